// SPDX-License-Identifier: GPL-2.0-or-later
#include "front/step_reporter.hpp"

#include <limits>

#include "kernel/sort_unique.hpp"

namespace qmorph::front {
namespace {

std::array<Index, 4> corners_of(const kernel::Mesh& mesh, Index f) {
  std::array<Index, 4> corners{kNone, kNone, kNone, kNone};
  if (f >= mesh.face_slots() || !mesh.is_live_face(f)) return corners;
  Index h = mesh.half_edge(f);
  for (Index i = 0; i < mesh.degree(f) && i < 4; ++i, h = mesh.next(h)) corners[i] = mesh.origin(h);
  return corners;
}

}  // namespace

StepReporter::StepReporter(const kernel::Mesh& mesh, Front& front, const std::vector<State>& states,
                           double corner_angle, const MorphSettings& settings)
    : mesh_(mesh), front_(front), states_(states), was_front_(mesh.half_edge_slots(), false) {
  std::vector<Eigen::Vector2d> points(mesh.vertex_slots(),
                                      Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN()));
  for (Index v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.is_live_vertex(v)) points[v] = mesh.point(v);
  std::vector<Eigen::Vector3d> places;
  for (Index v = 0; settings.lift && v < mesh.vertex_slots(); ++v)
    places.push_back(mesh.is_live_vertex(v) ? settings.lift(points[v]) : Eigen::Vector3d::Zero());
  std::vector<std::array<Index, 4>> faces;
  for (Index f = 0; f < mesh.face_slots(); ++f) faces.push_back(corners_of(mesh, f));
  for (Index h = 0; h < mesh.half_edge_slots(); ++h)
    if (is_front(h)) edges_.push_back(edge(h)), was_front_[h] = true;
  FrontStart start;
  start.frame = settings.frame;
  start.places = places;
  start.corner_angle = corner_angle;
  start.points = points;
  start.faces = faces;
  start.edges = edges_;
  watcher_ = settings.observer->front_starts(start);
}

FrontEdge StepReporter::edge(Index h) const {
  return {h, mesh_.origin(h), mesh_.target(h), front_.level(h), states_[h].left, states_[h].right};
}

void StepReporter::report(const TakenStep& step) {
  collect_nodes();
  collect_faces();
  collect_edges();
  restated_.clear();
  for (Index h : step.restated)
    if (is_front(h)) restated_.push_back(edge(h));
  FrontStep told;
  told.kind = step.kind;
  told.base_origin = step.base_origin;
  told.base_target = step.base_target;
  if (step.kind == StepKind::quad) {
    told.left = step.notes.left;
    told.right = step.notes.right;
    told.met_front = step.notes.met_front;
    told.swaps = step.notes.swaps;
  }
  told.nodes = nodes_;
  told.faces = faces_;
  told.edges = edges_;
  told.restated = restated_;
  told.gone = gone_;
  watcher_->step(told);
}

void StepReporter::collect_nodes() {
  changed_.clear();
  nodes_.clear();
  mesh_.for_edited_vertices([&](Index v) {
    if (mesh_.is_live_vertex(v)) changed_.push_back(v);
  });
  sort_unique(changed_);
  for (Index v : changed_) nodes_.push_back({v, mesh_.point(v)});
}

void StepReporter::collect_faces() {
  changed_.clear();
  faces_.clear();
  mesh_.for_edited_faces([&](Index f) { changed_.push_back(f); });
  mesh_.for_edited_half_edges([&](Index h) { changed_.push_back(mesh_.face(h)); });
  sort_unique(changed_);
  for (Index f : changed_)
    if (f < mesh_.face_slots()) faces_.push_back({f, corners_of(mesh_, f)});
}

void StepReporter::collect_edges() {
  edges_.clear();
  gone_.clear();
  listed_.clear();
  was_front_.resize(mesh_.half_edge_slots(), false);
  mesh_.for_edited_half_edges([&](Index h) { look_at(h); });
  front_.levels().for_logged([&](Index h) { look_at(h); });
  // What lies behind an edge may have changed without it.
  mesh_.for_edited_half_edges([&](Index h) {
    const Index other = kernel::Mesh::twin(h);
    if (was_front_[other] && !is_front(other)) look_at(other);
  });
  for (Index h : gone_) was_front_[h] = false;
}

void StepReporter::look_at(Index h) {
  if (!is_front(h)) {
    if (was_front_[h] && listed_.insert(h)) gone_.push_back(h);
    return;
  }
  was_front_[h] = true;
  if (listed_.insert(h)) edges_.push_back(edge(h));
}

}  // namespace qmorph::front
