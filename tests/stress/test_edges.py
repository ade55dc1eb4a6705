"""The edges of every family: change points, equal lengths, maximum strokes, tangencies, limits."""

from __future__ import annotations

import math

import numpy as np
import pytest
from oracles.unloading_limits import energy_parameter, invariants

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.machines.three_gear.momentary import momentary_frame_length, momentary_linkage
from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.machines.wide_swing.cam import WideSwingCam
from gearlink.core.machines.wide_swing.device import Pneumatic
from gearlink.core.machines.wide_swing.law import ElasticLaw
from gearlink.core.parts.cams.profile import profile, translating
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.tooth.involute import inverse_involute, involute
from gearlink.core.parts.linkages import slider_crank
from gearlink.core.parts.linkages.fourbar import position as fourbar
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.slider_crank import SliderCrank

EPS = 2.0**-52


@pytest.mark.parametrize(
    "lengths", [(40.0, 90.0, 40.0, 90.0), (90.0, 40.0, 90.0, 40.0), (1.0, 1.0, 1.0, 1.0), (20.0, 50.0, 40.0, 70.0)]
)
def test_change_points_are_known_and_solved_beside_the_fold(lengths: tuple[float, float, float, float]) -> None:
    linkage = FourBar(*lengths)
    assert linkage.kind() == "change-point"
    for phi in (0.5, 1.0, 2.5):
        state = fourbar.solve(linkage, phi, 1)
        a, b, c, d = lengths
        opening = a * np.exp(1j * phi) + b * np.exp(1j * state.coupler_angle) - d - c * np.exp(1j * state.rocker_angle)
        assert abs(opening) <= 16.0 * EPS * sum(lengths)


def test_links_in_line_have_no_rates() -> None:
    stretched = FourBar(10.0, 20.0, 30.0, 60.0)  # closes at crank angle 0 alone, fully stretched
    with pytest.raises(NoSolution):
        fourbar.solve(stretched, 0.0, 1)
    with pytest.raises(NoSolution):
        fourbar.solve(stretched, 0.5)


@pytest.mark.parametrize("less", [1e-1, 1e-4, 1e-8, 1e-12])
def test_strokes_up_to_the_greatest(less: float) -> None:
    """The stroke hardly depends on the crank there: what it gives back is exact to some ulp, up to the limit."""
    most = slider_crank.max_stroke(520.0, 50.0)
    stroke = most * (1.0 - less)
    crank = SliderCrank(stroke, 520.0, 50.0).crank_length
    far, near = math.sqrt((520.0 + crank) ** 2 - 2500.0), math.sqrt(max((520.0 - crank) ** 2 - 2500.0, 0.0))
    assert abs(far - near - stroke) <= 64.0 * EPS * stroke / math.sqrt(less) + 1e-5 * stroke * (less < 1e-9)
    with pytest.raises(NoSolution):
        SliderCrank(most * (1.0 + 1e-12), 520.0, 50.0)


@pytest.mark.parametrize(
    ("factor", "dwells"),
    [(1.0 - 1e-9, 0), (1.0 - 1e-12, 1), (1.0, 1), (1.0 + 1e-12, 1), (1.0 + 1e-9, 2)],
)
def test_dwells_beside_the_momentary_one(factor: float, dwells: int) -> None:
    """Frame d* (1 + x): shorter, there is no standstill; longer, there are two; within 1e-12 it is the momentary one,
    since the two are then 1e-6 rad apart and lie within what the rounded lengths leave open."""
    made = momentary_linkage(25.0, 25.0, 75.0, 16.0)
    frame = momentary_frame_length(25.0, 25.0, 75.0, 16.0) * factor
    linkage = FourBar(made.crank, made.coupler, made.rocker, frame, made.assembly)
    assert len(Output(linkage, GearTrain(25.0, 25.0, 75.0)).places) == dwells


@pytest.mark.parametrize("alpha", [1e-150, 1e-12, 1e-6, 1e-4, math.radians(45.0), 1.5])
def test_involutes_of_small_and_large_angles(alpha: float) -> None:
    """inv is inverted to 4 ulp of the angle times the condition tan^2 of the rounded involute, below a right angle."""
    v = involute(alpha)
    if v > 1e-300:
        condition = v / (alpha * math.tan(alpha) ** 2)
        assert abs(inverse_involute(v) - alpha) <= (4.0 + 4.0 * condition) * math.ulp(alpha)


@pytest.mark.parametrize("off", [-1e-9, -1e-13, 0.0, 1e-13, 1e-9])
def test_shifts_at_the_undercut_limit(off: float) -> None:
    limit = GearPair(module=1.0, teeth=(12, 40), given_shift=(0.3, 0.0)).min_shift_no_undercut[0]
    pair = GearPair(module=1.0, teeth=(12, 40), given_shift=(limit + off, 0.0))
    assert pair.min_shift_no_undercut[0] == limit
    assert abs((pair.profile_shift[0] - limit) - off) <= 4.0 * EPS


def test_rollers_at_the_curvature_limit_make_a_cusp() -> None:
    """rho_c = rho - r_g passes zero: the profile's speed falls to it linearly and has the digits of the difference."""
    theta = np.array([math.pi / 2])
    y, y1, y2 = 60.0 + 10.0 * np.cos(2 * theta), -20.0 * np.sin(2 * theta), -40.0 * np.cos(2 * theta)
    path = translating(y, y1, y2)
    rho = 1.0 / float(profile(theta, path, sense=1, roller_radius=1.0).curvature[0])
    for less in (1e-3, 1e-9, -1e-9):
        cam = profile(theta, path, sense=1, roller_radius=abs(rho) * (1.0 - less))
        assert math.isfinite(cam.profile[0].real)


@pytest.mark.parametrize("swing", [1e-8, 1e-3, 120.0, 299.999, 300.0])
def test_swings_from_1e_8_to_300_deg(swing: float) -> None:
    made = ElasticLaw(Pneumatic(2.5), math.radians(swing))
    assert 11.0 < made.energy_parameter * math.radians(swing) ** 2 < 80.0  # N gamma^2 tends to a constant
    s, v, _ = invariants(made, 0.25)
    assert 0.0 < s < 0.5
    assert v > 0.0


@pytest.mark.parametrize("ratio", [1.0 + 1e-2, 1.0 + 1e-6, 1.0 + 1e-9, 1e6])
def test_pivot_ratios_near_1_and_far_from_it(ratio: float) -> None:
    made = ElasticLaw(Pneumatic(ratio), math.radians(120.0))
    doubled = energy_parameter(made, 2 * made.clock.nodes)
    assert abs(doubled / made.energy_parameter - 1.0) <= 1e-12


def test_a_swing_that_is_no_swing_is_refused_with_the_least_one() -> None:
    law = ElasticLaw(Pneumatic(2.5), 1e-15)
    with pytest.raises(NoSolution, match="set swing to at least") as refusal:
        WideSwingCam("twin-cam", law, math.radians(120.0), 200.0, 8.0)
    assert refusal.value.key == "swing"
