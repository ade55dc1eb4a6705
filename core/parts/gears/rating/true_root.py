"""Root stress on the generated fillet of one tooth with its rim, the second way beside the section of ISO 6336-3.

The load acts at the outer point of single contact, normal to the flank, as cos^2 over 0.24 modules to either side; a
traction linear over the far side of the rim balances it. Within 4 %: a rim of 3 modules instead of 5 changes the
stress by 3.5 %, root circles of 2.5 pitches instead of 1 by 1 %.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gearlink.core.base.report import Table
from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.outline.root_contour import RootContour
from gearlink.core.parts.gears.rating.plane_stress import INTEGRAL, ORDER, WEIGHTS, HalfContour, panels

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Points, Reals
    from gearlink.core.parts.gears.data import GearData

_SOUGHT = (0.1, 0.9)
"""Of the fillet's parameter: at its joints the integral is off."""
_EACH = 4
"""Every fourth node stands in the table, and those of the maximum stresses."""


class Peak(NamedTuple):
    """A maximum stress, over F_t/(b m), and its place on the fillet [module]."""

    factor: float
    place: complex


@dataclass(frozen=True)
class TrueRoot:
    """The stress along the fillets of a tooth of module 1 under F_t/b = 1 N/mm.

    Parameters
        contour : RootContour
        load_radius : float [module] - where the load acts on the virtual gear
        pressure_angle : float [rad] - alpha_n
    Source
        own derivation; the equation of Sherman and Lauricella
    """

    contour: RootContour
    load_radius: float
    pressure_angle: float

    @cached_property
    def _pieces(self) -> tuple[HalfContour, list[str]]:
        """The half contour, and the name of the piece that each panel belongs to."""
        points, names = [], []
        for name, curve, breaks in self.contour.pieces(self.load_radius):
            points.append(panels(curve, breaks))
            names += [name] * (len(breaks) - 1)
        return HalfContour(np.concatenate(points)), names

    def _panels(self, name: str) -> list[int]:
        return [place for place, each in enumerate(self._pieces[1]) if each == name]

    @cached_property
    def _forces(self) -> tuple[Points, Points]:
        """(X + i Y) ds of each node of the right and the left half: load and what balances it."""
        half, load, far = self._pieces[0], self._panels("load"), self._panels("far")
        right = np.zeros(half.points.shape, dtype=complex)
        ends = np.cumsum(half.lengths[load].sum(axis=1))
        along = (ends - half.lengths[load].sum(axis=1))[:, None] + np.abs(half.rates[load]) @ INTEGRAL.T
        whole = float(ends[-1])
        pressure = np.sin(np.pi * along / whole) ** 2
        pressure /= float((pressure * half.lengths[load]).sum()) * math.cos(self.pressure_angle)
        right[load] = 1j * pressure * half.steps[load]  # against the outward normal -i T
        place, size = half.points[far], half.lengths[far]
        force = right.sum()
        level = -force / (2.0 * size.sum())
        turn = float((half.points.conj() * right).imag.sum())
        turn += float(((place.conj() - place) * level * size).imag.sum())  # of the level on both halves
        tilt = -turn / (2.0 * float((place.real**2 * size).sum()))
        right[far] += (level + 1j * tilt * place.real) * size
        left = np.zeros_like(right)
        left[far] = (level - 1j * tilt * place.real) * size
        return right, left

    @cached_property
    def _loads(self) -> tuple[Points, Points]:
        """f = i Int (X + iY) ds at the nodes of the right half, of both mirror signs."""
        right, left = self._forces
        after = 1j * right
        before = np.cumsum(after.sum(axis=1)) - after.sum(axis=1)
        own = before[:, None] + (after / WEIGHTS) @ INTEGRAL.T
        back = 1j * left  # from the y axis on clockwise: against the contour
        passed = np.cumsum(back.sum(axis=1)) - back.sum(axis=1)
        other = -(passed[:, None] + (back / WEIGHTS) @ INTEGRAL.T)
        return 0.5 * (own - other.conj()), 0.5 * (own + other.conj())

    @cached_property
    def stresses(self) -> tuple[Reals, Reals]:
        """Stress along the fillet of the loaded flank and along the other at the nodes of its panels, (9, 8) each."""
        half, fillet = self._pieces[0], self._panels("fillet")
        mirrored, other = half.solved(*self._loads)
        one = half.stress_sums(1.0, mirrored, fillet)
        two = half.stress_sums(-1.0, other, fillet)
        return one + two, one - two

    @property
    def fillet(self) -> Points:
        """The nodes of the fillet [module], the middle of the tooth on the y axis."""
        found: Points = self._pieces[0].points[self._panels("fillet")]
        return found

    def _peak(self, stress: Reals, sign: float) -> Peak:
        """The maximum stress away from the joints, between the nodes by the polynomial of each panel."""
        places = self.contour.pieces(self.load_radius)
        breaks = next(breaks for name, _, breaks in places if name == "fillet")
        low, high = (breaks[0] + share * (breaks[-1] - breaks[0]) for share in _SOUGHT)
        best = Peak(-math.inf, 0j)
        fine = np.linspace(-1.0, 1.0, 41)
        to_fine = np.vander(fine, ORDER) @ np.linalg.inv(np.vander(np.polynomial.legendre.leggauss(ORDER)[0], ORDER))
        for panel, row in enumerate(stress):
            start, end = breaks[panel], breaks[panel + 1]
            at = 0.5 * (start + end) + 0.5 * (end - start) * fine
            inside = (at >= low - 1e-12 * (end - start)) & (at <= high + 1e-12 * (end - start))
            if not inside.any():
                continue
            values = np.where(inside, sign * (to_fine @ row), -np.inf)
            k = int(np.argmax(values))
            if values[k] > best.factor:
                best = Peak(float(values[k]), complex((to_fine @ self.fillet[panel])[k]))
        return best

    @cached_property
    def tension(self) -> Peak:
        """The maximum tension, in the fillet of the loaded flank."""
        return self._peak(self.stresses[0], 1.0)

    @cached_property
    def compression(self) -> Peak:
        """The maximum compression, in the other fillet; its place in the mirror."""
        return self._peak(self.stresses[1], -1.0)


