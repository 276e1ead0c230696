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
class ErrorMap(Asked, Exported):
    """The pose error of one working mode over two coordinates; every field is an array (ny, nx), NaN where none is."""

    working_mode: dict[str, str]
    coordinates: list[str]
    fields: dict[str, np.ndarray] = field(repr=False)  #: "dx", "dy", "dalpha", "dp", "worst_dx", ...
    units: dict[str, str]
    x: np.ndarray = field(repr=False)  #: middles of the cells, m or, of an angle, rad
    y: np.ndarray = field(repr=False)
    reachable: int
    undefined: int
    never_loaded: list[str]

    def __getattr__(self, name: str) -> np.ndarray:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self.fields[name]
        except KeyError:
            raise AttributeError(name) from None

    def plot(self, field: str = "dp", ax: Axes | None = None) -> Axes:
        """One field in colours, in the Axes given or in new ones."""
        from .plots import plot_field

        return plot_field(self, field, ax)


@dataclass(frozen=True)
class ErrorVolume(Asked, Exported):
    """The pose error of one working mode over three coordinates; every field is an array indexed by the last coordinate
    first, NaN where there is none."""

    working_mode: dict[str, str]
    fields: dict[str, np.ndarray] = field(repr=False)  #: "dx", "dy", "dz", "dalpha_x", ..., "dp", "worst_dx", ...
    units: dict[str, str]
    axes: dict[str, np.ndarray] = field(repr=False)  #: of each coordinate the middles of the cells, m or rad
    reachable: int
    undefined: int
    never_loaded: list[str]


@dataclass(frozen=True)
class CoordinateErrors(Asked, Exported):
    """The pose error of one working mode over a single coordinate."""

    working_mode: dict[str, str]
    coordinate: str
    samples: dict[str, np.ndarray] = field(repr=False)  #: the coordinate, reactions, take-up, errors; NaN at events
    units: dict[str, str]
    events: list[dict[str, Any]] = field(repr=False)  #: what vanishes where, and by how much the end effector jumps
    never_loaded: list[str]


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
