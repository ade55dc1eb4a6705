"""Figures of a three-gear four-bar: curves are the table's, the drawing is to scale, every kind of motion draws.

Tolerances
* joints and circles: 1e-12 relative; curves: equal to the table, being the same numbers.
* magnified dwell: 1e-9 deg, the rounding of output angles of some hundred degrees, ten times.
"""

import cmath
import itertools
import math
import re

import numpy as np
import pytest
import yaml
from factory import design
from matplotlib.colors import to_rgba
from sheets import curve, lines, odd_sheets, panel, placed_sheet, points, sheet, tagged, words
from sweeps import mostly_slow

from gearlink.cli.options import Options
from gearlink.cli.views.figures.drawing import style
from gearlink.cli.views.figures.three_gear_four_bar import dwell_position
from gearlink.cli.views.figures.write import write_plot
from gearlink.core.parts.linkages.fourbar.position import solve

MOMENTARY, STEADY = "synth momentary-dwell", "synth variable-speed"
PRINTED = "{gears: {module: 2.5, crank: 20, idler: 20, output: 60}, links: {crank: 18.0, frame: 121.4}}"
CASES = {
    "synth dwell": "{gears: {module: 2.0, crank: 40, idler: 72, output: 40}, dwell: {angle: 135.0}}",
    "synth back-step": "{gears: {module: 2.0, crank: 40, idler: 72, output: 40}, back_step: {crank_angle: 90.0}}",
    "synth variable-speed": "{gears: {module: 2.0, crank: 20, idler: 21, output: 20}, speed: {min: 100.0, max: 300.0}}",
    "synth momentary-dwell": "{gears: {module: 2.5, crank: 20, idler: 20, output: 60}, "
    "momentary: {eccentricity: 16.0}}",
    "analyze": PRINTED,
    "gear": PRINTED,
}
ODD = {
    "drag link": "{gears: {module: 2.0, crank: 20, idler: 30, output: 20}, links: {crank: 60.0, frame: 15.0}, "
    "shafts: {input_radius: 6.0, output_radius: 8.0}}",
    "mirrored, with tolerance": "{gears: {module: 2.0, crank: 40, idler: 72, output: 40}, assembly: -1, "
    "dwell_tolerance: 2.0, links: {crank: 38.9, frame: 153.55}, shafts: {input_radius: 10.0}}",
    "tiny": "{gears: {module: 2.0e-6, crank: 20, idler: 25, output: 40}, links: {crank: 5.0e-6, frame: 80.0e-6}}",
    "huge": "{gears: {module: 1000000.0, crank: 20, idler: 25, output: 40}, "
    "links: {crank: 2500000.0, frame: 40000000.0}}",
    "drag link with a collision": "{gears: {module: 2.0, crank: 10, idler: 60, output: 40}, "
    "links: {crank: 80.0, frame: 35.0}}",
    "dwell over the revolution's end": "{gears: {module: 2.5, crank: 20, idler: 20, output: 60}, assembly: -1, "
    "dwell_tolerance: 0.4, links: {crank: 18.0, frame: 121.4}}",
}


def data(text):
    return {"kind": "three-gear-four-bar", "name": "train", **yaml.safe_load(text)}


@pytest.mark.slow
@pytest.mark.parametrize("command", mostly_slow(list(CASES), 1))
def test_every_command_draws(command, tmp_path):
    path = write_plot(command, design(data(CASES[command]), command=command), Options(out=tmp_path))
    assert path.name == f"train-{command.replace(' ', '-')}.png"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.quick(1)
@pytest.mark.parametrize(("case", "drawn"), odd_sheets(ODD))
@pytest.mark.parametrize("command", ["analyze", pytest.param("gear", marks=pytest.mark.slow)])
def test_odd_designs_draw(case, command, drawn):
    drawn(data(ODD[case]), command)


@pytest.mark.parametrize("case", ["drag link", "mirrored, with tolerance"])
def test_curves_are_the_tables(case):
    made, figure = sheet(data(ODD[case]))
    table = made.table("motion")
    for name in ("output_angle", "speed_ratio", "acceleration_ratio"):
        x, y = curve(figure, name.replace("_", "-"))
        assert x[:-1].tolist() == list(table.data[0])
        assert y[:-1].tolist() == list(table.data[table.columns.index(name)])
        turned = 360.0 * made.mean_ratio if name == "output_angle" else 0.0
        assert (x[-1], y[-1]) == (360.0, y[0] + turned)
    x, y = curve(figure, "transmission-angle")  # of the motion itself, twice as often
    assert x[:-1:2].tolist() == list(table.data[0])
    assert y[::2] == pytest.approx(np.append(table["transmission_angle"], y[0]), rel=1e-12)


def test_mechanism_is_to_scale():
    made, figure = sheet(data(PRINTED))
    angle, _ = dwell_position(made)
    rocker = solve(made.linkage, angle).rocker_angle
    b, c = cmath.rect(18.0, angle), 121.4 + cmath.rect(made.rocker_length, rocker)
    assert abs(c - b) == pytest.approx(made.coupler_length, rel=1e-12)
    for gear, center, teeth in ((1, b, 20), (3, c, 20), (5, 121.4, 60)):
        (pitch,), (body,) = tagged(figure, f"pitch-{gear}"), tagged(figure, f"body-{gear}")
        assert complex(*pitch.center) == pytest.approx(center, rel=1e-12)
        assert pitch.radius == pytest.approx(1.25 * teeth, rel=1e-12)
        radius = np.abs(points(body) - center)
        assert radius.max() == pytest.approx(1.25 * (teeth + 2), rel=1e-12)
        assert np.count_nonzero(np.diff((radius > pitch.radius).astype(int)) == 1) == teeth
    circle = points(lines(panel(figure, "Mechanism"))["path of the crank pin B"])
    np.testing.assert_allclose(np.abs(circle), 18.0, rtol=1e-12)


