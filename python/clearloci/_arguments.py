"""Arguments in Python's words: each is checked here, with its name and what to give instead, before the library sees it."""

from __future__ import annotations

import math
import operator
import os
import re
from collections.abc import Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Callable, TypeVar, Union

import numpy as np

from . import _clearloci

if TYPE_CHECKING:
    from .model import Model

#: Exact numbers are taken as they are written: 0.1 and "0.1" are 1/10, "1/3" is a third.
Number = Union[int, float, str, Fraction, Decimal]
#: A value, or for parameters also an expression or a value with its unit: "2*L", "12 mm".
Value = Union[Number, str]
#: One side for each dyad: "right,left", ["right", "left"], {"B1": "right", "B2": "left"}; "all" for every combination.
WorkingMode = Union[str, Sequence[str], Sequence[int], Mapping[str, str]]
#: One name, several with commas between them, or a list.
Names = Union[str, Sequence[str]]

LARGEST = 10**15  #: numbers beyond it are refused in every front end

_LONG_EXPONENT = re.compile(r"[eE][+-]?0*[0-9]{4}")  #: a power of ten that would take long to compute

Kind = TypeVar("Kind")


def real(name: str, value: Any, unit: str = "") -> float:
    """A finite number within 1e15."""
    hint = f"give a number{' of ' + unit if unit else ''}, such as 0.25"
    if isinstance(value, (bool, str, bytes, complex, np.complexfloating)) or not hasattr(value, "__float__"):
        raise TypeError(f"{name} is {value!r}, not a number; {hint}")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    except (TypeError, ValueError):
        raise TypeError(f"{name} is {value!r}, not a number; {hint}") from None
    if not math.isfinite(number) or abs(number) > LARGEST:
        raise ValueError(f"{name} is {_shown(value)}, beyond all sizes of a mechanism; {hint}")
    return number


def positive(name: str, value: Any, unit: str = "") -> float:
    number = real(name, value, unit)
    if number <= 0:
        raise ValueError(f"{name} is {value!r}; give a number above 0{', in ' + unit if unit else ''}")
    return number


def exact(name: str, value: Any, unit: str) -> str:
    """A number above 0 as a decimal or a fraction."""
    if isinstance(value, str):
        try:
            if _LONG_EXPONENT.search(value):
                raise ValueError
            fraction = Fraction(value.replace(" ", ""))
        except (ValueError, ZeroDivisionError):
            raise ValueError(f"{name} is {value!r}; give a number of {unit} or a fraction, such as '5/2'") from None
    elif isinstance(value, Fraction):
        fraction = value
    elif isinstance(value, Decimal) and value.is_finite() and abs(value.adjusted()) < 1000:
        fraction = Fraction(value)
    else:
        positive(name, value, unit)
        fraction = Fraction(repr(float(value))) if not isinstance(value, int) else Fraction(value)
    if fraction <= 0 or fraction > LARGEST or fraction.denominator > 10**30:
        raise ValueError(f"{name} is {_shown(value)}; give a number of {unit} above 0, up to 1e15")
    return f"{fraction.numerator}/{fraction.denominator}"


def count(name: str, value: Any, least: int = 1, most: int = 2**31 - 1) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {value!r}, not a whole number; give one from {least} on") from None
    if isinstance(value, bool) or not least <= number <= most:
        raise ValueError(f"{name} is {_shown(value)}; give a whole number from {least} to {most}")
    return number


def counts(name: str, values: Any, size: int | None = None) -> list[int]:
    if isinstance(values, (str, bytes)) or not hasattr(values, "__iter__"):
        raise TypeError(f"{name} is {values!r}; give a whole number for each coordinate, such as (200, 300)")
    numbers = [count(f"{name}[{i}]", value) for i, value in enumerate(values)]
    if size is not None and len(numbers) != size:
        raise ValueError(f"{name} has {len(numbers)} numbers; give {size}")
    return numbers


def pose(model: Model, at: Any) -> list[float]:
    """One value a free coordinate: in their order, or by their names."""
    coordinates = list(model.coordinates)
    if isinstance(at, Mapping):
        unknown = [str(name) for name in at if name not in coordinates]
        missing = [name for name in coordinates if name not in at]
        if unknown or missing:
            raise ValueError(f"at has {', '.join(map(str, at))}; the coordinates are {', '.join(coordinates)}")
        at = [at[name] for name in coordinates]
    if isinstance(at, (str, bytes)):
        raise TypeError(f"at is {at!r}; give a number for each of {', '.join(coordinates)}")
    values = [at] if not hasattr(at, "__iter__") else list(at)
    if len(values) != len(coordinates):
        raise ValueError(f"at has {len(values)} values; the coordinates are {', '.join(coordinates)}")
    return [real(f"at[{name!r}]", value, "m, of an angle rad") for name, value in zip(coordinates, values)]


