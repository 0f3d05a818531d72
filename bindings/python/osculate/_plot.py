"""The deformed mesh of a state, drawn with matplotlib.

Faces are painted from the back to the front, so that neither a display nor a renderer is needed.
"""
import importlib.util
import io

import numpy as np

# Corners of the faces of a cell, counter-clockwise seen from outside; a plane cell is its own face.
_FACES = {
    "quad": [[0, 1, 2, 3]],
    "triangle": [[0, 1, 2]],
    "hexahedron": [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]],
    "tetra": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    "wedge": [[0, 2, 1], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]],
}


def _kind(name):
    return name.rstrip("0123456789")


def outer_faces(cells):
    """Corners of the faces that belong to one cell alone, for cells [(type, nodes)] as `DataSet.cells` has them."""
    count = {}
    for name, nodes in cells:
        for face in _FACES.get(_kind(name), []):
            for corners in nodes[:, face].tolist():
                key = tuple(sorted(corners))
                count[key] = None if key in count else corners
    return [corners for corners in count.values() if corners is not None]


def _lines(cells):
    return [ends for name, nodes in cells if _kind(name) == "line" for ends in nodes[:, :2].tolist()]


def _on_paper(points, flat):
    """Coordinates on paper, and the depth towards the eye: a plane model as it is, others from above and the side."""
    if flat:
        return points[:, :2], np.zeros(len(points))
    turn, tilt = np.radians(-60), np.radians(25)
    right = np.array([-np.sin(turn), np.cos(turn), 0])
    eye = np.array([np.cos(tilt) * np.cos(turn), np.cos(tilt) * np.sin(turn), np.sin(tilt)])
    return points @ np.stack([right, np.cross(eye, right)], axis=1), points @ eye


def _light(points, faces):
    """Between 0.6 and 1, by the direction of each face."""
    a, b, c = (points[[face[k] for face in faces]] for k in (0, 1, -1))
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
    return 0.6 + 0.4 * np.clip(normals @ np.array([0.4, -0.5, 0.77]), 0, 1)


def _values(bodies, field):
    """A value of each node and its name."""
    if field is None:
        field = "Mises" if "Mises" in bodies else "U"
    values, name = (bodies[field], field) if isinstance(field, str) else (np.asarray(field, dtype=float), None)
    if len(values) != len(bodies.points):
        raise ValueError(f"a field of the bodies' nodes has {len(bodies.points)} rows; this one has {len(values)}")
    return (values, name) if values.ndim == 1 else (np.linalg.norm(values, axis=1), name and f"|{name}|")


def draw(parts, field=None, scale=1.0, file=None, ax=None):
    """What `Increment.plot` does, for the parts of any state."""
    import matplotlib
    from matplotlib.collections import LineCollection, PolyCollection

    bodies = parts["bodies"]
    values, name = _values(bodies, field)
    flat = not np.ptp(bodies.points[:, 2]) > 0
    points = bodies.points + scale * bodies["U"]
    paper, depth = _on_paper(points, flat)
    faces = sorted(outer_faces(bodies.cells), key=lambda face: depth[face].mean())
    if ax is None:
        import matplotlib.pyplot as plt
        ax = plt.subplots(figsize=(6.4, 4.0))[1]
    scaled = matplotlib.colors.Normalize(values.min(), values.max())
    colours = matplotlib.colormaps["viridis"](scaled([values[face].mean() for face in faces]))
    if not flat:
        colours[:, :3] *= _light(points, faces)[:, None]
    ax.add_collection(PolyCollection([paper[face] for face in faces], facecolors=colours, edgecolors=(0, 0, 0, 0.35),
                                     linewidths=0.3))
    ax.add_collection(LineCollection([paper[ends] for ends in _lines(bodies.cells)], colors="black", linewidths=1.2))
    if flat and "rigid bodies" in parts:  # in space they would hide what they press on
        rigid = parts["rigid bodies"]
        where, _ = _on_paper(rigid.points + scale * rigid["U"], flat)
        ax.add_collection(LineCollection([where[ends] for ends in _lines(rigid.cells)], colors="firebrick"))
    _frame(ax, paper)
    bar = ax.figure.colorbar(matplotlib.cm.ScalarMappable(scaled, "viridis"), ax=ax, shrink=0.7)
    bar.set_label(name or "")
    if file is not None:
        ax.figure.savefig(file, dpi=110, bbox_inches="tight")
    return ax


