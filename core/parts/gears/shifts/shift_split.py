"""How a pair's shift sum is shared: equal sliding, tips, root strength, no undercut.

With the shift sum the mesh is fixed: working pressure angle, line of action and tip alteration do not change with x_1.
Each criterion has a statement of what exists; none of them takes a root for granted.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import unlike
from gearlink.core.numerics.roots import bracketed_root, maximum, roots_on, sign_changes
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.pitch_pair import Pair

Strength = Callable[[GearPair], Pair | None]
"""Root stress over what is permissible of gear 1 and 2 of a pair, in any common unit; None where it has none."""
SPLITS = ("equal", "sliding", "tip", "root", "undercut")
_POINTS = 60
_WIDEST = 10.0
_APART = 1e-3
_GIVEN = "give shift_split as a number, the profile shift of gear 1"


class Split(NamedTuple):
    """x_1 of a criterion and what it is."""

    first: float
    statement: str


@dataclass(frozen=True)
class Diagonal:
    """All pairs of the same shift sum, by x_1.

    Parameters
        pair : GearPair - any of them
    Example
        >>> diagonal = Diagonal(GearPair.from_shift(1.0, (17, 53), (0.3, 0.3)))
        >>> round(diagonal.equal_sliding().first, 9)
        0.45102895

    Source
        own derivation; the counts of roots were found by scanning some 200 random cases
    """

    pair: GearPair

    @cached_property
    def shift_sum(self) -> float:
        """x_1 + x_2 that is shared [module]."""
        given = self.pair.given_shift
        return self.pair.shift_sum if given is None else given[0] + given[1]

    def at(self, first: float) -> GearPair:
        """The pair with x_1."""
        if self.pair.given_shift is None:
            return replace(self.pair, given_first_shift=first)
        return replace(self.pair, given_shift=(first, self.shift_sum - first))

    @cached_property
    def line(self) -> float:
        """T [mm], signed."""
        return (self.pair.base_radius[0] + self.pair.base_radius[1]) * math.tan(self.pair.working_pressure_angle)

    def _tip(self, gear: int, first: float) -> float:
        shift = first if gear == 0 else self.shift_sum - first
        height = self.pair.addendum + shift + self.pair.tip_alteration[gear]
        return self.pair.reference_radius[gear] + self.pair.module * height

    def _at_tip(self, gear: int, first: float) -> float:
        """Radius of curvature at the tip, rho_E1 or rho_A2; signed."""
        tip, base = self._tip(gear, first), self.pair.base_radius[gear]
        return self.pair.signs[gear] * math.sqrt(max(0.0, (tip - base) * (tip + base)))

    def _where_tip_is(self, gear: int, radius: float) -> float:
        """x_1 with which the tip of a gear has a radius."""
        height = (radius - self.pair.reference_radius[gear]) / self.pair.module
        shift = height - self.pair.addendum - self.pair.tip_alteration[gear]
        return shift if gear == 0 else self.shift_sum - shift

    @cached_property
    def domain(self) -> Pair:
        """x_1 between which contact stays on both involutes.

        Raises
            NoSolution - where there is no such x_1
        """
        base, sign = self.pair.base_radius, self.pair.signs[1]
        low = [self._where_tip_is(1, sign * math.hypot(base[1], self.line)), self._where_tip_is(0, base[0])]
        high = [self._where_tip_is(1, base[1])]
        if self.pair.internal:
            low, high = [*low, *high], [max(low) + _WIDEST]
        if not self.pair.internal or self.line > 0.0:
            high.append(self._where_tip_is(0, math.hypot(base[0], self.line)))
        if not max(low) < min(high):
            raise NoSolution("no split of the shift sum keeps contact on both involutes", fix="use more teeth")
        return max(low), min(high)

    def _require_shares(self) -> None:
        if self.pair.given_tip_radius is not None:
            raise NoSolution("with given tip diameters sliding and contact do not depend on the split", fix=_GIVEN)

    def equal_sliding(self) -> Split:
        """x_1 of equal specific sliding at both roots: rho_A2 rho_E2 = u^2 rho_A1 rho_E1.

        Raises
            NoSolution - where no share has it
        Notes
            zeta_A1 - zeta_E2 rises strictly with x_1, so there is at most one.
        """
        self._require_shares()
        u2 = self.pair.gear_ratio**2

        def difference(first: float) -> float:
            end, start = self._at_tip(0, first), self._at_tip(1, first)
            return u2 * (self.line - start) * end - start * (self.line - end)

        low, high = self.domain
        try:
            return Split(bracketed_root(difference, low, high), "the only split with equal sliding")
        except NoSolution:
            raise NoSolution("no split of the shift sum makes the sliding of both gears equal", fix=_GIVEN) from None

    def equal_tips(self) -> Split:
        """x_1 of equal tip thickness.

        Raises
            NoSolution - where no share has it
        """
        self._require_shares()

        def difference(first: float) -> float:
            one, other = self.at(first).tip_thickness
            return one - other

        low, high = self.domain
        grid = [low + (high - low) * k / _POINTS for k in range(1, _POINTS)]
        values = [difference(first) for first in grid]
        falling = [k for k in sign_changes(values) if values[k] >= 0.0]
        if not falling:
            raise NoSolution("no split of the shift sum makes both tips equally thick", fix=_GIVEN)
        middle = min(falling, key=lambda k: abs(grid[k] - self.shift_sum / 2.0))
        return Split(bracketed_root(difference, grid[middle], grid[middle + 1]), "equal tips")

    @cached_property
    def without_undercut(self) -> Pair:
        """x_1 between which no gear is undercut.

        Raises
            NoSolution - where the shift sum is too small for both
        """
        least = self.pair.min_shift_no_undercut
        low = least[0]
        high = low + _WIDEST if least[1] is None else self.shift_sum - least[1]
        if low > high:
            needed = self.shift_sum + low - high
            raise NoSolution(
                f"sum of the profile shifts: {unlike(self.shift_sum, needed)} (limit >= {safely_above(needed)} for "
                "no undercut on both gears)",
                fix="use a larger centre distance or more teeth",
            )
        return low, high

    def no_undercut(self) -> Split:
        """x_1 nearest to an equal share with which no gear is undercut.

        Raises
            NoSolution - where there is none
        """
        low, high = self.without_undercut
        first = min(max(self.shift_sum / 2.0, low), high)
        return Split(first, f"no undercut for x1 from {low:.4g} to {high:.4g}")

    def equal_roots(self, strength: Strength) -> Split:
        """x_1 of equal root stress over what is permissible; where there is none, of the minimum greatest.

        Raises
            NoSolution - where no share has root sections, or the stress still falls where a tooth becomes pointed
        Notes
            The ratio is not monotone: none to three roots. A scan of the shares with neither undercut nor pointed teeth
            finds them; of several the one of the minimum stress is taken.
        """
        low, high = self.without_undercut

        def whole(first: float) -> bool:
            try:
                return min(self.at(first).tip_thickness) > 0.0
            except NoSolution:
                return False

        def stresses(first: float) -> Pair | None:
            try:
                return strength(self.at(first)) if whole(first) else None
            except NoSolution:
                return None

        def greatest(first: float) -> float:
            found = stresses(first)
            return math.inf if found is None else max(found)

        def ratio(first: float) -> float:
            found = stresses(first)
            return math.nan if found is None else math.log(found[0] / found[1])

        grid = [first for k in range(_POINTS + 1) if stresses(first := low + (high - low) * k / _POINTS) is not None]
        if not grid:
            raise NoSolution(
                "no split of the shift sum leaves both gears full tips and a root section of ISO 6336-3", fix=_GIVEN
            )
        roots = roots_on(ratio, grid)
        if roots:
            count = "the only share" if len(roots) == 1 else f"the better of {len(roots)} shares"
            return Split(min(roots, key=greatest), f"{count} of equal root stress")
        best = min(range(len(grid)), key=lambda k: greatest(grid[k]))
        ends = grid[max(0, best - 1)], grid[min(len(grid) - 1, best + 1)]
        first, _ = maximum(lambda x: -greatest(x), *ends)
        if not all(whole(first + off * _APART) for off in (-1.0, 1.0)):
            raise NoSolution(
                "no split gives equal root stress: the maximum stress has its minimum where a tooth becomes pointed",
                fix=_GIVEN,
            )
        return Split(first, "no split gives equal root stress; this one has the lowest maximum")

    def split(self, name: str, strength: Strength) -> Split:
        """The share of one of SPLITS.

        Raises
            NoSolution - where the criterion has none
        """
        if name == "root":
            return self.equal_roots(strength)
        found = {"sliding": self.equal_sliding, "tip": self.equal_tips, "undercut": self.no_undercut}.get(name)
        return Split(self.shift_sum / 2.0, "equal shifts") if found is None else found()
