"""Answers, as plain values. Each keeps the model and the options that it was asked with: what the library alone can do
(files, pictures, tables) is made from these when it is wanted, also after unpickling."""

from __future__ import annotations

import html
import os
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Iterable, Iterator

import numpy as np

from . import _arguments as arguments
from . import _clearloci

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .model import Model

Mode = "dict[str, str]"  # point -> side


@dataclass(frozen=True)
class Curve:
    """One curve in one working mode, with all reactions that vanish on it."""

    id: str
    kind: str  #: "contact-loss", "backlash", "component", "margin", "preload", "direct-singularity", ...
    vanishing: list[str]  #: "f_A1"
    factor: str
    cause: str
    degree: int | None
    implicit: str | None  #: its polynomial in `variables`; None where it is not known
    variables: list[str]
    working_mode: dict[str, str]
    certified: bool
    excited: bool  #: of a direct singularity: some reaction grows without bound there
    arcs: list[np.ndarray]  #: float64 (n, 2), over three coordinates (n, 3), m; of angles rad
    ends: list[tuple[str, str]]

    def sympy(self) -> Any:
        """The implicit polynomial as an expression of SymPy, which has to be installed."""
        import sympy

        if self.implicit is None:
            return None
        symbols = {name: sympy.Symbol(name) for name in self.variables}
        return sympy.sympify(self.implicit.replace("^", "**"), locals=symbols, rational=True)


@dataclass(frozen=True)
class Surface:
    """One surface in one working mode, over three free coordinates."""

    id: str
    kind: str
    vanishing: list[str]
    factor: str
    cause: str
    working_mode: dict[str, str]
    certified: bool  #: the triangles have the topology of the surface, and nothing of it is missing
    within_resolution: bool  #: nothing of the surface is farther from the triangles than two cells of the search
    open: list[dict[str, Any]]  #: where the topology is not proven: boxes "from", "to" around so many "cells"
    vertices: np.ndarray  #: float64 (n, 3), m; of angles rad
    triangles: np.ndarray  #: int32 (k, 3)


@dataclass(frozen=True)
class IsolatedPoint:
    kind: str
    vanishing: list[str]
    at: list[float]  #: one value a coordinate: rad of an angle, else m
    working_mode: dict[str, str]
    certified: bool
    factor: str
    cause: str


@dataclass(frozen=True)
class OpenRegion:
    """A place at which a locus is not proven; the answer holds outside of it."""

    kind: str
    vanishing: list[str]
    factor: str
    cause: str
    working_mode: dict[str, str]
    lower: list[float]  #: one value a coordinate: rad of an angle, else m
    upper: list[float]
    point: bool  #: an isolated point may be in it; its box is tiny


@dataclass(frozen=True)
class Region:
    """The workspace of one mode: rings to be filled by the even-odd rule."""

    working_mode: dict[str, str]
    rings: list[np.ndarray]


@dataclass(frozen=True)
class Interval:
    """One free coordinate: a piece of its range in which the mode's posture exists."""

    working_mode: dict[str, str]
    range: tuple[float, float]


@dataclass(frozen=True)
class ZonedMode:
    """How much of the box the zones of a mode account for; sizes are products of the coordinates' units."""

    working_mode: dict[str, str]
    workspace: float  #: what the mode reaches; by cells all that is not proven to be out of reach
    outside: float  #: the rest of the box
    in_doubt: float  #: of the workspace: in zones that are not certified, in none, or in several
    cells: int  #: that were looked at, by cells
    #: By cells, in the middles of a grid over the box, the last coordinate first: 1 for the first of the zones, 2, ...,
    #: 0 in doubt, -1 out of reach; over two lengths None.
    labels: np.ndarray | None = field(repr=False)


class Written:
    """What the library holds of an answer, made when it is wanted and left out of pickles; and what the program prints
    and writes of it."""

    model: Model
    _map: Any

    def _ask(self) -> Any:
        raise NotImplementedError

    @property
    def _held(self) -> Any:
        if "_map" not in self.__dict__:
            object.__setattr__(self, "_map", self._ask())
        return self._map

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_map"}

    def json(self) -> str:
        """The text of the file that the program writes."""
        return self._held.json()

    def table(self) -> str:
        """The table that the program prints."""
        return self._held.table()

    #: What the files of an answer are called that has no pictures.
    _stem = "answer"

    def export(self, folder: str | os.PathLike[str], formats: Iterable[str] = ("txt",)) -> list[str]:
        """Writes the JSON of the answer into a folder, with "txt" its table, too; returns the files."""
        wanted = arguments.formats(formats) - {"json"}
        if wanted - {"txt"}:
            raise ValueError(f"{self._stem} has no format {sorted(wanted - {'txt'})[0]!r}; choose from json, txt")
        texts = {"json": self.json()} | ({"txt": self.table()} if wanted else {})
        return write_files(folder, {f"{self._stem}.{ending}": text for ending, text in texts.items()})


