"""Studies: a model over values of its parameters."""
import contextlib
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
from unittest import mock

import numpy as np
import osculate
from models import YAML, block

OUTPUTS = {"force": "c.normal_force", "shear": lambda result: abs(result.history["c.shear_force"]).max()}


class Studies(unittest.TestCase):
    def test_all_combinations(self):
        table = osculate.study(block(), {"side": [0.1, 0.2], "mu": [0.3, 0.5]}, OUTPUTS)
        self.assertEqual([(row["side"], row["mu"]) for row in table], [(0.1, 0.3), (0.1, 0.5), (0.2, 0.3), (0.2, 0.5)])
        np.testing.assert_allclose(table.column("shear"), [0.8, 0.8, 1.6, 1.6], rtol=1e-6)
        np.testing.assert_allclose(table.array()["force"], 16, rtol=1e-9)
        self.assertEqual(set(table.column("status")), {"done"})

    def test_a_table_is_printed_and_drawn(self):
        table = osculate.study(block(), {"mu": [0.5, 0.3]}, {"force": "c.normal_force"})
        lines = str(table).splitlines()
        self.assertEqual([line.split() for line in lines], [["mu", "force", "status"], ["0.5", "16", "done"], ["0.3", "16", "done"]])
        self.assertEqual(len({len(line) for line in lines}), 1)
        axes = table.plot("mu", "force")
        np.testing.assert_array_equal(axes.lines[0].get_xdata(), [0.3, 0.5])
        np.testing.assert_array_equal(axes.lines[0].get_ydata(), table.column("force")[::-1])
        with self.assertRaisesRegex(KeyError, "no column 'forc'; it has mu, force, status"):
            table.plot("mu", "forc")

    def test_processes_change_nothing(self):
        points = {"side": [0.1, 0.15, 0.2]}
        self.assertEqual(osculate.study(block(), points, OUTPUTS, processes=1),
                         osculate.study(block(), points, OUTPUTS, processes=3))

    def test_a_function_makes_the_models_and_failures_are_rows(self):
        def model(up):
            steps = [{"name": "rest", "increments": 1, "body_force": [{"on": "block", "fy": -1}]},
                     {"name": "then", "increments": 1, "body_force": [{"on": "block", "fy": up}]}]
            return block(steps=steps)

        table = osculate.study(model, [{"up": -2}, {"up": 1}], {"force": "c.normal_force"})
        self.assertEqual(table.column("status").tolist(), ["done", "stopped"])
        self.assertAlmostEqual(table[0]["force"], 16)
        self.assertTrue(np.isnan(table[1]["force"]))

    def test_a_file_keeps_its_results_in_folders(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "model.yaml")
            with open(path, "w") as file:
                file.write(YAML)
            osculate.study(path, {"side": [0.1, 0.2]}, OUTPUTS, folder=os.path.join(folder, "study"))
            second = osculate.Result(os.path.join(folder, "study", "0001"))
            self.assertEqual(second.summary["parameters"]["side"], "0.2")
            with self.assertRaisesRegex(TypeError, "folder"):
                osculate.study(path, {"side": [0.1]}, OUTPUTS)

    def test_what_fails_is_a_row(self):
        def model(side):
            if side > 0.15:
                raise OSError("no such mesh")
            return block(parameters={"mu": 0.3, "side": side})

        outputs = {**OUTPUTS, "wrong": lambda result: 1 / 0}
        for processes in (1, 2):
            table = osculate.study(model, {"side": [0.1, 0.2]}, outputs, processes=processes)
            self.assertAlmostEqual(table[0]["force"], 16)
            self.assertTrue(np.isnan([table[0]["wrong"], table[1]["wrong"], table[1]["force"]]).all())
            self.assertEqual(table[0]["status"], "failed: wrong: ZeroDivisionError: division by zero")
            self.assertEqual(table[1]["status"], "failed: OSError: no such mesh")

    def test_studies_in_threads_do_not_mix(self):
        tables = [None, None]

        def work(i):
            tables[i] = osculate.study(block(), {"side": [0.1 + 0.1 * i, 0.3]}, OUTPUTS, processes=1 + i)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual([t.column("side").tolist() for t in tables], [[0.1, 0.3], [0.2, 0.3]])

    def test_processes_have_one_thread_each(self):
        with self.assertRaisesRegex(osculate.InputError, "threads: expected 1 where a study has 2 processes"):
            osculate.study(block(), {"side": [0.1]}, OUTPUTS, processes=2, threads=2)
        code = """if True:
            import osculate
            from models import block
            mesh = {"generate": {"block": {"box": {"x": [0, 4], "y": [0, 2], "elements": [40, 20]}}}}
            osculate.run(block(mesh=mesh), threads=2)
            points = [[0.0, 1.0, 2.0]] * 100000
            osculate.closest_points(osculate.Torus(), points, threads=2)
            table = osculate.study(block(mesh=mesh), {"side": [0.1, 0.2]}, {"force": "c.normal_force"})
            print(table.column("status").tolist())"""
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True,
                              start_new_session=True) as process:
            try:
                self.assertEqual(process.communicate(timeout=60)[0], "['done', 'done']\n")
            finally:
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(process.pid, signal.SIGKILL)

    def test_what_is_done_is_not_run_again(self):
        with tempfile.TemporaryDirectory() as folder:
            ran = []  # each row's increments are told
            sides = [0.1, 0.2]

            def study(sides=sides, outputs=OUTPUTS, model=None, **more):
                ran.clear()
                return osculate.study(model or block(), {"side": sides}, outputs, processes=1, folder=folder,
                                      on_increment=lambda state: ran.append(state.history["c.shear_force"]), **more)

            first = study(resume=True)
            increments = len(ran)
            self.assertGreater(increments, 2)
            self.assertEqual(study(resume=True), first)
            self.assertEqual(ran, [])
            self.assertEqual(study(), first)  # anew, unless it is asked for
            self.assertEqual(len(ran), increments)
            shear = {"last": lambda result: result.history["c.shear_force"][-1]}
            self.assertEqual(study(outputs=shear, resume=True).column("status").tolist(), ["done", "done"])
            self.assertEqual(ran, [])  # other outputs of the same runs
            study([0.1, 0.3], resume=True)  # another value
            self.assertEqual(len(ran), increments // 2)
            study([0.1, 0.3], resume=True, until="weight")  # another option
            self.assertGreater(len(ran), 0)
            study([0.1, 0.3], resume=True, model=block(title="another one"))
            self.assertEqual(len(ran), increments)
            path = os.path.join(folder, "0001", "summary.json")
            with open(path) as file:
                summary = file.read()
            with open(path, "w") as file:  # as where a run was stopped
                file.write(summary.replace('"status": "done"', '"status": "stopped"'))
            study([0.1, 0.3], resume=True, model=block(title="another one"))
            self.assertEqual(len(ran), increments // 2)

    def test_another_mesh_or_version_is_another_run(self):
        with tempfile.TemporaryDirectory() as folder:
            ran = []
            file, mesh = os.path.join(folder, "model.yaml"), os.path.join(folder, "m.msh")

            def written(width):
                corners = [[0, 0], [width, 0], [width, 2], [0, 2]]
                osculate.write_gmsh({"points": corners, "cells": [("quad4", [[0, 1, 2, 3]], "block"), ("line2", [[0, 1]], "under")]}, mesh)

            model = block(mesh="m.msh", contact=[{"name": "c", "master": "floor", "slave": "under", "normal": {"penalty": 1e6},
                                                  "friction": {"coulomb": {"mu": 0.3, "penalty": 1e6}}}])
            del model["parameters"]["mu"]
            with open(file, "w") as out:
                out.write(json.dumps(model).replace('"=side"', "=side"))

            def runs(study, model, **more):
                """How many of both rows were run."""
                ran.clear()
                table = osculate.study(model, {"side": [0.1, 0.2]}, {"force": "c.normal_force"}, processes=1, resume=True,
                                       folder=os.path.join(folder, study), on_increment=lambda state: ran.append(state), **more)
                self.assertEqual(table.column("status").tolist(), ["done", "done"])
                return sum(state.step == "weight" and state.increment == 1 for state in ran)

            function = lambda side: {**model, "parameters": {"side": side}}  # noqa: E731
            for kind, *asked, more in (("file", file, {}), ("model", model, {"base": folder}), ("function", function, {"base": folder})):
                with self.subTest(kind):
                    written(4)
                    self.assertEqual([runs(kind, *asked, **more), runs(kind, *asked, **more)], [2, 0])
                    written(3)
                    self.assertEqual([runs(kind, *asked, **more), runs(kind, *asked, **more)], [2, 0])
                    with mock.patch.object(osculate._core, "version", osculate.__version__ + ".1"):
                        self.assertEqual([runs(kind, *asked, **more), runs(kind, *asked, **more)], [2, 0])
                    self.assertEqual(runs(kind, *asked, **more), 2)

    def test_what_stopped_is_run_again(self):
        def model(up):
            steps = [{"name": "rest", "increments": 1, "body_force": [{"on": "block", "fy": -1}]},
                     {"name": "then", "increments": 1, "body_force": [{"on": "block", "fy": up}]}]
            return block(steps=steps)

        with tempfile.TemporaryDirectory() as folder:
            ran = []
            for _ in range(2):
                ran.clear()
                table = osculate.study(model, [{"up": -2}, {"up": 1}], {"force": "c.normal_force"}, processes=1,
                                       folder=folder, resume=True, on_increment=lambda state: ran.append(state.step))
                self.assertEqual(table.column("status").tolist(), ["done", "stopped"])
            self.assertEqual(ran.count("rest"), 1)  # that of the row which stopped
        with self.assertRaisesRegex(TypeError, "resumed from the folder"):
            osculate.study(model, [{"up": -2}], {}, resume=True)

    def test_bad_input_is_raised(self):
        with self.assertRaisesRegex(osculate.InputError, "unknown parameter 'sid'"):
            osculate.study(block(), {"sid": [1]}, OUTPUTS)


if __name__ == "__main__":
    unittest.main()
