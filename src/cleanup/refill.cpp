// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/refill.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "cleanup/attempt.hpp"
#include "cleanup/cavity.hpp"
#include "cleanup/poor_shapes.hpp"
#include "cleanup/quadrangulations.hpp"
#include "kernel/sort_unique.hpp"

namespace qmorph::cleanup {
namespace {

/// Sines of the quads that something is tried for.
constexpr double kTried = 0.45;
/// What one of the valence score costs, and what a change has to bring: in quads of sine 0.
constexpr double kPriceOfScore = 0.03, kLeastGain = 0.02;
/// Rings of quads around the poor one that are replaced with it, first few, then more; without a ring those that share
/// a side with it.
constexpr std::array kRingsReplaced{0, 1, 2};
/// With more a search would end before it has found all.
constexpr std::size_t kLongestOutline = 20, kMostSteps = 10'000;
/// What the new valences may cost more than the old ones, and how many more nodes there may be inside.
constexpr int kMostScore = 4, kMostMore = 1;
/// Fillings that are relaxed.
constexpr std::size_t kMostTries = 24;
constexpr std::size_t kWorkOfStep = 20;
/// That spread new nodes, and rings that are relaxed then.
constexpr int kSweeps = 10, kRingsRelaxed = 1;

bool is_poor(const kernel::Mesh& mesh, Index f) {
  return mesh.is_live_face(f) && mesh.is_quad(f) && !mesh.is_above(f, kTried);
}

/// What is to be replaced, in an order that depends on the numbers of its nodes alone.
struct Window {
  std::vector<Index> faces, outline, inner;
  std::vector<int> outer;  ///< as Cavity::outer_edges()
};

Window window_of(const Cavity& cavity, const kernel::Mesh& mesh) {
  Window window{cavity.faces(), cavity.outline(), cavity.inner_nodes(), cavity.outer_edges()};
  sort_unique(window.inner);
  const auto first = std::min_element(window.outline.begin(), window.outline.end(),
                                      [&](Index g, Index h) { return mesh.origin(g) < mesh.origin(h); }) -
                     window.outline.begin();
  std::rotate(window.outline.begin(), window.outline.begin() + first, window.outline.end());
  std::rotate(window.outer.begin(), window.outer.begin() + first, window.outer.end());
  return window;
}

class Refilling {
 public:
  Refilling(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget)
      : mesh_(mesh), cavity_(mesh), score_(mesh), relaxing_(smoothing), budget_(budget) {
    relaxing_.iterations = std::max(relaxing_.iterations, 12);
    relaxing_.untangling_sweeps = 12;
  }

  std::size_t run() {
    std::vector<Index> poor;
    for (Index f = 0; f < mesh_.face_slots(); ++f)
      if (is_poor(mesh_, f)) poor.push_back(f);
    std::size_t replaced = 0;
    for (Index f : worst_first(mesh_, std::move(poor)))
      if (!budget_.is_spent() && is_poor(mesh_, f)) replaced += improve(f);
    return replaced;
  }

 private:
  bool improve(Index f) {
    for (const int rings : kRingsReplaced) {
      std::vector<Index> faces = topology::grow(mesh_, {f}, rings);
      if (rings == 0)
        for (Index h : mesh_.sides_of(f))
          if (const Index other = mesh_.face(kernel::Mesh::twin(h)); other != kNone) faces.push_back(other);
      std::erase_if(faces, [&](Index g) { return !mesh_.is_quad(g); });
      sort_unique(faces);
      if (!cavity_.start_with(faces) || cavity_.outline().size() > kLongestOutline) continue;
      if (replace(window_of(cavity_, mesh_), mesh_.smallest_sine(f))) return true;
    }
    return false;
  }

  /// A node of the outline. On the boundary it has as many edges at most as leave quads that share the angle evenly a
  /// sine which is good enough.
  RingNode node(Index v, int outer) const {
    RingNode node{outer, score_.ideal(v), 3, int(kMostValence), mesh_.point(v), mesh_.is_free(v)};
    if (!mesh_.is_boundary(v)) return node;
    const double angle = score_.inside_angle(v);
    node.fewest = std::max(node.outer, 2);
    while (node.most > node.ideal && std::sin(angle / (node.most - 1)) < kTried) --node.most;
    return node;
  }

  /// `worst`: the sine of the quad for which this is done.
  bool replace(const Window& window, double worst) {
    std::vector<RingNode> ring;
    int cost = 0;
    for (Index v : window.inner) cost += score_.cost(v);
    for (std::size_t i = 0; i < window.outline.size(); ++i) {
      const Index v = mesh_.origin(window.outline[i]);
      ring.push_back(node(v, window.outer[i]));
      cost += score_.cost(v);
    }
    SearchLimits limits;
    limits.least_sine = worst;
    limits.most_found = kMostTries;
    limits.most_steps = kMostSteps;
    limits.most_cost = cost + kMostScore;
    limits.most_inner = int(window.inner.size()) + kMostMore;
    std::size_t steps = 0;
    const std::vector<Quadrangulation> found = find_quadrangulations(ring, limits, steps);
    mesh_.add_work(kWorkOfStep * steps);
    for (const Quadrangulation& q : found) {
      if (budget_.is_spent()) return false;
      if (try_filling(window, q, kLeastGain + kPriceOfScore * std::max(0, q.cost - cost))) return true;
    }
    return false;
  }

  PoorShapes shapes_of(const std::vector<Index>& faces) const {
    mesh_.add_work(faces.size());
    return {mesh_, faces};
  }

  bool try_filling(const Window& window, const Quadrangulation& quadrangulation, double least_gain) {
    std::vector<Index> nodes = window.inner, fresh;
    for (Index h : window.outline) nodes.push_back(mesh_.origin(h));
    const PoorShapes before = shapes_of(topology::faces_around(mesh_, nodes));
    nodes.erase(nodes.begin(), nodes.begin() + std::ptrdiff_t(window.inner.size()));
    mesh_.begin();
    bool kept = fill(mesh_, window.outline, window.faces, quadrangulation, fresh);
    if (kept) {
      topology::spread(mesh_, fresh, kSweeps);
      nodes.insert(nodes.end(), fresh.begin(), fresh.end());
      topology::remove_doublets(mesh_, nodes);
      kept = smoothing::smooth_near(mesh_, relaxing_, nodes, kRingsRelaxed);
    }
    kept = kept && shapes_of(topology::faces_around(mesh_, nodes)).is_worth(before, least_gain);
    kept ? mesh_.commit() : mesh_.rollback();
    return kept;
  }

  kernel::Mesh& mesh_;
  Cavity cavity_;
  Score score_;
  SmoothingOptions relaxing_;
  const kernel::Budget& budget_;
};

}  // namespace

bool has_poor_quads(const kernel::Mesh& mesh) {
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (is_poor(mesh, f)) return true;
  return false;
}

std::size_t refill_around_poor(kernel::Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget) {
  return Refilling(mesh, smoothing, budget).run();
}

}  // namespace qmorph::cleanup
