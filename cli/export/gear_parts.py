"""A gear's outline: involute flanks and trochoidal roots as the rack tool cuts them."""

from __future__ import annotations

import math

from gearlink.cli.export.contour import Circle, Part
from gearlink.cli.export.sampling import Points, Reals, Stretch
from gearlink.core.gears.pair import GearPair
from gearlink.core.gears.tooth_profile import Curve, ToothProfile

_NAMES = ("root circle", "trochoid", "involute", "tip circle")


def gear_of(pair: GearPair, number: int, name: str, title: str) -> Part:
    """Gear 0 or 1 of a pair, its first tooth space on the x axis.

    Raises
        NoSolution - where no involute is left between root and tip
    """
    profile = ToothProfile.of(pair, number)
    short = 1e-14 * profile.tip_radius
    stretches = tuple(
        _stretch(piece, curve, low, high)
        for piece, (curve, low, high) in zip(_NAMES, profile.pieces(), strict=True)
        if _length(curve, low, high) > short
    )
    return Part(
        name=name,
        title=title,
        stretches=stretches,
        closed=True,
        teeth=profile.teeth,
        circles=(
            Circle("REFERENCE_CIRCLE", profile.reference_radius),
            Circle("WORKING_CIRCLE", pair.working_radius[number]),
            Circle("BASE_CIRCLE", profile.base_radius),
        ),
        notes=_notes(pair, number, profile),
    )


def _stretch(name: str, curve: Curve, low: float, high: float) -> Stretch:
    def points(parameter: Reals) -> Points:
        row: Points = curve(parameter)[None, :]
        return row

    return Stretch(("PROFILE",), points, low, high, name, steps=1)


def _length(curve: Curve, low: float, high: float) -> float:
    import numpy as np

    ends = curve(np.array([low, high]))
    return float(abs(ends[1] - ends[0])) if high > low else 0.0


def _notes(pair: GearPair, number: int, profile: ToothProfile) -> tuple[str, ...]:
    helix = f", helix angle {math.degrees(pair.helix_angle):.9g} deg" if pair.helix_angle else ""
    section = "; transverse section" if pair.helix_angle else ""
    notes = [
        f"module {pair.module:g} mm, {profile.teeth} teeth, profile shift {profile.shift:.9g}, "
        f"pressure angle {math.degrees(pair.pressure_angle):.9g} deg{helix}",
        f"tip radius {profile.outer_radius:.9g} mm, root radius {profile.root_radius:.9g} mm, "
        f"tooth thickness on the reference circle (normal section) {pair.tooth_thickness[number]:.9g} mm",
        f"root cut by a rack tool with a tip rounding of {profile.tool_rounding:.6g} module; involute from "
        f"{profile.form_radius:.9g} mm" + (", undercut" if profile.undercut else ""),
        "no backlash: thin the teeth by the allowance that the drawing gives",
        f"frame: gear axis at the origin, middle of a tooth space on the x axis{section}",
    ]
    return tuple(notes)
