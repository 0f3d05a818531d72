"""One cell or one material point by itself, with its tangent by name."""
import math
import os
import tempfile
from dataclasses import dataclass

import numpy as np

from . import _core
from ._comments import comment_of
from ._contact import DerivativeCheck
from ._errors import InputError
from ._laws import forget, reraise
from ._mesh import _CELLS, _block, write_gmsh


@dataclass(frozen=True)
@comment_of("osculate::solid::ElementResult", "osculate::solid::PointStress")
class ElementParts:
    """What a cell is at one displacement: n nodes in d dimensions, q points, c components (plane 4: xx, yy, zz, xy; in
    space 6: and yz, zx).

    force           internal forces of the nodes one behind the other, (n d)
    tangent         their derivative, (n d, n d)
    stress, strain  of each point: Cauchy's; Green and Lagrange's or the small one (shear: half the angle), (q, c)
    points, volume  places and volumes of the points in the undeformed cell, (q, d) and (q)
    before, after   what the points remember at the beginning of the increment (None: nothing yet), and at its end
    """

    force: np.ndarray
    tangent: np.ndarray
    stress: np.ndarray
    strain: np.ndarray
    points: np.ndarray
    volume: np.ndarray
    before: np.ndarray | None
    after: np.ndarray


@dataclass(frozen=True)
@comment_of("osculate::material::response")
class MaterialAnswer:
    """What a material says to a strain.

    stress    components 11, 22, 33, 12, 23, 13
    tangent   their derivative by the strain, (6, 6)
    after     what the point remembers at the end of the increment
    """

    stress: np.ndarray
    tangent: np.ndarray
    after: np.ndarray


def _one_cell(type, coordinates, material, section, base):
    """A model of one cell, as the reader of model files takes it."""
    if not hasattr(material, "items"):
        raise InputError(f"material: expected an entry of `materials`, such as {{'neo_hooke': {{'E': 10, 'nu': 0.3}}}}, got {material!r}")
    points = np.asarray(coordinates, dtype=float)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise InputError(f"coordinates: expected one row of 2 or 3 numbers a node, got an array of shape {points.shape}")
    ours, nodes = _block(type, np.arange(len(points))[None, :], False, len(points))
    if _CELLS[ours][0] != points.shape[1]:
        raise InputError(f"a cell {type} is not one of {points.shape[1]} dimensions")
    if not np.array_equal(nodes[0], np.arange(len(points))):
        raise InputError(f"a cell {type} has its nodes in another order: give them in Gmsh's, as {ours}")
    keys = {"element": "plane_strain" if points.shape[1] == 2 else "solid", **section}
    with tempfile.TemporaryDirectory(prefix="osculate-") as folder:
        mesh = os.path.join(folder, "mesh.msh")
        write_gmsh({"points": points, "cells": [(ours, nodes, "cell")]}, mesh)
        library = {name: _beside(law, base) for name, law in material.items()}
        return _call(_core.Element, {
            "osculate": 1, "mesh": mesh, "materials": {"material": library},
            "sections": [{"on": "cell", "material": "material", **keys}],
            "steps": [{"name": "step", "increments": 1, "duration": 1, "prescribe": [
                {"on": "cell", **dict.fromkeys(("ux", "uy", "uz")[:points.shape[1]], 0)}]}]})


def _beside(law, base):
    """A law with the path of its library relative to the folder `base`."""
    if not hasattr(law, "items") or "library" not in law:
        return law
    return {**law, "library": os.path.abspath(os.path.join(os.fspath(base) if base is not None else "", law["library"]))}


def _call(function, *arguments):
    """A call under which functions of the user may raise: that is what is raised then."""
    forget()
    try:
        out = function(*arguments)
    except Exception:
        reraise()
        raise
    reraise()
    return out


def _order(value, difference, step):
    """DerivativeCheck of differences with a step and half of it against the derivative `value`."""
    scale = max(np.abs(value).max(), np.finfo(float).tiny)
    errors = [np.abs(difference(h) - value).max() / scale for h in (step, step / 2)]
    exact = max(errors) < 1e-9
    order = math.log2(errors[0] / errors[1]) if errors[1] > 0 and errors[0] > 0 else math.inf
    return DerivativeCheck(error=float(errors[1]), order=float(order), exact=exact, same_states=True,
                           passed=bool(exact or (1.8 < order < 2.2 and errors[1] < 0.01)))


