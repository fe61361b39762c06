// SPDX-License-Identifier: GPL-2.0-or-later
#include "front/morph.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "front/step.hpp"
#include "kernel/mark_set.hpp"

namespace qmorph::front {
namespace {

/// A front that makes more steps than this for each triangle of the input is going round in circles.
constexpr double kStepsPerTriangle = 2.25;
/// A front edge longer than this times the edges of the input ahead is split.
constexpr double kTooLong = 2.2;
/// How often base edges that were set aside are tried again.
constexpr int kMostRounds = 8;

class Morph {
 public:
  Morph(kernel::Mesh& mesh, const FrontOptions& options, bool check, Decisions* decisions)
      : mesh_(mesh),
        front_(mesh, options, decisions),
        colours_(mesh, front_),
        step_{mesh, front_, colours_, options, {}, {}, decisions},
        options_(options),
        check_(check),
        decisions_(decisions) {
    start();
  }

  /// Before run().
  void watch(const MorphSettings& settings) {
    reporter_.emplace(mesh_, front_, states_, options_.corner_angle, settings);
    if (!reporter_->is_watched()) reporter_.reset();
  }

  std::unique_ptr<FrontObserver> run(const MorphSettings& settings) {
    advance_all(settings.progress);
    if (settings.is_astray) *settings.is_astray = is_astray_;
    return reporter_ ? reporter_->finish() : nullptr;
  }

 private:
  void advance_all(const std::function<void(double)>& progress) {
    const std::size_t quads_expected = mesh_.face_slots() / 2 + 1;
    const auto most_steps = std::size_t(kStepsPerTriangle * mesh_.face_slots()) + 1000;
    for (int round = 0; round < kMostRounds; ++round) {
      const std::size_t made_before = made_;
      for (Base base; (base = next_base()).h != kNone;) {
        if (++steps_ > most_steps) {
          is_astray_ = true;
          return;
        }
        if (progress && steps_ % 4096 == 0) progress(std::min(1.0, double(made_) / double(quads_expected)));
        if (!advance(base)) set_aside(base.h);
        if (check_) check();
      }
      if (made_ == made_before) break;
      for (Index h : aside_)
        if (mesh_.is_live_half_edge(h) && front_.contains(h)) enter(h, front_.state(h));
      aside_.clear();
    }
  }

  /// Thesis 3.5.3: not selectable until something around the edge has changed.
  void set_aside(Index h) {
    is_aside_.set(h, true);
    aside_.push_back(h);
  }
  void enter(Index h, State state, bool forced = false) {
    is_aside_.set(h, false);
    front_.push(h, state, forced);
  }

  void note_sizes() {
    const std::vector<double> sizes = mesh_.mean_edges();
    for (Index v = 0; v < mesh_.vertex_slots(); ++v)
      if (mesh_.is_live_vertex(v)) step_.size.set(v, sizes[v]);
  }

  void start() {
    note_sizes();
    for (Index h = 0; h < mesh_.half_edge_slots(); ++h)
      if (mesh_.is_live_half_edge(h) && front_.contains(h) && !colours_.is_coloured(mesh_.origin(h)))
        colours_.colour_loop(h);
    states_.resize(mesh_.half_edge_slots());
    for (Index h = 0; h < mesh_.half_edge_slots(); ++h)
      if (mesh_.is_live_half_edge(h) && front_.contains(h)) front_.push(h, states_[h] = front_.state(h), false);
  }

  void check() const {
    if (const auto defects = find_defects(mesh_); !defects.empty())
      throw std::logic_error("advancing front: " + defects[0]);
  }

  /// Thesis 3.5.2: the queue's first, or a much shorter neighbour of it unless it is in state 1-1.
  Base next_base() {
    const Index h = front_.pop();
    if (h == kNone) return {};
    const Base first = front_.look_at(h);
    if (front_.was_forced() || first.state.corners() == 2) return first;
    Index shortest = h;
    const double length = mesh_.length(h);
    double least = length / options_.transition_ratio;
    for (Index n : {first.before, first.after}) {
      if (is_aside_[n]) continue;
      const double other = mesh_.length(n);
      if (decisions_) decisions_->transition.note(length / other, other >= length / options_.transition_ratio);
      if (other < least) shortest = n, least = other;
    }
    if (shortest == h) return first;
    front_.push(h);
    return front_.look_at(shortest);
  }

  /// One base edge: a special case, a small loop or a quad. False if the edge has to be set aside.
  bool advance(const Base& base) {
    const bool forced = front_.was_forced();
    base_origin_ = mesh_.origin(base.h), base_target_ = mesh_.target(base.h);
    if (!forced && (special_case(base, base.before, base.h) || special_case(base, base.h, base.after))) return true;
    if (!forced && refine(base.h)) return true;
    if (const SmallLoop loop = find_small_loop(step_, base); loop.size != 0)
      if (attempt(StepKind::small_loop, [&] { return close_small_loop(step_, loop); })) return true;
    return attempt(StepKind::quad, [&] { return make_quad(base); });
  }

