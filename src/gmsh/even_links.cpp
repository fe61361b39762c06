#include "gmsh/even_links.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "gmsh/compat.hpp"
#include "gmsh/patches.hpp"

namespace qmorph::adapter {
namespace {

/// A side of an element of a surface.
struct Side {
  Index low, high;
  std::uint32_t surface;
  Index triangle;  ///< numbered through all surfaces that are converted; kNone for any other element
  bool may_split;  ///< of a linear triangle
};

int corners_of(int type) {
  std::string name;
  int dim = 0, order = 0, nodes = 0, primary_nodes = 0;
  std::vector<double> local;
  ::gmsh::model::mesh::getElementProperties(type, name, dim, order, nodes, local, primary_nodes);
  return primary_nodes;
}

std::vector<Side> sorted_sides(const ModelMesh& mesh, const std::vector<std::uint32_t>& surfaces, Index& triangles) {
  std::vector<Side> sides;
  triangles = 0;
  for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
    if (mesh.entities[e].dim != 2) continue;
    const bool converted = std::binary_search(surfaces.begin(), surfaces.end(), e);
    for (const ElementBlock& block : mesh.entities[e].blocks) {
      const auto corners = std::size_t(corners_of(block.type));
      const bool counts = converted && corners == 3;
      for (std::size_t i = 0; i + block.nodes_per_element <= block.nodes.size(); i += block.nodes_per_element) {
        for (std::size_t k = 0; k < corners; ++k) {
          const Index a = mesh.rows.find(block.nodes[i + k]), b = mesh.rows.find(block.nodes[i + (k + 1) % corners]);
          if (a != kNone && b != kNone)
            sides.push_back({std::min(a, b), std::max(a, b), e, counts ? triangles : kNone, block.type == kTriangle3});
        }
        triangles += counts;
      }
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
    return std::tie(s.low, s.high, s.surface, s.triangle) < std::tie(t.low, t.high, t.surface, t.triangle);
  });
  return sides;
}

/// Calls `visit(first, last)` for the sides of each edge.
template <class Visit>
void for_each_edge(const std::vector<Side>& sides, const Visit& visit) {
  for (std::size_t first = 0, last; first < sides.size(); first = last) {
    last = first + 1;
    while (last < sides.size() && sides[last].low == sides[first].low && sides[last].high == sides[first].high) ++last;
    visit(first, last);
  }
}

/// Curves that get no node: the user's, and periodic ones.
std::set<int> held_curves(const ModelMesh& mesh, const std::set<int>& keep_curves) {
  std::set<int> held = keep_curves;
  for (const EntityMesh& entity : mesh.entities) {
    if (entity.dim != 1) continue;
    int master = entity.tag;
    std::vector<std::size_t> nodes, master_nodes;
    std::vector<double> transformation;
    ::gmsh::model::mesh::getPeriodicNodes(1, entity.tag, master, nodes, master_nodes, transformation, false);
    if (master != entity.tag) held.insert({entity.tag, master});
  }
  return held;
}

/// Edges with a line element of a held curve, or one that is not linear; sorted.
std::vector<std::pair<Index, Index>> held_edges(const ModelMesh& mesh, const std::set<int>& held) {
  std::vector<std::pair<Index, Index>> edges;
  for (const EntityMesh& entity : mesh.entities) {
    if (entity.dim != 1) continue;
    for (const ElementBlock& block : entity.blocks) {
      if (block.type == kLine2 && !held.count(entity.tag)) continue;
      for (std::size_t i = 0; i + block.nodes_per_element <= block.nodes.size(); i += block.nodes_per_element) {
        const Index a = mesh.rows.find(block.nodes[i]), b = mesh.rows.find(block.nodes[i + 1]);
        edges.emplace_back(std::min(a, b), std::max(a, b));
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// Regions of triangles that nothing separates: the smallest triangle of each is its root.
class Regions {
 public:
  explicit Regions(Index triangles) : parent_(triangles) { std::iota(parent_.begin(), parent_.end(), 0); }
  Index root(Index t) {
    while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
    return t;
  }
  void unite(Index t, Index u) {
    t = root(t), u = root(u);
    parent_[std::max(t, u)] = std::min(t, u);
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace

std::uint32_t curve_under(const ModelMesh& mesh, Index row_a, Index row_b) {
  for (Index row : {row_a, row_b})
    if (mesh.entities[mesh.owner[row]].dim == 1) return mesh.owner[row];
  return kNobody;
}

RegionGraph find_region_graph(const ModelMesh& mesh, const NodeUse& use, const std::vector<std::uint32_t>& surfaces,
                              const std::set<int>& keep_curves) {
  Index triangles = 0;
  const std::vector<Side> sides = sorted_sides(mesh, surfaces, triangles);
  const FixedEdges fixed(mesh, use);
  const auto is_inside = [&](std::size_t first, std::size_t last) {
    const Side &s = sides[first], &t = sides[last - 1];
    return last - first == 2 && s.triangle != kNone && t.triangle != kNone && s.surface == t.surface &&
           !fixed.contains(s.low, s.high);
  };
  Regions regions(triangles);
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    if (is_inside(first, last)) regions.unite(sides[first].triangle, sides[first + 1].triangle);
  });

  RegionGraph graph;
  std::vector<Index> number(triangles, kNone);
  const auto region_of = [&](const Side& side) {
    Index& region = number[regions.root(side.triangle)];
    if (region == kNone) {
      region = Index(graph.odd.size());
      graph.odd.push_back(false);
      graph.surface.push_back(side.surface);
    }
    return region;
  };
  const std::set<int> held = held_curves(mesh, keep_curves);
  const auto lines = held_edges(mesh, held);
  for_each_edge(sides, [&](std::size_t first, std::size_t last) {
    if (is_inside(first, last)) return;
    bool may_split = last - first <= 2;
    std::vector<Index> beside;
    for (std::size_t i = first; i < last; ++i) {
      may_split = may_split && sides[i].triangle != kNone && sides[i].may_split;
      if (sides[i].triangle == kNone) continue;
      beside.push_back(region_of(sides[i]));
      graph.odd[beside.back()] = !graph.odd[beside.back()];
    }
    const Index a = sides[first].low, b = sides[first].high;
    if (use.volume[a] && use.volume[b]) may_split = false;
    if (const std::uint32_t curve = curve_under(mesh, a, b); curve != kNobody && held.count(mesh.entities[curve].tag))
      may_split = false;
    if (!may_split || std::binary_search(lines.begin(), lines.end(), std::pair(a, b))) return;
    beside.resize(2, parity::kOutside);
    graph.links.push_back({beside[0], beside[1], (mesh.points[a] - mesh.points[b]).norm()});
    graph.edges.emplace_back(a, b);
  });
  return graph;
}

}  // namespace qmorph::adapter
