"""What the errors of a disc cam move."""

from __future__ import annotations

import cmath
from typing import TYPE_CHECKING

from gearlink.core.mechanism.dual import Shift
from gearlink.core.mechanism.links import FRAME
from gearlink.core.studies.register.movable import Movable
from gearlink.core.studies.tolerance.sources import CAM_PROFILE

if TYPE_CHECKING:
    from gearlink.core.machines.disc_cam.design import DiscCamDesign
    from gearlink.core.mechanism.links import Mechanism


def errors(design: DiscCamDesign, _mechanism: Mechanism) -> Movable:
    """The cam's profile; of a roller its radius and the play of its pin; of a rocker arm and centre distance.

    The error of a follower that rocks is measured at its roller, or at register.radius under a face.
    """
    cams, outwards = design.cams, (Shift("cam", ("main",), 1.0, "normal"),)
    sizes: dict[str, tuple[Shift, ...]] = {CAM_PROFILE: outwards}
    if design.spec.is_flat:
        return Movable(sizes, others={CAM_PROFILE: 0.0})
    measured = design.kind == "measured-cam"
    sizes["roller_radius" if measured else "follower.roller_radius"] = outwards
    radius = 0.0
    if design.spec.oscillates:
        radius, away = float(cams.follower.arm), cmath.phase(cams.pivot)
        sizes["follower.arm"] = (Shift("follower", ("main",)),)
        if measured:
            sizes |= {f"follower.pivot[{i}]": (Shift(FRAME, ("A",), way),) for i, way in enumerate((1.0 + 0j, 1j))}
        else:
            sizes["follower.center_distance"] = (Shift(FRAME, ("A",), cmath.rect(1.0, away)),)
    else:
        sizes["follower.offset"] = (Shift(FRAME, ("guide",), -1j * cams.direction),)
    return Movable(
        sizes,
        others={CAM_PROFILE: 0.0},
        pins={"roller": (Shift("follower", ("main",), 1.0, "frame"),)},
        rollers=("roller",),
        radius=radius,
    )
