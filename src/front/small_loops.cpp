#include <algorithm>
#include <array>
#include <span>

#include "front/step.hpp"

namespace qmorph::front {
namespace {

/// A loop with more edges, or more triangles inside, than this is no remainder: it is meshed by the front.
constexpr std::size_t kMostEdges = 6;
constexpr std::size_t kMostTriangles4 = 6;
constexpr std::size_t kMostTriangles6 = 8;
/// A remainder closed at once must have corners at least this good.
constexpr double kLeastSine = 0.2;

/// The loop of h, or its first edges if it has more than kMostEdges.
std::span<const Index> loop_of(const Step& step, Index h, std::array<Index, kMostEdges + 1>& room) {
  std::size_t size = 0;
  Index e = h;
  do {
    room[size++] = e;
    e = step.front.next(e);
  } while (e != h && size < room.size());
  return {room.data(), size};
}

double corner_quality(const Mesh& mesh, std::span<const Index> loop, std::size_t a, std::size_t b, std::size_t c,
                      std::size_t d) {
  const auto p = [&](std::size_t i) { return mesh.point(mesh.origin(loop[i % loop.size()])); };
  return std::min({corner_sine(p(a), p(b), p(d)), corner_sine(p(b), p(c), p(a)), corner_sine(p(c), p(d), p(b)),
                   corner_sine(p(d), p(a), p(c))});
}

}  // namespace

bool close_small_loop(Step& step, Index h) {
  kernel::Mesh& mesh = step.mesh;
  std::array<Index, kMostEdges + 1> room{};
  const std::span<const Index> loop = loop_of(step, h, room);
  if (loop.size() != 4 && loop.size() != 6) return false;
  for (Index e : loop)  // a loop that touches itself is not a ring
    if (std::count_if(loop.begin(), loop.end(), [&](Index o) { return mesh.origin(o) == mesh.origin(e); }) != 1)
      return false;
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
