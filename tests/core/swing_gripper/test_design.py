"""The swing gripper as a design: its cams, the whole machine turned and mirrored, and everything it refuses.

Tolerances, EPS = 2^-52:
* cam points: 1e-13 of the largest radius's neighbourhood, 200 mm; curvature 1e-14 1/mm (32 EPS of its terms divided
  by |D1|); pressure angles 32 EPS of a half turn - lever over lever, both of a few roundings;
* extremes: values as the points, places to the root of that;
* turned machines: cam radii, pressure angles and torques keep 64 EPS of their size, for pivots are rounded anew;
  points turn with the machine. A mirrored machine is the same to 16 EPS.
"""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import factory
import numpy as np
import pytest
from oracles.gripper import CASES, REFERENCE, TABLE, machine, mirrored, turned
from pydantic import ValidationError
from sweeps import mostly_slow

from gearlink.core.base.codes import rules
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.spec_paths import changed
from gearlink.core.machines.swing_gripper.linkage import clear_turn
from gearlink.core.machines.swing_gripper.mechanism import motion

EPS = 2.0**-52
ROOT = Path(__file__).parents[3]
DESIGN = machine()
POINT = 1e-13 * 200.0
ANGLE = 32 * EPS * 180.0
CURVATURE = 1e-14


@pytest.mark.quick(3)
@pytest.mark.parametrize("row", TABLE, ids=lambda row: str(row["theta_deg"]))
def test_both_cams_of_the_table(row: dict) -> None:
    angle = np.radians([float(row["theta_deg"])])
    for number, cam in enumerate(DESIGN.cams.discs, start=1):
        at = cam.at(angle)
        expected = {key: float(row[f"cam{number}_{key}"]) for key in ("x", "y", "alpha_deg", "rho_pitch")}
        assert abs(at.profile[0] - complex(expected["x"], expected["y"])) <= POINT
        assert math.degrees(at.pressure_angle[0]) == pytest.approx(expected["alpha_deg"], rel=0.0, abs=ANGLE)
        assert at.curvature[0] == pytest.approx(1.0 / expected["rho_pitch"], rel=0.0, abs=CURVATURE)


@pytest.mark.parametrize("name", ["CAM-01", "CAM-03", "CAM-05"])
def test_points_of_the_reference(name: str) -> None:
    case = CASES[name]
    expected = {key: float(value) for key, value in case["expected"].items()}
    cam = DESIGN.cams.discs[case["inputs"]["roller"] - 1]
    at = cam.at(np.radians([case["inputs"]["theta_deg"]]))
    assert abs(at.pitch[0] - complex(expected["px"], expected["py"])) <= POINT
    assert abs(at.profile[0] - complex(expected["cx"], expected["cy"])) <= POINT
    assert abs(at.profile[0]) == pytest.approx(expected["r_c"], rel=0.0, abs=POINT)
    assert at.pressure_angle[0] == pytest.approx(expected["alpha"], rel=0.0, abs=math.radians(ANGLE))
    assert at.curvature[0] == pytest.approx(expected["kappa_p"], rel=0.0, abs=CURVATURE)


def test_extremes_of_the_reference() -> None:
    expected = {key: float(value) for key, value in CASES["EXT-01"]["expected"].items()}
    main, back = (cam.max_pressure_angle for cam in DESIGN.cams.discs)
    assert math.degrees(main.value) == pytest.approx(-expected["alpha1_min_deg"], rel=0.0, abs=ANGLE)
    assert math.degrees(back.value) == pytest.approx(expected["alpha2_max_deg"], rel=0.0, abs=ANGLE)
    assert math.degrees(main.place) == pytest.approx(expected["at_alpha1_min_deg"], rel=0.0, abs=1e-5)
    assert math.degrees(back.place) == pytest.approx(expected["at_alpha2_max_deg"], rel=0.0, abs=1e-5)
    degrees = np.linspace(180.0, 190.0, 100001)
    peak = np.abs(DESIGN.linkage.motion(degrees, 2).input.second).max() * DESIGN.shaft_speed**2
    assert peak == pytest.approx(expected["psi_dd_max"], rel=1e-9, abs=0.0)
    scan = REFERENCE["example_extremes_1deg_scan"]
    for value, key in zip(DESIGN.min_curvature_radius, ("kappa1", "kappa2"), strict=True):
        # The minimum curvature radius is that of the dwell circle, in both cams at a dwell that the scan met.
        assert value == pytest.approx(1.0 / float(scan[key]["max"]), rel=1e-10, abs=0.0)
    assert DESIGN.min_radius == pytest.approx((93.990, 94.667), rel=0.0, abs=5e-4)
    assert DESIGN.max_radius == pytest.approx((165.461, 166.158), rel=0.0, abs=5e-4)


