// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/process/private_directory.hpp"

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace qmorph::cli {

namespace fs = std::filesystem;

PrivateDirectory::PrivateDirectory() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  if (error) return;
  std::string pattern = (parent / "qmorph-XXXXXX").string();
  if (::mkdtemp(pattern.data())) path_ = pattern;
}

void PrivateDirectory::remove() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
  path_.clear();
}

std::string PrivateDirectory::read_foreign_words() const {
  if (path_.empty()) return {};
  std::ifstream in(foreign_words(), std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

}  // namespace qmorph::cli
