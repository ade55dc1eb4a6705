"""A ring as its pinion cutter leaves it, against the cutter itself rolled through every position.

The cutter is made here from first principles: an involute tooth whose tip corner is an arc of the given radius, tangent
to flank and tip circle. A point lies on the cut outline if the deepest that any position of the cutter reaches past it
is nothing. Tolerance 2e-6 mm: the scan's step of 2e-4 rad leaves half its square times the radius, 60 mm; a sharp
corner of the cutter passes within a whole step, 2e-4 mm.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from factory import design

from gearlink.cli.export import parts
from gearlink.cli.export.contour import contour
from gearlink.cli.export.options import CurveForm
from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.outline.ring_profile import RingProfile

DEEP, SHARP = 2e-6, 2e-4
DATA = {"kind": "gear-pair", "module": 2, "teeth": [21, -67], "profile_shift": [0.3, -0.3]}
CUTTERS: list[dict[str, Any]] = [
    {"cutter": {"teeth": 25, "shift": 0.1, "addendum": 1.25, "rounding": 0.25}},
    {"cutter": {"teeth": 40, "shift": -0.05, "addendum": 1.25, "rounding": 0.1}, "profile_shift": [0.3, 0.2]},
    {"cutter": {"teeth": 18, "shift": 0.0, "addendum": 1.2, "rounding": 0.0}},
    {"cutter": {"teeth": 25, "shift": 0.2, "addendum": 1.25, "rounding": 0.3}, "helix_angle": 20},
    # The pitch point of the last cut lies beyond the rounding's centre, beyond the tip, beyond a sharp tip.
    {"cutter": {"teeth": 43, "shift": 0.2, "addendum": 0.9, "rounding": 0.25}, "profile_shift": [0.8, -0.8]},
    {"cutter": {"teeth": 50, "shift": 0.1, "addendum": 1.25, "rounding": 0.2}, "profile_shift": [0.9, -0.9]},
    {"cutter": {"teeth": 50, "shift": 0.1, "addendum": 1.25, "rounding": 0.0}, "profile_shift": [0.9, -1.2]},
]


def inv(angle: Any) -> Any:
    return np.tan(angle) - angle


class Cutter:
    """The cutter's tooth about the x axis of its own frame, and its roll in the ring [mm]."""

    def __init__(self, made: Any) -> None:
        pair, given = made.gear_pair, made.spec.cutter
        self.ring, self.teeth = abs(pair.teeth[1]), given.teeth
        module, alpha_t = pair.module, pair.transverse_pressure_angle
        transverse = module / math.cos(pair.helix_angle)
        self.base = transverse * given.teeth / 2.0 * math.cos(alpha_t)
        self.tip = transverse * given.teeth / 2.0 + module * (given.addendum + given.shift)
        at_reference = (math.pi / 2.0 + 2.0 * given.shift * math.tan(pair.pressure_angle)) / given.teeth
        self.half = at_reference + inv(alpha_t)  # angle of the tooth's half on the base circle
        self.rounding = module * given.rounding
        self.corner = self.tip - self.rounding
        roll = math.sqrt((self.corner / self.base) ** 2 - 1.0)
        self.beside = self.half - (roll - math.atan(roll)) - self.rounding / self.base
        self.flank_end = math.atan(roll + self.rounding / self.base)  # pressure angle where the rounding begins
        # the centre distance from the two thicknesses and the spaces on the rolling circles, by bisection
        shift2, z = pair.profile_shift[1], self.ring

        def gap(working: float) -> float:
            thick = self.half - inv(working)
            tooth = (math.pi / 2.0 + 2.0 * shift2 * math.tan(pair.pressure_angle)) / z - inv(alpha_t) + inv(working)
            return given.teeth * thick + z * tooth - math.pi

        low, high = 1e-3, 1.2
        for _ in range(200):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if gap(middle) < 0.0 else (low, middle)
        base_ring = transverse * z / 2.0 * math.cos(alpha_t)
        self.distance = (base_ring - self.base) / math.cos(low)

    def reaches(self, points: Any, turns: Any) -> Any:
        """How deep each point (of the ring, its x axis in the middle of a space) lies in the cutter's tooth."""
        axis = turns * self.teeth / self.ring
        seen = points[:, None] * np.exp(1j * axis) - self.distance  # about the cutter's axis
        seen = seen * np.exp(-1j * turns)
        radius, angle = np.abs(seen), np.abs(np.angle(seen))
        pressure = np.arccos(np.minimum(1.0, self.base / radius))
        flank = (self.half - inv(pressure) - angle) * self.base  # along the common normal: the difference of strings
        deep = np.minimum(flank, self.tip - radius)
        center = self.corner * np.exp(1j * self.beside)
        away = radius * np.exp(1j * angle) - center
        # the arc's sector, between the normal of the flank's end and the radius through its centre
        outward = np.exp(1j * (math.pi / 2.0 + self.half - math.tan(self.flank_end)))
        in_sector = (np.angle(away / np.exp(1j * self.beside)) >= 0.0) & (np.angle(away / outward) <= 0.0)
        return np.where(in_sector, self.rounding - np.abs(away), deep)


