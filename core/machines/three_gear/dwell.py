"""How the output of the three-gear four-bar goes, with any teeth, in crank-rocker and drag link: where it stands.

The output stands still where A and the poles of both meshes lie on one line. That is a quadratic in cos^2(beta), beta
the base angle of the triangle between C and the poles, so there are at most two standstills a turn and none has to be
searched for; `gearlink.core.machines.three_gear.momentary` has the case of the double root. Where coupler and rocker
are not in proportion to the teeth, standstills are bracketed roots of the output's speed: `ByRoots`.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, unlike
from gearlink.core.machines.three_gear.momentary import (
    Tangency,
    crank_angle,
    pole_lengths,
    ring_standstills,
    ring_tangency,
    tangency,
    tangency_range,
    wrap,
)
from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.numerics.elementary import SCALARS, Elementary
from gearlink.core.parts.linkages.checks import check_linkage
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.geared_output import GearedOutput
from gearlink.core.parts.linkages.standstills import standstills

# A frame that is off by 1e-9 of its length moves the minimum speed ratio by about as much. No workshop can tell such
# frames apart, so nearer to zero than this the output has one standstill, not two or none.
STANDSTILL_TOLERANCE = 1e-9
_LINK_TOLERANCE = 1e-9
_NEAR = 1e-2
"""Angle to the minimum speed [rad] that a linkage within the tolerance of a momentary dwell has at most."""


class Output(GearedOutput):
    """The output of a drive whose coupler and rocker are in proportion to z1 + z3 and z3 + z5.

    Parameters
        linkage : FourBar [mm]
        places : list of float [rad] - where the output stands, where that is known
    Example
        >>> import math
        >>> output = Output(FourBar(18.0, 50.0, 100.0, 121.4), GearTrain(20, 20, 60))
        >>> round(math.degrees(output.angle(2.0 * math.pi)), 9), round(output.speed(0.0), 12)
        (120.0, 0.217279174726)
        >>> round(output.speed_ratio_max, 9), round(math.degrees(output.speed_ratio_min_at), 6)
        (0.758734009, 276.311226)
        >>> round(math.degrees(output.back_step.crank_angle), 9), round(math.degrees(output.back_step.angle), 9)
        (58.668592868, 1.212200833)
        >>> round(math.degrees(output.dwell_angle), 9)
        88.188661262
        >>> found = output.within(math.radians(1.0))
        >>> round(math.degrees(found.start), 9), round(math.degrees(found.crank_angle), 9)
        (217.998931749, 123.008371818)
        >>> found = Output(FourBar(18.0, 50.0, 100.0, 120.79635262063678), output.train).ripple
        >>> round(math.degrees(found.crank_angle), 6)
        108.824649
    """

    train: GearTrain

    def __init__(self, linkage: FourBar, train: GearTrain, places: list[float] | None = None) -> None:
        super().__init__(linkage, train)
        self._given_places = places

    @property
    def frame_ratio(self) -> float:
        """Frame over crank."""
        return self.linkage.frame / self.linkage.crank

    @cached_property
    def ahead(self) -> Output:
        """The same, counted in the direction of its mean motion.

        Example
            >>> Output(FourBar(22.0, 41.0, 37.0, 46.0), GearTrain(24, 17, -54)).ahead.train.sense
            -1
        """
        if self.mean_ratio > 0.0:
            return self
        return type(self)(self.linkage, replace(self.train, sense=-self.train.sense), self._given_places)

    @cached_property
    def places(self) -> list[float]:
        """Crank angles at which the output stands still: none, one (a momentary dwell) or two.

        Q X^2 + (2 P g - 4 S^2 h) X + g^2 = 0,   X = cos^2(beta),
        h = a^2 - r1^2,  g = h + r5^2 - d^2,  S = r1 + 2 r3 + r5,  P = S^2 + r1^2 - r5^2,  Q = P^2 - 4 S^2 r1^2

        Returns
            places : list of float [rad] - ascending in [0, 2 pi)
        Raises
            NoSolution - for another linkage, or links that are not the centre distances of the gears
        Notes
            With d_t the frame of the momentary dwell the discriminant is 4 S^2 r1^2 (d^2 - d_t^2) (d^2 - d_o^2), and
            d^2 - d_o^2 = d^2 - d_t^2 + 4 |h| U V/r1^2: a product without cancellation. Both roots belong to the
            linkage or none does, since the larger one passes 1 only where coupler and rocker stretch straight. A
            linkage whose speed ratio is zero within 1e-9 of its terms at the tangency has one standstill.
            The condition number of two standstills is d/|d - d_t|.
        Example
            >>> import math
            >>> output = Output(FourBar(18.0, 50.0, 100.0, 121.4), GearTrain(20, 20, 60))
            >>> [round(math.degrees(phi), 9) for phi in output.places]
            [247.691347727, 306.359940596]

        Source
            own derivation; thesis 4.2.2 states the condition of the poles
        """
        if self._given_places is not None:
            return self._given_places
        linkage = self.linkage
        check_linkage(linkage)
        r1, r3, r5 = radii = _radii(linkage, self.train)
        if self.train.internal:
            touching = ring_tangency(r1, r3, r5, linkage.crank)
            once = [] if touching is None else self._momentary(touching, radii)
            return once or ring_standstills(self, radii)
        low, high = tangency_range(r1, r3, r5)
        if not low < linkage.crank < high:
            return []
        limit = tangency(r1, r3, r5, linkage.crank)
        momentary = self._momentary(limit, radii)
        if momentary or linkage.frame <= limit.frame:
            return momentary
        poles = standing(linkage.crank, linkage.frame, limit.frame, radii)
        return sorted(crank_angle(r1, r5, *each, linkage.assembly) for each in poles)

    def _momentary(self, limit: Tangency, radii: tuple[float, float, float]) -> list[float]:
        """The one standstill of a linkage that is a momentary dwell within the tolerance, else an empty list."""
        linkage, (r1, r3, r5) = self.linkage, radii
        if abs(linkage.frame - limit.frame) > 1e-3 * limit.frame:
            return []
        reach = (r1 + 2.0 * r3 + r5) * limit.cos_beta
        phi = crank_angle(r1, r5, reach, limit.pole_offset * limit.cos_beta, limit.sin_beta, linkage.assembly)
        if abs(self.speed(phi)) > STANDSTILL_TOLERANCE * self.terms(phi):
            return []
        pull, jerk = self.acceleration(phi), self.jerk(phi)
        if not abs(pull) < _NEAR * abs(jerk):  # links that all but fold: with terms so large any speed is small
            return []
        # One Newton step from the double root of the limit to the minimum speed of this very linkage.
        return [wrap(phi - pull / jerk)]


class ByRoots(Output):
    """The output of a drive whose teeth keep the ratio of the gears at any length of coupler and rocker."""

    @cached_property
    def places(self) -> list[float]:
        """Crank angles of zero output speed [rad], ascending."""
        tolerance = STANDSTILL_TOLERANCE * self.terms(min(self.ahead_turnings, key=lambda one: one.value).place)
        return standstills(self.speed, self.speed_turnings, tolerance)


def motion(places: list[float]) -> str:
    """Kind of output motion, from its standstills.

    Parameters
        places : list of float [rad] - of `Output`
    Returns
        'unidirectional', 'momentary-dwell' or 'back-step'
    Example
        >>> motion(Output(FourBar(18.0, 50.0, 100.0, 121.4), GearTrain(20, 20, 60)).places)
        'back-step'

    Source
        thesis 4.1.2, 4.2.1
    """
    return ("unidirectional", "momentary-dwell", "back-step")[min(len(places), 2)]


def _radii(linkage: FourBar, train: GearTrain) -> tuple[float, float, float]:
    """Reference radii of the gears whose centre distances the coupler and the rocker are."""
    z1, z3, z5 = train.crank, train.idler, train.output
    scale = linkage.coupler / abs(z1 + z3)
    r1, r3 = z1 * scale, z3 * scale
    rocker = scale * abs(z3 + z5)
    if abs(rocker - linkage.rocker) > _LINK_TOLERANCE * rocker:
        raise NoSolution(
            f"rocker: {unlike(linkage.rocker, rocker)} mm (required {unlike(rocker, linkage.rocker)} mm by the coupler "
            f"{short(linkage.coupler)} mm and {z1:g}, {z3:g}, {z5:g} teeth)"
        )
    return r1, r3, linkage.rocker * z5 / abs(z3 + z5)


def standing(
    a: Any, d: Any, limit: Any, radii: tuple[Any, Any, Any], fn: Elementary = SCALARS
) -> tuple[tuple[Any, Any, Any], ...]:
    """Pole triangles of both roots of the quadratic: S cos(beta), AF's part along the pole line, sin(beta).

    Parameters
        a, d : float or array [mm] - crank, and frame; longer than `limit`, that of the momentary dwell
        radii : r1, r3, r5 [mm]
    """
    r1, r3, r5 = radii
    s, (u, v) = r1 + 2.0 * r3 + r5, pole_lengths(r1, r3, r5, fn)
    h = (a - r1) * (a + r1)
    factor = fn.where(a < r1, u + v, s * r1 / (u + v)) / r1
    delta = (d - limit) * (d + limit)
    p, four_huv = 2.0 * (u * u + v * v), 4.0 * abs(h) * u * v
    mean = p * delta + four_huv * factor * factor
    root = 2.0 * s * fn.sqrt(delta * (r1 * r1 * delta + four_huv))
    g = h * factor * factor - delta
    found = []
    for x2 in ((mean + root) / (4.0 * u * v) ** 2, g * g / (mean + root)):
        x = fn.sqrt(x2)
        found.append((s * x, (p * x2 + g) / (2.0 * s * x), fn.sqrt(1.0 - x2)))
    return tuple(found)


def tolerance_from_backlash(backlash: float, output_radius: float) -> float:
    """Tolerance of the output angle that a backlash at the output gear's circle takes up.

    tol = j/(2 r5)

    Parameters
        backlash : float [mm] - j, whole play at the circle r5
        output_radius : float [mm] - r5
    Returns
        tolerance : float [rad] - to either side
    Raises
        NoSolution - for a backlash or a radius that is not positive
    Example
        >>> round(tolerance_from_backlash(0.3419089045018483, 75.0), 12)
        0.002279392697
    """
    if not (backlash > 0.0 and output_radius > 0.0):
        raise NoSolution(
            f"backlash {backlash:g} mm at radius {output_radius:g} mm gives no dwell tolerance; both must be positive"
        )
    return backlash / (2.0 * output_radius)
