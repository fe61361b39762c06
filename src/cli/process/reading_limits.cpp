// SPDX-License-Identifier: GPL-2.0-or-later
#include "cli/process/reading_limits.hpp"

#include <algorithm>
#include <filesystem>

#include "gmsh/read/readable.hpp"

namespace qmorph::cli {
namespace {

/// Gmsh reads a megabyte in a tenth of a second, and takes ten bytes for each of a text.
constexpr rlim_t kSeconds = 20, kBytesPerSecond = 50'000;
constexpr rlim_t kMemory = rlim_t{768} << 20, kMemoryPerByte = 40;

/// Lowers a limit of this process. \return as it was
rlimit lower(decltype(RLIMIT_CPU) resource, rlim_t most) {
  rlimit before{};
  ::getrlimit(resource, &before);
  rlimit now = before;
  if (now.rlim_cur == RLIM_INFINITY || now.rlim_cur > most) now.rlim_cur = most;
  ::setrlimit(resource, &now);
  return before;
}

}  // namespace

ReadingLimits::ReadingLimits(const std::vector<std::string>& files) {
  rlim_t size = 0;
  for (const std::string& file : files) {
    if (!adapter::is_mesh_file(file)) return;
    std::error_code error;
    const auto bytes = std::filesystem::file_size(file, error);
    if (!error) size += bytes;
  }
  set_ = true;
  time_ = lower(RLIMIT_CPU, kSeconds + size / kBytesPerSecond);
#if defined(__SANITIZE_ADDRESS__)  // its own memory has no bounds
  ::getrlimit(RLIMIT_DATA, &data_);
#else
  data_ = lower(RLIMIT_DATA, kMemory + kMemoryPerByte * size);
#endif
}

void ReadingLimits::lift() {
  if (!set_) return;
  ::setrlimit(RLIMIT_CPU, &time_);
  ::setrlimit(RLIMIT_DATA, &data_);
  set_ = false;
}

}  // namespace qmorph::cli
