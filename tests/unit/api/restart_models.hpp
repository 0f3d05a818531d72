#pragma once
// Models that are stopped and go on.

namespace osculate::api::restarted {

inline constexpr const char* plane =
    "osculate: 1\n"
    "mesh: {generate: {block: {box: {x: [0, 2], y: [0, 1], elements: [12, 6]}}, rail: {line: "
    "{points: [[-1, 0], [3, 0]], elements: 7}}}}\n"
    "materials: {m: {st_venant_kirchhoff: {E: 100, nu: 0.3}}}\n"
    "sections: [{on: block, material: m, element: plane_strain}]\n"
    "rigid: {base: {set: rail}}\n"
    "contact: [{name: floor, master: base, slave: block.bottom, normal: {penalty: 1e4}, friction: "
    "{coulomb: {mu: 0.3, penalty: 1e4}}}]\n"
    "steps:\n"
    "  - {name: press, increments: 2, prescribe: [{on: block.top, ux: 0, uy: -0.02}]}\n"
    "  - {name: drag, increments: 8, prescribe: [{on: block.top, ux: 0.1}]}\n"
    "output: {history: [{on: floor, of: normal_force}, {on: floor, of: shear_force}]}\n";

inline constexpr const char* space =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 2], y: [0, 1], z: [0, 1], elements: [6, 3, 3]}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0.25}}}\n"
    "sections: [{on: b, material: m, element: solid}]\n"
    "rigid: {floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}}\n"
    "contact: [{name: c, master: floor, slave: b.bottom, normal: {penalty: 1000}, friction: "
    "{coulomb: {mu: 0.3, penalty: 500}}}]\n"
    "steps:\n"
    "  - {name: press, increments: 2, prescribe: [{on: b.top, ux: 0, uy: 0, uz: -0.02}]}\n"
    "  - {name: drag, increments: 4, prescribe: [{on: b.top, ux: 0.03, uy: 0.04}]}\n"
    "output: {history: [{on: c, of: normal_force}, {on: c, of: force_x}]}\n";

/// A block on another one, by multigrid; the law of the upper one is to be filled in.
inline constexpr const char* by_multigrid =
    "osculate: 1\n"
    "mesh: {generate: {low: {box: {x: [0, 2], y: [0, 2], z: [0, 1], elements: [8, 8, 5]}}, up: "
    "{box: {x: [0.3, 1.7], y: [0.3, 1.7], z: [1, 1.6], elements: [5, 5, 3]}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0.3}}, u: {LAW: {E: 100, nu: 0.3}}}\n"
    "sections: [{on: low, material: m, element: solid}, {on: up, material: u, element: solid}]\n"
    "contact: [{name: c, master: low.top, slave: up.bottom, friction: {coulomb: {mu: 0.3}}}]\n"
    "steps:\n"
    "  - {name: press, increments: 2, prescribe: [{on: low.bottom, ux: 0, uy: 0, uz: 0}, {on: "
    "up.top, ux: 0, uy: 0, uz: -0.02}]}\n"
    "  - {name: drag, increments: 12, prescribe: [{on: up.top, ux: 0.1, uy: 0.05}]}\n"
    "solver: {linear: multigrid}\n"
    "output: {history: [{on: c, of: normal_force}, {on: c, of: force_x}]}\n";

/// A disc that is thrown on a block whose base is shaken; time steps by their errors, after another
/// step with inertia.
inline constexpr const char* thrown =
    "osculate: 1\n"
    "mesh: {generate: {block: {box: {x: [-2, 2], y: [-1, 0], elements: [4, 2]}}}}\n"
    "materials: {m: {neo_hooke: {E: 1000, nu: 0.3, density: 0.5}}}\n"
    "sections: [{on: block, material: m, element: plane_strain}]\n"
    "rigid: {disc: {circle: {center: [0.3, 1.03], radius: 1}, mass: 2}}\n"
    "contact: [{name: c, master: disc, slave: block.top, normal: {penalty: 900}, friction: "
    "{coulomb: {mu: 0.4, penalty: 700}}}]\n"
    "initial_velocity: [{on: disc, vx: 0.3, vy: -1, wz: 2}]\n"
    "amplitudes: {shake: [[0, 0], [0.23, 1], [0.4, 0], [1, 0]]}\n"
    "steps:\n"
    "  - {name: fly, increments: 2, duration: 0.01, dynamics: {}, prescribe: [{on: block.bottom, "
    "ux: "
    "0, uy: 0}]}\n"
    "  - {name: hit, increments: 3, duration: 0.1, gravity: [0, -9.81], dynamics: {damping: {mass: "
    "0.3}, time_steps: {error: 0.02}}, prescribe: [{on: block.bottom, ux: 0.01, uy: 0, amplitude: "
    "shake}]}\n"
    "output: {history: [{on: c, of: normal_force}, {on: disc, of: vy}], checkpoint: 1}\n";

