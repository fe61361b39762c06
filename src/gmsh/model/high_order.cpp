// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/model/high_order.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "geometry/describe.hpp"
#include "gmsh/session/element_types.hpp"
#include "qmorph/check.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

using Tags = std::vector<std::size_t>;

/// A corner with less than this is flat, as in check.cpp.
constexpr double kLeastCornerSine = 1e-10;

struct TagPairHash {
  std::size_t operator()(const std::pair<std::size_t, std::size_t>& p) const {
    return p.first * 0x9e3779b97f4a7c15ULL ^ p.second;
  }
};

/// Nodes between the ends of edges, from the end with the smaller tag to the other.
class EdgeNodes {
 public:
  void add(std::size_t a, std::size_t b, Tags inner) {
    if (a > b) std::reverse(inner.begin(), inner.end());
    edges_.try_emplace(std::minmax(a, b), std::move(inner));
  }
  /// From a to b; empty if there are none yet.
  Tags find(std::size_t a, std::size_t b) const {
    const auto found = edges_.find(std::minmax(a, b));
    if (found == edges_.end()) return {};
    Tags inner = found->second;
    if (a > b) std::reverse(inner.begin(), inner.end());
    return inner;
  }

 private:
  std::unordered_map<std::pair<std::size_t, std::size_t>, Tags, TagPairHash> edges_;
};

/// Gmsh lists the corners, then the nodes of each edge in its direction, then those inside.
Tags edge_of(const Tags& element, std::size_t corners, int order, std::size_t edge) {
  const auto inner = static_cast<std::size_t>(order) - 1;
  const auto begin = element.begin() + static_cast<std::ptrdiff_t>(corners + edge * inner);
  return {begin, begin + static_cast<std::ptrdiff_t>(inner)};
}

Tags element_of(const ElementBlock& block, std::size_t i) {
  const auto begin = block.nodes.begin() + static_cast<std::ptrdiff_t>(i * block.nodes_per_element);
  return {begin, begin + static_cast<std::ptrdiff_t>(block.nodes_per_element)};
}

void learn_edges(const ElementBlock& block, EdgeNodes& edges) {
  if (block.order == 1) return;
  for (std::size_t i = 0; i < block.tags.size(); ++i) {
    const Tags element = element_of(block, i);
    for (std::size_t k = 0; k < block.corners; ++k)
      edges.add(element[k], element[(k + 1) % block.corners], edge_of(element, block.corners, block.order, k));
  }
}

/// A point of the line through points at equal steps, between its neighbours.
Eigen::Vector3d along(const std::vector<Eigen::Vector3d>& line, double t) {
  const double at = t * static_cast<double>(line.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at + 1e-9), line.size() - 2);
  const double s = at - static_cast<double>(i);
  return (1 - s) * line[i] + s * line[i + 1];
}

/// Coons' blend of the four sides; u, v from -1 to 1. Sides run from corner k to corner k + 1.
Eigen::Vector3d inside_quad(const std::vector<std::vector<Eigen::Vector3d>>& sides, double u, double v) {
  const double s = (u + 1) / 2, t = (v + 1) / 2;
  const Eigen::Vector3d across = (1 - t) * along(sides[0], s) + t * along(sides[2], 1 - s);
  const Eigen::Vector3d up = s * along(sides[1], t) + (1 - s) * along(sides[3], 1 - t);
  const Eigen::Vector3d flat = (1 - s) * (1 - t) * sides[0].front() + s * (1 - t) * sides[1].front() +
                               s * t * sides[2].front() + (1 - s) * t * sides[3].front();
  return across + up - flat;
}

/// The flat triangle, moved by what its sides are away from straight, less the further from the side.
Eigen::Vector3d inside_triangle(const std::vector<std::vector<Eigen::Vector3d>>& sides, double u, double v) {
  const double weight[3] = {1 - u - v, u, v};
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) p += weight[k] * sides[k].front();
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = weight[k], b = weight[(k + 1) % 3], t = b / (a + b);
    p += (a + b) * (a + b) * (along(sides[k], t) - (1 - t) * sides[k].front() - t * sides[k].back());
  }
  return p;
}

class Raiser {
 public:
  Raiser(const ModelMesh& mesh, const EntityMesh& before, EntityMesh& surface,
         const std::function<std::size_t()>& next_tag)
      : mesh_(mesh), surface_(surface), next_tag_(next_tag) {
    for (std::size_t i = 0; i < surface.node_tags.size(); ++i)
      position_[surface.node_tags[i]] = Eigen::Map<const Eigen::Vector3d>(surface.xyz.data() + 3 * i);
    for (const ElementBlock& block : before.blocks) {
      learn_edges(block, before_);
      for (std::size_t i = 0; block.corners == 4 && i < block.tags.size(); ++i) {
        const Tags element = element_of(block, i);
        quads_[{element.begin(), element.begin() + 4}] = element;
      }
    }
  }

  ElementBlock raise(const ElementBlock& linear, int order, bool incomplete);

