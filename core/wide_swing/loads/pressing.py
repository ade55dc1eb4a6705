"""How hard the rollers of a wide-swing mechanism press on their cams: over the strokes, and in the rests of a cycle."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.wide_swing.loads.design import WideSwingLoads
    from gearlink.core.wide_swing.loads.rest import SwingRest


class Pressing:
    """Forces and pressures of rollers and cams; every result is computed when it is read."""

    def __init__(self, loads: WideSwingLoads) -> None:
        self.loads = loads

    @cached_property
    def rests(self) -> tuple[SwingRest, ...]:
        """The rests of a whole cycle, each on the cam of the stroke before it; those of no length left out."""
        from gearlink.core.wide_swing.loads.rest import LEAST, SwingRest

        zones = zip(self.loads.strokes, self.loads.dwell_zones, strict=False)
        return tuple(SwingRest(stroke, *zone) for stroke, zone in zones if zone[1] > LEAST)

    def _all(self, name: str) -> list[float]:
        """A value of every stroke and every rest."""
        return [each.pressed[name].value for each in self.loads.strokes] + [each.pressed[name] for each in self.rests]

    @cached_property
    def force(self) -> float:
        """Greatest force of the roller on any of the cams [N]; from geometry alone where nothing acts besides."""
        if self.loads.own_forces:
            return max(self._all("force"))
        design = self.loads.design
        in_rests = design.unloading.dwell_force([rest.stroke.cam for rest in self.rests]) if self.rests else 0.0
        return max(design.contact_force, in_rests)

    @cached_property
    def least_force(self) -> float:
        """Least force of the roller where it touches a cam [N]."""
        return min(self._all("least_force"))

    @cached_property
    def exists(self) -> bool:
        """Whether the roller has a width and bears on its cams wherever it touches them."""
        if self.loads.section.roller is None or any(rest.relative_radius <= 0.0 for rest in self.rests):
            return False
        return not any(stroke.is_undercut for stroke in self.loads.strokes)

    @cached_property
    def pressure(self) -> float | None:
        """Greatest pressure of roller and cam [N/mm^2]; None without a width, and where the cam is undercut."""
        return max(self._all("pressure")) if self.exists else None

    @property
    def hardest_rest(self) -> SwingRest | None:
        """The rest in which the pressure is greatest; None where that is in a stroke."""
        return next((rest for rest in self.rests if rest.pressed["pressure"] == self.pressure), None)

    @cached_property
    def shear_depth(self) -> float | None:
        """Greatest depth of the greatest shear stress [mm]; with a drive, that where the pressure is greatest."""
        if not self.exists:
            return None
        if self.loads.spec.drive is None:
            return max(self._all("shear_depth"))
        hardest = max(self.loads.strokes, key=lambda each: each.pressed["pressure"].value)
        return hardest.shear_depth_at_greatest_pressure
