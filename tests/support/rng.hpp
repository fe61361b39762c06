// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Random numbers that are the same with every compiler and library: the standard's distributions are not.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace qmorph::test {

/// splitmix64 (Steele, Lea, Flood 2014): one word of state, every seed is good.
class Rng {
 public:
  explicit Rng(std::uint64_t seed) : state_(seed * 0xd1342543de82ef95u + 0x2545f4914f6cdd1du) {}

  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  /// 0 to count - 1.
  std::size_t below(std::size_t count) { return std::size_t((next() >> 32) * count >> 32); }

  /// first to last, both included.
  int range(int first, int last) { return first + int(below(std::size_t(last - first + 1))); }

  /// 0 to 1, 1 excluded.
  double uniform() { return double(next() >> 11) * 0x1p-53; }

  double between(double low, double high) { return low + (high - low) * uniform(); }

  bool chance(double probability) { return uniform() < probability; }

  /// From 2^low to 2^high, evenly spread over the powers of two.
  double power_of_two(int low, int high) { return std::ldexp(1 + uniform(), range(low, high - 1)); }

  template <class T>
  const T& pick(const std::vector<T>& values) {
    return values[below(values.size())];
  }

  template <class T>
  void shuffle(std::vector<T>& values) {
    for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[below(i)]);
  }

 private:
  std::uint64_t state_;
};

}  // namespace qmorph::test
