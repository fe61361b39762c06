// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Draws a domain by its lines, fills it with nodes of a given size, and triangulates it.

#include <map>
#include <optional>
#include <vector>

#include "support/draft.hpp"
#include "support/rng.hpp"
#include "support/triangulate.hpp"

namespace qmorph::test {

/// How long edges should be, from place to place.
struct SizeField {
  double smallest = 0.1, largest = 0.1;
  double growth = 0;  ///< length for length, away from the line from `from` to `to`
  Eigen::Vector2d from{0, 0}, to{0, 0};
  double at(const Eigen::Vector2d& p) const;
};

/// How the inside is filled.
struct Filling {
  enum class Pattern { nothing, cells, rows } pattern = Pattern::rows;
  double jitter = 0;  ///< share of the size
  double turn = 0;    ///< of the rows, radians
};

/// Coordinates are about -1 to 1; they are rounded to a lattice of 2^-19, and nodes at one lattice point are one.
class Sketch {
 public:
  SizeField size;
  Filling filling;

  int node(const Eigen::Vector2d& place);
  /// A line, cut into pieces of the field's size, at least `least` of them; returns its nodes, both ends included.
  std::vector<int> line(int from, int to, SegmentKind kind, int least = 1);
  /// A line in one piece, however long it is.
  void edge(int from, int to, SegmentKind kind) { segments_.push_back({from, to, kind}); }
  /// A polygon through corners; `closed` for the last side.
  std::vector<int> path(const std::vector<Eigen::Vector2d>& corners, SegmentKind kind, bool closed);
  /// A node that stays in place.
  void fixed(const Eigen::Vector2d& place) { fixed_.push_back(node(place)); }

  std::size_t node_count() const { return nodes_.size(); }
  Eigen::Vector2d place(int node) const;

  /// The triangles of what was drawn. Nothing if lines cross or nothing is enclosed.
  std::optional<Draft> build(Rng& rng) const;

 private:
  void fill(Rng& rng, std::vector<LatticePoint>& points) const;
  bool is_free(const Eigen::Vector2d& place, double size) const;

  std::vector<LatticePoint> nodes_;
  std::map<LatticePoint, int> node_at_;
  std::vector<Segment> segments_;
  std::vector<int> fixed_;
};

}  // namespace qmorph::test
