// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string_view>

#include "geometry/describe.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/element_types.hpp"
#include "gmsh/write/consumers.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

std::string group_name(int dim, int tag) {
  std::string name;
  ::gmsh::model::getPhysicalName(dim, tag, name);
  return name;
}

void save(const std::string& path, const fmt::memory_buffer& text) {
  std::ofstream out(path, std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) throw OutputError(fmt::format("cannot write {}; is the disk full?", path));
}

constexpr std::array<std::string_view, 5> kFamilies = {"CPS", "CPE", "CAX", "S", "M3D"};

/// Abaqus' name for an element type: for surfaces the family, the number of nodes, and R for reduced integration.
std::string abaqus_type(const ElementType& type, const std::string& family) {
  if (type.dim == 2 && (type.nodes == 3 || type.nodes == 4 || type.nodes == 6 || type.nodes == 8)) {
    const bool reduced = family.back() == 'R';
    return fmt::format("{}{}{}", family.substr(0, family.size() - reduced), type.nodes,
                       reduced && type.corners == 4 ? "R" : "");
  }
  if (type.dim == 3 && type.nodes == 4) return "C3D4";
  if (type.dim == 3 && type.corners == 8 && type.nodes == 8) return "C3D8";
  if (type.dim == 3 && type.nodes == 6) return "C3D6";
  throw OutputError(fmt::format("a deck has no element with {} corners and {} nodes", type.corners, type.nodes));
}

/// VTK's number of a linear element, which SU2 uses.
int vtk_type(const ElementType& type) {
  if (type.dim == 1) return 3;
  if (type.dim == 2) return type.corners == 3 ? 5 : 9;
  return type.corners == 4 ? 10 : type.corners == 5 ? 14 : type.corners == 6 ? 13 : 12;
}

/// Names of sets: without blanks or quotes, and not only digits.
std::string set_name(int dim, int tag) {
  std::string name = group_name(dim, tag);
  if (name.empty())
    name = fmt::format("{}{}", dim == 0 ? "POINT" : dim == 1 ? "CURVE" : dim == 2 ? "SURFACE" : "VOLUME", tag);
  for (char& c : name)
    if (static_cast<unsigned char>(c) < 128 && !std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  return name;
}

void append_set(fmt::memory_buffer& text, const char* keyword, const std::string& name,
                const std::set<std::size_t>& numbers) {
  constexpr std::size_t kPerLine = 10;  // readers take up to 16
  fmt::format_to(std::back_inserter(text), "*{}, {}={}\n", keyword, keyword, name);
  std::size_t i = 0;
  for (std::size_t number : numbers)
    fmt::format_to(std::back_inserter(text), "{}{}", number, ++i % kPerLine == 0 || i == numbers.size() ? "\n" : ", ");
}

}  // namespace

void write_msh2_for(const Consumer& consumer, const ConsumerMesh& mesh, const std::string& path) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
  std::set<std::pair<int, int>> groups;
  for (const ConsumerElement& element : mesh.elements)
    for (int group : element.groups) groups.emplace(element.dim, group);
  std::vector<std::string> names;
  for (const auto& [dim, tag] : groups)
    if (const std::string name = group_name(dim, tag); !name.empty())
      names.push_back(fmt::format("{} {} \"{}\"\n", dim, tag, name));
  if (!names.empty())
    fmt::format_to(out, "$PhysicalNames\n{}\n{}$EndPhysicalNames\n", names.size(), fmt::join(names, ""));
  fmt::format_to(out, "$Nodes\n{}\n", mesh.nodes.size());
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    fmt::format_to(out, "{} {} {} {}\n", i + 1, mesh.nodes[i].x(), mesh.nodes[i].y(), mesh.nodes[i].z());
  // MFEM takes no attribute below 1, even if the mesh has no groups at all.
  const int none = consumer.name == "mfem" ? 1 : 0;
  fmt::format_to(out, "$EndNodes\n$Elements\n{}\n", mesh.elements.size());
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) {
    const ConsumerElement& element = mesh.elements[i];
    fmt::format_to(out, "{} {} 2 {} {} {}\n", i + 1, element.type,
                   element.groups.empty() ? none : element.groups.front(), std::max(element.entity, 1),
                   fmt::join(element.nodes, " "));
  }
  fmt::format_to(out, "$EndElements\n");
  if (!mesh.links.empty()) fmt::format_to(out, "$Periodic\n{}\n", mesh.links.size());
  for (const PeriodicLink& link : mesh.links) {
    fmt::format_to(out, "{} {} {}\n", link.dim, link.slave, link.master);
    if (!link.transformation.empty()) fmt::format_to(out, "Affine {}\n", fmt::join(link.transformation, " "));
    fmt::format_to(out, "{}\n", link.nodes.size());
    for (const auto& [node, master] : link.nodes) fmt::format_to(out, "{} {}\n", node, master);
  }
  if (!mesh.links.empty()) fmt::format_to(out, "$EndPeriodic\n");
  save(path, text);
}

