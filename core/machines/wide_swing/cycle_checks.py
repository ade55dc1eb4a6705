"""Checks of a whole cycle: the joints of its contours, the roller in the free sectors, two profiles on one body."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Check, safely_below
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
    assert section is not None, "asked for where there is a cycle"
    working, far, back, near = section.lengths()
    text = f"the strokes take {working:g} and {back:g} deg of the cam's turn, the rests {far:g} and {near:g} deg"
    for name, rest in (("far_dwell", far), ("near_dwell", near)):
        if rest == 0.0:
            words = f"{text}: without a rest two hollows of each cam meet in an edge; make cycle.{name} above 0"
            yield codes.CYCLE_ANGLES.check("warn", words, rest, 0.0, "deg")
    if working != back:
        longer = "working" if working > back else "return"
        text += (
            f"; the device is sized by the shorter stroke, whose free swing it sets: in the {longer} stroke it has "
            f"{design.cycle.longer_stroke_reserve:.4g} of the force that balances it to spare, the reserve counted"
        )
    if far > 0.0 and near > 0.0:
        yield codes.CYCLE_ANGLES.check("pass", text, working + far + back + near, 360.0, "deg")


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
        text = (
            f"where the {words} joins rest and stroke the radius of its pitch curve jumps from {first.before:.5g} to "
            f"{first.after:.5g} mm and the rocker's acceleration by {step:.4g} rad/s^2; the tangent has no corner: "
            "judge the shock in the section shaft"
        )
        yield cams.ACCELERATION_STEP.check("warn", text, step, 0.0, "rad/s^2")


def closed_contour(design: WideSwingDesign) -> Iterator[Check]:
    """GL512: the roller goes round each closed contour without a cut, and the contour does not cross itself."""
    from gearlink.core.parts.cams.checks import HUB

    shaft, clearance = design.section.shaft_radius, design.section.free_clearance
    for words, cam in _contours(design):
        cut, least = cam.cut, cam.least_radius
        if cut.depth > _CUT * cam.cam.roller_radius:
            places = [math.degrees(angle) for angle in (cut.roller_angle, cut.cam_angle)]
            text = (
                f"the roller at {places[0]:.4g} deg from the start of the stroke of the {words} cuts {cut.depth:.4g} "
                f"mm into its contour at {places[1]:.4g} deg: take a smaller cam.roller_radius"
            )
            yield codes.CLOSED_CONTOUR.check("fail", text, -cut.depth, 0.0, "mm")
        elif clearance >= cam.largest_clearance:
            most = cam.largest_clearance
            text = (
                f"in the free sector of the {words} the contour crosses itself, for it keeps more from the roller's "
                "path than the path's curvature radius: take "
                + (f"cam.free_clearance below {safely_below(most)} mm or " if most > 0.0 else "")
                + "a smaller cam.roller_radius"
            )
            yield codes.CLOSED_CONTOUR.check("fail", text, clearance, most, "mm")
        elif least <= shaft:
            text = (
                f"the contour of the {words} comes to {least:.4g} mm from the cam axis, into the shaft of radius "
                f"{shaft:g} mm: take less cam.free_clearance or a larger cam.center_distance"
            )
            yield codes.CLOSED_CONTOUR.check("fail", text, least, shaft, "mm")
        elif cam.cam.sense > 0 and least < HUB * shaft and least < cam.cam.min_radius - cam.cam.roller_radius:
            text = (
                f"in its free sector the contour of the {words} leaves {least - shaft:.4g} mm round the shaft, radius "
                f"{shaft:g} mm, whose hub of {HUB:g} times the shaft takes {(HUB - 1.0) * shaft:.4g} mm: take less "
                "cam.free_clearance, a larger cam.center_distance or a thinner shaft"
            )
            yield codes.CLOSED_CONTOUR.check("warn", text, least, shaft, "mm")
        else:
            text = f"the contour of the {words} clears the roller, by {clearance:g} mm in its free sector"
            yield codes.CLOSED_CONTOUR.check("pass", text, least, shaft, "mm")


def profile_planes(design: WideSwingDesign) -> Iterator[Check]:
    """GL513: whether the two profiles of a twin-rocker's cam can stand in one plane."""
    if not _contours(design):
        return
    room = design.cycle.plane_room
    if room is None:
        return
    text = f"between the rests of the external and the internal profile {room:.4g} mm are left"
    if room <= 0.0:
        back = design.cycle.back.cam
        roller = 0.5 * (room + 2.0 * back.roller_radius)
        text += ": cut the profiles into two planes beside each other"
        text += f", or take rollers below {safely_below(roller)} mm" if roller > 0.0 else ""
    yield codes.PROFILE_PLANES.check("pass" if room > 0.0 else "warn", text, room, 0.0, "mm")
