// SPDX-License-Identifier: GPL-2.0-or-later
#include "smoothing/optimisation_based.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "smoothing/distortion.hpp"

namespace qmorph::smoothing {
namespace {

using kernel::Mesh;

struct Element {
  Index face;
  bool valid;
  double metric;
  Vec2 gradient = Vec2::Zero();  ///< of the metric by the node's position
};

std::vector<Element> elements_around(const Mesh& mesh, Index v, double coincidence) {
  std::vector<Element> elements;
  for (Index h : mesh.around(v)) {
    const Index f = mesh.face(h);
    if (f != kNone) elements.push_back({f, mesh.is_valid_face(f), distortion(mesh, f, coincidence)});
  }
  return elements;
}

/// By differences, as the thesis does.
void find_gradients(Mesh& mesh, Index v, double delta, double coincidence, std::vector<Element>& elements) {
  const Vec2 start = mesh.point(v);
  for (int axis = 0; axis < 2; ++axis) {
    mesh.set_point(v, start + delta * Vec2::Unit(axis));
    for (Element& e : elements) e.gradient[axis] = (distortion(mesh, e.face, coincidence) - e.metric) / delta;
  }
  mesh.set_point(v, start);
}

/// Along the gradient of `worst`, where the first of the others would be as bad as it is by then; 0 if none would.
double predicted_step(const std::vector<Element>& elements, const Element& worst) {
  const double rise = worst.gradient.squaredNorm();
  double step = std::numeric_limits<double>::infinity();
  for (const Element& e : elements) {
    const double closing = rise - worst.gradient.dot(e.gradient);
    if (closing > 0 && e.metric > worst.metric) step = std::min(step, (e.metric - worst.metric) / closing);
  }
  return step < std::numeric_limits<double>::infinity() ? step : 0;
}

struct Lengths {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
};

Lengths edge_lengths(const Mesh& mesh, Index v) {
  Lengths lengths;
  for (Index h : mesh.around(v)) {
    lengths.shortest = std::min(lengths.shortest, mesh.length(h));
    lengths.longest = std::max(lengths.longest, mesh.length(h));
  }
  return lengths;
}

}  // namespace

double optimise_node(Mesh& mesh, Index v, const ThesisSmoothing& options) {
  if (!mesh.is_live_vertex(v) || !mesh.is_free(v)) return 0;
  constexpr int kMostHalvings = 8;
  const Lengths lengths = edge_lengths(mesh, v);
  const double edge = mesh.mean_edge(v);
  std::vector<Element> elements = elements_around(mesh, v, options.coincidence);
  find_gradients(mesh, v, options.delta_factor * lengths.longest, options.coincidence, elements);
  const Element& worst = *std::min_element(elements.begin(), elements.end(),
                                           [](const Element& a, const Element& b) { return a.metric < b.metric; });
  const double slope = worst.gradient.norm();
  if (!(slope > 0)) return 0;
  double step = predicted_step(elements, worst);
  if (step == 0) step = options.gamma * lengths.shortest / slope;
  step = std::min(step, lengths.longest / slope);  // beyond that a linear prediction says nothing

  const Vec2 start = mesh.point(v);
  const auto is_good = [&] {
    return std::all_of(elements.begin(), elements.end(), [&](const Element& e) {
      return distortion(mesh, e.face, options.coincidence) >= worst.metric + options.least_gain &&
             (!e.valid || mesh.is_valid_face(e.face));
    });
  };
  for (int i = 0; i < kMostHalvings; ++i, step /= 2) {
    mesh.set_point(v, start + step * worst.gradient);
    if (is_good()) return step * slope / edge;
  }
  mesh.set_point(v, start);
  return 0;
}

}  // namespace qmorph::smoothing
