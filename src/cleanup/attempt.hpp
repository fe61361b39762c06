// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// One change of connectivity, judged by what the mesh is worth after a guarded relaxation.

#include <functional>
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

/// When a relaxation of so many faces or more is ended before a pass, because it would be for nothing.
struct GivingUp {
  std::size_t least_faces;
  bool (*is_hopeless)(const Worth& before, const Worth& now, int pass);  ///< passes done
};

/// Nodes of the faces that a candidate starts from.
std::vector<Index> nodes_near(const kernel::Mesh& mesh, const Candidate& candidate);

/// Carries out `edit(nodes)`, which changes the topology and appends the nodes around, removes the doublets that
/// result, relaxes `rings` rings around, and keeps all that if `accept(worth before, after)`. Otherwise the mesh is
/// as it was. `near` are the nodes by which the state before is judged; `nodes` gets those around after. What is worth
/// more than something that `accept` takes, it takes as well: so where not even best_worth_around() is accepted,
/// nothing is relaxed. Without `giving_up` each relaxation is done to its end.
template <class Edit, class Accept>
bool attempt(kernel::Mesh& mesh, const SmoothingOptions& relaxing, int rings, const std::vector<Index>& near,
             std::vector<Index>& nodes, const Edit& edit, const Accept& accept, const GivingUp* giving_up = nullptr);

}  // namespace qmorph::cleanup

#include "smoothing/smooth.hpp"
#include "topology/edits.hpp"

namespace qmorph::cleanup {

template <class Edit, class Accept>
bool attempt(kernel::Mesh& mesh, const SmoothingOptions& relaxing, int rings, const std::vector<Index>& near,
             std::vector<Index>& nodes, const Edit& edit, const Accept& accept, const GivingUp* giving_up) {
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
    if (giving_up && faces.size() >= giving_up->least_faces)
      goes_on = [&](int pass) {
        mesh.add_work(faces.size());
        return !giving_up->is_hopeless(before, worth_of(mesh, faces), pass);
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
