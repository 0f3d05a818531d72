"""Restart in the middle of an analysis, for every kind of contact. Usage: test_restart_contact.py PROGRAM"""
import json
import shutil
import signal
import subprocess
import sys
import unittest

from restart_case import RestartCase

# A block is pressed on another one and dragged along it; a small one, to be run often.
PLANE = """osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 3], y: [0, 1], elements: [12, 3]}}
    up: {box: {x: [0.3, 1.45], y: [1, 1.8], elements: [6, 3]}}
materials: {m: {st_venant_kirchhoff: {E: 100, nu: 0.3}}}
sections: [{on: low, material: m, element: plane_strain}, {on: up, material: m, element: plane_strain}]
contact: CONTACT
steps:
  - {name: press, increments: 2, prescribe: [{on: low.bottom, ux: 0, uy: 0}, {on: up.top, ux: 0, uy: -0.03}]}
  - {name: drag, increments: 6, prescribe: [{on: up.top, ux: 0.4}]}
output: {history: [{on: c, of: normal_force}, {on: c, of: force_x}, {on: c, of: max_penetration}]}
"""
SPACE = """osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 3], y: [0, 2], z: [0, 1], elements: [5, 3, 1]}}
    up: {box: {x: [0.3, 1.4], y: [0.4, 1.5], z: [1, 1.8], elements: [3, 3, 2]}}
materials: {m: {linear_elastic: {E: 100, nu: 0.25}}}
sections: [{on: low, material: m, element: solid}, {on: up, material: m, element: solid}]
contact: CONTACT
steps:
  - {name: press, increments: 2, prescribe: [{on: low.bottom, ux: 0, uy: 0, uz: 0},
      {on: up.top, ux: 0, uy: 0, uz: -0.03}]}
  - {name: drag, increments: 5, prescribe: [{on: up.top, ux: 0.45, uy: 0.1}]}
output: {history: [{on: c, of: normal_force}, {on: c, of: force_x}, {on: c, of: force_y}]}
"""
# Two beams, each with an edge up: one is dragged over the other, edge on edge.
BEAMS = """osculate: 1
mesh:
  generate:
    low: {box: {x: [-1.5, 1.5], y: [-0.3, 0.3], z: [-0.3, 0.3], elements: [7, 2, 2], angle: 45,
                axis: [1, 0, 0], about: [0, 0, 0]}}
    high: {box: {x: [-0.3, 0.3], y: [-1.5, 1.5], z: [0.5485, 1.1485], elements: [2, 7, 2], angle: 45,
                 axis: [0, 1, 0], about: [0, 0, 0.8485]}}
materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}
sections: [{on: low, material: m, element: solid}, {on: high, material: m, element: solid}]
contact: CONTACT
steps:
  - name: press
    increments: 2
    prescribe: [{on: low.left, ux: 0, uy: 0, uz: 0}, {on: low.right, ux: 0, uy: 0, uz: 0},
      {on: high.front, ux: 0, uy: 0, uz: -0.05}, {on: high.back, ux: 0, uy: 0, uz: -0.05}]
  - {name: drag, increments: 5, prescribe: [{on: high.front, ux: 0.4}, {on: high.back, ux: 0.4}]}
output: {history: [{on: c, of: normal_force}, {on: c, of: force_x}]}
"""
# A ball that turns is thrown on a block, which swings.
THROWN = """osculate: 1
mesh: {generate: {low: {box: {x: [-2, 2], y: [-2, 2], z: [-1, 0], elements: [4, 4, 2]}}}}
materials: {m: {linear_elastic: {E: 1000, nu: 0.3, density: 0.5}}}
sections: [{on: low, material: m, element: solid}]
rigid: {ball: {sphere: {center: [0.1, 0.05, 0.99], radius: 1}, mass: 2, inertia: [0.5, 0.8, 1.1, 0.05, -0.1, 0.02]}}
contact: CONTACT
initial_velocity: [{on: ball, vx: 3, vz: -1, wx: 20, wy: -10, wz: 30}]
steps:
  - {name: press, increments: 3, duration: 0.03, gravity: [0, 0, -9.81], dynamics: {},
     prescribe: [{on: low.bottom, ux: 0, uy: 0, uz: 0}]}
  - {name: drag, increments: 5, duration: 0.05, dynamics: {scheme: {generalized_alpha: {radius: 0.7}}, mass: lumped,
     damping: {stiffness: 1.0e-4}}}
output: {history: [{on: c, of: normal_force}, {on: ball, of: wx}, {on: ball, of: rx}]}
"""
SWUNG = PLANE.replace("nu: 0.3}", "nu: 0.3, density: 0.01}").replace(
    "name: drag, increments: 6,", "name: drag, increments: 6, duration: 0.06, dynamics: {},")
