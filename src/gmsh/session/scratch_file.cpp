#include "gmsh/session/scratch_file.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace fs = std::filesystem;

ScratchFile::ScratchFile(const std::string& extension) {
  std::error_code error;
  const fs::path directory = fs::temp_directory_path(error);
  if (error) throw InputError("there is no directory for temporary files; set TMPDIR to one that exists");
  path_ = (directory / ("qmorph-XXXXXX" + extension)).string();
  const int file = ::mkstemps(path_.data(), static_cast<int>(extension.size()));
  if (file < 0) throw InputError("no file can be made in " + directory.string() + "; set TMPDIR to another directory");
  ::close(file);
}

ScratchFile::~ScratchFile() {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

}  // namespace qmorph::adapter
