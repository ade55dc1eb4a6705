"""`synth momentary-dwell`: links whose output stops just once a turn, without stepping back."""

from __future__ import annotations

from collections.abc import Iterable

from gearlink.core.base.design import Outline, placed
from gearlink.core.base.errors import NoSolution, at_key, section_of
from gearlink.core.base.remedies.ways import at_most
from gearlink.core.base.report import Remedy
from gearlink.core.base.results import cached_property
from gearlink.core.machines.three_gear.dwell import momentary_dwell
from gearlink.core.machines.three_gear.dwell.internal_dwell import is_internal
from gearlink.core.machines.three_gear.dwell.momentary_dwell import (
    Intermediates,
    crank_with_room,
    intermediates,
    least_eccentricity,
)
from gearlink.core.machines.three_gear.families import internal
from gearlink.core.machines.three_gear.idler_choice import LEAST_IDLER
from gearlink.core.machines.three_gear.names import CHECKS, QUANTITIES
from gearlink.core.machines.three_gear.synthesis.base import Synthesis, with_analysis
from gearlink.core.parts.linkages.fourbar.position import FourBar

_STEPS = (
    "quartic_k",
    "quartic_l",
    "quartic_m",
    "base_angle",
    "pole_angle",
    "segment_af",
    "segment_fe",
    "segment_eg",
    "segment_gd",
)


class MomentaryDwellSynthesis(Synthesis):
    """`synth momentary-dwell`: any three gears and one length are given, the other is sought."""

    outlines = with_analysis("synth momentary-dwell", Outline((*QUANTITIES, *_STEPS), CHECKS))

    def _crank_of(self, idler: int) -> float:
        """Crank length as given, or from the frame, the gap or the balance that is."""
        request, radii = (
            section_of(self.spec, "momentary", "eccentricity, frame or gap (mm), or balanced"),
            self._radii(idler),
        )
        forms = internal if is_internal(*radii) else momentary_dwell
        if request.eccentricity is not None:
            return float(request.eccentricity)
        if request.frame is not None:
            with at_key("momentary.frame"):
                return float(forms.eccentricity_for_frame(*radii, request.frame))
        if request.gap is None:
            with at_key("momentary.balanced"):
                return float(forms.balanced_eccentricity(*radii))
        if is_internal(*radii):
            raise NoSolution(
                "a ring gear stands in another plane than gear 1, with no gap between them: give eccentricity, frame "
                "or balanced",
                key="momentary.gap",
            )
        distance = radii[0] + radii[2] + self.tip_excess + request.gap
        crank = crank_with_room(*radii, distance)
        if crank is None:
            raise NoSolution(
                f"a momentary dwell of these gears has no gap of {request.gap:g} mm between gears 1 and 5; ask for "
                f"less than {self._widest_gap(radii):.6g} mm",
                key="momentary.gap",
            )
        return crank

    def linkage_of(self, idler: int) -> FourBar:
        """Frame length in closed form, in place of thesis (4-26)..(4-33)."""
        crank, radii = self._crank_of(idler), self._radii(idler)
        with at_key("momentary.eccentricity"):
            forms = internal if is_internal(*radii) else momentary_dwell
            linkage: FourBar = forms.momentary_linkage(*radii, crank, self.spec.assembly)
        return linkage

    @cached_property
    def steps(self) -> Intermediates | None:
        """The thesis's steps to the frame; it knows no rings."""
        radii = self._radii(self.idler_teeth)
        return None if is_internal(*radii) else intermediates(*radii, self.linkage.crank)

    quartic_k: float | None = placed("steps.k")
    quartic_l: float | None = placed("steps.l")
    quartic_m: float | None = placed("steps.m")
    base_angle: float | None = placed("steps.beta")
    pole_angle: float | None = placed("steps.alpha")
    segment_af: float | None = placed("steps.af")
    segment_fe: float | None = placed("steps.fe")
    segment_eg: float | None = placed("steps.eg")
    segment_gd: float | None = placed("steps.gd")

    def _widest_gap(self, radii: tuple[float, float, float]) -> float:
        """The gap of the shortest crank with a momentary dwell [mm]."""
        shortest = least_eccentricity(*radii)
        return radii[1] * 2.0 - 2.0 * shortest - self.tip_excess

    def depends_on_idler(self, _refusal: NoSolution) -> bool:
        """A crank not below the radius of gear 1 is too long with every idler."""
        crank = section_of(self.spec, "momentary", "eccentricity (mm)").eccentricity
        return crank is None or crank < self._radii(LEAST_IDLER)[0]

    @cached_property
    def dwell_crank_angles(self) -> list[float]:
        """The one standstill, at full precision."""
        radii = self._radii(self.idler_teeth)
        if is_internal(*radii):
            return super().dwell_crank_angles
        return [momentary_dwell.momentary_crank_angle(*radii, self.linkage.crank, self.spec.assembly)]

    def _gap_remedy(self, missing: float) -> str:
        words = super()._gap_remedy(missing)
        request = section_of(self.spec, "momentary", "eccentricity (mm)")
        if request.gap is not None:
            return f"set momentary.gap to at least {self.spec.limits.gear_gap:g} mm"
        if request.eccentricity is None or self._longest_crank_with_room() is None:
            return words
        return f"shorten momentary.eccentricity, or {words}"

    def candidates(self, check: str, /) -> Iterable[Remedy]:
        """The longest crank with which the gears have room."""
        given = self.spec.momentary is not None and self.spec.momentary.eccentricity is not None
        shorter = self._longest_crank_with_room() if check == "gear-collision" and given else None
        return () if shorter is None else ((("momentary.eccentricity", at_most(shorter)),),)
