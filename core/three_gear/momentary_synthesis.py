"""`synth momentary-dwell`: links whose output stops just once a turn, without stepping back."""

from __future__ import annotations

from gearlink.core.design import Outline
from gearlink.core.errors import NoSolution, at_key
from gearlink.core.linkages.fourbar import FourBar
from gearlink.core.report import safely_below
from gearlink.core.results import cached_property
from gearlink.core.three_gear.idler_choice import LEAST_IDLER
from gearlink.core.three_gear.momentary_dwell import (
    balanced_eccentricity,
    crank_with_room,
    eccentricity_for_frame,
    least_eccentricity,
    momentary_crank_angle,
    momentary_linkage,
)
from gearlink.core.three_gear.names import CHECKS, QUANTITIES
from gearlink.core.three_gear.synthesis import Synthesis, with_analysis


class MomentaryDwellSynthesis(Synthesis):
    """`synth momentary-dwell`: any three gears and one length are given, the other is sought."""

    outlines = with_analysis("synth momentary-dwell", Outline(QUANTITIES, CHECKS))

    def _crank_of(self, idler: int) -> float:
        """Crank length as given, or from the frame, the gap or the balance that is."""
        wish, radii = self.section("momentary", "eccentricity, frame or gap (mm), or balanced"), self._radii(idler)
        if wish.eccentricity is not None:
            return float(wish.eccentricity)
        if wish.frame is not None:
            with at_key("momentary.frame"):
                return eccentricity_for_frame(*radii, wish.frame)
        if wish.gap is None:
            with at_key("momentary.balanced"):
                return balanced_eccentricity(*radii)
        distance = radii[0] + radii[2] + 2.0 * self.spec.gears.module + wish.gap
        crank = crank_with_room(*radii, distance)
        if crank is None:
            raise NoSolution(
                f"a momentary dwell of these gears has no gap of {wish.gap:g} mm between gears 1 and 5; ask for less "
                f"than {self._widest_gap(radii):.6g} mm",
                key="momentary.gap",
            )
        return crank

    def linkage_of(self, idler: int) -> FourBar:
        """Frame length in closed form, in place of thesis (4-26)..(4-33)."""
        crank = self._crank_of(idler)
        with at_key("momentary.eccentricity"):
            return momentary_linkage(*self._radii(idler), crank, self.spec.assembly)

    def _widest_gap(self, radii: tuple[float, float, float]) -> float:
        """The gap of the shortest crank with a momentary dwell [mm]."""
        shortest = least_eccentricity(*radii)
        return radii[1] * 2.0 - 2.0 * shortest - 2.0 * self.spec.gears.module

    def depends_on_idler(self, _refusal: NoSolution) -> bool:
        """A crank not below the radius of gear 1 is too long with every idler."""
        crank = self.section("momentary", "eccentricity (mm)").eccentricity
        return crank is None or crank < self._radii(LEAST_IDLER)[0]

    @cached_property
    def dwell_crank_angles(self) -> list[float]:
        """The one standstill, at full precision."""
        return [momentary_crank_angle(*self._radii(self.idler_teeth), self.linkage.crank, self.spec.assembly)]

    def _gap_remedy(self, missing: float) -> str:
        words = super()._gap_remedy(missing)
        wish = self.section("momentary", "eccentricity (mm)")
        if wish.gap is not None:
            return f"set momentary.gap to at least {self.spec.limits.gear_gap:g} mm"
        if wish.eccentricity is None:
            return words
        shorter = self._longest_crank_with_room()
        return (
            words
            if shorter is None
            else f"set momentary.eccentricity to at most {safely_below(shorter)} mm, or {words}"
        )
