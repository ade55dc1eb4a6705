"""`synth dwell`: links whose output is back after a crank angle, or stays within a tolerance over one."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING

from gearlink.core.base.design import Found, Outline
from gearlink.core.base.errors import MissingSection, NoSolution, anew, at_key
from gearlink.core.base.report import Check, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.three_gear import symmetric
from gearlink.core.machines.three_gear.codes import back_step_judged
from gearlink.core.machines.three_gear.design import CHECKS, QUANTITIES, ThreeGearFourBar, given_tolerance
from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.machines.three_gear.synthesis import LEAST_IDLER, TABLES, FamilyTask, candidates_table, with_analysis
from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.parts.linkages.band_dwell import AlwaysStepping, ToleranceDwell, band_of_window, flattest_of, keeping
from gearlink.core.parts.linkages.checks import dwell_edge_check, dwell_window_check
from gearlink.core.parts.linkages.fourbar.position import FourBar

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.families import Family

MARGIN = 0.01
PLAIN_TOLERANCE = 1.0
"""Of a dwell that names none [deg]."""
_ROUNDING = 1e-9
_DWELL = ("dwell_tolerance", "window_limit", "frame_ratio_interval", "frame_length_interval")


class DwellTask(FamilyTask):
    """A dwell of three gears: phi13, a window, a tolerance, or both of these."""

    section, keys = "dwell", "angle, or window and tolerance (deg)"

    no_idler: NoSolution | None = None
    """Why no idler was found: another check of the same design does not try some hundred of them again."""
    searched = False
    """Whether the whole range of frames was looked at."""

    # The request

    @cached_property
    def window(self) -> float | None:
        """Crank angle [rad] over which the output is to stay within the tolerance."""
        return None if self.request.window is None else math.radians(self.request.window)

    @cached_property
    def tolerance(self) -> float | None:
        """Tolerance of the output to either side [rad] that the file names."""
        if self.request.tolerance is not None:
            return math.radians(self.request.tolerance)
        return given_tolerance(self.spec, self.spec.dwell_tolerance)

    @property
    def band(self) -> float | None:
        """The tolerance that the links are designed for; a phi13 is designed for none."""
        return None if self.request.angle is not None else self.tolerance

    @property
    def aimed_at(self) -> float:
        """The tolerance less its margin [rad]."""
        assert self.tolerance is not None
        return self.tolerance * (1.0 - (MARGIN if self.request.margin is None else self.request.margin))

    @cached_property
    def general(self) -> bool:
        """Unequal gears that ask for a window are balanced where the file does not say otherwise."""
        gears, request = self.spec.gears, self.spec.dwell
        unequal = request is not None and request.angle is None and gears.crank != gears.output
        return unequal or super().general

    @property
    def key(self) -> str:
        """The key at fault where no linkage meets the request."""
        return "dwell.tolerance" if self.request.window is None else "dwell.window"

    # The idler

    def chosen_idler(self, *, advises: bool = True) -> int:
        """The smallest that keeps the limits; a refusal names the longest window that one within them reaches."""
        if self.no_idler is not None:
            raise anew(self.no_idler)
        try:
            return super().chosen_idler(advises=advises)
        except MissingSection:
            raise
        except NoSolution as error:
            words = self._best_within_limits() if advises else ""
            self.no_idler = NoSolution(error.message, key=error.key, fix=words or error.fix)
            raise anew(self.no_idler) from error

    def _best_within_limits(self) -> str:
        """The longest window at the asked tolerance, of the smallest idler that keeps the limits.

        That idler was tried with the default margin, which costs a third of a percent of the window.
        """
        if self.window is None or self.band is None or self.general:
            return ""
        tolerance = self.request.model_copy(update={"window": None})
        longest = DwellTask(self.spec.model_copy(update={"dwell": tolerance}))
        try:
            idler = longest.chosen_idler()
            limit = symmetric.longest_window(-idler / self.spec.gears.output, self.band)
        except NoSolution:
            return ""
        return f"set dwell.window to {safely_below(0.996 * math.degrees(limit))} deg (within the limits, idler {idler})"

    def depends_on_idler(self, refusal: NoSolution) -> bool:
        """A window that the smallest idler does not reach, no idler does: it falls with the idler's teeth, unless the
        band is so wide that a larger one reaches further."""
        if refusal.key not in ("dwell.window", "dwell.tolerance") or self._larger_reach_further():
            return super().depends_on_idler(refusal)
        self.linkage_of(LEAST_IDLER)  # its refusal names the best that can be had
        return True

    def _larger_reach_further(self) -> bool:
        if self.window is None or self.band is None or self.general:
            return False
        ratios = symmetric.reaching_ratios(self.window, self.band)
        return ratios is not None and ratios[0] * self.spec.gears.output > LEAST_IDLER

    # The links

    def crank_angle_for(self, i3: float) -> float:
        """phi12 that meets the request in the symmetric family."""
        if self.request.angle is not None:
            with at_key("dwell.angle"):
                return symmetric.crank_angle_for_dwell(i3, math.radians(self.request.angle))
        with at_key(self.key):
            if self.window is None:
                symmetric.check_tolerance(i3, self.tolerance or 0.0)  # of which `window_limit` tells too
                return symmetric.crank_angle_for_tolerance(i3, self.aimed_at)
            self._refuse_even_motion(1.0)
            if self.band is not None:
                symmetric.check_reach(i3, self.window, self.band)
            return symmetric.crank_angle_for_window(i3, self.window)

    def in_family(self, family: Family, train: GearTrain) -> FourBar:
        """phi13, the window of equal ripple, or the back-step that fills the band: the root of the one unknown.

        Where every frame steps back further than the band is wide: the window about one standstill.
        """
        from gearlink.core.machines.three_gear.families import dwell_angle_of, solved

        request = self.request
        if request.angle is not None:
            with at_key("dwell.angle"):
                words = f"a dwell angle of {request.angle:g} deg"
                return solved(family, dwell_angle_of(train), math.radians(request.angle), words, key="dwell.angle")
        with at_key(self.key):
            self._refuse_even_motion(abs(train.ratio))
            try:
                return self._of_equal_ripple(family, train)
            except NoSolution as refusal:
                given = train.idler == self.spec.gears.idler  # each idler that is tried would be a long search
                always = always_stepping(family, train) if given else None
                if always is None:
                    raise
                return family.linkage(self._about_one_standstill(always, train, refusal))

    def _of_equal_ripple(self, family: Family, train: GearTrain) -> FourBar:
        """The linkage whose back-step fills the band, or a band over the window."""
        from gearlink.core.machines.three_gear.families import solved, window_of

        if self.window is None:
            return self._fills(family, train)
        if self.spec.gears.idler is None:
            self._refuse_short_reach(family, train)
        words = f"a window of {self.request.window:g} deg"
        try:
            linkage = solved(family, window_of(train), self.window, words, key="dwell.window")
        except NoSolution:
            self._refuse_short_reach(family, train)  # which names the longest within the tolerance
            raise
        self._refuse_narrow_band(family, train, linkage)
        return linkage

    # Where the output steps back with every frame, and further than the band is wide

    def _about_one_standstill(self, always: AlwaysStepping, train: GearTrain, refusal: NoSolution) -> float:
        """The frame, with the asked transmission angle if any; a request that all frames miss is refused."""
        self.searched = True
        b, c = (abs(sum(pair)) for pair in pairwise(self.radii(train.idler)))
        parts = keeping(always, self.request.crank, b, c, math.radians(self.spec.limits.transmission_angle))
        if self.window is None:
            if always.step(always.low) > 2.0 * self.aimed_at < always.step(always.high):
                return parts[0].longest(self.aimed_at)[0]
            raise refusal
        if self.window > max(always.ripple(always.low), always.ripple(always.high)):
            raise refusal
        frame, least = flattest_of(parts, self.window, self.band)
        if self.band is None or least <= self.band:
            return frame
        place, longest = always.longest(self.band)
        raise NoSolution(
            f"{self._asked(self.band)} (limit <= {safely_below(math.degrees(longest))} deg as a crank-rocker with "
            f"these gears and this crank, frame {short(place)} mm, or +-{safely_above(math.degrees(least))} deg; "
            f"its back-step is at least {safely_above(math.degrees(always.least_step[1]))} deg)",
            fix="use a shorter crank",
        )

    def _fills(self, family: Family, train: GearTrain) -> FourBar:
        """The linkage whose back-step fills the band but for its margin; the whole band limits the tolerance."""
        from gearlink.core.machines.three_gear.families import back_step_of, solved

        whole, aimed = self.tolerance or 0.0, self.aimed_at
        words = f"a tolerance of {short(math.degrees(whole))} deg"
        most = back_step_of(train)(family.linkage(family.stepping()[1]))
        target, share = (2.0 * whole, 0.5) if 2.0 * whole > most else (2.0 * aimed, 0.5 * whole / aimed)
        return solved(family, back_step_of(train), target, words, share, "dwell.tolerance")

    def _refuse_even_motion(self, ratio: float) -> None:
        band, window = self.band, self.window
        if band is not None and window is not None and ratio * window <= 2.0 * band:
            raise NoSolution(
                f"even a uniform motion stays within +-{short(math.degrees(band))} deg over this window: no linkage "
                "needed",
                fix="increase dwell.window, or reduce dwell.tolerance",
            )

    def _refuse_short_reach(self, family: Family, train: GearTrain) -> None:
        """While an idler is sought: the window that fills the band tells sooner than the band that a window takes."""
        band, window = self.band, self.window
        if band is None or window is None:
            return
        try:
            longest = _filled_window(family, train, band)
        except NoSolution:
            return  # every back-step of this family is wider
        if longest is not None and longest < window * (1.0 - _ROUNDING):
            most = safely_below(math.degrees(longest))
            fix = f"set dwell.window to at most {most} deg"
            if self.spec.gears.idler is None:  # the smallest one: the limits are not looked at yet
                fix += f", with an idler of {train.idler:g} teeth where the limits allow it"
            raise NoSolution(f"{self._asked(band)} (limit <= {most} deg with these gears)", fix=fix)

    def _refuse_narrow_band(self, family: Family, train: GearTrain, found: FourBar) -> None:
        from gearlink.core.machines.three_gear.families import back_step_of

        band = self.band
        if band is None or (least := 0.5 * back_step_of(train)(found)) <= band:
            return

        longest = _filled_window(family, train, band)
        assert longest is not None  # a back-step of twice the minimum is wider than the band
        most = safely_below(math.degrees(longest))
        raise NoSolution(
            f"{self._asked(band)} (limit <= {most} deg with these gears, or +-{safely_above(math.degrees(least))} deg)",
            fix=f"set dwell.window to at most {most} deg",
        )

    def _asked(self, band: float) -> str:
        return f"dwell within +-{short(math.degrees(band))} deg: {self.request.window:g} deg"


def _filled_window(family: Family, train: GearTrain, band: float) -> float | None:
    """The window of the back-step that fills a band [rad], the longest one; None where none steps back so far.

    Raises
        NoSolution - for a family of which each back-step is wider
    """
    from gearlink.core.machines.three_gear.families import filling, window_of

    filled = filling(family, train, band)
    return None if filled is None else window_of(train)(filled)


def always_stepping(family: Family, train: GearTrain) -> AlwaysStepping | None:
    """The frames of a given crank, where the output steps back with each of them; None where one just stops it.

    Example
        >>> from gearlink.core.machines.three_gear.families import with_crank
        >>> found = always_stepping(with_crank(54.0, 78.0, 49.0, 72.778), GearTrain(54, 78, 49))
        >>> round(found.least_step[1], 6)
        0.455302
    """
    from gearlink.core.machines.three_gear.families import back_step_of

    if family.low is None or family.low != family.least or family.least == 0.0:
        return None
    low, high = sorted(family.stepping())
    if back_step_of(train)(family.linkage(0.5 * (low + high))) <= 0.0:
        return None

    return AlwaysStepping(lambda frame: Output(family.linkage(frame), train).valley, low, high)


class DwellSynthesis(ThreeGearFourBar):
    """`synth dwell`: phi13 is given, or a window, a tolerance, or both."""

    keys = dict.fromkeys(
        ("synth dwell", "analyze"),
        (
            ("?tolerance_dwell_angle", "dwell.window", "?dwell.tolerance"),
            ("?dwell_tolerance", "<dwell.tolerance"),
            ("?dwell_angle", "dwell.angle"),
            "idler_teeth",
            "crank_length",
            "frame_length",
            "frame_length_interval",
            ("min_transmission_angle", ">limits.transmission_angle"),
            ("gear_gap", ">limits.gear_gap"),
            "back_step_angle",
            "output_acceleration_max",
            "feed_per_turn",
            "speed_ratio_max",
            "acceleration_ratio_max",
        ),
    )
    outlines = with_analysis(
        "synth dwell", Outline((*QUANTITIES, *_DWELL), ("dwell-window", "dwell-edge", "back-step", *CHECKS))
    )
    extra_tables, table_candidates = TABLES, candidates_table

    @cached_property
    def task(self) -> DwellTask:
        """The section dwell."""
        return DwellTask(self.spec)

    def completion(self) -> Iterator[Found]:
        """The tolerance besides the links, so that an analysis measures the dwell by it."""
        yield from super().completion()
        request = self.task.request
        if request.tolerance is not None:
            yield Found("dwell_tolerance", float(request.tolerance), "from dwell.tolerance")
        if request.window is not None and self.task.band is not None:
            yield Found("dwell_window", float(request.window), "from dwell.window")

    @property
    def cost(self) -> float:
        """A dwell within a tolerance is sought anew for each design: milliseconds with an idler that is given, some
        hundredths of a second without, tenths for unequal gears, of which each idler is a search of its own. Where no
        idler serves, all were tried; a search over the whole range of frames takes as long as several.
        """
        task = self.task
        if task.request.angle is not None and not task.general:
            plain = 1.0
        elif self.spec.gears.idler is not None:
            plain = 3.5
        else:
            plain = 50.0 if task.general else 16.5
        return plain * (1 + (task.no_idler is not None) + 7 * task.searched)

    # What is reached

    @cached_property
    def dwell_angle(self) -> float | None:
        """As asked for, where phi12 was solved for it."""
        self.linkage  # noqa: B018 - a task without a mechanism is refused here as well
        return super().dwell_angle if self.task.request.angle is None else math.radians(self.task.request.angle)

    @property
    def dwell_tolerance(self) -> float | None:
        """Half of what the output covers in the window, which is half the back-step [rad], or less of a dwell about
        one standstill."""
        if self.back_step is None:
            return None
        return 0.5 * self.back_step.angle if self._narrower is None else self._narrower

    @cached_property
    def _frames(self) -> AlwaysStepping | None:
        """The frames, where the output steps back with each of them and a window or a tolerance is asked for."""
        if not self.task.general or self.task.request.angle is not None:
            return None
        return always_stepping(self.task.family(self.idler_teeth), self.train)

    @cached_property
    def _narrower(self) -> float | None:
        """The tolerance [rad] of a dwell about one standstill, narrower than half the back-step; None without one."""
        if self._frames is None or self.back_step is None:
            return None
        if self.task.window is None:
            found = self.task.aimed_at
        else:
            found = band_of_window(self._frames.valley(self.linkage.frame), self.task.window)
        return found if found < (1.0 - _ROUNDING) * 0.5 * self.back_step.angle else None

    @property
    def output_tolerance(self) -> float | None:
        """Tolerance that the dwell is measured at [rad]: the one asked for, else the one reached."""
        return self.task.tolerance or self.dwell_tolerance

    @cached_property
    def tolerance_dwell(self) -> ToleranceDwell | None:
        """The longest dwell within the tolerance; without a tolerance that of the band which the back-step fills."""
        step = self.back_step
        if self.task.tolerance is not None or step is None:
            return super().tolerance_dwell
        if self._narrower is not None:
            return self.output.within(self._narrower)
        return self.output.ripple

    @cached_property
    def window_limit(self) -> float | None:
        """Longest window that these gears reach at the asked tolerance [rad], where a back-step fills its band."""
        band = self.task.band
        if band is None:
            return None
        if not self.task.general:
            if self.task.window is not None and not symmetric.fills(self.i3, band):
                return None
            with at_key(self.task.key):
                return symmetric.longest_window(self.i3, band)
        if self._frames is not None and self._frames.least_step[1] > 2.0 * band:
            return self._frames.longest(band)[1]
        return _filled_window(self.task.family(self.idler_teeth), self.train, band)

    @cached_property
    def frame_ratio_interval(self) -> list[float] | None:
        """Frames over crank between which window and tolerance are met: of the symmetric family, else at this crank."""
        if self.task.window is None or self.task.band is None:
            return None
        if not self.task.general:
            return list(symmetric.frame_ratio_interval(self.i3, self.task.window, self.task.band))
        interval = self.frame_length_interval
        return None if interval is None else [length / self.linkage.crank for length in interval]

    @cached_property
    def frame_length_interval(self) -> list[float] | None:
        """Frames [mm] between which this crank meets window and tolerance.

        At the one the back-step fills the band or the crank turns just so (the longer one, but with a ring gear round
        the train), at the other the window is just as long as asked.
        """
        window, band = self.task.window, self.task.band
        if window is None or band is None:
            return None
        if self._frames is not None and self._frames.least_step[1] > 2.0 * band:
            return self._frames.interval(self.linkage.frame, window, band)
        from gearlink.core.machines.three_gear.families import met_between, with_crank

        links = self.linkage
        family = with_crank(*self.task.radii(self.idler_teeth), links.crank, self.spec.assembly)
        met = met_between(family, self.train, window, band, lambda each: each.frame, links.frame)
        return None if met is None else list(met)

    # Checks

    def check_dwell_window(self) -> Iterator[Check]:
        """GL313 where the file asks for both window and tolerance."""
        dwell = self.tolerance_dwell
        if self.task.window is None or self.task.band is None or dwell is None:
            return
        yield dwell_window_check(dwell.crank_angle, self.task.window, self.task.band)

    def check_dwell_edge(self) -> Iterator[Check]:
        """GL314 where the file asks for a tolerance: how near the window is to its jump."""
        step, band = self.back_step, self.task.band
        if step is None or band is None:
            return
        yield dwell_edge_check(0.5 * step.angle / band, self.frame_length_interval)

    def check_back_step(self) -> Iterator[Check]:
        """GL315 where phi13 is asked for: what the output does meanwhile."""
        step, asked = self.back_step, self.task.request.angle
        if asked is None or step is None:
            return
        half, limit = 0.5 * step.angle, self.task.tolerance or math.radians(PLAIN_TOLERANCE)
        yield back_step_judged(math.degrees(half), math.degrees(limit)).check(
            "half of the back-step of the output during the dwell",
            "give dwell.window and dwell.tolerance instead of dwell.angle",
            aside=f"dwell angle {short(asked)} deg",
        )
