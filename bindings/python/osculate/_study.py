"""An analysis over values of its parameters, in several processes."""
import itertools
import math
import multiprocessing
import os
import threading
from concurrent.futures import ProcessPoolExecutor

import numpy as np

from ._errors import AnalysisFailed, InputError
from ._run import run

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


def _one(task, number):
    model, points, outputs, folder, options = task
    values = points[number]
    if folder is not None:
        options = {**options, "folder": os.path.join(os.fspath(folder), f"{number:04d}")}
    try:
        if callable(model):
            result = run(model(**values), **options)
        else:
            result = run(model, parameters=values, **options)
    except AnalysisFailed as error:
        return {**values, **dict.fromkeys(outputs, math.nan), "status": error.result.status}
    except (InputError, KeyboardInterrupt):
        raise
    except Exception as error:  # of the function that makes the model, of a callback, of the disk
        return {**values, **dict.fromkeys(outputs, math.nan), "status": f"failed: {type(error).__name__}: {error}"}
    return {**values, **_outputs(outputs, result)}


def study(model, parameters, outputs, processes=2, folder=None, **options):
    """Runs a model for many values of its parameters; returns a Table with a row for each.

    model        a path or dictionary as of `run`, whose `parameters` are set; or a function of them that returns one
    parameters   {name: values}: all combinations, the last one fastest; or a list of dictionaries
    outputs      {name: column of the history, of which the last value is taken, or a function of the Result}
    processes    that work beside each other (forked, so that functions may be anything); with more than one each of
                 them has one thread
    folder       rows keep their results in folder/0000, ...; model files need one
    options      of `run`

    An analysis that fails has NaN as outputs and the status "stopped"; an output that raises is NaN, a row without a
    result has NaN only, both with the status "failed: ..."; bad input raises InputError.
    """
    global _task
    points = _points(parameters)
    if folder is None and not callable(model) and not hasattr(model, "items"):
        raise TypeError("a study of a model file needs a folder for its results")
    task = (model, points, dict(outputs), folder, options)
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
