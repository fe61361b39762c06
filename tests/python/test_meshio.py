# SPDX-License-Identifier: GPL-2.0-or-later
"""import qmorph.meshio: meshes of meshio, with their data."""
import sys
import unittest

try:
    import meshio
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

import numpy as np
import qmorph
import qmorph.meshio
from test_arrays import rough


def two_materials():
    points, triangles = rough(20, 10)
    centres = points[triangles].mean(axis=1)
    material = (centres[:, 0] > 10).astype(int) + 1
    order = np.argsort(material, kind="stable")
    triangles, material, centres = triangles[order], material[order], centres[order]
    return meshio.Mesh(
        points,
        [("line", [[0, 1], [1, 2]]), ("triangle", triangles)],
        point_data={"height": points @ [2.0, 3.0], "number": np.arange(len(points))},
        cell_data={"material": [np.array([7, 7]), material], "y": [np.zeros(2), centres[:, 1]]},
        cell_sets={"upper": [np.array([], int), np.flatnonzero(centres[:, 1] > 5)]},
        field_data={"steel": np.array([1, 2])},
    )


class Meshio(unittest.TestCase):
    def test_cells_carry_the_data_of_the_triangles_under_them(self):
        before = two_materials()
        after = qmorph.meshio.convert(before)
        self.assertEqual([block.type for block in after.cells], ["line", "quad"])
        quads = after.cells[1].data
        centres = after.points[quads].mean(axis=1)
        self.assertEqual(set(after.cell_data["material"][1][centres[:, 0] > 10.5]), {2})
        self.assertEqual(set(after.cell_data["material"][1][centres[:, 0] < 9.5]), {1})
        np.testing.assert_array_equal(after.cell_data["material"][0], [7, 7])
        np.testing.assert_allclose(after.cell_data["y"][1], centres[:, 1], atol=1)
        upper = np.zeros(len(quads), bool)
        upper[after.cell_sets["upper"][1]] = True
        self.assertTrue(upper[centres[:, 1] > 5.8].all())
        self.assertFalse(upper[centres[:, 1] < 4.2].any())
        self.assertEqual(after.field_data, before.field_data)

    def test_point_data_is_interpolated(self):
        after = qmorph.meshio.convert(two_materials())
        np.testing.assert_allclose(after.point_data["height"], after.points[:, :2] @ [2.0, 3.0], atol=1e-9)
        self.assertEqual(after.point_data["number"].dtype.kind, "i")
        self.assertEqual(len(after.point_data["number"]), len(after.points))
        self.assertEqual(after.points.shape[1], 2)

    def test_its_quads_are_those_of_the_arrays(self):
        points, triangles = rough(9, 9)
        points[11] += 0.1
        mesh = qmorph.meshio.convert(meshio.Mesh(points, [("triangle", triangles)], point_data={"x": points[:, 0]}))
        arrays = qmorph.convert(points, triangles)
        self.assertEqual(
            qmorph.measure(mesh.points, mesh.cells[0].data)["scaled_jacobian_min"], arrays.quality["scaled_jacobian_min"])
        np.testing.assert_allclose(mesh.point_data["x"], mesh.points[:, 0], atol=1e-9)
        self.assertEqual(set(np.unique(mesh.cells[0].data)), set(range(len(mesh.points))))  # no loose node

    def test_numbers_of_cells_and_entities_around_them_part_nothing(self):
        points, triangles = rough(8, 8)
        mesh = meshio.Mesh(
            points, [("triangle", triangles)], cell_data={"id": [np.arange(len(triangles))]},
            cell_sets={"gmsh:bounding_entities": [np.array([1, -2, 3])]}, point_sets={"corner": np.array([0, 8])})
        after = qmorph.meshio.convert(mesh)
        self.assertEqual([block.type for block in after.cells], ["quad"])
        np.testing.assert_array_equal(after.cell_sets["gmsh:bounding_entities"][0], [1, -2, 3])
        np.testing.assert_array_equal(after.points[after.point_sets["corner"]], points[[0, 8]])

    def test_what_parts_regions_stays(self):
        before = two_materials()
        after = qmorph.meshio.convert(before)

        def edges(mesh, cells):  # by their places: nodes that are no longer used have been removed
            places = [tuple(point) for point in mesh.points]
            return {tuple(sorted((places[c[k]], places[c[k - 1]]))) for c in cells for k in range(len(c))}

        one, two = (edges(before, before.cells[1].data[before.cell_data["material"][1] == m]) for m in (1, 2))
        self.assertTrue(one & two and one & two <= edges(after, after.cells[1].data))

    def test_other_cells_are_refused(self):
        with self.assertRaisesRegex(qmorph.UsageError, "tetra"):
            qmorph.meshio.convert(meshio.Mesh(np.zeros((4, 3)), [("tetra", [[0, 1, 2, 3]])]))


if __name__ == "__main__":
    unittest.main()
