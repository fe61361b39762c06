// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/model/curved_elements.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "geometry/predicates.hpp"
#include "gmsh/session/compat.hpp"
#include "kernel/sort_unique.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

/// A point of the line through points at equal steps, between its neighbours.
Vector3d along_line(const std::vector<Vector3d>& line, double t) {
  const double at = t * static_cast<double>(line.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at + 1e-9), line.size() - 2);
  const double s = at - static_cast<double>(i);
  return (1 - s) * line[i] + s * line[i + 1];
}

/// Coons' blend of the four sides; u, v from -1 to 1. Sides run from corner k to corner k + 1.
Vector3d inside_quad(const std::vector<std::vector<Vector3d>>& sides, double u, double v) {
  const double s = (u + 1) / 2, t = (v + 1) / 2;
  const Vector3d across = (1 - t) * along_line(sides[0], s) + t * along_line(sides[2], 1 - s);
  const Vector3d up = s * along_line(sides[1], t) + (1 - s) * along_line(sides[3], 1 - t);
  const Vector3d flat = (1 - s) * (1 - t) * sides[0].front() + s * (1 - t) * sides[1].front() +
                        s * t * sides[2].front() + (1 - s) * t * sides[3].front();
  return across + up - flat;
}

/// The flat triangle, moved by what its sides are away from straight, less the further from the side.
Vector3d inside_triangle(const std::vector<std::vector<Vector3d>>& sides, double u, double v) {
  const double weight[3] = {1 - u - v, u, v};
  Vector3d p = Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) p += weight[k] * sides[k].front();
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = weight[k], b = weight[(k + 1) % 3], t = b / (a + b);
    p += (a + b) * (a + b) * (along_line(sides[k], t) - (1 - t) * sides[k].front() - t * sides[k].back());
  }
  return p;
}

/// Derivatives of the functions of an element type at points of the reference element.
std::vector<Vector2d> slopes_at(int type, const std::vector<double>& local) {
  std::vector<double> uvw, values;
  for (std::size_t i = 0; i < local.size(); i += 2) uvw.insert(uvw.end(), {local[i], local[i + 1], 0});
  int components = 0, orientations = 0;
  ::gmsh::model::mesh::getBasisFunctions(type, uvw, "GradLagrange", components, values, orientations);
  std::vector<Vector2d> slopes;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) slopes.emplace_back(values[i], values[i + 1]);
  return slopes;
}

}  // namespace

void CurvedElements::set_type(const ElementType& type) {
  Shape& shape = shapes_[type.corners - 3];
  shape.type = type;
  shape.slopes = slopes_at(type.type, type.local);
  shape.linear_slopes = slopes_at(type_number(type.corners, 1, false), type.local);
}

Index CurvedElements::add_side(Index a, Index b) {
  const auto [found, is_new] = side_of_.try_emplace({std::min(a, b), std::max(a, b)}, sides());
  if (!is_new) return found->second;
  CurvedSide& side = sides_.emplace_back();
  side.ends = {a, b};
  const int order = std::max(shapes_[0].type.order, shapes_[1].type.order);
  side.nodes.resize(static_cast<std::size_t>(order) - 1);
  straighten(side);
  return found->second;
}

/// Where a node of the side is if that is straight.
Vector3d CurvedElements::on_line(const CurvedSide& side, std::size_t node) const {
  const Vector3d &p = points_[side.ends[0]], &q = points_[side.ends[1]];
  return p + (q - p) * (static_cast<double>(node + 1) / static_cast<double>(side.nodes.size() + 1));
}

bool CurvedElements::is_bent(const CurvedSide& side) const {
  constexpr double kStraight = 1e-9;  // of its length
  const double length = (points_[side.ends[0]] - points_[side.ends[1]]).norm();
  for (std::size_t i = 0; i < side.nodes.size(); ++i)
    if ((side.nodes[i].place - on_line(side, i)).norm() > kStraight * length) return true;
  return false;
}

void CurvedElements::straighten(CurvedSide& side) const {
  for (std::size_t i = 0; i < side.nodes.size(); ++i) {
    side.nodes[i].place = on_line(side, i);
    side.nodes[i].parameters = kNoParameters;
    side.nodes[i].is_landed = false;
  }
}

Index CurvedElements::add(std::vector<Index> corners) {
  const ElementType& type = shape(corners.size()).type;
  CurvedElement element;
  for (std::size_t k = 0; k < corners.size(); ++k)
    element.sides.push_back(add_side(corners[k], corners[(k + 1) % corners.size()]));
  element.inside.resize(type.nodes - corners.size() * static_cast<std::size_t>(type.order));
  element.corners = std::move(corners);
  elements_.push_back(std::move(element));
  fill(elements() - 1);
  return elements() - 1;
}

