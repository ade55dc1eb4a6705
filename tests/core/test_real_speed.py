"""Real speeds: velocities, accelerations and times of every kind that names the speed of its input.

Tolerance: 1e-13 relative, a handful of roundings in the factors 2 pi n/60 and its square. Slopes of table columns are
compared with central differences of 0.01 deg of input: 1e-6 of the largest value, their cut-off error.
"""

import math

import numpy as np
import pytest
from factory import design

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.kinds import KINDS

SPEED = 150.0
OMEGA = SPEED * 2.0 * math.pi / 60.0
CLOSE = {"rel": 1e-13}
# kind of motion: design, table, input angle, then (column, its rate, its order)
TABLES = [
    ("thesis_example_3_as_printed", "motion", "crank_angle", [("speed_ratio", "output_speed", 1),
                                                              ("acceleration_ratio", "output_acceleration", 2)]),
    ("two_gear_ring", "motion", "crank_angle", [("speed_ratio", "output_speed", 1),
                                                ("coupler_ratio", "coupler_speed", 1),
                                                ("acceleration_ratio", "output_acceleration", 2)]),
    ("wide_lever", "motion", "crank_angle", [("speed_ratio", "output_speed", 1),
                                             ("acceleration_ratio", "output_acceleration", 2)]),
    ("five_bar_path", "path", "input_angle", [("x_velocity", "point_x_velocity", 1),
                                              ("y_acceleration", "point_y_acceleration", 2)]),
    ("five_bar_positions", "function", "input_angle", [("speed_ratio", "output_speed", 1),
                                                       ("acceleration_ratio", "output_acceleration", 2)]),
    ("hypocycloid_slider", "motion", "carrier_angle", [("velocity", "slider_velocity", 1),
                                                       ("acceleration", "slider_acceleration", 2)]),
    ("mutilated_gear_press", "motion", "input_angle", [("driven_speed_ratio", "driven_speed", 1),
                                                       ("rocker_speed_ratio", "rocker_speed", 1)]),
    ("ty460_slider_crank", "motion", "input_angle", [("velocity", "slider_velocity", 1),
                                                     ("acceleration", "slider_acceleration", 2)]),
]  # fmt: skip


@pytest.mark.quick(1)
@pytest.mark.parametrize(("name", "table", "angle", "rates"), TABLES)
def test_tables_carry_time_and_real_speeds_where_the_input_speed_is_named(name, table, angle, rates):
    timed, plain = design(name, input_speed=SPEED).table(table, samples=24), design(name).table(table, samples=24)
    assert timed.columns == (*plain.columns, "time", *timed.columns[len(plain.columns) + 1 :])
    assert timed["time"] == pytest.approx(timed[angle] / 360.0 * 60_000.0 / SPEED, **CLOSE)
    for column, rate, order in rates:
        assert timed[rate] == pytest.approx(timed[column] * OMEGA**order, **CLOSE), rate
        unit = dict(zip(timed.columns, timed.units, strict=True))[rate]
        assert unit == ("mm" if "velocity" in column or column == "acceleration" or column[0] == "y" else "rad") + (
            "/s" if order == 1 else "/s^2"
        )


SLOPES = [
    ("five_bar_path", "path", "input_angle", [("x", "x_velocity", 1.0), ("y_velocity", "y_acceleration", 1.0)]),
    ("five_bar_path", "path", "input_angle", [("y", "y_velocity", 1.0), ("x_velocity", "x_acceleration", 1.0)]),
    ("five_bar_positions", "function", "input_angle", [("output_angle", "speed_ratio", math.radians(1.0)),
                                                       ("speed_ratio", "acceleration_ratio", 1.0)]),
    ("ty460_slider_crank", "motion", "input_angle", [("displacement", "velocity", 1.0),
                                                     ("velocity", "acceleration", 1.0)]),
]  # fmt: skip


@pytest.mark.quick(1)
@pytest.mark.parametrize(("name", "table", "angle", "pairs"), SLOPES)
def test_every_rate_is_the_slope_of_its_column(name, table, angle, pairs):
    found = design(name).table(table, samples=12_000)
    step = math.radians(found[angle][1] - found[angle][0])
    for column, rate, scale in pairs:
        slope = (found[column][2:] - found[column][:-2]) * scale / (2.0 * step)
        assert np.max(np.abs(slope - found[rate][1:-1])) <= 1e-6 * np.max(np.abs(found[rate]))


