"""Profile shifts that repair a gear pair and keep its centre distance."""

from __future__ import annotations

from dataclasses import replace

from gearlink.core.errors import NoSolution
from gearlink.core.gears.pair import GearPair
from gearlink.core.numerics.nearest_good import nearest_good

_FARTHEST = 1.5


def shared_anew(pair: GearPair, gear: int, x: float) -> GearPair:
    """The pair with profile shift x at one gear and the rest of the sum at its mate: the same centre distance."""
    rest = pair.shift_sum - x
    shifts = (x, rest) if gear == 0 else (rest, x)
    return replace(pair, given_shift=shifts, given_distance=None, given_first_shift=None)


def repaired_shifts(
    pair: GearPair, gear: int, tip_thickness: float, contact_ratio: float
) -> tuple[float, float] | None:
    """Profile shifts at the same centre distance, smaller at a gear whose tip is too thin or too high.

    Parameters
        pair : GearPair
        gear : int - 0 or 1
        tip_thickness : float [module] - what both tips must have
        contact_ratio : float - what the pair must have, if it has it now
    Returns
        shifts : (x_1, x_2) [module] - the nearest that repair it; None where none do
    Notes
        The mate takes over the difference. No tip may then be too thin or reach beyond the mate's base tangent
        point, no tooth be undercut.
    Example
        >>> x_1, x_2 = repaired_shifts(GearPair.from_shift(2.0, (12, 40), (0.9, -0.2)), 0, 0.4, 1.1)
        >>> x_1, round(x_2, 9)
        (0.473, 0.227)
    """

    def good(x: float) -> bool:
        try:
            trial = shared_anew(pair, gear, x)
            return (
                min(trial.tip_thickness) >= tip_thickness * trial.module
                and min(trial.interference_margin) >= 0.0
                and trial.contact_ratio >= min(contact_ratio, pair.contact_ratio)
                and all(x >= least for x, least in zip(trial.profile_shift, trial.min_shift_no_undercut, strict=True))
            )
        except NoSolution:
            return False

    start = pair.profile_shift[gear]
    found = nearest_good(start, start - _FARTHEST, good)
    return None if found is None else shared_anew(pair, gear, found).profile_shift
