"""The checks of the vibration of the output."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.report import Check, Side, safely_below
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
    r = vibrating.rise_periods
    text = f"the natural frequency is {found:.4g} times that of the input"
    text += f"; {r:.4g} natural periods in a motion" if r is not None else ""
    residual = vibrating.residual
    if found < limit:
        yield codes.RIGID_MODEL.check("warn", f"{text}: forces are those of rigid links", found, limit)
    elif residual is not None and residual > _ONE_PERCENT * vibrating.lift:
        share = residual / vibrating.lift
        message = f"{text}: {100.0 * share:.3g} % of the lift are left as vibration"
        yield codes.RIGID_MODEL.check("warn", message, share, _ONE_PERCENT)
    else:
        yield codes.RIGID_MODEL.check("pass", text, found, limit)


def residual_vibration(design: LoadsDesign) -> Iterator[Check]:
    """GL610, where the file allows some."""
    vibration = design.section.vibration
    allowed = None if vibration is None else vibration.allowed_residual
    if allowed is None:
        return
    vibrating = design.vibrating
    unit = "mm" if vibrating.slides else "deg"
    if not vibrating.motions:
        text = "the output stands nowhere, so that no vibration is held against loads.vibration.allowed_residual"
        text += "; the table harmonics has its deflection"
        yield codes.RESIDUAL_VIBRATION.check("warn", text, None, allowed, unit)
        return
    found = vibrating.residual if vibrating.residual is not None else vibrating.twist
    if found is None:  # resonance tells
        return
    text = f"the output vibrates in its dwell by {found:.4g} {unit}"
    limit = vibrating.speed_limit
    slower = f" (at most {safely_below(limit / design.speed_unit, 4)} {design.speed_words})" if limit else ""
    if found > allowed:
        message = f"{text}, more than {allowed:g}: lower the speed{slower}, or raise loads.vibration.frequency"
        if vibration.frequency is None:
            message = f"{text}, more than {allowed:g}: lower the speed{slower}, or raise loads.vibration.stiffness"
        yield codes.RESIDUAL_VIBRATION.check("fail", message, found, allowed, unit)
    elif found > _NEAR * allowed:
        yield codes.RESIDUAL_VIBRATION.check("warn", f"{text}, little below {allowed:g}", found, allowed, unit)
    else:
        yield codes.RESIDUAL_VIBRATION.check("pass", text, found, allowed, unit)


def resonance(design: LoadsDesign) -> Iterator[Check]:
    """GL611: a harmonic of the motion at the natural frequency."""
    if design.section.vibration is None:
        return
    vibrating, turns = design.vibrating, design.turns
    ratio = vibrating.frequency_ratio * turns
    order = max(1, round(ratio))
    if vibrating.response.unbounded:
        text = _nearness("nearest harmonic", order, turns, off := abs(ratio / order - 1.0))
        message = f"{text}, without damping: the vibration grows without limit; change the speed or give damping"
        yield codes.RESONANCE.check("fail", message, off, _NEAR_RESONANCE)
        return
    # Of a period of several turns, or a motion of which every second harmonic is none, the nearest may be nothing.
    near = [n for n in orders_near(ratio) if abs(ratio / n - 1.0) < _NEAR_RESONANCE]
    shares = dict(zip(near, design.harmonic_shares(near), strict=True))
    strong = [n for n in near if math.isfinite(shares[n]) and shares[n] > _ONE_PERCENT]
    if not strong:
        off = abs(ratio / order - 1.0)
        side: Side = ">=" if off >= _NEAR_RESONANCE else ""  # else one too weak to matter
        text = _nearness("nearest harmonic", order, turns, off)
        yield codes.RESONANCE.check("pass", text, off, _NEAR_RESONANCE, side=side)
        return
    found = min(strong, key=lambda n: abs(ratio / n - 1.0))
    off = abs(ratio / found - 1.0)
    text = _nearness("nearest harmonic" if found == order else "harmonic", found, turns, off)
    # from the fifth harmonic on the next one is as near, whatever the speed
    remedy = "change the speed by a tenth" if found < _CLOSE * turns else "stiffen the output, or take a smoother law"
    message = f"{text} and has {100.0 * shares[found]:.3g} % of the greatest: {remedy}"
    yield codes.RESONANCE.check("warn", message, off, _NEAR_RESONANCE)


def orders_near(ratio: float) -> range:
    """Whole numbers from which a ratio is not farther than a tenth of them, and its nearest one.

    Example
        >>> list(orders_near(3.1)), list(orders_near(27.5)), list(orders_near(1.4))
        ([3], [25, 26, 27, 28, 29, 30], [1])
    """
    low, high = math.ceil(ratio / (1.0 + _NEAR_RESONANCE)), math.floor(ratio / (1.0 - _NEAR_RESONANCE))
    nearest = max(1, round(ratio))
    return range(max(1, min(low, nearest)), max(high, nearest) + 1)


def _nearness(which: str, order: int, turns: int, off: float) -> str:
    over = f" over {turns} turns" if turns > 1 else ""
    return f"the {which}, number {order}{over}, lies {100.0 * off:.3g} % off the natural frequency"
