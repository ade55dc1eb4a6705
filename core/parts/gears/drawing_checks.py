"""Checks of a gear pair that need more than its teeth: helical contact, interferences of rings, root fillets, drawing.

Limits of the centre distance on the housing's drawing let gears mesh more or less deeply; both ends are checked.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.core.base.report import NO_NUMBER, Check, Shown, Status
from gearlink.core.base.wording import amount, short
from gearlink.core.parts.gears import strength_checks
from gearlink.core.parts.gears.checks import FILLET_NOISE, contact_check, fouling_check, gear_check, of_mesh
from gearlink.core.parts.gears.codes import (
    AT_LIMITS,
    BACKLASH,
    CONTACT_RATIO,
    FILLET,
    INSPECTION,
    INTERFERENCE,
    ROOT_CLEARANCE,
    TIP_FOULING,
    TRUE_FILLET,
)
from gearlink.core.parts.gears.data import GearData, interference
from gearlink.core.parts.gears.drawing_names import DRAWING_CHECKS
from gearlink.core.parts.gears.measures.inspection import preferred_pin
from gearlink.core.parts.gears.mesh.contact import PathOfContact
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.tip_corner import CornerGap, TipCorner

if TYPE_CHECKING:
    from gearlink.core.parts.gears.mesh.ring_cutter import InternalInterference
    from gearlink.core.parts.gears.rack import RackMesh


_DEEPEST = "the gears deepest in mesh"
_CLOSER = "reduce center_distance_allowance"


def moved(pair: GearPair, off: float) -> GearPair:
    """The same two gears with their axes so much [mm] farther from meshing deeply; negative: deeper in each other.

    Notes
        Of a ring and its pinion a larger centre distance is the deeper one.
    Raises
        NoSolution - where the centre distance leaves no pressure angle
    Example
        >>> from gearlink.core.parts.gears.mesh.pair import GearPair
        >>> pair = GearPair.from_shift(2.0, (20, 40))
        >>> apart = moved(pair, 0.5)
        >>> apart.center_distance, apart.tip_radius == pair.tip_radius, apart.contact_ratio < pair.contact_ratio
        (60.5, True, True)
    """
    one, other = pair.tip_radius
    return replace(
        pair,
        given_shift=pair.profile_shift,
        given_distance=abs(pair.center_distance) + pair.signs[1] * off,
        given_first_shift=None,
        tip=None,
        given_tip_radius=(one, abs(other)),
    )


def distance_limits(name: str, data: GearData, limits: Any) -> Iterator[Check]:
    """What fails at a limit of the centre distance and holds at the nominal one; nothing where it holds.

    Parameters
        name : str - one of AT_LIMITS
        data, limits : of the pair
    Notes
        GL203: a contact ratio below 1; GL205: a tip on the mate's root, which is cut deeper by the upper allowances of
        the thickness; GL204, GL206: as of the nominal distance.
    """
    if data.distance_allowance:
        yield from _OF_DISTANCE[name](data, data.distance_allowance, limits)


def _interrupted(data: GearData, off: float, limits: Any) -> Iterator[Check]:
    apart = moved(data.pair, off)
    helical = data.pair.helix_angle != 0.0
    overlap = (data.path.overlap_ratio or 0.0) if helical else 0.0
    yield from _no_drive(apart.contact_ratio + overlap, data.pair.contact_ratio + overlap, limits.contact_ratio)


def _tips_on_roots(data: GearData, off: float, _limits: Any) -> Iterator[Check]:
    pair, deep = data.pair, moved(data.pair, -off)
    for gear in (0, 1):
        by_cutter = pair.teeth[gear] < 0 and pair.cutter is not None
        thinner = 0.0 if by_cutter else pair.module * (pair.profile_shift[gear] - data.cut_shift[gear])
        room = deep.tip_clearance[1 - gear] + thinner
        if room <= 0.0 < pair.tip_clearance[1 - gear]:
            yield _on_root(room, data.called(1 - gear), data.called(gear))


def _tips_beyond(data: GearData, off: float, _limits: Any) -> Iterator[Check]:
    deep = moved(data.pair, -off)
    for gear, (margin, nominal) in enumerate(zip(deep.interference_margin, data.pair.interference_margin, strict=True)):
        if margin < 0.0 <= nominal:
            yield _beyond(margin, data.called(gear))


def _fouling(data: GearData, off: float, _limits: Any) -> Iterator[Check]:
    if not data.pair.internal:
        return
    for pair in (moved(data.pair, -off), moved(data.pair, off)):
        found, nominal = (_room(interference(each)) for each in (pair, data.pair))
        if found < 0.0 <= nominal:
            what = "interference of the tips of pinion and ring"
            at, name = "a limit of the centre distance", TIP_FOULING.checks[2]
            yield TIP_FOULING.check("fail", what, found, 0.0, "mm", name=name, overlap=what, at=at, fix=_CLOSER)


def _room(internal: InternalInterference) -> float:
    """How far the tips of pinion and ring keep off each other [mm]."""
    apart, margin = internal.tip_circles_apart, internal.tip_fouling_margin
    return apart if apart < 0.0 or margin is None else margin


def rack_limits(name: str, rack: RackMesh, limits: Any) -> Iterator[Check]:
    """The same of a gear on a rack: off its datum line the line of action keeps its direction."""
    data, pair = rack.data, rack.pair
    off, sine = data.distance_allowance, math.sin(pair.transverse_pressure_angle)
    if not off:
        return
    overlap = (rack.path.total_contact_ratio or rack.contact_ratio) - rack.contact_ratio
    if name == CONTACT_RATIO.checks[1]:
        nominal = rack.contact_ratio + overlap
        yield from _no_drive(nominal - off / (sine * pair.base_pitch), nominal, limits.contact_ratio)
    thinner = 0.0 if data.allowances is None else -data.allowances[1][0] / (2.0 * math.tan(pair.pressure_angle))
    room = rack.tip_clearance[0] - off + thinner
    if name == ROOT_CLEARANCE.checks[1] and room <= 0.0 < rack.tip_clearance[0]:
        yield _on_root(room, "gear 1", "the rack")
    start = rack.path.start - off / sine
    if name == INTERFERENCE.checks[1] and start < 0.0 <= rack.path.start:
        yield _beyond(start, "the rack")


def _no_drive(ratio: float, nominal: float, least: float) -> Iterator[Check]:
    """Below 1, or what the file allows below that, it fails; where the file allows it, it warns."""
    lowest = min(1.0, least)
    status: Status = "fail" if ratio < lowest <= nominal else "warn"
    if ratio < 1.0 <= nominal or status == "fail":
        yield CONTACT_RATIO.check(
            status,
            "contact ratio" if ratio > 0.0 else "contact ratio: the gears do not mesh",
            ratio,
            lowest if status == "fail" else 1.0,
            name=CONTACT_RATIO.checks[1],
            shown=None if ratio > 0.0 else NO_NUMBER,
            aside="drive interrupted" if ratio > 0.0 else "",
            at="the gears farthest out of mesh",
            fix=_CLOSER,
        )


def _on_root(room: float, tips: str, root: str) -> Check:
    what, name = f"interference of the tips of {tips} and the root of {root}", ROOT_CLEARANCE.checks[1]
    return ROOT_CLEARANCE.check("fail", what, room, 0.0, "mm", name=name, overlap=what, at=_DEEPEST, fix=_CLOSER)


def _beyond(margin: float, tips: str) -> Check:
    what, name = f"tips of {tips} beyond the mating gear's base tangent point", INTERFERENCE.checks[1]
    return INTERFERENCE.check("fail", what, margin, 0.0, "mm", name=name, overlap=what, at=_DEEPEST, fix=_CLOSER)


_OF_DISTANCE: dict[str, Callable[[GearData, float, Any], Iterator[Check]]] = {
    CONTACT_RATIO.checks[1]: _interrupted,
    INTERFERENCE.checks[1]: _tips_beyond,
    ROOT_CLEARANCE.checks[1]: _tips_on_roots,
    TIP_FOULING.checks[2]: _fouling,
}


# Checks of the pinion cutter that shapes a ring


def _cutting(data: GearData) -> GearPair | None:
    """The pinion cutter and the ring that it shapes, while the last cut is taken; None without one."""
    pair, shaped = data.pair, data.pair.shaped
    if shaped is None or pair.cutter is None:
        return None
    return GearPair(
        module=pair.module,
        teeth=(pair.cutter.teeth, pair.teeth[1]),
        pressure_angle=pair.pressure_angle,
        helix_angle=pair.helix_angle,
        given_shift=(pair.cutter.shift, pair.profile_shift[1]),
        given_tip_radius=(shaped.cutter_tip, -pair.tip_radius[1]),
    )


def fed_in(data: GearData) -> Iterator[Check]:
    """A pinion cutter feeds in along the line of centres and must not cut off the ring's tips."""
    cutting = _cutting(data)
    if cutting is None:
        return
    angle = interference(cutting).radial_assembly_angle
    if angle is None or angle >= 0.0:
        return
    what = f"the pinion cutter ({cutting.teeth[0]} teeth) cuts off tips of the ring gear while it feeds in"
    yield TIP_FOULING.check("fail", what, None, 0.0, "mm", name="radial-assembly", fix="use a cutter of fewer teeth")


