"""The rules that the checks of a planar mechanism judge by."""

from __future__ import annotations

from gearlink.core.base.report import Rule

ASSEMBLY = Rule(
    "GL318",
    "assembly far from the given start",
    "The direction of a link at input 0 is more than 45 deg off the rough one of `start`.",
    "The rough directions choose among the ways in which links can be put together: another one may be meant.",
    "Give the direction that is found, or that of the assembly that is meant; look at the figure (--plot).",
    "difference of directions; warns above 45 deg",
    "own derivation",
    ("assembly",),
    ("start",),
    side="<=",
)
