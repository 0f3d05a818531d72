"""Newton's method of the hosts in Python: bodies of their own, contact of Osculate, and the iterations of `osculate run`.

Bodies are a function of coordinates (nodes, dimension) that gives their internal forces, one number a coordinate, and
with `tangent=True` their derivative as a matrix of SciPy, too.
"""
import pathlib

import numpy as np
import osculate
from scipy.sparse import csr_matrix
from scipy.sparse.linalg import spsolve

TOLERANCE = 5e-11           # of the forces out of balance, over the largest forces: that of the model files


def zero_between(look, low, high, enough):
    """The zero of the work between two steps at which its sign differs (Illinois' rule)."""
    best, low_work, high_work = high, low[1], high[1]
    for _ in range(20):
        if abs(best[1]) <= enough:
            break
        now = look((low[0] * high_work - high[0] * low_work) / (high_work - low_work))
        best = min(best, now, key=lambda point: abs(point[1]))
        if now[1] * low[1] > 0:
            low, low_work, high_work = now, now[1], high_work / 2
        else:
            high, high_work, low_work = now, now[1], low_work / 2
    return best[0]


def line_search(residual_at, before, correction):
    """How much of a correction to take, by the work of the residual along it: the rule of `osculate run`. Friction and
    facets make that work a piecewise smooth function, whose zero a whole correction may jump over for ever."""
    def look(step):
        residual, branched = residual_at(step)
        return step, correction @ residual, np.linalg.norm(residual), branched

    start, whole = (0.0, correction @ before, np.linalg.norm(before)), look(1.0)
    enough, crossed = 0.05 * abs(start[1]), start[1] * whole[1] < 0
    if whole[3] or whole[2] <= 0.5 * start[2] or abs(whole[1]) <= enough or not crossed and whole[2] <= start[2]:
        return 1.0          # whole[3]: points jump over a border of their states, and the active set decides
    if crossed:
        return zero_between(look, start, whole, enough)
    best = now = whole
    for _ in range(10):
        if now[2] <= start[2]:
            break
        now = look(now[0] / 2)
        best = min(best, now, key=lambda point: point[2])
    return best[0] if best[2] <= 0.999 * start[2] else 1.0


def converged(internal, contact, free):
    """Forces out of balance are small beside the largest ones."""
    scale = max(np.linalg.norm(internal), np.linalg.norm(contact))
    return np.linalg.norm((internal + contact.ravel())[free]) <= TOLERANCE * scale


def increment(bodies, contact, history, x, held, motion):
    """One increment; `motion` of the coordinates `held`. Changes x; returns iterations, the last evaluation
    of contact and the internal forces.

    The first correction starts from where the increment begins, and the motion enters through the tangent."""
    active = contact.predicted(history, x)
    free = np.flatnonzero(~held)
    for iteration in range(26):
        now = contact.evaluate(x, history, active)
        internal, tangent = bodies(x, tangent=True)
        if iteration > 0 and converged(internal, now.force, free):
            return iteration, now, internal
        tangent = tangent + csr_matrix(osculate.csr(now.tangent, x.size), tangent.shape)
        unbalanced = internal + now.branch_force.ravel() + tangent @ motion
        correction = motion.copy()
        correction[free] = -spsolve(tangent[free][:, free].tocsc(), unbalanced[free])
        active = now.next_active_set()

        def residual_at(step):
            there = x + step * correction.reshape(x.shape)
            tried = contact.evaluate(there, history, active, tangent=False)
            return (bodies(there, tangent=False) + tried.force.ravel())[free], tried.branched
        step = 1.0
        if iteration > 0 and not now.branched:
            step = line_search(residual_at, (internal + now.force.ravel())[free], correction[free])
        x += step * correction.reshape(x.shape)
        motion = np.zeros_like(motion)
    raise RuntimeError("it did not converge")


def row(iterations, now, upper):
    """What increments.csv has, by the names of columns of history.csv: iterations and what contact does to the upper block."""
    force, points = -now.force[upper].sum(axis=0), now.points
    columns = {"iterations": iterations} | {f"force_{axis}": value for axis, value in zip("xyz", force)}
    columns["normal_force"] = -(points["weight"] * points["normal_traction"]).sum()
    columns["friction_work"] = points["friction_work"].sum()
    columns["slipping"] = np.count_nonzero(points["status"] == osculate.Status.slip)
    return columns


def drag(solve, contact, reference, lower_bottom, upper_top, upper, motions, folder=None):
    """All increments: the lower block's bottom stands still, the upper one's top makes one of `motions` each, and
    solve(contact, history, x, held, motion) does one as `increment` above. Prints a row each; FOLDER/increments.csv has them,
    FOLDER/nodes.csv places, displacements and reactions at the end."""
    x, history = reference.copy(), contact.initial_history(reference)
    held, rows = np.zeros(x.shape, bool), []
    held[lower_bottom] = held[upper_top] = True
    for step in motions:
        motion = np.zeros(x.shape)
        motion[upper_top] = step
        iterations, now, internal = solve(contact, history, x, held.ravel(), motion.ravel())
        history = now.committed()
        rows.append(row(iterations, now, upper))
        print(", ".join(f"{name} {value:.9g}" for name, value in rows[-1].items()))
    if folder:
        np.savetxt(pathlib.Path(folder) / "increments.csv", [list(r.values()) for r in rows], delimiter=",",
                   header=",".join(rows[0]), comments="")
        reactions = internal.reshape(x.shape) + now.force
        np.savetxt(pathlib.Path(folder) / "nodes.csv", np.hstack([reference, x - reference, reactions]), delimiter=",")
