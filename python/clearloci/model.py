"""A mechanism, of which every question is asked."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any, Mapping, Sequence, Union

import numpy as np

from . import _clearloci
from .answers import Loci, Validation, Verification, Zones, ask
from .motion import CoordinateErrors, ErrorMap, ErrorVolume, Pose, Trajectory
from .poses import PoseVerification, PoseZone, PoseZones

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

Number = Union[int, float, str]
Task = Union[str, "os.PathLike[str]", Mapping[str, Any], np.ndarray]


class Model:
    """What a mechanism file says, with values of parameters put in. Immutable; may be used from several threads.

    Questions take the options of the command line as keywords: `working_mode` ("all", "right,left" or a list of
    sides), `quantity` ("f,M" or a list), `joint`, `min_force` (N), `min_couple` (N m), `tolerance` (m), `mesh_size`,
    `engine` and `time_limit` (s). Wrong input raises InputError.
    """

    def __init__(self, handle: _clearloci.Model) -> None:
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
        """Values in SI units."""
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
    def joints(self) -> list[str]:
        return self._handle.joints

    @property
    def working_mode(self) -> dict[str, str]:
        """The file's: point -> side."""
        return self._handle.working_mode

    def with_parameters(self, **values: Number) -> Model:
        """The same mechanism with new values: m.with_parameters(L="0.45", F=80).

        Numbers are taken as they print; what does not depend on them is derived once.
        """
        return Model(self._handle.with_parameters(**values))

    def loci(self, **options: Any) -> Loci:
        """The discontinuity loci: points over one free coordinate, curves over two, surfaces over three."""
        return Loci(self, options)

    def zones(self, **options: Any) -> Zones:
        """The discontinuity-free zones, over two lengths."""
        return Zones(self, options)

    def verify(self, task: Task, fit: str | None = None, **options: Any) -> Verification:
        """Whether the task keeps clear of every locus: a task file, its content as a dictionary, or an array (n, 2) of
        points, m, which is a path. `fit`: "nearest" or "best", to move it where it fails.
        """
        return Verification(self, task, fit, options)

    def verify_poses(self, task: Task, fit: str | None = None, **options: Any) -> PoseVerification:
        """Whether a task over one to six coordinates, other than two lengths, keeps clear of every locus: a task file,
        its content as a dictionary, or an array (n, coordinates) of poses, which is a path. `fit`: "nearest" or "best",
        to move it where it fails, or "largest", to scale it.
        """
        if isinstance(task, (str, os.PathLike)):
            text, file = "", os.fspath(task)
        else:
            text, file = text_of(task), "task"
        return ask(lambda own: PoseVerification(**own), "verify_poses", self, text, file, fit or "", **options)

    def pose_zones(self, cells: int = 300_000, **options: Any) -> PoseZones:
        """The discontinuity-free zones over one to three coordinates, angles among them, by so many cells."""

        def zones_of(answer: dict[str, Any]) -> PoseZones:
            return PoseZones(**{**answer, "zones": [PoseZone(**own) for own in answer["zones"]]})

        return ask(zones_of, "find_pose_zones", self, cells, **options)

    def validate(self, grid: Sequence[int] = (), **options: Any) -> Validation:
        """The loci held against reactions that are solved numerically at the nodes of a grid: so many along each
        coordinate, 400 each over two, 4000 over one, 40 each over three where none are given.
        """
        return ask(lambda own: Validation(**own), "validate_loci", self, [int(n) for n in grid], **options)

    def pose(self, at: Sequence[float], iterate: bool = False, **options: Any) -> Pose | list[Pose]:
        """Posture, reactions, take-up and pose error at one pose: a value a free coordinate, m or, of an angle, rad.
        A float stands for the shortest decimal that reads back as it. With working_mode="all" a list: of the modes that
        have the pose.
        """
        values = [float(value) for value in at]
        if options.get("working_mode") == "all":
            return ask(lambda own: [Pose(**one) for one in own], "solve_pose_in_modes", self, values, iterate)
        return ask(lambda own: Pose(**own), "solve_pose", self, values, iterate, **options)

    def reactions(self, poses: ArrayLike, **options: Any) -> dict[str, np.ndarray]:
        """Scalar reactions, N and N m, at poses (n, coordinates): name -> (n,), NaN where a pose is out of reach."""
        return _clearloci.reactions(self._handle, np.asarray(poses, dtype=float), **options)

    def error_map(
        self, grid: tuple[int, int] = (400, 400), worst_case: bool = True, **options: Any
    ) -> ErrorMap | list[ErrorMap]:
        """The pose error over two coordinates, on a grid of (nx, ny) cells; one map a working mode, of a single one
        that map.
        """

        def maps_of(answer: dict[str, Any]) -> list[ErrorMap]:
            return [ErrorMap(coordinates=answer["coordinates"], **own) for own in answer["modes"]]

        maps = ask(maps_of, "error_map", self, *grid, worst_case, False, **options)
        return maps[0] if options.get("working_mode") != "all" else maps

    def error_volume(
        self, grid: tuple[int, int, int] = (40, 40, 40), worst_case: bool = True, **options: Any
    ) -> ErrorVolume | list[ErrorVolume]:
        """The pose error over three coordinates, on so many cells along each; one a working mode."""

        def volumes_of(answer: dict[str, Any]) -> list[ErrorVolume]:
            return [ErrorVolume(**own) for own in answer["modes"]]

        volumes = ask(volumes_of, "error_volume", self, [int(n) for n in grid], worst_case, **options)
        return volumes[0] if options.get("working_mode") != "all" else volumes

    def coordinate_errors(
        self, steps: int = 720, worst_case: bool = True, **options: Any
    ) -> CoordinateErrors | list[CoordinateErrors]:
        """The pose error over a single coordinate, with its jumps at the loci; one a working mode."""

        def errors_of(answer: dict[str, Any]) -> list[CoordinateErrors]:
            return [CoordinateErrors(coordinate=answer["coordinate"], **own) for own in answer["modes"]]

        all_modes = ask(errors_of, "coordinate_errors", self, steps, worst_case, **options)
        return all_modes[0] if options.get("working_mode") != "all" else all_modes

    def trajectory(
        self,
        path: str | os.PathLike[str],
        period: float | None = None,
        samples: int = 2000,
        min_force: float | None = None,
        periods: Sequence[float] = (),
        **options: Any,
    ) -> Trajectory:
        """What happens along a motion file: reactions with inertia, take-up, contact losses, critical periods; over
        `periods` (s) the error of each.
        """
        arguments = (os.fspath(path), period, samples, min_force, [float(p) for p in periods])
        return ask(lambda own: Trajectory(**own), "follow_trajectory", self, *arguments, **options)

    def __repr__(self) -> str:
        return f"<clearloci.Model {self.name!r}>"

    def __getstate__(self) -> _clearloci.Model:
        return self._handle

    def __setstate__(self, handle: _clearloci.Model) -> None:
        self._handle = handle


def task_of(model: Model, task: Task) -> _clearloci.Task:
    """A task file, a dictionary or an array, read."""
    if isinstance(task, (str, os.PathLike)):
        return _clearloci.read_task(os.fspath(task), model._handle)
    return _clearloci.parse_task(text_of(task), model._handle)


def text_of(task: Mapping[str, Any] | np.ndarray) -> str:
    """A dictionary or an array as the text of a task file."""
    content = dict(task) if isinstance(task, Mapping) else {"path": np.asarray(task, dtype=float)}
    content.setdefault("format", 1)
    return json.dumps(content, default=lambda value: np.asarray(value).tolist())


def read(path: str | os.PathLike[str]) -> Model:
    """The mechanism of a file. Raises InputError with file, line, column, what is wrong and how to mend it."""
    return Model(_clearloci.Model.read(os.fspath(path)))


def parse(text: str, file: str = "model") -> Model:
    """The same for a text; `file` is the name that errors show."""
    return Model(_clearloci.Model.parse(text, file))
