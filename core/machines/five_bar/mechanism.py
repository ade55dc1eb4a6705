"""The mechanism of a geared five-bar: input, coupler, follower, output, the gears between them.

In the path form gears tie input and output, and a point of the coupler draws a path; in the function form a gear on the
coupler rolls about one that is fixed to the frame.
"""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.machines.five_bar.path import coupler_angles
from gearlink.core.mechanism.closures import dyad
from gearlink.core.mechanism.courses import between, coordinate, turned
from gearlink.core.mechanism.joints import Connection, Mesh, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Course, Input, Motion, Output
from gearlink.core.mechanism.rates import Turn, fixed, steady
from gearlink.core.mechanism.vectors import least_transmission

if TYPE_CHECKING:
    from gearlink.core.machines.five_bar.design import GearedFiveBar
    from gearlink.core.machines.five_bar.function_motion import FunctionFiveBar
    from gearlink.core.machines.five_bar.path_motion import PathFiveBar
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.studies.movable import Movable, Turned


_DEGREE = math.radians(1.0)
_LINKS = ("input", "coupler", "follower", "output")


def errors(design: GearedFiveBar, mechanism: Mechanism) -> Movable:
    """Links, phase, the coupler point of a path, and the runout of the gears; an output that turns at its pin."""
    from gearlink.core.mechanism.dual import Shift, longer
    from gearlink.core.studies.movable import Movable

    bar = design.path_bar if design.is_path else design.function_bar
    ends = {f"links.{name}": (name, getattr(bar, name)) for name in _LINKS}
    sizes = longer(mechanism, ends | {"links.frame": (FRAME, bar.frame)})
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
    from gearlink.core.studies.movable import Turned

    gears = design.spec.gears
    links = {"input": "input", "idler": "idler", "output": "output", "planet": "coupler", "sun": FRAME, "ring": FRAME}
    return {name: Turned.of(link, gears, z) for name, link in links.items() if (z := getattr(gears, name)) is not None}


def motion(design: GearedFiveBar) -> Motion:
    """Links and joints over the input angle, A at 0 and E on +x: a path over its period, a function over its range.

    The output of a path is the coupler point M.

    Raises
        NoSolution - where the five-bar opens
    """
    if not design.is_path:
        return function_motion(design, design.function_bar, *design.input_range)
    bar = design.path_bar
    bar.closure()

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        return _path(design, bar, phi, order)

    outputs = tuple(Output(f"Point M, {name}", coordinate("coupler", "M", along)) for name, along in _AXES)
    given = Input(end=bar.period, turns=bar.period_turns)
    return Motion(make, given, outputs, transmission=between("coupler", "follower"))


_AXES = (("x", 1.0 + 0j), ("y", 1j))


def function_motion(design: GearedFiveBar, bar: FunctionFiveBar, start: float, end: float) -> Motion:
    """The function form over a range of the input [rad].

    Raises
        NoSolution - where the five-bar opens, when links there are asked for
    """

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        return _function(design, bar, phi, order)

    outputs = (Output("Output link ED", turned("output")),)
    return Motion(make, Input(start=start, end=end, turns=None), outputs, transmission=least_transmission("D"))


def _rolling(design: GearedFiveBar, name: str = "") -> tuple[float, float, float]:
    """Working radii of a mesh [mm], the first gear of the file's lists first, and tan of the pressure angle."""
    pair = design.meshes[name]
    one, other = (abs(radius) for radius in pair.working_radius)
    if design.signed_teeth[0] < 0:
        one, other = other, one
    return one, other, math.tan(pair.working_pressure_angle)


