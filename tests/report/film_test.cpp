// SPDX-License-Identifier: GPL-2.0-or-later
/// What is recorded of the front, byte by byte.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <set>

#include "front/fixture.hpp"
#include "front/morph.hpp"
#include "qmorph/convert.hpp"
#include "report/film.hpp"
#include "support/surfaces.hpp"
#include "support/watcher.hpp"

using namespace qmorph;
using qmorph::report::Film;
using qmorph::report::FilmRecorder;
using qmorph::test::live_faces;
using qmorph::test::turned;

namespace {

/// Plays a film as report/film.hpp says.
class Player {
 public:
  explicit Player(const Film& film) : film_(film), faces(film.faces) {
    for (const auto& p : film.points) points.push_back({p[0], p[1]});
    seen_.assign(points.size(), true);
    for (std::size_t step = 0; step < film.steps; ++step) play();
  }
  bool is_at_end() const { return at_ == film_.bytes.size(); }
  Eigen::Vector3d point(Index v) const {
    return film_.origin + double(points[v][0]) * film_.axis_u + double(points[v][1]) * film_.axis_v;
  }

 private:
  const Film& film_;
  std::size_t at_ = 0;
  std::vector<bool> seen_;

 public:
  std::vector<std::array<std::int64_t, 2>> points;
  std::vector<std::array<Index, 4>> faces;
  std::map<std::array<Index, 2>, unsigned> levels;
  std::map<StepKind, int> kinds;

 private:
  std::uint64_t number() {
    std::uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      const std::uint8_t byte = film_.bytes.at(at_++);
      value |= std::uint64_t(byte & 127) << shift;
      if (byte < 128) return value;
    }
  }
  std::int64_t signed_number() {
    const std::uint64_t n = number();
    return n % 2 ? -std::int64_t(n / 2) - 1 : std::int64_t(n / 2);
  }
  Index near(Index v) { return Index(std::int64_t(v) + signed_number()); }

  void play() {
    const StepKind kind = StepKind(film_.bytes.at(at_++));
    ++kinds[kind];
    if (kind == StepKind::quad) ++at_, number();
    const Index base = Index(number());
    near(base);
    const auto from = points[base];
    Index v = base;
    for (std::uint64_t i = number(); i > 0; --i) {
      v = near(v);
      if (v >= points.size()) points.resize(v + 1), seen_.resize(v + 1, false);
      if (!seen_[v]) points[v] = from;
      seen_[v] = true;
      for (auto& x : points[v]) x += signed_number();
    }
    Index f = 0;
    for (std::uint64_t i = number(); i > 0; --i) {
      f = near(f);
      if (f >= faces.size()) faces.resize(f + 1, {kNone, kNone, kNone, kNone});
      faces[f].fill(kNone);
      const std::uint64_t corners = number();
      for (std::size_t c = 0; c < corners; ++c) faces[f][c] = near(base);
    }
    for (std::uint64_t i = number(); i > 0; --i) {
      const Index a = near(base), b = near(base);
      levels[{a, b}] = unsigned(number());
    }
  }
};

std::set<std::array<Index, 4>> live_faces(const kernel::Mesh& mesh) {
  std::set<std::array<Index, 4>> live;
  for (Index f = 0; f < mesh.face_slots(); ++f) {
    if (!mesh.is_live_face(f)) continue;
    std::array<Index, 4> face{kNone, kNone, kNone, kNone};
    Index h = mesh.half_edge(f);
    for (Index i = 0; i < mesh.degree(f); ++i, h = mesh.next(h)) face[i] = mesh.origin(h);
    live.insert(turned(face));
  }
  return live;
}

struct FilmMaker : Observer {
  std::unique_ptr<FrontObserver> front_starts(const FrontStart& start) override {
    return std::make_unique<FilmRecorder>(start);
  }
};

}  // namespace

TEST_CASE("film: played to its end it is the mesh that the front made, to a fraction of an edge") {
  int quads = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    test::Rng rng(seed);
    kernel::Mesh mesh = test::random_mesh(rng);
    FilmMaker maker;
    const auto recorder = front::morph(mesh, {}, {.observer = &maker});
    const Film film = static_cast<FilmRecorder&>(*recorder).finish();
    const Player player(film);
    CHECK(player.is_at_end());
    CHECK(live_faces(player.faces) == live_faces(mesh));
    for (Index v = 0; v < mesh.vertex_slots(); ++v)
      if (mesh.is_live_vertex(v)) CHECK((player.point(v).head<2>() - mesh.point(v)).norm() <= film.axis_u.norm());
    quads += player.kinds.contains(StepKind::quad) ? player.kinds.at(StepKind::quad) : 0;
    // A level is the number of rows behind it: none is missing between two.
    unsigned highest = 0;
    std::set<unsigned> found;
    for (const auto& [edge, level] : player.levels) highest = std::max(highest, level), found.insert(level);
    for (unsigned level = 1; level <= highest; ++level) CHECK(found.contains(level));
  }
  CHECK(quads > 500);
}

TEST_CASE("film: nodes of a curved surface have positions on it, those of a plane need none") {
  struct Places : Observer {
    std::size_t nodes = 0, curved = 0;
    double least = 1, most = 1;  // distances from the middle of a sphere
    std::unique_ptr<FrontObserver> front_starts(const FrontStart& start) override {
      const std::scoped_lock lock(mutex);
      curved += start.places.size();
      for (std::size_t v = 0; v < start.points.size(); ++v) {
        if (std::isnan(start.points[v].x())) continue;
        ++nodes;
        if (start.places.empty()) continue;
        least = std::min(least, start.places[v].norm()), most = std::max(most, start.places[v].norm());
      }
      return nullptr;
    }
    std::mutex mutex;
  };
  test::Rng rng(3);
  const Patch sphere = test::sphere(0.25, rng);
  Places places;
  Options options;
  options.observer = &places;
  convert(sphere, options);
  CHECK(places.nodes > sphere.points.size() / 2);
  CHECK(places.curved >= places.nodes);
  CHECK(places.least > 0.9);
  CHECK(places.most < 1.001);

  Places flat;
  options.observer = &flat;
  Patch square;
  square.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  convert(square, options);
  CHECK(flat.nodes > 0);
  CHECK(flat.curved == 0);
}
