// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/write/temporary_names.hpp"

#include <unistd.h>

#include <algorithm>

namespace qmorph::adapter {

void TemporaryNames::add(const std::string& path) {
  if (path.size() >= kLongest) return;
  for (auto& name : names_)
    if (name[0] == '\0') {
      std::copy(path.begin(), path.end(), name.begin());
      name[path.size()] = '\0';
      return;
    }
}

void TemporaryNames::drop(const std::string& path) {
  for (auto& name : names_)
    if (path == name.data()) name[0] = '\0';
}

void TemporaryNames::remove_files() {
  for (auto& name : names_) {
    if (name[0] == '\0') continue;
    ::unlink(name.data());
    name[0] = '\0';
  }
}

}  // namespace qmorph::adapter
