"""Types of what `import osculate` has; tests/python/test_stubs.py holds them against the package."""
import builtins
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import IntEnum
from os import PathLike
from typing import Any, Literal

from numpy.typing import ArrayLike, NDArray

import numpy as np

__version__: str

Path = str | PathLike[str]
Floats = NDArray[np.float64]
FacetList = Sequence[tuple[str, ArrayLike]]
Law = Mapping[str, Any]

class InputError(ValueError):
    file: str
    line: int
    key: str
    def __init__(self, message: str, file: str = "", line: int = 0, key: str = "") -> None: ...

class Refused(ValueError): ...

class AnalysisFailed(RuntimeError):
    result: Result
    def __init__(self, message: str, result: Result | None = None) -> None: ...

class Interrupted(KeyboardInterrupt):
    result: Result
    def __init__(self, message: str, result: Result | None = None) -> None: ...

class DataSet:
    part: str
    points: Floats
    connectivity: NDArray[np.int64]
    offsets: NDArray[np.int64]
    types: NDArray[np.uint8]
    point_data: dict[str, Floats]
    cell_data: dict[str, Floats]
    def __init__(self, part: str, points: Floats, connectivity: NDArray[np.int64], offsets: NDArray[np.int64],
                 types: NDArray[np.uint8], point_data: dict[str, Floats], cell_data: dict[str, Floats]) -> None: ...
    def __getitem__(self, name: str) -> Floats: ...
    def __contains__(self, name: str) -> bool: ...
    @property
    def cells(self) -> list[tuple[str, NDArray[np.int64]]]: ...
    def as_meshio(self) -> dict[str, Any]: ...
    def as_pyvista(self) -> tuple[NDArray[np.int64], NDArray[np.uint8], Floats]: ...

class Parts:
    def __init__(self, sets: Iterable[DataSet]) -> None: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def __getitem__(self, part: str) -> DataSet: ...
    def field(self, name: str, part: str | None = None) -> Floats: ...

class Columns(dict[str, NDArray[Any]]):
    @property
    def units(self) -> dict[str, str]: ...

class State:
    step: str
    increment: int
    time: float
    fraction: float
    iterations: int
    history: dict[str, float]
    def __init__(self, step: str, increment: int, time: float, fraction: float, iterations: int,
                 history: dict[str, float], sets: Callable[[], Any]) -> None: ...
    @property
    def parts(self) -> Parts: ...
    def __getitem__(self, field: str | tuple[str, str]) -> Floats: ...
    def plot(self, field: str | Floats | None = None, *, scale: float = 1.0, file: Any = None, ax: Any = None) -> Any: ...

class Increment:
    step: str
    increment: int
    time: float
    record: dict[str, Any]
    def __init__(self, result: Result, step: str, increment: int, time: float, record: dict[str, Any],
                 files: dict[str, str]) -> None: ...
    @property
    def has_fields(self) -> bool: ...
    @property
    def parts(self) -> Parts: ...
    def __getitem__(self, field: str | tuple[str, str]) -> Floats: ...
    def plot(self, field: str | Floats | None = None, *, scale: float = 1.0, file: Any = None, ax: Any = None) -> Any: ...

class Result:
    folder: str
    summary: dict[str, Any]
    status: str
    message: str
    history: Columns
    increments: list[Increment]
    def __init__(self, folder: Path) -> None: ...
    @property
    def last_iterate(self) -> Increment | None: ...
    def fields(self, step: str | None = None) -> Parts: ...
    def view(self, *, height: int = 640) -> View: ...
    def plot_history(self, *columns: str, x: str = "time", file: Path | None = None, ax: Any = None) -> Any: ...

def check(model: Path | Mapping[str, Any], *, mesh: Any = None, base: Path | None = None,
          parameters: Mapping[str, Any] | None = None) -> dict[str, Any]: ...
@dataclass(frozen=True)
class TangentCheck:
    passed: bool
    rows: list[dict[str, Any]]
    text: str

def tangent(model: Path | Mapping[str, Any], folder: Path | None = None, *, mesh: Any = None, base: Path | None = None,
            parameters: Mapping[str, Any] | None = None, state: int = 0, threads: int = 1) -> TangentCheck: ...

@dataclass(frozen=True)
class Comparison:
    quantities: dict[str, tuple[float, float, float, float]]
    largest: float
    lacks: bool
    text: str

def compare(a: Result | Path, b: Result | Path) -> Comparison: ...
def plot_model(model: Path | Mapping[str, Any], *, mesh: Any = None, base: Path | None = None,
               parameters: Mapping[str, Any] | None = None, file: Path | None = None, ax: Any = None) -> Any: ...

