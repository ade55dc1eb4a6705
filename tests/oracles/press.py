"""A flatbed press computed a second time, in 40 digits: circles, law of cosines, roots and numerical derivatives.

Nothing here is shared with the program: the four-bars are solved by the cosine rule, not by half angles; the crank
of the slider by a root, not in closed form; derivatives by mpmath, not by the chain rule; the polynomials of the lift
by the linear equations of their ends.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, wraps

import mpmath as mp

DIGITS = 40


def constant(method):
    """A cached property worked out in all its digits, whatever the precision of whoever asks first."""

    @wraps(method)
    def with_all_digits(self):
        with mp.workdps(DIGITS + 20):
            return method(self)

    return cached_property(with_all_digits)


def rocker(links, phi):
    """Direction of the driven crank at a crank angle, one of its branches."""
    a, b, c, d, side = links
    from_pivot = a * mp.expj(phi) - d
    reach = abs(from_pivot)
    return mp.arg(from_pivot) - side * mp.acos((c * c + reach * reach - b * b) / (2 * c * reach))


def turned(links, start, phi):
    """Angle turned by the driven crank of a drag link while its crank turns from `start` to `start + phi`."""
    angle = rocker(links, start + phi) - rocker(links, start)
    return angle + 2 * mp.pi * mp.nint((phi - angle) / (2 * mp.pi))


@dataclass(frozen=True)
class Press:
    """Numbers of a design file: mm and degrees."""

    bed: tuple
    crank_offset_angle: float
    stroke: float
    rod: float
    offset: float
    cylinder: tuple
    initial_crank_angle: float
    radius: float
    gear_ratio: float = 1.0

    def scaled(self, k):
        """The same machine, k times as large."""
        bed, cylinder = (tuple(k * x for x in links[:4]) + links[4:] for links in (self.bed, self.cylinder))
        lengths = (k * self.stroke, k * self.rod, k * self.offset)
        return Press(
            bed,
            self.crank_offset_angle,
            *lengths,
            cylinder,
            self.initial_crank_angle,
            k * self.radius,
            self.gear_ratio,
        )

    def spec(self, **sections):
        """The design file."""
        names = ("crank", "coupler", "rocker", "frame", "assembly")
        cylinder = {
            "radius": self.radius,
            "gear_ratio": self.gear_ratio,
            "double_crank": dict(zip(names, self.cylinder, strict=True)),
            "initial_crank_angle": self.initial_crank_angle,
        }
        bed = {
            "stroke": self.stroke,
            "double_crank": dict(zip(names, self.bed, strict=True)),
            "crank_offset_angle": self.crank_offset_angle,
            "rod": self.rod,
            "offset": self.offset,
        }
        return {"kind": "flatbed-press", "speed": 4500.0, "cylinder": cylinder, "bed": bed, **sections}

    @constant
    def crank(self):
        """Crank DE from the stroke of the slider, by bisection of the two dead centres' distance."""
        half, rod, e = mp.mpf(self.stroke) / 2, mp.mpf(self.rod), mp.mpf(self.offset)

        def excess(x):
            return mp.sqrt((rod + x) ** 2 - e * e) - mp.sqrt((rod - x) ** 2 - e * e) - half

        return mp.findroot(excess, (half / 4, rod - abs(e)), solver="anderson")

    @constant
    def crank_start(self):
        """Direction of AB at the start: of the two circles' meeting points the one of the assembly."""
        a, b, c, d, side = self.bed
        psi = -mp.pi / 2 - mp.asin(mp.mpf(self.offset) / (self.rod + self.crank))
        joint = d + c * mp.expj(psi + mp.radians(self.crank_offset_angle))
        spread = mp.acos((a * a + abs(joint) ** 2 - b * b) / (2 * a * abs(joint)))
        for sign in (1, -1):
            angle = mp.arg(joint) + sign * spread
            pin = a * mp.expj(angle)
            if side * mp.im(mp.conj(d - pin) * (joint - pin)) > 0:
                return angle - 2 * mp.pi * mp.nint(angle / (2 * mp.pi))
        raise AssertionError("no such assembly")

    def cam(self, phi):
        """Angle turned by CD."""
        return turned(self.bed, self.crank_start, phi)

    def _depth(self, cam):
        psi = -mp.pi / 2 - mp.asin(mp.mpf(self.offset) / (self.rod + self.crank)) + cam
        pin = self.crank * mp.expj(psi)
        return -mp.im(pin) + mp.sqrt(mp.mpf(self.rod) ** 2 - (mp.re(pin) + self.offset) ** 2)

    def p(self, phi):
        """Travel of the bed."""
        return 2 * (self._depth(mp.mpf(0)) - self._depth(self.cam(phi)))

    def q(self, phi):
        """Travel of the cylinder's surface."""
        start = mp.radians(self.initial_crank_angle)
        return -self.radius * mp.mpf(self.gear_ratio) * turned(self.cylinder, start, -phi)

    def gap(self, phi):
        """Travel of the bed less that of the cylinder."""
        return self.p(phi) - self.q(phi)

    def input_at(self, cam, guess):
        """Input angle at a cam angle."""
        return mp.findroot(lambda phi: self.cam(phi) - cam, (guess, guess + mp.mpf("1e-4")))

    @constant
    def equal_speed(self):
        """First equality of the speeds after the start, from a scan every degree."""
        before = None
        for degree in range(361):
            phi = mp.radians(degree)
            with mp.workdps(20):
                value = mp.diff(self.gap, phi)
            if before is not None and before < 0 <= value:
                return mp.findroot(lambda x: mp.diff(self.gap, x), (phi - mp.radians(1), phi), solver="anderson")
            before = value
        raise AssertionError("no equality")

    def end_of(self, start, length):
        """Where the cylinder has turned `length` beyond `start`."""
        base = self.q(start)
        return mp.findroot(lambda phi: self.q(phi) - base - length, (start, start + mp.pi), solver="anderson")


def polynomial(conditions):
    """Coefficients c0, c1 ... of the polynomial with (place, order of derivative, value), by linear equations."""
    n = len(conditions)
    rows = [
        [mp.ff(power, order) * mp.mpf(place) ** (power - order) if power >= order else mp.mpf(0) for power in range(n)]
        for place, order, _ in conditions
    ]
    return mp.lu_solve(mp.matrix(rows), mp.matrix([value for *_, value in conditions]))


def at(coefficients, u):
    """Value of a polynomial."""
    return mp.fsum(c * u**n for n, c in enumerate(coefficients))


TY460 = Press((116.0, 100.0, 100.0, 37.0, 1), 177.0, 620.0, 520.0, 50.0, (100.0, 100.0, 95.0, 40.0, -1), 57.109, 140.0)
# Three more machines: every sign of the offset, both assemblies of both drag links, one and two revolutions a sheet.
PRESSES = {
    "ty460": TY460,
    "negative offset": Press(
        (110.0, 96.0, 104.0, 30.0, 1), 150.0, 560.0, 480.0, -40.0, (90.0, 100.0, 95.0, 35.0, -1), 60.0, 126.0
    ),
    "centric, two revolutions a sheet": Press(
        (120.0, 100.0, 105.0, 40.0, -1), -160.0, 600.0, 600.0, 0.0, (105.0, 100.0, 98.0, 42.0, -1), 95.0, 68.0, 2.0
    ),
    "mirrored cylinder chain": Press(
        (100.0, 90.0, 95.0, 25.0, 1), 190.0, 500.0, 430.0, 25.0, (100.0, 95.0, 90.0, 30.0, 1), 120.0, 124.3
    ),
}
