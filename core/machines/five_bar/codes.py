"""The rules that the checks of the geared five-bar judge by."""

from __future__ import annotations

from gearlink.core.base.report import Rule

CLOSURE = Rule(
    "GL305",
    "five-bar closes",
    "The two couplers reach from one geared link to the other at every input angle (a design that opens is refused "
    "with the worst angle).",
    "Where they do not reach, the mechanism cannot be put together or jams there.",
    "Lengthen coupler and follower together, make them more equal, or shorten the geared links.",
    "|b - c| < |BD| < b + c over the whole period; function form |c - e| < |CE| < c + e over the range",
    "own derivation",
    ("closure",),
    ("links", "range"),
)
