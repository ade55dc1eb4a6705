"""Radial internal clearance of deep-groove ball bearings, ISO 5753-1, before mounting."""

from __future__ import annotations

from bisect import bisect_left

from gearlink.core.base.errors import NoSolution, named

GROUPS = ("C2", "CN", "C3", "C4", "C5")
_BORES = (10, 18, 24, 30, 40, 50, 65, 80, 100)
# Minimum and maximum clearance in um, a row for each range of bores, a pair for each group.
_ROWS = (
    ((0, 7), (2, 13), (8, 23), (14, 29), (20, 37)),
    ((0, 9), (3, 18), (11, 25), (18, 33), (25, 45)),
    ((0, 10), (5, 20), (13, 28), (20, 36), (28, 48)),
    ((1, 11), (5, 20), (13, 28), (23, 41), (30, 53)),
    ((1, 11), (6, 20), (15, 33), (28, 46), (40, 64)),
    ((1, 11), (6, 23), (18, 36), (30, 51), (45, 73)),
    ((1, 15), (8, 28), (23, 43), (38, 61), (55, 90)),
    ((1, 15), (10, 30), (25, 51), (46, 71), (65, 105)),
    ((1, 18), (12, 36), (30, 58), (53, 84), (75, 120)),
)


def radial_clearance(bore: float, group: str) -> tuple[float, float]:
    """Minimum and maximum radial clearance of an unmounted bearing; fits and heat take some of it away.

    Parameters
        bore : float [mm] - above 0, up to 100
        group : str - C2, CN, C3, C4 or C5
    Returns
        minimum, maximum : float [mm]
    Raises
        NoSolution - no such group, or a bore outside of the table
    Example
        >>> radial_clearance(65, "C3")
        (0.023, 0.043)

    Source
        ISO 5753-1, table of deep-groove ball bearings with cylindrical bore
    """
    if group not in GROUPS:
        raise NoSolution(f"no clearance group {named(group)}: ISO 5753-1 has {', '.join(GROUPS)}")
    if not 0 < bore <= _BORES[-1]:
        raise NoSolution(
            f"the table of bearing clearances reaches to a bore of {_BORES[-1]} mm, not {bore:g} mm",
            fix="give clearance: [minimum, maximum]",
        )
    least, greatest = _ROWS[bisect_left(_BORES, bore)][GROUPS.index(group)]
    return least / 1000, greatest / 1000
