"""The geared five-bar in motion: a path over its whole period; a function over its range, there and back."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.figures import style
from gearlink.cli.scenes.gears import gear
from gearlink.cli.scenes.scene import (
    TURN,
    Body,
    Chain,
    Chart,
    Curve,
    Mark,
    Part,
    Points,
    Readout,
    Reals,
    Scene,
    loop,
    pale,
    standing,
    track,
)
from gearlink.core.gears.internal_mesh import InternalMesh
from gearlink.core.gears.mesh_phase import driven_turn, ring_turn
from gearlink.core.linkages.dyad import close_dyad

if TYPE_CHECKING:
    from gearlink.core.five_bar.design import GearedFiveBar


def build(design: GearedFiveBar, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    return _path_scene(design, fraction) if design.is_path else _function_scene(design, fraction)


def _path_scene(design: GearedFiveBar, fraction: Reals) -> Scene:
    bar, offset = design.path_bar, design.offset
    phi, whole = bar.period * fraction, bar.period * loop(361)
    ends = [bar.ends(angle) for angle in phi.tolist()]
    b, d = (np.array(pins) for pins in zip(*ends, strict=True))
    c = np.array([close_dyad(*pins, bar.coupler, bar.follower, bar.assembly) for pins in ends])
    m, path = (np.array([bar.point(angle, offset) for angle in angles.tolist()]) for angles in (phi, whole))
    a, e = track(0.0, fraction), track(bar.frame, fraction)
    plate = Body(
        outline=np.array([0.0, bar.coupler, offset, 0.0]),
        place=b,
        turn=np.unwrap(np.angle(c - b)),
        color=style.BLACK,
        fill=pale(style.BLACK, 0.25),
    )
    return Scene(
        parts=(
            *_path_gears(design, phi, fraction),
            standing(path, fraction, style.GREEN),
            plate,
            Chain(joints=(a, b, c, d, e), color=style.BLACK),
        ),
        marks=(*_marks(a, b, c, d, e), Mark(point=m, text="M" if abs(offset - bar.coupler) > 1e-9 else "")),
        chart=Chart(
            xlabel="input angle [deg]",
            ylabel="coupler point M [mm]",
            x=np.degrees(whole),
            now=np.degrees(phi),
            curves=(
                Curve(label="x", color=style.BLUE, y=path.real, now=m.real),
                Curve(label="y", color=style.ORANGE, y=path.imag, now=m.imag),
            ),
        ),
        readouts=(
            Readout(label="input", unit="°", values=np.degrees(phi)),
            Readout(label="x", unit=" mm", values=m.real),
            Readout(label="y", unit=" mm", values=m.imag),
        ),
    )


def _marks(*joints: Points) -> tuple[Mark, ...]:
    return tuple(Mark(point=joint, text=name, pivot=name in "AE") for name, joint in zip("ABCDE", joints, strict=True))


def _path_gears(design: GearedFiveBar, phi: Reals, fraction: Reals) -> list[Part]:
    """Gears on A and E, and an idler above the frame."""
    bar, period = design.path_bar, design.path_bar.period_turns
    a, e = track(0.0, fraction), track(bar.frame, fraction)
    first, *more = design.meshes.values()
    level, turned = np.zeros_like(phi), period * float(bar.ratio)
    if isinstance(first, InternalMesh):
        return _ring_pair(design, first, phi, (a, e))
    if not more:
        turn = driven_turn(first.teeth, level, phi)
        return [*gear(first, 0, a, phi, period, style.BLUE, "1"), *gear(first, 1, e, turn, turned, style.ORANGE, "4")]
    (second,) = more
    idler = close_dyad(0j, complex(bar.frame), first.center_distance, second.center_distance, 1)
    middle = driven_turn(first.teeth, level + cmath.phase(idler), phi)
    turn = driven_turn((second.teeth[0], second.teeth[1]), level + cmath.phase(bar.frame - idler), middle)
    idler_turns = -period * first.teeth[0] / first.teeth[1]
    return [
        *gear(first, 0, a, phi, period, style.BLUE, "1"),
        *gear(second, 1, e, turn, turned, style.ORANGE, "4"),
        *gear(first, 1, track(idler, fraction), middle, idler_turns, style.PURPLE, "idler"),
    ]


def _ring_pair(design: GearedFiveBar, mesh: InternalMesh, phi: Reals, axes: tuple[Points, Points]) -> list[Part]:
    """A ring gear on A or on E, the other gear in it; the ring is drawn first."""
    pinion, ring = mesh.teeth
    period, turned = design.period_turns, design.period_turns * float(design.ratio)
    level = np.zeros_like(phi)
    if design.spec.gears.input == ring:
        turn = ring_turn((ring, pinion), level, phi)
        return [
            *gear(mesh, 1, axes[0], phi, period, style.BLUE, "1"),
            *gear(mesh, 0, axes[1], turn, turned, style.ORANGE, "4"),
        ]
    turn = ring_turn((pinion, ring), level + math.pi, phi)
    return [
        *gear(mesh, 1, axes[1], turn, turned, style.ORANGE, "4"),
        *gear(mesh, 0, axes[0], phi, period, style.BLUE, "1"),
    ]


def _input_angles(design: GearedFiveBar, fraction: Reals) -> Reals:
    """Input angles of a function: straight through where its range closes in itself, else there and back."""
    start, end = design.input_range
    turns = (end - start) / TURN
    wound = turns * float(design.ratio)
    if max(abs(turns - round(turns)), abs(wound - round(wound))) < 1e-9:
        return start + (end - start) * fraction
    return np.asarray(start + (end - start) * 0.5 * (1.0 - np.cos(TURN * fraction)))


def _function_scene(design: GearedFiveBar, fraction: Reals) -> Scene:
    bar, phi = design.function_bar, _input_angles(design, fraction)
    c, d = (np.array([pin(angle) for angle in phi.tolist()]) for pin in (bar.joint, bar.end))
    a, e = track(0.0, fraction), track(bar.frame, fraction)
    b = bar.input * np.exp(1j * phi)
    whole = np.linspace(*design.input_range, 361)
    output = np.array(bar.output_angles(whole.tolist()))
    # The curve tells the turn, the mechanism the angle itself.
    raw = np.angle(d - bar.frame)
    now = raw + TURN * np.round((np.interp(phi, whole, output) - raw) / TURN)
    return Scene(
        parts=(*_function_gears(design, phi, a, b), Chain(joints=(a, b, c, d, e), color=style.BLACK)),
        marks=_marks(a, b, c, d, e),
        chart=Chart(
            xlabel="input angle [deg]",
            ylabel="output angle [deg]",
            x=np.degrees(whole),
            now=np.degrees(phi),
            curves=(Curve(label="output", color=style.BLUE, y=np.degrees(output), now=np.degrees(now)),),
        ),
        readouts=(
            Readout(label="input", unit="°", values=np.degrees(phi)),
            Readout(label="output", unit="°", values=np.degrees(now)),
        ),
    )


def _function_gears(design: GearedFiveBar, phi: Reals, a: Points, b: Points) -> list[Part]:
    """The gear that is fixed to the frame, and the planet that rolls on it, or in it."""
    (mesh,) = design.meshes.values()
    planet, fixed = mesh.teeth
    still = np.zeros_like(phi)
    internal = isinstance(mesh, InternalMesh)
    turn = ring_turn((fixed, planet), phi, still) if internal else driven_turn((fixed, planet), phi, still)
    there_and_back = float(abs(_input_angles(design, np.ones(1))[0] - _input_angles(design, np.zeros(1))[0]))
    turns = there_and_back / TURN * float(design.ratio)
    return [
        *gear(mesh, 1, a, still, 0.0, style.ORANGE, "" if internal else "5"),
        *gear(mesh, 0, b, turn, turns, style.BLUE, "2"),
    ]
