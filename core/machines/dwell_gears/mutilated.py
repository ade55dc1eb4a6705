"""Long dwell by a mutilated gear: a wheel with groups of teeth turns a full gear now and then.

Between reduction and driven gear the wheel carries g groups of n teeth on a pitch circle that has room for Z_M teeth.
While a group passes, the driven gear (Z_F teeth) turns as in mesh with a full wheel; then it stands. The model knows
pitch circles only: tip cuts of the first and the last tooth and the locking arcs are not in it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import amount, short

LEAST_DRIVEN, MOST_DRIVEN = 17, 120


def teeth_for_times(
    share: float, driven_turn: float, groups: int, driven: int | None, most_teeth: int
) -> tuple[int, int, int, int]:
    """Teeth with which the driven gear turns for a wanted share of the cycle.

    n g/Z_M -> M/(M + D),   n = driven_turn Z_F

    Parameters
        share : float - M/(M + D), input turns of the motion over those of the cycle
        driven_turn : float - turns of the driven gear in a motion
        groups : int - g
        driven : int or None - Z_F; None: from 17 to 120
        most_teeth : int - most Z_M
    Returns
        full_teeth, group_teeth, driven_teeth, stops : int - Z_M, a multiple of g, n, Z_F, and as many locking arcs as
            lead every group from one to another
    Raises
        NoSolution - where no numbers of teeth give this turn, or the wheel would have more teeth than allowed
    Notes
        All combinations; of those whose share comes equally near the one with the fewest teeth.
    Example
        >>> teeth_for_times(0.25, 1.0, 1, None, 200)
        (68, 17, 17, 1)
    """
    found = []
    for z in range(LEAST_DRIVEN, MOST_DRIVEN + 1) if driven is None else (driven,):
        n = round(driven_turn * z)
        if n < 1 or abs(n - driven_turn * z) > 1e-9 * z:
            continue
        around = n / share  # full teeth per group
        for pitches in {math.floor(around), math.ceil(around)}:
            full = pitches * groups
            if n < pitches and full <= most_teeth:
                found.append((round(abs(n / pitches - share), 12), full, n, z))
    if not found:
        of = f"{driven} teeth" if driven is not None else f"{LEAST_DRIVEN} to {MOST_DRIVEN} teeth"
        raise NoSolution(
            (
                f"no driven gear of {of} makes {amount(driven_turn, 'turn', spec='.9g')} in {share:.6g} "
                f"of a cycle with a wheel of at most {most_teeth} teeth"
            ),
            fix="raise most_teeth, take fewer groups, or another driven_turn",
        )
    _, full, n, z = min(found)
    return full, n, z, z // math.gcd(z, n)


@dataclass(frozen=True)
class MutilatedGear:
    """Reduction, mutilated wheel and driven gear.

    Parameters
        reduction : float - i_r, input revolutions per revolution of the wheel
        full_teeth : int - Z_M, teeth that the wheel would have without gaps
        group_teeth : int - n, teeth in a group
        groups : int - g, groups evenly round the wheel
        driven_teeth : int - Z_F
        stops : int - locking arcs evenly round the driven gear
    Raises
        NoSolution - for numbers that are not positive, groups that fill the wheel, or stops that a group of teeth
            does not lead back to
    Example
        >>> gear = MutilatedGear(6.0, 80, 20, 1, 20)
        >>> gear.cycle_turns, gear.motion_turns, gear.dwell_turns
        (6.0, 1.5, 4.5)

    Source
        thesis 2.2.2 (figure 2-6) gives the mechanism without a formula; own derivation
    """

    reduction: float
    full_teeth: int
    group_teeth: int
    groups: int
    driven_teeth: int
    stops: int = 1

    def __post_init__(self) -> None:
        if not 0.0 < self.reduction < math.inf:
            raise NoSolution(f"reduction is {self.reduction:g}; it must be positive and finite", key="reduction")
        for name in ("full_teeth", "group_teeth", "groups", "driven_teeth", "stops"):
            number = getattr(self, name)
            if isinstance(number, bool) or not isinstance(number, int) or number < 1:
                raise NoSolution(f"{name.replace('_', ' ')} is {number!r}; it must be a whole number, at least 1")
        self._require_gaps()
        self._require_locking()

    def _require_gaps(self) -> None:
        used = self.group_teeth * self.groups
        if used < self.full_teeth:
            return
        most = (self.full_teeth - 1) // self.groups
        remedy = f"at most {_teeth(most)} in a group" if most else f"fewer than {amount(self.full_teeth, 'group')}"
        raise NoSolution(
            f"{amount(self.groups, 'group')} of {_teeth(self.group_teeth)} fill the wheel of "
            f"{_teeth(self.full_teeth)}: the driven gear never stops",
            fix=f"take {remedy}, or more full teeth than {used}",
        )

    def _require_locking(self) -> None:
        if self.group_teeth * self.stops % self.driven_teeth == 0:
            return
        needed = self.driven_teeth // math.gcd(self.driven_teeth, self.group_teeth)
        step = self.driven_teeth // math.gcd(self.driven_teeth, self.stops)
        raise NoSolution(
            (
                f"{_teeth(self.group_teeth)} advance the driven gear {short(self.group_teeth / self.driven_teeth)} "
                f"revolutions; it must stop at a locking arc ({self.stops} of them)"
            ),
            fix=f"set gears.group_teeth to a multiple of {step}, or take {amount(needed, 'stop')}",
        )

    @property
    def cycle_turns(self) -> float:
        """Input turns from the start of one motion to the start of the next, i_r/g."""
        return self.reduction / self.groups

    @property
    def motion_share(self) -> float:
        """Share of the cycle in which the driven gear turns, n g/Z_M."""
        return self.group_teeth * self.groups / self.full_teeth

    @property
    def dwell_share(self) -> float:
        """Share of the cycle in which it stands, 1 - n g/Z_M."""
        return (self.full_teeth - self.group_teeth * self.groups) / self.full_teeth

    @property
    def motion_turns(self) -> float:
        """Input turns of the motion, i_r n/Z_M."""
        return self.reduction * self.group_teeth / self.full_teeth

    @property
    def dwell_turns(self) -> float:
        """Input turns of the dwell, i_r/g - i_r n/Z_M."""
        return self.cycle_turns * self.dwell_share

    @property
    def driven_turn(self) -> float:
        """Turns of the driven gear per group of teeth, n/Z_F."""
        return self.group_teeth / self.driven_teeth

    @property
    def speed_ratio(self) -> float:
        """Speed of the driven gear over that of the input while it turns, Z_M/(Z_F i_r); pitch circles only."""
        return self.full_teeth / (self.driven_teeth * self.reduction)

    @cached_property
    def cycles_to_repeat(self) -> int:
        """Cycles after which the driven gear is at the same position again, Z_F/gcd(Z_F, n)."""
        return self.driven_teeth // math.gcd(self.driven_teeth, self.group_teeth)

    @property
    def gap(self) -> float:
        """Pitches from the last tooth of a group to the first of the next, Z_M/g - n + 1."""
        return self.full_teeth / self.groups - self.group_teeth + 1.0


def _teeth(number: int) -> str:
    return amount(number, "tooth", "teeth")
