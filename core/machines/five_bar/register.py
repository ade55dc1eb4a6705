"""What the errors of a geared five-bar move."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.mechanism.dual import Shift, longer
from gearlink.core.mechanism.links import FRAME
from gearlink.core.mechanism.motion import Course
from gearlink.core.studies.register.movable import Movable, Turned
from gearlink.core.studies.tolerance.sources import GearOfSource

if TYPE_CHECKING:
    from gearlink.core.machines.five_bar.design import GearedFiveBar
    from gearlink.core.mechanism.links import Mechanism

_DEGREE = math.radians(1.0)
_LINKS = ("input", "coupler", "follower", "output")


def errors(design: GearedFiveBar, mechanism: Mechanism) -> Movable:
    """Links, phase, the coupler point of a path, and the runout of the gears; an output that turns at its pin."""
    bar = design.path_bar if design.is_path else design.function_bar
    sizes = longer(
        mechanism,
        {f"links.{name}": (name, getattr(bar, name)) for name in _LINKS} | {"links.frame": (FRAME, bar.frame)},
    )
    phased = "output" if design.is_path else "coupler"  # turned against its gear
    sizes["phase"] = (Shift(phased, ("D",) if design.is_path else ("C",), _DEGREE, turned=True),)
    gears = _gears(design)
    carried = "frame" if design.is_path else "input"  # the centre distance of the gears, where they leave it to them
    sizes["centers.gears"] = sizes[f"links.{carried}"]
    centers = {"gears": getattr(bar, carried)} if getattr(design.spec.links, carried) is None else {}
    if not design.is_path:
        return Movable(sizes, centers, gears=gears, radius=bar.output)
    section = design.spec.register_
    line = cmath.exp(-1j * math.radians((section.direction if section is not None else None) or 0.0))
    own = {"coupler_point.along": _across(line), "coupler_point.across": _across(1j * line)}
    return Movable(sizes, centers, gears=gears, own=own)


def _across(way: complex) -> Course:
    """How far the point M goes along the direction of the output where it stands off on the coupler."""
    return Course("1", lambda mechanism: [np.asarray((mechanism.links["coupler"].unit * way).real)])


def _gears(design: GearedFiveBar) -> dict[str, Turned]:
    gears, alpha = design.spec.gears, math.radians(design.spec.gears.pressure_angle)
    links = {"input": "input", "idler": "idler", "output": "output", "planet": "coupler", "sun": FRAME, "ring": FRAME}
    return {
        name: Turned(link, GearOfSource(gears.module, gears.module * teeth, alpha))
        for name, link in links.items()
        if (teeth := getattr(gears, name)) is not None
    }
