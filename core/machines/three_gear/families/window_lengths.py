"""The lengths of one link, the others as they are, with which the output stays within a band over a window."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.remedies.ways import at_least, at_most
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.machines.three_gear.dwell.tolerance_dwell import tolerance_dwell
from gearlink.core.machines.three_gear.families.external import Family, filling
from gearlink.core.machines.three_gear.families.forms import forms_for
from gearlink.core.machines.three_gear.motion import GearTrain
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.linkages.fourbar.position import FourBar

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.design import ThreeGearFourBar

_BESIDE = 1e-6
"""Share of the family beside the length that fills the band: at that length itself rounding decides the window."""
_STEPS = (0.1, 0.01, 0.001)


class Room(NamedTuple):
    """The lengths of a link [mm], the others as they are, that meet a window; `given` is that of the file."""

    key: str
    given: float
    low: float
    high: float

    @property
    def change(self) -> float:
        """The change that the file needs, as a share of its length."""
        return max(self.low / self.given, self.given / self.high) - 1.0

    def built(self) -> Iterator[float]:
        """Lengths of the coarsest grid that has one here: the one nearest to the middle, then those at the ends."""
        for step in _STEPS:
            ends = at_least(self.low, step), at_most(self.high, step)
            if ends[0] <= ends[1]:
                middle = at_most(0.5 * (self.low + self.high) + 0.5 * step, step)
                yield from dict.fromkeys((min(max(middle, ends[0]), ends[1]), *ends))
                return


def met_between(
    family: Family,
    train: GearTrain,
    window: float,
    band: float,
    length: Callable[[FourBar], float],
    serving: float | None = None,
) -> tuple[float, float] | None:
    """The lengths of a family between which a window is met.

    At the one the back-step fills the band or the crank turns just so, at the other the window is just as long as
    asked, or the crank turns just so.

    Parameters
        window, band : float [rad] - the crank angle, and the tolerance to either side
        length : of a linkage, the length that the family varies [mm]
        serving : float [mm] - a length that meets the window; without it the longest window is looked at
    Returns
        low, high : float [mm]; None where the longest window is too short
    Raises
        NoSolution - for a family whose output does not step back, or always by more than the band
    """

    def spare(x: float) -> float:
        return tolerance_dwell(family.linkage(x), train, band).crank_angle - window

    filled = length(filling(family, train, band) or family.linkage(family.stepping()[1]))
    end = family.ends()[0]
    inside = filled + _BESIDE * (end - filled) if serving is None else serving
    ends = spare(end), spare(inside)
    if ends[1] <= 0.0 and serving is None:
        return None
    just = end
    if ends[0] < 0.0:
        # A window as long as the limit leaves one length, where rounding decides the sign.
        just = bracketed_root(spare, end, inside, ends=ends) if ends[1] > 0.0 else inside
    return min(just, filled), max(just, filled)


def rooms(design: ThreeGearFourBar, window: float, band: float) -> tuple[Room, ...]:
    """The frames that meet a window with the crank of a design, and the cranks with its frame: the nearer first.

    Parameters
        window, band : float [rad]
    Returns
        rooms : none for gears whose profile shifts change the centre distances, of which there is no synthesis
    """
    if design.off_center:
        return ()
    module, links, assembly = design.spec.gears.transverse_module, design.linkage, design.spec.assembly
    radii = [0.5 * module * teeth for teeth in design.signed_teeth]
    forms, found = forms_for(*radii), []
    ways: tuple[tuple[str, Any, float, Callable[[FourBar], float]], ...] = (
        ("links.frame", forms.with_crank, links.crank, lambda each: each.frame),
        ("links.crank", forms.with_frame, links.frame, lambda each: each.crank),
    )
    for key, form, other, length in ways:
        with suppress(NoSolution):
            family: Family = form(*radii, other, assembly)
            if met := met_between(family, design.train, window, band, length):
                found.append(Room(key, length(links), *met))
    return tuple(sorted(found, key=lambda room: room.change))


def words(found: tuple[Room, ...]) -> str:
    """What the lengths may be, in words."""
    links = ((room.key.removeprefix("links."), room) for room in found)
    return ", ".join(
        f"with this {'frame' if link == 'crank' else 'crank'} the {link} may be {safely_above(room.low, 6)} to "
        f"{safely_below(room.high, 6)} mm"
        for link, room in links
    )
