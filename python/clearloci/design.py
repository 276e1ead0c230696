"""Many designs: which are good, why the others fail, which is best (docs/guide/studies.md)."""

from __future__ import annotations

import csv
import io
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Iterable, Mapping

import numpy as np

from . import _arguments as arguments
from . import _clearloci
from .answers import write_files
from .model import Model, content_text, parse


@dataclass(frozen=True)
class Designs:
    """The designs of a study, column by column; `pandas.DataFrame(designs.columns)` is a table of them."""

    #: varied parameters and figures: float64 (n,); "status", "reason": lists of str
    columns: dict[str, Any] = field(repr=False)
    parameters: list[str]
    figures: list[str]
    best: int | None  #: row of the best by the first goal
    best_model: str | None = field(repr=False, default=None)  #: its mechanism file
    front: list[int] = field(default_factory=list)  #: rows, with several goals
    cells: list[tuple] = field(default_factory=list, repr=False)  #: of a proof: lower, upper, status, reason
    #: of a proof over one parameter: all values that verify, range by range: an enclosure of where it begins, one of
    #: where it ends, and why designs below and above fail
    ranges: list[tuple] = field(default_factory=list)
    tolerances: tuple[list[float], list[float]] | None = None  #: of a proof: the box around the file's design
    #: of a proof with a goal over several parameters: what no design is better than, and what the best has
    best_goal: tuple[float, float] | None = None
    complete: bool = True

    def __len__(self) -> int:
        return len(self.columns["status"])

    @property
    def feasible(self) -> np.ndarray:
        """bool (n,): verified for every task, and what is required holds."""
        return np.asarray([status == "feasible" for status in self.columns["status"]], dtype=bool)

    def export(self, folder: str | os.PathLike[str], formats: Iterable[str] = ("csv",)) -> list[str]:
        """Writes designs.csv, a row a design, and best.yaml where there is a best; returns the files."""
        if arguments.formats(formats) - {"csv"}:
            raise ValueError("designs are written as csv; the command `clearloci design` writes pictures and a page, too")
        table = io.StringIO()
        writer = csv.writer(table, lineterminator="\n")
        writer.writerow(self.columns)
        writer.writerows(zip(*self.columns.values()))
        best = {} if self.best_model is None else {"best.yaml": self.best_model}
        return write_files(folder, {"designs.csv": table.getvalue(), **best})

    @property
    def best_design(self) -> Model | None:
        """The best one as a model."""
        return None if self.best_model is None else parse(self.best_model, "best.yaml")


def _judged(handle: _clearloci.Model, text: str, file: str, first: int, count: int) -> str:
    return _clearloci.judge_designs(handle, text, file, first, count)


def design(
    model: Model,
    study: str | os.PathLike[str] | Mapping[str, Any],
    executor: Any = None,
    chunk: int = 512,
    threads: int = 0,
    table: str | os.PathLike[str] | None = None,
    resume: bool = False,
) -> Designs:
    """Judge the designs of a study: a file, or a dictionary with its keys.

    With `executor` the designs of a grid or a sample are judged by any concurrent.futures executor, Dask's among them,
    `chunk` designs a call; the answer is the same. Otherwise `threads` of this process do it (0: one a core), and with
    `table`, a path, finished designs are kept as they come, from which `resume` goes on.
    """
    if isinstance(study, Mapping):
        text = content_text({"format": 1, **study}, "the study is no content of a study file")
        file = os.path.join(os.getcwd(), "study")
    else:
        file = arguments.path("study", study)
        try:
            text = Path(file).read_text(encoding="utf-8")
        except OSError as error:
            raise ValueError(f"the study {file!r} cannot be read: {error.strerror}; give the path of a study file") from None
    handle = arguments.handle_of(model)
    threads, chunk = arguments.count("threads", threads, least=0), arguments.count("chunk", chunk)
    if executor is not None:
        if not callable(getattr(executor, "submit", None)):
            raise TypeError(f"executor is {type(executor).__name__}; give one of concurrent.futures, or one with its submit()")
        if table is not None:
            raise ValueError("table is kept by the threads of this process; leave table or executor out")
    if resume and table is None:
        raise ValueError("resume goes on from a table; give table, the path of one, without an executor")
    if executor is None:
        kept = "" if table is None else arguments.path("table", table)
        return Designs(**_clearloci.run_study(handle, text, file, threads, kept, bool(resume)))
    count = _clearloci.design_count(handle, text, file)
    futures = [
        executor.submit(_judged, handle, text, file, first, min(chunk, count - first))
        for first in range(0, count, chunk)
    ]
    lines = "".join(future.result() for future in futures)
    return Designs(**_clearloci.study_result(handle, text, file, lines))
