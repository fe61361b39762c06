// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Nodes in the middle of edges of a mesh, and the lines and triangles beside them cut in two.

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "gmsh/model/model_mesh.hpp"
#include "gmsh/model/periodic_links.hpp"
#include "qmorph/gmsh.hpp"

namespace qmorph::adapter {

/// Splits edges in a copy of the model's mesh, then gives the model what has changed. Elements keep their order and the
/// curves their shape: for order 2 the node between the ends becomes a corner.
class EdgeSplitter {
 public:
  /// \param mesh of the current model, classified; changed by `run`
  explicit EdgeSplitter(ModelMesh& mesh)
      : mesh_(mesh), next_node_(mesh.max_node_tag), next_element_(mesh.max_element_tag) {}

  void plan(Index row_a, Index row_b) { edges_[key(mesh_.tags[row_a], mesh_.tags[row_b])]; }
  /// Returns what was split, in the order of the edges' node tags.
  std::vector<SplitEdge> run();
  /// \throws InputError if Gmsh refuses a step. The model must not be used then.
  void put_back() const;

 private:
  using Key = std::pair<std::size_t, std::size_t>;
  using Tags = std::vector<std::size_t>;
  using Point = Eigen::Vector3d;
  static Key key(std::size_t a, std::size_t b) { return {std::min(a, b), std::max(a, b)}; }

  const Point& point(std::size_t tag) const;
  std::size_t add_node(std::uint32_t owner, const Point& p);
  void find_edges();
  std::uint32_t lowest_owner(const Key& edge, std::uint32_t surface) const;
  void split_edge(const Key& edge, Tags nodes, std::uint32_t owner);
  void keep_upright(const Key& edge, std::size_t opposite);
  Tags nodes_from(std::size_t a, std::size_t b) const;
  void split_lines(EntityMesh& entity);
  void split_triangles(std::uint32_t e);
  class Cut;
  std::vector<PeriodicLink> links_of(const std::vector<std::uint32_t>& entities) const;

  ModelMesh& mesh_;
  std::size_t next_node_, next_element_;
  /// By the tags of the ends: all nodes of the two halves, from the smaller end. Every other one is new.
  std::map<Key, Tags> edges_;
  std::map<Key, SplitEdge> report_;
  std::map<std::size_t, Point> new_points_;
  std::map<Key, std::uint32_t> owners_;  ///< of the new nodes
  std::set<std::uint32_t> changed_;
};

}  // namespace qmorph::adapter
