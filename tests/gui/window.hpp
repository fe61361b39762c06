// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Gmsh's window with our panel, on a virtual display: tests press buttons and look at the model.

#include <gmsh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "cli/gui/gui.hpp"
#include "cli/gui/progress.hpp"
#include "gmsh/support.hpp"
#include "gmsh/window/snapshot.hpp"

namespace qmorph::test {

using namespace qmorph::cli;
namespace parameter = qmorph::cli::parameter;

inline constexpr const char* kPlate =
    "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 2, 1};\nDisk(2) = {1, 0.5, 0, 0.2};\n"
    "BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };\n"
    "Physical Surface(\"plate\", 1) = {3};\nMesh.MeshSizeMax = 0.1;\n";

/// Gmsh's session with our window in it.
class Window {
 public:
  explicit Window(std::vector<std::string> words)
      : words_(std::move(words)),
        request_(parse([&] {
          std::vector<std::string> all = words_;
          all.push_back("--gui");
          return all;
        }())),
        err_(stream_),
        call_{request_, words_, stream_, err_, process_},
        gui_(call_, session_) {}

  Gui& gui() { return gui_; }
  void press(const std::string& action) {
    adapter::ask_for(action);
    gui_.turn(0.01);
  }
  bool said(const std::string& part) const {
    return std::any_of(gui_.said().begin(), gui_.said().end(),
                       [&](const std::string& line) { return line.find(part) != std::string::npos; });
  }
  /// What the button saves, byte by byte.
  std::string saved() {
    adapter::set_parameter(parameter::kMeshFile, directory_ / "saved.msh");
    std::filesystem::remove(directory_ / "saved.msh");
    press(action::kSave);
    return read_file(directory_ / "saved.msh");
  }

 private:
  TemporaryDirectory directory_;
  std::ostringstream stream_;
  const std::vector<std::string> words_;
  const Request request_;
  const Process process_{};
  ErrorStream err_;
  const Call call_;
  adapter::Session session_{request_.gmsh_arguments};
  Gui gui_;
};

/// Triangles and quads of the current model.
inline std::pair<std::size_t, std::size_t> counts() {
  std::pair<std::size_t, std::size_t> result{0, 0};
  const adapter::ModelMesh mesh = adapter::read_model_mesh();
  for (const adapter::EntityMesh& entity : mesh.entities) {
    if (entity.dim != 2) continue;
    if (const auto* block = entity.polygons(3)) result.first += block->tags.size();
    if (const auto* block = entity.polygons(4)) result.second += block->tags.size();
  }
  return result;
}

/// What the command writes for these arguments.
inline std::string written(const std::string& words) {
  const TemporaryDirectory directory;
  const std::string out = directory / "command.msh";
  REQUIRE(std::system(fmt::format("\"{}\" {} -v 0 -o \"{}\"", QMORPH_COMMAND, words, out).c_str()) == 0);
  return read_file(out);
}

inline bool same_mesh(const adapter::ModelMesh& a, const adapter::ModelMesh& b) {
  if (a.tags != b.tags || a.points != b.points || a.owner != b.owner || a.entities.size() != b.entities.size())
    return false;
  for (std::size_t e = 0; e < a.entities.size(); ++e) {
    const auto &x = a.entities[e].blocks, &y = b.entities[e].blocks;
    if (x.size() != y.size() || a.entities[e].uv != b.entities[e].uv) return false;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (x[i].type != y[i].type || x[i].tags != y[i].tags || x[i].nodes != y[i].nodes) return false;
  }
  return true;
}

inline std::string figure(const std::string& name) {
  std::vector<std::string> names;
  gmsh::onelab::getNames(names, ".*/50Result/." + name);
  return names.empty() ? "" : adapter::text_parameter(names.front());
}

/// As large as the plate. Whatever the triangles are, its quads have irregular nodes: a boundary without corners asks
/// for at least four with three quads.
inline constexpr const char* kEllipse =
    "SetFactory(\"OpenCASCADE\");\nDisk(3) = {1, 0.5, 0, 1, 0.5};\n"
    "Physical Surface(\"ellipse\", 1) = {3};\nMesh.MeshSizeMax = 0.1;\n";

struct Plate {
  TemporaryDirectory directory;
  std::string path = directory / "plate.geo";
  explicit Plate(const char* script = kPlate) { write_file(path, script); }
};

}  // namespace qmorph::test
