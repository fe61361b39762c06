// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "kernel/mesh.hpp"
#include "kernel/sort_unique.hpp"

namespace qmorph::kernel {
namespace {

class Inspector {
 public:
  Inspector(const Mesh& mesh, bool geometry) : mesh_(mesh), geometry_(geometry) {}

  std::vector<std::string> look_at(const std::vector<Index>& half_edges) {
    for (Index h : half_edges)
      if (mesh_.is_live_half_edge(h)) check_half_edge(h);
    if (!defects_.empty()) return defects_;
    for (Index h : half_edges) {
      if (!mesh_.is_live_half_edge(h)) continue;
      if (mesh_.face(h) != kNone) check_face(mesh_.face(h));
      check_vertex(mesh_.origin(h));
    }
    return defects_;
  }

  std::vector<std::string> run() {
    for (Index h = 0; h < mesh_.half_edge_slots(); ++h)
      if (mesh_.is_live_half_edge(h)) check_half_edge(h);
    if (!defects_.empty()) return defects_;  // loops below could be endless
    for (Index f = 0; f < mesh_.face_slots(); ++f)
      if (mesh_.is_live_face(f)) check_face(f);
    for (Index v = 0; v < mesh_.vertex_slots(); ++v)
      if (mesh_.is_live_vertex(v)) check_vertex(v);
    return defects_;
  }

 private:
  template <class... Parts>
  void report(const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    defects_.push_back(text.str());
  }

  void check_half_edge(Index h) {
    const Index n = mesh_.next(h), p = mesh_.prev(h);
    if (!mesh_.is_live_half_edge(Mesh::twin(h))) return report("h", h, ": twin is dead");
    if (n == kNone || p == kNone) return report("h", h, ": not linked");
    if (!mesh_.is_live_half_edge(n) || !mesh_.is_live_half_edge(p)) return report("h", h, ": neighbour is dead");
    if (mesh_.prev(n) != h) report("h", h, ": prev(next) is not itself");
    if (mesh_.origin(n) != mesh_.target(h)) report("h", h, ": next starts elsewhere");
    if (mesh_.face(n) != mesh_.face(h)) report("h", h, ": next has another face");
    if (!mesh_.is_live_vertex(mesh_.origin(h))) report("h", h, ": origin is dead");
    if (mesh_.face(h) != kNone && !mesh_.is_live_face(mesh_.face(h))) report("h", h, ": face is dead");
  }

  void check_face(Index f) {
    Index sides = 0;
    const Index start = mesh_.half_edge(f);
    Index h = start;
    do {
      if (mesh_.face(h) != f) return report("f", f, ": half-edge of another face");
      ++sides;
      h = mesh_.next(h);
    } while (h != start && sides <= 8);
    if (sides != mesh_.degree(f)) report("f", f, ": degree ", mesh_.degree(f), " but ", sides, " sides");
    if (sides != 3 && sides != 4) report("f", f, ": ", sides, " sides");
    if (geometry_ && !mesh_.is_valid_face(f)) {
      const Vec2& p = mesh_.point(mesh_.origin(start));
      report("f", f, ": not strictly convex, near (", p.x(), ", ", p.y(), ")");
    }
  }

  void check_vertex(Index v) {
    std::vector<Index> inner, all;
    int outside = 0, neighbours = 0;
    Index h = mesh_.out(v);
    do {
      if (mesh_.origin(h) != v) return report("v", v, ": out() leaves another vertex");
      outside += mesh_.face(h) == kNone;
      neighbours += 1;
      all.push_back(mesh_.target(h));
      if (!mesh_.is_boundary_edge(h)) inner.push_back(mesh_.target(h));
      h = mesh_.rotate_ccw(h);
    } while (h != mesh_.out(v) && neighbours < 100000);
    if (outside > 1) report("v", v, ": ", outside, " boundary half-edges leave it");
    if (outside == 1 && mesh_.face(mesh_.out(v)) != kNone) report("v", v, ": on the boundary, but out() is inside");
    // Only the two boundary edges of a slit that is one edge long may join the same nodes.
    for (Index u : inner)
      if (std::count(all.begin(), all.end(), u) > 1) report("v", v, ": two edges to one neighbour");
    if (neighbours < 2) report("v", v, ": valence under 2");
  }

  const Mesh& mesh_;
  bool geometry_;
  std::vector<std::string> defects_;
};

}  // namespace

void Mesh::check_touched() const {
  std::vector<Index> touched;
  for (const auto& [h, old] : edge_pool_.old_values) touched.push_back(h);
  for (const auto& [v, old] : vertex_pool_.old_values)
    if (is_live_vertex(v)) {
      Index h = out(v);
      do {
        touched.push_back(h);
        h = rotate_ccw(h);
      } while (h != out(v) && touched.size() < 1000000);
    }
  sort_unique(touched);
  const auto defects = Inspector(*this, true).look_at(touched);
  if (!defects.empty()) throw std::logic_error("after an operation: " + defects[0]);
}

std::vector<std::string> find_defects(const Mesh& mesh, bool geometry) { return Inspector(mesh, geometry).run(); }

}  // namespace qmorph::kernel
