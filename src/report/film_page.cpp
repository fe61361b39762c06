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
using Vec3 = Eigen::Vector3d;

/// A film, and where it is seen: a point (x, y) of it at `at + x * u + y * w`, along the frame's axes; those of a
/// curved surface at their places.
struct PlacedFilm {
  const Film* film = nullptr;
  int surface = 0;
  Vec3 at = Vec3::Zero(), u = Vec3::Zero(), w = Vec3::Zero();
};

Vec3 point_of(const Film& film, std::size_t i) {
  if (!film.places.empty()) return film.places[i];
  return film.origin + film.points[i][0] * film.axis_u + film.points[i][1] * film.axis_v;
}

/// The frame that all points lie in, or one for a scene in space.
Frame frame_of(const std::vector<PlacedFilm>& films) {
  constexpr double kFlat = 1e-6, kAlongZ = 1 - 1e-9;
  Frame frame;
  Eigen::AlignedBox3d box;
  for (const PlacedFilm& placed : films)
    for (std::size_t i = 0; i < placed.film->points.size(); ++i) box.extend(point_of(*placed.film, i));
  if (box.isEmpty()) return frame;
  frame.centre = box.center();
  frame.radius = std::max(0.5 * box.sizes().norm(), std::numeric_limits<double>::min());
  const Film& first = *films.front().film;
  const Vec3 normal = first.axis_u.cross(first.axis_v).stableNormalized();
  if (normal.z() <= kAlongZ) {  // else as the model has it
    frame.right = right_of(normal);
    frame.up = normal.cross(frame.right);
  }
  for (const PlacedFilm& placed : films) {
    frame.flat = frame.flat && placed.film->places.empty();
    for (std::size_t i = 0; frame.flat && i < placed.film->points.size(); ++i)
      frame.flat = std::abs(frame.to_frame(point_of(*placed.film, i)).z()) <= kFlat * frame.radius;
  }
  if (!frame.flat) frame.right = Vec3::UnitX(), frame.up = Vec3::UnitZ();
  return frame;
}

std::vector<PlacedFilm> placed_films(const ModelReport& model, const Recorder& recorder) {
  std::vector<PlacedFilm> films;
  for (const SurfaceReport& surface : model.surfaces)
    if (const History* history = recorder.find(surface))
      for (const Film& film : history->films) films.push_back({&film, surface.tag});
  return films;
}

void place(PlacedFilm& placed, const Frame& frame) {
  placed.at = frame.to_frame(placed.film->origin);
  placed.u = frame.to_frame(frame.centre + placed.film->axis_u);
  placed.w = frame.to_frame(frame.centre + placed.film->axis_v);
}

Json vector_json(const Vec3& v, const Frame& frame) {
  if (frame.flat) return {v.x(), v.y()};
  return {v.x(), v.y(), v.z()};
}

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

Json region_json(const PlacedFilm& placed, const Frame& frame, Blob& blob) {
  const Film& film = *placed.film;
  Json json{{"surface", placed.surface},         {"at", vector_json(placed.at, frame)},
            {"u", vector_json(placed.u, frame)}, {"w", vector_json(placed.w, frame)},
            {"corner_angle", film.corner_angle}, {"step_count", film.steps}};
  json["point_count"] = film.points.size();
  json["face_count"] = film.faces.size();
  json["points"] = blob.add(std::span<const std::uint8_t>(packed_points(film)));
  json["faces"] = blob.add(std::span<const std::uint8_t>(packed_faces(film)));
  if (!film.places.empty()) {
    std::vector<float> places;
    for (const Vec3& p : film.places)
      for (double x : frame.to_frame(p)) places.push_back(float(x));
    json["places"] = blob.add(std::span<const float>(places));
  }
  json["steps"] = blob.add(std::span<const std::uint8_t>(film.bytes));
  return json;
}

}  // namespace

std::string film_page(const ModelReport& model, const Recorder& recorder, const RunFacts& facts,
                      const Viewpoint& from) {
  std::vector<PlacedFilm> films = placed_films(model, recorder);
  const Frame frame = frame_of(films);
  const Turn turn = frame.flat ? Turn{} : turn_of(frame, from);
  Blob blob;
  Json json{{"kind", "film"},
            {"version", kVersion},
            {"command", command_line(facts.arguments)},
            {"input", facts.input},
            {"output", facts.output}};
  const Vec3& c = frame.centre;
  json["frame"] = {{"centre", {c.x(), c.y(), c.z()}}, {"flat", frame.flat}, {"turned", {turn.up, turn.right}}};
  json["regions"] = Json::array();
  for (PlacedFilm& film : films) {
    place(film, frame);
    json["regions"].push_back(region_json(film, frame, blob));
  }
  return fill_page(kFilmPage, "front of " + file_name(facts.output) + " – qmorph", json, blob);
}

}  // namespace qmorph::report
