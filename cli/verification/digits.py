"""Published and computed numbers as they are read: with the digits that a limit leaves them."""

from __future__ import annotations

import math

from gearlink.cli.verification.cases import decimals
from gearlink.cli.verification.computing import Outcome

_DOUBLE = 15
"""Digits of a double; the last is rounding."""


def computed(outcome: Outcome) -> str:
    """The computed number with a digit more than is published, but none far below its limit, where rounding begins."""
    value = outcome.computed
    if value is None:
        return "-"
    size = 0 if value == 0.0 else math.floor(math.log10(abs(value))) + 1
    below = 1 - math.floor(math.log10(outcome.number.limit))
    places = min(1 - decimals(outcome.number.published), below, _DOUBLE - size - 1)
    return f"{value:.{max(places, 0)}f}"


def difference(outcome: Outcome) -> str:
    """The difference to two digits of its limit.

    A tenth of the limit is its last digit but one, so that what another processor rounds otherwise does not show.
    """
    found = outcome.difference
    if found is None:
        return "-"
    places = 1 - math.floor(math.log10(outcome.number.limit))
    shown = round(found, places)
    return _plain(shown + 0.0, places)


def limit(outcome: Outcome) -> str:
    """The limit."""
    return f"{outcome.number.limit:.3g}"


def share(outcome: Outcome) -> str:
    """The difference in percent of its limit."""
    return "-" if outcome.computed is None else f"{100.0 * outcome.share:.0f} %"


def _plain(value: float, places: int) -> str:
    if value == 0.0:
        return "0"
    return f"{value:.{max(places, 0)}f}" if places <= 7 else f"{value:.1e}"
