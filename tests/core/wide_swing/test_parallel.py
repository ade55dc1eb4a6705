"""Twin cams on two parallel shafts.

Tolerances: 1e-12 for lengths by the law of cosines; 2 mm for the gap of contours against a brute search over points
of both, in steps of 3 deg.
"""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest
from pydantic import ValidationError
from scipy.interpolate import CubicSpline
from scipy.optimize import fsolve
from scipy.spatial import cKDTree

from gearlink.core.machines.wide_swing.design import WideSwingDesign
from gearlink.core.machines.wide_swing.mechanism import motion
from gearlink.core.machines.wide_swing.spec import WideSwingSpec
from gearlink.core.mechanism.joints import SharedContact
from gearlink.core.studies.register import MotionRegister

CYLINDER = {"type": "pneumatic", "pivot_ratio": 2.6, "arm": 120.0, "reserve": 0.24}
CAM = {"center_distance": 200.0, "roller_radius": 8.0, "shaft_radius": 25.0}
CYCLE = {"working": 120.0, "far_dwell": 60.0, "return": 120.0, "near_dwell": 60.0}


def design_of(direction: float = 110.0, other: float = 200.0, cam: dict[str, Any] | None = None, **more: Any) -> Any:
    data = {"kind": "wide-swing-cam", "layout": "twin-cam-parallel", "swing": 120.0, "speed": 100.0, "inertia": 0.5}
    section = CAM | {"second": {"direction": direction, "center_distance": other}} | (cam or {})
    spec = WideSwingSpec.model_validate(
        data | {"unloader": CYLINDER, "cam": section} | ({} if "cycle" in more else {"cycle_angle": 120.0}) | more
    )
    return WideSwingDesign(spec)


def test_lengths() -> None:
    shafts = design_of(110.0, 250.0).shafts
    psi = math.radians(110.0)
    expected = math.sqrt(200.0**2 + 250.0**2 - 2.0 * 200.0 * 250.0 * math.cos(psi))
    assert shafts.shaft_distance == pytest.approx(expected, rel=1e-12)
    first, second = shafts.cams
    assert second.rocker_radius == pytest.approx(1.25 * first.rocker_radius, rel=1e-12)
    assert second.max_radius == pytest.approx(1.25 * first.max_radius, rel=1e-12)
    assert design_of(110.0, 250.0).raw("rocker_radius") == [first.rocker_radius, second.rocker_radius]


@pytest.mark.parametrize(("direction", "planes", "status"), [(110.0, "separate", "pass"), (30.0, "separate", "fail")])
def test_clearance(direction: float, planes: str, status: str) -> None:
    (check,) = design_of(direction, cam={"planes": planes}).check("cam-clearance")
    assert check.status == status


@pytest.mark.quick(1)
@pytest.mark.parametrize("direction", [60.0, 109.0])
def test_gap_of_contours_that_turn_against_each_other(direction: float) -> None:
    design = design_of(direction, cycle=CYCLE, cam={"planes": "same"})
    shafts, whole = design.shafts, design.cycle
    near, far = shafts.shafts
    first, second = (np.concatenate([p for _, p in cam.outline(120)]) for cam in (whole.main, whole.back))
    apart, cuts = math.inf, False
    for turn in np.radians(np.arange(0.0, 360.0, 3.0)):
        one = near + first * np.exp(-1j * (turn - math.radians(60.0)))
        # the second cam's own stroke begins after working stroke and rest, mirrored, about the direction of its shaft
        two = far + far / abs(far) * np.conj(second * np.exp(-1j * (turn - math.radians(180.0 + 60.0))))
        nearest, _ = cKDTree(np.column_stack([two.real, two.imag])).query(np.column_stack([one.real, one.imag]))
        apart = min(apart, float(nearest.min()))
        cuts = cuts or bool(np.any(np.abs(one - far) < whole.back.least_radius))
    found = shafts._contour_gap
    # contours that cross come near each other, those that do not keep the gap
    assert (found < 0.0) == (cuts or apart < 1.0)
    if found >= 0.0:
        assert found == pytest.approx(apart, abs=2.0)
    elif not cuts:
        assert shafts.cam_gap - 0.5 <= found


