// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/support.hpp"

#include <doctest/doctest.h>

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <tuple>

#include "cli/run.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"

namespace qmorph::test {
namespace {

namespace fs = std::filesystem;
using adapter::EntityMesh;
using adapter::ModelMesh;

std::string name_of(const EntityMesh& entity) {
  return "entity (" + std::to_string(entity.dim) + ", " + std::to_string(entity.tag) + ")";
}

/// A node by what it is told from others by.
using Key = std::array<double, 4>;

Key key(const ModelMesh& mesh, std::size_t tag, Compare compare) {
  const Eigen::Vector3d& p = mesh.points[mesh.rows.find(tag)];
  return {compare == Compare::tags ? static_cast<double>(tag) : 0.0, p.x(), p.y(), p.z()};
}

std::vector<Key> node_keys(const ModelMesh& mesh, const EntityMesh& entity, Compare compare) {
  std::vector<Key> keys;
  for (std::size_t tag : entity.node_tags) keys.push_back(key(mesh, tag, compare));
  return keys;
}

/// Elements with their corners in order; with tags if those are to be compared.
std::vector<std::pair<std::size_t, std::vector<Key>>> element_keys(const ModelMesh& mesh, const EntityMesh& entity,
                                                                   Compare compare) {
  std::vector<std::pair<std::size_t, std::vector<Key>>> elements;
  for (const adapter::ElementBlock& block : entity.blocks)
    for (std::size_t e = 0; e < block.tags.size(); ++e) {
      std::vector<Key> keys;
      for (std::size_t k = 0; k < block.nodes_per_element; ++k)
        keys.push_back(key(mesh, block.nodes[e * block.nodes_per_element + k], compare));
      elements.emplace_back(compare == Compare::tags ? block.tags[e] : 0, keys);
    }
  return elements;
}

/// Sides of one element only, as sets of the two corners and what lies between them.
std::set<std::set<Key>> boundary(const ModelMesh& mesh, const EntityMesh& entity, Compare compare) {
  std::map<std::set<Key>, int> count;
  for (const adapter::ElementBlock& block : entity.blocks)
    for (std::size_t e = 0; e < block.tags.size(); ++e)
      for (std::size_t k = 0; k < block.corners; ++k) {
        const std::size_t* nodes = block.nodes.data() + e * block.nodes_per_element;
        std::set<Key> side = {key(mesh, nodes[k], compare), key(mesh, nodes[(k + 1) % block.corners], compare)};
        const std::size_t inner = static_cast<std::size_t>(block.order) - 1, first = block.corners + k * inner;
        for (std::size_t i = first; i < first + inner; ++i) side.insert(key(mesh, nodes[i], compare));
        ++count[side];
      }
  std::set<std::set<Key>> edges;
  for (const auto& [edge, uses] : count)
    if (uses == 1) edges.insert(edge);
  return edges;
}

}  // namespace

TemporaryDirectory::TemporaryDirectory() {
  std::string pattern = (fs::temp_directory_path() / "qmorph-test-XXXXXX").string();
  path_ = ::mkdtemp(pattern.data());
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<std::string> TemporaryDirectory::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

RunningGmsh::RunningGmsh() {
  ::gmsh::initialize(0, nullptr, false);
  ::gmsh::option::setNumber("General.Terminal", 0);
}

RunningGmsh::~RunningGmsh() { ::gmsh::finalize(); }

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_file(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

Result run_qmorph(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  Result result;
  result.status = cli::run(arguments, out, err);
  result.out = out.str();
  result.err = err.str();
  return result;
}

Snapshot read_snapshot(const std::string& path) {
  const adapter::Session session;
  adapter::set_option("Mesh.IgnorePeriodicity", 0);
  adapter::run_logged([&] { ::gmsh::open(path); });
  Snapshot snapshot;
  snapshot.mesh = adapter::read_model_mesh();
  ::gmsh::vectorpair groups;
  ::gmsh::model::getPhysicalGroups(groups);
  for (const auto& [dim, tag] : groups) {
    Snapshot::Group& group = snapshot.groups[{dim, tag}];
    ::gmsh::model::getPhysicalName(dim, tag, group.first);
    ::gmsh::model::getEntitiesForPhysicalGroup(dim, tag, group.second);
    std::sort(group.second.begin(), group.second.end());
  }
  for (int dim : {0, 1})
    for (const adapter::PeriodicLink& link : adapter::read_periodic_links(snapshot.mesh, dim))
      snapshot.links.push_back(link);
  return snapshot;
}

std::string difference(const Snapshot& before, const Snapshot& after, const std::set<int>& converted, Compare compare) {
  if (before.groups != after.groups) return "physical groups";
  if (before.mesh.entities.size() != after.mesh.entities.size()) return "number of entities";
  for (std::size_t e = 0; e < before.mesh.entities.size(); ++e) {
    const EntityMesh& a = before.mesh.entities[e];
    const EntityMesh& b = after.mesh.entities[e];
    if (a.dim != b.dim || a.tag != b.tag) return "tag of " + name_of(a);
    if (a.dim == 2 && converted.count(a.tag)) {
      if (boundary(before.mesh, a, compare) != boundary(after.mesh, b, compare)) return "boundary of " + name_of(a);
      continue;
    }
    if (node_keys(before.mesh, a, compare) != node_keys(after.mesh, b, compare)) return "nodes of " + name_of(a);
    if (element_keys(before.mesh, a, compare) != element_keys(after.mesh, b, compare))
      return "elements of " + name_of(a);
  }
  const auto same_link = [](const adapter::PeriodicLink& a, const adapter::PeriodicLink& b) {
    return std::tie(a.dim, a.slave, a.master, a.nodes) == std::tie(b.dim, b.slave, b.master, b.nodes);
  };
  if (before.links.size() != after.links.size()) return "number of periodic links";
  if (compare == Compare::tags && !std::equal(before.links.begin(), before.links.end(), after.links.begin(), same_link))
    return "periodic links";
  return {};
}

void check_formats(const std::string& input, const std::vector<std::string>& formats, const std::set<int>& converted) {
  const TemporaryDirectory directory;
  const std::string output = directory / "out.msh";
  const Snapshot before = read_snapshot(input);
  for (const std::string& format : formats)
    for (const bool binary : {false, true}) {
      // Gmsh 4.8 writes empty files of MSH 4.0 in binary, and MSH 1 knows no binary.
      if (binary && (format == "msh40" || format == "msh1")) continue;
      CAPTURE(format);
      CAPTURE(binary);
      std::vector<std::string> words = {input, "-format", format, "-o", output};
      if (binary) words.push_back("-bin");
      const Result result = run_qmorph(words);
      CAPTURE(result.err);
      CHECK(result.status == 0);
      CHECK(difference(before, read_snapshot(output), converted, Compare::coordinates) == "");
    }
}

std::pair<std::size_t, std::size_t> element_counts(const Snapshot& snapshot, int surface) {
  std::pair<std::size_t, std::size_t> counts;
  for (const EntityMesh& entity : snapshot.mesh.entities) {
    if (entity.dim != 2 || entity.tag != surface) continue;
    if (const auto* block = entity.block(adapter::kTriangle3)) counts.first = block->tags.size();
    if (const auto* block = entity.block(adapter::kQuad4)) counts.second = block->tags.size();
  }
  return counts;
}

void make_msh(const std::string& path, double version, bool binary, const std::function<void()>& build) {
  const adapter::Session session;
  build();
  adapter::set_option("Mesh.MshFileVersion", version);
  adapter::set_option("Mesh.Binary", binary);
  adapter::set_option("Mesh.SaveAll", version >= 4);
  ::gmsh::write(path);
}

void build_two_squares() {
  namespace geo = ::gmsh::model::geo;
  constexpr double kSize = 0.2;
  const double corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {2, 1}};
  const int lines[7][2] = {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {2, 5}, {5, 6}, {6, 3}};
  for (int i = 0; i < 6; ++i) geo::addPoint(corners[i][0], corners[i][1], 0, kSize, i + 1);
  for (int i = 0; i < 7; ++i) geo::addLine(lines[i][0], lines[i][1], i + 1);
  geo::addPoint(0.3, 0.3, 0, kSize, 18);
  geo::addPoint(0.3, 0.7, 0, kSize, 19);
  geo::addPoint(0.7, 0.5, 0, kSize, 20);
  geo::addLine(18, 19, 10);
  geo::addCurveLoop({1, 2, 3, 4}, 1);
  geo::addCurveLoop({5, 6, 7, -2}, 2);
  geo::addPlaneSurface({1}, 1);
  geo::addPlaneSurface({2}, 2);
  geo::synchronize();
  ::gmsh::model::mesh::embed(1, {10}, 2, 1);
  ::gmsh::model::mesh::embed(0, {20}, 2, 1);
  const auto group = [](int dim, std::vector<int> entities, int tag, const std::string& name) {
    ::gmsh::model::addPhysicalGroup(dim, entities, tag);
    ::gmsh::model::setPhysicalName(dim, tag, name);
  };
  group(2, {1}, 5, "left");
  group(1, {4}, 6, "inlet");
  group(1, {10}, 7, "crack");
  group(0, {20}, 8, "probe");
  ::gmsh::model::mesh::generate(2);
}

std::vector<std::array<double, 3>> Grid::nodes() const {
  std::vector<std::array<double, 3>> result;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) result.push_back({x + double(i) / n, double(j) / n, z});
  return result;
}

std::vector<std::array<int, 3>> Grid::triangles() const {
  std::vector<std::array<int, 3>> result;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      result.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      result.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  return result;
}

std::vector<std::array<int, 2>> Grid::outline() const {
  std::vector<std::array<int, 2>> result;
  for (int i = 0; i < n; ++i) {
    result.push_back({node(i, 0), node(i + 1, 0)});
    result.push_back({node(n, i), node(n, i + 1)});
    result.push_back({node(i + 1, n), node(i, n)});
    result.push_back({node(0, i + 1), node(0, i)});
  }
  return result;
}

std::string msh22(const std::vector<std::array<double, 3>>& nodes, const std::vector<std::string>& elements,
                  const std::string& groups) {
  std::ostringstream text;
  text.precision(17);
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" << groups << "$Nodes\n" << nodes.size() << '\n';
  int number = 0;
  for (const auto& p : nodes) text << ++number << ' ' << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  text << "$EndNodes\n$Elements\n" << elements.size() << '\n';
  number = 0;
  for (const std::string& element : elements) text << ++number << ' ' << element << '\n';
  text << "$EndElements\n";
  return text.str();
}

}  // namespace qmorph::test
