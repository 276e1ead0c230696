"""A mechanism, and the questions about it."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any, Literal, Mapping, NamedTuple, Sequence, Union, overload

import numpy as np

from . import _arguments as arguments
from . import _clearloci
from ._arguments import Names, Number, Value, WorkingMode
from .answers import Loci, Validation, Verification, Zones, ask, validation_of
from .motion import Errors, Pose, Trajectory

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

#: A task file, its content as a dictionary, or an array of points, which is a path.
Task = Union[str, "os.PathLike[str]", Mapping[str, Any], np.ndarray]
Engine = Literal["adaptive-then-exact", "exact", "adaptive"]


class NormalizedFile(NamedTuple):
    """A mechanism file in which every point has its construction."""

    text: str
    #: Such as by how much points moved to close with the lengths given.
    notes: list[str]


class ImportedFile(NamedTuple):
    """A file of another program as a mechanism file in the drawn form."""

    text: str
    #: "PMKS+", "Linkage", "MJCF", "URDF", "SDF", "DXF", "pyslvs" or "CUIK"; "" of a mechanism file.
    format: str
    #: What was interpreted, and what was left out.
    notes: list[str]


class Model:
    """A mechanism file with values of its parameters::

        m = clearloci.read("five_bar.yaml")
        m.coordinates                         # {'x': (-0.5, 1.0), 'y': (-1.0, 1.0)}, m
        m.pose((0.25, -0.7)).reactions["A1"]  # {'fx': ..., 'fy': ..., 'M': ...}, N and N m
        m.loci().plot()                       # where joints lose contact
        m.zones()[0].inscribed_circle         # where none does
        m.verify({"box": {"x": [0.1, 0.4], "y": [-0.8, -0.6]}, "margin": 0.01})

    A model never changes, and may be used from several threads. Everything is in SI units: m, rad, N, N m, s, whatever
    units the file has; task files follow the units of the mechanism file, dictionaries and arrays do too.

    Arguments that many questions share:

    - `working_mode`: how the legs are assembled. None: as in the file; "right,left", ["right", "left"] or
      {"B1": "right", "B2": "left"}: one side a dyad, as `m.working_mode` names them; "all": every combination.
    - `joint`: the joints whose reactions count, "A1" or ["A1", "P"]. None: all that have a clearance, or all.
    - `quantity`: what vanishes: "f" forces, "M" couples, "F" axial forces, "N", "T" of a guide, components "fx" to "mz".
    - `min_force`, `min_couple`: N and N m: also the curves on which a force or a couple has this value.
    - `controlled`: efforts that are free and have no value may vary with the pose.
    - `tolerance`: the largest distance of a chord from its curve, m; None: 1e-5.
    - `engine`: "adaptive" (subdivision), "exact" (arrangement of curves), or "adaptive-then-exact".
    - `time_limit`: s, after which the answer says what is known by then, with `complete` False.

    A wrong argument raises TypeError or ValueError; what is wrong with a file or a mechanism raises InputError, which is a
    ValueError with file, line, column, what is wrong and how to mend it.
    """

    def __init__(self, handle: _clearloci.Model) -> None:
        if not isinstance(handle, _clearloci.Model):
            raise TypeError("clearloci.read(path) and clearloci.parse(text) make models")
        self._handle = handle

    @property
    def name(self) -> str:
        return self._handle.name

    @property
    def file(self) -> str:
        return self._handle.file

    @property
    def text(self) -> str:
        """The mechanism file."""
        return self._handle.text

    @property
    def parameters(self) -> dict[str, float]:
        """Values in the units of the file, as `with_parameters` takes them."""
        return {name: own["value"] for name, own in self._handle.parameters.items()}

    @property
    def exact_parameters(self) -> dict[str, str]:
        """The same as exact numbers or expressions: "1/2"."""
        return {name: own["exact"] for name, own in self._handle.parameters.items()}

    @property
    def coordinates(self) -> dict[str, tuple[float, float]]:
        """The free coordinates and their ranges, m or, of an angle, rad."""
        return self._handle.coordinates

    @property
    def units(self) -> dict[str, str]:
        """The units of tables, pictures and plots, {"length": "mm", "angle": "deg", "force": "N"}: those of the file.

        Arguments and values of answers are always in SI units.
        """
        return {what: name for what, (name, _) in self._handle.units.items()}

    @property
    def joints(self) -> list[str]:
        return self._handle.joints

    @property
    def working_mode(self) -> dict[str, str]:
        """The working mode of the file: point -> side."""
        return self._handle.working_mode

    def with_parameters(self, **values: Value) -> Model:
        """The same mechanism with new values: m.with_parameters(L="0.45", d=0.6).

        Numbers are in the units of the file. Equations that do not depend on them are derived only once.
        """
        return Model(self._handle.with_parameters(**{name: _plain(name, value) for name, value in values.items()}))

    def normalize(self) -> NormalizedFile:
        """The file in which every point has its construction; the drawn form is replaced by constructions
        (docs/guide/drawn-form.md)."""
        return NormalizedFile(*self._handle.normalize())

    def loci(
        self,
        *,
        working_mode: WorkingMode | None = None,
        joint: Names | None = None,
        quantity: Names | None = None,
        min_force: Number | None = None,
        min_couple: Number | None = None,
        controlled: bool | None = None,
        tolerance: float | None = None,
        mesh_size: float | None = None,
        engine: Engine | None = None,
        time_limit: float | None = None,
    ) -> Loci:
        """The discontinuity loci, where joints lose contact: points over one free coordinate, curves over two, surfaces
        over three.

        `quantity` is "f,M" unless said. `mesh_size`: edges of a surface's triangles, as a part of the box. The other
        arguments are those of the class.
        """
        return Loci(
            self,
            arguments.options(
                self,
                working_mode=working_mode,
                joint=joint,
                quantity=quantity,
                min_force=min_force,
                min_couple=min_couple,
                controlled=controlled,
                tolerance=tolerance,
                mesh_size=mesh_size,
                engine=engine,
                time_limit=time_limit,
            ),
        )

    def zones(
        self,
        *,
        working_mode: WorkingMode | None = None,
        joint: Names | None = None,
        quantity: Names | None = None,
        min_force: Number | None = None,
        min_couple: Number | None = None,
        controlled: bool | None = None,
        tolerance: float | None = None,
        engine: Engine | None = None,
        time_limit: float | None = None,
        cells: int = 300_000,
        by_cells: bool = False,
    ) -> Zones:
        """The discontinuity-free zones, over one to three coordinates: the parts into which the loci divide the workspace.

        Over two lengths they are the faces between curves; over other coordinates they are found by so many `cells` in
        each mode, with proven bounds of their sizes. `by_cells`: over two lengths, too.
        """
        return Zones(
            self,
            arguments.count("cells", cells),
            bool(by_cells),
            arguments.options(
                self,
                working_mode=working_mode,
                joint=joint,
                quantity=quantity,
                min_force=min_force,
                min_couple=min_couple,
                controlled=controlled,
                tolerance=tolerance,
                engine=engine,
                time_limit=time_limit,
            ),
        )

    def verify(
        self,
        task: Task,
        fit: Literal["nearest", "best", "largest"] | None = None,
        *,
        working_mode: WorkingMode | None = None,
        joint: Names | None = None,
        tolerance: float | None = None,
        engine: Engine | None = None,
        time_limit: float | None = None,
    ) -> Verification:
        """Whether a task over one to six coordinates is free of loci: true if that is proven.

        `task`: a task file, its content as a dictionary ({"box": {"x": [0.1, 0.4], "y": [-0.8, -0.6]}, "margin": 0.01,
        "min_force": 5}), or an array (n, coordinates) of poses, which is a path; in the units of the mechanism file.
        `fit`: "nearest" moves a task that fails to the nearest place that verifies, "best" to the one of the largest
        margin, "largest" scales it.
        """
        if fit is not None:
            arguments.choice("fit", fit, ("nearest", "best", "largest"))
        text, file = ("", os.fspath(task)) if isinstance(task, (str, os.PathLike)) else (text_of(task), "task")
        given = arguments.options(
            self, working_mode=working_mode, joint=joint, tolerance=tolerance, engine=engine, time_limit=time_limit
        )
        return ask(lambda own: Verification(**own), "verify", self, text, file, fit or "", **given)

    def validate(
        self,
        grid: Sequence[int] = (),
        *,
        working_mode: WorkingMode | None = None,
        joint: Names | None = None,
        tolerance: float | None = None,
        engine: Engine | None = None,
        time_limit: float | None = None,
    ) -> Validation:
        """The loci compared with reactions that are computed numerically at the nodes of a grid: true if nothing
        contradicts them.

        `grid`: so many nodes along each coordinate; 400 each over two, 4000 over one, 40 each over three where none are
        given.
        """
        given = arguments.options(
            self, working_mode=working_mode, joint=joint, tolerance=tolerance, engine=engine, time_limit=time_limit
        )
        return ask(validation_of, "validate_loci", self, arguments.counts("grid", grid), **given)

    @overload
    def pose(
        self,
        at: Sequence[float] | Mapping[str, float],
        iterate: bool = ...,
        *,
        working_mode: Literal["all"],
        min_force: Number | None = ...,
        min_couple: Number | None = ...,
    ) -> list[Pose]: ...
    @overload
    def pose(
        self,
        at: Sequence[float] | Mapping[str, float],
        iterate: bool = ...,
        *,
        working_mode: WorkingMode | None = ...,
        min_force: Number | None = ...,
        min_couple: Number | None = ...,
    ) -> Pose: ...
    def pose(
        self,
        at: Sequence[float] | Mapping[str, float],
        iterate: bool = False,
        *,
        working_mode: WorkingMode | None = None,
        min_force: Number | None = None,
        min_couple: Number | None = None,
    ) -> Pose | list[Pose]:
        """Posture, reactions, take-up and pose error at one pose.

        `at`: a value a free coordinate, (0.25, -0.7) or {"x": 0.25, "y": -0.7}, m or, of an angle, rad; a float stands
        for the shortest decimal that reads back as it. `iterate`: also the error of the mechanism closed with its
        clearances taken up, `actual`. `min_force`, `min_couple`: what efforts of free actuators are to keep in every joint
        (`feasible_efforts`), N and N m. Out of reach, `unreachable` names the point that cannot be placed, and the rest is
        None or empty. With working_mode="all" a list: of the modes that have the pose.
        """
        values = arguments.pose(self, at)
        if working_mode == "all":
            kept = arguments.options(self, min_force=min_force, min_couple=min_couple)
            return ask(lambda own: [Pose(**one) for one in own], "solve_pose_in_modes", self, values, bool(iterate), **kept)
        given = arguments.options(self, working_mode=working_mode, min_force=min_force, min_couple=min_couple)
        outside = self._outside(values)

        def pose_of(own: dict[str, Any]) -> Pose:
            if own["unreachable"] is not None and outside:
                own["unreachable"] += f"; {outside}"
            return Pose(**own)

        return ask(pose_of, "solve_pose", self, values, bool(iterate), **given)

    def _outside(self, at: list[float]) -> str:
        """Which coordinate is out of its range, a hint for those who write mm or degrees; empty where none is."""
        for value, (name, (lower, upper)) in zip(at, self.coordinates.items()):
            if not lower <= value <= upper:
                return f"{name} = {value:g} is outside its range from {lower:g} to {upper:g}, in m or rad"
        return ""

    def reactions(self, poses: ArrayLike, *, working_mode: WorkingMode | None = None) -> dict[str, np.ndarray]:
        """Scalar reactions, N and N m, at poses (n, coordinates): name -> (n,), NaN where a pose is out of reach."""
        given = arguments.options(self, working_mode=_single(working_mode))
        return _clearloci.reactions(self._handle, arguments.poses(self, poses), **given)

    def errors(
        self,
        grid: int | Sequence[int] = (),
        worst_case: bool = True,
        *,
        loci: bool | None = None,
        zones: bool = False,
        working_mode: WorkingMode | None = None,
        tolerance: float | None = None,
        engine: Engine | None = None,
        time_limit: float | None = None,
    ) -> Errors | list[Errors]:
        """The pose error that the clearances cause, over one to three coordinates; with working_mode="all" a list, one a
        mode.

        `grid`: so many cells along each coordinate, along a single one so many steps; 720, (400, 400) or (40, 40, 40)
        where none are given. `worst_case`: also the bounds over all take-ups. `loci`: also the loci, which pictures over
        two coordinates show and at which errors over a single one jump; unless said over a single one alone. `zones`:
        also which cells lie in which discontinuity-free zone.
        """

        def modes_of(answer: list[dict[str, Any]]) -> list[Errors]:
            return [Errors(**own) for own in answer]

        count = len(self.coordinates)
        cells = arguments.counts("grid", [grid] if isinstance(grid, int) else grid)
        if cells and len(cells) != count:
            raise ValueError(f"grid has {len(cells)} numbers; give one for each of {', '.join(self.coordinates)}")
        given = arguments.options(
            self, working_mode=working_mode, tolerance=tolerance, engine=engine, time_limit=time_limit
        )
        traced = count == 1 or bool(zones) if loci is None else bool(loci)
        modes = ask(modes_of, "find_errors", self, cells, bool(worst_case), traced, bool(zones), **given)
        return modes if working_mode == "all" else modes[0]

    def trajectory(
        self,
        path: str | os.PathLike[str],
        period: float | None = None,
        samples: int = 2000,
        min_force: float | None = None,
        periods: Sequence[float] = (),
        *,
        working_mode: WorkingMode | None = None,
    ) -> Trajectory:
        """What happens along a motion file: reactions with inertia, take-up, contact losses, critical periods.

        `period` (s) replaces that of the file; `samples`: instants in a cycle; `min_force` (N): below it contact counts
        as lost, 1 % of the largest force at rest unless said; `periods` (s, ascending): the error of each, `sweep`.
        """
        given = arguments.options(self, working_mode=_single(working_mode))
        return ask(
            lambda own: Trajectory(**own),
            "follow_trajectory",
            self,
            arguments.path("path", path),
            None if period is None else arguments.positive("period", period, "s"),
            arguments.count("samples", samples, least=10),
            None if min_force is None else arguments.positive("min_force", min_force, "N"),
            arguments.positives("periods", periods, "s"),
            **given,
        )

    def __repr__(self) -> str:
        return f"<clearloci.Model {self.name!r}>"

    def __getstate__(self) -> _clearloci.Model:
        return self._handle

    def __setstate__(self, handle: _clearloci.Model) -> None:
        self._handle = handle


def _plain(name: str, value: Value) -> str:
    """A value of a parameter as the file would have it."""
    if isinstance(value, str):
        return value
    if isinstance(value, (bool, bytes)) or not hasattr(value, "__float__"):
        raise TypeError(f"{name} is {value!r}; give a number, or a text such as '1/3', '2*L' or '12 mm'")
    if isinstance(value, (float, np.floating)):
        value = float(value)  # of NumPy, which prints in other ways
    return str(value)


def _single(working_mode: WorkingMode | None) -> WorkingMode | None:
    if working_mode == "all":
        raise ValueError("working_mode is 'all'; this answer is of one mode: give one side a dyad")
    return working_mode


def text_of(task: Mapping[str, Any] | np.ndarray) -> str:
    """A dictionary or an array as the text of a task file."""
    if not isinstance(task, (Mapping, np.ndarray, list, tuple)):
        raise TypeError(f"the task is {type(task).__name__}; give a task file, its content as a dictionary, or an array")
    wrong = "the task is no content of a task file"
    try:
        content = dict(task) if isinstance(task, Mapping) else {"path": np.asarray(task, dtype=float)}
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{wrong}: {error}") from None
    content.setdefault("format", 1)
    return content_text(content, wrong)


def content_text(content: Mapping[str, Any], wrong: str) -> str:
    """A dictionary as the text of a file; arrays are lists. ValueError: `wrong`, and why."""

    def listed(value: Any) -> Any:
        values = np.asarray(value)
        if isinstance(value, np.ndarray) or values.dtype.kind in "biufU":
            return values.tolist()
        raise TypeError(f"{value!r} is no number, text or list")

    try:
        return json.dumps(content, default=listed, allow_nan=False)
    except (TypeError, ValueError, OverflowError, RecursionError) as error:
        raise ValueError(f"{wrong}: {error}") from None


def read(path: str | os.PathLike[str]) -> Model:
    """The mechanism of a file (docs/reference/mechanism-file.md). Raises InputError with file, line, column, what is wrong
    and how to mend it."""
    return Model(_clearloci.Model.read(arguments.path("path", path)))


def import_file(
    path: str | os.PathLike[str],
    *,
    clearance: str | float | None = None,
    loops: str | os.PathLike[str] | None = None,
) -> ImportedFile:
    """A file of another program as a mechanism file (docs/guide/import.md); `read` also reads such files directly.

    `path`: of a file, or an address of PMKS+. `clearance`: of pins and balls of which the file says none, m or a text with
    its unit; None: 20e-6 m. `loops`: the file with `closed_loop:` of a URDF; None: robot.yaml beside robot.urdf.
    """
    side = "" if loops is None else open(loops, encoding="utf-8").read()
    return ImportedFile(
        *_clearloci.Model.import_file(
            os.fspath(path),
            "" if clearance is None else str(clearance),
            side,
            "" if loops is None else os.fspath(loops),
        )
    )


def parse(text: str, file: str = "model") -> Model:
    """The same for a text; `file` is the name that errors show."""
    return Model(_clearloci.Model.parse(arguments.text("text", text), arguments.text("file", file)))
