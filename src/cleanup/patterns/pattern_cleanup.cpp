// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/patterns/pattern_cleanup.hpp"

#include <algorithm>
#include <numeric>
#include <ranges>
#include <utility>

#include "cleanup/patterns/match.hpp"
#include "cleanup/attempt.hpp"
#include "kernel/sort_unique.hpp"

namespace qmorph::cleanup {
namespace {

using kernel::Mesh;

constexpr int kRings = 2;
/// A change for the sake of valences may lower the smallest sine around it, but not under this.
constexpr double kFloor = 0.4;

/// A change for the sake of shapes must pay: a slightly better corner is not worth irregular nodes.
bool is_clearly_better(double before, double after) {
  constexpr double kFactor = 1.5, kStep = 0.1;
  return after > kFactor * before && after > before + std::min(kStep, before);
}

/// Inner angle of the element at the node of a half-edge of its outline.
double angle_at(const Mesh& mesh, Index h) { return ccw_angle(mesh.vector(h), -mesh.vector(mesh.prev(h))); }

/// The same, compared with a limit: quick, since almost all angles are convex.
class AngleLimit {
 public:
  explicit AngleLimit(double limit) : limit_(limit), cosine_(std::cos(limit)) {}
  bool is_exceeded(const Mesh& mesh, Index h) const {
    const Vec2 a = mesh.vector(h), b = -mesh.vector(mesh.prev(h));
    if (cross(a, b) > 0)
      return limit_ < std::numbers::pi && a.dot(b) < cosine_ * std::sqrt(a.squaredNorm() * b.squaredNorm());
    return ccw_angle(a, b) > limit_;
  }

 private:
  double limit_, cosine_;
};

/// The two places where a composition for the corner at origin(h) can start: the second one in the mirror.
std::array<std::pair<Dart, bool>, 2> places_at(const Mesh& mesh, Index h) {
  return {{{Dart{h, false}, false}, {Dart{mesh.prev(h), true}, true}}};
}

std::vector<Pattern> read(std::span<const Case> cases) {
  std::vector<Pattern> patterns;
  for (const Case& c : cases) patterns.emplace_back(c);
  return patterns;
}

/// Tries compositions and keeps those that make the mesh better.
class Trial {
 public:
  Trial(Mesh& mesh, const SmoothingOptions& smoothing, int iterations)
      : mesh_(mesh), score_(mesh), relaxing_(smoothing) {
    relaxing_.iterations = iterations;
    relaxing_.untangling_sweeps = std::min(relaxing_.untangling_sweeps, 8);  // what needs more is no improvement
  }

  /// `near` are the nodes whose elements a composition from this dart changes, or more.
  template <class Accept>
  bool attempt_at(Dart dart, std::string_view composition, bool mirrored, const std::vector<Index>& near,
                  const Accept& accept) {
    collect_score_nodes(near);
    int cost = 0;
    for (Index v : scored_) cost += score_.cost(v);
    const auto edit = [&](std::vector<Index>& nodes) {
      if (!run(mesh_, dart, composition, mirrored, nodes)) return false;
      for (Index v : nodes)
        if (mesh_.is_live_vertex(v) && !std::binary_search(scored_.begin(), scored_.end(), v)) made_.push_back(v);
      nodes.insert(nodes.end(), near.begin(), near.end());
      return true;
    };
    made_.clear();
    const bool kept =
        attempt(mesh_, relaxing_, kRings, near, nodes_, edit, [&](const Worth& before, const Worth& after) {
          sort_unique(made_);
          int gain = cost;
          for (const auto* some : {&scored_, &made_})
            for (Index v : *some)
              if (mesh_.is_live_vertex(v)) gain -= score_.cost(v);
          return accept(before.worst, after.worst, gain);
        });
    if (kept) ++changes_;
    return kept;
  }

  /// The nodes around the last change.
  const std::vector<Index>& nodes() const { return nodes_; }
  std::size_t changes() const { return changes_; }
  const Score& score() const { return score_; }

 private:
  /// `near` and the nodes of the elements around: everything whose valence can change.
  void collect_score_nodes(const std::vector<Index>& near) {
    scored_ = near;
    for (Index v : near) {
      for (Index h : mesh_.around(v)) {
        scored_.push_back(mesh_.target(h));
        if (mesh_.face(h) != kNone) scored_.push_back(mesh_.target(mesh_.next(h)));
      }
    }
    sort_unique(scored_);
  }

  Mesh& mesh_;
  Score score_;
  SmoothingOptions relaxing_;
  std::vector<Index> nodes_, scored_, made_;
  std::size_t changes_ = 0;
};

/// Nodes of a face and of its neighbours across edges: what a composition at a corner of it changes.
std::vector<Index> nodes_beside(const Mesh& mesh, Index f) {
  std::vector<Index> nodes;
  for (Index h : mesh.sides_of(f)) {
    const Index beyond = mesh.face(Mesh::twin(h));
    if (beyond != kNone)
      for (Index v : topology::nodes_of(mesh, beyond)) nodes.push_back(v);
    nodes.push_back(mesh.origin(h));
  }
  sort_unique(nodes);
  return nodes;
}

bool has_fan(const Mesh& mesh, const std::vector<Index>& nodes) {
  return std::any_of(nodes.begin(), nodes.end(), [&](Index v) { return mesh.valence(v) > kMostValence; });
}

/// Round by round over nodes; a round leaves the nodes that the next one has to look at.
class Rounds {
 public:
  Rounds(Mesh& mesh, const CleanupOptions& options, const SmoothingOptions& smoothing, const kernel::Budget& budget)
      : mesh_(mesh), options_(options), budget_(budget), valence_(mesh), trial_(mesh, smoothing, 3) {}

