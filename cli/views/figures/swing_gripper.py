"""Scene and figures of a swing gripper: law, torques, mechanism; cams with rollers, pressure angle, curvature.

The scene is one revolution of the cylinder shaft, a sheet.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.cams import disc_cam
from gearlink.cli.views.figures.drawing import failing, panels, scene_axes, style, time_axes
from gearlink.cli.views.scenes.of_motion import Positions, Seen
from gearlink.cli.views.scenes.scene import (
    PHASE_TINTS,
    TURN,
    Body,
    Chain,
    Line,
    Mark,
    Part,
    Reals,
    Scene,
    bands,
    circle,
    letters,
    pale,
    track,
    wheel,
)
from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.swing_gripper.design import SwingGripper, drum_axis
from gearlink.core.machines.swing_gripper.mechanism import without_cams

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def build(design: SwingGripper, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    motion = without_cams(design)
    here, swing = Positions(motion, TURN * fraction), motion.outputs[0]
    path = Positions(motion, np.radians(np.linspace(0.0, design.law.starts[3], 121))).at("output", "F")
    (a, c, d, e), f = (mark.point for mark in here.marks), here.at("output", "F")
    arm = here.now.links["output"].points
    plate = np.array([0.0, arm["D"], arm["F"], 0.0])
    value, rate = swing.course.rates(motion, here.inputs, 1)
    return here.scene(
        (
            Line(points=path, color=style.ORANGE, width=2.0, name="path of the sheet's edge"),
            *_drum(design, fraction),
            *_cam_bodies(design, here),
            *_finger_parts(design, here),
            *_stop(design, fraction),
            here.body("output", plate, style.BLACK, 0.12, width=0.5),
            Chain(joints=(a, c, d, e), color=style.BLUE),
            Chain(joints=(d, e, f)),
        ),
        {"gripper": Seen(swing.course, style.BLUE)},
        "swing of the gripper [deg]",
        over="cylinder angle",
        marked=bands((phase.name, phase.start, phase.end, PHASE_TINTS[phase.name]) for phase in phases(design)),
        marks=(*letters("AE", A=a, C=c, D=d, E=e, F=f), Mark(track(drum_axis(design), fraction), pivot=True)),
        values={
            "swing": ("°", np.degrees(value)),
            "speed of the tip": (" mm/s", rate * design.shaft_speed * design.spec.arm.length),
        },
    )


def _drum(design: SwingGripper, fraction: Reals) -> list[Part]:
    """The drum that takes the sheet over, with its grippers where the tip meets them at the handover."""
    spec = design.spec
    center = drum_axis(design)
    handover = Positions(without_cams(design), np.radians([design.motion.handover]))
    meeting = complex(handover.at("output", "F")[0])
    radius = spec.cylinder.radius
    way = (meeting - center) / abs(meeting - center)
    turn = -spec.swing_sense * (TURN * fraction - math.radians(design.motion.handover))
    pad = radius * way * np.array([0.86, 1.0])
    shared: Any = {"place": track(center, fraction), "turn": turn}
    look: Any = {"color": style.GREY, "fill": pale(style.GREY, 0.1), "repeats": 0, "label": "cylinder"}
    drum = Body(outline=circle(radius, 144), name=f"feed drum, radius {radius:g} mm", **look, **shared)
    return [drum, Body(outline=pad, width=5.0, color=style.RED, **shared)]


def _cam_bodies(design: SwingGripper, here: Positions) -> list[Part]:
    """Cams on the shaft, rollers on the rocker; none where the cams cannot be."""
    spec = design.spec.cam
    if spec is None or not design.cams.stand:
        return []
    axis, pivot, turned = track(design.cam_center, here.inputs), here.at("input"), here.inputs
    rollers = [(spec.roller, spec.roller.angle)]
    if spec.return_roller is not None:
        rollers.append((spec.return_roller, spec.roller.angle + spec.return_roller.angle))
    cams = zip(design.cams.discs, panels.CAM_COLORS, strict=False)
    parts: list[Part] = [disc_cam(cam, axis, spec.sense * turned, color) for cam, color in cams]
    for (roller, angle), color in zip(rollers, panels.CAM_COLORS, strict=False):
        center = here.at("input", cmath.rect(roller.arm, math.radians(angle)))
        parts.append(Chain(joints=(pivot, center), color=style.BLUE, marked=False))
        parts.append(wheel(center, roller.radius, turned, color=color, fill=pale(color, 0.3)))
    parts.append(wheel(axis, max(spec.shaft_radius, 1e-3), turned, color=style.BLACK, fill="#ffffff"))
    return parts


def _finger_parts(design: SwingGripper, here: Positions) -> list[Part]:
    """The cam of the fingers about E, which turns with the cylinder, and its roller on the lever of the arm."""
    spec, section = design.spec, design.spec.fingers
    if section is None:
        return []
    cam_turn = math.radians(spec.arm.direction) - spec.swing_sense * here.inputs
    try:
        cam = disc_cam(design.fingers.cam, here.at("output"), cam_turn, style.PURPLE)
    except NoSolution:  # the arm returns as fast as it turns
        return []
    tip = here.now.links["output"].points["F"]
    along = tip / abs(tip)
    opened = design.fingers.opening(np.degrees(here.inputs), 0)[0]
    lever = section.lever * along * np.exp(1j * (math.radians(section.angle) + opened + here.turn("output")))
    pivot = here.at("output", section.pivot * along)
    roller = wheel(pivot + lever, section.roller_radius, here.inputs, color=style.PURPLE, fill=pale(style.PURPLE, 0.3))
    return [cam, Chain(joints=(pivot, pivot + lever), color=style.PURPLE, marked=False), roller]


def _stop(design: SwingGripper, fraction: Reals) -> list[Part]:
    """The stop beside the arm at the pick-up position, where the arm comes back to it."""
    spec, section = design.spec, design.spec.stop
    if section is None:
        return []
    along = cmath.rect(1.0, math.radians(spec.arm.direction))
    size = _STOP_SIZE * spec.arm.length
    corners = np.array([-0.5, 0.5, 0.5 - 1j * spec.swing_sense, -0.5 - 1j * spec.swing_sense, -0.5])
    place = track(complex(design.linkage.output_pivot) + section.radius * along, fraction)
    look: Any = {"color": style.BLACK, "fill": pale(style.GREY, 0.6), "name": "stop"}
    return [Body(outline=size * along * corners, place=place, turn=np.zeros_like(fraction), **look)]


_STOP_SIZE = 0.06
"""Of the arm's length."""
_ROWS = 1440
_HANDOVER = style.RED


