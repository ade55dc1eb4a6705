"""A wide-swing mechanism: its scene, and its figures with law of motion, cams, pressure angle and balancing."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import failing, panels, scene_axes, style, time_axes
from gearlink.cli.views.scenes.of_motion import Frame, Positions
from gearlink.cli.views.scenes.scene import (
    TURN,
    Body,
    Chain,
    Chart,
    Curve,
    Mark,
    Part,
    Points,
    Readout,
    Reals,
    Scene,
    block,
    circle,
    loop,
    pale,
    track,
    wheel,
)
from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.mechanism import slider_way

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.wide_swing.cycle import ClosedCam, WholeCycle
    from gearlink.core.machines.wide_swing.design import WideSwingDesign
    from gearlink.core.machines.wide_swing.strokes import AnyCam


_ROW: dict[str, Any] = {"loc": "center", "ncols": 4, "fontsize": 7.5, "columnspacing": 1.4, "handlelength": 2.0}
_BESIDE: dict[str, Any] = {"loc": "center left", "handlelength": 2.0, "borderaxespad": 0.5}
"""Legends in a panel of their own: a row below drawings, and beside or below one of them."""
ZONE = "#F7D9A8"


def cams_of(design: WideSwingDesign) -> list[tuple[str, AnyCam, float]]:
    """The cams to be drawn: title, cam, and -1 where the mirror image serves the return stroke."""
    working = "Cam of the working stroke"
    if design.spec.drive is not None:
        return [("Oscillating cam", design.cam, 1.0)]
    if design.spec.slider is not None:
        return [("Cam of both strokes, reversing in the return", design.cam, 1.0)]
    if design.return_cam is None:
        return [(working, design.cam, 1.0), ("Cam of the return stroke (mirror image)", design.cam, -1.0)]
    if design.spec.layout != "twin-rocker":
        return [(working, design.cam, 1.0), ("Cam of the return stroke", design.return_cam, -1.0)]
    external = "External profile, return stroke", design.return_cam, 1.0
    return [("Internal profile, working stroke", design.cam, 1.0), external]


def _title(command: str, design: WideSwingDesign) -> str:
    """Which of the mechanisms it is, and its swing."""
    layout = design.spec.layout if design.spec.drive is None else "oscillating cam"
    return f"{design.spec.name}: {command} ({layout}, {design.spec.swing:g}° swing)"


def has_slots(design: WideSwingDesign) -> bool:
    """Whether every cam can be drawn: no loop, and a roller that leaves a profile."""
    try:
        for _, cam, _ in cams_of(design):
            design.slot_of(cam)
    except NoSolution:
        return False
    return True


def _whole_cam(axes: Axes, design: WideSwingDesign, title: str, cam: AnyCam, mirror: float) -> None:
    """A cam, and in the corner how much of the stroke the change of flanks takes."""
    cam_panel(axes, design, title, cam, mirror)
    words = f"changes flank within ±{100.0 * cam.transition_zone:.3g} % of the stroke"
    look: dict[str, Any] = {"ha": "center", "va": "bottom", "fontsize": 7.5, "zorder": 8}
    axes.text(0.5, 0.02, words, transform=axes.transAxes, path_effects=style.outlined(), **look)


def cam_panel(axes: Axes, design: WideSwingDesign, title: str, cam: AnyCam, mirror: float) -> None:
    """A cam at rest, to scale: contour, pitch curve, transition zone, shaft, and the rocker carried round it."""
    panels.drawing(axes, title)
    _body(axes, design, cam, mirror)
    _pitch(axes, cam, mirror)
    _rockers(axes, cam, mirror)
    _shaft(axes, design)


def _shaft(axes: Axes, design: WideSwingDesign) -> None:
    """The shaft in the middle of a cam, and its axis."""
    if (radius := design.section.shaft_radius) > 0.0:
        style.circle(axes, 0j, radius, color=style.BLACK, linewidth=1.2, hatch="////", zorder=4)
    axes.plot([0.0], [0.0], "+", color=style.BLACK, markersize=10, zorder=6, label="cam axis")


def _xy(points: Any, mirror: float = 1.0) -> tuple[Any, Any]:
    return points.real, mirror * points.imag


def _body(axes: Axes, design: WideSwingDesign, cam: AnyCam, mirror: float) -> None:
    from gearlink.core.machines.wide_swing.strokes import contour, dwell_arc

    run_up, bottom, run_out = contour(cam)
    edge = np.concatenate((run_up, bottom, run_out))
    rest = dwell_arc(cam) if design.spec.cycle is None else _rest_of_turn(design, cam, mirror)
    x, y = _xy(np.concatenate((edge, rest)), mirror)
    if cam.sense > 0:
        style.area(axes, x + 1j * y, color=style.BLUE, alpha=0.10, linewidth=0, zorder=1)
    else:
        _ring(axes, x + 1j * y, 1.12 * float(np.abs(edge).max()) + cam.roller_radius)
    axes.plot(*_xy(rest, mirror), color=style.BLUE, linewidth=0.8, zorder=2)
    for part, label in ((run_up, "profile"), (run_out, None)):
        axes.plot(*_xy(part, mirror), color=style.BLUE, linewidth=1.8, zorder=3, label=label)
    look: dict[str, Any] = {"color": style.ORANGE, "linewidth": 3.4, "solid_capstyle": "butt", "zorder": 3}
    axes.plot(*_xy(bottom, mirror), **look, label="slot, in which the roller changes flank")


def _rest_of_turn(design: WideSwingDesign, cam: AnyCam, mirror: float) -> Any:
    """Arcs and free sector of a closed contour, in the frame of the cam's own stroke."""
    closed = design.cycle.back if cam is design.return_cam or mirror < 0.0 else design.cycle.main
    rest = np.concatenate([points for _, points in closed.outline()[3:]])
    return rest if cam.sense > 0 else -rest.conj()


