"""At which speed a member runs: that of the main shaft times its ratio, whatever its own file says."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.core.base.spec_paths import unit_at, value_at

if TYPE_CHECKING:
    from gearlink.core.machines.machine.spec import MachineSpec

_KEYS = ("speed", "input_speed", "loads.speed")
_SHEETS = 60.0
"""Sheets per hour of one revolution a minute."""


class Given(NamedTuple):
    """A speed of a member's own file.

    Fields
        key : str - where it stands
        value : float or None - in the unit of its key; None where the key is left out
        speed : float or None [1/min]
        per : float - of the key's unit in 1/min
        signed : bool - whether it may be negative
    """

    key: str
    value: float | None
    speed: float | None
    per: float
    signed: bool


def own_speeds(spec: Any) -> list[Given]:
    """The speeds that a file has or may have."""
    found = []
    for key in _KEYS:
        try:
            value, unit = value_at(spec, key), unit_at(spec, key)
        except (AttributeError, LookupError, TypeError):
            continue
        if unit not in ("1/min", "sheets/h"):
            continue
        per = 1.0 if unit == "1/min" else 1.0 / _SHEETS
        found.append(Given(key, value, None if value is None else value * per, per, key == "loads.speed"))
    return found


def wanted_speed(machine: MachineSpec, name: str) -> float | None:
    """The speed of a member's input, signed [1/min]; None without one of the machine, and of a member with input."""
    member = machine.members[name]
    return None if machine.speed is None or member.input is not None else machine.speed * member.ratio


def speed_changes(machine: MachineSpec, name: str) -> list[tuple[str, float]]:
    """The keys of a member's file that hold a speed, with that which the machine gives it; none without one."""
    speed = wanted_speed(machine, name)
    if speed is None:
        return []
    given = own_speeds(machine.members[name].spec)
    wanted = [(each, (speed if each.signed else abs(speed)) / each.per) for each in given]
    return [(each.key, value) for each, value in wanted if each.value != value]


def at_speed(machine: MachineSpec, name: str) -> Any:
    """The spec of a member with the speed that the machine gives it; as it is where the machine has none."""
    changes = speed_changes(machine, name)
    return machine.members[name].changed(changes) if changes else machine.members[name].spec
