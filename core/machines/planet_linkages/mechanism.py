"""The mechanisms of two-gear four-bar and geared rocker: a four-bar, a free gear, a mesh on the carrier link."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.core.mechanism.courses import between, turned
from gearlink.core.mechanism.joints import Mesh, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Input, Motion, Output
from gearlink.core.mechanism.rates import from_start, mixed
from gearlink.core.parts.linkages.fourbar.mechanism import four_bar, four_bar_pins
from gearlink.core.parts.linkages.fourbar.position import solve

if TYPE_CHECKING:
    from gearlink.core.machines.planet_linkages.rocker_design import GearedRocker
    from gearlink.core.machines.planet_linkages.two_gear_design import TwoGearFourBar
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.studies.movable import Movable


def two_gear_errors(design: TwoGearFourBar, mechanism: Mechanism) -> Movable:
    """Links, the centre distance of the gears, which is the crank, and both gears."""
    output = "ring" if design.internal else "sun"
    return _movable(design, mechanism, "crank", "planet", output, design.planet_teeth)


def geared_rocker_errors(design: GearedRocker, mechanism: Mechanism) -> Movable:
    """Links, the centre distance of the gears, which is the rocker, and both gears."""
    return _movable(design, mechanism, "rocker", "coupler", "output", design.coupler_gear_teeth)


def _movable(
    design: Any, mechanism: Mechanism, carrier: str, coupler_gear: str, output_gear: str, coupler_teeth: int
) -> Movable:
    from gearlink.core.mechanism.dual import longer
    from gearlink.core.studies.movable import Movable, Turned

    bar, gears = design.linkage, design.spec.gears
    ends = {f"links.{name}": (name, getattr(bar, name)) for name in ("crank", "coupler", "rocker")}
    sizes = longer(mechanism, ends | {"links.frame": (FRAME, bar.frame)})
    center = f"{coupler_gear}_{output_gear}"
    sizes[f"centers.{center}"] = sizes[f"links.{carrier}"]
    teeth = {coupler_gear: ("coupler", coupler_teeth), output_gear: ("output", design.output_teeth)}
    return Movable(
        sizes,
        {center: getattr(bar, carrier)},
        gears={name: Turned.of(link, gears, z) for name, (link, z) in teeth.items()},
        radius=0.5 * gears.module * abs(design.output_teeth),
    )


OUTPUT = turned("output")


def two_gears(design: TwoGearFourBar) -> Motion:
    """Planet on the coupler at B, output gear or ring on A; A at 0 and D on +x."""
    return _motion(design, "crank", "A_output", design.internal)


def geared_rocker(design: GearedRocker) -> Motion:
    """Gear on the coupler at C, output gear on D; A at 0 and D on +x."""
    return _motion(design, "rocker", "D_output", internal=False)


def _motion(design: Any, carrier: str, output_pin: str, internal: bool) -> Motion:
    """Links and joints over the crank angle; the output counts from crank angle 0.

    th5 = (1 - i) carrier + i coupler,   i = -z2/z5 of an external mesh, +z2/z5 of a ring

    Source
        thesis 2.2.1, integrated
    """
    linkage, ratio = design.linkage, design.gear_ratio
    pair, at_start = design.mesh, solve(linkage, 0.0)
    r2, r5 = pair.working_radius
    tangent = math.tan(pair.working_pressure_angle)

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        links = four_bar(linkage, phi, order)
        pins = four_bar_pins(links)
        coupler = from_start(links["coupler"].turn, at_start.coupler_angle)
        holder = links[carrier]
        of_carrier = holder.turn if carrier == "crank" else from_start(holder.turn, at_start.rocker_angle)
        links["output"] = Link(holder.origin, mixed((1.0 - ratio, of_carrier), (ratio, coupler)))
        center = holder.origin.value
        mesh = Mesh("mesh_25", "output", "coupler", center, holder.unit, abs(r5), r2, tangent, internal, carrier)
        return Mechanism(links, [*pins, Pin(output_pin, FRAME, "output", center), mesh], "crank")

    outputs = (Output("Output gear 5", OUTPUT),)
    return Motion(make, Input("crank_angle"), outputs, transmission=between("coupler", "rocker"))
