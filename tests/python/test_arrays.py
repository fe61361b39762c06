# SPDX-License-Identifier: GPL-2.0-or-later
"""import qmorph: arrays in and out."""
import os
import pickle
import resource
import signal
import subprocess
import sys
import threading
import time
import unittest
import xml.dom.minidom

import numpy as np
import qmorph


def plate(columns, rows):
    """Points and triangles of a rectangle, two in each square, alternating."""
    x, y = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0))
    points = np.column_stack([x.ravel(), y.ravel()])
    i, j = np.meshgrid(np.arange(columns), np.arange(rows))
    a = (j * (columns + 1) + i).ravel()
    b, c, d = a + 1, a + columns + 2, a + columns + 1
    odd = ((i + j) % 2).ravel()[:, None]
    one = np.where(odd, np.column_stack([a, b, c]), np.column_stack([a, b, d]))
    two = np.where(odd, np.column_stack([a, c, d]), np.column_stack([b, c, d]))
    return points, np.vstack([one, two])


def rough(columns, rows):
    """A plate whose triangles are not halves of squares."""
    points, triangles = plate(columns, rows)
    inner = (points[:, 0] > 0) & (points[:, 0] < columns) & (points[:, 1] > 0) & (points[:, 1] < rows)
    points[inner] += np.random.default_rng(1).uniform(-0.2, 0.2, points.shape)[inner]
    return points, triangles


