# SPDX-License-Identifier: GPL-2.0-or-later
"""All-quadrilateral meshes from triangles (Q-Morph, Owen et al. 1999).

    mesh = qmorph.convert(points, triangles)          # arrays in, arrays out
    qmorph.gmsh.recombine()                           # the model of the Gmsh session that is open (import qmorph.gmsh)
    quads = qmorph.meshio.convert(mesh)               # a meshio.Mesh in and out (import qmorph.meshio)

Options of all three are keywords; angles are in degrees, switches 0 or 1.
    threads: at most so many; 0 (default), as many as the machine has. The result does not depend on it.
    smoothing: "shape_energy" (default) or "thesis"
    layers: whether rows of triangles along walls stay rows of quads (default: 1)
    crease_angle: on curved surfaces edges with a sharper bend are kept (default: 40)
    part_triangles: larger surfaces are worked on in parts of about so many; 0, never
    smoothing_iterations, smoothing_target_quality: rounds over the nodes at the end, and the scaled Jacobian that they aim at
    cleanup_pattern_rounds: how often irregular nodes are looked for
    cleanup_..._cases, cleanup_..._angle, EPSILON1 ... GAMMA: the constants of the thesis, for those who compare with it
option_names() lists the names that have a dot where Python wants an underscore.

Figures (Mesh.quality, measure()) by name: quads, triangles, inverted; scaled_jacobian_min, _p1, _p5 (percentiles), _mean, _below_03
(share); eta_min, eta_mean (Gmsh's 1 - worst angle off 90 degrees / 90); thesis_min, thesis_mean; angle_min_deg, angle_max_deg;
interior_nodes, irregular_nodes (valence not 4), irregular_share, valence and boundary_valence (nodes by valence). Without a quad
they are those of a square.
Mesh.report tells what was done: regions and those with an odd boundary, quads of layers, seconds by stage, and so on; triangles that
the front had left before cleanup (leftover_triangles) are not those of the result.
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
    quads: elements that are there already and stay, four columns
    constraints: edges of the mesh that stay, two columns
    fixed: nodes that stay where they are, besides those of the boundary and of the constraints
    progress: called with the name of a stage and the share that is done, from the calling thread; the work ends if it returns
        False or raises. True: a tqdm bar, where tqdm is installed.
    options: see help(qmorph)

    Every boundary edge and constraint stays an edge; no triangle is left but one in each region with an odd number of sides.
    The same arguments give the same result. Ctrl-C ends the work; other threads run meanwhile.

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
    """Makes better quads of quads, or of quads and triangles, that are there already; all of them may change.

    Arguments and errors as those of convert().
    """
    with callback_of(progress) as callback:
        return Mesh(**_core.improve(points, triangles, quads, constraints, fixed, options, callback))


def measure(points: Any, quads: Any, triangles: Any = None) -> Dict[str, Any]:
    """Figures of a mesh by name, as in Mesh.quality, and "scaled_jacobians", one for each quad."""
    return _core.measure(points, triangles, quads)


def option_names() -> List[str]:
    """The constants of the algorithm, as `qmorph --set` knows them."""
    return list(_core.option_names())
