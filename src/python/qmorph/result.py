# SPDX-License-Identifier: GPL-2.0-or-later
"""What a conversion returns."""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Dict, List

import numpy as np

_LARGEST_PICTURE = 20_000  # quads; beyond that a browser gets slow


@dataclass(frozen=True, repr=False, eq=False)
class Mesh:
    """A surface in quads.

    points: floats, three columns even if the input has two; points that no element uses are left out
    quads, triangles: node numbers from 0, four and three columns, oriented like the input
    source: for each point its row among the input's points if it is where it was there, -1 if it is new or has moved
    quality: figures by name ("scaled_jacobian_min", "irregular_share", ...)
    report: what was done ("regions", "layer_quads", "front_seconds", ...)
    """

    points: np.ndarray
    quads: np.ndarray
    triangles: np.ndarray
    source: np.ndarray
    quality: Dict[str, Any] = field(default_factory=dict)
    report: Dict[str, Any] = field(default_factory=dict)

    def __repr__(self) -> str:
        return (
            f"<qmorph.Mesh: {len(self.quads)} quads, {len(self.triangles)} triangles; scaled Jacobian "
            f"min {self.quality['scaled_jacobian_min']:.3f} mean {self.quality['scaled_jacobian_mean']:.3f}; "
            f"irregular {100 * self.quality['irregular_share']:.1f} %>"
        )

    def _repr_svg_(self) -> str:
        """The mesh, seen against its mean normal; notebooks show it."""
        elements = list(self.quads[:_LARGEST_PICTURE]) + list(self.triangles[:_LARGEST_PICTURE])
        seen = self.points @ _view(self.points, self.quads, self.triangles).T
        low, high = (seen.min(axis=0), seen.max(axis=0)) if len(seen) else (np.zeros(2), np.ones(2))
        width = 600.0
        scale = width / max(high[0] - low[0], (high[1] - low[1]) / 2, 1e-300)
        height = max(scale * (high[1] - low[1]), 1.0)
        places = np.column_stack([scale * (seen[:, 0] - low[0]), height - scale * (seen[:, 1] - low[1])])
        paths = "".join(
            "M" + "L".join(f"{places[v, 0]:.1f} {places[v, 1]:.1f}" for v in element) + "Z" for element in elements
        )
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-1 -1 {width + 2:.0f} {height + 2:.0f}" width="{width:.0f}">'
            f'<path d="{paths}" fill="#dbe9f6" stroke="#08306b" stroke-width="0.5" stroke-linejoin="round"/></svg>'
        )


def _view(points: np.ndarray, quads: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Two unit vectors, to the right and up, seen from where most elements show their front."""
    normal = np.zeros(3)
    if len(quads):
        normal += np.cross(points[quads[:, 2]] - points[quads[:, 0]], points[quads[:, 3]] - points[quads[:, 1]]).sum(axis=0)
    if len(triangles):
        a, b, c = (points[triangles[:, k]] for k in range(3))
        normal += np.cross(b - a, c - a).sum(axis=0)
    length = np.linalg.norm(normal)
    if length == 0:
        normal, length = np.array([0.0, 0.0, 1.0]), 1.0
    normal = normal / length
    if abs(normal[2]) > 1 - 1e-9:  # as drawn on paper
        return np.array([[1.0, 0, 0], [0, 1.0, 0]])
    right = np.cross([0.0, 0.0, 1.0], normal)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(normal, right)])


@dataclass(frozen=True)
class SurfaceReport:
    """What became of a surface of a Gmsh model.

    outcome: "converted", "already_quads", or "left" (unchanged; `reason` says why)
    """

    tag: int
    name: str
    outcome: str
    reason: str
    warnings: List[str]
    triangles_in: int
    quads_in: int
    triangles_out: int
    quads_out: int
    quality: Dict[str, Any]
    report: Dict[str, Any]
    image_of: int
    seconds: float


@dataclass(frozen=True, repr=False)
class ModelReport:
    """What became of a Gmsh model: its surfaces by tag, and figures of all of them together."""

    surfaces: List[SurfaceReport]
    warnings: List[str]
    quality: Dict[str, Any]

    def __repr__(self) -> str:
        quads = sum(surface.quads_out for surface in self.surfaces)
        triangles = sum(surface.triangles_out for surface in self.surfaces)
        return f"<qmorph.ModelReport: {len(self.surfaces)} surfaces, {quads} quads, {triangles} triangles, {len(self.left)} left>"

    @property
    def left(self) -> List[SurfaceReport]:
        """Surfaces that could not be converted and are as they were."""
        return [surface for surface in self.surfaces if surface.outcome == "left"]


@dataclass(frozen=True)
class EvenReport:
    """What make_even() did: how many regions were odd, which edges were split, which surfaces stay odd."""

    odd_regions: int
    splits: List[Dict[str, Any]]
    odd_surfaces: List[int]