def test_gears_between_the_shafts() -> None:
    design = design_of(gears={"module": 4.0})
    pair = design.shafts.gears
    assert 4.0 * pair.teeth[0] <= design.shafts.shaft_distance < 4.0 * (pair.teeth[0] + 1)
    assert pair.teeth[0] == pair.teeth[1]
    assert sum(design.raw("shaft_gears.profile_shift")) >= 0.0


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"layout": "twin-cam"}, "applies only to layout: twin-cam-parallel"),
        ({"cam": {"second": None}}, "second"),
    ],
)
def test_contradictions(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(ValidationError, match=words):
        design_of(**changes)


@pytest.mark.parametrize(("geared", "sign"), [(False, 1), (True, 1), (True, -1)])
def test_errors_of_the_second_shaft_by_a_displaced_cam(geared: bool, sign: int) -> None:
    """The second cam, set aside by an error and turned by what its gear then turns, with the roller on its curve."""
    names = ("cam.second.center_distance", "cam.second.direction", "links.return_roller_arm")
    sources = {name: {"plus_minus": 0.01} for name in names}
    more: dict[str, Any] = {"cycle": CYCLE, "output_radius": 250.0, "tolerance": {"sources": sources}}
    design = design_of(125.0, 190.0, **more | ({"gears": {"module": 5.0}} if geared else {}))
    phi = np.radians(np.arange(200.0, 230.0, 0.05))
    made = motion(design).make(phi, 2, 1)
    row, cam, rocker = 200, made.links["return_cam"], made.links["rocker"]
    (roller,) = (each for each in made.connections if each.name == "roller")
    assert isinstance(roller, SharedContact)
    curve = CubicSpline(phi, np.conj(cam.unit) * (roller.at - cam.origin.value))
    pivot, shaft = rocker.origin.value[0], cam.origin.value[0]
    arm, toward = roller.at[row] - pivot, (shaft - pivot) / 190.0

    def turned(flank: float, away: complex, longer: float) -> float:
        spin = 0.0
        if geared:  # the flank that carries keeps touching: its normal at the pitch point, and the way of that point
            normal = 1j * shaft / abs(shaft) * np.exp(1j * flank * design.shafts.gears.working_pressure_angle)
            spin = -(away * np.conj(normal)).real / (-0.5j * shaft * np.conj(normal)).real

        def apart(x: Any) -> list[float]:
            gap = shaft + away + cam.unit[row] * np.exp(1j * spin) * curve(x[0])
            gap = gap - pivot - arm * (1.0 + longer / abs(arm)) * np.exp(1j * x[1])
            return [gap.real, gap.imag]

        return float(fsolve(apart, [phi[row], 0.0], xtol=1e-13)[1])

    register: Any = MotionRegister(design.spec)
    found = {one.source: abs(float(one.gain[0])) for one in register.contributions(phi[row : row + 1], sign)}
    small, per_degree = 1e-3, 1j * math.radians(1.0) * (shaft - pivot)
    shifts = dict(zip(names, ((toward, 0.0), (per_degree, 0.0), (0.0, 1.0)), strict=True))
    ways = []
    for flank in (1.0, -1.0):
        gain = {
            name: 250.0
            * (turned(flank, small * way, small * long) - turned(flank, -small * way, -small * long))
            / (2.0 * small)
            for name, (way, long) in shifts.items()
        }
        ways.append(all(found[name] == pytest.approx(abs(each), rel=1e-5, abs=1e-9) for name, each in gain.items()))
    assert any(ways)  # one flank of the gear carries; which one is the sign of the torque


def test_the_cam_that_lacks_room_is_moved_from_its_own_shaft() -> None:
    """The second shaft stands too near; they named the distance of the first, which leaves the second cam as it is."""
    near = {"cam__second__center_distance": 40.0, "cam__roller_radius": 3.0}
    found = factory.design("wide_swing_parallel", **near).findings("swing", "shaft-clearance")
    (check,) = [each for each in found if each.status == "fail"]
    assert "return cam" in check.what
    ((key, value),) = check.remedy
    assert key == "cam.second.center_distance"
    apart = factory.design("wide_swing_parallel", **near | {"cam__second__center_distance": value})
    assert {each.status for each in apart.findings("swing", "shaft-clearance")} == {"pass"}
    (contour,) = [
        each for each in factory.design("wide_swing_parallel", **near).check("closed-contour") if each.status == "fail"
    ]
    assert contour.fix == "set a larger cam.second.center_distance"
