"""The flatbed press as a design: positions by a second way, refusals, checks, laziness.

The report's numbers are cases of `gearlink verify`.

Tolerances
* contract: 1e-11 relative, as it states itself.
* positions against the oracle (cosine rule, 40 digits): 1e-12 of the peak of the column; transmission angles from the
  triangle's sides: 1e-11 deg.
"""

import json
import math
import re
from dataclasses import replace
from math import cos, degrees, radians
from pathlib import Path

import factory
import mpmath as mp
import numpy as np
import pytest
from oracles.press import PRESSES, TY460, Press
from pydantic import ValidationError

from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.machines.flatbed_press.design import FlatbedPress

ROOT = Path(__file__).parents[3]
CONTRACT = [
    case
    for name in ("press", "gear", "crank", "cam")
    for case in json.loads((ROOT / "tests" / "reference" / "contract" / f"{name}.json").read_text())
    if case["spec"]["kind"] == "flatbed-press"
]
GEARS = {"module": 4.0, "horizontal_distance": 290.0}
CAM = {"base_radius": 90.0, "roller_radius": 25.0, "transition_end": 125.0, "return_angle": 100.0}


pytestmark = pytest.mark.usefixtures("forty_digits")


def press(oracle: Press = TY460, **sections) -> FlatbedPress:
    given = {"sync": {"length": 420.0, "print_length": 320.0}} | sections
    return factory.design(oracle.spec(**given))


PARTS = {"motion", "cams"}


def computed(design) -> set[str]:
    """Names of the results that a design and its parts have worked out."""
    parts = [vars(design)[name] for name in PARTS & set(vars(design))]
    return {name for each in (design, *parts) for name in vars(each)} - {"spec", "kin", "advise"}


# Published


def test_working_radius_is_not_the_reference_radius():
    design = press(input_gears=GEARS)
    assert design.quantity("reference_radius").value == [144.0, 144.0]
    assert design.quantity("working_radius").value == pytest.approx([145.14561653732433] * 2, rel=1e-13)
    assert abs(design.quantity("working_radius").value[0] - 144.0) > 1.0
    assert design.gear_pair.teeth == (72, 72)
    assert design.quantity("tip_radius").value[0] == pytest.approx(149.102, abs=0.011)
    assert design.quantity("tip_thickness").value[0] == pytest.approx(3.10, abs=0.03)


@pytest.mark.parametrize("case", CONTRACT, ids=[case["id"] for case in CONTRACT])
def test_contract(case):
    design = factory.design(case["spec"])
    for name, wanted in case["quantities"].items():
        assert design.quantity(name).value == pytest.approx(wanted, rel=1e-11, abs=1e-12), name


# A second way


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", PRESSES)
def test_positions_against_the_cosine_rule(name):
    oracle = PRESSES[name]
    table = press(oracle).table("positions", samples=9)
    rows = np.array(table.rows())
    omega = mp.mpf(4500) / 3600 * 2 * mp.pi

    def fold(gamma):
        return min(mp.degrees(gamma), 180 - mp.degrees(gamma))

    def transmission(links, crank):
        a, b, c, d, _ = links
        reach = abs(a * mp.expj(crank) - d)
        return fold(mp.acos((b * b + c * c - reach * reach) / (2 * b * c)))

    exact = []
    for i in range(9):
        phi = 2 * mp.pi * i / 9
        exact.append(
            [
                mp.degrees(phi),
                mp.degrees(oracle.cam(phi)),
                oracle.p(phi),
                omega * mp.diff(oracle.p, phi),
                oracle.q(phi),
                omega * mp.diff(oracle.q, phi),
                transmission(oracle.bed, oracle.crank_start + phi),
                transmission(oracle.cylinder, mp.radians(oracle.initial_crank_angle) - phi),
            ]
        )
    exact = np.array([[float(value) for value in row] for row in exact])
    peak = np.abs(exact).max(axis=0)
    np.testing.assert_allclose(rows / peak, exact / peak, rtol=0.0, atol=1e-12)
    assert table.units == ("deg", "deg", "mm", "mm/s", "mm", "mm/s", "deg", "deg")


