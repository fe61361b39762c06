// SPDX-License-Identifier: GPL-2.0-or-later
#include "bands/relay_rows.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "bands/find_band.hpp"
#include "bands/lay_rows.hpp"
#include "cleanup/cavity.hpp"
#include "cleanup/poor_shapes.hpp"
#include "kernel/mark_set.hpp"
#include "smoothing/smooth.hpp"
#include "topology/edits.hpp"

namespace qmorph::bands {
namespace {

/// Up to which sine a quad leans; and what a change has to bring, in quads of sine 0.
constexpr double kLeaning = 0.45, kLeastGain = 0.1;
constexpr int kSweeps = 10, kRingsRelaxed = 1;

/// A row of quads across, with those at its ends.
struct Row {
  std::vector<Index> faces;
  Band band;  ///< of nodes of the mesh
};

/// The quad of `low`, one of its sides, lies between two pieces of the boundary, and `low` is on one of them.
bool is_across(const kernel::Mesh& mesh, Index low) {
  const Index f = mesh.face(low);
  if (f == kNone || !mesh.is_quad(f)) return false;
  const Index right = mesh.next(low), high = mesh.next(right), left = mesh.prev(low);
  return mesh.is_boundary_edge(low) && mesh.is_boundary_edge(high) && !mesh.is_boundary_edge(left) &&
         !mesh.is_boundary_edge(right);
}

/// The lower sides of the row that `low` belongs to, from left to right; of one that goes round, from `low` on.
std::vector<Index> row_of(const kernel::Mesh& mesh, Index low) {
  const auto ahead = [&](Index h) -> Index { return mesh.next(kernel::Mesh::twin(mesh.next(h))); };
  const auto behind = [&](Index h) -> Index { return mesh.prev(kernel::Mesh::twin(mesh.prev(h))); };
  Index first = low;
  while (is_across(mesh, behind(first)) && behind(first) != low) first = behind(first);
  std::vector<Index> sides{first};
  while (is_across(mesh, ahead(sides.back())) && ahead(sides.back()) != first) sides.push_back(ahead(sides.back()));
  return sides;
}

/// What a row may begin with, beyond its first rung: a face of which a side goes on along the lower piece of the
/// boundary, or along the upper one, or both.
struct End {
  Index face = kNone;
  std::vector<Index> nodes;  ///< from the lower side to the upper one
  bool is_longer_below = false, is_longer_above = false;
};

/// `rung`: on the other side of the last one, so that it runs away from the piece `before` it and towards the one
/// after. Where both sides of the face are the boundary's, either corner may be one in the middle of the end.
std::vector<End> ends_of(const kernel::Mesh& mesh, Index rung, bool is_right) {
  const Index face = mesh.face(rung), after = mesh.next(rung), before = mesh.prev(rung);
  const Index from = mesh.origin(rung), to = mesh.target(rung);
  std::vector<End> ends;
  if (mesh.is_quad(face)) {
    const Index beyond_to = mesh.target(after), beyond_from = mesh.origin(before);
    const bool may_go_back = mesh.is_boundary_edge(before), may_go_on = mesh.is_boundary_edge(after);
    if (may_go_back) ends.push_back({face, {beyond_from, beyond_to, to}, true, false});
    if (may_go_on) ends.push_back({face, {from, beyond_from, beyond_to}, false, true});
    if (may_go_back && may_go_on) ends.push_back({face, {beyond_from, beyond_to}, true, true});
  }
  if (ends.empty()) ends.push_back({kNone, {from, to}});
  if (is_right)
    for (End& end : ends) {
      std::reverse(end.nodes.begin(), end.nodes.end());
      std::swap(end.is_longer_below, end.is_longer_above);
    }
  return ends;
}

/// The row with the lower sides `sides` and its ends.
Row whole_row(const kernel::Mesh& mesh, const std::vector<Index>& sides, const End& left, const End& right) {
  Row row;
  Band& band = row.band;
  if (left.is_longer_below) band.lower.push_back(left.nodes.front());
  if (left.is_longer_above) band.upper.push_back(left.nodes.back());
  for (Index low : sides) {
    row.faces.push_back(mesh.face(low));
    band.lower.push_back(mesh.origin(low));
    band.upper.push_back(mesh.origin(mesh.prev(low)));
  }
  const Index last = mesh.next(sides.back());
  band.lower.push_back(mesh.origin(last));
  band.upper.push_back(mesh.target(last));
  if (right.is_longer_below) band.lower.push_back(right.nodes.front());
  if (right.is_longer_above) band.upper.push_back(right.nodes.back());
  for (const End* end : {&left, &right})
    if (end->face != kNone) row.faces.push_back(end->face);
  band.start = left.nodes, band.end = right.nodes;
  return row;
}

/// Draws the faces of `rows` into a face of `mesh`, each next to those before it. `node`: the mesh's node for each of
/// the first ones of `rows`; the others are new, and appended to it. False, perhaps half-way, if an edge that it needs
/// is there already outside.
bool draw(kernel::Mesh& mesh, const kernel::Mesh& rows, std::vector<Index>& node) {
  std::set<std::pair<Index, Index>> drawn;
  const auto edge = [](Index a, Index b) { return std::pair(std::min(a, b), std::max(a, b)); };
  for (Index h = 0; h < rows.half_edge_slots(); ++h)
    if (rows.is_boundary_edge(h)) drawn.insert(edge(rows.origin(h), rows.target(h)));
  node.resize(rows.vertex_slots(), kNone);
  for (Index f = 0; f < rows.face_slots(); ++f) {
    std::vector<Index> corners = topology::nodes_of(rows, f);
    const std::size_t n = corners.size();
    const auto is_drawn = [&](std::size_t i) { return drawn.contains(edge(corners[i], corners[(i + 1) % n])); };
    // From the first edge that is missing to the last.
    std::size_t first = 0;
    while (first < n && (is_drawn(first) || !is_drawn((first + n - 1) % n))) ++first;
    if (first == n) continue;
    std::rotate(corners.begin(), corners.begin() + std::ptrdiff_t(first), corners.end());
    std::size_t count = 1;
    while (!is_drawn(count)) ++count;
    std::vector<Vec2> points;
    std::vector<Index> fresh;
    for (std::size_t i = 1; i < count; ++i) points.push_back(rows.point(corners[i]));
    if (topology::draw_path(mesh, node[corners[0]], node[corners[count]], points, fresh) == kNone) return false;
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) node[corners[i]] = fresh[i - 1];
      drawn.insert(edge(corners[i], corners[i + 1]));
    }
  }
  return true;
}