def _path(design: GearedFiveBar, bar: PathFiveBar, phi: Reals, order: int) -> Mechanism:
    first = Link(fixed(0j, phi, order=order), steady(phi, order=order), {"A": 0.0, "B": bar.input})
    last = Link(
        fixed(bar.frame, phi, order=order),
        steady(phi, float(bar.ratio), bar.phase, order=order),
        {"E": 0.0, "D": bar.output},
    )
    b, d = first.at(bar.input), last.at(bar.output)
    t2, t3 = dyad(b, d, bar.coupler, bar.follower, bar.assembly)
    links = {
        "input": first,
        "coupler": Link(b, Turn(coupler_angles(bar, phi), *t2[1:]), {"B": 0.0, "C": bar.coupler, "M": design.offset}),
        "follower": Link(d, t3, {"D": 0.0, "C": bar.follower}),
        "output": last,
    }
    pins: list[Connection] = [
        Pin("A", FRAME, "input", first.origin.value),
        Pin("B", "input", "coupler", b.value),
        Pin("C", "coupler", "follower", links["coupler"].at(bar.coupler).value),
        Pin("D", "output", "follower", d.value),
        Pin("E", FRAME, "output", last.origin.value),
    ]
    return Mechanism(links, pins + _path_gears(design, links, phi, order), "input")


def _path_gears(design: GearedFiveBar, links: dict[str, Link], phi: Reals, order: int) -> list[Connection]:
    """The mesh of input and output, or those with the idler between them, which joins the links."""
    gears = design.spec.gears
    a, e = links["input"].origin.value, links["output"].origin.value
    if gears.idler is None:
        r1, r4, tangent = _rolling(design)
        if gears.mesh == "internal" and r4 > r1:
            return [Mesh("mesh_14", "output", "input", e, -1.0 + 0j, r4, r1, tangent, True)]
        return [Mesh("mesh_14", "input", "output", a, 1.0 + 0j, r1, r4, tangent, gears.mesh == "internal")]
    (r1, ri, tangent), (ri_out, r4, tangent_out) = (_rolling(design, name) for name in design.mesh_names)
    frame = design.path_bar.frame
    near, far = r1 + ri, ri_out + r4
    along = 0.5 * (frame + (near - far) * (near + far) / frame)
    axis = cmath.rect(near, design.spec.gears.idler_side * math.acos(along / near))
    center = fixed(axis, phi, order=order)
    links["idler"] = Link(center, steady(phi, -r1 / ri, order=order))
    return [
        Pin("O", FRAME, "idler", center.value),
        Mesh("mesh_1i", "input", "idler", a, axis / near, r1, ri, tangent),
        Mesh("mesh_i4", "idler", "output", center.value, (frame - axis) / far, ri_out, r4, tangent_out),
    ]


def _function(design: GearedFiveBar, bar: FunctionFiveBar, phi: Reals, order: int) -> Mechanism:
    gears = design.spec.gears
    first = Link(fixed(0j, phi, order=order), steady(phi, order=order), {"A": 0.0, "B": bar.input})
    coupler = Link(
        first.at(bar.input), steady(phi, bar.coupler_ratio, bar.phase, order=order), {"B": 0.0, "C": bar.coupler}
    )
    c, pivot = coupler.at(bar.coupler), fixed(bar.frame, phi, order=order)
    t3, t4 = dyad(c, pivot, bar.follower, bar.output, bar.assembly)
    links = {
        "input": first,
        "coupler": coupler,
        "follower": Link(c, t3, {"C": 0.0, "D": bar.follower}),
        "output": Link(pivot, t4, {"E": 0.0, "D": bar.output}),
    }
    r2, r5, tangent = _rolling(design)
    joints: list[Connection] = [
        Pin("A", FRAME, "input", first.origin.value),
        Pin("B", "input", "coupler", coupler.origin.value),
        Pin("C", "coupler", "follower", c.value),
        Pin("D", "follower", "output", links["output"].at(bar.output).value),
        Pin("E", FRAME, "output", pivot.value),
        Mesh("mesh_25", FRAME, "coupler", first.origin.value, first.unit, r5, r2, tangent,
             gears.ring is not None, "input"),
    ]  # fmt: skip
    return Mechanism(links, joints, "input")