@pytest.mark.parametrize("name", PRESSES)
def test_least_transmission_angle_stands_with_the_crank_on_the_frame(name):
    oracle, design = PRESSES[name], press(PRESSES[name])
    for links, found in (
        (oracle.bed, design.min_transmission_angle_bed),
        (oracle.cylinder, design.min_transmission_angle_cylinder),
    ):
        a, b, c, d = (mp.mpf(x) for x in links[:4])
        gammas = [mp.acos((b * b + c * c - (a + s * d) ** 2) / (2 * b * c)) for s in (1, -1)]
        assert found == pytest.approx(float(min(min(g, mp.pi - g) for g in gammas)), abs=1e-14)


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", PRESSES)
def test_zone_quantities_against_the_oracle(name):
    oracle = PRESSES[name]
    length = 0.5 * oracle.stroke
    design = press(oracle, sync={"length": length})
    start = oracle.equal_speed
    end = oracle.end_of(start, length)
    for quantity, wanted in (
        ("sync_start", mp.degrees(start)),
        ("sync_end", mp.degrees(end)),
        ("cam_sync_start", mp.degrees(oracle.cam(start))),
        ("cam_sync_end", mp.degrees(oracle.cam(end))),
        ("compensation", oracle.gap(end) - oracle.gap(start)),
    ):
        assert design.quantity(quantity).value == pytest.approx(float(wanted), abs=1e-10), quantity
    assert design.zone_length == pytest.approx(length, rel=1e-13)


@pytest.mark.parametrize("k", [1e-3, 1e3])
def test_scale(k):
    small, large = press(), press(TY460.scaled(k), sync={"length": 420.0 * k, "print_length": 320.0 * k})
    for name in ("sync_start", "sync_end", "cam_sync_end", "min_transmission_angle_bed", "initial_crank_angle"):
        assert large.quantity(name).value == pytest.approx(small.quantity(name).value, abs=1e-10)
    for name in ("crank_length", "compensation"):
        assert large.quantity(name).value == pytest.approx(k * small.quantity(name).value, rel=1e-10)


# Input gears


@pytest.mark.parametrize(("module", "distance"), [(0.7, 286.3), (0.3, 290.1), (0.1, 0.7), (0.9, 290.7), (4.0, 288.0)])
def test_centre_distance_of_whole_teeth_keeps_them_all(module, distance):
    # with the offset equal to the frame DA both axes stand at one height
    level = replace(TY460, offset=37.0)
    design = press(level, input_gears={"module": module, "horizontal_distance": distance})
    assert design.gear_pair.teeth[0] == round(distance / module)
    assert design.quantity("shift_sum").value == pytest.approx(0.0, abs=1e-9)


def test_module_that_leaves_no_tooth():
    with pytest.raises(NoSolution, match=r"module 300 mm.*290\.3 mm") as refusal:
        _ = press(input_gears={"module": 300.0, "horizontal_distance": 290.0}).gear_pair
    assert refusal.value.key == "input_gears.module"


@pytest.mark.parametrize(("module", "pressure_angle", "code"), [(32.0, 20.0, "GL201"), (4.0, 44.0, "GL202")])
def test_input_gears_beyond_undercut_or_pointed_tips_fail(module, pressure_angle, code):
    gears = {"module": module, "horizontal_distance": 290.0, "pressure_angle": pressure_angle}
    found = [check for name in ("undercut", "tip-thickness") for check in press(input_gears=gears).check(name)]
    assert {check.code for check in found if check.status == "fail"} == {code}


