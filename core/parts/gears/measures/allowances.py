"""Allowances of tooth thickness (DIN 3967) and of the centre distance (js7)."""

from __future__ import annotations

import re
from bisect import bisect_left

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import unlike

_UP_TO = (10.0, 50.0, 125.0, 280.0, 560.0, 1000.0, 1600.0, 2500.0, 4000.0, 6300.0, 10000.0)
_UPPER = {
    "a": (100, 135, 180, 250, 330, 450, 600, 820, 1100, 1500, 2000),
    "ab": (85, 110, 150, 200, 280, 370, 500, 680, 920, 1250, 1650),
    "b": (70, 95, 125, 170, 230, 310, 420, 560, 760, 1020, 1350),
    "bc": (58, 75, 105, 140, 190, 260, 340, 460, 620, 840, 1150),
    "c": (48, 65, 85, 115, 155, 210, 290, 390, 520, 700, 940),
    "cd": (40, 54, 70, 95, 130, 175, 240, 320, 430, 580, 780),
    "d": (33, 44, 60, 80, 110, 145, 200, 270, 360, 480, 640),
    "e": (22, 30, 40, 56, 75, 100, 135, 180, 250, 330, 450),
    "f": (10, 14, 19, 26, 35, 48, 64, 85, 115, 155, 210),
    "g": (5, 7, 9, 12, 17, 22, 30, 41, 56, 75, 100),
    "h": (0,) * 11,
}
_TOLERANCE = {
    "21": (3, 5, 6, 8, 10, 12, 16, 20, 25, 30, 40),
    "22": (5, 8, 10, 12, 16, 20, 25, 30, 40, 50, 60),
    "23": (8, 12, 16, 20, 25, 30, 40, 50, 60, 80, 100),
    "24": (12, 20, 25, 30, 40, 50, 60, 80, 100, 130, 160),
    "25": (20, 30, 40, 50, 60, 80, 100, 130, 160, 200, 250),
    "26": (30, 50, 60, 80, 100, 130, 160, 200, 250, 300, 400),
    "27": (50, 80, 100, 130, 160, 200, 250, 300, 400, 500, 600),
    "28": (80, 130, 160, 200, 250, 300, 400, 500, 600, 800, 1000),
    "29": (130, 200, 250, 300, 400, 500, 600, 800, 1000, 1300, 1600),
    "30": (200, 300, 400, 500, 600, 800, 1000, 1300, 1600, 2000, 2400),
}
SERIES = r"(2[1-9]|30)(ab|a|bc|b|cd|c|d|e|f|g|h)"
_JS_UP_TO = (
    3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500, 630, 800, 1000, 1250, 1600, 2000, 2500, 3150,
)  # fmt: skip
_IT7 = (10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63, 70, 80, 90, 105, 125, 150, 175, 210)


def thickness_allowances(series: str, diameter: float) -> tuple[float, float]:
    """Upper and lower allowance of the tooth thickness in the normal section.

    E_sni = E_sns - T_sn

    Parameters
        series : str - "27cd": tolerance series and letter of the upper allowance
        diameter : float [mm] - reference diameter, to 10 m
    Returns
        E_sns, E_sni : (float, float) [mm] - never positive
    Raises
        NoSolution - for a series that DIN 3967 does not have, or a gear beyond its tables
    Example
        >>> thickness_allowances("27cd", 100.0)
        (-0.07, -0.17)

    Source
        DIN 3967:1978, tables 1 and 2 as two public transcriptions agree on them; the standard was not opened
    """
    found = re.fullmatch(SERIES, series)
    if found is None:
        raise NoSolution(
            f"series {series!r} is none of DIN 3967: a tolerance series 21 to 30 and a letter a, ab, b, bc, c, cd, d, "
            "e, f, g or h, such as 25cd"
        )
    row = bisect_left(_UP_TO, diameter)
    if row == len(_UP_TO):
        raise NoSolution(
            f"reference diameter: {unlike(diameter, 1e4)} mm (DIN 3967: up to 10000 mm)", fix="give limits"
        )
    upper = _UPPER[found[2]][row]
    return -upper / 1000.0 + 0.0, -(upper + _TOLERANCE[found[1]][row]) / 1000.0


def js7(distance: float) -> float:
    """Half of IT7, the plus and minus of js7.

    Parameters
        distance : float [mm] - centre distance, to 3150 mm
    Returns
        allowance : float [mm]
    Raises
        NoSolution - beyond 3150 mm
    Example
        >>> js7(122.8), js7(290.3)
        (0.02, 0.026)

    Source
        ISO 286-1, IT7; a row a = 250 to 315 mm in DIN 3967's example
    """
    row = bisect_left(_JS_UP_TO, distance)
    if row == len(_JS_UP_TO):
        raise NoSolution(
            f"centre distance: {unlike(distance, 3150.0)} mm (table of js7: up to 3150 mm)", fix="give a number in mm"
        )
    return _IT7[row] / 2000.0