 private:
  Tags raise(const Tags& corners, const ElementType& type);
  Tags edge(std::size_t a, std::size_t b, int order);
  Eigen::Vector3d position(std::size_t tag) const {
    const auto found = position_.find(tag);
    return found != position_.end() ? found->second : mesh_.points[mesh_.rows.find(tag)];
  }
  bool has_moved(std::size_t tag) const {
    const Index row = mesh_.rows.find(tag);
    return row == kNone || mesh_.points[row] != position(tag);
  }
  std::size_t add_node(const Eigen::Vector3d& p) {
    const std::size_t tag = next_tag_();
    put(tag, p);
    return tag;
  }
  void put(std::size_t tag, const Eigen::Vector3d& p) {
    surface_.node_tags.push_back(tag);
    surface_.xyz.insert(surface_.xyz.end(), p.data(), p.data() + 3);
    position_[tag] = p;
  }
  /// A node of the input, which this surface may own and not have yet.
  void keep(std::size_t tag) {
    const Index row = mesh_.rows.find(tag);
    const EntityMesh& owner = mesh_.entities[mesh_.owner[row]];
    if (owner.dim == 2 && owner.tag == surface_.tag && !position_.count(tag)) put(tag, mesh_.points[row]);
  }

  const ModelMesh& mesh_;
  EntityMesh& surface_;
  const std::function<std::size_t()>& next_tag_;
  std::unordered_map<std::size_t, Eigen::Vector3d> position_;  // of what the surface owns
  EdgeNodes before_, edges_;                                   // of the input, and new ones
  std::map<Tags, Tags> quads_;                                 // of the input, by their corners in order
};

Tags Raiser::edge(std::size_t a, std::size_t b, int order) {
  if (!has_moved(a) && !has_moved(b)) {
    const Tags inner = before_.find(a, b);
    for (std::size_t tag : inner) keep(tag);
    if (!inner.empty()) return inner;
  }
  Tags inner = edges_.find(a, b);
  if (!inner.empty()) return inner;
  const Eigen::Vector3d p = position(a), q = position(b);
  for (int i = 1; i < order; ++i) inner.push_back(add_node(p + (q - p) * (double(i) / order)));
  edges_.add(a, b, inner);
  return inner;
}

Tags Raiser::raise(const Tags& corners, const ElementType& type) {
  const bool at_rest = std::none_of(corners.begin(), corners.end(), [&](std::size_t tag) { return has_moved(tag); });
  if (const auto kept = quads_.find(corners); at_rest && kept != quads_.end() && kept->second.size() == type.nodes) {
    for (std::size_t tag : kept->second) keep(tag);
    return kept->second;
  }
  Tags element = corners;
  std::vector<std::vector<Eigen::Vector3d>> sides(corners.size());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::size_t a = corners[k], b = corners[(k + 1) % corners.size()];
    const Tags inner = edge(a, b, type.order);
    element.insert(element.end(), inner.begin(), inner.end());
    sides[k].push_back(position(a));
    for (std::size_t tag : inner) sides[k].push_back(position(tag));
    sides[k].push_back(position(b));
  }
  for (std::size_t i = element.size(); i < type.nodes; ++i) {
    const double u = type.local[2 * i], v = type.local[2 * i + 1];
    element.push_back(add_node(corners.size() == 4 ? inside_quad(sides, u, v) : inside_triangle(sides, u, v)));
  }
  return element;
}

ElementBlock Raiser::raise(const ElementBlock& linear, int order, bool incomplete) {
  const ElementType type = element_type(type_number(linear.corners, order, incomplete));
  if (type.nodes == 0)
    throw SurfaceError(fmt::format("Gmsh has no element of order {} for it", order), {.kind = ErrorKind::element_type});
  ElementBlock block;
  block.type = type.type;
  block.order = order;
  block.corners = linear.corners;
  block.nodes_per_element = type.nodes;
  block.tags = linear.tags;
  for (std::size_t i = 0; i < linear.tags.size(); ++i) {
    const Tags element = raise(element_of(linear, i), type);
    block.nodes.insert(block.nodes.end(), element.begin(), element.end());
  }
  return block;
}

/// Direction in which the curve through points at equal steps leaves the first: the derivative of Lagrange's
/// polynomial there.
Eigen::Vector3d slope_at_begin(const std::vector<Eigen::Vector3d>& line) {
  const std::size_t n = line.size() - 1;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  for (std::size_t j = 1; j <= n; ++j) {
    double weight = 1.0 / static_cast<double>(j);  // prod over m != 0, j of -m / (j - m), times 1 / j
    for (std::size_t m = 1; m <= n; ++m)
      if (m != j) weight *= -static_cast<double>(m) / (static_cast<double>(j) - static_cast<double>(m));
    slope += weight * (line[j] - line[0]);
  }
  return slope;
}

