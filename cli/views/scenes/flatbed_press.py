"""The flatbed press: one revolution of the input, a sheet. Chains and cams are to scale, as in its diagram."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes.cams import disc_cam
from gearlink.cli.views.scenes.colors import BLACK, BLUE, DWELL, GREEN, GREY, RED, pale
from gearlink.cli.views.scenes.gears import gear
from gearlink.cli.views.scenes.scene import (
    TURN,
    Body,
    Chain,
    Chart,
    Curve,
    Line,
    Mark,
    Part,
    Points,
    Readout,
    Reals,
    Scene,
    bands,
    block,
    circle,
    letters,
    loop,
    track,
    wheel,
)
from gearlink.core.machines.flatbed_press.loads_spec import PressLoads
from gearlink.core.machines.flatbed_press.mechanism import bare
from gearlink.core.parts.gears.outline.mesh_geometry import driven_turn

if TYPE_CHECKING:
    from gearlink.core.machines.flatbed_press.design import FlatbedPress
    from gearlink.core.mechanism.links import Link
    from gearlink.core.mechanism.motion import Motion

LEVEL = -1j
"""Turns the bed chain's frame so that the bed moves level, printing to the right: AD points down, F stands left."""
UPRIGHT = 1j
"""Turns the cylinder chain's frame so that N stands above G; its cylinder, geared to N, then runs with the bed."""
_BED, _RACK = "#CFE8F7", "#F6E3C0"
_CAM_COLORS = (BLUE, RED)


@dataclass(frozen=True)
class Machine:
    """Where the parts of a press stand; what the design leaves free keeps the parts apart."""

    design: FlatbedPress
    fraction: Reals
    cams: bool = True

    @property
    def phi(self) -> Reals:
        """Input angle [rad]."""
        return TURN * self.fraction

    @cached_property
    def links(self) -> Mapping[str, Link]:
        """All links; without its cams the lower rack stands."""
        return self._moving.at(self.phi, 0).links

    @cached_property
    def _moving(self) -> Motion:
        return self.design.moving if self.cams else bare(self.design).moving

    def velocity(self, link: str, pin: str) -> Points:
        """Of a pin by the input angle [mm/rad], N towards +x from G."""
        found = self._moving.at(self.phi, 1).links
        side = np.sign(self.links["MN"].origin.value.real - self.links["gear1"].origin.value.real)
        return found[link].at(pin).first * (side if link == "MN" else 1.0)

    @cached_property
    def bed_joints(self) -> tuple[Points, ...]:
        """A to F with the slide level."""
        pins = (("gear2", "A"), ("gear2", "B"), ("CDE", "C"), ("CDE", "D"), ("CDE", "E"), ("carriage", "F"))
        return tuple(LEVEL * self.links[link].at(pin).value for link, pin in pins)

    @cached_property
    def slide(self) -> float:
        """Height of the slide line [mm]."""
        return float(self.bed_joints[5].imag[0])

    @cached_property
    def gear_axis(self) -> complex:
        """Axis G, on the height of the slide line."""
        gears = self.design.spec.input_gears
        if gears is not None:
            return complex(-gears.horizontal_distance, self.slide)
        bed, cylinder = self.design.bed, self.design.cylinder.linkage
        reach = max(bed.slider_crank_length, bed.linkage.crank) + bed.linkage.frame
        return complex(-1.1 * (reach + cylinder.crank + cylinder.frame), self.slide)

    @cached_property
    def cylinder_links(self) -> tuple[Points, ...]:
        """G, H, M, N with G in the origin and N above it."""
        center, pins = self.links["gear1"].origin.value, (("gear1", "G"), ("gear1", "H"), ("MN", "M"), ("MN", "N"))
        side = np.sign((self.links["MN"].origin.value - center).real)
        return tuple(UPRIGHT * side * (self.links[link].at(pin).value - center) for link, pin in pins)

    @property
    def cylinder_joints(self) -> tuple[Points, ...]:
        """G, H, M, N where they stand in the machine."""
        return tuple(self.gear_axis + joint for joint in self.cylinder_links)

    @cached_property
    def cam_angle(self) -> Reals:
        """Angle turned by the cams [rad]."""
        return np.asarray(self.links["CDE"].turn.value - self.design.bed.cam_angle_start)

    @cached_property
    def lift(self) -> Reals:
        """Way of the lower rack [mm]; nothing without cams."""
        rack = self.links.get("rack")
        return np.zeros_like(self.fraction) if rack is None else rack.origin.value.imag

    @cached_property
    def bed_travel(self) -> Reals:
        """Way of the bed [mm], the compensation taken off."""
        return self.links["bed"].origin.value.imag - self._bed_at_start

    @property
    def _bed_at_start(self) -> float:
        return 2.0 * float(bare(self.design).moving.at(np.zeros(1), 0).links["carriage"].origin.value[0].imag)

    @cached_property
    def cylinder_travel(self) -> Reals:
        """Way of the cylinder's surface [mm]."""
        return self.design.cylinder.radius * self.links["cylinder"].turn.value

    @property
    def pinion(self) -> float:
        """Radius of the pinion on F [mm]."""
        return 0.12 * self.design.spec.bed.stroke

    @property
    def bed_top(self) -> float:
        """Height of the bed's top [mm]."""
        return self.slide + self.pinion + 0.06 * self.design.spec.bed.stroke

    @cached_property
    def cam_axis(self) -> complex:
        """Where the cams of the shaft D are drawn: beside the chains."""
        design = self.design
        links, roller = design.bed, 0.0 if design.spec.cam is None else design.spec.cam.roller_radius
        gears = 0.0 if design.spec.input_gears is None else design.gear_pair.tip_radius[0]
        reach = max(links.linkage.crank + links.linkage.frame, links.slider_crank_length, gears)
        return complex(self.bed_joints[3][0]) + reach + 1.5 * design.max_radius + 2.0 * roller

    @cached_property
    def cylinder_axis(self) -> complex:
        """Axis of the cylinder: on the bed, geared to N."""
        radius, n = self.design.cylinder.radius, complex(self.cylinder_joints[3][0])
        rise = self.bed_top + radius - n.imag
        distance = max(radius * (1.0 + self.design.cylinder.gear_ratio), 1.001 * abs(rise))
        return complex(n.real - math.sqrt(distance**2 - rise**2), self.bed_top + radius)


