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
            step = osculate.line_search(residual_at, (internal + now.force.ravel())[free], correction[free])
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