/// \param ahead, behind the sides of an element from one of its corners
bool is_bent(const std::vector<Eigen::Vector3d>& ahead, const std::vector<Eigen::Vector3d>& behind,
             const Eigen::Vector3d& normal) {
  const Eigen::Vector3d a = slope_at_begin(ahead), b = slope_at_begin(behind);
  return !(a.cross(b).dot(normal) > kLeastCornerSine * a.norm() * b.norm());
}

}  // namespace

int order_of(const EntityMesh& surface) {
  std::set<int> orders;
  std::set<std::size_t> families;
  for (const ElementBlock& block : surface.blocks) {
    if (block.corners != 3 && block.corners != 4)
      throw SurfaceError(
          fmt::format("it has elements with {} nodes that are neither triangles nor quads", block.nodes_per_element),
          {.kind = ErrorKind::element_type});
    orders.insert(block.order);
    if (!families.insert(block.corners).second) orders.insert(-1);
  }
  if (orders.size() > 1)
    throw SurfaceError("it has elements of several orders; give them one order", {.kind = ErrorKind::element_type});
  return orders.empty() ? 1 : *orders.begin();
}

void raise_order(const ModelMesh& mesh, const EntityMesh& before, bool incomplete, EntityMesh& surface,
                 const std::function<std::size_t()>& next_tag) {
  const int order = order_of(before);
  for (const ElementBlock& block : before.blocks)
    if (block.order > 1 && (block.corners == 4 || order > 2))
      incomplete = block.nodes_per_element == block.corners * static_cast<std::size_t>(order);
  Raiser raiser(mesh, before, surface, next_tag);
  for (ElementBlock& block : surface.blocks) block = raiser.raise(block, order, incomplete);
}

std::string find_bent_corner(const ModelMesh& mesh, const EntityMesh& before, const SurfacePart& part,
                             const QuadMesh& result) {
  if (order_of(before) == 1) return {};
  EdgeNodes edges;
  for (const ElementBlock& block : before.blocks) learn_edges(block, edges);
  const auto line = [&](Index a, Index b) {
    std::vector<Eigen::Vector3d> points = {result.points[a]};
    const Index i = result.source[a], j = result.source[b];
    if (i != kNone && j != kNone && part.patch.points[i] == result.points[a] &&
        part.patch.points[j] == result.points[b])
      for (std::size_t tag : edges.find(mesh.tags[part.rows[i]], mesh.tags[part.rows[j]]))
        points.push_back(mesh.points[mesh.rows.find(tag)]);
    points.push_back(result.points[b]);
    return points;
  };
  const bool planar = is_planar(part.patch);
  const Eigen::Vector3d of_patch = mean_normal(part.patch);
  const auto bent = [&](const auto& element) {
    Eigen::Vector3d normal = of_patch;
    if (!planar) {  // the element's own corners say which way is up
      normal.setZero();
      const Eigen::Vector3d& p = result.points[element[0]];
      for (std::size_t k = 2; k < element.size(); ++k)
        normal += (result.points[element[k - 1]] - p).cross(result.points[element[k]] - p);
    }
    for (std::size_t k = 0; k < element.size(); ++k) {
      const Index next = element[(k + 1) % element.size()], last = element[(k + element.size() - 1) % element.size()];
      if (is_bent(line(element[k], next), line(element[k], last), normal)) return k;
    }
    return element.size();
  };
  for (std::size_t q = part.patch.quads.size(); q < result.quads.size(); ++q)
    if (const std::size_t k = bent(result.quads[q]); k < 4) return "at " + describe(result.points[result.quads[q][k]]);
  for (const auto& triangle : result.triangles)
    if (const std::size_t k = bent(triangle); k < 3) return "at " + describe(result.points[triangle[k]]);
  return {};
}

std::string find_bent_corner(const ModelMesh& mesh, const EntityMesh& surface) {
  const auto point = [&](std::size_t tag) { return mesh.points[mesh.rows.find(tag)]; };
  for (const ElementBlock& block : surface.blocks)
    for (std::size_t i = 0; block.order > 1 && i < block.tags.size(); ++i) {
      const Tags element = element_of(block, i);
      Eigen::Vector3d normal = Eigen::Vector3d::Zero();
      for (std::size_t k = 2; k < block.corners; ++k)
        normal += (point(element[k - 1]) - point(element[0])).cross(point(element[k]) - point(element[0]));
      const auto side = [&](std::size_t k) {
        std::vector<Eigen::Vector3d> line = {point(element[k])};
        for (std::size_t tag : edge_of(element, block.corners, block.order, k)) line.push_back(point(tag));
        line.push_back(point(element[(k + 1) % block.corners]));
        return line;
      };
      for (std::size_t k = 0; k < block.corners; ++k) {
        std::vector<Eigen::Vector3d> behind = side((k + block.corners - 1) % block.corners);
        std::reverse(behind.begin(), behind.end());
        if (is_bent(side(k), behind, normal)) return "at " + describe(point(element[k]));
      }
    }
  return {};
}

}  // namespace qmorph::adapter
