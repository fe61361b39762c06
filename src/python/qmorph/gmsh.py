# SPDX-License-Identifier: GPL-2.0-or-later
"""The model of the Gmsh session that is open in this process, as `import gmsh` has it.

    gmsh.model.mesh.generate(2)
    qmorph.gmsh.recombine()

Gmsh serves one thread at a time; a progress callback must leave the session alone. Gmsh up to 4.10 handles Ctrl-C itself, by ending the
process: signal.signal(signal.SIGINT, signal.default_int_handler) after gmsh.initialize() gives it back to Python.
"""
from __future__ import annotations

import ctypes
import operator
import threading
from contextlib import contextmanager
from typing import Any, Iterable, Iterator, List

import gmsh as _gmsh  # the one of the session

from . import _session
from ._progress import Progress, callback_of
from .errors import UsageError
from .result import EvenReport, ModelReport, SurfaceReport

_in_use = threading.Lock()  # there is one session for the whole process

__all__ = ["improve_quads", "make_even", "measure_surfaces", "recombine"]


def recombine(surfaces: Iterable[int] = (), *, progress: Progress = None, **options: Any) -> ModelReport:
    """Turns the triangles of surfaces into quads, in place; of all surfaces if none is named.

    Line elements, curve nodes, groups, entities and other surfaces stay as they are. A surface that cannot be converted is left as
    it was, and is in ModelReport.left. Options: see help(qmorph); progress: see qmorph.convert().
    """
    with _session_of_ours(), callback_of(progress) as callback:
        return _model_report(_session.recombine(_tags(surfaces, 2), options, callback))


def improve_quads(surfaces: Iterable[int] = (), *, progress: Progress = None, **options: Any) -> ModelReport:
    """Improves surfaces that consist of quads already, or of quads and triangles. Arguments are those of recombine()."""
    with _session_of_ours(), callback_of(progress) as callback:
        return _model_report(_session.improve_quads(_tags(surfaces, 2), options, callback))


def measure_surfaces(surfaces: Iterable[int] = ()) -> ModelReport:
    """Figures of surfaces as they are; changes nothing."""
    with _session_of_ours():
        return _model_report(_session.measure_surfaces(_tags(surfaces, 2)))


def make_even(surfaces: Iterable[int] = (), keep_curves: Iterable[int] = ()) -> EvenReport:
    """Splits edges of curves so that every region has an even number of sides; recombine() then leaves no triangle."""
    with _session_of_ours():
        return EvenReport(**_session.make_even(_tags(surfaces, 2), _tags(keep_curves, 1)))


def _model_report(report: dict) -> ModelReport:
    surfaces = [SurfaceReport(**surface) for surface in report.pop("surfaces")]
    if not surfaces:
        report["warnings"].append("no surface has elements; call gmsh.model.mesh.generate(2) first")
    return ModelReport(surfaces=surfaces, **report)


def _tags(entities: Iterable[Any], dim: int) -> List[int]:
    """Tags from tags, or from Gmsh's pairs of dimension and tag."""
    kind = {1: "curves", 2: "surfaces"}[dim]
    try:
        pairs = [entity if isinstance(entity, (tuple, list)) else (dim, entity) for entity in entities]
        tags = [operator.index(tag) for of, tag in pairs if of == dim]
    except (TypeError, ValueError):
        raise UsageError(f"{kind}: a list of tags, or of (dimension, tag), is expected, not {entities!r}") from None
    if len(tags) != len(pairs):
        raise UsageError(f"{kind}: all of them must be of dimension {dim}")
    return tags


@contextmanager
def _session_of_ours() -> Iterator[None]:
    _require_session()
    if not _in_use.acquire(blocking=False):
        raise UsageError("the session is in use by another call of qmorph.gmsh; Gmsh serves one thread at a time")
    try:
        yield
    finally:
        _in_use.release()


def _require_session() -> None:
    theirs = ctypes.cast(_gmsh.lib.gmshInitialize, ctypes.c_void_p).value
    if theirs != _session.address_of_gmsh():
        raise UsageError(
            f"the gmsh module uses {_gmsh.lib._name}, another library than qmorph does, with a session of its own; "
            "use the module of the system's Gmsh (Debian: python3-gmsh)"
        )
    if not _is_initialized():
        raise UsageError("Gmsh has not been initialised: call gmsh.initialize() first")


def _is_initialized() -> bool:
    if hasattr(_gmsh, "isInitialized"):
        return bool(_gmsh.isInitialized())
    try:  # Gmsh 4.8 returns nothing before its first initialize(), and an error after finalize()
        return _gmsh.option.getString("General.Version") != ""
    except Exception:
        return False
