"""Random designs of every family against a second, independent way in longer arithmetic.

The second way is the plainest textbook form in numpy's 80-bit numbers (64 bits of mantissa): it shares no formula with
the program and its own rounding is 2000 times smaller. Where the C compiler gives no such numbers the module skips.
Errors are in eps = 2^-52 times the condition number that stands at each test; the worst design is printed.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from oracles.closing import assembles
from stress.worst import COUNTS, EPS, LONG, LONGER_NUMBERS, MANY, Worst

from gearlink.core.base.errors import NoSolution
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

pytestmark = LONGER_NUMBERS

LAWS: list[Any] = [
    *("simple-harmonic", "cycloidal", "modified-trapezoid", "modified-sine", "polynomial-345", "polynomial-4567"),
    *("mcv-50", "mcv-33", "mcv-20", {"scca": [0.25, 0.25, 0.25, 0.25]}),
]


def long_four_bar(a: float, b: float, c: float, d: float, side: int, phi: float) -> tuple[Any, ...]:
    """Coupler and rocker direction and rates by circle intersection and Cramer's rule, in 80 bits."""
    a_, b_, c_, d_ = (LONG(x) for x in (a, b, c, d))
    x = LONG(phi)
    e_a = (np.cos(x), np.sin(x))
    v = (d_ - a_ * e_a[0], -a_ * e_a[1])
    square = v[0] * v[0] + v[1] * v[1]
    along = (b_ * b_ - square - c_ * c_) / (2 * square)
    across_square = c_ * c_ / square - along * along
    if across_square <= 0:
        raise ValueError
    across = side * np.sqrt(across_square)
    e_c = ((along * v[0] - across * v[1]) / c_, (along * v[1] + across * v[0]) / c_)
    e_b = ((v[0] + c_ * e_c[0]) / b_, (v[1] + c_ * e_c[1]) / b_)
    sine = e_c[1] * e_b[0] - e_c[0] * e_b[1]
    w_b = a_ * (e_a[1] * e_c[0] - e_a[0] * e_c[1]) / (b_ * sine)
    w_c = a_ * (e_a[1] * e_b[0] - e_a[0] * e_b[1]) / (c_ * sine)
    cosine = e_c[0] * e_b[0] + e_c[1] * e_b[1]
    pull = a_ * (e_a[0] * e_b[0] + e_a[1] * e_b[1]) + b_ * w_b * w_b - c_ * w_c * w_c * cosine
    return e_b, e_c, w_b, w_c, pull / (c_ * sine), float(sine), float(square)


def off(angle: float, direction: tuple[Any, Any]) -> float:
    """How far an angle is from a direction [rad]."""
    x = LONG(angle)
    return abs(
        float(
            np.arctan2(
                np.sin(x) * direction[0] - np.cos(x) * direction[1], np.cos(x) * direction[0] + np.sin(x) * direction[1]
            )
        )
    )


@pytest.mark.parametrize("count", COUNTS)
def test_four_bars_of_every_class(count: int) -> None:
    """Condition: rounded lengths and crank angle give the triangle's sides to eps (l/n); its angles have 1/sin(gamma)
    of that, each rate once more."""
    rng, worst, kinds = np.random.default_rng(11), Worst(), set()
    done = 0
    while done < count:
        scale = 10.0 ** rng.uniform(-6, 6)
        a, b, c, d = (float(x) for x in scale * 10.0 ** rng.uniform(-1, 1, 4))
        side, phi = int(rng.choice((-1, 1))), float(rng.uniform(-6.3, 6.3))
        linkage = FourBar(a, b, c, d, side)
        try:
            exact = long_four_bar(a, b, c, d, side, phi)
        except ValueError:
            if not assembles(linkage, phi):
                with pytest.raises(NoSolution):
                    fourbar.solve(linkage, phi)
            continue
        e_b, e_c, w_b, w_c, acceleration, sine, square = exact
        near = abs(sine)
        if near < 1e-3:
            continue
        kinds.add(linkage.kind())
        state = fourbar.solve(linkage, phi, 2)
        design = (a, b, c, d, side, phi)
        longest = max(a, b, c, d)
        base = (longest / math.sqrt(square) + longest / min(b, c)) / near
        largest = max(abs(float(w_b)), abs(float(w_c)), 1.0)
        worst.take("angles", max(off(state.coupler_angle, e_b), off(state.rocker_angle, e_c)) / (EPS * base), design)
        speed = max(abs(float(state.coupler_velocity - w_b)), abs(float(state.rocker_velocity - w_c)))
        worst.take("velocities", speed / (EPS * base * largest / near), design)
        gap = abs(float(state.rocker_acceleration - acceleration))
        scale_a = largest**2 * longest / min(b, c) / near**2
        worst.take("accelerations", gap / (EPS * base * scale_a), design)
        done += 1
    assert kinds >= {"crank-rocker", "drag-link", "rocker-crank", "double-rocker"}
    worst.check("four-bar", count, {"angles": 6.0, "velocities": 4.0, "accelerations": 8.0})


