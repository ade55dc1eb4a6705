"""The path of contact in a mesh zone: line of action, A, C and E, contact points, and the frame about them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from gearlink.cli.views.figures.drawing import panels, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Contact(Protocol):
    """What a mesh zone shows of a mesh; points in mm."""

    @property
    def pitch_point(self) -> complex: ...
    @property
    def direction(self) -> complex: ...
    @property
    def contact_start(self) -> complex: ...
    @property
    def contact_end(self) -> complex: ...
    @property
    def contacts(self) -> list[complex]: ...


def zone_size(geometry: Contact, module: float) -> tuple[float, float]:
    """Half the width and half the height that show the path of contact and some teeth [mm]."""
    pitch, ends = geometry.pitch_point, (geometry.contact_start, geometry.contact_end)
    high = max(2.6 * module, *(1.3 * abs((end - pitch).imag) for end in ends))
    return max(2.7 * module, *(1.3 * abs((end - pitch).real) for end in ends), 0.95 * high), high


def zone_frame(axes: Axes, pitch: complex, wide: float, high: float, names: tuple[str, str]) -> None:
    """The limits of a mesh zone, to scale, and the names of both bodies in its lower corners."""
    axes.set_xlim(pitch.real - wide, pitch.real + wide)
    axes.set_ylim(-high, high)
    axes.set_aspect("equal", adjustable="box")
    panels.few_ticks(axes.xaxis, 5)
    for name, side, align in zip(names, (-0.94, 0.94), ("left", "right"), strict=True):
        axes.text(pitch.real + side * wide, -0.93 * high, name, color=style.BLACK, fontsize=8, ha=align)


def contact_path(axes: Axes, geometry: Contact, length: float) -> None:
    """Line of action, path of contact from A to E, and where flanks touch now."""
    pitch, way = geometry.pitch_point, geometry.direction
    line = [pitch - length * way, pitch + length * way]
    axes.plot([p.real for p in line], [p.imag for p in line], color=style.BLACK, linewidth=0.8, label="line of action")
    ends = [geometry.contact_start, geometry.contact_end]
    axes.plot(
        [p.real for p in ends],
        [p.imag for p in ends],
        color=style.RED,
        linewidth=2.4,
        marker="|",
        markersize=11,
        label="path of contact A–E",
        zorder=5,
    )
    touching = geometry.contacts
    axes.plot(
        [p.real for p in touching],
        [p.imag for p in touching],
        "o",
        color="white",
        markeredgecolor=style.RED,
        markersize=5.5,
        label="contact points",
        zorder=6,
    )
    for name, point, shift in (("A", ends[0], (8, -4)), ("C", pitch, (8, -4)), ("E", ends[1], (8, -2))):
        _boxed(axes, name, point, shift)


def _boxed(axes: Axes, name: str, point: complex, shift: tuple[float, float]) -> None:
    box = {"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.8}
    place = (point.real, point.imag)
    axes.annotate(name, place, shift, textcoords="offset points", fontsize=9, bbox=box, zorder=7)


def zone_legend(axes: Axes) -> None:
    handles, labels = axes.get_legend_handles_labels()
    unique = dict(zip(labels, handles, strict=True))
    axes.legend(
        unique.values(),
        unique.keys(),
        loc="upper center",
        bbox_to_anchor=(0.5, -0.11),
        ncols=3,
        frameon=False,
        fontsize=7.5,
        handlelength=2.4,
        columnspacing=1.2,
    )
