#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""quality.py [PICTURE]: quads from a cloud of points, and a picture of how good they are; a notebook's cells in a row.

Needs Debian's python3-matplotlib, and the module qmorph (README: "In Python").
"""
import sys

import matplotlib

if sys.argv[1:]:
    matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import qmorph
from matplotlib.collections import PolyCollection
from matplotlib.tri import Triangulation

# %% Points in rings around a hole, joined by triangles
angle = np.linspace(0, 2 * np.pi, 64, endpoint=False)
rings = [np.column_stack([r * np.cos(angle + 0.05 * k), r * np.sin(angle + 0.05 * k)]) for k, r in enumerate(1.1 ** np.arange(14))]
points = np.vstack(rings)
delaunay = Triangulation(points[:, 0], points[:, 1])
triangles = delaunay.triangles[np.linalg.norm(points[delaunay.triangles].mean(axis=1), axis=1) > 0.99]

# %% Quads
mesh = qmorph.convert(points, triangles)
print(mesh)

# %% Their scaled Jacobians, as colours and as a histogram
figures = qmorph.measure(mesh.points, mesh.quads, mesh.triangles)
picture, (left, right) = plt.subplots(1, 2, figsize=(11, 5), width_ratios=[3, 2])
quads = PolyCollection(mesh.points[mesh.quads][:, :, :2], array=figures["scaled_jacobians"], cmap="viridis", edgecolor="k", linewidth=0.3)
left.add_collection(quads)
left.autoscale_view()
left.set_aspect("equal")
picture.colorbar(quads, ax=left, label="scaled Jacobian")
right.hist(figures["scaled_jacobians"], bins=40)
right.set_xlabel("scaled Jacobian")
right.set_ylabel("quads")
if sys.argv[1:]:
    picture.savefig(sys.argv[1])
else:
    plt.show()
