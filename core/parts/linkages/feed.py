"""What the output of a geared linkage feeds: a chain, a roller's web or a belt; the speed of a sheet at the front lay.

The speed is taken in windows of the crank angle before the arrival. The gentlest has both ends on one level of the
speed ratio W, a minimum of W between them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.core.base.design import Design, Outline
from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.real_speed import RealSpeed, per_time
from gearlink.core.base.report import Check, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import apart, short
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.linkages.codes import LAY_SPEED
from gearlink.core.parts.linkages.standstills import Turning

if TYPE_CHECKING:
    from gearlink.core.base.report import Column
    from gearlink.core.parts.linkages.spec_sections import Feed


FEED_QUANTITIES = (
    "feed_radius",
    "feed_ratio",
    "feed_teeth",
    "feed_per_turn",
    "feed_back_step",
    "chain_ripple",
    "feed_velocity_max",
    "feed_velocity_min",
    "feed_velocity_mean",
    "feed_acceleration_max",
    "feed_acceleration_min",
    "lay_speed",
    "lay_angle",
    "lay_time",
    "arrival_speed",
)

_ALL = frozenset(FEED_QUANTITIES)


def feed_radius(feed: Feed) -> float:
    """Radius at which the output's angle becomes travel.

    roller: r,   belt: r + s/2,   chain: z p/(2 pi), by which a revolution feeds z pitches

    Parameters
        feed : Feed - lengths [mm]
    Returns
        radius : float [mm] - times the ratio of feed shaft and output
    Source
        thesis 3.3.2: chain, roller or belt carry the product
    """
    ratio: float = feed.ratio
    if feed.pitch is not None and feed.teeth is not None:
        return ratio * feed.teeth * feed.pitch / (2.0 * math.pi)
    return ratio * ((feed.radius or 0.0) + 0.5 * feed.belt_thickness)


def _fed_per_time(name: str, order: int) -> Any:
    """A ratio of the output's motion as that of what is fed [mm/s^order]; None without `feed` or `input_speed`."""

    def value(design: Any) -> Any:
        if design.spec.feed is None or design.angular_speed is None:
            return None
        return getattr(design, name) * design.angular_speed**order * design.travel_radius

    return property(value, doc=f"`{name}` of what is fed, in real time.")


