"""Outlines of gears, rings and racks as their tools cut them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from gearlink.cli.export.contour import Circle, Part
from gearlink.cli.export.sampling import Points, Reals, Stretch
from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.outline.rack_profile import RackProfile, straight
from gearlink.core.parts.gears.outline.ring_profile import RingProfile
from gearlink.core.parts.gears.outline.tooth_profile import Curve, ToothProfile
from gearlink.core.parts.gears.rack import RackMesh

_NAMES = ("root circle", "trochoid", "involute", "tip circle")
SENSES = {"right": 1.0, "left": -1.0}
"""Which way teeth of a hand turn on their way up the axis."""


def gear_of(
    pair: GearPair, number: int, name: str, title: str, width: float | None = None, hand: str = "right"
) -> Part:
    """Gear 0 or 1 of a pair, its first tooth space on the x axis; helical ones of a hand.

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
            Circle("TIP_CIRCLE", profile.outer_radius),
            Circle("ROOT_CIRCLE", profile.root_radius),
        ),
        notes=_notes(pair, number, profile, hand),
        width=width,
        twist=SENSES[hand] * math.tan(pair.helix_angle) / pair.reference_radius[number],
    )


def ring_of(mesh: GearPair, rim: float, name: str, title: str, width: float | None = None, hand: str = "right") -> Part:
    """The ring of a pair, the middle of a tooth space on the x axis, within its rim [mm]; helical ones of a hand.

    Raises
        NoSolution - where the ring's tips lie inside its base circle
    Notes
        Without its cutter the flanks are involutes down to the root circle: how a cutter rounds the root depends on it.
    """
    shape = RingProfile.of(mesh)
    return Part(
        name=name,
        title=title,
        stretches=tuple(
            _stretch(piece, curve, low, high)
            for piece, curve, low, high in shape.pieces()
            if _length(curve, low, high) > 1e-14 * shape.root
        ),
        closed=True,
        teeth=shape.teeth,
        circles=(
            Circle("REFERENCE_CIRCLE", shape.reference),
            Circle("BASE_CIRCLE", shape.base),
            Circle("TIP_CIRCLE", shape.tip),
            Circle("ROOT_CIRCLE", shape.deepest),
            Circle("RIM", rim),
        ),
        notes=_ring_notes(mesh, shape, rim),
        width=width,
        twist=SENSES[hand] * math.tan(mesh.helix_angle) / shape.reference,
        rim=rim,
    )


def _ring_notes(mesh: GearPair, shape: RingProfile, rim: float) -> tuple[str, ...]:
    section = "; transverse section" if shape.helical else ""
    root = "involute down to the root circle; the fillet there is the cutter's, which the file does not name"
    if shape.shaped is not None:
        cutter = shape.shaped.cutter
        root = (
            f"root shaped by a pinion cutter of {cutter.teeth} teeth with a tip rounding of {cutter.rounding:.6g} "
            f"module; involute to {shape.shaped.form_radius:.9g} mm"
        )
    return (
        f"module {mesh.module:g} mm, ring of {shape.teeth} teeth, profile shift {shape.shift:.9g} (ISO 21771 sign)",
        f"tip radius {shape.tip:.9g} mm, root radius {shape.deepest:.9g} mm, outer radius {rim:.9g} mm",
        root,
        "no backlash: thin the teeth by the allowance that the drawing gives",
        "frame: gear axis at the origin, middle of a tooth space on the x axis; the body lies outside the profile"
        + section,
    )


