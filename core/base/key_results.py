"""The key results of a command: what the file asks for and what was reached, then what it costs.

A class of designs names them in order (`Design.keys`), each by the name of a quantity, or as a tuple of that name and
the keys of the file which it answers:

    ("tolerance_dwell_angle", ">dwell.window", ">dwell_window")

The first key that the file has counts. It is `required`; behind `>` the value has to be at least, behind `<` at most
that of the key, behind `?` the key only asks for it. A key that begins with a point is an attribute of the design, in
the quantity's unit. A name behind `?` is shown only where the file asks for it. A name with `*` is every quantity like
it, behind `^` the largest of them alone, whatever its sign. Of a maximum the minimum is shown instead where it is the
greater of both extremes, unless the class names it as well.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from gearlink.core.base.spec_paths import number_at

if TYPE_CHECKING:
    from gearlink.core.base.report import Quantity

Key: TypeAlias = "str | tuple[str, ...]"
FEWEST, MOST = 6, 10
"""Key results of a command, where it has so many quantities."""
_HOW = {">": "at least", "<": "at most"}
_ASIDE = ("_at", ".travel", "power_identity", "massless", "seed", "samples")
"""Ends of names that no command shows first by itself."""

SHARED: dict[str, tuple[Key, ...]] = {
    "gear": (
        "input_gear_teeth",
        ("center_distance", "center_distance"),
        "*.center_distance",
        "working_pressure_angle",
        "profile_shift",
        ("contact_ratio", ">limits.contact_ratio"),
        ("*.contact_ratio", ">limits.contact_ratio"),
        ("safety_pitting", ">limits.safety_pitting"),
        ("*.safety_pitting", ">limits.safety_pitting"),
        ("safety_bending", ">limits.safety_bending"),
        ("*.safety_bending", ">limits.safety_bending"),
        "backlash_normal",
        "*.backlash_normal",
        "output_play",
        "span_measurement",
        "tip_radius",
        "specific_sliding",
        "*.tip_thickness",
        "*.span_measurement",
    ),
    "loads": (
        "members_without_loads",
        "input_torque_max",
        "input_torque_min",
        "input_torque_rms",
        "input_power_peak",
        "motor_torque_rms",
        "flywheel_inertia",
        "speed_fluctuation",
        "contact_force_max",
        "hertz_pressure_max",
        ("lift_off_speed", ">speed"),
        "preload_needed",
        "^pin_*.peak",
        "^*.tooth_force_max",
        "shaking_force_max",
        ("frequency_ratio", ">limits.frequency_ratio"),
        "residual_amplitude",
        "energy_fluctuation",
        "reflected_inertia_max",
    ),
    "register": ("worst", ("band", "<register.tolerance"), "rss", "dead_band", "flips"),
    "tolerance": (("yield", ">tolerance.target_yield"), "yield_low", "yield_high", "no_mechanism", "samples"),
}
"""Of commands that no kind has as its own."""
TITLES = {
    "tolerance_dwell_angle": "dwell",
    "tolerance_dwell_start": "dwell, start",
    "tolerance_dwell_time": "dwell, time",
    "dwell_tolerance": "dwell, half range +-",
    "window_limit": "longest possible dwell",
    "dwell_angle": "crank angle to return, phi13",
    "back_step_angle": "back-step",
    "back_step_crank_angle": "back-step, crank angle phi12",
    "dwell_crank_angles": "standstills at",
    "extreme_crank_angles": "reversals at",
    "worst": "register, worst case",
    "rss": "register, standard deviation",
    "band": "register, 99.73 % of the machines",
    "force": "force of the balancing device",
    "yield_low": "yield, lower 95 % limit",
    "yield_high": "yield, upper 95 % limit",
    "pin_diameter": "diameter of measuring pins",
    "members_without_loads": "members without loads",
    "contact_force": "contact force at the design speed",
}
"""What a key result is called where its name would mislead."""


_REGISTER = "register, "
_AS_LARGE = 1.0 - 1e-9
"""Of magnitudes that differ by rounding the first is shown."""


class KeyResult(NamedTuple):
    """One of the results that a command shows first.

    Fields
        asked : float or None - what the file asks for, in the quantity's unit
        how : str - "required", "at least" or "at most"; empty where nothing is asked for
        called : str - what this design calls it; empty where all call it the same
    """

    quantity: Quantity
    asked: float | None = None
    how: str = ""
    called: str = ""

    @property
    def title(self) -> str:
        """What it is called, its name where that says it; of a register also what its two values are of."""
        title = self.called or TITLES.get(self.quantity.name, self.quantity.name)
        if title.startswith(_REGISTER) and isinstance(self.quantity.value, list):
            return f"{title.removeprefix(_REGISTER)}, torque + and -"
        return title


def key_results(design: Any, command: str, quantities: Sequence[Quantity]) -> tuple[KeyResult, ...]:
    """The first of the named key results that a report has; filled up in its order where they are too few.

    Parameters
        design : Design
        quantities : those of the report
    """
    shown = {q.name: q for q in quantities if q.value != []}
    found: dict[str, KeyResult] = {}
    keys = [(key,) if isinstance(key, str) else key for key in design.keys.get(command) or SHARED.get(command, ())]
    answers = [(name, _asked(design, paths)) for name, *paths in keys]
    named = [(name.lstrip("?"), asked) for name, asked in answers if asked or not name.startswith("?")]
    for name, asked in named:
        value, how = asked or (None, "")
        meant = _matching(name, shown) if asked else _greater_extremes(name, shown, [each for each, _ in named])
        for quantity in meant:
            found.setdefault(quantity.name, KeyResult(quantity, value, how, design.titles.get(quantity.name, "")))
    for quantity in shown.values():
        if len(found) >= FEWEST:
            break
        if not quantity.name.endswith(_ASIDE):
            found.setdefault(quantity.name, KeyResult(quantity))
    return tuple(found.values())[:MOST]


def _matching(name: str, shown: dict[str, Quantity]) -> Iterable[Quantity]:
    if "*" not in name:
        return (shown[name],) if name in shown else ()
    like = [q for each, q in shown.items() if fnmatchcase(each, name.removeprefix("^"))]
    if not (name.startswith("^") and like):
        return like
    return (_largest(like),)


def _greater_extremes(name: str, shown: dict[str, Quantity], named: Sequence[str]) -> Iterable[Quantity]:
    """Those that a name matches; of a maximum and its minimum, which the key results do not name, the greater one.

    A report of some quantities may have one of the two alone, which it was asked for.
    """
    if "*" not in name:
        return _greater(name, shown, named)
    return [each for quantity in _matching(name, shown) for each in _greater(quantity.name, shown, named)]


def _greater(name: str, shown: dict[str, Quantity], named: Sequence[str]) -> Iterable[Quantity]:
    least = f"{name.removesuffix('_max')}_min" if name.endswith("_max") else ""
    ends = (name,) if any(fnmatchcase(least, each) for each in named) else (name, least)
    there = [shown[end] for end in ends if end in shown]
    return (_largest(there),) if there else ()


def _largest(quantities: Sequence[Quantity]) -> Quantity:
    """The one of the greatest magnitude; the first of those that differ by rounding."""
    bound = _AS_LARGE * max(abs(_size(q)) for q in quantities)
    return next(q for q in quantities if abs(_size(q)) >= bound)


def _size(quantity: Quantity) -> float:
    value = quantity.value
    return float(value) if isinstance(value, (int, float)) else 0.0


def _asked(design: Any, paths: Sequence[str]) -> tuple[Any, str] | None:
    """The value that the first key of a file has, and how it stands to what was reached; None without one."""
    for path in paths:
        key = path.lstrip("<>?")
        value = getattr(design, key[1:], None) if key.startswith(".") else number_at(design.spec, key)
        if value is not None:
            return (None, "") if path.startswith("?") else (value, _HOW.get(path[0], "required"))
    return None
