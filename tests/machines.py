"""Machines of the tests, written as the data of their files."""

from __future__ import annotations

import math
from typing import Any

from gearlink.cli.opening import design
from gearlink.core.machines.machine.design import Machine

Segments = list[tuple[float, float | None]]
FEED: Segments = [(90, 60), (170, None), (290, 0), (360, None)]
GRIPPER: Segments = [(50, 12), (180, None), (235, 0), (360, None)]
ROCKER = {"kind": "crank-rocker", "links": {"crank": 40, "coupler": 110, "rocker": 80, "frame": 120}}
SWUNG = {
    "kind": "crank-rocker",
    "links": {"crank": 60, "coupler": 90, "rocker": 80, "frame": 100},
    "range": [20, 90],
}


def cam(segments: Segments, **more: Any) -> dict[str, Any]:
    """A disc cam with a roller, by the ends of its segments and the lifts there."""
    motion = [{"to": to} | ({} if lift is None else {"lift": lift, "law": "modified-sine"}) for to, lift in segments]
    follower = {"type": "translating-roller", "roller_radius": 10} | more.pop("follower", {})
    return {"kind": "disc-cam", "motion": motion, "follower": follower, "cam": {"prime_radius": 120}} | more


def machine(members: dict[str, Any], **more: Any) -> Machine:
    """A machine of members."""
    found = design(kind="machine", members=members, **more)
    assert isinstance(found, Machine)
    return found


def of(data: dict[str, Any], **more: Any) -> dict[str, Any]:
    """A member with its design in the file."""
    return {"design": data, **more}


def wrapped(angle: Any, dial: float) -> Any:
    """The way from one event to another by the shorter way round; half a dial is that half but for 1e-7."""
    return 0.5 * dial + 1e-7 - (0.5 * dial + 1e-7 - angle) % dial


def turns(angle: float) -> float:
    """An angle in rad as one of a revolution in deg."""
    return math.degrees(angle) % 360.0