EXTREMES = [
    ("thesis_example_3_as_printed", "motion", ["speed_ratio", "acceleration_ratio"]),
    ("two_gear_ring", "motion", ["speed_ratio", "acceleration_ratio"]),
    ("wide_lever", "motion", ["speed_ratio", "acceleration_ratio"]),
    ("hypocycloid_slider", "motion", ["velocity", "acceleration"]),
    ("ty460_slider_crank", "motion", ["velocity", "acceleration"]),
]


@pytest.mark.quick(1)
@pytest.mark.parametrize(("name", "table", "columns"), EXTREMES)
def test_extremes_and_their_places_against_a_fine_table(name, table, columns):
    made = design(name)
    found = made.table(table, samples=36_000)
    angle = found[found.columns[0]]
    for column in columns:
        values, size = found[column], np.max(np.abs(found[column]))
        for end, pick in (("max", np.argmax), ("min", np.argmin)):
            best, place = values[pick(values)], made.quantity(f"{column}_{end}_at").value
            # a row 0.005 deg beside the extreme is off by the curvature times that squared
            assert made.quantity(f"{column}_{end}").value == pytest.approx(best, abs=1e-7 * size)
            at = np.argmin(np.abs((angle - place + 180.0) % 360.0 - 180.0))
            assert values[at] == pytest.approx(best, abs=1e-7 * size)


def test_the_closed_form_of_the_symmetric_family_agrees_with_the_roots():
    sized = design("candy_feed", command="synth dwell", gears__idler=72)
    found = design("candy_feed", gears__idler=72, dwell=None,
                   links={"crank": sized.crank_length, "frame": sized.frame_length})  # fmt: skip
    for name in ("acceleration_ratio_max", "acceleration_ratio_min", "speed_ratio_max", "speed_ratio_min"):
        assert sized.raw(name) == pytest.approx(found.raw(name), rel=1e-12)
        off = math.remainder(sized.raw(f"{name}_at") - found.raw(f"{name}_at"), 2.0 * math.pi)
        assert abs(off) < 1e-7  # where the slope is flat, rounding moves the place by its square root


@pytest.mark.parametrize("assembly", [1, -1])
def test_the_mirror_image_has_its_extremes_at_mirrored_places(assembly):
    sized = design("candy_feed", command="synth dwell", gears__idler=72, assembly=assembly)
    links = {"crank": sized.crank_length, "frame": sized.frame_length}
    found = design("candy_feed", gears__idler=72, dwell=None, links=links, assembly=assembly)
    for name in ("acceleration_ratio_max_at", "speed_ratio_min_at", "speed_ratio_max_at"):
        assert abs(math.remainder(sized.raw(name) - found.raw(name), 2.0 * math.pi)) < 1e-7


def test_times_and_speeds_as_quantities():
    made = design("thesis_example_3_as_printed", input_speed=SPEED)
    assert made.quantity("input_speed").value == SPEED
    assert made.quantity("turn_time").value == pytest.approx(400.0, **CLOSE)
    assert made.quantity("output_speed_max").value == pytest.approx(made.speed_ratio_max * OMEGA, **CLOSE)
    assert made.quantity("back_step_time").value == pytest.approx(
        made.quantity("back_step_crank_angle").value / 360.0 * 400.0, **CLOSE
    )


NAMES = ["input_speed", "turn_time", "output_speed_max", "output_acceleration_min", "back_step_time", "dwell_time"]


@pytest.mark.parametrize("name", NAMES)
def test_nothing_of_it_appears_without_an_input_speed(name):
    assert design("thesis_example_3_as_printed").quantity(name) is None


def test_every_kind_whose_input_turns_takes_an_input_speed():
    taken = {name for name, kind in KINDS.items() if "input_speed" in kind.spec_model().model_fields}
    other_key = {"flatbed-press", "swing-gripper", "wide-swing-cam", "disc-cam", "cylindrical-cam", "machine"}
    assert taken | other_key | {"gear-pair", "gear-train-mobility", "measured-cam", "motion-law"} == set(KINDS)


