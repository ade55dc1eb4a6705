"""The three-gear four-bar drawn to scale in its dwell, and the numbers beside it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gearlink.cli.figures import panels, style
from gearlink.cli.figures.linkage import letters
from gearlink.core.linkages.fourbar import FourBar, solve
from gearlink.core.three_gear.design import ThreeGearFourBar

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CRANK_GEAR, IDLER, OUTPUT_GEAR = style.BLUE, style.GREEN, style.ORANGE
_DASHED: Any = (0, (5, 3))
_DOTTED: Any = (0, (1, 2))
_TURN = 360.0
_WORDS = {
    "crank_length": "crank AB",
    "coupler_length": "coupler BC",
    "rocker_length": "rocker CD",
    "frame_length": "frame AD",
    "gear_gap": "gap of gears 1 and 5",
    "min_transmission_angle": "least transmission angle",
    "mean_ratio": "output turns per crank turn",
    "speed_ratio_max": "greatest speed ratio",
    "speed_ratio_min": "least speed ratio",
    "back_step_angle": "back-step of the output",
    "back_step_crank_angle": "crank angle of it, $\\varphi_{12}$",
    "dwell_angle": "dwell, $\\varphi_{13}$",
}


@dataclass(frozen=True, slots=True)
class Position:
    """The joints of the linkage at a crank angle [mm]."""

    a: complex
    b: complex
    c: complex
    d: complex


def position(linkage: FourBar, crank_angle: float) -> Position:
    """Joints A, B, C, D with A in the origin and D on the x axis."""
    rocker = solve(linkage, crank_angle).rocker_angle
    d = complex(linkage.frame)
    return Position(
        0j,
        linkage.crank * complex(math.cos(crank_angle), math.sin(crank_angle)),
        d + linkage.rocker * complex(math.cos(rocker), math.sin(rocker)),
        d,
    )


def dwell_position(design: ThreeGearFourBar) -> tuple[float, str]:
    """Crank angle [rad] at which the mechanism is drawn, and what that position is."""
    places = design.dwell_crank_angles
    if design.back_step is not None:
        return design.back_step.start + 0.5 * design.back_step.crank_angle, "middle of the back-step"
    if places:
        return places[0], "momentary dwell"
    return design.speed_extremes.least_angle, "least output speed"


def mechanism(axes: Axes, design: ThreeGearFourBar) -> None:
    """Links and gears to scale in the dwell position; lightly, gears 1 and 5 at their closest."""
    angle, words = dwell_position(design)
    at = position(design.linkage, angle)
    style.drawing(axes)
    degrees = math.degrees(angle) % _TURN
    panels.heading(axes, f"Mechanism at the {words}, crank angle {degrees:.5g}°")
    middle = (at.a + at.b + at.c + at.d) / 4.0
    for gear, center in ((1, at.b), (3, at.c), (5, at.d)):
        _gear(axes, design, gear, center, center - middle)
    style.circle(
        axes, at.a, design.crank_length, color=style.GREY, linewidth=0.9, linestyle=_DOTTED, gid="crank-circle"
    )
    axes.plot([], [], color=style.GREY, linewidth=0.9, linestyle=_DOTTED, label="path of the crank pin B")
    _closest(axes, design, angle)
    _shafts(axes, design)
    style.link(axes, [at.a, at.b, at.c, at.d])
    style.pivot(axes, at.a)
    style.pivot(axes, at.d)
    _letters(axes, at)
    axes.margins(0.05)
    axes.autoscale_view()


def _parts(design: ThreeGearFourBar) -> dict[int, tuple[str, int, str]]:
    """Name, teeth and colour of each gear."""
    return {
        1: ("crank gear", design.crank_teeth, CRANK_GEAR),
        3: ("idler", design.idler_teeth, IDLER),
        5: ("output gear", design.output_teeth, OUTPUT_GEAR),
    }


def _radii(design: ThreeGearFourBar, gear: int) -> tuple[float, float]:
    """Pitch and tip radius [mm]."""
    pair, side = {1: ("crank_idler", 0), 3: ("crank_idler", 1), 5: ("idler_output", 1)}[gear]
    mesh = design.meshes[pair]
    return mesh.reference_radius[side], mesh.tip_radius[side]


def _gear(axes: Axes, design: ThreeGearFourBar, gear: int, center: complex, outward: complex) -> None:
    """Pitch circle solid, tip circle dashed, the gear's number on the rim, away from the links."""
    from matplotlib.patches import Circle

    name, teeth, color = _parts(design)[gear]
    pitch, tip = _radii(design, gear)
    axes.add_patch(Circle((center.real, center.imag), pitch, facecolor=color, alpha=0.10, linewidth=0, zorder=1))
    style.circle(axes, center, pitch, color=color, linewidth=1.5, zorder=3, gid=f"pitch-{gear}")
    style.circle(axes, center, tip, color=color, linewidth=0.9, linestyle=_DASHED, zorder=3, gid=f"tip-{gear}")
    axes.plot([], [], color=color, linewidth=1.5, label=f"gear {gear}, {name}, z = {teeth}")
    box = {"boxstyle": "circle,pad=0.2", "facecolor": "white", "edgecolor": color, "linewidth": 1.2}
    rim = center + pitch * outward / abs(outward)
    axes.text(rim.real, rim.imag, str(gear), fontsize=8, bbox=box, ha="center", va="center", zorder=6)


