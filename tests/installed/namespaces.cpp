// SPDX-License-Identifier: GPL-2.0-or-later
// A program that opens both namespaces: nothing in them has the name of something in the other.
#include <gmsh.h>
#include <qmorph/check.hpp>
#include <qmorph/convert.hpp>
#include <qmorph/gmsh.hpp>
#include <qmorph/observer.hpp>

using namespace qmorph;
using namespace gmsh;

namespace {

/// Ends the work at once.
Progress stop(std::string_view, double) { return Progress::cancel; }

bool session_works() {
  gmsh::model::occ::addRectangle(0, 0, 0, 2, 1);
  model::occ::synchronize();
  option::setNumber("Mesh.MeshSizeMax", 0.1);
  gmsh::model::mesh::generate(2);
  Options options;
  options.progress = stop;
  bool was_cancelled = false;
  try {
    qmorph::gmsh::recombine(options);
  } catch (const Cancelled&) {
    was_cancelled = true;
  }
  make_even({}, {});
  const ModelReport report = qmorph::gmsh::recombine(Options());
  const ModelReport again = measure_surfaces({});
  const ModelReport improved = qmorph::gmsh::improve_quads({}, {1});
  return was_cancelled && report.count(SurfaceOutcome::converted) == 1 && again.total.triangles == 0 &&
         improved.total.triangles == 0;
}

bool core_works() {
  Patch patch;
  patch.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  patch.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Conversion conversion = convert(patch);
  return measure(conversion.mesh).quads == 1 && !find_defect(patch, conversion.mesh) && measure({}).quads == 0;
}

}  // namespace

int main() {
  gmsh::initialize();
  option::setNumber("General.Terminal", 0);
  const bool works = session_works() && core_works();
  finalize();
  return works ? 0 : 1;
}
