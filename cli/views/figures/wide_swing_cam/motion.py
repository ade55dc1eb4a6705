"""A wide-swing mechanism: its scene, and the figure of its law of motion, cams, pressure angle and balancing."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import panels, scene_axes, style
from gearlink.cli.views.figures.wide_swing_cam.parts import (
    cam_panel,
    cams_of,
    has_slots,
    kind_words,
    pressure_panel,
    stroke_axis,
    zone_words,
)
from gearlink.cli.views.scenes.colors import BLACK, BLUE, GREEN, GREY, ORANGE, RED, pale
from gearlink.cli.views.scenes.linkages import Joints
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
    loop,
    track,
    wheel,
)
from gearlink.core.parts.linkages.fourbar.mechanism import four_bar_motion

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.wide_swing.design import WideSwingDesign
    from gearlink.core.machines.wide_swing.strokes import AnyCam


@dataclass(frozen=True)
class Cycle:
    """The cycle of a cam that turns evenly, or of one on a crank-rocker, over fractions of the loop."""

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
        return (
            TURN
            if self.oscillates or self.whole
            else TURN * math.ceil(2.0 * self.design.motion.cycle_angle / TURN - 1e-9)
        )

    @cached_property
    def share(self) -> float:
        """Share of the loop that a stroke takes."""
        return self.design.motion.cycle_angle / self.turned

    @cached_property
    def stroke(self) -> Reals:
        """k, fraction of the stroke: from 0 to 1 and back; the return takes the law from its other end."""
        at = np.mod(self.fraction, 1.0)
        if self.whole:
            return self.design.cycle.main.swing_share(TURN * at)
        if self.oscillates:
            return np.where(at <= self.share, at / self.share, self._back(at))
        out, back = np.clip(at / self.share, 0.0, 1.0), np.clip((at - 0.5) / self.share, 0.0, 1.0)
        return np.where(at < 0.5, out, 1.0 - back)

    def _back(self, at: Reals) -> Reals:
        """k where the cam that swings back stands as it did in the stroke."""
        drive = self.design.motion.drive
        bars = four_bar_motion(drive.linkage)
        k = np.linspace(0.0, 1.0, 20001)
        forth = Joints.of(bars, drive.crank_angles[0] + k * drive.crank_span).rocker
        here = Joints.of(bars, drive.crank_angles[0] + TURN * at).rocker
        rising = forth[-1] > forth[0]
        return np.asarray(np.interp(here if rising else -here, forth if rising else -forth, k))

    @cached_property
    def swing(self) -> Reals:
        """Angle of the rocker from mid-swing [rad]."""
        law = self.design.motion.law
        share = law.invariants(self.stroke, 0)[0]
        return np.asarray((share - 0.5) * self.design.motion.swing)

    def cam_turn(self, *, back: bool = False) -> Reals:
        """Angle of an evenly turning cam from mid-swing of the stroke that it guides, the return of the last [rad]."""
        motion = self.design.motion
        if self.design.spec.slider is not None:
            from gearlink.core.machines.wide_swing.strokes import middle_of

            share = middle_of(self.design.cam)
            late, share = (0.5 * self.turned, 1.0 - share) if back else (0.0, share)
            return self.turned * self.fraction - late - share * motion.cycle_angle
        late = 0.5 * self.turned if back else 0.0
        if back and self.whole:
            late = sum(motion.cycle_angles[:2])
        return self.turned * self.fraction - late - 0.5 * (motion.return_angle if back else motion.cycle_angle)


def build(design: WideSwingDesign, fraction: Reals) -> Scene:
    """Positions over fractions of the loop; the rocker's pivot is the origin, the cam axis stands right of it."""
    cycle = Cycle(design, fraction)
    base, pin = _device_pins(cycle)
    marks = [Mark(track(0.0, fraction), "D", pivot=True), Mark(0.5 * (base + pin), "device")]
    if design.spec.cam is not None:
        marks.append(Mark(track(design.spec.cam.center_distance, fraction), "O", pivot=True))
    if design.spec.layout == "twin-cam-parallel":
        marks.append(Mark(track(design.shafts.shafts[1], fraction), "O'", pivot=True))
    if cycle.oscillates:
        crank, *pins, _ = _crank_rocker(cycle)
        marks += [Mark(crank, "A", pivot=True), *(Mark(joint, name) for joint, name in zip(pins, "BC", strict=True))]
    if design.spec.slider is not None:
        marks += [Mark(joint, name) for joint, name in zip(_slider_joints(cycle), "EF", strict=True)]
    drive = "crank" if cycle.oscillates else "cam"
    return Scene(
        parts=(*_device(cycle), *_cams(cycle), *_slider(cycle)),
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
        turn, joints = _cam_on_rocker(cycle), _crank_rocker(cycle)
        return [
            *_cam(cycle, design.cam, turn, BLUE),
            Chain(joints=joints, color=GREY),
            *_roller(cycle, design.cam.rocker_radius),
        ]
    other, seat = design.return_cam or design.cam, _second_seat(design)
    back = _cam(cycle, other, cycle.cam_turn(back=True), RED, mirrored=True, seat=seat)
    if design.spec.layout != "twin-rocker":
        main = _cam(cycle, design.cam, -cycle.cam_turn(), BLUE)
        arms = dict.fromkeys((complex(design.cam.rocker_radius), seat * other.rocker_radius))
        if design.spec.slider is not None:
            back = _cam(cycle, other, cycle.cam_turn(back=True), RED)
        return [*back, *main, *(part for arm in arms for part in _roller(cycle, arm))]
    assert design.return_cam is not None, "a twin-rocker has two shapes"
    main = _cam(cycle, design.cam, math.pi + cycle.cam_turn(), BLUE)
    rollers = *_roller(cycle, -design.cam.rocker_radius), *_roller(cycle, design.return_cam.rocker_radius)
    return [*back, *main, *rollers]


def _second_seat(design: WideSwingDesign) -> complex:
    """Unit vector from the rocker's axis to the shaft of the return cam, over that to the first shaft."""
    if design.spec.layout != "twin-cam-parallel":
        return 1.0 + 0j
    return cmath.rect(1.0, design.shafts.roller_arm_angle)


def _cam(
    cycle: Cycle, cam: AnyCam, turn: Reals, color: str, *, mirrored: bool = False, seat: complex = 1.0 + 0j
) -> list[Part]:
    """The closed contour of a cycle; else that of a stroke, open as it is known, and spokes to the cam axis."""
    turn = turn + cmath.phase(seat)
    if cycle.whole:
        return [_closed(cycle, turn, color, late=mirrored, seat=seat)]
    from gearlink.core.machines.wide_swing.strokes import contour

    run_up, slot, run_out = contour(cam, cycle.design.slot_of(cam), 160)
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
        wheel(center, cam.roller_radius, cycle.fraction, color=BLACK, fill=pale(ORANGE, 0.6)),
    ]