class Convert(unittest.TestCase):
    def test_a_square_of_two_triangles_is_a_quad(self):
        mesh = qmorph.convert([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
        self.assertEqual(mesh.quads.shape, (1, 4))
        self.assertEqual(sorted(mesh.quads[0]), [0, 1, 2, 3])
        self.assertEqual(mesh.triangles.shape, (0, 3))
        self.assertEqual(mesh.points.shape, (4, 3))
        self.assertEqual(mesh.quality["scaled_jacobian_min"], 1)

    def test_arrays_of_any_layout_and_type_give_the_same(self):
        points, triangles = rough(20, 10)
        mesh = qmorph.convert(points, triangles)
        for p, t in (
            (np.asfortranarray(points), np.asfortranarray(triangles)),
            (np.column_stack([points, 0 * points[:, 0]]), triangles.astype(np.uint32)),
            (points.tolist(), triangles.tolist()),
            (np.repeat(points, 2, axis=0)[::2], triangles.astype(np.int16)),
        ):
            other = qmorph.convert(p, t)
            np.testing.assert_array_equal(mesh.points, other.points)
            np.testing.assert_array_equal(mesh.quads, other.quads)

    def test_results_outlive_what_they_came_from(self):
        points = qmorph.convert(*rough(20, 10)).points
        copy = points.copy()
        for _ in range(5):
            qmorph.convert(*rough(20, 10))
        np.testing.assert_array_equal(points, copy)

    def test_kept_nodes_have_the_coordinates_of_the_input(self):
        points, triangles = rough(20, 10)
        mesh = qmorph.convert(points, triangles, fixed=[25, 50], constraints=[[30, 31]])
        self.assertTrue({25, 50, 30, 31} <= set(mesh.source))
        boundary = (points[:, 0] == 0) | (points[:, 0] == 20) | (points[:, 1] == 0) | (points[:, 1] == 10)
        kept = np.flatnonzero(boundary[mesh.source.clip(0)] & (mesh.source >= 0))
        self.assertEqual(len(kept), boundary.sum())
        np.testing.assert_array_equal(mesh.points[kept, :2], points[mesh.source[kept]])

    def test_a_point_with_a_source_is_where_it_was(self):
        points, triangles = rough(20, 20)
        mesh = qmorph.convert(points, triangles)
        kept = mesh.source >= 0
        self.assertTrue(kept.any() and not kept.all())
        np.testing.assert_array_equal(mesh.points[kept, :2], points[mesh.source[kept]])

    def test_quads_that_are_there_stay(self):
        points, triangles = plate(4, 2)
        points = np.vstack([points, [[5, 0], [5, 1]]])
        mesh = qmorph.convert(points, triangles, quads=[[4, 15, 16, 9]])
        self.assertEqual(list(mesh.source[mesh.quads[0]]), [4, 15, 16, 9])

    def test_improve_takes_quads(self):
        points, triangles = rough(20, 10)
        mesh = qmorph.convert(points, triangles)
        better = qmorph.improve(mesh.points, mesh.quads)
        self.assertGreaterEqual(better.quality["scaled_jacobian_mean"], mesh.quality["scaled_jacobian_mean"] - 1e-9)

    def test_measure_gives_the_figures_of_the_result(self):
        mesh = qmorph.convert(*rough(20, 10))
        figures = qmorph.measure(mesh.points, mesh.quads)
        self.assertAlmostEqual(figures["scaled_jacobian_min"], mesh.quality["scaled_jacobian_min"], 12)
        self.assertEqual(len(figures["scaled_jacobians"]), len(mesh.quads))
        self.assertAlmostEqual(figures["scaled_jacobians"].min(), figures["scaled_jacobian_min"], 12)

    def test_a_notebook_gets_a_picture(self):
        mesh = qmorph.convert(*rough(6, 4))
        picture = xml.dom.minidom.parseString(mesh._repr_svg_())
        path = picture.getElementsByTagName("path")[0].getAttribute("d")
        self.assertEqual(path.count("Z"), len(mesh.quads))
        self.assertIn(f"{len(mesh.quads)} quads", repr(mesh))


class Options(unittest.TestCase):
    def test_they_have_the_names_of_the_command(self):
        points, triangles = rough(20, 10)
        plain = qmorph.convert(points, triangles)
        for options in ({"cleanup_pattern_rounds": 0}, {"cleanup.pattern_rounds": 0}, {"MAXITER": 3}, {"layers": False}):
            self.assertEqual(len(qmorph.convert(points, triangles, **options).triangles), len(plain.triangles))
        self.assertIn("cleanup.pattern_rounds", qmorph.option_names())

    def test_another_smoothing_moves_nodes(self):
        points, triangles = rough(20, 10)
        one, two = (qmorph.convert(points, triangles, smoothing=name) for name in ("shape_energy", "thesis"))
        self.assertFalse(np.array_equal(one.points, two.points))

    def test_threads_change_nothing(self):
        points, triangles = rough(60, 40)
        one, two = (qmorph.convert(points, triangles, threads=n) for n in (1, 2))
        np.testing.assert_array_equal(one.points, two.points)
        np.testing.assert_array_equal(one.quads, two.quads)


class Errors(unittest.TestCase):
    def test_arguments_that_make_no_sense(self):
        points, triangles = plate(3, 3)
        for arguments, options in (
            ((points[:, :1], triangles), {}),
            ((points.ravel(), triangles), {}),
            ((None, triangles), {}),
            (("points", triangles), {}),
            ((points * 1j, triangles), {}),
            ((points, triangles[:, :2]), {}),
            ((points, triangles.astype(float)), {}),
            ((points, -triangles), {}),
            ((points, triangles), {"fixed": [99]}),
            ((points, triangles), {"fixed": [[1, 2]]}),
            ((points, triangles), {"constraints": [[0, 99]]}),
            ((points, triangles), {"constraints": [[0, 15]]}),  # no edge of the mesh
            ((points, triangles), {"threads": 1.5}),
            ((points, triangles), {"no_such_option": 1}),
            ((points, triangles), {"layers": "yes"}),
            ((points, triangles), {"MAXITER": -1}),
            ((points, triangles), {"threads": -1}),
            ((points, triangles), {"smoothing": "none"}),
        ):
            with self.subTest(options=options), self.assertRaises(qmorph.UsageError) as caught:
                qmorph.convert(*arguments, **options)
            self.assertIsInstance(caught.exception, (qmorph.Error, ValueError))

    def test_a_node_that_there_is_not(self):
        points, triangles = plate(3, 3)
        with self.assertRaises(qmorph.Error):
            qmorph.convert(points, triangles + 99)
        with self.assertRaises(qmorph.Error):
            qmorph.measure(points, triangles[:, [0, 1, 2, 2]] + 99)

    def test_a_bad_surface_is_named_with_its_place(self):
        points, triangles = plate(3, 3)
        points[5] = np.nan
        with self.assertRaises(qmorph.SurfaceError) as caught:
            qmorph.convert(points, triangles)
        self.assertEqual(caught.exception.kind, "not_finite")
        self.assertEqual(caught.exception.subject, ("node", 5))
        copy = pickle.loads(pickle.dumps(caught.exception))
        self.assertEqual((str(copy), copy.kind), (str(caught.exception), "not_finite"))

    def test_nothing_gives_nothing(self):
        mesh = qmorph.convert(np.empty((0, 2)), np.empty((0, 3), int))
        self.assertEqual(len(mesh.quads), 0)
        self.assertTrue(mesh._repr_svg_())


class Work(unittest.TestCase):
    LARGE = rough(500, 300)  # half a second and more

    def test_progress_rises_to_one(self):
        shares = []
        qmorph.convert(*self.LARGE, progress=lambda stage, share: shares.append((stage, share)))
        self.assertEqual(shares[-1][1], 1)
        self.assertEqual([s for _, s in shares], sorted({s for _, s in shares}))

    def test_progress_can_end_it(self):
        with self.assertRaises(qmorph.Cancelled):
            qmorph.convert(*self.LARGE, progress=lambda stage, share: False)

    def test_a_false_of_numpy_ends_it_and_other_results_do_not(self):
        with self.assertRaises(qmorph.Cancelled):
            qmorph.convert(*self.LARGE, progress=lambda stage, share: np.bool_(False))
        self.assertTrue(len(qmorph.convert(*self.LARGE, progress=lambda stage, share: 0).quads))

    def test_a_thread_of_a_process_that_ends_does_no_harm(self):
        program = (
            "import sys, threading, time; sys.path[:0] = %r\n"
            "import qmorph\n"
            "from test_arrays import rough\n"
            "mesh = rough(500, 500)\n"
            "threading.Thread(target=lambda: qmorph.convert(*mesh), daemon=True).start()\n"
            "time.sleep(0.2)\n" % [os.path.dirname(os.path.abspath(__file__))] )
        ran = subprocess.run([sys.executable, "-c", program], stderr=subprocess.PIPE, text=True)
        self.assertEqual((ran.returncode, ran.stderr), (0, ""))

    def test_what_progress_raises_comes_out(self):
        def fail(stage, share):
            raise KeyError("mine")

        with self.assertRaisesRegex(KeyError, "mine"):
            qmorph.convert(*self.LARGE, progress=fail)

    def test_interrupts_end_it(self):
        timer = threading.Timer(0.15, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            qmorph.convert(*rough(1000, 500))
            time.sleep(1)  # in case the machine was faster than the timer
        timer.join()

    def test_other_threads_run_meanwhile_and_convert_at_once(self):
        expected = qmorph.convert(*self.LARGE)
        results = [None] * 2

        def work(k):
            results[k] = qmorph.convert(*self.LARGE)

        threads = [threading.Thread(target=work, args=(k,)) for k in range(2)]
        for thread in threads:
            thread.start()
        turns = 0
        while any(thread.is_alive() for thread in threads):
            turns += 1
            time.sleep(0.001)
        self.assertGreater(turns, 10)
        for result in results:
            np.testing.assert_array_equal(result.points, expected.points)
            np.testing.assert_array_equal(result.quads, expected.quads)

    def test_memory_does_not_grow(self):
        points, triangles = rough(20, 10)

        def work(times):
            for _ in range(times):
                qmorph.convert(points, triangles, threads=1)
                with self.assertRaises(qmorph.Error):
                    qmorph.convert(points, triangles, no_such_option=1)
            return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

        before = work(200)
        self.assertLess(work(1000) - before, 8_000)  # kB: a tenth of what the results alone would take


if __name__ == "__main__":
    unittest.main()
