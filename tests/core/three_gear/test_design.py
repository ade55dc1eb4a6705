"""The three-gear four-bar as a design: analysis by a second way, mirror image, checks that repair, refusals.

Tolerances
* oracle (tests/oracles/three_gear.py, 30 digits): 1e-11 relative for speeds and angles. The linkages keep 20 deg and
  more from their dead centres: condition below 10. A standstill loses d/|d - d*|, 40 for the printed example 3:
  1e-10 deg.
* mirror image: 1e-12 relative; the same sums in another order.
* remedies are applied as printed and must hold exactly.
"""

import json
import math
import re
from functools import partial
from pathlib import Path

import factory
import mpmath as mp
import numpy as np
import pytest
from oracles.three_gear import Drive
from sweeps import mostly_slow, spread

from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.machines.three_gear.design import MESHES
from gearlink.core.parts.gears.mesh.pair import GearPair

ROOT = Path(__file__).parents[3]
CASES = json.loads((ROOT / "tests" / "reference" / "contract" / "analyze.json").read_text())
EXAMPLE_3 = {"gears": {"module": 2.5, "crank": 20, "idler": 20, "output": 60}, "links": {"crank": 18.0, "frame": 121.4}}
# one of every motion; crank-rocker and drag link; any teeth
DESIGNS = {
    "example 3": EXAMPLE_3,
    "example 1": {
        "gears": {"module": 2.0, "crank": 40, "idler": 72, "output": 40},
        "links": {"crank": 38.857, "frame": 153.552},
    },
    "one way": {
        "gears": {"module": 2.0, "crank": 20, "idler": 21, "output": 20},
        "links": {"crank": 7.125, "frame": 57.5},
    },
    "short frame": {
        "gears": {"module": 2.0, "crank": 30, "idler": 30, "output": 44},
        "links": {"crank": 12.0, "frame": 60.0},
    },
    "drag link": {
        "gears": {"module": 2.0, "crank": 24, "idler": 20, "output": 30},
        "links": {"crank": 50.0, "frame": 14.0},
    },
}


# -1 is held by its mirror image, below
BOTH = mostly_slow([1, -1], 1)


pytestmark = pytest.mark.usefixtures("forty_digits")


design = partial(factory.design, {"kind": "three-gear-four-bar"})


def drive(sections, assembly=1):
    gears, links = sections["gears"], sections["links"]
    m, z1, z3, z5 = (gears[name] for name in ("module", "crank", "idler", "output"))
    return Drive(links["crank"], m * (z1 + z3) / 2, m * (z3 + z5) / 2, links["frame"], (z1, z3, z5), assembly)


def value(found, name):
    quantity = found.quantity(name)
    return None if quantity is None else quantity.value


# Published


@pytest.mark.parametrize("case", CASES, ids=[case["id"] for case in CASES])
def test_contract(case):
    found = factory.design(case["spec"])
    for name, wanted in case["quantities"].items():
        if isinstance(wanted, str):
            assert value(found, name) == wanted
        else:
            assert value(found, name) == pytest.approx(wanted, rel=case["rtol"], abs=case["atol"]), name


def test_example_3_as_printed_collides_and_says_why():
    found = factory.design("thesis_example_3_as_printed")
    (check,) = found.check("gear-collision")
    assert (check.code, check.status, check.unit, check.limit) == ("GL301", "fail", "mm", 0.0)
    assert check.value == pytest.approx(-1.6, abs=1e-12)
    assert check.message == (
        "interference of the crank gear and the output gear: 1.6 mm (limit <= 0 mm; minimum centre distance 103.4 mm, "
        "AD - AB) at input angle 0 deg"
    )
    assert value(found, "motion") == "back-step"  # the source takes it for a momentary dwell
    assert not found.report("analyze").ok


# A second way


