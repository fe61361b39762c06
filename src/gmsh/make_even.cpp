#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "gmsh/compat.hpp"
#include "gmsh/even_links.hpp"
#include "gmsh/model_mesh.hpp"
#include "gmsh/session.hpp"
#include "qmorph/gmsh.hpp"

namespace qmorph {
namespace {

using namespace adapter;
using Eigen::Vector3d;

struct ReadMesh {
  ModelMesh mesh;
  NodeUse use;
};

/// With every node owned by the lowest entity that uses it, or else clearing a surface would take nodes from others.
ReadMesh read_classified() {
  ReadMesh read;
  read.mesh = read_model_mesh();
  read.use = find_node_use(read.mesh);
  if (!is_misclassified(read.mesh, read.use)) return read;
  const auto pinned_tags = [&] {
    std::set<std::size_t> tags;
    for (Index row = 0; row < read.mesh.tags.size(); ++row)
      if (read.use.pinned[row]) tags.insert(read.mesh.tags[row]);
    return tags;
  };
  const std::set<std::size_t> before = pinned_tags();
  const StageLog log = run_logged([] { ::gmsh::model::mesh::reclassifyNodes(); });
  if (!log.errors.empty()) throw InputError("Gmsh cannot classify the nodes: " + first_errors(log));
  read.mesh = read_model_mesh();
  read.use = find_node_use(read.mesh);
  if (pinned_tags() != before)
    throw InputError(
        "the file has nodes in entities that do not use them, and curves without line elements; save it with "
        "Gmsh first (Mesh.SaveAll = 1)");
  return read;
}

/// Such a surface stays as it is: tetrahedra stand on its triangles.
bool bounds_volume(const ModelMesh& mesh, const NodeUse& use, const EntityMesh& surface) {
  for (const ElementBlock& block : surface.blocks)
    for (std::size_t i = 0; i + block.nodes_per_element <= block.nodes.size(); i += block.nodes_per_element)
      if (std::all_of(block.nodes.begin() + std::ptrdiff_t(i), block.nodes.begin() + std::ptrdiff_t(i) + 3,
                      [&](std::size_t tag) {
                        const Index row = mesh.rows.find(tag);
                        return row != kNone && use.volume[row];
                      }))
        return true;
  return false;
}

std::vector<std::uint32_t> find_surfaces(const ModelMesh& mesh, const NodeUse& use, const std::vector<int>& wanted) {
  std::vector<int> missing = wanted;
  std::vector<std::uint32_t> found;
  for (std::uint32_t e = 0; e < mesh.entities.size(); ++e) {
    if (mesh.entities[e].dim != 2) continue;
    std::erase(missing, mesh.entities[e].tag);
    const bool asked = wanted.empty() || std::count(wanted.begin(), wanted.end(), mesh.entities[e].tag);
    if (asked && !bounds_volume(mesh, use, mesh.entities[e])) found.push_back(e);
  }
  if (!missing.empty()) throw UsageError(fmt::format("the model has no surface {}", missing.front()));
  return found;
}

std::set<int> check_curves(const ModelMesh& mesh, const std::vector<int>& keep_curves) {
  std::set<int> curves;
  for (const EntityMesh& entity : mesh.entities)
    if (entity.dim == 1) curves.insert(entity.tag);
  for (int tag : keep_curves)
    if (!curves.count(tag)) throw UsageError(fmt::format("the model has no curve {}", tag));
  return {keep_curves.begin(), keep_curves.end()};
}

/// Splits edges in a copy of the model's mesh, then gives the model what has changed.
class Splitter {
 public:
  explicit Splitter(ModelMesh& mesh)
      : mesh_(mesh), next_node_(mesh.max_node_tag), next_element_(mesh.max_element_tag) {}

  void plan(Index a, Index b) { middle_[key(mesh_.tags[a], mesh_.tags[b])] = 0; }
  /// Returns what was split, in the order of the edges' node tags.
  std::vector<SplitEdge> run();
  void put_back() const;

 private:
  using Key = std::pair<std::size_t, std::size_t>;
  static Key key(std::size_t a, std::size_t b) { return {std::min(a, b), std::max(a, b)}; }

  void find_owners();
  std::uint32_t lowest_owner(const Key& edge, std::uint32_t surface) const;
  void add_node(const Key& edge, std::uint32_t owner);
  void split_lines(EntityMesh& entity);
  void split_triangles(EntityMesh& entity);
  std::vector<const EntityMesh*> find_cleared() const;

