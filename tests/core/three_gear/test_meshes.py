"""Profile shift, measures and backlash of the meshes of a three-gear drive.

Tolerances
* a mesh against the gear pair of the same data: 1e-12, since that is given its tips as diameters.
* links off the teeth's own distances against the closed forms where the shifts cancel: 1e-9 rad, the roots' own.
* a small shift against twice as small a one: the first order within 1 %.
"""

import math
import re
from itertools import pairwise

import pytest
from factory import design
from pydantic import ValidationError

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.dwell import ByRoots
from gearlink.core.machines.three_gear.register import ThreeGearSamples
from gearlink.core.parts.gears.data import PLACES
from gearlink.core.parts.gears.train.meshed import TRAIN_QUANTITIES

GEARS = {"module": 2.5, "crank": 24, "idler": 28, "output": 60}
DRAWN = {
    "tool": {"rounding": 0.3},
    "face_width": [22.0, 20.0, 24.0],
    "allowances": {"upper": [-0.05, -0.06, -0.07], "lower": [-0.08, -0.1, -0.12]},
    "center_distance_allowance": 0.015,
    "pin_diameter": [4.5, 4.5, 5.0],
}
BASE = {"kind": "three-gear-four-bar", "gears": GEARS, "links": {"crank": 18.0, "frame": 130.0}}


DWELLING = {"crank": 20, "idler": 20, "output": 60}


def flat(value):
    if isinstance(value, (tuple, list)):
        return [one for each in value for one in flat(each)]
    return [-1.0 if value is None else value]


def drive(command="analyze", **gears):
    return design(BASE | {"gears": GEARS | gears}, command=command)


@pytest.mark.parametrize("mesh", [0, 1])
@pytest.mark.parametrize("shift", [[0.0, 0.0, 0.0], [0.3, -0.1, 0.2]])
def test_a_mesh_is_the_gear_pair_of_the_same_data(mesh, shift):
    made = drive(profile_shift=shift, **DRAWN)
    places = (mesh, mesh + 1)
    tips = [2.0 * made.raw(("crank_idler", "idler_output")[mesh] + ".tip_radius")[i] for i in (0, 1)]
    alone = design(
        {
            "kind": "gear-pair",
            "module": 2.5,
            "teeth": [(24, 28, 60)[i] for i in places],
            "profile_shift": [shift[i] for i in places],
            "tip_diameter": tips,
            "tool": DRAWN["tool"],
            "face_width": [DRAWN["face_width"][i] for i in places],
            "allowances": {key: [values[i] for i in places] for key, values in DRAWN["allowances"].items()},
            "center_distance_allowance": 0.015,
            "pin_diameter": [DRAWN["pin_diameter"][i] for i in places],
        }
    )
    prefix = ("crank_idler.", "idler_output.")[mesh]
    names = [name.removeprefix(prefix) for name in made.quantity_names() if name.startswith(prefix)]
    for name in (name for name in names if name in alone.quantity_names() and name != "tip_shortening"):
        assert flat(made.raw(prefix + name)) == pytest.approx(flat(alone.raw(name)), rel=1e-12, abs=1e-13), name
    assert "span_measurement" in names
    assert "backlash_normal" in names


def test_gears_in_two_meshes_have_one_tip():
    made = drive(profile_shift=[0.4, 0.3, -0.1])
    first, second = made.raw("crank_idler.tip_radius"), made.raw("idler_output.tip_radius")
    assert first[1] == second[0]
    for clearance in (*made.raw("crank_idler.tip_clearance"), *made.raw("idler_output.tip_clearance")):
        assert clearance >= 0.25 * 2.5 - 1e-12


def test_links_are_the_centre_distances_of_the_shifted_gears():
    made = drive(profile_shift=[0.2, 0.15, 0.1])
    assert made.linkage.coupler == made.raw("crank_idler.center_distance") > 65.0
    assert made.linkage.rocker == made.raw("idler_output.center_distance") > 110.0


def test_shifts_that_cancel_leave_every_motion():
    made, plain = drive(profile_shift=[0.2, -0.2, 0.2], **DWELLING), drive(**DWELLING)
    for name in ("coupler_length", "speed_ratio_max", "dwell_crank_angles", "dwell_angle", "back_step_angle"):
        assert made.raw(name) == plain.raw(name), name
    assert made.raw("gear_gap") == pytest.approx(plain.raw("gear_gap") - 2 * 0.2 * 2.5, abs=1e-12)


