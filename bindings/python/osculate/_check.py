"""What is asked of a model or of results beside a run: its check, its tangent, its picture, two results side by side."""
import contextlib
import json
import os
import tempfile
from dataclasses import dataclass

from . import _core, _plot
from ._comments import comment_of
from ._data import DataSet, Parts
from ._element import _call
from ._mesh import write_gmsh
from ._run import _model, _settings


@contextlib.contextmanager
def _asked(model, mesh, base):
    """Path and content of a model, an own mesh in a temporary file."""
    with tempfile.TemporaryDirectory(prefix="osculate-") as temporary:
        def mesh_file(given):
            path = os.path.join(temporary, "mesh.msh")
            write_gmsh(given, path)
            return path

        yield _model(model, mesh, base, mesh_file)


@comment_of("osculate::api::CheckReport")
def check(model, *, mesh=None, base=None, parameters=None):
    """What `osculate check` says of a model, as a dictionary; its key `text` has it for a reader.

    Arguments as of `run`. Errors: InputError.
    """
    with _asked(model, mesh, base) as (path, content):
        text, facts = _call(_core.check, path, content, _settings(parameters))
    return {**json.loads(facts), "text": text}


@dataclass(frozen=True)
class TangentCheck:
    """The assembled tangent against differences, part by part.

    passed   whether every part is right
    rows     {"part", "error", "order", "exact", "skipped", "pass", "note"} of each part
    text     what `osculate tangent` prints
    """

    passed: bool
    rows: list
    text: str


@comment_of("osculate::api::check_tangent")
def tangent(model, folder=None, *, mesh=None, base=None, parameters=None, state=0, threads=1):
    """The tangent of a model against differences of its forces, by the order of their error: `osculate tangent`.

    folder   with checkpoints of a run, for `state`; default: that of the program
    state    number of a converged increment at which it is checked; 0: near the undeformed state
    The others are those of `run`. User laws and materials are part of it. Errors: InputError.
    """
    with _asked(model, mesh, base) as (path, content):
        text, facts, passed = _call(_core.tangent, path, content, _settings(parameters),
                                    "" if folder is None else os.fspath(folder), state, threads)
    return TangentCheck(passed, json.loads(facts)["rows"], text)


@dataclass(frozen=True)
class Comparison:
    """How far two results are apart.

    quantities   {quantity: (largest difference, scale, relative difference, its time)}: columns of the history, and
                 fields of the bodies and pairs
    largest      largest relative difference
    lacks        whether one has what the other lacks
    text         what `osculate compare` prints
    """

    quantities: dict
    largest: float
    lacks: bool
    text: str


@comment_of("osculate::api::compare", "osculate::api::QuantityDifference")
def compare(a, b):
    """Two results side by side, increment by increment: `osculate compare`.

    a, b   a Result, a result folder, or a .frd file of CalculiX. Errors: InputError.
    """
    folders = [os.fspath(getattr(one, "folder", one)) for one in (a, b)]
    text, lacks, largest, quantities = _core.compare(*folders)
    return Comparison({name: tuple(values) for name, *values in quantities}, largest, lacks, text)


def plot_model(model, *, mesh=None, base=None, parameters=None, file=None, ax=None):
    """Draws a model before its analysis with matplotlib; returns the axes.

    Bodies by section, rigid bodies, the slaves of contact pairs, and the nodes that the first step prescribes. Arguments
    as of `run`; `file`: saved there; `ax`: drawn into these axes. Errors: InputError.
    """
    with _asked(model, mesh, base) as (path, content):
        sets, slaves, sections = _call(_core.model_parts, path, content, _settings(parameters))
    return _plot.draw_model(Parts([DataSet(*arrays) for arrays in sets]), slaves, sections, file, ax)
