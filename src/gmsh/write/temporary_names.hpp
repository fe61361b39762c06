// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Files that are there for the time being.

#include <array>
#include <cstddef>
#include <string>

namespace qmorph::adapter {

/// Their names, in plain memory that two processes may share: where the one that makes the files ends before it can
/// remove them, the other one does.
class TemporaryNames {
 public:
  /// To be said before there is a file. More names than there is room for are not kept.
  void add(const std::string& path);
  void drop(const std::string& path);
  void remove_files();

 private:
  static constexpr std::size_t kMost = 16, kLongest = 4096;
  std::array<std::array<char, kLongest>, kMost> names_{};  ///< empty ones are free
};

}  // namespace qmorph::adapter
