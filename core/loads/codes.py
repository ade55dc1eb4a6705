"""Codes of the checks of `loads`, each with what it says and what to do."""

from __future__ import annotations

from gearlink.core.report import Rule

POWER_IDENTITY = Rule(
    "GL601",
    "power identity",
    "The input torque by virtual power and that by the forces of all joints differ.",
    "Both follow from the same links; where they differ, none of the forces can be trusted.",
    "Move the mechanism away from a dead point: near one the forces grow beyond all digits.",
    "|M_NE - M_VP| <= 1e-9 max |M|",
    "virtual power against Newton and Euler",
    checks=("power-identity",),
    keys=("loads",),
)
