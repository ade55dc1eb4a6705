"""A dwell on an arc of a hypocycloid as a design: planet in a ring gear, rod, slider.

A planet of pitch radius r rolls in a ring of n r; a point of its pitch circle draws a hypocycloid of n arcs. Frame:
ring centre at 0, the slide line the x axis, the middle of one arc on it at carrier angle t = 0:

    x = r [(n - 1) cos t - l cos((n - 1) t)],   y = r [(n - 1) sin t + l sin((n - 1) t)]

with l the distance of the point from the planet's axis over r, 1 on the pitch circle. A rod of length L leads from that
point outwards to the slider at s = x + sqrt(L^2 - y^2). The deviation is that from the position at t = 0, positive
towards the ring's centre. The kernel's t is the carrier angle from the middle of the arc.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.design import Found, Outline, placed
from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.real_speed import SLIDER_SPEEDS, SliderSpeed, per_time
from gearlink.core.base.remedies.ways import Way, either, up
from gearlink.core.base.report import Check, Remedy, Shown, Status, Table, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec_paths import changed
from gearlink.core.base.wording import short, unlike
from gearlink.core.mechanism.closures import slider
from gearlink.core.mechanism.courses import Shown as Column
from gearlink.core.mechanism.courses import coordinate, motion_table, of_output, turned
from gearlink.core.mechanism.joints import Connection, Contact, Guide, Mesh, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Course, Input, Motion, Output
from gearlink.core.mechanism.rates import Turn, fixed, standing, steady
from gearlink.core.mechanism.vectors import least_transmission
from gearlink.core.numerics.motion_extremes import names
from gearlink.core.numerics.roots import bracketed_root, maximum, roots_on
from gearlink.core.numerics.roots_sweep import zeros_of
from gearlink.core.parts.gears.codes import DWELL_QUALITY
from gearlink.core.parts.gears.train.meshed import MESH_CHECKS, TRAIN_CHECKS, Meshed, train_ways
from gearlink.core.parts.gears.train.meshed import QUANTITIES as OF_MESH
from gearlink.core.parts.linkages.checks import transmission_check
from gearlink.core.parts.linkages.standstills import Turning
from gearlink.core.studies.clearance import (
    SHAFT_WAYS,
    Gear,
    Layout,
    WithShafts,
    constant,
    least_shaft,
    ring_gear,
    shafts_at,
)

if TYPE_CHECKING:
    from gearlink.core.machines.dwell_gears.hypocycloid_spec import HypocycloidDwellSpec
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.studies.movable import Movable


_STEPS_PER_ARC, _ROWS = 48, 720
_TURN = 2.0 * math.pi


@dataclass(frozen=True)
class HypocycloidSlider:
    """Planet, ring and rod.

    Parameters
        planet_radius : float [mm] - r, pitch radius of the planet
        cusps : int - n >= 3, ring radius over planet radius
        rod : float [mm] - L
        ratio : float - l, the point's distance from the planet's axis over r
    Raises
        NoSolution - for lengths that are not positive, fewer than three cusps, or a rod too short for the turn
    Example
        >>> slider = HypocycloidSlider(1.0, 3, 7.0)
        >>> round(slider.stroke, 12), round(slider.ripple(math.radians(120.0)), 12)
        (4.0, 0.022082869931)

    Source
        thesis 2.2.2, figure 2-5; formulas: own derivation
    """

    planet_radius: float
    cusps: int
    rod: float
    ratio: float = 1.0

    def __post_init__(self) -> None:
        require_cusps(self.planet_radius, self.cusps)
        least = self.widest_offset
        if not least < self.rod < math.inf:
            usual = (
                f" (tangent-circle {short(tangent_circle(self.planet_radius, self.cusps))}, "
                f"osculating {short(osculating(self.planet_radius, self.cusps))} mm)"
                if self.ratio == 1.0
                else ""
            )
            raise NoSolution(
                f"rod: {unlike(self.rod, least)} mm (limit > {unlike(least, self.rod)} mm, the distance of the point "
                "from the slide line)",
                fix=f"set rod above {safely_above(least)} mm{usual}",
            )

    @cached_property
    def widest_offset(self) -> float:
        """Maximum distance of the point from the slide line [mm]."""
        if self.ratio == 1.0:
            return widest_offset(self.planet_radius, self.cusps)
        count = _STEPS_PER_ARC * self.cusps
        grid = [math.pi * (i + 0.5) / count for i in range(count)]
        return max(abs(self.point(t).imag) for t in roots_on(lambda t: self._rates(t)[1], grid))

    def point(self, t: float) -> complex:
        """The point on the planet [mm]."""
        return _point(self.planet_radius, self.cusps, t, self.ratio)

    def deviation(self, t: float) -> float:
        """Slider's place at t = 0 less that at t [mm], positive towards the ring's centre.

        s(0) - s(t) = y^2/(L + sqrt(L^2 - y^2)) - (x - x_0),  x - x_0 = 2 r [l sin^2((n-1) t/2) - (n-1) sin^2(t/2)]

        Parameters
            t : float [rad] - carrier angle from the middle of the arc
        Returns
            deviation : float [mm]
        Notes
            No difference of large lengths is taken.
        """
        y = self.point(t).imag
        advance = _advance(self.planet_radius, self.cusps, t, self.ratio)
        return y * y / (self.rod + math.sqrt(self.rod**2 - y * y)) - advance

    def speed(self, t: float) -> float:
        """Slider's speed outwards per carrier speed, ds/dt [mm/rad]."""
        (x_1, y_1), y = self._rates(t), self.point(t).imag
        return x_1 - y * y_1 / math.sqrt(self.rod**2 - y * y)

    def _rates(self, t: float) -> tuple[float, float]:
        k, far = self.cusps - 1, self.ratio
        scale = self.planet_radius * k
        return scale * (far * math.sin(k * t) - math.sin(t)), scale * (far * math.cos(k * t) + math.cos(t))

    def rod_angle(self, t: float) -> float:
        """Angle of the rod to the slide line [rad]."""
        return math.asin(self.point(t).imag / self.rod)

    @property
    def max_rod_angle(self) -> float:
        """Maximum angle of the rod to the slide line over the revolution [rad]."""
        return math.asin(self.widest_offset / self.rod)

    @cached_property
    def extremes(self) -> list[tuple[float, float]]:
        """Carrier angles in [0, pi] where the slider reverses or rests, with 0 and pi, and its deviations there."""
        count = _STEPS_PER_ARC * self.cusps
        grid = [math.pi * (i + 0.5) / count for i in range(count)]
        return [(t, self.deviation(t)) for t in (0.0, *roots_on(self.speed, grid), math.pi)]

    @property
    def stroke(self) -> float:
        """Stroke of the slider [mm]."""
        values = [value for _, value in self.extremes]
        return max(values) - min(values)

    def deviation_range(self, angle: float) -> tuple[float, float]:
        """Minimum and maximum deviation while the carrier turns by an angle about the middle of the arc.

        Parameters
            angle : float [rad] - whole carrier angle, 0..2 pi
        Returns
            minimum, maximum : float, float [mm]
        Example
            >>> minimum, maximum = HypocycloidSlider(1.0, 3, 7.5).deviation_range(math.radians(120.0))
            >>> round(minimum, 12), round(maximum, 12)
            (-0.035623639735, 0.005358514097)
        """
        half = 0.5 * angle
        values = [value for t, value in self.extremes if t <= half] + [self.deviation(half)]
        return min(values), max(values)

    def ripple(self, angle: float) -> float:
        """Range of the deviation over a carrier angle about the middle of the arc [mm]."""
        least, greatest = self.deviation_range(angle)
        return greatest - least

    def dwell_angle(self, tolerance: float) -> float:
        """Widest carrier angle about the middle of the arc in which the slider stays within +- a tolerance of a place.

        Parameters
            tolerance : float [mm] - half the range that is allowed, > 0
        Returns
            angle : float [rad] - whole carrier angle
        Raises
            NoSolution - for a tolerance that is not positive, or that lets the whole stroke pass
        Notes
            Between two extremes the slider runs one way: the end is a bracketed root, no search.
        Example
            >>> round(math.degrees(HypocycloidSlider(1.0, 3, 7.0).dwell_angle(0.0111)), 6)
            140.881311
        """
        limit = 0.5 * self.stroke
        if not 0.0 < tolerance < limit:
            raise NoSolution(
                f"tolerance: {tolerance:g} mm (above 0, below {safely_below(limit)} mm, half the stroke)",
                fix=f"set dwell.tolerance below {safely_below(limit)} mm",
            )
        low = high = 0.0
        for (t_0, _), (t_1, value) in zip(self.extremes, self.extremes[1:], strict=False):
            if max(high, value) - min(low, value) > 2.0 * tolerance:
                edge = low + 2.0 * tolerance if value > high else high - 2.0 * tolerance
                return 2.0 * bracketed_root(lambda t, edge=edge: self.deviation(t) - edge, t_0, t_1)  # type: ignore[misc]
            low, high = min(low, value), max(high, value)
        raise NoSolution(
            f"the slider stays within +-{tolerance:g} mm over the whole revolution",
            fix=f"set dwell.tolerance below {safely_below(0.5 * (high - low))} mm",
        )


