"""The tooth of an involute gear as a rack tool cuts it, in the transverse section: flanks, roots, tip and root circles.

Frame of the gear: its centre is the origin, the x axis the middle of a tooth space; points are complex numbers x + i y.
The root fillet is that of `root_fillet`, over the direction b of the normal in the normal section.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, unlike
from gearlink.core.numerics.arrays import Points, Reals, unit_vector
from gearlink.core.numerics.curves import Curve, arc
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.tooth.involute import inverse_involute, roll_at
from gearlink.core.parts.gears.tooth.root_fillet import RackCutRoot
from gearlink.core.parts.gears.tooth.tools import full_rounding

_LEAST_CHORD_ERROR = 1e-7  # module; below it the points of large gears would be distinguished by rounding alone


@dataclass(frozen=True, kw_only=True)
class ToothProfile:
    """The profile of one gear between the middle of a space and the middle of a tooth.

    Parameters
        cut : RackCutRoot - the root that the tool leaves: teeth, shift, angles and tool
        module : float [mm] - m
        tip_radius : float [mm] - r_a
    Returns
        Properties: lengths in mm, angles in rad.
    Raises
        NoSolution - where the tool's tooth is pointed, the root circle vanishes, or no involute is left
    Notes
        All is worked out for module 1 and scaled at the end: tiny and huge gears keep the same digits.
    Example
        >>> gear = ToothProfile.of(GearPair.from_shift(2.0, (12, 40)), 0)
        >>> gear.undercut, round(gear.form_radius, 6), round(gear.base_radius, 6)
        (True, 11.302707, 11.276311)

    Source
        own derivation from the law of gearing; ISO 53 for the tool's rounding
    """

    cut: RackCutRoot
    module: float
    tip_radius: float

    def __post_init__(self) -> None:
        tool, alpha, teeth, shift = self.cut.tool, self.cut.pressure_angle, self.cut.teeth, self.cut.shift
        most = full_rounding(alpha, tool.addendum, tool.residual_undercut)
        if most < 0.0:
            raise NoSolution(
                f"addendum of the tool (addendum + clearance): {short(tool.addendum)} modules (limit < "
                f"{safely_below(math.pi / 4.0 / math.tan(alpha))} modules, where it is pointed)"
            )
        if not 0.0 <= tool.rounding <= most * (1.0 + 1e-12):
            raise NoSolution(
                f"rounding of the tool: {unlike(tool.rounding, most)} modules (from 0 to {safely_below(most)} "
                "modules, a full round)"
            )
        if not self._root > 0.0:
            raise NoSolution(
                f"a gear of {teeth} teeth with the profile shift {short(shift)} has no root circle left",
                fix=f"use at least {math.ceil(2.0 * (tool.addendum - shift) + 1e-9)} teeth or a larger shift",
            )
        if not self._form < self._top:
            remedy = "increase" if self.undercut and not self._top < self.tip_radius / self.module else "reduce"
            raise NoSolution(
                f"start of the involute of a gear of {teeth} teeth: radius "
                f"{unlike(self.form_radius, self.outer_radius)} mm (limit < "
                f"{unlike(self.outer_radius, self.form_radius)} mm, its tip)",
                fix=f"{remedy} the profile shift, or use more teeth",
            )

    @classmethod
    def of(cls, pair: GearPair, gear: int) -> ToothProfile:
        """The profile of gear 0 or 1 of a pair, as its tool cuts it; a pair without tools has those of ISO 53.

        Parameters
            gear : int - 0 or 1
        Raises
            NoSolution - as the class
        Example
            >>> round(ToothProfile.of(GearPair.from_shift(2.0, (40, 72)), 0).cut.tool.rounding, 6)
            0.379951

        Source
            ISO 53, profile A
        """
        return cls(cut=pair.roots[gear], module=pair.module, tip_radius=pair.tip_radius[gear])

    # Radii and angles; names with an underscore are in modules

    @property
    def reference_radius(self) -> float:
        """r = m_t z/2 [mm]."""
        return self.module * self._r

    @property
    def base_radius(self) -> float:
        """r_b = r cos(alpha_t) [mm]."""
        return self.module * self._base

    @property
    def root_radius(self) -> float:
        """r_f = r - (h_a* + c* - x) m [mm]."""
        return self.module * self._root

    @property
    def form_radius(self) -> float:
        """Where trochoid and involute meet [mm]; the flank may be used from there outwards.

        r_F^2 = r_b^2 + (r sin(alpha) - q/sin(alpha) - rho)^2 without undercut
        """
        return self.module * self._form

    @property
    def outer_radius(self) -> float:
        """r_a, or less where both flanks meet in a point below it [mm]."""
        return self.module * self._top

    @property
    def undercut(self) -> bool:
        """Whether the tool cuts into the involute at its foot."""
        return self.cut.undercut

    @property
    def pitch_angle(self) -> float:
        """Angle from one space to the next, 2 pi/z [rad]."""
        return 2.0 * math.pi / self.cut.teeth

    @property
    def _r(self) -> float:
        return self.cut.teeth / 2.0 / math.cos(self.cut.helix_angle)

    @property
    def _base(self) -> float:
        return self.cut.base_radius

    @property
    def _root(self) -> float:
        return self._r + self.cut.shift - self.cut.tool.addendum

    @cached_property
    def _u(self) -> float:
        """Distance of the rounding's centre from the middle of the tool's tooth, in the transverse section."""
        return max(0.0, self.cut.tool.rounding_center(self.cut.pressure_angle)) / math.cos(self.cut.helix_angle)

    @property
    def _at_base(self) -> float:
        """Half the angle of the space on the base circle, where the involute begins; negative where spaces overlap."""
        return self.cut.half_space_at_base

    @cached_property
    def _top(self) -> float:
        half_pitch = math.pi / self.cut.teeth
        tip = self.tip_radius / self.module
        if half_pitch <= self._at_base:
            return self._base
        pointed = self._base / math.cos(inverse_involute(half_pitch - self._at_base))
        return min(tip, pointed)

    @property
    def _form(self) -> float:
        return self.cut.form_radius

    # Curves [mm], each over an array of its parameter

    def trochoid(self, normal: Reals) -> Points:
        """The root's rounding, over the direction b of the normal, then the path of a protuberance's corner."""
        rho, cosine = self.cut.tool.rounding, math.cos(self.cut.helix_angle)
        held = np.minimum(normal, self.cut.last_normal)
        below = self.cut.tool.addendum - rho - self.cut.shift + rho * np.cos(held)
        across = self._across(below * np.tan(held) * cosine, self._r - below, normal - held)
        shifted = self._u + rho * np.sin(held) / cosine - across
        return self.module * (self._r - below + 1j * across) * unit_vector(shifted / self._r)

    def _across(self, across: Reals, above: Reals, rolled: Reals) -> Reals:
        """`RackCutRoot.corner_path` over arrays."""
        size = np.abs(across) + rolled * self._r
        deeper = np.where(np.arctan2(size, above) < size / self._r, -size, size)
        found: Reals = np.where(rolled > 0.0, deeper, across)
        return found

    def flank(self, roll: Reals) -> Points:
        """The involute, over its roll angle t = tan(pressure angle at the radius).

        z(t) = r_b (1 - i t) exp(i (angle at the base circle + t))
        """
        return self.base_radius * (1.0 - 1j * roll) * unit_vector(self._at_base + roll)

    def pieces(self) -> list[tuple[Curve, float, float]]:
        """The curves from the middle of the space to the middle of the tooth, with the range of their parameters."""
        low, high = roll_at(self._form / self._base), roll_at(self._top / self._base)
        tooth_edge = self._at_base + high - math.atan(high)
        return [
            (arc(self.root_radius), 0.0, self._u / self._r),
            (self.trochoid, 0.0, self.cut.end_normal),
            (self.flank, low, high),
            (arc(self.outer_radius), tooth_edge, math.pi / self.cut.teeth),
        ]


def half_tooth(profile: ToothProfile, chord_error: float) -> Points:
    """Points of the profile from the middle of a space to the middle of the next tooth.

    Parameters
        chord_error : float [mm] - maximum distance of a chord from its curve
    Returns
        points : (N,) array [mm] - counter-clockwise, from the x axis to the polar angle pi/z
    Raises
        NoSolution - for a chord error below 1e-7 module
    Example
        >>> points = half_tooth(ToothProfile.of(GearPair.from_shift(2.0, (40, 72)), 0), 1e-3)
        >>> round(float(points[0].real), 9), round(float(abs(points[-1])), 9)
        (37.5, 42.0)
    """
    least = _LEAST_CHORD_ERROR * profile.module
    if not chord_error >= least:
        raise NoSolution(f"chord error {chord_error:g} mm: it must be at least {least:g} mm, 1e-7 of the module")
    parts = [_chords(*piece, chord_error) for piece in profile.pieces()]
    points: Points = np.concatenate([parts[0], *(part[1:] for part in parts[1:])])
    # A tool with a full round has no root arc, a pointed tooth no tip arc: their points fall into one.
    moved = np.abs(np.diff(points)) > 1e-14 * profile.tip_radius
    kept: Points = points[np.concatenate([[True], moved])]
    return kept


def tooth_space(profile: ToothProfile, chord_error: float) -> Points:
    """Points of one pitch, from the middle of a tooth through the space on the x axis to the middle of the next.

    Example
        >>> points = tooth_space(ToothProfile.of(GearPair.from_shift(2.0, (40, 72)), 0), 1e-3)
        >>> bool(np.all(points == points[::-1].conj()))
        True

    Source
        own derivation: the space is its own mirror image
    """
    half = half_tooth(profile, chord_error)
    return np.concatenate([half[:0:-1].conj(), half])


def outline(profile: ToothProfile, chord_error: float, teeth: int | None = None, first: float = 0.0) -> Points:
    """The outline of a gear, or of some of its pitches.

    Parameters
        chord_error : float [mm] - maximum distance of a chord from its curve
        teeth : int or None - how many pitches, counter-clockwise; None: all of them, closed
        first : float [rad] - polar angle of the middle of the first space
    Returns
        points : (N,) array [mm] - the last point of a whole gear is its first, to the bit
    Raises
        NoSolution - as `half_tooth`
    Example
        >>> gear = outline(ToothProfile.of(GearPair.from_shift(2.0, (40, 72)), 0), 1e-3)
        >>> bool(gear[0] == gear[-1])
        True
    """
    space = tooth_space(profile, chord_error)
    count = profile.cut.teeth if teeth is None else teeth
    turns = np.exp(1j * (first + profile.pitch_angle * np.arange(count)))
    points: Points = (turns[:, None] * space[None, :-1]).ravel()
    last = points[:1] if teeth is None else turns[-1:] * space[-1:]
    return np.concatenate([points, last])


def _chords(curve: Curve, low: float, high: float, chord_error: float) -> Points:
    """Points of a curve at equal steps of its parameter, halved until the middles lie near enough to the chords."""
    count = 1
    while True:
        fine = curve(np.linspace(low, high, 2 * count + 1))
        start, middle, end = fine[:-1:2], fine[1::2], fine[2::2]
        chord = end - start
        area = np.abs(((middle - start) * chord.conj()).imag)
        if np.all(area <= chord_error * np.abs(chord)):
            return fine[::2]
        count *= 2
