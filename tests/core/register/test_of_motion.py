"""The register of every kind with a motion: gains against designs made anew, against the whole chain, and refusals."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest

from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.kinds import KINDS
from gearlink.core.base.spec_paths import changed, number_at
from gearlink.core.studies.register import MotionRegister
from gearlink.core.studies.study.faults import WrongStudy
from tests import factory

PLAY, RUNOUT, SIZE = {"clearance": [0.0, 0.02]}, {"eccentricity": 0.01}, {"plus_minus": 0.05}
LINKS = ("links.crank", "links.coupler", "links.rocker", "links.frame")
CASES: dict[str, tuple[str, ...]] = {
    "two_gear_drag_link": (*LINKS[1:], "centers.planet_sun", "pins.B", "pins.A_output", "gears.planet", "gears.sun"),
    "two_gear_ring": (*LINKS[1:], "centers.planet_ring", "pins.C", "gears.ring"),
    "wide_lever": ("links.coupler", "links.frame", "centers.coupler_output", "pins.C", "pins.D_output"),
    "slider_crank_tolerances": ("crank", "rod", "offset", "pins.D", "pins.F"),
    "crank_rocker_links": (*LINKS, "pins.A", "pins.B", "pins.C", "pins.D"),
    "geared_six_bar": ("links.coupler_2", "links.coupler_3", "links.output", "links.frame", "centers.input", "pins.A"),
    "hypocycloid_slider": ("centers.planet_ring", "pins.M", "pins.planet", "gears.planet"),
    "mutilated_gear_press": ("links.crank", "links.coupler", "links.rocker", "pins.C", "gears.driven"),
    "five_bar_path": (
        *("links.input", "links.coupler", "links.follower", "links.output", "centers.gears", "pins.C"),
        *("coupler_point.along", "coupler_point.across", "gears.input"),
    ),
    "five_bar_function": ("links.coupler", "links.follower", "links.output", "phase", "centers.gears", "pins.D"),
    "gear_pair": ("centers.gears", "pins.gear1", "gears.gear1", "gears.gear2"),
    "wide_swing_cycle": ("centers.cam", "cam.profile", "cam.roller_radius", "pins.roller", "pins.D"),
    "loaded_cycloidal": ("eccentricity", "pins.E1", "pins.A"),
    "cam_gear": ("lever.length", "centers.gears", "cam.profile", "pins.roller", "pins.B"),
    "cam_linkage": ("links.input", "links.coupler", "links.follower", "cam.profile", "pins.roller", "pins.C"),
    "linked_cams": ("cams.x.roller_radius", "cams.x.profile", "pins.O"),
    "geneva_drive": ("center_distance", "pins.D", "pins.A"),
    "lift_cam": ("cam.profile", "follower.roller_radius", "follower.offset", "pins.roller", "pins.O"),
    "planar_watt": (
        *("frame.D[0]", "frame.D[1]", "links.crank[2]", "links.coupler.E[0]", "links.coupler.E[1]", "pins.E"),
        *("links.rocker.F[1]", "links.arm[2]"),
    ),
    "planar_five_bar": (
        *("links.crank[2]", "links.coupler.C[0]", "links.coupler.C[1]", "links.coupler.M[1]", "links.follower[2]"),
        *("frame.E[0]", "frame.E[1]", "pins.C", "gears.mesh_14_output"),
    ),
    "planar_bed_chain": (
        *("links.gear2[2]", "links.CDE.E[0]", "links.CDE.E[1]", "links.EF[2]", "frame.D[0]"),
        *("slides.guide_carriage.through[0]", "slides.guide_carriage.direction", "pins.D"),
    ),
    "planar_quick_return": (
        *("links.crank[2]", "frame.C[0]", "frame.C[1]", "links.rod[2]", "links.lever.D[0]"),
        *(
            "slots.slot.through[1]",
            "slides.guide.through[0]",
            "slots.slot.direction",
            "slides.guide.direction",
            "pins.D",
        ),
    ),
    "planar_cam": ("cams.cam.phase", "slides.guide.direction", "slides.guide.angle", "links.rod[2]", "pins.R"),
}
REMADE = {
    "two_gear_drag_link": LINKS[1:],
    "two_gear_ring": LINKS[1:],
    "slider_crank_tolerances": ("crank", "rod", "offset"),
    "crank_rocker_links": LINKS,
    "geared_six_bar": ("links.coupler_2", "links.coupler_3", "links.output", "links.frame"),
    "planar_watt": CASES["planar_watt"][:5] + CASES["planar_watt"][6:],
    "planar_five_bar": CASES["planar_five_bar"][:5],
    "planar_bed_chain": CASES["planar_bed_chain"][:7],
    "planar_quick_return": CASES["planar_quick_return"][:9],
    "planar_cam": CASES["planar_cam"][:4],
    "five_bar_path": CASES["five_bar_path"][:4] + CASES["five_bar_path"][6:8],
}
"""Sizes that change nothing but themselves, so that a design may be made anew with another one."""
WITHOUT_MESH = (
    "slider_crank_tolerances",
    "crank_rocker_links",
    "wide_swing_cycle",
    "lift_cam",
    "geneva_drive",
    "cam_linkage",
    "linked_cams",
    "loaded_cycloidal",
    "planar_watt",
    "planar_quick_return",
    "planar_cam",
)
SLOW, FOLLOWED = (
    pytest.mark.slow,
    ("planar_watt", "planar_cam", "planar_five_bar", "planar_bed_chain", "planar_quick_return"),
)
DEAR = ("five_bar_function", "planar_bed_chain", "planar_watt")
RADIUS = ("wide_swing_cycle", "planar_watt")


@cache
def register(name: str, sources: tuple[str, ...] = (), **keys: Any) -> MotionRegister:
    entries = {key: _entry(key) for key in sources or CASES[name]}
    given = {"backlash": 0.03} if name not in WITHOUT_MESH else {}
    if name in RADIUS:
        given["radius"] = 200.0
    made = factory.design(name, command="register", tolerance={"sources": entries}, register=given | keys)
    assert isinstance(made, MotionRegister)
    return made


def _entry(key: str) -> dict[str, Any]:
    return PLAY if key.startswith("pins.") else RUNOUT if key.startswith("gears.") else SIZE


def some(made: MotionRegister, count: int = 11) -> Any:
    given = made.motion.input
    return np.linspace(given.start, given.end, count + 2)[1:-1] + 1e-3


@pytest.mark.quick(11)
@pytest.mark.parametrize("name", [pytest.param(name, marks=SLOW if name in DEAR else ()) for name in CASES])
def test_the_whole_chain_goes_as_the_gains_but_for_squares(name: str) -> None:
    made = register(name)
    phi = some(made)
    for sign in (1, -1):
        gains = {one.source: one.gain for one in made.contributions(phi, sign)}
        off = []
        for size in (1e-3, 1e-4):
            errors = {
                one.key: np.array([size * (1.0 if one.coordinates == 1 else np.exp(0.7j))]) for one in made.sources
            }
            linear = sum(np.real(gains[key] * error) for key, error in errors.items())
            off.append(np.abs(made.sampled_errors(phi, sign, errors)[:, 0] - linear).max())
        assert off[1] < 0.02 * off[0] + 1e-12, name


@pytest.mark.parametrize("name", [pytest.param(name, marks=SLOW if name in FOLLOWED else ()) for name in REMADE])
def test_gains_are_the_changes_of_designs_made_anew(name: str) -> None:
    made, step = register(name, REMADE[name]), 1e-4
    phi = some(made)
    for one in made.contributions(phi, 1):
        if one.source not in REMADE[name]:
            continue
        value = number_at(made.spec, one.source)
        others = [MotionRegister(changed(made.spec, [(one.source, value + way)])) for way in (step, -step)]
        places = [made.radius * other.course.rates(other.motion, phi, 0)[0] for other in others]
        found = (places[0] - places[1]) / (2.0 * step)
        # a design counts its output from its own start: the changes over the motion are compared
        assert found - found[0] == pytest.approx(one.gain - one.gain[0], abs=2e-8), one.source


def test_a_tilted_face_and_a_turned_cam_in_closed_form() -> None:
    """A face touches the cam ds/dphi beside the ram's point, and rests there as the ram sinks by the tilt; a cam that
    is ahead lifts by ds/dphi."""
    keys: dict[str, Any] = {"frame": {"O": [0, 0]}, "links": {"shaft": {"O": [0, 0]}, "ram": {"S": [0, 0]}}}
    lift = [{"to": 120, "lift": 20}, {"to": 180}, {"to": 300, "lift": 0}, {"to": 360}]
    keys["cams"] = {"cam": {"cam": "shaft", "follower": "ram", "point": "S", "face": 90.0, "motion": lift}}
    keys["slides"] = {"guide": {"link": "ram", "through": [0, 0], "direction": 90}}
    keys |= {"drive": {"link": "shaft"}, "start": {"guide": 80}, "outputs": ["guide"]}
    keys["tolerance"] = {"sources": {"cams.cam.face": SIZE, "cams.cam.phase": SIZE}}
    made = factory.design({"kind": "planar-mechanism", **keys}, command="register")
    phi = np.linspace(0.1, 6.2, 50)
    slope = made.course.rates(made.motion, phi, 1)[1] * math.radians(1.0)
    found = {one.source: one.gain for one in made.contributions(phi, 1)}
    assert found["cams.cam.face"] == pytest.approx(-slope, abs=1e-14)
    assert found["cams.cam.phase"] == pytest.approx(slope, abs=1e-14)


@pytest.mark.slow
def test_limits_of_angles_are_not_in_millimetres() -> None:
    """The limit of a direction, in degrees, stood below mm; its gain is per degree."""
    table = register("planar_quick_return", ("slots.slot.direction", "frame.C[0]")).table("budget")
    units = dict(zip(table["source"].tolist(), table["unit"].tolist(), strict=True))
    assert units == {"slots.slot.direction": "deg", "frame.C[0]": "mm"}
    assert dict(zip(table.columns, table.units, strict=True))["limit"] == "1"
    lengths = register("planar_quick_return", ("frame.C[0]",)).table("budget")
    assert "unit" not in lengths.columns
    assert dict(zip(lengths.columns, lengths.units, strict=True))["limit"] == "mm"


def test_an_output_that_is_a_pin_moves_on_its_link_and_with_the_chain() -> None:
    """The end of the arm: an error of its length moved the point along the arm alone, as if no other link followed."""
    made = factory.design(
        "planar_watt",
        command="register",
        tolerance={"sources": {"links.arm[2]": SIZE}},
        register={"output": "G", "direction": 30.0},
    )
    phi, step = some(made), 1e-4
    (one,) = made.contributions(phi, 1)
    value = number_at(made.spec, one.source)
    others = [MotionRegister(changed(made.spec, [(one.source, value + way)])) for way in (step, -step)]
    high, low = (other.course.rates(other.motion, phi, 0)[0] for other in others)
    assert one.gain == pytest.approx((high - low) / (2.0 * step), abs=2e-8)
    error = {one.source: np.array([1e-4])}
    assert made.sampled_errors(phi, 1, error)[:, 0] == pytest.approx(1e-4 * one.gain, abs=2e-9)


def test_a_point_at_the_place_of_a_pin_is_not_the_pin() -> None:
    """M lies where C does: its own error moves M alone, on its link, and the links behind C not at all."""
    phi = np.array([0.4, 1.7, 4.0])
    tolerance = {"sources": {"links.coupler.M[1]": SIZE}}
    made = factory.design("planar_five_bar", command="register", tolerance=tolerance)
    (gain,) = (one.gain for one in made.contributions(phi, 1) if one.source == "links.coupler.M[1]")
    turned = made.motion.make(phi, 0, 1).links["coupler"].turn.value
    assert gain == pytest.approx(-np.sin(turned), abs=1e-12)
    other = {"output": "C"}
    shown = factory.design(
        "planar_five_bar", command="register", tolerance=tolerance, register=other, outputs=["M", "C"]
    )
    with pytest.raises(NoSolution, match=r"links\.coupler\.M\[1\] is no source of the register"):
        _ = shown.contributions(phi, 1)


def test_a_gear_pair_in_closed_form() -> None:
    """Both runouts are transmitted along the line of action, once per revolution; the backlash is a lag."""
    made = register("gear_pair")
    pair, phi = made.design.gear_pair, some(made)
    found = {one.source: one.gain for one in made.contributions(phi, 1)}
    scale = made.radius / pair.base_radius[1]
    assert np.abs(found["gears.gear1"]) == pytest.approx(scale, rel=1e-12)
    assert np.abs(found["gears.gear2"]) == pytest.approx(scale, rel=1e-12)
    assert found["centers.gears"] == pytest.approx(-scale * math.sin(pair.working_pressure_angle), rel=1e-12)
    lag = made.radius / pair.working_radius[1]
    assert found["backlash of mesh_12"] == pytest.approx(-lag, rel=1e-12)
    assert made.dead_band == pytest.approx(0.03 * lag, rel=1e-12)


def test_a_slider_crank_in_closed_form() -> None:
    """d(x)/d(crank) and d(x)/d(rod) of an offset slider-crank at right angles."""
    made = register("slider_crank_tolerances", ("crank", "rod"))
    found = {one.source: one.gain[0] for one in made.contributions(np.array([0.0]), 1)}
    part = made.design.slider_crank
    lean = math.asin((part.crank_length + part.offset) / part.rod)
    assert found["rod"] == pytest.approx(1.0 / math.cos(lean), rel=1e-12)
    assert found["crank"] == pytest.approx(-math.tan(lean), rel=1e-12)


def test_torque_turns_where_the_output_is_fastest() -> None:
    made = register("two_gear_drag_link")
    design = made.design
    wanted = sorted(design.quantity(f"speed_ratio_{name}_at").value for name in ("max", "min"))
    assert np.degrees(sorted(made.flips)) == pytest.approx(wanted, abs=1e-6)


def test_torque_with_friction_and_load_turns_elsewhere() -> None:
    made = register("two_gear_drag_link", output_inertia=0.02, friction=0.5, load=-0.2)
    with pytest.raises(NoSolution, match="input_speed"):
        _ = made.flips
    spec = changed(made.spec, [("input_speed", 60.0)])
    for place in MotionRegister(spec).flips or ():
        near = MotionRegister(spec).output_torque(np.array([place - 1e-7, place + 1e-7]))
        assert near[0] * near[1] <= 0.0


def test_a_shaft_lags_under_the_torque() -> None:
    made = register("two_gear_drag_link", load=2.0, stiffness=1000.0)
    phi = some(made)
    found = {one.source: one for one in made.contributions(phi, 1)}["wind-up of the output shaft"]
    assert found.mean * found.gain == pytest.approx(np.full(phi.shape, -made.radius * 2.0 / 1000.0), rel=1e-12)


def test_what_a_machine_does_not_have_is_refused() -> None:
    with pytest.raises(WrongStudy, match="no centre distance 'sun'"):
        _ = register("two_gear_drag_link", ("centers.sun",)).sources
    with pytest.raises(NoSolution, match="no mesh lies on the way"):
        _ = register("slider_crank_tolerances", backlash=0.02).backlash
    with pytest.raises(NoSolution, match="this one slides"):
        _ = register("slider_crank_tolerances", radius=10.0).radius
    with pytest.raises(NoSolution, match="this one slides"):
        _ = register("slider_crank_tolerances", load=10.0).flips
    with pytest.raises(NoSolution, match="no position 'dwell' here"):
        _ = register("slider_crank_tolerances", at="dwell").input_angles
    made = factory.design("wide_swing_cycle", command="register", tolerance={"sources": {"cam.profile": SIZE}})
    with pytest.raises(MissingSection, match=r"give register\.radius"):
        _ = made.worst


def test_a_synthesis_is_completed_first() -> None:
    made = register("two_gear_standing", ("links.coupler", "links.frame"))
    assert made.spec.links.frame is not None
    assert max(made.band) > 0.0


@pytest.mark.parametrize("name", [kind for kind, record in KINDS.items() if "loads" in record.commands])
def test_every_kind_with_loads_has_a_register(name: str) -> None:
    assert "register" in KINDS[name].commands


@pytest.mark.slow
def test_tables_run_over_the_range_of_the_input() -> None:
    made = register("five_bar_function", ("links.coupler",))
    start, end = (math.degrees(angle) for angle in made.design.input_range)
    table = made.table_cycle()
    angles = table.data[table.columns.index("input_angle")]
    assert (min(angles), max(angles)) == pytest.approx((start, end), abs=1e-9)


@pytest.mark.slow
def test_a_point_counts_along_a_direction() -> None:
    phi = np.array([0.4, 1.7, 4.0])
    gains = [
        {one.source: one.gain for one in register("planar_five_bar", direction=angle).contributions(phi, 1)}
        for angle in (0.0, 90.0, 30.0)
    ]
    for source in gains[0]:
        if source.startswith("links"):  # which flank carries depends on what is looked at
            x, y, along = (each[source] for each in gains)
            assert along == pytest.approx(math.cos(math.pi / 6.0) * x + 0.5 * y, abs=1e-12), source


@pytest.mark.slow
def test_another_output_counts_where_the_file_says_so() -> None:
    made = register("planar_quick_return", output="lever", radius=100.0)
    assert made.course.unit == "rad"
    with pytest.raises(NoSolution, match="no output 'ram' here: it has guide, lever"):
        _ = register("planar_quick_return", output="ram").worst
    with pytest.raises(NoSolution, match="direction belongs to a point"):
        _ = register("planar_quick_return", direction=10.0).worst
    press = factory.design("ty460", command="register", register={"output": "bed"})
    with pytest.raises(NoSolution, match="output belongs to machines with several outputs"):
        _ = press.section


def test_a_slide_as_input_is_refused() -> None:
    data = {
        "kind": "planar-mechanism",
        "frame": {"A": [0, 0]},
        "links": {"crank": ["A", "B", 40], "rod": ["B", "C", 120], "ram": {"C": [0, 0]}},
        "slides": {"guide": {"link": "ram", "through": [0, 0], "direction": 0}},
        "drive": {"slide": "guide"},
        "start": {"guide": 120, "crank": 60, "rod": -20},
        "range": {"start": -10, "end": 10},
        "tolerance": {"sources": {"links.rod[2]": SIZE}},
    }
    made = factory.design(data, command="register")
    with pytest.raises(NoSolution, match="drive a link instead of a slide") as refused:
        _ = made.worst
    assert refused.value.key == "drive.slide"


def test_a_rocker_on_a_cam_in_closed_form() -> None:
    """At a dwell: profile, arm and centre distance by the triangle of cam axis, pivot and roller."""
    follower = {"type": "oscillating-roller", "roller_radius": 15, "arm": 100, "center_distance": 140}
    sources = ("cam.profile", "follower.arm", "follower.center_distance")
    data = {
        "kind": "disc-cam",
        "motion": [{"to": 100, "lift": 25}, {"to": 160}, {"to": 280, "lift": 0}, {"to": 360}],
        "follower": follower,
        "cam": {"prime_radius": 80},
        "tolerance": {"sources": dict.fromkeys(sources, SIZE)},
        "register": {"cam_error": 0.01},
    }
    made = factory.design(data, command="register")
    found = {one.source: one.gain[0] for one in made.contributions(np.radians([330.0]), 1)}
    across = math.acos((100.0**2 + 140.0**2 - 80.0**2) / (2.0 * 100.0 * 140.0))
    per_radius = 80.0 / (140.0 * math.sin(across))  # arm times d(angle)/d(prime radius)
    assert found["cam.profile"] == pytest.approx(per_radius, rel=1e-12)
    assert found["cam profile"] == pytest.approx(per_radius, rel=1e-12)
    arm = (100.0 - 140.0 * math.cos(across)) / 80.0
    distance = (140.0 - 100.0 * math.cos(across)) / 80.0
    assert found["follower.arm"] == pytest.approx(-per_radius * arm, rel=1e-12)
    assert found["follower.center_distance"] == pytest.approx(-per_radius * distance, rel=1e-12)


def test_a_cam_error_needs_a_cam() -> None:
    with pytest.raises(NoSolution, match="no cam lies on the way"):
        _ = register("slider_crank_tolerances", cam_error=0.01).worst


def test_far_dwell_of_a_wide_swing_is_the_roller_on_its_arc() -> None:
    from gearlink.core.machines.wide_swing.design import WideSwingDesign
    from gearlink.core.machines.wide_swing.spec import WideSwingSpec

    sources = {name: {"plus_minus": 0.01} for name in ("cam.profile", "centers.cam", "links.roller_arm")}
    data = {
        "kind": "wide-swing-cam",
        "layout": "twin-cam",
        "swing": 120.0,
        "cycle": {"working": 120.0, "far_dwell": 60.0, "return": 120.0, "near_dwell": 60.0},
        "speed": 100.0,
        "inertia": 0.5,
        "unloader": {"type": "pneumatic", "pivot_ratio": 2.6, "arm": 120.0, "reserve": 0.24},
        "cam": {"center_distance": 200.0, "roller_radius": 8.0},
        "output_radius": 300.0,
        "register": {"at": "dwell"},
        "tolerance": {"sources": sources},
    }
    spec = WideSwingSpec.model_validate(data)
    design: Any = MotionRegister(spec)
    found = {one.source: abs(float(one.gain[0])) for one in design.contributions(design.input_angles, 1)}
    a, r, half = 200.0, WideSwingDesign(spec).cam.rocker_radius, math.radians(60.0)
    # rho^2 = a^2 + r^2 - 2 a r cos phi, differentiated, at the output radius
    scale = 300.0 / (a * r * math.sin(half))
    rho = math.sqrt(a * a + r * r - 2.0 * a * r * math.cos(half))
    expected = {
        "cam.profile": scale * rho,
        "centers.cam": scale * (a - r * math.cos(half)),
        "links.roller_arm": scale * abs(r - a * math.cos(half)),
    }
    assert found == pytest.approx(expected, rel=1e-9)


def test_lever_of_a_cam_gear_in_its_groove() -> None:
    """A longer lever turns its roller along the wall: N . (dl + i l dX) e^(i (theta + X)) = 0, sun by the teeth."""
    made = register("cam_gear", ("lever.length",))
    design, phi = made.design, some(made)
    unit = np.exp(1j * (phi + np.asarray(design.lever(phi, 0, 1)[0])))
    rate = design.groove.path(phi).first
    normal = 1j * rate / np.abs(rate)
    turned = -np.real(normal.conj() * unit) / (design.spec.lever.length * np.real(normal.conj() * 1j * unit))
    gain = next(one.gain for one in made.contributions(phi, 1) if one.source == "lever.length")
    wanted = np.abs(turned) * design.spec.gears.planet / design.spec.gears.sun * design.gear_data.pair.working_radius[0]
    np.testing.assert_allclose(np.abs(gain).ravel(), wanted, rtol=1e-9)
    assert wanted.max() > 0.5
