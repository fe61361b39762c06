// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <array>
#include <span>

#include "front/step.hpp"

namespace qmorph::front {
namespace {

/// A loop with more triangles inside than this is left to the front.
constexpr std::size_t kMostTriangles4 = 6;
constexpr std::size_t kMostTriangles6 = 8;
/// A remainder closed at once must have corners at least this good.
constexpr double kLeastSine = 0.2;

double corner_quality(const Mesh& mesh, std::span<const Index> loop, std::size_t a, std::size_t b, std::size_t c,
                      std::size_t d) {
  const auto p = [&](std::size_t i) { return mesh.point(mesh.origin(loop[i % loop.size()])); };
  return std::min({corner_sine(p(a), p(b), p(d)), corner_sine(p(b), p(c), p(a)), corner_sine(p(c), p(d), p(b)),
                   corner_sine(p(d), p(a), p(c))});
}

}  // namespace

SmallLoop find_small_loop(const Step& step, const Base& base) {
  const Mesh& mesh = step.mesh;
  SmallLoop loop;
  std::size_t size = 0;
  for (Index e = base.h; size < loop.edges.size();) {
    loop.edges[size++] = e;
    if (e == base.before) break;
    e = e == base.h ? base.after : step.front.next(e);
  }
  if (loop.edges[size - 1] != base.before || (size != 4 && size != 6)) return {};
  const std::span<const Index> edges(loop.edges.data(), size);
  for (Index e : edges)  // a loop that touches itself is not a ring
    if (std::count_if(edges.begin(), edges.end(), [&](Index o) { return mesh.origin(o) == mesh.origin(e); }) != 1)
      return {};
  loop.size = size;
  return loop;
}

bool close_small_loop(Step& step, const SmallLoop& small) {
  kernel::Mesh& mesh = step.mesh;
  const std::span<const Index> loop(small.edges.data(), small.size);
  if (loop.size() == 4) {
    if (corner_quality(mesh, loop, 0, 1, 2, 3) < kLeastSine) return false;
    const Index quad = form_face(step, loop, kMostTriangles4);
    if (quad == kNone) return false;
    smooth_around(step, quad);
    return mesh.is_valid_face(quad);
  }
  // Six edges: two quads along the best of three diagonals.
  std::size_t best = 0;
  double best_quality = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double quality = std::min(corner_quality(mesh, loop, i, i + 1, i + 2, i + 3),
                                    corner_quality(mesh, loop, i + 3, i + 4, i + 5, i + 6));
    if (quality > best_quality) best = i, best_quality = quality;
  }
  if (best_quality < kLeastSine) return false;
  if (mesh.find(mesh.origin(loop[best]), mesh.origin(loop[best + 3])) != kNone) {
    // An edge there is either inside, and vanishes, or outside, and would be doubled.
    const Index there = mesh.find(mesh.origin(loop[best]), mesh.origin(loop[best + 3]));
    if (!mesh.is_triangle(mesh.face(there)) || !mesh.is_triangle(mesh.face(Mesh::twin(there)))) return false;
  }
  if (form_face(step, loop, kMostTriangles6) == kNone) return false;
  const Index diagonal = mesh.split_face(loop[best], loop[best + 3]);
  smooth_around(step, mesh.face(diagonal));
  smooth_around(step, mesh.face(Mesh::twin(diagonal)));
  return mesh.is_valid_face(mesh.face(diagonal)) && mesh.is_valid_face(mesh.face(Mesh::twin(diagonal)));
}

}  // namespace qmorph::front