def _frame(ax, paper):
    """Axes without scales around what is drawn."""
    low, high = paper.min(axis=0), paper.max(axis=0)
    margin = 0.06 * max(high - low)
    ax.set_xlim(low[0] - margin, high[0] + margin)
    ax.set_ylim(low[1] - margin, high[1] + margin)
    ax.set_aspect("equal")
    ax.set_axis_off()


def draw_model(parts, slaves, sections, file=None, ax=None):
    """What `plot_model` does. slaves: {pair: corners of its facets}."""
    import matplotlib
    from matplotlib.collections import LineCollection, PolyCollection

    bodies = parts["bodies"]
    flat = not np.ptp(bodies.points[:, 2]) > 0
    paper, depth = _on_paper(bodies.points, flat)
    if ax is None:
        import matplotlib.pyplot as plt
        ax = plt.subplots(figsize=(6.4, 4.0))[1]
    palette = matplotlib.colormaps["Pastel1"].colors
    pairs = matplotlib.colormaps["tab10"].colors
    first = 0
    painted = []  # (depth, corners, colour)
    for kind, nodes in bodies.cells:
        number = bodies["Section"][first:first + len(nodes)].astype(int) - 1
        first += len(nodes)
        for section in np.unique(number):
            painted += [(depth[face].mean(), face, palette[section % len(palette)])
                        for face in outer_faces([(kind, nodes[number == section])])]
    if not flat:
        light = _light(bodies.points, [face for _, face, _ in painted])
        painted = [(d, face, tuple(np.multiply(colour, shade))) for (d, face, colour), shade in zip(painted, light)]
        for k, facets in enumerate(slaves.values()):  # on top of what they are part of
            painted += [(depth[face].mean() + 1e-9, face, pairs[k % len(pairs)]) for face in facets]
    painted.sort(key=lambda entry: entry[0])
    ax.add_collection(PolyCollection([paper[face] for _, face, _ in painted], facecolors=[c for *_, c in painted],
                                     edgecolors=(0, 0, 0, 0.35), linewidths=0.3))
    if "rigid bodies" in parts:
        rigid = parts["rigid bodies"]
        where, _ = _on_paper(rigid.points, flat)
        edges = _lines(rigid.cells) or [[face[k], face[k - 1]] for face in outer_faces(rigid.cells) for k in range(len(face))]
        ax.add_collection(LineCollection([where[ends] for ends in edges], colors="firebrick", linewidths=1.2 if flat else 0.4))
    if flat:
        for k, (name, facets) in enumerate(slaves.items()):
            ax.add_collection(LineCollection([paper[ends] for ends in facets], colors=[pairs[k % len(pairs)]], linewidths=2.5))
    held = np.flatnonzero(bodies["held"].any(axis=1))
    ax.plot(*paper[held].T, "k^", markersize=3, label="prescribed")
    for k, name in enumerate(slaves):
        ax.plot([], [], color=pairs[k % len(pairs)], linewidth=2.5, label=f"slave of {name}")
    for k, name in enumerate(sections):
        ax.plot([], [], "s", color=palette[k % len(palette)], label=name)
    _frame(ax, paper)
    ax.legend(loc="upper left", bbox_to_anchor=(1, 1), fontsize="small", frameon=False)
    if file is not None:
        ax.figure.savefig(file, dpi=110, bbox_inches="tight")
    return ax


def png(parts):
    """The picture as a notebook shows it; None without matplotlib, and of bodies that would take seconds."""
    most_cells = 50_000
    if importlib.util.find_spec("matplotlib") is None or len(parts["bodies"].types) > most_cells:
        return None
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 4.0))
    FigureCanvasAgg(figure)
    out = io.BytesIO()
    draw(parts, ax=figure.add_subplot(), file=out)
    return out.getvalue()