DRAWN = {
    "profile_shift": [0.35, 0.2],
    "face_width": [42.0, 40.0],
    "tool": {"rounding": 0.3},
    "allowances": {"series": "25cd"},
    "center_distance_allowance": "js7",
    "pin_diameter": 7.0,
    "load": {"torque": 200.0},
    "material": {"contact_limit": 1200.0, "bending_limit": 400.0},
}


@pytest.mark.parametrize("helix", [0.0, 12.0])
def test_input_gears_have_the_drawing_of_a_gear_pair_at_their_centre_distance(helix):
    inside = press(input_gears=GEARS | DRAWN | {"helix_angle": helix})
    pair = inside.gear_pair
    teeth, distance = list(pair.teeth), pair.center_distance
    alone = factory.design({"kind": "gear-pair", "module": 4.0, "teeth": teeth, "center_distance": distance,
                  "helix_angle": helix, **DRAWN})  # fmt: skip
    assert teeth[0] == int(distance * cos(radians(helix)) / 4.0)
    first, *others = inside.report("gear").quantities
    assert (first.name, first.value) == ("input_gear_teeth", teeth[0])
    assert others == list(alone.report("gear").quantities)
    assert inside.table("drawing") == alone.table("drawing")
    words = [(check.code, check.status, check.value) for check in inside.report("gear").checks]
    assert words == [(check.code, check.status, check.value) for check in alone.report("gear").checks]


def test_press_shows_nothing_of_its_gears():
    design = press(input_gears=GEARS | DRAWN)
    design.report("press")
    assert not computed(design) & {"gear_pair", "gear_data"}


# Refusals


def test_stroke_that_the_rod_cannot_make():
    # the slider makes half the bed's 2000 mm; the largest stroke of rod 520 and offset 50 is 988.74 mm
    with pytest.raises(NoSolution, match=r"988\.7") as refusal:
        _ = press(replace(TY460, stroke=2000.0)).crank_length
    assert refusal.value.key == "bed.stroke"


@pytest.mark.parametrize("chain", ["bed", "cylinder"])
def test_chain_that_is_no_drag_link(chain):
    links = {"bed": {"bed": (30.0, 100.0, 100.0, 116.0, 1)}, "cylinder": {"cylinder": (30.0, 100.0, 95.0, 100.0, -1)}}
    with pytest.raises(NoSolution, match="crank-rocker") as refusal:
        press(replace(TY460, **links[chain])).quantity("sync_start")
    assert refusal.value.key == f"{chain}.double_crank"


def test_no_equal_speed_and_the_shift_that_helps():
    large = replace(TY460, radius=170.0)
    with pytest.raises(NoSolution, match="no synchronous zone") as refusal:
        press(large).report("press")
    assert refusal.value.key == "cylinder.initial_crank_angle"
    angle = float(re.search(r"initial_crank_angle to ([\d.]+) deg", str(refusal.value))[1])
    assert press(replace(large, initial_crank_angle=angle)).report("press").checks


@pytest.mark.slow
def test_no_equal_speed_at_any_angle_and_the_sizes_that_help():
    short = replace(TY460, stroke=62.0)
    with pytest.raises(
        NoSolution, match=r"the bed \(max\. 20\.73 mm/rad\) never reaches the cylinder speed"
    ) as refusal:
        press(short).report("press")
    assert refusal.value.key == "bed.stroke"
    stroke = float(re.search(r"bed.stroke to at least ([\d.]+) mm", str(refusal.value))[1])
    for size, value, beyond in (("stroke", stroke, -1e-3),):
        assert press(replace(short, **{size: value})).sync_start > 0.0
        with pytest.raises(NoSolution, match="no synchronous zone"):
            _ = press(replace(short, **{size: value * (1.0 + beyond)})).sync_start


def given_crank(oracle: Press = TY460, crank: float | None = None, **sections) -> FlatbedPress:
    """The press with its crank DE instead of its stroke."""
    made = press(oracle, **sections)
    bed = made.spec.bed.model_dump(exclude_unset=True)
    del bed["stroke"]
    bed["crank"] = float(oracle.crank) if crank is None else crank
    return factory.design(oracle.spec(**{"sync": {"length": 420.0, "print_length": 320.0}} | sections) | {"bed": bed})


