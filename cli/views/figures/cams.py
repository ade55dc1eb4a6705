"""Scenes and pictures of cams: profile with pitch curve and follower, developed track or measured points, motion."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import failing, panels, scene_axes, style, time_axes
from gearlink.cli.views.figures.sheets.cam_sheets import away, edge_outline, follower_discs
from gearlink.cli.views.scenes import of_motion
from gearlink.cli.views.scenes.scene import TURN, Body, Chain, Mark, Part, Points, Reals, Scene, pale, track, wheel

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.cylindrical_cam import CylindricalCamDesign
    from gearlink.core.machines.disc_cam.design import DiscCamDesign
    from gearlink.core.machines.disc_cam.measured import MeasuredCamDesign
    from gearlink.core.parts.cams.disc_cam import DiscCam


_POINTS = 720


def disc_cam(cam: DiscCam, axis: Points, turn: Reals, color: str) -> Body:
    """A cam whose place at cam angle 0 is its own frame; `turn` counts counter-clockwise."""
    profile = cam.points(TURN * np.arange(_POINTS + 1) / _POINTS)[1]
    profile[-1] = profile[0]
    return Body(outline=profile, place=axis, turn=turn, color=color, fill=pale(color), name=cam.name)


_CLOSE = np.linspace(0.0, TURN, 721)
_STEM = 0.8
"""Of the prime radius: how far the rod of a slide is drawn."""
_REACH = 1.15
"""Of the places of contact: how far a flat face is drawn that the file does not bound."""


def build(design: DiscCamDesign, fraction: Reals) -> Scene:
    """Positions over fractions of a revolution of the cam."""
    scene = of_motion.build(design, fraction)
    links = [part for part in scene.parts if getattr(part, "name", "") != "main"]  # the contact is no slot
    if not (design.spec.oscillates or design.spec.rolls):
        links = [_on_rod(design, part) if isinstance(part, Body) else part for part in links]
    return replace(scene, parts=(*_cams(design, fraction), *links, *_followers(design, fraction)))


def _cams(design: DiscCamDesign, fraction: Reals) -> list[Part]:
    cams, turn = design.cams, design.spec.cam.sense * TURN * fraction
    axis = track(0j, fraction)
    if design.spec.is_flat:
        outline = cams.flat.points(_CLOSE)[0]
        return [Body(outline=outline, place=axis, turn=turn, color=style.BLUE, fill=pale(style.BLUE, 0.15), width=1.6)]
    walls: list[tuple[DiscCam | None, str]] = [(cams.main, style.BLUE), (cams.back, style.ORANGE)]
    if design.spec.closure == "groove":  # its inner wall on the outer one
        walls = [(cams.outer_wall, style.ORANGE), (cams.main, style.BLUE)]
    return [disc_cam(cam, axis, turn, color) for cam, color in walls if cam is not None]


def _followers(design: DiscCamDesign, fraction: Reals) -> list[Part]:
    cams, phi = design.cams, TURN * fraction
    if design.spec.is_flat:
        return _face(design, phi)
    front = cams.main.path(phi, 1).position
    if design.spec.is_edge:
        outline, off = edge_outline(cams.main), away(cams.main, phi)
        edge = Body(outline=outline, place=front, turn=np.angle(off), color=style.BLUE, fill=pale(style.BLUE, 0.3))
        return [*_stem(design, front + outline[1].real * off), edge]
    found: list[Part] = [*_stem(design, front)]
    if cams.back is not None:
        held = track(cams.pivot, fraction) if design.spec.oscillates else front
        found.append(Chain(joints=(held, cams.back.path(phi, 1).position), marked=False))
    for cam, color in ((cams.main, style.BLUE), (cams.back, style.ORANGE)):
        if cam is not None:
            center = cam.path(phi, 1).position
            found.append(wheel(center, cam.roller_radius, fraction, color=color, fill=pale(color, 0.3)))
    return found


def _face(design: DiscCamDesign, phi: Reals) -> list[Part]:
    """A flat face as far as the cam touches it, on the rod of a slide or on the arm of a rocker."""
    cams = design.cams
    touch, (low, high) = cams.flat.touch(phi), cams.flat.contact_places
    along = -1j * touch.normal
    if design.spec.oscillates:  # places count from the pivot, along the arm
        along = np.exp(1j * cams.arm_angle(cams.place, phi, 0)[0])
    foot = touch.point - touch.place * along
    if design.spec.oscillates:
        pivot = track(cams.pivot, phi)
        return [Chain(joints=(pivot, foot, foot + _REACH * high * along), marked=False)]
    beyond = (_REACH - 1.0) * max(abs(low), abs(high))
    ends = foot + (low - beyond) * along, foot + (high + beyond) * along
    return [Chain(joints=ends, color=style.GREY, marked=False), *_stem(design, foot)]


def _stem(design: DiscCamDesign, start: Points) -> list[Part]:
    """The rod of a follower that slides, from its roller or face on."""
    if design.spec.oscillates:
        return []
    return [Chain(joints=(start, start + _STEM * design.cams.place.radius * design.cams.direction), marked=False)]


def _on_rod(design: DiscCamDesign, block: Body) -> Body:
    """The block of the guide on the middle of the rod, where no cam is: a face or an edge has its origin on the cam."""
    return replace(block, place=block.place + 0.5 * _STEM * design.cams.place.radius * design.cams.direction)


_DRUM_STEM = 3.0
"""Radii of the roller that the follower's rod is drawn."""