def require_cusps(planet_radius: float, cusps: int) -> None:
    """Refuse a planet without size, and curves that have no arc to dwell on.

    Raises
        NoSolution - for a radius that is not positive and finite, or fewer than three cusps
    Source
        own derivation: with two cusps the curve is a straight line
    """
    if not 0.0 < planet_radius < math.inf:
        raise NoSolution(f"planet radius is {planet_radius:g} mm; it must be positive and finite")
    if cusps < 3:
        raise NoSolution(
            f"the ring has {cusps} times the planet's teeth; with 2 the point runs on a straight "
            "line, with 1 it is at rest",
            fix="use 3 times or more",
        )


def widest_offset(planet_radius: float, cusps: int) -> float:
    """Maximum distance of the point from the slide line, below which no rod can follow it [mm].

    y' = 0 at the cusps and where (n - 2) t is an odd multiple of pi

    Example
        >>> round(widest_offset(1.0, 3), 9), round(widest_offset(1.0, 4), 9)
        (2.598076211, 2.828427125)
    """
    places = [math.pi * k / cusps for k in range(1, 2 * cusps, 2)]
    places += [math.pi * k / (cusps - 2) for k in range(1, 2 * cusps - 4, 2)]
    return max(abs(_point(planet_radius, cusps, t).imag) for t in places)


