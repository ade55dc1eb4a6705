"""Sheets of disc cams for the workshop: pressure angle round the cam, and a drawing with its table of radii."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import panels, style
from gearlink.core.base.kind import load
from gearlink.core.base.kinds import KINDS
from gearlink.core.parts.cams.disc_cam import DiscCam

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.numerics.arrays import Points, Reals
    from gearlink.core.parts.cams.flat_cam import FlatCam

_TURN = 2.0 * math.pi
# DIN 6885-1: bore above, width of the keyway, depth in the hub [mm].
_KEYWAYS = (
    (6, 2, 1.0), (8, 3, 1.4), (10, 4, 1.8), (12, 5, 2.3), (17, 6, 2.8), (22, 8, 3.3), (30, 10, 3.3), (38, 12, 3.3),
    (44, 14, 3.8), (50, 16, 4.3), (58, 18, 4.4), (65, 20, 4.9), (75, 22, 5.4), (85, 25, 5.4), (95, 28, 6.4),
    (110, 32, 7.4),
)  # fmt: skip
_LARGEST_BORE = 130


def discs(design: Any) -> tuple[DiscCam, ...]:
    """The closed disc cams of a design, none where its file has no cams."""
    place = KINDS[design.kind].sheets.get("drawing")
    return load(place)(design) if place else ()


def press_discs(design: Any) -> tuple[DiscCam, ...]:
    """The main and the return cam of a press."""
    return () if design.spec.cam is None else (design.main_cam, design.return_cam)


def gripper_discs(design: Any) -> tuple[DiscCam, ...]:
    """The cams of a gripper, and that of its fingers in the frame of the arm."""
    return () if design.spec.cam is None else tuple(design.discs)


def linked_discs(design: Any) -> tuple[DiscCam, ...]:
    """The cams of both coordinates of a path."""
    return tuple(design.cams)


def planar_discs(design: Any) -> tuple[Any, ...]:
    """The cams of a planar mechanism, in the order of its file."""
    cams = design.structure.cams.values()
    return tuple(cam.profile if cam.given.face is None else UnderFace(cam.profile) for cam in cams)


class UnderFace:
    """A cam under a flat face, as the drawings read a cam: its pitch curve is the profile, of a roller of radius 0."""

    roller_radius = 0.0

    def __init__(self, cam: FlatCam) -> None:
        self.cam, self.name, self.sense = cam, cam.name, cam.sense
        self.min_radius, self.max_radius = cam.min_radius, cam.max_radius
        self.min_curvature_radius = cam.min_curvature_radius

    def points(self, cam_angle: Reals) -> tuple[Points, Points]:
        """Points of the profile [mm], twice."""
        found = self.cam.points(cam_angle)[0]
        return found, found

    def face(self) -> Points:
        """Ends of the stretch of the face at cam angle 0 that is drawn [mm]."""
        point, normal = (complex(part[0]) for part in self.cam.points(np.zeros(1)))
        return point + 0.5j * self.max_radius * normal * np.array([-1.0, 1.0])


def touching(cam: Any) -> str:
    """What of the follower a cam touches: roller, face or edge."""
    return "roller" if cam.roller_radius else "face" if isinstance(cam, UnderFace) else "edge"


_EDGE_LENGTH, _EDGE_HALF = 0.2, 0.3
"""Of the radius at its tip the length of a knife edge as it is drawn, and of that half its width."""


def edge_outline(cam: DiscCam) -> Points:
    """Outline of a knife edge [mm], its tip at 0 and the follower towards +x."""
    length = _EDGE_LENGTH * float(cam.radius(np.zeros(1))[0])
    return np.asarray(length * np.array([0j, complex(1.0, _EDGE_HALF), complex(1.0, -_EDGE_HALF), 0j]))


def away(cam: DiscCam, cam_angle: Reals) -> Points:
    """Unit vectors along the follower's motion, off the cam, in the frame of the machine."""
    along, normal = cam.path(cam_angle, 1).direction, cam.normals(cam_angle)
    return np.asarray(along * np.sign((np.conj(along) * normal).real))


def drawn_discs(design: Any) -> tuple[Any, ...]:
    """The cams that the workshop makes for a follower."""
    return (UnderFace(design.cams.flat),) if design.spec.is_flat else follower_discs(design)


def follower_discs(design: Any) -> tuple[DiscCam, ...]:
    """The cams of a roller or an edge, one or two; none under a flat face."""
    return () if design.spec.is_flat else tuple(design.profiles)


def outer_wall(design: Any) -> Any:
    """The outer wall of a groove; None of a cam that is open."""
    return design.cams.outer_wall if getattr(design.spec, "closure", "") == "groove" else None


def pressure_limit(design: Any) -> float:
    """Maximum pressure angle that the file allows [deg]; of strokes with limits of their own the greater."""
    of_strokes = getattr(design.spec, "pressure_limits", None)
    return float(design.spec.limits.pressure_angle if of_strokes is None else max(of_strokes()))


def pressure(design: Any) -> Figure:
    """The pressure angle as a radius in the direction of its contact on the cam, and as the width of the profile."""
    made = panels.page(f"{design.spec.name}: pressure angle", 0.5)
    grid: Any = made.add_gridspec(1, 2, width_ratios=(1.15, 1.0))
    polar: Any = made.add_subplot(grid[0], projection="polar")
    _polar(polar, design)
    _outlines(made.add_subplot(grid[1]), design)
    return made


