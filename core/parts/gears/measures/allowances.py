"""Allowances of tooth thickness (DIN 3967) and of the centre distance (js7), and the backlash that they leave."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import unlike
from gearlink.core.numerics.ranges import row_of
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.pitch_pair import Pair
from gearlink.core.parts.gears.tooth import teeth
from gearlink.core.parts.gears.tooth.involute import involute_rise

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
    row = row_of(_UP_TO, diameter)
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
    row = row_of(_JS_UP_TO, distance)
    if row == len(_JS_UP_TO):
        raise NoSolution(
            f"centre distance: {unlike(distance, 3150.0)} mm (table of js7: up to 3150 mm)", fix="give a number in mm"
        )
    return _IT7[row] / 2000.0


@dataclass(frozen=True)
class MeshPlay:
    """The backlash at one centre distance with one pair of tooth thicknesses.

    j_wt = 2 r_w1'/z_1 [(z_1 + z_2)(inv(alpha') - inv(alpha_t)) - 2 (x_1 + x_2) tan(alpha_n)]
           - (E_1 + E_2)/cos(beta) r_w1'/r_1

    Parameters
        off : float [mm] - centre distance (its magnitude) less that of the pair
        thinned : float [mm] - E_1 + E_2, allowances of both tooth thicknesses in the normal section
    Raises
        NoSolution - where the centre distance leaves no pressure angle
    Notes
        Theoretical: temperature, play of bearings and deviations of the teeth are not in it. Compared with the
        strings of both flanks along the line of action: 2e-40 at forty digits.
    Example
        >>> play = MeshPlay(GearPair.from_shift(3.0, (24, 55)), 0.05, -0.2)
        >>> round(play.circumferential, 6), round(play.normal, 6)
        (0.236555, 0.222195)

    Source
        own derivation; DIN 3967 for the quantities
    """

    pair: GearPair
    off: float
    thinned: float

    @cached_property
    def _rise(self) -> float:
        """alpha' - alpha_wt."""
        distance, alpha = abs(self.pair.center_distance), self.pair.working_pressure_angle
        return teeth.pressure_angle_rise(distance, self.off, alpha, what="centre distance at a limit of its allowance")

    @property
    def pressure_angle(self) -> float:
        """alpha' [rad]."""
        return self.pair.working_pressure_angle + self._rise

    @cached_property
    def working_radius(self) -> float:
        """r_w1' [mm]."""
        return self.pair.base_radius[0] / math.cos(self.pressure_angle)

    @cached_property
    def circumferential(self) -> float:
        """j_wt on the working circles in the transverse section [mm]."""
        pair, (z1, z2) = self.pair, self.pair.teeth
        opened = (z1 + z2) * involute_rise(pair.working_pressure_angle, self._rise)
        lacking = pair.shift_sum - (pair.profile_shift[0] + pair.profile_shift[1])
        if pair.given_shift is None or pair.given_distance is None:
            lacking = 0.0
        opened += 2.0 * lacking * math.tan(pair.pressure_angle)
        thinned = self.thinned / math.cos(pair.helix_angle) / pair.reference_radius[0]
        return self.working_radius * (2.0 * opened / z1 - thinned)

    @property
    def normal(self) -> float:
        """j_bn = j_wt cos(alpha') cos(beta_b), between the flanks [mm]."""
        return self.circumferential * math.cos(self.pressure_angle) * math.cos(self.pair.base_helix_angle)

    @property
    def angle(self) -> Pair:
        """j_wt/r_w', the free turn of each gear while the other stands [rad]."""
        z1, z2 = self.pair.teeth
        first = self.circumferential / self.working_radius
        return first, first * z1 / abs(z2)


@dataclass(frozen=True, kw_only=True)
class Backlash:
    """The minimum and the maximum backlash.

    Parameters
        upper, lower : (float, float) [mm] - allowances E_sns, E_sni of both gears
        distance_allowance : float [mm] - plus and minus of the centre distance
    """

    pair: GearPair
    upper: Pair = (0.0, 0.0)
    lower: Pair = (0.0, 0.0)
    distance_allowance: float = 0.0

    @cached_property
    def _ends(self) -> tuple[MeshPlay, MeshPlay]:
        """Minimum and maximum; a larger centre distance takes backlash away from a ring and its pinion."""
        away = self.pair.signs[1] * self.distance_allowance
        least = MeshPlay(self.pair, -away, self.upper[0] + self.upper[1])
        return least, MeshPlay(self.pair, away, self.lower[0] + self.lower[1])

    @property
    def circumferential(self) -> Pair:
        """j_wt [mm], minimum and greatest."""
        return self._ends[0].circumferential, self._ends[1].circumferential

    @property
    def normal(self) -> Pair:
        """j_bn [mm], minimum and greatest."""
        return self._ends[0].normal, self._ends[1].normal

    @property
    def angle(self) -> tuple[Pair, Pair]:
        """Free turn of gear 1 and of gear 2 [rad], each minimum and greatest."""
        least, greatest = self._ends[0].angle, self._ends[1].angle
        return (least[0], greatest[0]), (least[1], greatest[1])
