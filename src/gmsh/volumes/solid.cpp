// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/volumes/solid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

#include "gmsh/session/compat.hpp"

namespace qmorph::adapter {
namespace {

using FaceNodes = std::array<Index, 4>;  // the last is kNone in a triangle

constexpr std::array<CellCorner, 1> kTetrahedronCorners = {{{0, 1, 2, 3}}};
constexpr std::array<CellCorner, 4> kPyramidCorners = {{{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}}};
constexpr std::array<CellCorner, 6> kPrismCorners = {
    {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5}, {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}}};
constexpr std::array<CellCorner, 8> kHexahedronCorners = {
    {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7}, {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}}};

/// Seen from outside they run counterclockwise.
constexpr std::array<FaceNodes, 4> kTetrahedronFaces = {
    {{0, 2, 1, kNone}, {0, 1, 3, kNone}, {1, 2, 3, kNone}, {2, 0, 3, kNone}}};
constexpr std::array<FaceNodes, 5> kPyramidFaces = {
    {{0, 3, 2, 1}, {0, 1, 4, kNone}, {1, 2, 4, kNone}, {2, 3, 4, kNone}, {3, 0, 4, kNone}}};
constexpr std::array<FaceNodes, 5> kPrismFaces = {
    {{0, 2, 1, kNone}, {3, 4, 5, kNone}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
constexpr std::array<FaceNodes, 6> kHexahedronFaces = {
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

std::span<const FaceNodes> faces_of(CellShape shape) {
  switch (shape) {
    case CellShape::tetrahedron:
      return kTetrahedronFaces;
    case CellShape::pyramid:
      return kPyramidFaces;
    case CellShape::prism:
      return kPrismFaces;
    case CellShape::hexahedron:
      break;
  }
  return kHexahedronFaces;
}

/// The same cell numbered as its mirror image.
void mirror(Cell& cell) {
  auto& n = cell.nodes;
  switch (cell.shape) {
    case CellShape::tetrahedron:
      return std::swap(n[1], n[2]);
    case CellShape::pyramid:
      return std::swap(n[1], n[3]);
    case CellShape::prism:
      return std::swap(n[1], n[2]), std::swap(n[4], n[5]);
    case CellShape::hexahedron:
      return std::swap(n[1], n[3]), std::swap(n[5], n[7]);
  }
}

/// One side of a face: `runs_up` if, from its smallest node on, the smaller one of the two beside it comes first.
struct FaceSide {
  FaceNodes key{};  // sorted
  std::size_t cell = 0;
  bool runs_up = false;
};

FaceSide side_of(const Cell& cell, std::size_t number, const FaceNodes& local) {
  FaceNodes nodes = local;
  std::size_t count = 0;
  for (; count < 4 && local[count] != kNone; ++count) nodes[count] = cell.nodes[local[count]];
  const auto least =
      std::size_t(std::min_element(nodes.begin(), nodes.begin() + std::ptrdiff_t(count)) - nodes.begin());
  const Index next = nodes[(least + 1) % count], before = nodes[(least + count - 1) % count];
  FaceSide side{nodes, number, next < before};
  std::sort(side.key.begin(), side.key.end());
  return side;
}

/// By face.
std::vector<FaceSide> sides_of(const Solid& solid) {
  std::vector<FaceSide> sides;
  for (std::size_t c = 0; c < solid.cells.size(); ++c)
    for (const FaceNodes& face : faces_of(solid.cells[c].shape)) sides.push_back(side_of(solid.cells[c], c, face));
  std::sort(sides.begin(), sides.end(),
            [](const FaceSide& a, const FaceSide& b) { return std::tie(a.key, a.cell) < std::tie(b.key, b.cell); });
  return sides;
}

/// Calls `visit(first, count)` for each face.
template <class Visit>
void for_each_face(const std::vector<FaceSide>& sides, Visit visit) {
  for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
    while (end < sides.size() && sides[end].key == sides[first].key) ++end;
    visit(first, end - first);
  }
}

double volume_of(const Solid& solid, const Cell& cell) {
  double sum = 0;
  for (const CellCorner& corner : corners_of(cell.shape)) sum += spanned_volume(solid, cell, corner);
  return sum;
}

/// Turns cells so that neighbours agree, and each piece has a positive volume in sum.
void orient(Solid& solid, const std::vector<FaceSide>& sides) {
  std::vector<std::vector<std::pair<std::size_t, bool>>> neighbours(solid.cells.size());  // and whether they agree
  for_each_face(sides, [&](std::size_t first, std::size_t count) {
    if (count != 2) return;
    const FaceSide &a = sides[first], &b = sides[first + 1];
    const bool agree = a.runs_up != b.runs_up;
    neighbours[a.cell].emplace_back(b.cell, agree);
    neighbours[b.cell].emplace_back(a.cell, agree);
  });
  enum : char { unknown, as_it_is, mirrored };
  std::vector<char> state(solid.cells.size(), unknown);
  for (std::size_t seed = 0; seed < solid.cells.size(); ++seed) {
    if (state[seed] != unknown) continue;
    state[seed] = as_it_is;
    std::vector<std::size_t> piece = {seed};
    double volume = 0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const bool is_mirrored = state[piece[i]] == mirrored;
      volume += (is_mirrored ? -1 : 1) * volume_of(solid, solid.cells[piece[i]]);
      for (const auto& [other, agree] : neighbours[piece[i]])
        if (state[other] == unknown) {
          state[other] = is_mirrored == agree ? mirrored : as_it_is;
          piece.push_back(other);
        }
    }
    for (std::size_t c : piece)
      if ((state[c] == mirrored) == (volume > 0)) mirror(solid.cells[c]);
  }
}

/// Sorted corners of all elements of the volume's surfaces.
std::vector<FaceNodes> skin_of(const ModelMesh& mesh, int volume, const std::unordered_map<Index, Index>& local) {
  std::vector<FaceNodes> skin;
  ::gmsh::vectorpair surfaces;
  ::gmsh::model::getBoundary({{3, volume}}, surfaces, false, false);
  for (const auto& [dim, tag] : surfaces) {
    const EntityMesh* surface = find_entity(mesh, dim, tag);
    for (const std::size_t corners : {3, 4}) {
      const ElementBlock* block = surface ? surface->polygons(corners) : nullptr;
      for (std::size_t i = 0; block && i < block->nodes.size(); i += corners) {
        FaceNodes face{kNone, kNone, kNone, kNone};
        for (std::size_t k = 0; k < corners; ++k)
          if (const auto found = local.find(mesh.rows.find(block->nodes[i + k])); found != local.end())
            face[k] = found->second;
        std::sort(face.begin(), face.end());
        skin.push_back(face);
      }
    }
  }
  std::sort(skin.begin(), skin.end());
  return skin;
}

void find_loose_faces(Solid& solid, const std::vector<FaceSide>& sides, const std::vector<FaceNodes>& skin) {
  for_each_face(sides, [&](std::size_t first, std::size_t count) {
    const bool fits = count == 2 || (count == 1 && std::binary_search(skin.begin(), skin.end(), sides[first].key));
    if (fits) return;
    if (solid.loose_faces++ == 0) solid.loose_at = solid.points[sides[first].key[0]];
  });
}

}  // namespace

