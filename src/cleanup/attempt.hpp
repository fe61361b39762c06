// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One change of connectivity, judged by what the mesh is worth after a guarded relaxation.

#include <functional>
#include <type_traits>
#include <vector>

#include "cleanup/operations.hpp"
#include "qmorph/options.hpp"

namespace qmorph::cleanup {

/// Shapes of the faces around some nodes, by their scaled Jacobians.
struct Worth {
  double worst = 1, mean = 1;
  std::size_t faces = 0;
};
Worth worth_around(const kernel::Mesh& mesh, const std::vector<Index>& nodes);
Worth worth_of(const kernel::Mesh& mesh, const std::vector<Index>& faces);
/// No relaxation makes them better than that: what shares the angle of a node of the boundary has a corner that is no
/// nearer to right than an even share.
Worth best_worth_around(const kernel::Mesh& mesh, const std::vector<Index>& nodes);

/// The faces by their scaled Jacobians, the smallest first.
std::vector<Index> worst_first(const kernel::Mesh& mesh, std::vector<Index> faces);

struct AlwaysHope {};

/// Nodes of the faces that a candidate starts from.
std::vector<Index> nodes_near(const kernel::Mesh& mesh, const Candidate& candidate);

/// Carries out `edit(nodes)`, which changes the topology and appends the nodes around, removes the doublets that
/// result, relaxes `rings` rings around, and keeps all that if `accept(worth before, after)`. Otherwise the mesh is
/// as it was. `near` are the nodes by which the state before is judged; `nodes` gets those around after. What is worth
/// more than something that `accept` takes, it takes as well: so where not even best_worth_around() is accepted,
/// nothing is relaxed. `is_hopeless(worth before, worth now, pass)` may end it before each pass of the relaxation.
template <class Edit, class Accept, class Hopeless = AlwaysHope>
bool attempt(kernel::Mesh& mesh, const SmoothingOptions& relaxing, int rings, const std::vector<Index>& near,
             std::vector<Index>& nodes, const Edit& edit, const Accept& accept, const Hopeless& is_hopeless = {});

}  // namespace qmorph::cleanup

#include "smoothing/smooth.hpp"
#include "topology/edits.hpp"

namespace qmorph::cleanup {

template <class Edit, class Accept, class Hopeless>
bool attempt(kernel::Mesh& mesh, const SmoothingOptions& relaxing, int rings, const std::vector<Index>& near,
             std::vector<Index>& nodes, const Edit& edit, const Accept& accept, const Hopeless& is_hopeless) {
  const Worth before = worth_around(mesh, near);
  nodes.clear();
  mesh.add_work(before.faces);
  mesh.begin();
  bool kept = edit(nodes);
  std::vector<Index> faces;
  if (kept) {
    topology::remove_doublets(mesh, nodes);
    faces = topology::faces_around(mesh, nodes);
    std::function<bool(int)> goes_on;
    if constexpr (!std::is_same_v<Hopeless, AlwaysHope>)
      goes_on = [&](int pass) {
        mesh.add_work(faces.size());
        return !is_hopeless(before, worth_of(mesh, faces), pass);
      };
    kept =
        accept(before, best_worth_around(mesh, nodes)) && smoothing::smooth_near(mesh, relaxing, nodes, rings, goes_on);
  }
  if (kept) {
    const Worth after = worth_of(mesh, faces);
    mesh.add_work(after.faces);
    kept = accept(before, after);
  }
  kept ? mesh.commit() : mesh.rollback();
  return kept;
}

}  // namespace qmorph::cleanup
