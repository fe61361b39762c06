// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/read/dialect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <system_error>

namespace qmorph::adapter {
namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string head_of(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};  // a pipe would wait
  std::array<char, 1024> buffer{};
  std::ifstream in(path, std::ios::binary);
  in.read(buffer.data(), buffer.size());
  return {buffer.data(), static_cast<std::size_t>(in.gcount())};
}

}  // namespace

std::string describe_dialect(const std::string& path) {
  const std::string extension = extension_of(path), head = head_of(path);
  if (head.starts_with("\xEF\xBB\xBF")) return "; it begins with a byte order mark: save it as UTF-8 without one";
  if (head.starts_with("\xFF\xFE") || head.starts_with("\xFE\xFF")) return "; it is in UTF-16: save it as UTF-8";
  static const std::regex new_vtk(R"(^# vtk DataFile Version ([5-9][0-9.]*))");
  static const std::regex binary_ply(R"(\nformat\s+binary)");
  static const std::regex comma(R"(vertex\s+[-+]?\d+,\d)");
  std::smatch match;
  if (extension == ".vtk" && std::regex_search(head, match, new_vtk))
    return fmt::format("; it is of VTK {}: write it as VTK 4.2 or .msh", match[1].str());
  if (extension == ".ply" && std::regex_search(head, binary_ply)) return "; it is binary: write it as text, or as .stl";
  if (extension == ".stl" && std::regex_search(head, comma)) return "; it has decimal commas: write it with points";
  return {};
}

bool has_vtk_data(const std::string& path) {
  if (extension_of(path) != ".vtk") return false;
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return text.find("\nPOINT_DATA ") != std::string::npos || text.find("\nCELL_DATA ") != std::string::npos;
}

}  // namespace qmorph::adapter
