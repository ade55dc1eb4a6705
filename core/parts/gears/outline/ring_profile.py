"""The tooth of a ring in the transverse section as its pinion cutter leaves it: root, fillet, flank, tip.

Frame of the ring: its centre is the origin, the x axis the middle of a tooth space; points are complex numbers.
"""

from __future__ import annotations

import cmath
import math

import numpy as np

from gearlink.core.numerics.arrays import Points, Reals, unit_vector
from gearlink.core.numerics.curves import Curve, arc
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.tooth.involute import inverse_involute, involute, roll_at


class RingProfile:
    """A ring between the middle of a space and the middle of the next tooth; radii are magnitudes.

    Parameters
        mesh : GearPair - whose ring it is; without a cutter its flanks go down to the root circle, with sharp corners
    Returns
        Attributes: |z|, the base, tip and root radius [mm], half the angle of a tooth where its flank would meet the
        base circle [rad], tan of the pressure angle at the tip, and the ring as its cutter shapes it, or None.
    Raises
        NoSolution - where its tips lie inside its base circle, or its cutter cannot cut it
    Example
        >>> ring = RingProfile(GearPair(module=2.0, teeth=(48, -62), given_shift=(0.0, 0.0)))
        >>> [name for name, *_ in ring.pieces()]
        ['root circle', 'involute', 'tip circle']

    Source
        own derivation: the space of the ring is the tooth of an outer gear of as many teeth and the opposite shift
    """

    def __init__(self, mesh: GearPair) -> None:
        self.base, self.tip, self.root = (abs(r[1]) for r in (mesh.base_radius, mesh.tip_radius, mesh.root_radius))
        self.teeth, self.shaped = -mesh.teeth[1], mesh.shaped
        half = (math.pi / 2.0 + 2.0 * mesh.profile_shift[1] * math.tan(mesh.pressure_angle)) / self.teeth
        self.at_base = half - involute(mesh.transverse_pressure_angle)
        self.tip_roll = math.tan(mesh.tip_pressure_angle[1])

    @property
    def deepest(self) -> float:
        """Radius to which the space reaches: the root circle, or less where both flanks meet before it [mm]."""
        left = math.pi / self.teeth - self.at_base
        if self.shaped is not None or left <= 0.0:
            return self.root
        return min(self.root, self.base / math.cos(inverse_involute(left)))

    def _beside(self, roll: float) -> float:
        """Polar angle of the flank from the middle of the space [rad]."""
        return math.pi / self.teeth - (self.at_base + roll - math.atan(roll))

    def flank(self, back: Reals) -> Points:
        """The involute over its roll angle, counted backwards: from the root towards the tip."""
        half = math.pi / self.teeth
        return self.base * (1.0 - 1j * back) * unit_vector(half - self.at_base + back)

    def pieces(self) -> list[tuple[str, Curve, float, float]]:
        """Names and curves from the middle of the space to the middle of the tooth, with their parameters' ranges."""
        high = roll_at((self.deepest if self.shaped is None else self.shaped.form_radius) / self.base)
        fillet: list[tuple[str, Curve, float, float]] = []
        at_root = self._beside(high)
        if self.shaped is not None:
            fillet = [("fillet", self.fillet, *self.shaped.turns)]
            at_root = cmath.phase(self.shaped.fillet(self.shaped.turns[0]))
        return [
            ("root circle", arc(self.deepest), 0.0, at_root),
            *fillet,
            ("involute", self.flank, -high, -self.tip_roll),
            ("tip circle", arc(self.tip), self._beside(self.tip_roll), math.pi / self.teeth),
        ]

    def fillet(self, turn: Reals) -> Points:
        """The root fillet over the angle of the cutter [rad]."""
        assert self.shaped is not None, "a piece of shaped rings alone"
        return np.array([self.shaped.fillet(float(each)) for each in turn])

    def outline(self, points_on_flank: int = 12) -> Points:
        """The closed inner outline, counter-clockwise, the x axis in the middle of a tooth [mm]."""
        rows = []
        for name, curve, low, high in self.pieces():
            count = points_on_flank if name in ("fillet", "involute") else 2
            if high > low:
                rows.append(curve(np.linspace(low, high, count)))
        half = np.concatenate(rows)
        half = half[np.concatenate([[True], np.abs(np.diff(half)) > 1e-14 * self.root])]
        space = np.concatenate([half[:0:-1].conj(), half])
        turns = np.exp(1j * math.pi / self.teeth * (2.0 * np.arange(self.teeth) + 1.0))
        ring: Points = (turns[:, None] * space[None, :-1]).ravel()
        return np.concatenate([ring, ring[:1]])
