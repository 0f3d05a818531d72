"""Analyses and their results."""
import contextlib
import csv
import json
import math
import operator
import os
import shutil
import tempfile
import threading
import weakref

import numpy as np

from . import _core, _laws, _plot
from ._comments import comment_of
from ._data import DataSet, Parts, read_collection, read_vtu
from ._errors import AnalysisFailed, InputError, Interrupted
from ._mesh import write_gmsh
from ._view import View

_QUANTITIES = {
    "length": ("ux", "uy", "uz", "max_penetration", "slip"),
    "force": ("rfx", "rfy", "rfz", "force_x", "force_y", "force_z", "normal_force", "shear_force"),
    "moment": ("rmx", "rmy", "rmz"), "radian": ("rx", "ry", "rz"), "length/time": ("vx", "vy", "vz"),
    "radian/time": ("wx", "wy", "wz"), "pressure": ("max_pressure",), "area": ("area",),
    "energy": ("friction_work", "kinetic", "strain", "contact", "external", "friction", "damping", "numerical",
               "residual", "plastic"),
    "time": ("elapsed", "time_step", "time"), "1": ("stick", "slipping", "closed", "open", "fraction", "step", "increment"),
}
_UNITS = {quantity: unit for unit, quantities in _QUANTITIES.items() for quantity in quantities}


class Columns(dict):
    """{column: array}, one value for the initial state and each converged increment.

    `units` has what is known of each column: `force`, `length`, ... in the consistent units of the model; "1": a
    number. Columns that the model names itself are not in it.
    """

    @property
    def units(self):
        """{column: dimension} of the columns that are known."""
        known = {name: _UNITS.get(name.removesuffix(".imaginary").rsplit(".", 1)[-1]) for name in self}
        return {name: unit for name, unit in known.items() if unit}


class _Drawn:
    """What can be drawn of a state that has `parts`."""

    def plot(self, field=None, *, scale=1.0, file=None, ax=None):
        """Draws the deformed mesh with matplotlib, coloured by a field of the bodies' nodes; returns the axes.

        field   name, or an array with a row for each node of the bodies; of several components: its length.
                None: von Mises stress, or displacements where there is none
        scale   of the displacements
        file    the picture is saved there
        ax      drawn into these axes
        """
        return _plot.draw(self.parts, field, scale, file, ax)


class State(_Drawn):
    """An increment that has just converged, as `on_increment` of `run` gets it.

    step, increment    name of the step, number of the increment within it (from 1)
    time, fraction     of the analysis (docs/results.md), and the part of the step that has passed
    iterations         that it took
    history            {column: value} of this increment
    """

    def __init__(self, step, increment, time, fraction, iterations, history, sets):
        self.step, self.increment, self.time, self.fraction = step, increment, time, fraction
        self.iterations, self.history = iterations, history
        self._sets, self._parts = sets, None

    @property
    def parts(self):
        """Bodies, rigid bodies and contact pairs as data sets; computed when it is first asked for, which has to
        be while `on_increment` runs. The arrays may be kept."""
        if self._parts is None:
            self._parts = Parts([DataSet(*arrays) for arrays in self._sets()])
        return self._parts

    def __getitem__(self, field):
        """`state["U"]`, `state["CPRESS"]`, or of a part: `state["floor", "U"]`."""
        return self.parts.field(field) if isinstance(field, str) else self.parts.field(field[1], field[0])


