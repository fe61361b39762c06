// SPDX-License-Identifier: GPL-2.0-or-later
#include "cleanup/patterns/match.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "qmorph/quality.hpp"

namespace qmorph::cleanup {
namespace {

using kernel::Mesh;

constexpr int kAny = std::numeric_limits<int>::max();

signed char flag(std::string_view digits, std::size_t i) {
  if (digits.empty()) return -1;
  return digits[i] == '1';
}

/// The inner angle of the outline of the elements around the centre at the i-th node of the ring.
double outline_angle(const Mesh& mesh, const Ring& ring, int i) {
  const auto size = int(ring.nodes.size());
  const Vec2& p = mesh.point(ring.nodes[i]);
  const Vec2 next = mesh.point(ring.nodes[(i + 1) % size]) - p;
  const Vec2 previous = mesh.point(ring.nodes[(i + size - 1) % size]) - p;
  return ring.mirrored ? ccw_angle(previous, next) : ccw_angle(next, previous);
}

bool vertices_fit(const Mesh& mesh, const Pattern& pattern, const Ring& ring, int shift) {
  const auto size = int(ring.nodes.size());
  double largest = 0, smallest_other = std::numeric_limits<double>::infinity();
  for (int i = 0; i < size; ++i) {
    const double angle = outline_angle(mesh, ring, (i + shift) % size);
    if (pattern.ring[i].is_vertex)
      largest = std::max(largest, angle);
    else
      smallest_other = std::min(smallest_other, angle);
  }
  return largest < smallest_other;
}

bool fits(const Mesh& mesh, const Pattern& pattern, const Ring& ring, int shift) {
  const std::size_t size = ring.nodes.size();
  for (std::size_t i = 0; i < size; ++i) {
    const Pattern::Entry& entry = pattern.ring[i];
    const std::size_t k = (i + shift) % size;
    if (ring.valences[k] < entry.least || ring.valences[k] > entry.most) return false;
    if (entry.boundary >= 0 && mesh.is_boundary(ring.nodes[k]) != bool(entry.boundary)) return false;
  }
  return !pattern.has_vertices || vertices_fit(mesh, pattern, ring, shift);
}

}  // namespace

int GlossaryValence::operator()(Index v) const {
  const auto edges = int(mesh_.valence(v));
  if (!mesh_.is_boundary(v)) return edges;
  if (extra_.size() <= v) extra_.resize(mesh_.vertex_slots(), -1);
  if (extra_[v] < 0) {
    constexpr double kDegrees = 180 / std::numbers::pi;
    const Index out = mesh_.out(v);
    const double angle = ccw_angle(-mesh_.vector(mesh_.prev(out)), mesh_.vector(out));
    extra_[v] = static_cast<signed char>(boundary_valence(0, kDegrees * (angle > 0 ? angle : 2 * std::numbers::pi)));
  }
  return edges + extra_[v];
}

Pattern::Pattern(const Case& c) : source(&c), centre(c.valences.at(0) - '0'), has_vertices(!c.vertices.empty()) {
  centre_boundary = c.boundary.empty() ? 0 : flag(c.boundary, 0);  // tables 1 and 2 are about nodes inside
  for (std::size_t i = 2; i < c.valences.size(); ++i) {
    const char digit = c.valences[i];
    if (digit == '+') ring.back().most = kAny;
    if (digit == '-') ring.back().least = 0;
    if (digit < '0' || digit > '9') continue;
    const int valence = digit - '0';
    ring.push_back({valence, valence == 0 ? kAny : valence, false, -1});
  }
  const std::size_t size = ring.size();
  for (const std::string_view digits : {c.vertices, c.interior})
    if (!digits.empty() && digits.size() != size) throw std::logic_error(std::string(c.name) + ": patterns differ");
  if (!c.boundary.empty() && c.boundary.size() != size + 1)
    throw std::logic_error(std::string(c.name) + ": patterns differ");
  for (std::size_t i = 0; i < size; ++i) {
    ring[i].is_vertex = flag(c.vertices, i) == 1;
    if (flag(c.interior, i) == 1) ring[i].boundary = 0;
    if (!c.boundary.empty()) ring[i].boundary = flag(c.boundary, i + 1);
  }
}

bool read_ring(const Mesh& mesh, const GlossaryValence& valence, Index centre, Ring& ring) {
  ring = {centre, valence(centre), mesh.is_boundary(centre), false, {}, {}, {}};
  for (Index h : mesh.around_inside(centre)) {
    ring.nodes.push_back(mesh.target(h));
    const Index f = mesh.face(h);
    if (f != kNone) {
      if (!mesh.is_quad(f)) return false;
      ring.darts.push_back({h, false});
      ring.nodes.push_back(mesh.target(mesh.next(h)));
    }
  }
  for (Index v : ring.nodes) ring.valences.push_back(valence(v));
  return true;
}

Ring mirrored(const Mesh& mesh, const Ring& ring) {
  Ring mirror = ring;
  mirror.mirrored = true;
  // Inside, the first node stays the first; on the boundary the last one becomes it. The element that follows an
  // edge is now the one before it.
  std::reverse(mirror.nodes.begin() + !ring.is_boundary, mirror.nodes.end());
  std::reverse(mirror.valences.begin() + !ring.is_boundary, mirror.valences.end());
  std::reverse(mirror.darts.begin(), mirror.darts.end());
  for (Dart& dart : mirror.darts) dart = {mesh.prev(dart.h), true};
  return mirror;
}

int find_match(const Mesh& mesh, const Pattern& pattern, const Ring& ring, int from) {
  if (pattern.centre != ring.valence || pattern.ring.size() != ring.nodes.size() ||
      bool(pattern.centre_boundary) != ring.is_boundary)
    return -1;
  const int starts = ring.is_boundary ? 1 : int(ring.darts.size());
  for (int i = from; i < starts; ++i)
    if (fits(mesh, pattern, ring, 2 * i)) return i;
  return -1;
}

}  // namespace qmorph::cleanup
