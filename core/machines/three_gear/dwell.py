"""Standstills, back-step and dwells of the three-gear four-bar with any teeth, in crank-rocker and drag link.

The output stands still where A and the poles of both meshes lie on one line. That is a quadratic in cos^2(beta), beta
the base angle of the triangle between C and the poles, so there are at most two standstills a turn and none has to be
searched for; `gearlink.core.machines.three_gear.momentary` has the case of the double root. Where coupler and rocker
are not in proportion to the teeth, standstills are bracketed roots of the output's speed: `ByRoots`.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, unlike, within
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
from gearlink.core.machines.three_gear.motion import (
    Course,
    Extremes,
    GearTrain,
    acceleration_extremes,
    forward,
    mean_ratio,
    output_acceleration,
    output_jerk,
    output_speed,
    speed_extremes,
)
from gearlink.core.numerics.elementary import SCALARS, Elementary
from gearlink.core.parts.linkages.checks import check_linkage
from gearlink.core.parts.linkages.fourbar.position import FourBar, solve
from gearlink.core.parts.linkages.standstills import (
    BackStep,
    back_steps,
    gain,
    regained,
    standstills,
    turnings,
)

if TYPE_CHECKING:
    from gearlink.core.parts.linkages.band_dwell import ToleranceDwell, Valley

UNIDIRECTIONAL = "unidirectional"
MOMENTARY_DWELL = "momentary-dwell"
BACK_STEP = "back-step"

# A frame that is off by 1e-9 of its length moves the minimum speed ratio by about as much. No workshop can tell such
# frames apart, so nearer to zero than this the output has one standstill, not two or none.
STANDSTILL_TOLERANCE = 1e-9
_LINK_TOLERANCE = 1e-9
_TURN = 2.0 * math.pi


def dwell_positions(linkage: FourBar, train: GearTrain) -> list[float]:
    """Crank angles at which the output stands still: none, one (a momentary dwell) or two.

    Q X^2 + (2 P g - 4 S^2 h) X + g^2 = 0,   X = cos^2(beta),
    h = a^2 - r1^2,  g = h + r5^2 - d^2,  S = r1 + 2 r3 + r5,  P = S^2 + r1^2 - r5^2,  Q = P^2 - 4 S^2 r1^2

    Parameters
        linkage : FourBar [mm] - crank-rocker or drag link; coupler and rocker in proportion to z1 + z3 and z3 + z5
        train : GearTrain
    Returns
        positions : list of float [rad] - ascending in [0, 2 pi)
    Raises
        NoSolution - for another linkage, or links that are not the centre distances of the gears
    Notes
        With d_t the frame of the momentary dwell the discriminant is 4 S^2 r1^2 (d^2 - d_t^2) (d^2 - d_o^2), and
        d^2 - d_o^2 = d^2 - d_t^2 + 4 |h| U V/r1^2: a product without cancellation. Both roots belong to the
        linkage or none does, since the larger one passes 1 only where coupler and rocker stretch straight. A
        linkage whose speed ratio is zero within 1e-9 of its terms at the tangency has one standstill.
        The condition number of two standstills is d/|d - d_t|.
    Example
        >>> places = dwell_positions(FourBar(18.0, 50.0, 100.0, 121.4), GearTrain(20, 20, 60))
        >>> [round(math.degrees(phi), 9) for phi in places]
        [247.691347727, 306.359940596]

    Source
        own derivation; thesis 4.2.2 states the condition of the poles
    """
    check_linkage(linkage)
    r1, r3, r5 = _radii(linkage, train)
    if train.internal:
        touching = ring_tangency(r1, r3, r5, linkage.crank)
        once = [] if touching is None else _momentary(linkage, train, touching, r1, r3, r5)
        return once or ring_standstills(linkage, train, (r1, r3, r5))
    low, high = tangency_range(r1, r3, r5)
    if not low < linkage.crank < high:
        return []
    limit = tangency(r1, r3, r5, linkage.crank)
    momentary = _momentary(linkage, train, limit, r1, r3, r5)
    if momentary:
        return momentary
    if linkage.frame <= limit.frame:
        return []
    poles = standing(linkage.crank, linkage.frame, limit.frame, (r1, r3, r5))
    return sorted(crank_angle(r1, r5, *each, linkage.assembly) for each in poles)


def motion(positions: list[float]) -> str:
    """Kind of output motion, from its standstills.

    Parameters
        positions : list of float [rad] - from `dwell_positions`
    Returns
        'unidirectional', 'momentary-dwell' or 'back-step'
    Example
        >>> motion(dwell_positions(FourBar(18.0, 50.0, 100.0, 121.4), GearTrain(20, 20, 60)))
        'back-step'

    Source
        thesis 4.1.2, 4.2.1
    """
    return (UNIDIRECTIONAL, MOMENTARY_DWELL, BACK_STEP)[min(len(positions), 2)]


def back_step(linkage: FourBar, train: GearTrain) -> BackStep:
    """The back-step of an output that has one: where it starts and ends, and what it takes back.

    |phi5(2) - phi5(1)|

    Returns
        back_step : BackStep [rad]
    Raises
        NoSolution - when the output does not turn back, or the linkage is not fit, see `dwell_positions`
    Notes
        The angle is the integral of the speed where the back-step is short, as the third power of a short
        back-step's crank angle would cancel in the difference of output angles.
    Example
        >>> found = back_step(FourBar(18.0, 50.0, 100.0, 121.4), GearTrain(20, 20, 60))
        >>> round(math.degrees(found.crank_angle), 9), round(math.degrees(found.angle), 9)
        (58.668592868, 1.212200833)

    Source
        thesis (4-15), (4-16) for I = 1; own derivation otherwise
    """
    train = forward(linkage, train)
    positions = dwell_positions(linkage, train)
    if len(positions) < 2:
        raise NoSolution(
            f"the output of this linkage does not step back ({motion(positions)}, crank {short(linkage.crank)} mm)",
            fix=_frame_for_back_step(linkage, train),
        )
    start, end = positions
    if output_acceleration(linkage, train, start) > 0.0:
        start, end = end, start
    width = wrap(end - start)
    return BackStep(start, end, width, -gain(course(linkage, train), start, start + width))


def dwell_angle(linkage: FourBar, train: GearTrain, step: BackStep) -> float:
    """Crank angle phi13 from the start of the back-step to where the output is back at its starting position, exactly.

    phi5(phi(1) + phi13) = phi5(phi(1))

    Parameters
        step : BackStep - from `back_step`
    Returns
        phi13 : float [rad] - phi12 < phi13 < 2 pi
    Example
        >>> linkage, train = FourBar(18.0, 50.0, 100.0, 121.4), GearTrain(20, 20, 60)
        >>> round(math.degrees(dwell_angle(linkage, train, back_step(linkage, train))), 9)
        88.188661262

    Source
        own derivation; thesis (4-17) takes 1.5 phi12
    """
    return regained(course(linkage, forward(linkage, train)), step)


def course(linkage: FourBar, train: GearTrain) -> Course:
    """The output over the crank angle."""
    return Course(linkage, train, solve(linkage, 0.0))


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


def _momentary(linkage: FourBar, train: GearTrain, limit: Tangency, r1: float, r3: float, r5: float) -> list[float]:
    """The one standstill of a linkage that is a momentary dwell within the tolerance, else an empty list."""
    if abs(linkage.frame - limit.frame) > 1e-3 * limit.frame:
        return []
    reach = (r1 + 2.0 * r3 + r5) * limit.cos_beta
    phi = crank_angle(r1, r5, reach, limit.pole_offset * limit.cos_beta, limit.sin_beta, linkage.assembly)
    state = solve(linkage, phi, 1)
    terms = (
        abs(train.ratio)
        + abs(train.coupler_share * state.coupler_velocity)
        + abs(train.rocker_share * state.rocker_velocity)
    )
    if abs(output_speed(linkage, train, phi)) > STANDSTILL_TOLERANCE * terms:
        return []
    # One Newton step from the double root of the limit to the minimum speed of this very linkage.
    return [wrap(phi - output_acceleration(linkage, train, phi) / output_jerk(linkage, train, phi))]


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


def _frame_for_back_step(linkage: FourBar, train: GearTrain) -> str:
    """Which frame, if any, would make the output turn back."""
    r1, r3, r5 = _radii(linkage, train)
    if train.internal:
        touching = ring_tangency(r1, r3, r5, linkage.crank)
        if touching is None:
            return "take another crank or other teeth"
        side = "longer" if r1 + r3 + r5 > 0.0 else "shorter"
        limit = safely_above(touching.frame) if side == "longer" else safely_below(touching.frame)
        return f"take a frame {side} than {limit} mm"
    low, high = tangency_range(r1, r3, r5)
    if not low < linkage.crank < high:
        return f"take a crank of {within(low, high, 'mm')}"
    return f"take a frame longer than {safely_above(tangency(r1, r3, r5, linkage.crank).frame)} mm"


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
        >>> round(math.degrees(tolerance_from_backlash(0.3419089045018483, 75.0)), 9)
        0.130599581
    """
    if not (backlash > 0.0 and output_radius > 0.0):
        raise NoSolution(
            f"backlash {backlash:g} mm at radius {output_radius:g} mm gives no tolerance; both must be positive"
        )
    return backlash / (2.0 * output_radius)


