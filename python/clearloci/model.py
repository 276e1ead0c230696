"""A mechanism, of which every question is asked."""

from __future__ import annotations

import json
import os
from typing import Any, Mapping, Union

import numpy as np

from . import _clearloci
from .answers import Loci, Verification, Zones

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
    content = dict(task) if isinstance(task, Mapping) else {"path": np.asarray(task, dtype=float)}
    content.setdefault("format", 1)
    return _clearloci.parse_task(json.dumps(content, default=lambda value: np.asarray(value).tolist()), model._handle)


def read(path: str | os.PathLike[str]) -> Model:
    """The mechanism of a file. Raises InputError with file, line, column, what is wrong and how to mend it."""
    return Model(_clearloci.Model.read(os.fspath(path)))


def parse(text: str, file: str = "model") -> Model:
    """The same for a text; `file` is the name that errors show."""
    return Model(_clearloci.Model.parse(text, file))
