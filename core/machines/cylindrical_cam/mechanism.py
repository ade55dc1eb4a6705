"""The mechanism of a cylindrical cam on the development of its bottom: a track that runs by, and its follower."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.mechanism.courses import coordinate
from gearlink.core.mechanism.joints import Connection, Contact, Guide
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Input, Motion, Output
from gearlink.core.mechanism.rates import Point, standing

if TYPE_CHECKING:
    from gearlink.core.machines.cylindrical_cam.design import CylindricalCamDesign
    from gearlink.core.numerics.arrays import Reals


def motion(design: CylindricalCamDesign) -> Motion:
    """Links and joints over the cam angle: the drum's surface runs along x, the follower along y at x 0."""
    drum, law = design.drum, design.follower_motion

    def make(phi: Reals, order: int, side: int) -> Mechanism:
        still = np.zeros(phi.shape, dtype=np.complex128)
        way = [np.asarray(still + drum.sense * drum.bottom * phi), still + drum.sense * drum.bottom, still, still]
        lift = [np.asarray(1j * each, dtype=np.complex128) for each in law.evaluate(phi, order, side=side)]
        links = {
            "cam": Link(Point(*way[: order + 1]), standing(0.0, phi, order=order)),
            "follower": Link(Point(*lift), standing(0.0, phi, order=order)),
        }
        rate = 1j * law.evaluate(phi, 1, side=side)[1] - drum.sense * drum.bottom
        normal = np.asarray(-1j * drum.sense * rate / np.abs(rate), dtype=np.complex128)
        joints: list[Connection] = [
            Guide("drum", FRAME, "cam", links["cam"].origin.value, 1.0 + 0j),
            Guide("guide", FRAME, "follower", links["follower"].origin.value, 1j),
            Contact("roller", "cam", "follower", links["follower"].origin.value, normal),
        ]
        return Mechanism(links, joints, "cam", travel={"cam": 1.0 + 0j, "follower": 1j})

    joints = tuple(joint for joint in law.joints if joint > 0.0)
    return Motion(make, Input("cam_angle", joints=joints), (Output("Follower", coordinate("follower", along=1j)),))
