"""The motion of every link: slopes, second ways and published numbers.

Tolerances: central differences of 0.05 deg of input are cut off at 3e-6 of the largest value; instant centres by the
intersection of lines agree with the speed ratio to 1e-9 of the frame where the lines cross at more than a degree;
published numbers to half a unit of their last digit.
"""

import cmath
import math
from itertools import pairwise

import numpy as np
import pytest
from factory import design

from gearlink.core.base.rows import Rows
from gearlink.core.parts.linkages.fourbar.position import solve

LINKS = [
    ("thesis_example_3_as_printed", ["coupler", "rocker", "idler", "output"]),
    ("two_gear_ring", ["coupler", "rocker", "output"]),
    ("two_gear_drag_link", ["coupler", "rocker", "output"]),
    ("wide_lever", ["coupler", "rocker", "output"]),
    ("crank_rocker_links", ["coupler", "rocker"]),
]
RATES = ["angle", "speed_ratio", "acceleration_ratio", "jerk_ratio"]


def slope_error(values, rate, step):
    """Largest difference of a column's slope from another column, over the largest value of that."""
    slope = (values[2:] - values[:-2]) / (2.0 * step)
    return np.max(np.abs(slope - rate[1:-1])) / np.max(np.abs(rate))


@pytest.mark.quick(2)
@pytest.mark.parametrize(("name", "members"), LINKS)
def test_every_link_moves_as_its_angle_says(name, members):
    found, step = design(name).table("links", samples=7200), math.radians(0.05)
    for member in members:
        columns = [found[f"{member}_{rate}"] for rate in RATES]
        columns[0] = np.radians(columns[0])
        for values, rate in pairwise(columns):
            assert slope_error(values, rate, step) < 2e-5, member


@pytest.mark.parametrize(
    ("name", "speed"), [("thesis_example_3_as_printed", "crank_angle"), ("wide_lever", "crank_angle")]
)
def test_the_output_of_the_links_is_that_of_the_motion(name, speed):
    links, motion = (design(name).table(table, samples=36) for table in ("links", "motion"))
    assert links[speed] == pytest.approx(motion[speed], rel=1e-12)
    for one, other in (("output_angle", "output_angle"), ("output_speed_ratio", "speed_ratio")):
        assert links[one] == pytest.approx(motion[other], rel=1e-11, abs=1e-10)


def test_the_idler_rolls_on_crank_gear_and_output_gear():
    made = design("thesis_example_3_as_printed")
    found, train = made.table("links", samples=36), made.train
    coupler, rocker, idler, output = (found[f"{name}_speed_ratio"] for name in ("coupler", "rocker", "idler", "output"))
    assert (idler - coupler) * train.idler == pytest.approx(-(1.0 - coupler) * train.crank, abs=1e-10)
    assert (output - rocker) * train.output == pytest.approx(-(idler - rocker) * train.idler, abs=1e-10)


def test_the_instant_centre_lies_where_the_line_of_the_poles_meets_the_frame():
    made = design("thesis_example_3_as_printed")
    found, links, module = made.table("links", samples=24), made.linkage, made.spec.gears.module
    for degrees, pole in zip(found["crank_angle"], found["pole_x"], strict=True):
        state = solve(links, math.radians(degrees))
        b = cmath.rect(links.crank, math.radians(degrees))
        f = b + cmath.rect(module * made.crank_teeth / 2.0, state.coupler_angle)
        e = links.frame + cmath.rect(module * made.output_teeth / 2.0, state.rocker_angle)
        if abs(cmath.phase(e - f) % math.pi) < 0.02:
            continue
        assert pole == pytest.approx(f.real - f.imag * (e - f).real / (e - f).imag, rel=1e-9)


@pytest.mark.parametrize("module", [2.0, 2e-4])
def test_where_both_gears_turn_at_one_speed_the_instant_centre_is_at_infinity(module):
    """The equal gears of the worked feed do at 0 and 180 deg, whatever their size; a little beside it the centre is far
    off, but known: AD/(W - 1) with W - 1 = 1.192973 times the angle, its first two derivatives being 1.192973 and 0."""
    made = design("standing_feed", command="synth dwell", gears__module=module)
    found = made.table("links", samples=8)
    assert found["crank_angle"][np.isnan(found["pole_x"])].tolist() == [0.0, 180.0]
    assert made.table("links", samples=8).rows()[0][-1] is None
    beside = made.table("links", samples=Rows.part(2_500_000, 0, 3))["pole_x"][1]
    assert beside == pytest.approx(made.frame_length / (1.192973 * math.radians(360.0 / 2.5e6)), rel=1e-5)


