# SPDX-License-Identifier: GPL-2.0-or-later
"""import qmorph.gmsh: the model of the session that is open."""
import os
import subprocess
import sys
import tempfile
import unittest

try:
    import gmsh
    import qmorph.gmsh
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

import qmorph


class Session(unittest.TestCase):
    def setUp(self):
        gmsh.initialize(["gmsh", "-v", "0"], False)
        gmsh.model.add("disk")
        gmsh.model.occ.addDisk(0, 0, 0, 1, 1)
        gmsh.model.occ.addRectangle(3, 0, 0, 2, 1)
        gmsh.model.occ.synchronize()
        gmsh.model.addPhysicalGroup(2, [1], 7)
        gmsh.model.addPhysicalGroup(2, [2], 8)
        gmsh.option.setNumber("Mesh.MeshSizeMax", 0.1)
        gmsh.model.mesh.generate(2)

    def tearDown(self):
        gmsh.finalize()

    def elements(self, tag):
        types, _, nodes = gmsh.model.mesh.getElements(2, tag)
        return {t: len(n) // gmsh.model.mesh.getElementProperties(t)[3] for t, n in zip(types, nodes)}

    def test_recombine_leaves_no_triangle_where_curves_are_even(self):
        even = qmorph.gmsh.make_even()
        self.assertEqual(even.odd_surfaces, [])
        report = qmorph.gmsh.recombine()
        self.assertEqual([s.outcome for s in report.surfaces], ["converted", "converted"])
        self.assertEqual(report.left, [])
        for tag in (1, 2):
            self.assertEqual(list(self.elements(tag)), [3])
        self.assertEqual(list(gmsh.model.getEntitiesForPhysicalGroup(2, 8)), [2])

    def test_only_the_surfaces_that_are_named(self):
        before = self.elements(2)
        qmorph.gmsh.recombine([1], cleanup_pattern_rounds=1)
        self.assertEqual(self.elements(2), before)
        self.assertIn(3, self.elements(1))

    def test_measure_and_improve(self):
        gmsh.model.mesh.recombine()
        before = qmorph.gmsh.measure_surfaces().quality
        after = qmorph.gmsh.improve_quads().quality
        self.assertGreaterEqual(after["scaled_jacobian_mean"], before["scaled_jacobian_mean"])

    def test_errors_and_interruptions_leave_the_mesh_as_it_was(self):
        before = gmsh.model.mesh.getNodes()[0].tolist(), self.elements(1)
        with self.assertRaises(qmorph.UsageError) as caught:
            qmorph.gmsh.recombine([99])
        self.assertEqual(caught.exception.subject, ("surface", 99))
        with self.assertRaises(qmorph.UsageError):
            qmorph.gmsh.recombine(no_such_option=1)

        def stop(stage, share):
            raise KeyboardInterrupt

        gmsh.option.setNumber("Mesh.MeshSizeMax", 0.015)
        gmsh.model.mesh.clear()
        gmsh.model.mesh.generate(2)
        before = gmsh.model.mesh.getNodes()[0].tolist(), self.elements(1)
        with self.assertRaises(KeyboardInterrupt):
            qmorph.gmsh.recombine(progress=stop)
        self.assertEqual((gmsh.model.mesh.getNodes()[0].tolist(), self.elements(1)), before)

    def test_without_a_session_it_says_so(self):
        gmsh.finalize()
        with self.assertRaisesRegex(qmorph.UsageError, "initialize"):
            qmorph.gmsh.recombine()
        gmsh.initialize(["gmsh", "-v", "0"], False)

    @unittest.skipUnless("QMORPH_COMMAND" in os.environ, "needs the command")
    def test_surfaces_may_be_pairs_of_dimension_and_tag(self):
        report = qmorph.gmsh.recombine(gmsh.model.getEntities(2)[:1])
        self.assertEqual(len(report.surfaces), 1)
        for wrong in (1, [1.5], ["1"], [(1, 1)]):
            with self.subTest(wrong=wrong), self.assertRaises(qmorph.UsageError):
                qmorph.gmsh.recombine(wrong)

    def test_one_call_at_a_time(self):
        caught = []

        def again(stage, share):
            try:
                qmorph.gmsh.recombine()
            except qmorph.UsageError as error:
                caught.append(str(error))

        qmorph.gmsh.recombine(progress=again)
        self.assertIn("in use", caught[0])

    def test_a_model_without_a_mesh_gets_a_word(self):
        gmsh.model.mesh.clear()
        self.assertIn("generate(2)", qmorph.gmsh.recombine().warnings[0])

    def test_the_command_writes_the_same_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            mesh, ours, theirs = (os.path.join(folder, name) for name in ("in.msh", "ours.msh", "theirs.msh"))
            gmsh.write(mesh)
            gmsh.clear()
            gmsh.open(mesh)
            qmorph.gmsh.recombine()
            gmsh.write(ours)
            subprocess.run([os.environ["QMORPH_COMMAND"], mesh, "-o", theirs, "-v", "0"], check=True)
            with open(ours, "rb") as one, open(theirs, "rb") as two:
                self.assertEqual(one.read(), two.read())


if __name__ == "__main__":
    unittest.main()
