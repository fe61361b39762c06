// SPDX-License-Identifier: GPL-2.0-or-later
/// What the command says: what is wrong or left, where, and what to do about it.

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "gmsh/support.hpp"

using namespace qmorph::test;

namespace {

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Three triangles in a pentagon: five sides.
const std::string kPentagon =
    msh22({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}}, {"2 2 0 1 1 2 3", "2 2 0 1 1 3 4", "2 2 0 1 1 4 5"});

/// One quad with a corner of more than 180 degrees.
const std::string kConcave = msh22({{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}}, {"3 2 0 1 1 2 3 4"});

}  // namespace

TEST_CASE("messages: a triangle that an odd boundary forces names --all-quad, and is no failure") {
  const TemporaryDirectory directory;
  write_file(directory / "in.msh", kPentagon);
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CHECK(result.status == 0);
  CHECK(mentions(result.err,
                 "1 triangle is left where a boundary has an odd number of sides, on surface 1; --all-quad leaves "
                 "none\n"));
  const Result even = run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "--all-quad"});
  CHECK(even.status == 0);
  CHECK(!mentions(even.err, "--all-quad leaves"));
  CHECK(run_qmorph({directory / "in.msh", "-o", directory / "out.msh", "-v", "0"}).err.empty());
}

TEST_CASE("messages: a concave quad of the input names --cleanup-only") {
  const TemporaryDirectory directory;
  write_file(directory / "in.msh", kConcave);
  const Result result = run_qmorph({directory / "in.msh", "-o", directory / "out.msh"});
  CHECK(result.status == 3);
  CHECK(mentions(result.err, "is inverted or not convex at (0.5, 0.5, 0); --cleanup-only"));
}
