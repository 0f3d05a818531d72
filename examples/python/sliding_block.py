"""The sliding block, watched while it goes on and stopped as soon as three quarters of it slide (docs/python.md).

Usage: sliding_block.py [MODEL], of itself examples/sliding_block/sliding_block.yaml beside it."""
import pathlib
import sys

import osculate

BESIDE = pathlib.Path(__file__).resolve().parent.parent / "sliding_block" / "sliding_block.yaml"
MODEL = sys.argv[1] if len(sys.argv) > 1 else BESIDE


def watch(state):
    history = state.history
    print(f"{state.step} {state.increment}: normal force {history['floor.normal_force']:.4g}, "
          f"{history['floor.slipping']:.0f} points slide, largest pressure {state['CPRESS'].max():.4g}")
    return history["floor.slipping"] < 3 * history["floor.stick"]


result = osculate.run(MODEL, "sliding_block.results", until="forward", on_increment=watch)
ratio = result.history["floor.shear_force"][-1] / result.history["floor.normal_force"][-1]
print(f"{len(result.increments) - 1} increments; shear force over normal force {ratio:.4f}")
