"""An analysis over values of its parameters, in several processes."""
import hashlib
import itertools
import json
import math
import multiprocessing
import os
import pickle
import threading
from concurrent.futures import ProcessPoolExecutor

import numpy as np

from . import _core
from ._errors import AnalysisFailed, InputError
from ._run import Result, _model, _settings, run

_task = None  # what a process of a pool has to do; set before it is forked, with the lock
_lock = threading.Lock()


class Table(list):
    """One dictionary a row: the parameters, the outputs, and `status`."""

    def column(self, name):
        """The values of a column as an array."""
        return np.array([row[name] for row in self])

    def array(self):
        """All columns as one structured array."""
        names = list(self[0]) if self else []
        columns = [self.column(name) for name in names]
        out = np.empty(len(self), dtype=[(name, column.dtype, column.shape[1:])
                                         for name, column in zip(names, columns)])
        for name, column in zip(names, columns):
            out[name] = column
        return out

    def plot(self, x, *columns, file=None, ax=None):
        """Draws columns over another one with matplotlib, the rows in the order of `x`; returns the axes.

        `file`: saved there. `ax`: drawn into these axes. Errors: KeyError for a column that there is not.
        """
        import matplotlib.pyplot as plt

        for name in (x, *columns):
            if self and name not in self[0]:
                raise KeyError(f"the table has no column {name!r}; it has {', '.join(self[0])}")
        if ax is None:
            ax = plt.subplots()[1]
        order = np.argsort(self.column(x), kind="stable") if self else []
        for name in columns:
            ax.plot(self.column(x)[order], self.column(name)[order], "o-", label=name)
        ax.set_xlabel(x)
        if columns:
            ax.legend()
        if file is not None:
            ax.figure.savefig(file)
        return ax

    def __str__(self):
        """Columns with headings, as `osculate study` prints them."""
        if not self:
            return "an empty table"
        names = list(dict.fromkeys(name for row in self for name in row))  # rows may have columns of their own
        cells = [[str(name) for name in names]]
        for row in self:
            values = [row.get(name, "") for name in names]
            cells.append([f"{value:.6g}" if isinstance(value, (float, np.floating)) else str(value) for value in values])
        wide = [max(len(line[k]) for line in cells) for k in range(len(cells[0]))]
        return "\n".join("  ".join(text.rjust(width) for text, width in zip(line, wide)) for line in cells)


def _points(parameters):
    if hasattr(parameters, "items"):
        names = list(parameters)
        return [dict(zip(names, values)) for values in itertools.product(*(list(v) for v in parameters.values()))]
    return [dict(values) for values in parameters]


def _output(wanted, result):
    if callable(wanted):
        return wanted(result)
    return float(result.history[wanted][-1])


def _outputs(wanted, result):
    """The outputs of a row and its status: an output that raises is NaN, and the others are kept."""
    row, failed = {}, []
    for name, output in wanted.items():
        try:
            row[name] = _output(output, result)
        except Exception as error:  # whatever a function of the caller raises
            row[name] = math.nan
            failed.append(f"{name}: {type(error).__name__}: {error}")
    return {**row, "status": "failed: " + "; ".join(failed) if failed else result.status}


def _forked(number):
    return _one(_task, number)


_WATCHING = {"folder", "threads", "on_increment", "say"}  # options that results do not depend on


def _fed(digest, value):
    """What a value is made of into the digest."""
    if hasattr(value, "items"):
        digest.update(f"{{{len(value)}".encode())
        for key, part in value.items():
            digest.update(f"{key!r}:".encode())
            _fed(digest, part)
    elif isinstance(value, (list, tuple)):
        digest.update(f"[{len(value)}".encode())
        for part in value:
            _fed(digest, part)
    elif isinstance(value, np.ndarray) and not value.dtype.hasobject:
        digest.update(f"{value.dtype}{value.shape}".encode() + np.ascontiguousarray(value).tobytes())
    elif value is None or isinstance(value, (str, int, float, os.PathLike, np.generic)):
        digest.update(f"{value!r};".encode())
    else:
        digest.update(pickle.dumps(value))


def _meshes(model, parameters, options):
    """Contents of the mesh files that a model names, as text; a mesh of arrays is one of the options."""
    if options.get("mesh") is not None:
        return ""
    return _core.mesh_contents(*_model(model, None, options.get("base"), None), _settings(parameters))


