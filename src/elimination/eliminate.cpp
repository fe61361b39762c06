// SPDX-License-Identifier: GPL-2.0-or-later
#include "elimination/eliminate.hpp"

#include <algorithm>
#include <queue>
#include <span>

#include "elimination/certain.hpp"
#include "smoothing/smooth.hpp"
#include "topology/edits.hpp"

namespace qmorph::elimination {
namespace {

using kernel::Mesh;

/// Rings of neighbours that may give way after a triangle has been passed.
constexpr int kRings = 3;

std::vector<Index> triangles_of(const Mesh& mesh) {
  std::vector<Index> triangles;
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.is_live_face(f) && mesh.degree(f) == 3) triangles.push_back(f);
  return triangles;
}

/// Nodes of the quad that joining the triangles at h would make.
std::vector<Index> joined(const Mesh& mesh, Index h) {
  const Index t = Mesh::twin(h);
  return {mesh.origin(h), mesh.target(mesh.next(t)), mesh.target(h), mesh.target(mesh.next(h))};
}

void pair_triangles(Mesh& mesh) {
  struct Pair {
    double quality;
    Index half_edge;
  };
  std::vector<Pair> pairs;
  for (Index f : triangles_of(mesh)) {
    Index h = mesh.half_edge(f);
    for (int i = 0; i < 3; ++i, h = mesh.next(h)) {
      if (h > Mesh::twin(h) || !mesh.is_triangle(mesh.face(Mesh::twin(h)))) continue;
      const double quality = topology::smallest_sine(mesh, joined(mesh, h));
      if (quality > 0) pairs.push_back({quality, h});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return a.quality != b.quality ? a.quality > b.quality : a.half_edge < b.half_edge;
  });
  for (const Pair& pair : pairs) {
    const Index h = pair.half_edge;
    if (!mesh.is_live_half_edge(h) || !mesh.is_triangle(mesh.face(h)) || !mesh.is_triangle(mesh.face(Mesh::twin(h))))
      continue;
    mesh.begin();
    const Index f = mesh.face(mesh.join_faces(h));
    if (mesh.is_valid_face(f))
      mesh.commit();
    else
      mesh.rollback();
  }
}

/// Shortest chains of faces from one triangle to others. Faces on chains that failed cost more, so that the next
/// search finds a way round.
class Search {
 public:
  explicit Search(Mesh& mesh) : mesh_(mesh) {}

  /// Half-edges to cross, one after another, from `start` to the (skip + 1)-nearest triangle. Empty when there
  /// is none. O(faces visited * log).
  std::vector<Index> path_to_triangle(Index start, int skip) {
    came_by_.resize(mesh_.face_slots(), kNone);
    cost_.resize(mesh_.face_slots(), 0);
    penalty_.resize(mesh_.face_slots(), 0);
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::vector<Index> reached{start}, path;
    came_by_[start] = mesh_.half_edge(start);
    queue.push({0, start});
    while (!queue.empty() && path.empty()) {
      const auto [cost, f] = queue.top();
      queue.pop();
      if (cost != cost_[f]) continue;
      if (f != start && mesh_.is_triangle(f) && skip-- == 0) path = trace(start, f);
      for (Index h : mesh_.sides_of(f)) {
        const Index beyond = mesh_.face(Mesh::twin(h));
        if (beyond != kNone && beyond != start) {
          const unsigned there = cost + 1 + penalty_[beyond];
          if (came_by_[beyond] == kNone) reached.push_back(beyond);
          if (came_by_[beyond] == kNone || there < cost_[beyond]) {
            came_by_[beyond] = h;
            cost_[beyond] = there;
            queue.push({there, beyond});
          }
        }
      }
    }
    for (Index f : reached) came_by_[f] = kNone, cost_[f] = 0;
    mesh_.add_work(reached.size());
    return path;
  }

  void avoid(const std::vector<Index>& path) {
    constexpr unsigned kPenalty = 2;
    for (std::size_t i = 1; i < path.size(); ++i) {
      penalty_[mesh_.face(path[i])] += kPenalty;
      avoided_.push_back(mesh_.face(path[i]));
    }
  }
  void forgive() {
    for (Index f : avoided_) penalty_[f] = 0;
    avoided_.clear();
  }

 private:
  using Entry = std::pair<unsigned, Index>;  // cost, face

  std::vector<Index> trace(Index start, Index end) const {
    std::vector<Index> path;
    for (Index f = end; f != start; f = mesh_.face(came_by_[f])) path.push_back(came_by_[f]);
    std::reverse(path.begin(), path.end());
    return path;
  }