def write_files(folder: str | os.PathLike[str], texts: dict[str, str]) -> list[str]:
    """Into a folder that is made where it is missing; each file whole or not at all."""
    target = Path(arguments.path("folder", folder))
    target.mkdir(parents=True, exist_ok=True)
    files = []
    for name, text in texts.items():
        with tempfile.NamedTemporaryFile("w", dir=target, prefix=f".{name}.", delete=False, encoding="utf-8") as file:
            try:
                file.write(text)
                file.close()
                os.chmod(file.name, 0o644)
                os.replace(file.name, target / name)
            except BaseException:
                os.unlink(file.name)
                raise
        files.append(str(target / name))
    return files


class Exported(Written):
    """Files with pictures, too."""

    def export(self, folder: str | os.PathLike[str], formats: Iterable[str] = ("svg", "png")) -> list[str]:
        """Writes the formats named, and json, as the program does; returns the files. A format that the answer does not
        have raises InputError, which names those that it has."""
        return self._held.export(self.model._handle, arguments.path("folder", folder), arguments.formats(formats))


class _Answer(Exported):
    """Pictures in a notebook, too."""

    def _repr_svg_(self) -> str:
        return self._held.svgs()[0]

    def _repr_html_(self) -> str:
        return "".join(self._held.svgs()) + f"<pre>{html.escape(self.table())}</pre>"


class Asked(Written):
    """An answer of plain values that knows what it was asked by."""

    _question: tuple[str, Model, tuple[Any, ...], dict[str, Any]]

    @property
    def model(self) -> Model:  # type: ignore[override]
        return self._question[1]

    def _ask(self) -> Any:
        return held_of(*self._question)


def held_of(name: str, model: Model, arguments: tuple[Any, ...], options: dict[str, Any]) -> Any:
    """The answer as the library holds it: a call of the bindings by its name."""
    return getattr(_clearloci, name)(model._handle, *arguments, **options)


def ask(make: Callable[[Any], Any], name: str, model: Model, *arguments: Any, **options: Any) -> Any:
    """What `make` makes of the library's answer, one or a list; each remembers the question."""
    held = held_of(name, model, arguments, options)
    answer = make(held.data())
    for one in answer if isinstance(answer, list) else [answer]:
        object.__setattr__(one, "_question", (name, model, arguments, options))
        object.__setattr__(one, "_map", held)
    return answer


@dataclass(frozen=True)
class Validation(Asked):
    """Loci compared with reactions that are computed numerically: true if nothing contradicts them.

    What is counted are edges between neighbouring nodes of a grid, over all reactions: the sign of a reaction changes along
    an edge as often as the loci say that it does (confirmed), or not (contradicted); or the edge meets a boundary, or the
    sign cannot be told from rounding errors (unresolved).
    """

    mechanism: str
    parameters: dict[str, str]  #: exact values: "1/2", "3 N/mm"
    grid: list[int]  #: nodes along each coordinate
    validated: bool
    confirmed: int
    contradicted: int
    unresolved: int
    outside: int  #: edges of which neither node is reached
    reactions: list[dict[str, Any]] = field(repr=False)  #: the same, a reaction in a working mode
    contradicted_edges: list[dict[str, Any]] = field(repr=False)
    arcs_confirmed: int
    arcs_unresolved: int
    contradicted_arcs: list[dict[str, Any]] = field(repr=False)
    notes: list[str] = field(repr=False)

    _stem = "validation"

    def __bool__(self) -> bool:
        return self.validated


#: What the keys of validation.json are called here.
_VALIDATION = {
    "held": "confirmed",
    "disputed": "contradicted",
    "undecided": "unresolved",
    "disputed_edges": "contradicted_edges",
    "disputed_arcs": "contradicted_arcs",
    "arcs_held": "arcs_confirmed",
    "arcs_undecided": "arcs_unresolved",
}


