"""The outline of a mutilated wheel: its groups of teeth, the ends of each cut down, the gaps at the root circle."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.export.contour import Circle, Part
from gearlink.cli.export.gear_parts import SENSES
from gearlink.cli.export.sampling import Points, Reals, Stretch
from gearlink.core.base.wording import amount
from gearlink.core.machines.dwell_gears.wheel import end_tooth_radius
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile

if TYPE_CHECKING:
    from gearlink.core.machines.dwell_gears.mutilated_design import MutilatedGearDwell

_Curve = Callable[[Reals], Points]
_Piece = tuple[str, _Curve, float, float]
_NAMES = ("root circle", "trochoid", "involute", "tip circle")


def wheel_of(design: MutilatedGearDwell, width: float | None = None, hand: str = "right") -> Part:
    """The wheel, the middle of a gap on the x axis; half a group and its gap, mirrored and turned, make it all.

    Raises
        NoSolution - where the groups leave no gaps, and where no involute is left between root and tip
    """
    _ = design.mutilated  # refuses groups that fill the wheel
    profile, mesh = ToothProfile.of(design.mesh, 0), design.mesh
    count, groups, step = design.group_teeth, design.spec.gears.groups, 2.0 * math.pi / design.full_teeth
    cut = min(end_tooth_radius(mesh), profile.outer_radius)  # a pointed tooth ends below the tip circle
    half_gap = math.pi / groups - 0.5 * count * step
    whole = list(_half(profile))
    ends = _cut_down(whole, cut, math.pi / design.full_teeth)
    root = profile.root_radius
    stretches = [_stretch("gap", lambda angle: root * np.exp(1j * angle), 0.0, half_gap)]
    for k in range(math.ceil(0.5 * count)):
        pieces, start = ends if k in (0, count - 1) else whole, half_gap + k * step
        stretches += [_turned(*piece, start) for piece in pieces]
        if 2 * k + 1 != count:  # the middle tooth of an odd group ends at the mirror
            stretches += [_mirrored(*piece, start + step) for piece in reversed(pieces)]
    return Part(
        name="wheel",
        title=f"wheel, {groups} x {count} of {design.full_teeth} teeth",
        stretches=tuple(stretches),
        closed=True,
        teeth=groups,
        circles=(
            Circle("REFERENCE_CIRCLE", profile.reference_radius),
            Circle("BASE_CIRCLE", profile.base_radius),
            Circle("TIP_CIRCLE", profile.outer_radius),
            Circle("ROOT_CIRCLE", profile.root_radius),
        ),
        notes=(
            f"module {mesh.module:g} mm, {amount(groups, 'group')} of {amount(count, 'tooth', 'teeth')}, "
            f"{design.full_teeth} teeth without gaps",
            f"first and last tooth of a group cut to radius {cut:.6g} mm, so that they pass the resting gear",
            "the locking arcs that hold the driven gear, and an entry tooth that takes up its speed, are left out",
            "no backlash: thin the teeth by the allowance that the drawing gives",
            "frame: wheel axis at the origin, middle of a gap on the x axis",
        ),
        width=width,
        twist=SENSES[hand] * math.tan(mesh.helix_angle) / mesh.reference_radius[0],
    )


def _half(profile: ToothProfile) -> Iterator[_Piece]:
    """A tooth from the middle of the space before it, on the x axis, to its own middle."""
    for name, (curve, low, high) in zip(_NAMES, profile.pieces(), strict=True):
        ends = curve(np.array([low, high]))
        if high > low and abs(complex(ends[1] - ends[0])) > 1e-14 * profile.tip_radius:
            yield name, curve, low, high


def _cut_down(pieces: list[_Piece], radius: float, middle: float) -> list[_Piece]:
    """The same up to a radius [mm], from there an arc to the middle of the tooth [rad]."""
    kept: list[_Piece] = []
    start = 0.0
    for name, curve, low, high in pieces:

        def beyond(at: float, curve: _Curve = curve) -> float:
            return abs(complex(curve(np.array([at]))[0])) - radius

        if beyond(high) <= 0.0:
            kept.append((name, curve, low, high))
            start = cmath.phase(complex(curve(np.array([high]))[0]))
            continue
        if beyond(low) < 0.0:
            high = bracketed_root(beyond, low, high)
            kept.append((name, curve, low, high))
            start = cmath.phase(complex(curve(np.array([high]))[0]))
        break
    if start < middle:
        kept.append(("cut", lambda angle: radius * np.exp(1j * angle), start, middle))
    return kept


def _turned(name: str, curve: _Curve, low: float, high: float, angle: float) -> Stretch:
    unit = cmath.rect(1.0, angle)
    return _stretch(name, lambda at: unit * curve(at), low, high)


def _mirrored(name: str, curve: _Curve, low: float, high: float, angle: float) -> Stretch:
    """The other flank of a tooth, from its middle outwards."""
    unit = cmath.rect(1.0, angle)
    return _stretch(name, lambda at: unit * np.conj(curve(low + high - at)), low, high)


def _stretch(name: str, curve: _Curve, low: float, high: float) -> Stretch:
    def points(parameter: Reals) -> Points:
        row: Points = np.asarray(curve(parameter), dtype=np.complex128)[None, :]
        return row

    return Stretch(("PROFILE",), points, low, high, name, steps=1)
