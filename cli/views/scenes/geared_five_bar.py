"""The geared five-bar: a path over its whole period; a function over its range, there and back."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes.colors import BLACK, BLUE, GREEN, ORANGE, PURPLE, pale
from gearlink.cli.views.scenes.gears import gear
from gearlink.cli.views.scenes.scene import (
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
    letters,
    loop,
    standing,
    track,
)
from gearlink.core.parts.gears.outline.mesh_geometry import driven_turn, ring_turn
from gearlink.core.parts.linkages.dyad import close_dyad

if TYPE_CHECKING:
    from gearlink.core.machines.five_bar.design import GearedFiveBar
    from gearlink.core.parts.gears.mesh.pair import GearPair

_PINS = (("input", "A"), ("coupler", "B"), ("coupler", "C"), ("output", "D"), ("output", "E"))


def build(design: GearedFiveBar, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    return _path_scene(design, fraction) if design.is_path else _function_scene(design, fraction)


def _path_scene(design: GearedFiveBar, fraction: Reals) -> Scene:
    bar, offset = design.path_bar, design.offset
    phi, whole = bar.period * fraction, bar.period * loop(361)
    links = design.moving.at(phi, 0).links
    coupler = links["coupler"]
    a, b, c, d, e = (links[link].at(pin).value for link, pin in _PINS)
    m, path = coupler.at("M").value, design.moving.at(whole, 0).links["coupler"].at("M").value
    apart = bool(abs(offset - bar.coupler) > 1e-9)
    plate = Body(
        outline=np.array([0.0, bar.coupler, offset, 0.0]),
        place=b,
        turn=coupler.turn.value,
        color=BLACK,
        width=0.5,
        fill=pale(BLACK, 0.25),
    )
    return Scene(
        parts=(
            *_path_gears(design, phi, fraction),
            standing(_path(design), fraction, GREEN, "path of M"),
            plate,
            Chain(joints=(a, b, c, d, e)),
            Chain(joints=(m,), color=GREEN),
        ),
        marks=(
            *letters("AE", **{"A": a, "B": b, "C" if apart else "C, M": c, "D": d, "E": e}),
            *([Mark(m, "M")] * apart),
        ),
        chart=Chart(
            "input angle [deg]",
            "coupler point M [mm]",
            np.degrees(whole),
            np.degrees(phi),
            (Curve("x", BLUE, path.real, m.real), Curve("y", ORANGE, path.imag, m.imag)),
        ),
        readouts=(Readout("input", "°", np.degrees(phi)), Readout("x", " mm", m.real), Readout("y", " mm", m.imag)),
    )


def _path(design: GearedFiveBar) -> Points:
    """The path of M as its table has it, closed where the table has the whole of it."""
    table = design.table("path")
    x, y = (np.asarray(table.data[table.columns.index(name)]) for name in ("x", "y"))
    path: Points = x + 1j * y
    return np.append(path, path[0]) if design.shown_turns == design.period_turns else path


def _path_gears(design: GearedFiveBar, phi: Reals, fraction: Reals) -> list[Part]:
    """Gears on A and E, and an idler above the frame; a ring gear is drawn first."""
    bar, period = design.path_bar, design.path_bar.period_turns
    a, e = track(0.0, fraction), track(bar.frame, fraction)
    first, *more = design.meshes.values()
    level, turned = np.zeros_like(phi), period * float(bar.ratio)

    def on_input(mesh: GearPair, number: int) -> list[Body]:
        return gear(mesh, number, a, phi, period, BLUE, "1", "input gear", design.outer_rim(design.mesh_names[0]))

    def on_output(mesh: GearPair, number: int, turn: Reals) -> list[Body]:
        return gear(mesh, number, e, turn, turned, ORANGE, "4", "output gear", design.outer_rim(design.mesh_names[0]))

    if first.internal:
        pinion, ring = (abs(z) for z in first.teeth)
        if design.signed_teeth[0] < 0:
            return [*on_input(first, 1), *on_output(first, 0, ring_turn((ring, pinion), level, phi))]
        return [*on_output(first, 1, ring_turn((pinion, ring), level + math.pi, phi)), *on_input(first, 0)]
    if not more:
        return [*on_input(first, 0), *on_output(first, 1, driven_turn(first.teeth, level, phi))]
    (second,), (near, far) = more, design.center_distance
    idler = close_dyad(0j, complex(bar.frame), near, far, design.spec.gears.idler_side)
    middle = driven_turn(first.teeth, level + cmath.phase(idler), phi)
    turn = driven_turn((second.teeth[0], second.teeth[1]), level + cmath.phase(bar.frame - idler), middle)
    idler_turns, place = -period * first.teeth[0] / first.teeth[1], track(idler, fraction)
    between = gear(first, 1, place, middle, idler_turns, PURPLE, "idler", "idler")
    return [*on_input(first, 0), *on_output(second, 1, turn), *between]


def _input_angles(design: GearedFiveBar, fraction: Reals) -> Reals:
    """Input angles of a function: straight through where its range closes in itself, else there and back."""
    start, end = design.input_range
    turns = (end - start) / TURN
    wound = turns * float(design.ratio)
    if max(abs(turns - round(turns)), abs(wound - round(wound))) < 1e-9:
        return start + (end - start) * fraction
    return np.asarray(start + (end - start) * 0.5 * (1.0 - np.cos(TURN * fraction)))


def _function_scene(design: GearedFiveBar, fraction: Reals) -> Scene:
    phi = _input_angles(design, fraction)
    links = design.moving.at(phi, 0).links
    a, b, c, d, e = (links[link].at(pin).value for link, pin in _PINS)
    whole = np.linspace(*design.input_range, 361)
    output = np.array(design.function_bar.output_angles(whole.tolist()))
    # The curve tells the turn, the mechanism the angle itself.
    raw = np.angle(d - e)
    now = raw + TURN * np.round((np.interp(phi, whole, output) - raw) / TURN)
    return Scene(
        parts=(*_function_gears(design, phi, a, b), Chain(joints=(a, b, c, d, e))),
        marks=letters("AE", A=a, B=b, C=c, D=d, E=e),
        chart=Chart(
            "input angle [deg]",
            "output angle [deg]",
            np.degrees(whole),
            np.degrees(phi),
            (Curve("output", BLUE, np.degrees(output), np.degrees(now)),),
        ),
        readouts=(Readout("input", "°", np.degrees(phi)), Readout("output", "°", np.degrees(now))),
    )


def _function_gears(design: GearedFiveBar, phi: Reals, a: Points, b: Points) -> list[Part]:
    """The gear that is fixed to the frame, and the planet that rolls on it, or in it."""
    (mesh,) = design.meshes.values()
    planet, fixed = (abs(z) for z in mesh.teeth)
    still, internal = np.zeros_like(phi), mesh.internal
    turn = ring_turn((fixed, planet), phi, still) if internal else driven_turn((fixed, planet), phi, still)
    there_and_back = float(abs(_input_angles(design, np.ones(1))[0] - _input_angles(design, np.zeros(1))[0]))
    turns = there_and_back / TURN * float(design.ratio)
    return [
        *gear(
            mesh,
            1,
            a,
            still,
            0.0,
            ORANGE,
            "" if internal else "5",
            "ring gear, fixed" if internal else "sun, fixed",
            design.outer_rim(design.mesh_names[0]),
        ),
        *gear(mesh, 0, b, turn, turns, BLUE, "2", "planet on the coupler"),
    ]
