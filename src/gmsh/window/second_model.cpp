// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/window/second_model.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "gmsh/model/add_elements.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/session.hpp"

namespace qmorph::adapter {
namespace {

constexpr const char* kName = "Gmsh's recombine";
constexpr double kGap = 0.1;  ///< between the two, in widths

/// How far to the right a copy has to be.
double offset_of(const ModelMesh& mesh) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Eigen::Vector3d& p : mesh.points) low = std::min(low, p.x()), high = std::max(high, p.x());
  return mesh.points.empty() ? 0 : (1 + kGap) * (high - low);
}

void fill(const ModelMesh& mesh) {
  const double offset = offset_of(mesh);
  std::vector<const EntityMesh*> filled;
  for (const EntityMesh& entity : mesh.entities) {
    if (entity.dim > 2) continue;
    ::gmsh::model::addDiscreteEntity(entity.dim, entity.tag);
    std::vector<double> xyz = entity.xyz;
    for (std::size_t i = 0; i < xyz.size(); i += 3) xyz[i] += offset;
    if (!entity.node_tags.empty()) ::gmsh::model::mesh::addNodes(entity.dim, entity.tag, entity.node_tags, xyz);
    if (!entity.blocks.empty()) filled.push_back(&entity);
  }
  add_elements(filled, mesh.tags.size());
}

}  // namespace

SecondModel::SecondModel(const Snapshot& triangles) {
  remove_second_model();
  ::gmsh::model::getCurrent(first_);
  const StageLog log = run_logged([&] {
    ::gmsh::model::add(kName);
    fill(triangles.mesh);
    ::gmsh::model::mesh::recombine();
  });
  if (log.errors.empty()) return;
  ::gmsh::model::setCurrent(first_);
  throw InputError("Gmsh cannot recombine these triangles: " + first_errors(log));
}

SecondModel::~SecondModel() {
  try {
    ::gmsh::model::setCurrent(first_);
  } catch (...) {  // a destructor has nobody to tell
  }
}

void remove_second_model() {
  std::vector<std::string> models;
  ::gmsh::model::list(models);
  if (std::find(models.begin(), models.end(), kName) == models.end()) return;
  std::string now;
  ::gmsh::model::getCurrent(now);
  ::gmsh::model::setCurrent(kName);
  ::gmsh::model::remove();
  ::gmsh::model::setCurrent(now);
}

}  // namespace qmorph::adapter
