"""A planet in its ring, standard teeth.

Tolerances: the contact ratio against the path of contact measured between the two tip circles on the line of action,
1e-12 relative (differences of lengths of the order of the radii). The limits of tip fouling are the well known ones of
handbooks: whole numbers of teeth. Turning the pinion step by step tells only the sign of the tips' room: overlap beyond
1e-9 rad (a touch at the end of the contact is 0 to rounding).
"""

import math

import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.ring_cutter import InternalInterference
from gearlink.core.parts.gears.tooth.involute import involute


def ring_mesh(module, pinion, ring):
    return GearPair.from_shift(module, (pinion, -ring))


def fouling(mesh):
    return InternalInterference(mesh).tip_fouling_margin


@pytest.mark.parametrize("teeth", [(20, 60), (48, 62), (36, 90), (25, 80)])
def test_contact_ratio_from_the_path_of_contact(teeth):
    mesh = ring_mesh(2.5, *teeth)
    alpha = mesh.pressure_angle
    # distances from the pinion's base tangent point, along the line of action
    end = math.sqrt(mesh.tip_radius[0] ** 2 - mesh.base_radius[0] ** 2)
    start = math.sqrt(mesh.tip_radius[1] ** 2 - mesh.base_radius[1] ** 2) + mesh.center_distance * math.sin(alpha)
    pitch = math.pi * 2.5 * math.cos(alpha)
    assert mesh.contact_ratio == pytest.approx((end - start) / pitch, rel=1e-12)
    assert mesh.interference_margin[1] == pytest.approx(start, rel=1e-12)


def test_module_scales_lengths_alone():
    small, large = ring_mesh(1.0, 30, 50), ring_mesh(4.0, 30, 50)
    assert large.contact_ratio == pytest.approx(small.contact_ratio, rel=1e-14)
    assert fouling(large) == pytest.approx(4.0 * fouling(small), rel=1e-12)


@pytest.mark.parametrize("pinion", [35, 40, 60])
def test_tips_come_free_at_seven_to_nine_teeth_more(pinion):
    margins = [fouling(ring_mesh(1.0, pinion, pinion + more)) for more in range(3, 15)]
    assert margins == sorted(margins)
    first_free = next(i for i, margin in enumerate(margins, start=3) if margin >= 0.0)
    assert 7 <= first_free <= 9


def least_corner_gap(mesh, steps=6000):
    """Minimum angle between the pinion's tip corner and the ring's flank as the pinion turns, where the two overlap.

    Ring's axis at 0, pinion's at the centre distance; the flanks touch at the pitch point at turn 0 and lean forward
    outwards, so that the pinion's tooth lies ahead of them and a corner behind the ring's flank is inside its tooth.
    """
    a1, (z1, z2) = mesh.tip_radius[0], map(abs, mesh.teeth)
    a2, b2, distance = -mesh.tip_radius[1], -mesh.base_radius[1], -mesh.center_distance
    inv_alpha = involute(mesh.pressure_angle)
    corner = involute(mesh.tip_pressure_angle[0]) - inv_alpha
    worst = math.inf
    for i in range(-steps, steps):
        turn = math.pi * i / steps
        x, y = distance + a1 * math.cos(turn + corner), a1 * math.sin(turn + corner)
        radius = math.hypot(x, y)
        if radius >= a2:
            flank = turn * z1 / z2 + involute(math.acos(b2 / radius)) - inv_alpha
            worst = min(worst, math.atan2(y, x) - flank)
    return worst


@pytest.mark.quick(2)
@pytest.mark.parametrize("teeth", [(40, 45), (40, 46), (40, 50), (60, 64), (60, 70), (35, 70)])
def test_tip_fouling_by_turning_the_pinion(teeth):
    mesh = ring_mesh(1.0, *teeth)
    assert (least_corner_gap(mesh) < -1e-9) == (fouling(mesh) < 0.0)


def test_small_rings_are_refused():
    with pytest.raises(NoSolution, match="at least 34 teeth"):
        _ = ring_mesh(1.0, 17, 33).contact_ratio
    with pytest.raises(NoSolution, match="more teeth"):
        ring_mesh(1.0, 20, 20)
    with pytest.raises(NoSolution, match="module"):
        ring_mesh(0.0, 20, 40)