def _ring(axes: Axes, hollow: Any, radius: float) -> None:
    """The body outside an internal contour, as far as a circle."""
    rim = circle(radius, 360)
    style.holed(axes, rim, hollow, facecolor=style.BLUE, alpha=0.10, linewidth=0, zorder=1)
    axes.plot(*_xy(rim), color=style.BLUE, linewidth=0.8, zorder=2)


def _pitch(axes: Axes, cam: AnyCam, mirror: float) -> None:
    pitch, middle = cam.points(np.linspace(0.0, 1.0, 601)).pitch, cam.middle
    look: dict[str, Any] = {"color": style.BLUE, "linewidth": 1.0, "linestyle": style.DASHED, "zorder": 3}
    axes.plot(*_xy(pitch, mirror), **look, label="pitch curve")
    zone = min(cam.transition_zone, middle, 1.0 - middle)
    part = cam.points(np.linspace(middle - zone, middle + zone, 101)).pitch
    axes.plot(*_xy(part, mirror), color=style.ORANGE, linewidth=3.0, solid_capstyle="butt", zorder=4)


def _rockers(axes: Axes, cam: AnyCam, mirror: float) -> None:
    """The rocker at start, mid-swing and end as the cam sees it."""
    points = cam.points(np.array([0.0, cam.middle, 1.0]))
    pivots = -cam.sense * cam.center_distance * np.exp(1j * cam.sense * points.cam_angle)
    looks = (("start", style.GREEN), ("mid-swing", style.BLACK), ("end", style.PURPLE))
    for roller, pivot, (name, color) in zip(points.pitch, pivots, looks, strict=True):
        arm = np.array([complex(*_xy(z, mirror)) for z in (pivot, roller)])
        axes.plot(arm.real, arm.imag, color=color, linewidth=2.0, zorder=5, label=f"rocker, {name}")
        axes.plot(arm.real[:1], arm.imag[:1], "^", color=color, markersize=6, zorder=6)
        style.circle(axes, arm[1], cam.roller_radius, color=color, linewidth=1.1, zorder=6)
    style.circle(axes, 0j, cam.center_distance, color=style.GREY, linewidth=0.7, linestyle=style.DOTTED, zorder=1)


def stroke_axis(axes: Axes, design: WideSwingDesign, ylabel: str) -> None:
    """Curves over a stroke, and its time where both strokes take the same."""
    panels.curves(axes, "fraction of the stroke k", ylabel)
    axes.set_xlim(0.0, 1.0)
    if design.motion.return_angle == design.motion.cycle_angle:
        time_axes.in_ms(axes, 1e3 * design.motion.working_time)


def pressure_panel(axes: Axes, design: WideSwingDesign) -> None:
    """Pressure angle of each cam over the stroke with the limit; the transition zone is shaded."""
    stroke_axis(axes, design, "pressure angle [deg]")
    k = np.linspace(0.0, 1.0, 401)
    for (words, cam), color in zip(design.cams.items(), (style.BLUE, style.GREEN), strict=False):
        label = f"{words}, ≤ {math.degrees(cam.max_pressure_angle):.4g}°" if design.has_zone(cam) else words
        angle = np.degrees(cam.points(k).pressure_angle)
        axes.plot(k, angle, color=color, linewidth=1.6, label=label)
        touching = np.array([any(low <= at <= high for low, high in cam.contact) for at in k.tolist()])
        over = np.abs(angle) > design.spec.limits.pressure_angle
        failing.past(axes, k, angle, over & touching, f"{words}, above the limit")
    _zone(axes, design)
    limit = design.spec.limits.pressure_angle
    for sign in (1.0, -1.0):
        name = f"limit ±{limit:g}°" if sign > 0.0 else None
        axes.axhline(sign * limit, color=style.RED, linewidth=1.0, linestyle=style.DASHED, label=name)
    panels.legend_under_heading(axes, "Pressure angle")