@pytest.mark.slow
@pytest.mark.parametrize("assembly", BOTH)
@pytest.mark.parametrize("name", DESIGNS)
def test_motion_table_against_the_cosine_rule(name, assembly):
    sections = DESIGNS[name] | {"assembly": assembly}
    oracle = drive(sections, assembly)
    table = design(**sections).table("motion", samples=15)
    rows = np.array(table.rows())
    assert table.columns == ("crank_angle", "output_angle", "speed_ratio", "acceleration_ratio", "transmission_angle")
    assert table.units == ("deg", "deg", "1", "1", "deg")
    for degrees, _, speed, acceleration, angle in spread(rows, 4):
        phi = mp.radians(mp.mpf(float(degrees)))
        assert speed == pytest.approx(float(oracle.speed(phi)), abs=1e-11)
        assert acceleration == pytest.approx(float(oracle.acceleration(phi)), abs=1e-11)
        assert angle == pytest.approx(float(mp.degrees(oracle.transmission(phi))), rel=1e-12)
    # the output angle is the integral of the speed: by its increments, free of branches
    steps = [mp.quad(oracle.speed, [mp.radians(24 * i), mp.radians(24 * (i + 1))]) for i in range(4)]
    np.testing.assert_allclose(
        rows[:5, 1], np.cumsum([0.0, *(float(mp.degrees(s)) for s in steps)]), rtol=0.0, atol=1e-10
    )


@pytest.mark.slow
@pytest.mark.parametrize("assembly", BOTH)
@pytest.mark.parametrize("name", DESIGNS)
def test_extremes_and_standstills_against_a_search(name, assembly):
    oracle = drive(DESIGNS[name], assembly)
    found = design(**DESIGNS[name], assembly=assembly)
    with mp.workdps(20):
        stops = oracle.roots(oracle.speed, 2.0)
        extremes = [oracle.speed(phi) for phi in oracle.roots(oracle.acceleration, 3.0)]
    assert value(found, "dwell_crank_angles") == pytest.approx([float(mp.degrees(s)) for s in stops], abs=1e-9)
    assert value(found, "motion") == ("back-step" if stops else "unidirectional")
    assert value(found, "speed_ratio_max") == pytest.approx(float(max(extremes)), rel=1e-11)
    assert value(found, "speed_ratio_min") == pytest.approx(float(min(extremes)), rel=1e-11, abs=1e-12)
    mean = 1.0 if name == "drag link" else oracle.teeth[0] / oracle.teeth[2]
    assert value(found, "mean_ratio") == mean
    assert value(found, "nonuniformity") == pytest.approx(float((max(extremes) - min(extremes)) / mean), rel=1e-11)
    least = min(oracle.transmission(mp.mpf(0)), oracle.transmission(mp.pi))
    assert value(found, "min_transmission_angle") == pytest.approx(float(mp.degrees(least)), rel=1e-12)


@pytest.mark.quick(1)
@pytest.mark.parametrize("assembly", [1, -1])
@pytest.mark.parametrize("name", ["example 1", "example 3"])
def test_back_step_and_dwell_by_the_output_angle_itself(name, assembly):
    oracle = drive(DESIGNS[name], assembly)
    found = design(**DESIGNS[name], assembly=assembly)
    first, second = oracle.roots(oracle.speed, 2.0)
    if oracle.acceleration(first) > 0:
        first, second = second - 2 * mp.pi, first
    # in these crank-rockers no branch of the triangle's angles is passed
    back = mp.degrees(oracle.output(first) - oracle.output(second))
    assert value(found, "back_step_angle") == pytest.approx(float(back), rel=1e-10)
    assert value(found, "back_step_crank_angle") == pytest.approx(float(mp.degrees(second - first)), rel=1e-10)
    regained = mp.findroot(
        lambda phi: oracle.output(phi) - oracle.output(first), (second, second + (second - first)), solver="anderson"
    )
    assert value(found, "dwell_angle") == pytest.approx(float(mp.degrees(regained - first)), rel=1e-10)
    assert value(found, "dwell_angle_approximate") == 1.5 * value(found, "back_step_crank_angle")


def test_tolerance_dwell_only_where_the_file_gives_one():
    assert value(design(**EXAMPLE_3), "tolerance_dwell_angle") is None
    found = design(**EXAMPLE_3, dwell_tolerance=1.0)
    assert value(found, "tolerance_dwell_angle") == pytest.approx(123.0084, abs=5e-5)  # 40 digits, printed to four
    oracle = drive(EXAMPLE_3)
    start, width = value(found, "tolerance_dwell_start"), value(found, "tolerance_dwell_angle")
    at = [oracle.output(mp.radians(start + width * i / 400)) for i in range(401)]
    assert float(mp.degrees(max(at) - min(at))) == pytest.approx(2.0, abs=1e-4)