def build_cylindrical(design: CylindricalCamDesign, fraction: Reals) -> Scene:
    """Positions over fractions of a turn of the cam; the track is drawn over three turns, so that it never ends."""
    scene, drum = of_motion.build(design, fraction), design.drum
    phi = np.linspace(-TURN, 2.0 * TURN, 1081)
    upper, lower = (
        -drum.sense * arc + 1j * along for arc, along in (drum.developed(drum.bottom, s, phi) for s in (1, -1))
    )
    outline = np.concatenate((upper, lower[::-1], upper[:1]))
    # after a turn the track stands where it stood, and a loop ends as it began
    place = drum.sense * drum.bottom * TURN * np.mod(np.asarray(fraction), 1.0) + 0j
    level, center = np.zeros_like(fraction), 1j * design.follower_motion.evaluate(TURN * fraction, 0)[0]
    parts = (
        Body(outline=outline, place=place, turn=level, color=style.BLUE, fill=pale(style.BLUE, 0.15), width=1.4),
        wheel(center, drum.roller_radius, fraction, color=style.ORANGE, fill=pale(style.ORANGE, 0.3)),
        Chain(joints=(center, center + _DRUM_STEM * 1j * drum.roller_radius), marked=False),
    )
    return replace(scene, parts=parts, marks=(Mark(center),))


_LABELS = ("lift", "velocity", "acceleration", "jerk")
_COLORS = (style.BLUE, style.GREEN, style.ORANGE, style.PURPLE)
_SHOWN = 0.125


def draw_disc(command: str, design: DiscCamDesign) -> Figure:
    """The picture of a command on a disc cam."""
    flat = design.spec.is_flat
    made, (outline, *rows) = panels.stack(f"{design.spec.name}: {command}", (3.2, *(4 if flat else 5) * (1.0,)))
    panels.drawing(outline, "Cam and follower an eighth of a revolution after cam angle 0")
    scene = build(design, np.array([_SHOWN]))
    driven = 0j, design.spec.cam.sense * TURN * scene_axes.AHEAD
    scene_axes.draw(outline, scene, ahead=build(design, np.array([_SHOWN + scene_axes.AHEAD])), driven=driven)
    phi = np.linspace(0.0, TURN, 1441)
    rates = design.cams.motion.evaluate(phi, 3)
    rates[:] = [np.where(phi == phi[-1], design.cams.motion.evaluate(phi, 3, side=-1)[n], rates[n]) for n in range(4)]
    _motion(rows, phi, rates, "rad" if design.spec.oscillates else "mm")
    if design.spec.rolls:
        _pitch_curves(outline, design)
    else:
        _too_sharp(outline, design)
    if not flat:
        _pressure(rows[-1], design)
    time_axes.over_input(rows[-1], time_axes.turn_time(design))
    return made


