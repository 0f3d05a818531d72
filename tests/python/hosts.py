"""A host of examples/hosts beside `osculate run`: the same iterations in every increment, forces and displacements to the
tolerance of both solvers."""
import os
import pathlib
import resource
import subprocess
import tempfile

import numpy as np
import osculate

SOURCE = pathlib.Path(os.environ["SOURCE"])
HOSTS = SOURCE / "examples/hosts"
# Of the largest force and of the largest displacement: the tolerance of both solvers for forces out of balance.
CLOSE = 1e-10


def columns(path):
    table = np.genfromtxt(path, delimiter=",", names=True)
    return {name: table[name] for name in table.dtype.names}


def order(points, of):
    """For each row of `of` the row of `points` at the same place."""
    rows = [int(np.argmin(np.linalg.norm(points - place, axis=1))) for place in of]
    if len(set(rows)) != len(points) or np.abs(points[rows] - of).max() > 1e-12:
        raise AssertionError("the nodes of the host are not those of the model")
    return rows


def run_host(command, processor_seconds=100, seconds=500):
    """Runs a host. One that hangs is ended by what it has computed: on a busy machine a second of it takes several, and the
    longest host needs 11. The other limit is for one that waits."""
    def limited():
        resource.setrlimit(resource.RLIMIT_CPU, (processor_seconds, processor_seconds))

    subprocess.run([*map(str, command)], check=True, stdout=subprocess.DEVNULL, timeout=seconds, preexec_fn=limited)


def compare(test, model, command):
    """Runs `command FOLDER` and examples/hosts/MODEL; `test` is a unittest.TestCase."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        run_host([*command, folder])
        ours = columns(folder / "increments.csv")
        nodes = np.loadtxt(folder / "nodes.csv", delimiter=",")
        theirs = osculate.run(HOSTS / model, folder / "results")
        bodies = theirs.fields()["bodies"]
    if "PICTURES" in os.environ:  # those of docs/hosts.md, to draw them anew
        name = "_".join(pathlib.Path(model).with_suffix("").parts)
        theirs.increments[-1].plot(file=SOURCE / f"docs/images/hosts_{name}.png")
    increments = [i for step in theirs.summary["steps"] for i in step["increments"]]
    test.assertEqual([i["cutbacks"] for i in increments], [0] * len(increments))
    test.assertEqual(ours.pop("iterations").astype(int).tolist(), [i["iterations"] for i in increments])
    test.assertEqual(len(ours), sum(name.startswith("touch.") for name in theirs.history))
    largest = np.abs(theirs.history["touch.normal_force"]).max()
    for name, values in ours.items():
        expected = theirs.history[f"touch.{name}"][1:]
        test.assertLess(np.abs(values - expected).max(), CLOSE * largest, name)
    test.assertGreater(ours["slipping"].max(), 10)  # it slides,
    dimension = nodes.shape[1] // 3
    place, displacement, reaction = np.hsplit(nodes, 3)
    rows = order(bodies.points[:, :dimension], place)
    U, RF = bodies["U"][rows, :dimension], bodies["RF"][rows, :dimension]
    test.assertGreater(np.abs(U).max(), 0.9)  # far
    test.assertLess(np.abs(displacement - U).max(), CLOSE * np.abs(U).max())
    test.assertLess(np.abs(reaction - RF).max(), CLOSE * largest)
