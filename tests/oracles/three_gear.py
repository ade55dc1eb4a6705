"""The three-gear four-bar once more: the triangle BCD by the cosine rule, speeds by numerical derivatives."""

from __future__ import annotations

from dataclasses import dataclass

import mpmath as mp


@dataclass(frozen=True)
class Drive:
    """Crank, coupler, rocker, frame [mm], teeth of crank gear, idler and output gear, assembly."""

    crank: float
    coupler: float
    rocker: float
    frame: float
    teeth: tuple
    assembly: int = 1

    def triangle(self, phi):
        """Direction of D from B, and the angles at B and D of the triangle BCD."""
        to_d = self.frame - self.crank * mp.expj(phi)
        reach, b, c = abs(to_d), mp.mpf(self.coupler), mp.mpf(self.rocker)
        at_b = mp.acos((b * b + reach**2 - c * c) / (2 * b * reach))
        at_d = mp.acos((c * c + reach**2 - b * b) / (2 * c * reach))
        if self.frame > self.crank:
            return mp.arg(to_d), at_b, at_d
        # the crank goes round D: counted from the crank the direction never passes a branch
        return phi + mp.pi + mp.arg(-to_d * mp.expj(-phi)), at_b, at_d

    def output(self, phi):
        """phi5 but for a constant: gear 1 turns with the crank, the idler rolls on it, the output gear on the idler."""
        z1, z3, z5 = self.teeth
        direction, at_b, at_d = self.triangle(phi)
        coupler = direction + self.assembly * at_b
        rocker = direction + mp.pi - self.assembly * at_d
        # seen from the coupler the idler turns by -z1/z3 of gear 1; seen from the rocker gear 5 by -z3/z5 of the idler
        idler = coupler - mp.mpf(z1) / z3 * (phi - coupler)
        return rocker - mp.mpf(z3) / z5 * (idler - rocker)

    def speed(self, phi):
        """Speed ratio of the output."""
        return mp.diff(self.output, phi)

    def acceleration(self, phi):
        """Acceleration ratio of the output."""
        return mp.diff(self.output, phi, 2)

    def transmission(self, phi):
        """Angle BCD, folded to at most 90 deg."""
        _, at_b, at_d = self.triangle(phi)
        gamma = mp.pi - at_b - at_d
        return min(gamma, mp.pi - gamma)

    def roots(self, function, step=1.0):
        """Roots in [0, 2 pi), from sign changes every `step` degrees."""
        count = round(360 / step)
        places = [mp.radians(step * (i + mp.mpf("0.37"))) for i in range(count + 1)]
        with mp.workdps(20):
            signs = [mp.sign(function(place)) for place in places]
        found = []
        for i in range(count):
            if signs[i] * signs[i + 1] < 0:
                root = mp.findroot(function, (places[i], places[i + 1]), solver="anderson")
                found.append(root % (2 * mp.pi))
        return sorted(found)
