// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/model/patches.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "geometry/describe.hpp"
#include "gmsh/model/high_order.hpp"
#include "gmsh/model/orientation.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/element_types.hpp"
#include "kernel/sort_unique.hpp"
#include "qmorph/error.hpp"
#include "space/corners.hpp"

namespace qmorph::adapter {
namespace {

/// Below this even the square of an area does not overflow.
constexpr double kLargestCoordinate = 1e75;

/// The elements of one surface with their corners as rows of the model's nodes.
struct Elements {
  std::vector<std::array<Index, 3>> triangles;
  std::vector<std::array<Index, 4>> quads;
  std::vector<std::size_t> quad_tags;
};

template <std::size_t N>
std::vector<std::array<Index, N>> read_corners(const ModelMesh& mesh, const ElementBlock& block) {
  std::vector<std::array<Index, N>> elements(block.tags.size());
  for (std::size_t i = 0; i < block.nodes.size(); ++i) {
    const std::size_t e = i / block.nodes_per_element, k = i % block.nodes_per_element;
    const Index row = mesh.rows.find(block.nodes[i]);
    if (row == kNone)
      throw SurfaceError(
          fmt::format("element {} uses node {}, which the mesh does not have", block.tags[e], block.nodes[i]),
          {.kind = ErrorKind::bad_element, .subject = ErrorSubject{ErrorSubject::Kind::element, block.tags[e]}});
    if (!mesh.points[row].allFinite())
      throw SurfaceError(fmt::format("{} is nowhere: its coordinates are not finite numbers", describe_node(mesh, row)),
                         at_node(mesh, row, ErrorKind::not_finite));
    if (mesh.points[row].cwiseAbs().maxCoeff() > kLargestCoordinate)
      throw SurfaceError(fmt::format("{} is too far away to compute with; scale the mesh (Mesh.ScalingFactor)",
                                     describe_node(mesh, row)),
                         at_node(mesh, row, ErrorKind::not_finite));
    if (k < N) elements[e][k] = row;
  }
  return elements;
}

template <std::size_t N>
void refuse_repeated_corners(const ModelMesh& mesh, const ElementBlock& block,
                             const std::vector<std::array<Index, N>>& elements) {
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (std::size_t k = 0; k < N; ++k)
      for (std::size_t j = 0; j < k; ++j)
        if (elements[e][k] == elements[e][j])
          throw SurfaceError(fmt::format("element {} uses {} twice; remove the element", block.tags[e],
                                         describe_node(mesh, elements[e][k])),
                             {.kind = ErrorKind::bad_element,
                              .place = mesh.points[elements[e][k]],
                              .subject = ErrorSubject{ErrorSubject::Kind::element, block.tags[e]}});
}

Elements read_elements(const ModelMesh& mesh, const EntityMesh& entity) {
  order_of(entity);  // refuses what is neither triangle nor quad
  Elements elements;
  if (const ElementBlock* block = entity.polygons(3)) {
    elements.triangles = read_corners<3>(mesh, *block);
    refuse_repeated_corners(mesh, *block, elements.triangles);
  }
  if (const ElementBlock* block = entity.polygons(4)) {
    elements.quads = read_corners<4>(mesh, *block);
    refuse_repeated_corners(mesh, *block, elements.quads);
    elements.quad_tags = block->tags;
  }
  return elements;
}

/// "volume 3", or "volumes 3 and 4" of a surface between two. A file without topology says it by the nodes only.
std::string describe_volumes(const ModelMesh& mesh, const NodeUse& use, int surface, Index row) {
  std::vector<int> volumes, unused;
  ::gmsh::model::getAdjacencies(2, surface, volumes, unused);
  std::erase_if(volumes, [](int volume) { return !has_elements(3, volume); });
  if (volumes.empty()) volumes.push_back(mesh.entities[use.volume[row]].tag);
  std::sort(volumes.begin(), volumes.end());
  return fmt::format("volume{} {}", volumes.size() == 1 ? "" : "s", fmt::join(volumes, " and "));
}

/// A volume's elements use whole triangles of the surface: quads would not fit them.
void refuse_volume(const ModelMesh& mesh, const NodeUse& use, int surface, const Elements& elements) {
  const auto in_volume = [&](Index row) { return use.volume[row] != kNobody; };
  for (const auto& triangle : elements.triangles)
    if (std::all_of(triangle.begin(), triangle.end(), in_volume))
      throw SurfaceError(
          fmt::format("it bounds {}, meshed already (at {}) with elements that fit triangles only; --drop-volumes "
                      "removes them, and with -3 the volumes are meshed again on the quads",
                      describe_volumes(mesh, use, surface, triangle[0]), describe_node(mesh, triangle[0])),
          at_node(mesh, triangle[0], ErrorKind::volume));
}

/// Numbers rows 0, 1, 2, ... in the order in which they come.
class LocalNumbers {
 public:
  explicit LocalNumbers(std::vector<Index>& scratch) : local_(scratch) {}
  ~LocalNumbers() {
    for (Index row : rows_) local_[row] = kNone;
  }
  LocalNumbers(const LocalNumbers&) = delete;
  LocalNumbers& operator=(const LocalNumbers&) = delete;