def _cam_on_rocker(cycle: Cycle) -> Reals:
    """Turn of a cam on the rocker of a crank-rocker, 0 at the middle of the crank's stroke [rad]."""
    joints, drive = _drive_joints(cycle), cycle.design.motion.drive
    middle = float(Joints.of(four_bar_motion(drive.linkage), np.array([0.5 * sum(drive.crank_angles)])).rocker[0])
    return -_rising(cycle) * (joints.rocker - middle)


def _rising(cycle: Cycle) -> float:
    """+1 where the rocker of the drive turns counter-clockwise in the stroke, else -1."""
    drive = cycle.design.motion.drive
    ends = Joints.of(four_bar_motion(drive.linkage), np.array(drive.crank_angles)).rocker
    return 1.0 if ends[1] > ends[0] else -1.0


def _drive_joints(cycle: Cycle) -> Joints:
    drive = cycle.design.motion.drive
    return Joints.of(four_bar_motion(drive.linkage), drive.crank_angles[0] + TURN * cycle.fraction)


def _crank_rocker(cycle: Cycle) -> tuple[Points, ...]:
    """The crank-rocker of the cam, its rocker on the cam axis, mirrored where the cam asks for it."""
    at, cam = _drive_joints(cycle), cycle.design.spec.cam
    assert cam is not None, "the drive carries a cam"
    aside = -complex(math.cos(math.radians(60.0)), -math.sin(math.radians(60.0)))
    frame = cycle.design.motion.drive.linkage.frame

    def placed(point: Points) -> Points:
        from_rocker = point - frame
        return np.asarray(cam.center_distance + aside * (from_rocker.conj() if _rising(cycle) > 0.0 else from_rocker))

    return placed(at.a), placed(at.b), placed(at.c), placed(at.d)


