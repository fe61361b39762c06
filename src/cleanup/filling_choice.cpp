#include "cleanup/filling_choice.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>
#include <span>

namespace qmorph::cleanup {
namespace {

/// A filling that makes the elements coarser or finer than this is none.
constexpr double kFewest = 0.75, kMost = 1.7;
/// Three and five corners are looked for among so many places of the outline.
constexpr std::size_t kLikelyCorners = 9;
/// Four corners are looked for everywhere on an outline that is no longer than this.
constexpr int kShortOutline = 100;

/// What each place of an outline costs as a side and as a corner of a filling.
struct Places {
  double side_cost = 0, side_misfit = 0;           ///< of all places together
  std::vector<double> corner_cost, corner_misfit;  ///< by place, over those of a side

  Places(const kernel::Mesh& mesh, const Score& score, const Cavity& cavity) {
    const auto& outline = cavity.outline();
    const std::size_t n = outline.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Index v = mesh.origin(outline[i]);
      const int corner = cavity.outer_edges()[i] - score.ideal(v), side = corner + 1;
      double angle = ccw_angle(mesh.vector(outline[i]), -mesh.vector(outline[(i + n - 1) % n]));
      if (angle <= 0) angle += 2 * std::numbers::pi;
      const double off_side = angle / std::numbers::pi - 1, off_corner = angle / std::numbers::pi - 0.5;
      side_cost += side * side;
      side_misfit += off_side * off_side;
      constexpr double kForbidden = 1e6;
      const bool doublet = mesh.is_free(v) && cavity.outer_edges()[i] < 3;
      corner_cost.push_back(doublet ? kForbidden : corner * corner - side * side);
      corner_misfit.push_back(off_corner * off_corner - off_side * off_side);
    }
  }

  double weight(int i) const { return corner_cost[i] + corner_misfit[i]; }
};

class Chooser {
 public:
  Chooser(const Places& places, double most_cost, double quads_wanted)
      : places_(places), n_(int(places.corner_cost.size())), most_cost_(most_cost), quads_wanted_(quads_wanted) {}

  std::vector<FillingChoice> run() {
    const std::vector<int> likely = likely_corners();
    std::vector<int> picked;
    if (n_ <= kShortOutline) {
      const int half = n_ / 2;
      for (int i = 0; i < half; ++i)
        for (int j = i + 1; j < half; ++j) offer(std::array{i, j, i + half, j + half});
    } else {
      pick(likely, 0, 4, picked);
    }
    pick(likely, 0, 3, picked);
    pick(likely, 0, 5, picked);
    std::stable_sort(found_.begin(), found_.end(), [](const FillingChoice& a, const FillingChoice& b) {
      return a.cost + a.misfit < b.cost + b.misfit;
    });
    return std::move(found_);
  }

 private:
  std::vector<int> likely_corners() const {
    std::vector<int> all(n_);
    std::iota(all.begin(), all.end(), 0);
    std::stable_sort(all.begin(), all.end(), [&](int i, int j) { return places_.weight(i) < places_.weight(j); });
    if (all.size() > kLikelyCorners) all.resize(kLikelyCorners);
    std::sort(all.begin(), all.end());
    return all;
  }

  /// Offers every choice of `left` more corners from likely[from] on.
  void pick(const std::vector<int>& likely, std::size_t from, int left, std::vector<int>& picked) {
    if (left == 0) return offer(picked);
    for (std::size_t i = from; i + left <= likely.size(); ++i) {
      picked.push_back(likely[i]);
      pick(likely, i + 1, left - 1, picked);
      picked.pop_back();
    }
  }

  void offer(std::span<const int> corners) {
    FillingChoice choice;
    choice.cost = places_.side_cost + (corners.size() == 4 ? 0 : 1);
    choice.misfit = places_.side_misfit;
    for (int c : corners) choice.cost += places_.corner_cost[c], choice.misfit += places_.corner_misfit[c];
    if (choice.cost > most_cost_) return;
    const auto filling = filling_between(corners, n_);
    if (!filling) return;
    const double ratio = quads_of(*filling, n_) / quads_wanted_;
    if (ratio < kFewest || ratio > kMost) return;
    choice.filling = *filling;
    found_.push_back(choice);
  }

  const Places& places_;
  int n_;
  double most_cost_, quads_wanted_;
  std::vector<FillingChoice> found_;
};

}  // namespace

std::vector<FillingChoice> choose_fillings(const kernel::Mesh& mesh, const Score& score, const Cavity& cavity,
                                           double most_cost, double quads_wanted) {
  return Chooser(Places(mesh, score, cavity), most_cost, quads_wanted).run();
}

}  // namespace qmorph::cleanup
