"""Figures of gears in mesh: true teeth, line of action, table; odd pairs draw too.

Tolerances
* teeth on their circles: the figures' own chord error, 2e-3 module at most; contact points: 1e-12 relative.
"""

import itertools
import math

import numpy as np
import pytest
from factory import design
from matplotlib.backends.backend_agg import FigureCanvasAgg
from sheets import odd_sheets, panel, placed_sheet, points, sheet, tagged, words

from gearlink.cli.options import Options
from gearlink.cli.views.figures.gears import Mesh, mesh_figure
from gearlink.cli.views.figures.write import write_plot
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.outline.mesh_geometry import MeshGeometry
from gearlink.core.parts.gears.outline.rack_profile import RackGeometry

DATA = {"kind": "gear-pair", "name": "pair", "module": 4.0, "teeth": [20, 31], "profile_shift": [0.3, 0.1]}


def labelled(axes, label):
    return [line for line in axes.lines if line.get_label() == label]


@pytest.mark.slow
@pytest.mark.parametrize("command", ["gear", "analyze"])
def test_whole_gears_have_their_teeth(command):
    made, figure = sheet(DATA, command)
    pair = made.gear_pair
    for gear, center in ((0, 0.0), (1, pair.center_distance)):
        (body,) = tagged(figure, f"body-{gear + 1}")
        radius = np.abs(points(body) - center)
        assert radius.max() == pytest.approx(pair.tip_radius[gear], rel=1e-9)
        assert radius.min() == pytest.approx(pair.root_radius[gear], abs=2e-3 * pair.module)
        outside = radius > pair.working_radius[gear]
        assert np.count_nonzero(np.diff(outside.astype(int)) == 1) == pair.teeth[gear]


LOADED = {"face_width": 25, "load": {"torque": 60}, "material": {"contact_limit": 1500, "bending_limit": 430}}


@pytest.mark.slow
@pytest.mark.parametrize("keys", [LOADED, {}], ids=["loaded", "plain"])
def test_no_cell_of_a_table_runs_into_another_or_out_of_it(keys):
    """Boxes of the texts as they are drawn: words, symbols, units and numbers of a row stand apart in their table."""
    figure = placed_sheet(DATA, "gear", **keys).figure
    for name in ("Values", "Gear table of the drawing"):
        axes = panel(figure, name)
        inside = axes.get_window_extent()
        found = [(text, text.get_window_extent()) for text in axes.texts if text.get_text()]
        assert len(found) > 60
        for text, box in found:
            assert inside.x0 - 1.0 < box.x0 < box.x1 < inside.x1 + 1.0, (name, text.get_text())
        for (one, box), (other, beside) in itertools.combinations(found, 2):
            if one.get_fontstyle() == other.get_fontstyle() == "italic":
                continue  # a letter and its index
            apart = box.x1 < beside.x0 or beside.x1 < box.x0 or box.y1 <= beside.y0 or beside.y1 <= box.y0
            assert apart, (name, one.get_text(), other.get_text())


def test_mesh_zone_shows_the_path_of_contact():
    made, figure = sheet(DATA, "gear")
    geometry, zone = MeshGeometry(made.gear_pair), figure.axes[1]
    (path,) = labelled(zone, "path of contact A–E")
    ends = np.asarray(path.get_xdata()) + 1j * np.asarray(path.get_ydata())
    assert ends == pytest.approx(np.array([geometry.contact_start, geometry.contact_end]), rel=1e-12)
    (points,) = labelled(zone, "contact points")
    assert len(points.get_xdata()) == len(geometry.contacts)
    low, high = zone.get_ylim()
    assert low < ends.imag.min() < ends.imag.max() < high


def test_table_gives_the_designs_values():
    made, figure = sheet(DATA, "gear")
    shown = words(figure)
    for name in ("center_distance", "working_pressure_angle", "contact_ratio"):
        assert f"{made.quantity(name).value:.6g}" in shown
    for name in ("tip_radius", "base_radius", "tooth_thickness", "specific_sliding"):
        for value in made.quantity(name).value:
            assert f"{value:.6g}".replace("-", "−") in shown


ODD = [
    {"teeth": [12, 12], "profile_shift": [0.0, 0.0]},  # undercut
    {"teeth": [30, 40], "addendum": 2.5, "profile_shift": [0.0, 0.0]},  # a pointed tool
    {"teeth": [1, 2]},
    {"teeth": [7, 900], "module": 1e6},
    {"teeth": [25, 10000], "module": 1e-6},
    {"teeth": [20, 20], "profile_shift": [2.5, 0.0]},  # pointed teeth
    {"teeth": [40, 40], "pressure_angle": 3.0, "profile_shift": [0.0, 0.0]},
    {"teeth": [40, 40], "pressure_angle": 44.0, "addendum": 0.3, "clearance": 0.0},
    {"teeth": [60, 18], "profile_shift": None, "center_distance": 158.0, "shift_split": 0.1},
]


@pytest.mark.slow
@pytest.mark.parametrize(("keys", "drawn"), odd_sheets(ODD))
def test_odd_pairs_draw(keys, drawn):
    drawn(DATA, "gear", **keys)


@pytest.mark.slow
def test_a_picture_is_written(tmp_path):
    write_plot("gear", design(DATA, command="gear"), Options(out=tmp_path))
    assert [path.name for path in tmp_path.iterdir()] == ["pair-gear.png"]