def build(design: FlatbedPress, fraction: Reals, *, cams: bool = True) -> Scene:
    """Positions over fractions of the loop; the cams stand beside the chains."""
    machine = Machine(design, fraction, cams)
    chains = bed_chain(machine.bed_joints), cylinder_chain(machine.cylinder_joints)
    return Scene(
        parts=(
            *_driving_circles(machine),
            *_bed(machine),
            *_cylinder(machine),
            *_input_gears(machine),
            *(part for chain in chains for part in chain.parts),
            *(_cams(machine) if cams else ()),
        ),
        marks=(
            *(mark for chain in chains for mark in chain.marks),
            Mark(track(machine.cylinder_axis, fraction), pivot=True),
            *(_cam_words(machine) if cams else ()),
        ),
        chart=_chart(machine),
        readouts=(
            Readout("input", "°", np.degrees(machine.phi)),
            Readout("bed", " mm", machine.bed_travel),
            Readout("cylinder", " mm", machine.cylinder_travel),
            Readout("lift of the cam", " mm", machine.lift),
        ),
    )


def as_drawn(design: FlatbedPress) -> Motion | None:
    """The motion with gear 1 and the cylinder where they are drawn; None where the file places them by its loads."""
    if design.spec.loads is not None or design.spec.input_gears is None:
        return None
    machine = Machine(design, np.zeros(1), cams=False)
    to_gear = machine.gear_axis / LEVEL
    to_cylinder = (machine.cylinder_axis - complex(machine.cylinder_joints[3][0])) / LEVEL
    section = PressLoads.model_construct(
        bed_side=-1,
        gear_1_direction=math.degrees(np.angle(to_gear)),
        cylinder_direction=math.degrees(np.angle(to_cylinder)),
    )
    return type(design)(design.spec.model_copy(update={"loads": section})).moving


def bed_chain(joints: tuple[Points, ...]) -> Scene:
    """The links A to F alone."""
    marks = letters("AD", **dict(zip("ABCDEF", joints, strict=True)))
    return Scene(parts=(Chain(joints=joints, color=BLUE),), marks=marks)


def cylinder_chain(joints: tuple[Points, ...]) -> Scene:
    """The links G to N alone."""
    marks = letters("GN", **dict(zip("GHMN", joints, strict=True)))
    return Scene(parts=(Chain(joints=joints, color=GREEN),), marks=marks)


def _bed(machine: Machine) -> list[Part]:
    """Pinion on F between the rack that the cams move and the rack of the bed."""
    stroke, fraction = machine.design.spec.bed.stroke, machine.fraction
    f, pinion = machine.bed_joints[5], machine.pinion
    middle = 0.5 * (float(f.real.min()) + float(f.real.max()))
    thick = 0.06 * stroke
    whole = replace(machine, fraction=loop(721)).bed_travel
    travel = machine.bed_travel - 0.5 * (float(whole.min()) + float(whole.max()))
    upper = middle + travel + 1j * (machine.slide + pinion + 0.5 * thick)
    lower = middle + machine.lift + 1j * (machine.slide - pinion - 0.5 * thick)
    turn = -(f.real - machine.lift) / pinion
    spoke = pinion * np.array([-1.0, 1.0, 0.0, 1j, -1j])
    return [
        Line(points=f[[int(f.real.argmin()), int(f.real.argmax())]]),
        block(upper, 0.72 * stroke, thick, BLACK, "bed", fill=_BED),
        block(lower, 1.0 * stroke, thick, BLACK, "rack moved by the cams", fill=_RACK),
        wheel(f, pinion, fraction, color=BLUE, fill=pale(BLUE, 0.1)),
        Body(outline=spoke, place=f, turn=turn, color=BLUE),
    ]


