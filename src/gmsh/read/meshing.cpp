// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/read/meshing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <utility>

#include "gmsh/divide/coarse.hpp"
#include "gmsh/divide/curves.hpp"
#include "gmsh/even/even_links.hpp"
#include "gmsh/read/facing.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/element_types.hpp"
#include "gmsh/session/scratch_file.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

/// Gmsh's number of "simple": the only pairing that a script can switch off for each surface.
constexpr double kSimplePairing = 0;

bool is_discrete(int dim, int tag) { return entity_type(dim, tag).find("Discrete") != std::string::npos; }

/// Surfaces whose elements a script has handed to the parts of a partition: PartitionMesh makes a surface of each.
std::set<int> find_partitioned(const ::gmsh::vectorpair& surfaces) {
  std::set<int> partitioned;
  for (const auto& [dim, tag] : surfaces) {
    int parent_dim = -1, parent = -1;
    ::gmsh::model::getParent(dim, tag, parent_dim, parent);
    if (parent_dim == 2 && has_elements(2, tag)) partitioned.insert(parent);
  }
  return partitioned;
}

/// Whether CreateGeometry has given a discrete surface parameters: where it has not, all nodes get the same from Gmsh.
bool has_parameters(int surface) {
  std::vector<std::size_t> nodes;
  std::vector<double> xyz, with_nodes, uv;
  ::gmsh::model::mesh::getNodes(nodes, xyz, with_nodes, 2, surface, true, false);
  if (nodes.size() < 2) return false;
  xyz.resize(6);  // two of them tell
  run_logged([&] { ::gmsh::model::getParametrization(2, surface, xyz, uv); });
  return uv.size() == 4 && (uv[0] != uv[2] || uv[1] != uv[3]);
}

/// Surfaces with `Recombine Surface`, `Transfinite Surface` and `Reverse Surface`; fields of boundary layers with
/// `Quads`.
struct Flags {
  std::set<int> recombined, transfinite, reversed;
  std::vector<int> quad_fields;
};

/// No call of Gmsh 4.8 tells, but the model written as a script does. It does not have facets.
Flags read_flags() {
  const ScratchFile script(".geo_unrolled");
  const ScopedOption everything("Print.GeoOnlyPhysicals", 0);
  run_logged([&] { ::gmsh::write(script.path()); });
  std::ifstream in(script.path());
  static const std::regex statement(R"(^\s*(Recombine|Transfinite|Reverse) Surface \{([^}]*)\})");
  static const std::regex field(R"(^\s*Field\[(\d+)\]\.Quads = [1-9])");
  static const std::regex number(R"(\d+)");
  Flags flags;
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (std::regex_search(line, match, field)) flags.quad_fields.push_back(std::stoi(match[1]));
    if (!std::regex_search(line, match, statement)) continue;
    std::set<int>& tags = match[1] == "Recombine" ? flags.recombined
                          : match[1] == "Reverse" ? flags.reversed
                                                  : flags.transfinite;
    const std::string list = match[2];
    for (std::sregex_iterator it(list.begin(), list.end(), number), end; it != end; ++it)
      tags.insert(std::stoi(it->str()));
  }
  return flags;
}

/// Lets Gmsh recombine what is structured and pair nothing elsewhere: with the simple algorithm an angle below 0
/// accepts no pair (0 still accepts some, the worst ones).
void forbid_pairing(const std::set<int>& surfaces) {
  const ScratchFile script(".geo");
  {
    std::ofstream out(script.path());
    for (int tag : surfaces) out << "Recombine Surface{" << tag << "} = -1;\n";
    out << "Mesh.RecombinationAlgorithm = " << kSimplePairing << ";\n";
    if (!out.flush()) throw InputError("cannot write to the temporary directory " + script.path());
  }
  ::gmsh::merge(script.path());
}