class Increment(_Drawn):
    """The initial state or a converged increment of a result.

    step, increment, time   name of the step, number within it (0: the initial state), time of the analysis
    record                  what summary.json has of it (iterations, residual, ...); {} of the initial state
    has_fields              whether fields were written (`output: {fields: ...}` of the model)
    """

    def __init__(self, result, step, increment, time, record, files):
        self.step, self.increment, self.time, self.record = step, increment, time, record
        self._folder, self._keep = result.folder, result._keep
        self._files, self._parts = files, None

    @property
    def has_fields(self):
        """Whether fields were written."""
        return bool(self._files)

    @property
    def parts(self):
        """The data sets, read from the files when they are first asked for."""
        if not self._files:
            raise KeyError(f"no fields were written at time {self.time:g}: see `output: fields` of the model")
        if self._parts is None:
            self._parts = Parts([read_vtu(os.path.join(self._folder, file), part)
                                 for part, file in self._files.items()])
        return self._parts

    def __getitem__(self, field):
        """`increment["U"]`, `increment["CPRESS"]`, or of a part: `increment["floor", "U"]`."""
        return self.parts.field(field) if isinstance(field, str) else self.parts.field(field[1], field[0])

    def _repr_png_(self):
        return _plot.png(self.parts) if self.has_fields else None

    def __repr__(self):
        return f"<Increment {self.increment} of {self.step!r}, time {self.time:g}>"


class _Folder:
    """A folder that is removed with the last result or increment that reads it."""

    def __init__(self):
        self.name = tempfile.mkdtemp(prefix="osculate-")
        weakref.finalize(self, shutil.rmtree, self.name, ignore_errors=True)


class Result:
    """What is in a result folder, of `run` or of the program.

    folder      its path
    summary     summary.json as a dictionary (docs/results.md)
    status      "done", "stopped", or "unfinished": a run that still goes on or was killed; its summary is empty
    message     why it stopped, in plain words
    history     history.csv by columns (Columns)
    increments  the initial state and all converged increments, as many as rows of the history
    """

    def __init__(self, folder, *, _keep=None):
        self.folder = os.fspath(folder)
        self._keep = _keep  # a folder that goes with its last user
        self.summary = self._read_summary()
        self.status, self.message = self.summary.get("status", "unfinished"), self.summary.get("message", "")
        self._rows()

    def _read_summary(self):
        path = os.path.join(self.folder, "summary.json")
        try:
            with open(path, encoding="utf-8") as file:
                return json.load(file)
        except FileNotFoundError:
            if os.path.exists(os.path.join(self.folder, "history.csv")):
                return {}
            raise InputError(f"{self.folder}: there is no summary.json: no results of Osculate") from None
        except ValueError as error:
            raise InputError(f"{path}: cut off, or no file of Osculate ({error})", path) from error

    def _rows(self):
        path = os.path.join(self.folder, "history.csv")
        text = ""
        if os.path.exists(path):
            with open(path, newline="", encoding="utf-8") as file:
                text = file.read()
        text = text[: text.rfind("\n") + 1]  # a last row that is still being written
        rows = list(csv.reader(text.splitlines()))
        names, rows = (rows[0], rows[1:]) if rows else (["step", "increment", "time"], [])
        try:
            table = np.array(rows, dtype=float).reshape(len(rows), len(names))
        except ValueError as error:
            raise InputError(f"{path}: expected {len(names)} numbers in every row ({error})", path) from error
        self.history = Columns(zip(names, np.ascontiguousarray(table.T)))
        for name in ("step", "increment"):
            self.history[name] = self.history[name].astype(int)
        self._increments()

    def _increments(self):
        collection = os.path.join(self.folder, "results.pvd")
        frames = read_collection(collection) if os.path.exists(collection) else []
        steps = self.summary.get("steps", [])
        seen, self.increments = {}, []
        for step, number, time in zip(*(self.history[name] for name in ("step", "increment", "time"))):
            of_step = steps[step - 1] if step <= len(steps) else {}
            record = {}
            if number > 0:
                at = seen[step] = seen.get(step, -1) + 1
                records = of_step.get("increments", [])
                record = records[at] if at < len(records) else {}
            files = frames.pop(0)[1] if frames and frames[0][0] == time else {}
            self.increments.append(
                Increment(self, of_step.get("name", ""), int(number), float(time), record, files))

    def fields(self, step=None):
        """The data sets at the last increment with fields, of all or of a step by its name."""
        having = [i for i in self.increments if i.has_fields and (step is None or i.step == step)]
        if not having:
            steps = ", ".join(dict.fromkeys(i.step for i in self.increments if i.has_fields))
            raise KeyError(f"there are no fields of step {step!r}; there are some of: {steps or 'none'}")
        return having[-1].parts

    @property
    def last_iterate(self):
        """Of an analysis that failed: the iterate at which it gave up, to be drawn and asked for fields like an
        increment (U, `flips`, `free_motion_1`, ...; docs/results.md), of the step and increment that failed, at the time
        of the last converged one. None where there is none."""
        if not os.path.exists(os.path.join(self.folder, "last_iterate.vtu")):
            return None
        last, steps = self.increments[-1], self.summary.get("steps", [])
        step, number = last.step, last.increment + 1
        if len(steps) > self.history["step"][-1]:  # it has failed in the first increment of a step
            step, number = steps[-1]["name"], 1
        return Increment(self, step, number, last.time, {}, {"bodies": "last_iterate.vtu"})

    def plot_history(self, *columns, x="time", file=None, ax=None):
        """Draws columns of the history over another one with matplotlib; returns the axes.

        `file`: saved there. `ax`: drawn into these axes.
        """
        import matplotlib.pyplot as plt

        for name in (*columns, x):
            if name not in self.history:
                raise KeyError(f"the history has no column {name!r}; it has {', '.join(self.history)}")
        if ax is None:
            ax = plt.subplots()[1]
        units = self.history.units
        for name in columns:
            ax.plot(self.history[x], self.history[name], label=name)
        ax.set_xlabel(f"{x} [{units[x]}]" if x in units else x)
        of_columns = {units.get(name) for name in columns}
        if len(of_columns) == 1 and None not in of_columns:
            ax.set_ylabel(f"[{of_columns.pop()}]")
        ax.legend()
        if file is not None:
            ax.figure.savefig(file)
        return ax

    def view(self, *, height=640):
        """The report of the run (report.html) as a notebook shows it, with all that can be clicked in it: View."""
        return View(os.path.join(self.folder, "report.html"), height)

    def _repr_png_(self):
        drawn = [increment for increment in self.increments if increment.has_fields]
        return _plot.png(drawn[-1].parts) if drawn else None

    def __repr__(self):
        return f"<Result {self.status}, {max(len(self.increments) - 1, 0)} increments, in {self.folder!r}>"


