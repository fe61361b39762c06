// SPDX-License-Identifier: GPL-2.0-or-later
// A program that runs the Gmsh API: qmorph::gmsh::recombine() in the place of gmsh::model::mesh::recombine().
#include <gmsh.h>
#include <qmorph/gmsh.hpp>

#include <iostream>

int main() {
  gmsh::initialize();
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::occ::addRectangle(0, 0, 0, 2, 1);
  gmsh::model::occ::synchronize();
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.1);
  gmsh::model::mesh::generate(2);

  const qmorph::ModelReport report = qmorph::gmsh::recombine();
  for (const qmorph::SurfaceReport& surface : report.surfaces)
    std::cout << "surface " << surface.tag << ": " << surface.quads_out << " quads, worst scaled Jacobian "
              << surface.quality.scaled_jacobian_min << '\n';

  gmsh::write("rectangle.msh");
  gmsh::finalize();
  return report.count(qmorph::SurfaceOutcome::converted) == 1 && report.total.triangles == 0 ? 0 : 1;
}
