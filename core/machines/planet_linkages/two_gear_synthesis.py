"""Syntheses of the two-gear four-bar: the frame for a momentary dwell, a back-step, or a dwell in a tolerance."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from gearlink.core.base.design import Found, Outline
from gearlink.core.base.errors import NoSolution, at_key, section_of
from gearlink.core.base.report import Check, Table, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, unlike
from gearlink.core.machines.planet_linkages import two_gear_family as kernel
from gearlink.core.machines.planet_linkages.two_gear_design import CHECKS, QUANTITIES, TwoGearFourBar
from gearlink.core.machines.planet_linkages.two_gear_family import beyond_reach, momentary_frame
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.linkages.band_dwell import AlwaysStepping, ToleranceDwell, flattest_of, keeping, least_band
from gearlink.core.parts.linkages.checks import dwell_edge_check, dwell_window_check, target_check

_MARGIN = 0.01
_FIT = 1e-6  # deg, what a back-step of the printed frame may miss
_TABLES = (*TwoGearFourBar.extra_tables, "candidates")
_DWELL = (
    *("tolerance_dwell_angle", "tolerance_dwell_start", "dwell_tolerance", "window_limit", "frame_length_interval"),
    "tolerance_dwell_time",
)


def with_analysis(synthesis: str, outline: Outline) -> dict[str, Outline]:
    """What a synthesis shows: its own outline, the analysis of what it finds, and its gears."""
    return {synthesis: outline, "analyze": outline, "gear": TwoGearFourBar.outlines["gear"]}


def candidates_table(design: TwoGearFourBar, _samples: int | None = None) -> Table:
    """The task met with other planets and other output gears."""
    from gearlink.core.base.candidates import Sought, around, pairs, table

    gear = "gears.ring" if design.internal else "gears.sun"
    planet, output = design.spec.gears.planet, design.output_teeth
    command = next(command for command in design.outlines if command.startswith("synth"))
    keys = {"gears.planet": ("planet_teeth", "1"), gear: ("output_teeth", "1")}
    rows = pairs(sorted({round(0.9 * planet), planet, round(1.1 * planet)}), around(output)[:4])
    shown = ("crank_length", "frame_length", "tolerance_dwell_angle", "back_step_angle", "speed_ratio_max")
    found = (*shown, "acceleration_ratio_max", "min_transmission_angle")
    known = tuple(name for name in found if name in design.quantity_names())
    return table(design, Sought(command, keys, rows, known))


class MomentaryDwellSynthesis(TwoGearFourBar):
    """`synth momentary-dwell`: nothing else is given; the frame follows in closed form."""

    keys = dict.fromkeys(
        ("synth momentary-dwell", "analyze"),
        (
            *("motion", "dwell_crank_angles", "frame_length", ("min_transmission_angle", ">limits.transmission_angle")),
            *("back_step_angle", "mean_ratio", "speed_ratio_max", "output_acceleration_max", "feed_per_turn"),
            "acceleration_ratio_max",
        ),
    )
    outlines = with_analysis("synth momentary-dwell", Outline(QUANTITIES, CHECKS, ("motion",)))
    extra_tables, table_candidates = _TABLES, candidates_table
    seeks = True

    def sought_frame(self) -> float:
        """The double root of the standstills' equation."""
        return momentary_frame(self.family)


