// SPDX-License-Identifier: GPL-2.0-or-later
// libFuzzer makes .msh files: each is read through, or refused with an error of ours.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "gmsh/read/msh/file.hpp"
#include "qmorph/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int file = memfd_create("fuzz.msh", 0);
  if (file < 0 || write(file, data, size) != ssize_t(size)) std::abort();
  const std::string path = "/proc/self/fd/" + std::to_string(file);
  try {
    qmorph::adapter::check_msh_file(path, qmorph::adapter::read_msh_header(path));
  } catch (const qmorph::Error&) {
  }
  close(file);
  return 0;
}
