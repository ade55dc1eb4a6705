"""GL302 of links: the rod of a slider, the device, levers and a crank-rocker beside the shafts of cam and rocker.

Links are lines of no width. They may be in planes next to each other, so that none of this is a failure: it says which
shaft must end before the plane of which link. Where D alone matters the file's lengths decide; what lies to which
side of the cam shaft the section `loads` says by its directions.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gearlink.core.base.report import NO_NUMBER, Check, Shown, safely_above
from gearlink.core.numerics.arrays import unit_vector
from gearlink.core.numerics.extremes import minimum_over
from gearlink.core.parts.cams.checks import over_axis_check
from gearlink.core.parts.linkages.codes import SHAFT_CLEARANCE
from gearlink.core.studies.clearance import beside_line, beside_turning_arm

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.design import WideSwingDesign
    from gearlink.core.machines.wide_swing.loads import WideSwingLoads
    from gearlink.core.machines.wide_swing.slider import SliderDrive
    from gearlink.core.machines.wide_swing.spec import SwingCam
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.parts.linkages.fourbar.position import FourBar

CHECK = SHAFT_CLEARANCE.checks[2]
_TOUCHING = 1e-9
_ENDS = "the shaft must end before its plane (be overhung)"
_ONE_ENDS = "one of both shafts must end before the other (be overhung)"
_KEEPS_CLEAR = "turn loads.{}_direction"


class Axis(NamedTuple):
    """A shaft of the frame: what it is called, and the radius that must stay clear [mm]."""

    words: str
    radius: float
    named: bool


def cam_axis(section: SwingCam) -> Axis:
    """The cam shaft of the file; of one without a radius, one as thick as the roller."""
    if section.shaft_radius > 0.0:
        return Axis("the cam shaft", section.shaft_radius, named=True)
    return Axis("the cam axis", section.roller_radius, named=False)


def rocker_axis(section: SwingCam) -> Axis:
    """The rocker's axis D, with room for a shaft as thick as the roller."""
    return Axis("the rocker's axis", section.roller_radius, named=False)


def beside(link: str, axis: Axis, distance: float, remedy: str, end: str = _ENDS) -> Iterator[Check]:
    """A link that leaves the shaft less room than it takes; nothing where it keeps clear.

    Parameters
        link : str - "the device"
        distance : float [mm] - minimum over the motion
        remedy : str - what would clear it
        end : str - which shaft must end where
    """
    if distance >= axis.radius * (1.0 - _TOUCHING):
        return
    value, limit = (distance - axis.radius, 0.0) if axis.named else (distance, axis.radius)
    what, fix = f"distance of {link} from {axis.words}", remedy or end
    if distance <= _TOUCHING * axis.radius:
        what, shown = f"{link} passes over {axis.words}", NO_NUMBER
    else:
        shown = Shown(distance, axis.radius, "mm", ">=")
    aside = "" if shown is NO_NUMBER else "shaft radius" if axis.named else "a shaft as thick as the roller"
    yield SHAFT_CLEARANCE.check("warn", what, value, limit, "mm", name=CHECK, shown=shown, aside=aside, fix=fix)


# By the lengths of the file alone


def body_clearance(design: WideSwingDesign) -> Iterator[Check]:
    """GL302 of what the lengths alone place."""
    spec, section = design.spec, design.section
    own, cam = rocker_axis(section), cam_axis(section)
    unloader = spec.unloader
    if unloader.type != "gravity":
        least = device_room(unloader.pivot_ratio, design.motion.swing) * unloader.arm
        advice = f"set unloader.arm to at least {safely_above(own.radius * unloader.arm / least)} mm" if least else ""
        yield from beside("the device", own, least, advice)
    if spec.slider is not None:
        advice = "turn slider.middle_angle"
        room = rod_room(design.motion.slider.drive, design.motion.swing, 0j)
        yield from beside("the slider's rod", own, room, advice)
    if spec.layout == "twin-rocker":
        arm = design.even_cam.rocker_radius
        room = swept_room(arm, math.pi, design.motion.swing, section.center_distance)
        yield from beside("the arm of the internal profile's roller", cam, room, _NOT_OVER)
    if spec.drive is not None:
        yield from _drive(design, cam)