@pytest.mark.quick(2)
@pytest.mark.parametrize("keys", CUTTERS)
def test_the_outline_is_the_envelope_of_the_rolling_cutter(keys: dict[str, Any]) -> None:
    made = design(DATA | keys, command="gear")
    cutter, turns = Cutter(made), np.linspace(-0.9, 0.9, 9001)
    assert cutter.tip + cutter.distance == pytest.approx(abs(made.gear_pair.root_radius[1]), rel=1e-12)
    for name, curve, low, high in RingProfile(made.gear_pair).pieces():
        if name == "tip circle" or high <= low:
            continue
        deepest = cutter.reaches(curve(np.linspace(low, high, 9)), turns).max(axis=1)
        sharp = SHARP if made.spec.cutter.rounding == 0.0 else DEEP
        assert np.abs(deepest).max() < sharp, (name, deepest)


def test_a_rounding_whose_centre_is_the_pitch_point_leaves_its_own_arc() -> None:
    made = design(DATA | {"cutter": {"teeth": 25, "addendum": 0.25, "rounding": 0.25}, "profile_shift": [0, 0]})
    shaped = made.gear_pair.shaped
    assert shaped is not None
    assert shaped.turns[1] == pytest.approx(shaped.turns[0], abs=1e-12)
    assert abs(shaped.fillet(shaped.turns[0])) == pytest.approx(shaped.root_radius, rel=1e-12)


@pytest.mark.parametrize("form", list(CurveForm))
def test_what_is_exported_is_what_is_cut(form: CurveForm) -> None:
    made = design(DATA | CUTTERS[0], command="gear")
    exported = contour(parts.makers(made)["gear2"](), 1e-3, form)
    nodes = np.concatenate([piece.nodes[0] for piece in exported.pieces if piece.stretch.name != "tip circle"])
    nodes = nodes[nodes.imag >= 0.0]
    deepest = Cutter(made).reaches(nodes[::3], np.linspace(-0.9, 0.9, 9001)).max(axis=1)
    assert np.abs(deepest).max() < DEEP
    assert {"fillet", "involute"} <= {piece.stretch.name for piece in exported.pieces}
    drawn = RingProfile(made.gear_pair).outline(24)
    assert np.abs(drawn).max() == pytest.approx(abs(made.gear_pair.root_radius[1]), rel=1e-12)


def test_where_the_cutter_has_no_involute_for_the_tips_of_the_ring() -> None:
    """Deepest cut at the flank's outer end: none while the cutter's base tangent point lies short of the tip."""
    keys = {"teeth": [22, -79], "profile_shift": [0.1, 0.1], "cutter": {"teeth": 19, "rounding": 0.2}}
    cutter = design(DATA | keys).gear_pair.shaped.mesh
    ring, angle = abs(cutter.base_radius[1]), cutter.working_pressure_angle
    end = math.hypot(ring, -cutter.center_distance * math.sin(angle))  # the string there ends on the cutter's base
    for beyond, status in ((-1e-6, "fail"), (1e-6, "pass")):
        made = design(DATA | keys | {"tip_diameter": [48.0, 2.0 * (end + beyond)]}, command="gear")
        found = [each for each in made.check("involute-interference") if "its cutter" in each.message]
        assert [each.status for each in found] == ["fail"] * (status == "fail")
        assert all(each.code == "GL204" and each.value < 0.0 for each in found)
    ring_flank = {name: (curve, low, high) for name, curve, low, high in RingProfile(made.gear_pair).pieces()}
    curve, low, high = ring_flank["involute"]
    deepest = Cutter(made).reaches(curve(np.linspace(low, high, 9)), np.linspace(-0.9, 0.9, 9001)).max(axis=1)
    assert np.abs(deepest).max() < DEEP


def test_without_its_cutter_a_ring_has_sharp_corners_and_flanks_that_may_meet() -> None:
    sharp = RingProfile(design(DATA, command="gear").gear_pair)
    assert [name for name, *_ in sharp.pieces()] == ["root circle", "involute", "tip circle"]
    assert sharp.deepest == sharp.root
    wide = RingProfile(design(DATA | {"profile_shift": [0, 0], "addendum": 1.4, "clearance": 1.0}).gear_pair)
    assert wide.deepest < wide.root
    (_, flank, start, _) = wide.pieces()[1]
    assert np.angle(flank(np.array([start])))[0] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"rounding": 1.0}, r"limit <= 0\.3728 modules"),
        ({"shift": 2.0}, "pointed: reduce its addendum"),
        ({"addendum": 0.1, "shift": -2.0}, "without an involute: increase its addendum"),
        ({"teeth": 66, "shift": 0.4}, r"shifts of cutter and ring: 0\.\d+ \(limit <= 0\.\d+: .*reduce cutter\.shift"),
    ],
)
def test_cutters_that_cannot_be(keys: dict[str, float], words: str) -> None:
    with pytest.raises(NoSolution, match=words):
        _ = design(DATA | {"cutter": {"teeth": 25} | keys}, command="gear").gear_pair.root_radius


def test_the_greatest_rounding_fits() -> None:
    full = design(DATA | {"cutter": {"teeth": 25, "rounding": 0.3728}}, command="gear")
    cutter = Cutter(full)
    assert 0.0 <= cutter.beside < 2e-4
    assert "root circle" in [name for name, *_ in RingProfile(full.gear_pair).pieces()]
