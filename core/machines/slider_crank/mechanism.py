"""The mechanism of a slider-crank: crank, rod, slider."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.mechanism.closures import slider
from gearlink.core.mechanism.courses import between, coordinate
from gearlink.core.mechanism.dual import Shift, longer
from gearlink.core.mechanism.joints import Connection, Guide, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Course, Input, Motion, Output
from gearlink.core.mechanism.rates import fixed, standing, steady
from gearlink.core.studies.movable import Movable

if TYPE_CHECKING:
    from gearlink.core.machines.slider_crank.design import SliderCrankDesign
    from gearlink.core.numerics.arrays import Reals

DEPTH = coordinate("slider", along=-1j)


def motion(design: SliderCrankDesign) -> Motion:
    """Links and joints over the direction of the crank from +x, D at 0; the slider lies below on x = -offset."""
    part, racks = design.slider_crank, design.rack_drive
    crank_length, rod, offset = part.crank_length, part.rod, part.offset

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        crank = Link(fixed(0j, phi, order=order), steady(phi, order=order), {"D": 0.0, "E": crank_length})
        turn, end = slider(crank.at("E"), rod, complex(-offset), -1j)
        links = {
            "crank": crank,
            "rod": Link(crank.at("E"), turn, {"E": 0.0, "F": rod}),
            "slider": Link(end, standing(0.0, phi, order=order), {"F": 0.0}),
        }
        connections: list[Connection] = [
            Pin("D", FRAME, "crank", crank.origin.value),
            Pin("E", "crank", "rod", crank.at("E").value),
            Pin("F", "rod", "slider", end.value),
            Guide("guide", FRAME, "slider", end.value, -1j),
        ]
        if racks is None:
            return Mechanism(links, connections, "crank", travel={"slider": -1j})
        links |= racks.links(links["slider"])
        return Mechanism(links, [*connections, *racks.joints(links)], "crank", travel={"slider": -1j, "rack": -1j})

    outputs: tuple[Output, ...] = (Output("Slider F", displacement(design)),)
    if racks is not None:
        outputs = (Output("Rack", rack_displacement(design)), *outputs)
    return Motion(make, Input(), outputs, transmission=between("rod", "slider"))


def displacement(design: SliderCrankDesign) -> Course:
    """The way of the slider from the dead centre nearest to D [mm]."""
    return DEPTH.less(design.depth(design.dead_center_folded_at, 0))


def rack_displacement(design: SliderCrankDesign) -> Course:
    """The way of the moving rack from where the slider is nearest to D, positive as the slider's [mm]."""
    assert design.rack_drive is not None
    ratio = design.rack_drive.stroke_ratio
    return coordinate("rack", along=-1j).less(ratio * design.depth(design.dead_center_folded_at, 0))


def errors(design: SliderCrankDesign, mechanism: Mechanism) -> Movable:
    """Crank or stroke, rod and offset."""
    part = design.slider_crank
    ends = {"crank": ("crank", part.crank_length), "rod": ("rod", part.rod)}
    sizes = longer(mechanism, ends) | {"offset": (Shift(FRAME, ("guide",), -1.0),)}
    sizes["stroke"] = tuple(shift.scaled(part.crank_per_stroke) for shift in sizes["crank"])
    return Movable(sizes)
