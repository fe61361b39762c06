// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/filling_choice.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>
#include <span>

namespace qmorph::cleanup {
namespace {

/// Three and five corners are looked for among so many places of the outline.
constexpr std::size_t kLikelyCorners = 9;
/// Four corners are looked for everywhere on an outline that is no longer than this.
constexpr int kShortOutline = 100;

constexpr int kForbidden = 1'000'000;

/// Score of the new nodes: one is irregular unless there are four corners. All costs are whole numbers: their sums have
/// no rounding, in whatever order.
int cost_inside(int corners) { return corners == 4 ? 0 : 1; }
constexpr int kCostOfPair = 2;

/// What a place of an outline costs as a side, and as a corner over that.
struct PlaceCost {
  int side, corner;

  PlaceCost(const kernel::Mesh& mesh, const Score& score, const Cavity& cavity, std::size_t i) {
    const Index v = mesh.origin(cavity.outline()[i]);
    const int edges = cavity.outer_edges()[i], off_corner = edges - score.ideal(v), off_side = off_corner + 1;
    const bool doublet = edges < 3 && mesh.is_free(v);
    side = off_side * off_side;
    corner = doublet ? kForbidden : off_corner * off_corner - side;
  }
};

/// How badly an angle inside fits a side, and a corner over that.
struct PlaceMisfit {
  double side, corner;

  explicit PlaceMisfit(double angle) {
    const double off_side = angle / std::numbers::pi - 1, off_corner = angle / std::numbers::pi - 0.5;
    side = off_side * off_side;
    corner = off_corner * off_corner - side;
  }
};

/// What all places cost, and how well their angles fit.
struct Places {
  double side_cost = 0, side_misfit = 0;           ///< of all places together, as sides
  std::vector<double> corner_cost, corner_misfit;  ///< by place, over those of a side

  Places(const kernel::Mesh& mesh, const Score& score, const Cavity& cavity) {
    const auto& outline = cavity.outline();
    const std::size_t n = outline.size();
    corner_cost.reserve(n), corner_misfit.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      const PlaceCost cost(mesh, score, cavity, i);
      double angle = ccw_angle(mesh.vector(outline[i]), -mesh.vector(outline[(i + n - 1) % n]));
      if (angle <= 0) angle += 2 * std::numbers::pi;
      const PlaceMisfit misfit(angle);
      side_cost += cost.side;
      side_misfit += misfit.side;
      corner_cost.push_back(cost.corner);
      corner_misfit.push_back(misfit.corner);
    }
  }

  double weight(int i) const { return corner_cost[i] + corner_misfit[i]; }
};

class Chooser {
 public:
  Chooser(const Places& places, const PairWish& wish, double most_cost)
      : places_(places), wish_(wish), n_(int(places.corner_cost.size())), most_cost_(most_cost) {}

  FillingChoices run() {
    find_likely_corners();
    if (n_ <= kShortOutline) {
      const int half = n_ / 2;
      const auto cost_of_pair = [&](int i) { return places_.corner_cost[i] + places_.corner_cost[i + half]; };
      for (int i = 0; i < half; ++i) {
        const double cost = places_.side_cost + cost_of_pair(i);
        for (int j = i + 1; j < half; ++j)
          if (cost + cost_of_pair(j) <= most_cost_) offer(std::array{i, j, i + half, j + half});
      }
    } else {
      pick(0, 4, cost_of_sides(4));
    }
    pick(0, 3, cost_of_sides(3));
    pick(0, 5, cost_of_sides(5));
    with_pair_ = true;
    pick(0, 4, places_.side_cost + kCostOfPair);
    auto& found = found_.best_first;
    std::stable_sort(found.begin(), found.end(), [](const FillingChoice& a, const FillingChoice& b) {
      return a.cost + a.misfit < b.cost + b.misfit;
    });
    return std::move(found_);
  }

 private:
  void find_likely_corners() {
    std::vector<std::pair<double, int>> all;
    all.reserve(n_);
    for (int i = 0; i < n_; ++i) all.emplace_back(places_.weight(i), i);
    const std::size_t count = std::min(all.size(), kLikelyCorners);
    std::partial_sort(all.begin(), all.begin() + std::ptrdiff_t(count), all.end());
    likely_.reserve(count), cheapest_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      likely_.push_back(all[i].second);
      cheapest_.push_back(places_.corner_cost[all[i].second]);
    }
    std::sort(likely_.begin(), likely_.end());
    // cheapest_[k] becomes what k corners cost at least.
    std::sort(cheapest_.begin(), cheapest_.end());
    std::exclusive_scan(cheapest_.begin(), cheapest_.end(), cheapest_.begin(), 0.0);
  }

  double cost_of_sides(int corners) const { return places_.side_cost + cost_inside(corners); }