def _device(cycle: Cycle) -> list[Part]:
    """The unloading device, shortest at mid-swing, and its arm."""
    base, pin = _device_pins(cycle)
    return [
        Chain(joints=(base, pin), color=GREEN, width=6.0),
        Chain(joints=(track(0.0, cycle.fraction), pin)),
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
    rod, (pin, place) = cycle.design.motion.slider.drive.rod, _slider_joints(cycle)
    return [
        block(place, 0.14 * rod, 0.2 * rod, BLUE),
        Chain(joints=(track(0.0, cycle.fraction), pin, place)),
    ]


def _slider_joints(cycle: Cycle) -> tuple[Points, Points]:
    """The pins of the rod: on the rocker, on the slider."""
    drive = cycle.design.motion.slider.drive
    pin = drive.crank * np.exp(1j * (cycle.swing + drive.middle_angle - 0.5 * math.pi))
    return pin, -drive.offset - 1j * drive.depth(cycle.swing)[0]


def _chart(cycle: Cycle, drive: str) -> Chart:
    whole = Cycle(cycle.design, loop(361))
    curve = Curve("rocker", BLUE, np.degrees(whole.swing), np.degrees(cycle.swing))
    turned = math.degrees(cycle.turned)
    x, now = turned * loop(361), turned * cycle.fraction
    return Chart(f"{drive} angle from the start of the stroke [deg]", "rocker from mid-swing [deg]", x, now, (curve,))


_DASHED: Any = (0, (5, 3))
_DOTTED: Any = (0, (1, 2))
_NAMES = (("displacement", "a"), ("velocity", "b"), ("acceleration", "c"))


def draw(command: str, design: WideSwingDesign) -> Figure:
    """Unit diagrams over the stroke, cams to scale where the profile exists, balance over the speed; torques."""
    cams, moves = design.spec.cam is not None and has_slots(design), design.spec.cam is None
    title = f"{design.spec.name}: {command} ({kind_words(design)})"
    heights = [1.0, 1.75, 1.0] if cams else [1.0, 1.0 + 1.4 * moves]
    share = 0.95 if cams or moves else 0.62
    if design.spec.shaft is not None:
        share *= 1.0 + 1.0 / sum(heights)
        heights.append(1.0)
    made = panels.page(title, share)
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
    curves = (
        ("", style.RED, "rigid, without device"),
        ("_balanced", style.BLUE, "rigid, with device"),
        ("_elastic", style.GREEN, "elastic, with device"),
    )
    for i, (shaft, words) in enumerate((("rocker", "Rocker shaft"), ("drive", "Main shaft"))):
        axes = made.add_subplot(columns[0, i])
        style.curves(axes, "time [ms]", "torque [N m]")
        panels.small_ticks(axes)
        for end, color, label in curves:
            axes.plot(history["time"], history[f"{shaft}_torque{end}"], color=color, linewidth=1.3, label=label)
        axes.set_xlim(0.0, float(history["time"][-1]))
        panels.legend_under_heading(axes, words, 1)
    axes = made.add_subplot(columns[0, 2])
    style.curves(axes, "speed [rev/min]", "dynamic coefficient [1]")
    panels.small_ticks(axes)
    axes.plot(balance["speed"], balance["dynamic_coefficient"], color=style.BLUE, linewidth=1.6)
    axes.axvline(design.spec.speed, color=style.GREY, linewidth=0.9, linestyle=_DASHED, label="design speed")
    axes.set_xlim(0.0, float(balance["speed"][-1]))
    axes.set_ylim(bottom=0.0)
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
    import numpy as np

    panels.drawing(axes, "Mechanism at mid-swing")
    section = design.spec.slider
    middle = 0.5 if section is None else design.motion.slider.middle_place
    scene = build(design, Cycle(design, np.zeros(1)).share * np.array([middle, 0.0, 1.0]))
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
        aside = section.crank + 0.3 * section.rod
        start, end = (complex(-aside, point.imag) for point in (near, far))
        words = f"stroke {style.number(abs(far - near))} mm"
        style.dimension(axes, start, end, words, from_points=(near, far), upright=True)
    axes.margins(0.06)
    axes.autoscale_view()
    panels.legend_below(axes)


def _law_panels(made: Figure, place: Any, design: WideSwingDesign) -> None:
    from gearlink.core.parts.cams.laws import law

    table = design.table("law")
    k: Any = table.data[0]
    others = (("harmonic", law("simple-harmonic"), _DASHED), ("cycloidal", law("cycloidal"), _DOTTED))
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
        cam_panel(axes, design, title, cam, mirror)
        zone_words(axes, cam)
    legend_row(made.add_subplot(rows[1, :]), axes)


def legend_row(axes: Axes, drawing: Axes) -> None:
    """The legend of drawings in a panel of its own below them."""
    axes.set_axis_off()
    handles, labels = drawing.get_legend_handles_labels()
    axes.legend(handles, labels, loc="center", ncols=4, frameon=False, fontsize=7.5, columnspacing=1.4)


def _balance_panel(axes: Axes, design: WideSwingDesign) -> None:
    """Torque peaks on the rocker axis over the speed; where it is shaded the device does harm."""
    import numpy as np

    from gearlink.core.machines.wide_swing.design import torque_peaks
    from gearlink.core.numerics.extremes import minimum_over

    rows: Any = design.table("balance").data[0]
    least = minimum_over(lambda n: torque_peaks(design, n / design.spec.speed)[1], float(rows[0]), float(rows[-1]))
    speed = np.unique(np.concatenate([rows, np.linspace(rows[0], rows[-1], 241), [least.place]]))
    without, with_device = torque_peaks(design, speed / design.spec.speed)
    style.curves(axes, "speed [rev/min]", "torque peak [N m]")
    panels.small_ticks(axes)
    axes.plot(speed, without, color=style.RED, linewidth=1.6, label="without device")
    axes.plot(speed, with_device, color=style.BLUE, linewidth=1.6, label="with device", gid="with-device")
    usual = design.spec.speed / math.sqrt(2.0)
    axes.axvspan(0.0, design.unloading.harmful_speed, color=style.LIGHT, alpha=0.45, linewidth=0, zorder=0)
    axes.axvline(usual, color=style.GREY, linewidth=0.9, linestyle=_DASHED)
    axes.axvline(design.spec.speed, color=style.GREY, linewidth=0.9, linestyle=_DASHED)
    for place, words in ((usual, "n₀/√2"), (design.spec.speed, "n₀")):
        where: dict[str, Any] = {
            "xycoords": ("data", "axes fraction"),
            "textcoords": "offset points",
            "ha": "right",
            "va": "top",
        }
        axes.annotate(words, (place, 1.0), (-3, -2), fontsize=8.5, **where)
    axes.set_xlim(0.0, float(speed[-1]))
    axes.set_ylim(bottom=0.0)
    lowest = design.spec.operating_speed_min
    if lowest is not None:
        axes.axvline(lowest, color=style.GREEN, linewidth=1.0, linestyle=_DOTTED, label="minimum working speed")
    axes.axvspan(-2.0, -1.0, color=style.LIGHT, alpha=0.45, label="harmful")
    panels.extreme(axes, least.place, least.value, above=True, unit=" N m", at=" rev/min")
    panels.legend_under_heading(axes, "Torque on the rocker axis", 2)


def _slider_panel(axes: Axes, design: WideSwingDesign) -> None:
    """The slider's travel, speed and acceleration as invariants."""
    table = design.table("slider")
    stroke_axis(axes, design, "invariants of the slider")
    for column, color in (("displacement", style.GREEN), ("velocity", style.BLUE), ("acceleration", style.RED)):
        values = table.data[table.columns.index(column)]
        axes.plot(table.data[0], values, color=color, linewidth=1.6, label=column)
    axes.axvline(
        design.motion.slider.middle_place, color=style.GREY, linewidth=0.9, linestyle=_DASHED, label="mid-swing"
    )
    panels.legend_under_heading(axes, "Slider", 2)
