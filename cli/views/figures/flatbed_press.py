"""Scene and figures of a flatbed cylinder press: motion in twelve positions, cams, input gears and slider-crank.

The scene is one revolution of the input, a sheet. Chains and cams are to scale, as in its diagram.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.cams import disc_cam
from gearlink.cli.views.figures.drawing import failing, linkage, panels, scene_axes, style, time_axes
from gearlink.cli.views.figures.gears import Mesh, mesh_figure
from gearlink.cli.views.scenes.gears import gear
from gearlink.cli.views.scenes.of_motion import Frame, Positions, Seen, inputs
from gearlink.cli.views.scenes.scene import (
    DWELL,
    TURN,
    Body,
    Chain,
    Line,
    Mark,
    Part,
    Points,
    Reals,
    Scene,
    bands,
    block,
    circle,
    letters,
    loop,
    pale,
    round_below,
    track,
    wheel,
)
from gearlink.core.machines.flatbed_press.chains import difference, least_transmission_input
from gearlink.core.machines.flatbed_press.loads_spec import PressLoads
from gearlink.core.parts.gears.outline.mesh_geometry import driven_turn

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.flatbed_press.design import FlatbedPress
    from gearlink.core.mechanism.motion import Course


LEVEL = -1j
"""Turns the bed drive's frame so that the bed moves level, printing to the right: AD points down, F stands left."""
UPRIGHT = 1j
"""Turns the cylinder drive's frame so that N stands above G; its cylinder, geared to N, then runs with the bed."""
_BED, _RACK = "#CFE8F7", "#F6E3C0"


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
    def here(self) -> Positions:
        """The links; without its cams the lower rack stands."""
        return Positions((self.design if self.cams else self.design.without_cam).moving, self.phi)

    def velocity(self, link: str, pin: str) -> Points:
        """Of a pin by the input angle [mm/rad], N towards +x from G."""
        found = self.here.motion.at(self.phi, 1).links
        return found[link].at(pin).first * (self._side if link == "MN" else 1.0)

    @cached_property
    def _side(self) -> float:
        """+1 where N stands towards +x from G in the motion, else -1."""
        return float(np.sign((self.here.at("MN") - self.here.at("gear1")).real[0]))

    @cached_property
    def bed_joints(self) -> tuple[Points, ...]:
        """A to F with the slide level."""
        pins = (("gear2", "A"), ("gear2", "B"), ("CDE", "C"), ("CDE", "D"), ("CDE", "E"), ("carriage", "F"))
        return tuple(LEVEL * self.here.at(*pin) for pin in pins)

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
        pins = ("gear1", "G"), ("gear1", "H"), ("MN", "M"), ("MN", "N")
        return tuple(UPRIGHT * self._side * (self.here.at(*pin) - self.here.at("gear1")) for pin in pins)

    @property
    def cylinder_joints(self) -> tuple[Points, ...]:
        """G, H, M, N where they stand in the machine."""
        return tuple(self.gear_axis + joint for joint in self.cylinder_links)

    @cached_property
    def cam_angle(self) -> Reals:
        """Angle turned by the cams [rad]."""
        return np.asarray(self.here.turn("CDE") - self.design.bed.cam_angle_start)

    @cached_property
    def lift(self) -> Reals:
        """Way of the lower rack [mm]; nothing without cams."""
        return self.here.at("rack").imag if "rack" in self.here.now.links else np.zeros_like(self.fraction)

    @property
    def pinion(self) -> float:
        """Radius of the pinion on F [mm]."""
        return 0.12 * self.design.motion.bed_stroke

    @property
    def bed_top(self) -> float:
        """Height of the bed's top [mm]."""
        return self.slide + self.pinion + 0.06 * self.design.motion.bed_stroke

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
    here, chains = machine.here, (bed_chain(machine.bed_joints), cylinder_chain(machine.cylinder_joints))
    (bed, cylinder), zone = here.motion.outputs, np.degrees([design.sync_start, design.sync_end]).tolist()
    seen = {"bed": Seen(bed.course, style.BLUE, "mm"), "cylinder": Seen(cylinder.course, style.GREEN, "mm")}
    travel = {name: (" mm", each.at(here.motion, here.inputs)) for name, each in seen.items()}
    return here.scene(
        (
            *_driving_circles(machine),
            *_bed(machine, bed.course),
            *_cylinder(machine),
            *_input_gears(machine),
            *(part for chain in chains for part in chain.parts),
            *(_cam_bodies(machine) if cams else ()),
        ),
        seen,
        "travel [mm]",
        marked=bands([("synchronous zone", *zone, DWELL)]),
        marks=(
            *(mark for chain in chains for mark in chain.marks),
            Mark(track(machine.cylinder_axis, fraction), pivot=True),
            *(_cam_words(machine) if cams else ()),
        ),
        values={**travel, "lift of the cam": (" mm", machine.lift)},
    )


