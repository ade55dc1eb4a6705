"""What the errors of a wide swing move."""

from __future__ import annotations

import cmath
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.mechanism.dual import Shift, longer
from gearlink.core.mechanism.joints import SharedContact
from gearlink.core.mechanism.links import FRAME
from gearlink.core.studies.register.movable import Movable
from gearlink.core.studies.tolerance.sources import CAM_PROFILE, ROLLER_ARM

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
    rocker = mechanism.links["rocker"]
    (contact,) = (each for each in mechanism.connections if each.name == "roller")
    assert isinstance(contact, SharedContact), "of a machine with a cam"
    arm = complex(((contact.at - rocker.origin.value) * np.conj(rocker.unit))[0])
    sizes: dict[str, tuple[Shift, ...]] = {
        "cam.center_distance": farther,
        "centers.cam": farther,
        CAM_PROFILE: outwards,
        "cam.roller_radius": outwards,
    }
    others = {CAM_PROFILE: 0.0}
    if design.spec.layout != "twin-rocker" or design.spec.cycle is None:  # else there are two, that point apart
        sizes[ROLLER_ARM] = (Shift("rocker", ("roller",), arm / abs(arm)),)
        others[ROLLER_ARM] = design.cam.rocker_radius
    if design.section.second is not None:  # each cam shaft stands at its own distance
        sizes["cam.center_distance"] = sizes["centers.cam"] = (Shift(FRAME, ("O",), 1.0),)
        if "return_cam" in mechanism.links:
            toward = cmath.rect(1.0, design.shafts.roller_arm_angle)
            sizes["cam.second.center_distance"] = (Shift(FRAME, ("O_return",), toward),)
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


def _dwells(design: WideSwingDesign) -> dict[str, tuple[float, float]]:
    """The far dwell of a cycle, where the arc of the working cam holds the rocker; its errors do not change there."""
    if design.spec.cycle is None:
        return {}
    working, far, _, _ = design.motion.cycle_angles
    return {} if far == 0.0 else {"dwell": (working + 0.5 * far, working + 0.5 * far)}
