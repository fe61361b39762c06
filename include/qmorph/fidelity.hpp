// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How close the quads of a curved surface are to the triangles that they were made from.

#include <Eigen/Core>
#include <vector>

#include "qmorph/export.hpp"
#include "qmorph/patch.hpp"

namespace qmorph {

namespace space {
class Result;
}

/// One kind of figure over many places.
struct Spread {
  double mean = 0, p99 = 0, max = 0;
  Eigen::Vector3d where = Eigen::Vector3d::Zero();  ///< of the largest
};

/// Of curved surfaces; all 0 without any. Distances are in edges: over the mean length of the edges there.
struct Fidelity {
  std::size_t quads = 0;      ///< on curved surfaces
  Spread node, side, centre;  ///< distances of nodes, middles of edges, centres of quads from the input's triangles
  Spread back;                ///< of the input's nodes from the result, a quad being four triangles around its centre
  Spread normal_deg;          ///< between a quad's normal and that of the triangle under its centre
  Spread warpage_deg;         ///< between the normals of a quad's halves, cut along its better diagonal
};

/// Collects surfaces, then gives the figures of all of them together.
class QMORPH_API FidelityAccumulator {
 public:
  /// Adds a surface, if it is curved. Cost: linear.
  void add(const Patch& before, const QuadMesh& after);
  /// Adds a surface, flat or curved. `source` of the mesh may be all kNone; then the cost is n log n.
  void add_any(const Patch& before, const QuadMesh& after);
  void add(const FidelityAccumulator& other);
  Fidelity result() const;

 private:
  friend class Judged;
  struct Values {
    std::vector<float> all;
    double sum = 0, max = 0;
    Eigen::Vector3d where = Eigen::Vector3d::Zero();
    void add(double value, const Eigen::Vector3d& place);
    void add(const Values& other);
    Spread spread() const;
  };
  void add_on(const Patch& before, const space::Result& result);

  Values node_, side_, centre_, back_, normal_deg_, warpage_deg_;
};

}  // namespace qmorph
