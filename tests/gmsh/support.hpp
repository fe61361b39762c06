// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Files, models and comparisons for the tests of the adapter and the command.

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gmsh/convert/periodic.hpp"
#include "gmsh/model/model_mesh.hpp"

namespace qmorph::test {

/// A directory of its own for each test, removed at the end.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  /// Names of all files, hidden ones too, in order.
  std::vector<std::string> files() const;

 private:
  std::filesystem::path path_;
};

/// Gmsh as a program gets it, with its own defaults.
struct RunningGmsh {
  RunningGmsh();
  ~RunningGmsh();
  RunningGmsh(const RunningGmsh&) = delete;
  RunningGmsh& operator=(const RunningGmsh&) = delete;
};

std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& text);

/// One call of the command in this process.
struct Result {
  int status = 0;
  std::string out, err;
};
Result run_qmorph(const std::vector<std::string>& arguments);

/// Everything that a file says.
struct Snapshot {
  adapter::ModelMesh mesh;
  using Group = std::pair<std::string, std::vector<int>>;  ///< name, entities
  std::map<std::pair<int, int>, Group> groups;             ///< by dimension and tag
  std::vector<adapter::PeriodicLink> links;                ///< of points and curves
};
Snapshot read_snapshot(const std::string& path);

/// How the nodes of two files are matched.
enum class Compare { tags, coordinates };

/// What differs between two files besides the inside of the surfaces `converted`: entities, groups, nodes and elements
/// of points, curves, other surfaces and volumes, and boundary edges of the converted ones. Empty if nothing does.
std::string difference(const Snapshot& before, const Snapshot& after, const std::set<int>& converted,
                       Compare compare = Compare::tags);

/// Converts a file to each of these formats of MSH, in text and in binary where Gmsh has that, and checks that nothing is
/// different but the inside of the surfaces `converted`.
void check_formats(const std::string& input, const std::vector<std::string>& formats, const std::set<int>& converted);

/// Triangles and quads of a surface.
std::pair<std::size_t, std::size_t> element_counts(const Snapshot& snapshot, int surface);

/// Makes a file with the Gmsh API: `build` makes the model, geometry and mesh.
/// \param version of MSH; everything is saved from 4 on, before only groups if there are any
void make_msh(const std::string& path, double version, bool binary, const std::function<void()>& build);

/// Two unit squares side by side, sharing curve 2. Surface 1 has an embedded curve 10 and an embedded point 20. Groups:
/// surface 1 "left" (5), curves 4 "inlet" (6) and 10 "crack" (7), point 20 "probe" (8); the rest is in no group.
void build_two_squares();

/// A square of n x n cells, each cut into two triangles, as rows of text.
struct Grid {
  int n = 4;
  double z = 0;  ///< all points at this height
  double x = 0;  ///< left edge
  int first_node = 1;
  std::vector<std::array<double, 3>> nodes() const;
  std::vector<std::array<int, 3>> triangles() const;
  std::vector<std::array<int, 2>> outline() const;
  int node(int i, int j) const { return first_node + j * (n + 1) + i; }
};

/// MSH 2.2 in ASCII from rows: nodes, then elements as "type tags... nodes..." without the number.
std::string msh22(const std::vector<std::array<double, 3>>& nodes, const std::vector<std::string>& elements,
                  const std::string& groups = {});

/// A row for `msh22`: a triangle with the given tags, as "2 2 0 1" for type 2, two tags, 0 and 1.
template <std::size_t N>
std::string row(const std::string& head, const std::array<int, N>& nodes) {
  std::string text = head;
  for (int node : nodes) text += ' ' + std::to_string(node);
  return text;
}

}  // namespace qmorph::test
