"""Small models of every kind of work that several processes share, or do each."""

PLANE = """osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 3], y: [0, 1], elements: [12, 3]}}
    up: {box: {x: [0.3, 1.45], y: [1, 1.8], elements: [6, 3]}}
materials: {m: MATERIAL}
sections: [{on: low, material: m, element: plane_strain}, {on: up, material: m, element: plane_strain}]
contact: CONTACT
steps:
  - {name: press, increments: 2, prescribe: [{on: low.bottom, ux: 0, uy: 0}, {on: up.top, ux: 0, uy: -0.03}]}
  - {name: drag, increments: 4, MOREprescribe: [{on: up.top, ux: 0.3}]}
output: {history: [{on: c, of: normal_force}, {on: c, of: force_x}, {on: up.top, of: rfx}, {on: up.top, of: rfy},
  {on: low.bottom, of: rfy}, {on: up.right, of: ux}]}
"""
SPACE = """osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 3], y: [0, 2], z: [0, 1], elements: [5, 3, 1]}}
    up: {box: {x: [0.3, 1.4], y: [0.4, 1.5], z: [1, 1.8], elements: [3, 3, 2]}}
materials: {m: MATERIAL}
sections: [{on: low, material: m, element: solid}, {on: up, material: m, element: solid}]
contact: CONTACT
steps:
  - {name: press, increments: 2, prescribe: [{on: low.bottom, ux: 0, uy: 0, uz: 0},
      {on: up.top, ux: 0, uy: 0, uz: -0.03}]}
  - {name: drag, increments: 3, prescribe: [{on: up.top, ux: 0.3, uy: 0.1}]}
output: {history: [{on: c, of: normal_force}, {on: c, of: force_x}, {on: up.top, of: rfx}, {on: up.top, of: rfz},
  {on: up.right, of: uy}]}
"""
# Two beams, each with an edge up: one is dragged over the other, edge on edge.
EDGES = """osculate: 1
mesh:
  generate:
    low: {box: {x: [-1.5, 1.5], y: [-0.3, 0.3], z: [-0.3, 0.3], elements: [7, 2, 2], angle: 45,
                axis: [1, 0, 0], about: [0, 0, 0]}}
    high: {box: {x: [-0.3, 0.3], y: [-1.5, 1.5], z: [0.5485, 1.1485], elements: [2, 7, 2], angle: 45,
                 axis: [0, 1, 0], about: [0, 0, 0.8485]}}
materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}
sections: [{on: low, material: m, element: solid}, {on: high, material: m, element: solid}]
contact: [{name: c, master: low, slave: high, normal: {penalty: 2000}, friction: {coulomb: {mu: 0.3}}, edges: true,
           search: {depth: 0.2}}]
steps:
  - name: press
    increments: 2
    prescribe: [{on: low.left, ux: 0, uy: 0, uz: 0}, {on: low.right, ux: 0, uy: 0, uz: 0},
      {on: high.front, ux: 0, uy: 0, uz: -0.05}, {on: high.back, ux: 0, uy: 0, uz: -0.05}]
  - {name: drag, increments: 3, prescribe: [{on: high.front, ux: 0.3}, {on: high.back, ux: 0.3}]}
output: {history: [{on: c, of: normal_force}, {on: c, of: force_x}, {on: low.left, of: rfz}]}
"""
# A ball that turns is thrown on a block, which swings.
BALL = """osculate: 1
mesh: {generate: {low: {box: {x: [-2, 2], y: [-2, 2], z: [-1, 0], elements: [4, 4, 2]}}}}
materials: {m: {linear_elastic: {E: 1000, nu: 0.3, density: 0.5}}}
sections: [{on: low, material: m, element: solid}]
rigid: {ball: {sphere: {center: [0.1, 0.05, 0.99], radius: 1}, mass: 2, inertia: [0.5, 0.8, 1.1, 0.05, -0.1, 0.02]}}
contact: [{name: c, master: ball, slave: low.top, normal: {penalty: 3000}, friction: {coulomb: {mu: 0.3}}}]
initial_velocity: [{on: ball, vx: 3, vz: -1, wx: 20, wy: -10, wz: 30}]
steps:
  - {name: press, increments: 3, duration: 0.03, gravity: [0, 0, -9.81], dynamics: {},
     prescribe: [{on: low.bottom, ux: 0, uy: 0, uz: 0}]}
  - {name: drag, increments: 5, duration: 0.05, dynamics: {scheme: {generalized_alpha: {radius: 0.7}}, mass: lumped,
     damping: {stiffness: 1.0e-4}}}
output: {history: [{on: c, of: normal_force}, {on: ball, of: wx}, {on: ball, of: rx}, {on: ball, of: vz}]}
"""
# The upper block hangs on a rigid plate that a force presses and a moment turns.
PLATE = """osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 3], y: [0, 1], elements: [12, 3]}}
    up: {box: {x: [0.3, 1.45], y: [1, 1.8], elements: [6, 3]}}
materials: {m: {neo_hooke: {E: 100, nu: 0.3}}}
sections: [{on: low, material: m, element: plane_strain}, {on: up, material: m, element: plane_strain}]
rigid: {plate: {set: up.top, reference: [0.9, 1.8]}}
contact: [{name: c, master: low.top, slave: up.bottom, sampling: {gauss: 2}, friction: {coulomb: {mu: 0.3}}}]
steps:
  - {name: press, increments: 2, prescribe: [{on: low.bottom, ux: 0, uy: 0}, {on: plate, ux: 0, uy: -0.03, rz: 0}]}
  - {name: turn, increments: 3, release: [{on: plate, of: [uy, rz]}], prescribe: [{on: plate, ux: 0.1}],
     forces: [{on: plate, fy: -3, mz: 0.2}]}
output: {history: [{on: plate, of: uy}, {on: plate, of: rz}, {on: plate, of: rfx}, {on: c, of: normal_force}]}
"""
# Pressed, then what vibrates and what buckles of it.
MODES = """osculate: 1
mesh: {generate: {b: {box: {x: [0, 4], y: [0, 0.5], elements: [16, 2]}}}}
materials: {m: {linear_elastic: {E: 1000, nu: 0.3, density: 1}}}
sections: [{on: b, material: m, element: plane_strain}]
steps:
  - {name: press, increments: 2, prescribe: [{on: b.left, ux: 0, uy: 0}], forces: [{on: b.right, fx: -0.2}]}
  - {name: modes, modes: 3}
  - {name: buckle, buckling: 2, forces: [{on: b.right, fx: -1}]}
output: {history: [{on: b.right, of: ux}, {on: b.left, of: rfx}]}
"""
# Equations across the block, a hard spring beside it, and layers that yield one after the other.
TIED = """osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 2], y: [0, 1], z: [0, 1], elements: [4, 2, 2]}}
    up: {box: {x: [0, 2], y: [0, 1], z: [1, 1.5], elements: [3, 3, 1]}}
materials: {m: {elastoplastic: {E: 100, nu: 0.3, hardening: [[1, 0], [6, 1]]}}}
sections: [{on: low, material: m, element: solid}, {on: up, material: m, element: solid}]
ties: [{slave: up.bottom, master: low.top}]
steps:
  - {name: press, increments: 3, prescribe: [{on: low.bottom, ux: 0, uy: 0, uz: 0}, {on: up.top, uz: -0.05}]}
  - {name: shear, increments: 3, prescribe: [{on: up.top, ux: 0.08, uy: 0.02}]}
output: {history: [{on: up.top, of: rfx}, {on: up.top, of: rfz}, {on: low.bottom, of: rfy}]}
"""
EXPLICIT = """osculate: 1
mesh: {generate: {b: {box: {x: [0, 1], y: [0.01, 1.01], elements: [6, 6]}}}}
materials: {m: {neo_hooke: {E: 100, nu: 0.3, density: 1}}}
sections: [{on: b, material: m, element: plane_strain}]
rigid: {floor: {polyline: {points: [[-2, 0], [3, 0]]}}}
contact: [{name: c, master: floor, slave: b.bottom, normal: {penalty: 1000}, friction: {coulomb: {mu: 0.2}}}]
initial_velocity: [{on: b, vx: 1, vy: -1}]
steps:
  - {name: fall, increments: 5, duration: 0.2, dynamics: {scheme: central_differences}, prescribe: [{on: floor, ux: 0, uy: 0, rz: 0}]}
output: {history: [{on: b.bottom, of: vy}, {on: c, of: normal_force}]}
"""
# Cells of explicit steps are dealt out in parts of 2048; those that are evaluated one by one in parts of 512.
PARTS = """osculate: 1
mesh: {generate: {b: {box: {x: [0, 1], y: [0.002, 1.002], elements: [60, 60]}},
                  c: {box: {x: [1.5, 2], y: [0.002, 0.502], elements: [24, 24], type: quad8}}}}
materials:
  m: {neo_hooke: {E: 100, nu: 0.3, density: 1}}
  p: {elastoplastic: {E: 100, nu: 0.3, density: 1, hardening: [[1, 0], [11, 1]]}}
sections: [{on: b, material: p, element: plane_strain}, {on: c, material: m, element: plane_strain}]
rigid: {floor: {polyline: {points: [[-2, 0], [3, 0]]}}}
contact:
  - {name: c, master: floor, slave: b.bottom, normal: {penalty: 10000}, friction: {coulomb: {mu: 0.2}}}
  - {name: d, master: floor, slave: c.bottom, normal: {penalty: 10000}}
initial_velocity: [{on: b, vx: 1, vy: -2}, {on: c, vx: 1, vy: -2}]
steps:
  - {name: fall, increments: 4, duration: 0.02, dynamics: {scheme: central_differences}, prescribe: [{on: floor, ux: 0, uy: 0, rz: 0}]}
  - {name: rest, increments: 1, duration: 0.001, dynamics: {scheme: central_differences}, prescribe: [{on: floor, ux: 0, uy: 0, rz: 0}]}
output: {history: [{on: b.bottom, of: vy}, {on: b.top, of: uy}, {on: c, of: normal_force}, {on: d, of: normal_force}, {on: c.top, of: vx}]}
"""
FRICTION = "friction: {coulomb: {mu: 0.3}}"
SVK = "{st_venant_kirchhoff: {E: 100, nu: 0.3}}"
LINEAR = "{linear_elastic: {E: 100, nu: 0.25}}"
PLASTIC = "{elastoplastic: {E: 100, nu: 0.3, hardening: [[1, 0], [11, 1]]}}"


