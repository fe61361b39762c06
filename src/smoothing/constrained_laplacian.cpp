// SPDX-License-Identifier: GPL-2.0-or-later
#include "smoothing/constrained_laplacian.hpp"

#include <algorithm>
#include <vector>

#include "smoothing/distortion.hpp"
#include "topology/edits.hpp"

namespace qmorph::smoothing {
namespace {

using kernel::Mesh;

struct State {
  double metric;
  bool valid;
};

template <class Visit>
void visit_faces(const Mesh& mesh, Index v, const Visit& visit) {
  for (Index h : mesh.around(v))
    if (mesh.face(h) != kNone) visit(mesh.face(h));
}

std::vector<State> states_around(const Mesh& mesh, Index v, double coincidence) {
  std::vector<State> states;
  visit_faces(mesh, v, [&](Index f) { states.push_back({distortion(mesh, f, coincidence), mesh.is_valid_face(f)}); });
  return states;
}

double largest_angle_of(const Mesh& mesh, Index f) {
  double largest = 0;
  for (Index h : mesh.sides_of(f)) largest = std::max(largest, ccw_angle(mesh.vector(h), -mesh.vector(mesh.prev(h))));
  return largest;
}

Change compare(const Mesh& mesh, Index v, const std::vector<State>& before, const ThesisSmoothing& options) {
  const auto grade = [&](double metric) { return metric < 0 ? 0 : metric < options.least_quality ? 1 : 2; };
  Change change;
  std::size_t i = 0;
  visit_faces(mesh, v, [&](Index f) {
    const State& old = before[i++];
    const double metric = distortion(mesh, f, options.coincidence);
    ++change.elements;
    change.better += metric > old.metric;
    change.worse += metric < old.metric;
    change.much_better += grade(metric) > grade(old.metric);
    change.much_worse += grade(metric) < grade(old.metric);
    change.mean_change += metric - old.metric;
    change.largest_angle = std::max(change.largest_angle, largest_angle_of(mesh, f));
    change.inverts = change.inverts || (old.valid && !mesh.is_valid_face(f));
  });
  change.mean_change /= change.elements;
  return change;
}

}  // namespace

bool is_acceptable(const Change& change, const ThesisSmoothing& options) {
  if (change.worse == change.elements || change.inverts || change.much_worse > change.much_better ||
      change.mean_change < -options.least_quality || change.largest_angle > options.largest_angle)
    return false;
  return change.better == change.elements || (change.much_better > 0 && change.much_worse == 0) ||
         (change.much_better >= change.much_worse && change.mean_change > -options.least_quality);
}

double move_to_neighbours(Mesh& mesh, Index v, const ThesisSmoothing& options) {
  if (!mesh.is_live_vertex(v) || !mesh.is_free(v)) return 0;
  constexpr int kMostHalvings = 20;
  const double edge = mesh.mean_edge(v);
  const Vec2 start = mesh.point(v), way = topology::middle_of_neighbours(mesh, v) - start;
  const std::vector<State> before = states_around(mesh, v, options.coincidence);
  double share = 1;
  for (int i = 0; i < kMostHalvings && share * way.norm() > options.move_tolerance * edge; ++i, share /= 2) {
    mesh.set_point(v, start + share * way);
    if (is_acceptable(compare(mesh, v, before, options), options)) return share * way.norm() / edge;
  }
  mesh.set_point(v, start);
  return 0;
}

}  // namespace qmorph::smoothing