@pytest.mark.slow
def test_teeth_that_no_tool_cuts_are_said_to_be_none():
    figure = sheet(DATA, "gear", teeth=[30, 40], addendum=2.5, profile_shift=[0.0, 0.0]).figure
    assert "gear 1: the tool cannot cut these teeth" in words(figure)
    assert not tagged(figure, "body-1")


def test_two_meshes_stand_in_one_figure():
    pairs = [GearPair.from_shift(2.0, (20, 30)), GearPair.from_shift(2.0, (30, 25))]
    figure = mesh_figure("train", [Mesh(pairs[0], "first", ("1", "3")), Mesh(pairs[1], "second", ("3", "5"))])
    assert len(figure.axes) == 5
    assert "gear 3\nsecond" in words(figure)
    assert f"{math.degrees(pairs[1].working_pressure_angle):.6g}" in words(figure)


@pytest.mark.slow
def test_a_rack_stands_beside_its_gear_with_its_teeth_and_tables():
    made, figure = sheet("rack_drive", "gear")
    (rack,) = tagged(figure, "zone-2")
    geometry = RackGeometry(made.rack)
    (path,) = labelled(figure.axes[1], "path of contact A–E")
    ends = np.asarray(path.get_xdata()) + 1j * np.asarray(path.get_ydata())
    assert ends == pytest.approx(np.array([geometry.contact_start, geometry.contact_end]), rel=1e-12)
    assert points(rack).real.min() == pytest.approx(made.rack.center_distance - 3.0, rel=1e-12)
    shown = words(figure)
    for words_ in ("measure over balls, minimum", "axis to the datum line of the rack", "rack"):
        assert words_ in shown


@pytest.mark.slow
def test_safeties_stand_with_what_they_rest_on():
    load = {"face_width": 30, "load": {"torque": 100}, "material": {"contact_limit": 1400, "bending_limit": 400}}
    made, figure = sheet(DATA, "gear", **load)
    shown = words(figure)
    assert any("K_Hb 1" in text for text in shown)
    assert " ".join(filter(None, shown)).count("those of the file, else 1") == len(("contact", "root"))
    assert f"{made.quantity('safety_bending').value[0]:.6g}" in shown
    assert "thickness allowance, upper" not in shown
    assert "span measurement, nominal" in shown
    assert panel(figure, "Blocking contour").patches


@pytest.mark.slow
def test_sliding_without_bounds_leaves_its_panel_and_is_not_cut_off():
    """Beside the base circle of 12 teeth sliding grows beyond bounds: the curve stays true, the panel ends."""
    made, figure = sheet({**DATA, "teeth": [12, 80], "profile_shift": [0.32, 0.0]}, "gear")
    axes = next(each for each in figure.axes if "sliding" in each.get_ylabel())
    (line,) = labelled(axes, "sliding, gear 1")
    rho, drawn = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
    mate = made.gear_pair.center_distance * math.sin(made.gear_pair.working_pressure_angle) - rho
    assert drawn == pytest.approx(1.0 - mate / (80 / 12 * rho), rel=1e-9)
    assert drawn.min() < axes.get_ylim()[0]
    assert drawn.max() <= axes.get_ylim()[1]


@pytest.mark.slow
def test_words_of_a_table_keep_clear_of_rules_and_of_each_other() -> None:
    """The names of meshes in the head, and every line between its rules."""
    _, figure = placed_sheet("candy_feed", "gear")
    axes = figure.axes[-1]
    renderer = FigureCanvasAgg(figure).get_renderer()
    heads = [text.get_window_extent(renderer) for text in axes.texts if text.get_text().startswith("gear")]
    assert len(heads) == 4
    assert all(left.x1 < right.x0 for left, right in itertools.pairwise(heads))
    pitch = 72.0 * axes.get_window_extent(renderer).height / figure.dpi / abs(np.ptp(axes.get_ylim()))
    assert pitch > 1.3 * max(text.get_fontsize() for text in axes.texts)


@pytest.mark.slow
def test_the_nearest_limits_are_named_within_the_plot() -> None:
    """One lies near the left edge."""
    _, figure = placed_sheet("gear_pair", "gear")
    axes = next(each for each in figure.axes if each.get_title(loc="left") == "Blocking contour")
    plot, renderer = axes.get_window_extent(), FigureCanvasAgg(figure).get_renderer()
    boxes = [text.get_window_extent(renderer) for text in axes.texts]
    assert boxes
    assert all(plot.x0 <= box.x0 and box.x1 <= plot.x1 for box in boxes)


@pytest.mark.slow
def test_a_gear_that_is_a_dot_beside_its_mate_is_magnified():
    """Of 12 teeth against 300 nothing was to be seen but the pivot."""
    made, figure = sheet("gear_pair", "gear", teeth=[12, 300], load=None)
    (detail,) = figure.axes[0].child_axes
    low, high = detail.get_xlim()
    tip = made.gear_pair.tip_radius[0]
    assert low < -tip < tip < high < 3.0 * tip
    assert any(np.abs(points(patch)).max() == pytest.approx(tip, rel=1e-6) for patch in detail.patches)
    assert not sheet("gear_pair", "gear").figure.axes[0].child_axes
