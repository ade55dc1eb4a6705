"""Remedies for the checks of `loads`, from closed forms; each is tried before it is named."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.remedies.ways import at_least, at_most
from gearlink.core.base.spec_paths import number_at
from gearlink.core.studies.loads.names import RPM

if TYPE_CHECKING:
    from gearlink.core.base.report import Remedy
    from gearlink.core.studies.loads.design import LoadsDesign

_HOLDS = 0.9
_LIFE_MARGIN = 1.2
_RATIO = 0.45
_MORE = (1.0, 1.1, 1.3, 1.6, 2.0, 3.0)
_STRONGER = (1.25, 1.6, 2.0, 3.0, 5.0)
_SLOWER = (0.9, 0.8, 0.6, 0.4)
_HALVINGS = 12
_USUAL_FLUCTUATION, _USUAL_DAMPING = 0.1, 0.03


def candidates(design: LoadsDesign, check: str) -> Iterator[Remedy]:
    """What may repair a check, the least change first."""
    find = _FINDERS.get(check)
    yield from () if find is None else find(design)


def _wider(design: LoadsDesign) -> Iterator[Remedy]:
    """p ~ 1/sqrt(width)"""
    allowed, found = design.section.material.allowed_pressure, design.raw("hertz_pressure_max")
    found = found if isinstance(found, list) else [found]
    if None in found:  # an undercut, which no width repairs
        return
    worst = max(found)
    yield (("loads.roller.width", at_least(design.section.roller.width * (worst / (_HOLDS * allowed)) ** 2)),)


def _stronger_motor(design: LoadsDesign) -> Iterator[Remedy]:
    """Rated and greatest torque for what runs; a motor with another slope gives another peak."""
    motor, margin = design.section.motor, design.limit("torque_margin") / _HOLDS
    needs = {"rated_torque": design.running.motor_rms, "max_torque": abs(design.running.motor_peak or 0.0)}
    for more in _MORE:
        given = {name: (getattr(motor, name), (need or 0.0) * margin * more) for name, need in needs.items()}
        found = {name: at_least(need) for name, (was, need) in given.items() if was is not None and was < need}
        if found:
            yield tuple((f"loads.motor.{name}", value) for name, value in found.items())


def _other_ratio(design: LoadsDesign) -> Iterator[Remedy]:
    """The ratio with which the motor runs the input at the speed of the file."""
    motor, mean = design.section.motor, 0.5 * sum(design.running.range)
    ratio = motor.ratio * mean / (abs(design.speed) / RPM)
    yield from ((("loads.motor.ratio", float(f"{ratio:.{digits}g}")),) for digits in (2, 3))


def _heavier_flywheel(design: LoadsDesign) -> Iterator[Remedy]:
    """The least that holds the speed within nine tenths of what is allowed; with a motor it may need more."""
    if design.section.flywheel is None:
        return
    allowed, running = design.section.flywheel.fluctuation, design.running
    share = _HOLDS * allowed if allowed is not None else _USUAL_FLUCTUATION
    needed = design.energy.flywheel_for(share, abs(design.speed), running.motor_inertia)
    yield from ((("loads.flywheel.inertia", at_least(needed * more, 0.01)),) for more in _MORE)


def _better_bearing(design: LoadsDesign) -> Iterator[Remedy]:
    """C ~ L^(1/p), for all bearings that do not last."""
    found = {}
    for name, bearing in design.section.bearings.items():
        pin = design.pins_found.get(name)
        if pin is not None and pin.life is not None and bearing.life is not None and pin.life < bearing.life:
            rating = bearing.dynamic_rating * (_LIFE_MARGIN * bearing.life / pin.life) ** (1.0 / pin.exponent)
            found[f"loads.bearings.{name}.dynamic_rating"] = at_least(rating, 10.0)
    if found:
        yield tuple(found.items())


def _stiffer(design: LoadsDesign) -> Iterator[Remedy]:
    """A higher natural frequency, by as much as the speed is too high; else a lower speed."""
    vibration, limit = design.section.vibration, design.vibrating.speed_limit
    key, power = ("frequency", 1.0) if vibration.frequency is not None else ("stiffness", 2.0)
    ratio = abs(design.speed) / limit if limit else 1.1
    for more in (1.02, 1.1, 1.3, 1.6, 2.0, 3.0):
        yield ((f"loads.vibration.{key}", at_least(getattr(vibration, key) * (ratio * more) ** power, 0.1)),)


def _slower(design: LoadsDesign) -> Iterator[Remedy]:
    for key in ("loads.speed", "speed", "input_speed"):
        old = number_at(design.spec, key)
        if old is not None:
            yield from (((key, at_most(share * old, 1.0)),) for share in _SLOWER)
            return


def _loaded_one_way(design: LoadsDesign) -> Iterator[Remedy]:
    """More of the constant load that the output has, or less speed."""
    for i, load in enumerate(design.section.forces):
        name = "torque" if isinstance(load.torque, float) else "force" if isinstance(load.force, float) else ""
        if name and load.on == design.output:
            old = getattr(load, name)
            yield from (((f"loads.forces[{i}].{name}", _rounded(old * more)),) for more in _STRONGER)
    yield from _slower(design)


def _rounded(value: float) -> float:
    return math.copysign(at_least(abs(value)), value)


def _damped(design: LoadsDesign) -> Iterator[Remedy]:
    if not design.section.vibration.damping:
        yield (("loads.vibration.damping", _USUAL_DAMPING),)


def _less_friction(design: LoadsDesign) -> Iterator[Remedy]:
    """All coefficients in the share with which a pass leaves less than half of a change, by halving."""
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if design.machine.rubbing(middle).locking[0] < _RATIO else (low, middle)
    for less in (1.0, 0.3, 0.1):  # the motor must carry what is left of it
        found = _scaled(design, low * less)
        if found:
            yield found


def _scaled(design: LoadsDesign, share: float) -> Remedy:
    given = design.section.friction
    found = [(f"loads.friction.{name}", getattr(given, name) * share) for name in ("pins", "guides")]
    found = [(key, at_most(value, 0.001)) for key, value in found if value]
    if given.meshes < 1.0:
        found.append(("loads.friction.meshes", 1.0 - at_most(share * (1.0 - given.meshes), 0.001)))
    for name, value in given.joints.items():
        less = 1.0 - share * (1.0 - value) if name in design.meshes else share * value
        found.append((f"loads.friction.joints.{name}", less))
    return tuple(found)


def _closed_rollers(design: LoadsDesign) -> Iterator[Remedy]:
    """A stronger spring, or more reserve of a device; else a lower speed."""
    for key, step in (("spring.torque", 1.0), ("spring.preload", 1.0)):
        old = number_at(design.spec, key)
        if old is not None:
            yield from (((key, at_least(old * more, step)),) for more in (1.1, 1.25, 1.5, 2.0, 3.0, 5.0))
    if hasattr(design.spec, "unloader"):
        old = design.spec.unloader.reserve
        yield from ((("unloader.reserve", at_least(old + more, 0.01)),) for more in (0.1, 0.25, 0.5, 1.0, 2.0))
    yield from _slower(design)


_FINDERS: dict[str, Callable[[LoadsDesign], Iterator[Remedy]]] = {
    "contact-pressure": _wider,
    "contact-loss": _closed_rollers,
    "motor-torque": _stronger_motor,
    "motor-speed": _other_ratio,
    "speed-fluctuation": _heavier_flywheel,
    "bearing-life": _better_bearing,
    "residual-vibration": lambda design: iter((*_stiffer(design), *_slower(design))),
    "load-reversal": _loaded_one_way,
    "resonance": _damped,
    "self-locking": _less_friction,
}