/// A linear block of many unknowns, of which few are iterated on.
inline constexpr const char* linear =
    "osculate: 1\n"
    "mesh: {generate: {block: {box: {x: [0, 2], y: [0, 1], elements: [60, 30]}}, rail: {line: "
    "{points: [[-1, 0], [3, 0]], elements: 7}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}\n"
    "sections: [{on: block, material: m, element: plane_strain}]\n"
    "rigid: {base: {set: rail}}\n"
    "contact: [{name: floor, master: base, slave: block.bottom, normal: {penalty: 1e4}, friction: "
    "{coulomb: {mu: 0.3, penalty: 1e4}}}]\n"
    "steps:\n"
    "  - {name: press, increments: 2, prescribe: [{on: block.top, ux: 0, uy: -0.02}]}\n"
    "  - {name: drag, increments: 4, prescribe: [{on: block.top, ux: 0.01}]}\n"
    "output: {history: [{on: floor, of: normal_force}, {on: floor, of: shear_force}]}\n";

/// A plastic block that is bent over a rail and back, small and finite strains side by side.
inline constexpr const char* plastic =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 4], y: [0, 1], elements: [8, 2]}}, c: {box: {x: [0, 4], y: "
    "[2, 3], elements: [8, 2]}}}}\n"
    "materials: {m: {elastoplastic: {E: 200, nu: 0.3, hardening: [[1, 0], [1.2, 0.02]], kinematic: "
    "5}}}\n"
    "sections: [{on: b, material: m, element: plane_strain, kinematics: finite}, {on: c, material: "
    "m, element: plane_stress}]\n"
    "rigid: {rail: {circle: {center: [2, -1], radius: 1}}}\n"
    "contact: [{name: on, master: rail, slave: b.bottom, friction: {coulomb: {mu: 0.2}}}]\n"
    "steps:\n"
    "  - {name: bend, increments: 4, prescribe: [{on: rail, ux: 0, uy: 0.2, rz: 0}, {on: [b.left, "
    "b.right, c.left], ux: 0, uy: 0}, {on: c.right, ux: 0.05, uy: 0.2}]}\n"
    "  - {name: back, increments: 3, prescribe: [{on: rail, uy: 0.05}, {on: c.right, uy: 0}]}\n"
    "output: {history: [{on: on, of: normal_force}, {on: c.right, of: rfy}]}\n";

/// A creeping block that is dragged over a floor whose friction ages.
inline constexpr const char* creeping =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 4], y: [0, 1], elements: [4, 2]}}}}\n"
    "materials: {m: {norton: {E: 200, nu: 0.3, A: 0.1, n: 3}}}\n"
    "sections: [{on: b, material: m, element: plane_strain}]\n"
    "rigid: {floor: {line: {point: [0, 0], normal: [0, 1]}}}\n"
    "contact: [{name: on, master: floor, slave: b.bottom, normal: {penalty: 1000}, friction: "
    "{rate_and_state: {mu: 0.5, a: 0.01, b: 0.015, speed: 0.1, distance: 0.02, penalty: 1000}}}]\n"
    "steps:\n"
    "  - {name: press, increments: 2, duration: 1, prescribe: [{on: b.top, ux: 0, uy: -0.01}]}\n"
    "  - {name: drag, increments: 5, duration: 1, prescribe: [{on: b.top, ux: 0.1}]}\n"
    "output: {history: [{on: on, of: normal_force}, {on: on, of: shear_force}]}\n";

/// A bar that is stretched, and then moves along its vibrations in two steps.
inline constexpr const char* ringing =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 4], y: [0, 1], elements: [8, 2]}}}}\n"
    "materials: {m: {st_venant_kirchhoff: {E: 100, nu: 0.3, density: 1}}}\n"
    "sections: [{on: b, material: m, element: plane_strain}]\n"
    "amplitudes: {bent: [[0, 1], [0.3, 0], [1, 2]]}\n"
    "steps:\n"
    "  - {name: stretch, increments: 2, prescribe: [{on: b.left, ux: 0, uy: 0}], total_force: "
    "[{on: "
    "b.right, fx: 1}]}\n"
    "  - {name: free, modes: 3}\n"
    "  - {name: ring, increments: 3, duration: 2, modal: {damping: {ratio: 0.02}}, total_force: "
    "[{on: "
    "b.right, fy: 0.1, amplitude: bent}]}\n"
    "  - {name: on, increments: 2, duration: 1, modal: {}}\n"
    "output: {history: [{on: b.right, of: uy}, {on: b.right, of: vy}, {on: b.left, of: rfy}]}\n";

/// A bar that swings with loads and with its support, at some frequencies.
inline constexpr const char* swinging =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 4], y: [0, 1], elements: [8, 2]}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0.3, density: 1}}}\n"
    "sections: [{on: b, material: m, element: plane_strain}]\n"
    "steps:\n"
    "  - {name: hold, increments: 1, prescribe: [{on: b.left, ux: 0, uy: 0}]}\n"
    "  - {name: free, modes: 3}\n"
    "  - {name: swing, harmonic: {from: 0.1, to: 0.7, points: 3, damping: {ratio: 0.02}}, "
    "total_force: [{on: b.right, fy: 0.1, phase: 30}], prescribe: [{on: b.left, ux: 0.1}]}\n"
    "  - {name: on, harmonic: {from: 0.2, to: 0.2}, total_force: [{on: b.right, fx: 1}]}\n"
    "output: {history: [{on: b.right, of: uy}, {on: b.right, of: vy}, {on: b.left, of: rfy}]}\n";

