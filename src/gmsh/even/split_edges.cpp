// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/even/split_edges.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "gmsh/even/even_links.hpp"
#include "gmsh/model/put_back.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector3d;

/// On the curve of a CAD kernel where that is near, else in the middle of the chord.
Vector3d middle_of(const Vector3d& a, const Vector3d& b, const EntityMesh& owner) {
  const Vector3d chord = (a + b) / 2;
  const std::string type = entity_type(owner.dim, owner.tag);
  if (owner.dim != 1 || type == "Line" || type.rfind("Discrete", 0) == 0) return chord;
  std::vector<double> u, on_curve;
  const StageLog log = run_logged([&] {
    ::gmsh::model::getParametrization(1, owner.tag, {chord.x(), chord.y(), chord.z()}, u);
    ::gmsh::model::getValue(1, owner.tag, u, on_curve);
  });
  // With more sagitta than this a triangle beside the edge might turn over.
  constexpr double kMostSagitta = 0.1;
  if (!log.errors.empty() || on_curve.size() != 3) return chord;
  const Vector3d p(on_curve[0], on_curve[1], on_curve[2]);
  return (p - chord).norm() < kMostSagitta * (b - a).norm() ? p : chord;
}

/// The polynomial through points at equal steps, from 0 to 1.
Vector3d on_polynomial(const std::vector<Vector3d>& points, double t) {
  const double steps = static_cast<double>(points.size() - 1);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t j = 0; j < points.size(); ++j) {
    double factor = 1;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (k != j) factor *= (t * steps - static_cast<double>(k)) / (static_cast<double>(j) - static_cast<double>(k));
    sum += factor * points[j];
  }
  return sum;
}

/// Of an element: from corner k to the next, with what is between. Gmsh lists the corners, then the nodes of each edge.
std::vector<std::size_t> side_of(const ElementBlock& block, std::size_t element, std::size_t k) {
  const std::size_t* nodes = block.nodes.data() + element * block.nodes_per_element;
  const auto inner = static_cast<std::size_t>(block.order) - 1;
  std::vector<std::size_t> side{nodes[k]};
  side.insert(side.end(), nodes + block.corners + k * inner, nodes + block.corners + (k + 1) * inner);
  side.push_back(nodes[(k + 1) % block.corners]);
  return side;
}

}  // namespace

const Vector3d& EdgeSplitter::point(std::size_t tag) const {
  const auto found = new_points_.find(tag);
  return found == new_points_.end() ? mesh_.points[mesh_.rows.find(tag)] : found->second;
}

std::size_t EdgeSplitter::add_node(std::uint32_t owner, const Vector3d& p) {
  EntityMesh& entity = mesh_.entities[owner];
  entity.node_tags.push_back(++next_node_);
  entity.xyz.insert(entity.xyz.end(), p.data(), p.data() + 3);
  entity.uv.clear();
  changed_.insert(owner);
  new_points_[next_node_] = p;
  return next_node_;
}

void EdgeSplitter::find_edges() {
  for (std::uint32_t e = 0; e < mesh_.entities.size(); ++e) {
    const EntityMesh& entity = mesh_.entities[e];
    for (const ElementBlock& block : entity.blocks) {
      const bool is_line = entity.dim == 1 && block.corners == 2;
      if (!is_line && !(entity.dim == 2 && block.corners == 3)) continue;
      for (std::size_t i = 0; i < block.tags.size(); ++i)
        for (std::size_t k = 0; k < (is_line ? 1 : block.corners); ++k) {
          const Tags side = side_of(block, i, k);
          const Key edge = key(side.front(), side.back());
          const auto found = edges_.find(edge);
          if (found == edges_.end()) continue;
          changed_.insert(e);
          // Curves come before surfaces, so the first is the lowest; and if it is a surface, no line element is there.
          if (found->second.empty()) split_edge(edge, side, is_line ? e : lowest_owner(edge, e));
          if (is_line) continue;
          report_[edge].surfaces.push_back(entity.tag);
          if (block.order == 1) keep_upright(edge, block.nodes[i * block.nodes_per_element + (k + 2) % 3]);
        }
    }
  }
}

std::uint32_t EdgeSplitter::lowest_owner(const Key& edge, std::uint32_t surface) const {
  const std::uint32_t curve = curve_under(mesh_, mesh_.rows.find(edge.first), mesh_.rows.find(edge.second));
  return curve == kNobody ? surface : curve;
}

void EdgeSplitter::split_edge(const Key& edge, Tags nodes, std::uint32_t owner) {
  if (nodes.front() != edge.first) std::reverse(nodes.begin(), nodes.end());
  std::vector<Vector3d> points;
  for (std::size_t tag : nodes) points.push_back(point(tag));
  Tags halves;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    halves.push_back(nodes[i]);
    if (i + 1 == nodes.size()) break;
    const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(nodes.size() - 1);
    halves.push_back(add_node(
        owner, nodes.size() == 2 ? middle_of(points[0], points[1], mesh_.entities[owner]) : on_polynomial(points, t)));
  }
  SplitEdge& split = report_[edge];
  split.where = point(halves[halves.size() / 2]);
  if (mesh_.entities[owner].dim == 1) split.curve = mesh_.entities[owner].tag;
  edges_[edge] = std::move(halves);
  owners_[edge] = owner;
}

