"""The rules that the checks of cycloidal reducers alone judge by."""

from __future__ import annotations

from gearlink.core.base.report import Rule

INTERFERENCE = Rule(
    "GL342",
    "interference of disc and pins",
    "The modification of the profile leaves less than no gap between disc and pins somewhere on the flank.",
    "The disc cannot be put into the ring, or jams in it.",
    "Grind off more (modification.offset), or raise the pin circle that it is ground for less.",
    "gap = dr - dR (1 - K cos u)/Q >= 0 for 0 < u < 180 deg, Q = sqrt(1 + K^2 - 2 K cos u)",
    "own derivation",
    ("interference",),
    ("modification.offset", "modification"),
)
SHORTENING = Rule(
    "GL343",
    "shortening coefficient out of the usual range",
    "The eccentricity is small or large for this pin circle (a warning).",
    "Below 0.4 the pressure angles are large and so are pin and bearing forces; above 0.8 the flanks bend sharply and "
    "are near to undercut.",
    "Choose the eccentricity so that K = e Z/R lies between 0.4 and 0.8.",
    "K = e Z/R, 0.4 <= K <= 0.8",
    "usual practice of pin-gear drives",
    ("shortening",),
    ("eccentricity", "pin_circle_radius", "pins"),
    side="",
)
