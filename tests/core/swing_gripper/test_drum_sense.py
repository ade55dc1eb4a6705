"""A cam on the shaft of the cylinder that takes the sheet turns it: against the gripper's swing, or GL503 fails.

Tolerance: velocities from central differences over 1e-4 deg have an error of about 1e-7 of the speed.
"""

from __future__ import annotations

from typing import Any

import factory
import numpy as np
import pytest

STEP = 1e-4


def coaxial(swing_sense: int, cam_sense: int, off: complex = 0j, **keys: Any) -> Any:
    """The gripper with the cam on the drum's shaft; the senses of the swing are each other's mirror images."""
    mirrored = {
        "swing_sense": 1,
        "assembly": -1,
        "arm__direction": -125.0,
        "output_direction": -110.0,
        "pivots__output": [498.0, -55.0],
        "cam__roller__angle": -49.0,
        "cam__return_roller__angle": -88.0,
    }
    data = factory.changed(factory.worked("swing_gripper"), **(mirrored if swing_sense > 0 else {}))
    drum = factory.design(data).handover_center
    return factory.changed(data, cam__center=[drum.real + off.real, drum.imag + off.imag], cam__sense=cam_sense, **keys)


def velocities(made: Any) -> tuple[complex, complex]:
    """Of tip and drum surface by the cylinder angle at the handover [mm/deg], the drum turning with the cam."""
    degrees = made.spec.handover + STEP * np.array([-1.0, 0.0, 1.0])
    tip = made.moving.at(np.radians(degrees), 0).links["output"].at("F").value
    drum = made.handover_center
    turn = np.exp(1j * made.spec.cam.sense * np.radians([-STEP, STEP]))
    surface = drum + (tip[1] - drum) * turn
    return complex(tip[2] - tip[0]) / (2.0 * STEP), complex(surface[1] - surface[0]) / (2.0 * STEP)


@pytest.mark.parametrize("swing_sense", [1, -1])
@pytest.mark.parametrize("cam_sense", [1, -1])
def test_the_drum_runs_with_the_tip_or_gl503_fails(swing_sense: int, cam_sense: int) -> None:
    made = factory.design(coaxial(swing_sense, cam_sense))
    tip, surface = velocities(made)
    check = made.check("handover")[0]
    same = abs(tip - surface) < 1e-5 * abs(tip)
    assert same == (cam_sense == -swing_sense) == (check.status == "pass")
    if not same:
        assert abs(tip + surface) < 1e-5 * abs(tip)
        assert check.value == pytest.approx(abs(tip - surface) / abs(surface), rel=1e-5)
        assert "speed difference of gripper and cylinder at the handover" in check.message
        assert "cam.sense" in check.fix


def test_a_file_that_gives_the_axis_is_judged_alike_and_a_cam_beside_it_is_none_of_it() -> None:
    data = coaxial(-1, -1)
    center = data["cam"]["center"]
    assert factory.design(data, cylinder__center=center).check("handover")[0].status == "fail"
    rounded = [round(x, 2) for x in center]
    assert factory.design(data, cylinder__center=rounded).check("handover")[0].status == "fail"
    assert factory.design(coaxial(-1, -1, off=90.0 + 0j)).check("handover")[0].status == "pass"
    assert factory.design(data, cam=None, spring=None).check("handover")[0].status == "pass"
