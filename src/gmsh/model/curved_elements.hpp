// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "gmsh/model/model_mesh.hpp"
#include "gmsh/session/element_types.hpp"
#include "qmorph/index.hpp"

namespace qmorph::adapter {

/// A node that is no corner.
struct MiddleNode {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  Eigen::Vector2d parameters = kNoParameters;
  std::size_t tag = 0;     ///< 0: it has none yet
  bool is_landed = false;  ///< on what the elements stand for
};

/// A side of one element or two, and what is on it from the first end to the second.
struct CurvedSide {
  std::array<Index, 2> ends;
  std::vector<MiddleNode> nodes;
  bool is_given = false;   ///< stays as it is
  bool is_inner = false;   ///< given by nodes of the surface itself: may be made straight between two of its elements
  bool has_moved = false;  ///< from where it was, to unfold an element
};

struct CurvedElement {
  std::vector<Index> corners;
  std::vector<Index> sides;  ///< from each corner to the next
  std::vector<MiddleNode> inside;
  bool is_kept = false;  ///< stays as it is, whatever it is
};

/// Elements of one order that share curved sides.
class CurvedElements {
 public:
  CurvedElements() = default;
  explicit CurvedElements(std::vector<Eigen::Vector3d> points) : points_(std::move(points)) {}
  /// What elements with so many corners are. \pre called for all before any is added
  void set_type(const ElementType& type);
  const ElementType& type(std::size_t corners) const { return shape(corners).type; }

  /// With straight sides where there are none yet. Nodes inside follow from the sides.
  Index add(std::vector<Index> corners);
  Index add_side(Index a, Index b);
  /// Puts the nodes inside between the sides, at equal steps.
  void fill(Index element);

  std::span<const Eigen::Vector3d> points() const { return points_; }
  Index sides() const { return Index(sides_.size()); }
  CurvedSide& side(Index s) { return sides_[s]; }
  const CurvedSide& side(Index s) const { return sides_[s]; }
  Index elements() const { return Index(elements_.size()); }
  CurvedElement& element(Index e) { return elements_[e]; }
  const CurvedElement& element(Index e) const { return elements_[e]; }
  /// The nodes of a side of an element, in its direction.
  std::vector<MiddleNode> along(Index element, std::size_t k) const;

  /// At a node of it the element is turned over, or flat, compared with one that has straight sides.
  bool is_folded(Index element) const;
  /// The corner where it is turned over most.
  const Eigen::Vector3d& place_of_fold(Index element) const;
  /// Straightens sides of folded elements, unless they are given and on a boundary, or those of kept elements. Where a
  /// given side folds one all the same, the side opposite is bent like it, or those beside it turn with it. Some may
  /// stay folded.
  /// \return how many sides have moved
  std::size_t unfold();
  /// Straightens the given sides of an element. \return those that were bent
  std::vector<Index> straighten_given(Index element);
  /// The first folded element that is not kept, or kNone.
  Index find_folded() const;

 private:
  using Vector3d = Eigen::Vector3d;
  /// An element of reference: derivatives of its functions at its nodes, and those of the corners' linear ones.
  struct Shape {
    ElementType type;
    std::vector<Eigen::Vector2d> slopes, linear_slopes;  ///< by node, then function
  };
  const Shape& shape(std::size_t corners) const { return shapes_[corners - 3]; }
  using Around = std::vector<std::vector<Index>>;  ///< elements at a side
  Vector3d on_line(const CurvedSide& side, std::size_t node) const;
  bool is_bent(const CurvedSide& side) const;
  bool may_be_straight(Index side, const Around& around) const;
  void straighten(CurvedSide& side) const;
  void straighten_folded(const Around& around);
  bool follow_given_side(Index element, const Around& around);
  bool is_any_folded(const std::vector<Index>& elements) const;
  void turn_like(const CurvedSide& given, Index side, double part);
  bool turn_beside_given_side(Index element, const Around& around);
  std::vector<Eigen::Vector3d> places(Index element) const;
  /// By node of the element: the sine of the angle between its directions there, negative where it is turned over.
  std::vector<double> rises(Index element) const;

  std::vector<Eigen::Vector3d> points_;
  std::array<Shape, 2> shapes_;  ///< triangles, quads
  std::vector<CurvedSide> sides_;
  std::map<std::array<Index, 2>, Index> side_of_;  ///< by ends, the smaller first
  std::vector<CurvedElement> elements_;
};

}  // namespace qmorph::adapter
