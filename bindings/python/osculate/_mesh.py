"""Meshes from NumPy arrays and from meshio, as Gmsh files for the reader of the program."""
import numpy as np

from . import _core
from ._errors import InputError

_CELLS = _core.cells()  # name: dimension, nodes, Gmsh's type, VTK's type, order in VTK
_MESHIO = {"vertex": "point1", "line": "line2", "triangle": "tri3", "triangle6": "tri6", "quad": "quad4",
           "tetra": "tet4", "tetra10": "tet10", "wedge": "wedge6", "hexahedron": "hex8", "hexahedron20": "hex20",
           "hexahedron27": "hex27"}


def _integers(what, array, limit):
    """Numbers from 0 to limit - 1, or a mask of so many; nothing else is taken for them."""
    array = np.asarray(array)
    if array.dtype == bool:
        if array.shape != (limit,):
            raise InputError(f"{what}: expected a mask of {limit} truth values, got one of shape {array.shape}")
        return np.flatnonzero(array)
    if array.size and array.dtype.kind not in "iu":
        raise InputError(f"{what}: expected whole numbers, got an array of {array.dtype}")
    if array.size and (array.min() < 0 or array.max() >= limit):
        raise InputError(f"{what}: expected numbers from 0 to {limit - 1}, got {array.min()} to {array.max()}")
    return array.astype(np.int64)


def _block(name, nodes, of_meshio, points):
    """A block by our name of its cells, its nodes in Gmsh's order."""
    ours = _MESHIO.get(name, name)
    if ours not in _CELLS:
        raise InputError(f"'{name}' is no type of cells; there are {', '.join([*_CELLS, *_MESHIO])}")
    nodes = np.atleast_2d(nodes)
    if nodes.dtype == bool:
        raise InputError(f"cells {name}: expected numbers of nodes, got truth values")
    nodes = _integers(f"nodes of cells {name}", nodes, points)
    count, order = _CELLS[ours][1], _CELLS[ours][4]
    if nodes.size and nodes.shape[1] != count:
        raise InputError(f"a cell {name} has {count} nodes, not {nodes.shape[1]}")
    if of_meshio or name in _MESHIO:
        ordered = np.empty_like(nodes)
        ordered[:, order] = nodes  # VTK's node i is node order[i] here
        nodes = ordered
    return ours, nodes


def _blocks(mesh, points):
    """Blocks, and the sets that blocks with a name of their own are: {name: [rows or None of each block]}."""
    if isinstance(mesh, dict):
        given, of_meshio = [tuple(entry) for entry in mesh["cells"]], False
    else:
        given, of_meshio = [(block.type, block.data) for block in mesh.cells], True
    blocks = [_block(entry[0], entry[1], of_meshio, points) for entry in given]
    sets = {}
    for i, entry in enumerate(given):
        if len(entry) > 2:
            sets.setdefault(entry[2], [None] * len(given))[i] = np.arange(len(blocks[i][1]))
    return blocks, sets


def _physical_sets(mesh, blocks):
    """The groups of a Gmsh file that meshio has read."""
    tags = getattr(mesh, "cell_data", {}).get("gmsh:physical")
    sets = {}
    if tags is None:
        return sets
    for name, (tag, dimension) in mesh.field_data.items():
        rows = [np.flatnonzero(np.asarray(of_block) == tag) if _CELLS[cell][0] == dimension else None
                for (cell, _), of_block in zip(blocks, tags)]
        sets[name] = rows
    return sets


def _part(mesh, key):
    return mesh.get(key, {}) if isinstance(mesh, dict) else getattr(mesh, key, {}) or {}