@pytest.mark.parametrize("name", sorted(PRESSES))
def test_crank_instead_of_stroke_is_the_same_press(name):
    """The oracle's crank of 40 digits, rounded once: each quantity to 1e-12 where it is well conditioned."""
    by_stroke, by_crank = press(PRESSES[name]), given_crank(PRESSES[name])
    assert by_crank.quantity("bed_stroke").value == pytest.approx(PRESSES[name].stroke, rel=1e-12)
    assert by_stroke.quantity("bed_stroke") is None or by_stroke.quantity("bed_stroke").value is None
    for name in ("sync_start", "sync_end", "compensation", "quick_return_ratio", "cam_sync_end"):
        assert by_crank.quantity(name).value == pytest.approx(by_stroke.quantity(name).value, rel=1e-11), name


def test_crank_too_small_for_a_zone_says_which_crank_helps():
    with pytest.raises(NoSolution, match="no synchronous zone") as refusal:
        given_crank(crank=15.0).report("press")
    assert refusal.value.key == "bed.crank"
    least = float(re.search(r"bed.crank to at least ([\d.]+) mm", str(refusal.value))[1])
    assert given_crank(crank=least).sync_start > 0.0
    with pytest.raises(NoSolution, match="no synchronous zone"):
        _ = given_crank(crank=0.999 * least).sync_start


@pytest.mark.parametrize(("sizes", "words"), [({"crank": 154.0}, "exclude each other"), ({"stroke": None}, "or crank")])
def test_press_has_one_size(sizes, words):
    bed = TY460.spec()["bed"] | sizes
    with pytest.raises(ValidationError, match=words):
        factory.design(TY460.spec() | {"bed": bed})


@pytest.mark.parametrize("end", [20.0, 34.0])
def test_zone_that_ends_before_it_starts(end):
    design = press(sync={"start": 34.0, "end": end})
    with pytest.raises(
        NoSolution, match=rf"input angle {end:g} deg .limit > 34 deg, its start.; set sync\.end above 34 deg"
    ) as refusal:
        _ = design.sync_end
    assert refusal.value.key == "sync.end"


def test_zone_longer_than_the_cylinders_circumference():
    with pytest.raises(NoSolution) as refusal:
        _ = press(sync={"length": 1000.0}).sync_end
    assert refusal.value.key == "sync.length"


@pytest.mark.parametrize(("command", "key"), [("cam", "cam"), ("gear", "input_gears")])
def test_commands_without_their_section(command, key):
    with pytest.raises(MissingSection) as refusal:
        press().report(command)
    assert (refusal.value.key, refusal.value.code) == (key, "GL113")


@pytest.mark.parametrize("return_law", ["half-cycloidal", "velocity-345", {"quintic": 0.5}])
def test_return_wants_a_law_from_rest_to_rest(return_law):
    with pytest.raises(NoSolution, match="a law from rest to rest") as refusal:
        _ = press(cam=CAM | {"return_law": return_law}).follower
    assert refusal.value.key == "cam.return_law"


def test_unknown_return_law_names_the_nearest():
    with pytest.raises(NoSolution, match="cycloidal") as refusal:
        _ = press(cam=CAM | {"return_law": "cyclodial"}).follower
    assert refusal.value.key == "cam.return_law"


# Checks


@pytest.mark.parametrize(
    ("ratio", "status", "repaired"), [(1.0, "pass", 0), (2.0, "pass", 0), (0.5, "fail", 1), (1.4, "fail", 1)]
)
def test_register(ratio, status, repaired):
    (check, *again) = press(replace(TY460, gear_ratio=ratio, radius=140.0 / ratio)).check("register")
    assert [each.status for each in again] == ["warn"] * (ratio == 2.0), "the zone comes round while the bed returns"
    assert (check.code, check.status) == ("GL506", status)
    if status == "fail":
        assert "revolutions of the cylinder" in check.message
        assert press(replace(TY460, gear_ratio=float(repaired))).check("register")[0].status == "pass"


