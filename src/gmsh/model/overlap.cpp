// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/model/overlap.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geometry/mixed_bits.hpp"
#include "geometry/predicates.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector3d;

/// How many edges are looked at for one edge of the outline, on average. If more are needed, the question stays open.
constexpr std::size_t kBudget = 2000;

/// A surface, and the plane that it lies in.
struct Sheet {
  const EntityMesh* entity = nullptr;
  Vector3d normal = Vector3d::Zero(), origin = Vector3d::Zero();
};

/// An edge that one element has, with the inside on its left.
struct OutlineEdge {
  Vec2 a, b;
  Vec2 inside;  ///< the third corner
  int surface = 0;
  double left() const { return std::min(a.x(), b.x()); }
  double right() const { return std::max(a.x(), b.x()); }
};

/// Calls `take(rows)` for the corners of each element. \return false if an element uses a node that there is not
template <class Take>
bool for_each_element(const ModelMesh& mesh, const EntityMesh& entity, Take&& take) {
  std::vector<Index> rows;
  for (const ElementBlock& block : entity.blocks)
    for (std::size_t first = 0; first < block.nodes.size(); first += block.nodes_per_element) {
      rows.clear();
      for (std::size_t k = 0; k < block.corners; ++k) rows.push_back(mesh.rows.find(block.nodes[first + k]));
      if (std::count(rows.begin(), rows.end(), kNone)) return false;
      take(rows);
    }
  return true;
}

double size_of(const ModelMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : mesh.points)
    if (p.allFinite()) box.extend(p);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

bool lies_in_plane(const Sheet& sheet, const Vector3d& p, double tolerance) {
  return std::abs((p - sheet.origin).dot(sheet.normal)) <= tolerance;
}

/// Surfaces that are planar, with normals of length one.
std::vector<Sheet> find_sheets(const ModelMesh& mesh, double tolerance) {
  std::vector<Sheet> sheets;
  for (const EntityMesh& entity : mesh.entities) {
    if (entity.dim != 2 || entity.blocks.empty()) continue;
    Sheet sheet{.entity = &entity};
    const bool sound = for_each_element(mesh, entity, [&](const std::vector<Index>& rows) {
      sheet.origin = mesh.points[rows[0]];
      for (std::size_t k = 2; k < rows.size(); ++k)
        sheet.normal += (mesh.points[rows[k - 1]] - sheet.origin).cross(mesh.points[rows[k]] - sheet.origin);
    });
    if (!sound || !(sheet.normal.norm() > 0) || !sheet.normal.allFinite()) continue;
    sheet.normal.normalize();
    bool planar = true;
    for_each_element(mesh, entity, [&](const std::vector<Index>& rows) {
      for (const Index row : rows) planar = planar && lies_in_plane(sheet, mesh.points[row], tolerance);
    });
    if (planar) sheets.push_back(sheet);
  }
  return sheets;
}

/// Those in one plane together.
std::vector<std::vector<Sheet>> group_by_plane(const std::vector<Sheet>& sheets, double tolerance) {
  std::vector<std::vector<Sheet>> groups;
  for (const Sheet& sheet : sheets) {
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const std::vector<Sheet>& group) {
      return std::abs(sheet.normal.dot(group.front().normal)) > 1 - kPlanarTolerance &&
             lies_in_plane(group.front(), sheet.origin, tolerance);
    });
    if (found == groups.end())
      groups.push_back({sheet});
    else
      found->push_back(sheet);
  }
  return groups;
}

