// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/write/msh2_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

#include "gmsh/model/model_mesh.hpp"
#include "gmsh/model/periodic_links.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 20;

/// Writes text and binary numbers to a file.
class Output {
 public:
  Output(const std::string& path, bool is_binary) : binary(is_binary), file_(path, std::ios::binary) {}

  template <class... Arguments>
  void text(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Arguments>(arguments)...);
    if (buffer_.size() > kBufferSize) flush();
  }
  template <class Number>
  void raw(Number number) {
    char bytes[sizeof number];
    std::memcpy(bytes, &number, sizeof number);
    buffer_.append(bytes, bytes + sizeof number);
    if (buffer_.size() > kBufferSize) flush();
  }
  void close(const std::string& path) {
    flush();
    file_.close();
    if (!file_) throw OutputError(fmt::format("cannot write {}: {}", path, std::strerror(errno)));
  }

  const bool binary;

 private:
  void flush() {
    file_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }
  std::ofstream file_;
  fmt::memory_buffer buffer_;
};

std::int32_t int32(std::size_t tag) {
  if (tag > INT32_MAX) throw OutputError(fmt::format("MSH 2.2 has no room for the tag {}; use -format msh41", tag));
  return static_cast<std::int32_t>(tag);
}

void write_header(Output& out) {
  out.text("$MeshFormat\n2.2 {} {}\n", out.binary ? 1 : 0, sizeof(double));
  if (out.binary) {
    out.raw(std::int32_t{1});  // tells readers the byte order
    out.text("\n");
  }
  out.text("$EndMeshFormat\n");
}

void write_group_names(Output& out) {
  ::gmsh::vectorpair groups;
  ::gmsh::model::getPhysicalGroups(groups);
  std::vector<std::string> lines;
  for (const auto& [dim, tag] : groups) {
    std::string name;
    ::gmsh::model::getPhysicalName(dim, tag, name);
    if (!name.empty()) lines.push_back(fmt::format("{} {} \"{}\"\n", dim, tag, name));
  }
  if (lines.empty()) return;
  out.text("$PhysicalNames\n{}\n", lines.size());
  for (const std::string& line : lines) out.text("{}", line);
  out.text("$EndPhysicalNames\n");
}

void write_nodes(Output& out, const ModelMesh& mesh) {
  const double factor = get_option("Mesh.ScalingFactor");
  out.text("$Nodes\n{}\n", mesh.tags.size());
  for (std::size_t row = 0; row < mesh.tags.size(); ++row) {
    const Eigen::Vector3d p = factor * mesh.points[row];
    if (out.binary) {
      out.raw(int32(mesh.tags[row]));
      for (const double coordinate : {p.x(), p.y(), p.z()}) out.raw(coordinate);
    } else {
      // The shortest digits that read back as the same number, which 16 digits are not always.
      out.text("{} {} {} {}\n", mesh.tags[row], p.x(), p.y(), p.z());
    }
  }
  out.text("{}$EndNodes\n", out.binary ? "\n" : "");
}

/// An entity as version 2 sees it.
struct Place {
  int elementary = 0;
  std::vector<int> groups;      ///< at least one; 0 means none
  std::vector<int> partitions;  ///< empty in a mesh that has none
};

/// \return nothing for entities that Gmsh made between partitions, which the file does not have
std::optional<Place> find_place(const EntityMesh& entity, const Msh2Origin& origin) {
  Place place;
  int parent_dim = -1, parent_tag = -1;
  ::gmsh::model::getParent(entity.dim, entity.tag, parent_dim, parent_tag);
  ::gmsh::model::getPartitions(entity.dim, entity.tag, place.partitions);
  const bool is_part = !place.partitions.empty();
  if (is_part && parent_dim != entity.dim) return std::nullopt;
  place.elementary = is_part ? parent_tag : entity.tag;
  const auto renamed = origin.elementary.find({entity.dim, place.elementary});
  ::gmsh::model::getPhysicalGroupsForEntity(entity.dim, entity.tag, place.groups);
  if (place.groups.empty() && is_part) ::gmsh::model::getPhysicalGroupsForEntity(parent_dim, parent_tag, place.groups);
  if (renamed != origin.elementary.end()) place.elementary = renamed->second;
  if (place.groups.empty()) place.groups.push_back(0);
  std::sort(place.groups.begin(), place.groups.end());
  return place;
}

