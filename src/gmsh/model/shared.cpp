// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/model/shared.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <tuple>

#include "kernel/sort_unique.hpp"

namespace qmorph::adapter {
namespace {

using Corners = std::span<const Index>;

std::uint64_t edge_key(Index a, Index b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

bool contains_key(const std::vector<std::uint64_t>& keys, std::uint64_t key) {
  return std::binary_search(keys.begin(), keys.end(), key);
}

/// Edges with a line element on them, sorted.
std::vector<std::uint64_t> find_lines(const ModelMesh& mesh) {
  std::vector<std::uint64_t> lines;
  for (const EntityMesh& entity : mesh.entities) {
    if (entity.dim != 1) continue;
    for (const ElementBlock& block : entity.blocks)
      for (std::size_t i = 0; i + block.nodes_per_element <= block.nodes.size(); i += block.nodes_per_element) {
        const Index a = mesh.rows.find(block.nodes[i]), b = mesh.rows.find(block.nodes[i + 1]);
        if (a != kNone && b != kNone) lines.push_back(edge_key(a, b));
      }
  }
  sort_unique(lines);
  return lines;
}

/// Of surfaces: take(index of the entity, corners as rows of the model's nodes, kNone for one that there is not).
template <class Take>
void for_each_element(const ModelMesh& mesh, const Take& take) {
  std::array<Index, 4> corners{};
  for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
    if (mesh.entities[e].dim != 2) continue;
    for (const ElementBlock& block : mesh.entities[e].blocks) {
      if (block.corners != 3 && block.corners != 4) continue;
      for (std::size_t i = 0; i + block.nodes_per_element <= block.nodes.size(); i += block.nodes_per_element) {
        for (std::size_t k = 0; k < block.corners; ++k) corners[k] = mesh.rows.find(block.nodes[i + k]);
        take(e, Corners(corners.data(), block.corners));
      }
    }
  }
}

/// A side of an element whose nodes are in several surfaces.
struct Side {
  std::uint64_t key;
  std::uint32_t entity;
  auto operator<=>(const Side&) const = default;
};

/// Edges of several surfaces.
class SharedEdges {
 public:
  SharedEdges(const ModelMesh& mesh, const NodeUse& use, const std::vector<std::uint64_t>& lines) : lines_(lines) {
    for_each_element(mesh, [&](std::uint32_t e, Corners corners) {
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const Index a = corners[k], b = corners[(k + 1) % corners.size()];
        if (a != kNone && b != kNone && use.several[a] && use.several[b]) sides_.push_back({edge_key(a, b), e});
      }
    });
    std::sort(sides_.begin(), sides_.end());
    for (std::size_t first = 0, last = 0; first < sides_.size(); first = last) {
      while (last < sides_.size() && sides_[last].key == sides_[first].key) ++last;
      if (sides_[last - 1].entity == sides_[first].entity) continue;
      edges_.push_back({first, last});
      if (is_line(edges_.back())) add_ends(edges_.back());
    }
    std::sort(ends_of_lines_.begin(), ends_of_lines_.end());
  }

  /// Those that have to stay.
  std::vector<std::uint64_t> fixed() const {
    std::vector<std::uint64_t> keys;
    for (const Edge& edge : edges_)
      if (!is_line(edge) && !is_across(edge)) keys.push_back(sides_[edge.first].key);
    return keys;
  }

  /// True if one line that ends there is a side of all of these surfaces.
  bool have_line_at(Index row, const std::vector<std::uint32_t>& surfaces) const {
    auto at = std::lower_bound(ends_of_lines_.begin(), ends_of_lines_.end(), End{row, surfaces.front(), 0});
    for (; at != ends_of_lines_.end() && std::get<0>(*at) == row && std::get<1>(*at) == surfaces.front(); ++at)
      if (std::all_of(surfaces.begin(), surfaces.end(),
                      [&](std::uint32_t surface) { return is_end(row, surface, std::get<2>(*at)); }))
        return true;
    return false;
  }

 private:
  struct Edge {
    std::size_t first, last;  ///< rows of `sides_`
  };
  using End = std::tuple<Index, std::uint32_t, std::uint64_t>;  ///< node, surface, line

  bool is_line(const Edge& edge) const { return contains_key(lines_, sides_[edge.first].key); }