def tolerance_dwell(linkage: FourBar, train: GearTrain, tolerance: float) -> ToleranceDwell:
    """Longest crank interval over which the output stays within +- tol of a place that is free to choose.

    Parameters
        linkage : FourBar - crank-rocker or drag link
        train : GearTrain
        tolerance : float [rad] - 0 < tol < pi times the magnitude of the mean ratio
    Returns
        dwell : ToleranceDwell [rad]
    Raises
        NoSolution - for a tolerance that is not positive, or so wide that the whole revolution lies within it
    Notes
        See `gearlink.core.parts.linkages.band_dwell`.
    Example
        >>> found = tolerance_dwell(FourBar(18.0, 50.0, 100.0, 121.4), GearTrain(20, 20, 60), math.radians(1.0))
        >>> round(math.degrees(found.start), 9), round(math.degrees(found.crank_angle), 9)
        (217.998931749, 123.008371818)

    Source
        own derivation; thesis 4.2.1 speaks of a dwell "within usual deviations"
    """
    from gearlink.core.parts.linkages.band_dwell import longest_in_band

    ahead = forward(linkage, train)
    found = longest_in_band(valley(linkage, ahead), tolerance)
    return found._replace(output_angle=train.sense * ahead.sense * found.output_angle)


def valley(linkage: FourBar, train: GearTrain) -> Valley:
    """The part of the turn around the minimum speed, of a train whose output gains angle over a revolution."""
    extremes = speed_extremes(linkage, train)
    step = back_step(linkage, train) if len(dwell_positions(linkage, train)) == 2 else None
    return _valley(linkage, train, extremes.least_angle, extremes.greatest_angle, step)


