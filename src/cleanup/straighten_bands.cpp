// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/straighten_bands.hpp"

#include <algorithm>
#include <cmath>

#include "cleanup/band_plan.hpp"
#include "cleanup/attempt.hpp"

namespace qmorph::cleanup {
namespace {

using kernel::Mesh;

/// Longer bands are treated in pieces.
constexpr std::size_t kMostEdges = 300;
/// A band whose elements are better than this on average is good.
constexpr double kGoodMean = 0.85;

/// Part of a band from one rung to another: its rails, both in the direction from the first rung to the last, and its
/// faces.
struct Band {
  std::vector<Index> lower,
      upper;  ///< half-edges of the rails, the band on their left; `upper` runs backwards, last one first
  std::vector<Index> faces;
  Index first = kNone,
        last = kNone;  ///< rungs, as half-edges upwards: the band lies right of the first, left of the last
};

class BandFinder {
 public:
  explicit BandFinder(const Mesh& mesh) : mesh_(mesh) {}

  /// An edge from boundary to boundary, through the inside.
  bool is_rung(Index h) const {
    return mesh_.is_live_half_edge(h) && !mesh_.is_boundary_edge(h) && mesh_.is_boundary(mesh_.origin(h)) &&
           mesh_.is_boundary(mesh_.target(h));
  }

  /// The band ahead of (right of) this rung that no call before has returned.
  Band ahead_of(Index rung) {
    Band band;
    band.first = band.last = rung;
    while (band.lower.size() + band.upper.size() < kMostEdges && add_piece(band)) {
    }
    return band;
  }

  /// As far back as pieces go: where a band begins.
  Index beginning(Index rung) const {
    Index h = Mesh::twin(rung);
    for (std::size_t steps = mesh_.face_slots(); steps > 0; --steps) {
      Piece piece;
      if (!trace(h, piece) || piece.exit == Mesh::twin(rung)) break;
      h = piece.exit;
    }
    return Mesh::twin(h);
  }

 private:
  /// What lies between a rung and the next one.
  struct Piece {
    std::vector<Index> faces, lower, upper;
    Index exit = kNone;
  };

  bool is_seen(Index f) const { return f < seen_.size() && seen_[f]; }

  bool trace(Index rung, Piece& piece) const {
    constexpr std::size_t kMostFaces = 24;
    piece.faces = {mesh_.face(Mesh::twin(rung))};
    for (std::size_t i = 0; i < piece.faces.size(); ++i) {
      if (is_seen(piece.faces[i]) || !mesh_.is_quad(piece.faces[i])) return false;
      for (Index h : mesh_.sides_of(piece.faces[i])) {
        const Index beyond = mesh_.face(Mesh::twin(h));
        if (beyond != kNone && !is_rung(h) &&
            std::find(piece.faces.begin(), piece.faces.end(), beyond) == piece.faces.end()) {
          if (piece.faces.size() == kMostFaces) return false;
          piece.faces.push_back(beyond);
        }
      }
    }
    // Along the outline: lower rail, exit, upper rail back to the rung.
    Index h = after(Mesh::twin(rung), piece.faces);
    for (; mesh_.is_boundary_edge(h); h = after(h, piece.faces)) piece.lower.push_back(h);
    if (h == Mesh::twin(rung)) return false;
    piece.exit = h;
    for (h = after(h, piece.faces); mesh_.is_boundary_edge(h); h = after(h, piece.faces)) piece.upper.push_back(h);
    return h == Mesh::twin(rung) && has_free_nodes_only(piece);
  }

  Index after(Index h, const std::vector<Index>& faces) const {
    h = mesh_.next(h);
    while (!mesh_.is_boundary_edge(h) && !is_rung(h) &&
           std::find(faces.begin(), faces.end(), mesh_.face(Mesh::twin(h))) != faces.end())
      h = mesh_.rotate_cw(h);
    return h;
  }

  bool has_free_nodes_only(const Piece& piece) const {
    for (Index f : piece.faces)
      for (Index v : topology::nodes_of(mesh_, f))
        if (!mesh_.is_boundary(v) && !mesh_.is_free(v)) return false;
    return true;
  }

  /// Whether the piece, or the next one, ends at the first rung. A ring is left open there: its ends would share nodes
  /// or an element, and a path from one to the other could take the wrong way.
  bool closes(const Band& band, const Piece& piece) const {
    Piece beyond;
    return piece.exit == band.first || (trace(piece.exit, beyond) && beyond.exit == band.first);
  }

  bool add_piece(Band& band) {
    Piece piece;
    if (!trace(band.last, piece)) return false;
    if (closes(band, piece)) return false;
    if (seen_.size() < mesh_.face_slots()) seen_.resize(mesh_.face_slots(), 0);
    for (Index f : piece.faces) seen_[f] = 1;
    band.faces.insert(band.faces.end(), piece.faces.begin(), piece.faces.end());
    band.lower.insert(band.lower.end(), piece.lower.begin(), piece.lower.end());
    band.upper.insert(band.upper.end(), piece.upper.rbegin(), piece.upper.rend());
    band.last = piece.exit;
    return true;
  }

  const Mesh& mesh_;
  std::vector<char> seen_;  ///< by face
};

class Straightening {
 public:
  Straightening(Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget)
      : mesh_(mesh), relaxing_(smoothing), budget_(budget), finder_(mesh) {}

