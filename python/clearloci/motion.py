"""Answers about poses, errors and motions."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from .answers import Asked, Exported

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Pose(Asked):
    """One pose: places in m, reactions in N and N m, errors in m and rad. True where it is reached; of a pose out of reach
    the numbers are None, and lists and dictionaries are empty."""

    at: list[float]
    working_mode: dict[str, str]
    unreachable: str | None  #: why it is not reached: the first point that cannot be placed, or the limit that it is beyond
    points: dict[str, list[float]]
    reactions: dict[str, dict[str, float]]  #: joint -> {"fx": N, "fy": N, "M": N m}
    determinant: float | None  #: ``|A|``
    condition: float | None
    singular: bool | None
    take_up: dict[str, dict[str, Any]]
    error: dict[str, list[float]] | None  #: to the first order: "displacement" (m), "rotation" (rad); None if undefined
    worst: dict[str, Any] | None  #: bounds over all take-ups
    undefined: list[str]  #: joints whose take-up is
    vanishing: list[str]
    #: of every free actuator the efforts that keep every joint loaded here: "ranges", each with "from", "to" and what
    #: fails at either end
    feasible_efforts: dict[str, dict[str, Any]]
    actual: dict[str, list[float]] | None  #: beyond the linear step, where it was asked for
    notes: list[str]

    _stem = "pose"

    def __bool__(self) -> bool:
        return self.unreachable is None

    @property
    def pose_error(self) -> dict[str, list[float]] | None:
        """`error` by its name on the command line."""
        return self.error

    def json(self) -> str:
        self._require_reach()
        return super().json()

    def table(self) -> str:
        self._require_reach()
        return super().table()

    def _require_reach(self) -> None:
        if self.unreachable is not None:
            raise ValueError(f"the pose {self.at} is out of reach: {self.unreachable}")


@dataclass(frozen=True)
class Errors(Asked, Exported):
    """The pose error of one working mode over one to three coordinates. Every field is an array indexed by the last
    coordinate first, (ny, nx) over x and y, NaN where there is no error; fields are attributes, too: ``errors.dx``."""

    working_mode: dict[str, str]
    coordinates: list[str]
    axes: dict[str, np.ndarray] = field(repr=False)  #: of each coordinate the values at which fields are known, m or rad
    fields: dict[str, np.ndarray] = field(repr=False)  #: "dx", "dy", "dalpha", "dp", "worst_dx", ...
    #: Over a single coordinate the reactions and the joints' take-up, name -> values, as fields.
    take_up: dict[str, np.ndarray] = field(repr=False)
    units: dict[str, str] = field(repr=False)  #: of coordinates, fields and take-up
    #: Over a single coordinate what vanishes where, and by how much the end effector jumps there.
    events: list[dict[str, Any]] = field(repr=False)
    #: Where they were asked for: zone -> numbers of the cells in it, for ``errors.dx.ravel()``.
    zones: dict[str, np.ndarray] = field(repr=False)
    reachable: int  #: cells in the workspace
    undefined: int  #: of those, cells without an error, exactly on a locus
    never_loaded: list[str]
    complete: bool  #: False where a time limit came before all loci were traced
    notes: list[str] = field(repr=False)

    def __getattr__(self, name: str) -> np.ndarray:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self.fields[name] if name in self.fields else self.axes[name]
        except KeyError:
            raise AttributeError(name) from None

    @property
    def samples(self) -> dict[str, np.ndarray]:
        """Over a single coordinate all columns by name: the coordinate, reactions, take-up and errors."""
        self._require(len(self.coordinates) == 1, "samples are those of a single coordinate; see `fields` and `axes`")
        return {**self.axes, **self.take_up, **self.fields}

    def plot(self, field: str = "dp", ax: Axes | None = None) -> Axes:
        """One field over two coordinates in colours, or over a single one as a line, in the Axes given or in new ones."""
        from .plots import plot_field, plot_line

        self._require(len(self.coordinates) < 3, "errors over three coordinates have no plot; `export` draws slices")
        return plot_field(self, field, ax) if len(self.coordinates) == 2 else plot_line(self, field, ax)

    @staticmethod
    def _require(holds: bool, otherwise: str) -> None:
        if not holds:
            raise ValueError(otherwise)


@dataclass(frozen=True)
class Trajectory(Asked, Exported):
    """A motion: times in s, lengths in m, angles in rad, forces in N, couples in N m."""

    period: float
    length: float
    samples: dict[str, np.ndarray] = field(repr=False)  #: "time", "distance", "stage", "dx", ..., "fA1x", ...
    units: dict[str, str]
    losses: list[dict[str, Any]] = field(repr=False)  #: where the parts of a joint lose contact, in order of time
    stages: list[dict[str, Any]] = field(repr=False)
    #: with periods: "periods", "distance", and (periods, samples) of "dx", ...
    sweep: dict[str, np.ndarray] | None = field(repr=False)

    def plot(self, columns: list[str] | None = None, ax: Axes | None = None) -> Axes:
        """Columns of the samples (the pose error) over time, in the Axes given or in new ones."""
        from .plots import plot_trajectory

        return plot_trajectory(self, columns or ["dx", "dy"], ax)
