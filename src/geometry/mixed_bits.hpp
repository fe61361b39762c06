// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Marks for sets: numbers whose sum or exclusive or tells which of them are in it.

#include <cstdint>

namespace qmorph {

/// Mixes the bits of a number, so that sums of mixed numbers do not agree by chance as 2 + 3 and 1 + 4 do [Steele14].
constexpr std::uint64_t mixed_bits(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace qmorph
