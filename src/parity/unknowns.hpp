// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What an interval assignment decides: one number for curves that go together.

#include <vector>

#include "parity/intervals.hpp"
#include "parity/sets.hpp"

namespace qmorph::parity {

/// How far off a number is, for a curve: segments times the square of the logarithm of what sizes change by.
double harm(const CurveWish& curve, int segments);

/// Curves with one number of segments.
struct Unknown {
  std::vector<Index> curves;
  int segments = 0;
  int least = 1;
  bool fixed = false;
};

class Unknowns {
 public:
  /// \param sets of curves; the empty ones count for nothing
  Unknowns(const std::vector<CurveWish>& curves, const std::vector<std::vector<Index>>& sets);

  std::size_t size() const { return all_.size(); }
  Index of_curve(Index curve) const { return of_curve_[curve]; }
  const Unknown& operator[](Index i) const { return all_[i]; }
  bool may_change(Index i, int by) const { return !all_[i].fixed && all_[i].segments + by >= all_[i].least; }
  /// What a change costs: below 0 if it is for the better.
  double price(Index i, int by) const;
  void change(Index i, int by) { all_[i].segments += by; }

 private:
  double cost(const Unknown& unknown, int segments) const;

  const std::vector<CurveWish>& curves_;
  std::vector<Unknown> all_;
  std::vector<Index> of_curve_;
};

/// How often an unknown is on the first side of a band, less how often on the second.
struct Share {
  Index unknown = kNone;
  int count = 0;
};
std::vector<Share> shares_of(const Band& band, const Unknowns& unknowns);
/// By how much the first side of a band has more than the second.
int excess(const std::vector<Share>& band, const Unknowns& unknowns);

}  // namespace qmorph::parity
