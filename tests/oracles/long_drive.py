"""Geared four-bars computed again over arrays in 80-bit numbers: loop by circle intersection, gears mesh by mesh.

No formula is the program's. The joint C comes from the two circles about B and D, the rates from the loop's linear
system by Cramer's rule. Angles are continuous by what a linkage cannot do, not by counting turns: a rocker never
crosses the line of the frame in a crank-rocker, a coupler never that of the crank in a drag link.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

LONG = np.longdouble
PI = 4 * np.arctan(LONG(1))
FIELDS = ("a", "b", "c", "d")


def cross(u: Any, v: Any) -> Any:
    return u[0] * v[1] - u[1] * v[0]


def dot(u: Any, v: Any) -> Any:
    return u[0] * v[0] + u[1] * v[1]


@dataclass(frozen=True)
class Loop:
    """Angles of coupler and rocker, first and second derivatives, sin(gamma) and |BD|, arrays of one shape."""

    angles: tuple
    velocities: tuple
    accelerations: tuple
    sine: Any
    diagonal: Any


@dataclass(frozen=True)
class Drives:
    """Lengths, assembly and the mesh ratios of many geared four-bars; they broadcast with the crank angles.

    meshes: pairs (carrier, ratio) from the gear on the crank or the coupler on; each gear turns against its carrier
    by the ratio of how the gear before does. first: the link that carries the first gear.
    """

    a: Any
    b: Any
    c: Any
    d: Any
    side: Any
    first: str
    meshes: tuple

    @classmethod
    def three_gears(cls, lengths: Any, side: Any, teeth: Any) -> Drives:
        """Gear 1 on the crank, the idler on the coupler, gear 5 on the rocker."""
        z1, z3, z5 = (np.asarray(z, dtype=LONG) for z in teeth)
        return cls(*_long(lengths), np.asarray(side), "crank", (("coupler", -z1 / z3), ("rocker", -z3 / z5)))

    @classmethod
    def one_mesh(cls, lengths: Any, side: Any, ratio: Any, carrier: str) -> Drives:
        """A gear fixed to the coupler drives one that is free on the pivot of its carrier."""
        return cls(*_long(lengths), np.asarray(side), "coupler", ((carrier, np.asarray(ratio, dtype=LONG)),))

    def at(self, index: Any) -> Drives:
        """Some of them, or an axis more."""
        meshes = tuple((carrier, ratio[index]) for carrier, ratio in self.meshes)
        lengths = {name: getattr(self, name)[index] for name in FIELDS}
        return replace(self, side=self.side[index], meshes=meshes, **lengths)

    def loop(self, phi: Any) -> Loop:
        """The four-bar at crank angles."""
        x = np.asarray(phi, dtype=LONG)
        e_a = (np.cos(x), np.sin(x))
        to_d = (self.d - self.a * e_a[0], -self.a * e_a[1])
        square = dot(to_d, to_d)
        along = (self.b * self.b - square - self.c * self.c) / (2 * square)
        across = self.side * np.sqrt(self.c * self.c / square - along * along)
        e_c = ((along * to_d[0] - across * to_d[1]) / self.c, (along * to_d[1] + across * to_d[0]) / self.c)
        e_b = ((to_d[0] + self.c * e_c[0]) / self.b, (to_d[1] + self.c * e_c[1]) / self.b)
        sine = cross(e_b, e_c)
        w_b, w_c = self._by_cramer(self.a * e_a[0], self.a * e_a[1], e_b, e_c, sine)
        cosine = dot(e_b, e_c)
        pull_b = self.a * dot(e_a, e_c) + self.b * w_b * w_b * cosine - self.c * w_c * w_c
        pull_c = self.a * dot(e_a, e_b) + self.b * w_b * w_b - self.c * w_c * w_c * cosine
        rates = (pull_b / (self.b * sine), pull_c / (self.c * sine))
        return Loop(self._continuous(x, e_a, e_b, e_c), (w_b, w_c), rates, sine, np.sqrt(square))

    def _by_cramer(self, x: Any, y: Any, e_b: Any, e_c: Any, sine: Any) -> tuple:
        """Rates w_b, w_c of  i b e_b w_b - i c e_c w_c = -i (x + i y)."""
        pushed = (x, y)
        return cross(pushed, e_c) / (-self.b * sine), cross(pushed, e_b) / (-self.c * sine)

    def _continuous(self, x: Any, e_a: Any, e_b: Any, e_c: Any) -> tuple:
        lead = np.arctan2(cross(e_b, e_c), dot(e_b, e_c))
        rocker = np.arctan2(e_c[1], e_c[0])
        round_ = x + np.arctan2(cross(e_a, e_b), dot(e_a, e_b))
        coupler = np.where(self.d < self.a, round_, rocker - lead)
        return coupler, coupler + lead

    def through(self, crank: Any, links: tuple) -> Any:
        """What the output gear does when crank, coupler and rocker do this: angles, speeds or accelerations."""
        of = {"crank": crank, "coupler": links[0], "rocker": links[1]}
        gear = of[self.first]
        for carrier, ratio in self.meshes:
            gear = of[carrier] + ratio * (gear - of[carrier])
        return gear

    def angle(self, phi: Any) -> Any:
        """Output angle but for a constant."""
        return self.through(np.asarray(phi, dtype=LONG), self.loop(phi).angles)

    def turned(self, phi: Any) -> Any:
        """Output angle, 0 at the crank angle 0."""
        return self.angle(phi) - self.angle(np.zeros_like(np.asarray(phi, dtype=LONG)))

    def speed(self, phi: Any) -> Any:
        return self.through(LONG(1), self.loop(phi).velocities)

    def acceleration(self, phi: Any) -> Any:
        return self.through(LONG(0), self.loop(phi).accelerations)

    def size(self, function: str, phi: Any) -> Any:
        """Sum of the magnitudes of the terms of a result: what rounding them alone leaves open.

        Of angles half a revolution of each link, of accelerations those of the acceleration polygon.
        """
        shares = [abs(self.through(*unit)) for unit in ((1, (0, 0)), (0, (1, 0)), (0, (0, 1)))]
        if function == "turned":
            return sum(shares) * np.maximum(PI, np.abs(phi))
        loop = self.loop(phi)
        w_b, w_c = loop.velocities
        if function == "speed":
            return shares[0] + shares[1] * abs(w_b) + shares[2] * abs(w_c)
        pull = (self.a + self.b * w_b * w_b + self.c * w_c * w_c) / abs(loop.sine)
        return pull * (shares[1] / self.b + shares[2] / self.c)

    def condition(self, function: str, phi: Any) -> Any:
        """What an error is measured by: how far the inputs' last digits move the result, and the size of its terms.

        The output angle is the difference of two places, of which each has its own sensitivity.
        """
        if function == "turned":
            both = self.sensitivity("angle", phi) + self.sensitivity("angle", np.zeros_like(phi))
            return both + self.size("turned", phi)
        return self.sensitivity(function, phi) + self.size(function, phi)

    def sensitivity(self, function: str, phi: Any, step: float = 1e-8) -> Any:
        """How far a result moves per relative change of every length and of the crank angle, all against it.

        sum |x df/dx| by central differences in 80 bits: seven digits of them are good.
        """
        phi = np.asarray(phi, dtype=LONG)
        up, down = LONG(1) + LONG(step), LONG(1) - LONG(step)
        total = np.abs(getattr(self, function)(phi * up) - getattr(self, function)(phi * down))
        for name in FIELDS:
            more, less = (replace(self, **{name: getattr(self, name) * factor}) for factor in (up, down))
            total = total + np.abs(getattr(more, function)(phi) - getattr(less, function)(phi))
        return total / (2 * LONG(step))


def _long(lengths: Any) -> list:
    return [np.asarray(length, dtype=LONG) for length in lengths]
