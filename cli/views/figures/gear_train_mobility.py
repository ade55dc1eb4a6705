"""The figure of gear trains on a linkage: a diagram of links, pins, gears and fixed ends, not to scale."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Any

from gearlink.cli.views.figures.drawing import linkage, panels, style
from gearlink.core.base.wording import amount
from gearlink.core.machines.mobility import GearTrainMobility, pin_names

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_COLORS = (style.BLUE, style.ORANGE, style.GREEN, style.PURPLE, style.SKY, style.RED)
_GROUND = ("frame", "ground", "base", "fixed")
"""Words by which the name of a link says that it stands."""
_NEAR_MIDDLE = 0.2
_ALONE = 0.5  # gears that all sit on one pin, which a check tells


def draw(command: str, design: GearTrainMobility) -> Figure:
    """The sheet of `analyze` on gear trains."""
    words = {
        "linkage_mobility": "mobility of the linkage",
        "mobility_changes": "changes by the trains",
        "mobility": "mobility",
    }
    return linkage.sheet(f"{design.spec.name}: {command}", design, diagram, words, [])


def diagram(axes: Axes, design: GearTrainMobility) -> None:
    """Pins on a circle, links between them, gears round their pins; a dot marks the link a gear is fixed to."""
    design.require_names()
    places = pin_places(design)
    panels.heading(axes, "Structure, not to scale")
    axes.set_axis_off()
    for name, pins in design.links.items():
        _link(axes, name, [places[pin] for pin in pins])
    for i, train in enumerate(design.spec.trains):
        color = _COLORS[i % len(_COLORS)]
        apart = [abs(places[p.at] - places[q.at]) for p in train.gears for q in train.gears if p.at != q.at]
        half = min(apart, default=_ALONE) / 2.0 * (1.0 if i % 2 == 0 else 0.86)
        change = f"{design.mobility_changes[i]:+d}".replace("-", "−")
        words = f"train {i + 1}: {amount(design.fixed_ends[i], 'gear')} fixed to links, mobility {change}"
        axes.plot([], [], color=color, linewidth=1.6, label=words)
        for gear in train.gears:
            style.circle(axes, places[gear.at], half, color=color, linewidth=1.6, zorder=3)
            pins = design.links[gear.fixed_to] if gear.fixed_to is not None else ()
            if gear.at in pins and len(pins) > 1:
                other = next(pin for pin in pins if pin != gear.at)
                _fixing(axes, places[gear.at], places[other], half, color)
    for pin, place in places.items():
        axes.plot([place.real], [place.imag], "o", color="white", markeredgecolor=style.BLACK, markersize=7, zorder=6)
        style.letter(axes, place, pin, (19.0 * place.real, 19.0 * place.imag))


def pin_places(design: GearTrainMobility) -> dict[str, complex]:
    """A place for every pin, on a circle in the order in which links lead from one to the next."""
    names = pin_names(design.links)
    order, rest = [names[0]], names[1:]
    while rest:
        near = [pin for pin in rest if any(order[-1] in pins and pin in pins for pins in design.links.values())]
        order.append((near or rest)[0])
        rest.remove(order[-1])
    return {pin: cmath.rect(1.0, math.pi * (1.25 + 2.0 * i / len(order))) for i, pin in enumerate(order)}


def _link(axes: Axes, name: str, points: list[complex]) -> None:
    """A binary link as a bar, one with more pins as a plate; the frame in grey."""
    fixed = any(word in _GROUND for word in name.lower().replace("_", " ").replace("-", " ").split())
    color = style.GREY if fixed else style.BLACK
    if fixed:
        for point in points:
            style.pivot(axes, point)
    if len(points) > 2:
        style.area(axes, points, color=color, alpha=0.15, zorder=1)
    ends = [*points, points[0]] if len(points) > 2 else points
    axes.plot([p.real for p in ends], [p.imag for p in ends], color=color, linewidth=2.4, zorder=2)
    middle = sum(points, 0j) / len(points)
    look: dict[str, Any] = {"fontsize": 8, "color": color, "ha": "center", "va": "center", "zorder": 5}
    if len(points) == 2 and abs(middle) > _NEAR_MIDDLE:  # outside of its link, clear of it whatever its length
        away = middle / abs(middle)
        look |= {"ha": "left" if away.real > 0.2 else "right" if away.real < -0.2 else "center"}
        middle *= 1.0 + 0.09 / abs(middle)
    axes.text(middle.real, middle.imag, name, path_effects=style.outlined(), **look)
    axes.update_datalim([(1.2 * middle.real, 1.2 * middle.imag)])


def _fixing(axes: Axes, center: complex, toward: complex, radius: float, color: str) -> None:
    """A dot where the rim of a fixed gear crosses its link."""
    spot = center + 0.55 * radius * ((toward - center) / abs(toward - center))
    axes.plot([spot.real], [spot.imag], "s", color=color, markersize=8, zorder=5)
    axes.plot([center.real, spot.real], [center.imag, spot.imag], color=color, linewidth=4, zorder=4)
