// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/session/scratch_file.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace fs = std::filesystem;

ScratchFile::ScratchFile(const std::string& extension) {
  std::error_code error;
  const fs::path place = fs::temp_directory_path(error);
  if (error) throw InputError("there is no directory for temporary files; set TMPDIR to one that exists");
  directory_ = (place / "qmorph-XXXXXX").string();
  if (!::mkdtemp(directory_.data()))
    throw InputError("nothing can be written to " + place.string() + "; set TMPDIR to another directory");
  path_ = (fs::path(directory_) / ("scratch" + extension)).string();
}

ScratchFile::~ScratchFile() {
  std::error_code ignored;
  fs::remove_all(directory_, ignored);
}

}  // namespace qmorph::adapter