def true_root(data: GearData, gear: int) -> TrueRoot | None:
    """The generated root of a gear of a pair; None without a root section, and of a ring whose cutter is not known."""
    section, rim = data.root.sections[gear], data.rims[gear]
    if section is None:
        return None
    contour = RootContour.of(data.pair, gear, data.cut_shift[gear], None if rim is None else rim / data.pair.module)
    if contour is None:
        return None
    return TrueRoot(contour, abs(section.load_radius), data.pair.pressure_angle)


def end_tooth_root(data: GearData, tip_radius: float) -> TrueRoot | None:
    """The root of a tooth of gear 1 beside a gap, cut down to a radius [mm]; None where no flank is left.

    It takes up the load alone, at its tip. Its other side is the root circle, as in any tooth here: locking arcs are
    not known.
    """
    rim = data.rims[0]
    height = None if rim is None else rim / data.pair.module
    contour = RootContour.of(data.pair, 0, data.cut_shift[0], height, tip_radius)
    return None if contour is None else TrueRoot(contour, contour.tip, data.pair.pressure_angle)


def root_table(roots: Sequence[tuple[str, TrueRoot | None]], scales: Sequence[float], module: float) -> Table:
    """The table `root`: stress along the fillets of the loaded and of the other flank, all load factors in it.

    Parameters
        roots : (name of the gear, its root) in order
        scales : float [N/mm^2] - F_t/(b m) with all factors of each; all 0 without load: then over F_t/(b m)
        module : float [mm]
    """
    rows: list[tuple[str, float, float, float, float]] = []
    loaded = any(scales)
    for (name, found), scale in zip(roots, scales if loaded else [1.0] * len(roots), strict=True):
        if found is None:
            continue
        pulled, pressed = (side.ravel() for side in found.stresses)
        shown = sorted({*range(0, pulled.size, _EACH), int(np.argmax(pulled)), int(np.argmin(pressed))})
        places = found.fillet.ravel()[shown] * module
        values = zip(places.real, abs(places.imag), scale * pulled[shown], scale * pressed[shown], strict=True)
        rows += [(name, float(x), float(y), float(one), float(two)) for x, y, one, two in values]
    unit = "N/mm^2" if loaded else "1"
    names, units = ("gear", "x", "y", "loaded_side", "other_side"), ("", "mm", "mm", unit, unit)
    columns = zip(*rows, strict=True) if rows else ([] for _ in names)
    return Table("root", names, units, tuple(list(column) for column in columns))
