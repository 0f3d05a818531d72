"""A code of one's own around osculate.Evaluator: a soft sheet of springs that a rigid ball is pressed into and
dragged over. It has its unknowns, its matrix and its Newton method; contact gives forces, tangent and states.

SciPy solves the linear systems where it is installed, otherwise NumPy does, without sparse matrices.
"""
import numpy as np
import osculate

try:
    from scipy.sparse import csr_matrix, eye
    from scipy.sparse.linalg import spsolve
except ModuleNotFoundError:
    csr_matrix = None

FRAME, SIDE, SPRING, MU = 4, 9, 40.0, 0.3  # nodes of the ball's frame; nodes a side of the sheet


def sheet():
    """Coordinates of all nodes, the frame of the ball first, and the quadrilaterals of the sheet."""
    x, y = np.meshgrid(np.linspace(-1, 1, SIDE), np.linspace(-1, 1, SIDE), indexing="ij")
    node = FRAME + np.arange(SIDE * SIDE).reshape(SIDE, SIDE)
    quads = np.stack([node[:-1, :-1], node[1:, :-1], node[1:, 1:], node[:-1, 1:]], axis=-1).reshape(-1, 4)
    frame = np.array([[0, 0, 2.0], [1, 0, 2], [0, 1, 2], [0, 0, 3]])
    return np.vstack([frame, np.column_stack([x.ravel(), y.ravel(), np.zeros(SIDE * SIDE)])]), quads


def correction(tangent, size, residual):
    """(springs + contact)^-1 residual, of the nodes behind the frame."""
    first = 3 * FRAME
    if csr_matrix is not None:
        contact = csr_matrix(osculate.csr(tangent, size), shape=(size, size))[first:, first:]
        return spsolve((contact + SPRING * eye(size - first)).tocsc(), residual)
    dense = np.zeros((size, size))
    np.add.at(dense, (tangent["row"], tangent["column"]), tangent["value"])
    return np.linalg.solve(dense[first:, first:] + SPRING * np.eye(size - first), residual)


def increment(contact, history, rest, x):
    """Newton's method with the state of every point carried from iteration to iteration; changes x."""
    active = contact.predicted(history, x)
    for iteration in range(40):
        now = contact.evaluate(x, history, active)
        springs = SPRING * (x - rest)[FRAME:]
        if iteration > 0 and np.linalg.norm(springs + now.force[FRAME:]) < 1e-9:
            return iteration, now
        x[FRAME:] -= correction(now.tangent, x.size, (springs + now.branch_force[FRAME:]).ravel()).reshape(-1, 3)
        active = now.next_active_set()
    raise RuntimeError("it did not converge")


def main():
    x, quads = sheet()
    rest = x.copy()
    ball = osculate.Surface(shapes=[osculate.Sphere(radius=2)], frame=range(FRAME))
    contact = osculate.Evaluator(x, master=ball, slave=osculate.Surface(facets=[("quad4", quads)]),
                                 normal={"penalty": 1e4}, friction={"coulomb": {"mu": MU, "penalty": 5e3}})
    history = contact.initial_history(x)
    for motion in [(0, 0, -0.02)] * 2 + [(0.01, 0, 0)] * 6:
        x[:FRAME] += motion
        iterations, now = increment(contact, history, rest, x)
        history = now.committed()
        force = now.force[:FRAME].sum(axis=0)
        print(f"{iterations} iterations, normal force {-force[2]:.5f}, along the sheet {-force[0]:.5f}, "
              f"{np.count_nonzero(now.points['status'] == osculate.Status.slip)} nodes slide")


if __name__ == "__main__":
    main()
