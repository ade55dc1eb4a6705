"""Tools with a protuberance: the involute begins where the corner of the protuberance, rolled along, last cuts it.

* against the tool itself, rolled over a fine grid of positions: nothing of the involute is cut 4e-4 m above the form
  circle, and it is cut as far below it; the grid steps by 3e-5 m of roll.
* more of a tool leaves less of an involute: exact but for rounding.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from factory import design

from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.pair_sweep import RackCutRoots
from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile, half_tooth
from gearlink.core.parts.gears.tooth.root_fillet import RackCutRoot
from gearlink.core.parts.gears.tooth.tools import RackTool

DEPTH = 4e-4


def root(teeth: int, shift: float, undercut: float, angle: float = 20.0, helix: float = 0.0) -> RackCutRoot:
    tool = RackTool(addendum=1.4, rounding=0.2, residual_undercut=undercut)
    angles = {"pressure_angle": math.radians(angle), "helix_angle": math.radians(helix)}
    return RackCutRoot(teeth=teeth, shift=shift, tool=tool, **angles)


def cuts(gear: RackCutRoot, radius: float) -> bool:
    """Whether the tool comes over the involute at a radius, in any of its positions."""
    alpha, tool, cosine = gear.pressure_angle, gear.tool, math.cos(gear.helix_angle)
    r, across = gear.teeth / 2.0 / cosine, math.tan(alpha) / cosine
    base = r * math.cos(math.atan(across))
    half = (math.pi / 2.0 - 2.0 * gear.shift * math.tan(alpha)) / gear.teeth
    at = half - (across - math.atan(across)) + math.tan(math.acos(base / radius)) - math.acos(base / radius)
    turned = np.arange(-8.0, 8.0, 3e-5) / r
    wide = np.abs(radius * np.sin(at + turned) - r * turned) * cosine
    deep = gear.shift + r - radius * np.cos(at + turned)
    corner = tool.addendum - tool.rounding * (1.0 - math.sin(alpha))
    center = math.pi / 4.0 - tool.addendum * math.tan(alpha) + tool.residual_undercut / math.cos(alpha)
    center -= tool.rounding * (1.0 - math.sin(alpha)) / math.cos(alpha)
    reach = np.sqrt(np.maximum(tool.rounding**2 - (deep - tool.addendum + tool.rounding) ** 2, 0.0))
    tip = (corner <= deep) & (deep < tool.addendum) & (wide < center + reach)
    flank = (deep < corner) & (wide < math.pi / 4.0 - deep * math.tan(alpha) - 1e-9)
    return bool((tip | flank).any())


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("teeth", "shift", "undercut", "angle", "helix"),
    [
        (22, 0.2, 0.02, 20.0, 0.0),
        (17, 0.0, 0.005, 20.0, 0.0),
        (12, -0.2, 0.05, 20.0, 0.0),
        (17, 1.0, 0.1, 20.0, 0.0),
        (60, 0.3, 0.1, 14.5, 30.0),
        (25, 0.1, 0.002, 20.0, 15.0),
        # The corner lies a little below the pitch line, on it, above it: the other side of its path cuts deeper.
        (22, 1.26, 0.03, 20.0, 0.0),
        (22, 1.2684040286651338, 0.01, 20.0, 15.0),
        (40, 1.35, 0.03, 20.0, 0.0),
    ],
)
def test_the_form_circle_is_where_the_rolled_tool_last_cuts(
    teeth: int, shift: float, undercut: float, angle: float, helix: float
) -> None:
    gear = root(teeth, shift, undercut, angle, helix)
    assert cuts(gear, gear.form_radius - DEPTH)
    assert not cuts(gear, gear.form_radius + DEPTH)


@pytest.mark.parametrize(("teeth", "shift"), [(12, -0.4), (17, 0.1), (17, 0.9), (80, 0.0)])
def test_a_larger_protuberance_leaves_less_involute(teeth: int, shift: float) -> None:
    radii = [root(teeth, shift, undercut).form_radius for undercut in (0.0, 1e-6, 0.001, 0.01, 0.03, 0.1)]
    assert all(one < other for one, other in pairwise(radii))
    assert radii[1] - radii[0] < 0.01  # a small one changes little: the width of its cut goes with its root


def test_many_gears_at_once_have_the_same_form_circles() -> None:
    shifts = np.linspace(-0.6, 1.4, 21)
    alone = [root(17, float(shift), 0.03).form_radius for shift in shifts]
    many = RackCutRoots(teeth=17, shift=shifts, tool=root(17, 0.0, 0.03).tool)  # type: ignore[arg-type]
    assert many.form_radius == pytest.approx(alone, rel=1e-13)


@pytest.mark.parametrize("shift", [0.2, 1.26, 1.35])
def test_the_drawn_tooth_goes_on_from_its_fillet_to_its_flank(shift: float) -> None:
    pair = GearPair(module=1.0, teeth=(22, 55), given_shift=(shift, 0.1), tools=(root(22, shift, 0.02).tool, None))
    profile = ToothProfile.of(pair, 0)
    _, (fillet, low, high), (flank, start, _), _ = profile.pieces()
    ends = fillet(np.array([low, high])), flank(np.array([start]))
    assert abs(ends[0][1] - ends[1][0]) < 1e-12
    assert abs(ends[1][0]) == pytest.approx(profile.form_radius, rel=1e-14)
    points = half_tooth(profile, 1e-4)
    assert np.all(np.diff(np.abs(points)) > -1e-9)


def test_contact_on_what_a_protuberance_cut_away_is_found() -> None:
    spec: dict[str, Any] = {"kind": "gear-pair", "module": 4, "teeth": [22, 55], "profile_shift": [0.2, 0.1]}
    tool = {"addendum": 1.4, "rounding": 0.39}
    found = {}
    for undercut in (0.0, 0.02):
        made = design(spec | {"tool": tool | {"residual_undercut": undercut}})
        found[undercut] = next(check for check in made.check("fillet-interference") if "gear 1" in check.message)
    assert [found[undercut].status for undercut in (0.0, 0.02)] == ["pass", "fail"]
    assert "start of contact at the root of gear 1" in found[0.02].message
