"""The unloading device as it is bought, and the one that is given.

Tolerances: 1e-12 relative where a closed form meets another route of few operations (energy identity, quotient of
torques, inverse); 1e-9 for a numerical integral of the force over the stroke by Gauss's rule.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.special import ellipk
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.design import WideSwingDesign
from gearlink.core.machines.wide_swing.device import Gravity, Pneumatic, Spring
from gearlink.core.machines.wide_swing.law import ElasticLaw, legacy_law
from gearlink.core.machines.wide_swing.slider import SliderDrive, SliderLaw
from gearlink.core.machines.wide_swing.spec import WideSwingSpec

CYLINDER = {"type": "pneumatic", "pivot_ratio": 2.6, "arm": 120.0}
SPRING = {"type": "spring", "pivot_ratio": 3.6, "stretch_ratio": 0.4, "arm": 60.0}
PENDULUM = {"type": "gravity", "distance": 120.0}
SLIDER = {"crank": 150.0, "rod": 450.0, "middle_angle": 80.0, "mass": 6.0}


def design_of(unloader: dict[str, Any], **more: Any) -> WideSwingDesign:
    data = {"kind": "wide-swing-cam", "layout": "twin-cam", "swing": 110.0, "cycle_angle": 130.0, "speed": 40.0}
    spec = WideSwingSpec.model_validate(data | {"inertia": 0.3, "unloader": unloader} | more)
    return WideSwingDesign(spec)


@pytest.mark.parametrize("slider", [None, SLIDER])
@pytest.mark.parametrize("unloader", [CYLINDER, SPRING])
def test_energy_and_torques_over_the_stroke(unloader: dict[str, Any], slider: dict[str, Any] | None) -> None:
    design = design_of(unloader | {"reserve": 0.3}, slider=slider)
    table = design.table("device")
    at = dict(zip(table.columns, np.array(table.data, dtype=float), strict=True))
    # stored energy and energy of motion, from lengths and from the law: their quotient is the reserve everywhere
    np.testing.assert_allclose(at["energy"], 1.3 * at["kinetic_energy"], rtol=1e-11, atol=1e-12)
    np.testing.assert_allclose(at["device_torque"], 1.3 * at["inertia_torque"], rtol=1e-10, atol=1e-9)
    size = design.unloading.size
    assert at["energy"].max() <= size.stored_energy * (1.0 + 1e-12)
    work = np.trapezoid(at["device_force"], at["device_length"])  # there and back: nothing is left
    assert work == pytest.approx(0.0, abs=1e-2 * 1e3 * size.stored_energy)


@pytest.mark.parametrize("unloader", [CYLINDER | {"reserve": 0.2}, SPRING | {"rate": 9.0}])
def test_stored_energy_is_the_work_of_the_torque(unloader: dict[str, Any]) -> None:
    size = design_of(unloader).unloading.size
    arm, base = unloader["arm"], size.base_distance

    def torque(phi: float) -> float:
        pin, foot = arm * np.exp(1j * phi), complex(base)
        away = foot - pin
        pull = size.strength * (1.0 if unloader["type"] == "pneumatic" else abs(away) - size.free_length)
        return abs((np.conj(pin) * pull * away / abs(away)).imag)

    work = quad(torque, 0.0, math.radians(55.0), epsabs=0.0, epsrel=1e-11)[0]
    assert 1e-3 * work == pytest.approx(size.stored_energy, rel=1e-9)


@given(reserve=st.floats(0.0, 3.0), ratio=st.floats(2.6, 8.0), arm=st.floats(20.0, 300.0))
@examples(20)
def test_a_given_device_has_the_reserve_that_sized_it(reserve: float, ratio: float, arm: float) -> None:
    for unloader, key in ((CYLINDER, "force"), (SPRING, "rate")):
        own = unloader | {"pivot_ratio": ratio, "arm": arm}
        sized = design_of(own | {"reserve": reserve}).unloading
        back = design_of(own | {key: sized.size.strength}).unloading
        assert back.size.reserve == pytest.approx(reserve, rel=1e-12, abs=1e-12)
        assert back.lift_off_speed == pytest.approx(sized.lift_off_speed, rel=1e-12)
    sized = design_of(PENDULUM | {"reserve": reserve}, speed=18.0, inertia=0.02)
    back = design_of(PENDULUM | {"mass": sized.unloading.size.mass}, speed=18.0, inertia=0.02)
    assert back.unloading.size.reserve == pytest.approx(reserve, rel=1e-12, abs=1e-12)


def test_balanced_speed_needs_no_reserve_of_this_device() -> None:
    speed = design_of(CYLINDER | {"force": 500.0}).unloading.size.balanced_speed
    there = design_of(CYLINDER | {"force": 500.0}, speed=speed).unloading
    assert there.size.reserve == pytest.approx(0.0, abs=1e-12)
    assert design_of(CYLINDER, speed=speed).unloading.force == pytest.approx(500.0, rel=1e-12)


def test_weak_device_lifts_off_below_the_design_speed() -> None:
    section = {"center_distance": 200.0, "roller_radius": 8.0, "shaft_radius": 25.0}
    design = design_of(CYLINDER | {"force": 60.0}, cam=section)
    assert design.unloading.size.reserve < 0.0
    (check,) = design.check("force-reserve")
    assert check.status == "fail"
    need = float(check.advice.split("unloader.force to ")[1].split()[0])
    (better,) = design_of(CYLINDER | {"force": need}, cam=section).check("force-reserve")
    assert better.status == "pass"


def test_cylinder_carries_its_force() -> None:
    size = design_of(
        CYLINDER | {"force": 1500.0, "pressure": 0.6, "rod_diameter": 20.0, "efficiency": 0.9}
    ).unloading.size
    for bore, pressure in ((size.bore, 0.6), (size.standard_bore, size.set_pressure)):
        assert bore is not None
        area = 0.25 * math.pi * (bore**2 - 20.0**2)
        assert 0.9 * pressure * area == pytest.approx(1500.0, rel=1e-12)
    assert design_of(CYLINDER | {"force": 2e5, "pressure": 0.6}).unloading.size.standard_bore is None


def test_reservoir() -> None:
    more = CYLINDER | {"force": 1200.0, "bore": 63.0}
    (check,) = design_of(more | {"reservoir": 2.0}).check("device-pressure")
    assert check.status == "warn"
    least = float(check.advice.split("reservoir to at least ")[1].split()[0])
    (better,) = design_of(more | {"reservoir": least}).check("device-pressure")
    assert better.status == "pass"
    with pytest.raises(NoSolution, match="at least"):
        _ = design_of(more | {"reservoir": 0.1}).unloading.size.force_variation


def test_free_length() -> None:
    sized = design_of(SPRING).unloading.size
    free = {key: value for key, value in SPRING.items() if key != "stretch_ratio"} | {"free_length": sized.free_length}
    assert design_of(free).motion.stretch_ratio == pytest.approx(0.4, rel=1e-12)
    with pytest.raises(NoSolution, match="it is slack there"):
        _ = design_of(free | {"free_length": 1.001 * sized.device_length_min}).motion.device


@pytest.mark.parametrize("degrees", [20.0, 110.0, 300.0, 340.0])
def test_pendulum_is_the_closed_law(degrees: float) -> None:
    swing = math.radians(degrees)
    law, m = ElasticLaw(Gravity(), swing), math.sin(0.25 * swing)
    quarter = float(ellipk(m * m))
    assert law.energy_parameter == pytest.approx(8.0 * quarter**2 / swing**2, rel=1e-12)
    assert law.velocity_peak == pytest.approx(4.0 * quarter * m / swing, rel=1e-12)
    a, b, c = (float(each[0]) for each in law.invariants(np.array([0.3])))
    phi = (0.5 - a) * swing
    assert b * b == pytest.approx(law.energy_parameter * (math.cos(phi) - math.cos(0.5 * swing)), rel=1e-10)
    assert c == pytest.approx(0.5 * law.energy_parameter * swing * math.sin(phi), rel=1e-10)


@pytest.mark.parametrize("device", [Pneumatic(5.6), Spring(5.6, 0.3)])
def test_law_up_to_340_deg(device: Pneumatic | Spring) -> None:
    swing = math.radians(340.0)
    law = ElasticLaw(device, swing)
    half = 0.5 * swing

    def slowness(v: float) -> float:  # phi = half - v^2 takes the root away
        phi = half - v * v
        length = math.sqrt((5.6 - 1.0) ** 2 + 4.0 * 5.6 * math.sin(0.5 * phi) ** 2)
        x = 4.0 * 5.6 * math.sin(0.5 * v * v) * math.sin(0.5 * (half + phi)) / (law.geometry.longest + length)
        energy = x
        if isinstance(device, Spring):
            energy = x * (1.3 * law.geometry.stroke - 0.5 * x)
        return 2.0 * v / math.sqrt(energy) if v > 0.0 else 0.0

    total = quad(slowness, 0.0, math.sqrt(half), epsabs=0.0, epsrel=1e-11, limit=200)[0]
    assert law.energy_parameter == pytest.approx((2.0 * total / swing) ** 2, rel=1e-9)


def test_swing_range_warns_above_300() -> None:
    assert not design_of(CYLINDER | {"pivot_ratio": 5.6}, swing=300.0).check("swing-range")
    (check,) = design_of(CYLINDER | {"pivot_ratio": 5.6}, swing=301.0).check("swing-range")
    assert check.status == "warn"


SLIDER_DRIVE = SliderDrive(150.0, 450.0, math.radians(80.0))


@pytest.mark.quick(1)
@pytest.mark.parametrize("device", [Pneumatic(2.6), Spring(3.0, 0.5)])
def test_iteration_with_slider_meets_the_quadrature(device: Pneumatic | Spring) -> None:
    law = SliderLaw(device, math.radians(110.0), SLIDER_DRIVE, 0.3)
    found = [legacy_law(device, law.swing, law.inertia_at, steps=n).energy_parameter for n in (20, 40)]
    errors = [each / law.energy_parameter - 1.0 for each in found]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.05)
    # Richardson's step leaves the dk^4 term
    assert (4.0 * found[1] - found[0]) / 3.0 == pytest.approx(law.energy_parameter, rel=1e-5)


def test_iteration_without_slider_is_the_old_one() -> None:
    alike = legacy_law(Spring(3.0, 0.5), 2.0, lambda _: 1.0, steps=15)
    assert alike.energy_parameter == pytest.approx(
        legacy_law(Spring(3.0, 0.5), 2.0, steps=15).energy_parameter, rel=1e-11
    )
    assert alike.rows[-1][3] + alike.rows[-1][4] == pytest.approx(1.0, abs=1e-12)


@pytest.mark.slow
def test_iteration_that_does_not_converge() -> None:
    # an inertia that nearly vanishes at mid-swing: the rocker is fast there
    with pytest.raises(NoSolution, match=r"velocity invariant .*; omit method") as error:
        legacy_law(Pneumatic(2.6), math.radians(60.0), lambda a: 0.02 + 4.0 * (a - 0.5) ** 2, steps=40)
    assert error.value.key == "method"


def test_chart_of_the_curvature_ratio() -> None:
    from gearlink.core.machines.wide_swing import charts

    # printed to six places in the derivation of the chart, with the minimum pivot ratio
    swings = np.radians([90.0, 180.0, 300.0])
    for cycle, printed in ((60.0, (0.006477, 0.023135, 0.030299)), (120.0, (0.001861, 0.039705, 0.062068))):
        np.testing.assert_allclose(charts.curvature_ratio(swings, math.radians(cycle)), printed, rtol=0, atol=5e-7)
    assert np.isnan(charts.curvature_ratio(np.radians([40.0]), math.radians(120.0))).all()
    spring = charts.velocity_peak(np.radians([120.0]), 3.0, stretch_ratio=0.5)
    assert spring[0] == pytest.approx(ElasticLaw(Spring(3.0, 0.5), math.radians(120.0)).velocity_peak, rel=1e-12)


@pytest.mark.parametrize(("reserve", "inertia"), [(0.0, 0.02), (0.4, 0.0), (0.15, 1.5)])
def test_pendulum_with_slider_swings_in_the_time_of_the_stroke(reserve: float, inertia: float) -> None:
    """The time of a free swing, by the energy of rocker, mass and slider, whose speed is a difference of its places."""
    design = design_of(PENDULUM | {"reserve": reserve}, speed=18.0, inertia=inertia, slider=SLIDER, swing=100.0)
    mass, s, half = design.unloading.size.mass, 0.12, math.radians(50.0)

    def place(phi: float) -> float:  # of the slider [m]
        arm = math.radians(80.0) + phi
        return 0.15 * math.cos(arm) + math.sqrt(0.45**2 - (0.15 * math.sin(arm)) ** 2)

    def slowness(u: float) -> float:  # sin(phi/2) = sin(half/2) sin u takes the ends away
        phi = 2.0 * math.asin(math.sin(0.5 * half) * math.sin(u))
        rate = (place(phi + 1e-5) - place(phi - 1e-5)) / 2e-5
        moving = inertia + mass * s * s + 6.0 * rate * rate
        return math.sqrt(moving / (mass * 9.80665 * s)) / math.cos(0.5 * phi)

    time = quad(slowness, -0.5 * math.pi, 0.5 * math.pi, epsabs=0.0, epsrel=1e-10)[0]
    wanted = design.motion.stroke_time / math.sqrt(1.0 + reserve)
    assert time == pytest.approx(
        wanted, rel=1e-8, abs=0.0
    )  # differences of 1e-5 rad: 1e-10, and the slider's 1e-16/1e-5
    back = design_of(PENDULUM | {"mass": mass}, speed=18.0, inertia=inertia, slider=SLIDER, swing=100.0)
    assert back.unloading.size.reserve == pytest.approx(reserve, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize(
    ("name", "missing"),
    [
        ("bore", "unloader: {type: pneumatic, pressure}"),
        ("force_variation", "unloader: {type: pneumatic, reservoir}"),
        ("mass", "unloader: {type: gravity}"),
        ("force_min", "unloader: {type: spring}"),
        ("end_position_gain", "output_radius"),
        ("force_max", ""),
    ],
)
def test_what_another_device_has_is_not_known(name: str, missing: str) -> None:
    """That was a fault of the program."""
    design = design_of(CYLINDER)
    assert design.needs(name) == missing
    assert (design.quantity(name) is None) is bool(missing)
