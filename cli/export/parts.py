"""The parts of a design that have a profile: which there are, and the curves of each, made when one is asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from gearlink.core.errors import MissingSection, at_key

if TYPE_CHECKING:
    from gearlink.cli.export.contour import Part
    from gearlink.core.gears.pair import GearPair

_NO_RING = "the ring gear is not exported: its roots depend on its cutter"
Makers = dict[str, Callable[[], "Part"]]


def makers(design: Any) -> Makers:
    """Makers of every part that the design has, by the name that --part takes.

    Raises
        MissingSection - where the design file lacks the sections that a profile needs
    """
    made: Makers = _KINDS[design.kind](design)
    if not made:
        raise MissingSection(f"no profile to export: {_NEEDED[design.kind]}", key="")
    return made


def kinds() -> tuple[str, ...]:
    """The kinds of design that have profiles."""
    return tuple(_KINDS)


def _press(design: Any) -> Makers:
    found: Makers = {}
    if design.spec.cam is not None:
        from gearlink.cli.export.cam_parts import disc_cam

        found["main_cam"] = lambda: disc_cam("main_cam", design.main_cam)
        found["return_cam"] = lambda: disc_cam("return_cam", design.return_cam)
    if design.spec.input_gears is not None:
        found |= _pair(design, "input_gears")
    return found


def _gripper(design: Any) -> Makers:
    if design.spec.cam is None:
        return {}
    from gearlink.cli.export.cam_parts import disc_cam

    found: Makers = {"main_cam": lambda: disc_cam("main_cam", design.main_cam)}
    if design.spec.cam.return_roller is not None:
        found["return_cam"] = lambda: disc_cam("return_cam", design.return_cam)
    return found


def _wide_swing(design: Any) -> Makers:
    if design.spec.cam is None:
        return {}
    from gearlink.cli.export.cam_parts import closed_cam, swing_cam

    # A cam on the rocker of a crank-rocker serves both strokes.
    names = ("main_cam", "return_cam") if design.spec.drive is None else ("main_cam",)
    found: Makers = {name: partial(swing_cam, name, design) for name in names}
    if design.spec.cycle is not None:
        found |= {name: partial(closed_cam, name, design) for name in ("contour", "return_contour")}
    return found


def _pair(design: Any, key: str = "") -> Makers:
    def gear(number: int) -> Part:
        from gearlink.cli.export.gear_parts import gear_of

        with at_key(key):
            part = gear_of(design.gear_pair, number, f"gear{number + 1}", f"gear {number + 1}")
        if design.gear_pair.internal:
            part = replace(part, notes=(*part.notes, "the ring gear is not exported: its roots depend on its cutter"))
        return part

    numbers = (0,) if design.gear_pair.internal else (0, 1)
    return {f"gear{number + 1}": partial(gear, number) for number in numbers}


def _three_gears(design: Any) -> Makers:
    places = {
        "gear1": ("crank_idler", 0, "gear 1, on the crank"),
        "gear3": ("crank_idler", 1, "gear 3, the idler"),
        "gear5": ("idler_output", 1, "gear 5, the output"),
    }

    def gear(name: str) -> Part:
        from gearlink.cli.export.gear_parts import gear_of
        from gearlink.core.gears.pair import GearPair

        mesh, number, title = places[name]
        pair = design.meshes[mesh]
        with at_key("gears"):
            if isinstance(pair, GearPair):
                return gear_of(pair, number, name, title)
            part = gear_of(_planet(pair), 0, name, title)
        return replace(part, notes=(*part.notes, _NO_RING))

    # the idler by its internal mesh, where it has one, tells that the ring is left out
    if design.output_teeth < 0:
        places["gear3"] = ("idler_output", 0, places["gear3"][2])
    rings = {name for name, teeth in (("gear1", design.crank_teeth), ("gear5", design.output_teeth)) if teeth < 0}
    return {name: partial(gear, name) for name in places if name not in rings}


def _single_mesh(design: Any) -> Makers:
    """Gears 2 and 5; of a ring gear the roots depend on its cutter, which no design file names, so it is left out."""
    from gearlink.core.gears.pair import GearPair

    def gear(number: int, name: str, title: str) -> Part:
        from gearlink.cli.export.gear_parts import gear_of

        mesh = design.mesh
        with at_key("gears"):
            if isinstance(mesh, GearPair):
                return gear_of(mesh, number, name, title)
            part = gear_of(_planet(mesh), number, name, title)
        return replace(part, notes=(*part.notes, _NO_RING))

    found: Makers = {"gear2": partial(gear, 0, "gear2", "gear 2, on the coupler")}
    if isinstance(design.mesh, GearPair):
        found["gear5"] = partial(gear, 1, "gear5", "gear 5, the output")
    return found


def _planet(mesh: Any) -> GearPair:
    """The planet of an internal mesh without shift, as one of two equal external gears: its teeth are the same."""
    from gearlink.core.gears.pair import GearPair

    teeth = (mesh.teeth[0], mesh.teeth[0])
    profile = {"addendum": mesh.addendum, "clearance": mesh.clearance}
    return GearPair.from_shift(mesh.module, teeth, pressure_angle=mesh.pressure_angle, **profile)


_KINDS: dict[str, Callable[[Any], Makers]] = {
    "flatbed-press": _press,
    "swing-gripper": _gripper,
    "wide-swing-cam": _wide_swing,
    "gear-pair": _pair,
    "three-gear-four-bar": _three_gears,
    "two-gear-four-bar": _single_mesh,
    "geared-rocker": _single_mesh,
}
_NEEDED = {
    "flatbed-press": "the file has neither a section cam nor a section input_gears",
    "swing-gripper": "the file has no section cam: center, sense, roller",
    "wide-swing-cam": "the file has no section cam: center_distance, roller_radius",
}
