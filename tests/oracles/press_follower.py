"""The follower of the TY-460's cam a second time, in 40 digits: quartic lead-in and transition, cycloidal return.

The zone is 420 mm long; its slopes and bends by numerical derivatives, the quartics by the equations of their ends.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import mpmath as mp
from oracles.press import TY460, at, polynomial

LEAD_IN, TRANSITION_END, RETURN_ANGLE = 12, 125, 100


@cache
def stretches() -> dict[str, Any]:
    """Ends of the zone [rad of input, rad of cam], and the polynomials beside it."""
    start = TY460.equal_speed
    end = TY460.end_of(start, 420)
    first, last = TY460.cam(start), TY460.cam(end)

    def rates(phi: Any) -> tuple[Any, Any]:
        (p1, p2), (c1, c2) = ([mp.diff(f, phi, order) for order in (1, 2)] for f in (TY460.gap, TY460.cam))
        return p1 / c1, (p2 - p1 / c1 * c2) / c1**2

    span = mp.radians(LEAD_IN)
    slope, bend = rates(start)
    lead = polynomial([(0, 0, 0), (0, 1, 0), (0, 2, 0), (span, 1, slope), (span, 2, bend)])
    height = at(lead, span) + TY460.gap(end) - TY460.gap(start)
    slope, bend = rates(end)
    span = mp.radians(TRANSITION_END) - last
    over = polynomial([(0, 0, height), (0, 1, slope), (0, 2, bend), (span, 1, 0), (span, 2, 0)])
    return {"start": start, "end": end, "first": first, "last": last, "lead": lead, "over": over}


def lift(cam: Any, guess: Any) -> Any:
    """Lift of the follower at a cam angle."""
    made = stretches()
    begin, top = made["first"] - mp.radians(LEAD_IN), mp.radians(TRANSITION_END)
    cam = begin + (cam - begin) % (2 * mp.pi)
    if cam <= made["first"]:
        return at(made["lead"], cam - begin)
    if cam <= made["last"]:
        lead = at(made["lead"], mp.radians(LEAD_IN))
        return lead + TY460.gap(TY460.input_at(cam, guess)) - TY460.gap(made["start"])
    if cam <= top:
        return at(made["over"], cam - made["last"])
    x = (cam - top) / mp.radians(RETURN_ANGLE)
    if x >= 1:
        return mp.mpf(0)
    return at(made["over"], top - made["last"]) * (1 - x + mp.sin(2 * mp.pi * x) / (2 * mp.pi))
