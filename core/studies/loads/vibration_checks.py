"""The checks of the vibration of the output."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.report import Check, Shown, Side, Status, safely_below
from gearlink.core.base.wording import short
from gearlink.core.studies.loads import codes

if TYPE_CHECKING:
    from gearlink.core.studies.loads.design import LoadsDesign

VIBRATION_CHECKS = ("rigid-model", "residual-vibration", "resonance")
_ONE_PERCENT = 0.01
_NEAR = 0.8
_NEAR_RESONANCE = 0.1
_CLOSE = 5


def rigid_model(design: LoadsDesign) -> Iterator[Check]:
    """GL605: natural frequency over the input's, and what is left of a motion over its lift."""
    if design.section.vibration is None:
        return
    # Below its own frequency nothing follows the input as if it were rigid, whatever the file allows.
    found, limit, vibrating = (
        design.vibrating.frequency_ratio,
        max(design.limit("frequency_ratio"), 1.0),
        design.vibrating,
    )
    r, residual = vibrating.rise_periods, vibrating.residual
    aside = f"{short(r)} natural periods per motion" if r is not None else ""
    share = None if residual is None else residual / vibrating.lift
    if found >= limit and share is not None and share > _ONE_PERCENT:
        what, shown = "vibration left after the motion, over the lift", Shown(100.0 * share, 1.0, "%", "<=")
        fix = "take a smoother motion law, or a lower speed"
        yield codes.RIGID_MODEL.check("warn", what, share, _ONE_PERCENT, shown=shown, aside=aside, fix=fix)
        return
    status: Status = "warn" if found < limit else "pass"
    what, fix = "natural frequency over that of the input", "stiffen the output, or lower the speed"
    note = "forces are those of rigid links" if status == "warn" else ""
    yield codes.RIGID_MODEL.check(status, what, found, limit, side=">=", aside=aside, fix=fix, note=note)


def residual_vibration(design: LoadsDesign) -> Iterator[Check]:
    """GL610, where the file allows some."""
    vibration = design.section.vibration
    allowed = None if vibration is None else vibration.allowed_residual
    if allowed is None:
        return
    vibrating = design.vibrating
    unit = "mm" if vibrating.slides else "deg"
    if not vibrating.motions:
        what = "the output has no dwell in which vibration could be left"
        fix = "remove loads.vibration.allowed_residual; the table harmonics has the deflection"
        yield codes.RESIDUAL_VIBRATION.check("warn", what, None, allowed, unit, fix=fix)
        return
    found = vibrating.residual if vibrating.residual is not None else vibrating.twist
    if found is None:  # resonance tells
        return
    status: Status = "fail" if found > allowed else "warn" if found > _NEAR * allowed else "pass"
    slowest = None if status == "pass" else vibrating.speed_limit  # it takes longer than all else of the vibration
    key = "loads.vibration.stiffness" if vibration.frequency is None else "loads.vibration.frequency"
    fix = f"raise {key}"
    if slowest:
        fix = f"lower the speed to at most {safely_below(slowest / design.speed_unit)} {design.speed_words}"
    what, most = "vibration of the output in its dwell", _NEAR * allowed
    yield codes.RESIDUAL_VIBRATION.check(status, what, found, allowed, unit, recommended=most, fix=fix)


def resonance(design: LoadsDesign) -> Iterator[Check]:
    """GL611: a harmonic of the motion at the natural frequency."""
    if design.section.vibration is None:
        return
    vibrating, turns = design.vibrating, design.turns
    ratio = vibrating.frequency_ratio * turns
    order = max(1, round(ratio))
    if vibrating.response.unbounded:
        what = f"{_harmonic(order, turns)}, resonance without damping"
        off, fix = abs(ratio / order - 1.0), "change the speed, or give damping"
        yield codes.RESONANCE.check("fail", what, off, _NEAR_RESONANCE, shown=_percent(off), fix=fix)
        return
    # Of a period of several turns, or a motion of which every second harmonic is none, the nearest may be nothing.
    near = [n for n in orders_near(ratio) if abs(ratio / n - 1.0) < _NEAR_RESONANCE]
    shares = dict(zip(near, design.harmonic_shares(near), strict=True))
    strong = [n for n in near if math.isfinite(shares[n]) and shares[n] > _ONE_PERCENT]
    if not strong:
        off = abs(ratio / order - 1.0)
        side: Side = ">=" if off >= _NEAR_RESONANCE else ""  # else one too weak to matter
        shown = _percent(off, limited=off >= _NEAR_RESONANCE)
        yield codes.RESONANCE.check("pass", _harmonic(order, turns), off, _NEAR_RESONANCE, side=side, shown=shown)
        return
    found = min(strong, key=lambda n: abs(ratio / n - 1.0))
    off = abs(ratio / found - 1.0)
    # from the fifth harmonic on the next one is as near, whatever the speed
    remedy = "change the speed by 10 %" if found < _CLOSE * turns else "stiffen the output, or take a smoother law"
    aside = f"{short(100.0 * shares[found], 3)} % of the largest harmonic"
    what, shown = _harmonic(found, turns), _percent(off)
    yield codes.RESONANCE.check("warn", what, off, _NEAR_RESONANCE, shown=shown, aside=aside, fix=remedy)


def orders_near(ratio: float) -> range:
    """Whole numbers from which a ratio is not farther than a tenth of them, and its nearest one.

    Example
        >>> list(orders_near(3.1)), list(orders_near(27.5)), list(orders_near(1.4))
        ([3], [25, 26, 27, 28, 29, 30], [1])
    """
    low, high = math.ceil(ratio / (1.0 + _NEAR_RESONANCE)), math.floor(ratio / (1.0 - _NEAR_RESONANCE))
    nearest = max(1, round(ratio))
    return range(max(1, min(low, nearest)), max(high, nearest) + 1)


def _harmonic(order: int, turns: int) -> str:
    over = f" over {turns} revolutions" if turns > 1 else ""
    return f"distance of harmonic {order}{over} from the natural frequency"


def _percent(off: float, *, limited: bool = True) -> Shown:
    return Shown(100.0 * off, 100.0 * _NEAR_RESONANCE if limited else None, "%", ">=")