def draw(command: str, design: SwingGripper) -> Figure:
    """The figure of a command on a swing gripper."""
    return _draw_cams(command, design) if command == "cam" else _draw_motion(command, design)


def _draw_motion(command: str, design: SwingGripper) -> Figure:
    """Swing, its derivatives and the mechanism; torques where there are cams, inertia and spring."""
    forces = design.closure.stands
    heights = [1.3, 1.1, 1.1, 1.7, 5.3] if forces else [1.3, 1.1, 1.1, 5.3]
    made = panels.page(f"{design.spec.name}: {command}", (sum(heights) + 1.6) / 12.1)
    rows: Any = made.add_gridspec(len(heights), 1, height_ratios=heights)
    curves = [made.add_subplot(rows[i]) for i in range(len(heights) - 1)]
    _law(curves[:3], design)
    if forces:
        _torques(curves[3], design)
    panels.shade(curves, phases(design))
    curves[-1].set_xlabel("cylinder angle [deg]", fontsize=8.5)
    curves[-1].tick_params(labelbottom=True)
    time_axes.over_input(curves[-1], time_axes.turn_time(design))
    below: Any = rows[len(heights) - 1].subgridspec(1, 2, width_ratios=(3.2, 1.0))
    drawing = made.add_subplot(below[0])
    mechanism(drawing, design)
    panels.legend_beside(made.add_subplot(below[1]), drawing)
    return made


def phases(design: SwingGripper) -> tuple[panels.Phase, ...]:
    """The six phases of the law."""
    return panels.phases_of(without_cams(design).outputs[0])


