"""What the searches of many disc cams of one motion find, sought for all of them at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from gearlink.core.base.many_designs import column, hand_out, together
from gearlink.core.machines.disc_cam.cams import Place

if TYPE_CHECKING:
    from gearlink.core.machines.disc_cam.design import DiscCamDesign
    from gearlink.core.machines.disc_cam.spec import DiscCamSpec

_ALIKE = ("motion", "initial_lift", "speed", "loads", "direction", "pivot_direction", "side", "sense", "type", "angle")
_MAKING = ("lift_error_worst", "lift_error_rss", "acceleration_error")


def found_together(designs: Sequence[DiscCamDesign], names: Sequence[str]) -> None:
    """Let designs keep what their checks and some of their quantities need.

    Parameters
        designs : of files that differ by numbers of cam and follower
        names : quantities that will be asked for
    Raises
        Unlike - for files that differ otherwise
        NoSolution - where one of them does not exist
    """
    spec = together([design.spec for design in designs], _ALIKE)
    _shared_motion(designs, names)
    _found(designs, spec, names)


def _shared_motion(designs: Sequence[DiscCamDesign], names: Sequence[str]) -> None:
    """The motion of the first, and what is of it alone."""
    first = designs[0]
    for design in designs:
        vars(design.cams)["motion"] = first.cams.motion
    hand_out(first.cams, [design.cams for design in designs], "lifts")
    for design in designs:
        vars(design)["motion_extremes"] = first.motion_extremes
    if "servo_error" in names:
        hand_out(first.making, [design.making for design in designs], "servo_rows", "servo_error")


def _found(designs: Sequence[DiscCamDesign], spec: DiscCamSpec, names: Sequence[str]) -> None:
    first = designs[0]
    many = type(first)(spec)
    hand_out(first.cams, [many.cams], "lifts")
    vars(many.cams)["motion"] = first.cams.motion
    vars(many.cams)["place"] = Place(*map(column, zip(*(design.cams.place for design in designs), strict=True)))
    wanted = {"max_pressure_angle", "max_radius", "min_radius"}.intersection(names)
    if spec.cam.shaft_radius:
        wanted.add("min_radius")
    if spec.is_flat:
        _give(many, designs, "cams.flat", "min_curvature_radius", "contact_places", *wanted)
    else:
        wanted |= {"most_convex", "star_shaped"}
        if "min_concave_radius" in names or spec.closure == "groove" or spec.cam.cutter_radius is not None:
            wanted.add("most_hollow")
        for name in ("main",) if spec.return_roller is None else ("main", "back"):
            _give(many, designs, f"cams.{name}", *wanted)
        if spec.closure == "groove":
            _give(many, designs, "cams.outer_wall", *wanted.intersection(("max_radius", "min_radius")))
    _give(many, designs, "cams", "steepest_rise", "steepest_return", "steepest_dwell")
    _forces(many, designs)
    _give(many, designs, "making", *(name for name in _MAKING if name in names))


def _forces(many: DiscCamDesign, designs: Sequence[DiscCamDesign]) -> None:
    """Preload and lift-off of a spring."""
    spring = many.spec.spring
    if spring is None:
        return
    closings = [design.closing for design in designs]
    vars(many.closing)["inertia"] = column([one.inertia for one in closings])
    if spring.preload is None:
        _give(many, designs, "closing", "lacking")
    vars(many.closing)["preload"] = column([one.preload for one in closings])
    if closings[0].inertia:
        _give(many, designs, "closing", "loosest")
        if all(one.loosest.value < 0.0 for one in closings):
            _give(many, designs, "closing", "lightest")


def _give(many: DiscCamDesign, designs: Sequence[DiscCamDesign], place: str, *names: str) -> None:
    def at(design: Any) -> Any:
        for name in place.split("."):
            design = getattr(design, name)
        return design

    hand_out(at(many), [at(design) for design in designs], *names)