def _settings(parameters):
    """As `--set` has them."""
    def text(value):
        if isinstance(value, (bool, np.bool_)):
            return "true" if value else "false"
        return repr(float(value)) if isinstance(value, (float, np.floating)) else str(value)

    return [(name, text(value)) for name, value in (parameters or {}).items()]


def _limits(threads, max_iterations, max_minutes):
    """Within the ranges of the program's options; 0 is no limit."""
    for name, value, least, most in (("threads", threads, 1, 1024), ("max_iterations", max_iterations, 0, 10**9)):
        try:
            inside = least <= operator.index(value) <= most
        except TypeError:
            inside = False
        if not inside or isinstance(value, bool):
            raise InputError(f"{name}: expected a whole number from {least} to {most}, got {value!r}", key=name)
    try:
        inside = 0 <= float(max_minutes) < math.inf
    except (TypeError, ValueError):
        inside = False
    if not inside:
        raise InputError(f"max_minutes: expected a number, not negative, got {max_minutes!r}", key="max_minutes")


class _MeshFile:
    """A mesh that is written in place of the file `path`, complete, and taken back if its block raises."""

    def __init__(self, mesh, path):
        self.path, self._before, self._made = os.path.abspath(path), None, []
        folder = os.path.dirname(self.path)
        while not os.path.exists(folder):
            self._made.append(folder)
            folder = os.path.dirname(folder)
        try:
            for parent in reversed(self._made):
                os.makedirs(parent, exist_ok=True)
            self._write(mesh)
        except BaseException:
            self._without_folders()
            raise

    def _write(self, mesh):
        new = f"{self.path}.{os.getpid()}.{threading.get_ident()}"
        try:
            write_gmsh(mesh, new)
            if os.path.exists(self.path):
                self._before = new + ".before"
                os.replace(self.path, self._before)
            os.replace(new, self.path)
        finally:
            if os.path.exists(new):
                os.remove(new)

    def _without_folders(self):
        for parent in self._made:
            try:
                os.rmdir(parent)
            except OSError:
                return

    def __enter__(self):
        return self

    def __exit__(self, error, *_):
        if error is None:
            if self._before is not None:
                os.remove(self._before)
        elif self._before is not None:
            os.replace(self._before, self.path)
        else:
            os.remove(self.path)
            self._without_folders()