std::span<const CellCorner> corners_of(CellShape shape) {
  switch (shape) {
    case CellShape::tetrahedron:
      return kTetrahedronCorners;
    case CellShape::pyramid:
      return kPyramidCorners;
    case CellShape::prism:
      return kPrismCorners;
    case CellShape::hexahedron:
      break;
  }
  return kHexahedronCorners;
}

std::size_t nodes_of(CellShape shape) {
  return shape == CellShape::tetrahedron ? 4 : shape == CellShape::pyramid ? 5 : shape == CellShape::prism ? 6 : 8;
}

Solid read_solid(const ModelMesh& mesh, const EntityMesh& volume) {
  Solid solid;
  std::unordered_map<Index, Index> local;  // by row of the mesh
  for (const CellShape shape : kCellShapes) {
    const ElementBlock* block = volume.block(int(shape));
    for (std::size_t e = 0; block && e < block->tags.size(); ++e) {
      Cell cell{shape, {}};
      for (std::size_t k = 0; k < nodes_of(shape); ++k) {
        const Index row = mesh.rows.find(block->nodes[e * nodes_of(shape) + k]);
        const auto [found, is_new] = local.try_emplace(row, Index(solid.rows.size()));
        if (is_new) solid.rows.push_back(row);
        cell.nodes[k] = found->second;
      }
      solid.cells.push_back(cell);
    }
  }
  for (const Index row : solid.rows) {
    solid.points.push_back(mesh.points[row]);
    solid.may_move.push_back(&mesh.entities[mesh.owner[row]] == &volume);
  }
  const std::vector<FaceSide> sides = sides_of(solid);
  orient(solid, sides);
  find_loose_faces(solid, sides, skin_of(mesh, volume.tag, local));
  return solid;
}

double spanned_volume(const Solid& solid, const Cell& cell, const CellCorner& corner) {
  const auto at = [&](std::size_t k) { return solid.points[cell.nodes[corner[k]]]; };
  const Eigen::Vector3d p = at(0);
  return (at(1) - p).cross(at(2) - p).dot(at(3) - p);
}

std::vector<std::size_t> find_turned(const Solid& solid) {
  std::vector<std::size_t> turned;
  for (std::size_t c = 0; c < solid.cells.size(); ++c) {
    const auto corners = corners_of(solid.cells[c].shape);
    if (!std::all_of(corners.begin(), corners.end(),
                     [&](const CellCorner& corner) { return spanned_volume(solid, solid.cells[c], corner) > 0; }))
      turned.push_back(c);
  }
  return turned;
}

EntityMesh with_solid(const ModelMesh& mesh, EntityMesh volume, const Solid& solid) {
  const Index first = volume.node_tags.empty() ? 0 : mesh.rows.find(volume.node_tags.front());
  for (std::size_t i = 0; i < solid.rows.size(); ++i)
    if (solid.may_move[i])
      std::copy_n(solid.points[i].data(), 3, volume.xyz.begin() + 3 * std::ptrdiff_t(solid.rows[i] - first));
  auto cell = solid.cells.begin();
  for (const CellShape shape : kCellShapes)
    for (ElementBlock& block : volume.blocks) {
      if (block.type != int(shape)) continue;
      for (std::size_t e = 0; e < block.tags.size(); ++e, ++cell)
        for (std::size_t k = 0; k < nodes_of(shape); ++k)
          block.nodes[e * nodes_of(shape) + k] = mesh.tags[solid.rows[cell->nodes[k]]];
    }
  return volume;
}

}  // namespace qmorph::adapter
