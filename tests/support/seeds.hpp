// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// How many random domains a law is tried on.

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace qmorph::test {

/// `usual`, or fewer or more when QMORPH_DOMAINS is not 1000, in proportion, but no fewer than `least`: laws about sums
/// need a sample that is large enough for them.
inline std::uint64_t seeds(std::uint64_t usual, std::uint64_t least = 1) {
  const char* text = std::getenv("QMORPH_DOMAINS");
  return text ? std::max<std::uint64_t>(least, usual * std::strtoull(text, nullptr, 10) / 1000) : usual;
}

/// Whether so many domains are enough for laws about their sums. With fewer, as under the sanitizers, each domain is
/// looked at for itself, and that is all.
inline bool allows_laws(std::uint64_t domains) { return domains >= 50; }

}  // namespace qmorph::test