/// Each face of `rows` is one of `mesh`.
bool has_faces(const kernel::Mesh& mesh, const kernel::Mesh& rows, const std::vector<Index>& node) {
  for (Index f = 0; f < rows.face_slots(); ++f) {
    const std::vector<Index> corners = topology::nodes_of(rows, f);
    const Index h = mesh.find(node[corners[0]], node[corners[1]]);
    if (h == kNone || mesh.face(h) == kNone || mesh.degree(mesh.face(h)) != corners.size()) return false;
    std::size_t i = 0;
    for (Index side : mesh.loop_from(h))
      if (mesh.origin(side) != node[corners[i++]]) return false;
  }
  return true;
}

class Relaying {
 public:
  Relaying(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget)
      : mesh_(mesh), cavity_(mesh), relaxing_(smoothing), budget_(budget) {
    relaxing_.iterations = std::max(relaxing_.iterations, 12);
    relaxing_.untangling_sweeps = 12;
  }

  std::size_t run() {
    std::size_t laid = 0;
    for (Index h = 0; h < mesh_.half_edge_slots() && !budget_.is_spent(); ++h) {
      if (!mesh_.is_live_half_edge(h) || !is_across(mesh_, h) || seen_.contains(mesh_.face(h))) continue;
      const std::vector<Index> sides = row_of(mesh_, h);
      bool leans = false;
      for (Index low : sides) {
        seen_.insert(mesh_.face(low));
        leans = leans || !mesh_.is_above(mesh_.face(low), kLeaning);
      }
      mesh_.add_work(sides.size());
      if (leans) laid += relay(sides);
    }
    return laid;
  }

