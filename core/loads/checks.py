"""The checks of `loads`, in the order of their codes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.loads.codes import POWER_IDENTITY
from gearlink.core.report import Check

if TYPE_CHECKING:
    from gearlink.core.loads.design import LoadsDesign

CHECKS = ("power-identity",)
_IDENTITY = 1e-9


def power_identity(design: LoadsDesign) -> Check:
    """GL601."""
    found = design.power_identity
    text = f"the input torque by virtual power and by the joint forces differ by {found:.1e} of the largest"
    if found <= _IDENTITY:
        return POWER_IDENTITY.check("pass", text, found, _IDENTITY)
    return POWER_IDENTITY.check("fail", f"{text}: the links come too near to a dead point", found, _IDENTITY)