class BackStepSynthesis(TwoGearFourBar):
    """`synth back-step`: the back-step of the output is given."""

    keys = dict.fromkeys(
        ("synth back-step", "analyze"),
        (
            *(("back_step_angle", "back_step.angle"), "back_step_crank_angle", "frame_length"),
            *(("min_transmission_angle", ">limits.transmission_angle"), "mean_ratio", "speed_ratio_max"),
            *("output_acceleration_max", "feed_per_turn", "acceleration_ratio_max"),
        ),
    )
    outlines = with_analysis("synth back-step", Outline(QUANTITIES, ("target", *CHECKS), ("motion",)))
    extra_tables, table_candidates = _TABLES, candidates_table
    seeks = True

    @property
    def _request(self) -> float:
        return float(section_of(self.spec, "back_step", "angle (deg)").angle)

    def sought_frame(self) -> float:
        """The root of the back-step over the frame."""
        with at_key("back_step.angle"):
            words = f"a back-step of {self._request:g} deg"
            if self.always is not None:
                return self._of_always(self.always, math.radians(self._request), words)
            return kernel.solved(
                self.family, kernel.back_step_of, math.radians(self._request), words, key="back_step.angle"
            )

    def _of_always(self, always: AlwaysStepping, angle: float, words: str) -> float:
        """Of the frames with that back-step, to either side of the least one, that of the better transmission angle."""
        least, most = always.least_step[1], always.step(always.low)
        if angle < least:
            limit = safely_above(math.degrees(least))
            raise NoSolution(
                f"{words} is out of reach: at least {limit} deg as a crank-rocker with these gears and links, "
                "whose output steps back with every frame",
                fix=f"set back_step.angle to at least {limit} deg, or use more teeth on the ring gear",
            )
        frames = always.with_step(angle)
        if not frames:
            raise NoSolution(beyond_reach(words, most, self.family.drive(always.low), "back_step.angle"))
        return max(frames, key=lambda frame: self.family.drive(frame).linkage.min_transmission_angle())

    def check_target(self) -> Check:
        """GL307: the back-step of the finished design, measured on its motion."""
        residual = math.degrees(self.back_step_angle or 0.0) - self._request
        return target_check("the back-step", residual, _FIT, "deg")


