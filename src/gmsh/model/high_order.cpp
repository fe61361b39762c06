// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/model/high_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "geometry/describe.hpp"
#include "gmsh/session/element_types.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

using Tags = std::vector<std::size_t>;

struct TagPairHash {
  std::size_t operator()(const std::pair<std::size_t, std::size_t>& p) const {
    return p.first * 0x9e3779b97f4a7c15ULL ^ p.second;
  }
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

/// Nodes between the corners of a surface's elements.
class GivenNodes {
 public:
  explicit GivenNodes(const EntityMesh& surface) {
    for (const ElementBlock& block : surface.blocks)
      for (std::size_t i = 0; block.order > 1 && i < block.tags.size(); ++i) {
        const Tags element = element_of(block, i);
        for (std::size_t k = 0; k < block.corners; ++k)
          add_edge(element[k], element[(k + 1) % block.corners], edge_of(element, block.corners, block.order, k));
        if (block.corners == 4) quads_[{element.begin(), element.begin() + 4}] = element;
      }
  }
  /// From a to b; empty if that is no edge.
  Tags edge(std::size_t a, std::size_t b) const {
    const auto found = edges_.find(std::minmax(a, b));
    if (found == edges_.end()) return {};
    Tags inner = found->second;
    if (a > b) std::reverse(inner.begin(), inner.end());
    return inner;
  }
  /// All nodes of the quad with these corners in order; empty if there is none.
  Tags quad(const Tags& corners) const {
    const auto found = quads_.find(corners);
    return found == quads_.end() ? Tags{} : found->second;
  }

 private:
  void add_edge(std::size_t a, std::size_t b, Tags inner) {
    if (a > b) std::reverse(inner.begin(), inner.end());
    edges_.try_emplace(std::minmax(a, b), std::move(inner));
  }

  std::unordered_map<std::pair<std::size_t, std::size_t>, Tags, TagPairHash> edges_;  ///< from the smaller tag
  std::map<Tags, Tags> quads_;
};

/// Quads of order 2 have 8 nodes if others of the model have, and 9 otherwise.
bool wants_incomplete(const ModelMesh& mesh) {
  for (const EntityMesh& entity : mesh.entities)
    if (const ElementBlock* quads = entity.dim == 2 ? entity.polygons(4) : nullptr; quads && quads->order > 1)
      return quads->nodes_per_element == 4 * static_cast<std::size_t>(quads->order);
  return get_option("Mesh.SecondOrderIncomplete") != 0;
}

bool is_incomplete(const ModelMesh& mesh, const EntityMesh& before, int order) {
  for (const ElementBlock& block : before.blocks)
    if (block.order > 1 && (block.corners == 4 || order > 2))
      return block.nodes_per_element == block.corners * static_cast<std::size_t>(order);
  return wants_incomplete(mesh);
}

MiddleNode given_node(const ModelMesh& mesh, std::size_t tag) {
  return {.place = mesh.points[mesh.rows.find(tag)], .tag = tag};
}

/// What keeps the nodes that the input has there.
class ResultElements {
 public:
  ResultElements(const ModelMesh& mesh, const EntityMesh& before, const SurfacePart& part, const QuadMesh& result)
      : mesh_(mesh), before_(before), given_(before), elements_(result.points), tags_(result.points.size(), 0) {
    for (Index i = 0; i < result.points.size(); ++i) {
      const Index source = result.source[i];
      if (source != kNone && part.patch.points[source] == result.points[i]) tags_[i] = mesh.tags[part.rows[source]];
    }
    const int order = order_of(before);
    for (const std::size_t corners : {3, 4}) {
      const ElementType type = element_type(type_number(corners, order, is_incomplete(mesh, before, order)));
      if (type.nodes == 0)
        throw SurfaceError(fmt::format("Gmsh has no element of order {} for it", order),
                           {.kind = ErrorKind::element_type});
      elements_.set_type(type);
    }
    for (const auto& triangle : result.triangles) add({triangle.begin(), triangle.end()});
    for (const auto& quad : result.quads) add({quad.begin(), quad.end()});
  }
  CurvedElements take() { return std::move(elements_); }

