"""The rocker on the way home of an oscillating cam, against its own motion by finite differences."""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.base.spec_paths import replaced
from gearlink.core.machines.wide_swing.design import WideSwingDesign
from gearlink.core.machines.wide_swing.oscillating_cam import greatest_need, need_home
from gearlink.core.machines.wide_swing.remedies import candidates

SHORT = {"drive__crank": 60.0, "drive__coupler": 180.0, "drive__frame": 192.0, "unloader__reserve": 0.25}


def made(**changes: Any) -> WideSwingDesign:
    design: WideSwingDesign = factory.design("wide_swing_oscillating_cam", command="swing", **{**SHORT, **changes})
    return design


def cam_at(spec: Any, crank: float) -> float:
    """Direction of the cam's rocker by complex numbers, the frame along x from the crank's pivot [rad]."""
    bar = spec.drive
    line = bar.frame - bar.crank * complex(math.cos(crank), math.sin(crank))
    along = (bar.coupler**2 - bar.rocker**2 + abs(line) ** 2) / (2.0 * abs(line))
    joint = line / abs(line) * complex(along, bar.assembly * math.sqrt(bar.coupler**2 - along**2))
    tip = joint - line
    return math.atan2(tip.imag, tip.real) % math.tau


def bisected(f: Any, low: float, high: float) -> float:
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if f(low) * f(middle) > 0.0 else (low, middle)
    return 0.5 * (low + high)


@pytest.mark.parametrize(("assembly", "way"), [(1, "outward"), (-1, "outward"), (1, "homeward")])
def test_acceleration_on_the_way_back(assembly: int, way: str) -> None:
    """The crank goes on evenly; the rocker stands where the cam, at the same angle, held it in the stroke."""
    design = made(drive__assembly=assembly, drive__stroke=way)
    cam, spec = design.oscillating_cam, design.spec
    begin, end = cam.drive.crank_angles
    span, h = end - begin, 2e-3

    def rocker(crank: float) -> float:
        """Rocker angle with the crank beyond the end of the stroke [rad]."""
        there = cam_at(spec, crank)
        k = bisected(lambda k: cam_at(spec, begin + k * span) - there, 0.0, 1.0)
        return float(cam.law.middle_view(np.array([k])).angle[0])

    for k in (0.1, 0.3, 0.62, 0.85):
        place = cam_at(spec, begin + k * span)
        crank = bisected(lambda crank, place=place: cam_at(spec, crank) - place, end, begin + math.tau)
        angles = [rocker(crank + step) for step in (-h, 0.0, h)]
        home = (angles[0] - 2.0 * angles[1] + angles[2]) / h**2
        forth = cam.law.swing * float(cam.law.middle_view(np.array([k])).acceleration[0]) / span**2
        assert float(need_home(cam, np.array([k]))[0]) == pytest.approx(home / forth, abs=2e-4)


def test_the_way_back_is_judged() -> None:
    """With a quarter in reserve the roller left its cam on the way home above 34 1/min; the design of 60 passed."""
    design = made()
    (check,) = design.check("force-reserve")
    early = np.linspace(0.001, design.oscillating_cam.contact[0][1], 1001)
    most = float(need_home(design.oscillating_cam, early).max())
    late = np.linspace(design.oscillating_cam.contact[1][0], 0.999, 1001)
    most = max(most, float(need_home(design.oscillating_cam, late).max()))
    assert (check.status, check.code) == ("fail", "GL511")
    assert check.value == pytest.approx(60.0 * math.sqrt(1.25 / most), rel=1e-4)
    assert check.value == pytest.approx(34.157, abs=1e-3)
    ((change,),) = candidates(design, "force-reserve")
    repaired = WideSwingDesign(replaced(design.spec, *change))
    assert repaired.check("force-reserve")[0].status == "pass"


def test_long_links_make_both_ways_alike() -> None:
    design = made(drive__crank=20.0, drive__coupler=2000.0, drive__frame=2001.0, cam__roller_radius=2.0)
    assert greatest_need(design.oscillating_cam).value == pytest.approx(1.0, abs=0.05)
    assert factory.design("wide_swing_oscillating_cam").check("force-reserve")[0].status == "pass"


def test_greatest_force_is_that_of_both_ways() -> None:
    """Where the rocker is slower on the way home the device presses the roller harder."""
    design = factory.design("wide_swing_oscillating_cam")
    cam = design.oscillating_cam
    grids = [np.linspace(low, high, 801)[1:-1] for low, high in cam.contact]
    forth = max(float(design.unloading.contact_force(cam, k).max()) for k in grids)
    inertia = [design.unloading.contact_force(cam, k, 0.0) / 1.7 for k in grids]  # device alone, less its reserve
    home = max(float((part * (1.7 - need_home(cam, k))).max()) for part, k in zip(inertia, grids, strict=True))
    assert home > 1.08 * forth
    assert design.contact_force == pytest.approx(home, rel=1e-4)


@pytest.mark.slow
def test_no_reserve_holds_a_roller_where_its_device_has_no_torque() -> None:
    """The quotient of both torques has its pole in contact, to either side of which it grows as 1/distance; the
    lift-off speed was the rounding of the place of that pole."""
    design = factory.design("wide_swing_slider_drive", command="swing", drive__rocker=384.0)
    middle = design.motion.slider.middle_place
    assert any(start < middle < end for start, end in design.oscillating_cam.contact)
    near, nearer = (need_home(design.oscillating_cam, np.array([middle + each]))[0] for each in (1e-4, 1e-6))
    assert nearer == pytest.approx(100.0 * near, rel=0.1)
    assert design.unloading.lift_off_speed == 0.0
    (check,) = design.check("force-reserve")
    assert (check.status, check.fix) == ("fail", "reduce slider.mass")
    assert "requires a force where the device has none) at k = 0.483 of the return stroke" in check.message
    assert next(iter(candidates(design, "force-reserve")), None) is None
    loads = factory.design("wide_swing_slider_drive", command="loads", drive__rocker=384.0)
    assert [each.fix for each in loads.check("contact-loss")] == ["reduce slider.mass"] * 2
