"""What a motion keeps, and what it makes only where it is looked at."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.mechanism import working_stroke
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
