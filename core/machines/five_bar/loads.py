"""The loads of a geared five-bar in either form: two links on the frame, two couplers, the gears between them."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING

from gearlink.core.base.design import geometry
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.machines.five_bar.design import GearedFiveBar
from gearlink.core.studies.loads.design import LoadsDesign, homecoming, is_directed, loads_outline

if TYPE_CHECKING:
    from gearlink.core.machines.five_bar.function_motion import FunctionFiveBar
    from gearlink.core.machines.five_bar.loads_spec import FiveBarLoads as Section
    from gearlink.core.machines.five_bar.spec import GearedFiveBarSpec
    from gearlink.core.mechanism.motion import Motion


class FiveBarLoads(LoadsDesign):
    """Input, coupler, follower, output; with an idler in the path form that too."""

    kind = "geared-five-bar"
    spec: GearedFiveBarSpec
    section: Section
    links = ("input", "coupler", "follower", "output", "idler")
    pins, meshes = ("A", "B", "C", "D", "E", "O"), ("mesh_14", "mesh_1i", "mesh_i4", "mesh_25")
    outlines = loads_outline(pins, meshes)
    design: cached_property[GearedFiveBar] = geometry(GearedFiveBar)

    @cached_property
    def has_idler(self) -> bool:
        """Whether an idler stands between input and output."""
        return self.design.is_path and self.spec.gears.idler is not None

    @cached_property
    def own_links(self) -> tuple[str, ...]:
        if not self.has_idler and self.section.links.idler is not None:
            raise NoSolution("this five-bar has no idler", key="loads.links.idler", fix="omit its mass")
        return self.links if self.has_idler else self.links[:-1]

    @property
    def turns(self) -> int:
        """Input turns of the whole period."""
        turns = homecoming(self.design.period_turns, "the gears repeat", "gears", "choose teeth with a common factor")
        gears = self.spec.gears
        if gears.idler is None or gears.input is None or not is_directed(self.section, "idler"):
            return turns
        home = (turns * Fraction(gears.input, gears.idler)).denominator
        return homecoming(turns * home, "the idler is back in its initial position", "gears.idler")

    @cached_property
    def function_bar(self) -> FunctionFiveBar:
        """The function form over its whole period."""
        bar = self.design.function_bar
        try:
            bar.closure(0.0, 2.0 * math.pi * self.turns, free=False)
        except NoSolution as error:
            message = f"loads are those of the whole period, whatever the range: {error.message}"
            key = "range" if self.spec.range is not None else "links"
            raise NoSolution(message, key=key, fix=error.fix) from error
        return bar

    @property
    def transmission_angle(self) -> float:
        """Minimum transmission angle over the whole period [rad], whatever the range."""
        if self.design.is_path:
            return self.design.min_transmission_angle
        return self.function_bar.min_transmission_angle(0.0, 2.0 * math.pi * self.turns)[0]

    @cached_property
    def moving(self) -> Motion:
        """The motion over the whole period, whatever the range."""
        if self.design.is_path:
            return self.design.moving
        from gearlink.core.machines.five_bar.mechanism import function_motion

        return function_motion(self.design, self.function_bar, 0.0, 2.0 * math.pi * self.turns)
