"""Results at points and cells as NumPy arrays, and the files they are read from."""
import os
import xml.etree.ElementTree as ElementTree
import zlib

import numpy as np

from ._errors import InputError

_MESHIO = {1: "vertex", 3: "line", 21: "line3", 35: "line4", 5: "triangle", 22: "triangle6", 9: "quad",
           23: "quad8", 28: "quad9", 10: "tetra", 24: "tetra10", 13: "wedge", 26: "wedge15", 12: "hexahedron",
           25: "hexahedron20", 29: "hexahedron27"}


class DataSet:
    """Points, cells and fields of one part of a state: the bodies, the rigid bodies, or a contact pair.

    points         coordinates in the undeformed model, (n, 3)
    connectivity   nodes of all cells, one cell after the other, in VTK's order
    offsets        where each cell ends in it
    types          VTK's number of each cell's type
    point_data, cell_data   {name: array}, one row a point or cell; names and signs: docs/results.md
    """

    def __init__(self, part, points, connectivity, offsets, types, point_data, cell_data):
        self.part, self.points = part, points
        self.connectivity, self.offsets, self.types = connectivity, offsets, types
        self.point_data, self.cell_data = point_data, cell_data

    def __getitem__(self, name):
        for fields in (self.point_data, self.cell_data):
            if name in fields:
                return fields[name]
        raise KeyError(f"{self.part} has no field {name!r}; it has {', '.join([*self.point_data, *self.cell_data])}")

    def __contains__(self, name):
        return name in self.point_data or name in self.cell_data

    @property
    def cells(self):
        """[(type, nodes (m, k)), ...]: cells that follow each other with the same type, by meshio's names."""
        out = []
        if len(self.types) == 0:
            return out
        changes = np.flatnonzero(np.diff(self.types)) + 1
        for first, last in zip([0, *changes], [*changes, len(self.types)]):
            start = self.offsets[first - 1] if first else 0
            nodes = self.connectivity[start : self.offsets[last - 1]].reshape(last - first, -1)
            out.append((_MESHIO[int(self.types[first])], nodes))
        return out

    def as_meshio(self):
        """Arguments of a mesh: `meshio.Mesh(**data.as_meshio())`."""
        cells = self.cells
        ends = np.cumsum([len(nodes) for _, nodes in cells])[:-1] if cells else []
        return {"points": self.points, "cells": cells, "point_data": dict(self.point_data),
                "cell_data": {name: np.split(values, ends) for name, values in self.cell_data.items()}}

    def as_pyvista(self):
        """Arguments of a grid: `pyvista.UnstructuredGrid(*data.as_pyvista())`: cells, types, points.

        Its fields are `grid.point_data.update(data.point_data)`, and `cell_data` likewise.
        """
        starts = np.concatenate([[0], self.offsets[:-1]]) if len(self.offsets) else self.offsets
        cells = np.insert(self.connectivity, starts, self.offsets - starts)
        return cells, self.types, self.points


def _unused(part, taken):
    """The name of a part. A contact pair called as the bodies are ("bodies") gets another one."""
    while part in taken:
        part = f"contact {part}"
    return part


class Parts:
    """The data sets of one state: `parts["floor"]` is one of them, `parts.field("U")` a field."""

    def __init__(self, sets):
        self._sets = {}
        for data in sets:
            data.part = _unused(data.part, self._sets)
            self._sets[data.part] = data

    def __iter__(self):
        return iter(self._sets)

    def __len__(self):
        return len(self._sets)

    def __getitem__(self, part):
        if part not in self._sets:
            raise KeyError(f"there is no part {part!r}; there are {', '.join(self._sets)}")
        return self._sets[part]

    def field(self, name, part=None):
        """A field of a part; without one that of the bodies, or else of the only part that has it."""
        if part is not None:
            return self[part][name]
        if "bodies" in self._sets and name in self._sets["bodies"]:
            return self._sets["bodies"][name]
        having = [data for data in self._sets.values() if name in data]
        if len(having) == 1:
            return having[0][name]
        if having:
            raise KeyError(f"{name!r} is a field of {', '.join(d.part for d in having)}: name the part")
        known = dict.fromkeys(field for d in self._sets.values() for field in [*d.point_data, *d.cell_data])
        raise KeyError(f"there is no field {name!r}; there are {', '.join(known)}")


def _unpacked(raw, at):
    """The bytes of an array that zlib has packed in pieces."""
    pieces = int(np.frombuffer(raw, "<u8", 1, at)[0])
    sizes = np.frombuffer(raw, "<u8", pieces, at + 24)
    at += 24 + 8 * pieces
    out = []
    for size in sizes:
        out.append(zlib.decompress(raw[at : at + int(size)]))
        at += int(size)
    return b"".join(out)


_BROKEN = (ValueError, LookupError, AttributeError, TypeError, SyntaxError, zlib.error)  # SyntaxError: of XML, too


def read_vtu(path, part="bodies"):
    """A file of results (VTU as Osculate writes it) as a DataSet; nothing is copied that need not be.

    Errors: InputError that names a file that is cut off or none of Osculate's.
    """
    with open(path, "rb") as file:
        content = file.read()
    try:
        return _data_set(content, part)
    except _BROKEN as error:
        raise InputError(f"{path}: cut off, or no file of Osculate ({error})", path) from error


def _data_set(content, part):
    head = content.index(b"<AppendedData")
    start = content.index(b"_", content.index(b">", head)) + 1
    raw = memoryview(content)[start:]
    root = ElementTree.fromstring(content[:head] + b"</VTKFile>")
    packed = "compressor" in root.attrib
    kinds = {"Float64": "=f8", "Int64": "=i8", "UInt8": "u1"}

    def array(element):
        kind, at = np.dtype(kinds[element.get("type")]), int(element.get("offset"))
        if packed:
            values = np.frombuffer(_unpacked(raw, at), kind)
        else:
            size = int(np.frombuffer(raw, "=u8", 1, at)[0])
            values = np.frombuffer(raw, kind, size // kind.itemsize, at + 8)
        columns = int(element.get("NumberOfComponents", 1))
        return values if columns == 1 else values.reshape(-1, columns)

    def arrays(name):
        group = root.find(f"UnstructuredGrid/Piece/{name}")
        return {element.get("Name"): array(element) for element in group}

    cells = arrays("Cells")
    return DataSet(part, arrays("Points")["Points"], cells["connectivity"], cells["offsets"], cells["types"],
                   arrays("PointData"), arrays("CellData"))


def read_collection(path):
    """[(time, {part: file})] of results.pvd, in the order in which it was written: the bodies come first.

    Errors: InputError that names a file that is cut off.
    """
    frames = []
    try:
        for entry in ElementTree.parse(path).getroot().iter("DataSet"):
            part, time, file = entry.get("name") or entry.get("part"), float(entry.get("timestep")), entry.get("file")
            if not frames or frames[-1][0] != time or os.path.basename(file).startswith("bodies_"):
                frames.append((time, {}))
            frames[-1][1][_unused(part, frames[-1][1])] = file
    except _BROKEN as error:
        raise InputError(f"{path}: cut off, or no file of Osculate ({error})", path) from error
    return frames
