"""Contact laws and materials that are Python functions: for trying. In C, for using: docs/user_law.md."""
import ctypes
import threading
import types

import numpy as np

_real, _reals = ctypes.c_double, ctypes.POINTER(ctypes.c_double)


class _NormalPoint(ctypes.Structure):
    """osculate_normal_point of user_law.h."""

    _fields_ = [("gap", _real), ("constants", _reals), ("count", ctypes.c_int), ("pressure", _real),
                ("d_pressure", _real), ("energy", _real)]


class _FrictionPoint(ctypes.Structure):
    """osculate_friction_point of user_law.h."""

    _fields_ = [("pressure", _real), ("trial", _real), ("stiffness", _real), ("distance", _real),
                ("duration", _real), ("slid", _real), ("memory", _real * 2), ("constants", _reals),
                ("count", ctypes.c_int), ("limit", _real), ("d_trial", _real), ("d_pressure", _real),
                ("next", _real * 2)]


_UMAT = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 36, ctypes.c_size_t)
_kept = []  # what models, evaluators and their copies may call as long as the process lives


class _Raised:
    """What such functions have raised, under a C function that cannot pass it on: a thread that calls the library is told
    of what was raised in itself, and in threads of the library's own, not in other threads of Python."""

    def __init__(self):
        self._lock, self._errors = threading.Lock(), []

    def add(self, error):
        with self._lock:
            self._errors.append((threading.get_ident(), error))

    def take(self):
        """The first one of this thread's, which forgets all of them; None: there is none."""
        with self._lock:
            others = {thread.ident for thread in threading.enumerate()
                      if not isinstance(thread, threading._DummyThread)} - {threading.get_ident()}
            mine = [error for thread, error in self._errors if thread not in others]
            self._errors = [kept for kept in self._errors if kept[0] in others]
        return mine[0] if mine else None


_raised = _Raised()


def _address(prototype, function):
    """Of a C function that calls the Python one; what that one raises is kept for `reraise`."""

    def guarded(*arguments):
        try:
            function(*arguments)
        except BaseException as error:  # noqa: BLE001: Ctrl-C as well
            _raised.add(error)

    _kept.append(prototype(guarded))
    return hex(ctypes.cast(_kept[-1], ctypes.c_void_p).value)


def forget():
    """What was raised in a run or evaluation that has ended in another way."""
    _raised.take()


def reraise():
    """What a function of the user has raised first, if one has."""
    error = _raised.take()
    if error is not None:
        raise error


def normal_law(pressure, energy=None, *, onset=0.0):
    """Pressure over the gap by a function: a `normal` of model dictionaries and of Evaluator.

    pressure(gap)   p >= 0 and dp/dgap, of gaps up to the onset
    energy(gap)     integral of p from the gap to the onset. None: by twenty Gauss points, exact to rounding where p
                    is smooth
    onset           gap at which contact begins

    The function is kept as long as the process.
    """
    place, weight = np.polynomial.legendre.leggauss(20)

    def integral(gap):
        half = 0.5 * (onset - gap)
        return half * sum(w * pressure(gap + half * (1 + x))[0] for x, w in zip(place, weight))

    def answer(pointer):
        at = pointer.contents
        at.energy = (energy or integral)(at.gap)
        at.pressure, at.d_pressure = pressure(at.gap)

    address = _address(ctypes.CFUNCTYPE(None, ctypes.POINTER(_NormalPoint)), answer)
    return {"user": {"function": address, "onset": float(onset)}}


def friction_law(limit, memory=None, *, timed=False, penalty=None):
    """Friction, alike in all directions, by a function: a `friction` of model dictionaries and of Evaluator.

    limit(point)    L >= 0, dL/dtrial, dL/dp: the largest shear traction and its derivatives
    memory(point)   two numbers that a point keeps that slides by point.slid. None: it keeps nothing
    timed           it asks for point.duration; every step needs a duration
    penalty         stiffness of sticking (Evaluator needs one; models find one)

    point has pressure, trial (length of the elastic predictor), stiffness, distance (slid until the last increment),
    duration, slid and memory. Return mapping, direction and tangent are the program's. The functions are kept as long
    as the process.
    """

    def answer(pointer):
        at = pointer.contents
        point = types.SimpleNamespace(
            pressure=at.pressure, trial=at.trial, stiffness=at.stiffness, distance=at.distance,
            duration=at.duration, slid=at.slid, memory=tuple(at.memory))
        if at.slid == at.slid:  # else it is NaN
            if memory:
                at.next[:] = (np.nan, np.nan)  # where it raises
                at.next[:] = memory(point)
        else:
            at.limit, at.d_trial, at.d_pressure = limit(point)

    law = {"function": _address(ctypes.CFUNCTYPE(None, ctypes.POINTER(_FrictionPoint)), answer)}
    if timed:
        law["timed"] = 1
    if penalty is not None:
        law["penalty"] = penalty
    return {"user": law}


def _array(address, *shape):
    """The numbers at an address, by columns."""
    size = int(np.prod(shape))
    return np.ctypeslib.as_array(ctypes.cast(address, _reals), (size,)).reshape(shape, order="F")


def material(stress, *, state=0, density=0.0):
    """A material by a function: an entry of `materials` of model dictionaries.

    stress(strain, change, state, duration)   stress at the end of the increment, its derivative by `change`, and
                                              the state then

    Components 11, 22, 33, 12, 13, 23, strains with twice the shear; `strain` is that of the beginning. With finite
    kinematics strains are logarithmic (docs/user_material.md). The function is kept as long as the process.
    """

    def answer(*arguments):
        now, kept, tangent = _array(arguments[0], 6), _array(arguments[1], state), _array(arguments[2], 6, 6)
        strain, change, duration = _array(arguments[10], 6), _array(arguments[11], 6), _array(arguments[13], 1)
        now[:] = np.nan  # where it raises
        now[:], tangent[:], kept[:] = stress(strain.copy(), change.copy(), kept.copy(), float(duration[0]))

    law = {"function": _address(_UMAT, answer), "state": state}
    if density:
        law["density"] = density
    return {"user": law}
