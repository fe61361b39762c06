// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/write/amend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "gmsh/session/compat.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

namespace fs = std::filesystem;

/// Some writers put the path of their file into it, here that of a temporary one. It is replaced by the file's final
/// name, padded with blanks.
void call_by_its_name(const std::string& written, const std::string& target) {
  constexpr std::streamsize kHead = 4096;
  std::fstream file(written, std::ios::in | std::ios::out | std::ios::binary);
  std::string head(kHead, '\0');
  file.read(head.data(), kHead);
  head.resize(static_cast<std::size_t>(file.gcount()));
  const std::size_t at = head.find(written);
  if (at == std::string::npos) return;
  std::string name = fs::path(target).filename().string();
  name.resize(written.size(), ' ');
  file.clear();
  file.seekp(static_cast<std::streamoff>(at));
  file << name;
}

/// Whether surface elements have nodes at a height other than 0.
bool are_surfaces_in_space() {
  std::vector<std::size_t> tags;
  std::vector<double> xyz, parameters;
  ::gmsh::vectorpair surfaces;
  ::gmsh::model::getEntities(surfaces, 2);
  for (const auto& [dim, tag] : surfaces) {
    ::gmsh::model::mesh::getNodes(tags, xyz, parameters, dim, tag, true, false);
    for (std::size_t i = 2; i < xyz.size(); i += 3)
      if (xyz[i] != 0) return true;
  }
  return false;
}

/// Gmsh writes all surface elements as plane-stress ones, which solvers expect in the plane z = 0.
void name_shells(const std::string& written) {
  const std::string of_gmsh = "*ELEMENT, type=CPS", shell = "*ELEMENT, type=S";
  std::ifstream in(written, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(in), {});
  in.close();
  std::string named;
  std::size_t done = 0;
  for (std::size_t at = 0; (at = text.find(of_gmsh, done)) != std::string::npos; done = at + of_gmsh.size())
    named.append(text, done, at - done).append(shell);
  named.append(text, done);
  std::ofstream(written, std::ios::binary) << named;
}

/// Gmsh writes the keyword of linear quads for those of order 2, too, and its own reader then reads half of each.
void name_quads_of_order_2(const std::string& written) {
  const std::string linear = "\n Quadrilaterals\n", quadratic = "\n QuadrilateralsQ2\n";
  std::ifstream in(written, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(in), {});
  in.close();
  const std::size_t at = text.find(linear);
  if (at == std::string::npos) return;
  text.replace(at, linear.size(), quadratic);
  std::ofstream(written, std::ios::binary) << text;
}

}  // namespace

void amend(const std::string& written, const std::string& target, const OutputFormat& format, int order) {
  call_by_its_name(written, target);
  if (order == 2 && format.name == "mesh") name_quads_of_order_2(written);
  if (format.name == "inp" && are_surfaces_in_space()) name_shells(written);
}

void check_msh_end(const std::string& written, const std::string& target) {
  // A complete one ends with an $End line, in binary too.
  std::ifstream in(written, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::streamoff>(in.tellg());
  std::string tail(static_cast<std::size_t>(std::min<std::streamoff>(size, 64)), ' ');
  in.seekg(size - static_cast<std::streamoff>(tail.size()));
  in.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  const std::size_t last_line = tail.rfind("\n$");
  if (tail.empty() || tail.back() != '\n' || last_line == std::string::npos ||
      (tail.compare(last_line, 5, "\n$End") != 0 && tail.compare(last_line, 5, "\n$END") != 0))
    throw OutputError(fmt::format("cannot write {}: the file is incomplete; is the disk full?", target));
}

}  // namespace qmorph::adapter