double area_or_one(int surface) {
  double area = 1;  // where there is no CAD kernel to ask, every surface is expected to have elements
  const StageLog log = run_logged([&] { ::gmsh::model::occ::getMass(2, surface, area); });
  return log.errors.empty() ? area : 1;
}

/// What the log says of a surface.
StageLog complaints_about(int surface, const StageLog& log) {
  const std::regex name(fmt::format("surface {}(?![0-9])", surface));
  StageLog about;
  std::copy_if(log.warnings.begin(), log.warnings.end(), std::back_inserter(about.errors),
               [&](const std::string& line) { return std::regex_search(line, name); });
  return about;
}

/// A surface that cannot be meshed is an error to some versions of Gmsh and a warning to others. The surface that
/// Compound Surface makes hands its elements to those that it is made of, to narrow ones sometimes none.
/// \return what is without elements for that reason
std::vector<std::string> check_every_surface_has_elements(const StageLog& log) {
  bool compound = false;
  std::vector<int> bare;
  ::gmsh::vectorpair surfaces;
  ::gmsh::model::getEntities(surfaces, 2);
  for (const auto& [dim, tag] : surfaces) {
    if (has_elements(2, tag)) continue;
    const bool discrete = is_discrete(2, tag);
    compound = compound || discrete;
    if (!discrete && area_or_one(tag) > 0) bare.push_back(tag);
  }
  if (!bare.empty() && !compound)
    throw InputError(fmt::format("Gmsh cannot mesh it: no element on surface {}: {}", bare.front(),
                                 first_errors(complaints_about(bare.front(), log))));
  if (bare.empty()) return {};
  return {fmt::format("Gmsh gave no element of a compound to surfaces {}", fmt::join(bare, ", "))};
}

/// Where a surface gets a mesh beside one that has one, the curve between them must have its line elements: else it is
/// meshed anew, and the two do not fit.
void check_common_curves(const MeshingTask& task) {
  std::map<int, int> of_kept;
  const auto for_each_curve = [](int surface, const auto& take) {
    ::gmsh::vectorpair curves;
    ::gmsh::model::getBoundary({{2, surface}}, curves, false, false);
    for (const auto& [dim, curve] : curves) take(curve);
  };
  for (int surface : task.kept)
    for_each_curve(surface, [&](int curve) {
      if (!has_elements(1, curve)) of_kept.emplace(curve, surface);
    });
  for (int surface : task.bare)
    for_each_curve(surface, [&](int curve) {
      if (const auto kept = of_kept.find(curve); kept != of_kept.end())
        throw InputError(
            fmt::format("surface {} has a mesh, surface {} beside it has none, and the curve {} between "
                        "them has no line elements; mesh all of the geometry",
                        kept->second, surface, curve));
    });
}

/// With Mesh.MeshOnlyEmpty, facets are meshed once they are gone: the geometry has a copy of them.
void clear_facets(const std::vector<int>& surfaces) {
  ::gmsh::vectorpair entities;
  for (int surface : surfaces) entities.emplace_back(2, surface);
  if (!entities.empty()) ::gmsh::model::mesh::clear(entities);
}

/// Requests for homology are answered after each dimension, and before there are elements with a complaint.
bool is_forgiven(const std::string& error) { return error.find("Cell Complex is empty") == 0; }

/// Curves that Gmsh complains about.
std::set<int> curves_in(const StageLog& log) {
  static const std::regex name(R"(curve (\d+))");
  std::set<int> curves;
  for (const std::string& error : log.errors)
    for (std::sregex_iterator it(error.begin(), error.end(), name), end; it != end; ++it)
      curves.insert(std::stoi((*it)[1]));
  return curves;
}

/// An even number for each curve by itself: what Gmsh does before its own recombination.
void divide_evenly() {
  const ScopedOption all("Mesh.RecombineAll", 1), algorithm("Mesh.RecombinationAlgorithm", kBlossomPairing);
  ::gmsh::model::mesh::generate(1);
}

