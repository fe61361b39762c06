// SPDX-License-Identifier: GPL-2.0-or-later
#include "smoothing/smooth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "geometry/z_curve.hpp"
#include "kernel/sort_unique.hpp"
#include "parallel/for_each.hpp"
#include "smoothing/node_energy.hpp"
#include "smoothing/thesis_smoothing.hpp"
#include "smoothing/untangle.hpp"
#include "topology/edits.hpp"

namespace qmorph::smoothing {
namespace {

/// Sines do not see edge lengths: a node may fall onto its neighbour although every corner looks good.
bool is_on_neighbour(const kernel::Mesh& mesh, Index v) {
  constexpr double kLeastRatio = 1e-4;
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (Index h : mesh.around(v)) {
    const double length = mesh.length(h);
    shortest = std::min(shortest, length), longest = std::max(longest, length);
  }
  return shortest < kLeastRatio * longest;
}

/// Where very many edges meet, neighbours are not collected: work on a fan would be quadratic.
bool is_hub(const kernel::Mesh& mesh, Index v) {
  constexpr Index kMostValence = 24;
  return mesh.valence(v) > kMostValence;
}

/// Newton's direction where the energy is convex, else downhill by a fraction of the edge length.
Vec2 direction(const Energy& energy, double edge) {
  const Vec2& g = energy.gradient;
  if (energy.is_convex()) {
    const double determinant = energy.xx * energy.yy - energy.xy * energy.xy;
    return {-(energy.yy * g.x() - energy.xy * g.y()) / determinant,
            -(energy.xx * g.y() - energy.xy * g.x()) / determinant};
  }
  constexpr double kDownhill = 0.1;
  const double length = g.norm();
  return length > 0 ? Vec2(-g * (kDownhill * edge / length)) : Vec2::Zero();
}

/// Makes the elements around `nodes` valid by moving the nodes down a regularised energy whose regularisation
/// fades. [Escobar03] Returns false if some element stays invalid.
bool untangle(kernel::Mesh& mesh, const std::vector<Index>& nodes, int sweeps) {
  constexpr int kHalvings = 6;
  constexpr double kFirstDelta = 0.5, kFade = 0.8, kLeastDelta = 1e-8;
  Star star;
  if (has_immovable_fault(mesh, nodes)) return false;
  double share_of_area = kFirstDelta;
  bool valid = false;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    share_of_area = std::max(kLeastDelta, kFade * share_of_area);
    for (Index v : nodes) {
      star.look_around(mesh, v);
      const Vec2 start = mesh.point(v);
      const double edge = star.mean_edge(start), delta = share_of_area * std::pow(edge, 2);
      const Energy energy = star.regularised_with_derivatives(start, delta);
      const Vec2 step = direction(energy, edge);
      double share = 1;
      for (int i = 0; i < kHalvings; ++i, share /= 2) {
        const Vec2 p = start + share * step;
        if (!(star.regularised(p, delta) < energy.value)) continue;
        mesh.set_point(v, p);
        break;
      }
    }
    if ((valid = std::all_of(nodes.begin(), nodes.end(), [&](Index v) { return mesh.is_valid_star(v); }))) break;
  }
  mesh.add_work(star.work());
  return valid;
}

}  // namespace

double relax_node(kernel::Mesh& mesh, Index v, Star& star) {
  if (!mesh.is_live_vertex(v) || !mesh.is_free(v)) return 0;
  const double edge = mesh.length(mesh.out(v));
  star.look_around(mesh, v);
  const Energy energy = star.energy_with_derivatives(mesh.point(v));
  if (!energy.finite) {
    // To maximise the smallest area is not always to maximise the smallest sine; what was valid has to stay valid.
    const Vec2 before = mesh.point(v);
    const bool was_valid = mesh.is_valid_star(v);
    untangle_node(mesh, v);
    // Counted at more than it costs: where very many nodes need it, smoothing is not worth the time.
    star.add_work(3 * star.elements() * star.elements() * star.elements());
    if (was_valid && !mesh.is_valid_star(v)) mesh.set_point(v, before);
    return (mesh.point(v) - before).norm() / edge;
  }
  const Vec2 start = mesh.point(v), step = direction(energy, edge);
  // Over-relaxed: with 1.3 four passes reach more than six with 1.
  constexpr double kOverRelaxation = 1.3;
  constexpr int kHalvings = 4;
  double share = kOverRelaxation;
  if (energy.is_convex()) {
    // The energy is nearly self-concordant [Nesterov94]: where Newton's decrement is small, it falls along the whole
    // step, and nothing turns over. Not proved: of 17 million such steps on random domains none failed.
    constexpr double kSureDecrement = 0.1, kNegligible = 1e-12;
    const double decrement = -energy.gradient.dot(step);
    if (decrement < kNegligible * energy.value) return 0;
    if (decrement < kSureDecrement) {
      mesh.set_point(v, start + share * step);
      return share * step.norm() / edge;
    }
  }
  for (int i = 0; i < kHalvings; ++i, share /= 2) {
    const Vec2 p = start + share * step;
    const Energy there = star.energy(p);
    if (!there.finite || !(there.value < energy.value)) continue;
    mesh.set_point(v, p);
    return share * step.norm() / edge;
  }
  return 0;
}

