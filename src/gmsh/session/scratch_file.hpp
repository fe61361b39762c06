// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Files for Gmsh alone, in the directory for temporary files.

#include <string>

namespace qmorph::adapter {

/// A name for a file in a directory of its own. The directory is removed at the end with all that is in it: beside some
/// files Gmsh writes others that nobody has asked for.
class ScratchFile {
 public:
  /// \throws InputError if there is no directory for temporary files
  explicit ScratchFile(const std::string& extension);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string directory_, path_;
};

}  // namespace qmorph::adapter
