"""Tooth profile: involute, trochoidal root, undercut, chords.

Tolerances
* against a rack tool rolled over a fine grid of positions: 2e-7 module; the grid steps by 2e-4 rad of roll and leaves
  (r step)^2/(8 times the minimum radius of curvature, about 0.2 module) for the gears tried.
* closed forms (form radius, thickness): 64 ulp of the radius; the undercut's root is a bracketed one to the last bit.
* chords: the error asked for, and a tenth more, since middles of the parameter stand in for the farthest points.
"""

import itertools
import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile, half_tooth, outline, tooth_space
from gearlink.core.parts.gears.tooth.involute import involute
from gearlink.core.parts.gears.tooth.root_fillet import RackCutRoot
from gearlink.core.parts.gears.tooth.tools import RackTool

EPS = 2.0**-52
ALPHA = math.radians(20.0)


def profile(teeth, shift=0.0, module=1.0, alpha=ALPHA, addendum=1.0, clearance=0.25, rounding=None):
    full = (math.pi / 4 - (addendum + clearance) * math.tan(alpha)) * math.cos(alpha) / (1 - math.sin(alpha))
    rho = min(clearance / (1 - math.sin(alpha)), full) if rounding is None else rounding
    tool = RackTool(addendum=addendum + clearance, rounding=rho)
    cut = RackCutRoot(teeth=teeth, shift=shift, tool=tool, pressure_angle=alpha)
    return ToothProfile(cut=cut, module=module, tip_radius=module * (teeth / 2 + addendum + shift))


def outside_tool(gear, points, roll):
    """Distance [module] of points of the gear from the rack tool at rolls of the gear; negative: cut away."""
    r, alpha, rho = gear.cut.teeth / 2, gear.cut.pressure_angle, gear.cut.tool.rounding
    w = points[:, None] / gear.module * np.exp(1j * roll)[None, :]
    depth, lateral = r + gear.cut.shift - w.real, np.abs(w.imag - r * roll[None, :])
    floor = gear.cut.tool.addendum - rho
    corner = math.pi / 4 - floor * math.tan(alpha) - rho / math.cos(alpha)
    # the tool's tooth is what lies within rho of this trapezoid without lower end
    below, beside = depth - floor, lateral - corner
    along_flank = -below * math.cos(alpha) + beside * math.sin(alpha)
    from_flank = below * math.sin(alpha) + beside * math.cos(alpha)
    inside = np.maximum(below, from_flank)
    near_corner = np.hypot(below, beside)
    distance = np.where(
        inside <= 0,
        inside,
        np.where(along_flank >= 0, from_flank, np.where(beside <= 0, below, near_corner)),
    )
    return distance - rho


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("teeth", "shift"),
    [(12, 0.0), (17, 0.0), (18, 0.0), (8, 0.0), (7, 0.3), (40, 0.0), (30, 1.2), (40, -1.0), (9, 0.5)],
)
def test_tool_touches_every_point_and_cuts_none(teeth, shift):
    gear = profile(teeth, shift)
    points = half_tooth(gear, 1e-3)
    cut = points[np.abs(points) < gear.outer_radius * (1 - 1e-9)]
    distance = outside_tool(gear, cut, np.arange(-1.6, 1.6, 2e-4)).min(axis=1)
    assert np.abs(distance).max() < 2e-7 * max(1.0, teeth / 10) ** 2


@pytest.mark.quick(3)
@pytest.mark.parametrize("teeth", [5, 12, 17, 18, 25, 72, 300])
@pytest.mark.parametrize("shift", [-0.3, 0.0, 0.2, 0.6])
def test_undercut_begins_at_the_least_shift(teeth, shift):
    assert profile(teeth, shift).undercut == (shift < GearPair.from_shift(1.0, (teeth, 40)).min_shift_of(0))


@pytest.mark.parametrize("shift", [-0.3, 0.0, 0.2, 0.6])
def test_undercut_ends_at_the_minimum_number_of_teeth(shift):
    """The generated tooth of the next whole number has none, that of one tooth less has."""
    least = math.ceil(GearPair.from_shift(1.0, (17, 40), (shift, 0.0)).min_teeth_of(0))
    assert (profile(least - 1, shift).undercut, profile(least, shift).undercut) == (True, False)


