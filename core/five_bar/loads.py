"""The loads of a geared five-bar in either form: two links on the frame, two couplers, the gears between them."""

from __future__ import annotations

import cmath
import math
from fractions import Fraction
from typing import TYPE_CHECKING

from gearlink.core.errors import NoSolution
from gearlink.core.five_bar.design import GearedFiveBar
from gearlink.core.gears.outline.mesh_phase import signed_pair
from gearlink.core.loads.design import LoadsDesign, loads_outline
from gearlink.core.loads.periods import homecoming, is_directed
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.five_bar.function_motion import FunctionFiveBar
    from gearlink.core.five_bar.loads_spec import FiveBarLoads as Section
    from gearlink.core.five_bar.spec import GearedFiveBarSpec
    from gearlink.core.mechanism.joints import Connection
    from gearlink.core.mechanism.links import Link, Mechanism
    from gearlink.core.numerics.arrays import Reals


class FiveBarLoads(LoadsDesign):
    """Input, coupler, follower, output; with an idler in the path form that too."""

    kind = "geared-five-bar"
    spec: GearedFiveBarSpec
    section: Section
    links = ("input", "coupler", "follower", "output", "idler")
    pins, meshes = ("A", "B", "C", "D", "E", "O"), ("mesh_14", "mesh_1i", "mesh_i4", "mesh_25")
    outlines = loads_outline(pins, meshes)

    @cached_property
    def design(self) -> GearedFiveBar:
        """The geometry."""
        return GearedFiveBar(self.spec)

    @cached_property
    def has_idler(self) -> bool:
        """Whether an idler stands between input and output."""
        return self.design.is_path and self.spec.gears.idler is not None

    @cached_property
    def own_links(self) -> tuple[str, ...]:
        """The links that this design has."""
        if not self.has_idler and self.section.links.idler is not None:
            raise NoSolution("this five-bar has no idler: leave its mass out", key="loads.links.idler")
        return self.links if self.has_idler else self.links[:-1]

    @property
    def turns(self) -> int:
        """Input turns of the whole period."""
        turns = homecoming(self.design.period_turns, "the gears repeat", "gears", "choose teeth with a common factor")
        gears = self.spec.gears
        if gears.idler is None or gears.input is None or not is_directed(self.section, "idler"):
            return turns
        home = (turns * Fraction(gears.input, gears.idler)).denominator
        return homecoming(turns * home, "the idler comes home", "gears.idler")

    @cached_property
    def function_bar(self) -> FunctionFiveBar:
        """The function form over its whole period."""
        bar = self.design.function_bar
        try:
            bar.closure(0.0, 2.0 * math.pi * self.turns, free=False)
        except NoSolution as error:
            message = f"loads are those of the whole period, whatever the range: {error.message}"
            raise NoSolution(message, key="range" if self.spec.range is not None else "links") from error
        return bar

    @property
    def transmission_angle(self) -> float:
        """Least transmission angle over the whole period [rad], whatever the range."""
        if self.design.is_path:
            return self.design.min_transmission_angle
        return self.function_bar.min_transmission_angle(0.0, 2.0 * math.pi * self.turns)[0]

    def _rolling(self, name: str = "") -> tuple[float, float, float]:
        """Working radii of a mesh [mm], the first gear of the file's lists first, and tan of the pressure angle."""
        pair = signed_pair(self.design.meshes[name])
        one, other = (abs(radius) for radius in pair.working_radius)
        if self.design.signed_teeth[0] < 0:
            one, other = other, one
        return one, other, math.tan(pair.working_pressure_angle)

    def kinematics(self, phi: Reals, order: int = 2) -> Mechanism:
        """The links at input angles, A at 0 and E on +x."""
        from gearlink.core.mechanism.links import Mechanism

        links, connections = self._path(phi, order) if self.design.is_path else self._function(phi, order)
        return Mechanism(links, connections, "input")

    def _path(self, phi: Reals, order: int) -> tuple[dict[str, Link], list[Connection]]:
        from gearlink.core.mechanism.closures import dyad
        from gearlink.core.mechanism.joints import Pin
        from gearlink.core.mechanism.links import FRAME, Link
        from gearlink.core.mechanism.rates import fixed, steady

        bar = self.design.path_bar
        first = Link(fixed(0j, phi, order=order), steady(phi, order=order))
        last = Link(fixed(bar.frame, phi, order=order), steady(phi, float(bar.ratio), bar.phase, order=order))
        b, d = first.at(bar.input), last.at(bar.output)
        t2, t3 = dyad(b, d, bar.coupler, bar.follower, bar.assembly)
        links = {"input": first, "coupler": Link(b, t2), "follower": Link(d, t3), "output": last}
        pins: list[Connection] = [
            Pin("A", FRAME, "input", first.origin.value),
            Pin("B", "input", "coupler", b.value),
            Pin("C", "coupler", "follower", links["coupler"].at(bar.coupler).value),
            Pin("D", "output", "follower", d.value),
            Pin("E", FRAME, "output", last.origin.value),
        ]
        return links, pins + self._path_gears(links, phi, order)

    def _path_gears(self, links: dict[str, Link], phi: Reals, order: int) -> list[Connection]:
        """The mesh of input and output, or those with the idler between them, which joins the links."""
        from gearlink.core.mechanism.joints import Mesh, Pin
        from gearlink.core.mechanism.links import FRAME, Link
        from gearlink.core.mechanism.rates import fixed, steady

        gears = self.spec.gears
        a, e = links["input"].origin.value, links["output"].origin.value
        if not self.has_idler:
            r1, r4, tangent = self._rolling()
            if gears.mesh == "internal" and r4 > r1:
                return [Mesh("mesh_14", "output", "input", e, -1.0 + 0j, r4, r1, tangent, True)]
            return [Mesh("mesh_14", "input", "output", a, 1.0 + 0j, r1, r4, tangent, gears.mesh == "internal")]
        (r1, ri, tangent), (ri_out, r4, tangent_out) = (self._rolling(name) for name in self.design.mesh_names)
        frame = self.design.path_bar.frame
        near, far = r1 + ri, ri_out + r4
        along = 0.5 * (frame + (near - far) * (near + far) / frame)
        axis = cmath.rect(near, self.spec.gears.idler_side * math.acos(along / near))
        center = fixed(axis, phi, order=order)
        links["idler"] = Link(center, steady(phi, -r1 / ri, order=order))
        return [
            Pin("O", FRAME, "idler", center.value),
            Mesh("mesh_1i", "input", "idler", a, axis / near, r1, ri, tangent),
            Mesh("mesh_i4", "idler", "output", center.value, (frame - axis) / far, ri_out, r4, tangent_out),
        ]

    def _function(self, phi: Reals, order: int) -> tuple[dict[str, Link], list[Connection]]:
        from gearlink.core.mechanism.closures import dyad
        from gearlink.core.mechanism.joints import Mesh, Pin
        from gearlink.core.mechanism.links import FRAME, Link
        from gearlink.core.mechanism.rates import fixed, steady

        bar, gears = self.function_bar, self.spec.gears
        first = Link(fixed(0j, phi, order=order), steady(phi, order=order))
        coupler = Link(first.at(bar.input), steady(phi, bar.coupler_ratio, bar.phase, order=order))
        c, pivot = coupler.at(bar.coupler), fixed(bar.frame, phi, order=order)
        t3, t4 = dyad(c, pivot, bar.follower, bar.output, bar.assembly)
        links = {"input": first, "coupler": coupler, "follower": Link(c, t3), "output": Link(pivot, t4)}
        r2, r5, tangent = self._rolling()
        return links, [
            Pin("A", FRAME, "input", first.origin.value),
            Pin("B", "input", "coupler", coupler.origin.value),
            Pin("C", "coupler", "follower", c.value),
            Pin("D", "follower", "output", links["output"].at(bar.output).value),
            Pin("E", FRAME, "output", pivot.value),
            Mesh("mesh_25", FRAME, "coupler", first.origin.value, first.unit, r5, r2, tangent,
                 gears.ring is not None, "input"),
        ]  # fmt: skip