/// Where a curve arches so far that a half of the triangle beside it would turn over, the new node lies on the chord.
void EdgeSplitter::keep_upright(const Key& edge, std::size_t opposite) {
  constexpr double kLeastShare = 0.2;  // of what each half has if the node lies on the chord
  const std::size_t middle = edges_[edge][1];
  const Vector3d a = point(edge.first), b = point(edge.second), c = point(opposite), p = point(middle);
  const Vector3d normal = (b - a).cross(c - a);
  const double least = kLeastShare * normal.squaredNorm() / 2;
  if ((p - a).cross(c - a).dot(normal) >= least && (b - p).cross(c - p).dot(normal) >= least) return;
  const Vector3d chord = (a + b) / 2;
  EntityMesh& owner = mesh_.entities[owners_[edge]];
  const auto row = std::find(owner.node_tags.rbegin(), owner.node_tags.rend(), middle).base() - 1;
  std::copy_n(chord.data(), 3, owner.xyz.begin() + 3 * (row - owner.node_tags.begin()));
  new_points_[middle] = report_[edge].where = chord;
}

/// Of an edge that is split; empty for others.
EdgeSplitter::Tags EdgeSplitter::nodes_from(std::size_t a, std::size_t b) const {
  const auto found = edges_.find(key(a, b));
  if (found == edges_.end()) return {};
  Tags nodes = found->second;
  if (a > b) std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

void EdgeSplitter::split_lines(EntityMesh& entity) {
  for (ElementBlock& block : entity.blocks) {
    if (block.corners != 2) continue;
    ElementBlock split = block;
    split.tags.clear(), split.nodes.clear();
    const std::size_t n = block.nodes_per_element, middle = n - 1;
    const auto add = [&](std::size_t tag, const Tags& nodes, std::size_t first) {
      split.tags.push_back(tag);
      split.nodes.insert(split.nodes.end(), {nodes[first], nodes[first + middle]});
      for (std::size_t k = 1; k < middle; ++k) split.nodes.push_back(nodes[first + k]);
    };
    for (std::size_t i = 0; i < block.tags.size(); ++i) {
      const Tags side = side_of(block, i, 0), halves = nodes_from(side.front(), side.back());
      add(block.tags[i], halves.empty() ? side : halves, 0);
      if (!halves.empty()) add(++next_element_, halves, middle);
    }
    block = std::move(split);
  }
}

/// Cuts a triangle of any order from the middle of a side to the corner opposite. Nodes of the pieces lie between nodes
/// of the triangle; they are told apart by their places in it, whole numbers, `steps` from one corner to the next:
/// twice as many as there are between its own nodes.
class EdgeSplitter::Cut {
 public:
  Cut(EdgeSplitter& splitter, const ElementBlock& block, const Tags& triangle, std::uint32_t owner)
      : splitter_(splitter),
        type_(block.type),
        local_(element_type(block.type).local),
        triangle_(triangle),
        owner_(owner),
        steps_(2 * block.order) {
    for (std::size_t j = 0; j < triangle.size(); ++j) nodes_[place(j)] = triangle[j];
  }

  std::pair<Tags, Tags> run(std::size_t side) {
    const std::size_t next = (side + 1) % 3;
    const Place from = place(side), to = place(next), opposite = place((side + 2) % 3);
    const Tags halves = splitter_.nodes_from(triangle_[side], triangle_[next]);
    for (int i = 0; i <= steps_; ++i) nodes_[between(from, to, i)] = halves[static_cast<std::size_t>(i)];
    const Place middle = between(from, to, steps_ / 2);
    std::array<Place, 3> corners = {place(0), place(1), place(2)};
    corners[next] = middle;
    const Tags first = piece(corners);
    return {first, piece({middle, to, opposite})};
  }

 private:
  using Place = std::array<int, 2>;

  /// Of a node of the triangle.
  Place place(std::size_t node) const {
    return {static_cast<int>(std::lround(local_[2 * node] * steps_)),
            static_cast<int>(std::lround(local_[2 * node + 1] * steps_))};
  }
  Place between(const Place& from, const Place& to, int step) const {
    return {from[0] + step * (to[0] - from[0]) / steps_, from[1] + step * (to[1] - from[1]) / steps_};
  }

  /// The node at a place; a new one where there is none yet.
  std::size_t node_at(const Place& at) {
    const auto [found, is_new] = nodes_.try_emplace(at, 0);
    if (!is_new) return found->second;
    std::vector<double> functions;
    int components = 0, orientations = 0;
    ::gmsh::model::mesh::getBasisFunctions(type_, {at[0] / double(steps_), at[1] / double(steps_), 0}, "Lagrange",
                                           components, functions, orientations);
    Vector3d p = Vector3d::Zero();
    for (std::size_t j = 0; j < triangle_.size(); ++j) p += functions[j] * splitter_.point(triangle_[j]);
    return found->second = splitter_.add_node(owner_, p);
  }

  /// The nodes of the triangle of the same order that has these corners.
  Tags piece(const std::array<Place, 3>& corners) {
    Tags nodes;
    for (std::size_t j = 0; j < triangle_.size(); ++j) {
      const Place local = place(j);
      Place at = corners[0];
      for (std::size_t axis : {0, 1}) {
        const int along = corners[1][axis] - corners[0][axis], across = corners[2][axis] - corners[0][axis];
        at[axis] += (along * local[0] + across * local[1]) / steps_;
      }
      nodes.push_back(node_at(at));
    }
    return nodes;
  }

  EdgeSplitter& splitter_;
  const int type_;
  const std::vector<double> local_;  ///< coordinates of the nodes in the triangle, from 0 to 1
  const Tags& triangle_;
  const std::uint32_t owner_;
  const int steps_;
  std::map<Place, std::size_t> nodes_;
};

void EdgeSplitter::split_triangles(std::uint32_t e) {
  for (std::size_t b = 0; b < mesh_.entities[e].blocks.size(); ++b) {
    ElementBlock& block = mesh_.entities[e].blocks[b];
    if (block.corners != 3) continue;
    const std::size_t n = block.nodes_per_element, count = block.tags.size();
    for (std::size_t i = 0; i < count; ++i) {
      // Pieces are looked at until none has a side to split; a triangle has three at most.
      std::vector<std::size_t> pieces{i};
      while (!pieces.empty()) {
        const std::size_t t = pieces.back();
        pieces.pop_back();
        const auto begin = block.nodes.begin() + static_cast<std::ptrdiff_t>(n * t);
        const Tags triangle(begin, begin + static_cast<std::ptrdiff_t>(n));
        for (std::size_t k = 0; k < 3; ++k) {
          if (!edges_.count(key(triangle[k], triangle[(k + 1) % 3]))) continue;
          const auto [first, second] = Cut(*this, block, triangle, e).run(k);
          std::copy(first.begin(), first.end(), block.nodes.begin() + static_cast<std::ptrdiff_t>(n * t));
          block.nodes.insert(block.nodes.end(), second.begin(), second.end());
          block.tags.push_back(++next_element_);
          pieces.insert(pieces.end(), {t, block.tags.size() - 1});
          break;
        }
      }
    }
  }
}

std::vector<SplitEdge> EdgeSplitter::run() {
  find_edges();
  for (std::uint32_t e : std::set<std::uint32_t>(changed_)) {
    if (mesh_.entities[e].dim == 1) split_lines(mesh_.entities[e]);
    if (mesh_.entities[e].dim == 2) split_triangles(e);
  }
  std::vector<SplitEdge> splits;
  for (const auto& [edge, split] : report_) splits.push_back(split);
  return splits;
}

/// Links that clearing takes away, with the new nodes of edges that are images of one another.
std::vector<PeriodicLink> EdgeSplitter::links_of(const std::vector<std::uint32_t>& entities) const {
  std::set<std::pair<int, int>> cleared;
  for (std::uint32_t e : entities) cleared.insert({mesh_.entities[e].dim, mesh_.entities[e].tag});
  std::vector<PeriodicLink> links;
  for (int dim : {0, 1, 2})
    for (PeriodicLink& link : read_periodic_links(mesh_, dim)) {
      if (!cleared.count({dim, link.slave}) && !cleared.count({dim, link.master})) continue;
      const std::map<std::size_t, std::size_t> image(link.nodes.begin(), link.nodes.end());
      for (const auto& [edge, nodes] : edges_) {
        const auto a = image.find(edge.first), b = image.find(edge.second);
        if (a == image.end() || b == image.end()) continue;
        const Tags theirs = nodes_from(a->second, b->second);
        for (std::size_t i = 1; i < theirs.size() && theirs.size() == nodes.size(); i += 2)
          link.nodes.emplace_back(nodes[i], theirs[i]);
      }
      links.push_back(std::move(link));
    }
  return links;
}

void EdgeSplitter::put_back() const {
  const std::vector<std::uint32_t> changed(changed_.begin(), changed_.end());
  const std::vector<PeriodicLink> links = links_of(find_cleared(mesh_, changed));
  std::vector<Replacement> replacements;
  for (std::uint32_t e : changed) replacements.push_back({e, &mesh_.entities[e]});
  adapter::put_back(mesh_, replacements);
  restore_links(links);
}

}  // namespace qmorph::adapter