def validation_of(own: dict[str, Any]) -> Validation:
    """Of the values of validation.json."""

    def renamed(values: dict[str, Any]) -> dict[str, Any]:
        return {_VALIDATION.get(key, key): value for key, value in values.items() if key != "format"}

    values = renamed(own)
    values["reactions"] = [renamed(reaction) for reaction in values["reactions"]]
    return Validation(**values)


class Loci(_Answer):
    """The discontinuity loci of a model."""

    def __init__(self, model: Model, options: dict[str, Any], last: Loci | None = None) -> None:
        self.model, self.options = model, dict(options)
        self._last = last  # of another design: what these were carried over from
        self._fill(self._held.data())

    def _ask(self) -> Any:
        if self._last is not None:
            return _clearloci.carry_loci(self._last._held, self.model._handle, **self.options)
        return _clearloci.trace_loci(self.model._handle, **self.options)

    def carried_to(self, model: Model) -> Loci:
        """These loci, moved vertex by vertex to those of another design of the mechanism by Newton's method: a quick
        first answer, of which nothing is proven (`certified` and `complete` are false). Loci that are new are absent.
        Asked with the same options; over one to three coordinates.
        """
        if not hasattr(model, "_handle"):
            raise TypeError(f"model is {model!r}; give a Model")
        return Loci(model, self.options, self)

    def _fill(self, data: dict[str, Any]) -> None:
        self.coordinates: list[str] = data["coordinates"]
        self.box: list[tuple[float, float]] = data["box"]
        self.complete: bool = data["complete"]  #: False where something is open, or a time limit came first
        self.open = [OpenRegion(**own) for own in data["open"]]
        self.notes: list[str] = data["notes"]
        self.curves = [Curve(**own) for own in data["curves"]]
        self.surfaces = [Surface(**own) for own in data["surfaces"]]
        self.isolated_points = [IsolatedPoint(**own) for own in data["isolated_points"]]
        self.workspace = [Region(**own) for own in data["workspace"]]
        self.reachable = [Interval(**own) for own in data["reachable"]]

    def plot(self, ax: Axes | None = None, working_mode: dict[str, str] | None = None) -> Axes:
        """The loci of one working mode (the first) over two coordinates, in the Axes given or in new ones."""
        from .plots import plot_loci

        return plot_loci(self, ax, working_mode)

    def __repr__(self) -> str:
        loci = len(self.curves) + len(self.surfaces) + len(self.isolated_points)
        return f"<clearloci.Loci of {self.model.name!r}: {loci} loci{'' if self.complete else ', incomplete'}>"


@dataclass(frozen=True)
class Zone:
    """A part of the workspace that no locus crosses. Sizes are products of the coordinates' units: m^2 over two lengths,
    rad over one angle, m^3 over three lengths."""

    id: str
    working_mode: dict[str, str]
    assembly_mode: int  #: sign of ``|A|``
    signs: dict[str, int]  #: of couples, axial and normal forces: {"M_A1": 1}
    too_small: list[str]  #: what is smaller than min_force or min_couple in it: ["f_A1"]
    size: float  #: over two lengths the area; by cells `at_least`
    at_least: float  #: proven; 0 of a zone over two lengths that is not certified
    at_most: float
    certified: bool  #: its borders are proven; by cells: it is proven to be separate from all other zones
    perhaps_one_with: list[str]  #: by cells: zones of the same signs that only doubt parts from it
    lower: list[float]  #: the box around it, by cells around what is proven; over one coordinate the zone
    upper: list[float]
    sample: tuple[float, ...]
    ball: tuple[tuple[float, ...], float] | None  #: the largest inside that was found: centre, radius
    borders: list[dict[str, Any]] = field(repr=False)  #: "kind", what is "vanishing"; over two lengths "curve", "length"
    ends: list[dict[str, Any]] = field(repr=False)  #: over one coordinate
    polygon: np.ndarray | None = field(repr=False)  #: over two lengths (n, 2), counter-clockwise, first point repeated
    holes: list[np.ndarray] = field(repr=False)
    faces: list[np.ndarray] = field(repr=False)  #: by cells convex polygons (corners, 3), over two coordinates segments
    #: of free efforts without a value, at the sample: "feasible", the "smallest" size, "efforts" with their "ranges"
    preload: dict[str, Any] | None = field(repr=False)

    @property
    def area(self) -> float:
        """`size`, of a zone over two lengths, m^2."""
        return self.size

    @property
    def inscribed_circle(self) -> tuple[tuple[float, ...], float] | None:
        """`ball`, of a zone over two lengths: centre and radius, m."""
        return self.ball

    def contains(self, at: tuple[float, float]) -> bool:
        """Whether a point, m, lies inside a zone over two lengths, by its polygons."""
        if self.polygon is None:
            raise ValueError(f"{self.id} was found by cells and has no polygon; see `faces` and the labels of its mode")
        return _inside(self.polygon, at) and not any(_inside(hole, at) for hole in self.holes)