def test_roots_against_the_closed_forms():
    plain = drive(**DWELLING)
    roots = ByRoots(plain.linkage, plain.train)
    assert len(roots.places) == 2
    assert roots.places == pytest.approx(plain.dwell_crank_angles, abs=1e-9)
    assert roots.dwell_angle == pytest.approx(plain.dwell_angle, abs=1e-9)


def test_motion_of_shifted_gears_tends_to_that_of_plain_ones():
    plain = drive(**DWELLING)
    steps = [
        drive(profile_shift=[x, x, x], **DWELLING).raw("dwell_angle") - plain.raw("dwell_angle")
        for x in (4e-4, 2e-4, 1e-4)
    ]
    for coarse, fine in pairwise(steps):
        assert coarse / fine == pytest.approx(2.0, rel=1e-2)


def test_analyze_asks_nothing_of_the_meshes_drawing():
    made = drive(**DRAWN)
    made.report("analyze")
    assert "mesh_data" not in vars(made)


def test_drawing_has_a_table_for_each_mesh():
    table = drive(profile_shift=[0.3, -0.1, 0.2], **DRAWN).table("drawing")
    rows = list(zip(table.data[0], table.data[1], table.data[3], strict=True))
    assert ("idler_output", "number of teeth", 28) in rows
    assert ("crank_idler", "profile shift", 0.3) in rows


def test_negative_backlash_fails_for_its_mesh():
    found = drive(allowances={"upper": [0.0, 0.1, -0.3], "lower": [-0.01, 0.05, -0.4]}).check("backlash")
    assert [(check.status, check.message.split()[0]) for check in found] == [
        ("fail", "crank-idler"),
        ("pass", "idler-output"),
    ]


def test_a_synthesis_needs_shifts_that_cancel():
    with pytest.raises(NoSolution, match="add up to 0") as refusal:
        design(
            {
                "kind": "three-gear-four-bar",
                "gears": GEARS | {"profile_shift": [0.1, 0.1, 0.0]},
                "dwell": {"angle": 90},
            },
            command="synth dwell",
        )
    assert refusal.value.key == "gears.profile_shift"


@pytest.mark.parametrize(
    "keys",
    [
        {"profile_shift": [0.1, 0.1]},
        {"pin_diameter": [4.5] * 4},
        {"allowances": {"series": ["25cd", "25cd"]}},
        {"allowances": {"upper": [0, 0, 0], "lower": [0, 0]}},
        {"allowances": {"upper": [0, 0, -1], "lower": [0, 0, 0]}},
        {"allowances": {}},
        {"cutter": {"teeth": 25}},
        {"assembly": "radial"},
        {"helix_hand": ["right", "left", "right"]},
        {"helix_hand": ["right", "left", "left"], "helix_angle": 10},
        {"load": {"torque": 10, "gear": "planet"}},
        {"material": {"bending_limit": [400, 400]}},
    ],
)
def test_refusals(keys):
    with pytest.raises(ValidationError):
        drive(**keys)


def test_load_of_shifted_gears_rolls_on_their_working_circles():
    made = drive(profile_shift=[0.3, 0.2, 0.1])
    pair = made.mesh_data["crank_idler"].pair
    assert sum(pair.working_radius) == pytest.approx(made.coupler_length, rel=1e-14)
    assert math.cos(pair.working_pressure_angle) == pytest.approx(
        65.0 * math.cos(math.radians(20)) / made.coupler_length, rel=1e-12
    )


def test_names_are_those_of_a_gear_pair_without_its_rating():
    assert set(TRAIN_QUANTITIES) < set(PLACES)
    assert not [name for name in PLACES.keys() - set(TRAIN_QUANTITIES) if "backlash" in name or "limits" in name]


@pytest.mark.parametrize("keys", [{"helix_angle": 10.0}, {"profile_shift": [0.1, 0.1, 0.0]}])
def test_tolerances_know_spur_gears_whose_shifts_cancel(keys):
    with pytest.raises(NoSolution) as refusal:
        ThreeGearSamples(drive(**keys))
    assert refusal.value.key == f"gears.{next(iter(keys))}"


@pytest.mark.parametrize("angle", [14.5, 20.0, 25.0])
def test_the_teeth_that_the_fix_names_are_the_fewest_without_undercut(angle):
    def found(teeth):
        made = design(
            {
                "kind": "three-gear-four-bar",
                "gears": {"module": 2, "crank": teeth, "idler": 40, "output": 60, "pressure_angle": angle},
                "links": {"crank": 18.0, "frame": 110.0},
            },
            command="analyze",
        )
        return made.check("undercut")[0]

    named = int(re.search(r"use at least (\d+) teeth", found(9).fix)[1])
    assert found(named - 1).status == "warn"
    assert found(named).status == "pass"
