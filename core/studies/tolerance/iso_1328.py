"""Tolerance of the pitch of gear teeth, ISO 1328-1 edition 2013."""

from __future__ import annotations

import math

from gearlink.core.base.errors import NoSolution

EDITION = 2013


def cumulative_pitch(grade: int, module: float, diameter: float, width: float) -> float:
    """Allowed cumulative pitch deviation of a gear.

    F_pT = (0.002 d + 0.55 sqrt d + 0.7 m + 12) k, k = sqrt(2)^(A - 5), in um

    Parameters
        grade : int - flank tolerance class A, 1 to 11
        module : float [mm] - normal module, 0.5 to 70
        diameter : float [mm] - reference diameter, 5 to 15000
        width : float [mm] - face width, 4 to 1200: the standard holds for no other
    Returns
        tolerance : float [mm] - rounded as the standard does
    Raises
        NoSolution - outside of the standard's range: nothing is extrapolated
    Notes
        Edition 1995 has other formulas and grades.
    Example
        >>> cumulative_pitch(6, 3, 120, 30)
        0.029

    Source
        ISO 1328-1:2013, 5.3
    """
    _in_range(grade, module, diameter, width)
    k = math.sqrt(2) ** (grade - 5)
    return _rounded((0.002 * diameter + 0.55 * math.sqrt(diameter) + 0.7 * module + 12) * k)


_RANGES = (("module", 0.5, 70.0), ("diameter", 5.0, 15000.0), ("face width", 4.0, 1200.0))


def _in_range(grade: int, *sizes: float) -> None:
    if not 1 <= grade <= 11:
        raise NoSolution(f"grade {grade} of ISO 1328-1:{EDITION} does not exist: it has 1 to 11")
    for (name, least, greatest), size in zip(_RANGES, sizes, strict=True):
        if not least <= size <= greatest:
            raise NoSolution(
                f"ISO 1328-1:{EDITION} holds for a {name} of {least:g} to {greatest:g} mm, not {size:.6g} mm:"
                " give the deviation itself"
            )


def _rounded(um: float) -> float:
    """To whole um above 10, to 0.5 above 5, else to 0.1; halves up; in mm."""
    step = 1.0 if um > 10 else 0.5 if um >= 5 else 0.1
    return round(math.floor(um / step + 0.5) * step / 1000, 9)
