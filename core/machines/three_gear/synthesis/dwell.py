"""`synth dwell`: links whose output is back at its place after a crank angle, or stays within a tolerance over one."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.design import Found, Outline
from gearlink.core.base.errors import MissingSection, NoSolution, anew, at_key
from gearlink.core.base.report import Check, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.machines.three_gear.dwell.momentary_dwell import wrap
from gearlink.core.machines.three_gear.dwell_checks import back_step_judged
from gearlink.core.machines.three_gear.families.forms import forms_for
from gearlink.core.machines.three_gear.idler_choice import LEAST_IDLER
from gearlink.core.machines.three_gear.motion import output_angle
from gearlink.core.machines.three_gear.names import CHECKS, QUANTITIES
from gearlink.core.machines.three_gear.symmetric import back_step as symmetric_back_step
from gearlink.core.machines.three_gear.synthesis.base import with_analysis
from gearlink.core.machines.three_gear.synthesis.dwell_task import DwellTask
from gearlink.core.parts.linkages.band_dwell import ToleranceDwell
from gearlink.core.parts.linkages.checks import dwell_edge_check, dwell_window_check

if TYPE_CHECKING:
    from gearlink.core.parts.linkages.always_stepping import AlwaysStepping

_ROUNDING = 1e-9
PLAIN_TOLERANCE = 1.0
"""Of a dwell that names none [deg]."""

_DWELL = (
    "dwell_tolerance",
    "window_limit",
    "frame_ratio_interval",
    "frame_length_interval",
)


class DwellSynthesis(DwellTask):
    """`synth dwell`: phi13 is given, or a window, a tolerance, or both."""

    outlines = with_analysis(
        "synth dwell", Outline((*QUANTITIES, *_DWELL), ("dwell-window", "dwell-edge", "back-step", *CHECKS))
    )

    def completion(self) -> Iterator[Found]:
        """The tolerance besides the links, so that an analysis measures the dwell by it."""
        yield from super().completion()
        if self._request.tolerance is not None:
            yield Found("dwell_tolerance", float(self._request.tolerance), "from dwell.tolerance")
        if self._request.window is not None and self._band is not None:
            yield Found("dwell_window", float(self._request.window), "from dwell.window")

    # The idler

    _no_idler: NoSolution | None = None
    """Why no idler was found: another check of the same design does not try some hundred of them again."""

    def chosen_idler(self) -> int:
        """The smallest that keeps the limits; a refusal names the longest window that one within them reaches."""
        if self._no_idler is not None:
            raise anew(self._no_idler)
        try:
            return super().chosen_idler()
        except MissingSection:
            raise
        except NoSolution as error:
            words = self._best_within_limits() if self.advises else ""
            self._no_idler = NoSolution(error.message + words, key=error.key)
            raise anew(self._no_idler) from error

    def _best_within_limits(self) -> str:
        """The longest window at the asked tolerance, of the smallest idler that keeps the limits.

        That idler was tried with the default margin, which costs a third of a percent of the window.
        """
        if self.window is None or self._band is None or self.general:
            return ""
        tolerance = self._request.model_copy(update={"window": None})
        longest = DwellSynthesis(self.spec.model_copy(update={"dwell": tolerance}))
        try:
            idler, limit = longest.idler_teeth, longest.window_limit
        except NoSolution:
            return ""
        assert limit is not None
        return (
            f"; within the limits the output stays within +-{math.degrees(self._band):.9g} deg over "
            f"{safely_below(0.996 * math.degrees(limit))} deg (idler {idler})"
        )

    def depends_on_idler(self, refusal: NoSolution) -> bool:
        """A window that the smallest idler does not reach, no idler does: it falls with the idler's teeth, unless the
        band is so wide that a larger one reaches further."""
        if refusal.key not in ("dwell.window", "dwell.tolerance") or self._larger_reach_further():
            return super().depends_on_idler(refusal)
        self.linkage_of(LEAST_IDLER)  # its refusal names the best that can be had
        return True

    def _larger_reach_further(self) -> bool:
        if self.window is None or self._band is None or self.general:
            return False
        from gearlink.core.machines.three_gear.symmetric.window_dwell import reaching_ratios

        ratios = reaching_ratios(self.window, self._band)
        return ratios is not None and ratios[0] * self.spec.gears.output > LEAST_IDLER

    @property
    def cost(self) -> float:
        """A dwell within a tolerance is sought anew for each design: milliseconds with an idler that is given, some
        hundredths of a second without, tenths for unequal gears, of which each idler is a search of its own. Where no
        idler serves, all were tried; a search over the whole range of frames takes as long as several.
        """
        if self._request.angle is not None and not self.general:
            plain = 1.0
        elif self.spec.gears.idler is not None:
            plain = 3.5
        else:
            plain = 50.0 if self.general else 16.5
        return plain * (1 + (self._no_idler is not None) + 7 * self._searched)

    # What is reached

    @cached_property
    def dwell_angle(self) -> float | None:
        """As asked for, where phi12 was solved for it."""
        self.linkage  # noqa: B018 - a task without a mechanism is refused here as well
        return super().dwell_angle if self._request.angle is None else math.radians(self._request.angle)

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
        if not self.general or self._request.angle is not None:
            return None
        return self._always(self._family(self.idler_teeth), self.train)

    @cached_property
    def _narrower(self) -> float | None:
        """The tolerance [rad] of a dwell about one standstill, narrower than half the back-step; None without one."""
        if self._frames is None or self.back_step is None:
            return None
        if self.window is None:
            found = self._aimed_at()
        else:
            from gearlink.core.parts.linkages.band_dwell import band_of_window

            found = band_of_window(self._frames.valley(self.linkage.frame), self.window)
        return found if found < (1.0 - _ROUNDING) * 0.5 * self.back_step.angle else None

    @property
    def output_tolerance(self) -> float | None:
        """Tolerance that the dwell is measured at [rad]: the one asked for, else the one reached."""
        return self.asked_tolerance or self.dwell_tolerance

    @cached_property
    def tolerance_dwell(self) -> ToleranceDwell | None:
        """The longest dwell within the tolerance; without a tolerance that of the band which the back-step fills."""
        step = self.back_step
        if self.asked_tolerance is not None or step is None:
            return super().tolerance_dwell
        if self._narrower is not None:
            from gearlink.core.machines.three_gear.dwell.tolerance_dwell import tolerance_dwell

            return tolerance_dwell(self.linkage, self.train, self._narrower)
        if self.general:
            from gearlink.core.machines.three_gear.families.external import ripple

            found = ripple(self.linkage, self.train)
            return ToleranceDwell(found.start, found.crank_angle, found.output_angle)
        phi13 = symmetric_back_step.dwell_angle(self.i3, step.crank_angle)
        start = wrap(step.start - (phi13 - step.crank_angle))
        middle = output_angle(self.linkage, self.train, start) + 0.5 * step.angle
        return ToleranceDwell(start, 2.0 * phi13 - step.crank_angle, middle)

    @cached_property
    def window_limit(self) -> float | None:
        """Longest window that these gears reach at the asked tolerance [rad], where a back-step fills its band."""
        band = self._band
        if band is None:
            return None
        if not self.general:
            from gearlink.core.machines.three_gear.symmetric import window_dwell

            if self.window is not None and not window_dwell.fills(self.i3, band):
                return None
            with at_key(self._key()):
                return window_dwell.longest_window(self.i3, band)
        if self._frames is not None and self._frames.least_step[1] > 2.0 * band:
            return self._frames.longest(band)[1]
        from gearlink.core.machines.three_gear.families.external import filling, ripple

        filled = filling(self._family(self.idler_teeth), self.train, band)
        return None if filled is None else ripple(filled, self.train).crank_angle

    @cached_property
    def frame_ratio_interval(self) -> list[float] | None:
        """Frames over crank between which window and tolerance are met: of the symmetric family, else at this crank."""
        if self.window is None or self._band is None:
            return None
        if not self.general:
            from gearlink.core.machines.three_gear.symmetric import window_dwell

            return list(window_dwell.frame_ratio_interval(self.i3, self.window, self._band))
        interval = self.frame_length_interval
        return None if interval is None else [length / self.linkage.crank for length in interval]

    @cached_property
    def frame_length_interval(self) -> list[float] | None:
        """Frames [mm] between which this crank meets window and tolerance.

        At the one the back-step fills the band or the crank turns just so (the longer one, but with a ring gear round
        the train), at the other the window is just as long as asked.
        """
        window, band = self.window, self._band
        if window is None or band is None:
            return None
        if self._frames is not None and self._frames.least_step[1] > 2.0 * band:
            return self._frames.interval(self.linkage.frame, window, band)
        from gearlink.core.machines.three_gear.families.window_lengths import met_between

        links, radii = self.linkage, self._radii(self.idler_teeth)
        family = forms_for(*radii).with_crank(*radii, links.crank, self.spec.assembly)
        met = met_between(family, self.train, window, band, lambda each: each.frame, links.frame)
        return None if met is None else list(met)

    # Checks

    def check_dwell_window(self) -> Iterator[Check]:
        """GL313 where the file asks for both window and tolerance."""
        dwell = self.tolerance_dwell
        if self.window is None or self._band is None or dwell is None:
            return
        yield dwell_window_check(dwell.crank_angle, self.window, self._band)

    def check_dwell_edge(self) -> Iterator[Check]:
        """GL314 where the file asks for a tolerance: how near the window is to its jump."""
        step, band = self.back_step, self._band
        if step is None or band is None:
            return
        yield dwell_edge_check(0.5 * step.angle / band, self.frame_length_interval)

    def check_back_step(self) -> Iterator[Check]:
        """GL315 where phi13 is asked for: what the output does meanwhile."""
        step = self.back_step
        if self._request.angle is None or step is None:
            return
        half, limit = 0.5 * step.angle, self.asked_tolerance or math.radians(PLAIN_TOLERANCE)
        whole = math.degrees(step.angle)
        text = (
            f"over the dwell angle of {self._request.angle:g} deg the output steps back by {whole:.6g} deg and returns"
        )
        remedy = (
            f", +-{math.degrees(half):.6g} deg about its middle: it does not stand. For one that stays within a "
            "tolerance ask for dwell: {window: deg, tolerance: deg}"
        )
        yield back_step_judged(math.degrees(half), math.degrees(limit)).check(text, remedy)
