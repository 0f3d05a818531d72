"""Small models that the tests share."""


def block(**changes):
    """A block on a rigid line that carries its weight and is pushed."""
    model = {
        "osculate": 1, "title": "Block on a line",
        "parameters": {"mu": 0.3, "side": 0.1},
        "mesh": {"generate": {"block": {"box": {"x": [0, 4], "y": [0, 2], "elements": [8, 4]}}}},
        "materials": {"s": {"linear_elastic": {"E": 1.0e4, "nu": 0.3}}},
        "sections": [{"on": "block", "material": "s", "element": "plane_strain"}],
        "rigid": {"floor": {"line": {"point": [0, 0], "normal": [0, 1]}}},
        "contact": [{"name": "c", "master": "floor", "slave": "block.bottom", "normal": {"penalty": 1.0e6},
                     "friction": {"coulomb": {"mu": "=mu", "penalty": 1.0e6}}}],
        "steps": [{"name": "weight", "increments": 2, "body_force": [{"on": "block", "fx": "=side", "fy": -1}]},
                  {"name": "more", "increments": 2, "body_force": [{"on": "block", "fy": -2}]}],
        "output": {"history": [{"on": "c", "of": "normal_force"}, {"on": "c", "of": "shear_force"}]},
    }
    model.update(changes)
    return model


YAML = """osculate: 1
title: Block on a line
parameters: {mu: 0.3, side: 0.1}
mesh: {generate: {block: {box: {x: [0, 4], y: [0, 2], elements: [8, 4]}}}}
materials: {s: {linear_elastic: {E: 1.0e4, nu: 0.3}}}
sections: [{on: block, material: s, element: plane_strain}]
rigid: {floor: {line: {point: [0, 0], normal: [0, 1]}}}
contact: [{name: c, master: floor, slave: block.bottom, normal: {penalty: 1.0e6},
  friction: {coulomb: {mu: =mu, penalty: 1.0e6}}}]
steps:
  - {name: weight, increments: 2, body_force: [{on: block, fx: =side, fy: -1}]}
  - {name: more, increments: 2, body_force: [{on: block, fy: -2}]}
output: {history: [{on: c, of: normal_force}, {on: c, of: shear_force}]}
"""
