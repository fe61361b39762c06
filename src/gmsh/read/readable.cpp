#include "gmsh/read/readable.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "qmorph/error.hpp"

namespace qmorph::adapter {

namespace fs = std::filesystem;

/// Gmsh before 4.12 says nothing about a missing file, and asks no further about the others.
void check_readable(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(fmt::format("{}: no such file", path));
  if (fs::is_directory(status)) throw InputError(fmt::format("{} is a directory", path));
  if (!std::ifstream(path)) throw InputError(fmt::format("{} cannot be read", path));
  if (fs::is_regular_file(status) && fs::file_size(path, error) == 0)
    throw InputError(fmt::format("{} is empty", path));
}

}  // namespace qmorph::adapter
