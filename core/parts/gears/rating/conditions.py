"""What the rating by ISO 6336 takes besides teeth, load and elasticity: the section `rating` of a file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from gearlink.core.parts.gears.mesh.pitch_pair import Pair
from gearlink.core.parts.gears.rating.materials import GearSteel, Quality

System = Literal["pair", "sun-planet", "planet-ring"]
Modification = Literal["none", "crowning", "end-relief"]
_UNDER_LOAD = {
    "a": (0.8, 0.48),
    "b": (-0.8, -0.48),
    "c": (1.33, 1.33),
    "d": (-0.6, -0.36),
    "e": (-1.0, -0.6),
}
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
        pitting_allowed : bool
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
