#!/usr/bin/env python3
"""Draws the figures of the sliding block from the curves of its verification case.

    osculate verify sliding_block --curves DIR
    tools/plot_curves.py DIR [docs/images]

Needs matplotlib. Figures: hysteresis (KS2D Fig. 8), displacement (Figs. 9 and 11) and ratio T/N
(Figs. 10 and 12) along the contact line.
"""
import argparse
import csv
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

CASE = "sliding_block"
STYLE = {
    "font.size": 9,
    "axes.grid": True,
    "grid.color": "0.9",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "lines.linewidth": 1.4,
    "legend.frameon": False,
    "svg.hashsalt": CASE,
}


def read(folder, name):
    """Column names and columns of one curve file."""
    path = folder / f"{CASE}.{name}.csv"
    with path.open(newline="") as file:
        rows = list(csv.reader(file))
    return rows[0], [[float(v) for v in column] for column in zip(*rows[1:])]


def save(figure, folder, name):
    path = folder / f"{CASE}_{name}.png"
    figure.tight_layout()
    figure.savefig(path, dpi=130, metadata={"Software": None})
    plt.close(figure)
    print(path)


def hysteresis(curves, images):
    _, (top, corner, stick) = read(curves, "hysteresis")
    figure, axes = plt.subplots(figsize=(5.6, 4))
    axes.plot([1e3 * u for u in top], [1e3 * u for u in corner], color="C0")
    last = top.index(max(top))
    sliding = last + stick[last:].index(0)
    marks = ((0, "O", (6, -10)), (last, "F", (5, -3)), (sliding, "G", (6, -9)),
             (len(top) - 1, "H", (6, -4)))
    for index, name, offset in marks:
        axes.plot(1e3 * top[index], 1e3 * corner[index], "o", color="C0", markersize=4)
        axes.annotate(name, (1e3 * top[index], 1e3 * corner[index]), offset,
                      textcoords="offset points")
    axes.set_xlabel("applied displacement of the top, u(C) / 1e-3")
    axes.set_ylabel("displacement of the bottom right corner, u(D) / 1e-3")
    save(figure, images, "hysteresis")


def profiles(curves, images, name, label, factor):
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.8), sharey=True)
    for plot, way in zip(axes, ("forward", "backward")):
        names, columns = read(curves, f"{name}_{way}")
        colors = plt.get_cmap("viridis")
        for k, (title, values) in enumerate(zip(names[1:], columns[1:])):
            u = float(title.split("=")[1])
            plot.plot(columns[0], [factor * v for v in values],
                      color=colors(0.92 * k / max(1, len(names) - 2)),
                      marker=".", markersize=3, label=f"u = {u:.3f}")
        plot.set_title(f"{way} loading", fontsize=9)
        plot.set_xlabel("x along the contact line")
        plot.set_xlim(0, 20)
    if name == "ratio":
        for plot in axes:
            plot.set_ylim(-0.36, 0.36)
            for limit in (-0.3, 0.3):
                plot.axhline(limit, color="0.5", linewidth=0.8, linestyle="--", zorder=0)
    axes[0].set_ylabel(label)
    for plot in axes:
        plot.tick_params(labelleft=True)
        plot.legend(fontsize=7.5, loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, images, name)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("curves", type=pathlib.Path, help="folder given to `osculate verify --curves`")
    root = pathlib.Path(__file__).resolve().parent.parent
    parser.add_argument("images", type=pathlib.Path, nargs="?", default=root / "docs" / "images")
    options = parser.parse_args()
    options.images.mkdir(parents=True, exist_ok=True)
    with plt.rc_context(STYLE):
        hysteresis(options.curves, options.images)
        profiles(options.curves, options.images, "displacement", "horizontal displacement / 1e-3", 1e3)
        profiles(options.curves, options.images, "ratio", "T / N", 1)


if __name__ == "__main__":
    main()
