// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/budget.hpp"

#include <algorithm>

namespace qmorph {

std::vector<std::size_t> share_out_the_rest(std::vector<Budget>& shares, const std::vector<std::size_t>& cut_short) {
  constexpr double kTimes = 2;
  double rest = 0;
  std::vector<std::size_t> wanting, again;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    rest += shares[i].left();
    if (cut_short[i] > 0) wanting.push_back(i);
  }
  std::stable_sort(wanting.begin(), wanting.end(),
                   [&](std::size_t a, std::size_t b) { return cut_short[a] > cut_short[b]; });
  for (std::size_t i : wanting) {
    const double cost = kTimes * shares[i].allowed();
    if (cost > rest) continue;
    rest -= cost;
    shares[i].renew(cost);
    again.push_back(i);
  }
  std::sort(again.begin(), again.end());
  return again;
}

}  // namespace qmorph