def _members(mesh, blocks, sets):
    """(name, dimension, [(block, rows), ...]) of every set of cells."""
    sets = {**sets, **_part(mesh, "cell_sets")}
    if not isinstance(mesh, dict):
        for name, rows in _physical_sets(mesh, blocks).items():
            sets.setdefault(name, rows)
    out = []
    for name, rows in sets.items():
        if name.startswith("gmsh:"):
            continue
        if isinstance(rows, dict):
            rows = [rows.get(i) for i in range(len(blocks))]
        if len(rows) != len(blocks):
            raise InputError(f"set '{name}': expected rows of each of the {len(blocks)} blocks of cells")
        having = [(i, _integers(f"set '{name}'", r, len(blocks[i][1]))) for i, r in enumerate(rows) if r is not None]
        having = [(i, r) for i, r in having if len(r)]
        dimensions = {_CELLS[blocks[i][0]][0] for i, _ in having}
        if len(dimensions) > 1:
            raise InputError(f"set '{name}' has cells of several dimensions")
        if having:
            out.append((name, dimensions.pop(), having))
    return out


def _records(cell, physical, numbers, nodes):
    dimension, _, gmsh_type = _CELLS[cell][:3]
    table = np.empty((len(nodes), 3 + nodes.shape[1]), dtype="=i4")
    table[:, 0], table[:, 1], table[:, 2] = numbers + 1, physical, 1 + dimension
    table[:, 3:] = nodes + 1
    return len(nodes), np.array([gmsh_type, len(nodes), 2], dtype="=i4").tobytes() + table.tobytes()


def write_gmsh(mesh, path):
    """Writes a mesh as a binary Gmsh file (MSH 2.2): nodes and cells keep their order.

    `mesh` is a mesh of meshio, or a dictionary: points (n, 2) or (n, 3); cells [(type, nodes[, set]), ...];
    cell_sets {name: rows of each block} and point_sets {name: nodes}, which may be left out; sets are numbers or masks
    of as many truth values as there are cells in the block, or points. Types are those of
    Osculate (quad8, hex20: nodes in Gmsh's order) or of meshio (hexahedron20: in VTK's). Nodes count from 0.
    """
    points = np.asarray(mesh["points"] if isinstance(mesh, dict) else mesh.points, dtype=float)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise InputError("points: expected one row of 2 or 3 coordinates a point")
    blocks, named = _blocks(mesh, len(points))
    first = np.concatenate([[0], np.cumsum([len(nodes) for _, nodes in blocks])]).astype(np.int64)
    free = [np.ones(len(nodes), dtype=bool) for _, nodes in blocks]
    names, records = [], []
    for tag, (name, dimension, having) in enumerate(_members(mesh, blocks, named), 1):
        names.append((dimension, tag, name))
        for i, rows in having:
            free[i][rows] = False
            records.append(_records(blocks[i][0], tag, first[i] + rows, blocks[i][1][rows]))
    for i, (cell, nodes) in enumerate(blocks):
        rows = np.flatnonzero(free[i])
        if len(rows):
            records.append(_records(cell, 0, first[i] + rows, nodes[rows]))
    number = first[-1]
    for tag, (name, nodes) in enumerate(_part(mesh, "point_sets").items(), len(names) + 1):
        nodes = _integers(f"set '{name}'", nodes, len(points)).reshape(-1, 1)
        names.append((0, tag, name))
        records.append(_records("point1", tag, number + np.arange(len(nodes)), nodes))
        number += len(nodes)
    _write(path, points, names, records)


def _write(path, points, names, records):
    table = np.zeros(len(points), dtype=[("number", "=i4"), ("x", "=f8", 3)])
    table["number"] = np.arange(1, len(points) + 1)
    table["x"][:, : points.shape[1]] = points
    with open(path, "wb") as file:
        file.write(b"$MeshFormat\n2.2 1 8\n" + np.array([1], dtype="=i4").tobytes() + b"\n$EndMeshFormat\n")
        file.write(b"$PhysicalNames\n%d\n" % len(names))
        for dimension, tag, name in names:
            file.write(f'{dimension} {tag} "{name}"\n'.encode())
        file.write(b"$EndPhysicalNames\n$Nodes\n%d\n" % len(points) + table.tobytes() + b"\n$EndNodes\n")
        file.write(b"$Elements\n%d\n" % sum(count for count, _ in records))
        file.writelines(record for _, record in records)
        file.write(b"\n$EndElements\n")
