"""What `synth dwell` of three gears asks for, and the links that give it."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import NoSolution, at_key, section_of
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.machines.three_gear.motion import GearTrain
from gearlink.core.machines.three_gear.symmetric import back_step as symmetric_back_step
from gearlink.core.machines.three_gear.synthesis.back_step import BackStepFamily
from gearlink.core.parts.linkages.fourbar.position import FourBar

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.families.external import Family
    from gearlink.core.parts.linkages.always_stepping import AlwaysStepping

MARGIN = 0.01
_ROUNDING = 1e-9
_WORDS = "angle, or window and tolerance (deg)"


class DwellTask(BackStepFamily):
    """A dwell of three gears: phi13, a window, a tolerance, or both of these."""

    task = "dwell"

    # The request

    @property
    def _request(self) -> Any:
        return section_of(self.spec, "dwell", _WORDS)

    @cached_property
    def window(self) -> float | None:
        """Crank angle [rad] over which the output is to stay within the tolerance."""
        return None if self._request.window is None else math.radians(self._request.window)

    @cached_property
    def asked_tolerance(self) -> float | None:
        """Tolerance of the output to either side [rad] that the file names."""
        if self._request.tolerance is not None:
            return math.radians(self._request.tolerance)
        return super().output_tolerance

    @property
    def _band(self) -> float | None:
        """The tolerance that the links are designed for; a phi13 is designed for none."""
        return None if self._request.angle is not None else self.asked_tolerance

    @cached_property
    def general(self) -> bool:
        """Unequal gears that ask for a window are balanced where the file does not say otherwise."""
        gears, request = self.spec.gears, self.spec.dwell
        unequal = request is not None and request.angle is None and gears.crank != gears.output
        return unequal or super().general

    def _key(self) -> str:
        return "dwell.tolerance" if self._request.window is None else "dwell.window"

    # The links

    def crank_angle_for(self, i3: float) -> float:
        """phi12 that meets the request in the symmetric family."""
        if self._request.angle is not None:
            with at_key("dwell.angle"):
                return symmetric_back_step.crank_angle_for_dwell(i3, math.radians(self._request.angle))
        from gearlink.core.machines.three_gear.symmetric import window_dwell

        with at_key(self._key()):
            if self.window is None:
                window_dwell.check_tolerance(i3, self.asked_tolerance or 0.0)  # of which `window_limit` tells too
                return window_dwell.crank_angle_for_tolerance(i3, self._aimed_at())
            self._refuse_even_motion(1.0)
            if self._band is not None:
                window_dwell.check_reach(i3, self.window, self._band)
            return symmetric_back_step.crank_angle_for_window(i3, self.window)

    def in_family(self, family: Family, train: GearTrain) -> FourBar:
        """phi13, the window of equal ripple, or the back-step that fills the band: the root of the one unknown.

        Where every frame steps back further than the band is wide: the window about one standstill.
        """
        from gearlink.core.machines.three_gear.families.external import dwell_angle_of, solved

        request = self._request
        if request.angle is not None:
            with at_key("dwell.angle"):
                words = f"a dwell angle of {request.angle:g} deg"
                return solved(family, dwell_angle_of(train), math.radians(request.angle), words)
        with at_key(self._key()):
            self._refuse_even_motion(abs(train.ratio))
            try:
                return self._of_equal_ripple(family, train)
            except NoSolution as refusal:
                given = train.idler == self.spec.gears.idler  # each idler that is tried would be a long search
                always = self._always(family, train) if given else None
                if always is None:
                    raise
                return family.linkage(self._about_one_standstill(always, refusal))

    def _of_equal_ripple(self, family: Family, train: GearTrain) -> FourBar:
        """The linkage whose back-step fills the band, or a band over the window."""
        from gearlink.core.machines.three_gear.families.external import ripple, solved, window_of

        if self.window is None:
            return self._fills(family, train)
        if self.spec.gears.idler is None:
            self._refuse_short_reach(family, train)
        words = f"a window of {self._request.window:g} deg"
        try:
            linkage = solved(family, window_of(train), self.window, words)
        except NoSolution:
            self._refuse_short_reach(family, train)  # which names the longest within the tolerance
            raise
        self._refuse_narrow_band(family, train, ripple(linkage, train).tolerance)
        return linkage

    # Where the output steps back with every frame, and further than the band is wide

    def _always(self, family: Family, train: GearTrain) -> AlwaysStepping | None:
        from gearlink.core.machines.three_gear.synthesis.always import always_stepping

        return always_stepping(family, train)

    _searched = False
    """Whether the whole range of frames was looked at."""

    def _about_one_standstill(self, always: AlwaysStepping, refusal: NoSolution) -> float:
        """The frame, with the asked transmission angle if any; a request that all frames miss is refused."""
        from gearlink.core.parts.linkages.always_stepping import flattest_of, keeping

        self._searched = True
        b, c = (abs(sum(pair)) for pair in pairwise(self._radii(self.idler_teeth)))
        parts = keeping(always, self._request.crank, b, c, math.radians(self.spec.limits.transmission_angle))
        if self.window is None:
            if always.step(always.low) > 2.0 * self._aimed_at() < always.step(always.high):
                return parts[0].longest(self._aimed_at())[0]
            raise refusal
        if self.window > max(always.ripple(always.low), always.ripple(always.high)):
            raise refusal
        frame, least = flattest_of(parts, self.window, self._band)
        if self._band is None or least <= self._band:
            return frame
        place, longest = always.longest(self._band)
        raise NoSolution(
            f"the output cannot stay within +-{math.degrees(self._band):.9g} deg over {self._request.window:g} deg "
            f"with a crank-rocker of these gears and this crank: at most over {safely_below(math.degrees(longest))} "
            f"deg (with a frame of {place:.7g} mm), or within +-{safely_above(math.degrees(least))} deg; with every "
            f"frame it steps back, by {safely_above(math.degrees(always.least_step[1]), 4)} deg or more: ask for one "
            "of these, or take a shorter crank"
        )

    def _fills(self, family: Family, train: GearTrain) -> FourBar:
        """The linkage whose back-step fills the band but for its margin; the whole band limits the tolerance."""
        from gearlink.core.machines.three_gear.families.external import back_step_of, solved

        whole, aimed = self.asked_tolerance or 0.0, self._aimed_at()
        words = f"a tolerance of {math.degrees(whole):.9g} deg"
        most = back_step_of(train)(family.linkage(family.stepping()[1]))
        target, share = (2.0 * whole, 0.5) if 2.0 * whole > most else (2.0 * aimed, 0.5 * whole / aimed)
        return solved(family, back_step_of(train), target, words, share)

    def _aimed_at(self) -> float:
        tolerance = self.asked_tolerance
        assert tolerance is not None
        return tolerance * (1.0 - (MARGIN if self._request.margin is None else self._request.margin))

    def _refuse_even_motion(self, ratio: float) -> None:
        band, window = self._band, self.window
        if band is not None and window is not None and ratio * window <= 2.0 * band:
            raise NoSolution(
                f"an even motion stays within +-{math.degrees(band):.9g} deg over that window: it needs no linkage; "
                "ask for a longer window or a smaller tolerance"
            )

    def _refuse_short_reach(self, family: Family, train: GearTrain) -> None:
        """While an idler is sought: the window that fills the band tells sooner than the band that a window takes."""
        band, window = self._band, self.window
        if band is None or window is None:
            return
        from gearlink.core.machines.three_gear.families.external import filling, ripple

        try:
            filled = filling(family, train, band)
        except NoSolution:
            return  # every back-step of this family is wider
        if filled is None:
            return
        longest = ripple(filled, train).crank_angle
        if longest < window * (1.0 - _ROUNDING):
            remedy = "; ask for that"
            if self.spec.gears.idler is None:  # the least one: the limits are not looked at yet
                remedy = f", with an idler of {train.idler:g} teeth where the limits allow it; ask for less"
            raise NoSolution(
                f"the output cannot stay within +-{math.degrees(band):.9g} deg over {self._request.window:g} deg with "
                f"these gears: at most over {safely_below(math.degrees(longest))} deg{remedy}"
            )

    def _refuse_narrow_band(self, family: Family, train: GearTrain, least: float) -> None:
        band = self._band
        if band is None or least <= band:
            return
        from gearlink.core.machines.three_gear.families.external import filling, ripple

        filled = filling(family, train, band)
        assert filled is not None  # a back-step of twice the least is wider than the band
        longest = ripple(filled, train).crank_angle
        raise NoSolution(
            f"the output cannot stay within +-{math.degrees(band):.9g} deg over {self._request.window:g} deg with "
            f"these gears: at most over {safely_below(math.degrees(longest))} deg, or within "
            f"+-{safely_above(math.degrees(least))} deg; ask for one of these"
        )