def _model(model, mesh, base, mesh_file):
    """Its path, and its content where it is a dictionary; an own mesh is written to a file."""
    if not hasattr(model, "items"):
        if mesh is not None or base is not None:
            raise TypeError("mesh and base go with a model that is a dictionary")
        return os.fspath(model), None
    content = dict(model)
    if mesh is not None:
        if "mesh" in content:
            raise TypeError("the mesh is given twice: as an argument, and by the key `mesh` of the model")
        content["mesh"] = os.path.abspath(mesh_file(mesh))
    return os.path.join(os.fspath(base) if base is not None else "", "model"), content


@comment_of("osculate::api::run")
def run(model, folder=None, *, mesh=None, base=None, parameters=None, until=None, threads=1, restart=False,
        max_iterations=0, max_minutes=0.0, on_increment=None, say=None):
    """Runs an analysis and returns its Result.

    model         path of a model file or of an Abaqus or CalculiX deck, or a dictionary with the keys of a model file
    folder        for the results; default: that of the program for a path, for a dictionary one that is removed with
                  the Result
    mesh          with a dictionary, in place of its key `mesh`: a mesh of meshio or a dictionary of arrays
                  (`write_gmsh`). With a folder it is kept beside it as FOLDER.msh (as it was, if the model is refused)
    base          with a dictionary: the folder that its paths are relative to; default: the present one
    parameters    {name: value} in place of those of the model
    until         last step to run
    threads       for assembly, 1 to 1024
    restart       go on after the last checkpoint in the folder
    max_iterations, max_minutes   the run stops there; 0: no limit
    on_increment  called with a State after each converged increment (not of harmonic steps); what is false but not None
                  stops the run
    say           called with each line that the program would print

    Other Python threads go on meanwhile. Ctrl-C ends the run after the iteration that is under way.

    Errors: InputError, as the program says it; OSError for a folder that cannot be written to; AnalysisFailed and
    Interrupted have the converged increments as `result`; what a callback raises, after the run has ended.
    """
    _limits(threads, max_iterations, max_minutes)
    keep = None
    if hasattr(model, "items") and folder is None:
        keep = _Folder()
        folder = os.path.join(keep.name, "results")
    target = "" if folder is None else os.fspath(folder)
    watch = None if on_increment is None else lambda *state: on_increment(State(*state))
    main = threading.current_thread() is threading.main_thread()
    _laws.forget()
    with contextlib.ExitStack() as files:
        path, content = _model(model, mesh, base, lambda given: files.enter_context(
            _MeshFile(given, target.rstrip("/") + ".msh")).path)
        done, message, target, summary, refused, error = _core.run(
            path, content, target, _settings(parameters), until or "", threads, restart, max_iterations,
            float(max_minutes), watch, say, main)
    if error is not None and not isinstance(error, KeyboardInterrupt):
        _laws.forget()
        raise error
    _laws.reraise()
    if json.loads(summary)["status"] == "checked":
        raise InputError(message)
    result = Result(target, _keep=keep)
    result.message = message
    if error is not None:
        raise Interrupted(message, result) from error
    if not done and not refused:
        raise AnalysisFailed(message, result)
    return result