def _zone(axes: Axes, design: WideSwingDesign) -> None:
    zone, middle = min(0.5, max(cam.transition_zone for cam in design.cams.values())), design.cam.middle
    axes.axvspan(middle - zone, middle + zone, color=ZONE, linewidth=0, zorder=0)


def curvature_panel(axes: Axes, design: WideSwingDesign) -> None:
    """Curvature radius of each pitch curve where the roller touches the profile, against the roller's."""
    stroke_axis(axes, design, "radius [mm]")
    axes.set_yscale("log")
    panels.powers_of_ten(axes.yaxis)
    k = np.linspace(0.0, 1.0, 1001)[1:-1]
    k, greatest = k[k != 0.5], 0.0
    for (words, cam), color in zip(design.cams.items(), (style.BLUE, style.GREEN), strict=False):
        radius, least = cam.points(k).curvature_radius * cam.sense, ""
        if design.has_zone(cam):
            least = f", ≥ {cam.min_curvature_radius:.4g} mm"
            radius = np.where([any(low <= at <= high for low, high in cam.contact) for at in k], radius, np.nan)
        greatest = max(greatest, float(np.abs(radius).max(where=np.isfinite(radius), initial=0.0)))
        axes.plot(k, np.where(radius > 0.0, radius, np.nan), color=color, linewidth=1.6, label=words + least)
        failing.past(axes, k, radius, (radius > 0.0) & (radius <= cam.roller_radius), f"{words}, undercut")
        if (radius < 0.0).any():
            hollow = np.where(radius < 0.0, -radius, np.nan)
            axes.plot(k, hollow, color=color, linewidth=1.2, linestyle=style.DOTTED, label=f"{words}, concave")
    _zone(axes, design)
    roller = design.section.roller_radius
    axes.axhline(roller, color=style.RED, linewidth=1.0, linestyle=style.DASHED, label=f"roller radius {roller:g} mm")
    axes.set_ylim(0.3 * roller, min(100.0 * design.section.center_distance, 3.0 * max(greatest, 10.0 * roller)))
    panels.legend_under_heading(axes, "Curvature radius of the pitch curve")


@dataclass(frozen=True)
class Cycle:
    """A wide swing over fractions of its loop: its whole cycle, or a stroke of an evenly turning cam and back."""

    design: WideSwingDesign
    fraction: Reals

    @property
    def oscillates(self) -> bool:
        """Whether the cam rides on a crank-rocker."""
        return self.design.spec.drive is not None

    @property
    def whole(self) -> bool:
        """Whether strokes and rests fill one revolution as the file says."""
        return self.design.spec.cycle is not None

    @cached_property
    def turned(self) -> float:
        """Angle that the cam, or the crank, turns in the loop: whole revolutions with room for both strokes [rad]."""
        if self.oscillates or self.whole:
            return TURN
        return TURN * math.ceil(2.0 * self.design.motion.cycle_angle / TURN - 1e-9)

    @cached_property
    def stroke(self) -> Reals:
        """k, fraction of a stroke alone: from 0 to 1 and back; the return takes the law from its other end."""
        at, share = np.mod(self.fraction, 1.0), self.design.motion.cycle_angle / self.turned
        out, back = np.clip(at / share, 0.0, 1.0), np.clip((at - 0.5) / share, 0.0, 1.0)
        return np.where(at < 0.5, out, 1.0 - back)

    @cached_property
    def here(self) -> Positions:
        """The links.

        Raises
            MissingSection - of a whole cycle without its cams
        """
        if self.oscillates or (self.whole and self.design.cycle.main):
            return Positions(self.design.moving, TURN * np.mod(self.fraction, 1.0))
        return Positions(self.design.moving, self.design.motion.cycle_angle * self.stroke)

    @cached_property
    def pins(self) -> dict[str, Points]:
        """The pins where the scene has them."""
        stands = frame(self.design)
        return {mark.text: stands.at(mark.point) for mark in self.here.marks}

    @cached_property
    def swing(self) -> Reals:
        """Angle of the rocker from mid-swing [rad]."""
        return self.here.turn("rocker")

    def cam_turn(self, *, back: bool = False) -> Reals:
        """Angle of an evenly turning cam from mid-swing of the stroke that it guides, the return of the last [rad]."""
        motion = self.design.motion
        if self.design.spec.slider is not None:
            share = self.design.cam.middle
            late, share = (0.5 * self.turned, 1.0 - share) if back else (0.0, share)
            return self.turned * self.fraction - late - share * motion.cycle_angle
        late = 0.5 * self.turned if back else 0.0
        if back and self.whole:
            late = sum(motion.cycle_angles[:2])
        return self.turned * self.fraction - late - 0.5 * (motion.return_angle if back else motion.cycle_angle)


