"""Limit checks of an external gear pair: undercut, tips, contact ratio, interference, root clearance."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from functools import reduce
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.core.base.remedies.ways import Way, down, up
from gearlink.core.base.report import NO_NUMBER, Check, Shown, Status, safely_above
from gearlink.core.parts.gears.codes import (
    CONTACT_RATIO,
    INTERFERENCE,
    ROOT_CLEARANCE,
    SLIDING,
    TIP_FOULING,
    TIP_THICKNESS,
    TOOTH_FORM,
    UNDERCUT,
)
from gearlink.core.parts.gears.drawing_names import GEARS, Roles

if TYPE_CHECKING:
    from gearlink.core.base.spec import GearLimits as Limits
    from gearlink.core.parts.gears.mesh.pair import GearPair
    from gearlink.core.parts.gears.mesh.ring_cutter import InternalInterference


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
"""So many modules above the minimum tip thickness a tip is no longer called thin."""
_MORE_CONTACT = 0.1
"""So much above the minimum contact ratio it is no longer called little."""
_UNUSUAL_SLIDING = 8.0
FILLET_NOISE = 1e-4
"""So far below the form radius contact may go, in modules: what a rounding of 0.38 for 0.37995 makes."""


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
    from gearlink.core.parts.gears.data import shown

    return shown(name, value)


def of_mesh(mesh: str, found: Iterable[Check]) -> list[Check]:
    """Findings on a mesh, which begin with its name in a design with several."""
    before = f"{mesh.replace('_', '-')} mesh: " if mesh else ""
    return [check._replace(what=before + check.what) for check in found]


def gear_check(
    name: str, pair: GearPair, limits: Limits, shifts: bool = False, roles: Roles = GEARS
) -> Iterator[Check]:
    """The findings of one of GEAR_CHECKS on a pair.

    Parameters
        name : str - one of GEAR_CHECKS
        limits : the `limits` section of a spec
        shifts : bool - the design file has keys of the profile shifts, which messages may then name
        roles : (str, str) - what messages call the two gears
    Source
        ISO 21771 for the quantities; limits are usual practice (tip thickness, contact ratio, clearance, sliding)
    """
    if name == CONTACT_RATIO.name:
        remedy = "use more teeth or less profile shift" if shifts else "use more teeth or a smaller pressure angle"
        yield contact_check(pair.contact_ratio, limits, "contact ratio", remedy)
        return
    for gear in (0, 1):
        yield from _OF_ONE_GEAR[name](_Gear(pair, gear, shifts, roles), limits)


class _Gear(NamedTuple):
    """A gear of a pair, whether its messages may name shifts, and what they call both gears."""

    pair: GearPair
    place: int
    shifts: bool
    roles: Roles

    def of(self, quantity: str) -> float:
        """A quantity of this gear."""
        return float(getattr(self.pair, quantity)[self.place])

    def measured(self, name: str, limits: Limits) -> Measured:
        """What a check compares of this gear."""
        return measured(name, self.pair, self.place, limits)

    def named(self, part: str = "") -> str:
        """The gear, or a part of it, in words."""
        return part + self.roles[self.place]

    @property
    def mate(self) -> str:
        """The other gear in words."""
        return self.roles[1 - self.place]


def measured(name: str, pair: GearPair, gear: int, limits: Limits) -> Measured:
    """What a check of GEAR_CHECKS compares: the value fails below the first limit and warns below the second.

    Parameters
        name : str - one of GEAR_CHECKS but the sliding, which has no bound everywhere
        pair : GearPair - one, or many over arrays
        gear : int - 0 or 1; of the contact ratio either
        limits : the `limits` section of a spec
    """
    return _MEASURES[name](pair, gear, limits)


class Measured(NamedTuple):
    """A value, the limit below which it fails, and the one below which it warns."""

    value: float
    fails_below: float
    warns_below: float

    @property
    def status(self) -> Status:
        """As it is judged."""
        return "fail" if self.value < self.fails_below else "warn" if self.value < self.warns_below else "pass"


def fouling_check(internal: InternalInterference, roles: Roles = ("pinion", "ring")) -> Iterator[Check]:
    """GL206 of a pinion in its ring; nothing where their tip circles do not cross."""
    pinion, ring = (role.removeprefix("the ") for role in roles)
    both = f"{pinion} and {ring}"
    margin, part = internal.tip_fouling_margin, f"tips of {both}"
    if internal.tip_circles_apart < 0.0:
        margin, part = internal.tip_circles_apart, f"tip circles of {both}"
    if margin is None:
        return
    yield TIP_FOULING.check(
        "fail" if margin < 0.0 else "pass",
        f"clearance of the {part}",
        margin,
        0.0,
        "mm",
        overlap=f"interference of the {part}",
        fix=f"give the {ring} more teeth or the {pinion} fewer",
    )


def most_sliding(limits: Any) -> float:
    """Specific sliding beyond which GL209 warns."""
    given: float | None = limits.sliding
    return _UNUSUAL_SLIDING if given is None else given


def contact_measure(ratio: Any, limits: Any) -> Measured:
    """A contact ratio beside its limits: below 1, where the drive is interrupted, it warns whatever the file allows."""
    least = limits.contact_ratio
    return Measured(ratio, least, max(least + _MORE_CONTACT, 1.0))


def contact_check(ratio: float, limits: Any, subject: str, remedy: str) -> Check:
    """GL203."""
    found = contact_measure(ratio, limits)
    if ratio < 0.0:  # no path of contact has a negative length
        what = f"{subject}: the gears do not mesh"
        return CONTACT_RATIO.check(found.status, what, ratio, found.fails_below, shown=NO_NUMBER, fix=remedy)
    if found.status == "warn" and ratio < 1.0:
        what = f"{subject}, drive interrupted"
        return CONTACT_RATIO.check("warn", what, ratio, found.fails_below, recommended=1.0, fix=remedy)
    return CONTACT_RATIO.below(*found, "1", subject, remedy)


def _undercut_measure(pair: GearPair, gear: int, limits: Limits) -> Measured:
    return Measured(pair.profile_shift[gear] - pair.min_shift_of(gear), -limits.undercut, 0.0)


def tip_measure(width: float, module: float, limits: Any) -> Measured:
    """A tip's thickness over the module beside its limits."""
    limit = limits.tip_thickness
    return Measured(width / module, limit, limit + _USUAL_TIP)


