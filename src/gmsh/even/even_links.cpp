// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/even/even_links.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "gmsh/model/patches.hpp"
#include "gmsh/model/periodic_links.hpp"
#include "parity/sets.hpp"
#include "quality/sides.hpp"

namespace qmorph::adapter {
namespace {

/// A side of an element of one of several surfaces.
struct SurfaceSide {
  Index low, high;
  std::uint32_t surface;
  Index triangle;  ///< numbered through all surfaces that are converted; kNone for any other element
  int order;       ///< of its element
};

std::vector<SurfaceSide> sides_of_surfaces(const ModelMesh& mesh, const std::vector<std::uint32_t>& surfaces,
                                           Index& triangles) {
  std::vector<SurfaceSide> sides;
  triangles = 0;
  for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
    if (mesh.entities[e].dim != 2) continue;
    const bool converted = std::binary_search(surfaces.begin(), surfaces.end(), e);
    for (const ElementBlock& block : mesh.entities[e].blocks) {
      const std::size_t corners = block.corners;
      const bool counts = converted && corners == 3;
      for (std::size_t i = 0; i + block.nodes_per_element <= block.nodes.size(); i += block.nodes_per_element) {
        for (std::size_t k = 0; k < corners; ++k) {
          const Index a = mesh.rows.find(block.nodes[i + k]), b = mesh.rows.find(block.nodes[i + (k + 1) % corners]);
          if (a != kNone && b != kNone)
            sides.push_back({std::min(a, b), std::max(a, b), e, counts ? triangles : kNone, block.order});
        }
        triangles += counts;
      }
    }
  }
  std::sort(sides.begin(), sides.end(), [](const SurfaceSide& s, const SurfaceSide& t) {
    return std::tie(s.low, s.high, s.surface, s.triangle) < std::tie(t.low, t.high, t.surface, t.triangle);
  });
  return sides;
}

using Edge = std::pair<Index, Index>;  ///< rows, the smaller one first

struct Line {
  Edge edge;
  int curve, order;
  bool operator<(const Line& other) const { return std::tie(edge, curve) < std::tie(other.edge, other.curve); }
};

/// The line elements of all curves, by their ends.
std::vector<Line> sorted_lines(const ModelMesh& mesh) {
  std::vector<Line> lines;
  for (const EntityMesh& entity : mesh.entities) {
    if (entity.dim != 1) continue;
    for (const ElementBlock& block : entity.blocks)
      for (std::size_t i = 0; i + block.nodes_per_element <= block.nodes.size(); i += block.nodes_per_element) {
        const Index a = mesh.rows.find(block.nodes[i]), b = mesh.rows.find(block.nodes[i + 1]);
        lines.push_back({std::minmax(a, b), entity.tag, block.order});
      }
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

/// An edge on the boundary of regions that may get a node.
struct Candidate {
  Edge edge;
  std::vector<Index> regions;  ///< whose parity changes; one may be there twice
  double length;
  std::set<int> curves;  ///< that it is on
};

/// Edges that only get a node together: those that are images of one another, on periodic curves.
class Images {
 public:
  explicit Images(const std::vector<Candidate>& candidates)
      : candidates_(candidates), sets_(candidates.size()), lonely_(candidates.size(), false) {}
  void join(const ModelMesh& mesh, const PeriodicLink& link);
  /// Candidates that go together, without those that miss an image.
  std::vector<std::vector<Index>> groups();

 private:
  Index find(const Edge& edge) const {
    const auto at = std::lower_bound(candidates_.begin(), candidates_.end(), edge,
                                     [](const Candidate& candidate, const Edge& e) { return candidate.edge < e; });
    return at == candidates_.end() || at->edge != edge ? kNone : Index(at - candidates_.begin());
  }

  const std::vector<Candidate>& candidates_;
  parity::Sets sets_;
  std::vector<bool> lonely_;
};

void Images::join(const ModelMesh& mesh, const PeriodicLink& link) {
  std::map<Index, Index> master_of, slave_of;
  for (const auto& [slave, master] : link.nodes) {
    const Index s = mesh.rows.find(slave), m = mesh.rows.find(master);
    master_of[s] = m;
    slave_of[m] = s;
  }
  const auto look = [&](int curve, const std::map<Index, Index>& image) {
    for (Index i = 0; i < candidates_.size(); ++i) {
      if (!candidates_[i].curves.count(curve)) continue;
      const auto a = image.find(candidates_[i].edge.first), b = image.find(candidates_[i].edge.second);
      const Index other = a == image.end() || b == image.end() ? kNone : find(std::minmax(a->second, b->second));
      if (other == kNone)
        lonely_[i] = true;
      else
        sets_.unite(i, other);
    }
  };
  look(link.slave, master_of);
  look(link.master, slave_of);
}

std::vector<std::vector<Index>> Images::groups() {
  std::map<Index, std::vector<Index>> members;
  std::set<Index> lonely;
  for (Index i = 0; i < candidates_.size(); ++i) {
    members[sets_.root(i)].push_back(i);
    if (lonely_[i]) lonely.insert(sets_.root(i));
  }
  std::vector<std::vector<Index>> groups;
  for (auto& [first, group] : members)
    if (!lonely.count(first)) groups.push_back(std::move(group));
  return groups;
}

void make_link(const std::vector<Candidate>& candidates, const std::vector<Index>& group, RegionGraph& graph) {
  std::set<Index> changed;
  parity::Link link{parity::kOutside, parity::kOutside, candidates[group.front()].length, int(group.size())};
  std::vector<Edge> edges;
  for (Index i : group) {
    for (Index region : candidates[i].regions)
      if (!changed.insert(region).second) changed.erase(region);
    link.length = std::min(link.length, candidates[i].length);
    edges.push_back(candidates[i].edge);
  }
  auto region = changed.begin();
  if (region != changed.end()) link.a = *region++;
  if (region != changed.end()) link.b = *region++;
  link.others.assign(region, changed.end());
  graph.links.push_back(std::move(link));
  graph.edges.push_back(std::move(edges));
}

/// Numbers the regions, and finds out which edges of their boundaries may get a node.
class FindingRegions {
 public:
  FindingRegions(const ModelMesh& mesh, const NodeUse& use, const std::vector<std::uint32_t>& surfaces,
                 const std::set<int>& keep_curves)
      : mesh_(mesh),
        use_(use),
        keep_curves_(keep_curves),
        fixed_(mesh, use),
        lines_(sorted_lines(mesh)),
        sides_(sides_of_surfaces(mesh, surfaces, triangles_)),
        joined_(triangles_),
        number_(triangles_, kNone) {}

  RegionGraph run() {
    for_each_edge(sides_, [&](std::span<const SurfaceSide> edge) {
      if (!is_inside(edge)) return;
      for (std::size_t k = 0; k < edge.size(); k += 2) joined_.unite(edge[k].triangle, edge[k + 1].triangle);
    });
    std::vector<Candidate> candidates;
    for_each_edge(sides_, [&](std::span<const SurfaceSide> edge) {
      if (is_inside(edge)) return;
      Candidate candidate = count_in_regions(edge);
      if (may_split(edge, candidate)) candidates.push_back(std::move(candidate));
    });
    Images images(candidates);
    for (const PeriodicLink& link : read_periodic_links(mesh_, 1)) images.join(mesh_, link);
    for (const std::vector<Index>& group : images.groups()) make_link(candidates, group, graph_);
    return std::move(graph_);
  }

 private:
  /// Between two triangles of one region, in each of the surfaces that happen to have the edge.
  bool is_inside(std::span<const SurfaceSide> edge) const {
    if (edge.size() % 2 != 0 || !is_manifold(edge) || fixed_.contains(edge[0].low, edge[0].high)) return false;
    for (std::size_t k = 0; k < edge.size(); k += 2) {
      const SurfaceSide &s = edge[k], &t = edge[k + 1];
      if (s.surface != t.surface || s.triangle == kNone || t.triangle == kNone) return false;
    }
    return true;
  }

  /// In each of the surfaces that meet here.
  static bool is_manifold(std::span<const SurfaceSide> edge) {
    for (std::size_t k = 2; k < edge.size(); ++k)
      if (edge[k].surface == edge[k - 2].surface) return false;
    return true;
  }

  Index region_of(const SurfaceSide& side) {
    Index& region = number_[joined_.root(side.triangle)];
    if (region == kNone) {
      region = Index(graph_.odd.size());
      graph_.odd.push_back(false);
      graph_.surface.push_back(side.surface);
    }
    return region;
  }

  /// An edge of a boundary counts once in the parity of each region beside it.
  Candidate count_in_regions(std::span<const SurfaceSide> edge) {
    const Index a = edge[0].low, b = edge[0].high;
    Candidate candidate{{a, b}, {}, (mesh_.points[a] - mesh_.points[b]).norm(), {}};
    for (const SurfaceSide& side : edge) {
      if (side.triangle == kNone) continue;
      const Index region = region_of(side);
      candidate.regions.push_back(region);
      graph_.odd[region] = !graph_.odd[region];
    }
    return candidate;
  }

  /// Notes the curves that the edge is on, too.
  bool may_split(std::span<const SurfaceSide> edge, Candidate& candidate) const {
    const auto [a, b] = candidate.edge;
    const int order = edge[0].order;
    bool may = is_manifold(edge) && (use_.volume[a] == kNobody || use_.volume[b] == kNobody);
    for (const SurfaceSide& side : edge) may = may && side.triangle != kNone && side.order == order;
    const auto [from, to] = std::equal_range(lines_.begin(), lines_.end(), Line{candidate.edge, 0, 0},
                                             [](const Line& s, const Line& t) { return s.edge < t.edge; });
    for (auto line = from; line != to; ++line) {
      candidate.curves.insert(line->curve);
      may = may && line->order == order;
    }
    if (const std::uint32_t curve = curve_under(mesh_, a, b); curve != kNobody)
      candidate.curves.insert(mesh_.entities[curve].tag);
    for (int curve : candidate.curves) may = may && !keep_curves_.count(curve);
    return may;
  }

  const ModelMesh& mesh_;
  const NodeUse& use_;
  const std::set<int>& keep_curves_;
  const FixedEdges fixed_;
  const std::vector<Line> lines_;
  Index triangles_ = 0;
  const std::vector<SurfaceSide> sides_;
  parity::Sets joined_;        ///< of triangles that nothing separates
  std::vector<Index> number_;  ///< of a region, by the root of its triangles
  RegionGraph graph_;
};

}  // namespace

std::uint32_t curve_under(const ModelMesh& mesh, Index row_a, Index row_b) {
  for (Index row : {row_a, row_b})
    if (mesh.entities[mesh.owner[row]].dim == 1) return mesh.owner[row];
  return kNobody;
}

RegionGraph find_region_graph(const ModelMesh& mesh, const NodeUse& use, const std::vector<std::uint32_t>& surfaces,
                              const std::set<int>& keep_curves) {
  return FindingRegions(mesh, use, surfaces, keep_curves).run();
}

bool has_enclosed_odd_regions(const std::vector<int>& surfaces) {
  const ModelMesh mesh = read_model_mesh();
  std::vector<std::uint32_t> entities;
  for (std::uint32_t e = 0; e < mesh.entities.size(); ++e)
    if (mesh.entities[e].dim == 2 && std::count(surfaces.begin(), surfaces.end(), mesh.entities[e].tag))
      entities.push_back(e);
  const RegionGraph graph = find_region_graph(mesh, find_node_use(mesh), entities, {});
  return !parity::plan_splits(graph.odd, graph.links).odd_left.empty();
}

}  // namespace qmorph::adapter
