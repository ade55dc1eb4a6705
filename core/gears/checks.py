"""Limit checks of an external gear pair: undercut, tips, contact ratio, interference, root clearance."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from gearlink.core.gears.codes import (
    CONTACT_RATIO,
    INTERFERENCE,
    ROOT_CLEARANCE,
    SLIDING,
    TIP_FOULING,
    TIP_THICKNESS,
    TOOTH_FORM,
    UNDERCUT,
)
from gearlink.core.remedies import Way, down, up
from gearlink.core.report import Check, Status, safely_above

if TYPE_CHECKING:
    from gearlink.core.gears.pair import GearPair


class GearQuantities:
    """What can be asked of a gear mesh, and so of a design that has one: mm and radians, of two gears a pair."""

    working_pressure_angle: float
    center_distance: float
    reference_center_distance: float
    shift_sum: float
    center_distance_modification: float
    tip_shortening: float | tuple[float, float]
    contact_ratio: float
    profile_shift: tuple[float, float]
    reference_radius: tuple[float, float]
    base_radius: tuple[float, float]
    working_radius: tuple[float, float]
    tip_radius: tuple[float, float]
    root_radius: tuple[float, float]
    tooth_thickness: tuple[float, float]
    tip_pressure_angle: tuple[float, float]
    tip_thickness: tuple[float, float]
    min_shift_no_undercut: tuple[float, float | None]
    span_measurement: tuple[float, float | None]
    span_teeth: tuple[int, int | None]
    specific_sliding: tuple[float, float] | None


GEAR_QUANTITIES = tuple(GearQuantities.__annotations__)
GEAR_CHECKS = tuple(
    rule.name for rule in (UNDERCUT, TIP_THICKNESS, CONTACT_RATIO, INTERFERENCE, ROOT_CLEARANCE, TOOTH_FORM, SLIDING)
)
_USUAL_TIP = 0.15
"""So many modules above the least tip thickness a tip is no longer called thin."""
UNUSUAL_SLIDING = 8.0


def gear_ways(*teeth: Way, angle: str = "gears.pressure_angle") -> dict[str, tuple[Way, ...]]:
    """How a file without profile shifts may be changed where one of the checks of a mesh fails.

    Parameters
        teeth : the ways to more teeth
        angle : str - key of the pressure angle
    """
    steeper, flatter = up(angle, step=0.5), down(angle, step=0.5)
    fewer = tuple(Way(way.keys, -way.step, way.tie) for way in teeth)
    return {
        UNDERCUT.name: (*teeth, steeper),
        TIP_THICKNESS.name: (flatter, *teeth),
        CONTACT_RATIO.name: (*teeth, flatter),
        INTERFERENCE.name: (*teeth, *fewer, steeper),
        TIP_FOULING.name: (*teeth, *fewer, steeper),
        TOOTH_FORM.name: (*teeth, flatter),
    }


class Limits(Protocol):
    """What the checks read of a spec's `limits`."""

    @property
    def undercut(self) -> float: ...
    @property
    def tip_thickness(self) -> float: ...
    @property
    def contact_ratio(self) -> float: ...
    @property
    def sliding(self) -> float | None: ...


def gear_quantity(pair: GearPair, name: str) -> Any:
    """A quantity of a pair, or None where the teeth have none: no bound of the sliding where a tip reaches the
    mate's base tangent point.

    Notes
        The check `involute-interference` fails where it goes beyond and says so.
    """
    if name == "specific_sliding" and not pair.slides:
        return None
    value = getattr(pair, name)
    if not pair.internal:
        return value
    from gearlink.core.gears.data import shown

    return shown(name, value)


def gear_check(name: str, pair: GearPair, limits: Limits, mesh: str = "", shifts: bool = False) -> Iterator[Check]:
    """The findings of one of GEAR_CHECKS on a pair.

    Parameters
        name : str - one of GEAR_CHECKS
        pair : GearPair
        limits : the `limits` section of a spec
        mesh : str - name of the mesh in a design with several, put before the message
        shifts : bool - the design file has keys of the profile shifts, which messages may then name
    Source
        ISO 21771 for the quantities; limits are usual practice (tip thickness, contact ratio, clearance, sliding)
    """
    before = f"{mesh.replace('_', '-')} mesh: " if mesh else ""
    if name == CONTACT_RATIO.name:
        least, subject = limits.contact_ratio, f"{before}the contact ratio"
        remedy = f"take more teeth, {_either(shifts, 'a smaller pressure angle or less profile shift')}"
        yield CONTACT_RATIO.below(pair.contact_ratio, least, least + 0.1, "1", subject, remedy)
        return
    for gear in (0, 1):
        which = _Gear(pair, gear, f"{before}{{}}gear {gear + 1}", shifts)
        yield from _OF_ONE_GEAR[name](which, limits)


def _either(shifts: bool, words: str) -> str:
    return words if shifts else "or a smaller pressure angle"


class _Gear(NamedTuple):
    """A gear of a pair, what its messages begin with, and whether they may name shifts."""

    pair: GearPair
    place: int
    words: str
    shifts: bool

    def of(self, quantity: str) -> float:
        """A quantity of this gear."""
        return float(getattr(self.pair, quantity)[self.place])

    def named(self, part: str = "") -> str:
        """The gear, or a part of it, in words."""
        return self.words.format(part)


