// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "gmsh/session/compat.hpp"
#include "gmsh/views/element_locator.hpp"
#include "gmsh/views/line_locator.hpp"
#include "gmsh/views/views.hpp"

namespace qmorph::adapter {
namespace {

using Eigen::Vector3d;

/// Values at the nodes of an element, or nothing if one has none.
using NodeValues = std::optional<std::vector<const double*>>;

/// Carries one model's data from mesh to mesh. Places are looked up once for all views.
class Carrier {
 public:
  explicit Carrier(const ModelMesh& old) : old_(old), lines_(old), mesh_(read_model_mesh()) {
    find_new_nodes();
    find_new_elements();
  }
  ViewStep carry(const ViewStep& step);

 private:
  struct NewElement {
    const EntityMesh* entity;  ///< a curve or a surface
    const ElementBlock* block;
    std::size_t element;
  };
  using Values = std::vector<double>;

  const ElementLocator* locator(int surface);
  Vector3d point(std::size_t node) const { return mesh_.points[mesh_.rows.find(node)]; }
  Vector3d centre(const NewElement& element) const;
  void find_new_nodes();
  void find_new_elements();
  void find_renumbered();
  std::vector<double> shape_functions(const ElementPlace& place);
  std::vector<double> shape_functions(int type, const Vector3d& local);
  Values interpolate(const std::vector<double>& functions, const std::vector<const double*>& at_nodes, int components);
  NodeValues values_at_nodes(const ElementBlock& block, std::size_t element, const ViewStep& step) const;
  void carry_to_nodes(const ViewStep& step, ViewStep& carried);
  void carry_to_elements(const ViewStep& step, ViewStep& carried);
  std::optional<Values> value_on_surface(const NewElement& element, const ViewStep& step);
  std::optional<Values> value_on_curve(const NewElement& element, const ViewStep& step);