  ModelMesh& mesh_;
  std::size_t next_node_, next_element_;
  std::map<Key, std::size_t> middle_;  ///< of an edge, by node tags: the tag of the new node
  std::map<Key, SplitEdge> report_;
  std::set<std::uint32_t> changed_;
};

void Splitter::find_owners() {
  for (std::uint32_t e = 0; e < mesh_.entities.size(); ++e) {
    const EntityMesh& entity = mesh_.entities[e];
    const ElementBlock* block = entity.dim == 1   ? entity.block(kLine2)
                                : entity.dim == 2 ? entity.block(kTriangle3)
                                                  : nullptr;
    if (!block) continue;
    const std::size_t n = block->nodes_per_element, sides = n == 2 ? 1 : 3;
    for (std::size_t i = 0; i < block->nodes.size(); i += n)
      for (std::size_t k = 0; k < sides; ++k) {
        const Key edge = key(block->nodes[i + k], block->nodes[i + (k + 1) % n]);
        const auto found = middle_.find(edge);
        if (found == middle_.end()) continue;
        changed_.insert(e);
        // Curves come before surfaces, so the first is the lowest; and if it is a surface, no line element is there.
        if (found->second == 0) add_node(edge, entity.dim == 1 ? e : lowest_owner(edge, e));
        if (entity.dim == 2) report_[edge].surfaces.push_back(entity.tag);
      }
  }
}

/// On the curve of a CAD kernel where that is near, else in the middle of the chord.
Vector3d middle_of(const Vector3d& a, const Vector3d& b, const EntityMesh& owner) {
  const Vector3d chord = (a + b) / 2;
  const std::string type = entity_type(owner.dim, owner.tag);
  if (owner.dim != 1 || type == "Line" || type.rfind("Discrete", 0) == 0) return chord;
  std::vector<double> u, on_curve;
  const StageLog log = run_logged([&] {
    ::gmsh::model::getParametrization(1, owner.tag, {chord.x(), chord.y(), chord.z()}, u);
    ::gmsh::model::getValue(1, owner.tag, u, on_curve);
  });
  // More sagitta than this, and a triangle beside might turn over.
  constexpr double kMostSagitta = 0.1;
  if (!log.errors.empty() || on_curve.size() != 3) return chord;
  const Vector3d p(on_curve[0], on_curve[1], on_curve[2]);
  return (p - chord).norm() < kMostSagitta * (b - a).norm() ? p : chord;
}

std::uint32_t Splitter::lowest_owner(const Key& edge, std::uint32_t surface) const {
  const std::uint32_t curve = curve_under(mesh_, mesh_.rows.find(edge.first), mesh_.rows.find(edge.second));
  return curve == kNobody ? surface : curve;
}

void Splitter::add_node(const Key& edge, std::uint32_t owner) {
  const Vector3d &a = mesh_.points[mesh_.rows.find(edge.first)], &b = mesh_.points[mesh_.rows.find(edge.second)];
  EntityMesh& entity = mesh_.entities[owner];
  const Vector3d p = middle_of(a, b, entity);
  entity.node_tags.push_back(middle_[edge] = ++next_node_);
  entity.xyz.insert(entity.xyz.end(), p.data(), p.data() + 3);
  entity.uv.clear();
  changed_.insert(owner);
  report_[edge].where = p;
  if (entity.dim == 1) report_[edge].curve = entity.tag;
}

void Splitter::split_lines(EntityMesh& entity) {
  for (ElementBlock& block : entity.blocks) {
    if (block.type != kLine2) continue;
    ElementBlock split = block;
    split.tags.clear(), split.nodes.clear();
    for (std::size_t i = 0; i < block.tags.size(); ++i) {
      const std::size_t a = block.nodes[2 * i], b = block.nodes[2 * i + 1];
      split.tags.push_back(block.tags[i]);
      const auto found = middle_.find(key(a, b));
      if (found == middle_.end()) {
        split.nodes.insert(split.nodes.end(), {a, b});
        continue;
      }
      split.tags.push_back(++next_element_);
      split.nodes.insert(split.nodes.end(), {a, found->second, found->second, b});
    }
    block = std::move(split);
  }
}

void Splitter::split_triangles(EntityMesh& entity) {
  for (ElementBlock& block : entity.blocks) {
    if (block.type != kTriangle3) continue;
    const std::size_t count = block.tags.size();
    for (std::size_t i = 0; i < count; ++i) {
      // Pieces are looked at until none has a side to split; a triangle has three at most.
      std::vector<std::size_t> pieces{i};
      while (!pieces.empty()) {
        const std::size_t t = pieces.back();
        pieces.pop_back();
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t a = block.nodes[3 * t + k], b = block.nodes[3 * t + (k + 1) % 3],
                            c = block.nodes[3 * t + (k + 2) % 3];
          const auto found = middle_.find(key(a, b));
          if (found == middle_.end()) continue;
          block.nodes[3 * t + (k + 1) % 3] = found->second;
          block.nodes.insert(block.nodes.end(), {found->second, b, c});
          block.tags.push_back(++next_element_);
          pieces = {t, block.tags.size() - 1};
          break;
        }
      }
    }
  }
}

std::vector<SplitEdge> Splitter::run() {
  find_owners();
  for (std::uint32_t e : changed_) {
    if (mesh_.entities[e].dim == 1) split_lines(mesh_.entities[e]);
    if (mesh_.entities[e].dim == 2) split_triangles(mesh_.entities[e]);
  }
  std::vector<SplitEdge> splits;
  for (const auto& [edge, split] : report_) splits.push_back(split);
  return splits;
}

/// What is cleared frees its nodes, so whatever else uses them has to go and come back with it (notes 1.3); and a curve
/// can be cleared only with all that lies on it. All surfaces and volumes, to be simple.
std::vector<const EntityMesh*> Splitter::find_cleared() const {
  std::vector<bool> cleared(mesh_.entities.size());
  for (std::uint32_t e = 0; e < cleared.size(); ++e) cleared[e] = mesh_.entities[e].dim >= 2 || changed_.count(e);
  const auto uses_cleared = [&](const EntityMesh& entity) {
    for (const ElementBlock& block : entity.blocks)
      for (std::size_t tag : block.nodes)
        if (const Index row = mesh_.rows.find(tag); row != kNone && cleared[mesh_.owner[row]]) return true;
    return false;
  };
  for (bool again = true; again;) {
    again = false;
    for (std::uint32_t e = 0; e < cleared.size(); ++e)
      if (!cleared[e] && uses_cleared(mesh_.entities[e])) cleared[e] = again = true;
  }
  std::vector<const EntityMesh*> entities;
  for (std::uint32_t e = 0; e < cleared.size(); ++e)
    if (cleared[e]) entities.push_back(&mesh_.entities[e]);
  return entities;
}

/// Clearing would take the links away.
void refuse_periodic(const ModelMesh& mesh, const std::vector<const EntityMesh*>& entities) {
  for (const EntityMesh& entity : mesh.entities) {
    int master = entity.tag;
    if (entity.dim < 3) {
      std::vector<std::size_t> nodes, master_nodes;
      std::vector<double> transformation;
      ::gmsh::model::mesh::getPeriodicNodes(entity.dim, entity.tag, master, nodes, master_nodes, transformation, false);
    }
    if (master == entity.tag) continue;
    for (const EntityMesh* one : entities)
      if (one->dim == entity.dim && (one->tag == entity.tag || one->tag == master))
        throw InputError(fmt::format("{} {} and {} are periodic, and a curve beside them would have to get a node",
                                     entity.dim == 2   ? "surfaces"
                                     : entity.dim == 1 ? "curves"
                                                       : "points",
                                     entity.tag, master));
  }
}

void Splitter::put_back() const {
  const std::vector<const EntityMesh*> entities = find_cleared();
  refuse_periodic(mesh_, entities);
  const StageLog log = run_logged([&] {
    ::gmsh::vectorpair to_clear;
    for (auto it = entities.rbegin(); it != entities.rend(); ++it) to_clear.emplace_back((*it)->dim, (*it)->tag);
    ::gmsh::model::mesh::clear(to_clear);
    for (const EntityMesh* entity : entities)
      if (!entity->node_tags.empty())
        ::gmsh::model::mesh::addNodes(entity->dim, entity->tag, entity->node_tags, entity->xyz, entity->uv);
    for (const EntityMesh* entity : entities)
      for (const ElementBlock& block : entity->blocks)
        ::gmsh::model::mesh::addElementsByType(entity->tag, block.type, block.tags, block.nodes);
  });
  if (!log.errors.empty()) throw InputError("Gmsh cannot take the split curves back: " + first_errors(log));
  for (const std::string& warning : log.warnings)
    if (warning.find("Cannot delete mesh") != std::string::npos)
      throw InputError("Gmsh cannot take the split curves back: " + warning);
}

}  // namespace

EvenReport make_even(const std::vector<int>& surfaces, const std::vector<int>& keep_curves) {
  const QuietErrors quiet;
  ReadMesh read = read_classified();
  const RegionGraph graph = find_region_graph(read.mesh, read.use, find_surfaces(read.mesh, read.use, surfaces),
                                              check_curves(read.mesh, keep_curves));
  EvenReport report;
  report.odd_regions = std::size_t(std::count(graph.odd.begin(), graph.odd.end(), true));
  const parity::Plan plan = parity::plan_splits(graph.odd, graph.links);
  for (Index region : plan.odd_left) report.odd_surfaces.push_back(read.mesh.entities[graph.surface[region]].tag);
  std::sort(report.odd_surfaces.begin(), report.odd_surfaces.end());
  report.odd_surfaces.erase(std::unique(report.odd_surfaces.begin(), report.odd_surfaces.end()),
                            report.odd_surfaces.end());
  if (plan.splits.empty()) return report;

  Splitter splitter(read.mesh);
  for (Index link : plan.splits) splitter.plan(graph.edges[link].first, graph.edges[link].second);
  report.splits = splitter.run();
  splitter.put_back();
  return report;
}

}  // namespace qmorph