def _clearance_measure(pair: GearPair, gear: int, _limits: Limits) -> Measured:
    """Clearance at the root of a gear over the module; that of the profile where the tips keep it, free of rounding."""
    kept = pair.keeps_clearance
    clearance = pair.clearance if kept else pair.fn.round(pair.tip_clearance[1 - gear] / pair.module, 12)
    return Measured(clearance, 0.05, 0.15)


def form_parts(pair: GearPair, gear: int) -> dict[str, float]:
    """Parts of a tooth that no tool can cut where they are 0 or less [mm]."""
    thickness, root = pair.tooth_thickness[gear], pair.root_radius[gear]
    return {
        "height of the teeth of ": pair.tip_radius[gear] - root,
        "root radius of ": root * pair.signs[gear],
        "tip thickness of ": pair.tip_thickness[gear],
        "tooth thickness on the reference circle of ": thickness,
        "tooth space on the reference circle of ": math.pi * pair.module - thickness,
    }


_NO_FORM = {
    "height of the teeth of ": ("the teeth of {} have no height", "reduce the sum of the profile shifts"),
    "root radius of ": ("the root circle of {} has no radius", "increase its profile shift or use more teeth"),
    "tip thickness of ": ("the teeth of {} are pointed below their tips", "reduce its profile shift or its addendum"),
    "tooth thickness on the reference circle of ": ("the teeth of {} have no thickness on the reference circle", ""),
    "tooth space on the reference circle of ": ("the teeth of {} have no space on the reference circle", ""),
}
"""What a tooth lacks of which a part is 0 or less, and what would give it back."""


_MEASURES: dict[str, Callable[[GearPair, int, Limits], Measured]] = {
    UNDERCUT.name: _undercut_measure,
    TIP_THICKNESS.name: lambda pair, gear, limits: tip_measure(pair.tip_thickness[gear], pair.module, limits),
    CONTACT_RATIO.name: lambda pair, _gear, limits: contact_measure(pair.contact_ratio, limits),
    INTERFERENCE.name: lambda pair, gear, _limits: Measured(pair.interference_margin[gear], 0.0, 0.0),
    ROOT_CLEARANCE.name: _clearance_measure,
    TOOTH_FORM.name: lambda pair, gear, _limits: Measured(
        reduce(pair.fn.least, form_parts(pair, gear).values()), 0.0, 0.0
    ),
}