def tip_beyond_cutter(data: GearData) -> Iterator[Check]:
    """The flanks of a pinion cutter must reach the ring's tips: below its base circle they are no involutes."""
    cutting = _cutting(data)
    if cutting is None:
        return
    margin = cutting.interference_margin[1]
    if margin >= 0.0:
        return
    what = "tip of the ring gear beyond the base tangent point of its cutter"
    fix = f"use a cutter of more than {cutting.teeth[0]} teeth"
    yield INTERFERENCE.check("fail", what, margin, 0.0, "mm", overlap=what, aside="no involute there", fix=fix)


_TOUCHING = 1.2
"""Length of the line on which a plane of a span measurement touches, at least [mm]."""
_NEGATIVE = -1e-6
"""Backlash below it, in modules, is none."""


def drawing_check(name: str, data: GearData, limits: Any, *, radial: bool = False) -> Iterator[Check]:
    """The findings of one of DRAWING_CHECKS on a pair.

    Parameters
        name : str - one of DRAWING_CHECKS
        limits : the `limits` section of a spec
        radial : bool - the pinion is to be put into its ring along the line of centres
    Source
        ISO 21771 for the quantities
    """
    if name == "radial-assembly":
        yield from _radial_assembly(data, radial)
        yield from fed_in(data)
        return
    yield from _OF_PAIR[name](data, limits)


