// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// What the programs that read our meshes need, and a mesh made for them.

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gmsh/model/periodic_links.hpp"

namespace qmorph::adapter {

/// One reader (--for NAME). Sources: the readers' own code and issues, as of November 2026.
struct Consumer {
  std::string_view name;
  std::string_view title;   ///< as its users call it
  std::string_view format;  ///< "msh2" (ASCII), "inp" or "su2"
  int max_order = 1;
  bool wants_incomplete = false;  ///< 8 nodes for order 2
  bool only_quads = false;        ///< triangles cannot be read, or spoil the computation later
  bool needs_volumes = false;     ///< reads cells of dimension 3 only
  bool inner_lines = true;        ///< takes line elements between two surface elements
  bool points = true;             ///< takes point elements
  bool specfem_names = false;     ///< curves Top, Bottom, Left and Right; surfaces M1, M2, ...
  bool needs_surface_groups = false;
  bool needs_curve_groups = false;
  bool planar = false;    ///< ignores z: a mesh of surfaces has to lie in one plane z = constant
  bool oriented = false;  ///< elements oriented alike, counterclockwise in a plane: call `orient_surfaces` first
  bool periodic = false;  ///< reads which nodes are periodic images of others
};

/// \throws UsageError that lists the names
const Consumer& find_consumer(const std::string& name);

/// An element to be written.
struct ConsumerElement {
  int dim = 0, type = 0;  ///< Gmsh's number of the type
  int entity = 0;
  std::vector<int> groups;         ///< physical groups
  std::vector<std::size_t> nodes;  ///< from 1
};

/// The mesh as the reader gets it: numbered from 1 without gaps, without unused nodes.
struct ConsumerMesh {
  std::vector<Eigen::Vector3d> nodes;
  std::vector<ConsumerElement> elements;  ///< points, lines, surfaces, volumes
  std::vector<PeriodicLink> links;        ///< for readers that know about them
  std::vector<std::string> complaints;    ///< why the reader would not take it
};

/// Collects the current model for a reader.
/// \param everything includes what is in no physical group even if there are groups
ConsumerMesh collect_for(const Consumer& consumer, bool everything);

/// The largest dimension of an element.
int dimension(const ConsumerMesh& mesh);

/// The first node that is farther from this height than rounding explains.
std::optional<Eigen::Vector3d> find_off_plane(const ConsumerMesh& mesh, double z);

/// Writes MSH 2.2 in ASCII. \throws OutputError
void write_msh2_for(const Consumer& consumer, const ConsumerMesh& mesh, const std::string& path);

/// Writes a deck with nodes, elements of the mesh's dimension, and sets of both for each physical group. Lines become
/// sets of nodes, since as elements they would be trusses.
/// \param family of the surface elements: CPS (plane stress: CPS4, CPS8), CPE (plane strain), CAX (axisymmetric), S
///        (shells), M3D (membranes), each with an R after it for reduced integration
/// \throws OutputError
void write_inp_for(const ConsumerMesh& mesh, const std::string& family, const std::string& path);

/// The family of a deck's surface elements: the one asked for, if any, else CPS in the plane z = 0 and S elsewhere,
/// where CalculiX does not take the others. Complains of a mesh that is not in that plane though its family requires
/// it, and moves nodes into the plane that only rounding has left beside it.
std::string choose_family(const std::string& asked, ConsumerMesh& mesh);

/// Whether a deck can have such elements.
bool is_element_family(const std::string& family);

/// Writes elements and nodes from 0, and a marker for each physical group of the boundary. \throws OutputError
void write_su2_for(const ConsumerMesh& mesh, const std::string& path);

}  // namespace qmorph::adapter