class DwellSynthesis(TwoGearFourBar):
    """`synth dwell`: a window, a tolerance, or both are given."""

    keys = dict.fromkeys(
        ("synth dwell", "analyze"),
        (
            *(("tolerance_dwell_angle", "dwell.window"), ("dwell_tolerance", "<dwell.tolerance"), "frame_length"),
            *("frame_length_interval", ("min_transmission_angle", ">limits.transmission_angle"), "back_step_angle"),
            *("mean_ratio", "speed_ratio_max", "output_acceleration_max", "feed_per_turn", "acceleration_ratio_max"),
        ),
    )
    outlines = with_analysis(
        "synth dwell", Outline((*QUANTITIES, *_DWELL), ("dwell-window", "dwell-edge", *CHECKS), ("motion",))
    )
    extra_tables, table_candidates = _TABLES, candidates_table
    seeks = True

    def completion(self) -> Iterator[Found]:
        """The tolerance and the window besides the frame, so that an analysis measures the dwell by them."""
        yield from super().completion()
        if self._request.tolerance is not None:
            yield Found("dwell_tolerance", float(self._request.tolerance), "from dwell.tolerance")
            if self._request.window is not None:
                yield Found("dwell_window", float(self._request.window), "from dwell.window")

    # The request

    @property
    def _request(self) -> Any:
        return section_of(self.spec, "dwell", "window, tolerance or both (deg)")

    @cached_property
    def window(self) -> float | None:
        """Crank angle [rad] over which the output is to stay within the tolerance."""
        return None if self._request.window is None else math.radians(self._request.window)

    @cached_property
    def asked_tolerance(self) -> float | None:
        """Tolerance of the output to either side [rad] that the file names."""
        return None if self._request.tolerance is None else math.radians(self._request.tolerance)

    # The frame

    def sought_frame(self) -> float:
        """The back-step that fills the band, or the window of equal ripple: the root over the frame."""
        self._refuse_wide_band()
        with at_key("dwell.tolerance" if self.window is None else "dwell.window"):
            if self.window is None:
                return self._longest_frame() if self.always is not None else self._filled_frame()
            self._refuse_even_motion(self.window)
            frame, least = self._flattest
            self._refuse_narrow_band(least)
            return frame

    @cached_property
    def _flattest(self) -> tuple[float, float]:
        """The frame for the window, and its tolerance [rad]."""
        assert self.window is not None
        words = f"a window of {self._request.window:g} deg"
        if self.always is not None:
            return self._flattest_of(self.always, words)
        try:
            return kernel.flattest(
                self.family, self.window, words, beyond=self._longest is not None, key="dwell.window"
            )
        except NoSolution:
            self._refuse_long_window(self.window)
            raise

    # Where the output steps back with every frame

    @property
    def _parts(self) -> list[AlwaysStepping]:
        """The frames that keep the limit of the transmission angle, where there are some, and all of them."""
        assert self.always is not None
        a, b, c = self.family.crank, self.family.coupler, self.family.rocker
        return keeping(self.always, a, b, c, math.radians(self.spec.limits.transmission_angle))

    def _flattest_of(self, always: AlwaysStepping, words: str) -> tuple[float, float]:
        """Of frames that keep the limit of the transmission angle, unless those do not meet the tolerance."""
        assert self.window is not None
        if self.window > (most := always.ripple(always.low)):
            self._refuse_long_window(self.window)
            raise NoSolution(beyond_reach(words, most, self.family.drive(always.low), "dwell.window"))
        return flattest_of(self._parts, self.window, self.asked_tolerance)

    def _longest_frame(self) -> float:
        """The frame of the longest dwell in the band but for its margin, with the asked transmission angle if any."""
        return self._parts[0].longest(self._aimed_at)[0]

    # The limits

    @cached_property
    def _longest(self) -> tuple[float, float] | None:
        """Frame [mm] and length [rad] of the longest window within the asked tolerance, where it can be filled."""
        if self.always is not None and self.asked_tolerance is not None:
            return self.always.longest(self.asked_tolerance)
        return None if self.asked_tolerance is None else kernel.longest(self.family, self.asked_tolerance)

    @property
    def _aimed_at(self) -> float:
        tolerance = self.asked_tolerance
        assert tolerance is not None
        return tolerance * (1.0 - (_MARGIN if self._request.margin is None else self._request.margin))

    def _filled_frame(self) -> float:
        """The frame of the longest dwell in the band but for its margin; the whole band limits the tolerance."""
        whole, aimed = self.asked_tolerance or 0.0, self._aimed_at
        words = f"a tolerance of {short(math.degrees(whole))} deg"
        most = kernel.back_step_of(self.family.drive(kernel.stepping(self.family)[1]))
        if 2.0 * whole > most:
            kernel.solved(self.family, kernel.back_step_of, 2.0 * whole, words, 0.5, "dwell.tolerance")
        longest = kernel.longest(self.family, aimed)
        assert longest is not None
        return longest[0]

    @property
    def _mean(self) -> float:
        """Output turns per crank turn, in the class of linkage in which the output stands still."""
        return 1.0 - self.gear_ratio if self.internal else 1.0

    def _refuse_wide_band(self) -> None:
        band = self.asked_tolerance
        if band is not None and band >= math.pi * self._mean:
            raise NoSolution(
                f"dwell tolerance: {unlike(math.degrees(band), 180.0 * self._mean)} deg (limit < "
                f"{safely_below(180.0 * self._mean)} deg, half of the output angle per revolution of the crank)",
                key="dwell.tolerance",
                fix=f"set dwell.tolerance below {safely_below(180.0 * self._mean)} deg",
            )

    def _refuse_even_motion(self, window: float) -> None:
        band = self.asked_tolerance
        if band is not None and self._mean * window <= 2.0 * band:
            raise NoSolution(
                f"even a uniform motion stays within +-{short(math.degrees(band))} deg over this window: no linkage "
                "needed",
                fix="increase dwell.window, or reduce dwell.tolerance",
            )

    def _refuse_long_window(self, window: float) -> None:
        """A window beyond the family is refused by the longest within the tolerance, where that is shorter yet."""
        band, longest = self.asked_tolerance, self.window_limit
        if band is None or longest is None or longest >= window:
            return
        most = safely_below(math.degrees(longest))
        raise NoSolution(f"{self._asked(band, most)})", fix=f"set dwell.window to {most} deg")

    def _refuse_narrow_band(self, least: float) -> None:
        band, limit = self.asked_tolerance, self.window_limit
        if band is None or limit is None or least <= band:
            return
        most, wide = safely_below(math.degrees(limit)), safely_above(math.degrees(least))
        raise NoSolution(
            f"{self._asked(band, most)}, or +-{wide} deg)",
            fix=f"set dwell.window to {most} deg, or dwell.tolerance to {wide} deg",
        )

    def _asked(self, band: float, most: str) -> str:
        """The request, and the longest window, with the transmission angle at which it is had."""
        assert self._longest is not None
        angle = math.degrees(self.family.drive(self._longest[0]).linkage.min_transmission_angle())
        return (
            f"dwell within +-{short(math.degrees(band))} deg: {self._request.window:g} deg (limit <= {most} deg with "
            f"these gears and links, transmission angle {angle:.3g} deg"
        )

    # What is reached

    @property
    def dwell_tolerance(self) -> float | None:
        """Half of what the output covers in the window [rad], which is half the back-step unless that is shorter, or
        too wide for the band."""
        if self.back_step is None:
            return None
        half = 0.5 * self.back_step.angle
        if self.always is not None:
            return min(half, self._aimed_at) if self.window is None else self._flattest[1]
        return half if self.window is None else max(half, self._flattest[1])

    @property
    def output_tolerance(self) -> float | None:
        """The tolerance asked for [rad]; without one half of the band which the back-step fills."""
        return self.asked_tolerance or self.dwell_tolerance

    @cached_property
    def tolerance_dwell(self) -> ToleranceDwell | None:
        tolerance = self.output_tolerance
        return None if tolerance is None else self.drive.within(tolerance)

    @property
    def window_limit(self) -> float | None:
        """Longest window of these gears and links at the asked tolerance [rad], where a back-step fills its band."""
        return None if self._longest is None else self._longest[1]

    @cached_property
    def frame_length_interval(self) -> list[float] | None:
        """Frames [mm] between which window and tolerance are met.

        At one end the back-step fills the band or the crank turns just so, at the other the window is just as long as
        asked; of a window longer than that back-step's it is so at both.
        """
        window, band = self.window, self.asked_tolerance
        if window is None or band is None:
            return None
        family, frame = self.family, self.linkage.frame
        if self.always is not None:
            return self.always.interval(frame, window, band)
        edge = kernel.filling(family, band) or kernel.stepping(family)[1]

        def spare(other: float) -> float:
            return band - least_band(family.drive(other).valley, window)  # one root, not two in each other

        def just(*ends: float) -> float:
            """Where the window is just as long, on the way from the design's frame to some ends; the last one else."""
            near, room = frame, spare(frame)
            for end in ends:
                lack = spare(end)
                if lack < 0.0:
                    # A window as long as the limit leaves one frame, where rounding decides the sign.
                    return bracketed_root(spare, near, end, ends=(room, lack)) if room > 0.0 else near
                near, room = end, lack
            return near

        filled = kernel.window_of(family.drive(edge)) >= window
        return sorted((edge if filled else just(edge), just(kernel.stepping(family)[0], kernel.quiet_end(family))))

    # Checks

    def check_dwell_window(self) -> Iterator[Check]:
        """GL313 where the file asks for both window and tolerance."""
        dwell, window, band = self.tolerance_dwell, self.window, self.asked_tolerance
        if dwell is not None and window is not None and band is not None:
            yield dwell_window_check(dwell.crank_angle, window, band)

    def check_dwell_edge(self) -> Iterator[Check]:
        """GL314 where the file asks for a tolerance: how near the window is to its jump."""
        step, band = self.back_step, self.asked_tolerance
        if step is not None and band is not None:
            yield dwell_edge_check(0.5 * step.angle / band, self.frame_length_interval)
