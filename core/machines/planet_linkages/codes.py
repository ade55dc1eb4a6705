"""The rules that the checks of the two-gear four-bar judge by."""

from __future__ import annotations

from gearlink.core.base.report import Rule

DWELL_CONDITION = Rule(
    "GL306",
    "output does not make the required motion",
    "The output of a two-gear four-bar dwells where coupler and crank have a certain speed ratio; the links "
    "reach it, or do not, against what `target.motion` says.",
    "With a sun on a crank-rocker the output never dwells: the coupler would have to turn faster than the crank.",
    "Change z5/z2 beyond the limit named, take a ring gear, or a drag link; a momentary dwell has one frame: `synth "
    "momentary-dwell` finds it.",
    "w2/w1 = 1 + z5/z2 (sun), 1 - z5/z2 (ring gear): the line CD passes through the pitch point on AB",
    "thesis 2.2.1; the limit for a crank-rocker is an own derivation",
    ("dwell-condition",),
    ("target.motion", "gears", "links"),
    side="",
)