def pair_check(
    name: str, data: GearData, limits: Any, *, mesh: str = "", shifts: bool = True, radial: bool = False
) -> list[Check]:
    """The findings of one of GEAR_CHECKS or DRAWING_CHECKS on a pair of gears.

    Parameters
        limits : the `limits` section of a spec
        mesh : str - name of the mesh in a design with several, put before the message
        shifts : bool - the design file has keys of the profile shifts, which messages may then name
        radial : bool - the pinion is to be put into its ring along the line of centres
    Source
        ISO 21771 for the quantities
    """
    if name in DRAWING_CHECKS or name == TRUE_FILLET.name:
        return of_mesh(mesh, drawing_check(name, data, limits, radial=radial))
    if name == CONTACT_RATIO.name and (helical := helical_contact(data, limits)):
        return of_mesh(mesh, [helical])
    found = [*gear_check(name, data.pair, limits, shifts, data.roles)]
    return of_mesh(mesh, [*found, *(tip_beyond_cutter(data) if name == INTERFERENCE.name else ())])


def helical_contact(data: GearData, limits: Any) -> Check | None:
    """What GL203 says of a helical pair whose width is known: the total contact ratio counts; else None."""
    total = data.path.total_contact_ratio
    if data.pair.helix_angle == 0.0 or total is None:
        return None
    transverse, remedy = data.pair.contact_ratio, "use more teeth, or a greater face width or helix angle"
    found = contact_check(total, limits, "total contact ratio", remedy)
    if found.status != "pass" or transverse >= 1.0:
        return found
    aside = "only the overlap of the helix keeps the gears in contact"
    return CONTACT_RATIO.check("warn", "transverse contact ratio", transverse, 1.0, aside=aside, fix=remedy)


def _tip_fouling(data: GearData, _limits: Any) -> Iterator[Check]:
    if data.internal is not None:
        yield from fouling_check(data.internal)


def _radial_assembly(data: GearData, radial: bool) -> Iterator[Check]:
    if data.internal is None:
        return
    name, angle, margin = "radial-assembly", data.internal.radial_assembly_angle, data.internal.radial_assembly_margin
    if angle is None or margin is None:
        return
    what = "clearance of the pinion on radial assembly into its ring gear"
    if angle >= 0.0:
        yield TIP_FOULING.check("pass", what, margin, 0.0, "mm", name=name)
        return
    status: Status = "fail" if radial else "warn"
    fix = "assemble it axially (omit radial_assembly)" if radial else "assemble it axially"
    if angle > -1e9:
        what = "interference of the pinion on radial assembly into its ring gear"
        yield TIP_FOULING.check(status, what, margin, 0.0, "mm", name=name, overlap=what, fix=fix)
        return
    what = "the pinion is larger than the opening of its ring gear"
    yield TIP_FOULING.check(status, what, None, 0.0, "mm", name=name, fix=fix)