/// Writes elements one by one. An element in several groups is written once for each.
class ElementWriter {
 public:
  ElementWriter(Output& out, const ModelMesh& mesh, const Msh2Origin& origin);
  void write();

 private:
  void write_block(const ElementBlock& block, const Place& place, int group);
  std::size_t number(std::size_t element, const Place& place, int group);

  Output& out_;
  const ModelMesh& mesh_;
  const Msh2Origin& origin_;
  std::size_t next_ = 0;
};

ElementWriter::ElementWriter(Output& out, const ModelMesh& mesh, const Msh2Origin& origin)
    : out_(out), mesh_(mesh), origin_(origin), next_(mesh.max_element_tag) {
  for (const auto& [element, copies] : origin.copies)
    for (const auto& [group, number] : copies) next_ = std::max(next_, number);
}

void ElementWriter::write() {
  std::size_t count = 0;
  for (const EntityMesh& entity : mesh_.entities)
    if (const auto place = find_place(entity, origin_)) count += entity.element_count() * place->groups.size();
  out_.text("$Elements\n{}\n", count);
  for (const EntityMesh& entity : mesh_.entities)
    if (const auto place = find_place(entity, origin_))
      for (int group : place->groups)
        for (const ElementBlock& block : entity.blocks) write_block(block, *place, group);
  out_.text("{}$EndElements\n", out_.binary ? "\n" : "");
}

std::size_t ElementWriter::number(std::size_t element, const Place& place, int group) {
  if (group == place.groups.front()) return element;
  if (const auto copies = origin_.copies.find(element); copies != origin_.copies.end())
    if (const auto copy = copies->second.find(group); copy != copies->second.end()) return copy->second;
  return ++next_;
}

void ElementWriter::write_block(const ElementBlock& block, const Place& place, int group) {
  std::vector<std::int32_t> tags = {group, place.elementary};
  if (!place.partitions.empty()) tags.push_back(static_cast<std::int32_t>(place.partitions.size()));
  tags.insert(tags.end(), place.partitions.begin(), place.partitions.end());
  if (out_.binary)
    for (const std::size_t word : {static_cast<std::size_t>(block.type), block.tags.size(), tags.size()})
      out_.raw(int32(word));
  for (std::size_t e = 0; e < block.tags.size(); ++e) {
    const std::size_t tag = number(block.tags[e], place, group);
    const std::size_t* nodes = block.nodes.data() + e * block.nodes_per_element;
    if (out_.binary) {
      out_.raw(int32(tag));
      for (std::int32_t word : tags) out_.raw(word);
      for (std::size_t k = 0; k < block.nodes_per_element; ++k) out_.raw(int32(nodes[k]));
    } else {
      out_.text("{} {} {} {} {}\n", tag, block.type, tags.size(), fmt::join(tags, " "),
                fmt::join(nodes, nodes + block.nodes_per_element, " "));
    }
  }
}

/// As text in binary files, too, as Gmsh does it.
void write_periodic(Output& out, const ModelMesh& mesh) {
  std::vector<PeriodicLink> links;
  for (int dim : {0, 1, 2, 3}) {
    const std::vector<PeriodicLink> more = read_periodic_links(mesh, dim);
    links.insert(links.end(), more.begin(), more.end());
  }
  if (links.empty()) return;
  out.text("$Periodic\n{}\n", links.size());
  for (const PeriodicLink& link : links) {
    out.text("{} {} {}\n", link.dim, link.slave, link.master);
    if (!link.transformation.empty()) out.text("Affine {}\n", fmt::join(link.transformation, " "));
    out.text("{}\n", link.nodes.size());
    for (const auto& [node, master] : link.nodes) out.text("{} {}\n", node, master);
  }
  out.text("$EndPeriodic\n");
}

}  // namespace

void write_msh2(const std::string& path, bool binary, const Msh2Origin& origin) {
  const ModelMesh mesh = read_model_mesh();
  Output out(path, binary);
  write_header(out);
  write_group_names(out);
  write_nodes(out, mesh);
  ElementWriter(out, mesh, origin).write();
  write_periodic(out, mesh);
  out.close(path);
}

}  // namespace qmorph::adapter
