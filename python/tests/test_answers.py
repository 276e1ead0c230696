import json
import pickle

import clearloci as cl
import numpy as np
import pytest
from conftest import EXAMPLES


def test_loci_are_curves_with_arrays(five_bar):
    loci = five_bar.loci(working_mode="all")
    assert loci.complete and loci.open == []
    assert {c.kind for c in loci.curves} >= {"contact-loss", "backlash", "direct-singularity", "workspace-boundary"}
    for curve in loci.curves:
        assert curve.certified
        for arc in curve.arcs:
            assert arc.dtype == np.float64 and arc.ndim == 2 and arc.shape[1] == 2


def values_and_slopes(implicit, arc):
    polynomial = eval(f"lambda x, y: {implicit.replace('^', '**')}")
    x, y = arc[:, 0], arc[:, 1]
    step = 1e-6
    slopes = np.hypot(
        polynomial(x + step, y) - polynomial(x - step, y), polynomial(x, y + step) - polynomial(x, y - step)
    ) / (2 * step)
    return np.abs(polynomial(x, y)), slopes


def test_arcs_lie_on_their_implicit_curves(five_bar):
    for curve in five_bar.loci().curves:
        for arc in curve.arcs:
            values, slopes = values_and_slopes(curve.implicit, arc)
            assert np.all(values <= 1e-9 * np.maximum(slopes, 1))


def test_zones_are_polygons(five_bar):
    zones = five_bar.zones()
    zone = zones[0]
    assert zone.area == max(z.area for z in zones)
    centre, radius = zone.inscribed_circle
    assert zone.contains(centre)
    for angle in np.linspace(0, 6, 20):
        assert zone.contains((centre[0] + 0.999 * radius * np.cos(angle), centre[1] + 0.999 * radius * np.sin(angle)))
    x, y = zone.polygon[:, 0], zone.polygon[:, 1]
    area = (x[:-1] @ y[1:] - x[1:] @ y[:-1]) / 2
    if not zone.holes:
        assert area == pytest.approx(zone.area, rel=1e-4)  # chords within the tolerance
    assert zones.modes[0].in_doubt == 0


def test_tasks_are_files_dictionaries_or_arrays(five_bar):
    from conftest import EXAMPLES

    from_file = five_bar.verify(EXAMPLES / "tasks" / "pick_and_place.yaml")
    assert from_file and from_file.margin > 0.139 and from_file.witness is None
    path = [[0, -0.7], [0, -0.675], [0.5, -0.675], [0.5, -0.7]]
    assert five_bar.verify({"path": path, "margin": 0.01}).margin == from_file.margin
    assert five_bar.verify(np.array(path))
    refuted = five_bar.verify({"box": {"x": [0.1, 0.9], "y": [-0.8, -0.6]}})
    assert not refuted and refuted.verdict == "refuted" and refuted.witness is not None


def test_fit_moves_a_task(five_bar):
    task = {"circle": {"centre": [0.5, -0.3], "radius": 0.05}}
    if not five_bar.verify(task):
        moved = five_bar.verify(task, fit="nearest")
        assert moved and moved.moved_by is not None


def test_answers_pickle_and_still_write_files(five_bar, tmp_path):
    for answer in (five_bar.loci(), five_bar.zones(), five_bar.verify({"box": {"x": [0.2, 0.3], "y": [-0.8, -0.7]}})):
        again = pickle.loads(pickle.dumps(answer))
        assert repr(again) == repr(answer)
        files = again.export(tmp_path / type(answer).__name__, {"svg"})
        assert len(files) == 2
        json.loads(again.json())
        assert again._repr_svg_().lstrip().startswith("<?xml")


def test_plots_go_into_given_axes(five_bar):
    plt = pytest.importorskip("matplotlib.pyplot")
    figure, axes = plt.subplots(1, 2)
    assert five_bar.loci().plot(ax=axes[0]) is axes[0]
    assert len(axes[0].lines) > 5
    assert five_bar.zones().plot(ax=axes[1]) is axes[1]
    plt.close(figure)