def test_play_at_the_output_gear_is_a_tolerance():
    """j = 2 tol r5 with r5 = 75 mm: the same dwell as the tolerance itself."""
    play = design(**EXAMPLE_3, dwell_backlash=2.0 * math.radians(1.0) * 75.0)
    assert value(play, "tolerance_dwell_angle") == pytest.approx(
        value(design(**EXAMPLE_3, dwell_tolerance=1.0), "tolerance_dwell_angle"), rel=1e-12, abs=0.0
    )


def test_quantities_that_do_not_apply_are_absent():
    names = [quantity.name for quantity in design(**DESIGNS["one way"]).report("analyze").quantities]
    assert "dwell_crank_angles" in names
    for name in ("back_step_angle", "back_step_crank_angle", "dwell_angle", "dwell_angle_approximate"):
        assert name not in names


# Mirror image


def mirrored(one, other):
    """Quantities of a design and of its mirror image: standstills change sides, accelerations their sign.

    phi13 is not the image's: the output runs the other way there, so it counts from the other standstill.
    """
    first = {q.name: q.value for q in one.quantities}
    second = {q.name: q.value for q in other.quantities}
    assert first.keys() == second.keys()
    for name, found in first.items():
        if name == "dwell_angle":
            continue
        if name == "dwell_crank_angles":
            assert second[name] == pytest.approx([360.0 - v for v in reversed(found)], abs=1e-9)
        elif name == "acceleration_ratio_max":
            assert second["acceleration_ratio_min"] == pytest.approx(-found, rel=1e-11)
        elif name.endswith("_at"):
            image = {"acceleration_ratio_max_at": "acceleration_ratio_min_at",
                     "acceleration_ratio_min_at": "acceleration_ratio_max_at"}.get(name, name)  # fmt: skip
            assert abs(math.remainder(second[image] + found, 360.0)) < 1e-9, name
        elif name == "tolerance_dwell_start":
            start = (360.0 - found - first["tolerance_dwell_angle"]) % 360.0
            assert second[name] == pytest.approx(start, abs=1e-6)
        elif isinstance(found, float) and name != "acceleration_ratio_min":
            assert second[name] == pytest.approx(found, rel=1e-10, abs=1e-12), name
        elif name != "acceleration_ratio_min":
            assert second[name] == found
    for check, image in zip(one.checks, other.checks, strict=True):
        assert (check.code, check.name, check.status) == (image.code, image.name, image.status)


@pytest.mark.slow
@pytest.mark.parametrize("name", DESIGNS)
def test_mirror_image(name):
    given = DESIGNS[name] | {"dwell_tolerance": 0.5}
    mirrored(*(design(**given, assembly=s).report("analyze") for s in (1, -1)))


@pytest.mark.quick(1)
@pytest.mark.parametrize("k", [1e-3, 1e3])
@pytest.mark.parametrize("name", DESIGNS)
def test_scale(name, k):
    small, gears, links = design(**DESIGNS[name]), *(DESIGNS[name][s] for s in ("gears", "links"))
    large = design(gears=gears | {"module": k * gears["module"]}, links={n: k * v for n, v in links.items()})
    for quantity in small.report("analyze").quantities:
        factor = k if quantity.unit == "mm" else 1.0
        other = value(large, quantity.name)
        if isinstance(quantity.value, str):
            assert other == quantity.value
        else:
            wanted = np.multiply(factor, quantity.value)
            # a change of 1e-16 in a length moves a back-step's ends by its condition number, below 100
            np.testing.assert_allclose(other, wanted, rtol=1e-11, atol=1e-13 * factor, err_msg=quantity.name)


# Refusals


@pytest.mark.parametrize(
    ("crank", "frame"),
    [(60.0, 121.4), (28.6, 121.4), (20.0, 130.0), (50.0, 200.0), (120.0, 90.0)],
    ids=["double rocker", "little longer", "change point", "impossible", "short frame"],
)
@pytest.mark.parametrize("assembly", [1, -1])
def test_linkages_that_cannot_be_driven(crank, frame, assembly):
    found = design(gears=EXAMPLE_3["gears"], links={"crank": crank, "frame": frame}, assembly=assembly)
    with pytest.raises(NoSolution) as refusal:
        found.report("analyze")
    assert refusal.value.key == "links"
    assert f"crank {crank:g}" in str(refusal.value)
    assert "not a crank-rocker or drag link" in str(refusal.value)