 private:
  void add(std::vector<Index> corners) {
    for (std::size_t k = 0; k < corners.size(); ++k) add_side(corners[k], corners[(k + 1) % corners.size()]);
    Tags tags;
    for (const Index corner : corners) tags.push_back(tags_[corner]);
    CurvedElement& element = elements_.element(elements_.add(std::move(corners)));
    const Tags quad = given_.quad(tags);
    if (quad.size() != elements_.type(4).nodes) return;
    element.is_kept = true;
    for (std::size_t i = 0; i < element.inside.size(); ++i)
      element.inside[i] = given_node(mesh_, quad[quad.size() - element.inside.size() + i]);
  }

  void add_side(Index a, Index b) {
    if (tags_[a] == 0 || tags_[b] == 0) return;
    const Tags inner = given_.edge(tags_[a], tags_[b]);
    if (inner.empty()) return;
    CurvedSide& side = elements_.side(elements_.add_side(a, b));
    if (side.is_given) return;
    side.is_given = true;
    side.is_inner = std::all_of(inner.begin(), inner.end(), [&](std::size_t tag) {
      return &mesh_.entities[mesh_.owner[mesh_.rows.find(tag)]] == &before_;
    });
    for (std::size_t i = 0; i < inner.size(); ++i) side.nodes[i] = given_node(mesh_, inner[i]);
  }

  const ModelMesh& mesh_;
  const EntityMesh& before_;
  const GivenNodes given_;
  CurvedElements elements_;
  std::vector<std::size_t> tags_;  ///< of points that are where the input's node was, else 0
};

class Raiser {
 public:
  Raiser(const ModelMesh& mesh, const EntityMesh& before, EntityMesh& surface,
         const std::function<std::size_t()>& next_tag)
      : mesh_(mesh),
        before_(before),
        surface_(surface),
        next_tag_(next_tag),
        placed_(surface.node_tags.begin(), surface.node_tags.end()) {}

  Tags raise(CurvedElements& elements, Index e, const Tags& point_tags) {
    CurvedElement& element = elements.element(e);
    Tags tags;
    for (const Index corner : element.corners) tags.push_back(point_tags[corner]);
    for (std::size_t k = 0; k < element.sides.size(); ++k) {
      CurvedSide& side = elements.side(element.sides[k]);
      const bool forward = side.ends[0] == element.corners[k];
      for (std::size_t i = 0; i < side.nodes.size(); ++i)
        tags.push_back(place(side.nodes[forward ? i : side.nodes.size() - 1 - i]));
    }
    for (MiddleNode& node : element.inside) tags.push_back(place(node));
    return tags;
  }

 private:
  /// Gives it a tag if it has none. A node of the input may be this surface's, and not be there yet.
  std::size_t place(MiddleNode& node) {
    if (node.tag == 0) {
      node.tag = next_tag_();
      placed_.insert(node.tag);
      put(node.tag, node.place, node.parameters);
    } else if (const Index row = mesh_.rows.find(node.tag); row != kNone) {
      const bool is_own = &mesh_.entities[mesh_.owner[row]] == &before_;
      if (is_own && placed_.insert(node.tag).second) put(node.tag, mesh_.points[row], parameters_of(row));
    }
    return node.tag;
  }
  Eigen::Vector2d parameters_of(Index row) const {
    if (before_.uv.empty()) return kNoParameters;
    const std::size_t i = row - mesh_.rows.find(before_.node_tags.front());
    return {before_.uv[2 * i], before_.uv[2 * i + 1]};
  }
  void put(std::size_t tag, const Eigen::Vector3d& p, const Eigen::Vector2d& parameters) {
    surface_.node_tags.push_back(tag);
    surface_.xyz.insert(surface_.xyz.end(), p.data(), p.data() + 3);
    surface_.uv.insert(surface_.uv.end(), parameters.data(), parameters.data() + 2);
  }