class View:
    height: int
    page: str
    def __init__(self, path: Path, height: int = 640) -> None: ...

def run(model: Path | Mapping[str, Any], folder: Path | None = None, *, mesh: Any = None, base: Path | None = None,
        parameters: Mapping[str, Any] | None = None, until: str | None = None, threads: int = 1, restart: bool = False,
        max_iterations: int = 0, max_minutes: float = 0.0, on_increment: Callable[[State], Any] | None = None,
        say: Callable[[str], Any] | None = None) -> Result: ...
def write_gmsh(mesh: Any, path: Path) -> None: ...

class Table(list[dict[str, Any]]):
    def column(self, name: str) -> NDArray[Any]: ...
    def array(self) -> NDArray[Any]: ...
    def plot(self, x: str, *columns: str, file: Path | None = None, ax: Any = None) -> Any: ...

def study(model: Path | Mapping[str, Any] | Callable[..., Any],
          parameters: Mapping[str, Iterable[Any]] | Iterable[Mapping[str, Any]],
          outputs: Mapping[str, str | Callable[[Result], Any]], processes: int = 2, folder: Path | None = None,
          *, resume: bool = False, **options: Any) -> Table: ...

class Line:
    point: list[float]
    normal: list[float]
    def __init__(self, point: ArrayLike = ..., normal: ArrayLike = ...) -> None: ...

class Segment:
    start: list[float]
    end: list[float]
    def __init__(self, start: ArrayLike, end: ArrayLike) -> None: ...

class Circle:
    center: list[float]
    radius: float
    inside: bool
    def __init__(self, center: ArrayLike = ..., radius: float = 1.0, inside: bool = False) -> None: ...

class Arc:
    center: list[float]
    radius: float
    start: float
    end: float
    inside: bool
    def __init__(self, center: ArrayLike = ..., radius: float = 1.0, start: float = 0.0, end: float = 1.0,
                 inside: bool = False) -> None: ...

class NurbsCurve:
    degree: int
    knots: list[float]
    control: list[list[float]]
    weights: list[float]
    def __init__(self, degree: int, knots: ArrayLike, control: ArrayLike, weights: ArrayLike = ...) -> None: ...

class Plane:
    point: list[float]
    normal: list[float]
    def __init__(self, point: ArrayLike = ..., normal: ArrayLike = ...) -> None: ...

class Sphere:
    center: list[float]
    radius: float
    inside: bool
    def __init__(self, center: ArrayLike = ..., radius: float = 1.0, inside: bool = False) -> None: ...

class Cylinder:
    point: list[float]
    axis: list[float]
    radius: float
    inside: bool
    length: float
    def __init__(self, point: ArrayLike = ..., axis: ArrayLike = ..., radius: float = 1.0, inside: bool = False,
                 length: float = ...) -> None: ...

class Cone:
    apex: list[float]
    axis: list[float]
    half_angle: float
    inside: bool
    start: float
    end: float
    def __init__(self, apex: ArrayLike = ..., axis: ArrayLike = ..., half_angle: float = 0.5, inside: bool = False,
                 start: float = 0.0, end: float = ...) -> None: ...

class Torus:
    center: list[float]
    axis: list[float]
    radius: float
    tube_radius: float
    inside: bool
    def __init__(self, center: ArrayLike = ..., axis: ArrayLike = ..., radius: float = 2.0, tube_radius: float = 1.0,
                 inside: bool = False) -> None: ...

class NurbsSurface:
    degree: list[int]
    knots: list[list[float]]
    count: list[int]
    control: list[list[float]]
    weights: list[float]
    def __init__(self, degree: Sequence[int], knots: Sequence[ArrayLike], count: Sequence[int], control: ArrayLike,
                 weights: ArrayLike = ...) -> None: ...

class Status(IntEnum):
    open = 0
    stick = 1
    slip = 2

class Feature(IntEnum):
    none = 0
    face = 1
    edge = 2
    corner = 3

class ClosestStatus(IntEnum):
    projected = 0
    ambiguous = 1
    outside_domain = 2
    invalid = 3

@dataclass
class Surface:
    facets: FacetList = ...
    shapes: Sequence[Any] = ...
    closed: bool = False
    frame: ArrayLike = ()
    points: ArrayLike = ()

@dataclass(frozen=True)
class DerivativeCheck:
    error: float
    order: float
    exact: bool
    same_states: bool
    passed: bool

class History:
    def __len__(self) -> int: ...
    def bytes(self) -> builtins.bytes: ...