/// Runs that end with warnings of what was on the way: a beam that is bent and straightened again,
/// a block that moves away from a floor that was nearest at first, a body that goes past its slave,
/// blocks that go through a floor and that gain energy in explicit time integration.
/// Conditions that say the same twice, and a second step that lets a side go.
inline constexpr const char* conditioned =
    R"(osculate: 1
mesh: {generate: {b: {box: {x: [2, 3], y: [0, 1], z: [0, 2], elements: [2, 2, 2]}}}}
materials: {n: {linear_elastic: {E: 1500, nu: 0.25}}}
sections: [{on: b, material: n, element: solid}]
coplanar: [{on: b.top}]
collinear: [{on: b.top_front}]
sets: {rod: {union: [b.top_back_left, b.bottom_front_right]}}
fixed_distance: [{on: rod}]
steps:
  - {name: press, increments: 4, prescribe: [{on: b.bottom, ux: 0, uy: 0, uz: 0}, {on: b.top_back_right, ux: 0}],
     forces: [{on: b.top_front_left, fx: 5, fz: -9}]}
  - {name: let_go, increments: 4, release: [{on: b.top_back_right, of: [ux]}], forces: [{on: b.top_front_left, fx: 8, fz: -2}]}
output: {history: [{on: b.top_front_left, of: ux}, {on: b.top_back_right, of: ux}]}
)";

inline constexpr const char* bent =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 10], y: [0, 1], elements: [10, 1]}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}\n"
    "sections: [{on: b, material: m, element: plane_stress, formulation: full}]\n"
    "steps:\n"
    "  - {name: bend, increments: 2, prescribe: [{on: b.left, ux: 0, uy: 0}, {on: b.right, uy: "
    "-4}]}\n"
    "  - {name: back, increments: 2, prescribe: [{on: b.right, uy: 0}]}\n";
inline constexpr const char* leaving =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 2], y: [0, 1], elements: [2, 2]}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0}}}\n"
    "sections: [{on: b, material: m, element: plane_strain}]\n"
    "rigid: {floor: {line: {point: [0, -0.01], normal: [0, 1]}}}\n"
    "contact: [{name: c, master: floor, slave: b.bottom}]\n"
    "steps: [{name: s, increments: 2, prescribe: [{on: b.top, ux: 0, uy: 0.02}]}]\n";
inline constexpr const char* beside =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [0, 10], y: [0, 10], elements: [8, 8]}}}}\n"
    "materials: {m: {neo_hooke: {E: 3, nu: 0.45}}}\n"
    "sections: [{on: b, material: m, element: plane_strain, formulation: bbar}]\n"
    "rigid: {low: {line: {point: [0, 0], normal: [0, 1]}}, up: {line: {point: [0, 10], normal: "
    "[0, -1]}}}\n"
    "contact: [{name: l, master: low, slave: b.bottom, friction: {coulomb: {mu: 0.5}}}, {name: u, "
    "master: up, slave: b.top, friction: {coulomb: {mu: 0.5}}}]\n"
    "steps: [{name: s, increments: 12, prescribe: [{on: low, ux: 0, uy: 0, rz: 0}, {on: up, ux: 0, "
    "uy: -4.2, rz: 0}]}]\n";
inline constexpr const char* bouncing =
    "osculate: 1\n"
    "mesh: {generate: {cells: {box: {x: [0, 2], y: [0.04, 1], elements: [1, 1]}}}}\n"
    "rigid: {block: {set: cells, mass: 2, inertia: 1.5}, floor: {line: {point: [0, 0], normal: [0, "
    "1]}}}\n"
    "contact: [{name: c, master: floor, slave: cells.bottom, weight: node, normal: {table: [[0, 0],"
    " [0.001, 0.1], [0.002, 10]]}}]\n"
    "initial_velocity: [{on: block, vy: -1}]\n"
    "steps: [{name: fall, increments: 3, duration: 0.3, dynamics: {scheme: "
    "central_differences}}]\n";
inline constexpr const char* falling =
    "osculate: 1\n"
    "mesh: {generate: {b: {box: {x: [-1, 1], y: [0.01, 1], elements: [8, 4]}}}}\n"
    "materials: {m: {neo_hooke: {E: 2.0e3, nu: 0.4, density: 1}}}\n"
    "sections: [{on: b, material: m, element: plane_strain}]\n"
    "rigid: {floor: {line: {point: [0, 0], normal: [0, 1]}}}\n"
    "contact: [{name: c, master: floor, slave: b.bottom, search: {depth: 1.0e-4}}]\n"
    "initial_velocity: [{on: b, vy: -6}]\n"
    "steps: [{name: fall, increments: 6, duration: 0.006, dynamics: {scheme: "
    "central_differences}}]\n";

}  // namespace osculate::api::restarted