/// Edges with one element. Inside a mesh each neighbour of a node comes twice, once on either side of the edge between
/// them, and the marks of all cancel; so edges have to be compared only where they do not.
std::vector<OutlineEdge> find_outline(const ModelMesh& mesh, const std::vector<Sheet>& group,
                                      std::vector<Index>& neighbours) {
  struct Candidate {
    Index low, high, from, to, third;
    int surface;
  };
  for (const Sheet& sheet : group)
    for_each_element(mesh, *sheet.entity, [&](const std::vector<Index>& rows) {
      for (std::size_t k = 0, n = rows.size(); k < n; ++k)
        neighbours[rows[k]] ^= Index(mixed_bits(rows[(k + 1) % n]) ^ mixed_bits(rows[(k + n - 1) % n]));
    });
  std::vector<Candidate> candidates;
  for (const Sheet& sheet : group)
    for_each_element(mesh, *sheet.entity, [&](const std::vector<Index>& rows) {
      for (std::size_t k = 0, n = rows.size(); k < n; ++k) {
        const Index a = rows[k], b = rows[(k + 1) % n];
        if (neighbours[a] && neighbours[b])
          candidates.push_back({std::min(a, b), std::max(a, b), a, b, rows[(k + 2) % n], sheet.entity->tag});
      }
    });
  for (const Sheet& sheet : group)
    for_each_element(mesh, *sheet.entity, [&](const std::vector<Index>& rows) {
      for (const Index row : rows) neighbours[row] = 0;
    });
  const auto same = [](const Candidate& s, const Candidate& t) { return s.low == t.low && s.high == t.high; };
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& s, const Candidate& t) {
    return std::pair(s.low, s.high) < std::pair(t.low, t.high);
  });

  Eigen::Index dropped = 0;
  group.front().normal.cwiseAbs().maxCoeff(&dropped);
  const auto flat = [&](Index row) {
    return Vec2(mesh.points[row][(dropped + 1) % 3], mesh.points[row][(dropped + 2) % 3]);
  };
  std::vector<OutlineEdge> outline;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& edge = candidates[i];
    if ((i > 0 && same(candidates[i - 1], edge)) || (i + 1 < candidates.size() && same(edge, candidates[i + 1])))
      continue;
    OutlineEdge side{flat(edge.from), flat(edge.to), flat(edge.third), edge.surface};
    if (orientation(side.a, side.b, side.inside) < 0) std::swap(side.a, side.b);
    outline.push_back(side);
  }
  std::stable_sort(outline.begin(), outline.end(),
                   [](const OutlineEdge& s, const OutlineEdge& t) { return s.left() < t.left(); });
  return outline;
}

/// How often the plane is covered just inside each edge of the outline: by the edges above, of which those that run to
/// the left have the inside below them. \return an edge where it is more than once
std::optional<OutlineEdge> find_double_cover(const std::vector<OutlineEdge>& outline) {
  struct Sample {
    Vec2 place;
    const OutlineEdge* edge;
  };
  constexpr double kInside = 1e-3;
  std::vector<Sample> samples;
  for (const OutlineEdge& edge : outline) {
    const Vec2 middle = (edge.a + edge.b) / 2;
    samples.push_back({middle + kInside * (edge.inside - middle), &edge});
  }
  std::stable_sort(samples.begin(), samples.end(),
                   [](const Sample& s, const Sample& t) { return s.place.x() < t.place.x(); });
  std::vector<const OutlineEdge*> active;
  std::size_t budget = kBudget * outline.size(), next = 0;
  for (const Sample& sample : samples) {
    const Vec2& place = sample.place;
    for (; next < outline.size() && outline[next].left() <= place.x(); ++next) active.push_back(&outline[next]);
    std::erase_if(active, [&](const OutlineEdge* above) { return above->right() <= place.x(); });
    if (active.size() > budget) return std::nullopt;
    budget -= active.size();
    int covers = 0;
    for (const OutlineEdge* above : active) {
      const bool leftward = above->a.x() > above->b.x();
      const int side = orientation(above->a, above->b, place);
      if (side == (leftward ? 1 : -1)) covers += leftward ? 1 : -1;
    }
    if (covers > 1) return *sample.edge;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Overlap> find_overlap(const ModelMesh& mesh) {
  const double tolerance = kPlanarTolerance * size_of(mesh);
  if (!std::isfinite(tolerance)) return std::nullopt;
  std::vector<Index> neighbours(mesh.tags.size(), 0);
  for (const std::vector<Sheet>& group : group_by_plane(find_sheets(mesh, tolerance), tolerance)) {
    const auto edge = find_double_cover(find_outline(mesh, group, neighbours));
    if (!edge) continue;
    const Sheet& plane = group.front();
    Eigen::Index dropped = 0;
    plane.normal.cwiseAbs().maxCoeff(&dropped);
    Overlap overlap{.surface = edge->surface};
    const Vec2 middle = (edge->a + edge->b) / 2;
    overlap.where[(dropped + 1) % 3] = middle.x();
    overlap.where[(dropped + 2) % 3] = middle.y();
    overlap.where[dropped] = 0;
    overlap.where[dropped] = (plane.origin - overlap.where).dot(plane.normal) / plane.normal[dropped];
    return overlap;
  }
  return std::nullopt;
}

}  // namespace qmorph::adapter
