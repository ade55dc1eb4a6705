"""Checks of a whole cycle: the joints of its contours, the roller in the free sectors, two profiles on one body."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import NO_NUMBER, Check, Shown, Status, safely_below
from gearlink.core.base.wording import short
from gearlink.core.machines.wide_swing import codes
from gearlink.core.parts.cams import codes as cams

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.cams.closed_cam import ClosedCam
    from gearlink.core.machines.wide_swing.design import WideSwingDesign

_CUT = 1e-7
"""Cut, in roller radii, that rounding and the search of the nearest place leave of none."""


def cycle_angles(design: WideSwingDesign) -> Iterator[Check]:
    """GL510 of a whole cycle, whose angles fill the turn: rests of no length, and the stroke that sizes the device."""
    section = design.spec.cycle
    assert section is not None, "needed where there is a cycle"
    working, far, back, near = section.lengths
    aside = f"strokes {short(working)} and {short(back)} deg, dwells {short(far)} and {short(near)} deg"
    for name, rest in (("far_dwell", far), ("near_dwell", near)):
        if rest == 0.0:
            what, fix = (
                f"no {name.replace('_', ' ')}: two concave flanks of each cam meet in an edge",
                f"set cycle.{name} above 0",
            )
            yield codes.CYCLE_ANGLES.check("warn", what, rest, 0.0, "deg", shown=NO_NUMBER, aside=aside, fix=fix)
    note = ""
    if working != back:
        longer, reserve = "working" if working > back else "return", design.cycle.longer_stroke_reserve
        note = (
            f"the balancing device is sized for the shorter stroke: force reserve {short(100.0 * (reserve or 0.0))} %"
        )
        note += f" in the {longer} stroke"
    if far > 0.0 and near > 0.0:
        whole = working + far + back + near
        what = "angles of strokes and dwells"
        yield codes.CYCLE_ANGLES.check("pass", what, whole, 360.0, "deg", side="", aside=aside, note=note)


def _contours(design: WideSwingDesign) -> list[tuple[str, ClosedCam]]:
    """The closed contours of the cams that have a profile."""
    try:
        found = list(design.cycle.contours.items())
        for _, cam in found:
            _ = cam.slot
    except NoSolution:
        # what is refused here fails in checks of its own
        return []
    return found


def acceleration_step(design: WideSwingDesign) -> Iterator[Check]:
    """GL404: at the joints of strokes and rests the tangent goes over, the rocker's acceleration jumps."""
    import numpy as np

    for words, cam in _contours(design):
        first, pace = cam.joints[0], design.spec.speed * math.tau / 60.0
        start = float(design.motion.plain_law.invariants(np.zeros(1), 2)[2][0])
        step = start * design.motion.swing * (pace / cam.own) ** 2
        what, aside = f"acceleration step of the rocker at the dwells of the {words}", "no velocity step"
        note = f"the radius of the pitch curve steps from {short(first.before)} to {short(first.after)} mm there"
        fix = "compute the vibration with the section shaft"
        yield cams.ACCELERATION_STEP.check("warn", what, step, 0.0, "rad/s^2", aside=aside, fix=fix, note=note)


def closed_contour(design: WideSwingDesign) -> Iterator[Check]:
    """GL512: the roller goes round each closed contour without a cut, and the contour does not cross itself."""
    from gearlink.core.parts.cams.checks import HUB

    shaft, clearance = design.section.shaft_radius, design.section.free_clearance
    for words, cam in _contours(design):
        cut, least = cam.cut, cam.least_radius
        if cut.depth > _CUT * cam.cam.roller_radius:
            what = f"cut of the roller into the contour of the {words}"
            at = f"cam angle {short(math.degrees(cut.cam_angle))} deg"
            fix, shown = "take a smaller cam.roller_radius", Shown(cut.depth, 0.0, "mm", "<=")
            yield codes.CLOSED_CONTOUR.check("fail", what, -cut.depth, 0.0, "mm", shown=shown, at=at, fix=fix)
        elif clearance >= cam.largest_clearance:
            most = cam.largest_clearance
            what = f"clearance of the roller in the free sector of the {words}"
            fix, shown = "take a smaller cam.roller_radius", NO_NUMBER
            if most > 0.0:
                fix, shown = f"set cam.free_clearance below {safely_below(most)} mm", Shown(clearance, most, "mm", "<=")
            else:
                what = f"the contour of the {words} crosses itself in its free sector"
            yield codes.CLOSED_CONTOUR.check("fail", what, clearance, most, "mm", shown=shown, fix=fix)
        elif least <= shaft:
            what, fix = f"minimum radius of the contour of the {words}", "set a larger cam.center_distance"
            yield codes.CLOSED_CONTOUR.check("fail", what, least, shaft, "mm", aside="shaft radius", fix=fix)
        elif cam.cam.sense > 0 and least < HUB * shaft and least < cam.cam.min_radius - cam.cam.roller_radius:
            what, shown = (
                f"minimum radius of the contour of the {words}",
                Shown(least, HUB * shaft, "mm", ">=", "recommended"),
            )
            aside, fix = f"{HUB:g} times the shaft radius", "set a smaller cam.free_clearance"
            yield codes.CLOSED_CONTOUR.check("warn", what, least, shaft, "mm", shown=shown, aside=aside, fix=fix)
        else:
            what = f"minimum radius of the contour of the {words}"
            yield codes.CLOSED_CONTOUR.check("pass", what, least, shaft, "mm")


def profile_planes(design: WideSwingDesign) -> Iterator[Check]:
    """GL513: whether the two profiles of a twin-rocker's cam can stand in one plane."""
    if not _contours(design):
        return
    room = design.cycle.plane_room
    if room is None:
        return
    status: Status = "pass" if room > 0.0 else "warn"
    what, overlap = "distance of the two profiles at the dwells", "overlap of the two profiles at the dwells"
    fix = "cut the profiles in two planes next to each other"
    yield codes.PROFILE_PLANES.check(status, what, room, 0.0, "mm", overlap=overlap, fix=fix)
