"""The bed with the lift of its cam: against the oracle in 40 digits, its own derivatives, loads, and dense grids.

Tolerances: travel and velocity against the oracle, 1e-12 of their peaks; acceleration 1e-10 of its own, that of the
oracle's differences. Derivatives by Gauss's rule, stretch by stretch: 1e-10 of the curves. Extremes against grids of
h: h^2/8 of the bend, 1e-6 of the range.
"""

from __future__ import annotations

import math
from typing import Any

import factory
import mpmath as mp
import numpy as np
import pytest
from oracles.press import TY460
from oracles.press_follower import lift

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.flatbed_press import mechanism

pytestmark = pytest.mark.usefixtures("forty_digits")

CAMS: dict[str, dict[str, Any]] = {
    "worked": {},
    "no lead-in": {"cam__lead_in": 0.0},
    "arc": {"cam__transition": "arc", "cam__lead_in": 0.0},
    "parabola": {"cam__transition": "parabola", "cam__return_law": "polynomial-345"},
    "speed step": {"sync__start": 50.0, "cam__transition_end": 145.0, "cam__lead_in": 0.0},
}
OMEGA = 4500.0 / 3600.0 * 2.0 * math.pi


def stretches(made: Any) -> Any:
    """Input angles of each stretch of the lift [rad], from end to end but for a hair."""
    for segment in made.follower.segments:
        start, end = (float(made.bed.input_angle(angle)) for angle in (segment.start, segment.end))
        yield segment, np.linspace(start + 1e-11, end - 1e-11, 4001)


@pytest.mark.slow
def test_bed_is_its_chain_less_the_lift() -> None:
    made = factory.design("ty460", cam__lead_in=12.0)
    phi = np.radians([10.0, 25.0, 60.0, 120.0, 157.0, 165.0, 200.0, 270.0, 330.0])

    def bed(angle: Any) -> Any:
        return TY460.p(angle) - lift(TY460.cam(angle), angle)

    found = made.bed_motion.travel(phi)
    for order, (column, share) in enumerate(zip(found, (1e-12, 1e-12, 1e-10), strict=True)):
        wanted = [float(mp.diff(bed, mp.mpf(angle), order, h=mp.mpf("1e-12"))) for angle in phi.tolist()]
        np.testing.assert_allclose(column, wanted, rtol=0.0, atol=share * np.abs(wanted).max())


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", CAMS)
def test_each_rate_is_the_derivative_of_the_one_before(name: str) -> None:
    made = factory.design("ty460", **CAMS[name])
    nodes, weights = np.polynomial.legendre.leggauss(12)
    for _, phi in stretches(made):
        edges = phi[::200]
        half = 0.5 * (edges[1:] - edges[:-1])
        inside = (0.5 * (edges[1:] + edges[:-1])[:, None] + half[:, None] * nodes).ravel()
        lower, upper = (mechanism.bed(made).rates(made.moving, at, 3) for at in (edges, inside))
        for before, rate in zip(lower, upper[1:], strict=False):
            scale = float(np.abs(rate).max()) + float(np.abs(before).max())
            grown = half * (rate.reshape(-1, 12) @ weights)
            np.testing.assert_allclose(np.diff(before), grown, rtol=0.0, atol=1e-10 * scale)