  /// Runs a step in a transaction and brings the front up to date if it succeeded.
  template <class Operation>
  bool attempt(StepKind kind, const Operation& operation) {
    begin();
    step_.moved.clear();
    step_.notes = {};
    joins_.clear();
    if (!operation()) {
      rollback();
      return false;
    }
    commit();
    made_ += kind != StepKind::transition_split && kind != StepKind::refinement;
    for (const auto& [a, b] : joins_) join(a, b);
    reclassify();
    if (reporter_) reporter_->report({kind, base_origin_, base_target_, step_.notes, edges_});
    return true;
  }

  void begin() { mesh_.begin(), front_.levels().begin(), colours_.labels().begin(), step_.size.begin(); }
  void commit() { mesh_.commit(), front_.levels().commit(), colours_.labels().commit(), step_.size.commit(); }
  void rollback() { mesh_.rollback(), front_.levels().rollback(), colours_.labels().rollback(), step_.size.rollback(); }

  void join(Index a, Index b) {
    if (!mesh_.is_live_vertex(a) || !mesh_.is_live_vertex(b)) return;
    Index loop = kNone;
    for (Index h : mesh_.around(a))
      if (front_.contains(h)) loop = h;
    colours_.join(a, b, loop);
  }

  /// Enters anew the front edges whose states may have changed: those at nodes that moved, and the next to those.
  void reclassify() {
    moved_.clear(), touched_.clear(), edges_.clear();
    states_.resize(mesh_.half_edge_slots());
    std::erase_if(step_.moved, [&](Index v) { return !moved_.insert(v); });
    for (Index v : step_.moved) {
      if (!mesh_.is_live_vertex(v) || !colours_.is_coloured(v)) continue;
      front_.for_wedges_at(v, [&](Index in, Index out) {
        note_corner(in, out);
        touch(out);
        if (!moved_.contains(mesh_.target(out))) {
          const Index next = front_.next(out);
          note_corner(out, next), touch(next);
        }
        touch(in);
        if (!moved_.contains(mesh_.origin(in))) {
          const Index prev = front_.prev(in);
          note_corner(prev, in), touch(prev);
        }
      });
    }
    for (Index h : edges_) enter(h, states_[h]);
    if (forced_ != kNone && front_.contains(forced_)) enter(forced_, {}, true);
    forced_ = kNone;
  }

  void touch(Index h) {
    if (touched_.insert(h / 2)) edges_.push_back(h);  // of an edge's two sides one at most is on the front
  }
  /// Notes what the node between two front edges is in the states of both.
  void note_corner(Index in, Index out) { states_[in].right = states_[out].left = front_.is_corner(in, out); }

  /// Seam, transition seam or transition split at one end of the base edge, between the front edges in and out. Thesis
  /// 2.2.4.
  bool special_case(const Base& base, Index in, Index out) {
    if (in == out || Mesh::twin(in) == out) return false;
    const double l1 = mesh_.length(in), l2 = mesh_.length(out);
    const bool transition = is_transition(l1, l2);
    if (!transition && mesh_.is_boundary(mesh_.target(in))) return false;  // where no seam is possible
    if (is_seam(in, out)) {
      if (transition) return attempt(StepKind::transition_seam, [&] { return transition_seam(step_, in, out); });
      return attempt(StepKind::seam, [&] { return seam(step_, in, out); });
    }
    if (!transition || base.state.corners() == 2) return false;
    return split(StepKind::transition_split, l1 > l2 ? in : out, mesh_.target(in));
  }

  bool split(StepKind kind, Index longer, Index k) {
    return attempt(kind, [&] { return (forced_ = transition_split(step_, longer, k)) != kNone; });
  }

  /// Where the input gets finer than the front, the front has to follow, whatever its neighbours' lengths.
  bool refine(Index base) {
    const Index apex = mesh_.target(mesh_.next(base)), from = mesh_.origin(base), to = mesh_.target(base);
    const double size = std::min({step_.size[from], step_.size[to], step_.size[apex]});
    if (mesh_.length(base) < kTooLong * size) return false;
    return split(StepKind::refinement, base, step_.size[from] < step_.size[to] ? from : to);
  }

  bool is_transition(double l1, double l2) const {
    const double longer = std::max(l1, l2), shorter = std::min(l1, l2);
    const bool is_transition = longer > options_.transition_ratio * shorter;
    if (decisions_) decisions_->transition.note(longer / shorter, !is_transition);
    return is_transition;
  }