  void add_ends(const Edge& line) {
    const std::uint64_t key = sides_[line.first].key;
    for (std::size_t i = line.first; i < line.last; ++i)
      for (const std::uint64_t row : {key >> 32, key & 0xffffffff})
        ends_of_lines_.emplace_back(Index(row), sides_[i].entity, key);
  }

  /// Inside each of its surfaces, between curves that these have in common.
  bool is_across(const Edge& edge) const {
    std::vector<std::uint32_t> surfaces;
    for (std::size_t i = edge.first; i < edge.last; i += 2) {
      if (i + 1 == edge.last || sides_[i + 1].entity != sides_[i].entity) return false;
      surfaces.push_back(sides_[i].entity);
    }
    const std::uint64_t key = sides_[edge.first].key;
    return have_line_at(Index(key >> 32), surfaces) && have_line_at(Index(key & 0xffffffff), surfaces);
  }

  bool is_end(Index row, std::uint32_t surface, std::uint64_t line) const {
    return std::binary_search(ends_of_lines_.begin(), ends_of_lines_.end(), End{row, surface, line});
  }

  const std::vector<std::uint64_t>& lines_;
  std::vector<Side> sides_;  ///< sorted
  std::vector<Edge> edges_;
  std::vector<End> ends_of_lines_;  ///< sorted
};

}  // namespace

FixedEdges::FixedEdges(const ModelMesh& mesh, const NodeUse& use) : keys_(find_lines(mesh)) {
  const std::vector<std::uint64_t> shared = SharedEdges(mesh, use, keys_).fixed();
  keys_.insert(keys_.end(), shared.begin(), shared.end());
  sort_unique(keys_);
  touched_.assign(mesh.tags.size(), false);
  for (std::uint64_t key : keys_) touched_[key >> 32] = touched_[key & 0xffffffff] = true;
}

bool FixedEdges::contains(Index row_a, Index row_b) const {
  return touched_[row_a] && touched_[row_b] && contains_key(keys_, edge_key(row_a, row_b));
}

std::map<std::uint32_t, CommonElement> find_common_elements(const ModelMesh& mesh, const NodeUse& use) {
  struct Element {
    std::array<Index, 4> rows;  // sorted; a triangle has kNone for the fourth
    std::uint32_t entity;
    bool operator<(const Element& other) const { return std::tie(rows, entity) < std::tie(other.rows, other.entity); }
  };
  std::vector<Element> elements;
  std::vector<std::size_t> others(mesh.entities.size(), 0);  // elements that no other surface has
  for_each_element(mesh, [&](std::uint32_t e, Corners corners) {
    ++others[e];
    const auto is_shared = [&](Index row) { return row != kNone && use.several[row]; };
    if (!std::all_of(corners.begin(), corners.end(), is_shared)) return;
    Element element{{kNone, kNone, kNone, kNone}, e};
    std::copy(corners.begin(), corners.end(), element.rows.begin());
    std::sort(element.rows.begin(), element.rows.end());
    elements.push_back(element);
  });
  std::sort(elements.begin(), elements.end());
  const auto is_common_with_next = [&](std::size_t i) {
    return i + 1 < elements.size() && elements[i].rows == elements[i + 1].rows &&
           elements[i].entity != elements[i + 1].entity;
  };
  for (std::size_t i = 0; i < elements.size(); ++i)
    if (is_common_with_next(i) || (i > 0 && is_common_with_next(i - 1))) --others[elements[i].entity];
  const std::vector<std::uint64_t> lines = find_lines(mesh);
  std::optional<SharedEdges> edges;
  const auto only_happens_to_be_common = [&](const Element& a, const Element& b) {
    if (a.rows.back() != kNone || others[a.entity] == 0 || others[b.entity] == 0) return false;
    if (!edges) edges.emplace(mesh, use, lines);
    return std::all_of(a.rows.begin(), a.rows.begin() + 3, [&](Index row) {
      return edges->have_line_at(row, {a.entity, b.entity});
    });
  };
  std::map<std::uint32_t, CommonElement> found;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!is_common_with_next(i)) continue;
    const Element &a = elements[i], &b = elements[i + 1];
    if (only_happens_to_be_common(a, b)) continue;
    found.try_emplace(a.entity, CommonElement{b.entity, a.rows[0]});
    found.try_emplace(b.entity, CommonElement{a.entity, a.rows[0]});
  }
  return found;
}

}  // namespace qmorph::adapter