 private:
  /// Rows that may take the place of some faces.
  struct Offer {
    std::vector<Index> faces;
    std::vector<Index> nodes;  ///< of the mesh: the first ones of `rows`, which are on their boundary
    kernel::Mesh rows;
    double lack = 0;  ///< of their quads, before they are smoothed
  };

  bool relay(const std::vector<Index>& sides) {
    std::vector<Offer> offers;
    add_rows(sides, offers);
    std::stable_sort(offers.begin(), offers.end(), [](const Offer& a, const Offer& b) { return a.lack < b.lack; });
    return std::any_of(offers.begin(), offers.end(), [&](const Offer& offer) { return take(offer); });
  }

  /// A single row with what may be its ends.
  void add_rows(const std::vector<Index>& sides, std::vector<Offer>& offers) {
    for (const End& left : ends_of(mesh_, kernel::Mesh::twin(mesh_.prev(sides.front())), false))
      for (const End& right : ends_of(mesh_, kernel::Mesh::twin(mesh_.next(sides.back())), true))
        if (left.face == kNone || left.face != right.face) add_offers(whole_row(mesh_, sides, left, right), offers);
  }

  void add_offers(const Row& row, std::vector<Offer>& offers) {
    Band band = row.band;
    const std::vector<Index> nodes = renumber(band);
    std::vector<Vec2> points;
    for (Index v : nodes) points.push_back(mesh_.point(v));
    put_longer_below(band);
    for (const RowCosts& costs : {kBetterTurns, kFewerTurns})
      if (auto rows = lay_rows(band, points, costs)) {
        double lack = 0;
        for (Index f = 0; f < rows->face_slots(); ++f) lack += cleanup::lack_of(rows->smallest_sine(f));
        mesh_.add_work(rows->work());
        offers.push_back({row.faces, nodes, std::move(*rows), lack});
      }
  }

  cleanup::PoorShapes shapes_around(const std::vector<Index>& nodes) const {
    const std::vector<Index> faces = topology::faces_around(mesh_, nodes);
    mesh_.add_work(faces.size());
    return {mesh_, faces};
  }

  bool take(const Offer& offer) {
    if (!cavity_.start_with(offer.faces) || cavity_.outline().size() != offer.nodes.size()) return false;
    const cleanup::PoorShapes before = shapes_around(offer.nodes);
    mesh_.begin();
    mesh_.make_face(cavity_.outline(), cavity_.faces());
    std::vector<Index> nodes = offer.nodes;
    bool kept = draw(mesh_, offer.rows, nodes) && has_faces(mesh_, offer.rows, nodes);
    if (kept) {
      topology::spread(mesh_, std::span(nodes).subspan(offer.nodes.size()), kSweeps);
      kept = smoothing::smooth_near(mesh_, relaxing_, nodes, kRingsRelaxed);
    }
    kept = kept && shapes_around(nodes).is_worth(before, kLeastGain);
    kept ? mesh_.commit() : mesh_.rollback();
    return kept;
  }

  kernel::Mesh& mesh_;
  cleanup::Cavity cavity_;
  kernel::MarkSet seen_;  ///< faces of rows
  SmoothingOptions relaxing_;
  const kernel::Budget& budget_;
};

}  // namespace

std::size_t relay_leaning_rows(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget) {
  return Relaying(mesh, smoothing, budget).run();
}

}  // namespace qmorph::bands
