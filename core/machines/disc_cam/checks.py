"""The checks of a disc cam."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.report import NO_NUMBER, Check, Status, safely_above, safely_below
from gearlink.core.base.wording import short
from gearlink.core.parts.cams.checks import flat_undercut_check, hub_checks, undercut_checks
from gearlink.core.parts.cams.codes import (
    CONSTANT_SUM,
    CUTTER_RADIUS,
    FACE_LENGTH,
    LIFT_OFF,
    OUTER_WALL,
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
    status: Status = "fail" if over else "pass"
    yield PRESSURE_ANGLE.check(status, f"pressure angle of the {stroke}", value, limit, "deg", fix=_LARGER)


def cam_undercut(design: DiscCamDesign) -> Iterator[Check]:
    """GL402: roller against the pitch curve, or the profile under a flat face."""
    if not design.spec.is_flat:
        cams = [cam for cam in (design.cams.main, design.cams.back) if cam is not None]
        yield from undercut_checks(cams, plainly=_LARGER)
        return
    limit = design.spec.limits.curvature_radius
    size = design.spec.cam.size
    if size is not None and size.curvature_radius is not None and "curvature_radius" not in _given(design):
        limit = 0.0
    yield flat_undercut_check(design.cams.flat, limit, "raise cam.base_radius by {} mm")


def _given(design: DiscCamDesign) -> set[str]:
    return set(design.spec.limits.model_fields_set)


def shaft_clearance(design: DiscCamDesign) -> Iterator[Check]:
    """GL302: the profile against its shaft."""

    spec = design.spec
    key, radius = ("base_radius", design.base_radius) if spec.is_flat else ("prime_radius", design.prime_radius or 0.0)

    def farther(by: float) -> str:
        larger = safely_above(radius + by)
        if spec.cam.size is None:
            return f"set cam.{key} to {larger}"
        center, given = design.center_distance, getattr(spec.follower, "center_distance", None)
        pivot = (
            "" if given is not None or center is None else f", with follower.center_distance: {safely_above(center)}"
        )
        return f"replace cam.size by cam.{key}: {larger}{pivot}"

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
    what, aside = "deviation of the sum of the pitch radii", f"roller distance {short(distance)} mm"
    status: Status = "fail" if off > limit else "pass"
    fix = "raise return_roller.distance: the return roller passes the cam axis"
    yield CONSTANT_SUM.check(status, what, off, limit, "mm", aside=aside, fix=fix)


def face_length(design: DiscCamDesign) -> Iterator[Check]:
    """GL408, where the file gives the face."""
    face = getattr(design.spec.follower, "face", None)
    if face is None:
        return
    low, high = design.cams.flat.contact_places
    least, most = (face[0], face[1]) if design.spec.oscillates else (-face[0], face[1])
    beyond = max(least - low, high - most)
    aside = f"contact {short(low)} to {short(high)} mm, face {short(least)} to {short(most)} mm"
    what = "contact beyond the end of the face"
    if beyond > 1e-9:
        fix = f"lengthen follower.face by {safely_above(beyond)} mm"
        yield FACE_LENGTH.check("fail", what, beyond, 0.0, "mm", aside=aside, fix=fix)
    else:
        what = "the contact stays on the face"
        yield FACE_LENGTH.check("pass", what, beyond, 0.0, "mm", shown=NO_NUMBER, aside=aside)


def outer_wall(design: DiscCamDesign) -> Iterator[Check]:
    """GL409 of a groove."""
    if design.spec.closure != "groove":
        return
    roller, hollow = design.cams.main.roller_radius, design.cams.hollow
    if hollow is None:
        what = "the pitch curve is convex: the outer wall is whole"
        yield OUTER_WALL.check("pass", what, 0.0, roller, "mm", shown=NO_NUMBER)
        return
    least = hollow[0] - roller
    at = f"cam angle {short(math.degrees(hollow[1]))} deg"
    status: Status = "fail" if roller >= least else "pass"
    what = "roller radius against the minimum concave radius of the outer wall"
    yield OUTER_WALL.check(status, what, roller, least, "mm", at=at, fix=_LARGER)


def cutter_radius(design: DiscCamDesign) -> Iterator[Check]:
    """GL410, where the file gives the cutter."""
    cutter = design.spec.cam.cutter_radius
    if cutter is None:
        return
    found = design.min_concave_radius
    least = min((each for each in (found if isinstance(found, list) else [found]) if each is not None), default=None)
    if least is None:
        yield CUTTER_RADIUS.check(
            "pass", "the profile has no concave flank: any cutter fits", cutter, None, "mm", shown=NO_NUMBER
        )
        return
    what, aside = "cutter radius", "minimum concave radius of the profile"
    status: Status = "fail" if cutter >= least else "pass"
    fix = f"set cam.cutter_radius below {safely_below(least)} mm"
    yield CUTTER_RADIUS.check(status, what, cutter, least, "mm", fix=fix, aside=aside)


def lift_off(design: DiscCamDesign) -> Iterator[Check]:
    """GL406, where speed, mass and spring are given."""
    closing, spec = design.closing, design.spec
    found = closing.unloading
    if found is None or spec.speed is None:
        return
    speed = closing.lift_off_speed
    if speed is None:
        yield LIFT_OFF.check("pass", "no speed lifts the follower off its cam", None, spec.speed, "1/min")
        return
    status: Status = "fail" if speed <= spec.speed else "warn" if speed < _RESERVE * spec.speed else "pass"
    fix = ""
    if status != "pass":
        more = safely_above(closing.preload_for(_RESERVE * closing.speed))
        unit = "N m" if spec.oscillates else "N"
        fix = f"raise spring.preload to {more} {unit} (10 % speed margin)"
    at = f"cam angle {short(math.degrees(found.place))} deg"
    most = _RESERVE * spec.speed
    yield LIFT_OFF.check(
        status, "lift-off speed of the follower", speed, spec.speed, "1/min", recommended=most, at=at, fix=fix
    )
