"""What the errors of a wide swing move."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.mechanism.dual import Shift, longer
from gearlink.core.mechanism.links import FRAME
from gearlink.core.studies.register.movable import Errors, Movable
from gearlink.core.studies.tolerance.sources import CAM_PROFILE, RETURN_ARM, ROLLER_ARM

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.design import WideSwingDesign
    from gearlink.core.mechanism.links import Mechanism


def errors(design: WideSwingDesign, mechanism: Mechanism) -> Movable:
    """The distance of the axes, the cam's profile, the roller and its arm, and the play of the roller on its pin."""
    if design.spec.cam is None:
        return Movable()
    away = float(mechanism.links["rocker"].origin.value[0].real)
    farther = (Shift(FRAME, ("D",), 1.0 if away > 0.0 else -1.0),)
    outwards = (Shift("rocker", ("roller",), -1.0, "normal"),)  # as if the roller stood nearer to its cam
    sizes: dict[str, tuple[Shift, ...]] = {
        "cam.center_distance": farther,
        "centers.cam": farther,
        CAM_PROFILE: outwards,
        "cam.roller_radius": outwards,
    }
    others = {CAM_PROFILE: 0.0}
    if design.spec.layout != "twin-rocker" or design.spec.cycle is None:  # else there are two, that point apart
        sizes[ROLLER_ARM] = (Shift("rocker", ("roller",), 1.0, "arm"),)
        others[ROLLER_ARM] = design.cam.rocker_radius
    if design.section.second is not None:
        sizes |= _shafts(design, mechanism)
        others[RETURN_ARM] = design.shafts.cams[1].rocker_radius
    if "crank" in mechanism.links:
        bar = design.motion.drive.linkage
        sizes |= longer(mechanism, {"drive.crank": ("crank", bar.crank), "drive.coupler": ("coupler", bar.coupler)})
    return Movable(
        sizes,
        {"cam": abs(away)},
        others=others,
        pins={"roller": (Shift("rocker", ("roller",), 1.0, "frame"),)},
        rollers=("roller",),
        radius=design.spec.output_radius or 0.0,
        places=_dwells(design),
    )


def _shafts(design: WideSwingDesign, mechanism: Mechanism) -> Errors:
    """Of two cam shafts: each has its own distance from the rocker's axis and its own arm with a roller."""
    sizes: dict[str, tuple[Shift, ...]] = dict.fromkeys(
        ("cam.center_distance", "centers.cam"), (Shift(FRAME, ("O",), 1.0),)
    )
    if "return_cam" not in mechanism.links:
        return sizes
    _, second = design.shafts.shafts
    per_degree = 1j * math.radians(1.0) * second
    # a longer arm is the same as a cam that stands back along it
    return sizes | {
        "cam.second.center_distance": (Shift(FRAME, ("O_return",), second / abs(second)),),
        "cam.second.direction": (Shift(FRAME, ("O_return",), per_degree),),
        ROLLER_ARM: (Shift("cam", ("roller",), -1.0, "arm"),),
        RETURN_ARM: (Shift("return_cam", ("roller",), -1.0, "arm"),),
    }


def _dwells(design: WideSwingDesign) -> dict[str, tuple[float, float]]:
    """The far dwell of a cycle, where the arc of the working cam holds the rocker; its errors do not change there."""
    if design.spec.cycle is None:
        return {}
    working, far, _, _ = design.motion.cycle_angles
    return {} if far == 0.0 else {"dwell": (working + 0.5 * far, working + 0.5 * far)}