def _too_sharp(axes: Axes, design: DiscCamDesign) -> None:
    """In red, where a profile under a flat face or an edge is more sharply curved than its limit."""
    cams, limit = design.cams, design.spec.limits.curvature_radius
    if design.spec.is_flat:
        profile, lost = cams.flat.points(_CLOSE)[0], cams.flat.touch(_CLOSE).radius < limit
    else:
        profile, lost = cams.main.points(_CLOSE)[1], limit * cams.main.curvature(_CLOSE) > 1.0
    if lost.any():
        where = profile * np.exp(1j * design.spec.cam.sense * TURN * _SHOWN)
        failing.past(axes, where.real, where.imag, lost, "radius below its limit")
        panels.legend_above(axes, 1)


def _pitch_curves(axes: Axes, design: DiscCamDesign) -> None:
    """Pitch curves where the cams are drawn, and in red where the roller cuts into a profile."""
    turned = np.exp(1j * design.spec.cam.sense * TURN * _SHOWN)
    label = "pitch curve"
    for cam in follower_discs(design):
        pitch, profile = (points * turned for points in cam.points(_CLOSE))
        look: Any = {"color": style.GREY, "linewidth": 0.9, "linestyle": style.CHAIN, "gid": "pitch curve"}
        axes.plot(pitch.real, pitch.imag, label=label, zorder=3.0, **look)
        panels.cut(axes, cam, profile)
        label = "_"
    panels.legend_above(axes, 4)


def _pressure(axes: Axes, design: DiscCamDesign) -> None:
    """Pressure angle of each cam with the limits of rise and return, above which it is red."""
    rise, back = design.spec.pressure_limits()
    panels.pressure_angles(axes, follower_discs(design), max(rise, back), "cam angle [deg]")
    if rise == back:
        return
    speed = design.cams.motion.evaluate(_CLOSE, 1)[1]
    lesser, stroke, words = (rise, speed > 0.0, "rise") if rise < back else (back, speed < 0.0, "return")
    for cam in follower_discs(design):
        values = np.degrees(cam.pressure_angle(_CLOSE))
        failing.past(axes, np.degrees(_CLOSE), values, stroke & (np.abs(values) > lesser), "above the limit")
    for sign, label in ((1.0, f"{words} ±{lesser:g}°"), (-1.0, "_")):
        axes.axhline(sign * lesser, color=style.GREY, linewidth=0.9, linestyle=style.DASHED, label=label)
    panels.legend_above(axes, 4)


def draw_cylindrical(command: str, design: CylindricalCamDesign) -> Figure:
    """The picture of a command on a cylindrical cam: the track developed at its bottom, motion and pressure angle."""
    made, (track, *rows) = panels.stack(f"{design.spec.name}: {command}", (1.8, *5 * (1.0,)))
    phi, drum = np.linspace(0.0, TURN * (1.0 - 1e-9), 1441), design.drum
    panels.drawing(track, f"Track developed at its bottom, radius {drum.bottom:.6g} mm")
    for side, color, width in ((0, style.GREY, 0.9), (1, style.BLUE, 1.6), (-1, style.BLUE, 1.6)):
        track.plot(*drum.developed(drum.bottom, side, phi), color=color, linewidth=width)
    _motion(rows, phi, design.follower_motion.evaluate(phi, 3), "mm")
    _pressure_in_track(rows[-1], design, phi)
    time_axes.over_input(rows[-1], time_axes.turn_time(design))
    return made


