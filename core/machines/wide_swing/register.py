"""What the errors of a wide swing move."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.mechanism.dual import Shift, longer
from gearlink.core.mechanism.links import FRAME
from gearlink.core.studies.register.movable import Movable
from gearlink.core.studies.tolerance.sources import CAM_PROFILE

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.design import WideSwingDesign
    from gearlink.core.mechanism.links import Mechanism


def errors(design: WideSwingDesign, mechanism: Mechanism) -> Movable:
    """The distance of the axes, the cam's profile and the roller, and the play of the roller on its pin."""
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
    if "crank" in mechanism.links:
        bar = design.motion.drive.linkage
        sizes |= longer(mechanism, {"drive.crank": ("crank", bar.crank), "drive.coupler": ("coupler", bar.coupler)})
    return Movable(
        sizes,
        {"cam": abs(away)},
        others={CAM_PROFILE: 0.0},
        pins={"roller": (Shift("rocker", ("roller",), 1.0, "frame"),)},
        rollers=("roller",),
        radius=0.0,
    )
