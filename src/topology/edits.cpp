// SPDX-License-Identifier: GPL-2.0-or-later
#include "topology/edits.hpp"

#include <algorithm>
#include <array>

#include "kernel/sort_unique.hpp"

namespace qmorph::topology {

Index remove_doublet(kernel::Mesh& mesh, Index v) {
  const Index h = mesh.out(v), k = mesh.rotate_ccw(h);
  const Index f = mesh.face(h), g = mesh.face(k);
  // Of each face's ring, all but the two half-edges at v.
  std::vector<Index> ring;
  for (Index start : {h, k})
    for (Index e = mesh.next(start); mesh.target(e) != v; e = mesh.next(e)) ring.push_back(e);
  return mesh.make_face(ring, std::array{f, g});
}

namespace {

/// Whether what remove_doublet() makes of the two faces is one: a triangle or more, without a side in it twice. Two
/// faces that have a third side in common lie between two edges that join the same nodes.
bool is_removable(const kernel::Mesh& mesh, Index v) {
  const Index h = mesh.out(v), k = mesh.rotate_ccw(h);
  const Index f = mesh.face(h), g = mesh.face(k);
  if (f == g || mesh.degree(f) + mesh.degree(g) < 7) return false;
  for (Index e = mesh.next(h); mesh.target(e) != v; e = mesh.next(e))
    if (mesh.face(kernel::Mesh::twin(e)) == g) return false;
  return true;
}

}  // namespace

void remove_doublets(kernel::Mesh& mesh, std::vector<Index>& nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {  // grows
    const Index v = nodes[i];
    if (!mesh.is_live_vertex(v) || !mesh.is_free(v) || mesh.valence(v) != 2 || !is_removable(mesh, v)) continue;
    const std::vector<Index> left = nodes_of(mesh, remove_doublet(mesh, v));
    nodes.insert(nodes.end(), left.begin(), left.end());
  }
  keep_live(mesh, nodes);
}

void keep_live(const kernel::Mesh& mesh, std::vector<Index>& nodes) {
  std::erase_if(nodes, [&](Index v) { return !mesh.is_live_vertex(v); });
  sort_unique(nodes);
}

Vec2 middle_of_neighbours(const kernel::Mesh& mesh, Index v) {
  Vec2 sum = Vec2::Zero();
  int count = 0;
  for (Index h : mesh.around(v)) sum += mesh.point(mesh.target(h)), ++count;
  return sum / count;
}

void spread(kernel::Mesh& mesh, std::span<const Index> nodes, int sweeps) {
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (Index v : nodes) mesh.set_point(v, middle_of_neighbours(mesh, v));
}

std::vector<Index> nodes_of(const kernel::Mesh& mesh, Index f) {
  std::vector<Index> nodes;
  nodes.reserve(mesh.degree(f));
  mesh.for_nodes_of(f, [&](Index v) { nodes.push_back(v); });
  return nodes;
}

namespace {

std::uint64_t hash_of_nodes(const kernel::Mesh& mesh, Index f) {
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio
  std::uint64_t sum = 0;
  for (Index h : mesh.sides_of(f)) {
    const std::uint64_t side = (std::uint64_t{mesh.origin(h)} << 32 | mesh.target(h)) * kOdd;
    sum += (side ^ side >> 32) * kOdd;
  }
  return sum;
}

}  // namespace

std::vector<Index> faces_around(const kernel::Mesh& mesh, const std::vector<Index>& nodes) {
  std::vector<Index> faces;
  faces.reserve(5 * nodes.size());
  for (Index v : nodes) {
    if (!mesh.is_live_vertex(v)) continue;
    for (Index h : mesh.around(v))
      if (mesh.face(h) != kNone) faces.push_back(mesh.face(h));
  }
  sort_unique(faces);
  return faces;
}

std::uint64_t connectivity(const kernel::Mesh& mesh, const std::vector<Index>& faces) {
  std::uint64_t sum = 0;
  for (Index f : faces) sum += hash_of_nodes(mesh, f);
  return sum;
}

std::uint64_t connectivity(const kernel::Mesh& mesh) {
  std::uint64_t sum = 0;
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.is_live_face(f)) sum += hash_of_nodes(mesh, f);
  return sum;
}

std::vector<Index> grow(const kernel::Mesh& mesh, std::vector<Index> faces, int rings) {
  std::sort(faces.begin(), faces.end());
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<Index> nodes;
    for (Index f : faces)
      for (Index v : nodes_of(mesh, f)) nodes.push_back(v);
    faces = faces_around(mesh, nodes);
  }
  return faces;
}

