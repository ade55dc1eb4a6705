"""The scene of a cylindrical cam: its track on the development of the bottom runs past the roller."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes import of_motion
from gearlink.cli.views.scenes.colors import BLUE, ORANGE, pale
from gearlink.cli.views.scenes.scene import Body, Chain, Mark, Reals, Scene, track, wheel

if TYPE_CHECKING:
    from gearlink.core.machines.cylindrical_cam.design import CylindricalCamDesign

_TURN = 2.0 * math.pi
_STEM = 3.0
"""Radii of the roller that the follower's rod is drawn."""


def build(design: CylindricalCamDesign, fraction: Reals) -> Scene:
    """Positions over fractions of a turn of the cam; the track is drawn over three turns, so that it never ends."""
    scene, drum = of_motion.build(design, fraction), design.drum
    phi = np.linspace(-_TURN, 2.0 * _TURN, 1081)
    upper, lower = (
        -drum.sense * arc + 1j * along for arc, along in (drum.developed(drum.bottom, s, phi) for s in (1, -1))
    )
    outline = np.concatenate((upper, lower[::-1], upper[:1]))
    place = track(drum.sense * drum.bottom * _TURN * fraction + 0j, fraction)
    level, center = np.zeros_like(fraction), 1j * design.follower_motion.evaluate(_TURN * fraction, 0)[0]
    parts = (
        Body(outline=outline, place=place, turn=level, color=BLUE, fill=pale(BLUE, 0.15), width=1.4),
        wheel(center, drum.roller_radius, fraction, color=ORANGE, fill=pale(ORANGE, 0.3)),
        Chain(joints=(center, center + _STEM * 1j * drum.roller_radius), marked=False),
    )
    return replace(scene, parts=parts, marks=(Mark(center),))
