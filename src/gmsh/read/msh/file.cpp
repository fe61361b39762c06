// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/read/msh/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>

#include "gmsh/read/dialect.hpp"
#include "gmsh/read/msh/check.hpp"
#include "gmsh/read/msh/numbers.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

namespace fs = std::filesystem;

/// A header is in the first lines, after comments if there are any.
constexpr int kLinesToLookAt = 200;

/// For the end of a file: longer than any remark that may follow the mesh.
constexpr std::streamoff kTailToLookAt = 4096;

std::string lower_extension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string read_head(const std::string& path) {
  constexpr std::size_t kHead = std::size_t{1} << 20;  // a line may be as long as the file
  std::ifstream in(path, std::ios::binary);
  std::string head(kHead, ' ');
  in.read(head.data(), kHead);
  head.resize(static_cast<std::size_t>(in.gcount()));
  return head;
}

/// The last line with a dollar sign of a whole file ends a section.
void check_complete(const std::string& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::streamoff>(in.tellg());
  std::string tail(static_cast<std::size_t>(std::min(size, kTailToLookAt)), ' ');
  in.seekg(size - static_cast<std::streamoff>(tail.size()));
  in.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  const std::size_t last = tail.rfind("\n$");
  const std::string word = last == std::string::npos ? "" : tail.substr(last + 1, 4);
  if (word != "$End" && word != "$END") throw InputError(fmt::format("{} ends too soon: it is not complete", path));
}

/// Goes through a file section by section. Gmsh takes as many elements as the file says that there are, without a word
/// about more, about a section that is missing, or about numbers that it cannot hold; and where bytes are not what it
/// expects, it crashes.
class MshCheck {
 public:
  MshCheck(const std::string& path, std::string_view text, double version)
      : in_(path, text), state_{.in = in_, .version = version} {}
  MshContents run();

 private:
  void read_header();
  void read_names();
  bool read_section(const std::string& name);
  void find_end(const std::string& name, bool is_known);

  MshNumbers in_;
  MshState state_;
  MshContents contents_;
};

MshContents MshCheck::run() {
  while (!in_.at_end()) {
    const std::string_view line = in_.line();
    if (line.empty() || line[0] != '$') continue;
    const std::string name(line.substr(1));
    // Gmsh ends a section with what follows it, if that is what begins the next one.
    if (name.substr(0, 3) == "End" || name.substr(0, 3) == "END") continue;
    find_end(name, read_section(name));
  }
  if (state_.has_elements) contents_.elements = state_.elements;
  return contents_;
}

/// The number one, as four bytes, follows the line with the format in a binary file.
void MshCheck::read_header() {
  const std::string line(in_.line());
  int binary = 0;
  std::size_t size = 0;
  double version = 0;
  if (!(std::istringstream(line) >> version >> binary >> size)) in_.fail("has no version in its $MeshFormat");
  if (!binary) return;
  const std::string_view one = in_.peek_bytes(4);
  const bool swapped = one == std::string_view("\0\0\0\1", 4);
  if (!swapped && one != std::string_view("\1\0\0\0", 4)) in_.fail("says that it is binary and is not");
  if (version >= 4 && size != sizeof(std::size_t))
    in_.fail(
        fmt::format("is binary with numbers of {} bytes, and Gmsh reads those of {} alone", size, sizeof(std::size_t)));
  if (version >= 4 && version < 4.1) in_.fail("is binary and of version 4.0, which Gmsh reads as text alone");
  in_.be_binary(swapped);
  in_.integer();
}

/// Lines are text in binary files, too. Gmsh cuts names at a quote inside, and has as many dimensions as there are.
void MshCheck::read_names() {
  constexpr std::size_t kLongestLine = 250;
  const long long count = in_.word();
  in_.line();
  in_.require_room(count, 4, "names");
  for (long long i = 0; i < count; ++i) {
    const long long dim = in_.word(), tag = in_.word();
    const std::string line(in_.line());
    if (dim < 0 || dim > 3) in_.fail(fmt::format("contradicts itself: a group of dimension {}", dim));
    if (line.size() > kLongestLine)
      in_.fail(fmt::format("has a name of {} bytes, and Gmsh reads {}", line.size(), kLongestLine));
    const std::size_t open = line.find('"'), close = line.rfind('"');
    if (open == close || line.find('"', open + 1) == close) continue;
    contents_.odd_names.push_back(
        {static_cast<int>(dim), static_cast<int>(tag), line.substr(open + 1, close - open - 1)});
  }
}

/// \return false for one that is not known
bool MshCheck::read_section(const std::string& name) {
  const bool is_4 = state_.version >= 4;
  if (name == "MeshFormat")
    read_header();
  else if (name == "PhysicalNames")
    read_names();
  else if (name == "NodeData" || name == "ElementData" || name == "ElementNodeData")
    check_data(state_, name == "ElementNodeData");
  else if (name == "Nodes" || name == "NOD")
    is_4 ? check_nodes_of_4(state_) : check_nodes_before_4(state_, false);
  else if (name == "Elements" || name == "ELM")
    is_4 ? check_elements_of_4(state_) : check_elements_before_4(state_);
  else if (name == "Periodic")
    is_4 ? check_periodic_of_4(state_) : check_periodic_before_4(state_);
  else if (name == "ParametricNodes" && !is_4)
    check_nodes_before_4(state_, true);
  else if (name == "Entities" && state_.version >= 3)
    is_4 ? check_entities_of_4(state_, false) : check_entities_of_3(state_);
  else if (name == "PartitionedEntities" && is_4)
    check_entities_of_4(state_, true);
  else if (name == "GhostElements" && is_4)
    check_ghosts_of_4(state_);
  else
    return false;
  return true;
}

void MshCheck::find_end(const std::string& name, bool is_known) {
  const std::string end = (name == "NOD" || name == "ELM" ? "$END" : "$End") + name;
  if (is_known && !in_.at_end() && in_.peek_token().substr(0, 1) != "$")
    in_.fail(fmt::format("contradicts itself: there is more in ${} than it says", name));
  if (in_.skip_to_line(end) < 0) in_.fail(fmt::format("ends too soon: there is no {}", end));
}

}  // namespace

MshHeader read_msh_header(const std::string& path) {
  MshHeader header;
  const bool named_msh = lower_extension(path) == ".msh";
  std::istringstream in(read_head(path));
  std::string line;
  for (int i = 0; i < kLinesToLookAt && std::getline(in, line); ++i) {
    if (line.rfind("$NOD", 0) == 0) {
      header.version = 1;
      return header;
    }
    if (line.rfind("$MeshFormat", 0) != 0) continue;
    int binary = 0;
    std::getline(in, line);
    if (std::istringstream(line) >> header.version >> binary) {
      header.binary = binary != 0;
      return header;
    }
    break;
  }
  if (named_msh)
    throw InputError(fmt::format("{} has no $MeshFormat: it is not a Gmsh mesh{}", path, describe_dialect(path)));
  return {};
}

MshContents check_msh_file(const std::string& path, const MshHeader& header, bool whole) {
  if (header.version < 1 || header.version >= 5) return {};  // Gmsh says what it thinks of it
  check_complete(path);
  const MappedFile file(path);
  const MshContents contents = MshCheck(path, file.text(), header.version).run();
  if (whole && !contents.elements)
    throw InputError(
        fmt::format("{} has no $Elements: it is not complete, or Gmsh has left out what is in no physical "
                    "group (gmsh -save_all writes everything)",
                    path));
  return contents;
}

}  // namespace qmorph::adapter