def tangent_circle(planet_radius: float, cusps: int, angle: float | None = None) -> float:
    """Rod length of the circle through the middle of the arc and two points of it, the cusps by default.

    L = (D^2 + y^2)/(2 D),   D = x - x_0 at half the angle

    Parameters
        planet_radius : float [mm]
        angle : float or None [rad] - carrier angle between the two points; None: the whole arc, 2 pi/n
    Returns
        L : float [mm]
    Raises
        NoSolution - where the curve does not bend outwards to those points
    Notes
        Over the whole arc of a three-cusped curve no other rod has so small a ripple.
    Example
        >>> round(tangent_circle(1.0, 3), 12)
        7.0

    Source
        thesis 2.2.2 ("radius of the arc"); own derivation
    """
    require_cusps(planet_radius, cusps)
    half = math.pi / cusps if angle is None else 0.5 * angle
    y, rise = _point(planet_radius, cusps, half).imag, _advance(planet_radius, cusps, half)
    if rise <= 0.0 or half <= 0.0:
        raise NoSolution(
            f"no circle fits the arc over {short(math.degrees(2.0 * half))} deg of the carrier",
            fix=f"specify at most the whole arc, {safely_below(360.0 / cusps)} deg",
        )
    return (rise * rise + y * y) / (2.0 * rise)


def osculating(planet_radius: float, cusps: int) -> float:
    """Rod length of the circle of curvature in the middle of the arc.

    L = 4 r (n - 1)/(n - 2)

    Example
        >>> osculating(1.0, 3)
        8.0
    """
    require_cusps(planet_radius, cusps)
    return 4.0 * planet_radius * (cusps - 1) / (cusps - 2)


def _point(radius: float, cusps: int, t: float, ratio: float = 1.0) -> complex:
    k = cusps - 1
    return complex(
        radius * (k * math.cos(t) - ratio * math.cos(k * t)), radius * (k * math.sin(t) + ratio * math.sin(k * t))
    )


def _advance(radius: float, cusps: int, t: float, ratio: float = 1.0) -> float:
    """x - x_0 without a difference of cosines."""
    k = cusps - 1
    return 2.0 * radius * (ratio * math.sin(0.5 * k * t) ** 2 - k * math.sin(0.5 * t) ** 2)


# Rod lengths of a hypocycloid dwell that are best in some sense; each is judged on the slider's own motion

_SCAN = 120


def minimax(planet_radius: float, cusps: int, angle: float) -> float:
    """Rod length with the smallest maximum deviation from the slider's place in mid-dwell.

    max |s(t) - s(0)| over +- angle/2  ->  min

    Parameters
        planet_radius : float [mm]
        angle : float [rad] - carrier angle of the dwell, up to the whole arc
    Returns
        L : float [mm]
    Raises
        NoSolution - where no circle touches the arc over that angle
    Notes
        Between the tangent circle and the circle of curvature; place exact to about 1e-9 of the length.
    Example
        >>> round(minimax(1.0, 3, math.radians(120.0)), 6)
        7.191266
    """

    def quality(rod: float) -> float:
        low, high = HypocycloidSlider(planet_radius, cusps, rod).deviation_range(angle)
        return min(-high, low)

    return _best(planet_radius, cusps, quality, angle)


def least_ripple(planet_radius: float, cusps: int, angle: float) -> float:
    """Rod length with the smallest range of the slider's place over a carrier angle, the place itself free.

    max s - min s over +- angle/2  ->  min

    Parameters
        planet_radius, cusps, angle : as of `minimax`
    Returns
        L : float [mm]
    Raises
        NoSolution - as `minimax`
    Notes
        The result is the tangent circle through the ends of the dwell, or lies close by it.
    Example
        >>> round(least_ripple(1.0, 3, math.radians(120.0)), 6)
        7.0
    """
    return _best(planet_radius, cusps, lambda rod: -HypocycloidSlider(planet_radius, cusps, rod).ripple(angle), angle)


def widest_dwell(planet_radius: float, cusps: int, tolerance: float) -> float:
    """Rod length with the widest dwell within +- a tolerance.

    Parameters
        planet_radius : float [mm]
        tolerance : float [mm] - half the range that is allowed
    Returns
        L : float [mm]
    Raises
        NoSolution - for a tolerance that is not positive or not below half the stroke
    Notes
        The width jumps where a hump leaves the band, so that the best rod stands at such an edge: a scan over the
        curvature, then golden section about the best.
    Example
        >>> rod = widest_dwell(1.0, 3, 0.0111)
        >>> HypocycloidSlider(1.0, 3, rod).dwell_angle(0.0111) >= HypocycloidSlider(1.0, 3, 7.0).dwell_angle(0.0111)
        True
    """
    return _best(planet_radius, cusps, lambda rod: HypocycloidSlider(planet_radius, cusps, rod).dwell_angle(tolerance))


