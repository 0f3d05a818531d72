#!/usr/bin/python3
"""What a call from Python costs beside the same call in C++: 100 489 contact points, and as many closest points.

    PYTHONPATH=build/release/python benchmarks/from_python.py [PAIRS]

Seconds of the processor, the smallest and the median of calls in turns of both (7 pairs of processes, five calls each); sums of the answers
have to be the same bits.
"""
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
SIDE, CALLS = 317, 5


def evaluate():
    import osculate

    a = -0.5 + np.arange(SIDE) / (SIDE - 1.0)
    x, y = (k.ravel() for k in np.meshgrid(a, a, indexing="ij"))
    frame = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    coordinates = np.vstack([frame, np.column_stack([x, y, np.sqrt(4 - x * x - y * y) - 0.001])])
    n = (4 + np.arange(SIDE * SIDE)).reshape(SIDE, SIDE)
    quads = np.stack([n[:-1, :-1], n[:-1, 1:], n[1:, 1:], n[1:, :-1]], axis=-1).reshape(-1, 4)
    contact = osculate.Evaluator(coordinates, master=osculate.Surface(shapes=[osculate.Sphere(radius=2)], frame=range(4)),
                                 slave=osculate.Surface(facets=[("quad4", quads)]), normal={"penalty": 1e4},
                                 friction={"coulomb": {"mu": 0.3, "penalty": 1e4}})
    history = contact.initial_history(coordinates)
    coordinates[4:, 0] += 1e-4
    for _ in range(CALLS):
        began = time.process_time()
        result = contact.evaluate(coordinates, history)
        force, points, entries = result.force, result.points, result.tangent
        result.next_active_set()
        seconds = time.process_time() - began
        print("evaluate", seconds, repr(float(np.cumsum(force.ravel())[-1])), len(points) + len(entries))
        del result, force, points, entries  # not in the time of the next call


def closest():
    import osculate

    points = (6 * np.fmod(0.6180339887498949 * np.arange(1.0, 3 * SIDE * SIDE + 1), 1.0) - 3).reshape(-1, 3)
    torus = osculate.ClosestPoints(osculate.Torus(radius=2, tube_radius=0.5))
    for _ in range(CALLS):
        began = time.process_time()
        found = torus.find(points)
        seconds = time.process_time() - began
        print("closest", seconds, repr(float(np.cumsum(found.distance)[-1])), len(found.status))
        del found


def rows(command):
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return [(name, float(seconds), float(total), int(count)) for name, seconds, total, count in map(str.split, said.splitlines())]


def main(pairs):
    times, answers = {}, {}
    with tempfile.TemporaryDirectory() as folder:
        library = ROOT / "build/release/lib"
        host = pathlib.Path(folder) / "host"
        subprocess.run(["g++", "-std=c++20", "-O2", f"-I{ROOT}/include", ROOT / "benchmarks/from_python.cpp", "-o", host,
                        f"-L{library}", "-losculate-contact", f"-Wl,-rpath,{library}"], check=True)
        for _ in range(pairs):
            for language, command in (("C++", [host, str(SIDE), str(CALLS)]), ("Python", [sys.executable, __file__, "--calls"])):
                for name, seconds, *answer in rows(command):
                    times.setdefault((name, language), []).append(seconds)
                    answers.setdefault(name, set()).add(tuple(answer))
    for name, found in answers.items():
        if len(found) != 1:
            raise SystemExit(f"{name}: not the same answers: {found}")
        ours, theirs = times[name, "Python"], times[name, "C++"]
        print(json.dumps({"call": name, "C++": [min(theirs), statistics.median(theirs)], "Python": [min(ours), statistics.median(ours)],
                          "ratio": [min(ours) / min(theirs), statistics.median(ours) / statistics.median(theirs)]}))


if __name__ == "__main__":
    if sys.argv[1:] == ["--calls"]:
        evaluate()
        closest()
    else:
        main(int(sys.argv[1]) if len(sys.argv) > 1 else 7)