FRICTION = "friction: {coulomb: {mu: 0.3}}"


def pair(more):
    return "[{name: c, master: low.top, slave: up.bottom, %s, %s}]" % (FRICTION, more)


def everything(more=""):
    return "{all: {name: c, %s%s}}" % (FRICTION, more)


KINDS = {
    "mortar": pair("sampling: mortar"),
    "multipliers at nodes": pair("enforcement: lagrange_multiplier"),
    "multipliers of mortar": pair("sampling: mortar, enforcement: lagrange_multiplier"),
    "augmented at nodes": pair("enforcement: augmented_lagrange"),
    "augmented in one loop": pair("enforcement: {augmented_lagrange: {loop: single}}"),
    "augmented at Gauss points": pair("sampling: {gauss: 2}, enforcement: augmented_lagrange"),
    "augmented mortar": pair("sampling: mortar, enforcement: augmented_lagrange"),
    "all": everything(),
    "all, augmented": everything(", enforcement: augmented_lagrange"),
}
EDGES = {
    "edges": "[{name: c, master: low, slave: high, normal: {penalty: 2000}, %s, edges: true, "
             "search: {depth: 0.2}}]" % FRICTION,
    "all with edges": everything(", normal: {penalty: 2000}, edges: true"),
}


class RestartOfContact(RestartCase):
    def go_on(self, iterations, restart, ends):
        """One process that ends in the middle: after so many iterations, which drops the increment that
        is under way, or before that `ends` it, a signal and after how many increments it is sent."""
        with subprocess.Popen(self.command("parts", "--max-iterations", str(iterations), *restart),
                              cwd=self.folder.name, stderr=subprocess.PIPE, text=True) as program:
            increments = 0
            text = ""
            for line in program.stderr:
                text += line
                increments += line.startswith(("press  ", "drag  "))
                if ends and increments == ends[1]:
                    program.send_signal(ends[0])
        self.assertIn(program.returncode, (3, -signal.SIGKILL), text)
        if restart:
            self.assertIn("restart after increment", text)

    def expect_the_same_in_parts(self, model, contact, share):
        self.write(model.replace("CONTACT", contact).replace("output: {", "output: {checkpoint: 1, "))
        self.run_to_end("whole")
        with open(self.path("whole", "summary.json")) as file:
            summary = json.load(file)
        last = [increment for step in summary["steps"] for increment in step["increments"]][-1]
        self.assertGreater(last["stick"] + last["slipping"] + last["closed"], 0)  # still in contact
        part = summary["total"]["iterations"] // share
        self.go_on(part, [], None)
        self.go_on(part, ["--restart"], (signal.SIGKILL, 2))
        self.go_on(part, ["--restart"], (signal.SIGINT, 1))
        self.assertIn("restart after increment", self.run_to_end("parts", "--restart").stderr)
        self.expect_the_same("parts", "whole")

    def in_parts(self, model, kinds):
        """Three ends each, from kind to kind in other places."""
        for number, (name, contact) in enumerate(kinds.items()):
            with self.subTest(kind=name):
                self.expect_the_same_in_parts(model, contact, 4 + number % 3)
            for folder in ("whole", "parts"):
                shutil.rmtree(self.path(folder), ignore_errors=True)

    def test_every_kind_of_contact_in_the_plane(self):
        self.in_parts(PLANE, KINDS)

    def test_every_kind_of_contact_in_space(self):
        self.in_parts(SPACE, KINDS)

    def test_steps_with_inertia(self):
        of_swung = {"penalty": pair("sampling: nodes"), "mortar": KINDS["mortar"]}
        self.in_parts(SWUNG, {**of_swung, "multipliers": KINDS["multipliers at nodes"]})
        self.in_parts(THROWN, {"ball": "[{name: c, master: ball, slave: low.top, normal: {penalty: 3000}, %s}]" % FRICTION})

    def test_contact_of_edges(self):
        self.in_parts(BEAMS, EDGES)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[2:])
