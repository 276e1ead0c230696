"""Plots with matplotlib: the same colours and order as the program's pictures, in Axes that the caller may go on with."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .answers import Loci, Zones

_STYLES: dict[str, dict[str, Any]] = {
    "direct-singularity": {"color": "black", "linestyle": "-.", "linewidth": 1},
    "workspace-boundary": {"color": "0.6", "linewidth": 0.8},
}


def _axes(ax: Axes | None, coordinates: list[str]) -> Axes:
    if ax is None:
        import matplotlib.pyplot as plt

        ax = plt.subplots(layout="constrained")[1]  # room for a legend beside the plot
    ax.set_aspect("equal")
    ax.set_xlabel(f"{coordinates[0]} (m)")
    ax.set_ylabel(f"{coordinates[1]} (m)")
    return ax


def _mode_of(curves: list[Any], wanted: dict[str, str] | None) -> dict[str, str] | None:
    return wanted if wanted is not None else (curves[0].working_mode if curves else None)


def _label(curve: Any) -> str:
    what = {"contact-loss": "contact lost: ", "backlash": "backlash: "}.get(curve.kind, curve.kind.replace("-", " ") + " ")
    return (what + ", ".join(curve.vanishing)).strip()


def plot_curves(curves: list[Any], ax: Axes, mode: dict[str, str] | None) -> None:
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
            ax.plot(arc[:, 0], arc[:, 1], label=None if label in named else label, **style)
            named.add(label)


def plot_loci(loci: Loci, ax: Axes | None, working_mode: dict[str, str] | None) -> Axes:
    if len(loci.coordinates) != 2:
        raise ValueError("loci over two free coordinates are plotted; surfaces and points have export()")
    mode = _mode_of(loci.curves, working_mode)
    ax = _axes(ax, loci.coordinates)
    for region in loci.workspace:
        if region.working_mode == mode:
            _fill(ax, region.rings, color="0.95", zorder=0)
    plot_curves(loci.curves, ax, mode)
    named: set[str] = set()
    for point in loci.isolated_points:
        if point.working_mode == mode:
            label = f"isolated: {', '.join(point.vanishing)}"
            ax.plot(*point.at, "o", color="black", fillstyle="none", label=None if label in named else label)
            named.add(label)
    (x0, x1), (y0, y1) = loci.box
    ax.set_xlim(x0, x1)
    ax.set_ylim(y0, y1)
    ax.legend(fontsize="small", loc="center left", bbox_to_anchor=(1, 0.5))
    return ax


def plot_zones(zones: Zones, ax: Axes | None, working_mode: dict[str, str] | None) -> Axes:
    mode = _mode_of(list(zones), working_mode)
    ax = _axes(ax, list(zones.model.coordinates))
    for number, zone in enumerate(zone for zone in zones if zone.working_mode == mode):
        _fill(ax, [zone.polygon, *zone.holes], color=f"C{number % 10}", alpha=0.35, zorder=0)
        ax.annotate(zone.id, zone.sample, ha="center", va="center")
    plot_curves(zones.curves, ax, mode)
    return ax


def plot_field(errors: Any, field: str, ax: Axes | None) -> Axes:
    """Magnitudes in viridis, signed errors from blue to red; the colours end at the 90th percentile."""
    ax = _axes(ax, errors.coordinates)
    values = errors.fields[field]
    known = np.abs(values[np.isfinite(values)])
    most = float(np.percentile(known, 90)) if known.size else 1.0
    signed = bool(np.nanmin(values) < 0) if known.size else False
    image = ax.pcolormesh(
        *(errors.axes[name] for name in errors.coordinates),
        values,
        cmap="coolwarm" if signed else "viridis",
        vmin=-most if signed else 0,
        vmax=most,
        shading="nearest",
    )
    ax.figure.colorbar(image, ax=ax, label=f"{field} ({errors.units[field]})", extend="both" if signed else "max")
    return ax


def plot_line(errors: Any, field: str, ax: Axes | None) -> Axes:
    """A field over a single coordinate, broken at the loci."""
    if ax is None:
        import matplotlib.pyplot as plt

        ax = plt.subplots(layout="constrained")[1]
    (name,) = errors.coordinates
    ax.plot(errors.axes[name], errors.fields[field])
    ax.set_xlabel(f"{name} ({errors.units[name]})")
    ax.set_ylabel(f"{field} ({errors.units[field]})")
    return ax


def plot_trajectory(motion: Any, columns: list[str], ax: Axes | None) -> Axes:
    """Columns over time; contact losses as vertical lines."""
    if ax is None:
        import matplotlib.pyplot as plt

        ax = plt.subplots(layout="constrained")[1]  # room for a legend beside the plot
    for column in columns:
        ax.plot(motion.samples["time"], motion.samples[column], label=f"{column} ({motion.units[column]})")
    for loss in motion.losses:
        ax.axvline(loss["time"], color="0.7", linewidth=0.8, zorder=0)
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