def frame(design: WideSwingDesign) -> Frame:
    """The scene has the rocker's pivot in its origin and the cam axis right of it, and goes on through both strokes."""

    def inputs(fraction: Reals) -> Reals:
        return Cycle(design, fraction).turned * fraction

    if design.spec.cam is None:
        return Frame(inputs, design.moving)
    turn = -1.0 if design.spec.layout == "twin-rocker" else 1.0
    return Frame(inputs, design.moving, turn, design.spec.cam.center_distance)


def build(design: WideSwingDesign, fraction: Reals) -> Scene:
    """Positions over fractions of the loop; the rocker's pivot is the origin, the cam axis stands right of it."""
    cycle = Cycle(design, fraction)
    pins, (base, pin) = cycle.pins, _device_pins(cycle)
    marks = [Mark(pins["D"], "D", pivot=True), Mark(0.5 * (base + pin), "device")]
    if design.spec.cam is not None:
        marks.append(Mark(pins["O"], "O", pivot=True))
    if design.spec.layout == "twin-cam-parallel":
        marks.append(Mark(track(design.shafts.shafts[1], fraction), "O'", pivot=True))
    marks += [Mark(pins[name], name, pivot=name == "A") for name in "ABCEF" if name in pins]
    drive = "crank" if cycle.oscillates else "cam"
    return Scene(
        parts=(
            Chain(joints=(base, pin), color=style.GREEN, width=6.0),  # the unloading device, shortest at mid-swing
            Chain(joints=(track(0.0, fraction), pin)),
            *_cams(cycle),
            *_slider(cycle),
        ),
        marks=tuple(marks),
        chart=_chart(cycle, drive),
        readouts=(
            Readout(drive, "°", np.degrees(cycle.turned * fraction)),
            Readout("rocker from mid-swing", "°", np.degrees(cycle.swing)),
        ),
    )


def _cams(cycle: Cycle) -> list[Part]:
    """Cams of both strokes, and the rollers on the arms of the rocker."""
    design = cycle.design
    if design.spec.cam is None:
        return []
    if cycle.oscillates:
        middle = Positions(design.moving, np.array([0.5 * design.motion.drive.crank_span]))
        turn = cycle.here.turn("cam") - middle.turn("cam")  # from the middle of the crank's stroke
        return [
            *_cam(cycle, design.cam, turn, style.BLUE),
            Chain(joints=tuple(cycle.pins[name] for name in "ABCO"), color=style.GREY),
            *_roller(cycle, design.cam.rocker_radius),
        ]
    other, seat = design.return_cam or design.cam, 1.0 + 0j
    if (
        design.spec.layout == "twin-cam-parallel"
    ):  # from the rocker's axis to the shaft of the return cam, over the first
        seat = cmath.rect(1.0, design.shafts.roller_arm_angle)
    back = _cam(cycle, other, cycle.cam_turn(back=True), style.RED, mirrored=True, seat=seat)
    if design.spec.layout != "twin-rocker":
        main = _cam(cycle, design.cam, -cycle.cam_turn(), style.BLUE)
        arms = dict.fromkeys((complex(design.cam.rocker_radius), seat * other.rocker_radius))
        if design.spec.slider is not None:
            back = _cam(cycle, other, cycle.cam_turn(back=True), style.RED)
        return [*back, *main, *(part for arm in arms for part in _roller(cycle, arm))]
    assert design.return_cam is not None, "a twin-rocker has two shapes"
    main = _cam(cycle, design.cam, math.pi + cycle.cam_turn(), style.BLUE)
    rollers = *_roller(cycle, -design.cam.rocker_radius), *_roller(cycle, design.return_cam.rocker_radius)
    return [*back, *main, *rollers]


def _cam(
    cycle: Cycle, cam: AnyCam, turn: Reals, color: str, *, mirrored: bool = False, seat: complex = 1.0 + 0j
) -> list[Part]:
    """The closed contour of a cycle; else that of a stroke, open as it is known, and spokes to the cam axis."""
    turn = turn + cmath.phase(seat)
    if cycle.whole:
        return [_closed(cycle, turn, color, late=mirrored, seat=seat)]
    from gearlink.core.machines.wide_swing.strokes import contour

    run_up, slot, run_out = contour(cam, 160)
    outline = np.concatenate([run_up, slot[1:], run_out[1:]])
    outline = outline.conj() if mirrored else outline
    place = track(seat * cam.center_distance, cycle.fraction)
    spokes = np.array([outline[0], 0.0, outline[-1]])
    return [
        Body(outline=spokes, place=place, turn=turn, color=color, width=0.8),
        Body(outline=outline, place=place, turn=turn, color=color, width=2.4),
    ]


def _closed(cycle: Cycle, turn: Reals, color: str, *, late: bool, seat: complex) -> Body:
    """A closed contour in the frame of the stroke that it guides."""
    whole = cycle.design.cycle
    closed = whole.back if late else whole.main
    outline = np.concatenate([points for _, points in closed.outline(90)])
    outline = outline.conj() if late else whole.of_main(outline)
    place = track(seat * closed.cam.center_distance, cycle.fraction)
    return Body(outline=outline, place=place, turn=turn, color=color, width=2.4)


