// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/convert/curve_sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geometry/describe.hpp"
#include "gmsh/model/high_order.hpp"
#include "qmorph/error.hpp"
#include "space/result.hpp"

namespace qmorph::adapter {
namespace {

/// Moves middle nodes of a part's elements onto the geometry that its triangles stand for.
class Curving {
 public:
  Curving(const SurfacePart& part, const space::Result& result, const Lander& lander, CurvedElements& elements)
      : part_(part), result_(result), lander_(lander), elements_(elements) {}

  void run() {
    land_sides();
    for (Index e = 0; e < elements_.elements(); ++e)
      if (!elements_.element(e).is_kept) elements_.fill(e);
    land_insides();
  }

 private:
  void land_sides() {
    std::vector<char> is_done(elements_.sides(), 0);
    std::vector<Index> sides;
    std::vector<OnInput> places;
    for (Index e = 0; e < elements_.elements(); ++e)
      for (const Index s : elements_.element(e).sides) {
        if (std::exchange(is_done[s], 1) || elements_.side(s).is_given) continue;
        sides.push_back(s);
        for (const MiddleNode& node : elements_.side(s).nodes)
          places.push_back(place_of(e, node, length(elements_.side(s))));
      }
    const std::vector<Landing> landings = lander_(places);
    std::size_t at = 0;
    for (const Index s : sides) {
      std::vector<MiddleNode>& nodes = elements_.side(s).nodes;
      const std::span<const Landing> there(landings.data() + at, nodes.size());
      at += nodes.size();
      if (std::all_of(there.begin(), there.end(), [](const Landing& l) { return l.found; })) put(there, nodes);
    }
  }

  void land_insides() {
    std::vector<OnInput> places;
    for (Index e = 0; e < elements_.elements(); ++e)
      if (!elements_.element(e).is_kept)
        for (const MiddleNode& node : elements_.element(e).inside) places.push_back(place_of(e, node, size(e)));
    const std::vector<Landing> landings = lander_(places);
    std::size_t at = 0;
    for (Index e = 0; e < elements_.elements(); ++e) {
      if (elements_.element(e).is_kept) continue;
      for (MiddleNode& node : elements_.element(e).inside) {
        const Landing& landing = landings[at++];
        if (landing.found) node = {.place = landing.point, .parameters = landing.parameters, .is_landed = true};
      }
    }
  }

  static void put(std::span<const Landing> landings, std::vector<MiddleNode>& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      nodes[i] = {.place = landings[i].point, .parameters = landings[i].parameters, .is_landed = true};
  }

  double length(const CurvedSide& side) const {
    return (elements_.points()[side.ends[0]] - elements_.points()[side.ends[1]]).norm();
  }
  double size(Index element) const {
    double longest = 0;
    for (const Index s : elements_.element(element).sides) longest = std::max(longest, length(elements_.side(s)));
    return longest;
  }
  OnInput place_of(Index element, const MiddleNode& node, double chord) const {
    const space::Foot foot = result_.normals().closest(node.place, result_.triangle(element));
    OnInput place{.point = node.place, .weights = foot.weights, .corners = {}, .chord = chord};
    for (std::size_t i = 0; i < 3; ++i) place.corners[i] = part_.rows[result_.surface().corners(foot.triangle)[i]];
    return place;
  }

  const SurfacePart& part_;
  const space::Result& result_;
  const Lander& lander_;
  CurvedElements& elements_;
};

void count(const CurvedElements& elements, OnGeometry& sum) {
  const auto add = [&](const std::vector<MiddleNode>& nodes) {
    for (const MiddleNode& node : nodes) ++(node.is_landed ? sum.nodes : sum.left);
  };
  for (Index s = 0; s < elements.sides(); ++s)
    if (!elements.side(s).is_given) add(elements.side(s).nodes);
  for (Index e = 0; e < elements.elements(); ++e)
    if (!elements.element(e).is_kept) add(elements.element(e).inside);
}

/// The corners of the input's elements that are folded.
class InputFolds {
 public:
  InputFolds(const ModelMesh& mesh, const EntityMesh& before) {
    const CurvedElements elements = read_curved_elements(mesh, before);
    for (Index e = 0; e < elements.elements(); ++e)
      if (elements.is_folded(e))
        for (const Index corner : elements.element(e).corners) corners_.insert(coordinates(elements, corner));
  }
  /// Two of the element's corners were a folded one's.
  bool explain(const CurvedElements& elements, Index e) const {
    const auto& corners = elements.element(e).corners;
    return std::count_if(corners.begin(), corners.end(),
                         [&](Index corner) { return corners_.contains(coordinates(elements, corner)); }) >= 2;
  }

 private:
  using Coordinates = std::array<double, 3>;  // nodes that stay have the same, bit for bit
  static Coordinates coordinates(const CurvedElements& elements, Index point) {
    const Eigen::Vector3d& p = elements.points()[point];
    return {p.x(), p.y(), p.z()};
  }
  std::set<Coordinates> corners_;
};

/// \throws SurfaceError for a folded element that is not the input's fault
std::string find_given_folds(const ModelMesh& mesh, const EntityMesh& before,
                             const std::vector<CurvedElements>& parts) {
  std::optional<InputFolds> input;
  std::size_t count = 0;
  std::string first;
  for (const CurvedElements& elements : parts)
    for (Index e = 0; e < elements.elements(); ++e) {
      if (elements.element(e).is_kept || !elements.is_folded(e)) continue;
      const std::string where = "at " + describe(elements.place_of_fold(e));
      if (!input) input.emplace(mesh, before);
      if (!input->explain(elements, e))
        throw SurfaceError("its curved edges would turn an element over " + where + "; refine the mesh there",
                           {.kind = ErrorKind::no_valid_mesh});
      if (count++ == 0) first = where;
    }
  if (count == 0) return {};
  return fmt::format("its curved edges turn {} over {}, as they did triangles there; refine the mesh there",
                     count == 1 ? "an element" : fmt::format("{} elements", count),
                     count == 1 ? first : "(the first " + first + ")");
}

}  // namespace

void curve_sides(const ModelMesh& mesh, const Lander& lander, ConvertedSurface& surface) {
  const EntityMesh& before = mesh.entities[surface.surface.entity];
  surface.curved.clear();
  if (order_of(before) == 1) return;
  for (std::size_t p = 0; p < surface.results.size(); ++p) {
    const SurfacePart& part = surface.surface.parts[p];
    const QuadMesh& result = surface.results[p];
    CurvedElements& elements = surface.curved.emplace_back(curve_result(mesh, before, part, result));
    if (lander) Curving(part, surface.judged[p].on_surface(), lander, elements).run();
    surface.on_geometry.moved_sides += elements.unfold();
    if (lander) count(elements, surface.on_geometry);
  }
  surface.bent = find_given_folds(mesh, before, surface.curved);
}

}  // namespace qmorph::adapter
