"""A sample of every family of random designs against mpmath at 40 digits.

Conditions and limits are those of the family's long test, which compares all designs with a second way in 80 bits;
the sample shows that the second way is right itself.
"""

from __future__ import annotations

import math
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from oracles import forty_digits
from oracles.drive_search import turns
from oracles.long_drive import Drives
from oracles.three_gear import Drive
from stress.random_drives import VARIANTS, arrays, designs, turning
from stress.test_random_designs import LAWS
from stress.test_random_drives import (
    KEY_LIMITS,
    MOTION_LIMITS,
    QUANTITIES,
    Analysed,
    clear_of_dead_points,
    place_condition,
    scalar,
    sweep,
)
from stress.worst import EPS, LONGER_NUMBERS, Worst

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.planet_linkages.planet import PlanetLinkage
from gearlink.core.machines.three_gear.momentary import eccentricity_range, momentary_frame_length
from gearlink.core.machines.three_gear.sweep import momentary_dwells
from gearlink.core.machines.three_gear.symmetric import dwell_angle
from gearlink.core.machines.wide_swing.device import Pneumatic, Spring
from gearlink.core.machines.wide_swing.law import ElasticLaw
from gearlink.core.parts.cams.laws import law
from gearlink.core.parts.cams.profile import oscillating, profile, translating
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.linkages import slider_crank
from gearlink.core.parts.linkages.fourbar import position as fourbar
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.slider_crank import SliderCrank

SAMPLE = [1, pytest.param(20, marks=pytest.mark.stress)]
sampled = pytest.mark.parametrize("count", SAMPLE)
sampled_at_length = pytest.mark.parametrize("count", SAMPLE[1:])  # by quadrature; tests/core does so every time


pytestmark = pytest.mark.usefixtures("forty_digits")


def off(angle: float, exact: Any) -> float:
    """How far an angle is from another, whole revolutions aside [rad]."""
    gap = mp.mpf(angle) - exact
    return abs(float(gap - 2 * mp.pi * mp.nint(gap / (2 * mp.pi))))


@sampled
def test_four_bars(count: int) -> None:
    rng, worst, done = np.random.default_rng(11), Worst(), 0
    while done < count:
        a, b, c, d = (float(x) for x in 10.0 ** (rng.uniform(-6, 6) + rng.uniform(-1, 1, 4)))
        side, phi = int(rng.choice((-1, 1))), float(rng.uniform(-6.3, 6.3))
        try:
            state = fourbar.solve(FourBar(a, b, c, d, side), phi, 2)
        except NoSolution:
            continue
        near = math.sin(state.transmission_angle)
        if near < 1e-3:
            continue
        coupler, rocker = forty_digits.four_bar((a, b, c, d), side, phi)
        design, longest = (a, b, c, d, side, phi), max(a, b, c, d)
        base = longest * (1.0 / math.hypot(d - a * math.cos(phi), a * math.sin(phi)) + 1.0 / min(b, c)) / near
        fastest = max(abs(float(coupler[1])), abs(float(rocker[1])), 1.0)
        worst.take(
            "angles",
            max(off(state.coupler_angle, coupler[0]), off(state.rocker_angle, rocker[0])) / (EPS * base),
            design,
        )
        speed = max(abs(float(state.coupler_velocity - coupler[1])), abs(float(state.rocker_velocity - rocker[1])))
        worst.take("velocities", speed / (EPS * base * fastest / near), design)
        gap = abs(float(state.rocker_acceleration - rocker[2]))
        worst.take("accelerations", gap / (EPS * base * fastest**2 * longest / min(b, c) / near**2), design)
        done += 1
    worst.check("four-bar, 40 digits", count, {"angles": 6.0, "velocities": 4.0, "accelerations": 8.0})


@pytest.mark.parametrize("exponent", range(1, 9))
def test_four_bars_near_a_dead_point(exponent: int) -> None:
    b, c, d, gamma = 3.0, 2.0, 4.0, 10.0**-exponent
    n = math.hypot(b - c, 2.0 * math.sqrt(b * c) * math.sin(0.5 * gamma))
    for phi in (0.05, 0.1, 0.2):
        a = d * math.cos(phi) - math.sqrt(n * n - (d * math.sin(phi)) ** 2)
        try:
            state = fourbar.solve(FourBar(a, b, c, d), phi, 1)
        except NoSolution:
            continue  # the rounded lengths just fail to close
        _, rocker = forty_digits.four_bar((a, b, c, d), 1, phi, 1)
        near, longest = math.sin(state.transmission_angle), d / n
        assert off(state.rocker_angle, rocker[0]) <= 8.0 * EPS * longest / near
        gap = abs(float(state.rocker_velocity - rocker[1]))
        assert gap <= 16.0 * EPS * longest / near**2 * max(1.0, abs(float(rocker[1])))


