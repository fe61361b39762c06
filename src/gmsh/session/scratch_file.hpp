#pragma once
/// Files for Gmsh alone, in the directory for temporary files.

#include <string>

namespace qmorph::adapter {

/// A name for a file, which is removed at the end.
class ScratchFile {
 public:
  /// \throws InputError if there is no directory for temporary files
  explicit ScratchFile(const std::string& extension);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace qmorph::adapter