def _undercut(gear: _Gear, limits: Limits) -> Iterator[Check]:
    if gear.pair.teeth[gear.place] < 0:
        return
    found = gear.measured(UNDERCUT.name, limits)
    x, least = gear.of("profile_shift"), gear.of("min_shift_no_undercut")
    teeth = gear.pair.teeth[gear.place]
    enough = math.ceil(gear.pair.min_teeth_of(gear.place) - 1e-9)
    remedy = f"use at least {enough} teeth, or a larger pressure angle"
    if gear.shifts:
        remedy = f"increase its profile shift to {safely_above(least)}, or use more teeth"
    shown = Shown(x, least - (limits.undercut if found.status == "pass" else 0.0))
    what = f"{gear.named('profile shift x of ')} ({teeth} teeth)"
    aside = "undercut begins there" if found.status != "pass" else ""
    yield UNDERCUT.check(found.status, what, found.value, found.fails_below, shown=shown, aside=aside, fix=remedy)


def _tip_thickness(gear: _Gear, limits: Limits) -> Iterator[Check]:
    subject = f"{gear.named('tip thickness of ')} over the module"
    remedy = "reduce its profile shift or its addendum"
    if not gear.shifts:
        remedy = "use more teeth or a smaller pressure angle"
    yield tip_check(gear.measured(TIP_THICKNESS.name, limits), subject, f"the teeth of {gear.named()}", remedy)


def tip_check(found: Measured, subject: str, teeth: str, fix: str) -> Check:
    """GL202; of teeth that come to a point below their tips there is no thickness."""
    if found.value < 0.0:
        what = f"{teeth} are pointed below their tips"
        return TIP_THICKNESS.check(found.status, what, found.value, found.fails_below, shown=NO_NUMBER, fix=fix)
    return TIP_THICKNESS.below(*found, "1", subject, fix)


def _interference(gear: _Gear, limits: Limits) -> Iterator[Check]:
    found, tip = gear.measured(INTERFERENCE.name, limits), gear.named("tip of ")
    remedy = (
        f"increase the profile shift of {gear.mate} or reduce the addendum of {gear.named()}"
        if gear.shifts
        else f"use more teeth on {gear.mate}, or a larger pressure angle"
    )
    yield INTERFERENCE.check(
        found.status,
        f"{gear.named('distance of the tip of ')} from the mating gear's base tangent point",
        found.value,
        0.0,
        "mm",
        overlap=f"{tip} beyond the mating gear's base tangent point",
        fix=remedy,
    )


def _root_clearance(gear: _Gear, limits: Limits) -> Iterator[Check]:
    found = gear.measured(ROOT_CLEARANCE.name, limits)
    subject = f"{gear.named('clearance at the root of ')} over the module"
    deeper = gear.pair.tools[gear.place] is not None
    remedy = f"increase the {'addendum of its tool' if deeper else 'clearance coefficient'}"
    if not deeper and gear.pair.keeps_clearance:
        remedy += f" to {found.warns_below:g} or more"
    else:
        missing = safely_above(found.warns_below - found.value, 3)
        remedy += f" by {missing} modules, or shorten the tips of {gear.mate}"
    yield ROOT_CLEARANCE.below(*found, "1", subject, remedy)


def _tooth_form(gear: _Gear, _limits: Limits) -> Iterator[Check]:
    part, worst = min(form_parts(gear.pair, gear.place).items(), key=lambda each: each[1])
    if worst > 0.0:
        what = gear.named("minimum of height, thickness and space width of the teeth of ")
        yield TOOTH_FORM.check("pass", what, worst, 0.0, "mm")
        return
    lacks, fix = _NO_FORM[part]
    fix = fix or f"bring its profile shift {gear.of('profile_shift'):.4g} nearer to 0"
    what = f"{lacks.format(gear.named())}: no tool can cut them"
    fix = fix if gear.shifts else "use more teeth"
    yield TOOTH_FORM.check("fail", what, worst, 0.0, "mm", shown=NO_NUMBER, fix=fix)


def _sliding(gear: _Gear, limits: Limits) -> Iterator[Check]:
    found = gear_quantity(gear.pair, "specific_sliding")
    limit = most_sliding(limits)
    if found is None or (limits.sliding is None and abs(found[gear.place]) <= limit):
        return
    size = abs(found[gear.place])
    what = gear.named("specific sliding at the root of ")
    fix = "increase its profile shift" if gear.shifts else "use more teeth"
    yield SLIDING.check("warn" if size > limit else "pass", what, size, limit, fix=fix)


_OF_ONE_GEAR: dict[str, Callable[[_Gear, Limits], Iterator[Check]]] = {
    UNDERCUT.name: _undercut,
    TIP_THICKNESS.name: _tip_thickness,
    INTERFERENCE.name: _interference,
    ROOT_CLEARANCE.name: _root_clearance,
    TOOTH_FORM.name: _tooth_form,
    SLIDING.name: _sliding,
}
