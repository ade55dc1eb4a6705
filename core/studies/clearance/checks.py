"""GL301 and GL302: the gaps of all bodies in the plane of the gears against their limits."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, Protocol

from gearlink.core.base.judged import Judged
from gearlink.core.base.remedies.ways import down
from gearlink.core.base.report import Check
from gearlink.core.parts.linkages.codes import GEAR_COLLISION, SHAFT_CLEARANCE
from gearlink.core.studies.clearance.bodies import Clearance, Gear, Layout, Seat, Shaft

SHAFT_WAYS = (*(down(f"shafts.{name}_radius") for name in ("input", "output", *"ADEOW")), down("gears.rim"))
"""How a file may be changed where a shaft is not clear."""


def collision_check(pair: Clearance, limit: float, why: str, remedy: str) -> Check:
    """GL301: two gears that do not mesh.

    Parameters
        pair : Clearance - of two gears
        limit : float [mm] - least gap
        why, remedy : str - which lengths make the gap, and what would give the gears room
    Notes
        A limit below 0 allows gears that overlap, which is a warning: they do not turn in one plane.
    """
    gap, names = pair.gap, f"{pair.one.name} and {pair.other.name}"
    if gap >= max(limit, 0.0):
        text = f"{names} keep {gap:.6g} mm between their tips at the closest{_place(pair)}: {why}"
        return GEAR_COLLISION.check("pass", text, gap, limit, "mm")
    judged = collision_judged(gap, limit)
    if judged.warns:
        return judged.check(
            f"{names} overlap by {-gap:.6g} mm{_place(pair)}, as limits.gear_gap allows: they need planes of their own"
        )
    found = f"collide by {-gap:.6g} mm" if gap < 0.0 else f"keep only {gap:.6g} mm between their tips at the closest"
    return judged.check(f"{names} {found}{_place(pair)}: {why}; {remedy}")


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
        text = f"{_words(pair.one)} keeps {pair.gap:.4g} mm from {_words(pair.other)}{_place(pair)}"
        if judged.fails:
            text = _overlap(pair)
        elif judged.warns:
            text = _covered_axis(pair) if pair.gap < 0.0 else _narrow(pair, bare, limit)
        yield judged.check(text)


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
            yield SHAFT_CLEARANCE.check(
                "warn", _thin_rim(seat), seat.rim, seat.least, "mm", name=SHAFT_CLEARANCE.checks[1]
            )


def _place(pair: Clearance) -> str:
    """Where in the cycle, as the end of a clause; empty where the gap never changes."""
    return "" if pair.angle is None else f" at input angle {math.degrees(pair.angle):.6g} deg"


def _words(body: Gear | Shaft) -> str:
    if isinstance(body, Gear):
        return body.name
    return f"the axis of the {body.name}" if body.radius is None else f"the {body.name} (radius {body.radius:g} mm)"


def _overlap(pair: Clearance) -> str:
    """A shaft of the file that is not clear."""
    text = f"{_words(pair.one)} comes {-pair.gap:.4g} mm into {_words(pair.other)}{_place(pair)}"
    if pair.one.inner >= 0.0 and pair.angle is not None:  # the two may meet at other places too, and less deep
        within = pair.gap == pair.one.inner - (pair.distance + pair.other.outer)
        side = "within" if within else "without"
        text = (
            f"{_words(pair.one)} meets {_words(pair.other)}: it lacks {-pair.gap:.4g} mm to have it {side} all round, "
            f"most{_place(pair)}"
        )
    if isinstance(pair.one, Shaft):
        return f"{text}: overhang one of them, or make them thinner"
    thinner = ", or make it thinner" if pair.gap + pair.other.outer > 0.0 else ""
    return f"{text}: overhang the shaft{thinner}"


def _thin_rim(seat: Seat) -> str:
    left = f"leaves only {seat.rim:.4g} mm below its teeth round" if seat.rim > 0.0 else "has its teeth within"
    return (
        f"{seat.gear.name} {left} {_words(seat.shaft)}, half the height of the teeth is {seat.least:.4g} mm: lower "
        f"{seat.shaft.key}, or cut the teeth into the shaft"
    )


def _covered_axis(pair: Clearance) -> str:
    """A bare axis within another body."""
    one, other = pair.one, pair.other
    if isinstance(one, Shaft) and isinstance(other, Shaft):
        bare, cover = (one, other) if one.radius is None else (other, one)
        return (
            f"{_words(cover)} covers {_words(bare)}, {pair.distance:.6g} mm away: one of the two must end before the "
            "plane of the gears"
        )
    extent = f"{one.outer:.6g} mm" if one.inner < 0.0 else f"{one.inner:.6g} to {one.outer:.6g} mm"
    subject = f"the tips of {one.name} ({extent}) pass"
    if one.inner > 0.0:
        subject = f"{one.name} ({extent} from its axis) covers"
    return (
        f"{subject} {_words(other)}, {pair.distance:.6g} mm away{_place(pair)}: that shaft must end before the plane "
        "of the gears (be overhung)"
    )


def _narrow(pair: Clearance, bare: tuple[Shaft, ...], limit: float) -> str:
    """A bare axis with less room beside it than a shaft takes."""
    keys, both = " and ".join(shaft.key for shaft in bare), len(bare) > 1
    thinnest = f"{'two of the thinnest shafts take' if both else 'the thinnest shaft takes'} {limit:g} mm"
    text = (
        f"{_words(pair.one)} keeps only {pair.gap:.4g} mm from {_words(pair.other)}{_place(pair)}, {thinnest} "
        f"(limits.least_shaft): overhang {'one of them' if both else 'it'}"
    )
    # In whole tenths that can be built; the last bit of a gap is rounding.
    radius = math.floor(10.0 * pair.gap - 1e-9) / 10.0
    if radius <= 0.0:
        return text
    return f"{text}, or name {keys}, at most {radius:g} mm{' together' if both else ''}"
