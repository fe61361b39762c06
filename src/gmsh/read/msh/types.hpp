// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The element types of MSH, without asking Gmsh, which crashes on numbers that mean nothing.

#include <cstddef>

namespace qmorph::adapter {

struct MshType {
  int dim = 0;
  std::size_t nodes = 0;  ///< 0: there is no such type, or one for parts of elements, or polygons
};

MshType msh_type(long long number);

}  // namespace qmorph::adapter
