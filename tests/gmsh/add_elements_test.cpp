// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/model/add_elements.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <sstream>

#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/support.hpp"

using namespace qmorph;
using namespace qmorph::adapter;
using namespace qmorph::test;

namespace {

using Add = std::function<void(const std::vector<const EntityMesh*>&)>;

/// Takes all surfaces and volumes out of the current model's mesh and puts them back.
void take_out_and_put_back(const Add& add) {
  const ModelMesh mesh = read_model_mesh();
  std::vector<const EntityMesh*> entities;
  gmsh::vectorpair cleared;
  for (const EntityMesh& entity : mesh.entities)
    if (entity.dim >= 2) {
      entities.push_back(&entity);
      cleared.insert(cleared.begin(), {entity.dim, entity.tag});
    }
  ::gmsh::model::mesh::clear(cleared);
  for (const EntityMesh* e : entities)
    if (!e->node_tags.empty()) ::gmsh::model::mesh::addNodes(e->dim, e->tag, e->node_tags, e->xyz, e->uv);
  add(entities);
}

/// Gmsh writes the nodes of a periodic link in the order of their addresses in memory.
std::string with_sorted_links(const std::string& file) {
  std::istringstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line + '\n');
  std::sort(std::find(lines.begin(), lines.end(), "$Periodic\n"), lines.end());
  return std::accumulate(lines.begin(), lines.end(), std::string());
}

/// The model's file after that, and the nodes that Gmsh says each element has.
std::string outcome(const std::function<void()>& build, const Add& add) {
  const TemporaryDirectory directory;
  const Session session;
  const QuietErrors quiet;
  std::string text;
  const StageLog log = run_logged([&] {
    build();
    take_out_and_put_back(add);
    for (const EntityMesh& entity : read_model_mesh().entities)
      for (const ElementBlock& block : entity.blocks)
        for (const std::size_t element : block.tags) {
          int type = 0;
          std::vector<std::size_t> nodes;
#if QMORPH_GMSH_AT_LEAST(4, 9)
          int dim = 0, tag = 0;
          ::gmsh::model::mesh::getElement(element, type, nodes, dim, tag);
#else
          ::gmsh::model::mesh::getElement(element, type, nodes);
#endif
          text += std::to_string(element) + ':';
          for (const std::size_t node : nodes) text += ' ' + std::to_string(node);
          text += '\n';
        }
    set_option("Mesh.SaveAll", 1);
    set_option("Mesh.SaveParametric", 1);
    ::gmsh::write(directory / "a.msh");
    set_option("Mesh.SaveAll", 0);  // what groups say
    ::gmsh::write(directory / "b.msh");
  });
  CHECK(first_errors(log) == "no reason given");
  for (const char* name : {"a.msh", "b.msh"}) text += with_sorted_links(read_file(directory / name));
  return text;
}

void build_box(bool recombined, bool volume, int order) {
  ::gmsh::model::add("box");
  ::gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
  ::gmsh::model::occ::synchronize();
  ::gmsh::model::addPhysicalGroup(2, {1, 3}, 7);
  ::gmsh::model::setPhysicalName(2, 7, "walls");
  ::gmsh::model::addPhysicalGroup(3, {1}, 8);
  set_option("Mesh.MeshSizeMax", 0.4);
  if (recombined) ::gmsh::model::mesh::setRecombine(2, 3);
  ::gmsh::model::mesh::generate(volume ? 3 : 2);
  if (order > 1) ::gmsh::model::mesh::setOrder(order);
}

void build_periodic_box() {
  build_box(false, false, 1);
  ::gmsh::model::mesh::clear();
  ::gmsh::model::mesh::setPeriodic(2, {2}, {1}, {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  ::gmsh::model::mesh::generate(2);
}

}  // namespace

TEST_CASE("elements come into a model the same way by a file as by a call for each entity") {
  const std::vector<std::pair<std::string, std::function<void()>>> models = {
      {"two squares", build_two_squares},
      {"triangles and quads", [] { build_box(true, false, 1); }},
      {"tetrahedra", [] { build_box(false, true, 1); }},
      {"order 2", [] { build_box(true, false, 2); }},
      {"tetrahedra of order 3", [] { build_box(false, true, 3); }},
      {"periodic", build_periodic_box},
      {"partitions",
       [] {
         build_box(true, false, 1);
         ::gmsh::model::mesh::partition(3);
       }},
      {"sparse numbers",
       [] {
         build_box(true, false, 1);
         std::vector<double> xyz{0.5, 0.5, 0.5};
         ::gmsh::model::mesh::addNodes(3, 1, {2000000000}, xyz);
       }},
      {"options that change what is read",
       [] {
         build_box(true, false, 1);
         for (const char* name : {"Mesh.SwitchElementTags", "Geometry.MatchGeomAndMesh", "Mesh.IgnorePeriodicity"})
           set_option(name, 1);
       }},
  };
  for (const auto& [name, build] : models) {
    CAPTURE(name);
    const std::string by_calls = outcome(build, add_elements_by_calls), by_file = outcome(build, add_elements_by_file);
    CHECK(by_calls.size() > 1000);
    CHECK(by_calls == by_file);
  }
}