def _law(axes: list[Axes], design: SwingGripper) -> None:
    """beta, beta', beta'' over the cylinder angle, the handover marked; the derivatives in time on the right."""
    degrees = np.arange(_ROWS) * (360.0 / _ROWS)
    values = list(design.law.evaluate(degrees, 2))
    at_handover = [float(v[0]) for v in design.law.evaluate(np.array([design.motion.handover]), 2)]
    values[0], at_handover[0] = np.degrees(values[0]), math.degrees(at_handover[0])
    labels = ("β [deg]", "β′ = dβ/dθ [1]", "β″ = d²β/dθ² [1]")
    for each, curve, mark, label in zip(axes, values, at_handover, labels, strict=True):
        panels.turn_panel(each, label)
        each.plot(degrees, curve, color=style.BLUE, linewidth=1.6)
        each.axhline(0.0, color=style.GREY, linewidth=0.6)
        each.axvline(design.motion.handover, color=_HANDOVER, linewidth=0.9, linestyle="--")
        each.plot([design.motion.handover], [mark], "o", color=_HANDOVER, markersize=4.5)
    time_axes.in_time(axes[1], design.shaft_speed, 1, "rad")
    time_axes.in_time(axes[2], design.shaft_speed, 2, "rad")
    handover = f"handover (dashed) at {design.motion.handover:g}°, {design.handover_speed:.6g} mm/s"
    panels.heading(axes[0], f"Swing β of the gripper arm; {handover}")


def _torques(axes: Axes, design: SwingGripper) -> None:
    """Contact torques of both rollers: spring and inertia; what is left above zero keeps them on their cams."""
    column, spring = design.table("forces", samples=_ROWS), design.spec.spring
    assert spring is not None, "drawn only where the file has a spring"
    panels.turn_panel(axes, "torque [N m]")
    axes.plot(column["theta"], column["inertia_torque"], color=style.GREEN, linewidth=1.2, label="inertia")
    for name, color, line in zip(("main", "return"), panels.CAM_COLORS, panels.CAM_LINES, strict=True):
        if f"contact_torque_{name}" not in column.columns:
            continue
        values = column[f"contact_torque_{name}"]
        least = int(values.argmin())
        words = f"{name} roller, ≥ {style.number(values[least], 4)} N m"
        axes.plot(column["theta"], values, color=color, linewidth=1.6, linestyle=line, label=words)
        axes.plot([column["theta"][least]], [values[least]], "o", color=color, markersize=4.5)
        failing.past(axes, column["theta"], values, values < spring.reserve, "lifts off")
    closing = design.closing_torque
    axes.axhline(closing, color=style.BLACK, linewidth=0.9, linestyle="--", label=f"spring {closing:.5g} N m")
    least_label = f"minimum required {spring.reserve:g} N m"
    axes.axhline(spring.reserve, color=_HANDOVER, linewidth=1.0, linestyle=":", label=least_label)
    axes.axhspan(min(0.0, axes.get_ylim()[0]), spring.reserve, color=_HANDOVER, alpha=0.07, linewidth=0)
    speed = design.lift_off_speed
    lifted = "never lifts off" if speed is None else f"lifts off at {speed:.6g} sheets/h"
    panels.heading(axes, f"Torques on the cam rockers; a roller {lifted}")
    panels.legend_above(axes)


def mechanism(axes: Axes, design: SwingGripper) -> None:
    """Machine at the pick-up position; its linkage and gripper lightly at handover and far dwell, line of centres."""
    panels.drawing(axes, "Mechanism at the pick-up position, to scale")
    far = design.law.starts[3]
    stations = (
        ("pick-up", 0.0, style.BLUE, "-"),
        ("handover", design.motion.handover, _HANDOVER, style.DASHED),
        ("far dwell", far, style.GREEN, style.DOTTED),
    )
    scene = build(design, np.array([degrees for _, degrees, _, _ in stations]) / 360.0)
    scene_axes.draw(axes, scene)
    linkage = replace(scene, parts=tuple(part for part in scene.parts if isinstance(part, Chain)))
    for i, (name, degrees, color, line) in enumerate(stations):
        scene_axes.lightly(axes, linkage, i, color, f"{name}, {degrees:g}°", line=line)
    e, drum = complex(design.linkage.output_pivot), drum_axis(design)
    axes.plot([e.real, drum.real], [e.imag, drum.imag], color=style.GREY, linewidth=0.7, linestyle="-.", zorder=3)
    if design.spec.cam is not None and design.cams.stand:
        panels.cam_axis(axes, design.cam_center, design.cams.discs, design.spec.cam.sense, design.spec.cam.shaft_radius)


