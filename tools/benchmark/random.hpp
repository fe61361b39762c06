// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>

namespace benchmark {

/// SplitMix64 (Steele, Lea, Flood 2014). std::uniform_real_distribution differs between standard libraries.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double between(double low, double high) {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    z ^= z >> 31;
    return low + (high - low) * (double(z >> 11) * 0x1p-53);
  }
  bool chance(double share) { return between(0, 1) < share; }
  std::size_t below(std::size_t count) { return std::size_t(between(0, double(count))); }

 private:
  std::uint64_t state_;
};

}  // namespace benchmark
