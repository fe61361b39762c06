// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gmsh/geometry/landing.hpp"
#include "gmsh/geometry/node_parameters.hpp"

namespace qmorph::adapter {

/// A surface of a geometry. Points of its mesh's triangles are brought onto it by Newton steps from the parameters that
/// their corners have: Gmsh's own search takes a thousand times as long on B-splines.
class CadSurface {
 public:
  /// Nothing for a surface without geometry, such as all of a `.msh` file alone: Gmsh evaluates these, too, and gets
  /// nonsense. Nor for a plane, where triangles are the geometry.
  static std::unique_ptr<CadSurface> find(const ModelMesh& mesh, std::uint32_t entity);

  /// By its type alone: false where find() finds nothing in any case.
  static bool may_be_found(const ModelMesh& mesh, std::uint32_t entity);

  std::vector<Landing> land(std::span<const OnInput> points) const;
  /// Unit normals at parameters between those of the triangles' corners; zero where the surface has none.
  std::vector<Eigen::Vector3d> normals(std::span<const OnInput> points) const;

 private:
  CadSurface(const ModelMesh& mesh, std::uint32_t entity)
      : mesh_(mesh), tag_(mesh.entities[entity].tag), parameters_(mesh, entity) {}
  bool exists() const;
  double edge(const OnInput& point) const;
  bool guess(const OnInput& point, Eigen::Vector2d& start) const;
  void search(std::span<const OnInput> points, std::vector<std::size_t> open, std::vector<Landing>& landings) const;

  const ModelMesh& mesh_;
  int tag_;
  NodeParameters parameters_;
};

}  // namespace qmorph::adapter
