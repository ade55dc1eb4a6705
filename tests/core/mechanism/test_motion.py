"""What a motion keeps, and what it makes only where it is looked at."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.mechanism import working_stroke
from gearlink.core.mechanism import vectors
from gearlink.core.mechanism.links import Later
from gearlink.core.mechanism.motion import Motion
from tests import factory


def test_joints_are_made_when_looked_at_and_once() -> None:
    made: list[int] = []

    def joints() -> list[str]:
        made.append(1)
        return ["A", "B"]

    later = Later(joints)
    assert not made
    assert [*later] == ["A", "B"]
    assert len(later) == 2
    assert made == [1]


def test_a_press_moves_whatever_its_cams_are(monkeypatch: pytest.MonkeyPatch) -> None:
    design = factory.design("ty460")
    pair = type(design.cams)

    def none(_self: object) -> float:
        raise NoSolution("no base circle")

    monkeypatch.setattr(pair, "base_radius", property(none))
    moved = design.moving.at(np.linspace(0.1, 6.0, 5))
    assert moved.links["bed"].origin.order == 2
    with pytest.raises(NoSolution, match="no base circle"):
        len(moved.connections)


def test_a_working_stroke_is_that_of_the_cams() -> None:
    design = factory.design("wide_swing_slider_cam")
    stroke, whole = working_stroke(design), design.moving
    phi = np.linspace(0.02, 0.98, 40) * design.motion.cycle_angle
    for one, other in zip(stroke.outputs, whole.outputs, strict=True):
        alone, guided = one.course.rates(stroke, phi, 2), other.course.rates(whole, phi, 2)
        size = np.abs(guided[0]).max()
        assert alone[0] - alone[0][0] == pytest.approx(guided[0] - guided[0][0], abs=1e-12 * size)
        assert alone[1] == pytest.approx(guided[1], abs=1e-11 * size)


@pytest.mark.slow
def test_several_threads_may_ask_at_once() -> None:
    motion: Motion = factory.design("slider_crank_tolerances").moving
    inputs = [np.array([0.001 * k]) for k in range(2000)]
    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(lambda q: motion.at(q).links["slider"].origin.value[0], inputs))
    wanted = [motion.anew().at(q).links["slider"].origin.value[0] for q in inputs]
    assert np.array(found) == pytest.approx(np.array(wanted), rel=1e-15)


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("name", "pins", "quantities"),
    [
        ("hypocycloid_slider", "F", ("min_transmission_angle",)),
        ("ty460", "CMF", ("min_transmission_angle_bed", "min_transmission_angle_cylinder", "min_rod_angle")),
        ("swing_gripper", "DC", ("min_transmission_angle",)),
        ("five_bar_positions", "D", ("min_transmission_angle",)),
    ],
)
def test_transmission_angles_at_the_pins_reach_the_minimum_that_is_judged(
    name: str, pins: str, quantities: tuple[str, ...]
) -> None:
    """A smooth minimum, seen every 0.01 deg or so: 1e-6 rad; one at an end of the range is met."""
    design = factory.design(name)
    motion = design.moving
    q = np.linspace(motion.input.start, motion.input.end, 36001)
    links = motion.at(q, 1)
    found = vectors.transmission_angles(links, pins)
    assert motion.transmission.of(links)[0].tolist() == np.min([*found.values()], axis=0).tolist()
    owners = [design.motion if each == "min_rod_angle" else design for each in quantities]
    judged = np.concatenate(
        [np.atleast_1d(getattr(owner, each)) for owner, each in zip(owners, quantities, strict=True)]
    )
    assert [float(each.min()) for each in found.values()] == pytest.approx(judged, abs=1e-6)


def test_transmission_angles_of_a_wide_swing_are_those_of_its_drive_and_its_rod() -> None:
    design = factory.design("wide_swing_slider_drive")
    q = np.linspace(0.0, 2.0 * np.pi, 9001)
    found = vectors.transmission_angles(design.moving.at(q, 1), "CF")
    judged = design.motion.transmission_angles
    assert float(found["C"].min()) == pytest.approx(judged["drive"], abs=1e-6)
    assert float(found["F"].min()) == pytest.approx(judged["slider.rod"], abs=1e-6)
