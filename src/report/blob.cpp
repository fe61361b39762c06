// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/blob.hpp"

#include <algorithm>
#include <limits>

namespace qmorph::report {

nlohmann::ordered_json Blob::add_tags(std::span<const std::size_t> tags) {
  const bool fits = std::all_of(tags.begin(), tags.end(),
                                [](std::size_t tag) { return tag <= std::numeric_limits<std::uint32_t>::max(); });
  if (fits) return add(std::span<const std::uint32_t>(std::vector<std::uint32_t>(tags.begin(), tags.end())));
  return append(std::span<const double>(std::vector<double>(tags.begin(), tags.end())), "f64");
}

std::string Blob::text() const {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes_.size() + 2) / 3 * 4, '=');
  std::size_t at = 0;
  for (std::size_t i = 0; i < bytes_.size(); i += 3, at += 4) {
    const std::size_t rest = std::min<std::size_t>(3, bytes_.size() - i);
    const std::uint32_t word = std::uint32_t(bytes_[i]) << 16 | (rest > 1 ? std::uint32_t(bytes_[i + 1]) << 8 : 0) |
                               (rest > 2 ? std::uint32_t(bytes_[i + 2]) : 0);
    for (std::size_t k = 0; k <= rest; ++k) text[at + k] = kDigits[word >> (18 - 6 * k) & 63];
  }
  return text;
}

}  // namespace qmorph::report
