"""Cams as parts: closed disc cams of presses and grippers, open profiles of wide-swing cams."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.export.contour import JOIN, Circle, Part
from gearlink.cli.export.sampling import Points, Reals, Stretch
from gearlink.core.parts.cams.checks import undercut_checks
from gearlink.core.parts.cams.disc_cam import DiscCam

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.cams.outline import AnyCam
    from gearlink.core.parts.cams.flat_cam import FlatCam

CAM_LAYERS = ("PROFILE", "PITCH_CURVE")
_TURN = 2.0 * math.pi
# A joint belongs to the stretch that begins there; so far inside [rad] each stretch is asked, 1e-10 mm of a cam.
_INSIDE = 1e-12


def disc_cam(name: str, cam: DiscCam) -> Part:
    """A closed cam: profile and pitch curve over a turn, a vertex at each joint of its law.

    Raises
        NoSolution - where the cam does not exist
    """
    joints = _joints(cam)
    stretches = [_of_turn(cam, low, high) for low, high in pairwise(joints)]
    rounded = []
    for stretch, following in zip(stretches, [*stretches[1:], stretches[0]], strict=True):
        rounded += [stretch, *_round_corner(cam, stretch, following)]
    # a wall or a path outside the pitch curve has no roller that could cut it
    judged = (cam,) if cam.roller_radius > 0.0 else ()
    failed = tuple(check.message for check in undercut_checks(judged) if check.status == "fail")
    return Part(
        name=name,
        title=cam.name,
        stretches=tuple(rounded),
        closed=True,
        circles=(Circle("BASE_CIRCLE", cam.min_radius),) if cam.min_radius > 0.0 else (),  # else the roller covers it
        notes=(
            f"roller radius {cam.roller_radius:.9g} mm, cam turns {'counter-' if cam.sense > 0 else ''}clockwise",
            "frame: cam axis at the origin, x parallel to the machine's x at cam angle 0",
            "base circle: the largest about the axis inside the profile",
        ),
        findings=failed,
        extra_columns=("cam_angle [deg]", "pressure_angle [deg]", "curvature_radius [mm]"),
    )


def flat_cam(name: str, cam: FlatCam) -> Part:
    """A closed cam under a flat face: its profile over a turn, a vertex at each joint of its law."""

    def stretch(low: float, high: float) -> Stretch:
        def inside(theta: Reals) -> Reals:
            return np.clip(theta, low + _INSIDE if low else 0.0, high - _INSIDE)

        def extra(theta: Reals) -> Reals:
            return np.stack([np.degrees(theta), cam.touch(inside(theta)).radius])

        return Stretch(CAM_LAYERS[:1], lambda theta: cam.points(inside(theta))[0][None, :], low, high, extra=extra)

    undercut = cam.min_curvature_radius.value <= 0.0
    return Part(
        name=name,
        title="cam",
        stretches=tuple(stretch(low, high) for low, high in pairwise(_joints(cam))),
        closed=True,
        circles=(Circle("BASE_CIRCLE", cam.min_radius),),
        notes=(
            f"flat face, cam turns {'counter-' if cam.sense > 0 else ''}clockwise",
            "frame: cam axis at the origin, x parallel to the machine's x at cam angle 0",
            "base circle: the largest about the axis inside the profile",
        ),
        findings=("the profile is undercut: it cannot be made",) if undercut else (),
        extra_columns=("cam_angle [deg]", "curvature_radius [mm]"),
    )


def _joints(cam: DiscCam | FlatCam) -> list[float]:
    """Cam angles from 0 to a turn where stretches meet."""
    inside = sorted(joint % _TURN for joint in cam.joints)
    apart = [0.0]
    for joint in inside:
        if joint - apart[-1] > 1e-9 and _TURN - joint > 1e-9:
            apart.append(joint)
    return [*apart, _TURN]


def _of_turn(cam: DiscCam, low: float, high: float) -> Stretch:
    def inside(theta: Reals) -> Reals:
        return np.clip(theta, low + _INSIDE if low else 0.0, high - _INSIDE)

    def points(theta: Reals) -> Points:
        pitch, contact = cam.points(inside(theta))
        return np.stack([contact, pitch])

    def extra(theta: Reals) -> Reals:
        rows = cam.at(inside(theta))
        return np.stack([np.degrees(theta), np.degrees(rows.pressure_angle), rows.curvature_radius])

    return Stretch(CAM_LAYERS, points, low, high, extra=extra)


def _round_corner(cam: DiscCam, before: Stretch, after: Stretch) -> list[Stretch]:
    """The arc of the roller about a corner of the pitch curve, where the law's velocity jumps; none elsewhere."""
    left = before.points(np.array([before.high]))[:, 0]
    right = after.points(np.array([after.low]))[:, 0]
    if abs(left[0] - right[0]) <= JOIN:
        return []
    center, degrees = complex(right[1]), math.degrees(before.high)
    start, turn = cmath.phase(left[0] - center), cmath.phase((right[0] - center) / (left[0] - center))

    def points(way: Reals) -> Points:
        arc: Points = center + cam.roller_radius * np.exp(1j * (start + turn * way))
        return arc[None, :]

    def extra(way: Reals) -> Reals:
        return np.stack([np.full_like(way, degrees), np.full_like(way, math.nan), np.full_like(way, math.nan)])

    return [Stretch(("PROFILE",), points, 0.0, 1.0, "corner", extra, steps=1)]