def test_quantities_of_the_example() -> None:
    report = DESIGN.report("gripper")
    assert report.ok
    assert {check.status for check in report.checks} == {"pass"}
    values = {quantity.name: quantity.value for quantity in report.quantities}
    assert values["total_swing"] == pytest.approx(39.15, rel=8 * EPS, abs=0.0)
    assert 0.0 < DESIGN.newton_agreement <= 16 * EPS
    assert values["newton_agreement"] == math.degrees(DESIGN.newton_agreement)
    assert values["newton_iterations"] <= 4
    assert values["condition_number"] == pytest.approx(1.0 / math.sin(math.radians(69.7178346241)), rel=1e-11)
    assert values["lift_off_speed"] == pytest.approx(14151.0, rel=0.0, abs=0.5)


def test_one_of_many_designs_solves_the_loop_at_a_few_places() -> None:
    made = machine()
    made.advises = False
    (tried,), (whole,) = made.check("conditioning"), DESIGN.check("conditioning")
    assert "loop" not in vars(made.motion)
    assert (tried.status, tried.value, tried.limit) == (whole.status, whole.value, whole.limit)
    assert 0.0 < made.motion.rough_agreement <= DESIGN.newton_agreement


def test_the_worked_design_is_the_reference_machine() -> None:
    spec, known = factory.design("swing_gripper").spec, DESIGN.spec
    for name in ("speed", "cylinder", "arm", "links", "pivots", "phases", "laws", "handover", "inertia", "spring"):
        assert getattr(spec, name) == getattr(known, name), name
    assert spec.cam.model_copy(update={"shaft_radius": 0.0}) == known.cam
    assert {check.status for check in factory.design("swing_gripper").report("analyze").checks} == {"pass"}


def test_the_contract_is_the_same_machine() -> None:
    cases = json.loads((ROOT / "tests" / "reference" / "contract" / "gripper.json").read_text())
    spec = (cases if isinstance(cases, list) else cases["cases"])[0]["spec"]
    assert factory.design(spec).spec == DESIGN.spec


@pytest.mark.quick(1)
@pytest.mark.parametrize("angle", [30.0, -145.0])
def test_turning_the_whole_machine_changes_nothing(angle: float) -> None:
    other = turned(angle, 12.0 + 70.0j)
    for name in ("handover_speed", "total_swing", "min_transmission_angle", "lift_off_speed", "max_pressure_angle"):
        assert getattr(other, name) == pytest.approx(getattr(DESIGN, name), rel=64 * EPS, abs=0.0), name
    for name in ("min_curvature_radius", "min_radius", "max_radius"):
        assert getattr(other, name) == pytest.approx(getattr(DESIGN, name), rel=64 * EPS, abs=0.0), name
    angles = np.radians(np.arange(0.0, 360.0, 3.0))
    for one, two in zip(DESIGN.cams.discs, other.cams.discs, strict=True):
        turn = np.exp(1j * math.radians(angle))
        assert np.abs(two.at(angles).profile - turn * one.at(angles).profile).max() <= 10 * POINT
        assert np.abs(two.at(angles).curvature - one.at(angles).curvature).max() <= 4 * CURVATURE
    torque = [design.closure.inertia.torques(np.arange(0.0, 360.0, 3.0))[0] for design in (DESIGN, other)]
    assert np.abs(torque[1] - torque[0]).max() <= 512 * EPS * 293.0
    moved = complex(DESIGN.handover_center) * np.exp(1j * math.radians(angle)) + 12.0 + 70.0j
    assert abs(other.handover_center - moved) <= 1e-12