def _cylinder(machine: Machine) -> list[Part]:
    """The cylinder on the bed; its gripper gap shows how it turns."""
    radius, axis = machine.design.cylinder.radius, machine.cylinder_axis
    turn = machine.cylinder_travel / radius - 0.5 * math.pi
    gap = radius * np.exp(1j * np.linspace(-0.35, 0.0, 9))
    outline = np.concatenate([[0.82 * gap[0]], gap, [0.82 * gap[-1], 0.82 * gap[0]]])
    shared = {"place": track(axis, machine.fraction), "turn": turn, "color": GREEN}
    return [
        Body(outline=circle(radius, 144), repeats=0, fill=pale(GREEN, 0.12), **shared, label="cylinder"),  # type: ignore[arg-type]
        Body(outline=outline, fill="#ffffff", **shared),  # type: ignore[arg-type]
    ]


def _driving_circles(machine: Machine) -> list[Part]:
    """Pitch circles of the gears from N to the cylinder."""
    axis, n = machine.cylinder_axis, complex(machine.cylinder_joints[3][0])
    driven = abs(axis - n) / (1.0 + machine.design.cylinder.gear_ratio)
    level = np.zeros_like(machine.fraction)
    return [
        Body(
            outline=circle(radius, 120),
            place=track(center, machine.fraction),
            turn=level,
            repeats=0,
            color=GREY,
            width=0.8,
            label=label,
            pitch=radius,
        )
        for label, center, radius in (("4", axis, driven), ("3", n, abs(axis - n) - driven))
    ]


def _input_gears(machine: Machine) -> list[Part]:
    """Gears 1 on G and 2 on A with their teeth, where the design has them."""
    design = machine.design
    if design.spec.input_gears is None:
        return []
    pair, a, g = design.gear_pair, machine.bed_joints[0], machine.cylinder_joints[0]
    line = np.full_like(machine.fraction, np.angle(machine.gear_axis))
    turn = driven_turn(pair.teeth, line, machine.phi)
    return [
        *gear(pair, 0, a, machine.phi, 1.0, GREY, "2"),
        *gear(pair, 1, g, turn, -1.0, GREY, "1"),
    ]


def _cams(machine: Machine) -> list[Part]:
    """The cams of the shaft D with the rollers of the rack, drawn beside it."""
    design = machine.design
    if design.spec.cam is None:
        return []
    axis = track(machine.cam_axis, machine.fraction)
    back = disc_cam(design.return_cam, axis, machine.cam_angle, _CAM_COLORS[1])
    main = disc_cam(design.main_cam, axis, machine.cam_angle, _CAM_COLORS[0])
    parts: list[Part] = [back, replace(main, fill="")]
    places = (
        design.cam_base_radius + machine.lift,
        design.cam_base_radius - design.roller_center_distance + machine.lift,
    )
    rollers = [axis + place for place in places]
    for center, color in zip(rollers, _CAM_COLORS, strict=True):
        parts.append(wheel(center, design.spec.cam.roller_radius, machine.fraction, color=color, fill=pale(color, 0.3)))
    parts.append(Chain(joints=(rollers[0], rollers[1]), color=GREY, width=1.5))
    parts.append(wheel(axis, 0.12 * design.cam_base_radius, machine.fraction, color=BLACK, fill="#ffffff"))
    return parts


def _cam_words(machine: Machine) -> tuple[Mark, ...]:
    design = machine.design
    if design.spec.cam is None:
        return ()
    below = machine.cam_axis - (1.0 + 1.4j) * design.max_radius
    return (Mark(track(below, machine.fraction), "cams on D"),)


def _chart(machine: Machine) -> Chart:
    whole = replace(machine, fraction=loop())
    return Chart(
        "input angle [deg]",
        "travel [mm]",
        360.0 * loop(),
        np.degrees(machine.phi),
        (
            Curve("bed", BLUE, whole.bed_travel, machine.bed_travel),
            Curve("cylinder", GREEN, whole.cylinder_travel, machine.cylinder_travel),
        ),
        bands([("synchronous zone", *np.degrees([machine.design.sync_start, machine.design.sync_end]), DWELL)]),
    )