def test_steps_of_the_momentary_dwell_are_the_thesis_s_put_right():
    made = design({"kind": "three-gear-four-bar", "gears": {"module": 2.5, "crank": 20, "idler": 20, "output": 60},
                   "momentary": {"eccentricity": 18.0}}, command="synth momentary-dwell")  # fmt: skip
    assert made.quartic_k == pytest.approx(1.5625e11, rel=1e-12)
    assert made.quartic_l == pytest.approx(-7.525e10, rel=1e-12)
    assert made.quartic_m == pytest.approx(-2.0385225e9, rel=1e-12)
    x = math.cos(made.base_angle) ** 2
    assert made.quartic_k * x * x + made.quartic_l * x + made.quartic_m == pytest.approx(0.0, abs=1e-4)
    assert made.quantity("base_angle").value == pytest.approx(44.58076550020707, rel=1e-12)
    assert made.quantity("pole_angle").value == pytest.approx(77.13066294665992, rel=1e-12)
    parts = (13.797431469, 35.613086120, 53.419629180, 52.643548686)
    for name, value in zip(("segment_af", "segment_fe", "segment_eg", "segment_gd"), parts, strict=True):
        assert made.raw(name) == pytest.approx(value, abs=5e-10)
    along = made.segment_af + made.segment_fe + made.segment_eg
    assert math.hypot(along, made.segment_gd) == pytest.approx(made.frame_length, rel=1e-14)


# Press and gripper


@pytest.mark.slow
def test_chains_of_the_press_are_the_slopes_of_its_positions():
    press = design("ty460", command="press", cam=None)
    found, places = press.table("chains", samples=7200), press.table("positions", samples=7200)
    step = 1e-3 * (found["time"][1] - found["time"][0])
    for name in ("bed", "cylinder"):
        assert found[f"{name}_velocity"] == pytest.approx(places[f"{name}_velocity"], rel=1e-12, abs=1e-9)
        assert slope_error(found[f"{name}_velocity"], found[f"{name}_acceleration"], step) < 2e-5


@pytest.mark.slow
def test_the_bed_of_a_press_with_its_cam_is_that_of_its_positions():
    """Where the jerk jumps a difference over h misses the slope by a quarter of the jump times h: 7e-4 of its peak."""
    press = design("ty460", command="press")
    found, places = press.table("chains", samples=7200), press.table("positions", samples=7200)
    step = 1e-3 * (found["time"][1] - found["time"][0])
    assert found["bed_velocity"] == pytest.approx(places["compensated_velocity"], rel=1e-12, abs=1e-9)
    assert found["cylinder_velocity"] == pytest.approx(places["cylinder_velocity"], rel=1e-12, abs=1e-9)
    assert slope_error(places["compensated_displacement"], places["compensated_velocity"], step) < 2e-5
    assert slope_error(found["bed_velocity"], found["bed_acceleration"], step) < 7e-4


def test_links_of_the_press_close_its_chains():
    press = design("ty460", command="press")
    found, motion = press.table("chains", samples=12), press.motion
    angles = {name: np.radians(found[f"{name}_angle"]) for name in ("BC", "CD", "DE", "rod", "HM", "MN")}
    phi, bed = np.radians(found["input_angle"]), motion.bed
    b = bed.linkage.crank * np.exp(1j * (bed.initial_crank_angle + phi))
    c = bed.linkage.frame + bed.linkage.rocker * np.exp(1j * angles["CD"])
    assert b + bed.linkage.coupler * np.exp(1j * angles["BC"]) == pytest.approx(c, rel=1e-12)
    e = bed.linkage.frame + bed.slider_crank_length * np.exp(1j * angles["DE"])
    f = e - bed.rod * np.exp(1j * (math.pi / 2 - angles["rod"])) * np.array(1.0)
    assert (f.real - bed.linkage.frame) == pytest.approx(-bed.offset, rel=1e-12)
    cylinder = motion.cylinder
    h = cylinder.linkage.crank * np.exp(1j * (cylinder.initial_angle - phi))
    m = cylinder.linkage.frame + cylinder.linkage.rocker * np.exp(1j * angles["MN"])
    assert h + cylinder.linkage.coupler * np.exp(1j * angles["HM"]) == pytest.approx(m, rel=1e-12)


def test_tip_of_the_gripper():
    gripper = design("swing_gripper", command="gripper")
    found = gripper.table("tip", samples=7200)
    x, y, step = found["tip_x"], found["tip_y"], 1e-3 * (found["time"][1] - found["time"][0])
    place = x + 1j * y
    assert abs(place - complex(*gripper.spec.pivots.output)) == pytest.approx(gripper.spec.arm.length, rel=1e-12)
    speed = np.abs(place[2:] - place[:-2]) / (2.0 * step)
    assert np.max(np.abs(speed - found["tip_speed"][1:-1])) < 1e-5 * np.max(found["tip_speed"])
    at = round(gripper.spec.handover * 20)
    assert found["tip_speed"][at] == pytest.approx(gripper.quantity("handover_speed").value, rel=1e-12)
    motion = gripper.table("motion", samples=7200)
    jerk = np.gradient(motion["output_acceleration"], step)
    inside = np.abs(jerk - found["output_jerk"]) < 1e-3 * np.max(np.abs(jerk))
    assert inside.mean() > 0.99  # the jerk jumps at the joints of the law
