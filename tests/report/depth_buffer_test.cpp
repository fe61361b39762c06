// SPDX-License-Identifier: GPL-2.0-or-later
/// Which faces of a scene in space are seen, and from where.

#include "report/depth_buffer.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "report/picture.hpp"
#include "support/rng.hpp"

using namespace qmorph;
using namespace qmorph::report;
using Eigen::Vector3d;

namespace {

struct Faces {
  std::vector<Vector3d> points;
  std::vector<std::array<Index, 4>> faces;
};

/// Adds a globe of `n` by 2 n faces; at the poles quads have two corners in one place.
void add_globe(Faces& all, const Vector3d& middle, double radius, Index n) {
  const Index first = Index(all.points.size());
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j < 2 * n; ++j) {
      const double a = std::numbers::pi * i / n, b = std::numbers::pi * j / n;
      all.points.push_back(middle +
                           radius * Vector3d(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b)));
    }
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < 2 * n; ++j) {
      const Index k = (j + 1) % (2 * n), row = first + 2 * n * i, next = row + 2 * n;
      all.faces.push_back({row + j, row + k, next + k, next + j});
    }
}

/// Depth of a triangle at (x, y), if it is there.
std::optional<double> depth_at(const Vector3d& a, const Vector3d& b, const Vector3d& c, double x, double y) {
  const auto area = [](const Vector3d& p, const Vector3d& q, double u, double v) {
    return (q.x() - p.x()) * (v - p.y()) - (q.y() - p.y()) * (u - p.x());
  };
  const double whole = area(a, b, c.x(), c.y()), u = area(b, c, x, y) / whole, v = area(c, a, x, y) / whole;
  if (whole == 0 || u < 0 || v < 0 || u + v > 1) return std::nullopt;
  return u * a.z() + v * b.z() + (1 - u - v) * c.z();
}

std::optional<double> depth_at(const Faces& all, std::size_t f, double x, double y) {
  const auto& n = all.faces[f];
  const auto first = depth_at(all.points[n[0]], all.points[n[1]], all.points[n[2]], x, y);
  if (first || n[3] == kNone) return first;
  return depth_at(all.points[n[0]], all.points[n[2]], all.points[n[3]], x, y);
}

}  // namespace

TEST_CASE("depth buffer: painting in its order shows the face that is in front everywhere") {
  int places = 0, wrong = 0, bright = 0, left_out = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    test::Rng rng(seed);
    Faces all;
    // Globes side by side in depth, and walls, each one large face, between them: their middles say nothing.
    for (int i = 0; i < 4; ++i) {
      const double radius = rng.between(3, 9);
      add_globe(all, {rng.between(10, 30), rng.between(10, 30), 40.0 * i}, radius, Index(rng.range(4, 12)));
      const Index first = Index(all.points.size());
      const double x = rng.between(0, 20), y = rng.between(0, 20), lean = rng.between(-9, 9);
      for (const auto& [dx, dy] : {std::pair(0.0, 0.0), {20.0, 0.0}, {20.0, 9.0}, {0.0, 9.0}})
        all.points.emplace_back(x + dx, y + dy, 40.0 * i + 20 + lean * (dx / 20 - 0.5));
      all.faces.push_back({first, first + 1, first + 2, first + 3});
    }
    const DepthBuffer buffer(all.points, all.faces);
    const auto order = buffer.back_to_front();
    CHECK(std::set<std::size_t>(order.begin(), order.end()).size() == order.size());
    left_out += int(all.faces.size() - order.size());
    for (int i = 0; i < 400; ++i) {
      const double x = rng.between(0, 40), y = rng.between(0, 40);
      std::optional<double> foremost, painted;
      for (std::size_t f = 0; f < all.faces.size(); ++f)
        if (const auto depth = depth_at(all, f, x, y); depth && (!foremost || *depth > *foremost)) foremost = depth;
      for (std::size_t f : order)
        if (const auto depth = depth_at(all, f, x, y)) painted = depth;
      if (!foremost) continue;
      ++places;
      if (!painted || *foremost - *painted > 0.5) ++wrong;  // a pixel or two beside an outline
      CHECK(buffer.sees({x, y, *foremost}));
      if (buffer.sees({x, y, *foremost - 1000})) ++bright;
    }
  }
  CHECK(places > 1000);
  CHECK(wrong <= places / 200);
  CHECK(bright <= places / 50);
  CHECK(left_out > 1000);
}