def swing_cam(name: str, design: Any) -> Part:
    """A wide-swing cam: the profile of run-up and run-out as far as the roller touches it, open at both ends.

    Raises
        NoSolution - where the profile does not exist
    """
    from gearlink.core.machines.wide_swing.cams.outline import middle_of

    cam, mirror = _served(name, design)
    contact = design.contact_of(cam)
    center = middle_of(cam)
    places = sorted({0.0, *contact[0], center, *contact[1], 1.0})
    middle = complex(_pitch_of(cam, mirror)(np.array([center]))[0])
    circles = [Circle("ROLLER_AT_MID_SWING", cam.roller_radius, middle)]
    shaft = design.section.shaft_radius
    if shaft > 0.0:
        circles.append(Circle("SHAFT", shaft))
    return Part(
        name=name,
        title=f"{'main' if name == 'main_cam' else 'return'} cam, {'ex' if is_external(cam) else 'in'}ternal profile",
        stretches=tuple(_of_stroke(cam, mirror, part, part in contact) for part in pairwise(places)),
        closed=False,
        circles=tuple(circles),
        notes=_swing_notes(cam, mirror),
        findings=_swing_findings(cam, design),
        extra_columns=("k", "cam_angle [deg]", "pressure_angle [deg]", "curvature_radius [mm]"),
    )


def _served(name: str, design: Any) -> tuple[AnyCam, bool]:
    """The cam of a stroke, and whether its mirror image is meant."""
    if name == "main_cam":
        return design.cam, False
    return design.return_cam or design.cam, design.spec.layout == "twin-cam"


def _swing_findings(cam: AnyCam, design: Any) -> tuple[str, ...]:
    """Undercut of this cam; the findings of a design with two shapes tell them apart by their words."""
    others = [words for words, other in design.cams.items() if other is not cam]
    failed = [check.message for check in design.check("cam-undercut") if check.status == "fail"]
    return tuple(message for message in failed if not any(words in message for words in others))


def _pitch_of(cam: AnyCam, mirror: bool) -> Callable[[Reals], Points]:
    def pitch(k: Reals) -> Points:
        points = cam.points(k).pitch
        return points.conj() if mirror else points

    return pitch


def _of_stroke(cam: AnyCam, mirror: bool, part: tuple[float, float], touches: bool) -> Stretch:
    def points(k: Reals) -> Points:
        at = cam.points(k)
        curves = np.stack([at.profile, at.pitch]) if touches else at.pitch[None, :]
        return curves.conj() if mirror else curves

    def extra(k: Reals) -> Reals:
        at = cam.points(k)
        return np.stack([k, np.degrees(at.cam_angle), np.degrees(at.pressure_angle), at.curvature_radius])

    name = "profile" if touches else "slot"
    return Stretch(CAM_LAYERS if touches else CAM_LAYERS[1:], points, *part, name, extra)


