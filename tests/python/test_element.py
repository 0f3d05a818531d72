"""One cell, one material point: their tangents by order, against exact solutions, and beside an analysis."""
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np
import osculate
from osculate import Element, MaterialPoint

SOURCE = pathlib.Path(os.environ["SOURCE"])
QUAD = [[0, 0], [2, 0], [2.2, 1], [0, 1.1]]
CUBE = [[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
METAL = {"elastoplastic": {"E": 2e5, "nu": 0.3, "yield": 200, "isotropic": 1e3}}


def random(nodes, dimension, size):
    return np.random.default_rng(1).uniform(-size, size, (nodes, dimension))


class Elements(unittest.TestCase):
    def test_the_tangent_is_the_derivative_of_the_force(self):
        for material, section in [({"neo_hooke": {"E": 10, "nu": 0.3}}, {}),
                                  ({"neo_hooke": {"E": 10, "nu": 0.49}}, {"formulation": "bbar"}),
                                  ({"neo_hooke": {"E": 10, "nu": 0.3}}, {"element": "axisymmetric"}),
                                  ({"neo_hooke": {"E": 10, "nu": 0.3}}, {"element": "plane_stress", "thickness": 2})]:
            with self.subTest(section=section):
                cell = Element("quad4", QUAD, material, **section)
                self.assertTrue(cell.finite)
                check = cell.derivative_check(random(4, 2, 0.05))
                self.assertTrue(check.passed, check)
                self.assertFalse(check.exact)
        self.assertTrue(Element("hex8", CUBE, METAL).derivative_check(random(8, 3, 0.05)).passed)

    def test_cells_of_all_shapes_have_their_own_size(self):
        def with_middles(corners, edges):
            x = np.array(corners, dtype=float)
            return np.vstack([x, [(x[a] + x[b]) / 2 for a, b in edges]])

        triangle, tetrahedron = [[0, 0], [1, 0.1], [0.2, 1]], [[0, 0, 0], [1, 0, 0.1], [0, 1, 0], [0.1, 0, 1]]
        wedge = [[*x, z] for z in (0, 1) for x in triangle]
        around = [(0, 1), (1, 2), (2, 0)]
        cells = {"tri3": triangle, "tri6": with_middles(triangle, around), "quad4": QUAD,
                 "quad8": with_middles(QUAD, [(0, 1), (1, 2), (2, 3), (3, 0)]), "tet4": tetrahedron,
                 "tet10": with_middles(tetrahedron, [*around, (0, 3), (2, 3), (1, 3)]), "wedge6": wedge, "hex8": CUBE}
        for material in ({"linear_elastic": {"E": 10, "nu": 0.3}}, {"neo_hooke": {"E": 10, "nu": 0.3}}):
            for name, x in cells.items():
                with self.subTest(cell=name, material=material):
                    cell, x = Element(name, x, material), np.array(x, dtype=float)
                    u = random(*x.shape, 0.01)
                    now = cell.at(u)
                    self.assertEqual(now.force.size, x.size)
                    self.assertEqual(now.tangent.shape, (x.size, x.size))
                    self.assertTrue(cell.derivative_check(u).passed)
                    for along in np.eye(x.shape[1]):  # forces balance, a translation is free
                        self.assertAlmostEqual(now.force.reshape(x.shape).sum(axis=0) @ along, 0, 12)
                        np.testing.assert_allclose(now.tangent @ np.tile(along, len(x)), 0, atol=1e-11)

    def test_nodes_in_another_order_are_refused(self):
        with self.assertRaisesRegex(osculate.InputError, "another order"):
            Element("tetra10", np.eye(10, 3), {"linear_elastic": {"E": 10, "nu": 0.3}})

    def test_a_material_is_an_entry_of_materials(self):
        with self.assertRaisesRegex(osculate.InputError, "expected an entry of `materials`"):
            Element("hex8", CUBE, "steel")

    def test_a_wrong_tangent_is_found(self):
        stiff = 1.001e3 * np.eye(6)
        wrong = MaterialPoint(osculate.material(lambda strain, change, state, duration:
                                                (1e3 * (strain + change), stiff, state)))
        check = wrong.derivative_check([0.1, 0.2, 0, 0.1, 0, 0])
        self.assertFalse(check.passed)
        self.assertLess(check.order, 0.5)
        right = MaterialPoint(osculate.material(lambda strain, change, state, duration:
                                                (1e3 * (strain + change), stiff / 1.001, state)))
        self.assertTrue(right.derivative_check([0.1, 0.2, 0, 0.1, 0, 0]).exact)

    def test_a_bar_is_hookes(self):
        cell = Element("quad4", [[0, 0], [2, 0], [2, 1], [0, 1]], {"linear_elastic": {"E": 100, "nu": 0.25}},
                       element="plane_stress", thickness=3)
        now = cell.at([[0, 0], [0.02, 0], [0.02, -0.0025], [0, -0.0025]])
        np.testing.assert_allclose(now.stress, np.tile([1, 0, 0, 0], (4, 1)), atol=1e-13)
        np.testing.assert_allclose(now.force.reshape(4, 2)[:, 0], [-1.5, 1.5, 1.5, -1.5], rtol=1e-12)
        self.assertAlmostEqual(now.volume.sum(), 6)
        np.testing.assert_allclose(now.tangent @ np.tile([1, 0], 4), 0, atol=1e-12)  # a translation
        self.assertFalse(cell.finite)

    def test_it_is_the_cell_of_an_analysis(self):
        u = np.array([0, -0.1, 0, 0, 0, 0.05, 0.03, 0]).reshape(4, 2)
        model = {"osculate": 1, "materials": {"m": {"neo_hooke": {"E": 10, "nu": 0.3}}},
                 "sections": [{"on": "cell", "material": "m", "element": "plane_strain"}],
                 "steps": [{"name": "s", "increments": 1,
                            "prescribe": [{"on": f"n{k}", "ux": x, "uy": y} for k, (x, y) in enumerate(u)]}]}
        mesh = {"points": np.array(QUAD), "cells": [("quad4", np.arange(4)[None], "cell")],
                "point_sets": {f"n{k}": [k] for k in range(4)}}
        end = osculate.run(model, mesh=mesh).increments[-1]
        now = Element("quad4", QUAD, {"neo_hooke": {"E": 10, "nu": 0.3}}).at(u)
        np.testing.assert_array_equal(end["RF"][:, :2].reshape(-1), now.force)

    def test_metal_remembers(self):
        with self.assertRaisesRegex(osculate.InputError, "in space, of a solid, not 'plane_stress'"):
            MaterialPoint(METAL, element="plane_stress")
        point = MaterialPoint(METAL)
        self.assertEqual(point.state[0], "PEEQ")
        strain = np.outer(np.linspace(0, 3e-3, 7), [1, -0.5, -0.5, 0, 0, 0])  # G = E / 2.6: yields at 200 / (3 G)
        stress = point.path(strain)
        mises = stress[:, 0] - stress[:, 1]
        shear = 2e5 / 2.6
        elastic = 3 * shear * strain[:, 0]
        flown = 200 + 1e3 * (elastic - 200) / (3 * shear + 1e3)
        np.testing.assert_allclose(mises, np.where(elastic < 200, elastic, flown), rtol=1e-12)
        first = point.at(strain[-1])
        self.assertGreater(first.after[0], 1e-3)
        back = point.at(strain[-2], first.after)
        np.testing.assert_array_equal(back.after, first.after)  # it unloads elastically
        self.assertTrue(point.derivative_check(strain[-1], step=1e-5).passed)

    def test_a_compiled_umat_is_the_same(self):
        with tempfile.TemporaryDirectory() as folder:
            library = pathlib.Path(folder) / "elastic.so"
            subprocess.run(["gfortran", "-shared", "-fPIC", "-O2", "-o", library,
                            SOURCE / "examples/user_material/elastic.f"], check=True)
            law = {"user": {"library": "elastic.so", "constants": [2e5, 0.3], "state": 0}}
            umat = MaterialPoint(law, base=folder)
            strain = [1e-3, 2e-3, -1e-3, 1e-3, 5e-4, 3e-4]
            ours = MaterialPoint({"linear_elastic": {"E": 2e5, "nu": 0.3}}).at(strain)
            np.testing.assert_allclose(umat.at(strain).stress, ours.stress, rtol=1e-12)
            np.testing.assert_allclose(umat.at(strain).tangent, ours.tangent, rtol=1e-12, atol=1e-9)
            self.assertTrue(umat.derivative_check(strain).passed)

    def test_what_cannot_be_used_is_refused(self):
        metal = Element("hex8", CUBE, METAL)
        for call, said in [(lambda: Element("quad4", QUAD[::-1], METAL), "counter-clockwise"),
                           (lambda: Element("quad4", QUAD, {"neo_hook": {}}), "did you mean 'neo_hooke'"),
                           (lambda: Element("quad4", CUBE, METAL), "has 4 nodes, not 8"),
                           (lambda: Element("quad4", np.array(CUBE)[:4], METAL), "not one of 3 dimensions"),
                           (lambda: Element("quad4", QUAD, METAL, elemen="plane_strain"), "did you mean 'element'"),
                           (lambda: metal.at(np.zeros(3)), "expected 24 numbers, got 3"),
                           (lambda: metal.at(np.zeros(24), np.zeros(3)), "before: expected"),
                           (lambda: Element("hex8", CUBE, {"neo_hooke": {"E": 1, "nu": 0.3}}).at(
                               -2 * np.array(CUBE) * [1, 0, 0]), "inside out"),
                           (lambda: MaterialPoint(METAL).at([1, 2]), "expected 6 numbers, got 2")]:
            with self.assertRaisesRegex((osculate.InputError, osculate.Refused), said):
                call()

    def test_what_a_function_raises_is_raised(self):
        def fails(strain, change, state, duration):
            if change[0] > 0.5:
                raise ZeroDivisionError("here")
            return 1e3 * (strain + change), 1e3 * np.eye(6), state

        point = MaterialPoint(osculate.material(fails))
        with self.assertRaisesRegex(ZeroDivisionError, "here"):
            point.at([1, 0, 0, 0, 0, 0])
        self.assertEqual(point.at([0.1, 0, 0, 0, 0, 0]).stress[0], 100)
        with self.assertRaisesRegex(ZeroDivisionError, "at all"):
            MaterialPoint(osculate.material(lambda *_: (_ for _ in ()).throw(ZeroDivisionError("at all"))))


if __name__ == "__main__":
    unittest.main()