class FeedResults(RealSpeed, Design):
    """Results of a design whose file may have a section `feed`; None of them without it."""

    mean_ratio: Any
    back_step_angle: Any

    def decisive(self, command: str) -> Iterable[str]:
        """Those of a feed only where the file has one."""
        found = super().decisive(command)
        return found if self.spec.feed is not None else (name for name in found if name not in _ALL)

    @property
    def travel_radius(self) -> float | None:
        """Radius at which the output's angle becomes travel [mm], by the step where the file gives that."""
        feed = self.spec.feed
        if feed is None:
            return None
        if feed.step is None:
            return feed_radius(feed)
        if self.feed_teeth is not None and feed.pitch is not None:
            return float(feed.ratio * self.feed_teeth * feed.pitch / (2.0 * math.pi))
        return float(feed.step / (2.0 * math.pi * abs(self.mean_ratio)))

    @property
    def feed_radius(self) -> float | None:
        """Radius at which the output's angle becomes travel [mm]; of a step that of the roller, or under the belt.

        s/(2 pi |I| ratio) - belt_thickness/2
        """
        feed, radius = self.spec.feed, self.travel_radius
        if radius is None or feed.step is None or feed.pitch is not None:
            return radius
        return float(radius / feed.ratio - 0.5 * feed.belt_thickness)

    @property
    def feed_ratio(self) -> float | None:
        """Ratio of the feed's shaft that a step needs with a given sprocket: s/(pitch teeth |I|)."""
        feed = self.spec.feed
        if feed is None or feed.step is None or feed.teeth is None:
            return None
        return float(feed.step / (feed.pitch * feed.teeth * abs(self.mean_ratio)))

    @property
    def feed_teeth(self) -> int | None:
        """Teeth of the sprocket that come nearest to a step."""
        feed = self.spec.feed
        if feed is None or feed.step is None or feed.pitch is None or feed.teeth is not None:
            return None
        found: int = max(1, round(feed.step / (feed.pitch * feed.ratio * abs(self.mean_ratio))))
        return found

    @property
    def feed_per_turn(self) -> float | None:
        """Net travel per revolution of the input [mm]."""
        return self._fed(2.0 * math.pi * self.mean_ratio) if self.spec.feed is not None else None

    @property
    def feed_back_step(self) -> float | None:
        """How far the travel goes back [mm]."""
        return self._fed(self.back_step_angle) if self.spec.feed is not None else None

    @property
    def chain_ripple(self) -> float | None:
        """Share by which a chain's speed falls between two teeth, 1 - cos(pi/z); none without a chain."""
        feed = self.spec.feed
        teeth = None if feed is None else feed.teeth or self.feed_teeth
        return None if teeth is None else 2.0 * math.sin(0.5 * math.pi / teeth) ** 2

    feed_velocity_max: float | None = _fed_per_time("speed_ratio_max", 1)
    feed_velocity_min: float | None = _fed_per_time("speed_ratio_min", 1)
    feed_velocity_mean: float | None = _fed_per_time("mean_ratio", 1)
    feed_acceleration_max: float | None = _fed_per_time("acceleration_ratio_max", 2)
    feed_acceleration_min: float | None = _fed_per_time("acceleration_ratio_min", 2)

    def _fed(self, angle: float | None) -> float | None:
        return None if angle is None or self.travel_radius is None else angle * self.travel_radius

    # The front lay

    @classmethod
    def judged(cls, command: str, spec: Any, /) -> tuple[str, ...]:
        """The speed before a front lay is judged where the file has one."""
        found, feed = super().judged(command, spec), getattr(spec, "feed", None)
        return found if feed is not None and feed.lay is not None else tuple(x for x in found if x != "lay-speed")

    def outline(self, command: str) -> Outline:
        """The speed before a front lay is judged where the file has one."""
        found, feed = super().outline(command), self.spec.feed
        if feed is not None and feed.lay is not None:
            return found
        return found._replace(checks=tuple(name for name in found.checks if name != "lay-speed"))

    @property
    def running(self) -> tuple[Any, Any, Any]:
        """Speed ratio and angle of the output in the sense of its mean motion, as functions of the crank angle [rad],
        and all turnings of the speed ratio over a revolution."""
        raise NotImplementedError

    @cached_property
    def lay(self) -> Lay | None:
        """The last way before the front lay, where the file asks for one."""
        feed = self.spec.feed
        if feed is None or feed.lay is None or self.travel_radius is None:
            return None

        given, turned = feed.lay, feed.lay.distance / self.travel_radius
        with at_key("feed.lay.distance"):
            if turned >= 2.0 * math.pi * abs(self.mean_ratio):
                step = 2.0 * math.pi * abs(self.mean_ratio) * self.travel_radius
                now, limit = apart(given.distance, step)
                what = f"distance to the lay: {now} mm (limit < {limit} mm, feed per revolution)"
                raise NoSolution(what, fix=f"set feed.lay.distance below {safely_below(step)} mm")
            if given.angle is None:
                return gentlest(*self.running, turned)
            return way_before(*self.running, turned, math.radians(given.angle))

    @property
    def lay_speed(self) -> float | None:
        """Maximum speed of the sheet on the last way before the lay [mm/s]."""
        return None if self.lay is None else self._of_sheet(self.lay.greatest)

    def _of_sheet(self, ratio: float) -> float | None:
        return None if self.angular_speed is None else ratio * self.angular_speed * (self.travel_radius or 0.0)

    @property
    def lay_angle(self) -> float | None:
        """Crank angle of the arrival [rad]."""
        return None if self.lay is None else self.lay.end % (2.0 * math.pi)

    @property
    def _lay_way(self) -> float | None:
        return None if self.lay is None else self.lay.end - self.lay.start

    lay_time: float | None = per_time("_lay_way", -1)

    @property
    def arrival_speed(self) -> float | None:
        """Speed of the sheet at the arrival that the file gives [mm/s]."""
        feed = self.spec.feed
        if self.lay is None or feed is None or feed.lay.angle is None:
            return None
        return self._of_sheet(self.lay.arrival)

    def check_lay_speed(self) -> Iterator[Check]:
        """GL341."""
        found, feed = self.lay_speed, self.spec.feed
        if found is None or feed is None:
            return
        limit = feed.lay.speed
        over = found > limit * (1.0 + 1e-12)
        what, aside = "maximum speed of the sheet before the lay", f"over the last {short(feed.lay.distance)} mm"
        fix = "reduce the speed, or choose a drive that is slower there"
        yield LAY_SPEED.check("fail" if over else "pass", what, found, limit, "mm/s", side="<=", aside=aside, fix=fix)

    def timed(
        self, columns: Mapping[str, tuple[Column, str]], angle: str, rates: Mapping[str, tuple[str, int]]
    ) -> dict[str, tuple[Column, str]]:
        """As `RealSpeed.timed`; what is fed after it, where the table has the output's motion."""
        whole, radius = super().timed(columns, angle, rates), self.travel_radius
        if radius is None or "speed_ratio" not in columns:
            return whole
        whole["feed_travel"] = (radius * math.pi / 180.0 * _array(columns["output_angle"][0]), "mm")
        for name, column, unit in (
            ("feed_velocity", "output_speed", "mm/s"),
            ("feed_acceleration", "output_acceleration", "mm/s^2"),
        ):
            if column in whole:
                whole[name] = (radius * _array(whole[column][0]), unit)
        return whole


