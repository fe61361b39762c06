#include "gmsh/open.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <regex>
#include <sstream>

#include "gmsh/compat.hpp"
#include "gmsh/meshing.hpp"
#include "gmsh/session.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

namespace fs = std::filesystem;

/// A header is in the first lines, after comments if there are any.
constexpr int kLinesToLookAt = 200;

/// For the end of a file: more than any remark that somebody may have left after the mesh.
constexpr std::streamoff kTailToLookAt = 4096;

/// More than this in a file without $Entities, and reading it again for each would take too long.
constexpr std::size_t kUndeclaredEntities = 256;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string lower_extension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Gmsh takes what it gets of a file that ends too soon, and says something only sometimes. The last line with a
/// dollar sign of a whole file ends a section.
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

/// The number one, as four bytes, follows the line with the format in a binary file.
void check_binary(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string line;
  while (std::getline(in, line) && line.rfind("$MeshFormat", 0) != 0) {
  }
  std::getline(in, line);
  std::array<char, 4> one{};
  in.read(one.data(), one.size());
  if (one != std::array<char, 4>{1, 0, 0, 0} && one != std::array<char, 4>{0, 0, 0, 1})
    throw InputError(fmt::format("{} says that it is binary and is not", path));
}

/// Numbers of a line, as many as there are up to N; the rest is 0.
template <std::size_t N>
std::array<long long, N> numbers(const std::string& line) {
  std::array<long long, N> values{};
  const char* at = line.c_str();
  for (long long& value : values) {
    char* end = nullptr;
    value = std::strtoll(at, &end, 10);
    if (end == at) break;
    at = end;
  }
  return values;
}

/// One pass over the lines of an ASCII file of version 2 or 4. Gmsh takes as many elements as the file says that there
/// are, without a word about more, about a section that is missing, or about tags that it cannot hold.
class TextCheck {
 public:
  TextCheck(const std::string& path, double version) : path_(path), version_(version) {}
  void run();

 private:
  void begin(const std::string& word, std::istream& in);
  void take(const std::string& line);
  void end() const;
  void check_node_tag(long long tag) const {
    if (tag > std::numeric_limits<int>::max())
      throw InputError(
          fmt::format("{}: node numbers up to {} leave no room (the largest for Gmsh is {}); renumber the mesh", path_,
                      tag, std::numeric_limits<int>::max()));
  }

  const std::string& path_;
  double version_;
  std::string section_;
  long long stated_ = 0, expected_ = 0, lines_ = 0;
  bool has_elements_ = false;
};

void TextCheck::run() {
  std::ifstream in(path_, std::ios::binary);
  for (std::string line; std::getline(in, line);) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (line.empty()) continue;
    if (section_.empty() && line[0] == '$') {
      begin(line.substr(1), in);
    } else if (line[0] == '$' && line == "$End" + section_) {
      end();
      section_.clear();
    } else {
      take(line);
    }
  }
  if (!section_.empty()) throw InputError(fmt::format("{} ends too soon: there is no $End{}", path_, section_));
  if (!has_elements_) throw InputError(fmt::format("{} has no $Elements: it is not complete", path_));
}

void TextCheck::begin(const std::string& word, std::istream& in) {
  section_ = word;
  lines_ = 0;
  if (word == "Elements") has_elements_ = true;
  if (word != "Elements" && word != "Nodes") return;
  std::string line;
  std::getline(in, line);
  const auto header = numbers<4>(line);
  stated_ = version_ < 4 ? header[0] : header[1];
  expected_ = version_ < 4 ? stated_ : header[0] + stated_;  // a line for each block
  if (word == "Nodes" && version_ > 4) check_node_tag(header[3]);
}

void TextCheck::take(const std::string& line) {
  ++lines_;
  if (version_ >= 4) return;
  if (section_ == "Nodes") check_node_tag(numbers<1>(line)[0]);
  if (section_ != "Elements") return;
  const auto element = numbers<5>(line);  // number, type, how many tags, group, entity
  if (element[2] >= 2 && element[4] < 0)
    throw InputError(fmt::format("{}: element {} has the elementary tag {}, and Gmsh cannot keep tags below 0", path_,
                                 element[0], element[4]));
}

void TextCheck::end() const {
  const bool counted = section_ == "Elements" || (section_ == "Nodes" && version_ < 4);
  if (counted && (stated_ < 0 || lines_ > expected_))
    throw InputError(fmt::format("{} contradicts itself: ${} says {}, and there are {}", path_, section_, stated_,
                                 lines_ - (expected_ - stated_)));
}

/// Of what Gmsh would take without a word.
void check_sections(const std::string& path, const MshHeader& header) {
  check_complete(path);
  if (header.binary)
    check_binary(path);
  else if (header.version >= 2 && (header.version < 3 || (header.version >= 4 && header.version < 5)))
    TextCheck(path, header.version).run();
}

