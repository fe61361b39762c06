// SPDX-License-Identifier: GPL-2.0-or-later
// The core library alone: arrays in, arrays out.
#include <qmorph/convert.hpp>

int main() {
  qmorph::Patch patch;
  patch.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  patch.triangles = {{0, 1, 2}, {0, 2, 3}};
  return qmorph::convert(patch).mesh.quads.size() == 1 ? 0 : 1;
}
