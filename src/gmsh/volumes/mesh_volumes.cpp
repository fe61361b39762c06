// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "geometry/describe.hpp"
#include "gmsh/model/model_mesh.hpp"
#include "gmsh/model/put_back.hpp"
#include "gmsh/read/groups.hpp"
#include "gmsh/read/meshing.hpp"
#include "gmsh/read/raise.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/element_types.hpp"
#include "gmsh/session/session.hpp"
#include "gmsh/volumes/solid.hpp"
#include "gmsh/volumes/untangle.hpp"
#include "gmsh/volumes/volumes.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

/// Gmsh's numbers for ways to mesh volumes. With one that stands for none, only what is structured is meshed.
constexpr double kDelaunay = 1, kHxt = 10, kNone3D = 5;

bool has_quads(int surface) {
  std::vector<int> types;
  ::gmsh::model::mesh::getElementTypes(types, 2, surface);
  return std::any_of(types.begin(), types.end(), [](int type) { return element_type(type).corners == 4; });
}

std::vector<int> all_volumes() {
  ::gmsh::vectorpair entities;
  ::gmsh::model::getEntities(entities, 3);
  std::vector<int> volumes;
  for (const auto& [dim, tag] : entities) volumes.push_back(tag);
  return volumes;
}

std::vector<int> surfaces_of(int volume) {
  ::gmsh::vectorpair sides;
  ::gmsh::model::getBoundary({{3, volume}}, sides, false, false);
  std::vector<int> surfaces;
  for (const auto& side : sides) surfaces.push_back(side.second);
  return surfaces;
}

/// A volume of a file without geometry is not meshed by Gmsh; one of its built-in kernel inside the same surfaces is.
void make_meshable(int volume) {
  const std::vector<int> surfaces = surfaces_of(volume);
  if (surfaces.empty())
    throw InputError(fmt::format("the file does not say what surfaces volume {} has; with MSH 4.1 it would", volume));
  for (int surface : surfaces)  // Gmsh crashes there
    if (!has_elements(2, surface))
      throw InputError(fmt::format("volume {} cannot be meshed: its surface {} has no elements", volume, surface));
  std::vector<int> groups;
  ::gmsh::model::getPhysicalGroupsForEntity(3, volume, groups);
  const StageLog log = run_logged([&] {
    ::gmsh::model::removeEntities({{3, volume}});
    ::gmsh::model::geo::remove({{3, volume}});
    ::gmsh::model::geo::addVolume({::gmsh::model::geo::addSurfaceLoop(surfaces)}, volume);
    ::gmsh::model::geo::synchronize();
  });
  if (!log.errors.empty()) throw InputError(fmt::format("Gmsh cannot mesh volume {}: {}", volume, first_errors(log)));
  for (int group : groups) add_to_group(3, group, {volume});
}

/// Gmsh's words, and what to do about it where that is known.
[[noreturn]] void refuse(const StageLog& log) {
  const auto said = [&](const char* words) {
    return std::any_of(log.errors.begin(), log.errors.end(),
                       [&](const std::string& error) { return error.find(words) != std::string::npos; });
  };
  std::string what_to_do;
  if (said("without Recombine"))
    what_to_do = "; a volume that is extruded in Layers needs Recombine in its Extrude, for hexahedra";
  else if (said("find extruded vertex"))
    what_to_do = "; the mesh at the one end of an extruded volume is not the image of that at the other";
  else if (said("non-manifold quad"))
    what_to_do = "; it puts no pyramids on both sides of a surface inside a volume: leave that one out with --surfaces";
  // Elements of several volumes may be in each of them, and would be freed twice.
  throw BrokenModel("Gmsh cannot mesh the volumes on these quads: " + first_errors(log) + what_to_do);
}

void generate(const std::vector<std::string>& forgiven, std::vector<std::string>& warnings) {
  StageLog log = run_logged([] { ::gmsh::model::mesh::generate(3); });
  std::erase_if(log.errors, [&](const std::string& error) {
    return std::any_of(forgiven.begin(), forgiven.end(), [&](const auto& begin) { return error.find(begin) == 0; });
  });
  if (!log.errors.empty()) refuse(log);
  warnings.insert(warnings.end(), log.warnings.begin(), log.warnings.end());
}

/// Surfaces with quads that two of these volumes share.
bool share_quads(const std::vector<int>& volumes) {
  std::map<int, int> users;
  for (int volume : volumes)
    for (int surface : surfaces_of(volume)) ++users[surface];
  return std::any_of(users.begin(), users.end(),
                     [](const auto& user) { return user.second > 1 && has_quads(user.first); });
}

/// Gmsh makes one pyramid on each quad for all volumes that have it, and fails for the second one. It leaves out those
/// that are transfinite, which it does not look at again as long as they are hidden.
void mesh_one_by_one(const std::vector<int>& volumes, std::vector<std::string>& warnings) {
  const ScopedOption only_visible("Mesh.MeshOnlyVisible", 1);
  std::map<int, int> visibility;
  for (int volume : all_volumes()) ::gmsh::model::getVisibility(3, volume, visibility[volume]);
  for (int volume : volumes) {
    for (const auto& [other, was] : visibility) ::gmsh::model::setVisibility({{3, other}}, other == volume);
    for (int other : volumes)
      if (other != volume) ::gmsh::model::mesh::setTransfiniteVolume(other);
    generate({}, warnings);
    for (int other : volumes) ::gmsh::model::mesh::removeConstraints({{3, other}});
  }
  for (const auto& [volume, was] : visibility) ::gmsh::model::setVisibility({{3, volume}}, was);
}

