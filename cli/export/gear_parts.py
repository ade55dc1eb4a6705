"""A gear's outline: involute flanks and trochoidal roots as the rack tool cuts them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlink.cli.export.contour import Circle, Part
from gearlink.cli.export.sampling import Points, Reals, Stretch
from gearlink.core.gears.internal_mesh import InternalMesh
from gearlink.core.gears.involute import involute
from gearlink.core.gears.pair import GearPair
from gearlink.core.gears.tooth_profile import Curve, ToothProfile

_NAMES = ("root circle", "trochoid", "involute", "tip circle")


def gear_of(pair: GearPair, number: int, name: str, title: str, width: float | None = None) -> Part:
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
            Circle("TIP_CIRCLE", profile.outer_radius),
            Circle("ROOT_CIRCLE", profile.root_radius),
        ),
        notes=_notes(pair, number, profile),
        width=width,
        spur=not pair.helix_angle,
    )


def ring_of(mesh: GearPair | InternalMesh, rim: float, name: str, title: str, width: float | None = None) -> Part:
    """The ring of a pair, the middle of a tooth space on the x axis, within its rim [mm].

    Raises
        NoSolution - where the ring's tips lie inside its base circle
    Notes
        The flanks are involutes down to the root circle: how a cutter rounds the root depends on the cutter.
    """
    shape = _Ring.of(mesh)
    return Part(
        name=name,
        title=title,
        stretches=shape.stretches(),
        closed=True,
        teeth=shape.teeth,
        circles=(
            Circle("REFERENCE_CIRCLE", shape.reference),
            Circle("BASE_CIRCLE", shape.base),
            Circle("TIP_CIRCLE", shape.tip),
            Circle("ROOT_CIRCLE", shape.root),
            Circle("RIM", rim),
        ),
        notes=(
            f"module {mesh.module:g} mm, ring of {shape.teeth} teeth, profile shift {shape.shift:.9g} (ISO 21771 sign)",
            f"tip radius {shape.tip:.9g} mm, root radius {shape.root:.9g} mm, outer radius {rim:.9g} mm",
            "involute down to the root circle; the fillet there is the cutter's, and is left out",
            "no backlash: thin the teeth by the allowance that the drawing gives",
            "frame: gear axis at the origin, middle of a tooth space on the x axis; the body lies outside the profile",
        ),
        width=width,
        spur=not shape.helical,
        rim=rim,
    )


@dataclass(frozen=True)
class _Ring:
    """A ring in the transverse section, its radii as magnitudes [mm].

    at_base : half the angle of a tooth, measured to where its flank would meet the base circle [rad]
    low : tan of the pressure angle at the tip
    """

    teeth: int
    shift: float
    reference: float
    base: float
    tip: float
    root: float
    at_base: float
    low: float
    helical: bool

    @classmethod
    def of(cls, mesh: GearPair | InternalMesh) -> _Ring:
        reference, base = abs(mesh.reference_radius[1]), abs(mesh.base_radius[1])
        tip, root = abs(mesh.tip_radius[1]), abs(mesh.root_radius[1])
        low = math.tan(mesh.tip_pressure_angle[1])
        if isinstance(mesh, InternalMesh):
            z, alpha = mesh.teeth[1], mesh.pressure_angle
            return cls(z, 0.0, reference, base, tip, root, math.pi / (2.0 * z) - involute(alpha), low, False)
        z, shift = -mesh.teeth[1], mesh.profile_shift[1]
        half = (math.pi / 2.0 + 2.0 * shift * math.tan(mesh.pressure_angle)) / z
        at_base = half - involute(mesh.transverse_pressure_angle)
        return cls(z, shift, reference, base, tip, root, at_base, low, bool(mesh.helix_angle))

    def stretches(self) -> tuple[Stretch, ...]:
        """Root, flank and tip from the middle of a space to the middle of the next tooth."""
        half, high = math.pi / self.teeth, math.sqrt((self.root / self.base - 1.0) * (self.root / self.base + 1.0))

        def flank(back: Reals) -> Points:
            out: Points = self.base * (1.0 + 1j * -back) * np.exp(1j * (half - self.at_base + back))
            return out

        def arc(radius: float) -> Curve:
            return lambda angle: radius * np.exp(1j * angle)

        at_root = half - (self.at_base + high - math.atan(high))
        at_tip = half - (self.at_base + self.low - math.atan(self.low))
        pieces = ((arc(self.root), 0.0, at_root), (flank, -high, -self.low), (arc(self.tip), at_tip, half))
        names = ("root circle", "involute", "tip circle")
        return tuple(
            _stretch(name, curve, low, high)
            for name, (curve, low, high) in zip(names, pieces, strict=True)
            if _length(curve, low, high) > 1e-14 * self.root
        )


def _stretch(name: str, curve: Curve, low: float, high: float) -> Stretch:
    def points(parameter: Reals) -> Points:
        row: Points = curve(parameter)[None, :]
        return row

    return Stretch(("PROFILE",), points, low, high, name, steps=1)


def _length(curve: Curve, low: float, high: float) -> float:
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
