"""The section `rating` of a file: what ISO 6336 takes besides teeth, load and elasticity; limit stress over the cycles.

The limit stress falls in a line from the static knee to the long life; the damage is found from it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.mesh.pitch_pair import Pair
from gearlink.core.parts.gears.rating.materials import Endurance, GearSteel, Quality

System = Literal["pair", "sun-planet", "planet-ring"]
Modification = Literal["none", "crowning", "end-relief"]
_UNDER_LOAD = {"a": (0.8, 0.48), "b": (-0.8, -0.48), "c": (1.33, 1.33), "d": (-0.6, -0.36), "e": (-1.0, -0.6)}
"""K' of each position of the pinion, of a plain shaft and of one that the pinion's body stiffens."""
_LEFT_BY = {"none": (1.0, 1.0), "crowning": (0.5, 0.5), "end-relief": (0.7, 0.7)}
"""B_1 and B_2 of each modification of the helix."""


@dataclass(frozen=True, kw_only=True)
class Shaft:
    """The pinion's shaft, for the deflection in K_Hbeta.

    Fields
        position : str - "a" to "e" of ISO 6336-1
        span, offset, diameter : float [mm] - bearing distance l, pinion's distance s from its middle, d_sh
        stiffened : bool - the pinion's body supports the shaft
    """

    position: str
    span: float
    offset: float
    diameter: float
    stiffened: bool = False

    @property
    def factor(self) -> float:
        """K'."""
        return _UNDER_LOAD[self.position][self.stiffened]


@dataclass(frozen=True)
class Point:
    """A row of a load spectrum: factors of torque and speed, and the share of the life.

    Example
        >>> Point()
        Point(torque=1.0, speed=1.0, share=1.0)
    """

    torque: float = 1.0
    speed: float = 1.0
    share: float = 1.0


@dataclass(frozen=True, kw_only=True)
class Conditions:
    """Life, materials, accuracy, surfaces, oil and surroundings of a pair.

    Fields
        life : float [h] - L_h
        steels : (GearSteel, GearSteel)
        quality : str - ML, MQ or ME
        grades : (int, int) - of ISO 1328-1
        edition : int - of ISO 1328-1
        flank_roughness, root_roughness, ra : (float, float) [um] - Rz of flank and root, Ra of the flank
        viscosity_40 : float [mm^2/s]
        viscosity_100, oil_temperature, scuffing_stage : [mm^2/s], [deg C], 8 to 14 - None: no scuffing
        tip_relief : float or None [um] - C_a
        bores : (float, float) [mm] - of a ring the outside diameter
        web : (float, float) or None - b_s/b, s_R/m; None: solid
        system, planets : where the pair stands in a planetary gear
        reduced_mass : float or None [kg/mm]
        contacts : (float, float) - load contacts per revolution
        shaft, misalignment, modification : of the face load factor; F_betax in um
        long_life : float - factor at 1e10 load cycles
        mean_stress : (float, float) or None - Y_M; None: 0.7 of idlers, else 1
        generating_root : bool - the root has the generating shift of the upper allowance, else the nominal one
        generated_ring : bool - the fillet of a shaped ring is the one that its cutter leaves, else that of ISO 6336-3
        spectrum : tuple of Point - empty: the load itself
        given : frozenset of str - keys that the file has
    """

    life: float
    steels: tuple[GearSteel, GearSteel]
    quality: Quality = "MQ"
    grades: tuple[int, int]
    edition: int = 2013
    flank_roughness: Pair = (4.8, 4.8)
    root_roughness: Pair = (20.0, 20.0)
    ra: Pair = (0.6, 0.6)
    viscosity_40: float
    viscosity_100: float | None = None
    oil_temperature: float | None = None
    scuffing_stage: int | None = None
    tip_relief: float | None = None
    bores: Pair = (0.0, 0.0)
    web: Pair | None = None
    system: System = "pair"
    planets: int = 1
    reduced_mass: float | None = None
    contacts: Pair = (1.0, 1.0)
    shaft: Shaft | None = None
    misalignment: float | None = None
    modification: Modification = "none"
    long_life: float = 0.85
    pitting_allowed: bool = False
    mean_stress: Pair | None = None
    generating_root: bool = True
    generated_ring: bool = True
    spectrum: tuple[Point, ...] = ()
    given: frozenset[str] = frozenset()

    @property
    def points(self) -> tuple[Point, ...]:
        """The rows of the spectrum; the load itself where there is none."""
        return self.spectrum or (Point(),)

    @property
    def left(self) -> Pair:
        """B_1 and B_2: what the modification of the helix leaves of deflection and of deviations."""
        return _LEFT_BY[self.modification]


_LONG = 1e10
"""Load cycles of the long life."""
_PITTED = Endurance(6e5, 1e9, 1.6)
_PITTED_BEND = (1e7, 1.3)
"""Where some pits are allowed the line has a bend between its knees: load cycles and factor."""