@pytest.mark.parametrize("name", CAMS)
def test_bed_goes_as_the_cylinder_in_the_zone(name: str) -> None:
    made = factory.design("ty460", **CAMS[name])
    phi = np.linspace(made.sync_start + 1e-9, made.sync_end - 1e-9, 100)  # at a step the side hangs on rounding
    bed, cylinder = made.bed_motion.travel(phi), made.cylinder.travel(phi, 2)
    np.testing.assert_allclose(np.ptp(bed.value - cylinder.value), 0.0, rtol=0.0, atol=1e-11)
    np.testing.assert_allclose(bed.first, cylinder.first, rtol=1e-12)
    np.testing.assert_allclose(bed.second, cylinder.second, rtol=0.0, atol=1e-11 * np.abs(cylinder.second).max())


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", CAMS)
def test_extremes_count_both_sides_of_every_joint(name: str) -> None:
    """By each stretch's own law, up to its very ends."""
    made = factory.design("ty460", **CAMS[name])
    rates: dict[str, list[Any]] = {"bed_velocity": [], "bed_acceleration": []}
    for segment, phi in stretches(made):
        cam, p = made.bed.cam_angle(phi, 2), made.bed.travel(phi, 2)
        theta = np.linspace(segment.start, segment.end, phi.size)
        theta[1:-1] = segment.start + np.mod(cam.value[1:-1] - segment.start, 2.0 * math.pi)
        s = segment.lift(theta, 2)
        rates["bed_velocity"].append(OMEGA * (p.first - s.first * cam.first))
        bend = s.second * cam.first**2 + s.first * cam.second
        rates["bed_acceleration"].append(OMEGA**2 * (p.second - bend))
    for curve, parts in rates.items():
        dense = np.concatenate(parts)
        for side, wanted in (("max", dense.max()), ("min", dense.min())):
            found = made.quantity(f"{curve}_{side}")
            assert found.value == pytest.approx(wanted, abs=1e-6 * np.ptp(dense)), (curve, side)
            place = math.radians(made.quantity(f"{curve}_{side}_at").value)
            order = 1 if curve == "bed_velocity" else 2
            beside = made.bed_motion.travel(np.array([place - 1e-9, place, place + 1e-9]))[order] * OMEGA**order
            assert np.abs(beside - found.value).min() < 1e-6 * np.ptp(dense)


def test_the_bed_of_the_loads_is_this_bed() -> None:
    """What accelerates the bed goes through the upper rack: m b'' without friction and other forces."""
    made = factory.design("loaded_press")
    least = made.quantity("bed_acceleration_min").value
    loads = factory.design("loaded_press", command="loads", loads__forces=[])
    force = loads.quantity("rack_upper.tooth_force_max").value  # along the rack
    assert 240.0 * abs(least) * 1e-3 == pytest.approx(force, rel=1e-9)
    assert least == pytest.approx(-33252.6, abs=0.05)


def test_without_a_cam_the_bed_is_its_chain() -> None:
    made = factory.design("ty460", cam=None)
    phi = np.linspace(0.0, 2.0 * math.pi, 20001)
    chain = made.bed.travel(phi, 2)
    for one, other in zip(made.bed_motion.travel(phi), chain, strict=True):
        np.testing.assert_allclose(one, other, rtol=0.0, atol=1e-12 * np.abs(other).max())
    assert made.bed_motion.joints == ()
    assert made.quantity("bed_acceleration_min").value == pytest.approx(OMEGA**2 * chain.second.min(), rel=1e-6)
    assert made.table("positions").columns[-1] == "transmission_angle_cylinder"


def test_positions_keep_the_chain_and_have_the_bed_besides() -> None:
    made = factory.design("ty460")
    table, bare = made.table("positions"), factory.design("ty460", cam=None).table("positions")
    assert table.columns == (*bare.columns, "compensated_displacement", "compensated_velocity")
    assert all(np.array_equal(table[name], bare[name]) for name in bare.columns)
    bed = made.bed_motion.travel(np.radians(table["input_angle"]))
    assert np.array_equal(table["compensated_displacement"], bed.value)
    assert np.array_equal(table["compensated_velocity"], bed.first * made.input_speed)
    chains = made.table("chains", samples=12)
    assert np.array_equal(chains["bed_velocity"], table["compensated_velocity"])
    assert np.array_equal(chains["bed_acceleration"], bed.second * made.input_speed**2)


@pytest.mark.slow
def test_of_a_bed_whose_cam_cannot_be_nothing_is_said() -> None:
    made = factory.design("ty460", cam__transition_end=100.0)
    assert not made.bed_moves
    assert "compensated_velocity" not in made.table("positions").columns
    assert not {"bed_velocity", "bed_acceleration"} & set(made.table("chains").columns)
    shown = {quantity.name for quantity in made.report("analyze").quantities}
    assert "cylinder_velocity_max" in shown
    assert not {name for name in shown if name.startswith(("bed_velocity", "bed_acceleration"))}
    with pytest.raises(NoSolution) as refused:
        made.quantity("bed_velocity_max")
    assert refused.value.key == "cam.transition_end"