class Element:
    """A cell of a body by itself: forces, tangent, stresses and what its points remember.

    type          of the cell: "quad4", "hex20", ... (docs/conventions.md)
    coordinates   of its nodes in Gmsh's order, undeformed, (n, d)
    material      an entry of `materials` of model dictionaries, such as {"neo_hooke": {"E": 10, "nu": 0.3}}
    base          folder that the path of a library in it is relative to; default: the present one
    section       the keys of an entry of `sections` (`osculate doc sections`): element ("plane_strain" in the plane,
                  "solid" in space), kinematics, formulation, thickness, orientation; defaults are the program's

    Errors: InputError, as the program says it.
    """

    def __init__(self, type, coordinates, material, *, base=None, **section):
        self._core = _one_cell(type, coordinates, material, section, base)
        self.coordinates = np.array(coordinates, dtype=float)

    @property
    def finite(self):
        """Whether the strains are finite."""
        return self._core.finite

    @property
    def state(self):
        """Names of the numbers that each point remembers ("": it is shown nowhere)."""
        return self._core.state

    def at(self, displacement, before=None, *, duration=1.0):
        """ElementParts at a displacement of the nodes (n, d); before: `after` of an earlier one, None: nothing has
        happened yet. duration: of the increment, for materials that depend on time. Errors: Refused where the cell is
        turned inside out or the material has no answer."""
        found = _call(self._core.at, np.asarray(displacement, dtype=float), before, duration)
        return ElementParts(**found, before=before)

    def derivative_check(self, displacement, before=None, *, duration=1.0, step=1e-4):
        """The tangent against central differences of the force, by the order of their error (DerivativeCheck).
        step: of the displacements, in units of the largest extent of the cell."""
        u = np.array(displacement, dtype=float).reshape(-1)
        return _checked(lambda v: self.at(v, before, duration=duration), "force", u,
                        step, np.ptp(self.coordinates, axis=0).max())


def _checked(at, name, x, step, size=1.0):
    """DerivativeCheck of the tangent of `at(x)` against differences of its `name`, with steps in units of `size`."""
    return _order(at(x).tangent, lambda h: _central(lambda v: getattr(at(v), name), x, h * size), step)


def _central(function, x, h):
    columns = []
    for i in range(x.size):
        e = np.zeros_like(x)
        e[i] = h
        columns.append((function(x + e) - function(x - e)) / (2 * h))
    return np.stack(columns, axis=-1)


class MaterialPoint:
    """A point of a material in space by itself: any material of the program, a function of `material`, a compiled UMAT.

    material, base, kinematics   as of Element; where `kinematics` is "finite" strain and stress are Green and
                                 Lagrange's and the second one of Piola and Kirchhoff
    Strains have twice the shear. Errors: InputError, as the program says it.
    """

    def __init__(self, material, *, base=None, **section):
        if section.get("element", "solid") != "solid":
            raise InputError(f"element: a point of a material is one in space, of a solid, not {section['element']!r}; plane "
                             "stress and strain are those of an Element", key="element")
        corners = [[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
        self._core = _one_cell("hex8", corners, material, section, base)

    @property
    def finite(self):
        """Whether strain and stress are those of finite strains."""
        return self._core.finite

    @property
    def state(self):
        """Names of the numbers that the point remembers ("": it is shown nowhere)."""
        return self._core.state

    def at(self, strain, before=None, *, duration=1.0):
        """MaterialAnswer to a strain of six components at the end of an increment; before: `after` of an earlier one,
        None: nothing has happened yet. Errors: Refused where the material has no answer."""
        found = _call(self._core.response, np.asarray(strain, dtype=float), before, duration)
        return MaterialAnswer(**found)

    def path(self, strains, *, duration=1.0):
        """Answers to strains one after the other (m, 6), each an increment of that duration: stresses (m, 6)."""
        before, stresses = None, []
        for strain in np.asarray(strains, dtype=float):
            answer = self.at(strain, before, duration=duration)
            before = answer.after
            stresses.append(answer.stress)
        return np.array(stresses)

    def derivative_check(self, strain, before=None, *, duration=1.0, step=1e-4):
        """The tangent against central differences of the stress, by the order of their error (DerivativeCheck).
        step: of the strains. The strain must not be on a border, such as where a metal begins to yield."""
        e = np.array(strain, dtype=float)
        return _checked(lambda v: self.at(v, before, duration=duration), "stress", e, step)