def _polar(axes: Any, design: Any) -> None:
    theta = np.linspace(0.0, _TURN, 1441)
    for cam, color, line in zip(discs(design), panels.CAM_COLORS, panels.CAM_LINES, strict=False):
        worst = cam.max_pressure_angle
        angle, way = np.degrees(np.abs(cam.pressure_angle(theta))), np.unwrap(np.angle(cam.points(theta)[0]))
        there = float(np.interp(worst.place, theta, way))
        label = f"{cam.name}, ≤ {math.degrees(worst.value):.4g}° at cam angle {math.degrees(worst.place):.4g}°"
        axes.plot(way, angle, color=color, linestyle=line, linewidth=1.5, label=label, gid=f"pressure-{cam.name}")
        axes.plot([there], [math.degrees(worst.value)], "o", color=color, markersize=4.5)
    limit = pressure_limit(design)
    axes.plot(theta, np.full_like(theta, limit), color=style.BLACK, linestyle=style.DASHED, label=f"limit {limit:g}°")
    axes.set_ylim(0.0)
    axes.set_theta_zero_location("E")
    axes.tick_params(labelsize=8)
    axes.set_rlabel_position(22.5)
    axes.grid(color=style.LIGHT, linewidth=0.6)
    title = "|pressure angle| [deg] on the cam, from its start mark"
    axes.set_title(title, loc="left", fontsize=9, fontweight="bold", pad=18)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.08), frameon=False, fontsize=8)


def _outlines(axes: Axes, design: Any) -> None:
    """The profiles; the line is as thick as the pressure angle is large, and red above the limit."""
    from matplotlib.collections import LineCollection
    from matplotlib.lines import Line2D

    panels.drawing(axes, "Profiles, line width by pressure angle")
    theta, limit = np.linspace(0.0, _TURN, 721), pressure_limit(design)
    for cam, color in zip(discs(design), panels.CAM_COLORS, strict=False):
        _, profile = cam.points(theta)
        angle = np.degrees(np.abs(cam.pressure_angle(0.5 * (theta[1:] + theta[:-1]))))
        ends = np.stack([np.column_stack([z.real, z.imag]) for z in (profile[:-1], profile[1:])], axis=1)
        colors = [style.WRONG if a > limit else color for a in angle.tolist()]
        worst = cam.max_pressure_angle
        at = complex(cam.points(np.array([worst.place]))[1][0])
        axes.plot([at.real], [at.imag], "o", color=color, markersize=4.5, zorder=4)
        axes.add_collection(LineCollection(list(ends), linewidths=_width(angle / limit), colors=colors))
        axes.plot(profile.real, profile.imag, color=color, linewidth=0.4, label=f"{cam.name}")
    axes.plot([0.0], [0.0], "+", color=style.BLACK, markersize=10)
    for share in (0.0, 0.5, 1.0):
        axes.add_line(Line2D([], [], color=style.GREY, linewidth=_width(share), label=f"{share * limit:g}°"))
    panels.legend_below(axes, 3)


def _width(share: Any) -> Any:
    """Width of a profile's line [pt] by the pressure angle as a share of its limit."""
    return 0.5 + 5.0 * share


def keyway(bore: float) -> tuple[float, float] | None:
    """Width and depth in the hub of the keyway of a bore [mm]; None outside the standard.

    Example
        >>> keyway(40.0), keyway(5.0)
        ((12, 3.3), None)

    Source
        DIN 6885-1
    """
    found = [(width, depth) for above, width, depth in _KEYWAYS if bore > above]
    return found[-1] if found and bore <= _LARGEST_BORE else None


def bore_words(diameter: float) -> str:
    """Diameter and fit of a bore, and its keyway on a line below where the standard has one."""
    slot = keyway(diameter)
    return f"⌀{diameter:g} H7" + (f"\nkeyway {slot[0]:g} P9, {diameter + slot[1]:g} over bore" if slot else "")


def bore(radius: float, way: complex) -> Any:
    """Outline of the bore with its keyway, where the standard has one, in the direction of the start mark."""
    slot = keyway(2.0 * radius)
    if slot is None:
        return radius * np.exp(1j * np.linspace(0.0, _TURN, 181))
    half, depth = 0.5 * slot[0], slot[1]
    corner = math.asin(half / radius)
    circle = radius * np.exp(1j * np.linspace(corner, _TURN - corner, 181))
    floor = radius + depth
    points = np.concatenate([[complex(floor, half)], circle, [complex(floor, -half), complex(floor, half)]])
    return points * way


def pitch_radii(cam: DiscCam) -> Any:
    """Radius of the pitch curve or flat-faced profile [mm] at each degree on the cam from the mark, counter-clockwise.

    Notes
        Interpolated between 72,000 points of the curve, 2e-7 mm off at a bend of 1/mm.
    """
    pitch, _ = cam.points(np.linspace(0.0, _TURN, 72001))
    angle = np.unwrap(np.angle(pitch / pitch[0]))
    if angle[-1] < 0.0:
        angle, pitch = angle[::-1], pitch[::-1]
    turned = np.mod(np.radians(np.arange(360.0)) - angle[0], _TURN) + angle[0]
    return np.interp(turned, angle, np.abs(pitch))
