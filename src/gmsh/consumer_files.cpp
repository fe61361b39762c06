#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "gmsh/compat.hpp"
#include "gmsh/consumers.hpp"
#include "gmsh/element_types.hpp"
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

/// Abaqus' numbers of element types: by dimension, corners and nodes.
const char* abaqus_type(const ElementType& type) {
  if (type.dim == 2 && type.nodes == 3) return "CPS3";
  if (type.dim == 2 && type.nodes == 6) return "CPS6";
  if (type.dim == 2 && type.corners == 4 && type.nodes == 4) return "CPS4";
  if (type.dim == 2 && type.corners == 4 && type.nodes == 8) return "CPS8";
  if (type.dim == 3 && type.nodes == 4) return "C3D4";
  if (type.dim == 3 && type.corners == 8 && type.nodes == 8) return "C3D8";
  if (type.dim == 3 && type.nodes == 6) return "C3D6";
  throw OutputError(fmt::format("a deck has no element with {} corners and {} nodes", type.corners, type.nodes));
}

/// Names of sets: no blanks, no quotes, and not of digits alone.
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
  constexpr std::size_t kPerLine = 10;  // 16 at most
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
  // MFEM takes no attribute below 1, if the mesh has no groups at all.
  const int none = consumer.name == "mfem" ? 1 : 0;
  fmt::format_to(out, "$EndNodes\n$Elements\n{}\n", mesh.elements.size());
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) {
    const ConsumerElement& element = mesh.elements[i];
    fmt::format_to(out, "{} {} 2 {} {} {}\n", i + 1, element.type,
                   element.groups.empty() ? none : element.groups.front(), std::max(element.entity, 1),
                   fmt::join(element.nodes, " "));
  }
  fmt::format_to(out, "$EndElements\n");
  save(path, text);
}

void write_inp_for(const ConsumerMesh& mesh, const std::string& path) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "*HEADING\nqmorph\n*NODE\n");
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    // CalculiX takes 20 characters for a number and not one more.
    fmt::format_to(out, "{}, {:.13g}, {:.13g}, {:.13g}\n", i + 1, mesh.nodes[i].x(), mesh.nodes[i].y(),
                   mesh.nodes[i].z());
  int dim = 0;
  for (const ConsumerElement& element : mesh.elements) dim = std::max(dim, element.dim);

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
    fmt::format_to(out, "*ELEMENT, TYPE={}, ELSET={}{}\n", abaqus_type(element_type(key.second)),
                   dim == 2 ? "Surface" : "Volume", key.first);
    for (std::size_t i : members) fmt::format_to(out, "{}, {}\n", i + 1, fmt::join(mesh.elements[i].nodes, ", "));
  }
  for (const auto& [group, members] : elements) append_set(text, "ELSET", set_name(group.first, group.second), members);
  for (const auto& [group, members] : nodes) append_set(text, "NSET", set_name(group.first, group.second), members);
  save(path, text);
}

}  // namespace qmorph::adapter
