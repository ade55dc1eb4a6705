"""The loads of a slider-crank: crank, rod, slider."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.base.design import geometry
from gearlink.core.base.results import cached_property
from gearlink.core.machines.slider_crank.design import SliderCrankDesign
from gearlink.core.studies.loads.design import LoadsDesign, loads_outline
from gearlink.core.studies.loads.names import BALANCE

if TYPE_CHECKING:
    from gearlink.core.machines.slider_crank.spec import SliderCrankSpec


class SliderCrankLoads(LoadsDesign):
    """Input angle: direction of the crank from +x; the slider lies below on x = -offset and travels along -y."""

    kind = "slider-crank"
    spec: SliderCrankSpec
    links, sliding = ("crank", "rod", "slider", "pinion", "rack"), ("slider", "rack")
    pins, meshes = ("D", "E", "F", "pinion"), ("mesh_fixed", "mesh_moving")
    outlines = loads_outline(pins, meshes, BALANCE)
    design: cached_property[SliderCrankDesign] = geometry(SliderCrankDesign)

    @property
    def own_links(self) -> tuple[str, ...]:
        """Pinion and rack where the file has racks."""
        return self.links if self.spec.racks is not None else self.links[:3]

    @property
    def output(self) -> str:  # type: ignore[override]
        """The slider, or the moving rack."""
        return "slider" if self.spec.racks is None else "rack"

    def counterweights(self) -> dict[str, complex]:
        """One on the crank, for the rotating masses and a share of the reciprocating ones.

        U = -[m1 z1 + r (m2 (1 - z2/L) + kappa (m3 + m2 z2/L))]
        """
        from gearlink.core.numerics.roots import maximum

        share = self.section.balance.reciprocating_share
        if share == "best":
            share = maximum(lambda kappa: -self.balanced_force({"crank": self._counterweight(kappa)}), 0.0, 1.0)[0]
        return {"crank": self._counterweight(float(share))}

    def _counterweight(self, share: float) -> complex:
        from gearlink.core.mechanism.dynamics import Mass

        crank, rod, slider = (self.masses.get(name, Mass()) for name in self.links[:3])
        part = rod.center / self.design.slider_crank.rod
        reciprocating = slider.mass + rod.mass * part
        radius = self.design.slider_crank.crank_length
        return -(crank.mass * crank.center + radius * (rod.mass * (1.0 - part) + share * reciprocating))