_NOT_OVER = "set a larger cam.center_distance, or reduce the swing"


def _drive(design: WideSwingDesign, cam: Axis) -> Iterator[Check]:
    """The crank-rocker that carries the cam: pin C and the coupler beside the cam shaft, the crank's axis A."""
    bar, roller = design.motion.drive.linkage, design.section.roller_radius
    longer = f"set drive.rocker to at least {safely_above(cam.radius)} mm, the other links in proportion"
    if bar.rocker < cam.radius:
        yield from beside("pin C of the drive", cam, bar.rocker, longer)
    else:
        advice = "lengthen the links of the drive"
        yield from beside("the coupler of the drive", cam, coupler_room(bar), advice)
    advice = "lengthen drive.frame, the other links in proportion"
    if bar.frame < cam.radius:
        yield from beside("the crank's axis", cam, bar.frame, advice, _ONE_ENDS)
        return
    room = bar.frame - disc_radius(design)
    for check in over_axis_check(SHAFT_CLEARANCE, "cam", room, roller, "the crank's axis", advice):
        yield check._replace(name=CHECK)


def disc_radius(design: WideSwingDesign) -> float:
    """Maximum radius of the oscillating cam [mm]."""
    cam = design.cam
    if not design.has_profile:
        return cam.end_radius - cam.roller_radius
    (first, _), (_, last) = cam.contact
    return float(np.abs(cam.points(np.array([first, last])).profile).max())


# Where the section `loads` says which way a body stands


def placed_clearance(loads: WideSwingLoads) -> Iterator[Check]:
    """GL302 of what the directions of the section `loads` place beside the cam shaft, or beside D."""
    section, design = loads.section, loads.design
    cam, swing = cam_axis(design.section), design.motion.swing
    reach = design.section.center_distance
    toward = 0.0 if design.spec.layout != "twin-rocker" else math.pi  # direction from D to O
    unloader = design.spec.unloader
    if section.device_direction is not None and unloader.type != "gravity":
        aside = toward - math.radians(section.device_direction)
        advice = _KEEPS_CLEAR.format("device")
        place = cmath.rect(reach / unloader.arm, aside)
        room = unloader.arm * _device_from(unloader.pivot_ratio, swing, place)
        yield from beside("the device", cam, room, advice)
        yield from beside("the device's arm", cam, swept_room(unloader.arm, aside, swing, reach), advice)
    if section.slider_direction is not None and design.spec.slider is not None:
        aside, drive = toward - math.radians(section.slider_direction), design.motion.slider.drive
        advice = _KEEPS_CLEAR.format("slider")
        yield from beside("the slider's rod", cam, rod_room(drive, swing, cmath.rect(reach, aside)), advice)
        room = swept_room(drive.crank, aside - drive.middle_angle, swing, reach)
        yield from beside("the slider's arm", cam, room, advice)
    if section.drive_direction is not None and design.spec.drive is not None:
        advice = _KEEPS_CLEAR.format("drive")
        for name, room in _drive_rooms(loads).items():
            yield from beside(f"the {name} of the drive", rocker_axis(design.section), room, advice)


def _drive_rooms(loads: WideSwingLoads) -> dict[str, float]:
    """Minimum distances of crank and coupler from the rocker's axis over a revolution [mm]."""
    lengths = {"crank": loads.design.motion.drive.linkage.crank, "coupler": loads.design.motion.drive.linkage.coupler}

    def distance(name: str, phi: Reals) -> Reals:
        at = loads.machine.at(phi).links
        start, end = (at[name].at(place).value for place in (0j, lengths[name]))
        return beside_line(at["rocker"].origin.value, start, end)

    return {name: _least(lambda phi, name=name: distance(name, phi), 0.0, math.tau) for name in lengths}  # type: ignore[misc]


