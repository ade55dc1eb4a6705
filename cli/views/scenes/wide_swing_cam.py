"""The wide-swing mechanism: working stroke, rest, return stroke, rest.

A cam is drawn as far as it is known: as a closed contour where the file gives a cycle, else the profile of its stroke
with the slot of the roller at mid-swing.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

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