def _best(radius: float, cusps: int, quality: Callable[[float], float], angle: float | None = None) -> float:
    """Rod of the maximum quality, sought over its curvature 1/L from well below to well above the named circles."""
    if angle is not None and not 0.0 < angle <= 2.0 * math.pi / cusps * (1.0 + 1e-12):
        raise NoSolution(
            f"dwell: {short(math.degrees(angle))} deg (above 0, at most {safely_below(360.0 / cusps)} deg, one arc)",
            fix=f"set dwell.angle to at most {safely_below(360.0 / cusps)} deg, or omit it for the widest dwell",
        )
    named = (tangent_circle(radius, cusps, angle), osculating(radius, cusps))
    shortest = max(0.7 * min(named), 1.001 * widest_offset(radius, cusps))
    low, high = 1.0 / (2.0 * max(named)), 1.0 / shortest
    curvatures = [low + (high - low) * i / _SCAN for i in range(_SCAN + 1)]
    values = [quality(1.0 / c) for c in curvatures]
    top = max(range(len(values)), key=values.__getitem__)
    step = (high - low) / _SCAN
    best = maximum(lambda c: quality(1.0 / c), max(low, curvatures[top] - step), min(high, curvatures[top] + step))
    return max((1.0 / best[0], *(rod for rod in named if rod > shortest)), key=quality)


# A slotted arm about the ring's centre that a point of the planet turns: step motion of a hypocycloid train


@dataclass(frozen=True)
class SlottedArm:
    """The output of a train.

    Parameters
        teeth : float - n, ring over planet, above 1
        ratio : float - l, above 0 and below n - 1
    Raises
        NoSolution - for a point that turns the arm against the carrier
    Example
        >>> arm = SlottedArm(3.0, 1.0)
        >>> arm.speed_max, arm.speed_min, round(math.degrees(arm.dwell(math.radians(0.5))[0]), 6)
        (4.0, 0.0, 33.29542)

    Source
        thesis 2.2.2; formulas: own derivation
    """

    teeth: float
    ratio: float

    def __post_init__(self) -> None:
        if not 0.0 < self.ratio < self.teeth - 1.0:
            raise NoSolution(
                f"distance of the point from the planet's axis: {self.ratio:g} planet radii (above 0, below "
                f"{safely_below(self.teeth - 1.0)})",
                fix=f"set point.ratio between 0 and {safely_below(self.teeth - 1.0)}",
            )

    @property
    def speed_max(self) -> float:
        """Maximum speed of the arm over the carrier's, in the middle of an arc: (n - 1)(1 + l)/(n - 1 - l)."""
        k = self.teeth - 1.0
        return k * (1.0 + self.ratio) / (k - self.ratio)

    @property
    def speed_min(self) -> float:
        """Minimum speed of the arm over the carrier's, in a cusp: (n - 1)(1 - l)/(n - 1 + l)."""
        k = self.teeth - 1.0
        return k * (1.0 - self.ratio) / (k + self.ratio)

    def angle(self, x: float) -> float:
        """Angle of the arm from the place that it has in a cusp, at a carrier angle from there [rad]."""
        k, n = self.teeth - 1.0, self.teeth
        return x - math.atan2(self.ratio * math.sin(n * x), k + self.ratio * math.cos(n * x))

    @cached_property
    def standstill(self) -> float:
        """Carrier angle from a cusp to the standstill after it [rad]; 0 where the arm never turns back.

        cos n x = ((n - 1) - l^2)/((n - 2) l)
        """
        if self.ratio <= 1.0:
            return 0.0
        n, far = self.teeth, self.ratio
        return math.acos(((n - 1.0) - far * far) / ((n - 2.0) * far)) / n

    @property
    def back_step(self) -> float | None:
        """How far the arm goes back in each step [rad]; None where it never does."""
        return -2.0 * self.angle(self.standstill) if self.ratio > 1.0 else None

    def dwell(self, tolerance: float) -> tuple[float, float]:
        """Longest carrier angle in which the arm stays within +- a tolerance of a place, and where it starts [rad].

        Parameters
            tolerance : float [rad] - half of what the arm may cover, above 0
        Returns
            angle, start : float, float [rad] - of equal ones the first from carrier angle 0 on
        Raises
            NoSolution - for a tolerance that takes in a whole step
        Notes
            About a cusp the angle is odd: where the way back fits in, the window is symmetrical; else it lies about a
            standstill, with both ends on the edge of the band.
        """
        half = math.pi / self.teeth
        if not 0.0 < tolerance < half:
            raise NoSolution(
                f"tolerance: {math.degrees(tolerance):g} deg (above 0, below {safely_below(math.degrees(half))} deg, "
                "half a step)",
                fix=f"set dwell.tolerance below {safely_below(math.degrees(half))} deg",
            )
        top = -self.angle(self.standstill)  # before the cusp
        if top <= tolerance:
            end = bracketed_root(lambda x: self.angle(x) - tolerance, self.standstill, half)
            return 2.0 * end, half - end
        edge = top - 2.0 * tolerance
        before = bracketed_root(lambda x: self.angle(x) - edge, -half, -self.standstill)
        after = bracketed_root(lambda x: self.angle(x) - edge, -self.standstill, self.standstill)
        return after - before, half + before

    def turn(self, t: Reals, order: int) -> Turn:
        """Angle of the arm [rad] and its derivatives by the carrier angle, over an array.

        beta' = 1 + Im u,  u = z_1/z,  u' = z_2/z - u^2,  u'' = z_3/z - u^3 - 3 u u';  z_k the derivatives of z
        """
        n = self.teeth
        around: Any = self.ratio * np.exp(-1j * n * t)
        z = (n - 1.0) - around
        u = 1j * n * around / z
        found = [t + np.angle(z), 1.0 + u.imag]
        if order > 1:
            first = n * n * around / z - u * u
            found.append(first.imag)
            if order > 2:
                found.append((-1j * n**3 * around / z - u**3 - 3.0 * u * first).imag)
        return Turn(*(np.asarray(each) for each in found[: order + 1]))