@dataclass(frozen=True, kw_only=True)
class LimitLine:
    """The limit stress of a flank or a root over the load cycles, straight between its knees in logarithms.

    Parameters
        endurance : Endurance - knees, and the life factor at the static one
        static, reference : float [N/mm^2] - limit stresses at the two knees, each with its own influence factors
        long_life : float - factor at 1e10 load cycles
        bend : (float, float) or None - load cycles and life factor of a knee between
    Notes
        Between the knees the influence factors go over as the life factor does; without a bend that is the straight
        line between the two limit stresses, which meets the life of a printed ring (1005.7 h for 1005 h), one set of
        factors does not (1576 h).
    Example
        >>> line = LimitLine(endurance=Endurance(1e5, 5e7, 1.6), static=2400.0, reference=1500.0, long_life=0.85)
        >>> [round(line.at(n), 9) for n in (1e4, 5e7, 1e10)], line.factor_at(1e4)
        ([2400.0, 1500.0, 1275.0], 1.6)
        >>> round(line.cycles(line.at(3e8)) / 3e8, 9), line.cycles(1200.0)
        (1.0, inf)

    Source
        ISO 6336-2 and -3, ISO 6336-6 for the damage
    """

    endurance: Endurance
    static: float
    reference: float
    long_life: float
    bend: tuple[float, float] | None = None

    @cached_property
    def _knees(self) -> list[tuple[float, float, float]]:
        """Logarithms of load cycles, life factor and limit stress at each knee."""
        low, high = math.log(self.endurance.static), math.log(self.endurance.reference)
        most = math.log(self.endurance.factor)
        start, end = math.log(self.static), math.log(self.reference)
        found = [(low, most, start)]
        if self.bend is not None:
            at, factor = map(math.log, self.bend)
            influence = start - most + (at - low) / (high - low) * (end - start + most)
            found.append((at, factor, factor + influence))
        long = math.log(self.long_life)
        return [*found, (high, 0.0, end), (math.log(_LONG), long, end + long)]

    def _value(self, cycles: float, column: int) -> float:
        knees, at = self._knees, math.log(cycles)
        if at <= knees[0][0]:
            return knees[0][column]
        for before, after in pairwise(knees):
            if at <= after[0]:
                share = (at - before[0]) / (after[0] - before[0])
                return before[column] + share * (after[column] - before[column])
        return knees[-1][column]

    def at(self, cycles: float) -> float:
        """The limit stress at a number of load cycles [N/mm^2]: below the static knee that of the knee."""
        return math.exp(self._value(cycles, 2))

    def factor_at(self, cycles: float) -> float:
        """The tabulated life factor, Z_NT or Y_NT."""
        return math.exp(self._value(cycles, 1))

    def cycles(self, stress: float) -> float:
        """The load cycles that a stress is borne: infinite up to the limit of the long life; above the static limit
        the line goes on as it falls between the knees.
        """
        if stress <= 0.0:
            return math.inf
        knees, at = self._knees, math.log(stress)
        if at < knees[-1][2] or (at == knees[-1][2] and self.long_life == 1.0):
            return math.inf
        for before, after in pairwise(knees):
            falls = before[2] - after[2]
            if (at >= after[2] or after is knees[-1]) and falls > 0.0:
                return math.exp(after[0] - (at - after[2]) / falls * (after[0] - before[0]))
        return math.inf


def limit_line(
    endurance: Endurance, static: float, reference: float, long_life: float, *, pitting_allowed: bool = False
) -> LimitLine:
    """The line of a material: `static` and `reference` without the life factor.

    Parameters
        static, reference : float [N/mm^2] - limit stress times the influence factors of each knee
        pitting_allowed : bool - some pits are allowed: known of steels that are not nitrided
    """
    bend = None
    if pitting_allowed and endurance.factor == _PITTED.factor:
        endurance, bend = _PITTED, _PITTED_BEND
    return LimitLine(
        endurance=endurance, static=static * endurance.factor, reference=reference, long_life=long_life, bend=bend
    )


def damage(rows: Sequence[tuple[float, float, LimitLine]], safety: float) -> float:
    """U = sum n/N(S sigma) by Palmgren and Miner.

    Parameters
        rows : (load cycles, stress [N/mm^2], LimitLine) of each point of the spectrum
        safety : float - S
    """
    return math.fsum(cycles / line.cycles(safety * stress) for cycles, stress, line in rows)


def safety_of(rows: Sequence[tuple[float, float, LimitLine]]) -> float | None:
    """The S for which the damage is 1, by bracketing; None of a spectrum without stress.

    Notes
        Where the damage leaps over 1, at the limit of the long life, the S of the leap.
    """
    stressed = [row for row in rows if row[1] > 0.0 and row[0] > 0.0]
    if not stressed:
        return None
    low = high = 0.0  # of ln S
    while damage(stressed, math.exp(low)) > 1.0:
        low -= 1.0
    while damage(stressed, math.exp(high)) <= 1.0:
        high += 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        if damage(stressed, math.exp(middle)) > 1.0:
            high = middle
        else:
            low = middle
    return math.exp(low)
