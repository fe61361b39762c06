// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Arrays of numbers inside a page: one block of bytes, and a table that says where each array lies in it.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace qmorph::report {

/// Bytes are little-endian, as every machine that runs a browser reads them.
class Blob {
 public:
  /// Appends an array. \return its place: {"type": "f32", "at": byte, "count": n}
  nlohmann::ordered_json add(std::span<const float> values) { return append(values, "f32"); }
  nlohmann::ordered_json add(std::span<const std::uint32_t> values) { return append(values, "u32"); }
  nlohmann::ordered_json add(std::span<const std::uint8_t> values) { return append(values, "u8"); }
  nlohmann::ordered_json add(std::span<const std::int16_t> values) { return append(values, "i16"); }
  /// Tags as u32, or as f64 where one is too large for that.
  nlohmann::ordered_json add_tags(std::span<const std::size_t> tags);

  /// All of it in base64.
  std::string text() const;
  std::size_t size() const { return bytes_.size(); }

 private:
  template <class T>
  nlohmann::ordered_json append(std::span<const T> values, const char* type) {
    bytes_.resize((bytes_.size() + 7) / 8 * 8);  // a typed array begins at a multiple of its element's size
    const std::size_t at = bytes_.size();
    bytes_.resize(at + values.size_bytes());
    if (!values.empty()) std::memcpy(bytes_.data() + at, values.data(), values.size_bytes());
    return {{"type", type}, {"at", at}, {"count", values.size()}};
  }

  std::vector<std::uint8_t> bytes_;
};

}  // namespace qmorph::report
