"""Cams of any machine: laws of motion, cam profiles for every follower, size, undercut, checks.

Begin with `laws` (law by name) and `profile` (one formulation of profile, pressure angle and curvature).
Nothing here knows a machine.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gearlink.core.parts.cams.disc_cam import DiscCam as DiscCam
    from gearlink.core.parts.cams.laws import law as law

_PLACES = {"DiscCam": "disc_cam", "law": "laws"}


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_PLACES[name]}"), name)