def rack_of(
    rack: RackMesh, teeth: int, back: float, name: str, title: str, width: float | None = None, hand: str = "left"
) -> Part:
    """A rack of so many teeth, from the middle of a space to the middle of a space; helical ones of a hand.

    Parameters
        back : float [mm] - thickness of the body below the root line
    Raises
        NoSolution - for a rack that no tool leaves, and for one of more teeth than a file should hold
    """
    if teeth > _MOST_RACK_TEETH:
        text = f"a file holds a rack of at most {_MOST_RACK_TEETH} teeth, not {teeth}"
        raise NoSolution(text, key="rack_teeth", fix="give rack_teeth")
    profile, pair = rack.profile, rack.pair
    half = [(piece, *rest) for piece, rest in zip(_RACK_NAMES, profile.pieces(), strict=True)]
    half = [piece for piece in half if _length(*piece[1:]) > 1e-14 * profile.pitch]
    places = [profile.pitch * (k - 0.5 * teeth) for k in range(teeth)]
    pieces = [part for at in places for part in _one_pitch(half, at, profile.pitch)]
    left, right, low = places[0], places[-1] + profile.pitch, profile.root - back
    corners = [complex(right, profile.root), complex(right, low), complex(left, low), complex(left, profile.root)]
    pieces += [_line("body", "PROFILE", *ends) for ends in pairwise(corners)]
    lines = (("datum line", "DATUM_LINE", 0.0), ("pitch line", "PITCH_LINE", pair.profile_shift[0] * pair.module))
    pieces += [_line(words, layer, complex(left, y), complex(right, y)) for words, layer, y in lines]
    return Part(
        name=name,
        title=title,
        stretches=tuple(pieces),
        closed=True,
        notes=_rack_notes(rack, profile, teeth, low, hand),
        width=width,
        slant=-SENSES[hand] * math.tan(pair.helix_angle),
    )


_MOST_RACK_TEETH = 1000
_RACK_NAMES = ("root line", "rounding", "flank", "tip line")


def _one_pitch(half: list[tuple[str, Curve, float, float]], at: float, pitch: float) -> Iterator[Stretch]:
    """The stretches of a tooth, from the middle of the space at `at` to the middle of the next one."""
    for piece, curve, low, high in half:
        yield _stretch(piece, lambda t, curve=curve: at + curve(t), low, high)  # type: ignore[misc]
    for piece, curve, low, high in reversed(half):
        yield _stretch(piece, lambda t, curve=curve: at + pitch - curve(-t).conj(), -high, -low)  # type: ignore[misc]


def _line(words: str, layer: str, start: complex, end: complex) -> Stretch:
    curve = straight(start, end)
    return Stretch((layer,), lambda share: curve(share)[None, :], 0.0, 1.0, words, steps=1)


def _rack_notes(rack: RackMesh, profile: RackProfile, teeth: int, low: float, hand: str) -> tuple[str, ...]:
    pair = rack.pair
    helix = _helix(pair, hand)
    section = "; transverse section" if pair.helix_angle else ""
    return (
        f"module {pair.module:g} mm, rack of {teeth} teeth, pressure angle {math.degrees(pair.pressure_angle):.9g} deg"
        f"{helix}, pitch {profile.pitch:.9g} mm",
        f"tip line {profile.tip:.9g} mm above the datum line, root line {-profile.root:.9g} mm below it, back "
        f"{-low:.9g} mm below it; tooth and space equal on the datum line",
        f"root left by a tool with a tip rounding of {profile.tool.rounding:.6g} module",
        f"axis of the gear {rack.center_distance:.9g} mm above the datum line",
        "no backlash: thin the teeth by the allowance that the drawing gives",
        f"frame: datum line on the x axis, the middle of the rack at the origin, teeth up{section}",
    )


def _stretch(name: str, curve: Curve, low: float, high: float) -> Stretch:
    def points(parameter: Reals) -> Points:
        row: Points = curve(parameter)[None, :]
        return row

    return Stretch(("PROFILE",), points, low, high, name, steps=1)


def _length(curve: Curve, low: float, high: float) -> float:
    ends = curve(np.array([low, high]))
    return float(abs(ends[1] - ends[0])) if high > low else 0.0


def _helix(pair: GearPair, hand: str) -> str:
    return f", helix angle {math.degrees(pair.helix_angle):.9g} deg {hand}-hand" if pair.helix_angle else ""


def _notes(pair: GearPair, number: int, profile: ToothProfile, hand: str) -> tuple[str, ...]:
    helix = _helix(pair, hand)
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