def test_change_point_linkage():
    found = design(gears=EXAMPLE_3["gears"], links={"crank": 20.0, "frame": 130.0})
    with pytest.raises(NoSolution, match="at its change point") as refusal:
        found.quantity("min_transmission_angle")
    assert refusal.value.key == "links"


@pytest.mark.parametrize(
    ("sections", "key"),
    [
        ({"gears": EXAMPLE_3["gears"]}, "links"),
        ({"gears": {"module": 2.0, "crank": 40, "output": 40}, "links": EXAMPLE_3["links"]}, "gears.idler"),
    ],
)
def test_sections_that_analyze_needs(sections, key):
    with pytest.raises(MissingSection) as refusal:
        design(**sections).report("analyze")
    assert refusal.value.key == key


def test_ratio_of_less_than_a_tooth():
    with pytest.raises(NoSolution) as refusal:
        _ = design(gears={"module": 2.0, "crank": 40, "output": 40, "i3": -0.01}).idler_teeth
    assert refusal.value.key == "gears.i3"


# Checks, and what they advise


@pytest.mark.parametrize("limit", [0.0, 0.7, 12.34567])
@pytest.mark.parametrize("name", ["example 3", "short frame"])
def test_collision_remedies_repair_the_design(name, limit):
    gears, links = DESIGNS[name]["gears"], DESIGNS[name]["links"]
    limits = {"gear_gap": limit}
    (check,) = design(gears=gears, links=links, limits=limits).check("gear-collision")
    assert check.status == "fail"
    longer = float(re.search(r"frame minus crank by ([\d.]+) mm", check.fix)[1])
    teeth = int(re.search(r"use (\d+) (?:tooth|teeth) fewer", check.fix)[1])
    repaired = (
        {"gears": gears, "links": links | {"crank": links["crank"] - longer / 2, "frame": links["frame"] + longer / 2}},
        {"gears": gears | {"output": gears["output"] - teeth}, "links": links},
    )
    for sections in repaired:
        oracle = drive(sections)
        z1, _, z5 = oracle.teeth
        gap = oracle.frame - oracle.crank - sections["gears"]["module"] * (z1 + z5 + 4) / 2
        assert gap >= limit - 1e-12
    # one tooth and a hundredth of a millimetre less would not do
    assert (teeth - 1) * gears["module"] / 2.0 < limit - check.value
    assert longer == pytest.approx(limit - check.value, rel=1e-3)


def test_longer_frame_as_advised_passes_example_3():
    (check,) = design(**EXAMPLE_3).check("gear-collision")
    longer = float(re.search(r"frame minus crank by ([\d.]+) mm", check.fix)[1])
    repaired = design(gears=EXAMPLE_3["gears"], links={"crank": 18.0, "frame": 121.4 + longer})
    assert [c.status for c in repaired.check("gear-collision")] == ["pass"]


def test_crank_that_is_named_gives_a_momentary_dwell_with_room():
    (check,) = design(**EXAMPLE_3, momentary={"eccentricity": 18.0}).check("gear-collision")
    crank = float(re.search(r"crank of at most ([\d.]+) mm \(synth momentary-dwell\)", check.fix)[1])
    for eccentricity, status in ((crank, "pass"), (crank + 0.02, "fail")):
        made = design(
            command="synth momentary-dwell", gears=EXAMPLE_3["gears"], momentary={"eccentricity": eccentricity}
        )
        assert [c.status for c in made.check("gear-collision")] == [status]


@pytest.mark.parametrize(("limit", "status"), [(-1.7, "warn"), (-1.61, "warn"), (-1.59, "fail"), (0.0, "fail")])
def test_gap_against_the_limit_of_the_file(limit, status):
    """A limit below 0 says that the gears lie in planes of their own, which no other key does: they never pass."""
    (check,) = design(**EXAMPLE_3, limits={"gear_gap": limit}).check("gear-collision")
    assert (check.status, check.limit) == (status, limit)