def _roller(cycle: Cycle, arm: complex) -> list[Part]:
    """A roller on its arm, as it stands at mid-swing."""
    aside = getattr(cycle.design.cam, "arm_offset", 0.0)
    center = arm * np.exp(1j * (cycle.swing - aside))
    cam = cycle.design.spec.cam
    assert cam is not None, "there is a roller where there is a cam"
    return [
        Chain(joints=(track(0.0, cycle.fraction), center), marked=False),
        wheel(center, cam.roller_radius, cycle.fraction, color=style.BLACK, fill=pale(style.ORANGE, 0.6)),
    ]


def _device_pins(cycle: Cycle) -> tuple[Points, Points]:
    """The pins of the device: on the frame, on the rocker."""
    unloader = cycle.design.spec.unloader
    if unloader.type == "gravity":  # from the rocker's axis to the mass, which hangs
        return track(0.0, cycle.fraction), -1j * unloader.distance * np.exp(1j * cycle.swing)
    base = track(1j * unloader.arm * unloader.pivot_ratio, cycle.fraction)
    return base, 1j * unloader.arm * np.exp(1j * cycle.swing)


def _slider(cycle: Cycle) -> list[Part]:
    """The slider that the rocker moves through a rod."""
    if cycle.design.spec.slider is None:
        return []
    rod, (d, e, f) = cycle.design.motion.slider.drive.rod, (cycle.pins[name] for name in "DEF")
    along = cycle.here.turn("slider") + 0.5 * math.pi
    return [replace(block(f, 0.14 * rod, 0.2 * rod, style.BLUE), turn=along), Chain(joints=(d, e, f))]


def _chart(cycle: Cycle, drive: str) -> Chart:
    whole = Cycle(cycle.design, loop(361))
    curve = Curve("rocker", style.BLUE, np.degrees(whole.swing), np.degrees(cycle.swing))
    turned = math.degrees(cycle.turned)
    x, now = turned * loop(361), turned * cycle.fraction
    return Chart(f"{drive} angle from the start of the stroke [deg]", "rocker from mid-swing [deg]", x, now, (curve,))


_NAMES = (("displacement", "a"), ("velocity", "b"), ("acceleration", "c"))


def draw(command: str, design: WideSwingDesign) -> Figure:
    """The figure of a command on a wide-swing mechanism."""
    return draw_cams(command, design) if command == "cam" else draw_motion(command, design)


def draw_motion(command: str, design: WideSwingDesign) -> Figure:
    """Unit diagrams over the stroke, cams to scale where the profile exists, balance over the speed; torques."""
    cams, moves = design.spec.cam is not None and has_slots(design), design.spec.cam is None
    heights = [1.0, 1.75, 1.0] if cams else [1.0, 1.0 + 1.4 * moves]
    share = 0.95 if cams or moves else 0.62
    if design.spec.shaft is not None:
        share *= 1.0 + 1.0 / sum(heights)
        heights = [*heights[:1], *(min(height, 1.4) for height in heights[1:]), 1.0]
    made = panels.page(_title(command, design), share)
    grid = made.add_gridspec(len(heights), 1, height_ratios=heights)
    _law_panels(made, grid[0], design)
    if design.spec.shaft is not None:
        _history_panels(made, grid[len(heights) - 1], design)
    if cams:
        _cam_panels(made, grid[1], design)
    if moves:
        _moving_panels(made, grid[1], design)
        return made
    below = grid[2 if cams else 1].subgridspec(1, 2)
    balance = made.add_subplot(below[0, 1] if cams or design.spec.slider is not None else below[0, :])
    if cams:
        pressure_panel(made.add_subplot(below[0, 0]), design)
    elif design.spec.slider is not None:
        _slider_panel(made.add_subplot(below[0, 0]), design)
    _balance_panel(balance, design)
    return made


def _history_panels(made: Figure, place: Any, design: WideSwingDesign) -> None:
    """Torques of both shafts over the stroke and the rest after it, and the dynamic coefficient over the speed."""
    history, balance = design.table("history"), design.table("balance")
    columns = place.subgridspec(1, 3)
    curves = [("", style.RED, "rigid, without device"), ("_balanced", style.BLUE, "rigid, with device")]
    curves.append(("_elastic", style.GREEN, "elastic, with device"))
    for i, (shaft, words) in enumerate((("rocker", "Rocker shaft"), ("drive", "Main shaft"))):
        axes = made.add_subplot(columns[0, i])
        panels.curves(axes, "time [ms]", "torque [N m]")
        for end, color, label in curves:
            axes.plot(history["time"], history[f"{shaft}_torque{end}"], color=color, linewidth=1.3, label=label)
        axes.set_xlim(0.0, float(history["time"][-1]))
        panels.legend_under_heading(axes, words, 1)
    axes = made.add_subplot(columns[0, 2])
    panels.curves(axes, "speed [1/min]", "dynamic coefficient [1]")
    axes.plot(balance["speed"], balance["dynamic_coefficient"], color=style.BLUE, linewidth=1.6)
    axes.axvline(design.spec.speed, color=style.GREY, linewidth=0.9, linestyle=style.DASHED, label="design speed")
    axes.set_xlim(0.0, float(balance["speed"][-1]))
    axes.set_ylim(0.0, 1.15 * float(np.max(balance["dynamic_coefficient"])))
    panels.legend_under_heading(axes, "Elastic over rigid torque", 1)