@pytest.mark.slow
def test_the_mirrored_machine_is_the_same_machine() -> None:
    other = mirrored()
    for name in ("handover_speed", "total_swing", "min_transmission_angle", "lift_off_speed", "max_pressure_angle"):
        assert getattr(other, name) == pytest.approx(getattr(DESIGN, name), rel=16 * EPS, abs=0.0), name
    angles = np.radians(np.arange(0.0, 360.0, 3.0))
    for one, two in zip(DESIGN.cams.discs, other.cams.discs, strict=True):
        assert np.abs(two.at(angles).profile - np.conj(one.at(angles).profile)).max() <= POINT
        assert np.abs(np.abs(two.at(angles).pressure_angle) - np.abs(one.at(angles).pressure_angle)).max() <= 32 * EPS
    assert other.closure.lift_sense == -DESIGN.closure.lift_sense
    assert abs(other.handover_center - DESIGN.handover_center.conjugate()) <= 1e-12
    assert {check.status for check in other.report("analyze").checks} == {"pass"}


def test_profile_keeps_the_roller_off_itself() -> None:
    angles = np.linspace(0.0, 2.0 * math.pi, 721)[:-1]
    for cam in DESIGN.cams.discs:
        pitch, profile = cam.points(angles)
        gaps = np.abs(profile[:, None] - pitch[None, :])
        assert gaps.min() == pytest.approx(30.0, rel=0.0, abs=1e-12)


def test_speed_and_acceleration_of_the_tip_are_those_of_its_path() -> None:
    """Second differences over a tenth of a degree, but at the joints of the law, where its jerk jumps."""
    table = machine().table("tip", samples=3600)
    step = 1e-3 * (table["time"][1] - table["time"][0])
    place = table["tip_x"] + 1j * table["tip_y"]
    first = (np.roll(place, -1) - np.roll(place, 1)) / (2.0 * step)
    second = (np.roll(place, -1) - 2.0 * place + np.roll(place, 1)) / step**2
    for found, wanted in ((table["tip_speed"], np.abs(first)), (table["tip_acceleration"], np.abs(second))):
        off = np.abs(found - wanted)
        assert np.quantile(off, 0.98) < 1e-4 * found.max()


@pytest.mark.parametrize("direction", [-250.0, 110.0])
def test_the_swing_of_every_view_is_that_of_the_law(direction: float) -> None:
    """Table, output of the motion and law, also where ED is given by a direction outside the first revolution."""
    design = machine(output_direction=direction)
    law = np.degrees(design.motion.law.evaluate(np.arange(0.0, 360.0, 15.0), 0)[0])
    assert design.table("motion", samples=24)["beta"] == pytest.approx(law, rel=0.0, abs=64 * EPS * 180.0)
    moving = motion(design)
    swing = moving.outputs[0].course.of(moving.at(np.radians([106.0]), 0))[0]
    assert np.degrees(swing) == pytest.approx([25.2], rel=0.0, abs=64 * EPS * 180.0)


def test_rows_of_the_tables() -> None:
    design = machine()
    motion = design.table("motion", samples=24)
    assert [row[0] for row in motion.rows()] == [15.0 * k for k in range(24)]
    newton = design.table("newton", samples=24)
    assert newton.columns == ("theta", "deviation", "iterations", "residual", "error")
    assert newton.units == ("deg", "deg", "1", "mm", "deg")
    assert max(row[1] for row in newton.rows()) <= math.degrees(16 * EPS)


