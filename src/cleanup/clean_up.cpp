#include "cleanup/clean_up.hpp"

#include <algorithm>
#include <deque>

#include "cleanup/operations.hpp"
#include "smoothing/smooth.hpp"
#include "smoothing/untangle.hpp"
#include "topology/edits.hpp"

namespace qmorph::cleanup {
namespace {

/// A change may lower the smallest sine around it, but not under this (unless it was lower before).
constexpr double kFloor = 0.4;
constexpr int kRings = 2;

class CleanUp {
 public:
  CleanUp(kernel::Mesh& mesh, const SmoothingOptions& smoothing)
      : mesh_(mesh), score_(mesh), relaxing_(smoothing) {
    relaxing_.iterations = 5;
  }

  std::size_t run() {
    for (Index v = 0; v < mesh_.vertex_slots(); ++v) enqueue(v);
    std::size_t most = 4 * mesh_.vertex_slots() + 1000;
    while (!queue_.empty() && most-- > 0) {
      const Index v = queue_.front();
      queue_.pop_front();
      queued_[v] = 0;
      if (mesh_.is_live_vertex(v) && score_.excess(v) != 0) improve(v);
    }
    return changes_;
  }

 private:
  void enqueue(Index v) {
    if (v >= queued_.size()) queued_.resize(mesh_.vertex_slots() + 1, 0);
    if (queued_[v] || !mesh_.is_live_vertex(v) || score_.excess(v) == 0) return;
    queued_[v] = 1;
    queue_.push_back(v);
  }

  void improve(Index v) {
    for (const Candidate& c : candidates_around(mesh_, score_, v, 1)) {
      if (!attempt(c)) continue;
      ++changes_;
      for (Index u : nodes_)
        if (mesh_.is_live_vertex(u)) {
          enqueue(u);
          Index h = mesh_.out(u);
          do {
            enqueue(mesh_.target(h));
            h = mesh_.rotate_ccw(h);
          } while (h != mesh_.out(u));
        }
      return;
    }
  }

  double worst_around(const std::vector<Index>& nodes) const {
    double worst = 1;
    for (Index v : nodes)
      if (mesh_.is_live_vertex(v)) worst = std::min(worst, smoothing::smallest_sine_around(mesh_, v));
    return worst;
  }

  bool attempt(const Candidate& c) {
    nodes_.clear();
    mesh_.begin();
    const bool kept = change(c);
    kept ? mesh_.commit() : mesh_.rollback();
    return kept;
  }

  bool change(const Candidate& c) {
    std::vector<Index> around;
    collect(c, around);
    const double before = worst_around(around);
    if (!apply(mesh_, c, nodes_)) return false;
    topology::remove_doublets(mesh_, nodes_);
    if (!smoothing::smooth_near(mesh_, relaxing_, nodes_, kRings)) return false;
    return worst_around(nodes_) >= std::min(before, kFloor);
  }

  void collect(const Candidate& c, std::vector<Index>& around) const {
    for (Index h : {c.h, kernel::Mesh::twin(c.h), c.k})
      if (h != kNone && mesh_.face(h) != kNone)
        for (Index v : topology::nodes_of(mesh_, mesh_.face(h))) around.push_back(v);
  }

  kernel::Mesh& mesh_;
  Score score_;
  SmoothingOptions relaxing_;
  std::deque<Index> queue_;
  std::vector<char> queued_;
  std::vector<Index> nodes_;
  std::size_t changes_ = 0;
};

}  // namespace

std::size_t clean_up(kernel::Mesh& mesh, const SmoothingOptions& smoothing) {
  return CleanUp(mesh, smoothing).run();
}

}  // namespace qmorph::cleanup