def _array(data: Any) -> Any:
    import numpy as np

    return np.asarray(data)


TURN = 2.0 * math.pi
_STEPS = 720
Speed = Callable[[float], float]


class Lay(NamedTuple):
    """The way to the front lay: crank angles of its start and of the arrival [rad], maximum speed ratio on it, and
    that at the arrival."""

    start: float
    end: float
    greatest: float
    arrival: float


def way_before(speed: Speed, angle: Speed, extremes: Sequence[Turning], turned: float, end: float) -> Lay:
    """The last stretch before an arrival, in which the output turns by an angle.

    Parameters
        speed, angle : functions of the crank angle [rad] - W, and the output's angle, running on over turns
        turned : float [rad] - of the output in that stretch
        end : float [rad] - crank angle of the arrival
    Raises
        NoSolution - where the output turns back within it, or it is longer than two revolutions
    """
    step, here, goal = TURN / _STEPS, end, angle(end) - turned
    for k in range(1, 2 * _STEPS):
        there = end - k * step
        if angle(there) <= goal:
            start = bracketed_root(lambda x: angle(x) - goal, there, here)
            return _judged(speed, extremes, start, end)
        here = there
    whole = angle(end) - angle(end - 2.0 * TURN)
    raise NoSolution(
        f"output angle over the distance before the lay: {short(math.degrees(turned))} deg (limit < "
        f"{safely_below(math.degrees(whole))} deg, that of two revolutions)",
        fix="reduce feed.lay.distance",
    )


def gentlest(speed: Speed, angle: Speed, extremes: Sequence[Turning], turned: float) -> Lay:
    """The stretch of the smallest maximum speed, wherever in the turn the sheet may arrive.

    About a minimum of W, with equal speeds at both ends; where none has such ends, up to the maximum speed.

    Raises
        NoSolution - where the output turns back within all of them
    """
    best: Lay | None = None
    refused: NoSolution | None = None
    for place, value in extremes:
        tops = [_next_top(extremes, place, way) for way in (-1.0, 1.0)]
        if None in tops or any(top.value < value for top in tops if top is not None):
            continue
        found = _about(speed, angle, place, [top for top in tops if top is not None], turned)
        if found is None:
            continue
        try:
            judged = _judged(speed, extremes, *found)
        except NoSolution as error:
            refused = error
            continue
        if best is None or judged.greatest < best.greatest:
            best = judged
    if best is not None:
        return best
    if refused is not None:
        raise refused
    place = max(extremes, key=lambda each: each.value).place
    return way_before(speed, angle, extremes, turned, place)


def _next_top(extremes: Sequence[Turning], place: float, way: float) -> Turning | None:
    """The next turning one way, its place counted on over the revolution."""
    others = [each for each in extremes if each.place != place]
    if not others:
        return None
    found = min(others, key=lambda each: (way * (each.place - place)) % TURN)
    return Turning(place + way * ((way * (found.place - place)) % TURN), found.value)


def _about(speed: Speed, angle: Speed, place: float, tops: list[Turning], turned: float) -> tuple[float, float] | None:
    """Ends at one speed on both sides of a minimum, between which the output turns by an angle."""
    level = min(top.value for top in tops)

    def ends(share: float) -> tuple[float, float]:
        wanted = speed(place) + share * (level - speed(place))
        return (
            bracketed_root(lambda x: speed(x) - wanted, tops[0].place, place),
            bracketed_root(lambda x: speed(x) - wanted, place, tops[1].place),
        )

    def missing(share: float) -> float:
        start, end = ends(share)
        return angle(end) - angle(start) - turned

    most = 1.0 - 1e-12
    if missing(most) < 0.0:
        return None
    return ends(bracketed_root(missing, 1e-15, most))


def _judged(speed: Speed, extremes: Sequence[Turning], start: float, end: float) -> Lay:
    inside = [value for place, value in extremes if (place - start) % TURN <= end - start]
    values = [speed(start), speed(end), *inside]
    if min(values) < 0.0:
        raise NoSolution(
            f"the sheet moves backwards before the lay, speed ratio {short(min(values))}",
            fix="reduce feed.lay.distance, or use a drive without back-step",
        )
    return Lay(start, end, max(values), speed(end))
