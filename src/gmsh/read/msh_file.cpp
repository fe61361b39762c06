#include "gmsh/read/msh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

namespace fs = std::filesystem;

/// A header is in the first lines, after comments if there are any.
constexpr int kLinesToLookAt = 200;

/// For the end of a file: more than any remark that somebody may have left after the mesh.
constexpr std::streamoff kTailToLookAt = 4096;

/// Gmsh's element types go from 1 to this at most; it crashes on others.
constexpr long long kLastType = 140;

std::string lower_extension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
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
  TextCheck(const std::string& path, const MshHeader& header) : path_(path), version_(header.version) {}
  MshContents run();

 private:
  void begin(const std::string& word, std::istream& in);
  void take(const std::string& line);
  void take_element(const std::string& line);
  void end();
  void check_node_tag(long long tag) const {
    if (tag > std::numeric_limits<int>::max())
      throw InputError(
          fmt::format("{}: node numbers up to {} leave no room (the largest for Gmsh is {}); renumber the mesh", path_,
                      tag, std::numeric_limits<int>::max()));
  }

  const std::string& path_;
  double version_;
  std::string section_;
  long long stated_ = 0, expected_ = 0, lines_ = 0, rest_of_block_ = 0;
  std::optional<std::size_t> elements_;
};

MshContents TextCheck::run() {
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
  return {elements_, {}};
}

void TextCheck::begin(const std::string& word, std::istream& in) {
  section_ = word;
  lines_ = rest_of_block_ = 0;
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
  if (section_ == "Nodes" && version_ < 4) check_node_tag(numbers<1>(line)[0]);
  if (section_ == "Elements") take_element(line);
}

void TextCheck::take_element(const std::string& line) {
  // Number, type, how many tags, group, entity; in version 4 a line of this kind begins a block and ends in a count.
  const auto element = numbers<5>(line);
  if (version_ >= 4) {
    if (rest_of_block_-- > 0) return;
    rest_of_block_ = element[3];
  } else if (element[2] >= 2 && element[4] < 0) {
    throw InputError(fmt::format("{}: element {} has the elementary tag {}, and Gmsh cannot keep tags below 0", path_,
                                 element[0], element[4]));
  }
  const long long type = version_ < 4 ? element[1] : element[2];
  if (type < 1 || type > kLastType)
    throw InputError(
        fmt::format("{}: elements of type {}, which Gmsh does not have, in the line '{}'", path_, type, line));
}

void TextCheck::end() {
  const bool counted = section_ == "Elements" || (section_ == "Nodes" && version_ < 4);
  if (counted && (stated_ < 0 || lines_ > expected_))
    throw InputError(fmt::format("{} contradicts itself: ${} says {}, and there are {}", path_, section_, stated_,
                                 lines_ - (expected_ - stated_)));
  if (section_ == "Elements") elements_ = elements_.value_or(0) + static_cast<std::size_t>(stated_);
}

/// Lines of $PhysicalNames are text in binary files, too, and come before the nodes.
std::vector<GroupName> find_odd_names(const std::string& path) {
  std::vector<GroupName> names;
  std::ifstream in(path, std::ios::binary);
  bool inside = false;
  for (std::string line; std::getline(in, line) && line.rfind("$Nodes", 0) != 0;) {
    if (line[0] == '$') inside = line.rfind("$PhysicalNames", 0) == 0;
    const std::size_t open = line.find('"'), close = line.rfind('"');
    if (!inside || open == close || line.find('"', open + 1) == close) continue;
    const auto head = numbers<2>(line);
    names.push_back({static_cast<int>(head[0]), static_cast<int>(head[1]), line.substr(open + 1, close - open - 1)});
  }
  return names;
}

}  // namespace

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

MshContents check_msh_file(const std::string& path, const MshHeader& header, bool whole) {
  check_complete(path);
  MshContents contents;
  if (header.binary)
    check_binary(path);
  else if (header.is_2() || header.is_4())
    contents = TextCheck(path, header).run();
  if (whole && !header.binary && (header.is_2() || header.is_4()) && !contents.elements)
    throw InputError(fmt::format("{} has no $Elements: it is not complete", path));
  contents.odd_names = find_odd_names(path);
  return contents;
}

}  // namespace qmorph::adapter
