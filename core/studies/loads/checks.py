"""The checks of `loads` and of the vibration of the output, in the order of their codes."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.report import NO_NUMBER, Check, Shown, Side, Status, safely_above, safely_below
from gearlink.core.base.wording import amount, short
from gearlink.core.mechanism.joints import Connection, Pin
from gearlink.core.mechanism.links import FRAME
from gearlink.core.studies import codes
from gearlink.core.studies.loads.names import RPM

if TYPE_CHECKING:
    from gearlink.core.studies.loads.design import LoadsDesign
    from gearlink.core.studies.loads.joints import MeshLoad


# What the teeth of a machine are rated for, and what they push along their axes, beside its loads in the plane

_MEAN_STRESS = 0.4
"""M of tempered steel."""


def rated_forces(design: LoadsDesign) -> dict[str, float]:
    """Tangential forces at the pitch circles for which the file has the teeth rated [N], K_A counted, by mesh.

    F_t K_A r/r_w
    """
    found = {}
    for name, data in _meshes(design, "load"):
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
    """Maximum circumferential backlash that the gears as drawn leave [mm], by mesh; empty without allowances."""
    plays = {name: data.backlash for name, data in _meshes(design, "allowances")}
    return {name: play.circumferential[1] for name, play in plays.items() if play is not None}


def thrust(design: LoadsDesign, pin: str) -> float:
    """Maximum axial force of the helical teeth that a pin holds [N], which forces in the plane do not show; or 0.

    F_a = F_t tan(beta_w),   tan(beta_w) = tan(beta) r_w/r

    Parameters
        pin : str - of a gear, or of the link that a gear is fixed to
    """
    if not (meshes := _meshes(design, "helix_angle")):
        return 0.0
    connections = {each.name: each for each in design.machine.at(np.zeros(1)).connections}
    pins = [_links_of(each) for each in connections.values() if isinstance(each, Pin)]
    held = _links_of(connections[pin])
    found = [0.0]
    for name, data in meshes:
        gears = _links_of(connections[name])
        on_one_pin = [links for gear in gears if len(links := [each for each in pins if gear in each]) == 1]
        if held & gears.union(*itertools.chain(*on_one_pin)):  # a gear on one pin pushes the link that carries it
            share = math.tan(data.pair.helix_angle) * data.pair.working_radius[0] / data.pair.reference_radius[0]
            found.append(abs(share) * design.meshes_found[name].tooth_force_max)
    return max(found)


def _links_of(connection: Connection) -> set[str]:
    """The moving links that it joins."""
    return {getattr(connection, "first", FRAME), connection.second} - {FRAME}


def _meshes(design: Any, key: str) -> list[tuple[str, Any]]:
    """The meshes whose gears the file draws, which come first, with their data; none where it leaves out a key."""
    machine = design if hasattr(type(design), "mesh_data") else design.design
    keys = getattr(machine.spec, "gears", None) or getattr(machine.spec, "input_gears", None) or machine.spec
    if not getattr(keys, key, None) or not hasattr(type(machine), "mesh_data"):
        return []
    return list(zip(filter(design.has, design.meshes), machine.mesh_data.values(), strict=False))


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
_LESS_FRICTION = "reduce the friction or the pin radii"


def power_identity(design: LoadsDesign) -> Check:
    """GL601."""
    found = design.power_identity
    status: Status = "pass" if found <= _IDENTITY else "fail"
    what = "difference of the input torques by virtual power and by joint forces, over their maximum"
    fix = "keep the links farther from a dead centre"
    return codes.POWER_IDENTITY.check(status, what, found, _IDENTITY, fix=fix)


def listed(places: list[float]) -> str:
    """Some places in words, the first six of them."""
    return ", ".join(short(place) for place in places[:6]) + (", ..." if len(places) > 6 else "")


def load_reversal(design: LoadsDesign) -> Iterator[Check]:
    """GL602: each mesh."""
    backlash, drawn = design.section.backlash, drawn_play(design)
    for name, mesh in design.meshes_found.items():
        places = [math.degrees(place) for place in mesh.reversal_places]
        play = backlash.get(name) if isinstance(backlash, dict) else backlash
        play = drawn.get(name) if play is None else play
        if not places:
            what = f"{name}: the teeth stay on one flank"
            yield codes.LOAD_REVERSAL.check("pass", what, 0.0, 0.0, shown=NO_NUMBER)
            continue
        status: Status = "warn"
        what = f"{name}: the teeth change flanks {amount(len(places), 'time')} over the period"
        fix = note = ""
        inside = [place for place in places if design.is_quiet(math.radians(place))]
        if inside and play:
            lag = math.degrees(0.5 * play / mesh.radius)
            status, fix = "fail", "load the output in one direction"
            note = f"{mesh.second} lags by {short(lag)} deg at {short(inside[0])} deg, where the output must dwell"
        at, count = f"{listed(places)} deg", float(len(places))
        yield codes.LOAD_REVERSAL.check(status, what, count, 0.0, shown=NO_NUMBER, at=at, fix=fix, note=note)


def motor_torque(design: LoadsDesign) -> Iterator[Check]:
    """GL603: peak against the maximum torque, root mean square against the rated one."""
    motor, running = design.section.motor, design.running
    if motor is None:
        return
    if motor.max_torque is None and motor.rated_torque is None:
        what, fix = "the file gives no torque of the motor", "give loads.motor.rated_torque and max_torque"
        aside = f"required up to {short(abs(running.motor_peak or 0.0))} N m, rms {short(running.motor_rms or 0.0)} N m"
        yield codes.MOTOR_TORQUE.check("warn", what, aside=aside, fix=fix)
    margin = design.limit("torque_margin")
    pairs = (("peak", running.motor_peak, motor.max_torque), ("rms", running.motor_rms, motor.rated_torque))
    for words, signed, limit in pairs:
        if signed is None or limit is None:
            continue
        value, bound = abs(signed), limit / margin
        status: Status = "fail" if value > bound else "warn" if value > min(limit, _NEAR * bound) else "pass"
        yield codes.MOTOR_TORQUE.check(
            status,
            f"{words} torque of the motor",
            value,
            bound,
            "N m",
            recommended=min(limit, _NEAR * bound),
            aside="against its rotation" if signed < 0.0 else "",
            fix=f"use a motor of at least {safely_above(value * margin)} N m",
        )


def motor_speed(design: LoadsDesign) -> Iterator[Check]:
    """GL603: the mean of the speeds at which the motor runs the machine against that of the file."""
    motor, running = design.section.motor, design.running
    if motor is None:
        return
    mean, asked = 0.5 * sum(running.range), abs(design.speed) / RPM
    off, name = abs(mean / asked - 1.0), codes.MOTOR_TORQUE.checks[1]
    status: Status = "fail" if off > _OTHER_SPEED else "warn" if off > _NEAR_SPEED else "pass"
    ratio = None if status == "pass" else running.ratio_of_speed
    yield codes.MOTOR_TORQUE.check(
        status,
        "relative deviation of the motor's mean speed from that of the file",
        off,
        _OTHER_SPEED,
        name=name,
        recommended=_NEAR_SPEED,
        aside=f"motor {short(mean)} 1/min, file {short(asked)} 1/min",
        fix=f"set loads.motor.ratio near {short(ratio)}" if ratio else "use a stronger motor, or one of less slip",
        note="forces, lives and vibration are those of the speed of the file" if status != "pass" else "",
    )


def speed_fluctuation(design: LoadsDesign) -> Iterator[Check]:
    """GL604, where the file has a flywheel or a motor."""
    flywheel, running = design.section.flywheel, design.running
    if flywheel is None and design.section.motor is None:
        return
    if running.stops:
        what = "the machine stops: its load needs more energy than this flywheel stores"
        fix = "give loads.flywheel: {fluctuation: 0.05} alone to find the minimum flywheel"
        yield codes.SPEED_FLUCTUATION.check("fail", what, running.inertia, None, "kg m^2", fix=fix)
        return
    allowed, found = getattr(flywheel, "fluctuation", None), running.fluctuation
    what = "speed fluctuation"
    if allowed is None:
        if found > _UNEVEN:
            fix = "use a heavier flywheel, or increase loads.flywheel.fluctuation"
            note = "forces, lives and vibration are those of a constant speed"
            yield codes.SPEED_FLUCTUATION.check("warn", what, found, _UNEVEN, fix=fix, note=note)
    elif found > allowed * (1.0 + 1e-9):
        fix = f"use a flywheel of {safely_above(running.needed or 0.0)} kg m^2"
        yield codes.SPEED_FLUCTUATION.check("fail", what, found, allowed, fix=fix)
    elif found > _NEAR * allowed and flywheel.inertia is not None:
        most, fix = _NEAR * allowed, "use a heavier flywheel"
        yield codes.SPEED_FLUCTUATION.check("warn", what, found, allowed, recommended=most, fix=fix)
    else:
        yield codes.SPEED_FLUCTUATION.check("pass", what, found, allowed)


def bearing_life(design: LoadsDesign) -> Iterator[Check]:
    """GL606, for the bearings of the file."""
    for name in design.section.bearings:
        pin = design.borne_by(name)
        if pin is None:
            continue
        bearing, life = pin.bearing, pin.life
        if bearing.kind != "plain" and pin.swing is not None:
            bodies = bearing.rolling_bodies
            least = _SWING_PER_BODY / bodies if bodies else _SWING_UNKNOWN
            swing = math.degrees(pin.swing)
            if swing < least:
                what, fix = f"swing of the bearing of {name}, too small for a rating life", "use a plain bearing"
                yield codes.BEARING_LIFE.check("warn", what, swing, least, "deg", fix=fix)
        if life is None or bearing.life is None:
            continue
        if axial := thrust(design, name):
            what, fix = f"axial force of helical teeth on the bearing of {name}", "add it to the load of the bearing"
            note = "its rating life includes only the forces in the plane"
            shown = Shown(axial, None, "N")
            yield codes.BEARING_LIFE.check("warn", what, axial, 0.0, "N", shown=shown, fix=fix, note=note)
        least = _LEAST_LIFE_MARGIN * bearing.life
        rating = bearing.dynamic_rating * ((bearing.life if life < bearing.life else least) / life) ** (
            1.0 / pin.exponent
        )
        fix = f"use a bearing with a dynamic rating of {safely_above(rating)} N"
        yield codes.BEARING_LIFE.below(life, bearing.life, least, "h", f"rating life of the bearing of {name}", fix)


def force_amplification(design: LoadsDesign) -> Iterator[Check]:
    """GL612, for machines with a transmission angle."""
    least = design.transmission_angle
    if least is None:
        return
    found = 1.0 / math.sin(least)
    yield codes.FORCE_AMPLIFICATION.check(
        "warn" if found > _AMPLIFICATION else "pass",
        "pin forces over those at a transmission angle of 90 deg",
        found,
        _AMPLIFICATION,
        aside=f"minimum transmission angle {short(math.degrees(least))} deg",
        fix="change the links to increase the transmission angle",
    )


def impact(design: LoadsDesign) -> Iterator[Check]:
    """GL614, for machines whose speed jumps."""
    energy = getattr(design, "engagement_energy", None)
    if energy is not None:
        what, fix = "impact energy at each start and stop of the driven gear", "add entry cams, or cut the end teeth"
        yield codes.IMPACT.check(
            "warn", what, energy, 0.0, "J", fix=fix, note="the force of the impact is not computed"
        )


def self_locking(design: LoadsDesign) -> Iterator[Check]:
    """GL615, with friction."""
    if design.machine.friction is None:
        return
    from gearlink.core.mechanism.friction import LOCKS

    ratio, place = design.nearest_locking
    if place is None:
        what = "the mechanism is self-locking with this friction"
        yield codes.SELF_LOCKING.check("fail", what, None, LOCKS, fix=_LESS_FRICTION)
        return
    what, at = "convergence ratio of the friction iteration", f"{short(math.degrees(place))} deg"
    if ratio > LOCKS or design.locks_between:
        what, shown = f"{what}, self-locking", Shown(ratio, LOCKS if ratio > LOCKS else None, "1", "<=")
        yield codes.SELF_LOCKING.check("fail", what, ratio, LOCKS, shown=shown, at=at, fix=_LESS_FRICTION)
        return
    status: Status = "warn" if ratio > _NEAR_LOCKING else "pass"
    yield codes.SELF_LOCKING.check(
        status, what, ratio, _NEAR_LOCKING, aside=f"self-locking above {LOCKS:g}", at=at, fix=_LESS_FRICTION
    )


def tooth_load(design: LoadsDesign) -> Iterator[Check]:
    """GL616, of meshes whose teeth the file has rated."""
    for name, rated in rated_forces(design).items():
        mesh = design.meshes_found[name]
        found, back = bending_force(mesh), mesh.tooth_force_back
        other = f", {short(back)} N on the opposite flanks" if back > 0.0 else ""
        over = found > rated * (1.0 + _ROUNDING)
        yield codes.TOOTH_LOAD.check(
            "warn" if over else "pass",
            f"{name}: tooth force over the force of the rating",
            found,
            rated,
            "N",
            aside=f"up to {short(mesh.tooth_force_max)} N{other}",
            fix=f"rate the teeth for {safely_above(found / rated)} times the load",
        )


VIBRATION_CHECKS = ("rigid-model", "residual-vibration", "resonance")
_ONE_PERCENT = 0.01
_NEAR_VIBRATION = 0.8
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
    r, residual = vibrating.rise_periods, vibrating.residual
    aside = f"{short(r)} natural periods per motion" if r is not None else ""
    share = residual / vibrating.lift if residual else None  # an output that stands has neither
    if found >= limit and share is not None and share > _ONE_PERCENT:
        what, shown = "residual vibration after the motion, over the lift", Shown(100.0 * share, 1.0, "%", "<=")
        fix = "use a smoother motion law, or a lower speed"
        yield codes.RIGID_MODEL.check("warn", what, share, _ONE_PERCENT, shown=shown, aside=aside, fix=fix)
        return
    status: Status = "warn" if found < limit else "pass"
    what, fix = (
        "natural frequency of the output over the frequency of the input",
        "stiffen the output, or reduce the speed",
    )
    note = "forces are those of rigid links" if status == "warn" else ""
    yield codes.RIGID_MODEL.check(status, what, found, limit, side=">=", aside=aside, fix=fix, note=note)


def residual_vibration(design: LoadsDesign) -> Iterator[Check]:
    """GL610, where the file allows some."""
    vibration = design.section.vibration
    allowed = None if vibration is None else vibration.allowed_residual
    if allowed is None:
        return
    vibrating = design.vibrating
    unit = "mm" if vibrating.slides else "deg"
    if not vibrating.motions:
        what = "the output has no dwell, so there is no residual vibration"
        fix = "remove loads.vibration.allowed_residual; the table harmonics has the deflection"
        yield codes.RESIDUAL_VIBRATION.check("warn", what, None, allowed, unit, fix=fix)
        return
    found = vibrating.residual if vibrating.residual is not None else vibrating.twist
    if found is None:  # resonance tells
        return
    status: Status = "fail" if found > allowed else "warn" if found > _NEAR_VIBRATION * allowed else "pass"
    what, most = "vibration of the output in its dwell", _NEAR_VIBRATION * allowed
    slowest = None if status == "pass" else vibrating.speed_leaving(most)  # takes longer than all else of the vibration
    key = "loads.vibration.stiffness" if vibration.frequency is None else "loads.vibration.frequency"
    fix = f"raise {key}"
    if slowest:
        fix = f"reduce the speed to at most {safely_below(slowest / design.speed_unit)} {design.speed_words}"
    yield codes.RESIDUAL_VIBRATION.check(status, what, found, allowed, unit, recommended=most, fix=fix)


def resonance(design: LoadsDesign) -> Iterator[Check]:
    """GL611: a harmonic of the motion at the natural frequency."""
    if design.section.vibration is None:
        return
    vibrating, turns = design.vibrating, design.turns
    ratio = vibrating.frequency_ratio * turns
    order = max(1, round(ratio))
    if vibrating.response.unbounded:
        what = f"{_harmonic(order, turns)}, resonance without damping"
        off, fix = abs(ratio / order - 1.0), "change the speed, or give loads.vibration.damping"
        yield codes.RESONANCE.check("fail", what, off, _NEAR_RESONANCE, shown=_percent(off), fix=fix)
        return
    # Of a period of several turns, or a motion of which every second harmonic is none, the nearest may be nothing.
    near = [n for n in orders_near(ratio) if abs(ratio / n - 1.0) < _NEAR_RESONANCE]
    shares = dict(zip(near, design.harmonic_shares(near), strict=True))
    strong = [n for n in near if math.isfinite(shares[n]) and shares[n] > _ONE_PERCENT]
    if not strong:
        off = abs(ratio / order - 1.0)
        side: Side = ">=" if off >= _NEAR_RESONANCE else ""  # else one too weak to matter
        shown = _percent(off, limited=off >= _NEAR_RESONANCE)
        yield codes.RESONANCE.check("pass", _harmonic(order, turns), off, _NEAR_RESONANCE, side=side, shown=shown)
        return
    found = min(strong, key=lambda n: abs(ratio / n - 1.0))
    off = abs(ratio / found - 1.0)
    # from the fifth harmonic on the next one is as near, whatever the speed
    remedy = "change the speed by 10 %" if found < _CLOSE * turns else "stiffen the output, or use a smoother law"
    aside = f"{short(100.0 * shares[found], 3)} % of the largest harmonic"
    what, shown = _harmonic(found, turns), _percent(off)
    yield codes.RESONANCE.check("warn", what, off, _NEAR_RESONANCE, shown=shown, aside=aside, fix=remedy)


def orders_near(ratio: float) -> range:
    """Whole numbers from which a ratio is not farther than a tenth of them, and its nearest one.

    Example
        >>> list(orders_near(3.1)), list(orders_near(27.5)), list(orders_near(1.4))
        ([3], [25, 26, 27, 28, 29, 30], [1])
    """
    low, high = math.ceil(ratio / (1.0 + _NEAR_RESONANCE)), math.floor(ratio / (1.0 - _NEAR_RESONANCE))
    nearest = max(1, round(ratio))
    return range(max(1, min(low, nearest)), max(high, nearest) + 1)


def _harmonic(order: int, turns: int) -> str:
    over = f" over {turns} revolutions" if turns > 1 else ""
    return f"distance of harmonic {order}{over} from the natural frequency"


def _percent(off: float, *, limited: bool = True) -> Shown:
    return Shown(100.0 * off, 100.0 * _NEAR_RESONANCE if limited else None, "%", ">=")