  const ModelMesh& old_;
  const LineLocator lines_;
  const ModelMesh mesh_;
  std::map<int, ElementLocator> locators_;
  std::vector<std::pair<Index, const EntityMesh*>> new_nodes_;  ///< rows of `mesh_`
  std::vector<NewElement> new_elements_;
  std::vector<std::size_t> kept_nodes_, kept_elements_;  ///< tags, in order
  /// New and old tags of elements of volumes that Gmsh has given another order, and with it another number.
  std::vector<std::pair<std::size_t, std::size_t>> renumbered_;
  std::map<int, std::vector<Vector3d>> local_corners_;  ///< of element types
};

const ElementLocator* Carrier::locator(int surface) {
  auto found = locators_.find(surface);
  if (found == locators_.end()) {
    const auto entity = std::find_if(old_.entities.begin(), old_.entities.end(),
                                     [&](const EntityMesh& e) { return e.dim == 2 && e.tag == surface; });
    if (entity == old_.entities.end()) return nullptr;
    found = locators_.emplace(surface, ElementLocator(old_, *entity)).first;
  }
  return found->second.empty() ? nullptr : &found->second;
}

Vector3d Carrier::centre(const NewElement& element) const {
  const ElementBlock& block = *element.block;
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < block.corners; ++k)
    sum += point(block.nodes[element.element * block.nodes_per_element + k]);
  return sum / static_cast<double>(block.corners);
}

/// Nodes of surface elements that were not there, or elsewhere.
void Carrier::find_new_nodes() {
  std::vector<bool> done(mesh_.tags.size(), false);
  for (Index row = 0; row < mesh_.tags.size(); ++row) {
    const Index before = old_.rows.find(mesh_.tags[row]);
    done[row] = before != kNone && old_.points[before] == mesh_.points[row];
    if (done[row]) kept_nodes_.push_back(mesh_.tags[row]);
  }
  std::sort(kept_nodes_.begin(), kept_nodes_.end());
  for (const EntityMesh& entity : mesh_.entities)
    for (const ElementBlock& block : entity.blocks) {
      if (entity.dim != 2 || !locator(entity.tag)) continue;
      for (std::size_t node : block.nodes) {
        const Index row = mesh_.rows.find(node);
        if (row == kNone || done[row]) continue;
        done[row] = true;
        new_nodes_.emplace_back(row, &entity);
      }
    }
}

void Carrier::find_new_elements() {
  std::unordered_map<std::size_t, std::pair<const ElementBlock*, std::size_t>> before;
  for (const EntityMesh& entity : old_.entities)
    for (const ElementBlock& block : entity.blocks)
      for (std::size_t e = 0; e < block.tags.size(); ++e) before[block.tags[e]] = {&block, e};
  const auto is_kept = [&](const ElementBlock& block, std::size_t e, bool same_nodes) {
    const auto found = before.find(block.tags[e]);
    if (found == before.end() || found->second.first->type != block.type) return false;
    const std::size_t n = block.nodes_per_element;
    const std::size_t* nodes = found->second.first->nodes.data() + n * found->second.second;
    return !same_nodes || std::equal(nodes, nodes + n, block.nodes.data() + n * e);
  };
  for (const EntityMesh& entity : mesh_.entities)
    for (const ElementBlock& block : entity.blocks)
      for (std::size_t e = 0; e < block.tags.size(); ++e) {
        // The first half of a line that got a node has its number.
        if (is_kept(block, e, entity.dim == 1 || entity.dim == 2))
          kept_elements_.push_back(block.tags[e]);
        else if (entity.dim == 1 || (entity.dim == 2 && locator(entity.tag)))
          new_elements_.push_back({&entity, &block, e});
      }
  std::sort(kept_elements_.begin(), kept_elements_.end());
  find_renumbered();
}

void Carrier::find_renumbered() {
  const auto for_each_element = [](const ModelMesh& mesh, const auto& take) {
    for (const EntityMesh& entity : mesh.entities)
      for (const ElementBlock& block : entity.blocks)
        for (std::size_t e = 0; entity.dim == 3 && e < block.tags.size(); ++e) {
          const auto first = block.nodes.begin() + std::ptrdiff_t(e * block.nodes_per_element);
          take(std::vector<std::size_t>(first, first + std::ptrdiff_t(block.corners)), block.tags[e]);
        }
  };
  std::map<std::vector<std::size_t>, std::size_t> now;
  for_each_element(mesh_, [&](auto corners, std::size_t tag) {
    if (!std::binary_search(kept_elements_.begin(), kept_elements_.end(), tag)) now.emplace(std::move(corners), tag);
  });
  if (now.empty()) return;
  for_each_element(old_, [&](const auto& corners, std::size_t tag) {
    if (const auto found = now.find(corners); found != now.end()) renumbered_.emplace_back(found->second, tag);
  });
}

std::vector<double> Carrier::shape_functions(const ElementPlace& place) {
  if (place.block->type == kTriangle3) return {place.weights[0], place.weights[1], place.weights[2]};
  std::vector<Vector3d>& corners = local_corners_[place.block->type];
  if (corners.empty()) {
    std::string name;
    int dim = 0, order = 0, nodes = 0, primary = 0;
    std::vector<double> local;
    ::gmsh::model::mesh::getElementProperties(place.block->type, name, dim, order, nodes, local, primary);
    for (std::size_t k = 0; k < place.block->corners; ++k) corners.emplace_back(local[2 * k], local[2 * k + 1], 0);
  }
  Vector3d at = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) at += place.weights[k] * corners[place.corners[static_cast<std::size_t>(k)]];
  return shape_functions(place.block->type, at);
}

std::vector<double> Carrier::shape_functions(int type, const Vector3d& local) {
  int components = 0, orientations = 0;
  std::vector<double> functions;
  ::gmsh::model::mesh::getBasisFunctions(type, {local.x(), local.y(), local.z()}, "Lagrange", components, functions,
                                         orientations);
  return functions;
}

Carrier::Values Carrier::interpolate(const std::vector<double>& functions, const std::vector<const double*>& at_nodes,
                                     int components) {
  Values values(static_cast<std::size_t>(components), 0);
  for (std::size_t k = 0; k < at_nodes.size() && k < functions.size(); ++k)
    for (std::size_t c = 0; c < values.size(); ++c) values[c] += functions[k] * at_nodes[k][c];
  return values;
}

/// From data on nodes, or from data on the element's nodes.
NodeValues Carrier::values_at_nodes(const ElementBlock& block, std::size_t element, const ViewStep& step) const {
  const std::size_t n = block.nodes_per_element, c = static_cast<std::size_t>(step.components);
  std::vector<const double*> at_nodes;
  const std::vector<double>* own = step.kind == "NodeData" ? nullptr : step.find(block.tags[element]);
  if (step.kind != "NodeData" && (!own || own->size() < n * c)) return std::nullopt;
  for (std::size_t k = 0; k < n; ++k) {
    const std::vector<double>* one = own ? own : step.find(block.nodes[element * n + k]);
    if (!one || one->size() < c) return std::nullopt;
    at_nodes.push_back(one->data() + (own ? k * c : 0));
  }
  return at_nodes;
}