@pytest.mark.parametrize(("start", "status"), [(None, "pass"), (34.0, "pass"), (40.0, "fail")])
def test_speeds_at_the_start_of_the_zone(start, status):
    check, gathered = press(sync={"start": start, "end": 150.0}).check("sync-speed")
    assert (check.code, check.status) == ("GL501", status)
    assert (gathered.code, gathered.status, gathered.unit) == ("GL501", "warn", "mm")
    phi = mp.radians(start) if start else TY460.equal_speed
    share = abs(mp.diff(TY460.gap, phi) / mp.diff(TY460.q, phi))
    assert check.value == pytest.approx(float(share), abs=1e-13)
    assert ("remove sync.start" in (check.fix or "")) == (status == "fail")


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", PRESSES)
def test_without_a_cam_what_the_travels_gather_over_the_zone_is_warned_of(name):
    oracle, length = PRESSES[name], 0.3 * PRESSES[name].stroke
    found = press(oracle, sync={"length": length}).check("sync-speed")
    ahead = oracle.gap(oracle.end_of(oracle.equal_speed, length)) - oracle.gap(oracle.equal_speed)
    assert [check.status for check in found] == ["pass", "warn"]
    assert found[1].value == pytest.approx(float(abs(ahead)), abs=1e-11)
    side = "ahead of" if ahead > 0 else "behind"
    assert (
        f"travel of the bed {side} the cylinder at the end of the zone, without a compensation cam" in found[1].message
    )
    (alone,) = press(oracle, sync={"length": length}, cam=CAM).check("sync-speed")
    assert alone == found[0]


@pytest.mark.parametrize(("print_length", "status"), [(0.0, "pass"), (320.0, "pass"), (420.0, "pass"), (420.1, "fail")])
def test_zone_against_the_print(print_length, status):
    (check,) = press(sync={"length": 420.0, "print_length": print_length}).check("sync-length")
    assert (check.code, check.status, check.unit) == ("GL502", status, "mm")
    assert check.value == 420.0


@pytest.mark.parametrize(
    ("limit", "statuses"),
    [(30.0, ["pass", "pass"]), (31.0, ["pass", "warn"]), (36.0, ["pass", "fail"]), (47.0, ["fail", "fail"])],
)
def test_transmission_angles_of_both_chains(limit, statuses):
    *found, rod = press(limits={"transmission_angle": limit}).check("transmission-angle")
    assert "rod EF" in rod.message
    assert [check.status for check in found] == statuses
    assert [check.value for check in found] == pytest.approx([46.531948123073, 35.723697488383266], rel=1e-13)
    assert "minimum transmission angle of the bed drive" in found[0].message or statuses[0] == "pass"
    assert "minimum transmission angle of the cylinder drive" in found[1].message or statuses[1] == "pass"


@pytest.mark.parametrize(("rod", "status"), [(520.0, "pass"), (235.0, "warn"), (225.0, "fail"), (206.0, "fail")])
def test_a_short_rod_pushes_its_slider_aside(rod: float, status: str) -> None:
    """Second way: the slider on its line by Pythagoras, the rod's direction from both its ends, 36000 places."""
    made = factory.design("ty460", bed__rod=rod)
    check = made.check("transmission-angle")[2]
    crank, offset = made.motion.slider_crank.crank_length, made.spec.bed.offset
    pin = crank * np.exp(1j * np.linspace(0.0, 2.0 * math.pi, 36001))
    slider = pin.real + np.sqrt(rod**2 - (pin.imag + offset) ** 2) - 1j * offset
    lean = np.abs(np.angle(slider - pin)).max()
    assert check.value == pytest.approx(90.0 - math.degrees(lean), abs=1e-6)
    assert check.status == status


