"""The rules of studies: what can be wrong with one, and what is found in its result."""

from __future__ import annotations

from gearlink.core.base.report import Rule

FEASIBLE = Rule(
    "GL161",
    "few designs satisfy everything",
    "Less than one in a hundred of a study's designs satisfies all checks and conditions (a warning), or none does (a "
    "failure).",
    "A front of few designs says more of the conditions than of the objectives.",
    "Look at the table why: which check or condition alone removes the most, and how near the nearest design comes.",
    "designs that satisfy everything over all designs, 1 %",
    "own choice",
    ("feasible-designs",),
    ("where", "checks", "variables"),
)
RANGE_END = Rule(
    "GL162",
    "best designs at the end of a range",
    "Designs of the front have a variable at an end of its range.",
    "Beyond it there may be better ones.",
    "Widen the range, unless the end is one that the machine sets.",
    "the variable equals from or to",
    "own choice",
    ("range-end",),
    ("variables",),
    side="",
)
