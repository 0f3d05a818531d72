"""How much of a correction to take, for solvers of one's own."""
import numpy as np

from . import _core
from ._comments import comment_of


@comment_of("osculate::line_search")
def line_search(residual_at, before, correction):
    """The part of a correction that a solver of one's own takes.

    residual_at(step)   the residual at that part of the correction; or the residual and whether points have jumped over
                        a border of their states (Evaluation.branched); None where there is none (a cell has turned over)
    before              the residual that the correction was computed from
    correction          in the order of the residual
    """
    direction = np.asarray(correction, float).ravel()

    def work_and_norm(residual):
        r = np.asarray(residual, float).ravel()
        if r.shape != direction.shape:
            raise ValueError(f"residuals have {r.size} numbers, and the correction has {direction.size}")
        return float(direction @ r), float(np.linalg.norm(r))

    def look(step):
        found = residual_at(step)
        if found is None:
            return 0.0, 0.0, False, False
        residual, branched = found if isinstance(found, tuple) else (found, False)
        work, norm = work_and_norm(residual)
        return work, norm, bool(branched), bool(np.isfinite(norm))

    return _core.line_search(*work_and_norm(before), look)
