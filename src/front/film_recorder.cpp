#include "front/film_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/sort_unique.hpp"

namespace qmorph::front {
namespace {

/// Smaller movements are not recorded, relative to a short edge of the mesh: nobody sees them.
constexpr double kQuantum = 1.0 / 16;
/// The edge that counts as short: so many are shorter.
constexpr double kShortEdges = 0.02;
constexpr double kMostSteps = 1 << 30;  // from one side of the region to the other
constexpr std::array<Index, 4> kNoFace{kNone, kNone, kNone, kNone};

double short_edge(const kernel::Mesh& mesh) {
  std::vector<double> lengths;
  for (Index h = 0; h < mesh.half_edge_slots(); h += 2)
    if (mesh.is_live_half_edge(h)) lengths.push_back(mesh.length(h));
  if (lengths.empty()) return 1;
  const auto at = lengths.begin() + std::ptrdiff_t(kShortEdges * double(lengths.size()));
  std::nth_element(lengths.begin(), at, lengths.end());
  return *at;
}

std::array<Index, 4> corners_of(const kernel::Mesh& mesh, Index f) {
  std::array<Index, 4> corners = kNoFace;
  if (f >= mesh.face_slots() || !mesh.is_live_face(f)) return corners;
  Index h = mesh.half_edge(f);
  for (Index i = 0; i < mesh.degree(f) && i < 4; ++i, h = mesh.next(h)) corners[i] = mesh.origin(h);
  return corners;
}

Index count_corners(const std::array<Index, 4>& corners) {
  return corners[0] == kNone ? 0 : corners[3] == kNone ? 3 : 4;
}

}  // namespace

FilmRecorder::FilmRecorder(const kernel::Mesh& mesh, double corner_angle)
    : mesh_(mesh), film_(std::make_shared<Film>()), corner_(Eigen::Vector2d::Zero()) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_live_vertex(v)) low = low.cwiseMin(mesh.point(v)), high = high.cwiseMax(mesh.point(v));
  if (low.x() <= high.x()) corner_ = low;
  quantum_ =
      std::max({kQuantum * short_edge(mesh), (high - low).maxCoeff() / kMostSteps, std::numeric_limits<double>::min()});
  places_.resize(mesh.vertex_slots(), Place{});
  seen_.resize(mesh.vertex_slots(), false);
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_live_vertex(v)) places_[v] = place(v), seen_[v] = true;
  for (Index f = 0; f < mesh.face_slots(); ++f) faces_.push_back(corners_of(mesh, f));
  film_->corner_angle = corner_angle;
  film_->origin = {corner_.x(), corner_.y(), 0};
  film_->axis_u *= quantum_;
  film_->axis_v *= quantum_;
  film_->points = places_;
  film_->faces = faces_;
}

FilmRecorder::Place FilmRecorder::place(Index v) const {
  const Vec2 p = (mesh_.point(v) - corner_) / quantum_;
  const auto rounded = [](double x) {
    return std::int32_t(std::lround(std::clamp(x, -kMostSteps, 2 * kMostSteps - 1)));
  };
  return {rounded(p.x()), rounded(p.y())};
}

void FilmRecorder::put(std::uint64_t number) {
  for (; number >= 128; number >>= 7) film_->bytes.push_back(std::uint8_t(number | 128));
  film_->bytes.push_back(std::uint8_t(number));
}

void FilmRecorder::put_signed(std::int64_t number) {
  put(number >= 0 ? 2 * std::uint64_t(number) : 2 * std::uint64_t(-(number + 1)) + 1);
}

void FilmRecorder::record(FilmStep kind, Index base_origin, Index base_target, const StepNotes& notes, Front& front) {
  ++film_->steps;
  near_ = base_origin;
  film_->bytes.push_back(std::uint8_t(kind));
  if (kind == FilmStep::quad) {
    film_->bytes.push_back(
        std::uint8_t(unsigned(notes.left) + 8 * unsigned(notes.right) + 64 * unsigned(notes.met_front)));
    put(notes.swaps);
  }
  put(base_origin);
  put_near(base_target);
  record_nodes();
  record_faces();
  record_levels(front);
}

void FilmRecorder::record_nodes() {
  changed_.clear();
  places_.resize(mesh_.vertex_slots(), Place{});
  seen_.resize(mesh_.vertex_slots(), false);
  mesh_.for_edited_vertices([&](Index v) {
    if (mesh_.is_live_vertex(v) && (!seen_[v] || place(v) != places_[v])) changed_.push_back(v);
  });
  sort_unique(changed_);
  put(changed_.size());
  Index before = near_;
  for (Index v : changed_) {
    put_signed(std::int64_t(v) - std::int64_t(before));
    const Place from = seen_[v] ? places_[v] : places_[near_], to = place(v);
    for (int i : {0, 1}) put_signed(std::int64_t(to[i]) - std::int64_t(from[i]));
    before = v;
  }
  // Only now: places are relative to what the last step has left.
  for (Index v : changed_) places_[v] = place(v), seen_[v] = true;
}

void FilmRecorder::record_faces() {
  changed_.clear();
  faces_.resize(mesh_.face_slots(), kNoFace);
  const auto note = [&](Index f) {
    if (f != kNone && f < faces_.size() && corners_of(mesh_, f) != faces_[f]) changed_.push_back(f);
  };
  mesh_.for_edited_faces(note);
  mesh_.for_edited_half_edges([&](Index h) { note(mesh_.face(h)); });
  sort_unique(changed_);
  put(changed_.size());
  Index before = 0;
  for (Index f : changed_) {
    faces_[f] = corners_of(mesh_, f);
    put_signed(std::int64_t(f) - std::int64_t(before));
    const Index corners = count_corners(faces_[f]);
    put(corners);
    for (Index i = 0; i < corners; ++i) put_near(faces_[f][i]);
    before = f;
  }
}

void FilmRecorder::record_levels(Front& front) {
  changed_.clear();
  levels_.resize(mesh_.half_edge_slots());
  const auto note = [&](Index h) {
    if (!mesh_.is_live_half_edge(h) || !front.contains(h)) return;
    const Level now{mesh_.origin(h), mesh_.target(h), front.level(h)};
    Level& last = levels_[h];
    if (now.origin == last.origin && now.target == last.target && now.level == last.level) return;
    last = now;
    changed_.push_back(h);
  };
  mesh_.for_edited_half_edges(note);
  front.levels().for_logged(note);
  put(changed_.size());
  for (Index h : changed_) {
    put_near(mesh_.origin(h));
    put_near(mesh_.target(h));
    put(front.level(h));
  }
}

}  // namespace qmorph::front