@pytest.mark.parametrize("count", COUNTS)
def test_scale_mirror_and_period_of_four_bars(count: int) -> None:
    """The size takes no part in the angles, the mirror image changes signs alone, a revolution adds 2 pi to an ulp."""
    rng, worst = np.random.default_rng(12), Worst()
    for _ in range(count // 10):
        a = float(rng.uniform(0.1, 1.0))
        b, c = (float(x) for x in rng.uniform(1.0, 3.0, 2))
        low, high = (abs(b - c) + a) * 1.01, (b + c - a) * 0.99
        if low >= high:
            continue
        d = float(rng.uniform(low, high))
        linkage, phi = FourBar(a, b, c, d), float(rng.uniform(-3.0, 3.0))
        if not linkage.turns_fully():
            continue
        state = fourbar.solve(linkage, phi, 3)
        factor = 2.0 ** int(rng.integers(-20, 20))
        scaled = fourbar.solve(FourBar(*(factor * x for x in (a, b, c, d))), phi, 1)
        near = math.sin(state.transmission_angle)
        bits = abs(scaled.rocker_angle - state.rocker_angle) * near / (EPS * 2 * math.pi)
        worst.take("a power of two", bits, (a, b, c, d, phi, factor))
        mirrored = fourbar.solve(FourBar(a, b, c, d, -1), -phi, 3)
        turns = -state.rocker_angle - mirrored.rocker_angle
        assert abs(math.remainder(turns, 2.0 * math.pi)) <= 4 * EPS * math.pi
        assert math.isclose(mirrored.rocker_velocity, state.rocker_velocity, rel_tol=1e-13, abs_tol=1e-13 / near**2)
        assert math.isclose(
            mirrored.rocker_acceleration, -state.rocker_acceleration, rel_tol=1e-12, abs_tol=1e-12 / near**3
        )
        inch = fourbar.solve(FourBar(*(x / 25.4 for x in (a, b, c, d))), phi, 1)
        near = math.sin(state.transmission_angle)
        worst.take(
            "inches", abs(inch.rocker_angle - state.rocker_angle) * near / (EPS * 2 * math.pi), (a, b, c, d, phi)
        )
        after = fourbar.solve(linkage, phi + 2.0 * math.pi, 0)
        worst.take(
            "a revolution", abs(after.rocker_angle - state.rocker_angle) * near / (EPS * 2 * math.pi), (a, b, c, d, phi)
        )
    worst.check("four-bar invariance", count // 10, {"a power of two": 1.0, "inches": 8.0, "a revolution": 8.0})


@pytest.mark.parametrize("exponent", range(1, 9))
def test_transmission_angles_down_to_1e_8(exponent: int) -> None:
    """Near a dead centre the angle is lost as eps/gamma, the velocity as eps/gamma^2 of its size."""
    gamma = 10.0**-exponent
    b, c, d = 3.0, 2.0, 4.0
    n = math.sqrt((b - c) ** 2 + 4.0 * b * c * math.sin(0.5 * gamma) ** 2)  # of the triangle with gamma at C
    for phi in (0.4, 1.1, 2.0):
        a = d * math.cos(phi) + math.sqrt(max(n * n - (d * math.sin(phi)) ** 2, 0.0)) if n > d * math.sin(phi) else None
        if a is None or a <= 0.0:
            a = d * math.cos(phi) if math.cos(phi) > 0 else 1.0
            d_used = (
                a * math.cos(phi) + math.sqrt(max(n * n - (a * math.sin(phi)) ** 2, 0.0))
                if n > a * math.sin(phi)
                else 0.0
            )
            if d_used <= 0.0:
                continue
        else:
            d_used = d
        try:
            exact = long_four_bar(a, b, c, d_used, 1, phi)
            state = fourbar.solve(FourBar(a, b, c, d_used), phi, 1)
        except (ValueError, NoSolution):
            continue  # the rounded lengths just fail to close
        near = abs(exact[5])
        longest = max(a, b, c, d_used) / math.sqrt(exact[6])
        assert off(state.rocker_angle, exact[1]) <= 8.0 * EPS * longest / near
        speed = abs(float(state.rocker_velocity - exact[3]))
        assert speed <= 16.0 * EPS * longest / near**2 * max(1.0, abs(float(exact[3])))


@pytest.mark.parametrize("count", COUNTS)
def test_gear_pairs(count: int) -> None:
    """Condition of the working pressure angle in its involute: inv/(alpha tan^2)."""
    rng, worst = np.random.default_rng(13), Worst()
    refused = 0
    for _ in range(count):
        z = tuple(int(x) for x in rng.integers(6, 301, 2))
        x = tuple(float(v) for v in rng.uniform(-1.0, 1.0, 2))
        module, alpha = 10.0 ** float(rng.uniform(-6, 6)), math.radians(float(rng.uniform(14.5, 30.0)))
        tangent = np.tan(LONG(alpha))
        wanted = tangent - LONG(alpha) + 2 * (LONG(x[0]) + LONG(x[1])) / (z[0] + z[1]) * tangent
        design = (module, z, x, alpha)
        try:
            pair = GearPair(module=module, teeth=z, pressure_angle=alpha, given_shift=x)
            found, distance = pair.working_pressure_angle, pair.center_distance
        except NoSolution:
            assert wanted <= 0.0, design
            refused += 1
            continue
        w = np.cbrt(3 * wanted) if wanted < 1 else LONG(1.2)
        for _ in range(60):
            t = np.tan(w)
            step = (t - w - wanted) / (t * t)
            w = w - step
            if abs(step) < 1e-18 * w:
                break
        exact = LONG(module) * (z[0] + z[1]) / 2 * np.cos(LONG(alpha)) / np.cos(w)
        terms = float(tangent - LONG(alpha)) + abs(2.0 * (abs(x[0]) + abs(x[1])) / (z[0] + z[1]) * float(tangent))
        condition = terms / (float(w) * math.tan(float(w)) ** 2)
        worst.take("working pressure angle", abs(float(found - w)) / (EPS * float(w) * max(1.0, condition)), design)
        condition_a = max(1.0, condition * float(w) * math.tan(float(w)))
        worst.take("centre distance", abs(float(distance - exact)) / (EPS * distance * condition_a), design)
    print(f"\n{refused} refused")
    worst.check("gear pair", count, {"working pressure angle": 8.0, "centre distance": 8.0})


@pytest.mark.parametrize("count", COUNTS)
def test_slider_cranks(count: int) -> None:
    """The stroke that the crank gives back, in 80 bits; condition: stroke over the slope of the stroke."""
    rng, worst = np.random.default_rng(14), Worst()
    for i in range(count):
        rod = 10.0 ** float(rng.uniform(-6, 6))
        offset = rod * float(rng.uniform(-0.9, 0.9))
        most = slider_crank.max_stroke(rod, offset)
        share = 1.0 - 10.0 ** float(rng.uniform(-8, -0.5)) if i % 2 else float(rng.uniform(1e-6, 1.0))
        stroke = most * min(share, 1.0 - 1e-9)
        crank = SliderCrank(stroke, rod, offset).crank_length
        far, near = LONG(rod) + LONG(crank), LONG(rod) - LONG(crank)
        p, q = (
            np.sqrt((far - abs(LONG(offset))) * (far + abs(LONG(offset)))),
            np.sqrt(np.maximum((near - abs(LONG(offset))) * (near + abs(LONG(offset))), LONG(0))),
        )
        slope = float(far / p + near / np.maximum(q, LONG(1e-30) * LONG(rod)))
        back = 4 * LONG(rod) * LONG(crank) / (p + q)  # p - q
        error = abs(float(back - LONG(stroke))) / (EPS * (stroke + slope * crank))
        worst.take("stroke given back", error, (stroke, rod, offset))
    worst.check("slider-crank", count, {"stroke given back": 4.0})


@pytest.mark.parametrize("definition", LAWS, ids=str)
@pytest.mark.parametrize("count", COUNTS)
def test_laws(definition: Any, count: int) -> None:
    """Displacement, velocity and acceleration are each other's integrals: Gauss quadrature on short stretches; the
    tolerance is 8 ulp of the peak. Symmetry s(x) + s(1 - x) = 1 to 2 ulp."""
    nodes, weights = np.polynomial.legendre.leggauss(8)
    made, rng = law(definition), np.random.default_rng(15)
    x = np.sort(rng.uniform(0.0, 0.999, count))
    h = 1e-3 * rng.uniform(0.1, 1.0, count)
    s, v, a = made.evaluate(x, 2)
    s_h, v_h, _ = made.evaluate(x + h, 2)
    points = x[:, None] + 0.5 * h[:, None] * (1.0 + nodes)
    inner = made.evaluate(points.ravel(), 2)
    for end, start, rate, name in ((s_h, s, inner[1], "s"), (v_h, v, inner[2], "v")):
        area = 0.5 * h * (rate.reshape(points.shape) @ weights)
        # across a joint of the law the acceleration may jump in slope: quadrature is then good to h^2 of it
        good = np.abs(end - start - area) <= 8.0 * EPS * max(1.0, np.abs(start).max())
        assert good.mean() > 0.98, (definition, name)
        assert np.abs(end - start - area).max() <= 1e-4 * h.max() * max(1.0, np.abs(a).max())
    mirrored = made.evaluate(1.0 - x, 0)[0]
    assert np.abs(s + mirrored - 1.0).max() <= 8.0 * EPS


@pytest.mark.parametrize("count", COUNTS)
def test_cam_profiles(count: int) -> None:
    """Envelope in 80 bits from the same roller path. Condition: size over speed of the pitch curve."""
    rng, worst = np.random.default_rng(16), Worst()
    phi = rng.uniform(0.0, 2.0 * math.pi, count)
    sizes = 10.0 ** rng.uniform(-6, 6, count)
    y, y1, y2 = (
        sizes * rng.uniform(1.0, 3.0, count),
        sizes * rng.uniform(-1, 1, count),
        sizes * rng.uniform(-1, 1, count),
    )
    for sense in (1, -1):
        radius = 0.2
        for name, path in (
            ("translating", translating(y / sizes, y1 / sizes, y2 / sizes, offset=0.3)),
            ("oscillating", oscillating(4.0 + 0.0j, 2.0, 2.4 + 0.5 * y1 / sizes, 0.3 * y2 / sizes, 0.1)),
        ):
            cam = profile(phi, path, sense=sense, roller_radius=radius)
            b, b1 = path.position.astype(np.clongdouble), path.first.astype(np.clongdouble)
            long_phi = phi.astype(LONG)
            turn = np.cos(long_phi) - sense * 1j * np.sin(long_phi)
            d1 = b1 - 1j * sense * b
            exact = turn * (b - 1j * sense * radius * d1 / np.abs(d1))
            size = (np.abs(b) + radius * np.abs(b) / np.abs(d1)).astype(float)
            errors = np.abs(cam.profile - exact).astype(float) / (EPS * size)
            i = int(np.argmax(errors))
            worst.take(name, float(errors[i]), (float(phi[i]), *(float(x[i] / sizes[i]) for x in (y, y1, y2)), sense))
    worst.check("cam profile", count, {"translating": 8.0, "oscillating": 8.0})


@pytest.mark.parametrize("count", COUNTS)
def test_dwell_angles(count: int) -> None:
    """phi13 by Newton on the textbook form in 80 bits; it has no condition worth the name."""
    rng, worst = np.random.default_rng(17), Worst()
    i3, phi12 = -(10.0 ** rng.uniform(math.log10(0.5), 2.0, count)), rng.uniform(0.2, 3.1, count)
    found = np.array([dwell_angle(a, b) for a, b in zip(i3.tolist(), phi12.tolist(), strict=True)])
    n, h = 1 - i3.astype(LONG), phi12.astype(LONG) / 2
    c = (n * n - 1) * np.cos(h) ** 2
    y, at_h = found.astype(LONG) - h, np.arctan(np.tan(h) / n)
    for _ in range(4):
        root = np.sqrt(c + np.cos(y) ** 2)
        y = y - (n * (np.arctan2(np.sin(y), root) + at_h) - h - y) / (n * np.cos(y) / root - 1)
    errors = np.abs(found - (y + h)).astype(float) / np.spacing(found)
    i = int(np.argmax(errors))
    worst.take("[ulp]", float(errors.max()), (float(i3[i]), float(phi12[i])))
    worst.check("dwell angle", count, {"[ulp]": 6.0})


@pytest.mark.parametrize("count", COUNTS)
def test_momentary_frames(count: int) -> None:
    """The frame in 80 bits. Condition: how near the eccentricity is to the ends of its range."""
    rng, worst = np.random.default_rng(18), Worst()
    r1 = 10.0 ** rng.uniform(-6, 6, count)
    r3, r5, e = (
        r1 * rng.uniform(0.3, 3.0, count),
        r1 * rng.uniform(1.0, 5.0, count),
        r1 * rng.uniform(0.02, 0.999, count),
    )
    found = momentary_dwells(r1, r3, r5, e)
    a, m, o, w = (x.astype(LONG) for x in (r1, r3, r5, e))
    b, s = a + m, a + 2 * m + o
    low = s * (a / (np.sqrt(b * (b + o)) + np.sqrt(m * (m + o)))) ** 2
    share = (a - w) * (a + w) / ((a - low) * (a + low))
    inside = (low < w) & (w < a)
    assert np.array_equal(found.exists[np.abs(w - low) > 1e-12 * a], inside[np.abs(w - low) > 1e-12 * a])
    exact = np.sqrt((s - low) ** 2 * share + o * o * (1 - share))[found.exists]
    errors = np.abs(found.frame[found.exists] - exact).astype(float) / (EPS * exact.astype(float))
    condition = 1.0 + (low / np.maximum(a - low, LONG(1e-30))).astype(float)[found.exists]
    i = int(np.argmax(errors / condition))
    design = tuple(float(x[found.exists][i]) for x in (r1, r3, r5, e))
    worst.take("frame", float((errors / condition)[i]), design)
    worst.check("momentary frame", count, {"frame": 8.0})


@pytest.mark.parametrize("count", [20, pytest.param(max(1, MANY // 200), marks=pytest.mark.stress)])
def test_unloading_laws(count: int) -> None:
    """The energy parameter by Gauss-Legendre in the plain pendulum angle, 100 panels of 20; condition 1 for pivot
    ratios that are clear of 1 (below 1.05 the plain rule itself gives out)."""
    nodes, weights = np.polynomial.legendre.leggauss(20)
    panel = 0.5 * math.pi / 100
    u = (panel * (np.arange(100)[:, None] + 0.5 * (1.0 + nodes))).ravel()
    w = np.tile(0.5 * panel * weights, 100)
    rng, worst = np.random.default_rng(19), Worst()
    for _ in range(count):
        ratio, swing = 1.0 + 10.0 ** float(rng.uniform(-1.3, 2.0)), math.radians(float(rng.uniform(1e-6, 299.0)))
        device: Any = Pneumatic(ratio) if rng.random() < 0.5 else Spring(ratio, float(rng.uniform(0.05, 3.0)))
        made = ElasticLaw(device, swing)
        total = math.fsum(made.slowness(np.sin(u), np.cos(u)) * w)
        other = (2.0 / swing * total) ** 2
        worst.take("energy parameter", abs(made.energy_parameter / other - 1.0) / EPS, (device, swing))
    worst.check("unloading law", count, {"energy parameter": 64.0})
