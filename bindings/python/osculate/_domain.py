"""From where closest points of a surface are unique."""
import json
import os
import tempfile
from dataclasses import dataclass

import numpy as np

from . import _core
from ._comments import comment_of


@dataclass(frozen=True)
class Domain:
    """What `osculate domain` says of a surface or curve (docs/domains.md).

    facts    as its --json: classes of points, limits above and below with where they are, edges, warnings
    text     what it prints
    points   of the picture, (n, 2) or (n, 3): the surface, sheets of centres of curvature, wedges, cones
    fields   {name: one number a point}: K1, K2, GAUSS, MEAN, CLASS, BOUND_ABOVE, BOUND_BELOW, EVEN_ABOVE, EVEN_BELOW, SINE
    cells    [(type, nodes (m, k), PART (m), facet or knot span (m)), ...]
    """

    facts: dict
    text: str
    points: np.ndarray
    fields: dict
    cells: list


def _plain(value):
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"a surface has numbers, texts, lists and dictionaries, not {value!r}")


@comment_of("osculate::api::survey_domain")
def domain(surface, *, kink=0.01, samples=3000, tolerance=0.01, length=None, output=None, page=None):
    """The projection domain of a surface or curve: `osculate domain`.

    surface     path of a surface file or mesh (MESH.msh:SET), or a dictionary with the keys of a surface file; arrays too
    kink        angle up to which neighbours count as smooth, degrees
    samples     places looked at, about
    tolerance   between the proved and the found reach, as a part of it
    length      how far things without end are drawn; None: the size of the surface
    output      file for ParaView; page: a page with the surface in 3D

    Errors: InputError, as the program says it; Refused for numbers out of their range; OSError.
    """
    numbers = (kink, samples, tolerance, 0.0 if length is None else length,
               *("" if file is None else os.fspath(file) for file in (output, page)))
    if hasattr(surface, "items"):
        with tempfile.TemporaryDirectory(prefix="osculate-") as folder:
            path = os.path.join(folder, "surface.json")
            with open(path, "w") as file:
                json.dump({"osculate_surface": 1, **surface} if "facets" in surface else dict(surface), file, default=_plain)
            found = _core.domain(path, "surface", *numbers)
    else:
        path = os.fspath(surface)
        found = _core.domain(path, path, *numbers)
    facts, *others = found
    return Domain(json.loads(facts), *others)
