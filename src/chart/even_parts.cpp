// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <map>

#include "chart/interfaces.hpp"

namespace qmorph::chart {
namespace {

/// A tree of parts, in which each has a lower one that is its neighbour, and a side of the longest edge between the
/// two.
struct Tree {
  std::vector<Index> order, parent, longest;
};

class Evening {
 public:
  Evening(SurfaceMesh& mesh, std::vector<Index>& opposite, Division& division, std::vector<Edge>& creases,
          std::vector<Edge>& interface, const space::Background& background)
      : mesh_(mesh),
        opposite_(opposite),
        division_(division),
        creases_(creases),
        interface_(interface),
        background_(background),
        part_(mesh.faces.size(), kNone),
        changed_(division.parts.size(), 0) {
    for (Index p = 0; p < division.parts.size(); ++p)
      for (Index f : division.parts[p]) part_[f] = p;
  }

  std::vector<char> run() {
    std::vector<char> odd(division_.parts.size(), 0);
    for (Index side = 0; side < opposite_.size(); ++side)
      if (side % 4 < degree(mesh_.faces[side / 4]) && (opposite_[side] == kNone || division_.is_cut[side]))
        odd[part_[side / 4]] ^= 1;
    const Tree tree = span();
    for (std::size_t i = tree.order.size(); i-- > 1;) {
      const Index part = tree.order[i];
      if (!odd[part]) continue;
      Index side = tree.longest[part];
      for (auto moved = moved_.find(side); moved != moved_.end(); moved = moved_.find(side)) side = moved->second;
      split(side);
      changed_[part] = changed_[tree.parent[part]] = 1;
      odd[tree.parent[part]] ^= 1;
    }
    std::sort(gone_.begin(), gone_.end());
    for (auto* edges : {&creases_, &interface_}) {
      std::erase_if(*edges, [&](const Edge& e) { return is_among(gone_, e.first, e.second); });
      auto& more = edges == &creases_ ? more_creases_ : more_interface_;
      edges->insert(edges->end(), more.begin(), more.end());
      std::sort(edges->begin(), edges->end());
    }
    return changed_;
  }

 private:
  double length(Index side) const {
    const Face& face = mesh_.faces[side / 4];
    return (mesh_.points[face[next_corner(face, side % 4)]] - mesh_.points[face[side % 4]]).norm();
  }
  Edge edge_of(Index side) const {
    const Face& face = mesh_.faces[side / 4];
    return std::minmax(face[side % 4], face[next_corner(face, side % 4)]);
  }
  bool is_crease(Index side) const {
    const Edge edge = edge_of(side);
    return is_among(creases_, edge.first, edge.second);
  }

  Tree span() const {
    std::vector<std::map<Index, Index>> neighbours(division_.parts.size());  // part -> the best edge to it
    for (Index side = 0; side < opposite_.size(); ++side) {
      if (opposite_[side] == kNone || !division_.is_cut[side]) continue;
      const Index here = part_[side / 4], there = part_[opposite_[side] / 4];
      if (here == there) continue;
      const auto [at, is_new] = neighbours[here].emplace(there, side);
      if (is_new) continue;
      const auto worth = [&](Index s) { return std::pair(!is_crease(s), length(s)); };
      if (worth(side) > worth(at->second)) at->second = side;
    }
    Tree tree{{}, std::vector<Index>(division_.parts.size(), kNone), std::vector<Index>(division_.parts.size(), kNone)};
    std::vector<char> seen(division_.parts.size(), 0);
    const auto largest = std::max_element(division_.parts.begin(), division_.parts.end(),
                                          [](const auto& a, const auto& b) { return a.size() < b.size(); });
    tree.order.push_back(Index(largest - division_.parts.begin()));
    seen[tree.order[0]] = 1;
    for (std::size_t i = 0; i < tree.order.size(); ++i)
      for (const auto& [part, side] : neighbours[tree.order[i]]) {
        if (seen[part]) continue;
        seen[part] = 1;
        tree.parent[part] = tree.order[i], tree.longest[part] = side;
        tree.order.push_back(part);
      }
    return tree;
  }

  /// The faces on both sides of an edge get a node in its middle.
  void split(Index side) {
    const Edge edge = edge_of(side);
    const bool crease = is_crease(side);
    const Index other = opposite_[side];
    const space::Foot foot =
        background_.walk(0.5 * (mesh_.points[edge.first] + mesh_.points[edge.second]), mesh_.near[side / 4]);
    const Index middle = mesh_.add_point(foot.point, foot.triangle);
    const Index rest = split_face(side, middle), other_rest = split_face(other, middle);
    // The half that starts where the side did stays; the new face has the other one.
    link(side, other_rest);
    link(other, rest);
    auto& more = crease ? more_creases_ : more_interface_;
    more.emplace_back(edge.first, middle);
    more.emplace_back(edge.second, middle);
    gone_.push_back(edge);
  }

  void link(Index side, Index other) {
    opposite_[side] = other, opposite_[other] = side;
    division_.is_cut[side] = division_.is_cut[other] = true;
  }

  /// Face abc(d) with side ab becomes a m c (d), and m b c is new. Returns the new face's side mb.
  Index split_face(Index side, Index middle) {
    const Index f = side / 4, fresh = Index(mesh_.faces.size());
    const Face old = mesh_.faces[f];
    const Index i = side % 4, j = next_corner(old, i), k = next_corner(old, j);
    mesh_.faces.push_back({middle, old[j], old[k], kNone});
    mesh_.near.push_back(mesh_.near[f]);
    for (int s = 0; s < 4; ++s) {
      mesh_.open.push_back(false);
      opposite_.push_back(kNone);
      division_.is_cut.push_back(false);
    }
    mesh_.faces[f][j] = middle;
    // Side bc goes to the new face; the diagonal takes its place.
    const Index was = 4 * f + j, now = 4 * fresh + 1, diagonal = 4 * fresh + 2;
    opposite_[now] = opposite_[was];
    if (opposite_[was] != kNone) opposite_[opposite_[was]] = now;
    division_.is_cut[now] = division_.is_cut[was];
    mesh_.open[now] = mesh_.open[was];
    moved_[was] = now;
    opposite_[was] = diagonal, opposite_[diagonal] = was;
    division_.is_cut[was] = false;
    mesh_.open[was] = false;
    part_.push_back(part_[f]);
    division_.parts[part_[f]].push_back(fresh);
    return 4 * fresh;
  }

  SurfaceMesh& mesh_;
  std::vector<Index>& opposite_;
  Division& division_;
  std::vector<Edge>& creases_;
  std::vector<Edge>& interface_;
  const space::Background& background_;
  std::vector<Index> part_;
  std::vector<char> changed_;
  std::vector<Edge> gone_, more_creases_, more_interface_;
  std::map<Index, Index> moved_;  ///< sides that were renumbered
};

}  // namespace

std::vector<char> make_parts_even(SurfaceMesh& mesh, std::vector<Index>& opposite, Division& division,
                                  std::vector<Edge>& creases, std::vector<Edge>& interface,
                                  const space::Background& background) {
  return Evening(mesh, opposite, division, creases, interface, background).run();
}

}  // namespace qmorph::chart
