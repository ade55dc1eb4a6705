"""Limits and fits of ISO 286 to 500 mm: its tables, since its formulas miss them by their rounding."""

from __future__ import annotations

import re

from gearlink.core.base.errors import NoSolution, named
from gearlink.core.numerics.ranges import row_of

_MAIN = (3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
_FINE = (3, 6, 10, 14, 18, 24, 30, 40, 50, 65, 80, 100, 120, 140, 160, 180, 200, 225, 250, 280, 315, 355, 400, 450, 500)
_MAIN_AND_FINE = {len(_MAIN): _MAIN, len(_FINE): _FINE}
# Tables in um over the size steps, whose upper ends stand above.
_IT: dict[int, tuple[float, ...]] = {
    1: (0.8, 1, 1, 1.2, 1.5, 1.5, 2, 2.5, 3.5, 4.5, 6, 7, 8),
    2: (1.2, 1.5, 1.5, 2, 2.5, 2.5, 3, 4, 5, 7, 8, 9, 10),
    3: (2, 2.5, 2.5, 3, 4, 4, 5, 6, 8, 10, 12, 13, 15),
    4: (3, 4, 4, 5, 6, 7, 8, 10, 12, 14, 16, 18, 20),
    5: (4, 5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25, 27),
    6: (6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36, 40),
    7: (10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63),
    8: (14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89, 97),
    9: (25, 30, 36, 43, 52, 62, 74, 87, 100, 115, 130, 140, 155),
    10: (40, 48, 58, 70, 84, 100, 120, 140, 160, 185, 210, 230, 250),
    11: (60, 75, 90, 110, 130, 160, 190, 220, 250, 290, 320, 360, 400),
    12: (100, 120, 150, 180, 210, 250, 300, 350, 400, 460, 520, 570, 630),
    13: (140, 180, 220, 270, 330, 390, 460, 540, 630, 720, 810, 890, 970),
    14: (250, 300, 360, 430, 520, 620, 740, 870, 1000, 1150, 1300, 1400, 1550),
    15: (400, 480, 580, 700, 840, 1000, 1200, 1400, 1600, 1850, 2100, 2300, 2500),
    16: (600, 750, 900, 1100, 1300, 1600, 1900, 2200, 2500, 2900, 3200, 3600, 4000),
    17: (1000, 1200, 1500, 1800, 2100, 2500, 3000, 3500, 4000, 4600, 5200, 5700, 6300),
    18: (1400, 1800, 2200, 2700, 3300, 3900, 4600, 5400, 6300, 7200, 8100, 8900, 9700),
}
# Upper deviation of the shafts a to g, with its sign turned.
_MINUS_ES: dict[str, tuple[float, ...]] = {
    "a": (270, 270, 280, 290, 290, 300, 300, 310, 320, 340, 360, 380, 410,
          460, 520, 580, 660, 740, 820, 920, 1050, 1200, 1350, 1500, 1650),
    "b": (140, 140, 150, 150, 150, 160, 160, 170, 180, 190, 200, 220, 240,
          260, 280, 310, 340, 380, 420, 480, 540, 600, 680, 760, 840),
    "c": (60, 70, 80, 95, 95, 110, 110, 120, 130, 140, 150, 170, 180,
          200, 210, 230, 240, 260, 280, 300, 330, 360, 400, 440, 480),
    "d": (20, 30, 40, 50, 65, 80, 100, 120, 145, 170, 190, 210, 230),
    "e": (14, 20, 25, 32, 40, 50, 60, 72, 85, 100, 110, 125, 135),
    "f": (6, 10, 13, 16, 20, 25, 30, 36, 43, 50, 56, 62, 68),
    "g": (2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 17, 18, 20),
}  # fmt: skip
# Lower deviation of the shafts k to u.
_EI: dict[str, tuple[float, ...]] = {
    "k": (0, 1, 1, 1, 2, 2, 2, 3, 3, 4, 4, 4, 5),
    "m": (2, 4, 6, 7, 8, 9, 11, 13, 15, 17, 20, 21, 23),
    "n": (4, 8, 10, 12, 15, 17, 20, 23, 27, 31, 34, 37, 40),
    "p": (6, 12, 15, 18, 22, 26, 32, 37, 43, 50, 56, 62, 68),
    "r": (10, 15, 19, 23, 23, 28, 28, 34, 34, 41, 43, 51, 54,
          63, 65, 68, 77, 80, 84, 94, 98, 108, 114, 126, 132),
    "s": (14, 19, 23, 28, 28, 35, 35, 43, 43, 53, 59, 71, 79,
          92, 100, 108, 122, 130, 140, 158, 170, 190, 208, 232, 252),
    "u": (18, 23, 28, 33, 33, 41, 48, 60, 70, 87, 102, 124, 144,
          170, 190, 210, 236, 258, 284, 315, 350, 390, 435, 490, 540),
}  # fmt: skip
# j: lower deviation of the shaft; J: upper deviation of the hole.
_J: dict[str, tuple[float, ...]] = {
    "j5": (-2, -2, -2, -3, -4, -5, -7, -9, -11, -13, -16, -18, -20),
    "j6": (-2, -2, -2, -3, -4, -5, -7, -9, -11, -13, -16, -18, -20),
    "j7": (-4, -4, -5, -6, -8, -10, -12, -15, -18, -21, -26, -28, -32),
    "J6": (2, 5, 5, 6, 8, 10, 13, 16, 18, 22, 25, 29, 33),
    "J7": (4, 6, 8, 10, 12, 14, 18, 22, 26, 30, 36, 39, 43),
    "J8": (6, 10, 12, 15, 20, 24, 28, 34, 41, 47, 55, 60, 66),
}
_CLASS = re.compile(r"(js|JS|[a-hj-npr-su]|[A-HJ-NPR-SU])(\d{1,2})")
GREATEST_SIZE = 500.0


def standard_tolerance(size: float, grade: int) -> float:
    """Width of the tolerance field IT1 to IT18.

    Parameters
        size : float [mm] - nominal size, above 0, up to 500
        grade : int - 1 to 18
    Returns
        width : float [mm]
    Raises
        NoSolution - size or grade outside of the tables
    Example
        >>> standard_tolerance(100, 7)
        0.035

    Source
        ISO 286-1, table 1
    """
    return _width(_size(size), grade) / 1000


def limit_deviations(size: float, tolerance_class: str) -> tuple[float, float]:
    """Lower and upper deviation of a hole (capital letter) or a shaft.

    Parameters
        size : float [mm] - nominal size, above 0, up to 500
        tolerance_class : str - such as H7, g6, js7
    Returns
        lower, upper : float [mm]
    Raises
        NoSolution - no such class, or none for this size
    Notes
        Exact cells of the tables: shafts a-h, j, js, k, m, n, p, r, s, u; holes by the rule of equal fits.
    Example
        >>> limit_deviations(40, "g6"), limit_deviations(300, "M6")
        ((-0.025, -0.009), (-0.041, -0.009))

    Source
        ISO 286-1, 4.3 (rules for holes); ISO 286-2
    """
    match = _CLASS.fullmatch(tolerance_class)
    if not match:
        raise NoSolution(
            f"no tolerance class {named(tolerance_class)}",
            fix=("write a letter a-h, j, js, k, m, n, p, r, s, u (capital for a hole) and a grade, as in H7 or g6"),
        )
    letter, grade = match[1], int(match[2])
    lower, upper = (_shaft if letter.islower() else _hole)(_size(size), letter, grade)
    return lower / 1000, upper / 1000


def fit_clearances(size: float, fit: str) -> tuple[float, float]:
    """Minimum and maximum clearance of a fit; negative where the parts interfere.

    Parameters
        size : float [mm]
        fit : str - hole and shaft, such as H7/g6
    Example
        >>> fit_clearances(20, "H7/g6")
        (0.007, 0.041)

    Source
        ISO 286-1, 3.3
    """
    hole, shaft = fit_parts(size, fit)
    return round(hole[0] - shaft[1], 9), round(hole[1] - shaft[0], 9)


def fit_parts(size: float, fit: str) -> tuple[tuple[float, float], tuple[float, float]]:
    """Deviations (lower, upper) of the hole and of the shaft of a fit [mm]."""
    hole, slash, shaft = fit.partition("/")
    if not slash or not hole[:1].isupper() or not shaft[:1].islower():
        raise NoSolution(
            f"no fit {named(fit)}", fix="write the hole's class, a slash and the shaft's class, as in H7/g6"
        )
    return limit_deviations(size, hole), limit_deviations(size, shaft)


def _size(size: float) -> float:
    if not 0 < size <= GREATEST_SIZE:
        raise NoSolution(
            f"the tables of ISO 286 cover sizes above 0 up to {GREATEST_SIZE:g} mm, not {size:g} mm",
            fix="give limits instead",
        )
    return size


def _width(size: float, grade: int) -> float:
    if grade not in _IT:
        raise NoSolution(f"no tolerance grade IT{grade}: ISO 286 has IT1 to IT18")
    return _cell(_IT[grade], size)


def _cell(table: tuple[float, ...], size: float) -> float:
    return table[row_of(_MAIN_AND_FINE[len(table)], size)]


def _shaft(size: float, letter: str, grade: int) -> tuple[float, float]:
    width = _width(size, grade)
    if letter == "js":
        return -width / 2, width / 2
    if letter == "h":
        return -width, 0.0
    if letter in _MINUS_ES:
        return -_cell(_MINUS_ES[letter], size) - width, -_cell(_MINUS_ES[letter], size)
    lower = _lower_of_shaft(size, letter, grade)
    return lower, lower + width


def _lower_of_shaft(size: float, letter: str, grade: int) -> float:
    if letter == "j":
        return _cell(_special(f"j{grade}", "j5, j6 and j7"), size)
    if letter == "k" and not 4 <= grade <= 7:
        return 0.0
    return _cell(_EI[letter], size)


def _special(name: str, exist: str) -> tuple[float, ...]:
    if name not in _J:
        raise NoSolution(
            f"no tolerance class {name}: of this letter there are {exist}; js (JS) is available for every grade"
        )
    return _J[name]


def _hole(size: float, letter: str, grade: int) -> tuple[float, float]:
    width = _width(size, grade)
    small = letter.lower()
    if small in ("js", "h") or small in _MINUS_ES:
        lower, upper = _shaft(size, small, grade)
        return -upper + 0.0, -lower
    special = letter == "J"
    upper = _cell(_special(f"J{grade}", "J6, J7 and J8"), size) if special else _upper_of_hole(size, small, grade)
    return upper - width, upper


def _upper_of_hole(size: float, small: str, grade: int) -> float:
    """ES of K to U: turned about from the shaft's, with the step of the grades where the standard adds it."""
    if small == "k" and grade > 8 and size > 3:
        raise NoSolution(f"K{grade} is not standardised above 3 mm", fix=f"use K8 or finer, or JS{grade}")
    if small == "n" and grade > 8:
        return 0.0 if size > 3 else -_cell(_EI["n"], size)
    if small == "m" and grade == 6 and 250 < size <= 315:
        return -9.0
    upper = -_cell(_EI[small], size)
    finest_with_step = 8 if small in "kmn" else 7
    if size > 3 and 2 <= grade <= finest_with_step:
        upper += _width(size, grade) - _width(size, grade - 1)
    return upper
