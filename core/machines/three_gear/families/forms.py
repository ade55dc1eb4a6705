"""Which families of linkages a train has: with rings where a radius counts negative, else the plain ones."""

from __future__ import annotations

from typing import Any


def forms_for(*radii: float) -> Any:
    """The module of the families of a train: the one for rings where a radius is negative."""
    if min(radii) < 0.0:
        from gearlink.core.machines.three_gear.families import internal

        return internal
    from gearlink.core.machines.three_gear.families import external

    return external
