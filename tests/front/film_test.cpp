/// What is recorded of the front.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "front/film_recorder.hpp"
#include "front/fixture.hpp"
#include "front/morph.hpp"
#include "qmorph/convert.hpp"
#include "support/domains.hpp"

using namespace qmorph;

namespace {

/// Plays a film as include/qmorph/film.hpp says.
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
  std::map<FilmStep, int> kinds;

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
    const FilmStep kind = FilmStep(film_.bytes.at(at_++));
    ++kinds[kind];
    if (kind == FilmStep::quad) ++at_, number();
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

/// Corners in order from the smallest.
std::array<Index, 4> turned(std::array<Index, 4> face) {
  const auto end = face[3] == kNone ? face.begin() + 3 : face.end();
  std::rotate(face.begin(), std::min_element(face.begin(), end), end);
  return face;
}

std::set<std::array<Index, 4>> live_faces(const std::vector<std::array<Index, 4>>& faces) {
  std::set<std::array<Index, 4>> live;
  for (const auto& face : faces)
    if (face[0] != kNone) live.insert(turned(face));
  return live;
}

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

}  // namespace

TEST_CASE("film: played to its end it is the mesh that the front made, to a fraction of an edge") {
  int quads = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    test::Rng rng(seed);
    kernel::Mesh mesh = test::random_mesh(rng);
    front::FilmRecorder recorder(mesh, FrontOptions{}.corner_angle);
    front::morph(mesh, {}, false, {}, &recorder);
    const std::shared_ptr<Film> film = recorder.finish();
    const Player player(*film);
    CHECK(player.is_at_end());
    CHECK(live_faces(player.faces) == live_faces(mesh));
    for (Index v = 0; v < mesh.vertex_slots(); ++v)
      if (mesh.is_live_vertex(v)) CHECK((player.point(v).head<2>() - mesh.point(v)).norm() <= film->axis_u.norm());
    quads += player.kinds.contains(FilmStep::quad) ? player.kinds.at(FilmStep::quad) : 0;
    // A level is the number of rows behind it: none is missing between two.
    unsigned highest = 0;
    std::set<unsigned> found;
    for (const auto& [edge, level] : player.levels) highest = std::max(highest, level), found.insert(level);
    for (unsigned level = 1; level <= highest; ++level) CHECK(found.contains(level));
  }
  CHECK(quads > 500);
}

TEST_CASE("film: nothing changes for being watched") {
  for (std::uint64_t seed = 20; seed < 26; ++seed) {
    const test::Domain domain = test::random_domain(seed);
    Options watched;
    watched.record_film = true;
    const QuadMesh plain = convert(domain.patch), filmed = convert(domain.patch, watched);
    CHECK(plain.points == filmed.points);
    CHECK(plain.quads == filmed.quads);
    CHECK(plain.stats.films.empty());
    CHECK(filmed.stats.films.size() == filmed.stats.regions);
  }
}

TEST_CASE("stages: each surface is kept as it was after each stage, if asked") {
  Options options;
  options.measure_stages = options.keep_stages = true;
  const QuadMesh mesh = convert(test::random_domain(3).patch, options);
  REQUIRE(mesh.stats.stages.size() == kStages);
  for (const StageFigures& stage : mesh.stats.stages) REQUIRE(stage.meshes.size() == 1);
  CHECK(mesh.stats.stages.front().meshes[0]->quads.empty());
  CHECK(mesh.stats.stages.back().meshes[0]->quads == mesh.quads);
}
