"""Standard teeth of a planet in its ring, inside machines: what the same teeth are told as a pair of gears.

Tolerances
* form radius and end of contact against the tip lines of rack and ring, cut with the line of action: 1e-9 relative.
* depth of a tip's corner in a fillet against the fillet as the envelope of its tool, 2000 places: 1e-4 modules.
"""

import math
import random

import factory
import numpy as np
import pytest

from gearlink.core.base.kinds import KINDS
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.train.meshed import MESH_CHECKS, mesh_checks

LIMITS = KINDS["gear-pair"].spec_model().model_validate(
    {"kind": "gear-pair", "module": 1, "teeth": [20, 30], "profile_shift": [0, 0]}
).limits  # fmt: skip


def found(name, planet, ring, degrees=20.0, module=1.0):
    return mesh_checks(name, GearPair.from_shift(module, (planet, -ring), pressure_angle=math.radians(degrees)), LIMITS)


def some():
    rng = random.Random(7)
    for _ in range(60):
        planet = rng.randint(6, 80)
        yield (
            planet,
            planet + rng.randint(8, 90),
            rng.choice([14.5, 17.5, 20.0, 22.5, 25.0, 28.0]),
            rng.choice([0.5, 3]),
        )


@pytest.mark.quick(20)
@pytest.mark.parametrize(("planet", "ring", "degrees", "module"), list(some()))
def test_thickness_and_fillet_are_those_of_the_pair(planet, ring, degrees, module):
    """The pair fails what the machine, whose file says nothing of its tools, is warned of."""
    keys = {"module": module, "teeth": [planet, -ring], "pressure_angle": degrees, "profile_shift": [0, 0]}
    mesh = GearPair.from_shift(module, (planet, -ring), pressure_angle=math.radians(degrees))
    if mesh.ring_tip_margin < 0.0:
        assert not found("tip-thickness", planet, ring, degrees, module)
        assert not found("ring-tips", planet, ring, degrees, module)
        return
    pair = factory.design({"kind": "gear-pair", **keys}, command="gear")
    own, theirs = found("tip-thickness", planet, ring, degrees, module), pair.check("tip-thickness")
    assert [(each.status, each.value) for each in own] == [(each.status, each.value) for each in theirs]
    (told, *_), (interference, *_) = (
        pair.check("fillet-interference"),
        found("involute-interference", planet, ring, degrees),
    )
    own = found("ring-tips", planet, ring, degrees, module)
    if interference.status == "fail":
        assert not own
    else:
        assert [each.value for each in own] == [told.value]
        assert {"warn": "fail"}.get(own[0].status, own[0].status) == told.status


def test_a_pointed_planet_fails_in_every_machine():
    two = {"kind": "two-gear-four-bar", "gears": {"module": 2, "planet": 9, "ring": 40, "pressure_angle": 30},
           "links": {"coupler": 90, "rocker": 100, "frame": 100}}  # fmt: skip
    checks = [check for check in factory.design(two).check("tip-thickness") if check.status == "fail"]
    assert ["the planet" in check.message for check in checks] == [True]
    assert checks[0].value < 0.25


@pytest.mark.parametrize(("planet", "ring"), [(48, 62), (25, 75), (36, 118), (60, 100), (30, 60)])
def test_fillet_by_the_tip_lines_and_by_the_rolled_tool(planet, ring):
    """Where rack and ring end on the line of action, and how deep the corner of the ring stands in the cut fillet."""
    (check,) = found("ring-tips", planet, ring)
    sine, base = math.sin(math.radians(20.0)), 0.5 * planet * math.cos(math.radians(20.0))
    form = math.hypot(base, 0.5 * planet * sine - 1.0 / sine)
    tip, ring_base = 0.5 * ring - 1.0, 0.5 * ring * math.cos(math.radians(20.0))
    used = math.hypot(base, math.sqrt(tip**2 - ring_base**2) - 0.5 * (ring - planet) * sine)
    assert check.value == pytest.approx(used - form, abs=1e-9 * form)
    assert check.status == "warn"
    assert 2e-3 < corner_in_fillet(planet, ring) < 2e-2


def corner_in_fillet(planet, ring):
    """Depth of the corner of a ring's tooth in the planet's root [modules], without backlash; both roll."""
    distance, tip, alpha = 0.5 * (ring - planet), 0.5 * ring - 1.0, math.radians(20.0)

    def involute(angle):
        return math.tan(angle) - angle

    space = 0.5 * math.pi / ring + involute(alpha) - involute(math.acos(0.5 * ring * math.cos(alpha) / tip))
    turn = np.linspace(-0.2, 0.2, 201) * 20.0 / ring
    corner = -1j * distance + tip * 1j * np.exp(-1j * (math.pi / ring - space + turn))
    inside = np.abs(corner) < 0.5 * planet - 0.2
    radius = np.abs(corner[inside])
    place = np.angle(1j / corner[inside]) - turn[inside] * ring / planet
    return float(((place - cut_space(radius, planet)) * radius).max())


def cut_space(radius, teeth):
    """Half the angle of the space that a standard rack tool leaves on circles [rad]: its farthest reach in rolling."""
    alpha, rounding = math.radians(20.0), 0.25 / (1.0 - math.sin(math.radians(20.0)))
    centre = 1.25 - rounding
    beside = 0.25 * math.pi - centre * math.tan(alpha) - rounding / math.cos(alpha)
    flank = np.linspace(-2.0, centre + rounding * math.sin(alpha), 1000)
    round_ = np.linspace(alpha, 0.5 * math.pi, 1000)
    depth = np.concatenate((flank, centre + rounding * np.sin(round_)))
    half = np.concatenate((0.25 * math.pi - flank * math.tan(alpha), beside + rounding * np.cos(round_)))
    cosine = (0.5 * teeth - depth) / radius[:, None]
    angle = np.arccos(np.where(np.abs(cosine) <= 1.0, cosine, np.nan))
    reach = [
        sign * angle - (radius[:, None] * np.sin(sign * angle) - half) / (0.5 * teeth) for sign in (1.0, -1.0)
    ]  # fmt: skip
    return np.nanmax(np.concatenate(reach, axis=1), axis=1)


def test_standard_spur_gears_beside_each_other_need_no_look():
    mesh = factory.design("candy_feed").meshes["crank_idler"]
    assert mesh_checks("ring-tips", mesh, LIMITS) == []
    assert "ring-tips" in MESH_CHECKS


def test_shifted_teeth_without_a_tool_are_judged_as_a_pair_is():
    """GL207 of a train asked for a tool: shifts alone bring the corners of tips into fillets too."""
    teeth = {"module": 1.0, "pressure_angle": 10.0, "profile_shift": [0.587, 0.427], "tip_shortening": "none"}
    rocker = {"kind": "geared-rocker", "gears": {"coupler": 32, "output": 63} | teeth,
              "links": {"crank": 15.0, "coupler": 60.0, "frame": 62.0}}  # fmt: skip
    pair = {"kind": "gear-pair", "teeth": [32, 63]} | teeth
    one, other = (factory.design(data, command="gear").check("fillet-interference") for data in (rocker, pair))
    assert [(check.status, check.value) for check in one] == [(check.status, check.value) for check in other]
    assert [check.status for check in one] == ["warn", "pass"]
