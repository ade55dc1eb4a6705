"""On which side of each other the parts of a press lie: by the work of a rolling pair, by hand, by its picture.

A pair of forces in the line in which bed and cylinder roll on each other, +F on the bed and -F on the cylinder, does no
work where both run the same way. Tolerances are 1e-12 of the maximum value of a course where both ways are exact; the
zone's compensation leaves 1e-9 of the speed.
"""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.cli.views.figures.flatbed_press import Machine, build
from gearlink.core.machines.flatbed_press.loads import PressLoads
from gearlink.core.mechanism.rates import cross

PRESS = "loaded_press"
DEFAULT = {"loads__bed_side": 1, "loads__gravity": [-9.81, 0], "loads__gear_1_direction": 92.5}
ECCENTRIC = {"mass": 5.0, "inertia": 0.2, "center": [12.0, -7.0]}
PHI = np.radians(np.arange(360.0))
RIGHT_ANGLE = math.tan(math.radians(20.0))


def _press(**keys: Any) -> PressLoads:
    design = factory.design(PRESS, command="loads", **keys)
    assert isinstance(design, PressLoads)
    return design


def _zone(press: PressLoads) -> Any:
    motion = press.design.motion
    return np.linspace(motion.sync_start, motion.sync_end, 90)[1:-1]


def _work_of_rolling(press: PressLoads, phi: Any) -> Any:
    """What +1 N on the bed and its opposite on the cylinder do by the input angle, and what that on the bed does."""
    links = press.machine.at(phi).links
    bed, cylinder = links["bed"], links["cylinder"]
    radius = press.spec.cylinder.radius
    arm = math.copysign(radius, (bed.origin.value - cylinder.origin.value).real[0])
    of_bed = bed.origin.first.imag
    return of_bed + cross(arm + 0j, -1j) * cylinder.turn.first, of_bed


# Bed and cylinder


def test_a_rolling_pair_does_no_work_where_the_cylinder_stands_as_it_is_drawn() -> None:
    press = _press()
    work, of_bed = _work_of_rolling(press, _zone(press))
    assert np.abs(work).max() <= 1e-9 * of_bed.max()


def test_in_the_frame_of_the_theory_they_slide_on_each_other() -> None:
    """On +x, where the bed would have its print, they meet with twice the speed of either."""
    press = _press(**DEFAULT, loads__cylinder_direction=40)
    work, of_bed = _work_of_rolling(press, _zone(press))
    assert work == pytest.approx(2.0 * of_bed, rel=1e-9)


def test_the_input_does_not_feel_a_rolling_pair() -> None:
    """The same through the forces of a file: 1000 N on the bed, and the couple of its opposite on the cylinder."""
    pair = [{"on": "bed", "force": 1000}, {"on": "cylinder", "torque": -140}]
    bare, rolled = _press(loads__forces=[]), _press(loads__forces=pair)
    phi = _zone(bare)
    one, other = bare.machine.torque(phi), rolled.machine.torque(phi)
    assert other == pytest.approx(one, abs=1e-9 * np.abs(one).max())
    found = rolled.machine.reactions(phi).torque
    assert found == pytest.approx(other, abs=1e-12 * np.abs(other).max())


# The picture


def test_all_joints_stand_where_the_picture_has_them() -> None:
    """The picture is turned by a right angle, its x the loads' y and its height their -x; to 1e-9 mm."""
    press = _press(loads__gear_1_direction=math.degrees(math.atan2(-290.0, -13.0)))
    drawn, links = Machine(press.design, PHI / (2.0 * math.pi)), press.machine.at(PHI).links
    four = press.design.bed.linkage, press.design.cylinder.linkage
    made = [
        links["gear2"].origin, links["BC"].origin, links["CDE"].at(four[0].rocker), links["CDE"].origin,
        links["EF"].origin, links["carriage"].origin, links["gear1"].origin, links["HM"].origin,
        links["MN"].at(four[1].rocker), links["MN"].origin,
    ]  # fmt: skip
    for point, joint in zip(made, (*drawn.bed_joints, *drawn.cylinder_joints), strict=True):
        assert point.value == pytest.approx(1j * joint, abs=1e-9)
    travel = links["bed"].origin.value.imag - links["bed"].origin.value.imag[0]
    (shown,) = (each.values for each in build(press.design, drawn.fraction).readouts if each.label == "bed")
    assert travel == pytest.approx(shown - shown[0], abs=1e-9)
    over, under = (links[name].origin.value.real - links["carriage"].origin.value.real for name in ("bed", "rack"))
    assert -over == pytest.approx(press.pinion_radius, rel=1e-12) == under
    n, axis = (complex(links[name].origin.value[0]) for name in ("MN", "cylinder"))
    upwards, picture = -1j * (axis - n), drawn.cylinder_axis - complex(drawn.cylinder_joints[3][0])
    assert upwards.real < 0.0 < upwards.imag
    assert picture.real < 0.0 < picture.imag


