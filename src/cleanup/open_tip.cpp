// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/open_tip.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include "cleanup/attempt.hpp"
#include "cleanup/score.hpp"
#include "kernel/sort_unique.hpp"
#include "topology/edits.hpp"

namespace qmorph::cleanup {
namespace {

using kernel::Mesh;

/// The row's nodes: b[i] and a[i + 1] are the ends of rung i.
struct Sides {
  std::vector<Index> a, b;
};

Sides sides_of(const Mesh& mesh, const TipRow& row) {
  Sides sides;
  sides.a.push_back(kNone);
  for (Index h : row.rungs) {
    sides.b.push_back(row.tip_first ? mesh.origin(h) : mesh.target(h));
    sides.a.push_back(row.tip_first ? mesh.target(h) : mesh.origin(h));
  }
  return sides;
}

/// Of the new nodes i = 1, ..., `quads`: in the middle, the first one away from the tip, the last one towards it, so
/// that the quads there are convex.
Vec2 place(const Mesh& mesh, const Sides& sides, std::size_t i, std::size_t quads) {
  constexpr double kAhead = 0.25;  // of the row's next quad
  const auto middle = [&](std::size_t k) -> Vec2 {
    return k == 0 ? mesh.point(sides.b[0]) : Vec2(0.5 * (mesh.point(sides.a[k]) + mesh.point(sides.b[k])));
  };
  const double ahead = kAhead * (1 - 2 * double(i - 1) / double(quads - 1));
  const Vec2 here = middle(i);
  return ahead > 0 ? Vec2(here + ahead * (middle(i + 1) - here)) : Vec2(here + ahead * (here - middle(i - 1)));
}

/// Smallest sine of the quad that closes the row.
double closing_sine(const Mesh& mesh, const TipRow& row, const Sides& sides, std::size_t quads) {
  std::array<Vec2, 4> p{mesh.point(sides.a[quads]), mesh.point(sides.a[quads + 1]), mesh.point(sides.b[quads]),
                        place(mesh, sides, quads, quads)};
  if (!row.tip_first) std::reverse(p.begin(), p.end());
  return smallest_corner_sine(p[0], p[1], p[2], p[3]);
}

/// A corner of the boundary up to this angle is a tip; what is nearer to straight than to right is strained.
constexpr double kTip = 45 * std::numbers::pi / 180, kStrained = 135 * std::numbers::pi / 180;

/// A tip is opened for this, which two irregular nodes are worth.
bool is_clearly_better(const Worth& before, const Worth& after) {
  constexpr double kFactor = 1.2;
  return after.worst > kFactor * before.worst;
}

class TipOpener {
 public:
  TipOpener(Mesh& mesh, const SmoothingOptions& smoothing) : mesh_(mesh), score_(mesh), relaxing_(smoothing) {}

  std::size_t run() {
    constexpr double kPoor = 0.3;
    std::size_t opened = 0;
    for (Index f = 0; f < mesh_.face_slots(); ++f)
      if (mesh_.is_live_face(f) && mesh_.is_quad(f) && !mesh_.is_above(f, kPoor)) opened += improve(f);
    return opened;
  }

 private:
  bool improve(Index f) {
    for (Index v : topology::nodes_of(mesh_, f)) {
      if (!mesh_.is_boundary(v) || mesh_.valence(v) != 2 || score_.inside_angle(v) < kStrained) continue;
      for (bool tip_first : {true, false})
        if (try_row(find_tip_row(mesh_, f, v, tip_first, kMostQuads))) return true;
    }
    return false;
  }

  bool try_row(const TipRow& row) {
    if (row.rungs.empty()) return false;
    const Index tip = row.tip_first ? mesh_.origin(row.rungs[0]) : mesh_.target(row.rungs[0]);
    if (score_.inside_angle(tip) > kTip) return false;
    const std::size_t quads = quads_to_open(mesh_, row);
    std::vector<Index> near, nodes;
    for (std::size_t i = 0; i <= quads; ++i)
      near.insert(near.end(), {mesh_.origin(row.rungs[i]), mesh_.target(row.rungs[i])});
    const auto edit = [&](std::vector<Index>& around) { return open_tip(mesh_, row, quads, around); };
    return attempt(mesh_, relaxing_, kRings, near, nodes, edit, is_clearly_better);
  }

  static constexpr std::size_t kMostQuads = 8;  ///< of a row that a tip may be opened along
  static constexpr int kRings = 2;

  Mesh& mesh_;
  Score score_;
  SmoothingOptions relaxing_;
};

}  // namespace

TipRow find_tip_row(const Mesh& mesh, Index face, Index straight, bool tip_first, std::size_t most) {
  TipRow row;
  row.tip_first = tip_first;
  Index h = mesh.half_edge(face);
  while ((tip_first ? mesh.target(h) : mesh.origin(h)) != straight) h = mesh.next(h);
  if (!mesh.is_boundary_edge(h)) return row;
  row.rungs.push_back(h);
  std::vector<Index> faces;
  while (faces.size() < most) {
    const Index f = mesh.face(h);
    if (!mesh.is_quad(f) || std::find(faces.begin(), faces.end(), f) != faces.end()) break;
    faces.push_back(f);
    h = Mesh::twin(mesh.next(mesh.next(h)));
    row.rungs.push_back(h);
  }
  if (faces.size() < 2) row.rungs.clear();
  return row;
}

std::size_t quads_to_open(const Mesh& mesh, const TipRow& row) {
  constexpr double kGood = 0.4;
  const Sides sides = sides_of(mesh, row);
  std::size_t best = 2;
  double best_sine = -1;
  for (std::size_t quads = 2; quads < row.rungs.size(); ++quads) {
    // The last new node lies across the far end of the row's last but one quad.
    const double sine = closing_sine(mesh, row, sides, quads);
    if (sine > best_sine) best = quads, best_sine = sine;
    if (sine > kGood) break;
  }
  return best;
}

bool open_tip(Mesh& mesh, const TipRow& row, std::size_t quads, std::vector<Index>& nodes) {
  const Sides sides = sides_of(mesh, row);
  std::vector<Index> around(sides.a.begin() + 1, sides.a.begin() + std::ptrdiff_t(quads) + 2);
  around.insert(around.end(), sides.b.begin(), sides.b.begin() + std::ptrdiff_t(quads) + 1);
  nodes.insert(nodes.end(), around.begin(), around.end());
  sort_unique(around);
  if (around.size() != 2 * quads + 2) return false;  // the row meets itself
  std::vector<Vec2> places;
  for (std::size_t i = 1; i <= quads; ++i) places.push_back(place(mesh, sides, i, quads));
  for (std::size_t i = 1; i < quads; ++i) mesh.join_faces(row.rungs[i]);
  std::vector<Index> added;
  if (topology::draw_path(mesh, sides.a[1], sides.b[1], {places[0]}, added) == kNone) return false;
  for (std::size_t i = 1; i < quads; ++i) {
    if (topology::draw_path(mesh, sides.a[i + 1], added[i - 1], {places[i]}, added) == kNone) return false;
    if (topology::draw_path(mesh, added[i], sides.b[i + 1], {}, added) == kNone) return false;
  }
  nodes.insert(nodes.end(), added.begin(), added.end());
  return true;
}

std::size_t open_tips(Mesh& mesh, const SmoothingOptions& smoothing) { return TipOpener(mesh, smoothing).run(); }

}  // namespace qmorph::cleanup
