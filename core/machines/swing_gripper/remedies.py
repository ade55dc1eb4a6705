"""What to change in a swing gripper that fails: ways to go, and numbers from closed forms."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.remedies.ways import REFUSAL, Way, at_least, at_most, down, either, refusal_ways, shared
from gearlink.core.parts.cams.checks import HUB, ROLLER_SHARE

if TYPE_CHECKING:
    from gearlink.core.base.report import Remedy
    from gearlink.core.machines.swing_gripper.design import SwingGripper

_RESERVE = 1.1
"""Speed at which a roller may lift off, over the speed of the machine."""
_FINE = 3
"""Digits behind the point of what places the handover."""
_LINKAGE = (*either("output_direction", step=0.5), *either("links.coupler", "links.output", "links.input"))
_ROLLERS = either("cam.roller.angle", "cam.return_roller.angle", step=1.0)
_WAYS = {
    "transmission-angle": _LINKAGE,
    "conditioning": _LINKAGE,
    "handover": (down("release.window"),),
    "pressure-angle": (
        shared("phases.return", "phases.near_dwell", step=1.0)[0],
        shared("phases.decelerate", "phases.far_dwell", step=1.0)[0],
        *_ROLLERS,
        *_LINKAGE,
    ),
    "shaft-clearance": (*_ROLLERS, down("cam.return_roller.radius"), down("cam.roller.radius")),
    "lift-off": either("cam.return_roller.angle", step=1.0),
}
_QUIET = {"accelerate": "velocity-345", "decelerate": "velocity-345", "return": "modified-sine"}
_QUIETER = {"accelerate": "velocity-4567", "decelerate": "velocity-4567", "return": "polynomial-4567"}


def ways_of(design: SwingGripper, check: str) -> tuple[Way, ...]:
    """Ways in which a check that fails may be repaired; for cams that cannot be, those of their refusal."""
    if check == "pressure-angle" and design.cams.refusal is not None:
        return tuple(refusal_ways(design.spec, design.cams.refusal.key))
    return _WAYS.get(check, ())


def candidates(design: SwingGripper, check: str) -> Iterator[Remedy]:
    """Remedies of a check from closed forms, the first to be tried first."""
    return _CLOSED[check](design) if check in _CLOSED else iter(())


def _handover(design: SwingGripper) -> Iterator[Remedy]:
    """The middle of the constant phase; the arm or the cylinder's axis where the tip meets the line of centres.

    First the sense of a cam on the cylinder's own shaft, which must turn that against the gripper's swing.
    """
    from gearlink.core.machines.swing_gripper.checks import runs_backwards
    from gearlink.core.machines.swing_gripper.handover_geometry import misplacement, widest_window

    spec, (start, end) = design.spec, design.motion.law.starts[1:3]
    if spec.cam is not None and runs_backwards(design):
        yield (("cam.sense", -spec.swing_sense),)
        yield (("swing_sense", -spec.cam.sense),)
    if spec.cylinder.center is not None:
        center = complex(*spec.cylinder.center)
        off = misplacement(complex(*spec.pivots.output), design.handover.tip, center, spec.cylinder.radius)
        fits = design.handover.center
        yield (("arm.direction", round(spec.arm.direction + math.degrees(off.turn), _FINE)),)
        yield _point("cylinder.center", fits, _FINE)
    yield (("handover", 0.5 * (start + end)),)
    if spec.release is not None:
        widest = math.degrees(widest_window(spec.arm.length, spec.cylinder.radius, spec.release.gap))
        room = min(spec.handover - start, end - spec.handover)
        yield (("release.window", at_most(min(widest, room) if room > 0.0 else widest)),)


def _turn(design: SwingGripper) -> Iterator[Remedy]:
    """ED turned as far as the whole swing needs, in half degrees."""
    from gearlink.core.machines.swing_gripper.swing import clear_turn

    spec = design.spec
    for more in (0.0, 2.0, 5.0):
        turn, _ = clear_turn(design.motion.linkage, math.radians(spec.limits.transmission_angle + more))
        if turn is not None:
            wanted = spec.output_direction + math.degrees(turn)
            yield (("output_direction", (at_least if turn > 0.0 else at_most)(wanted, 0.5)),)


def _point(path: str, place: complex, digits: int) -> Remedy:
    return (f"{path}[0]", round(place.real, digits)), (f"{path}[1]", round(place.imag, digits))


def _pressure(design: SwingGripper) -> Iterator[Remedy]:
    """The centre of the smallest cams that keep the limits, or the angle that the centre is chosen for."""
    limits, cam = design.spec.limits, design.cams.section
    for limit in (limits.pressure_angle, min(limits.pressure_angle, limits.accelerate_pressure_angle)):
        if cam.center is None:
            yield (("size.pressure_angle", at_most(0.99 * limit, 0.5)),)
            continue
        try:
            yield _point("cam.center", design.cams.center_for(0.99 * limit, refined=False), 1)
        except NoSolution:
            continue
    yield from _longer_acceleration(design)


def _longer_acceleration(design: SwingGripper) -> Iterator[Remedy]:
    """More of the dwell before it, with the handover as far behind."""
    phases = design.spec.phases
    for more in (5.0, 10.0, 20.0, 30.0):
        if more < phases.near_dwell:
            yield (
                ("phases.accelerate", phases.accelerate + more),
                ("phases.near_dwell", phases.near_dwell - more),
                ("handover", design.spec.handover + more),
            )


def _rollers(design: SwingGripper) -> Iterator[Remedy]:
    """Rollers well below the least curvature radius of their cams."""
    most = [at_most(ROLLER_SHARE * cam.min_curvature_radius.value) for cam in design.cams.discs]
    for key, radius in zip(("cam.roller.radius", "cam.return_roller.radius"), most, strict=False):
        yield ((key, radius),)


def _shaft(design: SwingGripper) -> Iterator[Remedy]:
    """Rollers that leave a hub round the shaft, where no more than half is to be taken off them; or a thinner shaft."""
    section, least = design.cams.section, min(design.cams.min_radius)
    rollers = {"cam.roller.radius": section.roller, "cam.return_roller.radius": section.return_roller}
    smaller: list[tuple[str, float]] = []
    for (key, roller), radius in zip(rollers.items(), design.cams.min_radius, strict=False):
        missing = HUB * section.shaft_radius - radius
        if roller is not None and missing > 0.0:
            smaller.append((key, at_most(roller.radius - missing)))
            if smaller[-1][1] < 0.5 * roller.radius:
                smaller.clear()
                break
    if smaller:
        yield tuple(smaller)
    if least > 0.0:
        yield (("cam.shaft_radius", at_most(least / HUB)),)


def _laws(design: SwingGripper, quiet: dict[str, str]) -> Iterator[Remedy]:
    """Laws without the step, one after the other and all of them."""
    given = design.spec.laws
    better = [
        (f"laws.{key}", law) for key, law in quiet.items() if getattr(given, key.replace("return", "return_")) != law
    ]
    yield from ((change,) for change in better)
    if len(better) > 1:
        yield tuple(better)


def _closing(design: SwingGripper) -> Iterator[Remedy]:
    """The spring that leaves a tenth of speed in reserve: what the inertia takes grows with the square of the speed."""
    spring, closure = design.spec.spring, design.closure
    if spring is None or not closure.stands:
        return
    worst = max(extreme.value for extreme in closure.worst_unloading)
    if spring.torque is not None:
        yield (("spring.torque", at_least(_RESERVE**2 * worst + spring.reserve, 1.0)),)
        return
    yield (("spring.preload", at_least(closure.preload_for(_RESERVE**2 * worst + spring.reserve), 1.0)),)


_CLOSED: dict[str, Callable[[SwingGripper], Iterator[Remedy]]] = {
    REFUSAL: lambda design: _laws(design, _QUIET),
    "transmission-angle": _turn,
    "handover": _handover,
    "pressure-angle": _pressure,
    "cam-undercut": _rollers,
    "shaft-clearance": _shaft,
    "acceleration-step": lambda design: _laws(design, _QUIET),
    "velocity-step": lambda design: _laws(design, _QUIET),
    "jerk-step": lambda design: _laws(design, _QUIETER),
    "lift-off": _closing,
}
