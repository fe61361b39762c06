// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What improvement may cost: work (`kernel::Mesh::work()`, and what is counted like it), never time, so that the
/// result is the same on every machine. A call has one budget in proportion to its triangles; surfaces, their regions
/// and the parts of those get shares of it before work begins, so that the number of threads decides nothing. All that
/// improves the same region draws from its share, one after the other, failures and tries included; what makes an
/// element valid may go beyond it.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace qmorph {

/// Work that is left for something. It may be overdrawn: what has begun is finished.
class Budget {
 public:
  explicit Budget(double allowed) : allowed_(allowed) {}
  void spend(double work) { spent_ += work; }
  double allowed() const { return allowed_; }
  double spent() const { return spent_; }
  double left() const { return allowed_ - spent_; }
  bool is_spent() const { return left() <= 0; }
  /// So much from now on, whatever was left.
  void renew(double allowed) { allowed_ = spent_ + allowed; }
  /// For what has to begin again, because its first result is not valid: it does so with a little at least.
  double left_for_another() const {
    constexpr double kLeast = 0.1;
    return std::max(left(), kLeast * allowed_);
  }

 private:
  double allowed_, spent_ = 0;
};

/// Has what came of shares spent from the whole in the end, also if something is thrown.
class SpentInAll {
 public:
  SpentInAll(Budget& whole, const std::vector<Budget>& shares) : whole_(whole), shares_(shares) {}
  SpentInAll(const SpentInAll&) = delete;
  SpentInAll& operator=(const SpentInAll&) = delete;
  ~SpentInAll() {
    for (const Budget& share : shares_) whole_.spend(share.spent());
  }

 private:
  Budget& whole_;
  const std::vector<Budget>& shares_;
};

/// Of a call with so many triangles in all its surfaces. 1000 of work take about 20 microseconds; an ordinary surface
/// costs 60 to 400 a triangle besides what everything costs. Few triangles may cost more each, because tries with other
/// constants gain much there.
inline double budget_of_call(double triangles) {
  constexpr double kEach = 1100, kFew = 60e6, kLessEach = 11'000;
  return std::max(kEach * triangles, kFew - kLessEach * triangles);
}

/// What a surface of so many triangles is worth at most, however much its call may cost: in a small one a single step
/// of the front decides the result, and tries with other constants gain much; but not without end.
inline double allowance(std::size_t triangles) {
  constexpr double kEach = 1800, kFew = 12e6, kLessEach = 4800, kMostEach = 60000;
  const double n = double(triangles);
  return std::min(kMostEach * n, std::max(kEach * n, kFew - kLessEach * n));
}

/// What one of `count` surfaces, or regions, gets of what is allowed for all: in proportion to its triangles, and as if
/// it had some more, because a small one that turns out badly is worth many tries.
inline double share_of(double allowed, double triangles, double triangles_of_all, std::size_t count) {
  constexpr double kMore = 50;
  return allowed * (triangles + kMore) / (triangles_of_all + kMore * double(count));
}

/// The same with half of it shared by triangles and half evenly, for parts of one region.
inline double part_of(double allowed, std::size_t triangles, std::size_t triangles_of_all, std::size_t count) {
  return 0.5 * allowed * (double(triangles) / double(triangles_of_all) + 1 / double(count));
}

/// What has not been spent is for those that could have made use of more: twice as much as they had, to begin again.
/// Comes first whose improvement was cut short most often. `cut_short`: how often by share, 0 for those that want no
/// more. Returns their numbers, in order.
std::vector<std::size_t> share_out_the_rest(std::vector<Budget>& shares, const std::vector<std::size_t>& cut_short);

}  // namespace qmorph
