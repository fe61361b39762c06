// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/read/facing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/element_types.hpp"
#include "gmsh/session/session.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector3d;

/// Words in the names of types of surfaces.
constexpr const char* kWithoutGeometry[] = {"Discrete", "Boundary layer"};

/// Gmsh does not orient what has no geometry of its own.
bool has_geometry(int surface) {
  const std::string type = entity_type(2, surface);
  return std::all_of(std::begin(kWithoutGeometry), std::end(kWithoutGeometry),
                     [&](const char* other) { return type.find(other) == std::string::npos; });
}

/// Nor does it orient the copy of another surface.
bool is_copy(int surface) {
  int master = surface;
  std::vector<std::size_t> nodes, masters;
  std::vector<double> transformation;
  ::gmsh::model::mesh::getPeriodicNodes(2, surface, master, nodes, masters, transformation);
  return master != surface;
}

/// Twice the area of an element, along its normal.
Vector3d area_vector(const std::vector<PlacedNode>& corners) {
  const auto from = [&](std::size_t a, std::size_t b) {
    return Vector3d(Vector3d::Map(corners[b].xyz.data()) - Vector3d::Map(corners[a].xyz.data()));
  };
  return corners.size() == 3 ? from(0, 1).cross(from(0, 2)) : from(0, 2).cross(from(1, 3));
}

/// The geometry's normal where a node lies, or 0: nodes on curves have no parameters on the surface, poles no normal.
Vector3d normal_at(int surface, const PlacedNode& node) {
  constexpr double kUnit = 1e-3;
  std::vector<double> normal;
  if (node.parameters.size() == 2) ::gmsh::model::getNormal(surface, node.parameters, normal);
  if (normal.size() != 3) return Vector3d::Zero();
  const Vector3d n = Vector3d::Map(normal.data());
  return std::abs(n.norm() - 1) < kUnit ? n : Vector3d::Zero();
}

/// Areas of elements on the normal's side and on the other.
struct Sides {
  double with = 0, against = 0;
};

/// \param all nodes of all elements of one type
void add_sides(int surface, std::size_t corners, const std::vector<std::size_t>& all, Sides& sides) {
  constexpr std::size_t kSample = 100;
  const std::size_t count = all.size() / corners, stride = std::max<std::size_t>(1, count / kSample);
  std::vector<PlacedNode> nodes(corners);
  for (std::size_t e = 0; e < count; e += stride) {
    for (std::size_t i = 0; i < corners; ++i) nodes[i] = placed_node(all[e * corners + i]);
    const Vector3d area = area_vector(nodes);
    for (const PlacedNode& node : nodes) {
      const double side = area.dot(normal_at(surface, node));
      if (side != 0) (side > 0 ? sides.with : sides.against) += area.norm();
    }
  }
}

Sides find_sides(int surface) {
  Sides sides;
  std::vector<int> types;
  ::gmsh::model::mesh::getElementTypes(types, 2, surface);
  for (const int number : types) {
    const ElementType type = element_type(number);
    if (type.order != 1) continue;
    std::vector<std::size_t> tags, nodes;
    ::gmsh::model::mesh::getElementsByType(number, tags, nodes, surface);
    add_sides(surface, type.corners, nodes, sides);
  }
  return sides;
}

/// For as long as this object lives, nothing is invisible but these surfaces.
class Hidden {
 public:
  explicit Hidden(const std::vector<int>& surfaces) {
    ::gmsh::vectorpair entities;
    ::gmsh::model::getEntities(entities);
    for (const auto& entity : entities) {
      int visible = 1;
      ::gmsh::model::getVisibility(entity.first, entity.second, visible);
      if (!visible) before_.push_back(entity);
    }
    for (const int surface : surfaces) now_.emplace_back(2, surface);
    ::gmsh::model::setVisibility(before_, 1);
    ::gmsh::model::setVisibility(now_, 0);
  }
  ~Hidden() {
    try {
      ::gmsh::model::setVisibility(now_, 1);
      ::gmsh::model::setVisibility(before_, 0);
    } catch (...) {  // a destructor cannot report it
    }
  }
  Hidden(const Hidden&) = delete;
  Hidden& operator=(const Hidden&) = delete;

 private:
  ::gmsh::vectorpair before_, now_;
};

/// What every Gmsh can turn in place is all that is invisible. \return false if this one cannot
bool turn_over(const std::vector<int>& surfaces) {
  const auto choose = [](bool reverse) {
    const StageLog log = run_logged([&] {
      ::gmsh::plugin::setNumber("Invisible", "DeleteElements", reverse ? 0 : 1);
      ::gmsh::plugin::setNumber("Invisible", "ReverseElements", reverse ? 1 : 0);
    });
    return log.errors.empty();
  };
  if (!choose(true)) return false;  // it would delete them
  run_logged([&] {
    const Hidden hidden(surfaces);
    ::gmsh::plugin::run("Invisible");
  });
  choose(false);
  return true;
}

}  // namespace

std::vector<int> face_as_geometry(const std::vector<int>& surfaces, const std::set<int>& reversed) {
  constexpr double kClear = 0.9;  // of the area; where elements disagree more than that, no side is right
  std::vector<int> wrong;
  run_logged([&] {
    for (const int surface : surfaces) {
      if (!has_elements(2, surface) || !has_geometry(surface)) continue;
      Sides sides = find_sides(surface);
      if (reversed.count(surface)) std::swap(sides.with, sides.against);
      if (sides.against > kClear * (sides.with + sides.against) && !is_copy(surface)) wrong.push_back(surface);
    }
  });
  return !wrong.empty() && turn_over(wrong) ? wrong : std::vector<int>{};
}

}  // namespace qmorph::adapter