def poses(model: Model, values: Any) -> np.ndarray:
    """Poses as float64 (n, coordinates); NaN is passed on, as a pose out of reach."""
    try:
        array = np.asarray(values, dtype=float)
    except (TypeError, ValueError, OverflowError):
        raise TypeError("poses are no array of numbers; give (n, coordinates)") from None
    size = len(model.coordinates)
    if array.ndim == 1 and (array.size == size or size == 1):
        array = array.reshape(-1, size)
    if array.ndim != 2 or array.shape[1] != size:
        names = ", ".join(model.coordinates)
        raise ValueError(f"poses have the shape {array.shape}; give (n, {size}), one column each of {names}")
    return np.ascontiguousarray(array)


def positives(name: str, values: Any, unit: str) -> list[float]:
    if isinstance(values, (str, bytes)) or not hasattr(values, "__iter__"):
        raise TypeError(f"{name} is {values!r}; give a list of numbers, of {unit}")
    return [positive(f"{name}[{i}]", value, unit) for i, value in enumerate(values)]


def words(name: str, value: Names) -> list[str]:
    if isinstance(value, str):
        return [word.strip() for word in value.split(",")]
    if isinstance(value, Sequence) and all(isinstance(word, str) for word in value):
        return list(value)
    raise TypeError(f"{name} is {value!r}; give a name, or a list of names")


def sides(model: Model, value: WorkingMode) -> str | list[str] | list[int]:
    """As the library takes them; "all" stays."""
    dyads = list(model.working_mode)
    if isinstance(value, Mapping):
        unknown = [str(point) for point in value if point not in dyads]
        if unknown or len(value) != len(dyads):
            raise ValueError(f"working_mode has sides of {', '.join(map(str, value))}; give one for each of {', '.join(dyads)}")
        return [str(value[point]) for point in dyads]
    if isinstance(value, str):
        return value
    if isinstance(value, Sequence) and all(isinstance(side, str) for side in value):
        return list(value)
    if isinstance(value, Sequence) and all(side in (-1, 1) for side in value) and len(value) == len(dyads):
        return [int(side) for side in value]
    raise ValueError(f"working_mode is {value!r}; give one side for each of {', '.join(dyads)}, or 'all'")


def text(name: str, value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{name} is {type(value).__name__}, not str")
    return value


def path(name: str, value: Any) -> str:
    try:
        return os.fsdecode(value)
    except TypeError:
        raise TypeError(f"{name} is {type(value).__name__}; give the path of a file") from None


def formats(value: Any) -> set[str]:
    return {value} if isinstance(value, str) else set(words("formats", sorted(value)))


def options(model: Model, **given: Any) -> dict[str, Any]:
    """Those that were given, checked, as the bindings take them."""
    checks: dict[str, Callable[[Any], Any]] = {
        "working_mode": lambda value: sides(model, value),
        "quantity": lambda value: words("quantity", value),
        "joint": lambda value: words("joint", value),
        "min_force": lambda value: exact("min_force", value, "N"),
        "min_couple": lambda value: exact("min_couple", value, "N m"),
        "controlled": bool,
        "tolerance": lambda value: positive("tolerance", value, "m"),
        "mesh_size": lambda value: positive("mesh_size", value),
        "engine": lambda value: text("engine", value),
        "time_limit": lambda value: positive("time_limit", value, "s"),
    }
    return {name: checks[name](value) for name, value in given.items() if value is not None}


def choice(name: str, value: Any, choices: Sequence[str]) -> str:
    if value not in choices:
        raise ValueError(f"{name} is {value!r}; choose from {', '.join(choices)}")
    return str(value)


def handle_of(model: Any) -> _clearloci.Model:
    handle = getattr(model, "_handle", None)
    if not isinstance(handle, _clearloci.Model):
        raise TypeError(f"{type(model).__name__} is no clearloci.Model; clearloci.read(path) makes one")
    return handle


def _shown(value: Any) -> str:
    shown = repr(value) if not isinstance(value, int) or abs(value) < 10**20 else "a number of many digits"
    return shown if len(shown) <= 40 else shown[:37] + "..."