def pair(more):
    return "[{name: c, master: low.top, slave: up.bottom, %s, %s}]" % (FRICTION, more)


def of(model, contact, material=SVK, more=""):
    return model.replace("CONTACT", contact).replace("MATERIAL", material).replace("MORE", more)


# What an increment has added to the matrix, a step that every process takes by itself, and increments again.
BETWEEN = of(PLANE, pair("sampling: nodes"), SVK.replace("}}", ", density: 0.01}}")).replace(
    "  - {name: drag", "  - {name: look, modes: 2}\n  - {name: drag")

# Contact begins in the first step, farther away than a cell is high: then other nodes are dealt out together.
AFAR = PLANE.replace("y: [1, 1.8]", "y: [1.5, 2.3]").replace("uy: -0.03", "uy: -0.53")
SPACE_AFAR = SPACE.replace("z: [1, 1.8]", "z: [1.5, 2.3]").replace("uz: -0.03", "uz: -0.53")


def by_multigrid(model):
    return of(model, pair("sampling: nodes"), LINEAR).replace("[5, 3, 1]", "[12, 8, 4]").replace(
        "[3, 3, 2]", "[6, 6, 5]").replace("output:", "solver: {linear: multigrid}\noutput:")


MODELS = {
    "nodes with friction": of(PLANE, pair("sampling: nodes")),
    "smoothed master": of(PLANE, pair("sampling: {gauss: 2}, smoothing: hermite")),
    "multipliers at nodes": of(PLANE, pair("enforcement: lagrange_multiplier")),
    "augmented at Gauss points": of(PLANE, pair("sampling: {gauss: 2}, enforcement: augmented_lagrange")),
    "all with all": of(PLANE, "{all: {name: c, %s}}" % FRICTION),
    "plastic": of(PLANE, pair("sampling: {lobatto: 3}"), PLASTIC),
    "swung": of(PLANE, pair("sampling: mortar"), SVK.replace("}}", ", density: 0.01}}"),
                "duration: 0.04, dynamics: {}, "),
    "swung and plastic": of(PLANE, pair("sampling: nodes"), PLASTIC.replace("}}", ", density: 0.01}}"),
                            "duration: 0.04, dynamics: {}, "),
    "by multigrid": by_multigrid(SPACE),
    "from afar": of(AFAR, pair("sampling: nodes")),
    "from afar by multigrid": by_multigrid(SPACE_AFAR),
    "Gauss points in space": of(SPACE, pair("sampling: {gauss: 2}"), LINEAR),
    "multipliers of mortar in space": of(SPACE, pair("sampling: mortar, enforcement: lagrange_multiplier"), LINEAR),
    "edges": EDGES,
    "modes between": BETWEEN,
    "ball": BALL,
    "plate": PLATE,
    "modes": MODES,
    "tied and plastic": TIED,
    "explicit": EXPLICIT,
    "explicit in parts": PARTS,
}
# Of histories, where each way of solving has iterations of its own, to 1e-10 of the forces; seen: 4e-10.
TOLERANCES = {"by multigrid": 1e-8, "from afar by multigrid": 1e-8}
SAME_BITS = {"explicit", "explicit in parts"}
# In the repository; without the folder of results.
FILES = {
    "bodies come and go": "verification/body_changes/parallel.yaml",
    "bodies change their material": "verification/body_changes/series.yaml",
    "pairs change": "verification/pair_changes/block.yaml",
    "coupling": "verification/coupling/bar.yaml",
    "bolts": "examples/bolted_joint/joint.inp",
    "own surface": "examples/clip/clip.yaml",
}