std::vector<int> surfaces_of(const MeshingTask& task) {
  std::vector<int> surfaces = task.bare;
  surfaces.insert(surfaces.end(), task.facets.begin(), task.facets.end());
  return surfaces;
}

/// Curves, then surfaces. `division` stays empty if something is thrown while curves are divided.
StageLog generate(const Flags& flags, const DivisionTask* curves, std::optional<DivisionReport>& division) {
  division.reset();
  return run_logged([&] {
    const RecombinationOff off;
    // A script that is merged makes Gmsh forget the numbers that it has been told.
    if (!flags.recombined.empty()) forbid_pairing(flags.recombined);
    division = curves ? divide_curves(*curves) : DivisionReport();
    if (!division->understood) divide_evenly();
    ::gmsh::model::mesh::generate(2);
  });
}

bool has_failed(const StageLog& log) { return !std::all_of(log.errors.begin(), log.errors.end(), is_forgiven); }

/// Gmsh's mesher sometimes fails for one number of segments and not for the next: then the curves that it names keep
/// the number that Gmsh gives them. It divides others further as it goes: then that becomes their number. As a last
/// resort, and where curves cannot be divided at all, each is made even by itself.
StageLog generate_by_plan(DivisionTask curves, const Flags& flags, DivisionReport& division) {
  constexpr int kAttempts = 4;
  const auto generate_by = [&](const DivisionTask* by) {
    std::optional<DivisionReport> divided;
    StageLog log = generate(flags, by, divided);
    division = divided.value_or(DivisionReport());
    return std::pair(std::move(log), divided.has_value());
  };
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const auto [log, is_divided] = generate_by(&curves);
    if (!is_divided) break;
    if (!division.understood) return log;  // each curve has been made even by itself already
    run_logged([&] { forget_division(division); });
    if (!has_failed(log)) {
      const std::map<int, int> further = find_divided_further(division);
      const bool enough =
          further.empty() || std::none_of(curves.surfaces.begin(), curves.surfaces.end(), has_odd_boundary);
      if (enough || attempt + 1 == kAttempts) return log;
      for (const auto& [curve, segments] : further) curves.given[curve] = segments;
      continue;
    }
    const std::set<int> named = curves_in(log);
    const std::size_t before = curves.kept_curves.size();
    curves.kept_curves.insert(named.begin(), named.end());
    if (curves.kept_curves.size() == before) break;  // nothing else to try
  }
  return generate_by(nullptr).first;
}

/// Curved surfaces that Gmsh could not mesh, or of which the triangles are no picture.
std::vector<int> find_wanting(const std::vector<int>& surfaces, const StageLog& log) {
  static const std::regex name(R"(surface (\d+))");
  std::vector<int> wanting;
  run_logged([&] { wanting = find_too_coarse(surfaces); });
  for (const std::string& error : log.errors)
    for (std::sregex_iterator it(error.begin(), error.end(), name), end; it != end; ++it)
      if (const int tag = std::stoi((*it)[1]); std::count(surfaces.begin(), surfaces.end(), tag) > 0 && is_curved(tag))
        wanting.push_back(tag);
  return wanting;
}

/// Where Gmsh cannot mesh a curved surface, or its triangles are no picture of that, its curves get more segments than
/// their sizes say.
StageLog generate(const MeshingTask& task, const Flags& flags, const std::vector<int>& keep_curves,
                  DivisionReport& division) {
  if (task.kept_on_geometry || task.compounds) {
    std::optional<DivisionReport> divided;
    StageLog log = generate(flags, nullptr, divided);
    division = divided.value_or(DivisionReport());
    return log;
  }
  constexpr int kRounds = 3;
  DivisionTask curves{surfaces_of(task), {keep_curves.begin(), keep_curves.end()}, flags.transfinite};
  std::vector<int> free = task.bare;
  std::erase_if(free, [&](int surface) { return flags.transfinite.count(surface) > 0; });
  bool was_meshed = false;
  std::map<int, int> before;
  std::set<int> all_wanting;
  for (int round = 1;; ++round) {
    StageLog log = generate_by_plan(curves, flags, division);
    if (has_failed(log) && was_meshed) {
      curves.times.clear();
      return generate_by_plan(curves, flags, division);
    }
    was_meshed = !has_failed(log);
    division.coarse_surfaces.assign(all_wanting.begin(), all_wanting.end());
    const bool is_different = round == 1 || !was_meshed || division.segments != before;
    if (round == kRounds || !is_different || (was_meshed && !division.understood)) return log;
    before = division.segments;
    const std::vector<int> wanting = find_wanting(free, log);
    if (wanting.empty() || !ask_for_more(wanting, curves.times)) return log;
    all_wanting.insert(wanting.begin(), wanting.end());
  }
}