void Carrier::carry_to_nodes(const ViewStep& step, ViewStep& carried) {
  for (std::size_t node : kept_nodes_)
    if (const auto* values = step.find(node)) {
      carried.tags.push_back(node);
      carried.values.push_back(*values);
    }
  for (const auto& [row, surface] : new_nodes_) {
    const ElementPlace place = locator(surface->tag)->find(mesh_.points[row]);
    const NodeValues at_nodes = values_at_nodes(*place.block, place.element, step);
    if (!at_nodes) continue;
    carried.tags.push_back(mesh_.tags[row]);
    carried.values.push_back(interpolate(shape_functions(place), *at_nodes, step.components));
  }
}

std::optional<Carrier::Values> Carrier::value_on_surface(const NewElement& element, const ViewStep& step) {
  const ElementLocator& old = *locator(element.entity->tag);
  const ElementBlock& block = *element.block;
  const Vector3d middle = centre(element);
  if (step.kind == "ElementData") {
    const ElementPlace place = old.find(middle);
    const auto* values = step.find(place.block->tags[place.element]);
    return values ? std::optional(*values) : std::nullopt;
  }
  Values all;
  for (std::size_t k = 0; k < block.nodes_per_element; ++k) {
    const Vector3d p = point(block.nodes[element.element * block.nodes_per_element + k]);
    const ElementPlace place = old.find(p, middle);
    const NodeValues at_nodes = values_at_nodes(*place.block, place.element, step);
    if (!at_nodes) return std::nullopt;
    const Values values = interpolate(shape_functions(place), *at_nodes, step.components);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

std::optional<Carrier::Values> Carrier::value_on_curve(const NewElement& element, const ViewStep& step) {
  const ElementBlock& block = *element.block;
  const std::size_t* nodes = block.nodes.data() + element.element * block.nodes_per_element;
  const std::optional<Line> line = lines_.find(element.entity->tag, {nodes[0], nodes[1]}, centre(element));
  if (!line) return std::nullopt;
  if (step.kind == "ElementData") {
    const auto* values = step.find(line->block->tags[line->element]);
    return values ? std::optional(*values) : std::nullopt;
  }
  const NodeValues at_nodes = values_at_nodes(*line->block, line->element, step);
  if (!at_nodes) return std::nullopt;
  Values all;
  for (std::size_t k = 0; k < block.nodes_per_element; ++k) {
    const double at = lines_.parameter(*line, point(nodes[k]));
    const std::vector<double> functions = shape_functions(line->block->type, {at, 0, 0});
    const Values values = interpolate(functions, *at_nodes, step.components);
    all.insert(all.end(), values.begin(), values.end());
  }
  return all;
}

void Carrier::carry_to_elements(const ViewStep& step, ViewStep& carried) {
  for (std::size_t element : kept_elements_)
    if (const auto* values = step.find(element)) {
      carried.tags.push_back(element);
      carried.values.push_back(*values);
    }
  for (const auto& [now, before] : renumbered_)
    if (const auto* values = step.find(before); values && step.kind == "ElementData") {
      carried.tags.push_back(now);
      carried.values.push_back(*values);
    }
  for (const NewElement& element : new_elements_)
    if (auto values = element.entity->dim == 1 ? value_on_curve(element, step) : value_on_surface(element, step)) {
      carried.tags.push_back(element.block->tags[element.element]);
      carried.values.push_back(std::move(*values));
    }
}

ViewStep Carrier::carry(const ViewStep& step) {
  ViewStep carried{step.name, step.kind, step.step, step.components, step.time, {}, {}};
  if (step.kind == "NodeData")
    carry_to_nodes(step, carried);
  else
    carry_to_elements(step, carried);
  carried.sort();
  return carried;
}

}  // namespace

std::vector<ViewStep> carry_over(const MeshData& data) {
  std::vector<ViewStep> carried;
  if (data.steps.empty()) return carried;
  Carrier carrier(data.mesh);
  for (const ViewStep& step : data.steps) carried.push_back(carrier.carry(step));
  return carried;
}

}  // namespace qmorph::adapter
