# SPDX-License-Identifier: GPL-2.0-or-later
"""All-quadrilateral meshes from triangles (Q-Morph, Owen et al. 1999).

    mesh = qmorph.convert(points, triangles)          # arrays in, arrays out
    qmorph.gmsh.recombine()                           # the model of the Gmsh session that is open (import qmorph.gmsh)
    quads = qmorph.meshio.convert(mesh)               # a meshio.Mesh in and out (import qmorph.meshio)

All three take options as keywords; angles are in degrees, switches 0 or 1.
    threads: how many to use at most; 0 (default): as many as the machine has. The result does not depend on it.
    smoothing: "shape_energy" (default) or "thesis"
    layers: whether rows of triangles along walls stay rows of quads (default: 1)
    crease_angle: on curved surfaces, edges with a sharper bend are kept (default: 40)
    part_triangles: surfaces with more triangles are worked on in parts of about this size; 0: never
    smoothing_iterations, smoothing_target_quality: rounds over the nodes at the end, and the scaled Jacobian that they aim at
    cleanup_pattern_rounds: how many times cleanup looks for irregular nodes
    cleanup_..._cases, cleanup_..._angle, EPSILON1 ... GAMMA: constants of the thesis, for comparison with it
option_names() lists all of them, with a dot where Python has an underscore.

Figures (Mesh.quality, measure()) by name: quads, triangles, inverted; scaled_jacobian_min, _p1, _p5 (percentiles), _mean, _below_03
(share); eta_min, eta_mean (Gmsh's: 1 - largest deviation from 90 degrees / 90); thesis_min, thesis_mean; angle_min_deg, angle_max_deg;
interior_nodes, irregular_nodes (valence not 4), irregular_share, valence and boundary_valence (nodes by valence). For a mesh without
quads they are those of a square.
Mesh.report tells what was done: the number of regions and of those with an odd boundary, quads of layers, seconds by stage, and so on.
Its leftover_triangles are those that the front left for cleanup, not those of the result.
"""
from __future__ import annotations

from typing import Any, Callable, Dict, List, Optional

from . import _core
from ._progress import Progress, callback_of
from .errors import Cancelled, Error, InputError, SurfaceError, UsageError
from .result import EvenReport, Mesh, ModelReport, SurfaceReport

__version__: str = _core.version

__all__ = [
    "Cancelled", "Error", "EvenReport", "InputError", "Mesh", "ModelReport", "SurfaceError", "SurfaceReport", "UsageError",
    "convert", "improve", "measure", "option_names",
]


def convert(
    points: Any,
    triangles: Any,
    *,
    quads: Any = None,
    constraints: Any = None,
    fixed: Any = None,
    progress: Progress = None,
    **options: Any,
) -> Mesh:
    """Turns the triangles of a surface, planar or curved, into quads.

    points: coordinates, two columns or three
    triangles: node numbers from 0, three columns, oriented alike
    quads: elements that exist already and stay, four columns
    constraints: edges of the mesh that stay, two columns
    fixed: nodes that stay where they are, besides those of the boundary and of the constraints
    progress: a function that gets the name of a stage and the share that is done, in the calling thread; the work ends if it
        returns False or raises. True: a tqdm bar, if tqdm is installed.
    options: see help(qmorph)

    Every boundary edge and constraint stays an edge; no triangle is left, except one in each region with an odd number of boundary
    sides. The same arguments give the same result. Ctrl-C ends the work; other threads run meanwhile.

    Raises SurfaceError for a surface that cannot be converted, UsageError for arguments that make no sense; both say where.
    """
    with callback_of(progress) as callback:
        return Mesh(**_core.convert(points, triangles, quads, constraints, fixed, options, callback))


def improve(
    points: Any,
    quads: Any,
    *,
    triangles: Any = None,
    constraints: Any = None,
    fixed: Any = None,
    progress: Progress = None,
    **options: Any,
) -> Mesh:
    """Improves an existing mesh of quads, or of quads and triangles; all elements may change.

    Arguments and errors are those of convert().
    """
    with callback_of(progress) as callback:
        return Mesh(**_core.improve(points, triangles, quads, constraints, fixed, options, callback))


def measure(points: Any, quads: Any, triangles: Any = None) -> Dict[str, Any]:
    """Figures of a mesh by name, as in Mesh.quality, and "scaled_jacobians", one for each quad."""
    return _core.measure(points, triangles, quads)


def option_names() -> List[str]:
    """The constants of the algorithm, as `qmorph --set` knows them."""
    return list(_core.option_names())