def _closest(axes: Axes, design: ThreeGearFourBar, drawn: float) -> None:
    """Gears 1 and 5 where they come nearest, the crank on the frame line; red where they overlap."""

    at = position(design.linkage, 0.0)
    r1, r5 = (_radii(design, gear)[1] for gear in (1, 5))
    if abs(math.remainder(drawn, 2.0 * math.pi)) > math.radians(1.0):
        for center, radius, color in ((at.b, r1, CRANK_GEAR), (at.c, _radii(design, 3)[1], IDLER)):
            style.circle(axes, center, radius, color=color, linewidth=0.7, alpha=0.45, linestyle=_DASHED, gid="closest")
        points = [at.a, at.b, at.c, at.d]
        x, y = [p.real for p in points], [p.imag for p in points]
        axes.plot(x, y, "o-", color=style.GREY, alpha=0.5, linewidth=1.0, markersize=2.5, label="gears 1 and 5 closest")
    if design.gear_gap < 0.0:
        both = _overlap(at.b, r1, at.d, r5)
        axes.fill(both.real, both.imag, color=style.RED, linewidth=0, zorder=6, gid="collision")
        where = (design.frame_length - math.copysign(r5, design.frame_length - design.crank_length), 0.0)
        pointer = {"arrowstyle": "-|>", "color": style.RED, "linewidth": 0.9}
        axes.annotate(
            "collision",
            where,
            (0, -62),
            textcoords="offset points",
            color=style.RED,
            fontsize=8,
            ha="center",
            arrowprops=pointer,
            zorder=8,
        )
        axes.fill([], [], color=style.RED, label=f"gears 1 and 5 collide by {-design.gear_gap:.4g} mm")


def _overlap(center_1: complex, radius_1: float, center_2: complex, radius_2: float) -> Any:
    """Outline of what two circles share: the points of each that lie within the other, in order round their middle."""
    import numpy as np

    turn = np.exp(1j * np.linspace(0.0, 2.0 * math.pi, 20001))
    first, second = center_1 + radius_1 * turn, center_2 + radius_2 * turn
    points = np.concatenate([first[abs(first - center_2) <= radius_2], second[abs(second - center_1) <= radius_1]])
    return points[np.argsort(np.angle(points - points.mean()))]


def _shafts(axes: Axes, design: ThreeGearFourBar) -> None:
    """The shafts that the file names."""
    from matplotlib.patches import Circle

    shafts = design.spec.shafts
    if shafts is None:
        return
    for name, radius, x in (
        ("input", shafts.input_radius, 0.0),
        ("output", shafts.output_radius, design.frame_length),
    ):
        if radius is not None:
            axes.add_patch(
                Circle(
                    (x, 0.0),
                    radius,
                    facecolor=style.GREY,
                    edgecolor=style.BLACK,
                    alpha=0.6,
                    zorder=2,
                    gid=f"shaft-{name}",
                )
            )
            axes.fill([], [], color=style.GREY, alpha=0.6, label=f"{name} shaft, radius {radius:g} mm")


def _letters(axes: Axes, at: Position) -> None:
    """The letters of the joints, away from the links that meet there."""
    joints: dict[str, tuple[complex, tuple[complex, ...]]] = {
        "A": (at.a, (at.b, at.d)),
        "B": (at.b, (at.a, at.c)),
        "C": (at.c, (at.b, at.d)),
        "D": (at.d, (at.c, at.a)),
    }
    letters(axes, joints)


def numbers(axes: Axes, drawing: Axes, design: ThreeGearFourBar) -> None:
    """The legend of the drawing, and under it the numbers that it is to scale with."""
    panels.legend_beside(axes, drawing)
    names = ("crank_length", "coupler_length", "rocker_length", "frame_length", "gear_gap", "min_transmission_angle")
    found = [design.quantity(name) for name in (*names, *_motion_names(design))]
    shown = [
        (_WORDS.get(q.name, q.words), f"{q.value:.6g} {q.unit}".removesuffix(" 1")) for q in found if q is not None
    ]
    for i, (words, value) in enumerate(reversed(shown)):
        axes.text(0.0, 0.062 * i, words, transform=axes.transAxes, va="bottom", fontsize=8)
        axes.text(1.0, 0.062 * i, value, transform=axes.transAxes, va="bottom", ha="right", fontsize=8)


def _motion_names(design: ThreeGearFourBar) -> tuple[str, ...]:
    if design.back_step is None:
        return ("mean_ratio", "speed_ratio_max", "speed_ratio_min")
    return ("mean_ratio", "back_step_angle", "back_step_crank_angle", "dwell_angle")