def frame(design: FlatbedPress) -> Frame:
    """Where the scene stands: gear 1 and the cylinder are where the file's loads place them, else where it has them."""
    motion = design.moving
    if design.spec.loads is None and design.spec.input_gears is not None:
        machine = Machine(design, np.zeros(1), cams=False)
        to_gear = machine.gear_axis / LEVEL
        to_cylinder = (machine.cylinder_axis - complex(machine.cylinder_joints[3][0])) / LEVEL
        gear, cylinder = (math.degrees(np.angle(way)) for way in (to_gear, to_cylinder))
        section = PressLoads.model_construct(bed_side=-1, gear_1_direction=gear, cylinder_direction=cylinder)
        motion = type(design)(design.spec.model_copy(update={"loads": section})).moving
    return Frame(partial(inputs, motion.input), motion, LEVEL)


def bed_chain(joints: tuple[Points, ...]) -> Scene:
    """The links A to F alone."""
    marks = letters("AD", **dict(zip("ABCDEF", joints, strict=True)))
    return Scene(parts=(Chain(joints=joints, color=style.BLUE),), marks=marks)


def cylinder_chain(joints: tuple[Points, ...]) -> Scene:
    """The links G to N alone."""
    marks = letters("GN", **dict(zip("GHMN", joints, strict=True)))
    return Scene(parts=(Chain(joints=joints, color=style.GREEN),), marks=marks)


def _bed(machine: Machine, travel: Course) -> list[Part]:
    """Pinion on F between the rack that the cams move, without them fixed, and the rack of the bed."""
    stroke, fraction = machine.design.motion.bed_stroke, machine.fraction
    f, pinion = machine.bed_joints[5], machine.pinion
    middle = 0.5 * (float(f.real.min()) + float(f.real.max()))
    thick = 0.06 * stroke
    whole, now = (travel.rates(machine.here.motion, turn, 0)[0] for turn in (TURN * loop(721), machine.phi))
    moved = now - 0.5 * (float(whole.min()) + float(whole.max()))
    upper = middle + moved + 1j * (machine.slide + pinion + 0.5 * thick)
    lower = middle + machine.lift + 1j * (machine.slide - pinion - 0.5 * thick)
    turn = -(f.real - machine.lift) / pinion
    spoke = pinion * np.array([-1.0, 1.0, 0.0, 1j, -1j])
    words = "fixed rack" if machine.design.spec.cam is None else "rack moved by the cams"
    return [
        Line(points=f[[int(f.real.argmin()), int(f.real.argmax())]]),
        block(upper, 0.72 * stroke, thick, style.BLACK, "bed", fill=_BED),
        block(lower, 1.0 * stroke, thick, style.BLACK, words, fill=_RACK),
        wheel(f, pinion, fraction, color=style.BLUE, fill=pale(style.BLUE, 0.1)),
        Body(outline=spoke, place=f, turn=turn, color=style.BLUE),
    ]


