"""Figures of a three-gear four-bar: curves are the table's, the drawing is to scale, every kind of motion draws.

Tolerances
* joints and circles: 1e-12 relative; curves: equal to the table, being the same numbers.
* magnified dwell: 1e-9 deg, the rounding of output angles of some hundred degrees, ten times.
"""

import math

import numpy as np
import pytest
import yaml

from gearlink.cli.figures.three_gear_mechanism import dwell_position, position
from gearlink.cli.figures.write import draw, write_plot
from gearlink.cli.options import Options
from gearlink.core.kinds import KINDS

KIND = KINDS["three-gear-four-bar"]
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
    "dwell over the turn's end": "{gears: {module: 2.5, crank: 20, idler: 20, output: 60}, assembly: -1, "
    "dwell_tolerance: 0.4, links: {crank: 18.0, frame: 121.4}}",
}


def design(command, text):
    data = {"kind": "three-gear-four-bar", "name": "train", **yaml.safe_load(text)}
    return KIND.design(command, KIND.spec_model().model_validate(data))


def curve(figure, gid):
    (found,) = [line for axes in figure.axes for line in axes.lines if line.get_gid() == gid]
    return np.asarray(found.get_xdata()), np.asarray(found.get_ydata())


def patches(figure, gid):
    return [patch for axes in figure.axes for patch in axes.patches if patch.get_gid() == gid]


@pytest.mark.parametrize("command", CASES)
def test_every_command_draws(command, tmp_path):
    path = write_plot(command, design(command, CASES[command]), Options(out=tmp_path))
    assert path.name == f"train-{command.replace(' ', '-')}.png"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("case", ODD)
@pytest.mark.parametrize("command", ["analyze", pytest.param("gear", marks=pytest.mark.slow)])
def test_odd_designs_draw(command, case, tmp_path):
    write_plot(command, design(command, ODD[case]), Options(out=tmp_path))


@pytest.mark.parametrize("case", ["drag link", "mirrored, with tolerance"])
def test_curves_are_the_tables(case):
    made = design("analyze", ODD[case])
    table = made.table("motion")
    figure = draw("analyze", made)
    for name in ("output_angle", "speed_ratio", "acceleration_ratio", "transmission_angle"):
        x, y = curve(figure, name.replace("_", "-"))
        assert x[:-1].tolist() == list(table.data[0])
        assert y[:-1].tolist() == list(table.data[table.columns.index(name)])
        turned = 360.0 * made.mean_ratio if name == "output_angle" else 0.0
        assert (x[-1], y[-1]) == (360.0, y[0] + turned)


def test_mechanism_is_to_scale():
    made = design("analyze", PRINTED)
    figure = draw("analyze", made)
    at = position(made.linkage, dwell_position(made)[0])
    assert abs(at.c - at.b) == pytest.approx(made.coupler_length, rel=1e-12)
    for gear, center, teeth in ((1, at.b, 20), (3, at.c, 20), (5, at.d, 60)):
        (pitch,), (tip,) = patches(figure, f"pitch-{gear}"), patches(figure, f"tip-{gear}")
        assert complex(*pitch.center) == pytest.approx(center, rel=1e-12)
        assert pitch.radius == pytest.approx(1.25 * teeth, rel=1e-12)
        assert tip.radius == pytest.approx(1.25 * (teeth + 2), rel=1e-12)
    (path,) = patches(figure, "crank-circle")
    assert path.radius == 18.0


def test_position_drawn_is_the_dwell():
    back = design("analyze", PRINTED)
    angle, words = dwell_position(back)
    assert back.back_step.start < angle < back.back_step.end
    assert words == "middle of the back-step"
    momentary = design("synth momentary-dwell", CASES["synth momentary-dwell"])
    assert dwell_position(momentary) == (momentary.dwell_crank_angles[0], "momentary dwell")
    steady = design("synth variable-speed", CASES["synth variable-speed"])
    assert dwell_position(steady)[0] == pytest.approx(1.5 * math.pi, abs=1e-7)


def test_collision_is_shown_where_there_is_one():
    assert len(patches(draw("analyze", design("analyze", PRINTED)), "collision")) == 1
    clear = design("synth momentary-dwell", CASES["synth momentary-dwell"])
    assert not patches(draw("synth momentary-dwell", clear), "collision")
    (red,) = patches(draw("analyze", design("analyze", PRINTED)), "collision")
    z = red.get_xy() @ np.array([1.0, 1j])
    assert z.real.max() - z.real.min() == pytest.approx(1.6, abs=1e-3)
    assert np.abs(z - 18.0).max() < 27.5 * (1 + 1e-12)
    assert np.abs(z - 121.4).max() < 77.5 * (1 + 1e-12)


def test_shafts_are_drawn_where_named():
    figure = draw("analyze", design("analyze", ODD["drag link"]))
    assert [patches(figure, f"shaft-{name}")[0].radius for name in ("input", "output")] == [6.0, 8.0]
    assert not patches(draw("analyze", design("analyze", PRINTED)), "shaft-input")


def test_magnified_dwell_passes_its_marks():
    made = design("synth dwell", CASES["synth dwell"])
    x, y = curve(draw("synth dwell", made), "magnified")
    start = math.degrees(made.back_step.start)
    at = np.interp([start, start + 135.0], x, y)
    assert np.abs(at).max() < 0.05
    assert y[(x > start) & (x < start + 135.0)].min() == pytest.approx(-math.degrees(made.back_step.angle), abs=1e-3)
    assert x[0] < start
    assert x[-1] > start + 135.0


def test_steady_motion_has_no_magnified_dwell():
    command = "synth variable-speed"
    figure = draw(command, design(command, CASES[command]))
    assert not [line for axes in figure.axes for line in axes.lines if line.get_gid() == "magnified"]
