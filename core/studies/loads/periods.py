"""Input turns after which a machine with gears out of balance repeats."""

from __future__ import annotations

from typing import Any

from gearlink.core.base.errors import NoSolution

MOST_TURNS = 1000
"""Input turns of a period that loads are computed for at most."""


_BALANCE = "balance these gears (center: [0, 0]), or choose teeth with a common factor"


def is_directed(section: Any, link: str) -> bool:
    """Whether the direction of a link matters: a centre of mass beside its axis, a spring, a force at a point."""
    body = getattr(section.links, link, None)
    joined = {name for spring in section.springs for name in spring.between}
    pushed = {each.on for each in section.forces if each.point is not None}
    return (body is not None and any(body.center or ())) or link in joined | pushed


def homecoming(turns: int, gears: str, key: str, remedy: str = _BALANCE) -> int:
    """So many input turns bring gears home.

    Raises
        NoSolution - for more than are computed
    """
    if turns > MOST_TURNS:
        message = f"{gears} only after {turns} input revolutions (limit <= {MOST_TURNS})"
        raise NoSolution(message, key=key, fix=remedy)
    return turns