@pytest.mark.parametrize(
    ("changes", "key", "words"),
    [
        ({"links__coupler": 115.5}, "links", "the linkage cannot be assembled at cylinder angle"),
        ({"output_direction": 23.7}, "links", "dead centre at joint D .* 0.021 deg .limit >= 0.058 deg"),
        ({"pivots__output": [230.0, 0.0]}, "pivots", "frame length is 0 mm"),
        ({"laws__return": "simple-harmonic"}, "laws.return", "use cycloidal, modified-sine or polynomial-345"),
        ({"laws__accelerate": "cycloidal"}, "laws.accelerate", "use velocity-345 or half-cycloidal"),
        ({"laws__accelerate": {"quintic": 0.7}}, "laws.accelerate", "keep kappa in 2/5 to 3/5"),
        ({"laws__accelerate": "half-simple-harmonic"}, "laws.accelerate", "half-cycloidal or velocity-345"),
        ({"total_swing": 40.0}, "total_swing", r"phases.constant by \+1.88888889 deg"),
        ({"arm__length": 20.0}, "arm.length", "swing of the arm: 587.3 deg .limit < 360 deg.*arm longer than 32.63 mm"),
        ({"cylinder__radius": 1e12}, "arm.length", "radius less than 1241 mm"),
    ],
    ids=lambda value: str(value)[:40],
)
def test_refusals_name_key_value_and_remedy(changes: dict, key: str, words: str) -> None:
    with pytest.raises(NoSolution, match=words) as refused:
        machine(**changes).report("gripper")
    assert refused.value.key == key


_NO_CAM = [
    (
        {"output_direction": 38.0, "limits": {"transmission_angle": 1.0}},
        "cam.center",
        r"pressure angle: 90 deg at cam angle 208\.\d+ deg, where the roller passes the relative pole$",
    ),
    pytest.param(
        {"cam__center": None, "size": {"pressure_angle": 20.0}},
        "size.pressure_angle",
        "no cam centre keeps",
        marks=pytest.mark.slow,  # a second of search
    ),
]


@pytest.mark.slow
@pytest.mark.parametrize("command", ["gripper", "analyze"])
@pytest.mark.parametrize(("changes", "key", "words"), _NO_CAM, ids=["relative pole", "size"])
def test_the_motion_is_shown_though_the_cam_is_impossible(command: str, changes: dict, key: str, words: str) -> None:
    design = machine(**changes)
    report = design.report(command)
    (failed,) = [check for check in report.checks if check.name == "pressure-angle"]
    assert (failed.code, failed.status, failed.value) == ("GL401", "fail", None)
    assert re.search(words, failed.message)
    assert key == "size.pressure_angle" or failed.advice.startswith("move cam.center, or ")
    assert {"handover_speed", "total_swing", "newton_agreement"} <= {q.name for q in report.quantities}
    assert not {"max_pressure_angle", "lift_off_speed"} & {q.name for q in report.quantities}
    assert [table.name for table in report.tables] == ["motion"]
    without = {key: value for key, value in changes.items() if not key.startswith(("cam", "size"))}
    alone = machine(**without, cam=None).report(command)
    assert report.quantities == alone.quantities
    with pytest.raises(NoSolution) as refused:
        design.report("cam")
    assert re.search(words, refused.value.message)
    assert refused.value.key == key
    assert refused.value.fix == failed.advice


@pytest.mark.parametrize("command", ["gripper", "analyze", "cam"])
def test_a_linkage_that_cannot_swing_is_refused_with_its_own_key(command: str) -> None:
    with pytest.raises(NoSolution) as refused:
        machine(links__input=20.0).report(command)
    assert refused.value.key == "links"


