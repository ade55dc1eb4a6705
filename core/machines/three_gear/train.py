"""The gears of the three-gear four-bar: gear 1 fixed to the crank at B, idler 3 at C, output gear 5 free on D.

    phi5 = I phi + (1 - i2) i3 t2 + (1 - i3) t3,   W = I + (1 - i2) i3 w2 + (1 - i3) w3

with i2 = -z1/z3, i3 = -z3/z5, I = i2 i3 = z1/z5, teeth negative for a gear in internal mesh with the idler: the shares
of a `linkages.geared_output`. Standstills, back-step and dwells stand in `gearlink.core.machines.three_gear.dwell`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.base.wording import unlike
from gearlink.core.parts.linkages.fourbar.position import FourBar


@dataclass(frozen=True, slots=True)
class GearTrain:
    """The three gears: crank gear 1, idler 3 and output gear 5.

    Parameters
        crank, idler, output : float - teeth, or anything in proportion to them (charts need fractions); crank and
            output negative for an internal mesh with the idler
        sense : +1 or -1 - in which the output is counted: -1 against the crank
    Raises
        NoSolution - for a number that is zero or not finite, and gears in internal mesh that are as large as the idler
    Example
        >>> train = GearTrain(40, 72, 40)
        >>> train.i3, train.ratio
        (-1.8, 1.0)
    """

    crank: float
    idler: float
    output: float
    sense: int = 1

    def __post_init__(self) -> None:
        for name, teeth in (("crank gear", self.crank), ("idler", self.idler), ("output gear", self.output)):
            if not math.isfinite(teeth) or teeth == 0 or (name == "idler" and teeth < 0):
                raise NoSolution(f"the {name} has {teeth:g} teeth; the number must be positive and finite")
            if teeth == -self.idler:
                raise NoSolution(f"the {name}, a ring, is not larger than the idler of {self.idler:g} teeth")

    @property
    def internal(self) -> bool:
        """Whether a mesh is internal."""
        return self.crank < 0 or self.output < 0

    @property
    def i2(self) -> float:
        """Ratio of crank gear and idler, -z1/z3."""
        return -self.crank / self.idler

    @property
    def i3(self) -> float:
        """Ratio of idler and output gear, -z3/z5."""
        return -self.idler / self.output

    @property
    def ratio(self) -> float:
        """Ratio of the train, I = i2 i3 = z1/z5."""
        return self.sense * self.crank / self.output

    @property
    def coupler_share(self) -> float:
        """What a revolution of the coupler adds to the output, (1 - i2) i3 = -(z1 + z3)/z5."""
        return -self.sense * (self.crank + self.idler) / self.output

    @property
    def rocker_share(self) -> float:
        """What a revolution of the rocker adds to the output, 1 - i3 = (z3 + z5)/z5."""
        return self.sense * (self.idler + self.output) / self.output


def gear_gap(linkage: FourBar, train: GearTrain, module: float, addendum: float = 1.0) -> float:
    """Gap between the tip circles of crank gear and output gear where they come nearest over the revolution.

    s15 = |d - a| - m (z1 + z5)/2 - 2 h_a* m

    Parameters
        linkage : FourBar [mm]
        train : GearTrain - real teeth
        module : float [mm]
        addendum : float - h_a*, addendum coefficient
    Returns
        gap : float [mm] - negative where the gears collide
    Notes
        B passes between A and D (or, in a drag link, D between A and B): the distance of the gears is |d - a|, not d.
    Example
        >>> round(gear_gap(FourBar(18.0, 50.0, 100.0, 121.4), GearTrain(20, 20, 60), 2.5), 9)
        -1.6

    Source
        own derivation; thesis 4.2.3 compares the tip radii with the frame length
    """
    tips = tip_radius(train.crank, module, addendum) + tip_radius(train.output, module, addendum)
    return abs(linkage.frame - linkage.crank) - tips


def tip_radius(teeth: float, module: float, addendum: float = 1.0) -> float:
    """Tip radius of a gear without profile shift, m (z/2 + h_a*) [mm].

    Source
        ISO 21771
    """
    return module * (0.5 * teeth + addendum)


def idler_for_ratio(i3: float, output_teeth: int) -> int:
    """Idler whose ratio to the output gear comes nearest to a wanted one.

    z3 = round(-i3 z5)

    Parameters
        i3 : float - negative
        output_teeth : int - z5
    Returns
        idler_teeth : int - at least 1
    Raises
        NoSolution - when the nearest number of teeth is 0, or i3 is not negative
    Example
        >>> idler_for_ratio(-1.7798080356711419, 40)
        71

    Source
        thesis 4.1.4, example 1
    """
    teeth = math.floor(-i3 * output_teeth + 0.5) if math.isfinite(i3) else 0
    if teeth < 1:
        raise NoSolution(
            f"i3: {unlike(i3, -1.0 / output_teeth)} (limit <= {unlike(-1.0 / output_teeth, i3)}, an idler of one tooth "
            f"with an output gear of {output_teeth})",
            fix=f"set i3 to at most {safely_below(-1.0 / output_teeth)}",
        )
    return teeth
