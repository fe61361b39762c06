// SPDX-License-Identifier: GPL-2.0-or-later
#include "gmsh/window/second_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include "gmsh/model/add_elements.hpp"
#include "gmsh/session/compat.hpp"
#include "gmsh/session/scratch_file.hpp"
#include "gmsh/session/session.hpp"

namespace qmorph::adapter {
namespace {

constexpr const char* kName = "Gmsh's recombine";
constexpr double kGap = 0.1;  ///< between the two models, as a share of the width

/// Makes the window show at least this box; with an empty one, the current model.
void show_box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  const bool any = (low.array() <= high.array()).all();
  const ScratchFile script(".geo");
  std::ofstream(script.path()) << (any ? fmt::format("BoundingBox {{{}, {}, {}, {}, {}, {}}};\n", low.x(), high.x(),
                                                     low.y(), high.y(), low.z(), high.z())
                                       : "BoundingBox;\n");
  const ScopedOption quiet("General.Verbosity", 1);
  ::gmsh::merge(script.path());
}

void fill(const ModelMesh& mesh, double offset) {
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
  for (const Eigen::Vector3d& p : triangles.mesh.points) low_ = low_.cwiseMin(p), high_ = high_.cwiseMax(p);
  const double offset = (1 + kGap) * (high_ - low_).x();
  high_.x() += offset;
  const StageLog log = run_logged([&] {
    ::gmsh::model::add(kName);
    fill(triangles.mesh, offset);
    ::gmsh::model::mesh::recombine();
  });
  if (log.errors.empty()) return;
  ::gmsh::model::setCurrent(first_);
  throw InputError("Gmsh cannot recombine these triangles: " + first_errors(log));
}

SecondModel::~SecondModel() {
  try {
    ::gmsh::model::setCurrent(first_);
    show_box(low_, high_);
  } catch (...) {  // a destructor cannot report it
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
  show_box(Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero());
}

}  // namespace qmorph::adapter