std::vector<MiddleNode> CurvedElements::along(Index e, std::size_t k) const {
  const CurvedSide& side = sides_[elements_[e].sides[k]];
  std::vector<MiddleNode> nodes = side.nodes;
  if (side.ends[0] != elements_[e].corners[k]) std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

void CurvedElements::fill(Index e) {
  CurvedElement& element = elements_[e];
  if (element.inside.empty()) return;
  const std::size_t n = element.corners.size();
  std::vector<std::vector<Vector3d>> lines(n);
  for (std::size_t k = 0; k < n; ++k) {
    lines[k].push_back(points_[element.corners[k]]);
    for (const MiddleNode& node : along(e, k)) lines[k].push_back(node.place);
    lines[k].push_back(points_[element.corners[(k + 1) % n]]);
  }
  const ElementType& type = shape(n).type;
  for (std::size_t i = 0; i < element.inside.size(); ++i) {
    const std::size_t node = type.nodes - element.inside.size() + i;
    const double u = type.local[2 * node], v = type.local[2 * node + 1];
    element.inside[i].place = n == 4 ? inside_quad(lines, u, v) : inside_triangle(lines, u, v);
    element.inside[i].parameters = kNoParameters;
    element.inside[i].is_landed = false;
  }
}

std::vector<Vector3d> CurvedElements::places(Index e) const {
  const CurvedElement& element = elements_[e];
  std::vector<Vector3d> places;
  for (const Index corner : element.corners) places.push_back(points_[corner]);
  for (std::size_t k = 0; k < element.sides.size(); ++k)
    for (const MiddleNode& node : along(e, k)) places.push_back(node.place);
  for (const MiddleNode& node : element.inside) places.push_back(node.place);
  return places;
}

std::vector<double> CurvedElements::rises(Index e) const {
  const std::size_t corners = elements_[e].corners.size();
  const Shape& form = shape(corners);
  const std::vector<Vector3d> at = places(e);
  const auto tangents = [&](const std::vector<Vector2d>& slopes, std::size_t node, std::size_t functions) {
    Eigen::Matrix<double, 3, 2> sum = Eigen::Matrix<double, 3, 2>::Zero();
    for (std::size_t i = 0; i < functions; ++i) sum += at[i] * slopes[node * functions + i].transpose();
    return sum;
  };
  std::vector<double> rises;
  for (std::size_t node = 0; node < at.size(); ++node) {
    const auto here = tangents(form.slopes, node, at.size()), straight = tangents(form.linear_slopes, node, corners);
    const Vector3d up = straight.col(0).cross(straight.col(1));
    const double lengths = here.col(0).norm() * here.col(1).norm() * up.norm();
    rises.push_back(lengths > 0 ? here.col(0).cross(here.col(1)).dot(up) / lengths : 0);
  }
  return rises;
}

bool CurvedElements::is_folded(Index e) const {
  const std::vector<double> all = rises(e);
  return std::any_of(all.begin(), all.end(), [](double rise) { return !(rise > kDegenerateSine); });
}

const Vector3d& CurvedElements::place_of_fold(Index e) const {
  const std::vector<double> all = rises(e);
  const auto corners = static_cast<std::ptrdiff_t>(elements_[e].corners.size());
  const auto lowest = std::min_element(all.begin(), all.begin() + corners) - all.begin();
  return points_[elements_[e].corners[static_cast<std::size_t>(lowest)]];
}

Index CurvedElements::find_folded() const {
  for (Index e = 0; e < elements(); ++e)
    if (!elements_[e].is_kept && is_folded(e)) return e;
  return kNone;
}

bool CurvedElements::may_be_straight(Index s, const Around& around) const {
  if (!sides_[s].is_given) return true;
  return sides_[s].is_inner && around[s].size() == 2 &&
         std::none_of(around[s].begin(), around[s].end(), [&](Index e) { return elements_[e].is_kept; });
}

void CurvedElements::straighten_folded(const Around& around) {
  std::vector<Index> open;
  for (Index e = 0; e < elements(); ++e) open.push_back(e);
  while (!open.empty()) {
    std::vector<Index> changed;  // a side that is straight now may fold the neighbour
    for (const Index e : open) {
      if (elements_[e].is_kept || !is_folded(e)) continue;
      for (const Index s : elements_[e].sides) {
        CurvedSide& side = sides_[s];
        if (!may_be_straight(s, around) || !is_bent(side)) continue;
        straighten(side);
        if (std::exchange(side.is_given, false))
          for (MiddleNode& node : side.nodes) node.tag = 0;
        side.has_moved = true;
        changed.insert(changed.end(), around[s].begin(), around[s].end());
      }
      fill(e);
    }
    sort_unique(changed);
    for (const Index e : changed)
      if (!elements_[e].is_kept) fill(e);
    open = std::move(changed);
  }
}

std::vector<Index> CurvedElements::straighten_given(Index e) {
  std::vector<Index> straightened;
  for (const Index s : elements_[e].sides)
    if (sides_[s].is_given && is_bent(sides_[s])) straighten(sides_[s]), straightened.push_back(s);
  fill(e);
  return straightened;
}

/// Bends the side opposite a given one like that, as far as it takes.
bool CurvedElements::follow_given_side(Index e, const Around& around) {
  const CurvedElement& element = elements_[e];
  for (std::size_t k = 0; element.sides.size() == 4 && k < 4; ++k) {
    const CurvedSide& given = sides_[element.sides[k]];
    const Index s = element.sides[(k + 2) % 4];
    if (!given.is_given || sides_[s].is_given || !is_bent(given)) continue;
    const CurvedSide before = sides_[s];
    // Both sides, if seen in the element's direction, run against each other.
    const bool same_way = (given.ends[0] == element.corners[k]) != (before.ends[0] == element.corners[(k + 2) % 4]);
    for (const double part : {0.5, 0.75, 1.0, 0.25}) {
      CurvedSide& side = sides_[s];
      for (std::size_t i = 0; i < side.nodes.size(); ++i) {
        const std::size_t j = same_way ? i : side.nodes.size() - 1 - i;
        side.nodes[i].place = on_line(side, i) + part * (given.nodes[j].place - on_line(given, j));
        side.nodes[i].parameters = kNoParameters;
        side.nodes[i].is_landed = false;
      }
      for (const Index other : around[s]) fill(other);
      side.has_moved = true;
      if (!is_any_folded(around[s])) return true;
    }
    sides_[s] = before;
    for (const Index other : around[s]) fill(other);
  }
  return false;
}

bool CurvedElements::is_any_folded(const std::vector<Index>& elements) const {
  return std::any_of(elements.begin(), elements.end(), [&](Index e) { return !elements_[e].is_kept && is_folded(e); });
}

/// Bends a side so that it leaves the corner that it has with a given one turned by `part` of the angle by which
/// that does.
void CurvedElements::turn_like(const CurvedSide& given, Index s, double part) {
  CurvedSide& side = sides_[s];
  const bool from_first = side.ends[0] == given.ends[0] || side.ends[0] == given.ends[1];
  const Index corner = side.ends[from_first ? 0 : 1], far = side.ends[from_first ? 1 : 0];
  const bool given_from_first = given.ends[0] == corner;
  const Index given_far = given.ends[given_from_first ? 1 : 0];
  const Vector3d along = points_[far] - points_[corner], given_along = points_[given_far] - points_[corner];
  const Vector3d up = given_along.cross(along).normalized();
  // What a parabola needs in its middle to leave the corner as the given side does.
  const std::size_t count = side.nodes.size(), first = given_from_first ? 0 : count - 1;
  const double step = 1.0 / static_cast<double>(count + 1);
  const Vector3d rise = (given.nodes[first].place - on_line(given, first)) / (4 * step * (1 - step));
  const double length = given_along.squaredNorm();
  const double forth = rise.dot(given_along) / length, aside = rise.dot(up.cross(given_along)) / length;
  const Vector3d bend = part * (forth * along + aside * up.cross(along));
  for (std::size_t i = 0; i < count; ++i) {
    const double t = step * static_cast<double>(i + 1);
    side.nodes[i].place = on_line(side, i) + 4 * t * (1 - t) * bend;
    side.nodes[i].parameters = kNoParameters;
    side.nodes[i].is_landed = false;
  }
  side.has_moved = true;
}

/// Where a given side turns so far at its ends that it folds the element, the sides beside it turn with it, as far as
/// it takes: both, or one of them.
bool CurvedElements::turn_beside_given_side(Index e, const Around& around) {
  const CurvedElement& element = elements_[e];
  const std::size_t n = element.sides.size();
  for (std::size_t k = 0; k < n; ++k) {
    const CurvedSide given = sides_[element.sides[k]];
    if (!given.is_given || !is_bent(given)) continue;
    const Index before = element.sides[(k + n - 1) % n], after = element.sides[(k + 1) % n];
    for (const std::vector<Index>& beside : {std::vector{before, after}, {before}, {after}}) {
      if (std::any_of(beside.begin(), beside.end(), [&](Index s) { return sides_[s].is_given; })) continue;
      std::vector<CurvedSide> were;
      std::vector<Index> touched;
      for (const Index s : beside) {
        were.push_back(sides_[s]);
        touched.insert(touched.end(), around[s].begin(), around[s].end());
      }
      const auto fill_all = [&] { std::for_each(touched.begin(), touched.end(), [&](Index t) { fill(t); }); };
      for (const double part : {0.5, 0.75, 1.0, 0.25}) {
        for (const Index s : beside) turn_like(given, s, part);
        fill_all();
        if (!is_any_folded(touched)) return true;
      }
      for (std::size_t i = 0; i < beside.size(); ++i) sides_[beside[i]] = were[i];
      fill_all();
    }
  }
  return false;
}

std::size_t CurvedElements::unfold() {
  Around around(sides_.size());
  for (Index e = 0; e < elements(); ++e)
    for (const Index s : elements_[e].sides) around[s].push_back(e);
  straighten_folded(around);
  for (Index e = 0; e < elements(); ++e)
    if (!elements_[e].is_kept && is_folded(e) && !follow_given_side(e, around)) turn_beside_given_side(e, around);
  return static_cast<std::size_t>(
      std::count_if(sides_.begin(), sides_.end(), [](const CurvedSide& side) { return side.has_moved; }));
}

}  // namespace qmorph::adapter