  /// Offers every choice of `left` more corners from likely_[from] on that does not cost too much; `cost` is that of
  /// the corners picked so far and the sides.
  void pick(std::size_t from, int left, double cost) {
    if (left == 0) return offer(picked_);
    for (std::size_t i = from; i + left <= likely_.size(); ++i) {
      const double with = cost + places_.corner_cost[likely_[i]];
      if (with + cheapest_[left - 1] > most_cost_) continue;
      picked_.push_back(likely_[i]);
      pick(i + 1, left - 1, with);
      picked_.pop_back();
    }
  }

  void offer(std::span<const int> corners) {
    FillingChoice choice;
    choice.cost = with_pair_ ? places_.side_cost + kCostOfPair : cost_of_sides(int(corners.size()));
    choice.misfit = places_.side_misfit;
    for (int c : corners) choice.cost += places_.corner_cost[c], choice.misfit += places_.corner_misfit[c];
    if (choice.cost > most_cost_) return;
    if (with_pair_) return offer_pair(corners, choice);
    const auto filling = filling_between(corners, n_);
    if (!filling) return;
    const double ratio = quads_of(*filling, n_) / wish_.quads_wanted;
    if (ratio < wish_.size.fewest || ratio > wish_.size.most) {
      found_.depends_on_size = true;
      return;
    }
    choice.filling = *filling;
    found_.best_first.push_back(choice);
  }

  void offer_pair(std::span<const int> corners, FillingChoice choice) {
    const auto pair = pair_filling_between({corners[0], corners[1], corners[2], corners[3]}, wish_);
    if (!pair) return;
    choice.pair = pair->filling;
    choice.misfit += pair->misfit;
    found_.best_first.push_back(choice);
  }

  const Places& places_;
  const PairWish& wish_;
  int n_;
  double most_cost_;
  bool with_pair_ = false;        ///< the corners that are picked are those of a filling with two irregular nodes
  std::vector<int> likely_;       ///< places for three and five corners, ascending
  std::vector<double> cheapest_;  ///< [k]: what k of them cost at least
  std::vector<int> picked_;
  FillingChoices found_;
};

/// Of those inside: where sizes change, they are there for a reason.
Vec2 middle_of_irregular_nodes(const kernel::Mesh& mesh, const Cavity& cavity) {
  Vec2 sum = Vec2::Zero();
  int count = 0;
  for (Index v : cavity.inner_nodes())
    if (mesh.valence(v) != 4) sum += mesh.point(v), ++count;
  return count > 0 ? Vec2(sum / count) : mesh.point(mesh.origin(cavity.outline()[0]));
}

}  // namespace

bool may_have_filling(const kernel::Mesh& mesh, const Score& score, const Cavity& cavity, double most_cost) {
  const std::size_t n = cavity.outline().size(), half = n / 2;
  int sides = 0;
  std::vector<int> corners, pairs;
  corners.reserve(n), pairs.reserve(half);
  for (std::size_t i = 0; i < n; ++i) {
    const PlaceCost cost(mesh, score, cavity, i);
    sides += cost.side;
    corners.push_back(cost.corner);
  }
  // Four corners are two pairs on opposite sides.
  for (std::size_t i = 0; i < half; ++i) pairs.push_back(corners[i] + corners[i + half]);
  const auto cheapest = [](std::vector<int>& costs, std::size_t count) {
    if (costs.size() < count) return kForbidden;
    std::partial_sort(costs.begin(), costs.begin() + std::ptrdiff_t(count), costs.end());
    return std::accumulate(costs.begin(), costs.begin() + std::ptrdiff_t(count), 0);
  };
  return sides + cheapest(pairs, 2) <= most_cost || sides + cheapest(corners, 3) + cost_inside(3) <= most_cost ||
         sides + cheapest(corners, 5) + cost_inside(5) <= most_cost ||
         sides + cheapest(corners, 4) + kCostOfPair <= most_cost;
}

double least_misfit(const kernel::Mesh& mesh, const Score& score) {
  constexpr std::size_t kMostCorners = 5;
  double sides = 0;
  std::vector<double> corners(kMostCorners, 0);  // fewer may fit better
  for (Index v = 0; v < mesh.vertex_slots(); ++v) {
    if (!mesh.is_live_vertex(v) || !mesh.is_boundary(v)) continue;
    const PlaceMisfit misfit(score.inside_angle(v));
    sides += misfit.side;
    corners.push_back(misfit.corner);
  }
  std::partial_sort(corners.begin(), corners.begin() + kMostCorners, corners.end());
  return std::accumulate(corners.begin(), corners.begin() + kMostCorners, sides);
}

FillingChoices choose_fillings(const kernel::Mesh& mesh, const Score& score, const Cavity& cavity, double most_cost,
                               double quads_wanted, const FillingSize& size) {
  PairWish wish{{}, middle_of_irregular_nodes(mesh, cavity), quads_wanted, size};
  for (Index h : cavity.outline()) wish.outline.push_back(mesh.point(mesh.origin(h)));
  return Chooser(Places(mesh, score, cavity), wish, most_cost).run();
}

}  // namespace qmorph::cleanup