# Cams


def _draw_cams(command: str, design: SwingGripper) -> Figure:
    """Rocker, pressure angle and curvature over the cam angle; below them the cams to scale."""
    cams = design.cams.discs
    made = panels.page(f"{design.spec.name}: {command}")
    rows: Any = made.add_gridspec(4, 1, height_ratios=(1.2, 1.3, 1.3, 5.2))
    curves = [made.add_subplot(rows[i]) for i in range(3)]
    table = design.table("motion", samples=1440)
    panels.turn_panel(curves[0], "rocker\nangle [deg]")
    curves[0].plot(table.data[0], table["input_angle"], color=style.BLUE, linewidth=1.6)
    panels.heading(curves[0], "Cam rocker AC over the cam angle")
    panels.pressure_angles(curves[1], cams, design.spec.limits.pressure_angle, "")
    _accelerating(curves[1], design)
    panels.curvatures(curves[2], cams, "cam angle [deg]")
    panels.shade(curves, phases(design))
    time_axes.over_input(curves[2], time_axes.turn_time(design))
    below: Any = rows[3].subgridspec(1, 2, width_ratios=(3.0, 1.0 if design.spec.fingers is None else 1.3))
    drawing = made.add_subplot(below[0])
    _cams(drawing, design)
    legend: Any = below[1]
    if design.spec.fingers is not None:
        beside: Any = below[1].subgridspec(2, 1)
        _fingers(made.add_subplot(beside[0]), design)
        legend = beside[1]
    panels.legend_beside(made.add_subplot(legend), drawing)
    return made


def _fingers(axes: Axes, design: SwingGripper) -> None:
    """The cam of the fingers about E, the arm along +x, its roller on the lever with the fingers closed."""
    cam, section = design.fingers.cam, design.fingers.section
    panels.drawing(axes, "Finger cam")
    panels.cam_outline(axes, cam, style.PURPLE, 0j, "-")
    roller = complex(cam.path(np.zeros(1), 1).position[0])
    style.circle(axes, roller, section.roller_radius, color=style.PURPLE, linewidth=1.2)
    for joints in ((0j, complex(section.pivot)), (complex(section.pivot), roller)):
        axes.plot([each.real for each in joints], [each.imag for each in joints], color=style.GREY, linewidth=1.6)
    style.pivot(axes, 0j)


def _accelerating(axes: Axes, design: SwingGripper) -> None:
    """The lower limit of the phase accelerate, which only warns."""
    limit, end = design.spec.limits.accelerate_pressure_angle, design.law.starts[1]
    for sign, label in ((1.0, f"accelerate ±{limit:g}°"), (-1.0, "_")):
        axes.plot([0.0, end], [sign * limit] * 2, color=style.BLACK, linewidth=0.9, linestyle=":", label=label)
    panels.legend_above(axes)


def _cams(axes: Axes, design: SwingGripper) -> None:
    """The cams about their axis at cam angle 0, the rollers on the rocker, the shaft."""
    spec, linkage = design.spec.cam, design.linkage
    assert spec is not None, "the cams have requested it"
    panels.drawing(axes, "Cams at cam angle 0, to scale")
    axis, pivot = design.cam_center, np.array([linkage.input_pivot])
    for cam, color, line in zip(design.cams.discs, panels.CAM_COLORS, panels.CAM_LINES, strict=False):
        panels.cam_outline(axes, cam, color, axis, line)
    scene = build(design, np.zeros(1))
    rocker = [part for part in scene.parts if isinstance(part, Chain) and not part.marked]
    c = next(mark.point for mark in scene.marks if mark.text == "C")
    arm = Chain(joints=(pivot, c), color=style.GREY)
    scene_axes.draw(axes, Scene(parts=(*rocker, arm), marks=letters("A", A=pivot, C=c)))
    panels.base_circles(axes, design.cams.discs, axis)
    panels.cam_shaft(axes, axis, spec.shaft_radius)
    panels.cam_axis(axes, axis, design.cams.discs, spec.sense, spec.shaft_radius)
