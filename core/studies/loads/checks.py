"""The checks of `loads`, in the order of their codes."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.report import Check, Status, safely_above
from gearlink.core.base.wording import amount
from gearlink.core.mechanism.joints import Pin
from gearlink.core.mechanism.links import FRAME
from gearlink.core.studies.loads import codes
from gearlink.core.studies.loads.names import RPM

if TYPE_CHECKING:
    from gearlink.core.mechanism.joints import Connection
    from gearlink.core.studies.loads.design import LoadsDesign
    from gearlink.core.studies.loads.joints import MeshLoad


# What the teeth of a machine are rated for, and what they push along their axes, beside its loads in the plane

_MEAN_STRESS = 0.4
"""M of tempered steel."""


def rated_forces(design: LoadsDesign) -> dict[str, float]:
    """Tangential forces at the pitch circles for which the file has the teeth rated [N], K_A counted, by mesh.

    F_t K_A r/r_w
    """
    machine, keys = _with_gears(design)
    if getattr(keys, "load", None) is None:
        return {}
    found = {}
    for name, data in zip(_drawn(design), machine.mesh_data.values(), strict=False):
        force, pair = data.flank.tangential_force, data.pair
        found[name] = force * data.load.factors.application * pair.reference_radius[0] / pair.working_radius[0]
    return found


def bending_force(mesh: MeshLoad) -> float:
    """Force on one flank that bends teeth of tempered steel as those on both do, F + (1 - M)/(1 + M) F_back [N].

    Notes
        The mean stress influence of a load from -F_back to F, Y_M = 1/(1 + (1 - M)/(1 + M) F_back/F) with M = 0.4: of
        F_back = F the 0.7 with which idlers are rated.
    Source
        ISO 6336-3, annex B
    """
    return mesh.tooth_force_max + (1.0 - _MEAN_STRESS) / (1.0 + _MEAN_STRESS) * mesh.tooth_force_back


def drawn_play(design: LoadsDesign) -> dict[str, float]:
    """Greatest circumferential backlash that the gears as drawn leave [mm], by mesh; empty without allowances."""
    machine, keys = _with_gears(design)
    if getattr(keys, "allowances", None) is None:
        return {}
    plays = {name: data.backlash for name, data in zip(_drawn(design), machine.mesh_data.values(), strict=False)}
    return {name: play.circumferential[1] for name, play in plays.items() if play is not None}


def thrust(design: LoadsDesign, pin: str) -> float:
    """Greatest axial force of the helical teeth that a pin holds [N], which forces in the plane do not show; or 0.

    F_a = F_t tan(beta_w),   tan(beta_w) = tan(beta) r_w/r

    Parameters
        pin : str - of a gear, or of the link that a gear is fixed to
    """
    machine, keys = _with_gears(design)
    if not getattr(keys, "helix_angle", 0.0):
        return 0.0
    connections = {each.name: each for each in design.machine.at(np.zeros(1)).connections}
    pins = [_links_of(each) for each in connections.values() if isinstance(each, Pin)]
    held = _links_of(connections[pin])
    found = [0.0]
    for name, data in zip(_drawn(design), machine.mesh_data.values(), strict=False):
        gears = _links_of(connections[name])
        on_one_pin = [links for gear in gears if len(links := [each for each in pins if gear in each]) == 1]
        if held & gears.union(*itertools.chain(*on_one_pin)):  # a gear on one pin pushes the link that carries it
            share = math.tan(data.pair.helix_angle) * data.pair.working_radius[0] / data.pair.reference_radius[0]
            found.append(abs(share) * design.meshes_found[name].tooth_force_max)
    return max(found)


def _links_of(connection: Connection) -> set[str]:
    """The moving links that it joins."""
    return {getattr(connection, "first", FRAME), connection.second} - {FRAME}


def _drawn(design: LoadsDesign) -> list[str]:
    """The meshes that a design has; those whose gears the file draws come first."""
    return [name for name in design.meshes if design.has(name)]


def _with_gears(design: Any) -> tuple[Any, Any]:
    """The part of a machine that knows its meshes, and the section with their keys."""
    machine = design if hasattr(type(design), "mesh_data") else design.design
    spec = machine.spec
    return machine, getattr(spec, "gears", None) or getattr(spec, "input_gears", None) or spec


CHECKS = (
    "power-identity",
    "load-reversal",
    "motor-torque",
    "motor-speed",
    "speed-fluctuation",
    "bearing-life",
    "force-amplification",
    "impact",
    "self-locking",
    "tooth-load",
)
_IDENTITY = 1e-9
_NEAR = 0.9
_LEAST_LIFE_MARGIN = 1.2
_OTHER_SPEED, _NEAR_SPEED, _UNEVEN = 0.1, 0.05, 0.2
_AMPLIFICATION = 5.0
_SWING_PER_BODY = 2.0 * 360.0
_SWING_UNKNOWN = 20.0
_NEAR_LOCKING = 0.5
_ROUNDING = 1e-9
_LESS_FRICTION = "take thinner pins or less friction"


def power_identity(design: LoadsDesign) -> Check:
    """GL601."""
    found = design.power_identity
    text = f"the input torque by virtual power and by the joint forces differ by {found:.1e} of the largest"
    if found <= _IDENTITY:
        return codes.POWER_IDENTITY.check("pass", text, found, _IDENTITY)
    return codes.POWER_IDENTITY.check("fail", f"{text}: the links come too near to a dead point", found, _IDENTITY)


def listed(places: list[float]) -> str:
    """Some places in words, the first six of them."""
    return ", ".join(f"{place:.5g}" for place in places[:6]) + (", ..." if len(places) > 6 else "")


def load_reversal(design: LoadsDesign) -> Iterator[Check]:
    """GL602: each mesh."""
    backlash, drawn = design.section.backlash, drawn_play(design)
    for name, mesh in design.meshes_found.items():
        places = [math.degrees(place) for place in mesh.reversal_places]
        play = backlash.get(name) if isinstance(backlash, dict) else backlash
        play = drawn.get(name) if play is None else play
        if not places:
            text = f"{name}: the teeth stay on one flank"
            yield codes.LOAD_REVERSAL.check("pass", text, 0.0, 0.0)
            continue
        text = f"{name}: the teeth change flanks {amount(len(places), 'time')} over the period, at {listed(places)} deg"
        inside = [place for place in places if design.is_quiet(math.radians(place))]
        if inside and play:
            lag = math.degrees(0.5 * play / mesh.radius)
            text += (
                f"; that at {inside[0]:.5g} deg lies where the output must stand or run true: "
                f"the link {mesh.second} lags by {lag:.3g} deg"
            )
            yield codes.LOAD_REVERSAL.check("fail", f"{text}; load the output one way", float(len(places)), 0.0)
        else:
            yield codes.LOAD_REVERSAL.check("warn", f"{text}: it rattles there", float(len(places)), 0.0)


def motor_torque(design: LoadsDesign) -> Iterator[Check]:
    """GL603: peak against the greatest torque, root mean square against the rated one."""
    motor, running = design.section.motor, design.running
    if motor is None:
        return
    if motor.max_torque is None and motor.rated_torque is None:
        text = f"the motor gives up to {abs(running.motor_peak or 0.0):.5g} N m, {running.motor_rms:.5g} N m root mean "
        text += "square, and the file names no torque of its own: give loads.motor.rated_torque and max_torque"
        yield codes.MOTOR_TORQUE.check("warn", text)
    margin = design.limit("torque_margin")
    pairs = (("peak", running.motor_peak, motor.max_torque), ("rms", running.motor_rms, motor.rated_torque))
    for words, signed, limit in pairs:
        if signed is None or limit is None:
            continue
        value, bound = abs(signed), limit / margin
        text = f"{words} of the motor's torque is {value:.5g} N m{', against its turning' if signed < 0.0 else ''}"
        remedy = f"it needs a motor of {safely_above(value * margin, 4)} N m or more, or a heavier flywheel"
        if value > bound:
            yield codes.MOTOR_TORQUE.check("fail", f"{text}, above {bound:.5g}: {remedy}", value, bound, "N m")
        elif value > limit:
            text += f", above the motor's own {limit:.5g}, though limits.torque_margin allows it: {remedy}"
            yield codes.MOTOR_TORQUE.check("warn", text, value, bound, "N m")
        elif value > _NEAR * bound:
            yield codes.MOTOR_TORQUE.check("warn", f"{text}, little below {bound:.5g}: {remedy}", value, bound, "N m")
        else:
            yield codes.MOTOR_TORQUE.check("pass", text, value, bound, "N m")


def motor_speed(design: LoadsDesign) -> Iterator[Check]:
    """GL603: the mean of the speeds at which the motor runs the machine against that of the file."""
    motor, running = design.section.motor, design.running
    if motor is None:
        return
    mean, asked = 0.5 * sum(running.range), abs(design.speed) / RPM
    off, name = abs(mean / asked - 1.0), codes.MOTOR_TORQUE.checks[1]
    text = f"loads.motor runs the input at {mean:.5g} rev/min, {asked:.5g} are those of the file"
    status: Status = "fail" if off > _OTHER_SPEED else "warn" if off > _NEAR_SPEED else "pass"
    if status != "pass":
        ratio = motor.ratio * mean / asked
        text += f": forces, lives and vibration are not those of this speed; take a ratio near {ratio:.4g}"
    yield codes.MOTOR_TORQUE.check(status, text, off, _OTHER_SPEED, name=name)


def speed_fluctuation(design: LoadsDesign) -> Iterator[Check]:
    """GL604, where the file has a flywheel or a motor."""
    flywheel, running = design.section.flywheel, design.running
    if flywheel is None and design.section.motor is None:
        return
    if running.stops:
        text = f"the machine stops: its load takes more than is stored in {running.inertia:.5g} kg m^2 of flywheel"
        remedy = "give loads.flywheel: {fluctuation: 0.05} alone to have the least one found"
        yield codes.SPEED_FLUCTUATION.check("fail", f"{text}; {remedy}", running.inertia, None, "kg m^2")
        return
    allowed, found = getattr(flywheel, "fluctuation", None), running.fluctuation
    text = f"the speed varies by {found:.4g} of its mean"
    if allowed is None:
        if found > _UNEVEN:
            text += ", and forces, lives and vibration are those of an even speed: take a heavier flywheel, or allow it"
            text += " by loads.flywheel.fluctuation"
            yield codes.SPEED_FLUCTUATION.check("warn", text, found, _UNEVEN)
    elif found > allowed * (1.0 + 1e-9):
        needed = safely_above(running.needed or 0.0, 4)
        message = f"{text}, more than {allowed:g}: at a constant drive torque {needed} kg m^2 would do"
        yield codes.SPEED_FLUCTUATION.check("fail", message, found, allowed)
    elif found > _NEAR * allowed and flywheel.inertia is not None:
        yield codes.SPEED_FLUCTUATION.check("warn", f"{text}, little below {allowed:g}", found, allowed)
    else:
        yield codes.SPEED_FLUCTUATION.check("pass", text, found, allowed)


def bearing_life(design: LoadsDesign) -> Iterator[Check]:
    """GL606, for the bearings of the file."""
    for name in design.section.bearings:
        pin = design.pins_found.get(name)
        if pin is None:
            continue
        bearing, life = pin.bearing, pin.life
        if bearing.kind != "plain" and pin.swing is not None:
            bodies = bearing.rolling_bodies
            least = _SWING_PER_BODY / bodies if bodies else _SWING_UNKNOWN
            swing = math.degrees(pin.swing)
            if swing < least:
                text = f"the bearing of {name} swings only {swing:.4g} deg, below {least:.4g}: its rating life does not"
                yield codes.BEARING_LIFE.check("warn", f"{text} hold; take a plain bearing", swing, least, "deg")
        if life is None or bearing.life is None:
            continue
        if axial := thrust(design, name):
            text = f"the rating life of the bearing of {name} is that of forces in the plane: helical teeth push along"
            text += f" their axis with up to {axial:.5g} N besides, and tilt their gear"
            yield codes.BEARING_LIFE.check("warn", f"{text}; add what the bearing takes of it", axial, 0.0, "N")
        text = f"the bearing of {name} has a rating life of {life:.5g} h"
        if life < bearing.life:
            rating = bearing.dynamic_rating * (bearing.life / life) ** (1.0 / pin.exponent)
            message = f"{text}, below {bearing.life:g}: it needs a dynamic rating of {safely_above(rating, 4)} N"
            yield codes.BEARING_LIFE.check("fail", message, life, bearing.life, "h")
        elif life < _LEAST_LIFE_MARGIN * bearing.life:
            yield codes.BEARING_LIFE.check("warn", f"{text}, little above {bearing.life:g}", life, bearing.life, "h")
        else:
            yield codes.BEARING_LIFE.check("pass", text, life, bearing.life, "h")


def force_amplification(design: LoadsDesign) -> Iterator[Check]:
    """GL612, for machines with a transmission angle."""
    least = design.transmission_angle
    if least is None:
        return
    found = 1.0 / math.sin(least)
    text = f"the least transmission angle {math.degrees(least):.4g} deg makes pin forces {found:.4g} times as large"
    if found > _AMPLIFICATION:
        message = f"{text} as at 90 deg: change the links for a larger one"
        yield codes.FORCE_AMPLIFICATION.check("warn", message, found, _AMPLIFICATION)
    else:
        yield codes.FORCE_AMPLIFICATION.check("pass", f"{text} as at 90 deg", found, _AMPLIFICATION)


def impact(design: LoadsDesign) -> Iterator[Check]:
    """GL614, for machines whose speed jumps."""
    energy = getattr(design, "engagement_energy", None)
    if energy is not None:
        text = f"the driven gear starts and stops at once: {energy:.4g} J each time, the force of it is not finite"
        yield codes.IMPACT.check(
            "warn", f"{text}; cut the first and the last tooth, or add entry cams", energy, 0.0, "J"
        )


def self_locking(design: LoadsDesign) -> Iterator[Check]:
    """GL615, with friction."""
    if design.machine.friction is None:
        return
    from gearlink.core.mechanism.rubbing import LOCKS

    ratio, place = design.nearest_locking
    if place is None:
        message = "with this friction there are no forces with which the mechanism moves: it locks itself"
        yield codes.SELF_LOCKING.check("fail", f"{message}; {_LESS_FRICTION}", None, LOCKS)
        return
    text = (
        f"a pass of the friction changes the forces by {ratio:.3g} of the pass before, at {math.degrees(place):.4g} deg"
    )
    if ratio > LOCKS or design.locks_between:
        message = f"{text}: the mechanism locks itself; {_LESS_FRICTION}"
        yield codes.SELF_LOCKING.check("fail", message, ratio, LOCKS)
    elif ratio > _NEAR_LOCKING:
        message = f"{text}: near self-locking; {_LESS_FRICTION}"
        yield codes.SELF_LOCKING.check("warn", message, ratio, _NEAR_LOCKING)
    else:
        yield codes.SELF_LOCKING.check("pass", text, ratio, _NEAR_LOCKING)


def tooth_load(design: LoadsDesign) -> Iterator[Check]:
    """GL616, of meshes whose teeth the file has rated."""
    for name, rated in rated_forces(design).items():
        mesh = design.meshes_found[name]
        found, back = bending_force(mesh), mesh.tooth_force_back
        text = f"{name}: the teeth carry up to {mesh.tooth_force_max:.5g} N"
        if back > 0.0:
            text += f", and {back:.5g} N on the other flanks, which bends them as {found:.5g} N one way"
        text += f", and are rated for {rated:.5g} N, K_A counted"
        if found > rated * (1.0 + _ROUNDING):
            text += f": their safeties are those of a smaller force; rate them for {found / rated:.4g} times the load"
            yield codes.TOOTH_LOAD.check("warn", text, found, rated, "N")
        else:
            yield codes.TOOTH_LOAD.check("pass", text, found, rated, "N")