/// Boundary layers of triangles, for as long as this object lives, where the script wants quads.
class LayersOfTriangles {
 public:
  explicit LayersOfTriangles(const std::vector<int>& fields) : fields_(fields) { set_quads(0); }
  ~LayersOfTriangles() {
    try {
      set_quads(1);
    } catch (...) {  // a destructor cannot report it
    }
  }
  LayersOfTriangles(const LayersOfTriangles&) = delete;
  LayersOfTriangles& operator=(const LayersOfTriangles&) = delete;

 private:
  void set_quads(double value) const {
    run_logged([&] {
      for (int field : fields_) ::gmsh::model::mesh::field::setNumber(field, "Quads", value);
    });
  }
  const std::vector<int>& fields_;
};

/// The quads that Gmsh makes in layers stay as they are. Triangles that they enclose, in fans, may be odd, and no node
/// on a curve changes that. Layers of triangles become quads, too, and nothing is left.
StageLog generate_evenly(const MeshingTask& task, const Flags& flags, const std::vector<int>& keep_curves,
                         DivisionReport& division) {
  const auto generate_all = [&] {
    StageLog log = generate(task, flags, keep_curves, division);
    std::erase_if(log.errors, is_forgiven);
    return log;
  };
  const StageLog log = generate_all();
  const std::vector<int> surfaces = surfaces_of(task);
  if (flags.quad_fields.empty() || !task.becomes_layers || task.kept_on_geometry || !log.errors.empty() ||
      !has_enclosed_odd_regions(surfaces))
    return log;
  {
    const LayersOfTriangles layers(flags.quad_fields);
    const StageLog with_triangles = generate_all();
    if (with_triangles.errors.empty() && !has_enclosed_odd_regions(surfaces)) return with_triangles;
  }
  return generate_all();
}

std::set<int> surfaces_at(int point) {
  std::set<int> all;
  std::vector<int> curves, surfaces, lower;
  ::gmsh::model::getAdjacencies(0, point, curves, lower);
  for (int curve : curves) {
    ::gmsh::model::getAdjacencies(1, curve, surfaces, lower);
    all.insert(surfaces.begin(), surfaces.end());
  }
  return all;
}

/// Whether a curve's segments may happen to be edges in a surface that it is not a part of: they stay, and part it.
/// A curve of no surface may, and one whose only segment joins two points of another surface, as a short seam does.
bool has_loose_curve() {
  ::gmsh::vectorpair curves;
  ::gmsh::model::getEntities(curves, 1);
  return std::any_of(curves.begin(), curves.end(), [](const auto& curve) {
    std::vector<int> surfaces, points;
    ::gmsh::model::getAdjacencies(1, curve.second, surfaces, points);
    if (surfaces.empty()) return has_elements(1, curve.second);
    if (points.size() != 2 || count_segments(curve.second) != 1) return false;
    const std::set<int> one = surfaces_at(points[0]), other = surfaces_at(points[1]);
    return std::any_of(one.begin(), one.end(), [&](int surface) {
      return other.count(surface) && std::find(surfaces.begin(), surfaces.end(), surface) == surfaces.end();
    });
  });
}

