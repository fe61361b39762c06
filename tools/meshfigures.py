# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads a mesh file and measures its surfaces, for the scripts beside this file (draw, table).

Deliberately without a line of qmorph: what these scripts print and draw must not repeat an error of the library.
Needs Debian's python3-gmsh and python3-numpy.
"""
import os
import sys

try:
    import gmsh
    import numpy as np
except ImportError as missing:
    sys.exit(f"{missing}; tools/setup --scripts installs it")

# Gmsh element types by number of corners, with the nodes per element: only the corners are looked at.
TRIANGLES = {2: 3, 9: 6, 21: 10, 20: 9}
QUADS = {3: 4, 10: 9, 16: 8, 36: 16}
LINES = {1: 2, 8: 3, 26: 4}


_running = []  # gmsh.isInitialized() is not there before 4.9


def start_gmsh():
    if not _running:
        gmsh.initialize(["meshfigures"], False)
        _running.append(True)
    gmsh.option.setNumber("General.Terminal", 0)


def restart_gmsh():
    """With its options as they are by default: gmsh.clear() leaves those that a .geo has set."""
    gmsh.finalize()
    _running.clear()
    start_gmsh()


class Surface:
    """Triangles and quads of one surface entity, as rows of Mesh.points."""

    def __init__(self, triangles, quads, points):
        self.triangles, self.quads = triangles, quads
        areas = np.concatenate([np.cross(points[triangles[:, 1]] - points[triangles[:, 0]],
                                         points[triangles[:, 2]] - points[triangles[:, 0]]),
                                np.cross(points[quads[:, 2]] - points[quads[:, 0]],
                                         points[quads[:, 3]] - points[quads[:, 1]])]) / 2
        lengths = np.linalg.norm(areas, axis=1)
        total = areas.sum(0)
        self.vector_area = total
        self.planar = np.linalg.norm(total) > (1 - 1e-9) * lengths.sum()
        # A planar surface has one normal, so a folded element counts as inverted; a curved one is measured
        # against each element's own normal.
        normals = np.tile(total, (len(areas), 1)) if self.planar else areas
        normals = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
        n_tri = len(triangles)
        self.triangle_jacobians = scaled_jacobians(points[triangles], normals[:n_tri])
        self.quad_jacobians = scaled_jacobians(points[quads], normals[n_tri:])
        self.thesis_metrics = thesis_metrics(points[quads], normals[n_tri:])

        edges = np.sort(np.concatenate([element_edges(triangles), element_edges(quads)]), axis=1)
        self.edges, uses = np.unique(edges, axis=0, return_counts=True)
        self.boundary_edges, self.inner_edges = self.edges[uses == 1], self.edges[uses > 1]
        nodes, valence = np.unique(self.edges, return_counts=True)
        interior = ~np.isin(nodes, self.boundary_edges)
        self.interior_nodes, self.valence = nodes[interior], valence[interior]


class Mesh:
    """Corner nodes, surfaces, line and point elements of a file that Gmsh can read."""

    def __init__(self, path):
        if not os.path.isfile(path):
            sys.exit(f"{path}: no such file")  # gmsh.open() is silent about it before 4.12
        start_gmsh()
        gmsh.clear()
        gmsh.open(path)
        self._from_current_model()

    @classmethod
    def of_current_model(cls):
        """The mesh that the running Gmsh session has."""
        mesh = cls.__new__(cls)
        mesh._from_current_model()
        return mesh

    def _from_current_model(self):
        tags, xyz, _ = gmsh.model.mesh.getNodes()
        order = np.argsort(tags)
        tags = np.asarray(tags, dtype=np.int64)[order]
        self.points = np.asarray(xyz).reshape(-1, 3)[order]
        kinds = {**{t: 3 for t in TRIANGLES}, **{t: 4 for t in QUADS}, **{t: 2 for t in LINES}, 15: 1}
        sizes = {**TRIANGLES, **QUADS, **LINES, 15: 1}
        self.surfaces, lines, dots = {}, [], []
        for dim, tag in gmsh.model.getEntities():
            rows = {1: [], 2: [], 3: [], 4: []}
            if dim < 3:
                for kind, _, conn in zip(*gmsh.model.mesh.getElements(dim, tag)):
                    if kind in kinds:
                        conn = np.searchsorted(tags, np.asarray(conn, dtype=np.int64)).reshape(-1, sizes[kind])
                        rows[kinds[kind]].append(conn[:, :kinds[kind]])
            rows = {k: np.concatenate(v) if v else np.zeros((0, k), dtype=np.int64) for k, v in rows.items()}
            dots.append(rows[1])
            lines.append(rows[2])
            if len(rows[3]) or len(rows[4]):
                self.surfaces[tag] = Surface(rows[3], rows[4], self.points)
        none = [np.zeros((0, 2), dtype=np.int64)]
        self.lines = np.concatenate(lines or none)
        self.dots = np.concatenate(dots or [none[0][:, :1]])

    def figures(self):
        """The figures of one table row, all surfaces together."""
        surfaces = list(self.surfaces.values())
        jacobians = np.concatenate([s.quad_jacobians for s in surfaces] or [np.zeros(0)])
        thesis = np.concatenate([s.thesis_metrics for s in surfaces] or [np.zeros(0)])
        valence = np.concatenate([s.valence for s in surfaces] or [np.zeros(0)])
        triangles = sum(len(s.triangles) for s in surfaces)
        # A line element on a surface that is no edge of its elements: elements were merged across it.
        nodes = [set(np.unique(s.edges)) for s in surfaces]
        edges = set(map(tuple, np.concatenate([s.edges for s in surfaces]).tolist())) if surfaces else set()
        lost = sum(1 for a, b in np.sort(self.lines, axis=1).tolist()
                   if (a, b) not in edges and any(a in n and b in n for n in nodes))
        inverted = int((jacobians <= 0).sum()) + sum(int((s.triangle_jacobians <= 0).sum()) for s in surfaces)
        return {"quads": len(jacobians), "triangles": triangles, "inverted": inverted, "lines_lost": lost,
                "sj_min": float(jacobians.min()) if len(jacobians) else float("nan"),
                "sj_mean": float(jacobians.mean()) if len(jacobians) else float("nan"),
                "thesis_min": float(thesis.min()) if len(thesis) else float("nan"),
                "thesis_mean": float(thesis.mean()) if len(thesis) else float("nan"),
                "interior": len(valence), "irregular": float((valence != 4).mean()) if len(valence) else 0.0}


def size_ratio(before, after, neighbours=12, samples=2000):
    """How long the quads are: the median, over inner edges of `after` (evenly spread, at most `samples`), of their length
    over the median length of the `neighbours` edges of `before` whose middles are nearest."""
    def middles_and_lengths(mesh, edges):
        a, b = (mesh.points[edges[:, i]] for i in (0, 1))
        return (a + b) / 2, np.linalg.norm(b - a, axis=1)

    theirs = np.concatenate([s.edges for s in before.surfaces.values()])
    ours = np.concatenate([s.inner_edges for s in after.surfaces.values()])
    ours = ours[::max(1, -(-len(ours) // samples))]
    middles, lengths = middles_and_lengths(before, theirs)
    ratios = []
    for middle, length in zip(*middles_and_lengths(after, ours)):
        distances = ((middles - middle) ** 2).sum(1)
        nearest = np.argpartition(distances, min(neighbours, len(distances)) - 1)[:neighbours]
        ratios.append(length / np.median(lengths[nearest]))
    return float(np.median(ratios)) if ratios else float("nan")


def element_edges(elements):
    return np.stack([elements, np.roll(elements, -1, axis=1)], axis=2).reshape(-1, 2)


def scaled_jacobians(corners, normals):
    """Smallest signed sine of the corner angles (Verdict manual, "scaled Jacobian"); corners is (n, k, 3)."""
    if not len(corners):
        return np.zeros(0)
    ahead = np.roll(corners, -1, axis=1) - corners
    behind = np.roll(corners, 1, axis=1) - corners
    cross = np.einsum("nki,ni->nk", np.cross(ahead, behind), normals)
    lengths = np.linalg.norm(ahead, axis=2) * np.linalg.norm(behind, axis=2)
    return (cross / np.maximum(lengths, 1e-300)).min(axis=1)


def thesis_metrics(corners, normals):
    """The quads' metric of the Q-Morph thesis, eq. 2.2: the smallest value of 8 area / (sum of squared sides) over the
    four triangles that the diagonals make; less 1 if two are inverted or a corner is under 6 degrees, less 2 for three,
    less 3 for four inverted. 1 for a square."""
    if not len(corners):
        return np.zeros(0)
    halves = []
    for a, b, c in ((0, 1, 2), (0, 2, 3), (0, 1, 3), (1, 2, 3)):
        p, q, r = corners[:, a], corners[:, b], corners[:, c]
        twice_area = np.einsum("ni,ni->n", np.cross(q - p, r - p), normals)
        squares = sum(((u - v) ** 2).sum(1) for u, v in ((p, q), (q, r), (r, p)))
        halves.append(4 * twice_area / np.maximum(squares, 1e-300))
    halves = np.stack(halves)
    inverted = (halves < 0).sum(0)
    ahead = np.roll(corners, -1, axis=1) - corners
    behind = np.roll(corners, 1, axis=1) - corners
    sines = np.einsum("nki,ni->nk", np.cross(ahead, behind), normals)
    angles = np.degrees(np.arctan2(sines, (ahead * behind).sum(2))) % 360
    sharp = angles.min(1) < 6
    penalty = np.where(inverted >= 2, inverted - 1, np.where(sharp, 1, 0))
    return halves.min(0) - penalty