@pytest.mark.slow
def test_letters_keep_off_the_links():
    axes = panel(placed_sheet(data(PRINTED)).figure, "Mechanism")
    chain = next(line for line in axes.lines if line.get_linewidth() > 2.0)
    joints = axes.transData.transform(chain.get_xydata()) @ np.array([1.0, 1j])
    for name, joint in zip("ABCD", joints, strict=True):
        (letter,) = [text for text in axes.texts if text.get_text() == name]
        away = complex(*letter.get_position())
        assert 11.5 * (1.0 - 1e-12) <= abs(away) < 16.0, "no nearer, and not moved far by other words"
        for other in joints[[abs(joints - joint).argsort()[1]]]:
            # Not over the nearest joint's link: at least 40 degrees beside it.
            assert abs(cmath.phase(away / (other - joint))) > math.radians(40.0)


def test_position_drawn_is_the_dwell():
    back = design(data(PRINTED))
    angle, words = dwell_position(back)
    assert back.back_step.start < angle < back.back_step.end
    assert words == "middle of the back-step"
    momentary, steady = (sheet(data(CASES[command]), command).design for command in (MOMENTARY, STEADY))
    assert dwell_position(momentary) == (momentary.dwell_crank_angles[0], "momentary dwell")
    assert dwell_position(steady)[0] == pytest.approx(1.5 * math.pi, abs=1e-7)


def test_collision_is_shown_where_there_is_one():
    (red,) = tagged(sheet(data(PRINTED)).figure, "collision")
    z = points(red)
    assert red.get_facecolor() == to_rgba(style.WRONG), "as all that fails"
    assert z.real.max() - z.real.min() == pytest.approx(1.6, abs=1e-3)
    assert np.abs(z - 18.0).max() < 27.5 * (1 + 1e-12)
    assert np.abs(z - 121.4).max() < 77.5 * (1 + 1e-12)
    assert not tagged(sheet(data(CASES[MOMENTARY]), MOMENTARY).figure, "collision")


def test_shafts_are_drawn_where_named():
    figure = sheet(data(ODD["drag link"])).figure
    assert [tagged(figure, f"shaft-{name}")[0].radius for name in ("input", "output")] == [6.0, 8.0]
    assert not tagged(sheet(data(PRINTED)).figure, "shaft-input")


def test_magnified_dwell_passes_its_marks():
    made, figure = sheet(data(CASES["synth dwell"]), "synth dwell")
    x, y = curve(figure, "magnified")
    start = math.degrees(made.back_step.start)
    at = np.interp([start, start + 135.0], x, y)
    assert np.abs(at).max() < 0.05
    assert y[(x > start) & (x < start + 135.0)].min() == pytest.approx(-math.degrees(made.back_step.angle), abs=1e-3)
    assert x[0] < start
    assert x[-1] > start + 135.0


def test_the_back_step_does_not_hide_the_dwell():
    made, figure = sheet(data(CASES["synth dwell"]), "synth dwell")
    for title in ("Output angle", "Dwell, magnified", "Speed ratio"):
        dwell, *_, step = panel(figure, title).patches
        wide, narrow = ((box.x0, box.x1) for box in (dwell.get_bbox(), step.get_bbox()))
        assert wide[1] - wide[0] == pytest.approx(135.0, rel=1e-12)
        assert narrow[1] - narrow[0] == pytest.approx(math.degrees(made.back_step.crank_angle), rel=1e-12)
        assert not step.get_fill() or step.get_facecolor()[3] == 0.0
        assert step.get_hatch()


def test_rounding_noise_is_zero_in_words():
    figure = sheet(data(CASES[MOMENTARY]), MOMENTARY).figure
    assert not [text for text in words(figure) if re.search(r"e[-−]1\d", text)]
    assert any(text.startswith("0 at ") for text in words(figure))


def test_steady_motion_has_no_magnified_dwell():
    assert not tagged(sheet(data(CASES[STEADY]), STEADY).figure, "magnified")


@pytest.mark.slow
def test_the_legend_of_a_collision_stands_clear_of_the_numbers():
    """The longest legend over the most numbers: boxes as they are drawn, rows a line apart, none below the panel."""
    given = {"module": 1.5, "crank": 40, "idler": 44, "output": 40}
    slip = {"gears": given, "links": {"crank": 23.6, "frame": 86.2}, "dwell_tolerance": 0.3, "input_speed": 133.0}
    figure = placed_sheet(
        {"kind": "three-gear-four-bar", "name": "slip", **slip, "shafts": {"input_radius": 8.0, "output_radius": 9.0}},
        "analyze",
    ).figure
    numbers = next(axes for axes in figure.axes if any(text.get_text() == "crank AB" for text in axes.texts))
    legend = numbers.get_legend()
    assert any("collide" in text.get_text() for text in legend.get_texts())
    rows = [text.get_window_extent() for text in numbers.texts if text.get_ha() == "left"]
    assert len(rows) >= 12
    assert max(row.y1 for row in rows) < legend.get_window_extent().y0
    assert min(row.y0 for row in rows) > numbers.get_window_extent().y0 - 5.0
    levels = sorted((row.y0, row.y1) for row in rows)
    assert all(one[1] < other[0] + 1.0 for one, other in itertools.pairwise(levels))
