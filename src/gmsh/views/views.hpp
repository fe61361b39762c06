// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Data on nodes and elements ($NodeData, $ElementData, $ElementNodeData) on its way from the mesh of a file to the
/// mesh of quads. Gmsh keeps the numbers of what the data was on and does not write data with a mesh.

#include <string>
#include <vector>

#include "gmsh/model/model_mesh.hpp"

namespace qmorph::adapter {

/// One step of a view.
struct ViewStep {
  std::string name;
  std::string kind;  ///< "NodeData", "ElementData" or "ElementNodeData"
  int step = 0, components = 1;
  double time = 0;
  std::vector<std::size_t> tags;  ///< of nodes or elements, in order
  std::vector<std::vector<double>> values;

  /// By number, as `find` expects it.
  void sort();
  /// Values of a node or an element, or null.
  const std::vector<double>* find(std::size_t tag) const;
};

/// All data of a model, with the mesh that it is on.
struct MeshData {
  std::vector<ViewStep> steps;
  ModelMesh mesh;  ///< empty where there is no data
  std::vector<std::string> warnings;
};

/// The data that Gmsh has, but for some views; no mesh.
MeshData read_steps(const std::vector<int>& but_views = {});

/// Copies the data that Gmsh has, and the current model's mesh. `more` is data on the same mesh that Gmsh does not
/// have.
MeshData read_views(const std::vector<ViewStep>& more = {});

/// The data on the current model's mesh, which was made of `data.mesh`. What is as it was keeps its values. On
/// surfaces, a node elsewhere gets those of the old element that it lies in, interpolated with that element's own
/// functions; a new element those of the old element at its centre; and the nodes of a new element those of the old
/// element that they lie in on its side. Other new nodes and elements get none.
std::vector<ViewStep> carry_over(const MeshData& data);

/// Writes the data behind the mesh in a file of MSH 2 or 4. \throws OutputError
void append_views(const std::string& path, bool binary, const std::vector<ViewStep>& steps);

}  // namespace qmorph::adapter