bool pillow(kernel::Mesh& mesh, const std::vector<Index>& faces, std::vector<Index>& nodes) {
  constexpr double kShare = 0.2;
  std::vector<Index> sorted = faces;
  std::sort(sorted.begin(), sorted.end());
  const auto inside = [&](Index f) { return f != kNone && std::binary_search(sorted.begin(), sorted.end(), f); };
  std::vector<Index> outline;
  for (Index f : sorted) {
    for (Index h : mesh.sides_of(f))
      if (!inside(mesh.face(kernel::Mesh::twin(h)))) outline.push_back(h);
  }
  std::vector<Index> origins;
  for (Index h : outline) origins.push_back(mesh.origin(h));
  std::sort(origins.begin(), origins.end());
  if (std::adjacent_find(origins.begin(), origins.end()) != origins.end()) return false;

  std::vector<std::vector<Index>> loops;
  std::sort(outline.begin(), outline.end());
  while (!outline.empty()) {
    std::vector<Index> loop;
    Index h = outline.front();
    do {
      loop.push_back(h);
      outline.erase(std::lower_bound(outline.begin(), outline.end(), h));
      h = mesh.next(h);  // round the target, through the set, to the next side of its outline
      while (inside(mesh.face(kernel::Mesh::twin(h)))) h = mesh.rotate_cw(h);
    } while (h != loop.front());
    loops.push_back(std::move(loop));
  }
  for (const auto& loop : loops) {
    const std::vector<Index> copies = mesh.pillow(loop, kShare);
    nodes.insert(nodes.end(), copies.begin(), copies.end());
  }
  return true;
}

namespace {

/// The half-edges that leave a and b in their common face.
std::pair<Index, Index> find_in_common_face(const kernel::Mesh& mesh, Index a, Index b) {
  std::vector<std::pair<Index, Index>> ways;  // from a, both ways along each face
  std::vector<Index> starts;
  for (Index h : mesh.around(a))
    if (mesh.face(h) != kNone) ways.emplace_back(h, h), starts.push_back(h);
  for (bool any = true; any;) {
    any = false;
    for (std::size_t i = 0; i < ways.size(); ++i) {
      auto& [ahead, back] = ways[i];
      if (ahead == kNone) continue;
      ahead = mesh.next(ahead);
      back = mesh.prev(back);
      for (Index e : {ahead, back})
        if (mesh.origin(e) == b) return {starts[i], e};
      if (ahead == starts[i]) ahead = kNone;
      any = true;
    }
  }
  return {kNone, kNone};
}

}  // namespace

Index draw_path(kernel::Mesh& mesh, Index a, Index b, const std::vector<Vec2>& points, std::vector<Index>& nodes) {
  const auto [g, h] = find_in_common_face(mesh, a, b);
  if (g == kNone || (points.empty() && mesh.find(a, b) != kNone)) return kNone;
  const Index first = mesh.split_face(g, h);
  Index e = first;
  for (const Vec2& p : points) {
    nodes.push_back(mesh.split_edge(e, p));
    e = mesh.next(e);
  }
  return first;
}

double smallest_sine(const kernel::Mesh& mesh) {
  double least = 1;
  for (Index f = 0; f < mesh.face_slots(); ++f)
    if (mesh.is_live_face(f)) least = std::min(least, mesh.smallest_sine(f));
  return least;
}

double smallest_sine(const kernel::Mesh& mesh, const std::vector<Index>& nodes) {
  const std::size_t n = nodes.size();
  double least = 1;
  for (std::size_t i = 0; i < n; ++i)
    least = std::min(
        least, corner_sine(mesh.point(nodes[i]), mesh.point(nodes[(i + 1) % n]), mesh.point(nodes[(i + n - 1) % n])));
  return least;
}

double worst_corner_shape(const kernel::Mesh& mesh, Index f) {
  double least = 1;
  Index h = mesh.half_edge(f);
  for (Index i = 0; i < mesh.degree(f); ++i, h = mesh.next(h)) {
    const Vec2 a = mesh.vector(h), b = -mesh.vector(mesh.prev(h));
    least = std::min(least, 4 * cross(a, b) / (a.squaredNorm() + b.squaredNorm() + (a - b).squaredNorm()));
  }
  return least;
}

}  // namespace qmorph::topology
