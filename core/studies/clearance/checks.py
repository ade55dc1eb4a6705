"""GL301 and GL302: the gaps of all bodies in the plane of the gears against their limits."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, Protocol

from gearlink.core.base.judged import Judged
from gearlink.core.base.remedies.ways import down
from gearlink.core.base.report import Check
from gearlink.core.base.wording import short
from gearlink.core.parts.linkages.codes import GEAR_COLLISION, SHAFT_CLEARANCE
from gearlink.core.studies.clearance.bodies import Clearance, Gear, Layout, Seat, Shaft

SHAFT_WAYS = (*(down(f"shafts.{name}_radius") for name in ("input", "output", *"ADEOW")), down("gears.rim"))
"""How a file may be changed where a shaft is not clear."""


def collision_check(pair: Clearance, limit: float, why: str, remedy: str) -> Check:
    """GL301: two gears that do not mesh.

    Parameters
        pair : Clearance - of two gears
        limit : float [mm] - minimum gap
        why, remedy : str - which lengths make the gap, and what would give the gears room
    Notes
        A limit below 0 allows gears that overlap, which is a warning: they do not turn in one plane.
    """
    gap, names = pair.gap, f"{pair.one.name} and {pair.other.name}"
    judged = collision_judged(gap, limit)
    note = "the gears need planes of their own, as limits.gear_gap allows" if judged.warns else ""
    fix = "put the gears in planes of their own" if judged.warns else remedy
    return judged.check(
        f"gap between the tips of {names}",
        fix,
        at=_place(pair),
        aside=why,
        overlap=f"interference of {names}",
        note=note,
    )


def collision_judged(gap: Any, limit: Any) -> Judged:
    """GL301 of gaps of gears that do not mesh [mm]."""
    keeps = gap >= limit
    return Judged(GEAR_COLLISION, gap, limit, keeps ^ True, keeps & (gap < 0.0), "mm")


def shaft_checks(layout: Layout) -> Iterator[Check]:
    """GL302: every gear against every shaft, and the shafts against each other.

    Notes
        A shaft of the file must be clear. Beside the axis of one that the file does not name there must be room for
        the thinnest shaft that would be built; less is a warning, since that shaft may end before the gears.
    """
    for pair in layout.shaft_pairs:
        bare = pair.bare
        limit = layout.least_shaft * len(bare)
        judged = shaft_judged(pair.gap, limit, bool(bare))
        yield _shaft_check(judged, pair, bare)


def shaft_judged(gap: Any, limit: Any, bare: Any) -> Judged:
    """GL302 of gaps of gears and shafts [mm], at axes that are bare a warning."""
    low = (gap >= limit) ^ True
    return Judged(SHAFT_CLEARANCE, gap, limit, low & (bare ^ True), low & bare, "mm")


class Placed(Protocol):
    """A design with gears and shafts in one plane."""

    @property
    def layout(self) -> Layout: ...


def shaft_seat(design: Placed) -> Iterator[Check]:
    """GL302: the rims of gears round their own shafts; see `seat_checks`."""
    return seat_checks(design.layout)


def seat_checks(layout: Layout) -> Iterator[Check]:
    """GL302: every gear whose own shaft leaves its teeth no rim that bears them; a warning, since they may be cut into
    the shaft. Nothing where all have one."""
    for seat in layout.seats:
        if seat.rim < seat.least:
            yield _thin_rim(seat)


def _place(pair: Clearance) -> str:
    """Where in the cycle; empty where the gap never changes."""
    return "" if pair.angle is None else f"input angle {short(math.degrees(pair.angle))} deg"


def _words(body: Gear | Shaft) -> str:
    if isinstance(body, Gear):
        return body.name
    return f"the axis of the {body.name}" if body.radius is None else f"the {body.name}"


def _shaft_check(judged: Judged, pair: Clearance, bare: tuple[Shaft, ...]) -> Check:
    """GL302 of one body and one shaft."""
    one, other = _words(pair.one), _words(pair.other)
    named = [body for body in (pair.one, pair.other) if isinstance(body, Shaft) and body.radius is not None]
    aside = ", ".join(f"{body.name} radius {body.radius:g} mm" for body in named)
    fix = ""
    if judged.fails:
        fix = "end the shaft before the plane of the gears (overhung)"
    elif judged.warns:
        fix = f"end the {bare[0].name} before the plane of the gears (overhung)"
        # In whole tenths that can be built; the last bit of a gap is rounding.
        radius = math.floor(10.0 * pair.gap - 1e-9) / 10.0
        if radius > 0.0 and len(bare) == 1:
            fix = f"set {bare[0].key} to at most {radius:g} mm"
        if pair.gap >= 0.0:
            aside = f"{'two minimum shaft radii' if len(bare) > 1 else 'minimum shaft radius'}, limits.least_shaft"
        else:
            aside = f"axes {short(pair.distance)} mm apart"
    overlap = f"overlap of {one} and {other}"
    return judged.check(f"distance of {one} from {other}", fix, at=_place(pair), aside=aside, overlap=overlap)


def _thin_rim(seat: Seat) -> Check:
    what, name = f"rim of {seat.gear.name} between its teeth and {_words(seat.shaft)}", SHAFT_CLEARANCE.checks[1]
    overlap = f"overlap of the teeth of {seat.gear.name} and {_words(seat.shaft)}"
    return SHAFT_CLEARANCE.check(
        "warn",
        what,
        seat.rim,
        seat.least,
        "mm",
        name=name,
        overlap=overlap,
        aside="half the tooth height" if seat.rim >= 0.0 else "",
        fix=f"lower {seat.shaft.key}, or cut the teeth into the shaft",
    )
