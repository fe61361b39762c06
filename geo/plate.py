#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""plate.py [FILE.inp]: a plate with a hole, drawn, meshed, turned into quads and written as a deck in one session of Gmsh.

Needs Debian's python3-gmsh, and the module qmorph (README: "In Python").
"""
import sys

import gmsh
import qmorph.gmsh

gmsh.initialize(["plate", "-v", "2"])
gmsh.model.add("plate")
plate = gmsh.model.occ.addRectangle(-1, -0.5, 0, 2, 1)
hole = gmsh.model.occ.addDisk(0, 0, 0, 0.2, 0.2)
gmsh.model.occ.cut([(2, plate)], [(2, hole)])
gmsh.model.occ.synchronize()


def name_group(dim, entities, name):
    gmsh.model.setPhysicalName(dim, gmsh.model.addPhysicalGroup(dim, [tag for _, tag in entities]), name)


name_group(2, gmsh.model.getEntities(2), "plate")
for name, x in (("clamped", -1), ("pulled", 1)):
    name_group(1, gmsh.model.getEntitiesInBoundingBox(x - 1e-3, -1, -1, x + 1e-3, 1, 1, 1), name)
gmsh.option.setNumber("Mesh.MeshSizeMax", 0.05)
gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", 40)
gmsh.model.mesh.generate(2)

qmorph.gmsh.make_even()  # so that no triangle is left
report = qmorph.gmsh.recombine()
for surface in report.left:
    sys.exit(f"surface {surface.tag}: {surface.reason}")
print(f"{report.quality['quads']} quads, scaled Jacobian at least {report.quality['scaled_jacobian_min']:.3f}")
gmsh.option.setNumber("Mesh.SaveGroupsOfNodes", 1)
gmsh.write(sys.argv[1] if sys.argv[1:] else "plate.inp")
gmsh.finalize()