def _moving_panels(made: Figure, place: Any, design: WideSwingDesign) -> None:
    """A mechanism that has no cam yet, and beside it what the slider does and the balance."""
    slider = design.spec.slider is not None
    panes = place.subgridspec(2 if slider else 1, 2, width_ratios=[1.0, 1.0])
    _mechanism_panel(made.add_subplot(panes[:, 0]), design)
    if slider:
        _slider_panel(made.add_subplot(panes[0, 1]), design)
    _balance_panel(made.add_subplot(panes[-1, 1]), design)


def _mechanism_panel(axes: Axes, design: WideSwingDesign) -> None:
    """Rocker, device and slider to scale at mid-swing; lightly at both ends of the stroke."""
    panels.drawing(axes, "Mechanism at mid-swing")
    section = design.spec.slider
    middle = 0.5 if section is None else design.motion.slider.middle_place
    share = design.motion.cycle_angle / Cycle(design, np.zeros(1)).turned
    scene = build(design, share * np.array([middle, 0.0, 1.0]))
    scene_axes.draw(axes, scene)
    device = scene.parts[0]
    assert isinstance(device, Chain), "from its pivot on the frame to its pin on the rocker"
    style.pivot(axes, complex(device.joints[0][0]))
    for i, color, words in ((1, style.ORANGE, "start of the stroke"), (2, style.BLUE, "end of the stroke")):
        scene_axes.lightly(axes, scene, i, color, words)
    axes.plot([], [], color=style.GREEN, linewidth=4.0, label="unloading device")
    if section is not None:
        links = scene.parts[-1]
        assert isinstance(links, Chain), "rocker and rod, to the slider"
        near, far = (complex(links.joints[-1][i]) for i in (1, 2))
        away, aside = slider_way(design), section.crank + 0.3 * section.rod
        start, end = (away * complex((point / away).real, -aside) for point in (near, far))
        words = f"stroke {style.number(abs(far - near))} mm"
        style.dimension(axes, start, end, words, from_points=(near, far), upright=True)
    axes.margins(0.06)
    axes.autoscale_view()
    panels.legend_below(axes)


def _law_panels(made: Figure, place: Any, design: WideSwingDesign) -> None:
    from gearlink.core.parts.cams.laws import law

    table = design.table("law")
    k: Any = table.data[0]
    others = (("harmonic", law("simple-harmonic"), style.DASHED), ("cycloidal", law("cycloidal"), style.DOTTED))
    columns = place.subgridspec(1, 3)
    for i, (name, symbol) in enumerate(_NAMES):
        axes = made.add_subplot(columns[0, i])
        panels.heading(axes, name.capitalize())
        stroke_axis(axes, design, f"{symbol} [1]")
        for words, other, dashes in others:
            curve = other.evaluate(k, 2)[i]
            axes.plot(k, curve, color=style.GREY, linewidth=0.9, linestyle=dashes, label=words)
        axes.plot(k, table.data[1 + i], color=style.BLUE, linewidth=1.8, label="unloaded law")
        if i == 0:
            axes.legend(loc="upper left", frameon=False, fontsize=7.5, handlelength=1.8)
        peak = (None, design.motion.law.velocity_peak, design.motion.law.acceleration_peak)[i]
        if peak is not None:
            axes.set_title(f"peak {peak:.5g}", loc="right", fontsize=8)


def _cam_panels(made: Figure, place: Any, design: WideSwingDesign) -> None:
    drawn = cams_of(design)
    rows = place.subgridspec(2, len(drawn), height_ratios=[1.0, 0.09])
    for i, (title, cam, mirror) in enumerate(drawn):
        axes = made.add_subplot(rows[0, i])
        _whole_cam(axes, design, title, cam, mirror)
    panels.legend_beside(made.add_subplot(rows[1, :]), axes, **_ROW)


