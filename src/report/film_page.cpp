// SPDX-License-Identifier: GPL-2.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "report/page.hpp"
#include "report/page_parts.hpp"
#include "report/page_sources.hpp"
#include "report/version.hpp"

namespace qmorph::report {
namespace {

using Json = nlohmann::ordered_json;
using Vec2 = Eigen::Vector2d;

/// A film, and where it is seen: a point (x, y) of it at `at + x * u + y * w`.
struct PlacedFilm {
  const Film* film = nullptr;
  int surface = 0;
  Vec2 at = Vec2::Zero(), u = Vec2::Zero(), w = Vec2::Zero();
};

/// Directions in which films are laid out flat.
struct PageAxes {
  Eigen::Vector3d origin, right, up;
  Vec2 flat(const Eigen::Vector3d& d) const { return {d.dot(right), d.dot(up)}; }
};

Eigen::Vector3d normal_of(const Film& film) { return film.axis_u.cross(film.axis_v).stableNormalized(); }

PageAxes axes_of(const Film& film) {
  Eigen::Vector3d normal = normal_of(film);
  if (normal.z() > -1e-6 && std::abs(normal.z()) > 0.999)  // as the model has it
    return {film.origin, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  const Eigen::Vector3d right = film.axis_u.stableNormalized();
  return {film.origin, right, normal.cross(right)};
}

/// All films lie in one plane, or in planes that can be laid on one another.
bool in_one_plane(const std::vector<PlacedFilm>& films) {
  constexpr double kParallel = 0.9999;
  const Eigen::Vector3d normal = normal_of(*films.front().film);
  return std::all_of(films.begin(), films.end(),
                     [&](const PlacedFilm& f) { return std::abs(normal.dot(normal_of(*f.film))) > kParallel; });
}

void place(PlacedFilm& placed, const PageAxes& axes) {
  placed.at = axes.flat(placed.film->origin - axes.origin);
  placed.u = axes.flat(placed.film->axis_u);
  placed.w = axes.flat(placed.film->axis_v);
}

/// The box around a film in the plane.
Eigen::AlignedBox2d box_of(const PlacedFilm& placed) {
  Eigen::AlignedBox2d box;
  for (const auto& p : placed.film->points) box.extend(placed.at + p[0] * placed.u + p[1] * placed.w);
  return box;
}

/// Surfaces in several planes: each flat, one beside the other.
void lay_out_in_a_row(std::vector<PlacedFilm>& films) {
  constexpr double kGap = 0.1;
  double x = 0;
  for (std::size_t first = 0, end; first < films.size(); first = end) {
    for (end = first; end < films.size() && films[end].surface == films[first].surface;) ++end;
    const PageAxes axes = axes_of(*films[first].film);
    Eigen::AlignedBox2d box;
    for (std::size_t i = first; i < end; ++i) place(films[i], axes), box.extend(box_of(films[i]));
    for (std::size_t i = first; i < end; ++i) films[i].at += Vec2(x, 0) - box.min();
    x += (1 + kGap) * box.sizes().x();
  }
}

std::vector<PlacedFilm> placed_films(const ModelReport& model, const Recorder& recorder) {
  std::vector<PlacedFilm> films;
  for (const SurfaceReport& surface : model.surfaces)
    if (const History* history = recorder.find(surface))
      for (const Film& film : history->films) films.push_back({&film, surface.tag});
  if (films.empty()) return films;
  if (!in_one_plane(films)) {
    lay_out_in_a_row(films);
  } else {
    const PageAxes axes = axes_of(*films.front().film);
    for (PlacedFilm& film : films) place(film, axes);
  }
  // Numbers on the page have 32 bits: the middle is the origin.
  Eigen::AlignedBox2d box;
  for (const PlacedFilm& film : films) box.extend(box_of(film));
  for (PlacedFilm& film : films) film.at -= box.center();
  return films;
}

Json vector_json(const Vec2& v) { return {v.x(), v.y()}; }

/// Numbers as differences to the one before, in the film's coding of signed numbers.
class Differences {
 public:
  void put(std::int64_t number, std::int64_t before) {
    const std::int64_t d = number - before;
    std::uint64_t rest = d >= 0 ? 2 * std::uint64_t(d) : 2 * std::uint64_t(-(d + 1)) + 1;
    for (; rest >= 128; rest >>= 7) bytes_.push_back(std::uint8_t(rest | 128));
    bytes_.push_back(std::uint8_t(rest));
  }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

std::vector<std::uint8_t> packed_points(const Film& film) {
  Differences numbers;
  std::array<std::int32_t, 2> before{};
  for (const auto& p : film.points) {
    for (std::size_t i : {0, 1}) numbers.put(p[i], before[i]);
    before = p;
  }
  return numbers.bytes();
}

/// For each face the number of its corners and the corners.
std::vector<std::uint8_t> packed_faces(const Film& film) {
  Differences numbers;
  Index before = 0;
  for (const auto& f : film.faces) {
    const int corners = f[0] == kNone ? 0 : f[3] == kNone ? 3 : 4;
    numbers.put(corners, 0);
    for (int i = 0; i < corners; ++i) numbers.put(f[std::size_t(i)], before), before = f[std::size_t(i)];
  }
  return numbers.bytes();
}

Json region_json(const PlacedFilm& placed, Blob& blob) {
  const Film& film = *placed.film;
  Json json{{"surface", placed.surface},  {"at", vector_json(placed.at)},      {"u", vector_json(placed.u)},
            {"w", vector_json(placed.w)}, {"corner_angle", film.corner_angle}, {"step_count", film.steps}};
  json["point_count"] = film.points.size();
  json["face_count"] = film.faces.size();
  json["points"] = blob.add(std::span<const std::uint8_t>(packed_points(film)));
  json["faces"] = blob.add(std::span<const std::uint8_t>(packed_faces(film)));
  json["steps"] = blob.add(std::span<const std::uint8_t>(film.bytes));
  return json;
}

}  // namespace

std::string film_page(const ModelReport& model, const Recorder& recorder, const RunFacts& facts) {
  Blob blob;
  Json json{{"kind", "film"},
            {"version", kVersion},
            {"command", command_line(facts.arguments)},
            {"input", facts.input},
            {"output", facts.output}};
  json["regions"] = Json::array();
  for (const PlacedFilm& film : placed_films(model, recorder)) json["regions"].push_back(region_json(film, blob));
  return fill_page(kFilmPage, "front of " + file_name(facts.output) + " – qmorph", json, blob);
}

}  // namespace qmorph::report