def _valley(linkage: FourBar, train: GearTrain, least: float, greatest: float, step: BackStep | None) -> Valley:
    from gearlink.core.parts.linkages.band_dwell import Valley

    first, second = (least, least) if step is None else (step.start, step.start + step.crank_angle)
    after = first + (greatest - first) % _TURN
    return Valley(
        course(linkage, train),
        first,
        second,
        first + (least - first) % _TURN,
        after - _TURN,
        after,
        mean_ratio(linkage, train),
    )


class Output:
    """How the output of a drive goes over a revolution of the crank: extremes, standstills, back-step and dwells.

    Parameters
        linkage : FourBar [mm] - coupler and rocker in proportion to z1 + z3 and z3 + z5
        train : GearTrain
        places : list of float [rad] - where the output stands, where that is known
    """

    def __init__(self, linkage: FourBar, train: GearTrain, places: list[float] | None = None) -> None:
        self.linkage, self.train = linkage, train
        self._given_places = places

    @property
    def frame_ratio(self) -> float:
        """Frame over crank."""
        return self.linkage.frame / self.linkage.crank

    @cached_property
    def speed_extremes(self) -> Extremes:
        """Maximum and minimum speed ratio and their places."""
        return speed_extremes(self.linkage, self.train)

    @cached_property
    def acceleration_extremes(self) -> Extremes:
        """Maximum and minimum acceleration ratio and their places."""
        return acceleration_extremes(self.linkage, self.train)

    @cached_property
    def places(self) -> list[float]:
        """Crank angles of zero output speed [rad], ascending."""
        return dwell_positions(self.linkage, self.train) if self._given_places is None else self._given_places

    @cached_property
    def back_step(self) -> BackStep | None:
        """The back-step, where there is one."""
        return back_step(self.linkage, self.train) if motion(self.places) == BACK_STEP else None

    @cached_property
    def dwell_angle(self) -> float | None:
        """Crank angle phi13 until the output is back at its starting position [rad]."""
        return None if self.back_step is None else dwell_angle(self.linkage, self.train, self.back_step)

    @cached_property
    def ahead(self) -> GearTrain:
        """The train counted in the direction of its mean motion, in which turning back has its meaning."""
        return forward(self.linkage, self.train)

    def within(self, tolerance: float) -> ToleranceDwell:
        """The longest dwell within a tolerance [rad] to either side that has an end."""
        from gearlink.core.parts.linkages.band_dwell import longest_in_band

        forward, extremes = self.train.sense * self.ahead.sense, self.speed_extremes
        least, greatest = (extremes.least_angle, extremes.greatest_angle)[::forward]
        found = longest_in_band(_valley(self.linkage, self.ahead, least, greatest, self.back_step), tolerance)
        return found._replace(output_angle=forward * found.output_angle)


class ByRoots(Output):
    """The output of a drive whose teeth keep the ratio of the gears at any length of coupler and rocker."""

    @cached_property
    def _course(self) -> Course:
        return course(self.linkage, self.ahead)

    @cached_property
    def places(self) -> list[float]:
        """Crank angles of zero output speed [rad], ascending."""
        speed, train = self._course.speed, self.ahead
        extremes = turnings(speed, lambda phi: output_acceleration(self.linkage, train, phi))
        state = solve(self.linkage, min(extremes, key=lambda one: one.value).place, 1)
        terms = (train.ratio, train.coupler_share * state.coupler_velocity, train.rocker_share * state.rocker_velocity)
        return standstills(speed, extremes, STANDSTILL_TOLERANCE * sum(map(abs, terms)))

    @cached_property
    def back_step(self) -> BackStep | None:
        """The back-step, where there is one."""
        found = back_steps(self._course.speed, self._course.angle, self.places)
        return found[0] if found else None