def _balance_panel(axes: Axes, design: WideSwingDesign) -> None:
    """Torque peaks on the rocker axis over the speed; where it is shaded the device does harm."""
    from gearlink.core.numerics.extremes import minimum_over

    rows: Any = design.table("balance").data[0]
    peaks = design.unloading.torque_peaks
    least = minimum_over(lambda n: peaks(n / design.spec.speed)[1], float(rows[0]), float(rows[-1]))
    speed = np.unique(np.concatenate([rows, np.linspace(rows[0], rows[-1], 241), [least.place]]))
    without, with_device = peaks(speed / design.spec.speed)
    panels.curves(axes, "speed [1/min]", "torque peak [N m]")
    axes.plot(speed, without, color=style.RED, linewidth=1.6, label="without device")
    axes.plot(speed, with_device, color=style.BLUE, linewidth=1.6, label="with device", gid="with-device")
    axes.axvspan(0.0, design.unloading.harmful_speed, color=style.LIGHT, alpha=0.45, linewidth=0, zorder=0)
    for place, words in ((design.spec.speed / math.sqrt(2.0), "n₀/√2"), (design.spec.speed, "n₀")):
        axes.axvline(place, color=style.GREY, linewidth=0.9, linestyle=style.DASHED)
        where: dict[str, Any] = {"xycoords": ("data", "axes fraction"), "textcoords": "offset points"}
        axes.annotate(words, (place, 1.0), (-3, -2), fontsize=8.5, ha="right", va="top", **where)
    axes.set_xlim(0.0, float(speed[-1]))
    axes.set_ylim(bottom=0.0)
    lowest = design.spec.operating_speed_min
    if lowest is not None:
        axes.axvline(lowest, color=style.GREEN, linewidth=1.0, linestyle=style.DOTTED, label="minimum operating speed")
    axes.axvspan(-2.0, -1.0, color=style.LIGHT, alpha=0.45, label="harmful")
    panels.extreme(axes, least.place, least.value, above=True, unit=" N m", at=" 1/min")
    panels.legend_under_heading(axes, "Torque on the rocker axis", 2)


def _slider_panel(axes: Axes, design: WideSwingDesign) -> None:
    """The slider's travel, speed and acceleration as invariants."""
    table = design.table("slider")
    stroke_axis(axes, design, "invariants of the slider")
    for column, color in (("displacement", style.GREEN), ("velocity", style.BLUE), ("acceleration", style.RED)):
        axes.plot(table.data[0], table[column], color=color, linewidth=1.6, label=column)
    middle = design.motion.slider.middle_place
    axes.axvline(middle, color=style.GREY, linewidth=0.9, linestyle=style.DASHED, label="mid-swing")
    panels.legend_under_heading(axes, "Slider", 2)


_SHADES = (style.BLUE, style.LIGHT, style.GREEN, style.LIGHT)
_PARTS: dict[str, tuple[str, float]] = {
    "arc": (style.GREY, 1.4),
    "free": (style.PURPLE, 1.4),
    "slot": (style.ORANGE, 3),
}
_WORDS = {"profile": "guides", "slot": "slot", "arc": "rest", "free": "free, the other cam guides"}
_SLOT_VIEW = 3.2
"""Half the width of the enlarged view about mid-swing, in roller radii."""


def draw_cams(command: str, design: WideSwingDesign) -> Figure:
    """The cams and an enlarged view of each slot, pressure angle and curvature.

    Raises
        NoSolution - for a profile that does not exist
    """
    whole = design.spec.cycle is not None
    made = panels.page(_title(command, design), 1.6 if whole else 1.0)
    drawn = cams_of(design)
    rows = made.add_gridspec(3, 1, height_ratios=[2.3, 0.9, 4.2]) if whole else None
    if rows is not None:
        contours_panel(made, rows[0], design)
        cycle_panel(made.add_subplot(rows[1]), design)
    place = made.add_gridspec(1, 1)[0] if rows is None else rows[2]
    grid = place.subgridspec(4, 1, height_ratios=[1.75, 1.2, 0.2, 1.05])
    large, close, below = (grid[i].subgridspec(1, n) for i, n in ((0, len(drawn)), (1, len(drawn)), (3, 2)))
    for i, (title, cam, mirror) in enumerate(drawn):
        axes = made.add_subplot(large[0, i])
        _whole_cam(axes, design, title, cam, mirror)
        _slot_panel(made.add_subplot(close[0, i]), design, cam, mirror)
    panels.legend_beside(made.add_subplot(grid[2]), axes, **_ROW)
    pressure_panel(made.add_subplot(below[0, 0]), design)
    curvature_panel(made.add_subplot(below[0, 1]), design)
    return made


def _slot_panel(axes: Axes, design: WideSwingDesign, cam: AnyCam, mirror: float) -> None:
    """The slot that the roller needs at mid-swing, enlarged."""
    start, end = design.slot_of(cam)
    cam_panel(axes, design, "Slot at mid-swing", cam, mirror)
    words = f"contact until k = {start:.4f}\nand from k = {end:.4f}"
    axes.text(0.97, 0.05, words, transform=axes.transAxes, ha="right", va="bottom", fontsize=7.5, zorder=8)
    middle = complex(cam.points(np.array([cam.middle])).pitch[0])
    half: Any = _SLOT_VIEW * cam.roller_radius
    axes.set_aspect("equal", adjustable="box")
    axes.set_xlim(middle.real - 1.6 * half, middle.real + 1.6 * half)
    axes.set_ylim(mirror * middle.imag - half, mirror * middle.imag + half)