  template <std::size_t N>
  std::array<Index, N> operator()(std::array<Index, N> element) {
    for (Index& row : element) {
      if (local_[row] == kNone) {
        local_[row] = static_cast<Index>(rows_.size());
        rows_.push_back(row);
      }
      row = local_[row];
    }
    return element;
  }
  const std::vector<Index>& rows() const { return rows_; }

 private:
  std::vector<Index>& local_;
  std::vector<Index> rows_;
};

template <std::size_t N>
void refuse_twins(const ModelMesh& mesh, const std::vector<std::array<Index, N>>& elements) {
  std::vector<std::array<Index, N>> sorted = elements;
  for (auto& nodes : sorted) std::sort(nodes.begin(), nodes.end());
  std::sort(sorted.begin(), sorted.end());
  const auto twin = std::adjacent_find(sorted.begin(), sorted.end());
  if (twin == sorted.end()) return;
  const Index row = (*twin)[0];
  throw SurfaceError(fmt::format("it has an element twice, at {}; remove one of the two", describe_node(mesh, row)),
                     at_node(mesh, row, ErrorKind::not_manifold));
}

/// Such a quad is not joined to those around it as they are to each other, so that the surface may turn over there.
void refuse_crossed_quads(const ModelMesh& mesh, const Elements& elements) {
  for (std::size_t q = 0; q < elements.quads.size(); ++q) {
    space::Corners<4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.points[elements.quads[q][k]];
    if (space::crosses_itself(p)) throw crossed_quad(elements.quad_tags[q], p);
  }
}

Orientation orient_surface(const ModelMesh& mesh, const Elements& elements, std::vector<Index>& local) {
  LocalNumbers number(local);
  std::vector<std::array<Index, 3>> triangles;
  std::vector<std::array<Index, 4>> quads;
  triangles.reserve(elements.triangles.size());
  quads.reserve(elements.quads.size());
  for (const auto& triangle : elements.triangles) triangles.push_back(number(triangle));
  for (const auto& quad : elements.quads) quads.push_back(number(quad));
  const std::vector<Side> sides = sorted_sides(number.rows().size(), triangles, quads);
  Orientation orientation = orient(triangles.size() + quads.size(), sides);
  if (orientation.defect) refuse_crossed_quads(mesh, elements);
  if (orientation.defect)
    throw SurfaceError(
        fmt::format("{}, from {} to {}", orientation.defect, describe_node(mesh, number.rows()[orientation.where.low]),
                    describe_node(mesh, number.rows()[orientation.where.high])),
        at_node(mesh, number.rows()[orientation.where.low], ErrorKind::not_manifold));
  for (auto& edge : orientation.of_many)
    for (Index& node : edge) node = number.rows()[node];
  if (!orientation.of_many.empty() || orientation.flipped > 0) {  // only then can there be any
    refuse_twins(mesh, elements.triangles);
    refuse_twins(mesh, elements.quads);
  }
  return orientation;
}

/// Nodes where two parts touch. Each part would think that it may move them.
std::vector<Index> nodes_of_several_parts(const Elements& elements, const Orientation& orientation,
                                          std::vector<Index>& local) {
  if (orientation.parts < 2) return {};
  std::vector<Index> touched, several;
  const auto visit = [&](Index row, Index part) {
    if (local[row] == kNone) {
      local[row] = part;
      touched.push_back(row);
    } else if (local[row] != part) {
      several.push_back(row);
    }
  };
  Index e = 0;
  for (const auto& triangle : elements.triangles) {
    for (Index row : triangle) visit(row, orientation.part[e]);
    ++e;
  }
  for (const auto& quad : elements.quads) {
    for (Index row : quad) visit(row, orientation.part[e]);
    ++e;
  }
  for (Index row : touched) local[row] = kNone;
  std::sort(several.begin(), several.end());
  return several;
}

/// Element numbers of each part, in order.
std::vector<std::vector<Index>> members_of_parts(const Orientation& orientation) {
  std::vector<std::vector<Index>> members(orientation.parts);
  for (Index e = 0; e < orientation.part.size(); ++e) members[orientation.part[e]].push_back(e);
  return members;
}

template <std::size_t N>
std::array<Index, N> turned(std::array<Index, N> element, bool flip) {
  if (flip) std::reverse(element.begin(), element.end());
  return element;
}

SurfacePart make_part(const ModelMesh& mesh, const Elements& elements, const Orientation& orientation,
                      const std::vector<Index>& members, std::vector<Index>& local) {
  SurfacePart part;
  LocalNumbers number(local);
  for (Index e : members) {
    if (e < elements.triangles.size()) {
      part.patch.triangles.push_back(number(turned(elements.triangles[e], orientation.flip[e])));
    } else {
      const std::size_t q = e - elements.triangles.size();
      part.patch.quads.push_back(number(turned(elements.quads[q], orientation.flip[e])));
      part.quad_tags.push_back(elements.quad_tags[q]);
    }
  }
  part.rows = number.rows();
  part.patch.points.reserve(part.rows.size());
  for (Index row : part.rows) part.patch.points.push_back(mesh.points[row]);
  return part;
}

template <std::size_t N>
void add_constraints(const std::vector<std::array<Index, N>>& elements, const FixedEdges& fixed_edges,
                     SurfacePart& part) {
  for (const auto& element : elements)
    for (std::size_t k = 0; k < N; ++k) {
      const Index a = element[k], b = element[(k + 1) % N];
      if (fixed_edges.contains(part.rows[a], part.rows[b]))
        part.patch.constraints.push_back({std::min(a, b), std::max(a, b)});
    }
}

/// Edges of the part where other sheets meet it.
void add_edges_of_many(const std::vector<std::array<Index, 2>>& of_many, SurfacePart& part) {
  if (of_many.empty()) return;
  std::vector<std::pair<Index, Index>> numbers;  // row of the model, of the part
  for (Index i = 0; i < part.rows.size(); ++i) numbers.emplace_back(part.rows[i], i);
  std::sort(numbers.begin(), numbers.end());
  const auto number = [&](Index row) {
    const auto at = std::lower_bound(numbers.begin(), numbers.end(), std::pair(row, Index(0)));
    return at != numbers.end() && at->first == row ? at->second : kNone;
  };
  std::vector<std::array<Index, 2>> wanted;
  for (const auto& [row, other_row] : of_many)
    if (const Index a = number(row), b = number(other_row); a != kNone && b != kNone)
      wanted.push_back({std::min(a, b), std::max(a, b)});
  std::sort(wanted.begin(), wanted.end());
  const auto add = [&](const auto& elements) {
    for (const auto& element : elements)
      for (std::size_t k = 0; k < element.size(); ++k) {
        const Index a = element[k], b = element[(k + 1) % element.size()];
        const std::array<Index, 2> edge{std::min(a, b), std::max(a, b)};
        if (std::binary_search(wanted.begin(), wanted.end(), edge)) part.patch.constraints.push_back(edge);
      }
  };
  add(part.patch.triangles);
  add(part.patch.quads);
}

void set_constraints(const ModelMesh& mesh, const NodeUse& use, const FixedEdges& fixed_edges, std::uint32_t entity,
                     const Orientation& orientation, const std::vector<Index>& touching, SurfacePart& part) {
  add_constraints(part.patch.triangles, fixed_edges, part);
  add_constraints(part.patch.quads, fixed_edges, part);
  add_edges_of_many(orientation.of_many, part);
  auto& constraints = part.patch.constraints;
  sort_unique(constraints);

  for (Index i = 0; i < part.rows.size(); ++i) {
    const Index row = part.rows[i];
    if (mesh.owner[row] != entity || use.pinned[row] || use.several[row] || use.volume[row] != kNobody ||
        std::binary_search(touching.begin(), touching.end(), row))
      part.patch.fixed.push_back(i);
  }
}

}  // namespace

SurfaceMesh read_surface(const ModelMesh& mesh, const NodeUse& use, const FixedEdges& fixed_edges, std::uint32_t entity,
                         std::vector<Index>& local) {
  SurfaceMesh surface;
  surface.entity = entity;
  const Elements elements = read_elements(mesh, mesh.entities[entity]);
  refuse_volume(mesh, use, mesh.entities[entity].tag, elements);
  const Orientation orientation = orient_surface(mesh, elements, local);
  if (orientation.flipped)
    surface.warnings.push_back(
        fmt::format("{} elements were oriented against their neighbours and have been turned", orientation.flipped));
  if (!orientation.of_many.empty())
    surface.edge_of_many = fmt::format("from {} to {}", describe_node(mesh, orientation.of_many[0][0]),
                                       describe_node(mesh, orientation.of_many[0][1]));
  const std::vector<Index> touching = nodes_of_several_parts(elements, orientation, local);
  for (const std::vector<Index>& members : members_of_parts(orientation)) {
    SurfacePart part = make_part(mesh, elements, orientation, members, local);
    set_constraints(mesh, use, fixed_edges, entity, orientation, touching, part);
    surface.parts.push_back(std::move(part));
  }
  return surface;
}

SurfaceError crossed_quad(std::size_t tag, const std::array<Eigen::Vector3d, 4>& corners) {
  return SurfaceError(
      fmt::format("its quad {} crosses itself, {}, {}, {}, {}: list its nodes in order around it, or "
                  "move the one that lies beyond the opposite side",
                  tag, describe(corners[0]), describe(corners[1]), describe(corners[2]), describe(corners[3])),
      {.kind = ErrorKind::bad_element, .place = corners[0], .subject = ErrorSubject{ErrorSubject::Kind::element, tag}});
}

}  // namespace qmorph::adapter