@pytest.mark.parametrize(("teeth", "shift"), [(18, 0.0), (40, 0.0), (72, 0.3), (25, -0.2)])
def test_form_radius_is_that_of_the_standard(teeth, shift):
    """DIN 3960: d_Ff^2 = (d sin(alpha) - 2 (h_Ff - x) m/sin(alpha))^2 + d_b^2, h_Ff the tool's straight flank."""
    gear = profile(teeth, shift, module=3.0)
    straight = gear.cut.tool.addendum - gear.cut.tool.rounding * (1 - math.sin(ALPHA))
    half = gear.reference_radius * math.sin(ALPHA) - (straight - shift) * 3.0 / math.sin(ALPHA)
    assert gear.form_radius == pytest.approx(math.hypot(half, gear.base_radius), rel=64 * EPS)


@pytest.mark.parametrize(("teeth", "shift"), [(12, 0.0), (40, 0.0), (72, 0.3), (10, 0.6)])
def test_thickness_on_the_reference_circle(teeth, shift):
    gear = profile(teeth, shift, module=2.0)
    r = gear.reference_radius
    flank = gear.flank(np.array([math.tan(ALPHA)]))[0]
    half_thickness = math.pi / teeth - math.atan2(flank.imag, flank.real)
    assert abs(flank) == pytest.approx(r, rel=8 * EPS)
    wanted = 2.0 * (math.pi / 2 + 2 * shift * math.tan(ALPHA)) / 2 / r
    assert half_thickness == pytest.approx(wanted, abs=16 * EPS)


def test_tip_thickness_is_the_pairs():
    pair = GearPair(module=4.0, teeth=(72, 72), given_distance=290.2912330746487)
    gear = ToothProfile.of(pair, 0)
    start = gear.pieces()[-1][1]
    assert 2 * gear.outer_radius * (math.pi / 72 - start) == pytest.approx(pair.tip_thickness[0], rel=1e-12)
    assert gear.root_radius == pytest.approx(pair.root_radius[0], rel=8 * EPS)


@given(
    st.integers(6, 200),
    st.floats(-0.8, 1.5),
    st.floats(math.radians(14.5), math.radians(28.0)),
    st.sampled_from([1e-6, 1.0, 1e6]),
)
@examples(150)
def test_pieces_join_without_gap_and_radii_never_fall(teeth, shift, alpha, module):
    try:
        gear = profile(teeth, shift, module, alpha)
    except NoSolution:
        assume(False)
    pieces = gear.pieces()
    for (curve, _, end), (following, start, _) in itertools.pairwise(pieces):
        gap = abs(curve(np.array([end]))[0] - following(np.array([start]))[0])
        # the roll angle is the square root of a small height above the base circle
        assert gap < 1e-13 * gear.tip_radius or (gear.undercut and gap < 2e-8 * module)
    points = half_tooth(gear, 1e-3 * module)
    assert np.diff(np.abs(points)).min() > -1e-13 * gear.tip_radius
    assert abs(np.angle(points[-1]) - math.pi / teeth) < 1e-14
    assert points[0].imag == 0.0


@given(st.integers(8, 120), st.floats(-0.2, 0.8), st.floats(0.01, 1000.0))
@examples(50)
def test_scale(teeth, shift, module):
    small, large = profile(teeth, shift), profile(teeth, shift, module)
    one, other = half_tooth(small, 1e-3), half_tooth(large, 1e-3 * module)
    assert len(one) == len(other)
    assert np.abs(one * module - other).max() < 64 * EPS * large.tip_radius


@pytest.mark.quick(2)
@pytest.mark.parametrize("error", [1e-2, 1e-3, 1e-4])
@pytest.mark.parametrize("teeth", [12, 40])
def test_chords_keep_their_error(teeth, error):
    gear = profile(teeth, module=5.0)
    fine, coarse = half_tooth(gear, error / 100), half_tooth(gear, error)
    chord = np.diff(coarse)
    along = (fine[:, None] - coarse[None, :-1]) * chord.conj() / np.abs(chord)
    beyond = np.maximum(np.maximum(-along.real, along.real - np.abs(chord)), 0.0)
    distance = np.hypot(along.imag, beyond).min(axis=1)
    assert 0.1 * error < distance.max() < 1.1 * error
    assert len(coarse) < len(fine)