@pytest.mark.parametrize(
    ("limit", "status"), [(41.0, "pass"), (41.2, "warn"), (46.1, "warn"), (46.2, "fail"), (60.0, "fail")]
)
def test_transmission_angle_against_its_limit(limit, status):
    # 46.113 deg; a warning up to 5 deg above the limit
    (check,) = design(**EXAMPLE_3, limits={"transmission_angle": limit}).check("transmission-angle")
    assert (check.code, check.status) == ("GL303", status)
    assert check.value == pytest.approx(46.113184642103754, rel=1e-12)


def test_shafts_that_the_file_does_not_name():
    found = design(**DESIGNS["example 1"]).check("shaft-clearance")
    assert [check.code for check in found] == ["GL302"] * 5
    assert [check.status for check in found] == ["warn", "pass", "pass", "pass", "pass"]
    # crank and coupler folded: C comes to b - a = 112 - 38.857 of A, the idler's tips reach 74 mm
    assert found[0].value == pytest.approx(112.0 - 38.857 - 74.0, abs=1e-12)
    assert found[1].value == pytest.approx(153.552 - 42.0, abs=1e-12)
    assert found[2].value == pytest.approx(153.552 - 38.857 - 42.0, abs=1e-12)
    assert found[3].value == pytest.approx(112.0 - 74.0, abs=1e-12)
    assert found[4].value == pytest.approx(153.552, abs=1e-12)
    assert [check.limit for check in found] == [4.0, 4.0, 4.0, 4.0, 8.0]
    assert found[0].message == (
        "overlap of the idler and the axis of the input shaft: 0.857 mm (limit <= 0 mm; axes 73.14 mm apart) "
        "at input angle 223.2 deg"
    )


@pytest.mark.slow
@pytest.mark.parametrize("assembly", BOTH)
@pytest.mark.parametrize("name", DESIGNS)
def test_nearest_approach_of_idler_and_input_shaft_by_a_search(name, assembly):
    oracle = drive(DESIGNS[name], assembly)
    with mp.workdps(15):
        nearest = min(
            abs(oracle.frame + oracle.rocker * mp.expj(direction + mp.pi - assembly * at_d))
            for direction, _, at_d in (oracle.triangle(mp.radians(i / mp.mpf(2))) for i in range(720))
        )
    check = design(**DESIGNS[name], assembly=assembly).check("shaft-clearance")[0]
    tip = DESIGNS[name]["gears"]["module"] * (oracle.teeth[1] + 2) / 2.0
    # a flat minimum, a quarter of a degree off at most
    assert check.value + tip == pytest.approx(float(nearest), rel=1e-4)
    assert check.value + tip <= float(nearest) + 1e-9


def test_shafts_of_the_file():
    given = DESIGNS["one way"]
    free = {(check.value, check.message) for check in design(**given).check("shaft-clearance")}
    at_input = min(value for value, message in free if "input shaft" in message)
    at_output = min(value for value, message in free if "output shaft" in message)
    assert min(at_input, at_output) > 5.0
    for input_radius, output_radius, fails in (
        (at_input - 1e-6, at_output - 1e-6, 0),
        (at_input + 1e-6, at_output - 1e-6, 1),
        (at_input - 1e-6, at_output + 1e-6, 1),
    ):
        shafts = {"input_radius": input_radius, "output_radius": output_radius}
        found = design(**given, shafts=shafts).check("shaft-clearance")
        assert sorted(check.status for check in found) == ["fail"] * fails + ["pass"] * (5 - fails)


@pytest.mark.parametrize(
    ("ratio", "teeth", "status"), [(-1.8, 72, "pass"), (-1.79, 72, "warn"), (-1.7875, 72, "warn"), (-1.78, 71, "warn")]
)
def test_ratio_is_rounded_to_teeth(ratio, teeth, status):
    found = design(gears={"module": 2.0, "crank": 40, "output": 40, "i3": ratio}, links={"crank": 38.0, "frame": 153.0})
    assert value(found, "idler_teeth") == teeth
    (check,) = found.check("rounded-ratio")
    assert (check.code, check.status) == ("GL304", status)
    assert check.value == value(found, "i3") == -teeth / 40
    assert design(**EXAMPLE_3).check("rounded-ratio") == []


# Meshes