/// Where curves as they were planned have not made every region even: Gmsh may have divided them further while it
/// meshed the surfaces, and the plan knows only what lies on a surface by its definition.
EvenReport mend_parity(const MeshingTask& task, const DivisionReport& division, const std::vector<int>& keep_curves) {
  const std::vector<int> surfaces = surfaces_of(task);
  const bool as_planned = find_divided_further(division).empty() && !has_loose_curve();
  if (as_planned && std::none_of(surfaces.begin(), surfaces.end(), has_odd_boundary)) return {};
  std::vector<int> keep = keep_curves;
  keep.insert(keep.end(), division.fixed.begin(), division.fixed.end());
  return session::make_even(surfaces, keep);
}

}  // namespace

MeshingTask find_meshing_task(bool taken_as_it_is) {
  MeshingTask task;
  ::gmsh::vectorpair surfaces;
  ::gmsh::model::getEntities(surfaces, 2);
  const std::set<int> partitioned = find_partitioned(surfaces);
  for (const auto& [dim, tag] : surfaces) {
    const bool meshed = has_elements(2, tag), discrete = is_discrete(2, tag);
    if (discrete && meshed && !taken_as_it_is && has_parameters(tag))
      task.facets.push_back(tag);
    else if (meshed)
      task.kept.push_back(tag), task.kept_on_geometry |= !discrete;
    else if (!discrete && partitioned.count(tag) == 0)
      task.bare.push_back(tag);
  }
  return task;
}

MeshedModel mesh_surfaces(const MeshingTask& task, const std::vector<int>& keep_curves) {
  check_common_curves(task);
  const ScopedOption linear("Mesh.ElementOrder", 1);  // raised when the quads are there
  const ScopedOption only_empty("Mesh.MeshOnlyEmpty", task.kept_on_geometry ? 1 : get_option("Mesh.MeshOnlyEmpty"));
  if (task.kept_on_geometry) clear_facets(task.facets);
  Flags flags = read_flags();
  if (get_option("Mesh.RecombineAll") != 0 || get_option("Mesh.SubdivisionAlgorithm") == 1)
    flags.recombined.insert(task.bare.begin(), task.bare.end());
  for (int tag : task.kept) flags.recombined.erase(tag);
  flags.recombined.insert(task.facets.begin(), task.facets.end());
#if !QMORPH_GMSH_AT_LEAST(4, 9)
  // Frontal-Delaunay for quads crashes in a Gmsh without the ANN library, like Debian's, unless it needs no neighbours.
  if (get_option("Mesh.Algorithm") == 8) set_option("Mesh.CrossFieldClosestPoint", 0);
#endif
  MeshedModel meshed;
  const StageLog log = generate_evenly(task, flags, keep_curves, meshed.division);
  if (!log.errors.empty()) throw InputError("Gmsh cannot mesh it: " + first_errors(log));
  meshed.warnings = log.warnings;
  const std::vector<std::string> bare = check_every_surface_has_elements(log);
  meshed.warnings.insert(meshed.warnings.end(), bare.begin(), bare.end());
  if (!task.compounds) face_as_geometry(task.bare, flags.reversed);
  meshed.even = mend_parity(task, meshed.division, keep_curves);
  return meshed;
}

/// METIS fills the terminal where there are not enough.
void partition(int count) {
  std::size_t elements = 0;  // of the highest dimension that has some: those are handed out
  for (int dim = 3; dim > 0 && elements == 0; --dim) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    ::gmsh::model::mesh::getElements(types, tags, nodes, dim);
    for (const auto& block : tags) elements += block.size();
  }
  if (elements < static_cast<std::size_t>(count))
    throw InputError(fmt::format("-part {}: the mesh has only {} elements", count, elements));
  const StageLog log = run_logged([&] { ::gmsh::model::mesh::partition(count); });
  if (!log.errors.empty()) throw InputError("Gmsh cannot partition the mesh: " + first_errors(log));
}

}  // namespace qmorph::adapter