class ActiveSet:
    def __len__(self) -> int: ...
    def bytes(self) -> builtins.bytes: ...
    @property
    def predicts(self) -> bool: ...

class Multipliers:
    @property
    def values(self) -> Floats: ...
    @property
    def stiffening(self) -> float: ...
    @property
    def violation(self) -> float: ...

class Evaluation:
    @property
    def force(self) -> Floats: ...
    @property
    def branch_force(self) -> Floats: ...
    @property
    def branched(self) -> bool: ...
    @property
    def tangent(self) -> NDArray[np.void]: ...
    @property
    def points(self) -> NDArray[np.void]: ...
    @property
    def constraints(self) -> dict[str, NDArray[Any]]: ...
    def next_active_set(self) -> ActiveSet: ...
    def multipliers(self) -> Multipliers: ...
    def corrected_multipliers(self) -> Multipliers: ...
    def committed(self) -> History: ...
    def committed_multipliers(self) -> Multipliers: ...

@dataclass(frozen=True)
class Domain:
    facts: dict[str, Any]
    text: str
    points: Floats
    fields: dict[str, Floats]
    cells: list[tuple[str, NDArray[np.int32], NDArray[np.int32], NDArray[np.int32]]]

def domain(surface: Path | Mapping[str, Any], *, kink: float = 0.01, samples: int = 3000, tolerance: float = 0.01,
           length: float | None = None, output: Path | None = None, page: Path | None = None) -> Domain: ...

@dataclass(frozen=True)
class Pattern:
    dim: int
    couplings: NDArray[np.int32]
    row_start: NDArray[np.int32]
    columns: NDArray[np.int32]
    point_start: NDArray[np.int32]
    point_nodes: NDArray[np.int32]
    def csr(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]: ...

def line_search(residual_at: Callable[[float], Floats | tuple[Floats, bool] | None], before: ArrayLike,
                correction: ArrayLike) -> float: ...

class Evaluator:
    def __init__(self, reference: ArrayLike, *, master: Surface, slave: Surface | None = None, normal: Law,
                 friction: Law | None = None, damping: Law | None = None,
                 factors: Sequence[tuple[float, float]] | None = None,
                 sampling: Literal["nodes", "gauss", "lobatto", "mortar"] = "nodes", sampling_points: int = 2,
                 subdomains: int = 1,
                 enforcement: Literal["penalty", "augmented_lagrange", "lagrange_multiplier"] = "penalty",
                 weight: Literal["node", "reference_area", "current_area"] = "reference_area",
                 separation: Literal["allowed", "no_separation", "tied_normal", "tied"] = "allowed",
                 tolerance: float = 0.0, keep_gap: bool = True, offset: float = 0.0,
                 overlap: Literal["acts", "ramped", "kept"] = "acts",
                 history: Literal["continuous", "chord", "per_facet"] = "continuous",
                 residual: Literal["surface", "full"] = "surface", tangent: Sequence[str] | None = None,
                 thickness: float = 1.0, axisymmetric: bool = False,
                 smoothing: Literal["none", "hermite", "nurbs"] = "none", sharp_angle: float = ...,
                 edge_angle: float | None = None, reentrant_vertices: bool = False,
                 search_distance: float | None = None, depth: float = ..., part: float = 1.0) -> None: ...
    def initial_history(self, coordinates: ArrayLike) -> History: ...
    def predicted(self, committed: History, coordinates: ArrayLike,
                  guess: Literal["as_before", "sticking", "sliding"] = "as_before") -> ActiveSet: ...
    def evaluate(self, coordinates: ArrayLike, committed: History, active_set: ActiveSet | None = None,
                 multipliers: Multipliers | None = None, *, tangent: bool = True, duration: float = 0.0,
                 relief: float = 0.0, far: bool = False) -> Evaluation: ...
    def pattern(self, coordinates: ArrayLike, committed: History, motion: float, distance: float = ...) -> Pattern: ...
    def derivative_check(self, coordinates: ArrayLike, committed: History, step: float,
                         active_set: ActiveSet | None = None, multipliers: Multipliers | None = None, *,
                         duration: float = 0.0) -> DerivativeCheck: ...
    def slave_points(self) -> list[tuple[NDArray[np.int32], Floats, int]]: ...
    def initial_multipliers(self) -> Multipliers: ...
    @property
    def unknowns_per_point(self) -> int: ...
    def multipliers_of(self, unknowns: ArrayLike) -> Multipliers: ...
    def unknowns_of(self, multipliers: Multipliers) -> Floats: ...
    def history(self, data: builtins.bytes) -> History: ...
    def active_set(self, data: builtins.bytes) -> ActiveSet: ...
    def multipliers(self, data: builtins.bytes) -> Multipliers: ...
    def bytes(self, multipliers: Multipliers) -> builtins.bytes: ...