def test_both_meshes_as_gear_pairs():
    found = design(**EXAMPLE_3)
    for mesh, teeth in zip(MESHES, ((20, 20), (20, 60)), strict=True):
        pair = GearPair.from_shift(2.5, teeth)
        assert value(found, f"{mesh}.contact_ratio") == pair.contact_ratio
        assert value(found, f"{mesh}.tip_radius") == list(pair.tip_radius)
        assert value(found, f"{mesh}.center_distance") == value(
            found, {20: "coupler_length", 60: "rocker_length"}[teeth[1]]
        )
    messages = [check.message for check in found.check("undercut")]
    assert [m.split(":")[0] for m in messages] == ["crank-idler mesh"] * 2 + ["idler-output mesh"] * 2


def test_gears_need_no_links():
    assert design(gears=EXAMPLE_3["gears"]).report("gear").ok


# Nothing but what is asked for


def test_transmission_angle_computes_no_motion():
    found = design(**EXAMPLE_3)
    found.quantity("min_transmission_angle")
    assert set(vars(found)) == {"spec", "kin", "linkage", "min_transmission_angle", "idler_teeth"}


def test_gear_gap_sweeps_nothing():
    found = design(**EXAMPLE_3)
    found.quantity("gear_gap")
    assert not set(vars(found)) & {"speed_turnings", "dwell_crank_angles", "meshes"}
    assert math.isclose(found.gear_gap, -1.6, rel_tol=0.0, abs_tol=1e-12)


def test_the_tolerance_of_the_request_for_a_dwell_measures_an_analysis():
    """`dwell.tolerance` and `dwell_tolerance` are one request under two names; others leave the section alone."""
    linkage = {"gears": {"module": 2, "crank": 40, "idler": 72, "output": 40}, "links": {"crank": 38, "frame": 152}}
    given = design(**linkage, dwell_tolerance=0.5)
    asked = design(**linkage, dwell={"tolerance": 0.5})
    assert asked.raw("tolerance_dwell_angle") == given.raw("tolerance_dwell_angle")
    tasks = {"dwell": {"tolerance": 0.5}, "back_step": {"crank_angle": 90}}
    other = design(command="synth back-step", **linkage, **tasks)
    assert other.output_tolerance is None


@pytest.mark.slow
@pytest.mark.parametrize("key", ["dwell_tolerance", "dwell_backlash"])
def test_a_tolerance_without_end_is_a_finding(key):
    """Half of the gain of a revolution of example 3; a play counts at the output gear's circle, r5 = 75 mm."""
    limit = 180.0 * design(**EXAMPLE_3).mean_ratio
    scale = 1.0 if key == "dwell_tolerance" else math.radians(2.0 * 75.0)
    for share, status in ((0.999, "pass"), (1.001, "fail")):
        made = design(**EXAMPLE_3, **{key: share * limit * scale})
        (check,) = made.check("dwell-tolerance")
        assert (check.code, check.status) == ("GL317", status)
        assert check.limit == pytest.approx(limit, rel=1e-14)
        names = [quantity.name for quantity in made.report("analyze").quantities]
        assert ("tolerance_dwell_angle" in names) == (status == "pass")
        assert "speed_ratio_max" in names
    assert design(**EXAMPLE_3).check("dwell-tolerance") == []


@pytest.mark.parametrize(
    "keys", [{"dwell_tolerance": 1e-10}, {"dwell_backlash": 1e-10}, {"dwell": {"tolerance": 1e-10}}]
)
def test_tolerances_below_what_double_precision_tells_are_refused(keys):
    with pytest.raises(ValueError, match=r"equal to 0\.000000001"):
        design(**EXAMPLE_3, **keys)
    assert design(**EXAMPLE_3, dwell_tolerance=1e-9).raw("tolerance_dwell_angle") > 0.0


def test_a_dwell_angle_beyond_a_revolution_of_the_output_asks_for_a_smaller_one() -> None:
    """The file has no tolerance that could be set: half of its back-step is taken for one."""
    keys = {"gears": {"module": 1, "crank": 74, "output": 74}, "dwell": {"angle": 281}}
    keys |= {"limits": {"transmission_angle": 31.62}}
    made = factory.design({"kind": "three-gear-four-bar", **keys}, command="synth dwell")
    (check,) = made.check("dwell-tolerance")
    assert (check.status, check.fix.split(":")[0]) == ("fail", "reduce dwell.angle")
