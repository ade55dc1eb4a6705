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

_TURN = 2.0 * math.pi
_COLUMNS = 6
# DIN 6885-1: bore above, width of the keyway, depth in the hub [mm].
_KEYWAYS = (
    (6, 2, 1.0), (8, 3, 1.4), (10, 4, 1.8), (12, 5, 2.3), (17, 6, 2.8), (22, 8, 3.3), (30, 10, 3.3), (38, 12, 3.3),
    (44, 14, 3.8), (50, 16, 4.3), (58, 18, 4.4), (65, 20, 4.9), (75, 22, 5.4), (85, 25, 5.4), (95, 28, 6.4),
    (110, 32, 7.4),
)  # fmt: skip
_LARGEST_BORE = 130


def discs(design: Any) -> tuple[DiscCam, ...]:
    """The closed disc cams of a design, none where it has no section cam."""
    place = KINDS[design.kind].sheets.get("drawing")
    return load(place)(design) if place and design.spec.cam is not None else ()


def press_discs(design: Any) -> tuple[DiscCam, ...]:
    """The main and the return cam of a press."""
    return design.main_cam, design.return_cam


def gripper_discs(design: Any) -> tuple[DiscCam, ...]:
    """The cams of a gripper, and that of its fingers in the frame of the arm."""
    return tuple(design.discs)


def follower_discs(design: Any) -> tuple[DiscCam, ...]:
    """The cams of a roller follower, one or two; none under a flat face."""
    return () if design.spec.is_flat else tuple(design.profiles)


def _limit(design: Any) -> float:
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
    limit = _limit(design)
    axes.plot(theta, np.full_like(theta, limit), color=style.BLACK, linestyle=style.DASHED, label=f"limit {limit:g}°")
    axes.set_ylim(0.0)
    axes.set_theta_zero_location("E")
    axes.tick_params(labelsize=8)
    axes.set_rlabel_position(22.5)
    axes.grid(color=style.LIGHT, linewidth=0.6)
    axes.set_title(
        "|pressure angle| [deg] on the cam, from its start mark", loc="left", fontsize=9, fontweight="bold", pad=18
    )
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.08), frameon=False, fontsize=8)


def _outlines(axes: Axes, design: Any) -> None:
    """The profiles; the line is as thick as the pressure angle is large, and red above the limit."""
    from matplotlib.collections import LineCollection
    from matplotlib.lines import Line2D

    panels.drawing(axes, "Profiles, line width by pressure angle")
    theta, limit = np.linspace(0.0, _TURN, 721), _limit(design)
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


def drawing(design: Any, index: int) -> Figure:
    """One cam for the workshop: outline with dimensions, start mark, bore and keyway, and a radius for each degree."""
    cam = discs(design)[index]
    made = panels.page(f"{design.spec.name}: {cam.name}, drawing")
    grid: Any = made.add_gridspec(2, 1, height_ratios=(1.0, 1.35))
    above: Any = grid[0].subgridspec(1, 2, width_ratios=(1.6, 1.0))
    outline, notes = made.add_subplot(above[0]), made.add_subplot(above[1])
    shaft = _shaft(design)
    _workpiece(outline, cam, shaft)
    panels.legend_beside(notes, outline)
    for i, words in enumerate(reversed(_notes(cam, shaft))):
        notes.text(0.0, 0.055 * i, words, transform=notes.transAxes, fontsize=7.5, va="bottom")
    _radii(made.add_subplot(grid[1]), cam)
    return made


def _shaft(design: Any) -> float:
    """Radius of the shaft [mm]; 0 where the file does not name it."""
    return float(design.cams.section.shaft_radius)