  void run_connectivity() {
    const std::vector<Pattern> patterns = read(connectivity_cases());
    run([&](Index v) { resolve(v, patterns); });
  }

  void run_boundary() {
    std::vector<Pattern> patterns;
    if (options_.boundary_cases) patterns = read(boundary_cases());
    run([&](Index v) {
      if (options_.boundary_cases) resolve(v, patterns);
      if (options_.transition_cases) make_transition(v);
      if (options_.diamond_cases) close_diamonds(v);
    });
  }

  void run_shape() {
    const AngleLimit limit(options_.shape_angle);
    run([&](Index v) { mend_large_angle(v, limit); });
  }

  std::size_t changes() const { return trial_.changes(); }

 private:
  template <class Visit>
  void run(const Visit& visit) {
    std::vector<Index> nodes(mesh_.vertex_slots());
    std::iota(nodes.begin(), nodes.end(), Index(0));
    for (int round = 0; round < options_.pattern_rounds && !nodes.empty(); ++round) {
      changed_.clear();
      for (Index v : nodes)
        if (mesh_.is_live_vertex(v) && !budget_.is_spent()) visit(v);
      sort_unique(changed_);
      std::swap(nodes, changed_);
    }
  }

  void note_change() {
    for (Index v : trial_.nodes()) {
      if (!mesh_.is_live_vertex(v)) continue;
      changed_.push_back(v);
      for (Index h : mesh_.around(v)) changed_.push_back(mesh_.target(h));
    }
  }

  bool is_worth_it(double before, double after, int gain) const {
    return (gain > 0 && after >= std::min(before, kFloor)) || is_clearly_better(before, after);
  }

  void resolve(Index v, const std::vector<Pattern>& patterns) {
    if (mesh_.valence(v) > kMostValence || !read_ring(mesh_, valence_, v, ring_)) return;
    std::vector<Index> near = ring_.nodes;
    near.push_back(v);
    if (has_fan(mesh_, near)) return;
    const Ring mirror = mirrored(mesh_, ring_);
    for (const Pattern& pattern : patterns)
      for (const Ring* ring : {&std::as_const(ring_), &mirror})
        for (int i = -1; (i = find_match(mesh_, pattern, *ring, i + 1)) >= 0;) {
          const bool kept = trial_.attempt_at(
              ring->darts[i], pattern.source->composition, ring->mirrored, near,
              [&](double before, double after, int gain) { return gain > 0 && after >= std::min(before, kFloor); });
          if (!kept) continue;
          note_change();
          return;  // the ring is another one now
        }
  }

  /// Tries the cases at the corner of an element, in both directions.
  template <std::ranges::range Cases>
  bool try_corner(Index h, const Cases& cases, int boundary_edges) {
    const std::vector<Index> near = nodes_beside(mesh_, mesh_.face(h));
    if (has_fan(mesh_, near)) return false;
    for (const ShapeCase& c : cases)
      for (const auto& [dart, in_mirror] : places_at(mesh_, h)) {
        if (c.boundary_edges != boundary_edges) continue;
        if (!trial_.attempt_at(dart, c.composition, in_mirror, near,
                               [&](double before, double after, int gain) { return is_worth_it(before, after, gain); }))
          continue;
        note_change();
        return true;
      }
    return false;
  }

  void make_transition(Index v) {
    if (!mesh_.is_boundary(v) || mesh_.valence(v) != 2) return;
    const Index h = mesh_.rotate_ccw(mesh_.out(v));
    if (mesh_.is_quad(mesh_.face(h)) && AngleLimit(options_.transition_angle).is_exceeded(mesh_, h))
      try_corner(h, transition_cases(), 2);
  }

  void close_diamonds(Index v) {
    if (!mesh_.is_boundary(v)) return;
    const Index last = mesh_.out(v);
    for (Index h = mesh_.rotate_ccw(last); h != last; h = mesh_.rotate_ccw(h)) {
      const Index f = mesh_.face(h);
      if (!mesh_.is_quad(f)) continue;
      const Index a = mesh_.target(h), o = mesh_.target(mesh_.next(h)), b = mesh_.origin(mesh_.prev(h));
      if (mesh_.is_boundary(a) || mesh_.is_boundary(o) || mesh_.is_boundary(b)) continue;
      // The inequality of thesis 3.6.4.
      const int va = valence_(a), vb = valence_(b);
      if (std::abs(4 - (va + vb - 2)) > std::max(std::abs(4 - va), std::abs(4 - vb))) continue;
      static constexpr std::array kDiamond = {ShapeCase{"boundary diamond", 0, "04"}};
      if (try_corner(h, kDiamond, 0)) return;
    }
  }

