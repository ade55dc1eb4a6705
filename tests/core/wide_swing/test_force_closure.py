"""Contact force of a wide-swing roller, lift-off and reserve.

Tolerances: 1e-9 against a reference of 16 digits (the force keeps about 1e-13); 1e-8 against d'Alembert's equation from
differences of the profile at 40 digits, whose step leaves 1e-12 of the normal; remedies are applied as printed.
"""

from __future__ import annotations

import math
from typing import Any

import factory
import mpmath as mp
import numpy as np
import pytest
from oracles.unloading_limits import pendulum_stretch_ratio
from pydantic import ValidationError
from sweeps import ALL

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.spec_paths import replaced
from gearlink.core.machines.wide_swing.design import WideSwingDesign
from gearlink.core.machines.wide_swing.spec import WideSwingSpec

CAM = {"center_distance": 200.0, "roller_radius": 8.0}
DRIVE = {"crank": 60.0, "coupler": 180.0, "rocker": 96.0, "frame": 192.0}


def design(reserve: float = 0.0, residual: float = 0.0, **changes: Any) -> WideSwingDesign:
    unloader = {"type": "pneumatic", "pivot_ratio": 2.6, "arm": 120.0, "reserve": reserve, "residual": residual}
    data = {
        "kind": "wide-swing-cam",
        "layout": "twin-cam",
        "swing": 120.0,
        "cycle_angle": 100.0,
        "speed": 100.0,
        "inertia": 0.5,
        "unloader": unloader,
        "cam": CAM,
    } | changes
    return WideSwingDesign(WideSwingSpec.model_validate({k: v for k, v in data.items() if v is not None}))


def quantity(made: WideSwingDesign, name: str) -> Any:
    found = made.quantity(name)
    assert found is not None
    return found.value


def test_reference() -> None:
    made = design(reserve=0.3)
    table = made.table("contact", samples=20)
    k, force, share = (np.asarray(table.data[i]) for i in range(3))
    assert table.columns == ("k", "force", "speed_share")
    for place, want in ((0.0, 1243.5648644093399), (0.1, 1212.1811976584672), (0.25, 1107.7814201963222)):
        row = (np.abs(k - place) < 1e-9) & (np.abs(share - 0.9) < 1e-9)
        assert force[row] == pytest.approx(want, rel=1e-9)
    assert quantity(made, "lift_off_speed") == pytest.approx(114.0175425099138, rel=1e-14)
    assert made.quantity("lift_off_speed").unit == "1/min"  # type: ignore[union-attr]


def test_device_is_stronger_by_its_reserve() -> None:
    assert quantity(design(reserve=0.3), "force") == pytest.approx(1.3 * quantity(design(), "force"), rel=1e-15)


def _by_dalembert(layout: str, swing: float, cycle: float, k: float, rate: float, share: float) -> float:
    """Force of the profile on the roller [N], from mechanics at 40 digits and the rate of the spring [N/mm].

    A spring of free length zero makes the law a pendulum's. The rocker's acceleration less the torque of the device,
    from its geometry, is the moment of the contact; its lever is that of the profile's normal about the rocker's pivot,
    found by differences of the roller's path in the cam's frame.
    """
    with mp.workdps(40):
        gamma, phi_ud = mp.mpf(swing), mp.mpf(cycle)
        m = mp.sin(gamma / 4)
        quarter = mp.ellipk(m * m)
        outward = 1 if layout == "twin-cam" else -1
        arm = 200 / (4 * quarter * m / phi_ud + outward)

        def phi(at: Any) -> Any:
            return -2 * mp.asin(m * mp.ellipfun("sn", quarter * (1 - 2 * at), m=m * m))

        # fixed frame: rocker's pivot at 0, cam axis on the x axis; the roller's arm points to it, or away from it
        def roller(at: Any) -> Any:
            return outward * arm * mp.expj(phi(at))

        def in_cam(at: Any) -> Any:
            return (roller(at) - 200) * mp.expj(outward * (at - mp.mpf("0.5")) * phi_ud)

        at, step = mp.mpf(k), mp.mpf("1e-12")
        tangent = (in_cam(at + step) - in_cam(at - step)) / (2 * step)
        tangent *= mp.expj(-outward * (at - mp.mpf("0.5")) * phi_ud)
        normal = 1j * tangent / abs(tangent)
        # towards the roller from its body: the body is nearer to the cam axis outside it, or farther inside
        away = mp.re(normal * mp.conj(roller(at) - 200)) * outward
        normal = normal if away > 0 else -normal
        lever = mp.im(mp.conj(roller(at)) * normal)
        time = phi_ud / (100 * 2 * mp.pi / 60)
        acceleration = mp.diff(phi, at, 2) * share * share / time**2
        # force rate * length, lever arm * base * sin/length: the length falls out
        device = -mp.mpf(rate) * 60 * 180 * mp.sin(phi(at)) / 1000
        return float(1000 * (mp.mpf("0.5") * acceleration - device) / lever)


