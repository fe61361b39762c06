// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The names of temporary files.

#include <array>
#include <cstddef>
#include <string>

namespace qmorph::adapter {

/// In plain memory that two processes may share: if the one that makes the files ends before it can remove them, the
/// other one does.
class TemporaryNames {
 public:
  /// Call this before the file is created. Names beyond the room that there is are not kept.
  void add(const std::string& path);
  void drop(const std::string& path);
  void remove_files();

 private:
  static constexpr std::size_t kMost = 16, kLongest = 4096;
  std::array<std::array<char, kLongest>, kMost> names_{};  ///< empty ones are free
};

}  // namespace qmorph::adapter