def test_pivots_in_one_point_are_both_named() -> None:
    with pytest.raises(NoSolution, match=r"pivots\.input and pivots\.output are one point, \(230, 0\) mm.*move one"):
        machine(pivots__output=[230.0, 0.0]).report("gripper")


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            {"phases__constant": 13.0},
            r"1 validation error for SwingGripperSpec\
phases\
  sum of the six phases:",
        ),
        ({"phases__constant": -12.0}, "greater than 0"),
        ({"handover": 99.0}, "set handover from 100 to 112 deg"),
        ({"arm__length": 0.0}, "greater than 0"),
        ({"cylinder__radius": math.inf}, "finite"),
        ({"spring": {"torque": 400.0, "arms": [1.0, 2.0]}}, "exclude each other"),
        ({"spring": {"arms": [1.0, 2.0]}}, "angle, preload missing"),
        ({"spring": {"arms": [1.0, 2.0], "angle": 90.0, "preload": 1.0, "rate": 2.0}}, "go together"),
    ],
    ids=lambda value: str(value)[:40],
)
def test_files_that_are_refused(changes: dict, words: str) -> None:
    with pytest.raises(ValidationError, match=words):
        machine(**changes)


@pytest.mark.quick(7)
@pytest.mark.parametrize(
    ("changes", "code", "status", "words"),
    [
        ({"output_direction": 150.0}, "GL303", "fail", "turn output_direction .transmission"),
        ({"output_direction": 137.2}, "GL303", "warn", "transmission angle 45 deg"),
        ({"limits": {"pressure_angle": 20.0}}, "GL401", "fail", "no cam centre meets the limit, best 24.1 deg"),
        ({"cam__center": [150.0, 0.0]}, "GL401", "fail", "move cam.center, or lengthen"),  # half a second
        ({"limits": {"accelerate_pressure_angle": 24.5}}, "GL401", "warn", "while it accelerates the gripper"),
        ({"cam__roller__radius": 110.0}, "GL402", "warn", "use a roller of at most 99.19 mm"),
        ({"cam__roller__radius": 124.0}, "GL402", "fail", "use a roller"),
        ({"cam__shaft_radius": 80.0}, "GL302", "warn", "use a shaft_radius of at most 62.66 mm"),
        ({"cam__shaft_radius": 95.0}, "GL302", "fail", "main cam and its shaft: 1.01 mm"),
        ({"laws__return": {"scca": [0.5, 0.5, 0.0, 0.0]}}, "GL404", "warn", "within phase return"),
        ({"limits": {"jerk_step": 1.0}}, "GL407", "warn", "step of the swing's jerk .rad/rad.3.: 5.167"),
        ({"spring": {"torque": 250.0}}, "GL406", "fail", "increase spring.torque .10 % speed margin"),
        ({"spring": {"torque": 300.0}}, "GL406", "warn", "10 % speed margin"),
        ({"spring": {"torque": 400.0, "reserve": 120.0}}, "GL406", "fail", "required 407.6 N m, spring 400 N m"),
    ],
    ids=lambda value: str(value)[:40],
)
def test_findings_say_what_to_change(changes: dict, code: str, status: str, words: str) -> None:
    made = machine(**changes)
    names = [name for name in rules()[code].checks if name in made.outline("gripper").checks]
    found = [check for name in names for check in made.check(name)]
    bad = [check for check in found if check.status == status]
    assert bad, found
    assert any(re.search(words, "; ".join(check.lines)) for check in bad), bad


@pytest.mark.parametrize("limit", mostly_slow([30.0, 26.0, 45.0], 1))
def test_the_centre_that_is_recommended_keeps_the_limit(limit: float) -> None:
    """It is named where it was tried alone: the centre that keeps the limit may lead a cam into its shaft."""
    design = machine(cam__center=[150.0, 0.0], limits={"pressure_angle": limit})
    check = next(c for c in design.findings("gripper", "pressure-angle") if c.status == "fail")
    assert not re.search(r"\[[-0-9.]+, [-0-9.]+\]", check.message)
    assert [key for key, _ in check.remedy] == ["cam.center[0]", "cam.center[1]"]
    repaired = machine(cam__center=[value for _, value in check.remedy], limits={"pressure_angle": limit})
    assert all(c.status != "fail" for c in repaired.check("pressure-angle"))