def _inside(ring: np.ndarray, at: tuple[float, float]) -> bool:
    x, y = at
    a, b = ring[:-1], ring[1:]
    crosses = (a[:, 1] > y) != (b[:, 1] > y)
    a, b = a[crosses], b[crosses]
    return bool(np.count_nonzero(x < a[:, 0] + (b[:, 0] - a[:, 0]) * (y - a[:, 1]) / (b[:, 1] - a[:, 1])) % 2)


class Zones(_Answer):
    """The discontinuity-free zones of a model: a sequence, by mode, then size, largest first."""

    def __init__(self, model: Model, cells: int, by_cells: bool, options: dict[str, Any]) -> None:
        self.model, self.options = model, dict(options)
        self._cells = cells, by_cells
        data = self._held.data()
        self.by_cells: bool = data["by_cells"]  #: else the faces between curves, over two lengths
        self._zones = [Zone(**own) for own in data["zones"]]
        self.modes = [ZonedMode(**own) for own in data["modes"]]
        #: zones between which free efforts lead without a change of "signs": "working_mode", "zones", "size"
        self.preload_regions: list[dict[str, Any]] = data["preload_regions"]
        self.coordinates: list[str] = data["loci"]["coordinates"]
        self.box: list[tuple[float, float]] = data["loci"]["box"]
        self.complete: bool = data["loci"]["complete"]  #: False where something is open, or a time limit came first
        self.open = [OpenRegion(**own) for own in data["loci"]["open"]]
        self.notes: list[str] = data["loci"]["notes"]
        self.curves = [Curve(**own) for own in data["loci"]["curves"]]

    def _ask(self) -> Any:
        return _clearloci.find_zones(self.model._handle, *self._cells, **self.options)

    def __len__(self) -> int:
        return len(self._zones)

    def __getitem__(self, index: int) -> Zone:
        return self._zones[index]

    def __iter__(self) -> Iterator[Zone]:
        return iter(self._zones)

    def plot(self, ax: Axes | None = None, working_mode: dict[str, str] | None = None) -> Axes:
        """The zones of one working mode (the first) over two lengths, in the Axes given or in new ones."""
        if self.by_cells:
            raise ValueError("zones by cells have no polygons to plot; `export` and notebooks show their picture")
        from .plots import plot_zones

        return plot_zones(self, ax, working_mode)

    def __repr__(self) -> str:
        return f"<clearloci.Zones of {self.model.name!r}: {len(self)} zones>"


@dataclass(frozen=True)
class Verification(Asked, _Answer):
    """Whether a task keeps clear of every locus: true where that is proven. m, rad, N, N m; places have a value a
    coordinate."""

    verdict: str  #: "verified", "refuted", "undecided"
    coordinates: list[str]
    working_mode: dict[str, str]
    margin: float | None  #: m in the task's metric, proven to be free around it; None where not verified
    angle_margin: float | None  #: rad, where angles are told apart
    pose_error: float | None  #: m, a proven upper bound, where the task asks for one
    zone: str | None  #: over two lengths
    witness: dict[str, Any] | None  #: where refuted: a pose at which the task fails
    nearest: dict[str, Any] | None  #: the nearest locus that was found: the margin is at most its "distance"
    #: where undecided: "cells" that stayed open, the box around them from "lower" to "upper", and why ("reason": "time",
    #: "cells" or "doubles" ran out)
    open: dict[str, Any] | None
    #: where efforts are free and none is given: the smallest that was found by joint ("value", of which the rest of the
    #: answer is), what the smallest size is at least and at most ("size"), of one effort all that verify ("ranges")
    preload: dict[str, Any] | None
    least: list[dict[str, Any]]  #: over other than two lengths what every reaction has at least, "proven" and as "met"
    cells: int
    notes: list[str]
    moved_by: tuple[float, ...] | None  #: what `fit` has moved the task by
    scaled_by: float | None  #: what `fit` has scaled it by

    def __bool__(self) -> bool:
        return self.verdict == "verified"

    def __repr__(self) -> str:
        return f"<clearloci.Verification of {self.model.name!r}: {self.verdict}>"