# Distances


def _least(distance: Callable[[Reals], Reals], start: float, end: float) -> float:
    return minimum_over(distance, start, end, samples=256).value


def device_room(ratio: float, swing: float) -> float:
    """Minimum distance of the device from the rocker's axis over the swing, in arms.

    1 while cos(phi) > 1/lambda, then lambda sin(phi)/l, which falls

    Example
        >>> device_room(2.6, math.radians(120.0)), round(device_room(4.0, math.radians(240.0)), 6)
        (1.0, 0.755929)
    """
    half = 0.5 * swing
    if math.cos(half) >= 1.0 / ratio:
        return 1.0
    return ratio * math.sin(half) / math.sqrt(1.0 + ratio * ratio - 2.0 * ratio * math.cos(half))


def _device_from(ratio: float, swing: float, place: complex) -> float:
    """Minimum distance of the device from a place, in arms from D, the base pin on the real axis."""
    return _least(lambda phi: beside_line(place, np.exp(1j * phi), complex(ratio)), -0.5 * swing, 0.5 * swing)


def rod_room(drive: SliderDrive, swing: float, place: complex) -> float:
    """Minimum distance of a slider's rod from a place over the swing [mm].

    Parameters
        swing : float [rad]
        place : complex [mm] - from D, the direction in which the slider is farthest being real
    Example
        >>> from gearlink.core.machines.wide_swing.slider import SliderDrive
        >>> drive = SliderDrive(crank=150.0, rod=450.0, middle_angle=math.radians(150.0))
        >>> round(rod_room(drive, math.radians(120.0), 0j), 9)
        0.0
    """

    def distance(phi: Reals) -> Reals:
        pin = drive.crank * unit_vector(phi + drive.middle_angle)
        end = np.asarray(drive.depth(phi)[0] - 1j * drive.offset, dtype=np.complex128)
        return beside_line(place, pin, end)

    return _least(distance, -0.5 * swing, 0.5 * swing)


def swept_room(length: float, aside: float, swing: float, reach: float) -> float:
    """Minimum distance of a lever of the rocker from a point, 0 where it passes over it [mm].

    Parameters
        length : float [mm] - of the lever
        aside : float [rad] - of the point, from the lever's direction at mid-swing
        swing : float [rad]
        reach : float [mm] - of the point from D
    Example
        >>> round(swept_room(200.0, math.pi, math.radians(270.0), 150.0), 6), swept_room(100.0, 0.0, 2.0, 150.0)
        (106.066017, 50.0)
    """
    return beside_turning_arm(cmath.rect(reach, aside), cmath.rect(length, -0.5 * swing), swing).distance


def coupler_room(bar: FourBar) -> float:
    """Minimum distance of a crank-rocker's coupler from the pivot of its rocker: where the crank points to that [mm].

    l4 sin(mu_min), mu_min there the angle of coupler and rocker; l4 where that is blunt, l1 - l2 beyond the crank's pin

    Notes
        The distance grows with mu in all three cases, and mu with the distance of crank pin and pivot. In a
        crank-rocker mu_min is above 0: what is kept from below 0 under the root is rounding.
    Example
        >>> from gearlink.core.parts.linkages.fourbar.position import FourBar
        >>> round(coupler_room(FourBar(crank=40.0, coupler=400.0, rocker=96.0, frame=409.0)), 6)
        86.653107
    """
    near = bar.frame - bar.crank
    cosine = (bar.coupler**2 + bar.rocker**2 - near**2) / (2.0 * bar.coupler * bar.rocker)
    if bar.rocker * cosine >= bar.coupler:
        return near
    return bar.rocker * (math.sqrt(max(0.0, 1.0 - cosine * cosine)) if cosine > 0.0 else 1.0)