@sampled
def test_gear_pairs(count: int) -> None:
    rng, worst = np.random.default_rng(13), Worst()
    for _ in range(count):
        teeth, x = tuple(int(z) for z in rng.integers(6, 301, 2)), tuple(float(v) for v in rng.uniform(-1.0, 1.0, 2))
        module, alpha = 10.0 ** float(rng.uniform(-6, 6)), math.radians(float(rng.uniform(14.5, 30.0)))
        exact, design = forty_digits.working_pressure_angle(teeth, x, alpha), (module, teeth, x, alpha)
        pair = GearPair(module=module, teeth=teeth, pressure_angle=alpha, given_shift=x)
        if exact is None:
            with pytest.raises(NoSolution):
                _ = pair.working_pressure_angle
            continue
        tangent, angle = math.tan(alpha), float(exact)
        terms = tangent - alpha + 2.0 * (abs(x[0]) + abs(x[1])) / sum(teeth) * tangent
        condition = terms / (angle * math.tan(angle) ** 2)
        gap = abs(float(pair.working_pressure_angle - exact))
        worst.take("working pressure angle", gap / (EPS * angle * max(1.0, condition)), design)
        distance = mp.mpf(module) * sum(teeth) / 2 * mp.cos(mp.mpf(alpha)) / mp.cos(exact)
        condition = max(1.0, condition * angle * math.tan(angle))
        worst.take("centre distance", abs(float(pair.center_distance / distance - 1)) / (EPS * condition), design)
    worst.check("gear pair, 40 digits", count, {"working pressure angle": 8.0, "centre distance": 8.0})


@sampled
def test_slider_cranks(count: int) -> None:
    rng, worst = np.random.default_rng(14), Worst()
    for _ in range(count):
        rod = 10.0 ** float(rng.uniform(-6, 6))
        offset = rod * float(rng.uniform(-0.9, 0.9))
        wanted = slider_crank.max_stroke(rod, offset) * (1.0 - 10.0 ** float(rng.uniform(-8, -0.1)))
        crank = SliderCrank(wanted, rod, offset).crank_length
        slope = float(mp.diff(lambda r, rod=rod, e=offset: forty_digits.stroke(r, rod, e), mp.mpf(crank)))
        gap = abs(float(forty_digits.stroke(crank, rod, offset) - mp.mpf(wanted)))
        worst.take("stroke given back", gap / (EPS * (wanted + slope * crank)), (wanted, rod, offset))
    worst.check("slider-crank, 40 digits", count, {"stroke given back": 4.0})


@pytest.mark.parametrize("definition", LAWS, ids=str)
@sampled_at_length
def test_laws(definition: Any, count: int) -> None:
    """Rise, velocity and acceleration to 8 ulp of their peaks, from the law's definition."""
    made, rng, worst = law(definition), np.random.default_rng(15), Worst()
    peaks = (1.0, made.peak_velocity, made.peak_acceleration)
    for x in rng.uniform(0.0, 1.0, count).tolist():
        pairs = zip("sva", made.evaluate(x, 2), forty_digits.rise(definition, x), peaks, strict=True)
        for name, found, exact, peak in pairs:
            worst.take(name, abs(float(found - exact)) / (EPS * peak), x)
    worst.check(f"{definition}, 40 digits", count, {"s": 8.0, "v": 8.0, "a": 8.0})


