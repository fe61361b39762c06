// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A mesh as it is shown: what pages and pictures are made from.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "qmorph/index.hpp"

namespace qmorph::report {

/// A physical group.
struct SceneGroup {
  int dim = 0, tag = 0;
  std::string name;
};

/// A surface or a curve, and which faces or lines of the scene are its own.
struct SceneEntity {
  int tag = 0;
  std::vector<std::size_t> groups;  ///< indices into `Scene::groups`
  std::size_t first = 0, count = 0;
};

/// Elements of higher order are shown by their corners.
struct Scene {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::size_t> node_tags;       ///< of a point; 0 if it has none
  std::vector<std::array<Index, 4>> faces;  ///< rows of `points`; of a triangle the last is kNone
  std::vector<std::size_t> face_tags;
  std::vector<std::array<Index, 2>> lines;  ///< line elements
  std::vector<Index> dots;                  ///< nodes of point elements
  std::vector<SceneEntity> surfaces;        ///< of `faces`, one after another
  std::vector<SceneEntity> curves;          ///< of `lines`, one after another
  std::vector<SceneGroup> groups;
};

inline Index corners_of(const std::array<Index, 4>& face) { return face[3] == kNone ? 3 : 4; }

/// Figures of a scene that colours and marks show. All are as long as `Scene::faces`; NaN where a figure is not
/// defined for the element.
struct SceneFigures {
  std::vector<float> scaled_jacobian, eta, thesis_metric;
  std::vector<float> size;  ///< mean length of the element's edges
  struct Irregular {
    Index node;
    int valence;
  };
  std::vector<Irregular> irregular;              ///< nodes inside a surface with quads that have not four edges
  std::vector<std::array<Index, 2>> open_edges;  ///< sides that one element of a surface has, and no line element is on
};

/// Cost: linear.
SceneFigures measure(const Scene& scene);

/// From which direction a scene is drawn.
struct Frame {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::UnitX(), up = Eigen::Vector3d::UnitY();
  double radius = 1;  ///< no point is farther from the centre
  bool flat = true;   ///< all points lie in the plane of `right` and `up`
  Eigen::Vector3d normal() const;
  /// Along `right`, `up` and `normal`, from the centre.
  Eigen::Vector3d to_frame(const Eigen::Vector3d& p) const;
};

/// What runs to the right where one looks at a plane against this unit normal: along x, as far as that may be.
Eigen::Vector3d right_of(const Eigen::Vector3d& normal);

/// The plane of a flat scene, x and y themselves where that is (nearly) z = constant; x and z for a scene in space.
Frame find_frame(const Scene& scene);

}  // namespace qmorph::report
