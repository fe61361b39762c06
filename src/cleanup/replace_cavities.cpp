#include "cleanup/replace_cavities.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>

#include "cleanup/cavity.hpp"
#include "cleanup/filling.hpp"
#include "cleanup/transaction.hpp"

namespace qmorph::cleanup {
namespace {

constexpr std::size_t kMostQuads = 60;
constexpr int kMostGrowth = 4;
constexpr int kMostCorners = 9;
constexpr double kFloor = 0.4;
constexpr double kMeanLoss = 0.02;
constexpr int kRings = 2;

struct Choice {
  Filling filling;
  double cost;    ///< of the valences
  double misfit;  ///< how far the angles of the outline are from those that the filling asks for
};

/// What each place of an outline costs as a side and as a corner of a filling.
class Places {
 public:
  Places(const kernel::Mesh& mesh, const Score& score, const Cavity& cavity) {
    const auto& outline = cavity.outline();
    const std::size_t n = outline.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Index v = mesh.origin(outline[i]);
      const int corner = cavity.outer_edges()[i] - score.ideal(v), side = corner + 1;
      const bool doublet = mesh.is_free(v) && cavity.outer_edges()[i] < 3;
      const Vec2 next = mesh.vector(outline[i]), back = -mesh.vector(outline[(i + n - 1) % n]);
      double angle = ccw_angle(next, back);
      if (angle <= 0) angle += 2 * std::numbers::pi;
      const double off_side = angle / std::numbers::pi - 1, off_corner = angle / std::numbers::pi - 0.5;
      base_cost += side * side;
      base_misfit += off_side * off_side;
      cost.push_back(doublet ? kForbidden : corner * corner - side * side);
      misfit.push_back(off_corner * off_corner - off_side * off_side);
    }
  }

  static constexpr double kForbidden = 1e6;
  double base_cost = 0, base_misfit = 0;
  std::vector<double> cost, misfit;  ///< of a corner, over that of a side
};

class Chooser {
 public:
  Chooser(const Places& places, double limit, double wanted)
      : places_(places), n_(int(places.cost.size())), limit_(limit), wanted_(wanted) {}

  std::vector<Choice> choices() {
    for (int i = 0; i < n_ / 2; ++i)
      for (int a = 1; a < n_ / 2; ++a) offer({i, i + a, i + n_ / 2, i + n_ / 2 + a});
    std::vector<int> likely = likely_corners();
    std::vector<int> picked;
    pick(likely, 0, 3, picked);
    pick(likely, 0, 5, picked);
    std::stable_sort(found_.begin(), found_.end(), [](const Choice& a, const Choice& b) {
      return a.cost + kMisfitWeight * a.misfit < b.cost + kMisfitWeight * b.misfit;
    });
    return std::move(found_);
  }

 private:
  static constexpr double kMisfitWeight = 1;
  static constexpr double kFewest = 0.75, kMost = 1.4;

  std::vector<int> likely_corners() const {
    std::vector<int> all(n_);
    for (int i = 0; i < n_; ++i) all[i] = i;
    const auto weight = [&](int i) { return places_.cost[i] + kMisfitWeight * places_.misfit[i]; };
    std::stable_sort(all.begin(), all.end(), [&](int i, int j) { return weight(i) < weight(j); });
    if (all.size() > kMostCorners) all.resize(kMostCorners);
    std::sort(all.begin(), all.end());
    return all;
  }

  void pick(const std::vector<int>& likely, std::size_t from, int left, std::vector<int>& picked) {
    if (left == 0) return offer(picked);
    for (std::size_t i = from; i + left <= likely.size(); ++i) {
      picked.push_back(likely[i]);
      pick(likely, i + 1, left - 1, picked);
      picked.pop_back();
    }
  }

  void offer(const std::vector<int>& corners) {
    Choice choice;
    choice.cost = places_.base_cost + (corners.size() == 4 ? 0 : 1);
    choice.misfit = places_.base_misfit;
    for (int c : corners) choice.cost += places_.cost[c], choice.misfit += places_.misfit[c];
    if (choice.cost > limit_) return;
    if (const auto filling = filling_between(corners, n_)) {
      const double ratio = quads_of(*filling, n_) / wanted_;
      if (ratio < kFewest || ratio > kMost) return;
      choice.filling = *filling;
      found_.push_back(choice);
    }
  }