def test_remedy_of_a_short_rod_holds() -> None:
    made = factory.design("ty460", bed__rod=225.0, cam__base_radius=250.0)
    (check,) = (check for check in made.report("press").checks if check.status == "fail")
    ((path, value),) = check.remedy
    repaired = factory.design("ty460", bed__rod=value, cam__base_radius=250.0)
    assert path == "bed.rod"
    assert {each.status for each in repaired.check("transmission-angle")} == {"pass"}


@pytest.mark.parametrize(
    ("radius", "statuses"), [(67.0, ["pass"]), (66.04, ["pass", "fail"]), (65.0, ["pass", "fail"])]
)
def test_a_print_longer_than_the_cylinder_is_round_falls_on_itself(radius: float, statuses: list[str]) -> None:
    cylinder = {"cylinder__radius": radius, "cylinder__gear_ratio": 2.0}
    found = factory.design("ty460", **cylinder, sync__print_length=415.0).check("sync-length")
    assert [check.status for check in found] == statuses
    assert [check.code for check in found] == ["GL502"] * len(found)


@pytest.mark.quick(6)
@pytest.mark.parametrize("start", [None, 20.0, 100.0, 350.0])
@pytest.mark.parametrize("length", [300.0, 420.0, 540.0, 569.0, 570.0, 700.0])
def test_a_zone_in_which_the_bed_turns_back_fails(length: float, start: float | None) -> None:
    """Second way: the sign of the bed's velocity at 20000 places of the zone."""
    made = factory.design("ty460", cam=None, sync={"length": length} | ({} if start is None else {"start": start}))
    zone = np.linspace(made.motion.sync_start, made.motion.sync_end, 20001)[1:-1]
    turns = np.any(np.diff(np.sign(made.bed.travel(zone, 1).first)) != 0)
    assert [check.status for check in made.check("sync-length")] == (["pass", "fail"] if turns else ["pass"])
    if turns:
        place = zone[np.argmax(np.diff(np.sign(made.bed.travel(zone, 1).first)) != 0)]
        assert made.check("sync-length")[1].value == pytest.approx(math.degrees(place), abs=0.05)


# Nothing but what is asked for


def test_crank_length_touches_nothing_else():
    design = press(input_gears=GEARS, cam=CAM)
    design.quantity("crank_length")
    assert computed(design) == {"motion", "slider_crank"}


def test_start_position_and_bed_touch_nothing_of_the_cylinder():
    design = press(input_gears=GEARS, cam=CAM)
    design.quantity("initial_crank_angle")
    design.quantity("min_transmission_angle_bed")
    assert not computed(design) & {"cylinder", "sync_start", "gear_pair", "follower"}


def test_gears_touch_no_chain():
    design = press(input_gears=GEARS, cam=CAM)
    design.report("gear")
    assert computed(design) == {"gear_pair", "gear_data", "teeth"}


def test_cam_never_sizes_gears_nor_press_the_cam():
    design = press(input_gears=GEARS, cam=CAM)
    design.require("cam")
    assert all(design.check(name) for name in ("pressure-angle", "cam-undercut", "velocity-step"))
    assert "gear_pair" not in computed(design)
    assert "discs" in computed(design)
    design = press(input_gears=GEARS)
    design.report("press")
    assert not computed(design) & {"gear_pair", "cams"}


def test_stroke_of_the_follower_draws_no_cam():
    design = press(cam=CAM)
    design.quantity("follower_stroke")
    assert "follower" in computed(design)
    assert not computed(design) & {"discs", "base_radius"}


def test_impossible_cylinder_does_not_stand_in_the_way_of_the_crank():
    design = press(replace(TY460, cylinder=(30.0, 100.0, 95.0, 100.0, -1)))
    assert design.quantity("crank_length").value == pytest.approx(154.21159203908383, rel=1e-14)


