// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A mesh with the advancing front on it, as the driver sets it up, for tests of single steps.

#include "front/step.hpp"
#include "kernel/fixture.hpp"

namespace qmorph::test {

inline constexpr double kPi = std::numbers::pi;

/// Every front edge has level 0, every loop is coloured as a system of its own, and the size at a node is the mean
/// length of its edges, unless `size` is set.
struct Scene {
  explicit Scene(Mesh start, FrontOptions front_options = {})
      : mesh(std::move(start)), options(front_options), front(mesh, options), colours(mesh, front), step{mesh,
                                                                                                         front,
                                                                                                         colours,
                                                                                                         options,
                                                                                                         {},
                                                                                                         {}} {
    for (Index v = 0; v < mesh.vertex_slots(); ++v)
      if (mesh.is_live_vertex(v)) step.size.set(v, mean_edge(v));
    for (Index h = 0; h < mesh.half_edge_slots(); ++h)
      if (mesh.is_live_half_edge(h) && front.contains(h) && !colours.is_coloured(mesh.origin(h)))
        colours.colour_loop(h);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Runs a step as the driver does: in a transaction that is undone if the step fails.
  template <class Operation>
  bool attempt(const Operation& operation) {
    mesh.begin(), front.levels().begin(), colours.labels().begin(), step.size.begin();
    step.moved.clear();
    const bool done = bool(operation());
    if (done)
      mesh.commit(), front.levels().commit(), colours.labels().commit(), step.size.commit();
    else
      mesh.rollback(), front.levels().rollback(), colours.labels().rollback(), step.size.rollback();
    return done;
  }

  /// A step that must fail, and leave every bit as it was.
  template <class Operation>
  bool refuses(const Operation& operation) {
    const Snapshot before = snapshot(mesh);
    return !attempt(operation) && snapshot(mesh) == before;
  }

  Index at(Index a, Index b) const { return edge(mesh, a, b); }

  /// Half-edges of a front loop from h on.
  std::vector<Index> loop(Index h) const {
    std::vector<Index> edges;
    Index e = h;
    do {
      edges.push_back(e);
      e = front.next(e);
    } while (e != h && edges.size() < 10000);
    return edges;
  }
  std::vector<Index> loop_nodes(Index h) const {
    std::vector<Index> nodes;
    for (Index e : loop(h)) nodes.push_back(mesh.origin(e));
    return nodes;
  }

  double mean_edge(Index v) const {
    double sum = 0;
    int edges = 0;
    Index h = mesh.out(v);
    do {
      sum += mesh.length(h), ++edges;
      h = mesh.rotate_ccw(h);
    } while (h != mesh.out(v));
    return sum / edges;
  }

  Mesh mesh;
  FrontOptions options;
  front::Front front;
  front::LoopColours colours;
  front::Step step;
};

/// A closed ring of triangles between an outer and an inner polygon of `sides` nodes each: outer nodes 0 to
/// sides - 1, inner ones after them; the hole is inside.
inline Mesh annulus(Index sides, double inner_radius = 0.5) {
  std::vector<Vec2> points;
  for (const double radius : {1.0, inner_radius})
    for (Index i = 0; i < sides; ++i) points.push_back(rotated(Vec2(radius, 0), 2 * kPi * i / sides));
  std::vector<std::array<Index, 3>> triangles;
  for (Index i = 0; i < sides; ++i) {
    const Index j = (i + 1) % sides;
    triangles.insert(triangles.end(), {{i, j, sides + j}, {i, sides + j, sides + i}});
  }
  return Mesh(points, triangles);
}

}  // namespace qmorph::test