  void mend_large_angle(Index v, const AngleLimit& limit) {
    for (Index h : mesh_.around(v)) {
      if (mesh_.is_quad(mesh_.face(h)) && limit.is_exceeded(mesh_, h)) {
        const int boundary_edges = mesh_.is_boundary_edge(h) + mesh_.is_boundary_edge(mesh_.prev(h));
        if (try_corner(h, large_angle_cases(), boundary_edges)) return;
      }
    }
  }

  Mesh& mesh_;
  const CleanupOptions& options_;
  const kernel::Budget& budget_;
  GlossaryValence valence_;
  Trial trial_;
  std::vector<Index> changed_;
  Ring ring_;
};

/// A quad's corner over the limit, or kNone.
Index find_chevron_corner(const Mesh& mesh, Index f, const AngleLimit& limit) {
  if (!mesh.is_live_face(f) || mesh.degree(f) != 4) return kNone;
  for (Index h : mesh.sides_of(f))
    if (limit.is_exceeded(mesh, h)) return h;
  return kNone;
}

/// Compositions of the thesis, as digits of `composition.hpp`.
constexpr std::string_view kFill3 = "0105", kFill4 = "0106";

/// Figures 3.6, 3.7: with fill_3 the node where the neighbour is joined keeps one corner, which may be a chevron again;
/// fill_4 divides it. `dart` is at the chevron's corner.
bool needs_fill_4(const Mesh& mesh, const Dart& dart, double angle) {
  const Index side = dart.at_target ? mesh.prev(dart.h) : mesh.next(dart.h);  // from, or to, the node n1 of the figure
  const Index t = Mesh::twin(side);
  if (mesh.face(t) == kNone) return false;
  const double here = angle_at(mesh, dart.at_target ? dart.h : side);
  const double there = angle_at(mesh, dart.at_target ? t : mesh.next(t));
  return here + there > angle;
}

/// Gets rid of chevrons one by one, each in the first way that makes the mesh there better.
class EliminatingChevrons {
 public:
  EliminatingChevrons(Mesh& mesh, double angle, const SmoothingOptions& smoothing)
      : mesh_(mesh), angle_(angle), limit_(angle), trial_(mesh, smoothing, std::max(smoothing.iterations, 12)) {}

  void run(const kernel::Budget& budget) {
    const Index faces = mesh_.face_slots();  // those that a change makes are not looked at again
    for (Index f = 0; f < faces && !budget.is_spent(); ++f)
      if (const Index corner = find_chevron_corner(mesh_, f, limit_); corner != kNone) eliminate(f, corner);
  }
  std::size_t changes() const { return trial_.changes(); }

 private:
  void eliminate(Index f, Index corner) {
    const std::vector<Index> near = nodes_beside(mesh_, f);
    if (has_fan(mesh_, near)) return;
    const auto attempt = [&](Dart dart, std::string_view composition, bool mirrored) {
      const auto is_better = [](double before, double after, int) { return after > 0 && after > before; };
      return trial_.attempt_at(dart, composition, mirrored, near, is_better);
    };
    // Without any composition: moving the node may do.
    if (mesh_.is_free(mesh_.origin(corner)) && attempt({corner, false}, "", false)) return;
    // On either side, fill_4 where it is needed and fill_3 elsewhere; then the other one.
    for (const bool is_fallback : {false, true})
      for (const auto& [dart, mirrored] : places_at(mesh_, corner)) {
        const bool takes_fill_4 = needs_fill_4(mesh_, dart, angle_) != is_fallback;
        if (attempt(dart, takes_fill_4 ? kFill4 : kFill3, mirrored)) return;
      }
  }

  Mesh& mesh_;
  double angle_;
  AngleLimit limit_;
  Trial trial_;
};

}  // namespace

std::size_t eliminate_chevrons(Mesh& mesh, const CleanupOptions& options, const SmoothingOptions& smoothing,
                               const kernel::Budget& budget) {
  EliminatingChevrons eliminating(mesh, options.chevron_angle, smoothing);
  eliminating.run(budget);
  return eliminating.changes();
}

std::size_t clean_up_connectivity(Mesh& mesh, const CleanupOptions& options, const SmoothingOptions& smoothing,
                                  const kernel::Budget& budget) {
  Rounds rounds(mesh, options, smoothing, budget);
  if (options.connectivity_cases) rounds.run_connectivity();
  return rounds.changes();
}

std::size_t clean_up_boundary(Mesh& mesh, const CleanupOptions& options, const SmoothingOptions& smoothing,
                              const kernel::Budget& budget) {
  Rounds rounds(mesh, options, smoothing, budget);
  rounds.run_boundary();
  return rounds.changes();
}

std::size_t clean_up_shape(Mesh& mesh, const CleanupOptions& options, const SmoothingOptions& smoothing,
                           const kernel::Budget& budget) {
  Rounds rounds(mesh, options, smoothing, budget);
  if (options.shape_cases) rounds.run_shape();
  return rounds.changes();
}

}  // namespace qmorph::cleanup
