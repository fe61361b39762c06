// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/read/msh/types.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace qmorph::adapter {
namespace {

struct Row {
  int number, dim;
  std::size_t nodes;
};

/// Gmsh's reference manual, MSH file format, and for higher orders its list of types.
constexpr std::array kRows = {
    Row{15, 0, 1},
    // lines
    Row{1, 1, 2}, Row{8, 1, 3}, Row{26, 1, 4}, Row{27, 1, 5}, Row{28, 1, 6}, Row{62, 1, 7}, Row{63, 1, 8},
    Row{64, 1, 9}, Row{65, 1, 10}, Row{66, 1, 11},
    // triangles
    Row{2, 2, 3}, Row{9, 2, 6}, Row{20, 2, 9}, Row{21, 2, 10}, Row{22, 2, 12}, Row{23, 2, 15}, Row{24, 2, 15},
    Row{25, 2, 21}, Row{42, 2, 28}, Row{43, 2, 36}, Row{44, 2, 45}, Row{45, 2, 55}, Row{46, 2, 66}, Row{52, 2, 18},
    Row{53, 2, 21}, Row{54, 2, 24}, Row{55, 2, 27}, Row{56, 2, 30},
    // quads
    Row{3, 2, 4}, Row{10, 2, 9}, Row{16, 2, 8}, Row{36, 2, 16}, Row{37, 2, 25}, Row{38, 2, 36}, Row{39, 2, 12},
    Row{40, 2, 16}, Row{41, 2, 20}, Row{47, 2, 49}, Row{48, 2, 64}, Row{49, 2, 81}, Row{50, 2, 100}, Row{51, 2, 121},
    Row{57, 2, 24}, Row{58, 2, 28}, Row{59, 2, 32}, Row{60, 2, 36}, Row{61, 2, 40},
    // tetrahedra
    Row{4, 3, 4}, Row{11, 3, 10}, Row{29, 3, 20}, Row{30, 3, 35}, Row{31, 3, 56}, Row{32, 3, 22}, Row{33, 3, 28},
    Row{71, 3, 84}, Row{72, 3, 120}, Row{73, 3, 165}, Row{74, 3, 220}, Row{75, 3, 286}, Row{79, 3, 34}, Row{80, 3, 40},
    Row{81, 3, 46}, Row{82, 3, 52}, Row{83, 3, 58}, Row{137, 3, 16},
    // hexahedra
    Row{5, 3, 8}, Row{12, 3, 27}, Row{17, 3, 20}, Row{92, 3, 64}, Row{93, 3, 125}, Row{94, 3, 216}, Row{95, 3, 343},
    Row{96, 3, 512}, Row{97, 3, 729}, Row{98, 3, 1000}, Row{99, 3, 32},
    // prisms
    Row{6, 3, 6}, Row{13, 3, 18}, Row{18, 3, 15}, Row{90, 3, 40}, Row{91, 3, 75}, Row{106, 3, 126}, Row{107, 3, 196},
    Row{108, 3, 288}, Row{109, 3, 405}, Row{110, 3, 550}, Row{111, 3, 24}, Row{112, 3, 33}, Row{113, 3, 42},
    Row{114, 3, 51}, Row{115, 3, 60}, Row{116, 3, 69}, Row{117, 3, 78},
    // pyramids
    Row{7, 3, 5}, Row{14, 3, 14}, Row{19, 3, 13}, Row{118, 3, 30}, Row{119, 3, 55}, Row{120, 3, 91}, Row{121, 3, 140},
    Row{122, 3, 204}, Row{123, 3, 285}, Row{124, 3, 385}};

constexpr int kLast = 140;

constexpr std::array<MshType, kLast + 1> make_table() {
  std::array<MshType, kLast + 1> table{};
  for (const Row& row : kRows) table[static_cast<std::size_t>(row.number)] = {row.dim, row.nodes};
  return table;
}

constexpr std::array<MshType, kLast + 1> kTable = make_table();

}  // namespace

MshType msh_type(long long number) {
  return number < 1 || number > kLast ? MshType{} : kTable[static_cast<std::size_t>(number)];
}

}  // namespace qmorph::adapter