# The speed that a variable-speed drive asks for


def test_variable_speed_names_its_input_speed_and_refuses_another():
    made = design("thesis_example_2", command="synth variable-speed")
    assert made.input_speed == 200.0
    assert made.quantity("output_speed_max").value == pytest.approx(300.0 * 2.0 * math.pi / 60.0, rel=1e-12)
    assert design("thesis_example_2", command="synth variable-speed", input_speed=200).input_speed == 200.0
    with pytest.raises(ValueError, match=r"input_speed: 190 1/min .*200 1/min"):
        design("thesis_example_2", command="synth variable-speed", input_speed=190)


def test_variable_speed_of_unequal_gears_refuses_another_input_speed_too():
    keys = {"gears__output": 24, "speed__balanced": True, "speed__min": 150, "speed__max": 250}
    made = design("thesis_example_2", command="synth variable-speed", **keys)
    assert made.quantity("output_speed_max").value == pytest.approx(250.0 * 2.0 * math.pi / 60.0, rel=1e-12)
    with pytest.raises(NoSolution, match="input_speed: 999 1/min") as refused:
        design("thesis_example_2", command="synth variable-speed", input_speed=999, **keys).input_speed  # noqa: B018
    assert refused.value.key == "input_speed"


# What the output feeds


@pytest.mark.parametrize(("feed", "radius"), [
    ({"radius": 60.0}, 60.0),
    ({"radius": 60.0, "belt_thickness": 2.0}, 61.0),
    ({"radius": 60.0, "ratio": 0.5}, 30.0),
    ({"pitch": 12.7, "teeth": 19}, 19 * 12.7 / (2.0 * math.pi)),
])  # fmt: skip
@pytest.mark.parametrize("name", ["thesis_example_3_as_printed", "two_gear_ring"])
def test_roller_belt_and_chain(name, feed, radius):
    made = design(name, input_speed=SPEED, feed=feed)
    assert made.quantity("feed_radius").value == pytest.approx(radius, **CLOSE)
    assert made.feed_per_turn == pytest.approx(2.0 * math.pi * made.mean_ratio * radius, **CLOSE)
    assert made.feed_back_step == pytest.approx(made.back_step_angle * radius, **CLOSE)
    assert made.feed_velocity_max == pytest.approx(made.output_speed_max * radius, **CLOSE)
    assert made.feed_acceleration_min == pytest.approx(made.output_acceleration_min * radius, **CLOSE)
    found = made.table("motion", samples=7200)
    step = 1e-3 * (found["time"][1] - found["time"][0])
    slope = (found["feed_travel"][2:] - found["feed_travel"][:-2]) / (2.0 * step)
    assert np.max(np.abs(slope - found["feed_velocity"][1:-1])) < 1e-5 * np.max(found["feed_velocity"])


def test_a_chain_of_many_teeth_runs_evenly():
    ripple = [design("two_gear_ring", feed={"pitch": 12.7, "teeth": z}).chain_ripple for z in (6, 19, 1000)]
    assert ripple == pytest.approx([1.0 - math.cos(math.pi / z) for z in (6, 19, 1000)], rel=1e-10)
    assert design("two_gear_ring", feed={"radius": 10.0}).quantity("chain_ripple") is None


def test_travel_needs_no_speed_and_nothing_of_it_appears_without_a_feed():
    made = design("thesis_example_3_as_printed", feed={"radius": 60.0})
    assert made.table("motion", samples=4).columns[-1] == "feed_travel"
    assert made.quantity("feed_velocity_max") is None
    assert design("thesis_example_3_as_printed", input_speed=SPEED).quantity("feed_per_turn") is None


@pytest.mark.parametrize(("feed", "words"), [
    ({}, "give radius, or pitch and teeth"),
    ({"pitch": 12.7}, "give radius, or pitch and teeth"),
    ({"radius": 10.0, "teeth": 19}, "radius applies to a roller or a belt"),
    ({"pitch": 12.7, "teeth": 19, "belt_thickness": 1.0}, "a chain has no belt_thickness"),
])  # fmt: skip
def test_a_feed_is_one_of_three(feed, words):
    with pytest.raises(ValueError, match=words):
        design("two_gear_ring", feed=feed)
