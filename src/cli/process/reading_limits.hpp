// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// For files that only Gmsh looks into.

#include <sys/resource.h>

#include <string>
#include <vector>

namespace qmorph::cli {

/// While it lives, this process may take no more time and memory than reading meshes of this size needs: Gmsh's readers
/// trust what a broken file says about itself, or search for ever for what it does not have. Beyond the limit the
/// process dies, or runs out of memory. No limit where one of the files is a script or a geometry, which may take as
/// long as it likes.
class ReadingLimits {
 public:
  explicit ReadingLimits(const std::vector<std::string>& files);
  ~ReadingLimits() { lift(); }
  ReadingLimits(const ReadingLimits&) = delete;
  ReadingLimits& operator=(const ReadingLimits&) = delete;
  void lift();

 private:
  bool set_ = false;
  rlimit time_{}, data_{};  ///< as they were
};

}  // namespace qmorph::cli
