"""Checks of a gear pair where its gears mesh as deeply, and as slightly, as the drawing of the housing lets them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Protocol

from gearlink.core.base.report import NO_NUMBER, Check, Status
from gearlink.core.parts.gears.codes import CONTACT_RATIO, INTERFERENCE, ROOT_CLEARANCE, TIP_FOULING

if TYPE_CHECKING:
    from gearlink.core.parts.gears.data import GearData
    from gearlink.core.parts.gears.mesh.pair import GearPair
    from gearlink.core.parts.gears.mesh.ring_interference import InternalInterference
    from gearlink.core.parts.gears.rack.mesh import RackMesh

_DEEPEST = "the gears deepest in mesh"
_CLOSER = "reduce center_distance_allowance"


class Limits(Protocol):
    """What the checks read of a spec's `limits`."""

    @property
    def contact_ratio(self) -> float: ...


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


def distance_limits(name: str, data: GearData, limits: Limits) -> Iterator[Check]:
    """What fails at a limit of the centre distance and holds at the nominal one; nothing where it holds.

    Parameters
        name : str - one of AT_LIMITS
        data, limits : of the pair
    Notes
        GL203: a contact ratio below 1; GL205: a tip on the mate's root, which is cut deeper by the upper allowances of
        the thickness; GL204, GL206: as of the nominal distance.
    """
    if data.distance_allowance:
        yield from _OF_PAIR[name](data, data.distance_allowance, limits)


def _interrupted(data: GearData, off: float, limits: Limits) -> Iterator[Check]:
    apart = moved(data.pair, off)
    helical = data.pair.helix_angle != 0.0
    overlap = (data.path.overlap_ratio or 0.0) if helical else 0.0
    yield from _no_drive(apart.contact_ratio + overlap, data.pair.contact_ratio + overlap, limits.contact_ratio)


def _tips_on_roots(data: GearData, off: float, _limits: Limits) -> Iterator[Check]:
    pair, deep = data.pair, moved(data.pair, -off)
    for gear in (0, 1):
        by_cutter = pair.teeth[gear] < 0 and pair.cutter is not None
        thinner = 0.0 if by_cutter else pair.module * (pair.profile_shift[gear] - data.cut_shift[gear])
        room = deep.tip_clearance[1 - gear] + thinner
        if room <= 0.0 < pair.tip_clearance[1 - gear]:
            yield _on_root(room, data.called(1 - gear), data.called(gear))


def _tips_beyond(data: GearData, off: float, _limits: Limits) -> Iterator[Check]:
    deep = moved(data.pair, -off)
    for gear, (margin, nominal) in enumerate(zip(deep.interference_margin, data.pair.interference_margin, strict=True)):
        if margin < 0.0 <= nominal:
            yield _beyond(margin, data.called(gear))


def _fouling(data: GearData, off: float, _limits: Limits) -> Iterator[Check]:
    if not data.pair.internal:
        return
    from gearlink.core.parts.gears.mesh.ring_interference import InternalInterference

    for pair in (moved(data.pair, -off), moved(data.pair, off)):
        found, nominal = (_room(InternalInterference(each)) for each in (pair, data.pair))
        if found < 0.0 <= nominal:
            what = "interference of the tips of pinion and ring"
            at, name = "a limit of the centre distance", TIP_FOULING.checks[2]
            yield TIP_FOULING.check("fail", what, found, 0.0, "mm", name=name, overlap=what, at=at, fix=_CLOSER)


def _room(internal: InternalInterference) -> float:
    """How far the tips of pinion and ring keep off each other [mm]."""
    apart, margin = internal.tip_circles_apart, internal.tip_fouling_margin
    return apart if apart < 0.0 or margin is None else margin


def rack_limits(name: str, rack: RackMesh, limits: Limits) -> Iterator[Check]:
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


_OF_PAIR: dict[str, Callable[[GearData, float, Limits], Iterator[Check]]] = {
    CONTACT_RATIO.checks[1]: _interrupted,
    INTERFERENCE.checks[1]: _tips_beyond,
    ROOT_CLEARANCE.checks[1]: _tips_on_roots,
    TIP_FOULING.checks[2]: _fouling,
}
