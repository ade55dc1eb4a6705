"""What the errors of a crank-rocker move."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.mechanism.dual import longer
from gearlink.core.mechanism.links import FRAME
from gearlink.core.studies.register.movable import Movable

if TYPE_CHECKING:
    from gearlink.core.machines.crank_rocker.design import CrankRocker
    from gearlink.core.mechanism.links import Mechanism


def errors(design: CrankRocker, mechanism: Mechanism) -> Movable:
    """The four links; the error is measured at the joint on the rocker where the file says nothing else."""
    bar = design.linkage
    ends = {f"links.{name}": (name, getattr(bar, name)) for name in ("crank", "coupler", "rocker")}
    return Movable(longer(mechanism, ends | {"links.frame": (FRAME, bar.frame)}), radius=bar.rocker)
