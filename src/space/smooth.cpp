// SPDX-License-Identifier: GPL-2.0-or-later
#include "space/smooth.hpp"

#include <algorithm>
#include <cmath>

#include "smoothing/corner_energy.hpp"

namespace qmorph::space {
namespace {

using smoothing::Energy;

/// Newton's step where the energy is convex, else downhill by a fraction of the edge length.
Vec2 step_of(const Energy& energy, double edge) {
  const Vec2& g = energy.gradient;
  if (energy.is_convex())
    return Vec2(energy.xy * g.y() - energy.yy * g.x(), energy.xy * g.x() - energy.xx * g.y()) /
           (energy.xx * energy.yy - energy.xy * energy.xy);
  constexpr double kDownhill = 0.1;
  const double length = g.norm();
  return length > 0 ? Vec2(-g * (kDownhill * edge / length)) : Vec2::Zero();
}

class Smoother {
 public:
  Smoother(MeshOnSurface& mesh, const SmoothingOptions& options, bool all_active)
      : mesh_(mesh), options_(options), active_(mesh.nodes(), all_active) {}

  void wake_around(Index v) {
    mesh_.for_sides_around(v, [&](Index first) {
      for (Index side = mesh_.next(first); side != first; side = mesh_.next(side)) active_[mesh_.node(side)] = 1;
    });
    active_[v] = 1;
  }

  void run() {
    for (int pass = 0; pass < options_.iterations; ++pass)
      if (!relax_all()) break;
    raise_poor_corners();
  }

 private:
  /// Moves a node by a share of the step, if no element around gets worse than the worst was, unless it stays good.
  bool try_step(Index v, const UnfoldedStar& star, const Vec2& step, bool is_sure) {
    const MeshOnSurface::Place before = mesh_.place(v);
    const double least = is_sure ? 0 : std::min(options_.good_quality, mesh_.smallest_sine_around(v));
    mesh_.move(v, mesh_.foot(v, mesh_.point(v) + star.in_space(step)));
    if (is_sure || mesh_.smallest_sine_around(v) >= least) return true;
    mesh_.move(v, before);
    return false;
  }

  /// Returns how far the node moved, in edges.
  template <class EnergyAt>
  double descend(Index v, const UnfoldedStar& star, const Energy& energy, double first_share, double sure_energy,
                 const EnergyAt& energy_at) {
    constexpr int kHalvings = 4;
    constexpr double kLeastStep = 1e-3;  // of an edge: less is not worth visiting the neighbours
    const Vec2 step = step_of(energy, star.edge);
    const double length = step.norm() / star.edge;
    if (!(length > kLeastStep)) return 0;
    double share = first_share;
    for (int i = 0; i < kHalvings; ++i, share /= 2) {
      const Energy there = energy_at(share * step);
      if (!there.finite || !(there.value < energy.value)) continue;
      if (try_step(v, star, share * step, there.value < sure_energy)) return share * length;
    }
    return 0;
  }

  double relax(Index v) {
    constexpr double kOverRelaxation = 1.3;
    if (!mesh_.unfold(v, star_)) return 0;
    energies_.set(star_.elements);
    const Energy energy = energies_.energy_with_derivatives(Vec2::Zero());
    if (!energy.finite) return 0;
    // The energy is the sum of mu^2 over three corners of each element, each at least 1 and at least the sine^-2 of its
    // corner: if even all that exceeds 1 in the sum came from one corner, that corner would be good, and so all are.
    const double sure = double(3 * star_.elements.size() - 1) + std::pow(options_.good_quality, -2);
    return descend(v, star_, energy, kOverRelaxation, sure, [&](const Vec2& p) { return energies_.energy(p); });
  }

  bool relax_all() {
    bool any = false;
    for (Index v = 0; v < mesh_.nodes(); ++v) {
      if (!active_[v] || !mesh_.is_to_be_smoothed(v)) continue;
      active_[v] = 0;
      if (relax(v) <= options_.move_tolerance) continue;
      any = true;
      active_[v] = 1;
      for (const auto& element : star_.elements) active_[element.node] = active_[element.opposite] = 1;
    }
    return any;
  }

  double raise(Index v) {
    if (!mesh_.unfold(v, star_)) return 0;
    const Energy energy = smoothing::corner_energy(star_.elements, Vec2::Zero(), true);
    if (!energy.finite) return 0;
    return descend(v, star_, energy, 1, 0,
                   [&](const Vec2& p) { return smoothing::corner_energy(star_.elements, p, false); });
  }

  /// As raise_worst_corners() does in a plane.
  void raise_poor_corners() {
    constexpr int kPasses = 8;
    const std::vector<Index> nodes = nodes_near_poor();
    for (int pass = 0; pass < kPasses; ++pass) {
      double moved = 0;
      for (Index v : nodes) moved = std::max(moved, raise(v));
      if (moved < options_.move_tolerance) break;
    }
  }

  /// Free nodes of the poorest elements, at most a small share of all, and of those around.
  std::vector<Index> nodes_near_poor() const {
    constexpr double kMostPoor = 0.05;
    std::vector<std::pair<double, Index>> faces;
    for (Index f = 0; f < mesh_.faces(); ++f)
      if (const double sine = mesh_.smallest_sine(f); sine < options_.good_quality) faces.emplace_back(sine, f);
    std::sort(faces.begin(), faces.end());
    const auto most = std::size_t(std::ceil(kMostPoor * double(mesh_.faces())));
    if (faces.size() > most) faces.resize(most);
    std::vector<Index> nodes;
    std::vector<char> taken(mesh_.nodes(), 0);
    const auto take = [&](Index f) {
      for (Index i = 0; i < chart::degree(mesh_.mesh().faces[f]); ++i)
        if (const Index v = mesh_.node(4 * f + i); !taken[v]) taken[v] = 1, nodes.push_back(v);
    };
    for (const auto& face : faces) take(face.second);
    const std::size_t count = nodes.size();
    for (std::size_t i = 0; i < count; ++i) mesh_.for_sides_around(nodes[i], [&](Index side) { take(side / 4); });
    std::erase_if(nodes, [&](Index v) { return !mesh_.is_to_be_smoothed(v); });
    return nodes;
  }

  MeshOnSurface& mesh_;
  const SmoothingOptions& options_;
  std::vector<char> active_;  ///< by node
  UnfoldedStar star_;
  smoothing::Star energies_;
};

}  // namespace

void smooth(MeshOnSurface& mesh, const SmoothingOptions& options) { Smoother(mesh, options, true).run(); }

void smooth_near(MeshOnSurface& mesh, const SmoothingOptions& options, std::span<const Index> nodes) {
  if (nodes.empty()) return;
  Smoother smoother(mesh, options, false);
  for (Index v : nodes) smoother.wake_around(v);
  smoother.run();
}

}  // namespace qmorph::space