def test_the_pinion_rolls_between_its_racks_on_either_side() -> None:
    """Each rack has the speed of the pinion where it meets it."""
    for side in (1, -1):
        links = _press(loads__bed_side=side).machine.at(PHI).links
        pinion = links["pinion"]
        for name in ("rack", "bed"):
            arm = links[name].origin.value.real - pinion.origin.value.real
            met = pinion.origin.first + 1j * pinion.turn.first * arm
            assert met.imag == pytest.approx(links[name].origin.first.imag, abs=1e-11)


# Forces


def test_without_weight_the_whole_cylinder_chain_may_be_turned_round_gear_2() -> None:
    """Its pins turn with it, the teeth carry the same, and the bed's chain feels nothing of it."""
    keys = {"loads__gravity": [0, 0], "loads__links__gear2__center": None}
    drawn = _press(**keys, loads__gear_1_direction=-87.5, loads__cylinder_direction=-140)
    other = _press(**keys, loads__bed_side=1, loads__gear_1_direction=92.5, loads__cylinder_direction=40)
    one, two = (each.machine.reactions(PHI) for each in (drawn, other))
    assert one.torque == pytest.approx(two.torque, abs=1e-12 * np.abs(two.torque).max())
    for name in ("G", "H", "M", "N", "cylinder"):
        size = np.abs(two.force(name)).max()
        assert one.force(name) == pytest.approx(-two.force(name), abs=1e-12 * size)
    for name in ("B", "C", "D", "E", "F"):
        assert one.force(name) == pytest.approx(two.force(name), abs=1e-12 * np.abs(two.force(name)).max())
    for name in ("mesh_12", "mesh_34", "rack_lower", "rack_upper", "cam"):
        expected = two.unknowns[name][0]
        assert one.unknowns[name][0] == pytest.approx(expected, abs=1e-12 * np.abs(expected).max())
    pinion = two.force("F_pinion")
    assert one.force("F_pinion") == pytest.approx(-np.conj(pinion), abs=1e-12 * np.abs(pinion).max())
    assert drawn.power_identity <= 1e-12


@pytest.mark.parametrize("side", [1, -1])
def test_bed_pinion_and_carriage_by_hand(side: int) -> None:
    """Newton and Euler of each, from the places of the links by the input angle; x is the direction of the weight."""
    press = _press(loads__bed_side=side, loads__gravity=[3.0, 0.0])
    found, links = press.machine.reactions(PHI), press.machine.at(PHI).links
    square, r8, masses = press.speed**2, 1e-3 * press.pinion_radius, press.machine.masses
    travel = {name: 1e-3 * links[name].origin.second.imag * square for name in ("bed", "carriage")}
    resisted = -350.0 * np.sign(links["bed"].origin.first.imag)
    by_bed = resisted - masses["bed"].mass * travel["bed"]  # on the pinion, along +y
    spin = links["pinion"].turn.second * square
    by_rack = by_bed - side * masses["pinion"].inertia * spin / r8
    apart = {"upper": RIGHT_ANGLE * np.abs(by_bed), "lower": RIGHT_ANGLE * np.abs(by_rack)}
    moved = (masses["pinion"].mass + masses["carriage"].mass) * travel["carriage"]
    weight = 3.0 * masses["pinion"].mass
    size = np.abs(by_bed).max()

    def close(name: str, value: Any, part: int = 0) -> None:
        assert found.unknowns[name][part] == pytest.approx(value, abs=1e-10 * size), name

    close("rack_upper", -by_bed)
    close("rack_lower", -by_rack)
    close("F_pinion", side * (apart["upper"] - apart["lower"]) - weight)
    close("F", moved - by_bed - by_rack, 1)
    close("guide_bed", -side * apart["upper"] - 3.0 * masses["bed"].mass)
    from_bed = 1e-3 * (links["carriage"].origin.value - links["bed"].origin.value).imag
    close("guide_bed", side * apart["upper"] * from_bed, 1)
    pressed = found.unknowns["F"][0] - found.unknowns["F_pinion"][0] + 3.0 * masses["carriage"].mass
    close("guide_carriage", -pressed)


@pytest.mark.parametrize("side", [1, -1])
def test_both_torques_agree_with_parts_out_of_balance(side: int) -> None:
    links = {f"loads__links__{name}": ECCENTRIC for name in ("pinion", "cylinder", "gear1", "MN", "HM")}
    assert _press(loads__bed_side=side, **links).power_identity <= 1e-12
