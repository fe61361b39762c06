// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The shape energy of the elements around a node, as a function of where the node is.
///
/// At a corner with edges e1, e2 the energy is mu = (|e1|^2 + |e2|^2) / (2 e1 x e2): 1 for the corner of a square, the
/// inverse of the mean ratio of its two edges, growing without bound where the corner closes or turns over
/// [Knupp01]. The sum of mu^2 punishes the worst corners most. It is smooth, so one Newton step each pass is enough.

#include <array>
#include <span>
#include <vector>

#include "geometry/lanes.hpp"
#include "kernel/mesh.hpp"

namespace qmorph::smoothing {

struct Energy {
  bool finite = true;  ///< false if a corner is not convex by more than `kStraightSine`
  double value = 0;
  Vec2 gradient = Vec2::Zero();
  double xx = 0, xy = 0, yy = 0;  ///< second derivatives
  bool is_convex() const { return xx > 0 && xx * yy - xy * xy > 0; }
};

/// Four of the elements around a node v, one in each lane. An element runs v, q, after_q, r or, if it is a triangle, v,
/// q, r: then after_q is r and before_r is q.
struct FourElements {
  FourLanes qx, qy, rx, ry, after_qx, after_qy, before_rx, before_ry;
  std::array<Index, 4> node;      ///< at q
  std::array<Index, 4> opposite;  ///< at before_r
};

/// An element around a node v, which runs v, q, ..., r; of a triangle after_q is r and before_r is q.
struct StarElement {
  Vec2 q, after_q, before_r, r;
  Index node = kNone, opposite = kNone;  ///< at q and before_r
};

/// The elements around a node, looked at once, so that the energy at several places costs no walk through the mesh. Of
/// an element that runs v, q, ..., r the corners at v, q and r depend on v.
class Star {
 public:
  void look_around(const kernel::Mesh& mesh, Index v);
  /// These elements instead of those of a mesh.
  void set(std::span<const StarElement> elements);
  /// Energy of the corners whose shape depends on the node, if that is at p.
  Energy energy_with_derivatives(const Vec2& p) const;
  /// The same, value only.
  Energy energy(const Vec2& p) const;
  /// Energy of corners that may be turned over: mu with (J + sqrt(J^2 + 4 delta^2)) / 2 for the area J of a corner,
  /// which is positive everywhere and tends to J as delta goes to zero. [Escobar03] `delta` is an area.
  Energy regularised_with_derivatives(const Vec2& p, double delta) const;
  /// The same, value only.
  double regularised(const Vec2& p, double delta) const;

  /// Of the edges at the node, if that is at p and inside.
  double mean_edge(const Vec2& p) const;
  std::size_t elements() const { return count_; }
  /// Elements looked at so far, at all nodes and places.
  std::size_t work() const { return work_; }
  void add_work(std::size_t elements) { work_ += elements; }
  /// Calls visit(u) for the nodes of the elements around, some more than once. Precondition: the node is inside.
  template <class Visit>
  void for_each_neighbour(const Visit& visit) const {
    for (std::size_t i = 0; i < count_; ++i) visit(fours_[i / 4].node[i % 4]), visit(fours_[i / 4].opposite[i % 4]);
  }

 private:
  template <class Add>
  Energy sum(const Vec2& p, const Add& add) const;
  void put(std::size_t place, const Vec2& q, const Vec2& after_q, const Vec2& before_r, const Vec2& r, Index node,
           Index opposite);

  std::vector<FourElements> fours_;  ///< kept to avoid allocations
  std::size_t count_ = 0;            ///< elements
  mutable std::size_t work_ = 0;
};

/// As Star's, for one place.
Energy energy_around(const kernel::Mesh& mesh, Index v);
Energy energy_at(const kernel::Mesh& mesh, Index v, const Vec2& p);

}  // namespace qmorph::smoothing
