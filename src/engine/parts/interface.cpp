// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/parts/interface.hpp"

#include <algorithm>
#include <map>

#include "kernel/sort_unique.hpp"
#include "smoothing/node_energy.hpp"
#include "smoothing/smooth.hpp"
#include "topology/edits.hpp"

namespace qmorph {
namespace {

using kernel::Mesh;

constexpr int kSweeps = 8;
constexpr int kRings = 2;  ///< around an interface that make room
/// A move may not leave triangles with a smaller sine, unless they were worse before.
constexpr double kFloor = 0.35;
constexpr int kHalvings = 3;

/// Where the interface through v is straight; v itself if that cannot be said. Where three interfaces or more meet, the
/// two that are most nearly opposite are one line.
Vec2 straight_position(const Mesh& mesh, const Division& division, Index v) {
  const Vec2& p = mesh.point(v);
  std::vector<Vec2> ends;
  for (Index h : mesh.around(v))
    if (division.is_interface(mesh, h)) ends.push_back(mesh.point(mesh.target(h)));
  double least = 1;
  Vec2 middle = p;
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const double cosine = (ends[i] - p).normalized().dot((ends[k] - p).normalized());
      if (cosine < least) least = cosine, middle = 0.5 * (ends[i] + ends[k]);
    }
  return middle;
}

void move_towards(Mesh& mesh, Index v, const Vec2& goal) {
  const Vec2 start = mesh.point(v);
  const double floor = std::min(kFloor, mesh.smallest_sine_around(v));
  double share = 1;
  for (int i = 0; i <= kHalvings; ++i, share /= 2) {
    mesh.set_point(v, start + share * (goal - start));
    if (mesh.smallest_sine_around(v) >= floor) return;
  }
  mesh.set_point(v, start);
}

/// Free nodes within some rings of the given ones, without them.
std::vector<Index> nodes_around(const Mesh& mesh, const std::vector<Index>& nodes) {
  std::vector<Index> around = nodes;
  for (int ring = 0; ring < kRings; ++ring) {
    for (std::size_t i = 0, count = around.size(); i < count; ++i) {
      for (Index h : mesh.around(around[i])) around.push_back(mesh.target(h));
    }
    sort_unique(around);
  }
  std::erase_if(around, [&](Index v) { return std::binary_search(nodes.begin(), nodes.end(), v); });
  return around;
}

bool is_on_interface(const Mesh& mesh, const Division& division, Index v) {
  for (Index h : mesh.around(v))
    if (division.is_interface(mesh, h)) return true;
  return false;
}

/// Two triangles become four; the new ones belong to the parts of the old. Returns the new node.
Index split_interface_edge(Mesh& mesh, Division& division, Index h) {
  const Index m = mesh.split_edge(h, 0.5 * (mesh.point(mesh.origin(h)) + mesh.point(mesh.target(h))));
  for (Index side : Mesh::halves_of(h)) {
    const Index from_m = mesh.origin(side) == m ? side : mesh.next(side);
    const Index part = division.part[mesh.face(from_m)];
    const Index d = mesh.split_face(from_m, mesh.next(mesh.next(from_m)));
    division.part.resize(mesh.face_slots());
    for (Index half : Mesh::halves_of(d)) division.part[mesh.face(half)] = part;
  }
  return m;
}

/// v and the nodes that are not more than some steps along interfaces away, ascending.
std::vector<Index> along_interfaces(const Mesh& mesh, const Division& division, Index v) {
  constexpr int kSteps = 10;
  std::vector<Index> nodes{v};
  for (int step = 0; step < kSteps; ++step)
    for (std::size_t i = 0, count = nodes.size(); i < count; ++i) {
      for (Index h : mesh.around(nodes[i])) {
        const Index u = mesh.target(h);
        if (division.is_interface(mesh, h) && std::find(nodes.begin(), nodes.end(), u) == nodes.end())
          nodes.push_back(u);
      }
    }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// A tree of parts, in which each has a lower one that is its neighbour, and the longest edge between the two.
struct Tree {
  std::vector<Index> order;            ///< parts, each after its parent
  std::vector<Index> parent, longest;  ///< of each part; kNone at the root
};

/// Half-edges of all interfaces, ascending. The parts with an odd number of sides are marked in `odd`.
std::vector<Index> find_interfaces(const Mesh& mesh, const Division& division, std::vector<char>& odd) {
  std::vector<Index> interface;
  for (Index h = 0; h < mesh.half_edge_slots(); h += 2) {
    if (!mesh.is_live_half_edge(h)) continue;
    const Index f = mesh.face(h), g = mesh.face(Mesh::twin(h));
    const Index left = f == kNone ? kNone : division.part[f], right = g == kNone ? kNone : division.part[g];
    if (left == right) continue;
    if (left != kNone) odd[left] ^= 1;
    if (right != kNone) odd[right] ^= 1;
    if (left != kNone && right != kNone) interface.insert(interface.end(), {h, Mesh::twin(h)});
  }
  return interface;
}

Tree span_parts(const Mesh& mesh, const Division& division, const std::vector<Index>& interface) {
  std::vector<std::map<Index, Index>> neighbours(division.parts);  // part -> the longest edge to it
  for (Index h : interface) {
    auto& longest = neighbours[division.part[mesh.face(h)]];
    const auto [at, is_new] = longest.emplace(division.part[mesh.face(Mesh::twin(h))], h);
    if (!is_new && mesh.length(h) > mesh.length(at->second)) at->second = h;
  }
  Tree tree{{0}, std::vector<Index>(division.parts, kNone), std::vector<Index>(division.parts, kNone)};
  for (std::size_t i = 0; i < tree.order.size(); ++i)
    for (const auto& [part, edge] : neighbours[tree.order[i]]) {
      if (part == 0 || tree.parent[part] != kNone) continue;
      tree.parent[part] = tree.order[i], tree.longest[part] = edge;
      tree.order.push_back(part);
    }
  return tree;
}

}  // namespace

void straighten_interfaces(Mesh& mesh, const Division& division, const std::vector<Index>& nodes) {
  std::vector<Index> around = nodes_around(mesh, nodes);
  std::erase_if(around, [&](Index v) { return !mesh.is_free(v) || is_on_interface(mesh, division, v); });
  smoothing::Star star;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (Index v : nodes)
      if (mesh.is_free(v)) move_towards(mesh, v, straight_position(mesh, division, v));
    for (Index v : around) smoothing::relax_node(mesh, v, star);
  }
}

void finish_interfaces(Mesh& mesh, Division& division) {
  std::vector<char> odd(division.parts, 0);
  const std::vector<Index> interface = find_interfaces(mesh, division, odd);
  for (Index h : interface) division.interface.push_back(mesh.origin(h));
  const Tree tree = span_parts(mesh, division, interface);
  for (std::size_t i = tree.order.size(); i-- > 1;) {
    const Index part = tree.order[i];
    if (!odd[part]) continue;
    const Index node = split_interface_edge(mesh, division, tree.longest[part]);
    division.interface.push_back(node);
    straighten_interfaces(mesh, division, along_interfaces(mesh, division, node));
    odd[tree.parent[part]] ^= 1;
  }
  sort_unique(division.interface);
}

}  // namespace qmorph