@sampled
def test_cam_profiles(count: int) -> None:
    rng, worst, radius = np.random.default_rng(16), Worst(), 0.2
    for _ in range(count):
        phi, y, y1 = (float(x) for x in (rng.uniform(0.0, 6.28), rng.uniform(1.0, 3.0), rng.uniform(-1.0, 1.0)))
        for sense in (1, -1):
            ways = (
                (translating([y], [y1], offset=0.3), forty_digits.translating_profile(phi, y, y1, 0.3, sense, radius)),
                (
                    oscillating(4.0 + 0.0j, 2.0, [2.4 + 0.5 * y1], [0.3 * y]),
                    forty_digits.oscillating_profile(phi, (4.0, 2.0, 2.4 + 0.5 * y1, 0.3 * y), sense, radius),
                ),
            )
            for (path, exact), name in zip(ways, ("translating", "oscillating"), strict=True):
                found = complex(profile([phi], path, sense=sense, roller_radius=radius).profile[0])
                center = abs(path.position[0])
                size = center * (1.0 + radius / abs(path.first[0] - 1j * sense * path.position[0]))
                worst.take(name, float(abs(mp.mpc(found) - exact)) / (EPS * size), (phi, y, y1, sense))
    worst.check("cam profile, 40 digits", count, {"translating": 8.0, "oscillating": 8.0})


@sampled
def test_dwell_angles(count: int) -> None:
    rng, worst = np.random.default_rng(17), Worst()
    for _ in range(count):
        i3, phi12 = -(10.0 ** float(rng.uniform(math.log10(0.5), 2.0))), float(rng.uniform(0.2, 3.1))
        exact = forty_digits.dwell_angle(i3, phi12)
        found = dwell_angle(i3, phi12)
        worst.take("one", float(abs(found - exact)) / math.ulp(found), (i3, phi12))
    worst.check("dwell angle [ulp], 40 digits", count, {"one": 6.0})


@sampled
def test_momentary_frames(count: int) -> None:
    rng, worst, done = np.random.default_rng(18), Worst(), 0
    while done < count:
        radii = [float(x) for x in 10.0 ** rng.uniform(-6, 6) * rng.uniform((1.0, 0.3, 1.0), (1.01, 3.0, 5.0))]
        low, high = eccentricity_range(*radii)
        e = low + (high - low) * float(rng.uniform(1e-6, 1.0 - 1e-6))
        exact, condition = forty_digits.momentary_frame(*radii, e), 1.0 + low / (radii[0] - low)
        found = momentary_frame_length(*radii, e), float(momentary_dwells(*radii, e).frame)
        for name, frame in zip(("one", "arrays"), found, strict=True):
            worst.take(name, float(abs(frame / exact - 1)) / (EPS * condition), (*radii, e))
        done += 1
    worst.check("momentary frame, 40 digits", count, {"one": 8.0, "arrays": 8.0})


@sampled_at_length
def test_unloading_laws(count: int) -> None:
    rng, worst = np.random.default_rng(19), Worst()
    for i in range(count):
        ratio, swing = 1.0 + 10.0 ** float(rng.uniform(-1.3, 2.0)), math.radians(float(rng.uniform(1e-6, 299.0)))
        stretch = float(rng.uniform(0.05, 3.0)) if i % 2 else None
        made = ElasticLaw(Pneumatic(ratio) if stretch is None else Spring(ratio, stretch), swing)
        exact = forty_digits.energy_parameter(ratio, stretch, swing)
        worst.take("energy parameter", float(abs(made.energy_parameter / exact - 1)) / EPS, (ratio, stretch, swing))
    worst.check("unloading law, 40 digits", count, {"energy parameter": 64.0})


@LONGER_NUMBERS
@sampled
def test_motion_of_whole_drives(count: int) -> None:
    """Every variant; the second way itself is held to a hundredth of eps."""
    rng, worst = np.random.default_rng(21), Worst()
    for design in designs(rng, max(count, len(VARIANTS))):
        phi, links, train = float(rng.uniform(-13.0, 13.0)), design.linkage, design.train
        long = Drives.three_gears(*arrays([design]))
        if not clear_of_dead_points(long, np.array([phi]))[0]:
            continue
        plain = Drive(
            *(links.crank, links.coupler, links.rocker, links.frame, (train.crank, train.idler, train.output)),
            links.assembly,
        )
        exact = plain.output(phi) - plain.output(mp.mpf(0)), plain.speed(phi), plain.acceleration(phi)
        for name, one, many, true in zip(QUANTITIES, scalar(design, phi), sweep(design, phi), exact, strict=True):
            condition = EPS * float(long.condition(name, np.array([phi]))[0])
            second = mp.mpf(str(getattr(long, name)(np.array([phi]))[0]))
            for found in (one, many):
                worst.take(name, float(abs(found - true)) / condition, (str(design), phi))
            worst.take("second way", float(abs(second - true)) / condition, (str(design), phi))
    worst.check("whole drives, 40 digits", count, {**MOTION_LIMITS, "second way": 0.01})