@pytest.mark.quick(8)
@pytest.mark.parametrize(("layout", "swing", "cycle"), [("twin-cam", 120.0, 100.0), ("twin-rocker", 150.0, 60.0)])
@pytest.mark.parametrize("k", [0.0625, 0.25, 0.4375, 0.75])
@pytest.mark.parametrize(("reserve", "share"), [(0.3, 1.0), (0.3, 0.5), (0.0, 0.9), (0.1, 1.2)])
def test_force_by_dalembert(layout: str, swing: float, cycle: float, k: float, reserve: float, share: float) -> None:
    """Positive where the profile presses the roller, in run-up and run-out, external and internal."""
    stretch = pendulum_stretch_ratio(3.0, math.radians(swing))
    unloader = {"type": "spring", "pivot_ratio": 3.0, "stretch_ratio": stretch, "arm": 60.0, "reserve": reserve}
    made = design(layout=layout, swing=swing, cycle_angle=cycle, unloader=unloader, cam=CAM | {"roller_radius": 2.0})
    found = float(made.unloading.contact_force(made.cam, np.array([k]), share)[0])
    rate = quantity(made, "spring_rate")
    force = _by_dalembert(layout, math.radians(swing), math.radians(cycle), k, rate, share)
    assert found == pytest.approx(force, rel=1e-8)
    assert (found > 0.0) == (share * share < 1.0 + reserve)


def test_balance_leaves_no_force() -> None:
    assert quantity(design(), "contact_force") == 0.0
    # a tenth of the inertia torque: a tenth of the force that no device would leave
    without = design().unloading.contact_force(design().cam, np.array([0.2]), 0.0)
    reserved = design(reserve=0.1)
    assert reserved.unloading.contact_force(reserved.cam, np.array([0.2])) == pytest.approx(0.1 * without, rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("changes", [{}, {"layout": "twin-rocker", "swing": 150.0, "cycle_angle": 80.0}])
def test_greatest_force_is_that_of_the_table(changes: dict[str, Any]) -> None:
    made = design(reserve=0.3, **changes)
    rows = made.table("contact", samples=2000)
    table = dict(zip(rows.columns, rows.data, strict=True))
    at_design = np.abs(np.asarray(table["speed_share"]) - 1.0) < 1e-9
    forces = [np.asarray(table[name])[at_design] for name in ("force", "return_force") if name in table]
    largest = max(float(np.nanmax(force)) for force in forces)
    assert quantity(made, "contact_force") == pytest.approx(largest, rel=1e-5)
    assert quantity(made, "contact_force") >= largest * (1 - 1e-12)
    # empty where the roller does not touch the profile
    assert np.isnan(forces[0][np.abs(np.asarray(table["k"])[at_design] - 0.5) < 1e-9]).all()


def test_oscillating_cam_has_a_force_too() -> None:
    made = design(reserve=0.25, cycle_angle=None, drive=DRIVE)
    assert quantity(made, "contact_force") > 0.0
    assert len(made.check("force-reserve")) == 1


@pytest.mark.parametrize(
    ("reserve", "residual", "status"),
    [
        (0.0, 0.0, "warn"),
        (0.0, 1e-12, "warn"),
        (0.0, 1e-6, "fail"),
        (0.1, 0.0, "warn"),
        (0.21, 0.0, "pass"),
        (0.2, 0.22, "fail"),
        (0.22, 0.22, "warn"),
        (0.43, 0.22, "pass"),
    ],
)
def test_reserve_is_judged(reserve: float, residual: float, status: str) -> None:
    (check,) = design(reserve, residual).check("force-reserve")
    assert (check.code, check.status) == ("GL511", status)
    assert check.value == pytest.approx(100.0 * math.sqrt(1.0 + reserve - residual), rel=1e-14)
    if status != "pass":
        safe = float(check.fix.split("reserve to ")[1].split(" ")[0])
        assert safe == pytest.approx(0.21 + residual, rel=1e-3)
        assert design(safe, residual).check("force-reserve")[0].status == "pass"


def test_reserve_is_suggested() -> None:
    made = design(residual=0.22)
    (found,) = made.findings("swing", "force-reserve")
    assert found.remedy == (("unloader.reserve", 0.44),)
    assert WideSwingDesign(replaced(made.spec, *found.remedy[0])).check("force-reserve")[0].status == "pass"


def test_reserve_of_another_speed() -> None:
    """(n/n0)^2 - 1 + f: 0.69 holds the roller to 130 1/min."""
    assert quantity(design(reserve=0.69), "lift_off_speed") == pytest.approx(130.0, rel=1e-14)
    with pytest.raises(ValidationError, match="greater than or equal to 0"):
        design(reserve=-0.1)


def test_without_a_cam_no_roller_is_judged() -> None:
    made = design(cam=None)
    assert "force-reserve" not in made.outline("swing").checks
    with pytest.raises(NoSolution):
        made.table("contact")


@pytest.mark.slow
def test_return_cam_without_contact_is_a_finding_and_no_refusal() -> None:
    """The roller covers the external profile of this twin-rocker alone: GL402 and GL507 fail, the rest is shown."""
    rocker = {"layout": "twin-rocker", "swing": 150.0, "cycle_angle": 60.0}
    made = next(
        made
        for radius in range(10, 200, 5)
        if not (made := design(reserve=0.3, cam=CAM | {"roller_radius": float(radius)}, **rocker)).has_zone(
            made.return_cam  # type: ignore[arg-type]
        )
    )
    assert made.has_zone(made.cam)
    report = made.report("swing")
    assert {"contact_force", "transition_zone"} <= {each.name for each in report.quantities}
    failed = {check.code for check in report.checks if check.status == "fail" and "external" in check.message}
    assert {"GL402", "GL507"} <= failed


def test_a_roller_that_covers_the_profile_is_judged_in_silence() -> None:
    """Trials of smaller rollers had radii without bound at neighbouring samples, whose difference warned."""
    made = factory.design("wide_swing_cycle", command="swing", cam__roller_radius=76.2)
    every = (check for name in made.outline("swing").checks for check in made.check(name))
    failing = [check.name for check in (made.report("swing").checks if ALL else every) if check.status == "fail"]
    assert failing == ["cam-undercut", "transition-zone", "transition-zone"]