def test_plots_show_the_mechanism_and_keep_their_legend(five_bar):
    plt = pytest.importorskip("matplotlib.pyplot")
    for answer in (five_bar.loci(), five_bar.zones()):
        ax = answer.plot()
        ax.figure.canvas.draw()
        assert ax.get_xlabel() == "x (m)"
        assert "P" in [text.get_text() for text in ax.texts]  # the end effector
        assert sum(line.get_marker() == "o" for line in ax.lines) >= 5  # joints
        whole, legend = ax.figure.bbox, ax.get_legend().get_window_extent()
        assert whole.x0 <= legend.x0 and legend.x1 <= whole.x1 and whole.y0 <= legend.y0 and legend.y1 <= whole.y1
        plt.close(ax.figure)
    figure, ax = plt.subplots()
    five_bar.loci().plot(ax=ax)
    figure.canvas.draw()
    assert ax.get_legend().get_window_extent().x1 <= figure.bbox.x1
    plt.close(figure)


def test_plots_speak_in_the_units_of_the_file():
    import clearloci as cl
    from conftest import EXAMPLES

    plt = pytest.importorskip("matplotlib.pyplot")
    model = cl.read(EXAMPLES / "minitaur_leg.yaml")
    assert model.units == {"length": "mm", "angle": "deg", "force": "N"}
    ax = model.zones().plot()
    assert ax.get_xlabel() == "x (mm)" and 200 <= ax.get_xlim()[1] < 300  # with room for the motors above the box
    assert max(abs(line.get_xdata()).max() for line in ax.lines) > 100
    assert model.errors((8, 8), worst_case=False).plot("dalpha").get_xlim()[1] == pytest.approx(200, rel=0.2)
    plt.close("all")


def test_surfaces_are_triangles():
    import clearloci as cl
    from conftest import EXAMPLES

    loci = cl.read(EXAMPLES / "gough_stewart.yaml").loci(mesh_size=1 / 8)
    assert loci.surfaces and not loci.curves
    surface = loci.surfaces[0]
    assert surface.within_resolution and surface.certified == (not surface.open)
    assert surface.vertices.shape[1] == 3 and surface.triangles.max() < len(surface.vertices)


def test_free_efforts_are_chosen():
    import clearloci as cl
    from conftest import EXAMPLES

    model = cl.read(EXAMPLES / "studies" / "antagonistic.yaml")
    task = {"box": {"x": [-0.05, 0.15], "y": [0.45, 0.6]}}
    answer = model.verify(task)
    assert answer and answer.preload is not None
    assert answer.preload["value"]["B2"] == pytest.approx(-6.1, abs=0.1)
    assert answer.preload["ranges"][0]["above"].startswith("contact lost")
    given = model.verify({**task, "preload": {"B2": -20}})
    assert given and given.preload is None
    with pytest.raises(cl.InputError, match="the effort of joint B2 is free"):
        model.errors()
    assert any(curve.kind == "preload" for curve in model.loci().curves)
    assert model.with_parameters(preload_B2=-20).loci().curves


def test_carried_loci_lie_on_those_of_the_new_design(five_bar):
    longer = five_bar.with_parameters(L="0.51")
    traced = five_bar.loci()
    carried, proven = traced.carried_to(longer), longer.loci()
    assert not carried.complete and not any(curve.certified for curve in carried.curves)
    assert [curve.id for curve in carried.curves] == [curve.id for curve in traced.curves]
    implicit = {curve.id: curve.implicit for curve in proven.curves}
    for curve in carried.curves:
        assert curve.arcs
        for arc in curve.arcs:
            values, slopes = values_and_slopes(implicit[curve.id], arc)
            assert np.median(values / np.maximum(slopes, 1e-12)) <= 1e-9
    again = pickle.loads(pickle.dumps(carried))
    assert [len(curve.arcs) for curve in again.curves] == [len(curve.arcs) for curve in carried.curves]


def test_places_that_are_open_are_told():
    answer = cl.read(EXAMPLES / "three_rpr_legs.yaml").loci(mesh_size=0.25)
    assert not answer.complete and answer.open
    for region in answer.open:
        assert len(region.lower) == len(region.upper) == 3 and not region.point  # surfaces are open
