"""The checks of a disc cam."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.report import Check, Status, safely_above
from gearlink.core.machines.disc_cam import codes
from gearlink.core.parts.cams.checks import hub_checks, undercut_checks
from gearlink.core.parts.cams.codes import (
    CAM_UNDERCUT,
    CONSTANT_SUM,
    LIFT_OFF,
    PRESSURE_ANGLE,
)
from gearlink.core.parts.linkages.codes import SHAFT_CLEARANCE

if TYPE_CHECKING:
    from gearlink.core.machines.disc_cam.design import DiscCamDesign

_FIT = 1e-9  # deg: a cam that is sized lies on its limit
_RESERVE = 1.1
_LARGER = "enlarge the cam, or give the motion more cam angle"


def pressure_angle(design: DiscCamDesign) -> Iterator[Check]:
    """GL401 of the stroke that is nearest to its limit."""
    rise, back = design.spec.pressure_limits()
    found = [(design.pressure_angle_rise, rise, "rise"), (design.pressure_angle_return, back, "return")]
    found.append((design.cams.most_in_strokes(0), max(rise, back), "dwell"))
    known = [(math.degrees(value), limit, stroke) for value, limit, stroke in found if value is not None]
    value, limit, stroke = max(known, key=lambda each: each[0] - each[1])
    over = value > limit + _FIT
    text = f"the pressure angle of the {stroke} reaches {value:.6g} deg"
    text += f", above the limit {limit:g} deg: {_LARGER}" if over else ""
    yield PRESSURE_ANGLE.check("fail" if over else "pass", text, value, limit, "deg")


def cam_undercut(design: DiscCamDesign) -> Iterator[Check]:
    """GL402: roller against the pitch curve, or the profile under a flat face."""
    if not design.spec.is_flat:
        cams = [cam for cam in (design.cams.main, design.cams.back) if cam is not None]
        yield from undercut_checks(cams, plainly=_LARGER)
        return
    least, limit = design.cams.flat.min_curvature_radius, design.spec.limits.curvature_radius
    size = design.spec.cam.size
    if size is not None and size.curvature_radius is not None and "curvature_radius" not in _given(design):
        limit = 0.0
    room = 1e-9 * max(limit, abs(least.value))
    status: Status = "fail" if least.value <= 0.0 else "warn" if least.value < limit - room else "pass"
    text = (
        f"least curvature radius {least.value:.6g} mm of the profile at cam angle {math.degrees(least.place):.5g} deg"
    )
    if status != "pass":
        text += f": raise cam.base_radius by {max(limit, 0.0) - least.value:.4g} mm or more"
    yield CAM_UNDERCUT.check(status, text, least.value, limit, "mm", side=">=")


def _given(design: DiscCamDesign) -> set[str]:
    return set(design.spec.limits.model_fields_set)


def shaft_clearance(design: DiscCamDesign) -> Iterator[Check]:
    """GL302: the profile against its shaft."""

    def farther(by: float) -> str:
        return f"set the base circle {by:.4g} mm or more larger"

    yield from hub_checks(SHAFT_CLEARANCE, design.profiles, design.spec.cam.shaft_radius, farther)


def constant_sum(design: DiscCamDesign) -> Iterator[Check]:
    """GL405 of the two rollers of a slide: they stand on either side of the cam axis at their distance."""
    import numpy as np

    cams = design.cams
    if cams.back is None or design.spec.oscillates:
        return
    phi = np.radians(np.arange(0.0, 360.0, 1.0))
    lift, distance = cams.motion.evaluate(phi, 0)[0], cams.roller_distance
    # along the travel: with an offset the radii themselves do not add up
    along = np.abs(cams.start_height + lift) + np.abs(cams.start_height + lift - distance)
    off, limit = float(np.abs(along - distance).max()), 1e-9 * distance
    text = f"the rollers stand {distance:.6g} mm apart on both sides of the cam axis within {off:.2g} mm"
    if off > limit:
        text += ": the return roller would pass the cam axis; raise return_roller.distance"
    yield CONSTANT_SUM.check("fail" if off > limit else "pass", text, off, limit, "mm")


def face_length(design: DiscCamDesign) -> Iterator[Check]:
    """GL408, where the file gives the face."""
    face = getattr(design.spec.follower, "face", None)
    if face is None:
        return
    low, high = design.cams.flat.contact_places
    least, most = (face[0], face[1]) if design.spec.oscillates else (-face[0], face[1])
    beyond = max(least - low, high - most)
    text = f"the contact runs from {low:.6g} to {high:.6g} mm on a face from {least:g} to {most:g} mm"
    if beyond > 1e-9:
        yield codes.FACE_LENGTH.check("fail", f"{text}: {beyond:.4g} mm are missing", beyond, 0.0, "mm")
    else:
        yield codes.FACE_LENGTH.check("pass", text, beyond, 0.0, "mm")


def outer_wall(design: DiscCamDesign) -> Iterator[Check]:
    """GL409 of a groove."""
    if design.spec.closure != "groove":
        return
    roller, hollow = design.cams.main.roller_radius, design.cams.hollow
    if hollow is None:
        yield codes.OUTER_WALL.check("pass", "the pitch curve is convex: the outer wall is whole", 0.0, roller, "mm")
        return
    least = hollow[0] - roller
    place = f"{math.degrees(hollow[1]):.5g} deg"
    text = f"roller radius {roller:g} mm against the least hollow radius {least:.6g} mm at {place}"
    status: Status = "fail" if roller >= least else "pass"
    if status == "fail":
        text += f": {_LARGER}, or take a smaller roller"
    yield codes.OUTER_WALL.check(status, text, roller, least, "mm")


def cutter_radius(design: DiscCamDesign) -> Iterator[Check]:
    """GL410, where the file gives the cutter."""
    cutter = design.spec.cam.cutter_radius
    if cutter is None:
        return
    found = design.min_concave_radius
    least = min((each for each in (found if isinstance(found, list) else [found]) if each is not None), default=None)
    if least is None:
        yield codes.CUTTER_RADIUS.check(
            "pass", "the profile has no hollow flank: any cutter serves", cutter, None, "mm"
        )
        return
    text = f"cutter radius {cutter:g} mm against the least hollow radius {least:.6g} mm of the profile"
    over = cutter >= least
    text += ": take a smaller cutter" if over else ""
    yield codes.CUTTER_RADIUS.check("fail" if over else "pass", text, cutter, least, "mm")


def lift_off(design: DiscCamDesign) -> Iterator[Check]:
    """GL406, where speed, mass and spring are given."""
    closing, spec = design.closing, design.spec
    found = closing.unloading
    if found is None or spec.speed is None:
        return
    speed = closing.lift_off_speed
    if speed is None:
        yield LIFT_OFF.check("pass", "no inertia ever unloads the follower", None, spec.speed, "1/min")
        return
    status: Status = "fail" if speed <= spec.speed else "warn" if speed < _RESERVE * spec.speed else "pass"
    text = f"the follower leaves its cam at {speed:.6g} 1/min, at cam angle {math.degrees(found.place):.5g} deg"
    if status != "pass":
        more = safely_above(closing.preload_for(_RESERVE * closing.speed), 5)
        text += f": raise spring.preload to {more} for a tenth of speed in reserve, or lower the speed"
    yield LIFT_OFF.check(status, text, speed, spec.speed, "1/min")
