"""Involute gears: single tooth, pair, mesh, true profile, checks and remedies.

A package a subject: `tooth`, `mesh`, `outline`, `rating`, `measures`, `shifts`, `train`, and the `keys` of design
files; `rack` is a gear on a rack. Begin with `mesh.pair` (a gear pair as a record).
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gearlink.core.parts.gears.mesh.pair import GearPair as GearPair

_PLACES = {"GearPair": "mesh.pair"}


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_PLACES[name]}"), name)
