// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "gmsh/model/model_mesh.hpp"

namespace qmorph::adapter {

/// Range of the parameters of a surface, which may come back to itself.
struct ParameterRange {
  Eigen::Vector2d low = Eigen::Vector2d::Zero(), high = Eigen::Vector2d::Zero();
  Eigen::Vector2d period = Eigen::Vector2d::Zero();  ///< 0: it does not come back to itself that way

  /// The nearest one in the range, as far as there is an end.
  Eigen::Vector2d within(Eigen::Vector2d p) const;
  /// The repetition of p that is in the range.
  Eigen::Vector2d wrapped(Eigen::Vector2d p) const;
  /// The one of p and its repetitions that is nearest to another point.
  Eigen::Vector2d nearest(Eigen::Vector2d p, const Eigen::Vector2d& to) const;
};

/// A place on a surface that a node has.
struct Candidate {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  std::array<bool, 2> counts = {true, true};  ///< at a pole, one of both says nothing
  double distance = 0;                        ///< between what the geometry has there and the node
};

/// Parameters of the nodes of a surface of a geometry: as Gmsh stores them for those inside; of nodes on curves and
/// points, which may have several places, as where a seam ends in a pole.
class NodeParameters {
 public:
  NodeParameters(const ModelMesh& mesh, std::uint32_t entity);
  const ParameterRange& range() const { return range_; }
  bool empty() const { return inside_.empty() && beside_.empty(); }
  /// Calls visit(candidate) for the places of a row.
  template <class Visit>
  void for_each(Index row, const Visit& visit) const {
    if (row - first_row_ < inside_.size()) return visit(inside_[row - first_row_]);
    if (const auto found = beside_.find(row); found != beside_.end())
      for (const Candidate& candidate : found->second) visit(candidate);
  }
  bool is_inside(Index row) const { return row - first_row_ < inside_.size(); }

 private:
  void add_inside(const ModelMesh& mesh, const EntityMesh& surface);
  void add_curve(const ModelMesh& mesh, int curve);
  void add_point(const ModelMesh& mesh, int point);
  void add(Index row, const Eigen::Vector2d& p) { beside_[row].push_back({p}); }
  void find_period();
  void find_distances(const ModelMesh& mesh);
  void find_poles();

  int tag_ = 0;
  ParameterRange range_;
  Index first_row_ = 0;
  std::vector<Candidate> inside_;
  std::map<Index, std::vector<Candidate>> beside_;
};

/// Points of a surface, and the derivatives of it by both parameters, all in one call of Gmsh's.
std::vector<Eigen::Vector3d> surface_points(int tag, const std::vector<Eigen::Vector2d>& parameters);
struct Tangents {
  Eigen::Vector3d u, v;
};
std::vector<Tangents> surface_tangents(int tag, const std::vector<Eigen::Vector2d>& parameters);

}  // namespace qmorph::adapter
