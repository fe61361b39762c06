// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "qmorph/patch.hpp"

namespace qmorph {

/// Puts the values in ascending order, each once.
template <class Value>
void sort_unique(std::vector<Value>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// The same for indices, which usually lie close together: a bit is set for each, and the bits are read in order.
/// Sorting takes ten times as long, because the processor cannot predict the comparisons.
inline void sort_unique(std::vector<Index>& values) {
  constexpr std::size_t kWord = 64, kMostWordsPerValue = 4, kFewWords = 32;
  if (values.empty()) return;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const Index first = *least;
  const std::size_t words = (*most - first) / kWord + 1;
  if (words > kMostWordsPerValue * values.size()) return sort_unique<Index>(values);
  std::array<std::uint64_t, kFewWords> few;  // not cleared unless it is used
  std::vector<std::uint64_t> many(words > kFewWords ? words : 0, 0);
  if (many.empty()) std::fill_n(few.begin(), words, 0);
  std::uint64_t* const bits = many.empty() ? few.data() : many.data();
  for (const Index v : values) bits[(v - first) / kWord] |= std::uint64_t(1) << (v - first) % kWord;
  values.clear();
  for (std::size_t w = 0; w < words; ++w)
    for (std::uint64_t word = bits[w]; word != 0; word &= word - 1)
      values.push_back(first + Index(w * kWord) + Index(std::countr_zero(word)));
}

}  // namespace qmorph