def test_outline_is_closed_and_turned():
    gear = profile(17, 0.1, module=2.0)
    whole = outline(gear, 1e-2)
    assert whole[0] == whole[-1]
    assert np.abs(whole).max() == pytest.approx(gear.outer_radius, rel=4 * EPS)
    part = outline(gear, 1e-2, teeth=3, first=0.5)
    pitch = tooth_space(gear, 1e-2)
    assert len(part) == 3 * (len(pitch) - 1) + 1
    assert part[0] == pytest.approx(pitch[0] * np.exp(0.5j), rel=4 * EPS)
    area = 0.5 * float(np.sum(whole[:-1].real * whole[1:].imag - whole[:-1].imag * whole[1:].real))
    assert math.pi * gear.root_radius**2 < area < math.pi * gear.outer_radius**2


def test_meshing_teeth_touch_on_the_line_of_action_and_never_overlap():
    pair = GearPair.from_shift(3.0, (18, 31), (0.25, 0.1))
    gears = [ToothProfile.of(pair, i) for i in (0, 1)]
    flank_1, flank_2 = (half_tooth(gear, 1e-5) for gear in gears)
    # a tooth of gear 1 in the space of gear 2: both flanks touch where they stand symmetric to the line of centres
    tooth = (flank_1 * np.exp(-1j * math.pi / 18)).conj()
    space = pair.center_distance - flank_2[np.abs(flank_2) < gears[1].outer_radius * (1 - 1e-9)].conj()
    depth = np.interp(tooth.real, space.real[::-1], space.imag[::-1])
    inside = (tooth.real > space.real.min()) & (tooth.real < space.real.max())
    gap = (depth - tooth.imag)[inside]
    assert gap.min() > -3e-5
    assert gap.min() < 3e-5


def test_pointed_tooth_ends_where_the_flanks_meet():
    gear = profile(20, 2.5)
    half_pitch = math.pi / 20
    start = (math.pi / 2 - 5.0 * math.tan(ALPHA)) / 20 - involute(ALPHA)
    at_tip = math.acos(gear.base_radius / gear.outer_radius)
    assert gear.outer_radius < gear.tip_radius
    assert start + involute(at_tip) == pytest.approx(half_pitch, abs=1e-14)
    assert abs(np.angle(half_tooth(gear, 1e-3)[-1]) - half_pitch) < 1e-14


def test_sharp_and_full_round_tools():
    sharp = profile(40, rounding=0.0)
    assert len(half_tooth(sharp, 1e-3)) > 10
    alpha, depth = ALPHA, 1.25
    full = (math.pi / 4 - depth * math.tan(alpha)) * math.cos(alpha) / (1 - math.sin(alpha))
    assert len(half_tooth(profile(40, rounding=full), 1e-3)) > 10
    on_pitch_line = half_tooth(profile(40, 1.25, rounding=0.0), 1e-3)  # the tool's corner runs on the pitch line
    assert np.all(np.isfinite(on_pitch_line))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"teeth": 2}, "no root circle left; use at least 3 teeth"),
        ({"teeth": 20, "addendum": 2.5}, "pointed"),
        ({"teeth": 20, "rounding": 0.9}, "from 0 to 0.47"),
    ],
)
def test_failures_name_the_limit(arguments, words):
    with pytest.raises(NoSolution, match=words):
        profile(**arguments)


def test_a_gear_without_involute_is_refused():
    with pytest.raises(NoSolution, match=r"start of the involute of a gear of 12 teeth: .* increase"):
        ToothProfile(cut=RackCutRoot(teeth=12, shift=0.0, tool=RackTool()), module=1.0, tip_radius=5.65)
    with pytest.raises(NoSolution, match=r"start of the involute of a gear of 12 teeth: .* reduce"):
        profile(12, 4.0)
    # pushed apart, the tip shortened into the root: less shift is the way out
    with pytest.raises(NoSolution, match=r"start of the involute of a gear of 19 teeth: .* reduce"):
        ToothProfile.of(GearPair(module=3.0, teeth=(19, 47), given_distance=120.0), 0)


def test_chord_error_must_be_reachable():
    with pytest.raises(NoSolution, match="at least 1e-07 mm"):
        half_tooth(profile(20), 0.0)
