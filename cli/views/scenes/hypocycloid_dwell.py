"""The dwell on an arc of a hypocycloid: one revolution of the carrier."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes import of_motion
from gearlink.cli.views.scenes.colors import BLACK, BLUE, DWELL, GREEN, ORANGE, PURPLE
from gearlink.cli.views.scenes.gears import gear
from gearlink.cli.views.scenes.scene import (
    TURN,
    Chain,
    Chart,
    Curve,
    Line,
    Readout,
    Reals,
    Scene,
    bands,
    block,
    letters,
    loop,
    standing,
)
from gearlink.core.parts.gears.outline.mesh_geometry import ring_turn

if TYPE_CHECKING:
    from gearlink.core.machines.dwell_gears.hypocycloid_design import HypocycloidDwell


def _arm(design: HypocycloidDwell, fraction: Reals) -> Scene:
    """With an arm: positions over the turns of the carrier that bring the planet home."""
    scene = of_motion.build(design, fraction)
    whole = of_motion.inputs(design.moving.input, fraction)
    links = design.moving.at(whole, 0).links
    a, b, m = (links[link].at(name).value for link, name in (("carrier", "A"), ("planet", "B"), ("planet", "M")))
    path = design.moving.at(of_motion.inputs(design.moving.input, loop(721)), 0).links["planet"].at("M").value
    planet, ring = design.planet_teeth, design.ring_teeth
    turn = ring_turn((ring, planet), whole, np.zeros_like(whole))
    reach = float(np.abs(path).max()) * 1.1
    far = reach * np.exp(1j * links["arm"].turn.value)
    return replace(
        scene,
        parts=(
            *gear(design.mesh, 1, a, np.zeros_like(whole), 0.0, ORANGE, "", "ring gear, fixed", design.rim_of("")),
            *gear(design.mesh, 0, b, turn, 1.0 - ring / planet, BLUE, "2", "planet"),
            standing(path, fraction, GREEN, "path of the point M"),
            Chain(joints=(a, far), color=PURPLE, width=5.0, marked=False),
            Chain(joints=(a, b, m), color=BLUE),
        ),
        marks=letters("A", A=a, B=b, M=m),
    )


def build(design: HypocycloidDwell, fraction: Reals) -> Scene:
    """Positions over fractions of the loop, from mid-dwell on."""
    if design.spec.is_arm:
        return _arm(design, fraction)
    t = TURN * fraction
    now, whole = (design.moving.at(angles, 0).links for angles in (t, TURN * loop(361)))
    a, b, m, f = (
        now[link].at(name).value for link, name in (("carrier", "A"), ("carrier", "B"), ("rod", "M"), ("rod", "F"))
    )
    rest = design.slider.point(0.0).real + design.slider.rod
    inwards, course = rest - now["slider"].origin.value.real, rest - whole["slider"].origin.value.real
    planet, ring = design.planet_teeth, design.ring_teeth
    turn = ring_turn((ring, planet), t, np.zeros_like(t))
    size = 0.5 * design.point_radius
    half = np.degrees(0.5 * design.dwell_carrier_angle)
    way = rest - np.array([course.min() - size, course.max() + size]) + 0j
    return Scene(
        parts=(
            *gear(design.mesh, 1, a, np.zeros_like(t), 0.0, ORANGE, "", "ring gear, fixed", design.rim_of("")),
            *gear(design.mesh, 0, b, turn, 1.0 - ring / planet, BLUE, "2", "planet"),
            standing(whole["planet"].at("M").value, fraction, GREEN, "path of the point M"),
            *(Line(points=way + side * 0.5j * size, width=1.5) for side in (-1.0, 1.0)),
            block(f, 1.6 * size, size, BLACK),
            Chain(joints=(a, b, m), color=BLUE),
            Chain(joints=(m, f)),
        ),
        marks=letters("A", A=a, B=b, M=m, F=f),
        chart=Chart(
            "carrier angle [deg]",
            "slider, inwards from mid-dwell [mm]",
            360.0 * loop(361),
            np.degrees(t),
            (Curve("slider", BLUE, course, inwards),),
            bands([("required dwell", -half, half, DWELL)]),
        ),
        readouts=(Readout("carrier", "°", np.degrees(t)), Readout("slider", " mm", inwards)),
    )
