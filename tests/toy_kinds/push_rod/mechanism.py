"""The mechanism of a push rod."""

from __future__ import annotations

from typing import Any

from gearlink.core.mechanism.closures import slider
from gearlink.core.mechanism.courses import coordinate
from gearlink.core.mechanism.dual import longer
from gearlink.core.mechanism.joints import Connection, Guide, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Input, Motion, Output
from gearlink.core.mechanism.rates import fixed, standing, steady
from gearlink.core.studies.movable import Movable

SLIDER = coordinate("slider")


def motion(design: Any) -> Motion:
    """Links and joints over the crank angle."""
    spec = design.spec

    def make(phi: Any, order: int, _side: int) -> Mechanism:
        crank = Link(fixed(0j, phi, order=order), steady(phi, order=order), {"A": 0.0, "B": spec.crank})
        turn, end = slider(crank.at("B"), spec.rod, 1j * spec.offset, 1.0 + 0j)
        links = {
            "crank": crank,
            "rod": Link(crank.at("B"), turn, {"B": 0.0, "C": spec.rod}),
            "slider": Link(end, standing(0.0, phi, order=order)),
        }
        joints: list[Connection] = [
            Pin("A", FRAME, "crank", crank.origin.value),
            Pin("B", "crank", "rod", crank.at("B").value),
            Pin("C", "rod", "slider", end.value),
            Guide("guide", FRAME, "slider", end.value, 1.0 + 0j),
        ]
        return Mechanism(links, joints, "crank", travel={"slider": 1.0 + 0j})

    return Motion(make, Input("crank_angle"), (Output("Slider", SLIDER),))


def errors(design: Any, mechanism: Mechanism) -> Movable:
    """What an error of its sizes moves."""
    spec = design.spec
    return Movable(longer(mechanism, {"crank": ("crank", spec.crank), "rod": ("rod", spec.rod)}))