namespace {

/// Passes over a set of nodes until nothing moves much. Nodes near one that moved stay in the set.
///
/// The nodes are cut into blocks along a Z-curve. Those whose neighbours are all in the same block, or never move, are
/// moved block by block, side by side; then the others, one after another. Blocks do not depend on the number of
/// threads, and so nothing does.
class Passes {
 public:
  Passes(kernel::Mesh& mesh, const SmoothingOptions& options)
      : mesh_(mesh), options_(options), active_(mesh.vertex_slots(), 1) {}

  void run(const std::vector<Index>& nodes, const kernel::Budget& budget) {
    cut_into_blocks(nodes);
    constexpr int kFewest = 2;  // what follows counts on them
    for (int pass = 0; pass < options_.iterations && (pass < kFewest || !budget.is_spent()); ++pass)
      if (for_blocks([&](const std::vector<Index>& block, std::size_t& work) { return relax(block, work); }) == 0)
        break;
    wake_at_poor_faces();
    for (int pass = 0; pass < kRepairPasses; ++pass) {
      const double most_each = double(budget.left()) / double(kRepairPasses - pass) / double(nodes.size());
      for_blocks([&](const std::vector<Index>& block, std::size_t& work) {
        return raise_poor(block, most_each * double(block.size()), work);
      });
    }
  }

 private:
  static constexpr int kRepairPasses = 2;
  static constexpr std::size_t kBlock = 16384;  ///< nodes: about one in twenty is between blocks then

  void cut_into_blocks(const std::vector<Index>& nodes) {
    std::vector<Vec2> points;
    points.reserve(nodes.size());
    for (Index v : nodes) points.push_back(mesh_.point(v));
    const std::vector<Index> order = along_z_curve(points);
    block_.assign(mesh_.vertex_slots(), kNone);
    for (std::size_t i = 0; i < order.size(); ++i) block_[nodes[order[i]]] = Index(i / kBlock);
    blocks_.resize(order.size() / kBlock + 1);
    for (auto& block : blocks_) block.reserve(std::min(order.size(), kBlock));
    const std::vector<char> is_between = find_between();
    for (Index i : order) (is_between[nodes[i]] ? between_ : blocks_[block_[nodes[i]]]).push_back(nodes[i]);
  }

  /// By node: whether a face has it and a node of another block.
  std::vector<char> find_between() const {
    std::vector<char> is_between(mesh_.vertex_slots(), 0);
    for (Index f = 0; f < mesh_.face_slots(); ++f) {
      if (!mesh_.is_live_face(f)) continue;
      Index one = kNone;
      bool several = false;
      mesh_.for_nodes_of(f, [&](Index v) {
        if (block_[v] == kNone) return;
        several = several || (one != kNone && block_[v] != one);
        one = block_[v];
      });
      if (several) mesh_.for_nodes_of(f, [&](Index v) { is_between[v] = 1; });
    }
    return is_between;
  }

  /// Calls visit(block, work), which returns whether a node moved, for all blocks side by side, then for the nodes
  /// between.
  /// \return how many said so
  template <class Visit>
  int for_blocks(const Visit& visit) {
    std::vector<std::size_t> work(blocks_.size() + 1, 0);
    std::vector<char> moved(blocks_.size() + 1);
    parallel::for_each_index(blocks_.size(), [&](std::size_t b) { moved[b] = visit(blocks_[b], work[b]); });
    moved.back() = visit(between_, work.back());
    mesh_.add_work(std::accumulate(work.begin(), work.end(), std::size_t(0)));
    return int(std::count(moved.begin(), moved.end(), 1));
  }

  /// True if a node moved.
  bool relax(const std::vector<Index>& nodes, std::size_t& work) {
    bool any = false;
    Star star;
    for (Index v : nodes) {
      if (!active_[v]) continue;
      active_[v] = 0;
      const double moved = relax_node(mesh_, v, star);
      if (moved <= options_.move_tolerance) continue;
      any = true;
      wake(v);
      star.for_each_neighbour([&](Index u) { wake(u); });
    }
    work += star.work();
    return any;
  }

  /// True if a node moved.
  bool raise_poor(const std::vector<Index>& nodes, double most, std::size_t& work) {
    constexpr double kUsualWork = 500;  // of a node
    const auto count = std::count_if(nodes.begin(), nodes.end(), [&](Index v) { return active_[v]; });
    if (kUsualWork * double(count) > most) return raise_in_order(worst_first(nodes), most, work);
    return raise_in_order(nodes, most, work);
  }

