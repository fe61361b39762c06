// SPDX-License-Identifier: GPL-2.0-or-later
#include "chart/widen_tips.hpp"

#include <algorithm>
#include <tuple>

namespace qmorph::chart {
namespace {

class Widening {
 public:
  Widening(SurfaceMesh& mesh, const std::vector<Edge>& creases, const space::Background& surface)
      : mesh_(mesh), surface_(surface), opposite_(opposite_sides(mesh)), stays_(mesh.fixed) {
    valence_.assign(mesh.points.size(), 0);
    for (Index side = 0; side < opposite_.size(); ++side) {
      if (side % 4 >= degree(mesh.faces[side / 4])) continue;
      ++valence_[node(side)];
      if (opposite_[side] == kNone) stays_[node(side)] = stays_[node(next(side))] = 1;
    }
    for (const auto& [a, b] : creases) stays_[a] = stays_[b] = 1;
  }

  std::size_t run() {
    std::size_t count = 0;
    is_changed_.assign(mesh_.faces.size(), false);
    const std::size_t sides = opposite_.size();
    for (Index side = 0; side < sides; ++side)
      if (is_between_two(side)) count += open(side);
    return count;
  }

 private:
  Index node(Index side) const { return mesh_.faces[side / 4][side % 4]; }
  Index next(Index side) const { return side - side % 4 + next_corner(mesh_.faces[side / 4], side % 4); }
  Index previous(Index side) const { return side % 4 ? side - 1 : side + degree(mesh_.faces[side / 4]) - 1; }

  /// The side starts at a node that stays, around which there are two quads, this and the one behind the side. They
  /// meet at another edge, too, be it on a line.
  bool is_between_two(Index side) const {
    if (side % 4 >= degree(mesh_.faces[side / 4])) return false;
    const Index other = opposite_[side];
    if (other == kNone || degree(mesh_.faces[side / 4]) != 4 || degree(mesh_.faces[other / 4]) != 4) return false;
    const Index before = previous(side), after = next(other);
    return stays_[node(side)] && !stays_[node(other)] &&
           opposite_[before] == (opposite_[after] == kNone ? kNone : after) &&
           mesh_.node[node(before)] == mesh_.node[node(next(after))];
  }

  /// Sides that start at the end of this one, a node inside, counted from the face that it is of; the last is the one
  /// back.
  std::vector<Index> spokes_at_end(Index side) const {
    std::vector<Index> spokes;
    for (Index spoke = next(side); spoke != opposite_[side]; spoke = next(opposite_[spoke])) spokes.push_back(spoke);
    spokes.push_back(opposite_[side]);
    return spokes;
  }

  bool open(Index side) {
    const std::vector<Index> spokes = spokes_at_end(side);
    if (std::any_of(spokes.begin(), spokes.end(), [&](Index s) { return is_changed_[s / 4]; })) return false;
    if (spokes.size() < 4) return false;  // one half of the node would have two edges
    // Half of the elements to each side; else where fewer edges end.
    const auto cost = [&](std::size_t k) {
      const std::size_t here = k + 2, there = spokes.size() - k;
      return std::tuple(here > there ? here - there : there - here, valence_[node(next(spokes[k]))], k);
    };
    std::size_t best = 1;
    for (std::size_t k = 2; k + 2 < spokes.size(); ++k)
      if (cost(k) < cost(best)) best = k;
    const Index tip = node(side), middle = node(spokes[0]), far = node(next(spokes[best]));
    const Index second = mesh_.add_point(mesh_.points[middle], mesh_.on[middle]);
    stays_.push_back(0);
    valence_.push_back(Index(spokes.size() - best) + 1);
    std::vector<Index> first_ends, second_ends;
    for (std::size_t k = 0; k + 1 < spokes.size(); ++k)
      if (k != best) (k < best ? first_ends : second_ends).push_back(node(next(spokes[k])));
    move_towards(second, second_ends);
    move_towards(middle, first_ends);
    for (std::size_t k = best + 1; k < spokes.size(); ++k) mesh_.faces[spokes[k] / 4][spokes[k] % 4] = second;
    for (const Index spoke : spokes) is_changed_[spoke / 4] = true;
    mesh_.faces.push_back({middle, tip, second, far});
    mesh_.open.insert(mesh_.open.end(), 4, false);
    mesh_.near.push_back(mesh_.near[side / 4]);
    return true;
  }

  /// A third of the way to the mean of these nodes.
  void move_towards(Index v, const std::vector<Index>& ends) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Index w : ends) mean += mesh_.points[w] / double(ends.size());
    const auto foot = surface_.walk(mesh_.points[v] + (mean - mesh_.points[v]) / 3, mesh_.on[v]);
    mesh_.points[v] = foot.point, mesh_.on[v] = foot.triangle;
  }

  SurfaceMesh& mesh_;
  const space::Background& surface_;
  const std::vector<Index> opposite_;  ///< by side
  std::vector<char> stays_;            ///< by point: it is fixed, or on the boundary or a crease
  std::vector<Index> valence_;         ///< by point: faces
  std::vector<bool> is_changed_;       ///< by face
};

/// Whether two elements meet at a node that stays, all around it or up to the two sides of one line. Cheap: most
/// surfaces have no such node.
bool may_have_narrow_tips(const SurfaceMesh& mesh, const std::vector<Edge>& creases) {
  std::vector<Index> valence(mesh.points.size(), 0), after(mesh.points.size(), kNone), before(after);
  std::vector<char> stays = mesh.fixed;
  for (const auto& [a, b] : creases) stays[a] = stays[b] = 1;
  for (Index f = 0; f < mesh.faces.size(); ++f)
    for (Index i = 0; i < degree(mesh.faces[f]); ++i) {
      const Index a = mesh.faces[f][i], b = mesh.faces[f][next_corner(mesh.faces[f], i)];
      ++valence[a];
      if (mesh.open[4 * f + i]) after[a] = mesh.node[b], before[b] = mesh.node[a];
    }
  for (Index v = 0; v < valence.size(); ++v)
    if (valence[v] == 2 && after[v] == before[v] && (stays[v] || after[v] != kNone)) return true;
  return false;
}

}  // namespace

std::optional<SurfaceMesh> with_wider_tips(const SurfaceMesh& mesh, const std::vector<Edge>& creases,
                                           const space::Background& surface) {
  if (!may_have_narrow_tips(mesh, creases)) return {};
  SurfaceMesh widened = mesh;
  if (Widening(widened, creases, surface).run() == 0) return {};
  return widened;
}

}  // namespace qmorph::chart
