// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Makes triangle meshes with layers of which it is known which quads they are halves of.

#include <map>
#include <string>
#include <vector>

#include "qmorph/patch.hpp"
#include "support/rng.hpp"
#include "support/sketch.hpp"

namespace qmorph::test {

struct LayeredDomain {
  std::string kind;
  Patch patch;  ///< triangles
  std::vector<std::array<Index, 4>>
      quads;                      ///< of the layers, counter-clockwise; the wall edge is the first side of some
  std::vector<Index> wall_quads;  ///< which of them stand on a wall
  std::size_t tip_triangles = 0;  ///< in the first row of fans
};

/// How the cells of layers become triangles.
enum class Diagonals { rising, falling, alternating, random };

/// Lines of nodes that begin at a wall, side by side from right to left as the wall is followed, the domain to the left
/// of it; between two of them are cells.
class LayerBuilder {
 public:
  LayerBuilder(Rng& rng, double spacing) : rng_(rng), spacing_(spacing) {}

  Diagonals diagonals = Diagonals::rising;
  double jitter = 0;         ///< share of the shortest distance to a neighbour
  bool marks_walls = false;  ///< edges of the wall are constraints

  /// A line from a point of the wall; nodes are `direction` times each of the heights away. Lines from one point are a
  /// fan. `still`: it lies on a wall, too, and its nodes are not jittered.
  void add_line(const Eigen::Vector2d& foot, const Eigen::Vector2d& direction, const std::vector<double>& heights,
                bool still = false);
  std::size_t lines() const { return lines_.size(); }
  /// Lines are closed to a ring: a cell is between the last and the first as well.
  void close() { is_closed_ = true; }
  /// How many rows there are between a line and the next; all of them if it is not set.
  void set_rows(std::size_t line, std::size_t rows) { rows_[line] = rows; }
  std::size_t rows(std::size_t line) const { return rows_[line]; }
  /// The first row stands on no wall.
  void float_free() { has_wall_ = false; }

  /// The places along the outer end of the layers from line `first` on, those along the feet, and those all around.
  std::vector<Eigen::Vector2d> outer_rim(std::size_t first = 0) const;
  std::vector<Eigen::Vector2d> inner_rim() const;
  std::vector<Eigen::Vector2d> whole_rim() const;

  /// The layers, joined with what was drawn around them. Nothing if a cell has a corner of less than 20 or more than
  /// 160 degrees, if lines of the drawing cross, or if nothing is enclosed.
  std::optional<LayeredDomain> build(const Sketch* around);

 private:
  void make_cells(LayeredDomain& domain) const;
  bool join(const Sketch& around, LayeredDomain& domain);
  bool starts_falling(std::size_t line, std::size_t row) const;
  std::size_t following(std::size_t line) const { return (line + 1) % lines_.size(); }
  std::size_t bands() const { return is_closed_ ? lines_.size() : lines_.size() - 1; }

  Rng& rng_;
  double spacing_;
  bool is_closed_ = false, has_wall_ = true;
  std::vector<Eigen::Vector2d> points_;
  std::map<std::pair<double, double>, Index> foot_;  ///< points of the wall
  std::vector<std::vector<Index>> lines_;
  std::vector<std::size_t> rows_;
};

/// Draws lines along one side of the nodes of a wall: a fan where the wall turns away by more than `fan_from`
/// (radians), else one line in the middle between the perpendiculars.
void add_wall(LayerBuilder& builder, const std::vector<Eigen::Vector2d>& nodes, bool closed,
              const std::vector<double>& heights, double fan_from, Rng& rng);

}  // namespace qmorph::test
