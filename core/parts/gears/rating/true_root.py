"""Root stress on the generated fillet of one tooth with its rim, the second way beside the section of ISO 6336-3.

The load acts at the outer point of single contact, normal to the flank, as cos^2 over 0.24 modules to either side; a
traction linear over the far side of the rim balances it. Within 4 %: a rim of 3 modules instead of 5 changes the
stress by 3.5 %, root circles of 2.5 pitches instead of 1 by 1 %.

The body is one tooth of the virtual spur gear of module 1 in the normal section, its centre at the origin, the middle
of the tooth on the y axis, tip up; a ring is mirrored so that its rim lies below the tooth as well. Neighbouring teeth
are left out: the root circle goes on to 1.5 pitches beside the middle.

The stress on the edge of this plane elastic body, which is its own mirror image, is found by a boundary integral.

First fundamental problem of plane elasticity, the equation of Sherman and Lauricella over the closed contour L,
counter-clockwise, with th = arg(tau - t):

    omega(t) + (1/pi) Int_L [omega(tau) - e^(2 i th) conj omega(tau)] d th = f(t),   f = i Int (X + i Y) ds
    phi(t) = omega(t) + 1/(2 pi i) Int (omega(tau) - omega(t))/(tau - t) d tau,   sigma_t + sigma_n = 4 Re phi'(t)

The body is mirrored at the y axis: its right half gives two real systems of half size, for loads that mirror and for
those that mirror with the other sign. A turn of the whole body, omega = i z, bears no stress: the second system is
freed of it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Table
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.curves import arc
from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile
from gearlink.core.parts.gears.tooth.involute import involute, roll_at
from gearlink.core.parts.gears.tooth.root_fillet import RackCutRoot

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Points, Reals
    from gearlink.core.numerics.curves import Curve
    from gearlink.core.parts.gears.data import GearData
    from gearlink.core.parts.gears.mesh.pair import GearPair


RIM = 5.0
"""Modules of the rim below the root circle, where the file names none."""
BESIDE = 1.5
"""Pitches from the middle of the tooth to where the root circle ends."""
TIP_ROUNDING = 0.12
_LEAST_ROUNDING = 0.005
_MOST_OF_GEAR = 0.8
"""Of the root circle that a rim takes at most."""
_FILLET = (0.0, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95, 1.0)
_LAND = (0.0, 0.02, 0.04, 0.08, 0.2, 0.4, 0.7, 1.0)
"""Places of the panels over fillet and land: short ones at their joint, without which a ring came out 2.4 % wrong."""
_FLANK = (0.0, 0.03, 0.08, 0.2, 0.45, 1.0)
_LOAD_HALF = 0.24
"""Modules of the flank to either side of the middle of the load."""
_LOAD_PANELS = 4


@dataclass(frozen=True, kw_only=True)
class RootContour:
    """The right half of a tooth with its rim, in modules.

    Parameters
        teeth : float - |z_n|
        base, tip, root : float - radii
        at_base : float [rad] - of a gear half the angle of a space on the base circle, of a ring that of a tooth
        fillet : function of an array - points of the fillet, the middle of the space on the x axis, from root to flank
        ends : (float, float) - range of its parameter
        form : float - radius where the flank begins
        rim : float - thickness of the rim
    """

    teeth: float
    ring: bool
    base: float
    tip: float
    root: float
    at_base: float
    fillet: Callable[[Any], Any]
    ends: tuple[float, float]
    form: float
    rim: float

    @classmethod
    def of(
        cls, pair: GearPair, gear: int, shift: float, rim: float | None, tip_radius: float | None = None
    ) -> RootContour | None:
        """The contour of a gear of a pair; None of a ring whose cutter is not known, and of a tooth that is none.

        Parameters
            gear : int - 0 or 1
            shift : float [module] - generating shift
            rim : float or None [module] - thickness below the root circle
            tip_radius : float or None [mm] - of a gear whose tooth is cut down; None: its tip circle
        """
        try:
            found = (
                cls._ring(pair, shift, rim) if pair.teeth[gear] < 0 else cls._gear(pair, gear, shift, rim, tip_radius)
            )
        except NoSolution:
            return None
        return None if found is None or found.is_pointed else found

    @classmethod
    def _gear(cls, pair: GearPair, gear: int, shift: float, rim: float | None, tip: float | None) -> RootContour:
        turned = math.cos(pair.base_helix_angle) ** 2 * math.cos(pair.helix_angle)
        teeth, tool = pair.teeth[gear] / turned, pair.tool(gear)
        top = pair.tip_radius[gear] if tip is None else tip
        height = (top - pair.reference_radius[gear]) / pair.module
        cut = RackCutRoot(teeth=cast(int, teeth), shift=shift, tool=tool, pressure_angle=pair.pressure_angle)
        profile = ToothProfile(cut=cut, module=1.0, tip_radius=0.5 * teeth + height)
        _, (curve, start, end), *_ = profile.pieces()
        half = (math.pi / 2.0 - 2.0 * shift * math.tan(pair.pressure_angle)) / teeth
        return cls(
            teeth=teeth,
            ring=False,
            base=profile.base_radius,
            tip=profile.outer_radius,
            root=profile.root_radius,
            at_base=half - involute(pair.pressure_angle),
            fillet=curve,
            ends=(start, end),
            form=profile.form_radius,
            rim=min(RIM if rim is None else rim, _MOST_OF_GEAR * profile.root_radius),
        )

    @classmethod
    def _ring(cls, pair: GearPair, shift: float, rim: float | None) -> RootContour | None:
        if pair.shaped is None:
            return None
        ring = replace(pair.shaped, shift=shift).virtual
        teeth = -float(ring.teeth)
        height = (pair.tip_radius[1] - pair.reference_radius[1]) / pair.module
        half = (math.pi / 2.0 + 2.0 * ring.shift * math.tan(pair.pressure_angle)) / teeth
        return cls(
            teeth=teeth,
            ring=True,
            base=0.5 * teeth * math.cos(pair.pressure_angle),
            tip=0.5 * teeth - height,
            root=ring.root_radius,
            at_base=half - involute(pair.pressure_angle),
            fillet=np.vectorize(ring.fillet, otypes=[complex]),
            ends=ring.turns,
            form=ring.form_radius,
            rim=RIM if rim is None else rim,
        )

    # Curves, the middle of the space on the x axis

    @property
    def _sign(self) -> float:
        return -1.0 if self.ring else 1.0

    def flank(self, roll: Any) -> Any:
        """The involute over its roll angle."""
        sign = self._sign
        start = math.pi / self.teeth - self.at_base if self.ring else self.at_base
        return self.base * (1.0 - 1j * sign * roll) * np.exp(1j * (start + sign * roll))

    def standing(self, points: Any) -> Any:
        """Points beside the middle of the space, in the frame of the tooth."""
        found = points * np.exp(1j * (0.5 * math.pi - math.pi / self.teeth))
        return np.conj(found) if self.ring else found

    @property
    def is_pointed(self) -> bool:
        """Whether the tip has no room for the minimum rounding, or lies too near to the base circle."""
        radius = _LEAST_ROUNDING
        inside = not self.ring and self.tip - TIP_ROUNDING <= self.base
        return inside or bool(np.angle(self._tip_corner(radius)[1]) > math.pi / self.teeth)

    @cached_property
    def tip_corner(self) -> tuple[float, float, complex]:
        """Radius of the rounding of the tip, the roll angle where the flank ends in it, and its centre."""
        radius = TIP_ROUNDING
        while radius > _LEAST_ROUNDING:
            roll, center = self._tip_corner(radius)
            if np.angle(center) <= math.pi / self.teeth:
                return radius, roll, center
            radius *= 0.5
        return _LEAST_ROUNDING, *self._tip_corner(_LEAST_ROUNDING)

    def _tip_corner(self, radius: float) -> tuple[float, complex]:
        """Roll angle at the end of the flank, and centre: on the parallel of the involute and of the tip circle."""
        sign = self._sign
        at = math.sqrt((self.tip - sign * radius) ** 2 - self.base**2) / self.base
        roll = at + sign * radius / self.base
        start = math.pi / self.teeth - self.at_base if self.ring else self.at_base
        return roll, complex(self.base * (1.0 - 1j * sign * at) * np.exp(1j * (start + sign * roll)))

    def load_patch(self, radius: float) -> tuple[float, float]:
        """Minimum and maximum roll angle of the load on the flank about a radius."""
        low, high = sorted((roll_at(self.form / self.base), self.tip_corner[1]))
        middle = min(max(roll_at(radius / self.base), low), high)
        # arc length of the involute: base roll^2/2
        half = _LOAD_HALF / self.base
        ends = [math.sqrt(max(0.0, middle * middle + 2.0 * side * half)) for side in (-1.0, 1.0)]
        room = 0.02 * (high - low)
        begin, end = max(ends[0], low + room), min(ends[1], high - room)
        return begin, end

    def pieces(self, load_radius: float) -> list[tuple[str, Curve, Sequence[float]]]:
        """Names, curves and places of panels from below the tooth counter-clockwise to the middle of its tip."""
        stand = self.standing
        begin, end = self.load_patch(load_radius)
        form, radius = roll_at(self.form / self.base), self.tip_corner[0]
        roll, center = self.tip_corner[1], self.tip_corner[2]
        flank = [*_between(form, begin if form < roll else end, _FLANK)]
        patch = np.linspace(begin, end, _LOAD_PANELS + 1)
        patch = patch if form < roll else patch[::-1]
        beyond = _between(float(patch[-1]), roll, (0.0, 0.5, 1.0))
        first, last = np.angle(self.flank(roll) - center), np.angle(self._sign * center)
        tip = float(np.angle(center))
        corner = arc(radius, center)
        over = _turned(first, last, clockwise=self.ring)
        return [
            *self._rim(),
            ("fillet", lambda at: stand(self.fillet(at)), _between(*self.ends, _FILLET)),
            ("flank", lambda at: stand(self.flank(at)), flank),
            ("load", lambda at: stand(self.flank(at)), list(patch)),
            ("flank", lambda at: stand(self.flank(at)), beyond),
            ("corner", lambda at: stand(corner(at)), _between(*over, (0.0, 0.5, 1.0))),
            ("tip", lambda at: stand(arc(self.tip)(at)), _between(tip, math.pi / self.teeth, (0.0, 0.5, 1.0))),
        ]

    def _rim(self) -> list[tuple[str, Curve, Sequence[float]]]:
        """Far side of the rim, its side, and the land beside the fillet, with rounded corners."""
        sign, stand, half = self._sign, self.standing, math.pi / self.teeth
        far = self.root - sign * self.rim
        edge = half - 2.0 * BESIDE * half
        edge = max(edge, half - 0.95 * math.pi)
        rounding = min(0.5, 0.2 * self.rim, 0.2 * far * (half - edge))
        side = np.exp(1j * edge)
        below, above = far + sign * rounding, self.root - sign * rounding
        turns = (math.asin(rounding / below), math.asin(rounding / above))
        centers = [place * np.exp(1j * (edge + turn)) for place, turn in zip((below, above), turns, strict=True)]
        ends = [place * math.cos(turn) for place, turn in zip((below, above), turns, strict=True)]
        to_side = edge - 0.5 * math.pi
        inward = edge + turns[0] + (math.pi if not self.ring else 0.0)
        outward = edge + turns[1] + (0.0 if not self.ring else math.pi)
        at_root = float(np.angle(self.fillet(np.asarray([self.ends[0]]))[0]))
        land = _between(at_root, edge + turns[1], _LAND)
        first, second = (
            _between(*_turned(*ends, clockwise=self.ring), (0.0, 0.5, 1.0))
            for ends in ((inward, to_side), (to_side, outward))
        )
        return [
            ("far", lambda at: stand(arc(far)(at)), _between(half, edge + turns[0], (0.0, 0.25, 0.5, 0.75, 1.0))),
            ("side", lambda at: stand(arc(rounding, centers[0])(at)), first),
            ("side", lambda at: stand(at * side), _between(ends[0], ends[1], (0.0, 0.33, 0.67, 1.0))),
            ("side", lambda at: stand(arc(rounding, centers[1])(at)), second),
            ("land", lambda at: stand(arc(self.root)(at)), land[::-1]),
        ]


def _between(low: float, high: float, shares: Sequence[float]) -> list[float]:
    return [low + share * (high - low) for share in shares]


def _turned(start: float, end: float, *, clockwise: bool) -> tuple[float, float]:
    """Angles of an arc from one direction to another, the way round that is named."""
    turn = (end - start) % (2.0 * math.pi)
    return float(start), float(start + (turn - 2.0 * math.pi if clockwise else turn))


ORDER = 8
"""Gauss nodes of a panel."""
NODES, WEIGHTS = np.polynomial.legendre.leggauss(ORDER)
_POWERS = np.vander(NODES, ORDER, increasing=True)
DERIVATIVE = np.vander(NODES, ORDER, increasing=True)[:, : ORDER - 1] * np.arange(1, ORDER) @ np.linalg.inv(_POWERS)[1:]
"""Values at the nodes of a panel to those of the derivative on [-1, 1]."""
_RAISED = (NODES[:, None] ** np.arange(1, ORDER + 1) - (-1.0) ** np.arange(1, ORDER + 1)) / np.arange(1, ORDER + 1)
INTEGRAL = _RAISED @ np.linalg.inv(_POWERS)
"""Values at the nodes of a panel to those of the integral from its beginning."""


@dataclass(frozen=True)
class HalfContour:
    """The right half of a mirrored contour, from the y axis counter-clockwise to the y axis.

    Parameters
        points : (P, 8) complex array - Gauss nodes of its panels, in order
    """

    points: Points

    @cached_property
    def rates(self) -> Points:
        """Derivatives by the place on each panel, -1 to 1."""
        return self.points @ DERIVATIVE.T

    @cached_property
    def steps(self) -> Points:
        """d tau of each node: derivative times weight."""
        return self.rates * WEIGHTS

    @cached_property
    def lengths(self) -> Reals:
        """ds of each node."""
        return np.abs(self.steps)

    @cached_property
    def _half_bends(self) -> Reals:
        """Limit of d th where tau = t: half the curvature times ds."""
        bent = self.rates @ DERIVATIVE.T
        found: Reals = (bent * self.rates.conj()).imag / (2.0 * np.abs(self.rates) ** 2) * WEIGHTS
        return found

    @cached_property
    def _kernels(self) -> tuple[Points, Points]:
        """What multiplies omega and conj omega of the right half, at mirrored loads and at the others: P_R, Q_R first,
        then what the left half adds."""
        own, steps = self.points.ravel(), self.steps.ravel()
        right = own[None, :] - own[:, None]
        np.fill_diagonal(right, 1.0)
        turned = (steps[None, :] / right).imag
        turned[np.diag_indices_from(turned)] = self._half_bends.ravel()
        double = right / right.conj()
        rates = self.rates.ravel()
        double[np.diag_indices_from(double)] = rates / rates.conj()
        left = -own.conj()[None, :] - own[:, None]
        beside = (steps.conj()[None, :] / left).imag  # the left half runs the other way: d tau is conj(d tau)
        crossed = left / left.conj() * beside
        direct, conjugate = np.stack((turned, beside)) / np.pi, np.stack((-double * turned, -crossed)) / np.pi
        return direct.astype(complex), conjugate.astype(complex)

    def solved(self, mirrored: Points, other: Points) -> tuple[Points, Points]:
        """omega of the right half under loads that mirror, f(-conj z) = -conj f(z), and under those of the other sign.

        Parameters
            mirrored, other : (P, 8) complex arrays - f at the nodes
        """
        return self._solved(1.0, mirrored), self._solved(-1.0, other)

    def _solved(self, sign: float, loads: Points) -> Points:
        (direct, beside), (conjugate, crossed) = self._kernels
        plain, bar = direct - sign * crossed, conjugate - sign * beside
        plain = plain + np.eye(len(plain))
        first, second = plain + bar, 1j * (plain - bar)
        system = np.block([[first.real, second.real], [first.imag, second.imag]])
        if sign < 0.0:
            turn = 1j * self.points.ravel()
            free = np.concatenate((turn.real, turn.imag))
            system += np.outer(free, free) / (free @ free)
        flat = loads.ravel()
        found = np.linalg.solve(system, np.concatenate((flat.real, flat.imag)))
        return (found[: flat.size] + 1j * found[flat.size :]).reshape(loads.shape)

    def stress_sums(self, sign: float, omega: Points, panels: Sequence[int]) -> Reals:
        """sigma_t + sigma_n at the nodes of some panels of the right half, (len(panels), 8).

        Parameters
            sign : float - 1 of a load that mirrors, -1 of one of the other sign
            omega : (P, 8) complex array - of `solved`
            panels : their numbers
        """
        own, steps, values = self.points.ravel(), self.steps.ravel(), omega.ravel()
        places = (np.asarray(panels)[:, None] * ORDER + np.arange(ORDER)).ravel()
        at, here = own[places], values[places]
        away = own[None, :] - at[:, None]
        away[np.arange(len(places)), places] = 1.0
        differences = (values[None, :] - here[:, None]) / away
        slopes = (omega @ DERIVATIVE.T / self.rates).ravel()
        differences[np.arange(len(places)), places] = slopes[places]
        far = -own.conj()[None, :] - at[:, None]
        mirrored = (-sign * values.conj()[None, :] - here[:, None]) / far
        whole = differences @ steps + mirrored @ steps.conj()
        phi = (here + whole / (2j * np.pi)).reshape(-1, ORDER)
        found: Reals = 4.0 * (phi @ DERIVATIVE.T / self.rates[list(panels)]).real
        return found


def panels(curve: object, breaks: Sequence[float]) -> Points:
    """Gauss nodes of a curve on panels between places of its parameter, (len(breaks) - 1, 8).

    Parameters
        curve : function of an array of the parameter that gives complex points
        breaks : places of the parameter, in the order of the contour
    """
    ends = np.asarray(breaks, dtype=float)
    middle, half = 0.5 * (ends[1:] + ends[:-1]), 0.5 * (ends[1:] - ends[:-1])
    places = middle[:, None] + half[:, None] * NODES
    return np.asarray(curve(places.ravel())).reshape(places.shape)  # type: ignore[operator]


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

    @cached_property
    def tension(self) -> Peak:
        """The maximum tension in the fillet of the loaded flank, away from its joints.

        Between the nodes by the polynomial of each panel.
        """
        places = self.contour.pieces(self.load_radius)
        breaks = next(breaks for name, _, breaks in places if name == "fillet")
        low, high = (breaks[0] + share * (breaks[-1] - breaks[0]) for share in _SOUGHT)
        best = Peak(-math.inf, 0j)
        fine = np.linspace(-1.0, 1.0, 41)
        to_fine = np.vander(fine, ORDER) @ np.linalg.inv(np.vander(np.polynomial.legendre.leggauss(ORDER)[0], ORDER))
        for panel, row in enumerate(self.stresses[0]):
            start, end = breaks[panel], breaks[panel + 1]
            at = 0.5 * (start + end) + 0.5 * (end - start) * fine
            inside = (at >= low - 1e-12 * (end - start)) & (at <= high + 1e-12 * (end - start))
            if not inside.any():
                continue
            values = np.where(inside, to_fine @ row, -np.inf)
            k = int(np.argmax(values))
            if values[k] > best.factor:
                best = Peak(float(values[k]), complex((to_fine @ self.fillet[panel])[k]))
        return best


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