def _fillet(data: GearData, _limits: Any) -> Iterator[Check]:
    for gear in (0, 1):
        yield from _fillet_of(data, gear)


class FilletMeasure(NamedTuple):
    """How far contact stays off a root fillet [mm] and the limit; whether it would lie beyond the base circle, whether
    that is bad, and whether what is bad is a failure or, of a fillet that is not known well, a warning.

    Of many pairs each is an array.
    """

    margin: Any
    limit: Any
    beyond: Any
    bad: Any
    judged: Any


def fillet_measured(pair: GearPair, path: PathOfContact, gear: int) -> FilletMeasure:
    """What GL207 compares, of one pair or of many over arrays.

    Parameters
        pair, path : GearPair, PathOfContact
        gear : int - 0 or 1; a flank whose end is not known (None, or NaN) has the margin 0 of its fillet
    """
    form, left = pair.form_radius[gear], pair.interference_margin[1 - gear]
    known = math.nan if form is None else form
    margin = pair.signs[gear] * (abs(path.used_root_radius[gear]) - abs(known))
    margin = pair.fn.where(known == known, margin, 0.0)
    beyond, limit = left <= 0.0, -FILLET_NOISE * pair.module
    margin = pair.fn.where(beyond, pair.fn.least(margin, left), margin)
    tooled = pair.internal or any(pair.tools) or pair.cutter is not None
    judged = beyond | (pair.helix_angle != 0.0) | tooled
    return FilletMeasure(margin, limit, beyond, beyond | (margin < limit), judged)


def corner_in_fillet(pair: GearPair, gear: int) -> CornerGap | None:
    """The cut of the mate's tip corner into a gear's fillet outside the path of contact; None where there is none.

    Parameters
        pair : GearPair - contact ends on the flank that the fillet leaves
        gear : int - 0 or 1, whose fillet is known
    """
    corner = TipCorner(pair, gear).cut
    return corner if corner is not None and corner.gap < -FILLET_NOISE * pair.module else None


def _fillet_of(data: GearData, gear: int) -> Iterator[Check]:
    pair, form, own, mate = data.pair, data.pair.form_radius[gear], data.called(gear), data.called(1 - gear)
    if form is None and pair.interference_margin[1 - gear] > 0.0:
        return
    found = fillet_measured(pair, data.path, gear)
    judged: Status = "fail" if found.judged else "warn"
    fix = f"shorten the tips of {mate}"
    if form is None or found.beyond:
        base = abs(pair.base_radius[gear])
        what, aside = f"contact at the root of {own} beyond its base circle", f"base radius {short(base)} mm"
        shown = Shown(abs(found.margin), 0.0, "mm", "<=")
        status: Status = judged if found.bad else "pass"
        yield FILLET.check(status, what, found.margin, found.limit, "mm", shown=shown, aside=aside, fix=fix)
        return
    if not found.bad and (corner := corner_in_fillet(pair, gear)):
        what = f"cut of the tip corner of {mate} into the root fillet of {own}"
        shown = Shown(-corner.gap, 0.0, "mm", "<=")
        at = f"radius {short(corner.place)} mm"
        yield FILLET.check(judged, what, corner.gap, found.limit, "mm", shown=shown, at=at, fix=fix)
        return
    outside = pair.teeth[gear] > 0
    used, ends = abs(data.path.used_root_radius[gear]), abs(form)
    what = f"{'start' if outside else 'end'} of contact at the root of {own}"
    shown = Shown(used, ends, "mm", ">=" if outside else "<=")
    aside = f"{'form' if outside else 'root form'} radius"
    status = judged if found.bad else "pass"
    yield FILLET.check(status, what, found.margin, found.limit, "mm", shown=shown, aside=aside, fix=fix)


def _backlash(data: GearData, limits: Any) -> Iterator[Check]:
    if data.backlash is None:
        return
    least, greatest = data.backlash.normal
    yield backlash_check(least, greatest, limits.backlash, data.pair.module, "the gears do not assemble")