@dataclass(frozen=True)
class PointParts:
    feature: Feature
    facet: int
    xi: Floats
    foot: Floats
    gap: float
    normal: Floats
    base: Floats
    second: Floats
    metric: Floats
    inverse_metric: Floats
    curvature: Floats
    offset_metric: Floats
    d_gap: Floats
    d_xi: Floats
    d_normal: Floats
    d_base: Floats
    status: Status
    pressure: float
    shear: Floats
    slip: Floats
    force: Floats
    tangent: Floats
    main: Floats
    rotational: Floats
    bending: Floats
    before: History
    after: History

class ContactPoint:
    start: History
    def __init__(self, coordinates: ArrayLike, *, master: Surface, slave: int = 0, normal: Law,
                 friction: Law | None = None, **options: Any) -> None: ...
    def at(self, coordinates: ArrayLike, before: History | None = None, *, duration: float = 0.0) -> PointParts: ...
    def derivative(self, name: str, coordinates: ArrayLike, before: History | None = None, *, step: float = 1e-6,
                   duration: float = 0.0) -> Floats: ...

@dataclass(frozen=True)
class ElementParts:
    force: Floats
    tangent: Floats
    stress: Floats
    strain: Floats
    points: Floats
    volume: Floats
    before: Floats | None
    after: Floats

class Element:
    coordinates: Floats
    def __init__(self, type: str, coordinates: ArrayLike, material: Law, *, base: Path | None = None, **section: Any) -> None: ...
    @property
    def finite(self) -> bool: ...
    @property
    def state(self) -> list[str]: ...
    def at(self, displacement: ArrayLike, before: Floats | None = None, *, duration: float = 1.0) -> ElementParts: ...
    def derivative_check(self, displacement: ArrayLike, before: Floats | None = None, *, duration: float = 1.0,
                         step: float = 1e-4) -> DerivativeCheck: ...

@dataclass(frozen=True)
class MaterialAnswer:
    stress: Floats
    tangent: Floats
    after: Floats

class MaterialPoint:
    def __init__(self, material: Law, *, base: Path | None = None, **section: Any) -> None: ...
    @property
    def finite(self) -> bool: ...
    @property
    def state(self) -> list[str]: ...
    def at(self, strain: ArrayLike, before: Floats | None = None, *, duration: float = 1.0) -> MaterialAnswer: ...
    def path(self, strains: ArrayLike, *, duration: float = 1.0) -> Floats: ...
    def derivative_check(self, strain: ArrayLike, before: Floats | None = None, *, duration: float = 1.0,
                         step: float = 1e-4) -> DerivativeCheck: ...

def normal_law(pressure: Callable[[float], tuple[float, float]], energy: Callable[[float], float] | None = None, *,
               onset: float = 0.0) -> Law: ...
def friction_law(limit: Callable[[Any], tuple[float, float, float]],
                 memory: Callable[[Any], tuple[float, float]] | None = None, *, timed: bool = False,
                 penalty: float | None = None) -> Law: ...
def material(stress: Callable[[Floats, Floats, Floats, float], tuple[ArrayLike, ArrayLike, ArrayLike]], *, state: int = 0,
             density: float = 0.0) -> Law: ...

def csr(entries: NDArray[np.void], size: int) -> tuple[Floats, NDArray[np.int64], NDArray[np.int64]]: ...

@dataclass(frozen=True)
class Closest:
    status: NDArray[np.uint8]
    feature: NDArray[np.uint8]
    facet: NDArray[np.int32]
    xi: Floats
    point: Floats
    distance: Floats
    margin: Floats
    unique: NDArray[np.bool_]

class ClosestPoints:
    def __init__(self, surface: Any, coordinates: ArrayLike | None = None) -> None: ...
    @property
    def dimension(self) -> int: ...
    def find(self, points: ArrayLike, mode: Literal["nearest", "fast", "certified"] = "certified",
             threads: int = 1) -> Closest: ...

def closest_points(surface: Any, points: ArrayLike, *, coordinates: ArrayLike | None = None,
                   mode: Literal["nearest", "fast", "certified"] = "certified", threads: int = 1) -> Closest: ...
def automatic_penalties(slave: Sequence[Sequence[float]], master: Sequence[Sequence[float]] = ()) -> tuple[float, float]: ...
