"""Disc cams of a scene."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes.colors import pale
from gearlink.cli.views.scenes.scene import TURN, Body, Points, Reals

if TYPE_CHECKING:
    from gearlink.core.parts.cams.disc_cam import DiscCam

_POINTS = 720


def disc_cam(cam: DiscCam, axis: Points, turn: Reals, color: str) -> Body:
    """A cam whose place at cam angle 0 is its own frame; `turn` counts counter-clockwise."""
    profile = cam.points(TURN * np.arange(_POINTS + 1) / _POINTS)[1]
    profile[-1] = profile[0]
    return Body(outline=profile, place=axis, turn=turn, color=color, fill=pale(color), name=cam.name)