TEST_CASE("depth buffer: only the side of a globe towards the eye is seen") {
  Faces globe;
  add_globe(globe, {10, 10, 0}, 10, 24);
  const auto order = DepthBuffer(globe.points, globe.faces).back_to_front();
  std::vector<bool> seen(globe.faces.size(), false);
  for (std::size_t f : order) seen[f] = true;
  for (std::size_t f = 0; f < globe.faces.size(); ++f) {
    Vector3d middle = Vector3d::Zero();
    for (Index v : globe.faces[f]) middle += globe.points[v] / 4;
    CAPTURE(middle.z());
    if (middle.z() > 1) CHECK(seen[f]);
    if (middle.z() < -1) CHECK_FALSE(seen[f]);
  }
}

TEST_CASE("viewpoint: axes and directions by name") {
  CHECK(find_viewpoint("x") == Viewpoint(1, 0, 0));
  CHECK(find_viewpoint("-z") == Viewpoint(0, 0, -1));
  CHECK(find_viewpoint("+y") == Viewpoint(0, 1, 0));
  CHECK(find_viewpoint("3,0,-4")->isApprox(Viewpoint(0.6, 0, -0.8)));
  for (const char* name : {"", "-", "w", "xy", "1,2", "1,2,3,4", "1,2,", "0,0,0", "1,2,x", "nan,0,1", "1e999,0,1"}) {
    CAPTURE(name);
    CHECK_FALSE(find_viewpoint(name));
  }
}

TEST_CASE("viewpoint: what is nearer to the eye is in front, and up stays up") {
  test::Rng rng(5);
  Frame frame;  // of a scene in space: up is z
  frame.flat = false;
  frame.up = Vector3d::UnitZ();
  for (int i = 0; i < 100; ++i) {
    const Viewpoint from = Viewpoint(rng.between(-1, 1), rng.between(-1, 1), rng.between(-1, 1)).normalized();
    const Eigen::Matrix3d rows = turn_of(frame, from).rows();
    CHECK((rows * frame.to_frame(from)).isApprox(Vector3d(0, 0, 1), 1e-9));
    const Vector3d up = rows * frame.to_frame(Vector3d::UnitZ());
    CHECK(std::abs(up.x()) < 1e-9);
    CHECK(up.y() > 0);
  }
  const Eigen::Matrix3d above = turn_of(frame, Viewpoint::UnitZ()).rows();
  CHECK((above * frame.to_frame(Vector3d::UnitX())).isApprox(Vector3d(1, 0, 0), 1e-9));
  CHECK((above * frame.to_frame(Vector3d::UnitY())).isApprox(Vector3d(0, 1, 0), 1e-9));
}

TEST_CASE("picture: hidden faces are left out, and marks with them") {
  Scene scene;
  Faces globe;
  add_globe(globe, Vector3d::Zero(), 1, 16);
  scene.points = globe.points;
  scene.faces = globe.faces;
  scene.node_tags.assign(scene.points.size(), 0);
  scene.face_tags.assign(scene.faces.size(), 0);
  scene.surfaces = {{1, {}, 0, scene.faces.size()}};
  for (const char* from : {"x", "z", "-1,2,0.5"}) {
    CAPTURE(from);
    const Drawing drawing = draw(scene, PictureColour::none, *find_viewpoint(from));
    const std::size_t faces = std::size_t(std::count_if(drawing.shapes.begin(), drawing.shapes.end(),
                                                        [](const Shape& shape) { return shape.fill.has_value(); }));
    CHECK(faces > 0.4 * double(scene.faces.size()));
    CHECK(faces < 0.6 * double(scene.faces.size()));
    CHECK(drawing.size.x() == doctest::Approx(drawing.size.y()).epsilon(0.02));
  }
  // Without colours light shows the shape: the middle of the globe is white, its outline is not.
  std::set<int> greys;
  for (const Shape& shape : draw(scene, PictureColour::none, Viewpoint::UnitX()).shapes)
    if (shape.fill) greys.insert(shape.fill->red);
  CHECK(*greys.rbegin() > 240);
  CHECK(*greys.begin() < 170);
}

TEST_CASE("picture: a flat scene can be looked at from elsewhere") {
  Scene scene;
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {2.0, 0.0}, {2.0, 1.0}, {0.0, 1.0}})
    scene.points.emplace_back(x, y, 0);
  scene.node_tags.assign(4, 0);
  scene.faces = {{0, 1, 2, 3}};
  scene.face_tags = {1};
  scene.surfaces = {{1, {}, 0, 1}};
  const Drawing plain = draw(scene, PictureColour::none),
                leaning = draw(scene, PictureColour::none, Viewpoint(0, -1, 1).normalized());
  CHECK(plain.size.x() == doctest::Approx(leaning.size.x()));
  CHECK(leaning.size.y() - 6 == doctest::Approx((plain.size.y() - 6) * std::sqrt(0.5)));
}
