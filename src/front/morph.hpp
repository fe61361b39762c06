// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The advancing front as a whole. Thesis chapter 2, [Owen99].

#include <functional>
#include <memory>

#include "front/decisions.hpp"
#include "kernel/mesh.hpp"
#include "qmorph/observer.hpp"
#include "qmorph/options.hpp"

namespace qmorph::front {

struct MorphSettings {
  bool check_each_step = false;
  std::function<void(double)> progress{};  ///< called now and then with the share of triangles done; may be empty
  Observer* observer = nullptr;            ///< is asked who wants to see the steps; may be null
  FlatFrame frame{};                       ///< for the observer: where the mesh lies in the model
  /// The same for a chart of a curved surface; may be empty.
  std::function<Eigen::Vector3d(const Eigen::Vector2d&)> lift{};
  Decisions* decisions = nullptr;  ///< is told what the constants have decided; may be null
  /// Is told whether the front has ended before it was done, since it took far more steps than there were triangles:
  /// then it makes more and more small quads where there is no room for good ones. May be null.
  bool* is_astray = nullptr;
};

/// Turns triangles into quads from the boundary inwards. Every element of the mesh is valid before and after;
/// triangles that no step can take are left for triangle elimination. Linear but for the queue.
/// \return who has watched, or null
std::unique_ptr<FrontObserver> morph(kernel::Mesh& mesh, const FrontOptions& options,
                                     const MorphSettings& settings = {});

}  // namespace qmorph::front
