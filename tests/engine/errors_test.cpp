// SPDX-License-Identifier: GPL-2.0-or-later
// What errors say to programs.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "qmorph/convert.hpp"

namespace {

using namespace qmorph;

/// Two by two cells of two triangles each, with corners at (0, 0, 0) and (2, 2, 0).
Patch square() {
  Patch patch;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) patch.points.emplace_back(i, j, 0);
  for (Index corner : {0u, 1u, 3u, 4u}) {
    patch.triangles.push_back({corner, corner + 1, corner + 4});
    patch.triangles.push_back({corner, corner + 4, corner + 3});
  }
  return patch;
}

ErrorDetails details_after(const std::function<void(Patch&)>& spoil) {
  Patch patch = square();
  spoil(patch);
  try {
    convert(patch);
  } catch (const SurfaceError& error) {
    return error.details();
  }
  FAIL("nothing was said");
  return {};
}

}  // namespace

TEST_CASE("errors: kind, place and node agree with the message") {
  const ErrorDetails nowhere = details_after([](Patch& p) { p.points[4].x() = std::nan(""); });
  CHECK(nowhere.kind == ErrorKind::not_finite);
  REQUIRE(nowhere.subject);
  CHECK(nowhere.subject->kind == ErrorSubject::Kind::node);
  CHECK(nowhere.subject->number == 4);

  const ErrorDetails far_away = details_after([](Patch& p) { p.points[4].x() = 1e200; });
  CHECK(far_away.kind == ErrorKind::not_finite);
  const ErrorDetails nothing_left = details_after([](Patch& p) {
    p.triangles.clear();
    p.points[4].x() = std::nan("");
  });
  CHECK(nothing_left.kind == ErrorKind::not_finite);

  const ErrorDetails unknown = details_after([](Patch& p) { p.triangles[0][1] = 77; });
  CHECK(unknown.kind == ErrorKind::bad_element);
  CHECK(unknown.subject->number == 77);

  const ErrorDetails twice = details_after([](Patch& p) { p.triangles[0] = {4, 4, 1}; });
  CHECK(twice.kind == ErrorKind::bad_element);
  CHECK(*twice.place == Eigen::Vector3d(1, 1, 0));

  const ErrorDetails turned = details_after([](Patch& p) { std::swap(p.triangles[0][0], p.triangles[0][1]); });
  CHECK(turned.kind == ErrorKind::not_manifold);

  const ErrorDetails folded = details_after([](Patch& p) { p.points[4] = {2.5, 2.5, 0}; });
  CHECK(folded.kind == ErrorKind::overlap);
  CHECK(folded.place);

  const ErrorDetails flat = details_after([](Patch& p) {
    for (auto& point : p.points) point.y() = 0;
  });
  CHECK(flat.kind == ErrorKind::no_area);
}

TEST_CASE("errors: each class has the kind of its name, and all are one family") {
  CHECK(UsageError("").kind() == ErrorKind::usage);
  CHECK(InputError("").kind() == ErrorKind::input);
  CHECK(OutputError("").kind() == ErrorKind::output);
  CHECK(SurfaceError("").kind() == ErrorKind::surface);
  CHECK(Cancelled().kind() == ErrorKind::cancelled);
  try {
    throw Cancelled();
  } catch (const Error& error) {
    CHECK_FALSE(error.place());
    CHECK_FALSE(error.subject());
  }
}