  const ModelMesh& mesh_;
  const EntityMesh& before_;
  EntityMesh& surface_;
  const std::function<std::size_t()>& next_tag_;
  std::unordered_set<std::size_t> placed_;  ///< what the surface has
};

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

CurvedElements read_curved_elements(const ModelMesh& mesh, const EntityMesh& surface) {
  std::map<Index, Index> point_of;  // by row
  std::vector<Eigen::Vector3d> points;
  const auto number = [&](std::size_t tag) {
    const Index row = mesh.rows.find(tag);
    const auto [found, is_new] = point_of.try_emplace(row, Index(points.size()));
    if (is_new) points.push_back(mesh.points[row]);
    return found->second;
  };
  std::vector<std::pair<Tags, std::vector<Index>>> all;  // nodes, corners
  for (const std::size_t corners : {3, 4})
    if (const ElementBlock* block = surface.polygons(corners))
      for (std::size_t i = 0; i < block->tags.size(); ++i) {
        auto& [nodes, numbers] = all.emplace_back(element_of(*block, i), std::vector<Index>());
        for (std::size_t k = 0; k < corners; ++k) numbers.push_back(number(nodes[k]));
      }
  CurvedElements elements(std::move(points));
  for (const ElementBlock& block : surface.blocks) elements.set_type(element_type(block.type));
  const auto is_own = [&](std::size_t tag) { return &mesh.entities[mesh.owner[mesh.rows.find(tag)]] == &surface; };
  for (const auto& [nodes, corners] : all) {
    const std::size_t n = corners.size();
    const Index e = elements.add(corners);
    for (std::size_t k = 0; k < n; ++k) {
      CurvedSide& side = elements.side(elements.element(e).sides[k]);
      const Tags inner = edge_of(nodes, n, elements.type(n).order, k);
      const bool forward = side.ends[0] == corners[k];
      for (std::size_t i = 0; i < inner.size(); ++i)
        side.nodes[forward ? i : inner.size() - 1 - i] = given_node(mesh, inner[i]);
      side.is_given = !std::all_of(inner.begin(), inner.end(), is_own);
    }
    CurvedElement& element = elements.element(e);
    for (std::size_t i = 0; i < element.inside.size(); ++i)
      element.inside[i] = given_node(mesh, nodes[nodes.size() - element.inside.size() + i]);
  }
  return elements;
}

CurvedElements curve_result(const ModelMesh& mesh, const EntityMesh& before, const SurfacePart& part,
                            const QuadMesh& result) {
  return ResultElements(mesh, before, part, result).take();
}

void raise_order(const ModelMesh& mesh, const EntityMesh& before, std::vector<CurvedElements> parts,
                 const std::vector<Tags>& part_tags, EntityMesh& surface,
                 const std::function<std::size_t()>& next_tag) {
  Raiser raiser(mesh, before, surface, next_tag);
  for (ElementBlock& block : surface.blocks) {
    block.nodes.clear();
    for (std::size_t p = 0; p < parts.size(); ++p)
      for (Index e = 0; e < parts[p].elements(); ++e) {
        if (parts[p].element(e).corners.size() != block.corners) continue;
        const Tags tags = raiser.raise(parts[p], e, part_tags[p]);
        block.nodes.insert(block.nodes.end(), tags.begin(), tags.end());
      }
    const ElementType& type = parts.front().type(block.corners);
    block.type = type.type;
    block.order = type.order;
    block.nodes_per_element = type.nodes;
  }
}

std::string find_bent(const CurvedElements& elements) {
  const Index bent = elements.find_folded();
  return bent == kNone ? "" : "at " + describe(elements.place_of_fold(bent));
}

}  // namespace qmorph::adapter