def _pressure_in_track(axes: Axes, design: CylindricalCamDesign, phi: Any) -> None:
    """Pressure angle at the bottom of the track, red above its limit, and at the outside."""
    drum, limit, degrees = design.drum, design.spec.limits.pressure_angle, np.degrees(phi)
    panels.turn_panel(axes, "pressure\nangle [deg]", "cam angle [deg]", "Pressure angle")
    bottom, outside = (np.degrees(drum.pressure_angle(x, phi)) for x in (drum.bottom, drum.outside))
    place, worst = math.degrees(design.steepest.place), math.degrees(design.max_pressure_angle)
    label = f"bottom, ≤ {worst:.4g}° at {place:.4g}°"
    axes.plot(degrees, bottom, color=style.BLUE, linewidth=1.5, label=label)
    label = f"outside, ≤ {math.degrees(design.pressure_angle_outside):.4g}°"
    axes.plot(degrees, outside, color=style.ORANGE, linewidth=1.2, linestyle=style.DASHED, label=label)
    failing.past(axes, degrees, bottom, np.abs(bottom) > limit, "above the limit")
    for sign, label in ((1.0, f"limit ±{limit:g}°"), (-1.0, "_")):
        axes.axhline(sign * limit, color=style.BLACK, linewidth=0.9, linestyle=(0, (5, 3)), label=label)
    panels.legend_above(axes, 4)


def _motion(rows: list[Axes], phi: Any, rates: Any, unit: str) -> None:
    """Lift and its derivatives over the cam angle."""
    for order, (axes, label, color) in enumerate(zip(rows[:4], _LABELS, _COLORS, strict=True)):
        over = "cam angle [deg]" if axes is rows[-1] else ""
        panels.turn_panel(axes, f"{label}\n[{panels.per_input(unit, order)}]", over)
        values = np.degrees(rates[order]) if unit == "rad" and order == 0 else rates[order]
        axes.plot(np.degrees(phi), values, color=color, linewidth=1.6)


def draw_measured(command: str, design: MeasuredCamDesign) -> Figure:
    """The picture of a command."""
    made, (shape, *rows) = panels.stack(f"{design.spec.name}: {command}", (2.6, 1.0, 1.0, 1.0))
    t = np.linspace(0.0, TURN, 1441)
    panels.drawing(shape, f"Profile through {len(design.residuals)} points, deviation {design.fit_max:.3g} mm at most")
    pitch = design.cam.contact(t).center
    radius = design.cam.series.at(t, 0)[0]
    angle, measured = design.points
    shape.plot(radius * np.cos(t), radius * np.sin(t), color=style.BLUE, linewidth=1.6, label="profile")
    shape.plot(pitch.real, pitch.imag, color=style.GREY, linewidth=0.9, linestyle=style.CHAIN, label="pitch curve")
    points = measured * np.exp(1j * angle)
    shape.plot(points.real, points.imag, ".", color=style.ORANGE, markersize=3.0, label="points")
    style.pivot(shape, 0j)
    panels.legend_below(shape, 3)
    table = design.table("law", samples=1440)
    for axes, name, color in zip(rows, (table.columns[1], "velocity", "acceleration"), _COLORS, strict=False):
        unit = table.units[table.columns.index(name)].replace("^2", "²")
        over = "cam angle [deg]" if axes is rows[-1] else ""
        panels.turn_panel(axes, f"{name.replace('_', ' ')} [{unit}]", over)
        axes.plot(table["cam_angle"], table[name], color=color, linewidth=1.6)
    _shade(rows, design)
    time_axes.over_input(rows[-1], time_axes.turn_time(design))
    return made


def _shade(rows: list[Axes], design: MeasuredCamDesign) -> None:
    """Shade the phases behind the motion, those that run over the end of the turn in two parts."""
    found = []
    for each in design.phases:
        start, end = math.degrees(each.start), math.degrees(each.end)
        name = each.motion
        found += [panels.Phase(name, max(start + off, 0.0), min(end + off, 360.0)) for off in (-360.0, 0.0, 360.0)]
    panels.shade(rows, [phase for phase in found if phase.end > phase.start])