  bool is_seam(Index in, Index out) const {
    const double most = std::max(options_.seam_angle, options_.seam_angle_many);
    if (!front_.is_angle_below(in, out, most)) {  // nearly always
      if (decisions_) decisions_->seam.note(most, false), decisions_->seam_many.note(most, false);
      return false;
    }
    const bool has_many = has_many_quads(mesh_.target(in));
    const double angle = front_.angle_between(in, out);
    const bool is_seam = angle < (has_many ? options_.seam_angle_many : options_.seam_angle);
    if (decisions_) (has_many ? decisions_->seam_many : decisions_->seam).note(angle, is_seam);
    return is_seam;
  }

  bool has_many_quads(Index v) const {
    int quads = 0;
    for (Index h : mesh_.around(v)) quads += mesh_.is_quad(mesh_.face(h));
    return quads >= 5;
  }

  /// How many quads should share the angle at a node of the front; the side edge is one of their angles away from the
  /// base edge.
  static double quads_in(double angle) { return std::max(2.0, std::round(angle / (0.5 * std::numbers::pi))); }

  bool make_quad(const Base& at) {
    const auto& [base, before, after, state] = at;
    if (before == after) return false;  // a loop of two
    const Index n0 = mesh_.origin(base), n1 = mesh_.target(base);
    // The reused sides first: what the other side makes must not end there.
    Index left = state.left ? before : kNone;   // half-edges of the ring: left N2 -> N0,
    Index right = state.right ? after : kNone;  // right N1 -> N3
    if (left == kNone) {
      const double angle = front_.angle_left(base);
      const Taken taken{right == kNone ? kNone : mesh_.target(right), right};
      const Index side = define_side_edge(step_, {before, base, angle / quads_in(angle)}, taken);
      if (side == kNone) return false;
      note_join(n0, mesh_.target(side));
      left = Mesh::twin(side);
      step_.notes.left = step_.notes.side;
    }
    if (right == kNone) {
      const Index following = front_.next(base);
      const double angle = front_.angle_between(base, following);
      const Taken taken{mesh_.origin(left), left};
      right = define_side_edge(step_, {base, following, angle - angle / quads_in(angle)}, taken);
      if (right == kNone) return false;
      note_join(n1, mesh_.target(right));
      step_.notes.right = step_.notes.side;
    }
    step_.notes.met_front = !joins_.empty();
    const Index n2 = mesh_.origin(left), n3 = mesh_.target(right);
    if (n2 == n3 || n2 == n1 || n3 == n0) return false;
    const Index top = recover_edge(step_, left, n3);  // N2 -> N3
    if (top == kNone) return false;
    const unsigned level = front_.level(base) + 1;
    const std::array<Index, 4> ring{base, right, Mesh::twin(top), left};
    const Index quad = form_face(step_, ring, kMostTrianglesInQuad);
    if (quad == kNone) return false;
    finish_quad(quad, ring, level);
    return mesh_.is_valid_face(quad);
  }

  void note_join(Index a, Index b) {
    if (colours_.is_coloured(b)) joins_.emplace_back(a, b);
  }

  void finish_quad(Index quad, const std::array<Index, 4>& ring, unsigned level) {
    const Index n0 = mesh_.origin(ring[0]), n1 = mesh_.origin(ring[1]), n3 = mesh_.origin(ring[2]),
                n2 = mesh_.origin(ring[3]);
    if (!colours_.is_coloured(n2)) colours_.colour_opposite(n2, n0);
    if (!colours_.is_coloured(n3)) colours_.colour_opposite(n3, n1);
    note_join(n2, n3);
    for (Index h : ring)
      if (front_.contains(Mesh::twin(h))) front_.set_level(Mesh::twin(h), level);
    step_.moved.insert(step_.moved.end(), {n0, n1, n2, n3});
    smooth_around(step_, quad);
  }

  static constexpr std::size_t kMostTrianglesInQuad = 64;

  kernel::Mesh& mesh_;
  Front front_;
  LoopColours colours_;
  Step step_;
  FrontOptions options_;
  bool check_;
  Decisions* decisions_;
  std::size_t steps_ = 0;
  std::size_t made_ = 0;  ///< steps that were no splits
  bool is_astray_ = false;
  LoggedColumn<bool> is_aside_;
  std::vector<Index> aside_;
  std::vector<State> states_;  ///< of front edges, by half-edge, as they were last looked at
  kernel::MarkSet moved_, touched_;
  std::vector<Index> edges_;  ///< to enter anew
  std::vector<std::pair<Index, Index>> joins_;
  Index forced_ = kNone;
  std::optional<StepReporter> reporter_;  ///< if anybody watches
  Index base_origin_ = kNone, base_target_ = kNone;
};

}  // namespace

std::unique_ptr<FrontObserver> morph(kernel::Mesh& mesh, const FrontOptions& options, const MorphSettings& settings) {
  Morph morph(mesh, options, settings.check_each_step, settings.decisions);
  if (settings.observer) morph.watch(settings);
  return morph.run(settings);
}

}  // namespace qmorph::front
