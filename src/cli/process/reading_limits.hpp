// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// For files that nobody but Gmsh looks into.

#include <sys/resource.h>

#include <string>
#include <vector>

namespace qmorph::cli {

/// While it lives, this process may take no more time and memory than reading meshes of this size needs: Gmsh's readers
/// believe in what a broken file says of itself, or look for ever for what it does not have. Beyond, the process dies,
/// or there is not enough memory. No limit where one of the files is a script or a geometry, which may take as long as
/// it likes.
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
