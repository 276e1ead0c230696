"""Plots with matplotlib: the same colours and order as the program's pictures, in Axes that the caller may go on with.

As in the program's tables and pictures, places are in the units of the mechanism file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .answers import Loci, Zones
    from .model import Model

_STYLES: dict[str, dict[str, Any]] = {
    "direct-singularity": {"color": "black", "linestyle": "-.", "linewidth": 1},
    "workspace-boundary": {"color": "0.6", "linewidth": 0.8},
}


class _Plane:
    """Two coordinates in the units of the file."""

    def __init__(self, model: Model, coordinates: list[str]) -> None:
        handle = model._handle
        kinds = ["angle" if name in handle.angles else "length" for name in coordinates]
        self.labels = [f"{name} ({handle.units[kind][0]})" for name, kind in zip(coordinates, kinds)]
        self.scale = np.array([1 / handle.units[kind][1] for kind in kinds])
        self.of_lengths = "angle" not in kinds

    def __call__(self, places: Any) -> np.ndarray:
        """Places (n, 2), m or rad, as they are plotted."""
        return np.asarray(places, dtype=float) * self.scale


def _shown_unit(model: Model, si: str) -> tuple[str, float]:
    """The unit of the file for m, rad or N, and how many of it are one; others stay."""
    kind = {"m": "length", "rad": "angle", "N": "force"}.get(si)
    if kind is None:
        return si, 1.0
    name, size = model._handle.units[kind]
    return name, 1 / size


def _axes(ax: Axes | None, plane: _Plane) -> Axes:
    ax = _new_axes() if ax is None else ax
    if plane.of_lengths:
        ax.set_aspect("equal")
    ax.set_xlabel(plane.labels[0])
    ax.set_ylabel(plane.labels[1])
    return ax


def _new_axes() -> Axes:
    import matplotlib.pyplot as plt

    return plt.subplots()[1]


def _legend(ax: Axes, beside: bool) -> None:
    """Inside the picture: beside the plot where the figure is ours and makes room for it, else in the plot."""
    if not ax.get_legend_handles_labels()[0]:
        return
    if beside:
        legend = ax.legend(fontsize="small", loc="center left", bbox_to_anchor=(1.01, 0.5))
        ax.figure.draw_without_rendering()  # from now on the legend has a size
        taken = legend.get_window_extent().width / ax.figure.bbox.width
        ax.figure.subplots_adjust(right=max(0.3, 0.96 - taken))
    else:
        ax.legend(fontsize="small", loc="best")


def _mode_of(curves: list[Any], wanted: dict[str, str] | None) -> dict[str, str] | None:
    return wanted if wanted is not None else (curves[0].working_mode if curves else None)


def _label(curve: Any) -> str:
    what = {"contact-loss": "contact lost: ", "backlash": "backlash: "}.get(curve.kind, curve.kind.replace("-", " ") + " ")
    return (what + ", ".join(curve.vanishing)).strip()


def _plot_curves(curves: list[Any], ax: Axes, plane: _Plane, mode: dict[str, str] | None) -> None:
    """A line an arc; loci for the same reason have one colour and one entry in the legend."""
    colours: dict[str, str] = {}
    named: set[str] = set()
    for curve in curves:
        if curve.working_mode != mode:
            continue
        label = _label(curve)
        style = dict(_STYLES.get(curve.kind, {"linewidth": 1.5}))
        style.setdefault("color", colours.setdefault(label, f"C{len(colours)}"))
        for arc in curve.arcs:
            ax.plot(*plane(arc).T, label=None if label in named else label, **style)
            named.add(label)


def _plot_mechanism(model: Model, ax: Axes, plane: _Plane, mode: dict[str, str] | None) -> np.ndarray:
    """Where the coordinates are the place of the end effector: the links in a pose of this working mode. Motors are filled,
    pins of the ground have a bar below them. Returns the places that it takes, none where it is not drawn."""
    sketch = model._handle.sketch(mode)
    if sketch is None:
        return np.empty((0, 2))
    places = [plane(line) for kind in ("links", "slides", "springs") for line in sketch[kind]]
    for link in sketch["links"]:
        corners = plane(link)
        if len(corners) > 2:
            ax.fill(*corners.T, facecolor="0.45", edgecolor="0.45", alpha=0.3, zorder=2.5)
        else:
            ax.plot(*corners.T, color="0.45", linewidth=3, alpha=0.6, solid_capstyle="round", zorder=2.5)
    for slide in sketch["slides"]:
        ax.plot(*plane(slide).T, color="0.45", linewidth=5, alpha=0.3, solid_capstyle="butt", zorder=2.5)
    for spring in sketch["springs"]:
        ax.plot(*plane(_zigzag(spring)).T, color="0.25", linewidth=0.9, zorder=2.4)
    for joint in sketch["joints"]:
        at = plane(joint["at"])
        colour = "0.25" if joint["actuated"] else "white"
        ax.plot(*at, "o", markersize=5, markerfacecolor=colour, markeredgecolor="0.25", zorder=2.6)
        if joint["on_ground"]:
            ax.plot(*at, marker="_", markersize=14, color="0.25", markeredgewidth=2, zorder=2.4)
    if "end_effector" in sketch:
        name, at = sketch["end_effector"]
        ax.annotate(name, plane(at), xytext=(6, 6), textcoords="offset points", zorder=2.7)
    return np.concatenate(places)


def _zigzag(ends: np.ndarray, turns: int = 8) -> np.ndarray:
    """A spring between two points, straight at its ends."""
    way = ends[1] - ends[0]
    along = np.concatenate(([0], np.linspace(0.2, 0.8, 2 * turns + 1), [1]))
    beside = np.concatenate(([0, 0], [0.05 * (-1) ** k for k in range(2 * turns - 1)], [0, 0]))
    return ends[0] + np.outer(along, way) + np.outer(beside, [-way[1], way[0]])


def plot_loci(loci: Loci, ax: Axes | None, working_mode: dict[str, str] | None) -> Axes:
    if len(loci.coordinates) != 2:
        raise ValueError("loci over two free coordinates are plotted; surfaces and points have export()")
    mode = _mode_of(loci.curves, working_mode)
    plane = _Plane(loci.model, loci.coordinates)
    beside = ax is None
    ax = _axes(ax, plane)
    for region in loci.workspace:
        if region.working_mode == mode:
            _fill(ax, [plane(ring) for ring in region.rings], color="0.95", zorder=0)
    _plot_curves(loci.curves, ax, plane, mode)
    named: set[str] = set()
    for point in loci.isolated_points:
        if point.working_mode == mode:
            label = f"isolated: {', '.join(point.vanishing)}"
            ax.plot(*plane(point.at), "o", color="black", fillstyle="none", label=None if label in named else label)
            named.add(label)
    _finish(ax, plane, loci.box, _plot_mechanism(loci.model, ax, plane, mode), beside)
    return ax


def _finish(ax: Axes, plane: _Plane, box: list[tuple[float, float]], drawn: np.ndarray, beside: bool) -> None:
    """The box, with a dashed border and room around it where the mechanism stands out of it, and the legend."""
    corners = plane(np.array(box).T)
    lower, upper = np.min([corners[0], *drawn], axis=0), np.max([corners[1], *drawn], axis=0)
    if np.any(lower < corners[0]) or np.any(upper > corners[1]):
        (x0, y0), (x1, y1) = corners
        ax.plot([x0, x1, x1, x0, x0], [y0, y0, y1, y1, y0], color="0.6", linewidth=0.7, linestyle=":", zorder=0.5)
        room = 0.05 * (upper - lower)
        lower, upper = lower - room, upper + room
    ax.set_xlim(lower[0], upper[0])
    ax.set_ylim(lower[1], upper[1])
    _legend(ax, beside)


def plot_zones(zones: Zones, ax: Axes | None, working_mode: dict[str, str] | None) -> Axes:
    mode = _mode_of(list(zones), working_mode)
    plane = _Plane(zones.model, zones.coordinates)
    beside = ax is None
    ax = _axes(ax, plane)
    for number, zone in enumerate(zone for zone in zones if zone.working_mode == mode):
        rings = [plane(ring) for ring in (zone.polygon, *zone.holes)]
        _fill(ax, rings, color=f"C{number % 10}", alpha=0.35, zorder=0)
        ax.annotate(zone.id, plane(zone.sample), ha="center", va="center", zorder=3)
    _plot_curves(zones.curves, ax, plane, mode)
    _finish(ax, plane, zones.box, _plot_mechanism(zones.model, ax, plane, mode), beside)
    return ax


def plot_field(errors: Any, field: str, ax: Axes | None) -> Axes:
    """Magnitudes in viridis, signed errors from blue to red; the colours end at the 90th percentile."""
    plane = _Plane(errors.model, errors.coordinates)
    ax = _axes(ax, plane)
    unit, per_si = _shown_unit(errors.model, errors.units[field])
    values = errors.fields[field] * per_si
    known = np.abs(values[np.isfinite(values)])
    most = float(np.percentile(known, 90)) if known.size else 1.0
    signed = bool(np.nanmin(values) < 0) if known.size else False
    image = ax.pcolormesh(
        *(errors.axes[name] * scale for name, scale in zip(errors.coordinates, plane.scale)),
        values,
        cmap="coolwarm" if signed else "viridis",
        vmin=-most if signed else 0,
        vmax=most,
        shading="nearest",
    )
    ax.figure.colorbar(image, ax=ax, label=f"{field} ({unit})", extend="both" if signed else "max")
    return ax


def plot_line(errors: Any, field: str, ax: Axes | None) -> Axes:
    """A field over a single coordinate, broken at the loci."""
    ax = _new_axes() if ax is None else ax
    axis = _Plane(errors.model, errors.coordinates)
    unit, per_si = _shown_unit(errors.model, errors.units[field])
    (name,) = errors.coordinates
    ax.plot(errors.axes[name] * axis.scale[0], errors.fields[field] * per_si)
    ax.set_xlabel(axis.labels[0])
    ax.set_ylabel(f"{field} ({unit})")
    return ax


def plot_trajectory(motion: Any, columns: list[str], ax: Axes | None) -> Axes:
    """Columns over time; contact losses as vertical lines."""
    ax = _new_axes() if ax is None else ax
    for column in columns:
        unit, per_si = _shown_unit(motion.model, motion.units[column])
        ax.plot(motion.samples["time"], motion.samples[column] * per_si, label=f"{column} ({unit})")
    for number, loss in enumerate(motion.losses):
        label = None if number else "contact lost"
        ax.axvline(loss["time"], color="0.7", linewidth=0.8, zorder=0, label=label)
    ax.set_xlabel("time (s)")
    ax.legend(fontsize="small")
    return ax


def _fill(ax: Axes, rings: list[np.ndarray], **style: Any) -> None:
    """Rings filled by the even-odd rule, whichever way they turn."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    def signed_area(ring: np.ndarray) -> float:
        x, y = ring[:, 0], ring[:, 1]
        return float(np.dot(x[:-1], y[1:]) - np.dot(x[1:], y[:-1]))

    if not rings:
        return
    largest = max(rings, key=lambda ring: abs(signed_area(ring)))
    turned = [ring if (signed_area(ring) > 0) == (ring is largest) else ring[::-1] for ring in rings]
    path = Path.make_compound_path(*(Path(ring, closed=True) for ring in turned if len(ring) > 2))
    ax.add_patch(PathPatch(path, linewidth=0, **style))
    ax.autoscale_view()