  std::size_t run() {
    const Index count = mesh_.half_edge_slots();  // not those that this makes
    for (Index h = 0; h < count && !budget_.is_spent(); h += 2)
      if (finder_.is_rung(h)) straighten(finder_.ahead_of(finder_.beginning(h)));
    return changes_;
  }

 private:
  void straighten(const Band& band) {
    constexpr std::size_t kLeastEdges = 3;
    if (band.lower.size() < kLeastEdges || band.upper.size() < kLeastEdges) return;
    if (band.first == Mesh::twin(band.last)) return;
    std::vector<Index> lower{mesh_.origin(band.first)}, upper{mesh_.target(band.first)};
    for (Index h : band.lower) lower.push_back(mesh_.target(h));
    for (Index h : band.upper) upper.push_back(mesh_.origin(h));
    const Worth worth = worth_of_faces(band.faces);
    if (worth.mean > kGoodMean) return;
    constexpr int kSpareLag = 4;
    const BandPlan plan =
        plan_band(points(lower), points(upper), kSpareLag + std::abs(int(lower.size()) - int(upper.size())));
    if (plan.places.empty()) return;
    std::vector<Index> near = lower;
    near.insert(near.end(), upper.begin(), upper.end());
    const auto edit = [&](std::vector<Index>& nodes) {
      nodes = near;
      mesh_.make_face(ring(band), band.faces);
      return draw(plan, lower, upper, nodes);
    };
    const auto better = [](const Worth& before, const Worth& after) {
      constexpr double kFloor = 0.3, kGain = 0.02;
      return after.mean > before.mean + kGain && after.worst >= std::min(before.worst, kFloor);
    };
    changes_ += attempt(mesh_, relaxing_, 0, near, nodes_, edit, better);
  }

  Worth worth_of_faces(const std::vector<Index>& faces) const {
    Worth worth;
    worth.mean = 0;
    for (Index f : faces) {
      const double sine = mesh_.smallest_sine(f);
      worth.worst = std::min(worth.worst, sine);
      worth.mean += sine / double(faces.size());
    }
    return worth;
  }

  std::vector<Vec2> points(const std::vector<Index>& nodes) const {
    std::vector<Vec2> points;
    for (Index v : nodes) points.push_back(mesh_.point(v));
    return points;
  }

  static std::vector<Index> ring(const Band& band) {
    std::vector<Index> ring = band.lower;
    ring.push_back(band.last);
    ring.insert(ring.end(), band.upper.rbegin(), band.upper.rend());
    ring.push_back(Mesh::twin(band.first));
    return ring;
  }

  bool draw_edge(Index a, Index b, std::vector<Index>& nodes) {
    return topology::draw_path(mesh_, a, b, {}, nodes) != kNone;
  }

  bool draw(const BandPlan& plan, const std::vector<Index>& lower, const std::vector<Index>& upper,
            std::vector<Index>& nodes) {
    const auto& places = plan.places;
    for (std::size_t at = 1; at < places.size(); ++at) {
      std::size_t rung = at;
      while (places[rung].two_rows) ++rung;
      if (rung + 1 < places.size() && !draw_edge(lower[places[rung].lower], upper[places[rung].upper], nodes))
        return false;
      if (rung > at && !draw_rows({places.begin() + at - 1, places.begin() + rung + 1}, lower, upper, nodes))
        return false;
      at = rung;
    }
    return true;
  }

  /// Two rows between a rung and another: `places` has the rungs, too.
  bool draw_rows(const std::vector<BandPlace>& places, const std::vector<Index>& lower, const std::vector<Index>& upper,
                 std::vector<Index>& nodes) {
    const BandPlace &before = places.front(), &first = places[1], &last = places[places.size() - 2],
                    &after = places.back();
    const bool starts_above = first.upper == before.upper, ends_above = last.upper == after.upper;
    std::vector<Vec2> middle;
    for (std::size_t k = 1; k + 1 < places.size(); ++k)
      middle.push_back(0.5 * (mesh_.point(lower[places[k].lower]) + mesh_.point(upper[places[k].upper])));
    const std::size_t old = nodes.size();
    if (topology::draw_path(mesh_, starts_above ? upper[first.upper] : lower[first.lower],
                            ends_above ? upper[last.upper] : lower[last.lower], middle, nodes) == kNone)
      return false;
    const std::vector<Index> row(nodes.begin() + old, nodes.end());
    for (std::size_t k = 1; k + 1 < places.size(); ++k) {
      const bool is_first = k == 1, is_last = k + 2 == places.size();
      const bool has_upper = (is_first && starts_above) || (is_last && ends_above);
      const bool has_lower = (is_first && !starts_above) || (is_last && !ends_above);
      if (!has_lower && !draw_edge(row[k - 1], lower[places[k].lower], nodes)) return false;
      if (!has_upper && !draw_edge(row[k - 1], upper[places[k].upper], nodes)) return false;
    }
    return true;
  }

  Mesh& mesh_;
  SmoothingOptions relaxing_;
  const kernel::Budget& budget_;
  BandFinder finder_;
  std::vector<Index> nodes_;
  std::size_t changes_ = 0;
};

}  // namespace

std::size_t straighten_bands(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget) {
  return Straightening(mesh, smoothing, budget).run();
}

}  // namespace qmorph::cleanup