def _mark(model, values, options, parameters=None):
    """Of the program's version, the model (of a file: its content), the mesh files it names, the values and the options;
    None where they cannot be told apart. parameters: of the model, where it is no function's."""
    digest = hashlib.sha256(_core.version.encode() + b"\0meshes")
    try:
        digest.update(_meshes(model, parameters, options).encode())
        if not hasattr(model, "items"):
            with open(model, "rb") as file:
                digest.update(file.read() + b"\0values")
        else:
            _fed(digest, model)
        _fed(digest, values)
        _fed(digest, {name: options[name] for name in sorted(options) if name not in _WATCHING})
    except (OSError, InputError, pickle.PicklingError, AttributeError, TypeError):  # bad input: the run says it
        return None
    return digest.hexdigest()


class _Book:
    """FOLDER/0000.json of a row: the mark of the run that the folder beside it has, written when that is done."""

    def __init__(self, folder, mark):
        self.path, self.folder, self.mark = folder + ".json", folder, mark

    def result(self):
        """The result of a run that is done, of the same mark; else None."""
        try:
            with open(self.path, encoding="utf-8") as file:
                known = json.load(file)
            if self.mark is None or not isinstance(known, dict) or known.get("mark") != self.mark:
                return None
            result = Result(self.folder)
            return result if result.status == "done" else None
        except (OSError, ValueError):  # InputError, too: there is none, or not a whole one
            return None

    def begin(self):
        """The folder is about to have another run."""
        try:
            os.remove(self.path)
        except FileNotFoundError:
            pass

    def end(self):
        """Written beside its place and moved there: a row is in the book, or it is not."""
        with open(self.path + ".part", "w", encoding="utf-8") as file:
            json.dump({"mark": self.mark}, file)
        os.replace(self.path + ".part", self.path)


def _run_of(model, values, options, folder, resume):
    """A result of this run: that of the folder, if it is done, else of a new run."""
    if callable(model):
        model, parameters = model(**values), {}
    else:
        parameters = {"parameters": values}
    if folder is None:
        return run(model, **parameters, **options)
    book = _Book(folder, _mark(model, values, options, **parameters))
    known = book.result() if resume else None
    if known is not None:
        return known
    book.begin()
    result = run(model, folder=folder, **parameters, **options)
    if result.status == "done":
        book.end()
    return result


def _one(task, number):
    model, points, outputs, folder, options, resume = task
    values = points[number]
    try:
        row = None if folder is None else os.path.join(os.fspath(folder), f"{number:04d}")
        result = _run_of(model, values, options, row, resume)
    except AnalysisFailed as error:
        return {**values, **dict.fromkeys(outputs, math.nan), "status": error.result.status}
    except (InputError, KeyboardInterrupt):
        raise
    except Exception as error:  # of the function that makes the model, of a callback, of the disk
        return {**values, **dict.fromkeys(outputs, math.nan), "status": f"failed: {type(error).__name__}: {error}"}
    return {**values, **_outputs(outputs, result)}


def study(model, parameters, outputs, processes=2, folder=None, *, resume=False, **options):
    """Runs a model for many values of its parameters; returns a Table with a row for each.

    model        a path or dictionary as of `run`, whose `parameters` are set; or a function of them that returns one
    parameters   {name: values}: all combinations, the last one fastest; or a list of dictionaries
    outputs      {name: column of the history, of which the last value is taken, or a function of the Result}
    processes    that work beside each other (forked, so that functions may be anything); with more than one each of
                 them has one thread
    folder       rows keep their results in folder/0000, ...; model files need one
    resume       rows whose folder has a run that is done, by the same version of Osculate, of the same model, meshes,
                 values and options, are not run again: their outputs are made of its Result. All others are run anew. Of a
                 model file and of mesh files their content counts; own functions as laws are others in each process
    options      of `run`

    An analysis that fails has NaN as outputs and the status "stopped"; an output that raises is NaN, a row without a
    result has NaN only, both with the status "failed: ..."; bad input raises InputError.
    """
    global _task
    points = _points(parameters)
    if folder is None and not callable(model) and not hasattr(model, "items"):
        raise TypeError("a study of a model file needs a folder for its results")
    if resume and folder is None:
        raise TypeError("a study is resumed from the folder of its results")
    task = (model, points, dict(outputs), folder, options, resume)
    if processes == 1:
        return Table(_one(task, number) for number in range(len(points)))
    if options.get("threads", 1) != 1:
        raise InputError(f"threads: expected 1 where a study has {processes} processes, got {options['threads']!r}",
                         key="threads")
    context = multiprocessing.get_context("fork")
    with _lock:
        _task = task
        try:
            with ProcessPoolExecutor(processes, mp_context=context) as pool:
                return Table(pool.map(_forked, range(len(points))))
        finally:
            _task = None
