// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/divide/divide.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "gmsh/divide/bands.hpp"
#include "gmsh/divide/corners.hpp"
#include "gmsh/divide/crossings.hpp"
#include "gmsh/divide/curves.hpp"
#include "gmsh/divide/cuts.hpp"
#include "gmsh/divide/tips.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "kernel/sort_unique.hpp"
#include "parity/intervals.hpp"
#include "parity/sets.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector3d;
using parity::IntervalPlan;
using parity::IntervalProblem;

/// True if embedded curves cut a surface into regions, or cut off one: each of which has a boundary of its own.
bool is_divided(const CurveModel& model, const BoundedSurface& surface) {
  std::vector<int> points;
  for (const std::vector<Index>* curves : {&surface.boundary, &surface.embedded})
    for (Index c : *curves) points.insert(points.end(), model.curves[c].ends.begin(), model.curves[c].ends.end());
  sort_unique(points);
  parity::Sets joined(points.size());
  const auto place = [&](int point) {
    return Index(std::lower_bound(points.begin(), points.end(), point) - points.begin());
  };
  for (Index c : surface.boundary) joined.unite(place(model.curves[c].ends[0]), place(model.curves[c].ends[1]));
  for (Index c : surface.embedded) {
    const Index a = place(model.curves[c].ends[0]), b = place(model.curves[c].ends[1]);
    if (joined.root(a) == joined.root(b)) return true;
    joined.unite(a, b);
  }
  return false;
}

/// What Gmsh has refused: numbers below its own of some curves, all others of others.
struct Refusals {
  std::set<Index> fewer, any;

  /// \param curves that have not become what the plan wants
  void add(const CurveModel& model, const IntervalPlan& plan, const std::set<Index>& curves) {
    for (Index c : curves) {
      const bool less = plan.segments[c] < model.curves[c].segments;
      (less && !fewer.count(c) ? fewer : any).insert(c);
    }
  }
};

/// More segments, if the task wants that. A closed curve with fewer than some would fold back.
void make_finer(parity::CurveWish& wish, const DividedCurve& curve, const DivisionTask& task) {
  constexpr int kFewAround = 6;
  const auto times = task.times.find(curve.tag);
  if (times == task.times.end() || !curve.depends_on_size() || task.kept_curves.count(curve.tag)) return;
  const bool is_closed = curve.ends[0] == curve.ends[1];
  const int least = is_closed ? kFewAround : 1;
  wish.segments = std::max(least, times->second * wish.segments);
  wish.wish = std::max(double(least), times->second * wish.wish);
}

IntervalProblem pose(const CurveModel& model, const DivisionTask& task, const Refusals& refused) {
  constexpr int kFew = 4;
  constexpr double kMostFewer = 0.75;
  IntervalProblem problem;
  for (Index c = 0; c < model.curves.size(); ++c) {
    const DividedCurve& curve = model.curves[c];
    parity::CurveWish wish;
    wish.segments = curve.is_spare ? 1 : curve.segments;
    wish.wish = curve.wish();
    make_finer(wish, curve, task);
    wish.least = wish.segments <= kFew ? wish.segments : std::max(kFew, int(std::ceil(kMostFewer * wish.segments)));
    if (refused.fewer.count(c)) wish.least = wish.segments;
    wish.fixed = !curve.depends_on_size() || task.kept_curves.count(curve.tag) || refused.any.count(c);
    if (const auto given = task.given.find(curve.tag); given != task.given.end()) {
      wish.segments = given->second;
      wish.fixed = true;
    }
    problem.curves.push_back(wish);
  }
  for (const BoundedSurface& surface : model.surfaces) {
    problem.surfaces.push_back(surface.boundary);
    if (task.structured.count(surface.tag))
      for (Index c : surface.boundary) problem.curves[c].fixed = true;
  }
  for (const BoundedSurface& surface : model.surfaces)
    if (is_divided(model, surface))  // each curve by itself, so that it does not matter which of them is around what
      for (const std::vector<Index>* curves : {&surface.boundary, &surface.embedded})
        for (Index c : *curves) problem.surfaces.push_back({c});
  heed_corners(model, problem);
  problem.images = model.images;
  problem.bands = find_bands(model);
  return problem;
}

/// A curve of the geometry, with its pieces, if it is in pieces.
struct WholeCurve {
  Index first = 0, last = 0;  ///< the rows between are its pieces
  int planned = 0, before = 0;
  bool is_changed() const { return planned != before || last - first > 1; }
};

std::vector<WholeCurve> whole_curves(const CurveModel& model, const std::vector<int>& segments) {
  std::vector<WholeCurve> whole;
  for (Index c = 0; c < model.curves.size(); ++c) {
    if (c == 0 || model.curves[c].tag != model.curves[c - 1].tag) whole.push_back({c, c, 0, 0});
    whole.back().last = c + 1;
    whole.back().planned += segments[c];
    whole.back().before += model.curves[c].segments;
  }
  return whole;
}

/// Gmsh has spread the nodes evenly; moves them to where the sizes want them, and to the ends of pieces.
void place_nodes(const CurveModel& model, const WholeCurve& whole, const std::vector<int>& segments) {
  const DividedCurve& first = model.curves[whole.first];
  const std::vector<std::pair<double, std::size_t>> nodes = nodes_along(first.tag);
  std::vector<double> parameters;
  for (Index c = whole.first; c < whole.last; ++c) {
    if (c > whole.first) parameters.push_back(model.curves[c].parameters.front());
    const std::vector<double> inside = parameters_for(model.curves[c], segments[c]);
    parameters.insert(parameters.end(), inside.begin(), inside.end());
  }
  if (nodes.size() != parameters.size()) return;
  const std::vector<Vector3d> points = points_at(first, parameters);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    ::gmsh::model::mesh::setNode(nodes[i].second, {points[i].x(), points[i].y(), points[i].z()}, {parameters[i]});
}