std::string choose_family(const std::string& asked, ConsumerMesh& mesh) {
  const std::optional<Eigen::Vector3d> off = find_off_plane(mesh, 0);
  if (!off)
    for (Eigen::Vector3d& p : mesh.nodes) p.z() = 0;  // a reader may take z = 1e-17 for another height
  const bool in_space = off && dimension(mesh) == 2;
  if (in_space && asked.rfind('C', 0) == 0)
    mesh.complaints.push_back(fmt::format(
        "elements {} must lie in the plane z = 0, and this mesh has a node at {}; --elements S makes shells", asked,
        describe(*off)));
  return !asked.empty() ? asked : in_space ? "S" : "CPS";
}

bool is_element_family(const std::string& family) {
  return std::any_of(kFamilies.begin(), kFamilies.end(),
                     [&](std::string_view known) { return family == known || family == std::string(known) + "R"; });
}

void write_su2_for(const ConsumerMesh& mesh, const std::string& path) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  const int dim = dimension(mesh);
  const auto line = [&](const ConsumerElement& element) {
    std::string words = std::to_string(vtk_type(element_type(element.type)));
    for (std::size_t node : element.nodes) words += ' ' + std::to_string(node - 1);
    return words;
  };
  std::vector<std::string> cells;
  std::map<int, std::vector<std::string>> markers;
  for (const ConsumerElement& element : mesh.elements) {
    if (element.dim == dim) cells.push_back(line(element));
    if (element.dim == dim - 1)
      for (int group : element.groups) markers[group].push_back(line(element));
  }
  fmt::format_to(out, "NDIME= {}\nNELEM= {}\n", dim, cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) fmt::format_to(out, "{} {}\n", cells[i], i);
  fmt::format_to(out, "NPOIN= {}\n", mesh.nodes.size());
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    fmt::format_to(out, "{} {} ", mesh.nodes[i].x(), mesh.nodes[i].y());
    if (dim == 3) fmt::format_to(out, "{} ", mesh.nodes[i].z());
    fmt::format_to(out, "{}\n", i);
  }
  fmt::format_to(out, "NMARK= {}\n", markers.size());
  for (const auto& [group, lines] : markers)
    fmt::format_to(out, "MARKER_TAG= {}\nMARKER_ELEMS= {}\n{}\n", set_name(dim - 1, group), lines.size(),
                   fmt::join(lines, "\n"));
  save(path, text);
}

void write_inp_for(const ConsumerMesh& mesh, const std::string& family, const std::string& path) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "*HEADING\nqmorph\n*NODE\n");
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    // CalculiX takes at most 20 characters for a number.
    fmt::format_to(out, "{}, {:.13g}, {:.13g}, {:.13g}\n", i + 1, mesh.nodes[i].x(), mesh.nodes[i].y(),
                   mesh.nodes[i].z());
  const int dim = dimension(mesh);

  std::map<std::pair<int, int>, std::set<std::size_t>> nodes, elements;  // by dimension and group
  std::map<std::pair<int, int>, std::vector<std::size_t>> blocks;        // elements by entity and type
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) {
    const ConsumerElement& element = mesh.elements[i];
    for (int group : element.groups) nodes[{element.dim, group}].insert(element.nodes.begin(), element.nodes.end());
    if (element.dim < dim) continue;
    for (int group : element.groups) elements[{element.dim, group}].insert(i + 1);
    blocks[{element.entity, element.type}].push_back(i);
  }
  for (const auto& [key, members] : blocks) {
    fmt::format_to(out, "*ELEMENT, TYPE={}, ELSET={}{}\n", abaqus_type(element_type(key.second), family),
                   dim == 2 ? "Surface" : "Volume", key.first);
    for (std::size_t i : members) fmt::format_to(out, "{}, {}\n", i + 1, fmt::join(mesh.elements[i].nodes, ", "));
  }
  for (const auto& [group, members] : elements) append_set(text, "ELSET", set_name(group.first, group.second), members);
  for (const auto& [group, members] : nodes) append_set(text, "NSET", set_name(group.first, group.second), members);
  save(path, text);
}

}  // namespace qmorph::adapter
