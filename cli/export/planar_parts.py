"""What a planar mechanism exports: the paths of its output points, the gears of its meshes, and its cams."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.export.contour import Part
from gearlink.cli.export.parts import disc_cam, flat_cam, of_mesh
from gearlink.cli.export.sampling import Points, Reals, Stretch
from gearlink.core.base.errors import MissingSection
from gearlink.core.machines.planar.outputs import moved
from gearlink.core.machines.planar.structure import RackJoint

if TYPE_CHECKING:
    from gearlink.cli.export.parts import Makers

_RATES = ("velocity", "acceleration")


def makers(design: Any) -> Makers:
    """Makers of the paths by `PATH-POINT`, of the gears, with standard teeth, by mesh and link, and of the cams."""
    structure = design.structure
    points = [name for name in design.spec.shown if len(moved(structure, name)) == 2]
    found: Makers = {**{f"PATH-{name}": partial(_path, design, name) for name in points}, **_gears(design)}
    found |= {name: partial(_cam, name, cam) for name, cam in structure.cams.items()}
    if not found:
        raise MissingSection("no path to export", key="outputs", fix="name a point of a link in outputs")
    return found


def _cam(name: str, cam: Any) -> Part:
    return flat_cam(name, cam.profile) if cam.given.face is not None else disc_cam(name, cam.profile)


def _path(design: Any, name: str) -> Part:
    """The path of a point over the period or range, its rates beside it."""
    course, per = design.course, "rad" if design.moving.input.unit == "rad" else "mm"
    parts = moved(design.structure, name)

    def rates(q: Reals, order: int) -> list[list[Reals]]:
        jets = course.jets(q, order)
        return [course.derivatives(part.coefficient, jets, order) for part in parts]

    def points(q: Reals) -> Points:
        (x,), (y,) = rates(q, 0)
        return np.asarray([x + 1j * y])

    def extra(q: Reals) -> Reals:
        x, y = rates(q, 2)
        shown = np.degrees(q) if per == "rad" else q
        return np.asarray([shown, x[1], y[1], x[2], y[2]])

    units = (f"mm/{per}", f"mm/{per}^2") if per == "rad" else ("1", "1/mm")
    columns = [f"{axis}_{rate}_ratio [{unit}]" for rate, unit in zip(_RATES, units, strict=True) for axis in "xy"]
    first = "input_angle [deg]" if per == "rad" else "input_position [mm]"
    steps = max(8, course.samples // 10)
    return Part(
        name=f"PATH-{name}",
        title=f"path of {name}",
        stretches=(Stretch(("PATH",), points, course.start, course.end, extra=extra, steps=steps),),
        closed=course.turns is not None,
        notes=("frame: that of the design", "rates are per input"),
        extra_columns=(first, *columns),
    )


def _gears(design: Any) -> Makers:
    found: Makers = {}
    for name, mesh in design.structure.meshes.items():
        alpha, names = math.radians(design.spec.meshes[name].pressure_angle), design.structure.names
        if isinstance(mesh, RackJoint):
            teeth, links = (round(2.0 * mesh.radius / mesh.module),) * 2, (names[mesh.line.other], "")
        else:
            teeth, links = mesh.teeth, (names[mesh.first], names[mesh.second])
            if teeth[0] < 0:
                teeth, links = teeth[::-1], links[::-1]
        from gearlink.core.parts.gears.mesh.pair import GearPair

        made = of_mesh(
            GearPair.from_shift(mesh.module, teeth, pressure_angle=alpha),
            (f"{name}_{links[0]}", f"{name}_{links[1]}"),
            (f"gear of {links[0]}", f"gear of {links[1]}"),
            f"meshes.{name}",
        )
        found |= {part: maker for part, maker in made.items() if not part.endswith("_")}
    return found