/// What Gmsh has been told of a curve. It would forget that it extrudes it, besides.
void undo(const DividedCurve& curve) {
  if (curve.carried)
    ::gmsh::model::mesh::setTransfiniteCurve(curve.tag, curve.segments + 1);
  else
    ::gmsh::model::mesh::removeConstraints({{1, curve.tag}});
}

/// Divides the curves as planned. \return those that Gmsh divides otherwise
std::set<Index> carry_out(const CurveModel& model, const IntervalPlan& plan) {
  std::set<Index> stubborn;
  std::vector<WholeCurve> whole = whole_curves(model, plan.segments), changed;
  for (const WholeCurve& curve : whole)
    if (curve.is_changed()) changed.push_back(curve);
  if (changed.empty()) return {};
  for (const WholeCurve& curve : changed)
    for (Index c = curve.first; c < curve.last; ++c)
      if (folds_back(model.curves[c], plan.segments[c])) stubborn.insert(c);
  if (!stubborn.empty()) return stubborn;
  const auto tag = [&](const WholeCurve& curve) { return model.curves[curve.first].tag; };
  for (const WholeCurve& curve : changed) ::gmsh::model::mesh::setTransfiniteCurve(tag(curve), curve.planned + 1);
  ::gmsh::model::mesh::generate(1);
  for (const WholeCurve& curve : whole)
    if (count_segments(tag(curve)) != curve.planned)
      for (Index c = curve.first; c < curve.last; ++c) stubborn.insert(c);
  for (const WholeCurve& curve : changed) {
    if (stubborn.empty())
      place_nodes(model, curve, plan.segments);
    else
      undo(model.curves[curve.first]);
  }
  return stubborn;
}

DivisionReport report_on(const CurveModel& model) {
  DivisionReport report;
  report.understood = true;
  for (const DividedCurve& curve : model.curves)
    if (!curve.depends_on_size() && curve.segments > 1) report.fixed.push_back(curve.tag);
  return report;
}

void add_changes(const CurveModel& model, const IntervalPlan& plan, DivisionReport& report) {
  for (const WholeCurve& whole : whole_curves(model, plan.segments)) {
    const DividedCurve& curve = model.curves[whole.first];
    report.segments[curve.tag] = whole.planned;
    if (!whole.is_changed()) continue;
    if (whole.planned != whole.before) (whole.planned > whole.before ? report.more : report.fewer).push_back(curve.tag);
    if (!curve.carried) report.told.push_back(curve.tag);
  }
}

/// Whether a curve may get nodes other than Gmsh's.
std::vector<bool> may_change(const CurveModel& model, const DivisionTask& task) {
  std::vector<bool> may;
  for (const DividedCurve& curve : model.curves)
    may.push_back(curve.depends_on_size() && !task.kept_curves.count(curve.tag) && !task.given.count(curve.tag));
  for (const BoundedSurface& surface : model.surfaces)
    if (task.structured.count(surface.tag))
      for (Index c : surface.boundary) may[c] = false;
  return may;
}

}  // namespace

std::map<int, int> find_divided_further(const DivisionReport& report) {
  std::map<int, int> further;
  for (const auto& [curve, segments] : report.segments)
    if (const int now = count_segments(curve); now != segments) further[curve] = now;
  return further;
}

bool has_odd_boundary(int surface) {
  constexpr int kTriangle = 2;
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  ::gmsh::model::mesh::getElements(types, tags, nodes, 2, surface);
  std::size_t triangles = 0;
  for (std::size_t i = 0; i < types.size(); ++i) triangles += types[i] == kTriangle ? tags[i].size() : 0;
  return triangles % 2 != 0;
}

void forget_division(const DivisionReport& report) {
  ::gmsh::vectorpair entities;
  for (int curve : report.told) entities.emplace_back(1, curve);
  if (!entities.empty()) ::gmsh::model::mesh::removeConstraints(entities);
}

DivisionReport divide_curves(const DivisionTask& task) {
  constexpr int kRounds = 4;
  constexpr double kSimplePairing = 0;  // the only one of Gmsh's ways to recombine for which numbers may be odd
  const ScopedOption all("Mesh.RecombineAll", 0), algorithm("Mesh.RecombinationAlgorithm", kSimplePairing);
  std::optional<CurveModel> model = divide_as_wished(task.surfaces);
  if (!model) return {};
  DivisionReport report = report_on(*model);
  const std::vector<bool> may = may_change(*model, task);
  model = cut_at_narrow_places(mark_tips(std::move(*model), may), may);
  Refusals refused;
  for (int round = 0; round < kRounds; ++round) {
    const IntervalPlan plan = parity::plan_intervals(pose(*model, task, refused));
    const std::set<Index> others = carry_out(*model, plan);
    refused.add(*model, plan, others);
    if (!others.empty()) continue;
    if (std::any_of(model->surfaces.begin(), model->surfaces.end(),
                    [&](const BoundedSurface& surface) { return crosses_itself(*model, surface, plan.segments); })) {
      for (const WholeCurve& curve : whole_curves(*model, plan.segments))
        if (curve.is_changed()) undo(model->curves[curve.first]);
      return {};
    }
    add_changes(*model, plan, report);
    for (Index s : plan.odd)
      if (s < model->surfaces.size()) report.odd_surfaces.push_back(model->surfaces[s].tag);
    return report;
  }
  ::gmsh::model::mesh::generate(1);
  return report;
}

}  // namespace qmorph::adapter
