# SPDX-License-Identifier: GPL-2.0-or-later
"""meshio.Mesh in and out, with its data."""
from __future__ import annotations

from typing import Any, Dict, List, Tuple

import meshio as _meshio
import numpy as np

from . import _core
from . import convert as _convert
from ._progress import Progress
from .errors import UsageError

__all__ = ["convert"]

# meshio keeps this among the cell sets, though its numbers are not those of cells but tags of bounding entities.
_NO_SETS = ("gmsh:bounding_entities",)


def convert(mesh: "_meshio.Mesh", *, progress: Progress = None, **options: Any) -> "_meshio.Mesh":
    """Returns the mesh with quads instead of its triangles.

    Triangles that differ in a cell set, or in integer cell data (gmsh:physical, ...), belong to different regions, and the edges
    between regions stay; data that gives each triangle a number of its own is ignored for this. Lines and vertices of the mesh are
    kept, too. Point data is interpolated on the triangles; a quad gets the cell data of the triangle under its centre. Points that no
    cell uses any more are removed. Meshes with cells of volumes or of higher order are refused.
    Arguments, options and errors are those of qmorph.convert().
    """
    return _Conversion(mesh).run(progress, options)


class _Conversion:
    def __init__(self, mesh: "_meshio.Mesh") -> None:
        self.mesh = mesh
        kinds = {block.type for block in mesh.cells}
        foreign = kinds - {"triangle", "quad", "line", "vertex"}
        if foreign:
            raise UsageError(
                f"cells of type {', '.join(sorted(foreign))}: only triangles, quads, lines and vertices can be converted")
        self.points = np.asarray(mesh.points, dtype=float)
        self.blocks = [b for b, block in enumerate(mesh.cells) if block.type == "triangle"]
        self.triangles = np.vstack([np.empty((0, 3), int)] + [mesh.cells[b].data for b in self.blocks])

    def run(self, progress: Progress, options: Dict[str, Any]) -> "_meshio.Mesh":
        labels, count = self._labels()
        points, origins = [_in_space(self.points)], [np.empty((0, 3))]
        parents: List[Tuple[np.ndarray, np.ndarray, np.ndarray]] = []  # quads, triangles, their triangles
        total = len(self.points)
        for label in range(count):
            rows = np.flatnonzero(labels == label)
            result = _convert(
                self.points, self.triangles[rows], constraints=self._lines_on(self.triangles[rows]), fixed=self._rows("vertex"),
                progress=progress, **options)
            number = result.source.astype(np.int64)
            new = number < 0
            number[new] = total + np.arange(np.count_nonzero(new))
            total += np.count_nonzero(new)
            points.append(result.points[new])
            elements = [number[result.quads], number[result.triangles]]
            centres = np.vstack([result.points[result.quads].mean(axis=1), result.points[result.triangles].mean(axis=1)])
            parents.append((elements[0], elements[1], rows[_core.locate(centres, self.points, self.triangles[rows])]))
            origins.append(result.points[new])
        return self._write(np.vstack(points), np.vstack(origins), parents)

    def _rows(self, kind: str) -> Any:
        rows = [block.data for block in self.mesh.cells if block.type == kind]
        if not rows:
            return None
        return np.vstack(rows) if kind == "line" else np.vstack(rows).ravel()

    def _lines_on(self, triangles: np.ndarray) -> Any:
        """Lines that are edges of these triangles."""
        lines = self._rows("line")
        if lines is None:
            return None
        edges = np.sort(np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
        count = len(self.points)
        on = np.isin(np.sort(lines, axis=1) @ [count, 1], edges @ [count, 1])
        return lines[on]

    def _labels(self) -> Tuple[np.ndarray, int]:
        """The region of each triangle, and how many there are; regions are numbered in the order of their first triangles."""
        columns = [np.concatenate([np.full(len(self.mesh.cells[b].data), b) for b in self.blocks] or [np.empty(0, int)])]
        for data in self.mesh.cell_data.values():
            values = self._of_triangles(data)
            if values is not None and values.dtype.kind in "iub" and not _is_numbering(values):
                columns += list(values.reshape(len(values), -1).T)
        for name, members in self.mesh.cell_sets.items():
            if name in _NO_SETS:
                continue
            inside = [np.zeros(len(self.mesh.cells[b].data), int) for b in self.blocks]
            for k, b in enumerate(self.blocks):
                if members[b] is not None:
                    inside[k][np.asarray(members[b], dtype=int)] = 1
            columns.append(np.concatenate(inside) if inside else np.empty(0, int))
        table = np.column_stack(columns)
        _, first, inverse = np.unique(table, axis=0, return_index=True, return_inverse=True)
        order = np.argsort(np.argsort(first))
        return order[inverse.ravel()] if len(first) else np.empty(0, int), len(first)

    def _of_triangles(self, data: List[Any]) -> Any:
        values = [np.asarray(data[b]) for b in self.blocks]
        return np.concatenate(values) if values else None

    def _write(self, points: np.ndarray, new: np.ndarray, parents: Any) -> "_meshio.Mesh":
        block_of = np.concatenate([np.full(len(self.mesh.cells[b].data), k) for k, b in enumerate(self.blocks)] or [np.empty(0, int)])
        cells: List[Tuple[str, np.ndarray]] = []
        rows: List[Tuple[int, Any]] = []  # for each new block: the old one, and rows among all triangles
        for b, block in enumerate(self.mesh.cells):
            if block.type != "triangle":
                cells.append((block.type, block.data))
                rows.append((b, None))
                continue
            k = self.blocks.index(b)
            quads, quad_rows, left, left_rows = [], [], [], []
            for q, t, parent in parents:
                mine = block_of[parent] == k
                quads.append(q[mine[: len(q)]])
                quad_rows.append(parent[: len(q)][mine[: len(q)]])
                left.append(t[mine[len(q):]])
                left_rows.append(parent[len(q):][mine[len(q):]])
            for kind, parts, part_rows in (("quad", quads, quad_rows), ("triangle", left, left_rows)):
                elements = np.vstack(parts) if parts else np.empty((0, 4), int)
                if len(elements) or kind == "quad":
                    cells.append((kind, elements))
                    rows.append((b, np.concatenate(part_rows) if part_rows else np.empty(0, int)))
        stays = np.ones(len(points), bool)
        stays[self.triangles.ravel()] = False
        for _, nodes in cells:
            stays[np.asarray(nodes, dtype=int).ravel()] = True
        number = np.cumsum(stays) - 1
        points = points[stays]
        return _meshio.Mesh(
            points if self.mesh.points.shape[1] == 3 else points[:, :2],
            [(kind, number[np.asarray(nodes, dtype=int)]) for kind, nodes in cells],
            point_data={name: values[stays] for name, values in self._point_data(new).items()},
            cell_data=self._cell_data(rows),
            cell_sets=self._cell_sets(rows),
            point_sets={name: number[nodes[stays[nodes]]] for name, nodes in self._point_sets()},
            field_data=self.mesh.field_data,
        )

    def _point_sets(self) -> List[Tuple[str, np.ndarray]]:
        return [(name, np.asarray(nodes, dtype=int)) for name, nodes in self.mesh.point_sets.items()]

    def _point_data(self, new: np.ndarray) -> Dict[str, np.ndarray]:
        if not self.mesh.point_data:
            return {}
        corners = self.triangles[_core.locate(new, self.points, self.triangles)] if len(new) else np.empty((0, 3), int)
        weights = _barycentric(new, _in_space(self.points)[corners])
        data = {}
        for name, values in self.mesh.point_data.items():
            values = np.asarray(values)
            if values.dtype.kind in "iub":  # integers are labels: no means
                added = values[corners[np.arange(len(corners)), weights.argmax(axis=1)]] if len(corners) else values[:0]
            else:
                added = np.einsum("ij,ij...->i...", weights, values[corners])
            data[name] = np.concatenate([values, added.astype(values.dtype)])
        return data

    def _cell_data(self, rows: Any) -> Dict[str, List[np.ndarray]]:
        return {
            name: [
                np.asarray(data[b]) if chosen is None else self._of_triangles(data)[chosen] for b, chosen in rows
            ]
            for name, data in self.mesh.cell_data.items()
        }

    def _cell_sets(self, rows: Any) -> Dict[str, List[np.ndarray]]:
        starts = dict(zip(self.blocks, np.cumsum([0] + [len(self.mesh.cells[b].data) for b in self.blocks])))
        sets = {}
        for name, members in self.mesh.cell_sets.items():
            if name in _NO_SETS:
                sets[name] = [members[b] for b, _ in rows]
                continue
            lists = []
            for b, chosen in rows:
                old = np.asarray(members[b] if members[b] is not None else [], dtype=int)
                lists.append(old if chosen is None else np.flatnonzero(np.isin(chosen - starts[b], old)))
            sets[name] = lists
        return sets


def _is_numbering(values: np.ndarray) -> bool:
    """Whether each row has a value of its own."""
    return len(values) > 1 and len(np.unique(values, axis=0)) == len(values)


def _in_space(points: np.ndarray) -> np.ndarray:
    return points if points.shape[1] == 3 else np.column_stack([points, np.zeros(len(points))])


def _barycentric(places: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Weights of the triangles' corners at the points of their planes that are nearest to the places; none below 0."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    u, v, w = b - a, c - a, places - a
    uu, uv, vv = (u * u).sum(1), (u * v).sum(1), (v * v).sum(1)
    wu, wv = (w * u).sum(1), (w * v).sum(1)
    area = np.maximum(uu * vv - uv * uv, np.finfo(float).tiny)
    s, t = (vv * wu - uv * wv) / area, (uu * wv - uv * wu) / area
    weights = np.clip(np.column_stack([1 - s - t, s, t]), 0, None)
    return weights / weights.sum(axis=1, keepdims=True)
