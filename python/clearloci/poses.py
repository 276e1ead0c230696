"""Zones over one to three coordinates, angles among them, by proofs over cells."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .answers import Asked, Exported


@dataclass(frozen=True)
class PoseZone:
    """A discontinuity-free zone, with bounds of its size from inside and outside."""

    id: str
    assembly_mode: int
    signs: dict[str, int]
    at_least: float  #: a proven bound from below, of products of the coordinates' units
    at_most: float
    lower: list[float]
    upper: list[float]
    sample: list[float]
    bounds: list[dict[str, Any]]  #: what may vanish beside it
    at_side: bool  #: the box of the mechanism file cuts it
    perhaps_one_with: list[str]
    ends: list[dict[str, Any]]  #: over one coordinate
    faces: list[np.ndarray] = field(repr=False)  #: convex polygons (corners, 3), over two coordinates segments
    ball: tuple[list[float], float] | None  #: the largest that was found in what is proven: centre, radius


@dataclass(frozen=True)
class PoseZones(Asked, Exported):
    """Zones over one to three coordinates, by cells; largest first."""

    zones: list[PoseZone]
    coordinates: list[str]
    lower: list[float]
    upper: list[float]
    working_mode: dict[str, str]
    outside: float  #: proven to be out of reach
    in_doubt: float
    #: In the middles of a grid over the box, the last coordinate first: 1 for the first zone, 2, ..., 0 in doubt,
    #: -1 out of reach.
    labels: np.ndarray = field(repr=False)
    cells: int
    complete: bool
    notes: list[str]

    def __len__(self) -> int:
        return len(self.zones)

    def __getitem__(self, index: int) -> PoseZone:
        return self.zones[index]