  Mesh& mesh_;  // for its count of work
  std::vector<Index> came_by_, avoided_;
  std::vector<unsigned> cost_, penalty_;
};

/// How a triangle is cut from a five-sided face: as the better of two ears, or around a new node inside, which gives
/// two quads besides and can follow any shape.
enum class Cut { ear, around_node };

/// The five-sided face of `exit` is cut so that a triangle lies at `exit`.
void cut_triangle_at(Mesh& mesh, Index exit, Cut cut, std::vector<Index>& nodes) {
  // Corners: exit runs a -> b, after it b -> c, c -> d, d -> e, e -> a.
  const Index before = mesh.prev(exit), after = mesh.next(exit), across = mesh.next(after);
  const Index a = mesh.origin(exit), b = mesh.origin(after), c = mesh.origin(across), d = mesh.target(across),
              e = mesh.origin(before);
  if (cut == Cut::around_node) {
    Vec2 centre = Vec2::Zero();
    for (Index v : {a, b, c, d, e}) centre += mesh.point(v) / 5;
    // a-d with the new node on it, then from the node to b: a triangle and two quads.
    const Index from_d = mesh.next(across);
    const Index diagonal = mesh.split_face(exit, from_d);  // a -> d, the part d, e, a on its left
    const Index o = mesh.split_edge(diagonal, centre);
    const Index from_o = mesh.next(Mesh::twin(diagonal)) == exit ? Mesh::twin(diagonal) : mesh.find(o, a);
    mesh.split_face(from_o, after);
    nodes.push_back(o);
    return;
  }
  const double first = std::min(topology::smallest_sine(mesh, {e, a, b}), topology::smallest_sine(mesh, {b, c, d, e}));
  const double second = std::min(topology::smallest_sine(mesh, {a, b, c}), topology::smallest_sine(mesh, {c, d, e, a}));
  if (first > second)
    mesh.split_face(before, after);
  else
    mesh.split_face(exit, across);
}

/// Passes the triangle behind path[0] across the first `crossings` edges of the path; if these are all, it meets the
/// triangle at the end. Nodes on the way are collected in `nodes`. False if two faces on the way share
/// more than one edge.
bool pass_along(Mesh& mesh, const std::vector<Index>& path, std::size_t crossings, Cut cut, std::vector<Index>& nodes) {
  for (std::size_t i = 0; i < crossings; ++i) {
    const Index h = path[i], f = mesh.face(h), g = mesh.face(Mesh::twin(h));
    if (f == kNone || g == kNone || f == g || !mesh.is_triangle(f)) return false;
    for (Index face : {f, g})
      for (Index v : topology::nodes_of(mesh, face)) nodes.push_back(v);
    int shared = 0;
    Index e = mesh.half_edge(f);
    for (int k = 0; k < 3; ++k, e = mesh.next(e)) shared += mesh.face(Mesh::twin(e)) == g;
    if (shared != 1) return false;
    mesh.join_faces(h);
    if (i + 1 < path.size()) cut_triangle_at(mesh, path[i + 1], cut, nodes);
  }
  return true;
}

/// How much of the surroundings gets a layer of quads around it, to give fixed nodes room, before a triangle is passed.
enum class Room { none, chain, ring, two_rings };

/// A triangle that is farther from its partner than this walks.
constexpr std::size_t kLongestChain = 40;

/// How hard to try: how triangles are cut, how much room is made, how long elements are untangled, how many
/// chains are tried.
struct Effort {
  Cut cut;
  Room room;
  int sweeps;  ///< times the usual number
  int chains;
};
constexpr Effort kLight[] = {
    {Cut::ear, Room::none, 1, 6}, {Cut::ear, Room::chain, 1, 4}, {Cut::around_node, Room::none, 1, 4}};

/// The faces on a path, the one behind its last edge too.
std::vector<Index> faces_on(const Mesh& mesh, const std::vector<Index>& path) {
  std::vector<Index> faces{mesh.face(path[0])};
  for (Index h : path) faces.push_back(mesh.face(Mesh::twin(h)));
  return faces;
}

/// One triangle to one partner, or part of the way, in a transaction.
bool try_path(Mesh& mesh, SmoothingOptions smoothing, const std::vector<Index>& path, std::size_t crossings,
              const Effort& effort) {
  smoothing.untangling_sweeps *= effort.sweeps;
  std::vector<Index> nodes;
  mesh.begin();
  bool done = true;
  if (effort.room != Room::none) {
    const int rings = int(effort.room) - int(Room::chain);
    const auto faces = topology::grow(mesh, faces_on(mesh, path), rings);
    done = topology::pillow(mesh, faces, nodes);
  }
  done = done && pass_along(mesh, path, crossings, effort.cut, nodes);
  if (done) {
    topology::remove_doublets(mesh, nodes);
    done = smoothing::smooth_near(mesh, smoothing, nodes, kRings);
  }
  done ? mesh.commit() : mesh.rollback();
  return done;
}

/// Passes triangle f to a partner nearby in one go, at first with little room and little effort.
bool pass_at_once(Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget, Search& search, Index f,
                  std::span<const Effort> efforts) {
  bool done = false;
  for (const Effort& effort : efforts) {
    for (int i = 0; i < effort.chains && !done && !budget.is_spent(); ++i) {
      // In turn the nearest partner along another path, and another partner.
      const std::vector<Index> path = search.path_to_triangle(f, i / 2);
      if (path.empty() || path.size() > kLongestChain) break;
      done = try_path(mesh, smoothing, path, path.size(), effort);
      if (!done) search.avoid(path);
    }
    search.forgive();
    if (done) break;
  }
  return done;
}

/// Walks triangle f to a partner, face by face: each step leaves a valid mesh, so a long way needs no
/// untangling as a whole. A step that fails makes the walk go round.
bool walk(Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget, Search& search, Index f) {
  constexpr int kSteps = 120, kMostFailures = 10;
  int failures = 0;
  constexpr Effort kStepEfforts[] = {{Cut::ear, Room::none, 1, 1},
                                     {Cut::around_node, Room::none, 1, 1},
                                     {Cut::ear, Room::chain, 2, 1},
                                     {Cut::around_node, Room::chain, 4, 1}};
  bool done = false;
  for (int step = 0; step < kSteps && !done && !budget.is_spent(); ++step) {
    std::vector<Index> path = search.path_to_triangle(f, 0);
    if (path.empty()) break;
    if (path.size() > 2) path.resize(2);
    bool moved = false;
    for (const Effort& effort : kStepEfforts)
      if ((moved = try_path(mesh, smoothing, path, 1, effort))) break;
    if (moved) {
      done = path.size() == 1;
      if (!done) f = mesh.face(path[1]);
      if (!done && !mesh.is_triangle(f)) break;
    } else {
      // A partner next door is not reached by a detour.
      if (path.size() == 1 || ++failures > kMostFailures) break;
      path.push_back(Mesh::twin(path.back()));
      search.avoid(path);
    }
  }
  search.forgive();
  return done;
}

/// Triangle f meets the nearest partner, whatever elements that makes: they are valid, and cleanup follows.
bool pair_for_certain(Mesh& mesh, const SmoothingOptions& smoothing, const kernel::Budget& budget, Search& search,
                      Index f) {
  const std::vector<Index> path = search.path_to_triangle(f, 0);
  if (path.empty()) return false;
  std::vector<Index> nodes;
  mesh.begin();
  if (!pair_along(mesh, path, nodes)) {
    mesh.rollback();
    return false;
  }
  mesh.commit();
  if (budget.is_spent()) return true;
  mesh.begin();
  smoothing::smooth_near(mesh, smoothing, nodes, kRings) ? mesh.commit() : mesh.rollback();
  return true;
}

}  // namespace

std::size_t eliminate_triangles(Mesh& mesh, const SmoothingOptions& smoothing, Means means,
                                const kernel::Budget& budget) {
  pair_triangles(mesh);
  Search search(mesh);
  SmoothingOptions thorough = smoothing;
  thorough.iterations = std::max(smoothing.iterations, 20);
  for (bool progress = true; progress;) {
    progress = false;
    const std::vector<Index> triangles = triangles_of(mesh);
    if (triangles.size() < 2) return triangles.size();
    for (Index f : triangles) {
      if (!mesh.is_live_face(f) || mesh.degree(f) != 3) continue;
      const bool passed =
          pass_at_once(mesh, thorough, budget, search, f, kLight) || walk(mesh, thorough, budget, search, f) ||
          (means == Means::cutting && mesh.is_triangle(f) && pair_for_certain(mesh, thorough, budget, search, f));
      progress = progress || passed;
    }
  }
  return triangles_of(mesh).size();
}

}  // namespace qmorph::elimination
