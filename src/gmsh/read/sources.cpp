// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/read/sources.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include "gmsh/read/readable.hpp"

namespace qmorph::adapter {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// Names of files in a script. Gmsh looks beside the script; some of its fields where the program runs.
std::vector<std::string> names_in(const std::string& script) {
  static const std::regex naming(
      R"((?:Merge|MergeWithBoundingBox|Include|ShapeFromFile|ListFromFile|FileName)\b[\s=(\[{]*["']([^"'\n]+)["'])");
  std::ifstream in(script, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  std::vector<std::string> names;
  for (std::sregex_iterator match(text.begin(), text.end(), naming), end; match != end; ++match) {
    const fs::path name = (*match)[1].str(), beside = fs::path(script).parent_path() / name;
    if (is_file(beside))
      names.push_back(beside.string());
    else if (is_file(name))
      names.push_back(name.string());
  }
  return names;
}

std::string escaped(const std::string& path) {
  std::string text;
  for (const char c : path) {
    if (c == ' ' || c == '#' || c == ':' || c == '%') text += '\\';
    if (c == '$') text += '$';
    text += c;
  }
  return text;
}

}  // namespace

std::vector<std::string> files_read(const StageLog& log) {
  constexpr std::string_view kBegin = "Reading '", kEnd = "'...";
  std::vector<std::string> files;
  for (const std::string& line : log.information)
    if (line.size() > kBegin.size() + kEnd.size() && line.compare(0, kBegin.size(), kBegin) == 0 &&
        line.compare(line.size() - kEnd.size(), kEnd.size(), kEnd) == 0)
      files.push_back(line.substr(kBegin.size(), line.size() - kBegin.size() - kEnd.size()));
  return files;
}

bool name_compounds(const std::vector<std::string>& files) {
  static const std::regex statement(R"(\bCompound\s+(Curve|Line|Surface)\b)");
  return std::any_of(files.begin(), files.end(), [](const std::string& file) {
    if (is_mesh_file(file) || is_cad_file(file) || !is_file(file)) return false;
    std::ifstream in(file, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(in), {});
    return std::regex_search(text, statement);
  });
}

std::vector<std::string> with_named_files(const std::vector<std::string>& files) {
  std::vector<std::string> open(files.rbegin(), files.rend()), all;
  const auto same = [](const std::string& a, const std::string& b) {
    std::error_code error;
    return a == b || fs::equivalent(a, b, error);
  };
  while (!open.empty()) {
    const std::string file = open.back();
    open.pop_back();
    const bool known = std::any_of(all.begin(), all.end(), [&](const std::string& other) { return same(file, other); });
    if (known || !is_file(file)) continue;
    all.push_back(file);
    if (is_mesh_file(file) || is_cad_file(file)) continue;
    const std::vector<std::string> names = names_in(file);
    open.insert(open.end(), names.rbegin(), names.rend());
  }
  return all;
}

std::string make_rule(const std::string& target, const std::vector<std::string>& files) {
  std::string text = escaped(target) + ":";
  for (const std::string& file : files) text += " \\\n  " + escaped(file);
  text += '\n';
  for (std::size_t i = 1; i < files.size(); ++i) text.append("\n").append(escaped(files[i])).append(":\n");
  return text;
}

}  // namespace qmorph::adapter
