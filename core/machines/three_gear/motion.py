"""Output motion of the three-gear four-bar: gear 1 fixed to the crank at B, idler 3 at C, output gear 5 free on D.

    phi5 = I phi + (1 - i2) i3 t2 + (1 - i3) t3,   W = I + (1 - i2) i3 w2 + (1 - i3) w3

with the coupler and rocker angles t2, t3 of `linkages.fourbar.position`, their rates w2, w3 per crank speed, and
i2 = -z1/z3, i3 = -z3/z5, I = i2 i3 = z1/z5, teeth negative for a gear in internal mesh with the idler. Standstills
and back-step stand in `gearlink.core.machines.three_gear.dwell`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, TypeVar

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.base.wording import unlike
from gearlink.core.parts.linkages.checks import check_linkage
from gearlink.core.parts.linkages.fourbar.loop import rates_of
from gearlink.core.parts.linkages.fourbar.position import FourBar, FourBarState, solve
from gearlink.core.parts.linkages.standstills import zeros_over_turn

Number = TypeVar("Number")


@dataclass(frozen=True, slots=True)
class GearTrain:
    """The three gears: crank gear 1, idler 3 and output gear 5.

    Parameters
        crank, idler, output : float - teeth, or anything in proportion to them (charts need fractions); crank and
            output negative for an internal mesh with the idler
        sense : +1 or -1 - in which the output is counted: -1 against the crank
    Raises
        NoSolution - for a number that is zero or not finite, and gears in internal mesh that are as large as the idler
    Example
        >>> train = GearTrain(40, 72, 40)
        >>> train.i3, train.ratio
        (-1.8, 1.0)
    """

    crank: float
    idler: float
    output: float
    sense: int = 1

    def __post_init__(self) -> None:
        for name, teeth in (("crank gear", self.crank), ("idler", self.idler), ("output gear", self.output)):
            if not math.isfinite(teeth) or teeth == 0 or (name == "idler" and teeth < 0):
                raise NoSolution(f"the {name} has {teeth:g} teeth; the number must be positive and finite")
            if teeth == -self.idler:
                raise NoSolution(f"the {name}, a ring, is no larger than the idler of {self.idler:g} teeth")

    @property
    def internal(self) -> bool:
        """Whether a mesh is internal."""
        return self.crank < 0 or self.output < 0

    @property
    def i2(self) -> float:
        """Ratio of crank gear and idler, -z1/z3."""
        return -self.crank / self.idler

    @property
    def i3(self) -> float:
        """Ratio of idler and output gear, -z3/z5."""
        return -self.idler / self.output

    @property
    def ratio(self) -> float:
        """Ratio of the train, I = i2 i3 = z1/z5."""
        return self.sense * self.crank / self.output

    @property
    def coupler_share(self) -> float:
        """What a revolution of the coupler adds to the output, (1 - i2) i3 = -(z1 + z3)/z5."""
        return -self.sense * (self.crank + self.idler) / self.output

    @property
    def rocker_share(self) -> float:
        """What a revolution of the rocker adds to the output, 1 - i3 = (z3 + z5)/z5."""
        return self.sense * (self.idler + self.output) / self.output


class Extremes(NamedTuple):
    """Maximum and minimum value of a ratio over the turn and the crank angles [rad] in [0, 2 pi) of both."""

    greatest: float
    greatest_angle: float
    least: float
    least_angle: float


def output_angle(linkage: FourBar, train: GearTrain, crank_angle: float) -> float:
    """Angle of the output gear, 0 at the crank angle 0 and continuous over any number of revolutions.

    phi5 = I phi + (1 - i2) i3 [t2(phi) - t2(0)] + (1 - i3) [t3(phi) - t3(0)]

    Parameters
        linkage : FourBar
        train : GearTrain
        crank_angle : float [rad] - any real angle
    Returns
        phi5 : float [rad] - counter-clockwise positive
    Raises
        NoSolution - when the linkage does not close there or at the crank angle 0
    Example
        >>> train, linkage = GearTrain(20, 20, 60), FourBar(18.0, 50.0, 100.0, 121.4)
        >>> round(math.degrees(output_angle(linkage, train, 2.0 * math.pi)), 9)
        120.0

    Source
        thesis (4-23), integrated
    """
    return _turned(train, crank_angle, solve(linkage, crank_angle), solve(linkage, 0.0))


class Course(NamedTuple):
    """The output's angle and its derivatives, for searches: its start is computed once.

    Example
        >>> train, linkage = GearTrain(20, 20, 60), FourBar(18.0, 50.0, 100.0, 121.4)
        >>> course = Course(linkage, train, solve(linkage, 0.0))
        >>> course.rates(2.0, 1) == (output_angle(linkage, train, 2.0), output_speed(linkage, train, 2.0))
        True
    """

    linkage: FourBar
    train: GearTrain
    start: FourBarState[float]

    def angle(self, crank_angle: float) -> float:
        """`output_angle`."""
        return _turned(self.train, crank_angle, solve(self.linkage, crank_angle), self.start)

    def speed(self, crank_angle: float) -> float:
        """`output_speed`."""
        return output_speed(self.linkage, self.train, crank_angle)

    def rates(self, crank_angle: float, order: int) -> tuple[float, ...]:
        """Angle, and derivatives up to an order."""
        state = solve(self.linkage, crank_angle, order)
        speed, *more = (blend(self.train, *state[k : k + 2]) for k in range(3, 3 + 2 * order, 2))
        return _turned(self.train, crank_angle, state, self.start), self.train.ratio + speed, *more


def _turned(train: GearTrain, crank_angle: float, state: FourBarState[float], start: FourBarState[float]) -> float:
    return (
        train.ratio * crank_angle
        + train.coupler_share * (state.coupler_angle - start.coupler_angle)
        + train.rocker_share * (state.rocker_angle - start.rocker_angle)
    )


def output_speed(linkage: FourBar, train: GearTrain, crank_angle: float) -> float:
    """Speed ratio of the output, output speed per crank speed.

    W = w5/w1 = I + (1 - i2) i3 w2/w1 + (1 - i3) w3/w1

    Raises
        NoSolution - when the linkage does not close there or stands in a dead centre
    Example
        >>> train, linkage = GearTrain(20, 20, 60), FourBar(18.0, 50.0, 100.0, 121.4)
        >>> round(output_speed(linkage, train, 0.0), 12)
        0.217279174726

    Source
        thesis (4-24)
    """
    return train.ratio + blend(train, *rates_of(linkage.reading, crank_angle, 1))


def output_acceleration(linkage: FourBar, train: GearTrain, crank_angle: float) -> float:
    """Acceleration ratio of the output, dW/dphi = e5/w1^2 at constant crank speed.

    e5/w1^2 = (1 - i2) i3 e2/w1^2 + (1 - i3) e3/w1^2

    Returns
        acceleration_ratio : float [1/rad]
    Raises
        NoSolution - as `output_speed`
    Example
        >>> train, linkage = GearTrain(20, 20, 60), FourBar(18.0, 50.0, 100.0, 121.4)
        >>> round(output_acceleration(linkage, train, 0.0), 12)
        0.340460830883

    Source
        thesis (4-25)
    """
    return blend(train, *rates_of(linkage.reading, crank_angle, 2))


def output_jerk(linkage: FourBar, train: GearTrain, crank_angle: float) -> float:
    """Jerk ratio of the output, the derivative of the acceleration ratio with respect to the crank angle.

    Returns
        jerk_ratio : float [1/rad^2]
    Raises
        NoSolution - as `output_speed`
    Example
        >>> train, linkage = GearTrain(20, 20, 60), FourBar(18.0, 50.0, 100.0, 121.4)
        >>> h = 1e-4
        >>> slope = (output_acceleration(linkage, train, 1 + h) - output_acceleration(linkage, train, 1 - h)) / (2 * h)
        >>> abs(output_jerk(linkage, train, 1.0) - slope) < 1e-8
        True

    Source
        thesis (4-25), differentiated
    """
    return blend(train, *rates_of(linkage.reading, crank_angle, 3))


def mean_ratio(linkage: FourBar, train: GearTrain) -> float:
    """Net output revolutions per crank revolution.

    I = z1/z5 for a crank-rocker;   1 for a drag link, whatever the teeth: I + (1 - i2) i3 + (1 - i3) = 1

    Raises
        NoSolution - when the linkage is neither, see `check_linkage`
    Example
        >>> train = GearTrain(20, 20, 60)
        >>> mean_ratio(FourBar(18.0, 50.0, 100.0, 121.4), train), mean_ratio(FourBar(120.0, 50.0, 100.0, 20.0), train)
        (0.3333333333333333, 1.0)

    Source
        thesis (4-1) for the crank-rocker; own derivation for the drag link
    """
    return train.ratio if check_linkage(linkage) == "crank-rocker" else float(train.sense)


def forward(linkage: FourBar, train: GearTrain) -> GearTrain:
    """The train with its output counted in the direction of its mean motion, in which backward has its meaning.

    Example
        >>> forward(FourBar(22.0, 41.0, 37.0, 46.0), GearTrain(24, 17, -54)).sense
        -1
    """
    return train if mean_ratio(linkage, train) > 0.0 else replace(train, sense=-train.sense)


def speed_extremes(linkage: FourBar, train: GearTrain) -> Extremes:
    """Maximum and minimum speed ratio over the turn, and where they are reached.

    e5 = 0

    Returns
        extremes : Extremes - the places to full precision: roots of the acceleration ratio
    Raises
        NoSolution - for a linkage that is neither crank-rocker nor drag link
    Notes
        Signs of the acceleration on a grid that is refined towards 0 and 180 deg, then bracketed roots. Six
        thousand random crank-rockers and drag links had one maximum and one minimum each.
    Example
        >>> found = speed_extremes(FourBar(18.0, 50.0, 100.0, 121.4), GearTrain(20, 20, 60))
        >>> round(found.greatest, 9), round(math.degrees(found.least_angle), 6)
        (0.758734009, 276.311226)

    Source
        thesis (4-13) for I = 1; own derivation otherwise
    """
    check_linkage(linkage)
    return _extremes(
        lambda phi: output_speed(linkage, train, phi), lambda phi: output_acceleration(linkage, train, phi)
    )


def acceleration_extremes(linkage: FourBar, train: GearTrain) -> Extremes:
    """Maximum and minimum acceleration ratio over the turn, and where they are reached.

    Returns
        extremes : Extremes [1/rad] - the places to full precision: roots of the jerk ratio
    Raises
        NoSolution - for a linkage that is neither crank-rocker nor drag link
    Example
        >>> d = 3.951703805053557
        >>> b = math.sqrt((1 + d * d) / 2)
        >>> round(acceleration_extremes(FourBar(1.0, b, b, d), GearTrain(40, 72, 40)).greatest, 12)
        1.51406659722

    Source
        thesis (4-25); own derivation of the peak 2 (1 - i3) d/(d^2 - 1) for I = 1
    """
    check_linkage(linkage)
    return _extremes(lambda phi: output_acceleration(linkage, train, phi), lambda phi: output_jerk(linkage, train, phi))


def gear_gap(linkage: FourBar, train: GearTrain, module: float, addendum: float = 1.0) -> float:
    """Gap between the tip circles of crank gear and output gear where they come nearest over the turn.

    s15 = |d - a| - m (z1 + z5)/2 - 2 h_a* m

    Parameters
        linkage : FourBar [mm]
        train : GearTrain - real teeth
        module : float [mm]
        addendum : float - h_a*, addendum coefficient
    Returns
        gap : float [mm] - negative where the gears collide
    Notes
        B passes between A and D (or, in a drag link, D between A and B): the distance of the gears is |d - a|, not d.
    Example
        >>> round(gear_gap(FourBar(18.0, 50.0, 100.0, 121.4), GearTrain(20, 20, 60), 2.5), 9)
        -1.6

    Source
        own derivation; thesis 4.2.3 compares the tip radii with the frame length
    """
    tips = tip_radius(train.crank, module, addendum) + tip_radius(train.output, module, addendum)
    return abs(linkage.frame - linkage.crank) - tips


def tip_radius(teeth: float, module: float, addendum: float = 1.0) -> float:
    """Tip radius of a gear without profile shift, m (z/2 + h_a*) [mm].

    Source
        ISO 21771
    """
    return module * (0.5 * teeth + addendum)


def idler_for_ratio(i3: float, output_teeth: int) -> int:
    """Idler whose ratio to the output gear comes nearest to a wanted one.

    z3 = round(-i3 z5)

    Parameters
        i3 : float - negative
        output_teeth : int - z5
    Returns
        idler_teeth : int - at least 1
    Raises
        NoSolution - when the nearest number of teeth is 0, or i3 is not negative
    Example
        >>> idler_for_ratio(-1.7798080356711419, 40)
        71

    Source
        thesis 4.1.4, example 1
    """
    teeth = math.floor(-i3 * output_teeth + 0.5) if math.isfinite(i3) else 0
    if teeth < 1:
        raise NoSolution(
            f"i3: {unlike(i3, -1.0 / output_teeth)} (limit <= {unlike(-1.0 / output_teeth, i3)}, an idler of one tooth "
            f"with an output gear of {output_teeth})",
            fix=f"set i3 to at most {safely_below(-1.0 / output_teeth)}",
        )
    return teeth


def blend(train: Any, coupler: Number, rocker: Number) -> Number:
    """What coupler and rocker add to the output, of numbers or of arrays."""
    found: Number = train.coupler_share * coupler + train.rocker_share * rocker
    return found


def _extremes(f: Callable[[float], float], slope: Callable[[float], float]) -> Extremes:
    """Extremes of a periodic function from the sign changes of its derivative."""
    ranked = sorted((f(place), place) for place in zeros_over_turn(slope))
    (least, at_least), (greatest, at_greatest) = ranked[0], ranked[-1]
    return Extremes(greatest, at_greatest, least, at_least)
