// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/patterns/cases.hpp"

#include <array>

namespace qmorph::cleanup {
namespace {

// The tables are as printed but for what is said beside a row. The scan of the thesis has lost the column of the first
// ring node's wildcards here and there and put zeros into some vertex patterns; read so that every row has as many
// entries as its centre's valence asks for, each composition turns its pattern into regular nodes, or into one pair 3-5
// where the sides of the outline differ. tests/cleanup/cases_test.cpp draws every row.

// Standard cases: a region with four corners. After the first two, written with the numbers of elements along the
// sides of the outline: 2-3-2-3 becomes a grid, 4-3-2-3 and 3-2-2-3 the smallest transition.
constexpr std::array kConnectivity = {
    // Vertex pattern printed with one zero more (10100010100); so are the next two that say it.
    Case{"standard 1: 2 x 3 grid", "5-4+34+3404043", "1010010100", "", "", "519"},
    Case{"standard 2: four to two rows, corner between", "6-4-4+4344+4-34+34+3", "010001001010", "", "",
         "215218210210502120195"},
    // Printed 10000100010100.
    Case{"standard 3: four to two rows", "6-4+3434+3404043", "100010010100", "", "", "51215105"},
    // Printed 100010010100.
    Case{"standard 4: three to two rows at a corner", "5-4+340404043", "1001010100", "", "", "5"},
    Case{"standard 5: three to two rows beside a corner", "5-4+0434+34+34+3", "0100101010", "", "",
         "12108501201921019"},

    Case{"normal 1: 3 and 3 beside 5", "5-3443000000", "", "", "", "19"},
    Case{"normal 2: its mirror image", "5-4430000003", "", "", "", "8"},
    Case{"normal 3: 3 on both sides of 5", "5-344+4300000", "", "", "", "105"},
    Case{"normal 4: 3 across from 3", "3-4+34+000", "000101", "111000", "", "4"},
    Case{"normal 5: 3 beside 3", "3-354544", "", "100000", "", "0303"},
    // The composition takes an edge from the second and the fifth of the ring; as printed above only the second has
    // one too many, so that a pair 3-5 is left. Here both have, and nothing is.
    Case{"normal 5, both corners 5", "3-354454", "", "100000", "", "0303"},
    Case{"normal 6: 3 and 3 around a pair of regular nodes", "4-34434445", "", "11111000", "", "403201021403"},
};

constexpr std::array kBoundary = {
    Case{"boundary 1: 5 on 5 across a row", "5-4354344", "", "", "11011001", "18"},
    Case{"boundary 2: its mirror image", "5-44+34534", "", "", "11001101", "1219"},
    // As printed the corner of the element before last gets an edge that it can use only where its angle is more than a
    // right one; with 3 (a flat corner of the boundary without an edge to the inside) it is regular afterwards,
    // as in the last row. Both are here, and so for the mirror image.
    Case{"boundary 3: 5 above a row's end", "4-43544", "", "", "110111", "15"},
    Case{"boundary 3, flat end", "4-43534", "", "", "110111", "15"},
    Case{"boundary 4: its mirror image", "4-44534", "", "", "111101", "15"},
    Case{"boundary 4, flat end", "4-43534", "", "", "111101", "15"},
    Case{"boundary 5: 5 on both sides of a node inside", "4-54345434", "", "", "010011001", "82010231023"},
    Case{"boundary 6: a flat corner between two 5", "5-4353534", "", "", "11011101", "121518"},
};

// A dart at the node of the large angle: the far edge of the element on that side, seen from the opposite node,
// is the one across which it is joined with its neighbour (figures 3.6 and 3.7). The mirror image takes the
// other neighbour.
constexpr std::array kLargeAngle = {
    ShapeCase{"fill_3", 0, "0105"},
    ShapeCase{"fill_4", 0, "0106"},
    ShapeCase{"fill_3 at the boundary", 1, "0105"},
    ShapeCase{"fill_4 at the boundary", 1, "0106"},
    ShapeCase{"split and twice fill_3", 2, "701510121015"},
};

// Both end with the new node of the first step joined to the one of the second.
constexpr std::array kTransition = {
    ShapeCase{"one row: fill_4 and fill_3", 2, "0106105"},
    ShapeCase{"two rows: fill_3 and fill_3", 2, "0105105"},
};

}  // namespace

std::span<const Case> connectivity_cases() { return kConnectivity; }
std::span<const Case> boundary_cases() { return kBoundary; }
std::span<const ShapeCase> large_angle_cases() { return kLargeAngle; }
std::span<const ShapeCase> transition_cases() { return kTransition; }

}  // namespace qmorph::cleanup