  bool raise_in_order(const std::vector<Index>& nodes, double most, std::size_t& work) {
    bool any = false;
    for (Index v : nodes) {
      if (!active_[v]) continue;
      if (double(work) > most) break;
      active_[v] = 0;
      if (mesh_.is_star_above(v, options_.target_quality) || !raise_smallest_sine(mesh_, v, work)) continue;
      any = true;
      wake_around(v);
    }
    return any;
  }

  std::vector<Index> worst_first(const std::vector<Index>& nodes) const {
    std::vector<std::pair<double, Index>> sines;
    for (Index v : nodes)
      if (active_[v]) sines.emplace_back(mesh_.smallest_sine_around(v), v);
    std::sort(sines.begin(), sines.end());
    std::vector<Index> sorted;
    for (const auto& [sine, v] : sines) sorted.push_back(v);
    return sorted;
  }

  /// Activates the nodes of poor faces alone: each face is looked at once, not from all its nodes.
  void wake_at_poor_faces() {
    std::fill(active_.begin(), active_.end(), 0);
    for (Index f = 0; f < mesh_.face_slots(); ++f) {
      if (!mesh_.is_live_face(f) || mesh_.is_above(f, options_.target_quality)) continue;
      mesh_.for_nodes_of(f, [&](Index v) { wake(v); });
    }
  }

  void wake(Index v) {
    if (block_[v] != kNone) active_[v] = 1;  // a node that never moves has neighbours in several blocks
  }

  void wake_around(Index v) {
    wake(v);
    for (Index h : mesh_.around(v)) {
      wake(mesh_.target(h));
      if (mesh_.face(h) != kNone) wake(mesh_.target(mesh_.next(h)));
    }
  }

  kernel::Mesh& mesh_;
  const SmoothingOptions& options_;
  std::vector<char> active_;                ///< by node
  std::vector<Index> block_;                ///< by node; kNone: never moves
  std::vector<std::vector<Index>> blocks_;  ///< nodes that depend on their block alone
  std::vector<Index> between_;              ///< all others
};

}  // namespace

double relax_node(kernel::Mesh& mesh, Index v) {
  Star star;
  return relax_node(mesh, v, star);
}

void smooth(kernel::Mesh& mesh, const SmoothingOptions& options, const kernel::Budget& budget) {
  std::vector<Index> nodes;
  nodes.reserve(mesh.vertex_slots());
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_live_vertex(v) && mesh.is_free(v)) nodes.push_back(v);
  if (options.method == SmoothingMethod::thesis)
    smooth_by_thesis(mesh, options.thesis, nodes);
  else
    Passes(mesh, options).run(nodes, budget);
}

bool smooth_near(kernel::Mesh& mesh, const SmoothingOptions& options, std::span<const Index> nodes, int rings,
                 const std::function<bool(int)>& goes_on) {
  if (goes_on && !goes_on(0)) return false;
  std::vector<Index> around(nodes.begin(), nodes.end());
  for (int ring = 0; ring <= rings; ++ring) {
    sort_unique(around);
    if (ring == rings) break;
    const std::size_t count = around.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (is_hub(mesh, around[i])) continue;
      for (Index h : mesh.around(around[i])) {
        around.push_back(mesh.target(h));
        if (mesh.face(h) != kNone) around.push_back(mesh.target(mesh.next(h)));
      }
    }
  }
  std::erase_if(around, [&](Index v) { return !mesh.is_live_vertex(v) || !mesh.is_free(v); });
  const std::vector<Index> faces = topology::faces_around(mesh, around);
  constexpr std::size_t kWorkToGather = 6;  // for each element, from here to the last check
  mesh.add_work(kWorkToGather * faces.size());
  if (!std::all_of(faces.begin(), faces.end(), [&](Index f) { return mesh.is_valid_face(f); }))
    if (!untangle(mesh, around, options.untangling_sweeps)) return false;
  Star star;
  for (int pass = 0; pass < options.iterations; ++pass) {
    if (goes_on && pass > 0 && !goes_on(pass)) {
      mesh.add_work(star.work());
      return false;
    }
    double moved = 0;
    for (Index v : around) moved = std::max(moved, relax_node(mesh, v, star));
    if (moved < options.move_tolerance) break;
  }
  std::size_t work = star.work();
  if (!std::all_of(faces.begin(), faces.end(), [&](Index f) { return mesh.is_above(f, options.target_quality); }))
    for (Index v : around)
      if (!mesh.is_star_above(v, options.target_quality)) raise_smallest_sine(mesh, v, work);
  mesh.add_work(work);
  return std::none_of(around.begin(), around.end(), [&](Index v) { return is_on_neighbour(mesh, v); }) &&
         std::all_of(nodes.begin(), nodes.end(), [&](Index v) { return mesh.is_valid_star(v); });
}

}  // namespace qmorph::smoothing