def _undercut(gear: _Gear, limits: Limits) -> Iterator[Check]:
    if gear.pair.teeth[gear.place] < 0:
        return
    x, least = gear.of("profile_shift"), gear.of("min_shift_no_undercut")
    status: Status = "pass" if x >= least else "warn" if x >= least - limits.undercut else "fail"
    teeth = gear.pair.teeth[gear.place]
    text = f"{gear.named()} ({teeth} teeth) has x = {x:.6g}, undercut begins below {least:.6g}"
    if status != "pass":
        remedy = f"raise its profile shift to {safely_above(least, 4)} or take more teeth"
        text += f": {remedy if gear.shifts else 'take more teeth, or a larger pressure angle'}"
    yield UNDERCUT.check(status, text, x - least, -limits.undercut)


def _tip_thickness(gear: _Gear, limits: Limits) -> Iterator[Check]:
    share, limit = gear.of("tip_thickness") / gear.pair.module, limits.tip_thickness
    subject = f"{gear.named('the tip thickness of ')} over the module"
    remedy = "lower its profile shift or its addendum"
    if not gear.shifts:
        remedy = "take more teeth or a smaller pressure angle"
    yield TIP_THICKNESS.below(share, limit, limit + _USUAL_TIP, "1", subject, remedy)


def _interference(gear: _Gear, _limits: Limits) -> Iterator[Check]:
    margin, tip = gear.of("interference_margin"), gear.named("the tip of ")
    if margin >= 0.0:
        text = f"{tip} stays {margin:.4g} mm short of the mate's base tangent point"
        yield INTERFERENCE.check("pass", text, margin, 0.0, "mm")
        return
    one, mate = gear.place + 1, 2 - gear.place
    remedy = (
        f"raise the profile shift of gear {mate} or lower the addendum of gear {one}"
        if gear.shifts
        else f"take more teeth on gear {mate}, or a larger pressure angle"
    )
    text = f"{tip} goes {-margin:.4g} mm beyond the mate's base tangent point: {remedy}"
    yield INTERFERENCE.check("fail", text, margin, 0.0, "mm")


def _root_clearance(gear: _Gear, _limits: Limits) -> Iterator[Check]:
    least, usual = 0.05, 0.15
    clearance = _clearance_at_root(gear.pair, gear.place)
    subject = f"{gear.named('the clearance at the root of ')} over the module"
    deeper = gear.pair.tools[gear.place] is not None
    remedy = f"raise the {'addendum of its tool' if deeper else 'clearance coefficient'}"
    if not deeper and gear.pair.keeps_clearance:
        remedy += f" to {least if clearance < least else usual:g} or more"
    else:
        remedy += f", or shorten the tips of gear {2 - gear.place}"
    yield ROOT_CLEARANCE.below(clearance, least, usual, "1", subject, remedy)


def _clearance_at_root(pair: GearPair, gear: int) -> float:
    """Clearance at the root of a gear over the module; that of the profile where the tips keep it, free of rounding."""
    return pair.clearance if pair.keeps_clearance else round(pair.tip_clearance[1 - gear] / pair.module, 12)


def _tooth_form(gear: _Gear, _limits: Limits) -> Iterator[Check]:
    thickness, root = gear.of("tooth_thickness"), gear.of("root_radius")
    parts = {
        "the height of the teeth of ": gear.of("tip_radius") - root,
        "the root radius of ": abs(root) if gear.pair.teeth[gear.place] < 0 else root,
        "the tip thickness of ": gear.of("tip_thickness"),
        "the tooth thickness on the reference circle of ": thickness,
        "the tooth space on the reference circle of ": math.pi * gear.pair.module - thickness,
    }
    part, worst = min(parts.items(), key=lambda each: each[1])
    text = f"{gear.named(part)} is {worst:.4g} mm"
    if worst <= 0.0:
        most = math.pi / (4.0 * math.tan(gear.pair.pressure_angle))
        nearer = f"bring its profile shift {gear.of('profile_shift'):.6g} nearer to 0 (|x| below {most:.3g})"
        text += f", a tooth that no tool can cut: {nearer if gear.shifts else 'take more teeth'}"
    yield TOOTH_FORM.check("fail" if worst <= 0.0 else "pass", text, worst, 0.0, "mm")


def _sliding(gear: _Gear, limits: Limits) -> Iterator[Check]:
    found = gear_quantity(gear.pair, "specific_sliding")
    limit = UNUSUAL_SLIDING if limits.sliding is None else limits.sliding
    if found is None or (limits.sliding is None and abs(found[gear.place]) <= limit):
        return
    size = abs(found[gear.place])
    text = f"{gear.named('the specific sliding at the root of ')} is {found[gear.place]:.5g}"
    if size > limit:
        remedy = "raise its profile shift" if gear.shifts else "take more teeth"
        text += f", beyond the limit of {limit:g}: {remedy}, so that the mate's tip stays off its base circle"
    yield SLIDING.check("warn" if size > limit else "pass", text, size, limit)


_OF_ONE_GEAR: dict[str, Callable[[_Gear, Limits], Iterator[Check]]] = {
    UNDERCUT.name: _undercut,
    TIP_THICKNESS.name: _tip_thickness,
    INTERFERENCE.name: _interference,
    ROOT_CLEARANCE.name: _root_clearance,
    TOOTH_FORM.name: _tooth_form,
    SLIDING.name: _sliding,
}