void generate_all(const std::vector<int>& volumes, std::vector<std::string>& warnings) {
  if (!share_quads(volumes)) return generate({}, warnings);
  std::vector<int> unstructured = volumes;
  {
    const ScopedOption structured("Mesh.Algorithm3D", kNone3D);
    generate({"No elements in volume"}, warnings);
  }
  std::erase_if(unstructured, [](int volume) { return has_elements(3, volume); });
  if (unstructured.empty()) return;
  if (share_quads(unstructured))
    mesh_one_by_one(unstructured, warnings);
  else
    generate({}, warnings);
}

/// What is wrong with volumes, in words, and with how many elements and faces.
struct Faults {
  std::vector<std::string> told;
  std::size_t count = 0;
};

std::optional<std::string> describe_faults(int volume, const Solid& solid, const std::vector<std::size_t>& turned) {
  std::vector<std::string> faults;
  if (!turned.empty())
    faults.push_back(fmt::format("{} of its {} elements {} turned over, as at {}", turned.size(), solid.cells.size(),
                                 turned.size() == 1 ? "is" : "are",
                                 describe(solid.points[solid.cells[turned[0]].nodes[0]])));
  if (solid.loose_faces)
    faults.push_back(
        fmt::format("{} faces of its elements do not fit, as at {}", solid.loose_faces, describe(solid.loose_at)));
  if (faults.empty()) return std::nullopt;
  return fmt::format("volume {}: Gmsh has not meshed it well: {}; smaller elements there may help", volume,
                     fmt::join(faults, ", "));
}

/// Mends volumes as far as that is possible, and says what is left.
Faults mend(const std::vector<int>& volumes) {
  const ModelMesh mesh = read_model_mesh();
  Faults faults;
  std::deque<EntityMesh> mended;
  std::vector<Replacement> replacements;
  for (int tag : volumes) {
    const EntityMesh& volume = *find_entity(mesh, 3, tag);
    Solid solid = read_solid(mesh, volume);
    std::vector<std::size_t> turned = find_turned(solid);
    if (!turned.empty()) {
      turned = untangle(solid, std::move(turned));
      mended.push_back(with_solid(mesh, volume, solid));
      replacements.push_back({std::uint32_t(&volume - mesh.entities.data()), &mended.back()});
    }
    faults.count += turned.size() + solid.loose_faces;
    if (std::optional<std::string> fault = describe_faults(tag, solid, turned))
      faults.told.push_back(std::move(*fault));
  }
  if (!replacements.empty()) put_back(mesh, replacements);
  return faults;
}

/// By how much Gmsh moves nodes before it begins, in sizes of the model: the first one as it is set. Whether elements
/// of thin corners fit in the end is chance.
std::vector<double> perturbations() { return {get_option("Mesh.RandomFactor3D"), 1e-9, 1e-7}; }

/// Meshes the volumes, and once more as long as something does not fit; in the end as it was best.
Faults generate_well(const std::vector<int>& volumes, std::vector<std::string>& warnings) {
  const auto generate_with = [&](double perturbation) {
    const ScopedOption moved("Mesh.RandomFactor3D", perturbation);
    warnings.clear();
    generate_all(volumes, warnings);
    for (int volume : volumes)
      if (!has_elements(3, volume)) throw InputError(fmt::format("Gmsh made no element in volume {}", volume));
    return order_of_surfaces() <= 1 ? mend(volumes) : Faults{};
  };
  Faults now;
  double best = 0;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (double perturbation : perturbations()) {
    now = generate_with(perturbation);
    if (now.count < least) least = now.count, best = perturbation;
    if (now.count == 0) break;
  }
  return now.count == least ? now : generate_with(best);
}

}  // namespace

MeshedVolumes mesh_volumes(bool keep_numbers) {
  MeshedVolumes meshed;
  const std::vector<int> volumes = all_volumes();
  if (volumes.empty()) {
    meshed.told.push_back("-3: there is no volume to mesh");
    return meshed;
  }
  for (int volume : volumes)
    if (entity_type(3, volume).rfind("Discrete", 0) == 0 && !has_elements(3, volume)) make_meshable(volume);
  const RecombinationOff off;
  const ScopedOption linear("Mesh.ElementOrder", 1);
  const ScopedOption renumber("Mesh.Renumber", keep_numbers ? 0 : 1);
  std::optional<ScopedOption> delaunay;
  if (get_option("Mesh.Algorithm3D") == kHxt) {
    delaunay.emplace("Mesh.Algorithm3D", kDelaunay);
    meshed.told.push_back("Mesh.Algorithm3D 10 (HXT) makes no volume on quads; 1 (Delaunay) does it instead");
  }
  meshed.bad = generate_well(volumes, meshed.warnings).told;
  return meshed;
}

}  // namespace qmorph::adapter