# The whole cycle


def contours_panel(made: Figure, place: Any, design: WideSwingDesign) -> None:
    """The closed contours to scale: of a twin-rocker on one body, of a twin-cam side by side."""
    cycle = design.cycle
    if not cycle.external_working:
        columns = place.subgridspec(1, 2, width_ratios=[1.5, 1.0])
        axes = made.add_subplot(columns[0, 0])
        panels.drawing(axes, "Both profiles on one body")
        for cam, frame, color in ((cycle.main, cycle.of_main, style.BLUE), (cycle.back, cycle.of_back, style.GREEN)):
            _contour(axes, cam, frame, color)
        _between(axes, cycle)
        _shaft(axes, design)
        panels.legend_beside(made.add_subplot(columns[0, 1]), axes, **_BESIDE)
        return
    columns = place.subgridspec(2, 2, height_ratios=[1.0, 0.08])
    both = ("working", cycle.main, cycle.of_main), ("return", cycle.back, cycle.of_back)
    for i, (stroke, cam, frame) in enumerate(both):
        axes = made.add_subplot(columns[0, i])
        panels.drawing(axes, f"Cam of the {stroke} stroke")
        _contour(axes, cam, frame, (style.BLUE, style.GREEN)[i])
        style.area(axes, _whole(cam, frame), color=style.BLUE, alpha=0.10, linewidth=0, zorder=1)
        _shaft(axes, design)
        panels.legend_beside(made.add_subplot(columns[1, i]), axes, **_BESIDE, ncols=2)


def _whole(cam: ClosedCam, frame: Any) -> Any:
    return frame(np.concatenate([points for _, points in cam.outline()]))


def _contour(axes: Axes, cam: ClosedCam, frame: Any, color: str) -> None:
    """A contour in its sectors, each in its own colour, the joints marked, and the path of the roller's centre."""
    named = "internal" if cam.cam.sense < 0 else "external"
    for i, (name, points) in enumerate(cam.outline()):
        shade, width = _PARTS.get(name, (color, 2.4))
        label = f"{named}: {_WORDS[name]}" if name == "profile" else _WORDS[name]
        first = i not in (2, 5)
        axes.plot(*_xy(frame(points)), color=shade, linewidth=width, zorder=4, label=label if first else None)
    joints = frame(cam.contour(np.array(cam.starts[:4])))
    axes.plot(*_xy(joints), "o", color=style.BLACK, markersize=3.5, zorder=6, label="joint")
    path = frame(cam.pitch(np.linspace(0.0, 2.0 * math.pi, 1441)))
    axes.plot(*_xy(path), color=style.GREY, linewidth=0.7, linestyle=style.DASHED, zorder=3, label="roller centre")


def _between(axes: Axes, cycle: WholeCycle) -> None:
    """The body of both profiles: metal inside the external and outside the internal one, as far as a rim."""
    inside, hollow = _whole(cycle.back, cycle.of_back), _whole(cycle.main, cycle.of_main)
    style.area(axes, inside, color=style.GREEN, alpha=0.12, linewidth=0, zorder=1)
    _ring(axes, hollow, 1.08 * float(np.abs(hollow).max()))


def cycle_panel(axes: Axes, design: WideSwingDesign) -> None:
    """The rocker's angle over a revolution of the cam, the strokes and rests shaded and named."""
    cycle = design.cycle
    panels.curves(axes, "cam angle from the start of the working stroke [deg]", "rocker from mid-swing [deg]")
    table = cycle.table(720)
    x, y = np.append(table["cam_angle"], 360.0), np.append(table["rocker_angle"], table["rocker_angle"][0])
    axes.plot(x, y, color=style.BLUE, linewidth=1.8, label="rocker")
    starts = np.degrees(np.cumsum((0.0, *cycle.angles)))
    half = 0.5 * design.spec.swing
    for i, words in enumerate(("working stroke", "far dwell", "return stroke", "near dwell")):
        axes.axvspan(starts[i], starts[i + 1], color=_SHADES[i], alpha=0.14, linewidth=0, zorder=0)
        if starts[i + 1] > starts[i]:
            text = f"{words}\n{starts[i + 1] - starts[i]:g}°"
            axes.text(0.5 * (starts[i] + starts[i + 1]), 1.08 * half, text, ha="center", va="bottom", fontsize=8)
    axes.set_xlim(0.0, 360.0)
    axes.set_ylim(-1.15 * half, 1.55 * half)
    time_axes.in_ms(axes, 6e4 / (360.0 * design.spec.speed))
    panels.heading(axes, "Cycle")