def _cylinder(machine: Machine) -> list[Part]:
    """The cylinder on the bed; its gripper gap shows how it turns."""
    radius, axis = machine.design.cylinder.radius, machine.cylinder_axis
    turn = machine.here.turn("cylinder") - 0.5 * math.pi
    gap = radius * np.exp(1j * np.linspace(-0.35, 0.0, 9))
    outline = np.concatenate([[0.82 * gap[0]], gap, [0.82 * gap[-1], 0.82 * gap[0]]])
    shared = {"place": track(axis, machine.fraction), "turn": turn, "color": style.GREEN}
    return [
        Body(outline=circle(radius, 144), repeats=0, fill=pale(style.GREEN, 0.12), **shared, label="cylinder"),  # type: ignore[arg-type]
        Body(outline=outline, fill="#ffffff", **shared),  # type: ignore[arg-type]
    ]


def _driving_circles(machine: Machine) -> list[Part]:
    """Pitch circles of the gears from N to the cylinder."""
    axis, n = machine.cylinder_axis, complex(machine.cylinder_joints[3][0])
    driven = abs(axis - n) / (1.0 + machine.design.cylinder.gear_ratio)
    look: Any = {"turn": np.zeros_like(machine.fraction), "repeats": 0, "color": style.GREY, "width": 0.8}
    return [
        Body(outline=circle(radius, 120), place=track(center, machine.fraction), label=label, pitch=radius, **look)
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
    return [*gear(pair, 0, a, machine.phi, 1.0, style.GREY, "2"), *gear(pair, 1, g, turn, -1.0, style.GREY, "1")]


def _cam_bodies(machine: Machine) -> list[Part]:
    """The cams of the shaft D with the rollers of the rack, drawn beside it."""
    design = machine.design
    if design.spec.cam is None:
        return []
    axis = track(machine.cam_axis, machine.fraction)
    main, back = (
        disc_cam(cam, axis, machine.cam_angle, color)
        for cam, color in zip((design.main_cam, design.return_cam), panels.CAM_COLORS, strict=True)
    )
    parts: list[Part] = [back, replace(main, fill="")]
    places = design.cam_base_radius, design.cam_base_radius - design.roller_center_distance
    rollers = [axis + (place + machine.lift) for place in places]
    for center, color in zip(rollers, panels.CAM_COLORS, strict=True):
        parts.append(wheel(center, design.spec.cam.roller_radius, machine.fraction, color=color, fill=pale(color, 0.3)))
    parts.append(Chain(joints=(rollers[0], rollers[1]), color=style.GREY, width=1.5))
    parts.append(wheel(axis, 0.12 * design.cam_base_radius, machine.fraction, color=style.BLACK, fill="#ffffff"))
    return parts


def _cam_words(machine: Machine) -> tuple[Mark, ...]:
    design = machine.design
    if design.spec.cam is None:
        return ()
    below = machine.cam_axis - (1.0 + 1.4j) * design.max_radius
    return (Mark(track(below, machine.fraction), "cams on D"),)


POSITIONS = 12
HIGHLIGHTED = 2
BED, CYLINDER, LEAST = style.BLUE, style.GREEN, style.RED
_ROWS = 720
_SHAFT = 2.0 / 130.0
"""Width of a velocity arrow [inch]."""
_CAM_ROWS = 1440


def draw(command: str, design: FlatbedPress) -> Figure:
    """The figure of a command on a press."""
    if command == "cam":
        return _draw_cams(command, design)
    return _draw_parts(command, design) if command in ("gear", "crank") else _draw_motion(command, design)


def _draw_motion(command: str, design: FlatbedPress) -> Figure:
    """Both chains in twelve positions, the whole machine, displacement and velocity over the input angle."""
    made = panels.page(f"{design.spec.name}: {command}")
    rows: Any = made.add_gridspec(4, 1, height_ratios=(3.7, 3.5, 1.7, 1.9))
    bed_positions(made.add_subplot(rows[0]), design)
    middle: Any = rows[1].subgridspec(1, 2, width_ratios=(1.0, 1.6))
    cylinder_positions(made.add_subplot(middle[0]), design)
    machine(made.add_subplot(middle[1]), design)
    curves = [made.add_subplot(rows[2]), made.add_subplot(rows[3])]
    _curves(curves, design)
    return made


def machine(axes: Axes, design: FlatbedPress) -> None:
    """The whole press at an input angle of 60 deg, but for its cams."""
    style.drawing(axes)
    panels.heading(axes, f"Kinematic diagram at input angle {30 * HIGHLIGHTED}°")
    axes.set_xlabel("")
    scene_axes.draw(axes, build(design, np.array([HIGHLIGHTED / POSITIONS]), cams=False))


def _at_positions(design: FlatbedPress, chain: Any) -> Machine:
    """The press in twelve positions, and last where a chain has its minimum transmission angle."""
    fraction = np.append(np.arange(POSITIONS) / POSITIONS, least_transmission_input(chain) / TURN)
    return Machine(design, fraction, cams=design.bed_moves)


def bed_positions(axes: Axes, design: FlatbedPress) -> None:
    """A-B-C-D-E-F in twelve positions; the speeds of the bed in lanes below the slide line."""
    panels.drawing(axes, f"Bed drive in {POSITIONS} positions, 30° apart, to scale")
    at, linkage = _at_positions(design, design.bed), design.bed.linkage
    a, b, _, d, _, f = (joint[:-1] for joint in at.bed_joints)
    for center, radius in ((a, linkage.crank), (d, linkage.rocker), (d, design.bed.slider_crank_length)):
        style.circle(axes, complex(center[0]), radius, color=style.LIGHT, linewidth=0.8)
    axes.axhline(at.slide, color=style.GREY, linewidth=0.7, linestyle="-.", zorder=1)
    _overlay(axes, bed_chain(at.bed_joints), at, design.min_transmission_angle_bed)
    _numbers(axes, list(b), complex(a[0]), 0.16 * linkage.crank)
    velocity = LEVEL * at.velocity("carriage", "F")[:-1]
    _lanes(axes, list(f), 2.0 * design.input_speed * velocity.real, at.slide - 0.22 * design.bed.slider_crank_length)


def cylinder_positions(axes: Axes, design: FlatbedPress) -> None:
    """G-H-M-N in twelve positions, with the velocity of M."""
    panels.drawing(axes, "Cylinder drive")
    chain = design.cylinder
    at = _at_positions(design, chain)
    g, _, m, n = (joint[:-1] for joint in at.cylinder_links)
    for center, radius in ((g, chain.linkage.crank), (n, chain.linkage.rocker)):
        style.circle(axes, complex(center[0]), radius, color=style.LIGHT, linewidth=0.8)
    _overlay(axes, cylinder_chain(at.cylinder_links), at, design.min_transmission_angle_cylinder)
    velocity = UPRIGHT * at.velocity("MN", "M")[:-1] * design.input_speed
    tips = _arrows(axes, m, velocity, 0.75 * chain.linkage.rocker, "M", (0.86, 0.05))
    _numbers(axes, list(tips), complex(n[0]), 0.09 * chain.linkage.rocker)
    panels.legend_below(axes)


def _overlay(axes: Axes, scene: Scene, at: Machine, angle: float) -> None:
    """All positions thin, one strong with its letters, and the one of the minimum transmission angle dashed."""
    (links,) = scene.parts
    assert isinstance(links, Chain), "a chain alone"
    *thin, least = np.array(links.joints).T
    for chain in thin:
        axes.plot(chain.real, chain.imag, color=links.color, linewidth=0.6, alpha=0.55, zorder=2)
    look: Any = {"color": LEAST, "linewidth": 1.2, "linestyle": (0, (4, 2)), "zorder": 3}
    words = f"minimum transmission angle {math.degrees(angle):.5g}° (input {math.degrees(at.phi[-1]):.5g}°)"
    axes.plot(least.real, least.imag, **look, label=words)
    _angle_arc(axes, *(complex(point) for point in least[1:4]))
    scene_axes.draw(axes, scene, HIGHLIGHTED)
    words = f"position {HIGHLIGHTED} (input {30 * HIGHLIGHTED}°)"
    axes.plot([], [], color=links.color, linewidth=2.0, label=words)


def _angle_arc(axes: Axes, before: complex, joint: complex, after: complex) -> None:
    """The transmission angle at a joint, acute: between the link and the other or its prolongation."""
    one, other = before - joint, after - joint
    if (one * other.conjugate()).real < 0.0:
        one = -one
    radius = 0.32 * min(abs(one), abs(other))
    turn = np.angle(other / one) * np.linspace(0.0, 1.0, 25)
    arc = joint + radius * (one / abs(one)) * np.exp(1j * turn)
    axes.plot(arc.real, arc.imag, color=LEAST, linewidth=1.6, zorder=5)
    start = joint + 1.2 * radius * one / abs(one)
    axes.plot([joint.real, start.real], [joint.imag, start.imag], color=LEAST, linewidth=0.8, zorder=3)


def _numbers(axes: Axes, points: list[complex], center: complex, outwards: float) -> None:
    """Position numbers beside the points, away from a centre."""
    for number, point in enumerate(points):
        place = point + outwards * (point - center) / abs(point - center)
        axes.text(place.real, place.imag, str(number), fontsize=6.5, ha="center", va="center", zorder=7)


def _arrows(
    axes: Axes, start: Any, velocity: Any, longest: float, subject: str, place: tuple[float, float] = (0.86, 1.04)
) -> Any:
    """Velocity vectors to one scale, with a key of a round speed; their tips are returned."""
    top = float(np.abs(velocity).max())
    scale = top / longest
    drawn = velocity / scale
    # Inches are of the page: dots would make them thicker in PDF and thinner in a fine picture.
    look: Any = {"angles": "xy", "scale_units": "xy", "scale": 1.0, "units": "inches", "width": _SHAFT}
    look |= {"headwidth": 4.5, "headlength": 6.0, "headaxislength": 5.5, "color": style.ORANGE, "zorder": 5}
    quiver = axes.quiver(start.real, start.imag, drawn.real, drawn.imag, **look)
    tips = start + drawn
    axes.update_datalim(np.column_stack([tips.real, tips.imag]))
    speed = round_below(0.7 * top)
    words = f"{subject}: {speed:g} mm/s"
    key = axes.quiverkey(quiver, *place, speed / scale, words, labelpos="W", coordinates="axes")
    key.text.set_fontsize(8 if place[1] > 1.0 else 6.5)
    return tips


def _lanes(axes: Axes, points: list[complex], speed: Any, top: float) -> None:
    """Velocities of the bed, each in a lane of its own below its slider, for on the line they would hide each other."""
    stroke = max(p.real for p in points) - min(p.real for p in points)
    step = 0.062 * stroke
    start = np.array([complex(p.real, top - i * step) for i, p in enumerate(points)])
    for number, (point, lane) in enumerate(zip(points, start, strict=True)):
        axes.plot([point.real] * 2, [point.imag, lane.imag], color=style.GREY, linewidth=0.4, linestyle=":", zorder=1)
        axes.plot([point.real], [point.imag], "s", color=BED, markersize=3.0, zorder=5)
        side = -1.0 if speed[number] >= 0.0 else 1.0
        place = lane.real + side * 0.02 * stroke, lane.imag
        axes.text(*place, str(number), fontsize=6.5, ha="center", va="center", zorder=7)
    _arrows(axes, start, speed.astype(complex), 0.55 * stroke, "bed")
    panels.legend_below(axes, 2)


def _curves(axes: list[Axes], design: FlatbedPress) -> None:
    """Travel and speed over the input angle: the table `positions`, its twelve rows marked."""
    dense = design.table("positions", samples=_ROWS)
    twelve = design.table("positions", samples=POSITIONS)
    for each, what, ylabel in zip(axes, ("displacement", "velocity"), ("travel [mm]", "speed [mm/s]"), strict=True):
        panels.turn_panel(each, ylabel, "input angle [deg]" if what == "velocity" else "")
        for part, color, line in (("cylinder", CYLINDER, style.LONG), ("bed", BED, "-")):
            column = f"{part}_{what}"
            each.plot(dense.data[0], dense[column], color=color, linewidth=1.6, linestyle=line, label=part)
            each.plot(twelve.data[0], twelve[column], "o", color=color, markersize=3.0)
        if f"compensated_{what}" in dense.columns:
            with_cam: Any = {"color": BED, "linewidth": 1.1, "linestyle": style.DOTTED, "label": "bed with its cam"}
            each.plot(dense.data[0], dense[f"compensated_{what}"], **with_cam)
        each.axhline(0.0, color=style.GREY, linewidth=0.6)
    panels.heading(axes[0], "Travel of bed and cylinder")
    panels.heading(axes[1], "Speed")
    start, end = math.degrees(design.sync_start), math.degrees(design.sync_end)
    for each, label in zip(axes, (f"synchronous zone, {start:.4g}° to {end:.4g}°", None), strict=True):
        linkage.shade(each, linkage.DWELL, start, end - start, label)
    _equal_speeds(axes[1], design)
    _poor_transmission(axes[1], design)
    time_axes.over_input(axes[1], time_axes.turn_time(design))
    panels.legend_above(axes[0])
    panels.legend_above(axes[1])


def _poor_transmission(axes: Axes, design: FlatbedPress) -> None:
    """Where the minimum transmission angle of a chain falls below its limit."""
    limit = design.spec.limits.transmission_angle
    for chain in ("bed", "cylinder"):
        least, place = (math.degrees(design.raw(f"min_transmission_angle_{chain}{end}")) for end in ("", "_at"))
        if least < limit:
            failing.at(axes, place, f"{chain} drive: transmission angle {least:.4g}° at {place:.4g}°")


def _equal_speeds(axes: Axes, design: FlatbedPress) -> None:
    """The points at which bed and cylinder have the same speed."""
    from gearlink.core.machines.flatbed_press.zone import equal_speed_angles

    found = np.array(equal_speed_angles(design.bed, design.cylinder))
    if not found.size:
        return
    speed = design.cylinder.travel(found, 1).first * design.input_speed
    named = ", ".join(f"{angle:.1f}°" for angle in np.degrees(found[:6])) + (", …" if found.size > 6 else "")
    look: Any = {"color": "white", "markeredgecolor": style.RED, "markersize": 5}
    axes.plot(np.degrees(found), speed, "D", **look, label=f"equal: {named}")


# Cams


def _draw_cams(command: str, design: FlatbedPress) -> Figure:
    """Lift, velocity, acceleration, pressure angle, curvature over the cam angle; compensation; both cams."""
    made = panels.page(f"{design.spec.name}: {command}")
    rows: Any = made.add_gridspec(6, 1, height_ratios=(1.5, 1.05, 1.05, 1.05, 1.05, 4.2))
    curves = [made.add_subplot(rows[i]) for i in range(5)]
    _follower(curves[:3], design)
    cams = (design.main_cam, design.return_cam)
    panels.pressure_angles(curves[3], cams, design.spec.limits.pressure_angle, "")
    panels.curvatures(curves[4], cams, "cam angle [deg]")
    laws = design.follower.segments
    panels.shade(curves, [panels.Phase(law.phase, math.degrees(law.start), math.degrees(law.end)) for law in laws])
    _times(curves[4], design)
    below: Any = rows[5].subgridspec(1, 2, width_ratios=(1.55, 1.0))
    drawing = made.add_subplot(below[0])
    _cams(drawing, design)
    right: Any = below[1].subgridspec(2, 1, height_ratios=(1.5, 1.0))
    _compensation(made.add_subplot(right[0]), design)
    panels.legend_beside(made.add_subplot(right[1]), drawing)
    return made


def _times(axes: Axes, design: FlatbedPress) -> None:
    """The cam angle in time: its link turns unevenly."""
    degrees = np.arange(0.0, 361.0)
    inputs = np.unwrap(np.asarray(design.bed.input_angle(np.radians(degrees))))
    time_axes.in_uneven_ms(axes, degrees, 1e3 * (inputs - inputs[0]) / design.input_speed)


def _follower(axes: list[Axes], design: FlatbedPress) -> None:
    """The table `follower` and the steps that are left at its joints."""
    table = design.table("follower", samples=_CAM_ROWS)
    degrees = table.data[0]
    names = (("lift", "lift [mm]"), ("velocity", "velocity\n[mm/rad]"), ("acceleration", "acceleration\n[mm/rad²]"))
    for each, (name, ylabel) in zip(axes, names, strict=True):
        panels.turn_panel(each, ylabel)
        each.plot(degrees, table[name], color=style.BLUE, linewidth=1.6)
        each.axhline(0.0, color=style.GREY, linewidth=0.6)
    panels.heading(axes[0], "Motion of the follower over the cam angle")


def _compensation(axes: Axes, design: FlatbedPress) -> None:
    """Difference of bed and cylinder travel that the cam makes good in the zone, over the input angle."""
    phi = np.linspace(design.sync_start, design.sync_end, 241)
    gap = difference(design.bed, design.cylinder, phi).value
    title = f"Compensation: {design.compensation:.5g} mm"
    panels.curves(axes, "input angle [deg]", "bed less cylinder travel [mm]", title)
    axes.plot(np.degrees(phi), gap - gap[0], color=style.GREEN, linewidth=1.6)
    end = float(np.degrees(phi[-1]))
    axes.plot([end], [design.compensation], "o", color=style.GREEN, markersize=4.5)


def _cams(axes: Axes, design: FlatbedPress) -> None:
    """Both cams on their shaft at cam angle 0, with the line of the rollers."""
    panels.drawing(axes, "Main and return cam at cam angle 0, to scale")
    cams = (design.main_cam, design.return_cam)
    rollers = [
        panels.cam_outline(axes, cam, color, line=line)
        for cam, color, line in zip(cams, panels.CAM_COLORS, panels.CAM_LINES, strict=True)
    ]
    panels.base_circles(axes, cams)
    spec = design.cams.section
    panels.cam_shaft(axes, 0j, spec.shaft_radius)
    panels.cam_axis(axes, 0j, cams, 1, spec.shaft_radius)
    reach = 1.15 * spec.roller_radius
    left, right = rollers[1].real - reach, rollers[0].real + reach
    axes.plot([left, right], [0.0, 0.0], color=style.GREY, linewidth=0.8, linestyle="-.", zorder=2)
    words = f"roller distance {design.roller_center_distance:.6g} mm"
    axes.plot([rollers[1].real, rollers[0].real], [0.0, 0.0], " ", label=words)


# Parts that are designs of their own kind


def _draw_parts(command: str, design: FlatbedPress) -> Figure:
    """The pair of input gears, or D-E-F as a design of its own: its slider makes half the bed's stroke."""
    name, part = design.spec.name, design.slider_crank
    if command == "gear":
        return mesh_figure(f"{name}: {command}", [Mesh(design.gear_pair)])
    from gearlink.cli.views.figures import slider_crank
    from gearlink.core.machines.slider_crank.design import SliderCrankDesign
    from gearlink.core.machines.slider_crank.spec import SliderCrankSpec

    spec = SliderCrankSpec(kind="slider-crank", name=name, stroke=part.stroke, rod=part.rod, offset=part.offset)
    return slider_crank.draw(command, SliderCrankDesign(spec))