def _workpiece(axes: Axes, cam: DiscCam, shaft: float) -> None:
    panels.drawing(axes, "To scale")
    roller = panels.cam_outline(axes, cam, style.BLACK)
    theta = np.linspace(0.0, _TURN, 361)
    for radius, words in ((cam.min_radius, "minimum"), (cam.max_radius, "maximum")):
        if _is_cut(cam) and words == "maximum":  # an undercut profile does not reach it
            continue
        circle = radius * np.exp(1j * theta)
        axes.plot(circle.real, circle.imag, color=style.GREY, linewidth=0.8, linestyle=style.DOTTED)
        way = np.exp(1j * math.radians(235.0 if words == "minimum" else 305.0)) * radius
        shape = {"arrowstyle": "-|>", "color": style.GREY, "linewidth": 0.9}
        axes.annotate("", (way.real, way.imag), (0.0, 0.0), arrowprops=shape, zorder=6)
        axes.annotate(f"R {radius:.5g}", (0.62 * way.real, 0.62 * way.imag), fontsize=8, ha="center",
                      path_effects=style.outlined(), zorder=7)  # fmt: skip
    _, profile = cam.points(np.linspace(0.0, _TURN, 7201))
    way = roller / abs(roller)
    edge = float(np.abs(profile[int(np.argmin(np.abs(np.angle(profile / way))))]))
    mark = edge * np.array([0.82, 1.0]) * way
    axes.plot(
        mark.real, mark.imag, color=style.RED, linewidth=2.2, label="start mark: roller here at cam angle 0", zorder=6
    )
    if shaft > 0.0:
        bore = _bore(shaft, roller / abs(roller))
        style.area(axes, bore, facecolor="white", edgecolor=style.BLACK, linewidth=1.2, zorder=5)
    panels.cam_axis(axes, 0j, (cam,), cam.sense, shaft)
    reach = abs(roller) + 1.2 * cam.roller_radius
    axes.plot([-cam.max_radius * 1.1, reach], [0.0, 0.0], color=style.GREY, linewidth=0.7, linestyle="-.", zorder=1)


def _is_cut(cam: DiscCam) -> bool:
    """Whether the roller cuts into the profile."""
    return cam.min_curvature_radius.value <= cam.roller_radius


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


def _bore(radius: float, way: complex) -> Any:
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


def _notes(cam: DiscCam, shaft: float) -> list[str]:
    slot = keyway(2.0 * shaft) if shaft > 0.0 else None
    bore = f"bore ø {2.0 * shaft:g} mm" if shaft > 0.0 else "bore: the file names no shaft"
    key = f", keyway {slot[0]:g} × {slot[1]:g} mm, DIN 6885-1, on the start mark" if slot else ""
    least = cam.min_curvature_radius.value
    return [
        f"roller ø {2.0 * cam.roller_radius:g} mm",
        f"cam turns {'counter-' if cam.sense > 0 else ''}clockwise",
        bore,
        *([key.removeprefix(", ")] if key else []),
        f"profile from R {cam.min_radius:.5g} " + ("mm, undercut" if _is_cut(cam) else f"to R {cam.max_radius:.5g} mm"),
        f"minimum convex radius of the pitch curve {least:.5g} mm"
        if math.isfinite(least)
        else "pitch curve never convex",
        "table: radius of the roller's centre [mm]",
        "over the angle on the cam from the start mark,",
        "counter-clockwise [deg]",
    ]


def pitch_radii(cam: DiscCam) -> Any:
    """Radius of the pitch curve [mm] at each whole degree on the cam, from the start mark, counter-clockwise.

    Notes
        Interpolated between 72,000 points of the curve, 2e-7 mm off at a bend of 1/mm.
    """
    pitch, _ = cam.points(np.linspace(0.0, _TURN, 72001))
    angle = np.unwrap(np.angle(pitch / pitch[0]))
    if angle[-1] < 0.0:
        angle, pitch = angle[::-1], pitch[::-1]
    turned = np.mod(np.radians(np.arange(360.0)) - angle[0], _TURN) + angle[0]
    return np.interp(turned, angle, np.abs(pitch))


def _radii(axes: Axes, cam: DiscCam) -> None:
    """Radii of the pitch curve, degree by degree."""
    axes.set_axis_off()
    axes.set_xlim(0.0, _COLUMNS)
    rows = 360 // _COLUMNS
    axes.set_ylim(rows + 0.5, -1.5)
    radii = [f"{value:.3f}" for value in pitch_radii(cam).tolist()]
    look: dict[str, Any] = {"fontsize": 5.4, "va": "center", "family": "monospace", "linespacing": 1.16}
    for column in range(_COLUMNS):
        first = column * rows
        words = "\n".join(f"{degree:3d}   {radii[degree]:>9}" for degree in range(first, first + rows))
        axes.text(column + 0.1, -0.5, "deg        mm", fontsize=5.8, fontweight="bold", va="bottom")
        axes.text(column + 0.1, 0.0, words, **{**look, "va": "top"})
