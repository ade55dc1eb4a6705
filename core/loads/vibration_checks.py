"""The checks of the vibration of the output."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.loads import codes
from gearlink.core.report import Check, safely_below

if TYPE_CHECKING:
    from gearlink.core.loads.design import LoadsDesign

VIBRATION_CHECKS = ("rigid-model", "residual-vibration", "resonance")
_ONE_PERCENT = 0.01
_NEAR = 0.8
_NEAR_RESONANCE = 0.1
_CLOSE = 5


def rigid_model(design: LoadsDesign) -> Iterator[Check]:
    """GL605: natural frequency over the input's, and what is left of a motion over its lift."""
    if design.section.vibration is None:
        return
    found, limit, vibrating = design.vibrating.frequency_ratio, design.limit("frequency_ratio"), design.vibrating
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
    vibrating = design.vibrating
    ratio = vibrating.frequency_ratio * design.turns
    order = max(1, round(ratio))
    off = abs(ratio / order - 1.0)
    text = f"the nearest harmonic, number {order}, lies {100.0 * off:.3g} % off the natural frequency"
    if vibrating.response.unbounded:
        message = f"{text}, without damping: the vibration grows without limit; change the speed or give damping"
        yield codes.RESONANCE.check("fail", message, off, _NEAR_RESONANCE)
        return
    share = design.harmonic_share(order)
    if off < _NEAR_RESONANCE and share > _ONE_PERCENT and math.isfinite(share):
        # from the fifth harmonic on the next one is as near, whatever the speed
        remedy = "change the speed by a tenth" if order < _CLOSE else "stiffen the output, or take a smoother law"
        message = f"{text} and has {100.0 * share:.3g} % of the greatest: {remedy}"
        yield codes.RESONANCE.check("warn", message, off, _NEAR_RESONANCE)
    else:
        yield codes.RESONANCE.check("pass", text, off, _NEAR_RESONANCE)
