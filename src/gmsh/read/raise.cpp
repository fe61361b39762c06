// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/read/raise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "gmsh/model/high_order.hpp"
#include "gmsh/model/model_mesh.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/element_types.hpp"
#include "gmsh/session/session.hpp"
#include "qmorph/error.hpp"

namespace qmorph::adapter {
namespace {

/// Nodes that were there keep their tags. \return warnings of Gmsh. \throws InputError
std::vector<std::string> set_order(int order, bool optimize) {
  const ScopedOption keep("Mesh.Renumber", 0);
  const StageLog log = run_logged([&] {
    ::gmsh::model::mesh::setOrder(order);
    if (optimize) ::gmsh::model::mesh::optimize("HighOrder");
  });
  if (!log.errors.empty())
    throw InputError(fmt::format("Gmsh cannot make elements of order {}: {}", order, first_errors(log)));
  return log.warnings;
}

/// Makes sides straight where curving them turns an element over: those inside of surfaces first, and where that is not
/// enough those on curves, which several surfaces share.
class Unfolding {
 public:
  void run() {
    // A side on a curve that is straight now may fold the element behind it. Each round makes some straight, and few
    // are enough.
    constexpr int kMostRounds = 10;
    for (int round = 0; round < kMostRounds; ++round) {
      const ModelMesh mesh = read_model_mesh();
      const std::set<std::size_t> before = std::move(straightened_);
      straightened_.clear();
      bent_.clear();
      for (const EntityMesh& entity : mesh.entities)
        if (entity.dim == 2) unfold(mesh, entity, before);
      if (straightened_.empty()) return;
    }
  }
  std::size_t moved_sides() const { return moved_sides_; }
  /// Surface and place of what is folded all the same.
  const std::vector<std::pair<int, std::string>>& bent() const { return bent_; }

 private:
  /// `before`: nodes on curves that the last round has moved.
  void unfold(const ModelMesh& mesh, const EntityMesh& entity, const std::set<std::size_t>& before) {
    CurvedElements elements = read_curved_elements(mesh, entity);
    bool changed = false;
    for (Index e = 0; e < elements.elements() && !before.empty(); ++e)
      if (has_side_of(elements, e, before)) elements.fill(e), changed = true;
    const std::size_t moved = elements.unfold();
    moved_sides_ += moved;
    for (Index e = 0; e < elements.elements(); ++e)
      if (elements.is_folded(e)) straighten_given(elements, e);
    if (moved > 0 || changed) move_middle_nodes(elements);
    if (const std::string where = find_bent(elements); !where.empty()) bent_.emplace_back(entity.tag, where);
  }

  static bool has_side_of(const CurvedElements& elements, Index e, const std::set<std::size_t>& nodes) {
    const auto& sides = elements.element(e).sides;
    return std::any_of(sides.begin(), sides.end(), [&](Index s) {
      const CurvedSide& side = elements.side(s);
      return side.is_given && !side.nodes.empty() && nodes.contains(side.nodes[0].tag);
    });
  }

  void straighten_given(CurvedElements& elements, Index e) {
    for (const Index s : elements.straighten_given(e)) {
      ++moved_sides_;
      for (const MiddleNode& node : elements.side(s).nodes) move(node), straightened_.insert(node.tag);
    }
  }

  static void move(const MiddleNode& node) {
    ::gmsh::model::mesh::setNode(node.tag, {node.place.x(), node.place.y(), node.place.z()}, {});
  }

  /// To where the elements have them.
  static void move_middle_nodes(const CurvedElements& elements) {
    for (Index s = 0; s < elements.sides(); ++s)
      if (elements.side(s).has_moved)
        for (const MiddleNode& node : elements.side(s).nodes) move(node);
    for (Index e = 0; e < elements.elements(); ++e)
      for (const MiddleNode& node : elements.element(e).inside) move(node);
  }

  std::set<std::size_t> straightened_;
  std::size_t moved_sides_ = 0;
  std::vector<std::pair<int, std::string>> bent_;
};

}  // namespace

int order_of_surfaces() {
  std::vector<int> types;
  ::gmsh::model::mesh::getElementTypes(types, 2);
  int order = 1;
  for (const int type : types) order = std::max(order, element_type(type).order);
  return order;
}

void lower_model(int order) {
  if (order_of_surfaces() > order) set_order(order, false);
}

RaisedModel raise_model() {
  RaisedModel raised;
  const int order = static_cast<int>(get_option("Mesh.ElementOrder"));
  if (order < 2 || order_of_surfaces() > 1) return raised;
  raised.warnings = set_order(order, get_option("Mesh.HighOrderOptimize") != 0);
  Unfolding unfolding;
  unfolding.run();
  raised.moved_sides = unfolding.moved_sides();
  for (const auto& [surface, where] : unfolding.bent())
    raised.bent.push_back(fmt::format("surface {}: a curved edge of order {} turns an element over {}; refine there",
                                      surface, order, where));
  return raised;
}

}  // namespace qmorph::adapter
