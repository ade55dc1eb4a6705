"""Backlash of a pair at the limits of tooth thickness and centre distance, exact in both."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.pitch_pair import Pair
from gearlink.core.parts.gears.tooth import teeth
from gearlink.core.parts.gears.tooth.involute import involute_rise


@dataclass(frozen=True)
class MeshPlay:
    """The backlash at one centre distance with one pair of tooth thicknesses.

    j_wt = 2 r_w1'/z_1 [(z_1 + z_2)(inv(alpha') - inv(alpha_t)) - 2 (x_1 + x_2) tan(alpha_n)]
           - (E_1 + E_2)/cos(beta) r_w1'/r_1

    Parameters
        pair : GearPair
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
        pair : GearPair
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
