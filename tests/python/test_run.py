"""Analyses from Python: the same answers, messages and files as the program. PROGRAM: its path."""
import importlib.util
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import traceback
import unittest

import numpy as np
import osculate
from osculate import _plot
from models import YAML, block

PROGRAM = os.environ["PROGRAM"]


def files_of(folder):
    """What two runs have in common, byte by byte."""
    names = sorted(name for name in os.listdir(folder) if name.endswith((".vtu", ".csv", ".pvd")))
    return {name: pathlib.Path(folder, name).read_bytes() for name in names}


class Runs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.path("model.yaml").write_text(YAML)

    def path(self, name):
        return pathlib.Path(self.folder, name)

    def program(self, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)

    def test_a_file_a_dictionary_and_the_program_give_the_same_bytes(self):
        self.program("run", "model.yaml", "-o", "program")
        osculate.run(self.path("model.yaml"), self.path("file"))
        osculate.run(block(), self.path("dictionary"))
        expected = files_of(self.path("program"))
        self.assertGreater(len(expected), 10)
        self.assertEqual(files_of(self.path("file")), expected)
        self.assertEqual(files_of(self.path("dictionary")), expected)

    def test_parameters_are_set_as_by_the_program(self):
        self.program("run", "model.yaml", "-o", "program", "--set", "side=0.25")
        osculate.run(block(), self.path("dictionary"), parameters={"side": 0.25})
        self.assertEqual(files_of(self.path("dictionary")), files_of(self.path("program")))
        self.assertNotEqual(osculate.run(block()).history["c.shear_force"][-1],
                            osculate.Result(self.path("program")).history["c.shear_force"][-1])

    def test_statics(self):
        result = osculate.run(block())
        self.assertEqual(result.status, "done")
        np.testing.assert_allclose(result.history["c.normal_force"], [0, 4, 8, 12, 16], atol=1e-8)
        np.testing.assert_allclose(result.history["time"], [0, 0.5, 1, 1.5, 2])
        self.assertEqual(result.history.units["c.normal_force"], "force")
        floor = result.increments[2].parts["c"]
        np.testing.assert_allclose(np.sum(floor["CPRESS"] * floor["CAREA"]), 8, rtol=1e-9)
        np.testing.assert_allclose(result.fields("weight").field("U"), result.increments[2]["U"])
        self.assertEqual(result.summary["steps"][1]["name"], "more")
        self.assertEqual(result.increments[3].record["time"], 1.5)
        self.assertEqual(result.increments[3].step, "more")

    def test_messages_are_those_of_the_program(self):
        self.path("wrong.yaml").write_text(YAML.replace("penalty: 1.0e6},", "penalt: 1.0e6},"))
        said = self.program("run", "wrong.yaml")
        self.assertEqual(said.returncode, 2)
        with self.assertRaises(osculate.InputError) as raised:
            osculate.run(self.path("wrong.yaml"), self.path("results"))
        self.assertEqual(f"error: {raised.exception}\n".replace(self.folder + "/", ""), said.stderr)
        self.assertEqual((raised.exception.line, raised.exception.key), (8, "contact[0].normal"))
        contact = [{**block()["contact"][0], "normal": {"penalt": 1.0e6}}]
        with self.assertRaises(osculate.InputError) as raised:
            osculate.run(block(contact=contact))
        said = said.stderr.removeprefix("error: wrong.yaml:8: ")
        self.assertEqual(f"{raised.exception}\n".removeprefix("model: "), said)

    def test_texts_stay_texts_and_numbers_numbers(self):
        for value, part in (("1.0e4", "quoted text"), (True, "got the text 'true'"), (None, "nothing"),
                            (np.nan, "finite"), ([1], "a list"), (object(), "got object")):
            with self.subTest(value=value), self.assertRaisesRegex(osculate.InputError, part):
                osculate.run(block(materials={"s": {"linear_elastic": {"E": value, "nu": 0.3}}}))
        numpy = {"s": {"linear_elastic": {"E": np.float64(1e4), "nu": np.float32(0.25)}}}
        self.assertEqual(osculate.check(block(materials=numpy))["unknowns"], 93)
        loop = block()
        loop["mesh"] = loop
        with self.assertRaisesRegex(osculate.InputError, "nested more than 48 deep"):
            osculate.run(loop)

    def test_an_analysis_that_fails_keeps_what_converged(self):
        pulled = [{"name": "rest", "increments": 1, "body_force": [{"on": "block", "fy": -1}]},
                  {"name": "lift", "increments": 2, "body_force": [{"on": "block", "fy": 1}]}]
        with self.assertRaises(osculate.AnalysisFailed) as raised:
            osculate.run(block(steps=pulled))
        result = raised.exception.result
        self.assertEqual(result.status, "stopped")
        self.assertEqual(str(raised.exception), result.message)
        self.assertIn("diagnosis", result.summary)
        self.assertGreater(result.history["c.normal_force"][1], 0)
        last = result.last_iterate
        self.assertEqual(last.increment, result.increments[-1].increment + 1)
        self.assertEqual(last["U"].shape, result.increments[-1]["U"].shape)
        self.assertIn("flips", last.parts["bodies"].point_data)
        self.assertIsNone(osculate.run(block()).last_iterate)

    def test_the_last_iterate_is_of_the_step_that_failed(self):
        def lifted(increments, force, **more):
            with self.assertRaises(osculate.AnalysisFailed) as raised:
                osculate.run(block(steps=[{"name": "rest", "increments": 1, "body_force": [{"on": "block", "fy": -1}]},
                                          {"name": "lift", "increments": increments, "body_force": [{"on": "block", "fy": force}], **more}]))
            result = raised.exception.result
            return result.increments[-1], result.last_iterate

        converged, last = lifted(1, -3, contact=[{"pair": "c", "active": False}])
        self.assertEqual((converged.step, converged.increment), ("rest", 1))  # nothing of the next one
        self.assertEqual((last.step, last.increment, last.time), ("lift", 1, converged.time))
        converged, last = lifted(2, 1)
        self.assertEqual((converged.step, converged.increment), ("lift", 1))
        self.assertEqual((last.step, last.increment), ("lift", 2))

    def test_two_runs_in_one_process_give_the_same_bytes(self):
        for name in ("first", "second"):
            osculate.run(block(), self.path(name))
        self.assertEqual(files_of(self.path("first")), files_of(self.path("second")))

    def test_runs_in_threads_give_the_same_bytes(self):
        names = [f"thread{i}" for i in range(4)]
        threads = [threading.Thread(target=osculate.run, args=(block(), self.path(n))) for n in names]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        osculate.run(block(), self.path("alone"))
        for name in names:
            self.assertEqual(files_of(self.path(name)), files_of(self.path("alone")))

    def test_restart_goes_on(self):
        osculate.run(block(), self.path("whole"))
        osculate.run(block(), self.path("parts"), until="weight")
        osculate.run(block(), self.path("parts"), restart=True)
        self.assertEqual(files_of(self.path("parts")), files_of(self.path("whole")))

    def test_nothing_is_printed(self):
        code = "import osculate, sys; osculate.run(sys.argv[1], sys.argv[2])"
        said = subprocess.run([sys.executable, "-c", code, self.path("model.yaml"), self.path("r")],
                              capture_output=True, text=True, check=True)
        self.assertEqual((said.stdout, said.stderr), ("", ""))

    def test_a_folder_that_cannot_be_written_to(self):
        self.path("file").write_text("")
        with self.assertRaises((OSError, osculate.InputError)):
            osculate.run(block(), self.path("file") / "below")

    def test_limits_have_ranges(self):
        for change in ({"threads": 0}, {"threads": -1}, {"threads": 100000}, {"threads": 1.5}, {"threads": True},
                       {"max_iterations": -1}, {"max_iterations": 2.5}, {"max_minutes": np.nan}, {"max_minutes": -1},
                       {"max_minutes": "long"}):
            name = next(iter(change))
            with self.subTest(change=change), self.assertRaisesRegex(osculate.InputError, f"^{name}: expected"):
                osculate.run(block(), self.path("none"), **change)
        self.assertFalse(self.path("none").exists())
        with self.assertRaises(osculate.AnalysisFailed) as raised:
            osculate.run(block(), max_iterations=np.int64(2))
        self.assertIn("iterations that max_iterations allows", str(raised.exception))
        self.assertEqual(raised.exception.result.message, str(raised.exception))
        with self.assertRaisesRegex(osculate.InputError, "run with restart=False"):
            osculate.run(block(), restart=True)

    def test_results_of_a_run_that_was_killed(self):
        folder = self.path("results")
        whole = osculate.run(block(), folder)
        (folder / "summary.json").unlink()
        rows = (folder / "history.csv").read_bytes()
        (folder / "history.csv").write_bytes(rows[:-5])
        result = osculate.Result(folder)
        self.assertEqual((result.status, result.summary), ("unfinished", {}))
        np.testing.assert_array_equal(result.history["time"], whole.history["time"][:-1])
        np.testing.assert_array_equal(result.increments[-1]["U"], whole.increments[-2]["U"])

    def test_fields_of_files_are_read_only_and_those_that_are_told_are_not(self):
        told = []
        for compress in (False, True):
            packed = block(output={**block()["output"], "compress": compress})
            result = osculate.run(packed, on_increment=lambda state: told.append(state["U"]))
            self.assertFalse(result.increments[-1]["U"].flags.writeable)
            self.assertTrue(result.history["time"].flags.writeable)
        self.assertTrue(told[0].flags.writeable)

    def test_broken_files_are_named(self):
        folder = self.path("results")
        osculate.run(block(), folder)
        for name in ("bodies_00002.vtu", "results.pvd", "history.csv", "summary.json"):
            kept = (folder / name).read_bytes()
            for size in (len(kept) // 2, len(kept) // 8):
                cut = kept + b"1,2\n" if name == "history.csv" else kept[:size]
                (folder / name).write_bytes(cut)
                with self.subTest(name=name, size=size), self.assertRaisesRegex(osculate.InputError, name):
                    osculate.Result(folder).increments[2]["U"]
            (folder / name).write_bytes(kept)
        osculate.Result(folder).increments[2]["U"]

    def test_check_says_what_the_program_says(self):
        def without_memory(text):
            return [line for line in text.splitlines() if not line.startswith("Memory")]

        facts = osculate.check(self.path("model.yaml"))
        said = self.program("check", "model.yaml").stdout
        self.assertEqual(without_memory(facts["text"]), without_memory(said))


class Watching(unittest.TestCase):
    def test_increments_are_told_with_the_fields_of_the_files(self):
        told = []

        def watch(state):
            told.append((state.step, state.increment, state.time, state.iterations, state["U"], state["CPRESS"],
                         state.parts, state.history["c.normal_force"]))

        result = osculate.run(block(), on_increment=watch)
        self.assertEqual([t[:3] for t in told],
                         [("weight", 1, 0.5), ("weight", 2, 1.0), ("more", 1, 1.5), ("more", 2, 2.0)])
        for one, increment, force in zip(told, result.increments[1:], result.history["c.normal_force"][1:]):
            self.assertEqual(one[3], increment.record["iterations"])
            self.assertEqual(one[7], force)
            self.assertEqual(list(one[6]), list(increment.parts))
            for part in one[6]:
                live, read = one[6][part], increment.parts[part]
                for name in ("points", "connectivity", "offsets", "types"):
                    np.testing.assert_array_equal(getattr(live, name), getattr(read, name))
                for name in ("point_data", "cell_data"):
                    self.assertEqual(list(getattr(live, name)), list(getattr(read, name)))
                    for field, values in getattr(live, name).items():
                        np.testing.assert_array_equal(values, read[field])

    def test_compressed_files_are_read(self):
        packed = block(output={**block()["output"], "compress": True})
        np.testing.assert_array_equal(osculate.run(packed).increments[-1]["S"],
                                      osculate.run(block()).increments[-1]["S"])

    def test_a_pair_called_as_the_bodies_are(self):
        told = []
        contact = [{**block()["contact"][0], "name": "bodies"}]
        result = osculate.run(block(contact=contact, output={}), on_increment=lambda s: told.append(s.parts))
        self.assertEqual(sum(i.has_fields for i in result.increments), len(told) + 1)
        for parts in (told[-1], result.increments[-1].parts):
            self.assertEqual(list(parts), ["bodies", "rigid bodies", "contact bodies"])
            self.assertEqual(parts.field("U").shape, parts["bodies"].points.shape)
            self.assertIn("CPRESS", parts["contact bodies"])

    def test_false_stops_with_what_has_converged(self):
        result = osculate.run(block(), on_increment=lambda state: state.time < 1)
        self.assertEqual(result.status, "stopped")
        np.testing.assert_array_equal(result.history["time"], [0, 0.5, 1])

    def test_an_exception_of_a_callback_comes_through(self):
        def watch(state):
            raise KeyError(state.step)

        with self.assertRaisesRegex(KeyError, "weight"):
            osculate.run(block(), on_increment=watch)
        with self.assertRaisesRegex(ZeroDivisionError, ""):
            osculate.run(block(), say=lambda text: 1 / 0)

    def test_fields_cannot_be_asked_for_afterwards(self):
        kept = []
        osculate.run(block(), on_increment=kept.append)
        with self.assertRaisesRegex(RuntimeError, "while it is told"):
            kept[0]["U"]

    def test_fields_cannot_be_asked_for_after_an_exception(self):
        kept = []

        def watch(state):
            kept.append(state)
            raise KeyError(state.step)

        with self.assertRaises(KeyError):
            osculate.run(block(), on_increment=watch)
        with self.assertRaisesRegex(RuntimeError, "while it is told"):
            kept[0]["U"]

    def test_whatever_is_false_stops_but_none(self):
        for answer, increments in ((np.bool_(False), 2), (0, 2), (None, 5), (np.bool_(True), 5)):
            with self.subTest(answer=answer):
                result = osculate.run(block(), on_increment=lambda state, answer=answer: answer)
                self.assertEqual(len(result.increments), increments)
        with self.assertRaisesRegex(ValueError, "ambiguous"):
            osculate.run(block(), on_increment=lambda state: np.zeros(2))

    def test_an_exception_has_the_lines_of_the_callback(self):
        def callback_with_a_name(state):
            raise KeyError(state.step)

        told = ""
        try:
            osculate.run(block(), on_increment=callback_with_a_name)
        except KeyError:
            told = traceback.format_exc()
        self.assertIn("in callback_with_a_name", told)

    def test_an_exception_of_say_ends_a_run_in_a_thread(self):
        with tempfile.TemporaryDirectory() as folder:
            raised = []

            def work():
                try:
                    osculate.run(block(), folder, say=lambda text: 1 / 0)
                except ZeroDivisionError as error:
                    raised.append(error)

            thread = threading.Thread(target=work)
            thread.start()
            thread.join()
            self.assertEqual(len(raised), 1)
            self.assertEqual(osculate.Result(folder).status, "stopped")

    def test_interrupt_keeps_what_has_converged(self):
        def watch(state):
            if state.time == 1:
                signal.raise_signal(signal.SIGINT)

        with self.assertRaises(KeyboardInterrupt) as raised:
            osculate.run(block(), on_increment=watch)
        self.assertIsInstance(raised.exception, osculate.Interrupted)
        times = raised.exception.result.history["time"]
        np.testing.assert_array_equal(times, [0, 0.5, 1])

    def test_ctrl_c_while_it_computes(self):
        long = block(steps=[{"name": "w", "increments": 20000, "body_force": [{"on": "block", "fy": -1}]}],
                     output={"fields": "none", "report": False, "checkpoint": "none"})
        timer = threading.Timer(0.5, signal.raise_signal, (signal.SIGINT,))
        timer.start()
        try:
            with self.assertRaises(osculate.Interrupted) as raised:
                osculate.run(long)
        finally:
            timer.cancel()
        self.assertIn(len(raised.exception.result.increments), range(2, 20000))
        self.assertEqual(raised.exception.result.status, "stopped")

    def test_other_threads_go_on(self):
        many = block(steps=[{"name": "w", "increments": 60, "body_force": [{"on": "block", "fy": -1}]}])
        count, done = 0, threading.Event()
        worker = threading.Thread(target=lambda: (osculate.run(many), done.set()))
        worker.start()
        while not done.wait(0.001):
            count += 1
        worker.join()
        self.assertGreater(count, 5)


class Meshes(unittest.TestCase):
    """The block of 2 x 1 cells with 3 x 2 nodes, in several ways."""

    points = np.array([[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1]])
    quads = [[0, 1, 4, 3], [1, 2, 5, 4]]

    def model(self):
        model = block(sections=[{"on": "body", "material": "s", "element": "plane_strain"}])
        del model["mesh"]
        model["contact"][0]["slave"] = "bottom"
        model["steps"] = [{"name": "press", "increments": 1, "prescribe": [{"on": "top", "ux": 0, "uy": -0.01}]}]
        return model

    def generated(self):
        model = self.model()
        model["mesh"] = {"generate": {"body": {"box": {"x": [0, 2], "y": [0, 1], "elements": [2, 1]}}}}
        model["contact"][0]["slave"] = "body.bottom"
        model["steps"][0]["prescribe"][0]["on"] = "body.top"
        return osculate.run(model)

    def mesh(self):
        return {"points": self.points,
                "cells": [("quad4", self.quads, "body"), ("line2", [[0, 1], [1, 2]], "bottom")],
                "point_sets": {"top": [3, 4, 5]}}

    def same(self, result):
        expected = self.generated()
        np.testing.assert_allclose(result.history["c.normal_force"], expected.history["c.normal_force"], rtol=1e-12)
        np.testing.assert_array_equal(result.fields()["bodies"].points[:, :2], self.points)

    def test_arrays(self):
        self.same(osculate.run(self.model(), mesh=self.mesh()))

    def test_sets_that_share_cells(self):
        mesh = self.mesh()
        mesh["cell_sets"] = {"left": [[0], None], "all": {0: [0, 1]}}
        model = self.model()
        model["sections"][0]["on"] = "all"
        self.same(osculate.run(model, mesh=mesh))

    def test_an_object_like_meshios(self):
        class Block:
            def __init__(self, kind, data):
                self.type, self.data = kind, np.asarray(data)

        class Mesh:
            points = np.insert(self.points.astype(float), 2, 0, axis=1)
            cells = [Block("quad", self.quads), Block("line", [[0, 1], [1, 2]])]
            point_sets = {"top": np.array([3, 4, 5])}
            cell_sets = {}
            field_data = {"body": np.array([7, 2]), "bottom": np.array([8, 1])}
            cell_data = {"gmsh:physical": [np.array([7, 7]), np.array([8, 8])]}

        self.same(osculate.run(self.model(), mesh=Mesh()))

    def test_second_order_in_vtk_order(self):
        corners = np.array([[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], dtype=float)
        pairs = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
        points = np.vstack([corners, [(corners[a] + corners[b]) / 2 for a, b in pairs]])
        mesh = {"points": points, "cells": [("hexahedron20", [list(range(20))], "body")],
                "point_sets": {"low": [0, 1, 2, 3, 8, 9, 10, 11], "high": [4, 5, 6, 7, 12, 13, 14, 15]}}
        model = {"osculate": 1, "materials": {"s": {"linear_elastic": {"E": 100, "nu": 0}}},
                 "sections": [{"on": "body", "material": "s", "element": "solid"}],
                 "steps": [{"name": "pull", "increments": 1,
                            "prescribe": [{"on": "low", "ux": 0, "uy": 0, "uz": 0},
                                          {"on": "high", "ux": 0, "uy": 0, "uz": 0.01}]}]}
        parts = osculate.run(model, mesh=mesh).fields()
        np.testing.assert_allclose(parts.field("S")[:, 2], 1, rtol=1e-9)
        np.testing.assert_array_equal(parts["bodies"].cells[0][1], [list(range(20))])
        self.assertEqual(parts["bodies"].cells[0][0], "hexahedron20")

    def test_wrong_meshes_are_refused(self):
        for change, part in (({"cells": [("quad5", self.quads)]}, "no type of cells"),
                             ({"cells": [("quad4", [[0, 1, 2]])]}, "has 4 nodes, not 3"),
                             ({"cells": [("quad4", [[0, 1, 4, 6]])]}, "numbers from 0 to 5, got 0 to 6"),
                             ({"points": [1, 2, 3]}, "one row of")):
            with self.subTest(part=part), self.assertRaisesRegex(osculate.InputError, part):
                osculate.run(self.model(), mesh={**self.mesh(), **change})
        with self.assertRaisesRegex(osculate.InputError, "unknown set 'top'"):
            osculate.run(self.model(), mesh={**self.mesh(), "point_sets": {}})

    def test_the_mesh_beside_a_folder(self):
        with tempfile.TemporaryDirectory() as top:
            folder = pathlib.Path(top, "new", "results")
            file = pathlib.Path(top, "new", "results.msh")
            wrong = {**self.model(), "contac": 1}
            for model, mesh in ((wrong, self.mesh()), (self.model(), {**self.mesh(), "points": [1]})):
                with self.assertRaises(osculate.InputError):
                    osculate.run(model, folder, mesh=mesh)
                self.assertEqual(os.listdir(top), [])
            self.same(osculate.run(self.model(), folder, mesh=self.mesh()))
            kept = file.read_bytes()
            self.assertEqual(sorted(os.listdir(file.parent)), ["results", "results.msh"])
            with self.assertRaises(osculate.InputError):
                osculate.run(wrong, folder, mesh={**self.mesh(), "points": 2 * self.points})
            self.assertEqual(file.read_bytes(), kept)
            osculate.run(self.model(), folder, mesh={**self.mesh(), "points": 2 * self.points})
            self.assertNotEqual(file.read_bytes(), kept)
            with self.assertRaises(osculate.InputError):  # results of another mesh
                osculate.run(self.model(), folder, mesh=self.mesh(), restart=True)
            self.assertNotEqual(file.read_bytes(), kept)
            self.assertEqual(sorted(os.listdir(file.parent)), ["results", "results.msh"])

    def test_sets_may_be_masks(self):
        mesh = self.mesh()
        mesh["point_sets"] = {"top": np.array([False, False, False, True, True, True])}
        mesh["cell_sets"] = {"all": [np.array([True, True]), np.array([])], "left": [np.array([True, False]), None]}
        model = self.model()
        model["sections"][0]["on"] = "all"
        self.same(osculate.run(model, mesh=mesh))
        model["sections"] = [{**model["sections"][0], "on": "left"}]
        with self.assertRaisesRegex(osculate.InputError, "section"):
            osculate.run(model, mesh=mesh)

    def test_sets_that_are_no_numbers_of_nodes_or_cells_are_refused(self):
        for change, part in (({"point_sets": {"top": [True, False]}}, "set 'top': expected a mask of 6"),
                             ({"point_sets": {"top": [3.7, 4]}}, "set 'top': expected whole numbers"),
                             ({"point_sets": {"top": [6]}}, "set 'top': expected numbers from 0 to 5, got 6"),
                             ({"point_sets": {"top": [-1]}}, "set 'top': expected numbers from 0"),
                             ({"cell_sets": {"some": [[2], None]}}, "set 'some': expected numbers from 0 to 1, got 2"),
                             ({"cell_sets": {"some": [[0.5], None]}}, "set 'some': expected whole numbers"),
                             ({"cells": [("quad4", np.array(self.quads, dtype=float))]}, "nodes of cells quad4"),
                             ({"cells": [("quad4", [[True, False, True, False]])]}, "truth values")):
            with self.subTest(part=part), self.assertRaisesRegex(osculate.InputError, part):
                osculate.run(self.model(), mesh={**self.mesh(), **change})

    def test_paths_are_relative_to_the_base(self):
        with tempfile.TemporaryDirectory() as folder:
            osculate.write_gmsh(self.mesh(), os.path.join(folder, "block.msh"))
            self.same(osculate.run({**self.model(), "mesh": "block.msh"}, base=folder))

    def test_forms_for_other_packages(self):
        data = osculate.run(self.model(), mesh=self.mesh()).fields()["bodies"]
        form = data.as_meshio()
        self.assertEqual([(name, nodes.shape) for name, nodes in form["cells"]], [("quad", (2, 4))])
        self.assertEqual(form["cell_data"]["CellNumber"][0].tolist(), [1, 2])
        cells, types, points = data.as_pyvista()
        np.testing.assert_array_equal(cells.reshape(2, 5)[:, 0], 4)
        np.testing.assert_array_equal(cells.reshape(2, 5)[:, 1:], self.quads)
        np.testing.assert_array_equal(types, 9)

    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
    def test_history_is_drawn(self):
        os.environ.setdefault("MPLBACKEND", "agg")
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "history.png")
            axes = osculate.run(block()).plot_history("c.normal_force", file=file)
            np.testing.assert_allclose(axes.lines[0].get_ydata()[-1], 16)
            self.assertEqual(axes.get_ylabel(), "[force]")
            self.assertEqual(pathlib.Path(file).read_bytes()[:4], b"\x89PNG")
        with self.assertRaisesRegex(KeyError, "no column"):
            osculate.run(block()).plot_history("none")

    def test_deformed_meshes_are_drawn(self):
        result = osculate.run(block())
        last = result.increments[-1]
        axes = last.plot(np.arange(len(last["U"])))
        faces = axes.collections[0].get_paths()
        quads = [nodes for name, nodes in last.parts["bodies"].cells if name.startswith("quad")]
        self.assertEqual(len(faces), sum(map(len, quads)))
        moved = (last.parts["bodies"].points + 3 * last["U"])[quads[0][0, :4], :2]
        drawn = {tuple(corner) for corner in last.plot("U", scale=3).collections[0].get_paths()[0].vertices[:4]}
        self.assertEqual(drawn, {tuple(corner) for corner in moved})
        with self.assertRaisesRegex(ValueError, "nodes has [0-9]+ rows; this one has 1"):
            last.plot([1.0])
        self.assertEqual(result._repr_png_()[:4], b"\x89PNG")
        self.assertIsNone(osculate.Increment(result, "none", 0, 0.0, {}, {})._repr_png_())

    def test_faces_inside_a_body_are_not_drawn(self):
        two = [("hexahedron", np.array([[0, 1, 2, 3, 4, 5, 6, 7], [4, 5, 6, 7, 8, 9, 10, 11]])),
               ("tetra10", np.array([[12, 13, 14, 15, 0, 0, 0, 0, 0, 0]]))]
        faces = _plot.outer_faces(two)
        self.assertEqual(len(faces), 10 + 4)
        self.assertNotIn({4, 5, 6, 7}, [set(face) for face in faces])


if __name__ == "__main__":
    unittest.main()
