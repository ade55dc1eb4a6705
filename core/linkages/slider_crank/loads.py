"""The loads of a slider-crank: crank, rod, slider."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.linkages.slider_crank.position import SliderCrank
from gearlink.core.loads.design import BALANCE, LoadsDesign, loads_outline
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.linkages.slider_crank.spec import SliderCrankSpec
    from gearlink.core.mechanism.joints import Connection
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.numerics.arrays import Reals


class SliderCrankLoads(LoadsDesign):
    """Input angle: direction of the crank from +x; the slider lies below on x = -offset and travels along -y."""

    kind = "slider-crank"
    spec: SliderCrankSpec
    links, sliding = ("crank", "rod", "slider"), ("slider",)
    pins, meshes = ("D", "E", "F"), ()
    output = "slider"
    outlines = loads_outline(pins, meshes, BALANCE)

    @cached_property
    def slider_crank(self) -> SliderCrank:
        """The geometry."""
        return self.spec.slider_crank()

    @property
    def transmission_angle(self) -> float:
        """Least angle between the rod and the normal to the guide [rad]: cos mu = (r + |e|)/L."""
        return math.acos((self.slider_crank.crank_length + abs(self.spec.offset)) / self.spec.rod)

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

        crank, rod, slider = (self.masses.get(name, Mass()) for name in self.links)
        part = rod.center / self.spec.rod
        reciprocating = slider.mass + rod.mass * part
        radius = self.slider_crank.crank_length
        return -(crank.mass * crank.center + radius * (rod.mass * (1.0 - part) + share * reciprocating))

    def kinematics(self, phi: Reals, order: int = 2) -> Mechanism:
        """The three links at crank angles, D at 0."""
        from gearlink.core.mechanism.closures import slider
        from gearlink.core.mechanism.joints import Guide, Pin
        from gearlink.core.mechanism.links import FRAME, Link, Mechanism
        from gearlink.core.mechanism.rates import fixed, standing, steady

        crank = Link(fixed(0j, phi, order=order), steady(phi, order=order))
        pin = crank.at(self.slider_crank.crank_length)
        turn, end = slider(pin, self.spec.rod, complex(-self.spec.offset), -1j)
        links = {"crank": crank, "rod": Link(pin, turn), "slider": Link(end, standing(0.0, phi, order=order))}
        connections: list[Connection] = [
            Pin("D", FRAME, "crank", crank.origin.value),
            Pin("E", "crank", "rod", pin.value),
            Pin("F", "rod", "slider", end.value),
            Guide("guide", FRAME, "slider", end.value, -1j),
        ]
        return Mechanism(links, connections, "crank", travel={"slider": -1j})