@pytest.mark.slow
def test_a_turn_of_the_output_is_named_where_the_cams_stand_it() -> None:
    """By how much it must be turned for the angles alone was said before, and left a cam refused."""
    design = machine(output_direction=150.0)
    check = next(c for c in design.findings("gripper", "transmission-angle") if c.status == "fail")
    assert not re.search(r"output_direction by", check.message)
    assert check.remedy
    after = type(design)(changed(design.spec, check.remedy))
    after.require("cam")
    assert all(c.status != "fail" for c in after.check("transmission-angle"))


@pytest.mark.slow
def test_the_recommended_centre_of_the_mirrored_machine_is_the_mirrored_centre() -> None:
    assert abs(mirrored().cams.center_for(28.0) - DESIGN.cams.center_for(28.0).conjugate()) <= 1e-10


@pytest.mark.parametrize("direction", [24.4, 23.9])
def test_near_a_dead_point_the_report_tells_what_remains(direction: float) -> None:
    design = machine(output_direction=direction, limits={"transmission_angle": 0.0})
    check = design.check("conditioning")[0]
    assert (check.code, check.status) == ("GL312", "warn")
    assert check.value > 100.0
    assert "condition number of the loop" in check.message
    turn, _ = clear_turn(design.motion.linkage, math.radians(10.0))
    assert turn is not None
    repaired = machine(output_direction=direction + math.degrees(turn), limits={"transmission_angle": 0.0})
    assert repaired.check("conditioning")[0].status == "pass"


def test_a_change_point_linkage_warns() -> None:
    # A parallelogram of the pivots' distance.
    frame = abs(complex(498.0, 55.0) - 230.0)
    design = machine(links={"input": 100.0, "coupler": frame, "output": 100.0})
    check = design.check("conditioning")[0]
    assert check.status == "warn"
    assert "distance of the swing from the change point of the linkage" in check.message


@pytest.mark.parametrize("stated", [40.0, 36.0, 45.0])
def test_the_constant_phase_that_is_recommended_gives_the_swing(stated: float) -> None:
    with pytest.raises(NoSolution) as refused:
        _ = machine(total_swing=stated).law
    change = float(str(refused.value).split("phases.constant by ")[1].split()[0])
    repaired = machine(
        phases__constant=12.0 + change, phases__near_dwell=70.0 - change, total_swing=stated, handover=101.0
    )
    assert math.degrees(repaired.law.total_swing) == pytest.approx(stated, rel=0.0, abs=1e-6)
    length = float(re.search(r"arm\.length to (\S+),", str(refused.value))[1])
    longer = machine(arm__length=length, total_swing=stated)
    assert math.degrees(longer.law.total_swing) == pytest.approx(stated, rel=0.0, abs=1e-6)


def test_kappa_that_is_recommended_gives_the_swing() -> None:
    with pytest.raises(NoSolution) as refused:
        _ = machine(total_swing=40.0).law
    kappa = float(str(refused.value).split("{quintic: ")[1].split("}")[0])
    swing = machine(total_swing=40.0, laws__accelerate={"quintic": kappa}).total_swing
    assert math.degrees(swing) == pytest.approx(40.0, rel=1e-9)  # as many digits of kappa are printed


def test_a_cam_over_the_pivot_of_its_rocker_is_warned_of() -> None:
    """The roller, on an arm at more than a right angle, comes farther from the cam's axis than the pivot."""
    roller, back = {"arm": 155.3, "angle": 21.6, "radius": 20}, {"arm": 131.2, "angle": 154.9, "radius": 20}
    made = factory.design(
        "swing_gripper", cam={"center": [30, -32.7], "sense": 1, "roller": roller, "return_roller": back}
    )
    main, other = made.check("shaft-clearance")
    pivot = abs(complex(*made.spec.pivots.input) - complex(30, -32.7))
    reach = made.cams.discs[0].radius(np.linspace(0.0, 2.0 * math.pi, 2001)).max()
    assert (main.status, other.status) == ("warn", "warn")
    assert "overlap of the main cam and the cam rocker's axis" in main.message
    assert main.value == pytest.approx(pivot - reach, abs=1e-3)
    assert not [check for check in DESIGN.check("shaft-clearance") if "axis" in check.message]
