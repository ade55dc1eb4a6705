"""Tolerances of gear teeth, ISO 1328-1 edition 2013."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlink.core.errors import NoSolution

EDITION = 2013


@dataclass(frozen=True, slots=True)
class ToothTolerances:
    """Allowed deviations of one gear [mm], named as the standard names them."""

    single_pitch: float
    cumulative_pitch: float
    profile_slope: float
    profile_form: float
    profile: float
    helix_slope: float
    helix_form: float
    helix: float
    runout: float


def tooth_tolerances(grade: int, module: float, diameter: float, width: float) -> ToothTolerances:
    """Allowed deviations of a gear's teeth.

    f_pT = (0.001 d + 0.4 m + 5) k, F_pT = (0.002 d + 0.55 sqrt d + 0.7 m + 12) k, k = sqrt(2)^(A - 5), in um

    Parameters
        grade : int - flank tolerance class A, 1 to 11
        module : float [mm] - normal module, 0.5 to 70
        diameter : float [mm] - reference diameter, 5 to 15000
        width : float [mm] - face width, 4 to 1200
    Returns
        tolerances : ToothTolerances [mm] - rounded as the standard does
    Raises
        NoSolution - outside of the standard's range: nothing is extrapolated
    Notes
        Edition 1995 has other formulas and grades. F_rT = 0.9 F_pT stands in an informative annex.
    Example
        >>> tooth_tolerances(6, 3, 120, 30).cumulative_pitch
        0.029

    Source
        ISO 1328-1:2013, 5.3 and annex F
    """
    _in_range(grade, module, diameter, width)
    k = math.sqrt(2) ** (grade - 5)
    root = math.sqrt(diameter)
    breadth = math.sqrt(width)
    cumulative = (0.002 * diameter + 0.55 * root + 0.7 * module + 12) * k
    slope, form = (0.4 * module + 0.001 * diameter + 4) * k, (0.55 * module + 5) * k
    helix_slope, helix_form = (0.05 * root + 0.35 * breadth + 4) * k, (0.07 * root + 0.45 * breadth + 4) * k
    return ToothTolerances(
        *(
            _rounded(value)
            for value in (
                (0.001 * diameter + 0.4 * module + 5) * k,
                cumulative,
                slope,
                form,
                math.hypot(slope, form),
                helix_slope,
                helix_form,
                math.hypot(helix_slope, helix_form),
                0.9 * cumulative,
            )
        )
    )


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
