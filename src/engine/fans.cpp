// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/fans.hpp"

#include <algorithm>
#include <array>

#include "topology/edits.hpp"

namespace qmorph {
namespace {

using kernel::Mesh;

/// A fan is graded if more edges than this meet at its node, and until no more than kEnough do.
constexpr std::size_t kTooMany = 16, kEnough = 10;
/// Distance to the next ring over the length of this ring's edges, which the next has twice as long.
constexpr double kRingHeight = 1.2;
/// A ring does not come nearer to the centre than this share of the way to it.
constexpr double kNearest = 0.3;
/// A ring is no improvement if it makes a triangle whose smallest sine is less than this times the fan's.
constexpr double kLeastShare = 0.5;

/// What becomes of an edge from the centre to the ring around it.
enum class Spoke { stays, is_split, vanishes };

/// Edges from v outwards, counter-clockwise, from one boundary edge to the other if v is on the boundary.
std::vector<Index> spokes_of(const Mesh& mesh, Index v) {
  std::vector<Index> spokes;
  for (Index h : mesh.around_inside(v)) spokes.push_back(h);
  return spokes;
}

class Ring {
 public:
  Ring(Mesh& mesh, Index centre)
      : mesh_(mesh), centre_(centre), spokes_(spokes_of(mesh, centre)), fates_(spokes_.size()) {}

  std::size_t size() const { return spokes_.size(); }

  /// Puts the next ring inside. False if it was no improvement, or if there is no room; nothing has changed then.
  bool add_inside() {
    const double least = kLeastShare * mesh_.smallest_sine_around(centre_);
    if (!decide_fates()) return false;
    mesh_.begin();
    split_spokes();
    join_over_vanishing();
    const bool done = cut_faces(least);
    done ? mesh_.commit() : mesh_.rollback();
    return done;
  }

 private:
  bool is_open() const { return mesh_.is_boundary(centre_); }

  /// Where on spoke i the next ring passes, as a share of its length.
  double share_at(std::size_t i) const {
    const Index h = spokes_[i];
    const double ring_edge = (mesh_.length(mesh_.next(h)) + mesh_.length(mesh_.prev(Mesh::twin(h)))) / 2;
    return 1 - kRingHeight * ring_edge / mesh_.length(h);
  }

  /// Boundary edges stay, and so do spokes that are too short for another ring. Of the others each second one is split,
  /// and the first and the last in a row; those between vanish. False if none vanishes.
  bool decide_fates() {
    const std::size_t n = size();
    bool any_vanishes = false;
    for (std::size_t i = 0; i < n; ++i) {
      const bool is_end = is_open() && (i == 0 || i + 1 == n);
      if (is_end || share_at(i) < kNearest)
        fates_[i] = Spoke::stays;
      else
        fates_[i] = i > 0 && fates_[i - 1] == Spoke::is_split ? Spoke::vanishes : Spoke::is_split;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t next = (i + 1) % n, before = (i + n - 1) % n;
      if (fates_[i] == Spoke::vanishes && (fates_[next] != Spoke::is_split || fates_[before] != Spoke::is_split))
        fates_[i] = Spoke::is_split;
      any_vanishes = any_vanishes || fates_[i] == Spoke::vanishes;
    }
    return any_vanishes;
  }

  void split_spokes() {
    std::vector<double> shares(size());
    for (std::size_t i = 0; i < size(); ++i)
      if (fates_[i] == Spoke::is_split) shares[i] = share_at(i);
    for (std::size_t i = 0; i < size(); ++i)
      if (fates_[i] == Spoke::is_split)
        mesh_.split_edge(spokes_[i], mesh_.point(centre_) + shares[i] * mesh_.vector(spokes_[i]));
  }

  void join_over_vanishing() {
    std::vector<Index> left;
    for (std::size_t i = 0; i < size(); ++i)
      if (fates_[i] == Spoke::vanishes)
        mesh_.join_faces(spokes_[i]);
      else
        left.push_back(spokes_[i]);
    spokes_ = left;
  }

  /// Each face is: the centre, the end of a spoke, up to three nodes of the old ring, the end of the next spoke. The
  /// triangle at the centre is cut off, then the rest divided. False where a triangle is worse than `least`.
  bool cut_faces(double least) {
    const std::size_t faces = is_open() ? spokes_.size() - 1 : spokes_.size();
    for (std::size_t i = 0; i < faces; ++i) {
      const Index from = mesh_.next(spokes_[i]), back = mesh_.prev(spokes_[i]);
      if (mesh_.next(from) == back) continue;  // between two that stayed
      if (!cut_outer(mesh_.split_face(from, back), least)) return false;
      if (mesh_.smallest_sine(mesh_.face(spokes_[i])) < least) return false;
    }
    return true;
  }

  /// Divides the face right of h, the edge between the ends of two spokes, into triangles:
  ///
  ///   ring  o---o---o    o---o    o
  ///         | / | \ |    | / |    | \      h below, from left to right as seen from the centre
  ///         o-------o    o---o    o--o
  bool cut_outer(Index h, double least) {
    const Index base = Mesh::twin(h), f = mesh_.face(base);  // base runs from the second spoke's end to the first's
    while (mesh_.degree(f) > 3) {
      const Index ear =
          mesh_.degree(f) == 5 || is_better_at_start(base) ? mesh_.next(base) : mesh_.prev(mesh_.prev(base));
      const Index diagonal = mesh_.split_face(ear, mesh_.next(mesh_.next(ear)));
      if (mesh_.smallest_sine(mesh_.face(Mesh::twin(diagonal))) < least) return false;
    }
    return mesh_.smallest_sine(f) >= least;
  }

  /// Of the two ways to cut the quad of `base`, the one with an ear at the end of `base` gives the better triangles.
  bool is_better_at_start(Index base) const {
    const Index a = mesh_.origin(base), b = mesh_.target(base), c = mesh_.target(mesh_.next(base)),
                d = mesh_.origin(mesh_.prev(base));
    const auto worst = [&](std::array<Index, 3> t, std::array<Index, 3> u) {
      return std::min(topology::smallest_sine(mesh_, {t.begin(), t.end()}),
                      topology::smallest_sine(mesh_, {u.begin(), u.end()}));
    };
    return worst({b, c, d}, {a, b, d}) > worst({c, d, a}, {a, b, c});
  }

  Mesh& mesh_;
  Index centre_;
  std::vector<Index> spokes_;
  std::vector<Spoke> fates_;
};

}  // namespace

std::size_t grade_fans(Mesh& mesh) {
  const std::vector<Index> valences = mesh.valences();
  if (std::all_of(valences.begin(), valences.end(), [](Index valence) { return valence <= kTooMany; })) return 0;
  const Index count = mesh.vertex_slots();
  std::size_t rings = 0;
  for (Index v = 0; v < count; ++v) {
    if (!mesh.is_live_vertex(v) || mesh.valence(v) <= kTooMany) continue;
    while (mesh.valence(v) > kEnough && Ring(mesh, v).add_inside()) ++rings;
  }
  return rings;
}

}  // namespace qmorph