def test_analyze_shows_the_cams_where_the_file_has_them():
    bare, full = press(), press(cam=CAM)
    assert "max_pressure_angle" not in bare.outline("analyze").quantities
    assert "max_pressure_angle" in full.outline("analyze").quantities
    names = [table.name for table in full.report("analyze").tables]
    assert names == ["positions", "follower", "main_cam", "return_cam"]
    codes = [check.name for check in full.report("analyze").checks]
    assert codes.count("sync-length") == 1


# Whether a cam can bear the motion


@pytest.mark.quick(1)
@pytest.mark.parametrize(("stroke", "status"), [(620.0, "pass"), (800.0, "fail")])
def test_a_stroke_that_no_cam_can_bear_fails_without_the_cam_s_own_command(stroke, status):
    design = press(replace(TY460, stroke=stroke), cam=CAM)
    report = design.report("press")
    found = [check for check in report.checks if check.name == "pressure-angle"]
    assert [check.status for check in found] == [status, status]
    for check, plain in zip(found, design.check("pressure-angle"), strict=True):
        assert check.message.startswith(plain.message)
        assert bool(check.remedy) == (status == "fail")
    assert report.ok == (status == "pass")
    assert [table.name for table in report.tables] == ["positions"]


@pytest.mark.slow
@pytest.mark.parametrize("command", ["press", "analyze"])
@pytest.mark.parametrize(
    ("cam", "words"),
    [
        ({"transition_end": 100.0}, "the transition ends at cam angle 100 deg, the synchronous zone at 116.5"),
        ({"return_angle": 290.0}, "after the next sheet begins"),
        ({"return_law": "half-cycloidal"}, "a law from rest to rest"),
    ],
)
def test_chains_and_zone_are_shown_though_the_cam_is_impossible(command, cam, words):
    design = press(cam=CAM | cam)
    report = design.report(command)
    assert {q.name for q in report.quantities} >= {"sync_start", "compensation"}
    assert "max_pressure_angle" not in {q.name for q in report.quantities}
    (failed,) = [check for check in report.checks if check.status == "fail"]
    assert (failed.code, failed.name, failed.value) == ("GL401", "pressure-angle", None)
    assert words in failed.message
    with pytest.raises(NoSolution):
        design.report("cam")


@pytest.mark.parametrize("command", ["press", "analyze", "cam"])
def test_a_zone_that_cannot_be_is_refused_with_its_own_key(command):
    with pytest.raises(NoSolution) as refused:
        press(cam=CAM, sync={"end": 20.0}).report(command)
    assert refused.value.key == "sync.end"


@pytest.mark.slow
@pytest.mark.parametrize("command", ["press", "check"])
def test_a_shaft_that_the_cams_do_not_clear_fails_in_press_too(command):
    design = press(cam=CAM | {"shaft_radius": 359.999})
    judged = FlatbedPress.judged("press", design.spec) if command == "check" else design.outline("press").checks
    assert judged.count("shaft-clearance") == 1
    found = [check for check in design.report("press").checks if check.name == "shaft-clearance"]
    assert [(check.code, check.status) for check in found] == [("GL302", "fail")] * 2
    assert [check.value for check in found] == pytest.approx([design.min_radius - 359.999] * 2, rel=1e-12)
    impossible = press(cam=CAM | {"shaft_radius": 359.999, "transition_end": 100.0}).report("press")
    assert "shaft-clearance" not in {check.name for check in impossible.checks}


