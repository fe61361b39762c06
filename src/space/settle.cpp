// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/settle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace qmorph::space {
namespace {

using Eigen::Vector3d;

class Settling {
 public:
  Settling(MeshOnSurface& mesh, const SmoothingOptions& options)
      : mesh_(mesh), options_(options), slope_(mesh.faces()), way_(mesh.nodes(), Vector3d::Zero()) {
    for (Index v = 0; v < mesh.nodes(); ++v) start_.push_back(mesh.place(v));
  }

  void run() {
    constexpr int kPasses = 3;  // twice as many find little more
    for (int pass = 0; pass < kPasses; ++pass) {
      for (Index f = 0; f < mesh_.faces(); ++f) slope_[f] = slope_of(f);
      for (Index v = 0; v < mesh_.nodes(); ++v)
        if (mesh_.is_free(v)) settle(v);
    }
  }

 private:
  /// How fast the distance of a quad's centre from the surface grows when the centre moves; slower where it is nearly
  /// there.
  Vector3d slope_of(Index f) const {
    constexpr double kNear = 0.02;  // of a diagonal
    if (chart::degree(mesh_.mesh().faces[f]) != 4) return Vector3d::Zero();
    Vector3d centre = Vector3d::Zero();
    for (Index side = 4 * f; side < 4 * f + 4; ++side) centre += 0.25 * mesh_.point(mesh_.node(side));
    const Foot foot = mesh_.surface().walk(centre, mesh_.mesh().near[f]);
    const double near = kNear * (mesh_.point(mesh_.node(4 * f)) - mesh_.point(mesh_.node(4 * f + 2))).norm();
    const double distance = std::max(std::sqrt(foot.distance2), near);
    return distance > 0 ? Vector3d((centre - foot.point) / distance) : Vector3d::Zero();
  }

  /// Sends a node downhill, half as far as its neighbours have come besides: where all go the same way no shape
  /// suffers.
  void settle(Index v) {
    constexpr double kGain = 0.15, kMost = 0.15;  // of an edge
    Vector3d slope = Vector3d::Zero(), others = Vector3d::Zero();
    double edge = 0, count = 0;
    mesh_.for_sides_around(v, [&](Index side) {
      const Index other = mesh_.node(mesh_.next(side));
      slope += slope_[side / 4];
      others += way_[other];
      edge += (mesh_.point(other) - mesh_.point(v)).norm();
      ++count;
    });
    if (count == 0) return;
    edge /= count;
    Vector3d way = 0.5 * (way_[v] + others / count) - kGain * edge * slope;
    const Vector3d& up = mesh_.surface().normal(mesh_.mesh().on[v]);
    way -= way.dot(up) * up;
    const double length = way.norm(), most = kMost * edge;
    if (length > most) way *= most / length;
    const MeshOnSurface::Place before = mesh_.place(v);
    constexpr double kPoor = 0.3;  // left to those who look closer
    const double least = std::min(options_.good_quality, mesh_.smallest_sine_around(v));
    if (least < kPoor) return;
    mesh_.move(v, start_[v]);
    mesh_.move(v, mesh_.foot(v, start_[v].point + way));
    if (stays_good(v, least))
      way_[v] = way;
    else
      mesh_.move(v, before);
  }

  bool stays_good(Index v, double least) const {
    bool good = true;
    mesh_.for_sides_around(v, [&](Index side) {
      const Index f = side / 4;
      good = good && (mesh_.is_clearly_above(f, least) || mesh_.exact_sine(f) >= least);
    });
    return good;
  }

  MeshOnSurface& mesh_;
  const SmoothingOptions& options_;
  std::vector<Vector3d> slope_;  ///< by face
  std::vector<MeshOnSurface::Place> start_;
  std::vector<Vector3d> way_;  ///< by node: from the start
};

}  // namespace

void settle(MeshOnSurface& mesh, const SmoothingOptions& options) { Settling(mesh, options).run(); }

}  // namespace qmorph::space
