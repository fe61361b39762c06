// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/model/add_elements.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <limits>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/scratch_file.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

void add_by_call(const EntityMesh& entity) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  for (const ElementBlock& block : entity.blocks) {
    types.push_back(block.type);
    tags.push_back(block.tags);
    nodes.push_back(block.nodes);
  }
  if (!types.empty()) ::gmsh::model::mesh::addElements(entity.dim, entity.tag, types, tags, nodes);
}

template <class Number>
void put(std::ostream& out, std::initializer_list<Number> numbers) {
  for (const Number number : numbers) out.write(reinterpret_cast<const char*>(&number), sizeof number);
}

/// The $Elements of a binary file of format 4.1, and nothing else.
void write_elements(std::ostream& out, const std::vector<const EntityMesh*>& entities) {
  std::uint64_t blocks = 0, count = 0, lowest = std::numeric_limits<std::uint64_t>::max(), highest = 0;
  for (const EntityMesh* entity : entities)
    for (const ElementBlock& block : entity->blocks) {
      blocks += !block.tags.empty(), count += block.tags.size();
      for (const std::uint64_t tag : block.tags) lowest = std::min(lowest, tag), highest = std::max(highest, tag);
    }
  out << "$MeshFormat\n4.1 1 8\n";
  put<std::int32_t>(out, {1});
  out << "\n$EndMeshFormat\n$Elements\n";
  put<std::uint64_t>(out, {blocks, count, lowest, highest});
  for (const EntityMesh* entity : entities)
    for (const ElementBlock& block : entity->blocks) {
      if (block.tags.empty()) continue;
      put<std::int32_t>(out, {entity->dim, entity->tag, block.type});
      put<std::uint64_t>(out, {block.tags.size()});
      for (std::size_t e = 0; e < block.tags.size(); ++e) {
        put<std::uint64_t>(out, {block.tags[e]});
        for (std::size_t i = 0; i < block.nodes_per_element; ++i)
          put<std::uint64_t>(out, {block.nodes[e * block.nodes_per_element + i]});
      }
    }
  out << "\n$EndElements\n";
}

}  // namespace

void add_elements_by_calls(const std::vector<const EntityMesh*>& entities) {
  for (const EntityMesh* entity : entities) add_by_call(*entity);
}

void add_elements_by_file(const std::vector<const EntityMesh*>& entities) {
  std::vector<const EntityMesh*> rest;
  std::copy_if(entities.begin(), entities.end(), std::back_inserter(rest),
               [](const EntityMesh* entity) { return entity->element_count() > 0; });
  if (rest.empty()) return;
  // The last one by a call: after a file Gmsh finds elements by the file's numbers only, after a call by all.
  const EntityMesh* last = rest.back();
  rest.pop_back();
  if (!rest.empty()) {
    const ScratchFile file(".msh");
    {
      std::ofstream out(file.path(), std::ios::binary);
      write_elements(out, rest);
      if (!out.flush()) throw InputError("cannot write to the temporary file " + file.path());
    }
    const ScopedOption as_it_is("Geometry.MatchGeomAndMesh", 0);
    ::gmsh::merge(file.path());
  }
  add_by_call(*last);
}

void add_elements(const std::vector<const EntityMesh*>& entities, std::size_t nodes) {
  // A call costs about 20 ns for each node of the model: up to 50 ms by calls.
  constexpr double kManyLooks = 2.5e6;
  if (double(entities.size()) * double(nodes) > kManyLooks)
    add_elements_by_file(entities);
  else
    add_elements_by_calls(entities);
}

}  // namespace qmorph::adapter
