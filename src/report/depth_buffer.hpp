// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Which faces of a scene in space are seen.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "qmorph/index.hpp"

namespace qmorph::report {

/// The face in front at each pixel of a grid that is fine beside the faces.
class DepthBuffer {
 public:
  /// `points`: x to the right and y upwards on the page, z towards the eye, all in one unit; not less than (0, 0).
  /// `faces`: as in `Scene`.
  DepthBuffer(std::span<const Eigen::Vector3d> points, std::span<const std::array<Index, 4>> faces);

  /// Faces of which something is seen, in an order in which each may be painted over those before it: at each pixel the
  /// face in front comes last. Of faces that go through one another, or lie behind one another in a ring, some come out
  /// of order.
  std::vector<std::size_t> back_to_front() const;

  /// Is nothing before a point, within a pixel or two?
  bool sees(const Eigen::Vector3d& point) const;

 private:
  struct Flat;
  Flat flat(std::size_t f) const;
  template <class Visit>
  void for_pixels(const Flat& face, const Visit& visit) const;
  double depth_of(std::size_t f) const;
  std::vector<bool> find_seen() const;
  using Pair = std::array<Index, 2>;
  std::vector<Pair> find_behind(const std::vector<bool>& seen) const;

  std::span<const Eigen::Vector3d> points_;
  std::span<const std::array<Index, 4>> faces_;
  double pixel_ = 1;  ///< its side
  Index width_ = 0, height_ = 0;
  std::vector<Index> front_;
  std::vector<float> depth_;
};

}  // namespace qmorph::report