def polished(plain: Drive, start: Any, end: Any, regained: Any) -> tuple[Any, Any, Any]:
    """Start and end of a back-step and the place where the output is back, from places near them."""
    fine = mp.mpf(10) ** -90
    first, second = (mp.findroot(plain.speed, x, tol=fine) for x in (start, end))
    return first, second, mp.findroot(lambda x: plain.output(x) - plain.output(first), regained, tol=fine)


@LONGER_NUMBERS
@sampled
def test_key_quantities_of_whole_drives(count: int) -> None:
    """Standstills, back-step and phi13 as roots at 40 digits, from the places that the dense search found."""
    worst = Worst()
    drawn = designs(np.random.default_rng(25), count, ("dwell", "back-step", "beside-momentary", "crank-rocker"))
    for design, turn in zip(drawn, turns(Drives.three_gears(*arrays(drawn)), count), strict=True):
        found, links, train = Analysed(design), design.linkage, design.train
        if len(found.dwell_crank_angles) != 2:
            continue
        plain = Drive(
            *(links.crank, links.coupler, links.rocker, links.frame, (train.crank, train.idler, train.output)),
            links.assembly,
        )
        start, width, _, regained = (mp.mpf(str(x)) for x in turn.back_step())
        with mp.workdps(60):
            first, second, place = polished(plain, start, start + width, start + regained)
            back = plain.output(first) - plain.output(second)
        at_places = float(sum(place_condition(turn, "speed", x) for x in turn.standstills))
        ends = turn.drive.size("turned", 0.0)
        gain = float(regained) * turn.over("speed", float(start), float(regained)) + ends
        pairs = (
            ("phi12", found.back_step_crank_angle, second - first, at_places),
            (
                "back-step",
                found.back_step_angle,
                back,
                float(width) * turn.over("speed", float(start), float(width)) + ends,
            ),
            ("phi13", found.dwell_angle, place - first, gain / turn.drive.speed(float(place)) + at_places),
        )
        for name, value, exact, condition in pairs:
            worst.take(name, float(abs(value - exact)) / (EPS * float(condition)), str(design))
    worst.check(
        "key quantities, 40 digits", count, {name: KEY_LIMITS[name] for name in ("phi12", "back-step", "phi13")}
    )


@LONGER_NUMBERS
@pytest.mark.parametrize("carrier", ["crank", "rocker"])
@sampled
def test_drives_without_an_idler(carrier: Any, count: int) -> None:
    rng, worst = np.random.default_rng(24), Worst()
    for _ in range(count):
        b, c = (float(x) for x in 10.0 ** (rng.uniform(-6, 6) + rng.uniform(-1, 1, 2)))
        short, long_ = turning(rng, b, c)
        lengths = (short, b, c, long_) if rng.random() < 0.5 else (long_, b, c, short)
        side, ratio, phi = (
            int(rng.choice((-1, 1))),
            -(10.0 ** float(rng.uniform(-1.0, 1.0))),
            float(rng.uniform(-13, 13)),
        )
        links = np.array(lengths)[:, None]
        long = Drives.one_mesh(links, np.array([side]), np.array([ratio]), carrier)
        if not clear_of_dead_points(long, np.array([phi]))[0]:
            continue
        planet = PlanetLinkage(FourBar(*lengths, side), ratio, carrier)
        plain = Drive(*lengths, (1, 1, 1), side)

        def output(x: Any, plain: Drive = plain, ratio: float = ratio) -> Any:
            direction, at_b, at_d = plain.triangle(x)
            arm = x if carrier == "crank" else direction + mp.pi - plain.assembly * at_d
            return arm + mp.mpf(ratio) * (direction + plain.assembly * at_b - arm)

        exact = output(mp.mpf(phi)) - output(mp.mpf(0)), mp.diff(output, phi), mp.diff(output, phi, 2)
        for name, found, true in zip(
            QUANTITIES, (planet.angle(phi), planet.speed(phi), planet.acceleration(phi)), exact, strict=True
        ):
            condition = EPS * float(long.condition(name, np.array([phi]))[0])
            worst.take(name, float(abs(found - true)) / condition, (lengths, side, ratio, phi))
    worst.check(f"gear on the coupler, {carrier} carries, 40 digits", count, MOTION_LIMITS)