bool surfaces_have_elements() {
  std::vector<int> types;
  ::gmsh::model::mesh::getElementTypes(types, 2);
  return !types.empty();
}

bool has_surfaces() {
  ::gmsh::vectorpair surfaces;
  ::gmsh::model::getEntities(surfaces, 2);
  return !surfaces.empty();
}

/// Version 2 stores one group for each element; Gmsh gives all groups of an entity to all its elements, and would
/// write each of them several times (notes 1.7).
void refuse_mixed_groups(const MshHeader& header) {
  if (header.version == 0 || header.version >= 4) return;
  ::gmsh::vectorpair entities;
  ::gmsh::model::getEntities(entities);
  for (const auto& [dim, tag] : entities) {
    std::vector<int> groups;
    ::gmsh::model::getPhysicalGroupsForEntity(dim, tag, groups);
    if (groups.size() > 1)
      throw InputError(fmt::format(
          "elements with elementary tag {} (dimension {}) are in {} physical groups, which Gmsh cannot keep apart; "
          "give each group its own elementary tag, or write the file as MSH 4.1",
          tag, dim, groups.size()));
  }
}

/// "Unknown entity 7 of dimension 1": what a file without $Entities makes Gmsh say when elements are on an entity
/// that no node is on. \return dimension and tag
std::optional<std::pair<int, int>> unknown_entity(const StageLog& log) {
  static const std::regex complaint(R"(Unknown entity (\d+) of dimension (\d+))");
  for (const std::string& error : log.errors) {
    std::smatch match;
    if (std::regex_search(error, match, complaint)) return std::pair(std::stoi(match[2]), std::stoi(match[1]));
  }
  return std::nullopt;
}

/// Opens a file. Entities that it uses and does not declare are made first, one more with each attempt.
StageLog open_file(const std::string& path) {
  StageLog log = run_logged([&] { ::gmsh::open(path); });
  std::vector<std::pair<int, int>> entities;
  while (entities.size() < kUndeclaredEntities) {
    const auto missing = unknown_entity(log);
    if (!missing || std::count(entities.begin(), entities.end(), *missing)) break;
    entities.push_back(*missing);
    log = run_logged([&] {
      ::gmsh::clear();
      ::gmsh::model::add(fs::path(path).stem().string());
      for (const auto& [dim, tag] : entities) ::gmsh::model::addDiscreteEntity(dim, tag);
      ::gmsh::merge(path);
    });
  }
  return log;
}

}  // namespace

/// Gmsh before 4.12 says nothing about a missing file, and asks no further about the others (notes, trap 3).
void check_readable(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(fmt::format("{}: no such file", path));
  if (fs::is_directory(status)) throw InputError(fmt::format("{} is a directory", path));
  if (!std::ifstream(path)) throw InputError(fmt::format("{} cannot be read", path));
  if (fs::is_regular_file(status) && fs::file_size(path, error) == 0)
    throw InputError(fmt::format("{} is empty", path));
}

MshHeader read_msh_header(const std::string& path) {
  MshHeader header;
  const bool named_msh = lower_extension(path) == ".msh";
  std::ifstream in(path, std::ios::binary);
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
  if (named_msh) throw InputError(fmt::format("{} has no $MeshFormat: it is not a Gmsh mesh", path));
  return {};
}

OpenedModel open_model(const std::string& path) {
  check_readable(path);
  OpenedModel opened;
  opened.msh = read_msh_header(path);
  if (opened.msh.version != 0) check_sections(path, opened.msh);
  set_option("Mesh.IgnorePeriodicity", 0);  // MSH 2 would lose it on reading (notes 1.5)

  auto start = std::chrono::steady_clock::now();
  const StageLog log = open_file(path);
  if (!log.errors.empty()) throw InputError(fmt::format("{} cannot be opened: {}", path, first_errors(log)));
  take_control();
  refuse_mixed_groups(opened.msh);
  opened.warnings = log.warnings;
  std::vector<int> views;
  ::gmsh::view::getTags(views);
  if (!views.empty())
    opened.warnings.push_back("the data in the file (views) is not part of the mesh and is not written");
  opened.open_seconds = seconds_since(start);

  opened.had_mesh = opened.msh.version != 0 || surfaces_have_elements();
  if (opened.had_mesh || !has_surfaces()) return opened;
  start = std::chrono::steady_clock::now();
  const std::vector<std::string> warnings = mesh_surfaces();
  opened.warnings.insert(opened.warnings.end(), warnings.begin(), warnings.end());
  opened.mesh_seconds = seconds_since(start);
  return opened;
}

}  // namespace qmorph::adapter