TURNS_BACK = "the bed reverses at input angle 224 deg, before the synchronous zone ends"


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("keys", "key", "words"),
    [
        (
            {},
            "sync.length",
            "at most 164.4 mm, where cam.transition_end",
        ),
        ({"cam__return_angle": 300.0}, "sync.length", "at most 164.4 mm, where cam.transition_end"),
        ({"cam__transition_end": 315.0}, "sync.length", "at most 283.5 mm$"),
        ({"cam__transition_end": 350.0}, "sync.length", "at most 283.5 mm$"),
        ({"sync__end": 300.0}, "sync.end", "at most 168.8 deg, where cam.transition_end"),
    ],
)
def test_a_bed_that_turns_back_within_the_zone_is_named_before_the_cam(keys, key, words):
    """The numbers, applied as printed, give cams; a hundredth more and the bed turns back in the zone."""
    design = factory.design("ty460", bed__offset=-90.0, **keys)
    with pytest.raises(
        NoSolution, match=TURNS_BACK + ".*" + words.replace("behind .* the", r"behind .*\(the")
    ) as refused:
        design.report("cam")
    assert refused.value.key == key
    (failed,) = [check for check in design.report("press").checks if check.name == "pressure-angle"]
    assert TURNS_BACK in failed.message
    for repaired in ({"sync__length": 283.52, "cam__transition_end": 200.0}, {"sync__length": 164.47}):
        followed = factory.design("ty460", bed__offset=-90.0, **repaired)
        assert followed.max_pressure_angle > 0.0
        assert followed.motion.bed_turns_back is None
    longer = factory.design("ty460", bed__offset=-90.0, sync__length=283.53)
    assert longer.motion.bed_turns_back is not None


def test_speeds_where_a_lead_in_takes_the_difference_up():
    sync = {"start": 50.0, "length": 400.0}
    cam = CAM | {"transition_end": 145.0}
    (bare,) = press(sync=sync, cam=cam).check("sync-speed")
    (led,) = press(sync=sync, cam=cam | {"lead_in": 12.0}).check("sync-speed")
    assert (bare.status, led.status) == ("fail", "pass")
    assert "speed difference of bed and cylinder at the start of the zone" in bare.message
    # the second way: the rack's speed just before and just after, from the lift alone
    follower = press(sync=sync, cam=cam | {"lead_in": 12.0}).follower
    start, step = follower.cam_sync_start, 1e-4
    lift = follower.lift(np.array([start - 2 * step, start - step, start, start + step, start + 2 * step]), 0).value
    before, after = lift[2] - lift[1], lift[3] - lift[2]
    assert after - before == pytest.approx(0.5 * (lift[4] - lift[3] - lift[1] + lift[0]), abs=1e-6)
    assert led.value < 1e-12
    assert bare.value == pytest.approx(abs(before / step) * share_of(press(sync=sync, cam=cam)), rel=1e-3)


def share_of(design):
    """Cam speed over cylinder speed at the start of the zone [1/mm]."""
    start = design.sync_start
    return float(design.bed.cam_angle(start, 1).first) / float(design.cylinder.travel(start, 1).first)


def test_transition_may_be_counted_from_the_end_of_the_zone():
    end = degrees(press().cam_sync_end)
    by_angle = press(cam=_without(CAM, "transition_end") | {"transition_angle": 125.0 - end})
    assert by_angle.return_end == pytest.approx(press(cam=CAM).return_end, rel=1e-15)
    assert by_angle.follower_stroke == pytest.approx(press(cam=CAM).follower_stroke, rel=1e-13)
    later = press(cam=_without(CAM, "transition_end") | {"transition_angle": 8.0}, sync={"length": 470.0})
    assert later.follower.transition_end == pytest.approx(later.cam_sync_end + radians(8.0), rel=1e-15)


def _without(section, key):
    return {name: value for name, value in section.items() if name != key}


@pytest.mark.parametrize(
    ("cam", "key", "code"),
    [
        (_without(CAM, "transition_end"), "transition_end", "GL106"),
        (CAM | {"transition_angle": 9.0}, "transition_angle", "GL111"),
    ],
)
def test_one_of_both_ways_to_end_the_transition(cam, key, code):
    with pytest.raises(ValidationError) as refused:
        press(cam=cam)
    (error,) = refused.value.errors()
    assert (error["type"], error["ctx"]["key"]) == (code, key)