def backlash_check(least: float, greatest: float, limit: float, module: float, jammed: str) -> Check:
    """GL208 of a theoretical normal backlash; below 0 there is none.

    Parameters
        least, greatest, limit, module : float [mm] - minimum and maximum backlash, limit of the minimum
        jammed : str - what it means where there is none
    """
    aside, fix = f"maximum backlash {short(greatest)} mm", "reduce the tooth thickness (allowances)"
    if least < _NEGATIVE * module:
        what = f"interference of the flanks: {jammed}"
        return BACKLASH.check("fail", what, least, limit, "mm", overlap=what, aside=aside, fix=fix)
    status: Status = "warn" if least < limit else "pass"
    return BACKLASH.check(status, "minimum theoretical normal backlash", least, limit, "mm", aside=aside, fix=fix)


def _inspection(data: GearData, _limits: Any) -> Iterator[Check]:
    for gear in data.measured:
        diameter = data.pins[gear]
        found = None if diameter is None else _amiss(data, gear)
        if found is not None:
            best = preferred_pin(data.pair, gear)
            fix = f"set pin_diameter to {best:g} mm" if best is not None else ""
            yield INSPECTION.check("warn", f"a ball of {diameter:g} mm {found}", fix=fix)
        yield from _spanned(data, gear)


def _spanned(data: GearData, gear: int) -> Iterator[Check]:
    """A span measurement that leaves a helical gear's face; both planes touch apart by W_k sin(beta_b) along it."""
    pair, widths = data.pair, data.face_width
    count = pair.span_teeth[gear]
    if pair.helix_angle == 0.0 or widths is None or count is None:
        return
    needed, width = width_of_span(pair, gear, count), widths[gear]
    if needed <= width:
        return
    form, tip = pair.form_radius[gear] or pair.base_radius[gear], pair.tip_radius[gear]
    lesser = [k for k in range(1, count) if form < pair.span_contact(gear, k) < tip]
    fewer = [k for k in lesser if width_of_span(pair, gear, k) <= width]
    balls = f"measure {'between' if pair.teeth[gear] < 0 else 'over'} balls"
    fix = f"measure over {amount(fewer[-1], 'tooth', 'teeth')}" if fewer else balls
    what = f"face width of {data.called(gear)} for the span over {amount(count, 'tooth', 'teeth')}"
    yield INSPECTION.check("warn", what, width, needed, "mm", fix=fix)


def width_of_span(pair: GearPair, gear: int, count: Any) -> Any:
    """Face width that both planes of a span measurement over so many teeth touch [mm]; of many pairs an array."""
    angle = pair.base_helix_angle
    return pair.span_over(gear, count) * pair.fn.sin(angle) + _TOUCHING * pair.fn.cos(angle)


def _amiss(data: GearData, gear: int) -> str | None:
    """What keeps a ball that the file names from measuring the teeth of a gear, in words; None where nothing does."""
    pair, name, ball = data.pair, data.called(gear), data.ball(gear)
    if ball is None:
        return f"falls through the spaces of {name}"
    sign, tip, form = pair.signs[gear], abs(pair.tip_radius[gear]), pair.form_radius[gear]
    touch, center = abs(ball.contact_radius), abs(ball.center_radius)
    if sign * (touch - tip) > 0.0:
        return f"would touch {name} at a radius of {short(touch)} mm, beyond its tips at {short(tip)} mm"
    if ball.roll < 0.0 or (form is not None and sign * (abs(form) - touch) > 0.0):
        return f"touches the root fillets of {name}"
    if sign * (center - abs(pair.root_radius[gear])) < 0.5 * ball.diameter:
        return f"touches the root of {name}"
    return f"lies below the tips of {name}" if sign * (center - tip) + 0.5 * ball.diameter < 0.0 else None


_OF_PAIR: dict[str, Callable[[GearData, Any], Iterator[Check]]] = {
    "tip-fouling": _tip_fouling,
    "fillet-interference": _fillet,
    "backlash": _backlash,
    "inspection": _inspection,
    **{name: partial(distance_limits, name) for name in AT_LIMITS},
    "pitting": strength_checks.pitting,
    "bending": strength_checks.bending,
    "rating-range": strength_checks.rating_range,
    "resonance": strength_checks.resonance,
    "scuffing": strength_checks.scuffing,
    "damage": strength_checks.damage,
    "face-load": strength_checks.face_load,
    "true-fillet": strength_checks.true_fillet,
}
