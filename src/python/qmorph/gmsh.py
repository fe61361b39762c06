# SPDX-License-Identifier: GPL-2.0-or-later
"""The model of the Gmsh session that is open in this process, as `import gmsh` has it.

    gmsh.model.mesh.generate(2)
    qmorph.gmsh.recombine()
"""
from __future__ import annotations

import ctypes
from typing import Any, Sequence

import gmsh as _gmsh  # the one of the session

from . import _session
from ._progress import Progress, callback_of
from .errors import UsageError
from .result import EvenReport, ModelReport, SurfaceReport

__all__ = ["improve_quads", "make_even", "measure_surfaces", "recombine"]


def recombine(surfaces: Sequence[int] = (), *, progress: Progress = None, **options: Any) -> ModelReport:
    """Turns the triangles of surfaces into quads, in place; all surfaces if none is named.

    Line elements, curve nodes, groups, entities and other surfaces stay as they are. A surface that cannot be converted is left as
    it was: ModelReport.left. Options: see help(qmorph); progress: see qmorph.convert().
    """
    _require_session()
    with callback_of(progress) as callback:
        return _model_report(_session.recombine(list(surfaces), options, callback))


def improve_quads(surfaces: Sequence[int] = (), *, progress: Progress = None, **options: Any) -> ModelReport:
    """The same for surfaces that consist of quads already, or of quads and triangles: better ones."""
    _require_session()
    with callback_of(progress) as callback:
        return _model_report(_session.improve_quads(list(surfaces), options, callback))


def measure_surfaces(surfaces: Sequence[int] = ()) -> ModelReport:
    """Figures of surfaces as they are; nothing changes."""
    _require_session()
    return _model_report(_session.measure_surfaces(list(surfaces)))


def make_even(surfaces: Sequence[int] = (), keep_curves: Sequence[int] = ()) -> EvenReport:
    """Splits edges of curves so that every region gets an even number of sides: recombine() leaves no triangle then."""
    _require_session()
    return EvenReport(**_session.make_even(list(surfaces), list(keep_curves)))


def _model_report(report: dict) -> ModelReport:
    surfaces = [SurfaceReport(**surface) for surface in report.pop("surfaces")]
    return ModelReport(surfaces=surfaces, **report)


def _require_session() -> None:
    theirs = ctypes.cast(_gmsh.lib.gmshInitialize, ctypes.c_void_p).value
    if theirs != _session.address_of_gmsh():
        raise UsageError(
            f"the gmsh module uses {_gmsh.lib._name}, another library than qmorph: two sessions that do not see each other; "
            "use the module of the system's Gmsh (Debian: python3-gmsh)"
        )
    try:
        _gmsh.option.getNumber("General.Verbosity")
    except Exception:  # Gmsh 4.8 has no isInitialized()
        raise UsageError("Gmsh has not been initialised: gmsh.initialize()") from None