_ARM = (
    *("steps", "speed_ratio_max", "speed_ratio_min", "back_step_angle", "tolerance_dwell_angle"),
    *("tolerance_dwell_start", "output_speed_max", "output_speed_min"),
)
_RODS = ("rod_length", "stroke", "dwell_ripple", "ripple_share", "tolerance_carrier_angle", "min_transmission_angle")
_SHARED = (
    *("planet_teeth", "ring_teeth", "carrier_length", "point_radius", "contact_ratio", "input_speed", "turn_time"),
    "dwell_time",
)


class HypocycloidDwell(SliderSpeed, WithShafts, Meshed):
    """Slider that dwells while a point of the planet runs along an arc about its centre, or an arm that steps."""

    kind = "hypocycloid-dwell"
    spec: HypocycloidDwellSpec
    keys = {
        "analyze": (
            *(("dwell_carrier_angle", "dwell.angle"), "dwell_ripple", ("ripple_share", "<target.quality"), "stroke"),
            *("rod_length", "tolerance_carrier_angle", ("min_transmission_angle", ">limits.transmission_angle")),
            *("dwell_time", "slider_acceleration_max", "velocity_max", "acceleration_max"),
        )
    }
    outlines = {
        "analyze": Outline(
            (
                *("cusps", "planet_teeth", "ring_teeth", "carrier_length", "point_radius", "rod_length"),
                *("tangent_circle_length", "osculating_length", "dwell_carrier_angle", "dwell_ripple"),
                *("dwell_deviation_min", "dwell_deviation_max", "tolerance_carrier_angle", "stroke", "ripple_share"),
                *("min_transmission_angle", "contact_ratio", *names("velocity", "acceleration"), "input_speed"),
                *("turn_time", *SLIDER_SPEEDS, "dwell_time", *_ARM),
            ),
            ("dwell-quality", "shaft-clearance", "transmission-angle", *MESH_CHECKS),
            ("motion",),
        ),
        "gear": Outline(OF_MESH, (*MESH_CHECKS, *TRAIN_CHECKS)),
    }

    ways = {
        "shaft-clearance": SHAFT_WAYS,
        "transmission-angle": (up("rod.length"),),
        "dwell-quality": either("rod.length"),
        **train_ways(2, Way(("gears.planet", "gears.ring"), 1, "ratio")),
    }

    requirements = Meshed.requirements | {"dwell.tolerance", "dwell.angle"}
    extra_tables = ("drawing", "factors", "candidates")

    def outline(self, command: str) -> Outline:
        """Slider and arm have quantities of their own."""
        found = super().outline(command)
        if command != "analyze":
            return found
        arm = self.spec.is_arm
        shown = tuple(name for name in found.quantities if name in _SHARED or (name in _ARM) is arm)
        checks = tuple(name for name in found.checks if not arm or name != "transmission-angle")
        return found._replace(quantities=shown, checks=checks)

    @property
    def output_columns(self) -> dict[str, tuple[str, ...]]:
        """The slider's position, or the arm's angle."""
        return {"motion": ("output_angle",)} if self.spec.is_arm else {"motion": ("deviation",)}

    def raw(self, name: str) -> Any:
        """What the other output has is None."""
        if name in _ALL and name not in _SHARED and (name in _ARM) is not self.spec.is_arm:
            return None
        return super().raw(name)

    def table_candidates(self, _samples: int | None = None) -> Table:
        """The rods of every rule side by side."""
        from gearlink.core.base.candidates import Sought, nothing_sought, table

        if self.spec.is_arm or self.spec.point.ratio != 1.0:
            raise nothing_sought("the rod is found only for a slider whose point lies on the pitch circle")
        rules = ["tangent-circle", "osculating", "minimax"]
        qualities = ["least-ripple", *(["widest-dwell"] if self.spec.dwell.tolerance is not None else [])]
        rows = [({"rule": rule}, None) for rule in rules] + [(None, {"quality": quality}) for quality in qualities]
        keys = {"rod": ("", ""), "target": ("", "")}
        return table(self, Sought("analyze", keys, rows, _RODS, "rod", [*rules, *qualities]))

    cost = 7.0  # a rod that is sought

    def candidates(self, check: str) -> Iterator[Remedy]:
        """A rod of another rule, or what the slider does over the dwell that is wanted; a curve with a cusp less."""
        if self.spec.is_arm:
            return
        if check == "dwell-quality" and self.tolerance_carrier_angle is not None:
            yield from self._better_rods()
            yield (("dwell.tolerance", math.ceil(501.0 * self.dwell_ripple) / 1000.0),)
            yield (("dwell.angle", math.floor(10.0 * math.degrees(self.tolerance_carrier_angle)) / 10.0),)
        if check == "transmission-angle":
            yield (("gears.ring", self.ring_teeth - self.planet_teeth),)

    def _better_rods(self) -> Iterator[Remedy]:
        """The rod of the minimum ripple over the dwell, to tenths and hundredths; or what is sought of it."""
        rod = self.spec.rod
        if self.spec.point.ratio != 1.0:
            return
        if rod is None:
            yield (("target.quality", "widest-dwell"),)
            return
        spec = changed(self.spec, (("rod", None), ("target", {"quality": "least-ripple"})))
        try:
            found = type(self)(spec).rod_length
        except NoSolution:  # a dwell beyond one arc has no such rod
            return
        given: Remedy = () if rod.rule is None else (("rod.rule", None),)
        yield from ((("rod.length", round(found, digits)), *given) for digits in (1, 2))

    # Gears and rod

    planet_teeth: int = placed("spec.gears.planet")
    ring_teeth: int = placed("spec.gears.ring")

    @cached_property
    def cusps(self) -> int:
        """Cusps of the curve, ring teeth over planet teeth."""
        planet, ring = self.planet_teeth, self.ring_teeth
        if (far := self.spec.point.ratio) != 1.0 and far >= ring / planet - 1.0:
            most = ring / planet - 1.0
            message = f"point.ratio: {far:g} (above 0, below ring/planet - 1 = {safely_below(most)})"
            raise NoSolution(message, key="point.ratio")
        if ring % planet:
            near = max(3, round(ring / planet))
            raise NoSolution(
                f"ring {ring} over planet {planet} teeth is {unlike(ring / planet, round(ring / planet))}: the "
                "curve does not close in one revolution of the carrier",
                key="gears.ring",
                fix=f"set gears.ring to {near * planet}",
            )
        with at_key("gears.ring"):
            require_cusps(self.point_radius, ring // planet)
        return ring // planet

    @property
    def point_radius(self) -> float:
        """Pitch radius of the planet, on which the point lies [mm]; of shifted teeth the working one."""
        if self.own_teeth:
            return self.distance() * self.planet_teeth / (self.ring_teeth - self.planet_teeth)
        return self.spec.gears.module * self.planet_teeth / 2.0

    @property
    def carrier_length(self) -> float:
        """Centre distance of planet and ring gear [mm]."""
        return self.distance()

    @property
    def signed_teeth(self) -> tuple[int, ...]:
        """Planet and ring gear."""
        return self.planet_teeth, -self.ring_teeth

    @property
    def tangent_circle_length(self) -> float | None:
        """Rod of the circle through the ends and the middle of the dwell [mm]; None beside the pitch circle."""
        if self.spec.point.ratio != 1.0:
            return None
        with at_key("dwell.angle"):
            return tangent_circle(self.point_radius, self.cusps, self.dwell_carrier_angle)

    @property
    def osculating_length(self) -> float | None:
        """Rod of the circle of curvature [mm]; None beside the pitch circle."""
        return osculating(self.point_radius, self.cusps) if self.spec.point.ratio == 1.0 else None

    @property
    def dwell_carrier_angle(self) -> float:
        """Carrier angle of the dwell that is wanted [rad]."""
        asked = self.spec.dwell.angle
        return 2.0 * math.pi / self.cusps if asked is None else math.radians(asked)

    @cached_property
    def rod_length(self) -> float:
        """Rod [mm], given, by rule or by target."""
        rod, target, tolerance = self.spec.rod, self.spec.target, self.spec.dwell.tolerance
        if target is None and rod is not None and rod.length is not None:
            return rod.length
        if target is not None and target.quality == "widest-dwell" and tolerance is not None:
            with at_key("dwell.tolerance"):
                return widest_dwell(self.point_radius, self.cusps, tolerance)
        if rod is not None and rod.rule == "osculating":
            return osculating(self.point_radius, self.cusps)
        way = minimax if target is None else least_ripple
        if rod is not None and rod.rule == "tangent-circle":
            way = tangent_circle
        with at_key("dwell.angle"):
            return way(self.point_radius, self.cusps, self.dwell_carrier_angle)

    def completion(self) -> Iterator[Found]:
        """The rod instead of the target or the rule."""
        if not self.spec.is_arm and (self.spec.rod is None or self.spec.rod.rule is not None):
            yield Found("rod.length", self.rod_length, "found for target" if self.spec.target else "found by rod.rule")
            yield Found("rod.rule", None)
            yield Found("target", None)

    # A slotted arm

    @cached_property
    def arm(self) -> SlottedArm:
        """The kernel's view of gears and arm."""
        with at_key("point.ratio"):
            return SlottedArm(self.ring_teeth / self.planet_teeth, self.spec.point.ratio)

    @property
    def steps(self) -> int | None:
        """Steps of the arm per revolution of the carrier; None where teeth make no whole number."""
        planet, ring = self.planet_teeth, self.ring_teeth
        return None if ring % planet else ring // planet

    speed_ratio_max: float = placed("arm.speed_max")
    speed_ratio_min: float = placed("arm.speed_min")
    back_step_angle: float | None = placed("arm.back_step")
    output_speed_max: float | None = per_time("speed_ratio_max", 1)
    output_speed_min: float | None = per_time("speed_ratio_min", 1)

    @cached_property
    def _arm_dwell(self) -> tuple[float, float] | None:
        if self.spec.dwell.tolerance is None:
            return None
        with at_key("dwell.tolerance"):
            return self.arm.dwell(math.radians(self.spec.dwell.tolerance))

    tolerance_dwell_angle: float | None = placed("_arm_dwell.0")
    tolerance_dwell_start: float | None = placed("_arm_dwell.1")

    # Motion

    @cached_property
    def slider(self) -> HypocycloidSlider:
        """The kernel's view of gears and rod."""
        with at_key("rod" if self.spec.target is None else "target"):
            return HypocycloidSlider(self.point_radius, self.cusps, self.rod_length, self.spec.point.ratio)

    stroke: float = placed("slider.stroke")

    @property
    def _deviations(self) -> tuple[float, float]:
        """Minimum and maximum deviation in the dwell [mm]."""
        return self.slider.deviation_range(self.dwell_carrier_angle)

    dwell_deviation_min: float = placed("_deviations.0")
    dwell_deviation_max: float = placed("_deviations.1")

    @property
    def dwell_ripple(self) -> float:
        """Range of the slider's position in the dwell [mm]."""
        return self.dwell_deviation_max - self.dwell_deviation_min

    @property
    def ripple_share(self) -> float:
        """Ripple over stroke."""
        return self.dwell_ripple / self.stroke

    @cached_property
    def tolerance_carrier_angle(self) -> float | None:
        """Widest carrier angle within the file's tolerance [rad]."""
        if self.spec.dwell.tolerance is None:
            return None
        with at_key("dwell.tolerance"):
            return self.slider.dwell_angle(self.spec.dwell.tolerance)

    @cached_property
    def _turnings(self) -> list[list[Turning]]:
        """Turnings of the slider's velocity [mm/rad] and acceleration outwards over half a turn, and its ends."""
        way, rows = outwards(self), math.ceil(_STEPS_PER_ARC * self.cusps / _ROWS)

        def rate(order: int) -> Callable[[Reals], Reals]:
            return lambda t: way.rates(self.moving, t, 3)[order]

        places = [[0.0, *inside, math.pi] for inside in zeros_of([rate(2), rate(3)], math.pi, rows)]
        return [list(map(Turning, at, rate(order)(np.array(at)).tolist())) for order, at in enumerate(places, 1)]

    @cached_property
    def fastest(self) -> tuple[Turning, Turning]:
        """Maximum velocity outwards, and inwards: the motion is its own mirror image."""
        place, value = max(self._turnings[0], key=lambda each: abs(each.value))
        forth = Turning(place, value) if value > 0.0 else Turning(_TURN - place, -value)
        return forth, Turning(_TURN - forth.place, -forth.value)

    @cached_property
    def hardest(self) -> tuple[Turning, Turning]:
        """Maximum and minimum acceleration outwards, at the first of both places."""
        every = self._turnings[1]
        return max(every, key=lambda each: each.value), min(every, key=lambda each: each.value)

    dwell_time: float | None = per_time("_dwell_reached", -1)

    @property
    def _dwell_reached(self) -> float | None:
        """Carrier angle of the dwell within the tolerance, else of the one that is wanted [rad]."""
        if self.spec.is_arm:
            return self.tolerance_dwell_angle
        return self.tolerance_carrier_angle or self.dwell_carrier_angle

    @property
    def min_transmission_angle(self) -> float:
        """Minimum angle between the rod and the normal of the slide line over the revolution [rad]."""
        return 0.5 * math.pi - self.slider.max_rod_angle

    @cached_property
    def layout(self) -> Layout:
        """The planet on its carrier, which goes round the shaft O, and the ring gear."""
        spec, mesh = self.spec, self.mesh
        gears = Gear("the planet", "M", mesh.tip_radius[0], mates="O"), ring_gear("O", mesh, rim=self.rim_of(""))
        way, least = {"MO": constant(self.carrier_length)}, least_shaft(spec.limits, spec.gears.module)
        return Layout(gears, shafts_at("O", spec.shafts), way, least)

    def table_motion(self, samples: int | None = None) -> Table:
        """Slider and point over a revolution of the carrier; the middle of the dwell is at carrier angle 0."""
        point = -self.spec.point.ratio * self.point_radius
        path = Column("x", coordinate("planet", point)), Column("y", coordinate("planet", point, 1j))
        if self.spec.is_arm:
            return motion_table("motion", self, [*of_output(turned("arm")), *path], samples)
        way = outwards(self)
        shown = [
            Column("deviation", way.scaled(-1.0)),
            Column("velocity", way, 1, "slider_velocity"),
            Column("acceleration", way, 2, "slider_acceleration"),
            Column("rod_angle", turned("rod", sense=-1.0)),
            *path,
        ]
        return motion_table("motion", self, shown, samples)

    # Checks

    def check_dwell_quality(self) -> Iterator[Check]:
        """GL311: the dwell that is reached within the tolerance against the one that is wanted."""
        tolerance, asked, arm = self.spec.dwell.tolerance, self.spec.dwell.angle, self.spec.is_arm
        reached = self.tolerance_dwell_angle if arm else self.tolerance_carrier_angle
        if tolerance is None or reached is None or (arm and asked is None):
            return
        wanted = asked if arm and asked is not None else math.degrees(self.dwell_carrier_angle)
        found = math.degrees(reached)
        met, aside = found >= wanted - 1e-9, f"within +-{short(tolerance)} {'deg' if arm else 'mm'}"
        if not met and not arm:
            aside += f"; the slider moves {short(self.dwell_ripple)} mm over the required angle"
        what, fix = f"dwell of the {'arm' if arm else 'slider'}", "allow a larger dwell.tolerance"
        shown = Shown(found, min(wanted, found) if met else wanted, "deg", ">=")
        status: Status = "pass" if met else "fail"
        yield DWELL_QUALITY.check(status, what, found, wanted, "deg", shown=shown, aside=aside, fix=fix)

    def check_transmission_angle(self) -> Check:
        """GL303: the rod against the slide line."""
        remedy = "lengthen the rod, or use a curve with fewer cusps (fewer ring teeth)"
        return transmission_check(self.min_transmission_angle, self.spec.limits.transmission_angle, remedy)


_ALL = frozenset(HypocycloidDwell.outlines["analyze"].quantities)


def errors(design: HypocycloidDwell, mechanism: Mechanism) -> Movable:
    """The rod, the carrier, which is the centre distance of planet and ring, and the planet's teeth."""
    from gearlink.core.mechanism.dual import longer
    from gearlink.core.studies.movable import Movable, Turned

    spec, arm = design.spec, design.carrier_length
    ends = {"centers.planet_ring": ("carrier", arm)}
    if not spec.is_arm:
        ends["rod.length"] = ("rod", design.slider.rod)
    links = {"planet": ("planet", spec.gears.planet), "ring": (FRAME, spec.gears.ring)}
    gears = {name: Turned.of(link, spec.gears, z) for name, (link, z) in links.items()}
    return Movable(longer(mechanism, ends), {"planet_ring": arm}, gears=gears, radius=arm if spec.is_arm else 0.0)


def motion(design: HypocycloidDwell) -> Motion:
    """Links and joints over the carrier angle from the middle of the dwell's arc; ring's centre at 0, slider on +x."""
    if design.spec.is_arm:
        return _arm_motion(design)
    rod, train = design.slider.rod, _train(design)

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        links, (pin, axis, mesh) = train(phi, order)
        point = links["planet"].at("M")
        turn, end = slider(point, rod, 0j, 1.0 + 0j)
        links["rod"] = Link(point, turn, {"M": 0.0, "F": rod})
        links["slider"] = Link(end, standing(0.0, phi, order=order), {"F": 0.0})
        pins = Pin("M", "planet", "rod", point.value), Pin("F", "rod", "slider", end.value)
        guide = Guide("guide", FRAME, "slider", end.value, 1.0 + 0j)
        return Mechanism(links, [pin, axis, *pins, guide, mesh], "carrier", travel={"slider": 1.0 + 0j})

    outputs = (Output("Slider F, outwards", outwards(design)),)
    return Motion(make, Input("carrier_angle"), outputs, transmission=least_transmission("F"))


def _train(design: HypocycloidDwell) -> Callable[[Reals, int], tuple[dict[str, Link], list[Connection]]]:
    """Carrier and planet with the point M, and what joins them: the pins O and planet, and the mesh with the ring."""
    r, n = design.point_radius, design.ring_teeth / design.planet_teeth
    tangent = math.tan(design.mesh.working_pressure_angle)
    point = {"B": 0.0, "M": -design.spec.point.ratio * r}

    def train(phi: Reals, order: int) -> tuple[dict[str, Link], list[Connection]]:
        carrier = Link(fixed(0j, phi, order=order), steady(phi, order=order), {"A": 0.0, "B": (n - 1.0) * r})
        planet = Link(carrier.at("B"), steady(phi, -(n - 1.0), order=order), point)
        center = carrier.origin.value
        joints: list[Connection] = [
            Pin("O", FRAME, "carrier", center),
            Pin("planet", "carrier", "planet", planet.origin.value),
            Mesh("mesh_ring", FRAME, "planet", center, carrier.unit, n * r, r, tangent, True, "carrier"),
        ]
        return {"carrier": carrier, "planet": planet}, joints

    return train


def _arm_motion(design: HypocycloidDwell) -> Motion:
    """With an arm about the ring's centre, the point in its slot."""
    train, slotted = _train(design), design.arm

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        links, (pin, axis, mesh) = train(phi, order)
        arm = links["arm"] = Link(links["carrier"].origin, slotted.turn(phi, order))
        slot = Contact("slot", "arm", "planet", links["planet"].at("M").value, 1j * arm.unit)
        return Mechanism(links, [pin, axis, Pin("D", FRAME, "arm", arm.origin.value), slot, mesh], "carrier")

    turns = design.planet_teeth // math.gcd(design.planet_teeth, design.ring_teeth)
    return Motion(make, Input("carrier_angle", end=_TURN * turns, turns=turns), (Output("Arm", turned("arm")),))


def outwards(design: HypocycloidDwell) -> Course:
    """The way of the slider outwards from the middle of the dwell [mm]."""
    return coordinate("slider").less(design.slider.point(0.0).real + design.slider.rod)
