// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A copy of everything in the current Gmsh model's mesh, and which entity uses what. Reading all of it once
/// is cheaper than asking Gmsh again, and it is what is put back where Gmsh has to forget.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <unordered_map>
#include <vector>

#include "gmsh/session/element_types.hpp"
#include "qmorph/error.hpp"
#include "qmorph/patch.hpp"

namespace qmorph::adapter {

/// Of a node on a surface, where none are known.
inline const Eigen::Vector2d kNoParameters = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());

/// The elements of one type of one entity.
struct ElementBlock {
  int type = 0;
  std::size_t nodes_per_element = 0;
  std::size_t corners = 0;  ///< come first among the nodes
  int order = 1;
  std::vector<std::size_t> tags;
  std::vector<std::size_t> nodes;  ///< node tags, nodes_per_element for each
};

/// One entity with the nodes that it owns and its elements, as Gmsh has them.
struct EntityMesh {
  int dim = 0, tag = 0;
  std::vector<std::size_t> node_tags;
  std::vector<double> xyz;
  std::vector<double> uv;  ///< 2 a node, or empty if a node has none
  std::vector<ElementBlock> blocks;

  std::size_t element_count() const;
  const ElementBlock* block(int type) const;
  /// Of surfaces: triangles (3) or quads (4), whatever their order.
  const ElementBlock* polygons(std::size_t corners) const;
};

/// From node tags to rows 0 .. n-1: an array where the tags are dense, a map where they are not.
class NodeRows {
 public:
  NodeRows() = default;
  explicit NodeRows(const std::vector<std::size_t>& tags);
  Index find(std::size_t tag) const {
    if (!dense_.empty()) return tag < dense_.size() ? dense_[tag] : kNone;
    const auto found = sparse_.find(tag);
    return found == sparse_.end() ? kNone : found->second;
  }
  /// A tag that two nodes have, or 0.
  std::size_t duplicate() const { return duplicate_; }

 private:
  std::vector<Index> dense_;
  std::unordered_map<std::size_t, Index> sparse_;
  std::size_t duplicate_ = 0;
};

/// The mesh of the current model. Rows number all nodes in the order of their entities.
struct ModelMesh {
  std::vector<EntityMesh> entities;  ///< by dimension, then tag
  NodeRows rows;
  std::vector<std::size_t> tags;        ///< of a row
  std::vector<Eigen::Vector3d> points;  ///< of a row
  std::vector<std::uint32_t> owner;     ///< of a row: an index into `entities`
  std::size_t max_node_tag = 0, max_element_tag = 0;
};

/// Null if the model has no such entity. O(log n).
const EntityMesh* find_entity(const ModelMesh& mesh, int dim, int tag);

/// Copies the current model's mesh.
/// \throws InputError if two nodes have one tag, or a line or point element uses a node that does not exist.
ModelMesh read_model_mesh();

inline constexpr std::uint32_t kNobody = 0xffffffff;

/// Which entities' elements use a node.
struct NodeUse {
  std::vector<std::uint32_t> surface;  ///< first entity of dimension 2 whose elements use the row, or kNobody
  std::vector<bool> several;           ///< elements of two surfaces or more use it
  std::vector<std::uint32_t> volume;   ///< first entity of dimension 3 whose elements use the row, or kNobody
  std::vector<bool> point, line;
  std::vector<bool> pinned;  ///< on a point or a curve, by owner or by use
};

/// \param pinned_tags nodes that are known to lie on points and curves although nothing says so any more.
NodeUse find_node_use(const ModelMesh& mesh, const std::vector<std::size_t>& pinned_tags = {});

/// True if nodes are owned by other entities than those whose elements use them: a file by a program that
/// puts all nodes in one block.
bool is_misclassified(const ModelMesh& mesh, const NodeUse& use);

/// "node 12 at (1, 2.5, 0)", for messages, and the same for programs.
std::string describe_node(const ModelMesh& mesh, Index row);
ErrorDetails at_node(const ModelMesh& mesh, Index row, ErrorKind kind);

}  // namespace qmorph::adapter