  const Places& places_;
  int n_;
  double limit_;
  double wanted_;
  std::vector<Choice> found_;
};

class Replacing {
 public:
  Replacing(kernel::Mesh& mesh, const SmoothingOptions& smoothing)
      : mesh_(mesh), score_(mesh), cavity_(mesh), relaxing_(smoothing) {
    relaxing_.iterations = 4;
    relaxing_.untangling_sweeps = 8;
  }

  std::size_t run() {
    size_.resize(mesh_.vertex_slots());
    for (Index v = 0; v < mesh_.vertex_slots(); ++v)
      if (mesh_.is_live_vertex(v)) size_[v] = mesh_.mean_edge(v);
    for (Index v = 0; v < mesh_.vertex_slots(); ++v) enqueue(v);
    std::size_t most = 4 * mesh_.vertex_slots() + 1000;
    while (!queue_.empty() && most-- > 0) {
      const Index v = queue_.front();
      queue_.pop_front();
      queued_[v] = 0;
      if (is_defect(v)) improve(v);
    }
    return changes_;
  }

 private:
  bool is_defect(Index v) const {
    return mesh_.is_live_vertex(v) && mesh_.is_free(v) && score_.excess(v) != 0;
  }

  void enqueue(Index v) {
    if (v >= queued_.size()) queued_.resize(mesh_.vertex_slots() + 1, 0);
    if (queued_[v] || !is_defect(v)) return;
    queued_[v] = 1;
    queue_.push_back(v);
  }

  void improve(Index v) {
    if (mesh_.valence(v) > kMostValence || !cavity_.start(v)) return;
    for (int step = 0; step < kMostGrowth; ++step) {
      if (replace()) {
        ++changes_;
        for (Index u : nodes_)
          if (mesh_.is_live_vertex(u)) enqueue(u);
        return;
      }
      if (!cavity_.grow(kMostQuads)) return;
    }
  }

  bool replace() {
    const Places places(mesh_, score_, cavity_);
    double before = 0;
    std::vector<Index> near = cavity_.inner_nodes();
    for (Index h : cavity_.outline()) near.push_back(mesh_.origin(h));
    for (Index v : near) before += score_.cost(v);
    double wanted = 0, mean_size = 0;
    for (Index f : cavity_.faces()) {
      double area = 0, size = 0;
      Index h = mesh_.half_edge(f);
      const Vec2 p = mesh_.point(mesh_.origin(h));
      for (int i = 0; i < 4; ++i, h = mesh_.next(h)) {
        area += 0.5 * cross(mesh_.point(mesh_.origin(h)) - p, mesh_.point(mesh_.target(h)) - p);
        size += 0.25 * size_[mesh_.origin(h)];
      }
      wanted += area / (size * size);
    }
    for (Index v : near) mean_size += size_[v] / double(near.size());
    constexpr int kMostTries = 2;
    int tries = 0;
    for (const Choice& choice : Chooser(places, before - 1, wanted).choices()) {
      if (++tries > kMostTries) return false;
      if (attempt(
              mesh_, relaxing_, kRings, near, nodes_,
              [&](std::vector<Index>& nodes) {
                return fill(mesh_, cavity_.outline(), cavity_.faces(), choice.filling, nodes);
              },
              [](const Worth& was, const Worth& is) {
                return is.worst >= std::min(was.worst, kFloor) && is.mean >= was.mean - kMeanLoss;
              })) {
        size_.resize(mesh_.vertex_slots(), mean_size);
        for (Index v : nodes_)
          if (std::find(near.begin(), near.end(), v) == near.end()) size_[v] = mean_size;
        return true;
      }
    }
    return false;
  }

  kernel::Mesh& mesh_;
  Score score_;
  Cavity cavity_;
  SmoothingOptions relaxing_;
  std::deque<Index> queue_;
  std::vector<char> queued_;
  std::vector<Index> nodes_;
  std::vector<double> size_;
  std::size_t changes_ = 0;
};

}  // namespace

std::size_t replace_cavities(kernel::Mesh& mesh, const SmoothingOptions& smoothing) {
  return Replacing(mesh, smoothing).run();
}

}  // namespace qmorph::cleanup
