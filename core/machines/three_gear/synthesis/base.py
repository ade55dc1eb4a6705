"""Syntheses of the three-gear four-bar: from an output motion to its links, and to its idler where it is left out."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import cache
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Found, Outline
from gearlink.core.base.errors import MissingSection, NoSolution, at_key
from gearlink.core.base.report import Table
from gearlink.core.base.results import cached_property
from gearlink.core.machines.three_gear.bodies import layout
from gearlink.core.machines.three_gear.design import ThreeGearFourBar
from gearlink.core.machines.three_gear.families.forms import forms_for
from gearlink.core.machines.three_gear.idler_choice import GREATEST_IDLER, LEAST_IDLER, smallest_idler
from gearlink.core.machines.three_gear.motion import Extremes, GearTrain, gear_gap
from gearlink.core.machines.three_gear.names import MESHES
from gearlink.core.machines.three_gear.symmetric import family
from gearlink.core.parts.linkages.fourbar.position import FourBar

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.families.external import Family

_GEARS = ThreeGearFourBar.outlines["gear"]
_STANDSTILL = 1.5 * math.pi
_TURN = 2.0 * math.pi


def with_analysis(synthesis: str, outline: Outline) -> dict[str, Outline]:
    """What a synthesis shows: its own outline, the analysis of what it finds, and its gears."""
    return {synthesis: outline, "analyze": outline._replace(tables=("motion",)), "gear": _GEARS}


class Synthesis(ThreeGearFourBar):
    """What the syntheses share: the choice of the idler; `linkage_of` gives the links for an idler."""

    extra_tables = (*ThreeGearFourBar.extra_tables, "candidates")

    def table_candidates(self, samples: int | None = None) -> Table:
        """The other modules and idlers that meet the task."""
        from gearlink.core.machines.three_gear.synthesis.candidates import table

        return table(self, samples)

    def __init__(self, spec: Any) -> None:
        super().__init__(spec)
        self.require_proportion()

    @property
    def dwell_request(self) -> Any:
        """None: a synthesis takes the section that it needs; that of a dwell reads its own."""
        return None

    @property
    def _addendum(self) -> float:
        """Half of what the tips of gears 1 and 5 reach beyond their reference circles, in transverse modules."""
        return 0.5 * self.tip_excess / self.spec.gears.transverse_module

    def linkage_of(self, idler: int) -> FourBar:
        """The links that meet the task with an idler of so many teeth."""
        raise NotImplementedError

    def _radii(self, idler: int) -> tuple[float, float, float]:
        gears = self.spec.gears
        return tuple(gears.transverse_module * teeth / 2.0 for teeth in (gears.crank, idler, gears.output))  # type: ignore[return-value]

    def completion(self) -> Iterator[Found]:
        """Idler and links in place of the tasks."""
        by, gears = f"found by {self._synthesis}", self.spec.gears
        if gears.idler is None:
            yield Found("gears.idler", self.idler_teeth, by)
        yield Found("gears.i3", None)
        yield Found("links", {"crank": self.crank_length, "frame": self.frame_length}, by)
        yield from (Found(section, None) for section in ("dwell", "back_step", "speed", "momentary"))

    @property
    def _synthesis(self) -> str:
        return next(command for command in self.outlines if command.startswith("synth"))

    def chosen_idler(self) -> int:
        """The smallest idler that keeps transmission angle and gear gap."""
        gears, limits = self.spec.gears, self.spec.limits
        try:
            return smallest_idler(
                self.linkage_of,
                gears.crank,
                gears.output,
                gears.transverse_module,
                addendum=self._addendum,
                min_transmission_angle=math.radians(limits.transmission_angle),
                min_gear_gap=limits.gear_gap,
                clear=self._clears_shafts,
            )
        except MissingSection:
            raise
        except NoSolution as error:
            if error.key in ("", "gears.idler") or not self.depends_on_idler(error):
                raise
            words = f"no idler from {LEAST_IDLER} to {GREATEST_IDLER} teeth meets the task: {error.message}"
            raise NoSolution(words, key="gears.idler") from error

    def _clears_shafts(self, linkage: FourBar, idler: int) -> bool:
        """Whether no gear reaches a shaft that the file names."""
        shafts, gears = self.spec.shafts, self.spec.gears
        if shafts is None:
            return True
        teeth = (gears.crank, idler, gears.output)
        own = None
        if self.own_teeth:
            from gearlink.core.parts.gears.train.meshes import Train

            own = dict(zip(MESHES, Train(gears, teeth, (None, None)).pairs(), strict=True))
        found = layout(linkage, GearTrain(*teeth), self.spec, own).shaft_pairs
        return all(pair.gap >= 0.0 for pair in found if not pair.bare)

    def depends_on_idler(self, _refusal: NoSolution) -> bool:
        """Whether another idler could avoid a refusal of `linkage_of`."""
        return True

    @cached_property
    def linkage(self) -> FourBar:
        """The links that meet the task."""
        return self.linkage_of(self.idler_teeth)

    def _gap_remedy(self, missing: float) -> str:
        larger = None if self.train.internal else self._idler_with_room()
        if larger is not None:
            return f"take an idler of {larger} teeth or more"
        return super()._gap_remedy(missing)

    def _idler_with_room(self) -> int | None:
        gears, limit = self.spec.gears, self.spec.limits.gear_gap
        for idler in range(self.idler_teeth + 1, GREATEST_IDLER + 1):
            try:
                linkage = self.linkage_of(idler)
            except NoSolution:
                continue
            train = GearTrain(gears.crank, idler, gears.output)
            if gear_gap(linkage, train, gears.transverse_module, self._addendum) >= limit:
                return idler
        return None


class SymmetricSynthesis(Synthesis):
    """The family I = 1 with equal gears 1 and 5 and equal coupler and rocker (thesis 4.1), in closed form.

    Gears of any size, and equal ones with a given crank or frame, have one bracketed root instead: `in_family`.
    """

    task = ""
    """The section of the file that the synthesis serves."""

    def in_family(self, family: Family, train: GearTrain) -> FourBar:
        """The linkage of a family in one unknown that meets the task."""
        raise NotImplementedError

    @cached_property
    def general(self) -> bool:
        """Whether the closed forms of the symmetric family do not serve the task."""
        section, gears = getattr(self.spec, self.task), self.spec.gears
        if section is None:
            return False
        if section.balanced and gears.crank == gears.output:
            return False  # equal gears are balanced by the symmetric family
        return bool(section.crank or section.frame or section.balanced)

    def _family(self, idler: int) -> Family:
        section, radii = getattr(self.spec, self.task), self._radii(idler)
        forms = forms_for(*radii)
        if min(radii) < 0.0:
            from gearlink.core.machines.three_gear.dwell.internal_dwell import shape

            with at_key("gears.output" if radii[0] > 0.0 else "gears.crank"):
                shape(*radii)  # a train that never just stops is refused whatever the links
        found: Family
        if section.crank is not None:
            with at_key(f"{self.task}.crank"):
                found = forms.with_crank(*radii, section.crank, self.spec.assembly)
        elif section.frame is not None:
            with at_key(f"{self.task}.frame"):
                found = forms.with_frame(*radii, section.frame, self.spec.assembly)
        else:
            found = forms.balanced(*radii, self.spec.assembly)
        return found

    def frame_ratio_for(self, i3: float) -> float:
        """Frame over crank that meets the task with a ratio i3."""
        raise NotImplementedError

    @cached_property
    def train(self) -> GearTrain:
        """The three gears; every closed form of the family asks for their ratio here."""
        if not self.general:
            self._require_equal_gears()
        return GearTrain(self.crank_teeth, self.idler_teeth, self.output_teeth)

    def _require_equal_gears(self) -> None:
        gears = self.spec.gears
        if gears.crank != gears.output:
            raise NoSolution(
                f"this synthesis belongs to the family I = 1: crank ({gears.crank}) and output ({gears.output}) teeth "
                f"must be equal; set output to {gears.crank}, or give {self.task}.crank, frame or balanced as well",
                key="gears.output",
            )

    @cached_property
    def frame_ratio_at(self) -> Callable[[float], float]:
        """`frame_ratio_for`, solved once for each i3."""
        return cache(self.frame_ratio_for)

    def linkage_of(self, idler: int) -> FourBar:
        """Links of the family for an idler."""
        gears = self.spec.gears
        if self.general:
            return self.in_family(self._family(idler), GearTrain(gears.crank, idler, gears.output))
        self._require_equal_gears()
        ratio = self.frame_ratio_at(-idler / gears.output)
        length = gears.transverse_module * (gears.crank + idler) / 2.0
        return family.symmetric_linkage(ratio, length, self.spec.assembly)

    def depends_on_idler(self, refusal: NoSolution) -> bool:
        """Unequal gears are wrong with every idler."""
        return refusal.key != "gears.output"

    @cached_property
    def frame_ratio(self) -> float:
        """Frame over crank."""
        return self.linkage.frame / self.linkage.crank if self.general else self.frame_ratio_at(self.i3)

    @cached_property
    def speed_extremes(self) -> Extremes:
        """Of the symmetric family in closed form (thesis (4-13)): half a turn apart."""
        if self.general:
            return super().speed_extremes
        limits = family.speed_ratio_limits(self.i3, self.frame_ratio)
        return Extremes(limits.greatest, (self._middle + math.pi) % _TURN, limits.least, self._middle)

    @cached_property
    def acceleration_extremes(self) -> Extremes:
        """Of the symmetric family in closed form: a quarter turn after and before the least speed."""
        if self.general:
            return super().acceleration_extremes
        peak = family.peak_acceleration_ratio(self.i3, self.frame_ratio)
        after, before = (self._middle + 0.5 * math.pi) % _TURN, (self._middle - 0.5 * math.pi) % _TURN
        return Extremes(peak, after, -peak, before)

    @property
    def _middle(self) -> float:
        """Crank angle of the least speed: 270 deg, mirrored with the assembly."""
        return _STANDSTILL if self.spec.assembly == 1 else math.pi - 0.5 * math.pi