def _swing_notes(cam: AnyCam, mirror: bool) -> tuple[str, ...]:
    body = "inside" if is_external(cam) else "outside"
    (first, start), (end, last) = cam.contact
    return (
        f"roller radius {cam.roller_radius:.9g} mm, centre distance {cam.center_distance:.9g} mm, "
        f"rocker radius {cam.rocker_radius:.9g} mm",
        f"open profile: the body lies {body} it; how it closes through hub and rim is the designer's choice",
        f"profile given for k = {first:.9g} to {start:.9g} and {end:.9g} to {last:.9g}; between them the roller at "
        "mid-swing cuts its own circle (layer ROLLER_AT_MID_SWING)",
        "frame: cam axis at the origin, mid-swing on the x axis" + ("; mirror image of main_cam" if mirror else ""),
    )


def closed_cam(name: str, design: Any) -> Part:
    """A wide-swing cam over the whole cycle as one closed contour; a twin-rocker's two in the frame of one body.

    Raises
        NoSolution - where the profile does not exist
    """
    cycle = design.cycle
    late = name != "contour"
    closed, frame = (cycle.back, cycle.of_back) if late else (cycle.main, cycle.of_main)
    start, end = (k * closed.own for k in closed.slot)
    places = [(0, 0.0), (0, start), (0, 0.5 * closed.own), (0, end), *((i, closed.starts[i]) for i in (1, 2, 3))]
    ends = [t for _, t in places[1:]] + [closed.starts[4]]
    spans = [(i, low, high) for (i, low), high in zip(places, ends, strict=True) if high > low]
    shaft = design.section.shaft_radius
    found = design.check("closed-contour")
    return Part(
        name=name,
        title=f"{'return' if late else 'main'} cam, closed {'ex' if is_external(closed.cam) else 'in'}ternal contour",
        stretches=tuple(_of_sector(closed, frame, *span) for span in spans),
        closed=True,
        circles=(Circle("SHAFT", shaft),) if shaft > 0.0 else (),
        notes=_closed_notes(closed, cycle, late),
        findings=tuple(found[late].message for _ in (0,) if found[late].status == "fail"),
        extra_columns=("cam_angle_of_own_stroke [deg]",),
    )


def _of_sector(closed: Any, frame: Any, sector: int, low: float, high: float) -> Stretch:
    from gearlink.core.machines.wide_swing.cams.closed_cam import SECTORS

    def points(t: Reals) -> Points:
        return np.stack([frame(closed.contour_of(sector, t)), frame(closed.pitch_of(sector, t))])

    return Stretch(CAM_LAYERS, points, low, high, SECTORS[sector], lambda t: np.degrees(t)[None, :])


def _closed_notes(closed: Any, cycle: Any, late: bool) -> tuple[str, ...]:
    cam = closed.cam
    sectors = ", ".join(f"{math.degrees(angle):.9g}" for angle in closed.sectors)
    frame = "cam axis at the origin, mid-swing of " + ("the return stroke" if late else "the working stroke")
    if late and not cycle.external_working:
        frame = "that of the internal contour: both profiles stand on one body in their true mutual place"
    else:
        frame += " on the x axis"
    return (
        f"roller radius {cam.roller_radius:.9g} mm, centre distance {cam.center_distance:.9g} mm, "
        f"rocker radius {cam.rocker_radius:.9g} mm",
        f"sectors of the pitch curve from its own stroke on: driven, arc, free, arc: {sectors} deg; in the free sector "
        f"the contour keeps {closed.clearance:.9g} mm from the roller",
        f"the body lies {'in' if is_external(cam) else 'out'}side; the roller's slot at mid-swing is part of it",
        f"frame: {frame}",
    )


def is_external(cam: AnyCam) -> bool:
    """Whether the cam's body lies inside its profile."""
    from gearlink.core.machines.wide_swing.cams import outline

    return outline.is_external(cam)
