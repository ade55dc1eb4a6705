"""An output that gears hold to the links of a four-bar: how it goes over a revolution of the crank.

    phi5 = I phi + C [t2(phi) - t2(0)] + R [t3(phi) - t3(0)],   W = I + C w2 + R w3

with the coupler and rocker angles t2, t3 of `fourbar.position` and their rates w2, w3 per crank speed. I, C and R are
what a revolution of crank, coupler and rocker adds to the output.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from gearlink.core.base.results import cached_property
from gearlink.core.parts.linkages.checks import check_linkage
from gearlink.core.parts.linkages.fourbar.loop import rates_of
from gearlink.core.parts.linkages.fourbar.position import FourBar, FourBarState, solve
from gearlink.core.parts.linkages.standstills import (
    TURN,
    BackStep,
    OutputRates,
    Turning,
    backward,
    gain,
    regained,
    standstills,
    turnings,
)

if TYPE_CHECKING:
    from gearlink.core.parts.linkages.band_dwell import ToleranceDwell, Valley

Number = TypeVar("Number")


class Shares(NamedTuple):
    """I, C and R."""

    ratio: float
    coupler_share: float
    rocker_share: float


def blend(train: Any, coupler: Number, rocker: Number) -> Number:
    """What coupler and rocker add to the output, of numbers or of arrays."""
    found: Number = train.coupler_share * coupler + train.rocker_share * rocker
    return found


class GearedOutput(OutputRates):
    """The output of one linkage; every result is found once.

    Parameters
        train : Shares, or gears that have those numbers
    Raises
        NoSolution - of an angle or a rate: where the linkage does not close, of a rate also in a dead centre; of
            what belongs to a revolution: for a linkage that is neither crank-rocker nor drag link
    """

    def __init__(self, linkage: FourBar, train: Any) -> None:
        self.linkage, self.train = linkage, train

    @cached_property
    def _start(self) -> FourBarState[float]:
        return solve(self.linkage, 0.0)

    def angle(self, crank_angle: float) -> float:
        """Angle of the output, 0 at the crank angle 0 and continuous over any number of revolutions.

        Parameters
            crank_angle : float [rad]
        Returns
            phi5 : float [rad] - counter-clockwise positive
        Source
            thesis (4-23), integrated
        """
        return self._turned(crank_angle, solve(self.linkage, crank_angle))

    def _turned(self, crank_angle: float, here: FourBarState[float]) -> float:
        train, coupler = self.train, here.coupler_angle - self._start.coupler_angle
        rocker = here.rocker_angle - self._start.rocker_angle
        return float(train.ratio * crank_angle + train.coupler_share * coupler + train.rocker_share * rocker)

    def rates(self, crank_angle: float, order: int) -> tuple[float, ...]:
        """Angle, and its derivatives by the crank angle up to an order."""
        here = solve(self.linkage, crank_angle, order)
        speed, *more = (blend(self.train, *here[k : k + 2]) for k in range(3, 3 + 2 * order, 2))
        return self._turned(crank_angle, here), self.train.ratio + speed, *more

    def speed(self, crank_angle: float) -> float:
        """Speed ratio of the output, W = w5/w1.

        Source
            thesis (4-24)
        """
        return float(self.train.ratio + blend(self.train, *rates_of(self.linkage.reading, crank_angle, 1)))

    def acceleration(self, crank_angle: float) -> float:
        """Acceleration ratio of the output at constant crank speed, dW/dphi = e5/w1^2 [1/rad].

        Source
            thesis (4-25)
        """
        return blend(self.train, *rates_of(self.linkage.reading, crank_angle, 2))

    def jerk(self, crank_angle: float) -> float:
        """Jerk ratio of the output at constant crank speed, d2W/dphi2 [1/rad^2].

        Source
            thesis (4-25), differentiated
        """
        return blend(self.train, *rates_of(self.linkage.reading, crank_angle, 3))

    def terms(self, crank_angle: float) -> float:
        """The size of what the speed ratio is summed from."""
        coupler, rocker = rates_of(self.linkage.reading, crank_angle, 1)
        train = self.train
        return float(abs(train.ratio) + abs(train.coupler_share * coupler) + abs(train.rocker_share * rocker))

    # Over a revolution

    @cached_property
    def mean_ratio(self) -> float:
        """Net output revolutions per crank revolution: I of a crank-rocker, the whole number I + C + R of a drag link.

        Source
            thesis (4-1) for the crank-rocker; own derivation for the drag link
        """
        train = self.train
        if check_linkage(self.linkage) == "crank-rocker":
            return float(train.ratio)
        return float(round(train.ratio + train.coupler_share + train.rocker_share))

    @property
    def ahead(self) -> GearedOutput:
        """The output counted in the direction of its mean motion, in which turning back has its meaning."""
        return self

    @cached_property
    def speed_turnings(self) -> list[Turning]:
        """Extremes of the speed ratio, to full precision: roots of the acceleration ratio.

        Notes
            Six thousand random crank-rockers and drag links of three gears had one maximum and one minimum each.
        """
        check_linkage(self.linkage)
        return turnings(self.speed, self.acceleration)

    @cached_property
    def acceleration_turnings(self) -> list[Turning]:
        """Extremes of the acceleration ratio: roots of the jerk ratio."""
        check_linkage(self.linkage)
        return turnings(self.acceleration, self.jerk)

    @property
    def ahead_turnings(self) -> list[Turning]:
        """Extremes of the speed ratio of `ahead`."""
        if self.ahead is self:
            return self.speed_turnings
        return [Turning(each.place, -each.value) for each in self.speed_turnings]

    @cached_property
    def places(self) -> list[float]:
        """Crank angles of zero output speed [rad], ascending in [0, 2 pi)."""
        return standstills(self.speed, self.speed_turnings, 0.0)

    @cached_property
    def back_step(self) -> BackStep | None:
        """The back-step, the greatest one of several; None of an output that does not turn back.

        Notes
            The angle of a short one is the integral of the speed: it goes with the third power of the crank angle,
            which cancels in the difference of output angles.
        Source
            thesis (4-15), (4-16) for I = 1; own derivation otherwise
        """
        ahead = self.ahead
        steps = [BackStep(a, b, b - a, -gain(ahead, a, b)) for a, b in backward(ahead.speed, self.places)]
        return max(steps, key=lambda one: one.angle, default=None)

    @cached_property
    def dwell_angle(self) -> float | None:
        """Crank angle phi13 from the start of the back-step until the output is back at its place, exactly [rad].

        phi5(phi(1) + phi13) = phi5(phi(1)),   phi12 < phi13 < 2 pi

        Source
            own derivation; thesis (4-17) takes 1.5 phi12
        """
        return None if self.back_step is None else regained(self.ahead, self.back_step)

    @cached_property
    def ripple(self) -> ToleranceDwell | None:
        """The dwell within the band that the back-step fills; None without one.

        phi5(L) = phi5(phi(2)),   phi5(R) = phi5(phi(1)),   window = R - L,   band = D = 2 tau
        """
        from gearlink.core.parts.linkages.band_dwell import ToleranceDwell

        step = self.back_step
        if step is None or self.dwell_angle is None:
            return None
        before = regained(self.ahead, step, backwards=True)
        start = (step.start + step.crank_angle - before) % TURN % TURN
        middle = self.ahead.angle(start) + 0.5 * step.angle
        return self._as_counted(ToleranceDwell(start, before + self.dwell_angle - step.crank_angle, middle))

    @property
    def valley(self) -> Valley:
        """The part of the turn around the minimum speed, of the output counted in the direction of its mean motion.

        The speed runs one way between the extremes beside the minimum.
        """
        from gearlink.core.parts.linkages.band_dwell import Valley

        extremes, step = self.ahead_turnings, self.back_step
        at = min(range(len(extremes)), key=lambda i: extremes[i].value)
        least = extremes[at].place
        before, after = extremes[at - 1].place, extremes[(at + 1) % len(extremes)].place
        # whole turns alone are taken off: searches over many linkages end where places stand still to the last bit
        low, high = before - TURN * (before >= least), after + TURN * (after <= least)
        first = second = least
        if step is not None:
            first = step.start - TURN * (step.start > least)
            second = first + step.crank_angle
        return Valley(self.ahead, first, second, least, low, high, abs(self.mean_ratio))

    def within(self, tolerance: float) -> ToleranceDwell:
        """The longest crank interval over which the output stays within +- tol of a place that is free to choose.

        Parameters
            tolerance : float [rad] - 0 < tol < pi times the magnitude of the mean ratio
        Raises
            NoSolution - for a tolerance that is not positive, or so wide that the whole revolution lies within it
        Notes
            See `band_dwell`.
        Source
            own derivation; thesis 4.2.1 speaks of a dwell "within usual deviations"
        """
        from gearlink.core.parts.linkages.band_dwell import longest_in_band

        return self._as_counted(longest_in_band(self.valley, tolerance))

    def _as_counted(self, found: ToleranceDwell) -> ToleranceDwell:
        """The same with its output angle as that of this output is counted."""
        return found if self.ahead is self else found._replace(output_angle=-found.output_angle)
