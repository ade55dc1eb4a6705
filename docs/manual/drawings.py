"""The drawing of a kind: its mechanism in one position with points, sizes, angles and the coordinate frame.

A page of a kind asks for it by a block

    ```drawing
    designs/standing_feed.yaml at 0.75
    AB: l1 crank
    angle AB: phi1
    circle A crank_length: path of B
    ```

whose lines name a size between two lettered points, an angle from the x axis, or a circle about a point with a quantity
or a key of the design as its radius.
"""

from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from docs.manual.runs import KEPT, ROOT, program

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from gearlink.cli.views.scenes.scene import Scene

_GREY, _RED = "#555555", "#B03A00"
_LETTERS = re.compile(r"[A-Z]\d*")


@dataclass(frozen=True, slots=True)
class Drawing:
    """What a block asks for: the file, the share of its loop, and a text for each size, angle or circle."""

    design: str
    fraction: float
    sizes: tuple[tuple[str, str], ...]

    @classmethod
    def read(cls, block: str) -> Drawing:
        """The block of a page.

        Example
            >>> Drawing.read("designs/feed.yaml at 0.75\\nAB: l1 crank").sizes
            (('AB', 'l1 crank'),)
        """
        first, *rest = block.strip().split("\n")
        design, _, fraction = first.partition(" at ")
        sizes = tuple((name.strip(), text.strip()) for name, _, text in (line.partition(":") for line in rest))
        return cls(design, float(fraction or 0.0), sizes)

    def picture(self, stale: bool) -> str:
        """Name of the picture in `KEPT`, drawn where it is not there."""
        made_of = "" if stale else program()
        name = hashlib.sha256(repr(self).encode()).hexdigest()[:20]
        path, note = KEPT / f"{name}.svg", KEPT / f"{name}.txt"
        if not path.exists() or not (stale or (note.exists() and note.read_text(encoding="utf-8") == made_of)):
            KEPT.mkdir(parents=True, exist_ok=True)
            self._draw(path)
            note.write_text(program(), encoding="utf-8")
        return path.name

    def _draw(self, path: Path) -> None:
        from matplotlib import rc_context
        from matplotlib.backends.backend_svg import FigureCanvasSVG
        from matplotlib.figure import Figure

        from gearlink.cli.views.figures.drawing import scene_axes

        scene, ahead = (scene_of(self.design, self.fraction + step) for step in (0.0, scene_axes.AHEAD))
        with rc_context({"svg.hashsalt": "gearlink", "svg.fonttype": "path"}):
            made = Figure(figsize=(6.4, 4.8), layout="constrained")
            FigureCanvasSVG(made)
            axes = made.add_subplot()
            axes.set_aspect("equal")
            axes.grid(visible=False)
            axes.set_xlabel("x [mm]")
            axes.set_ylabel("y [mm]")
            scene_axes.draw(axes, scene, ahead=ahead)
            self._label(axes, scene)
            made.savefig(path, metadata={"Date": None}, bbox_inches="tight", pad_inches=0.08)

    def _label(self, axes: Axes, scene: Scene) -> None:
        points = places(scene)
        _frame(axes)
        size = _size(axes)
        for name, text in self.sizes:
            if name.startswith("circle "):
                _, letter, radius = name.split()
                _circle(axes, points[letter], size_of(self.design, radius), text)
                continue
            angle = name.startswith("angle ")
            letters = _LETTERS.findall(name.removeprefix("angle "))
            unknown = [letter for letter in letters if letter not in points]
            if unknown or len(letters) != 2:
                raise ValueError(f"{self.design} has no point {', '.join(unknown) or name}, but {', '.join(points)}")
            start, end = (points[letter] for letter in letters)
            (_angle if angle else _length)(axes, start, end, text, size)


def scene_of(design: str, fraction: float) -> Scene:
    """The scene of a design file at a fraction of its loop."""
    from gearlink.cli.views.scenes.linkages import build

    return build(_design(design), np.array([fraction]))


def size_of(design: str, name: str) -> float:
    """A quantity or a key of a design [mm].

    Example
        >>> size_of("designs/cycloidal_reducer.yaml", "pin_circle_radius")
        60.0
    """
    from gearlink.core.base.spec_paths import value_at

    made = _design(design)
    found = made.quantity(name).value if name in made.quantity_names() else value_at(made.spec, name)
    return float(found)


def _design(design: str) -> Any:
    from gearlink.cli.evaluate import open_design, read_spec, whole_design
    from gearlink.cli.options import Options

    source = str(ROOT / design)
    loaded, kind = open_design(source, Options())
    return whole_design(kind, read_spec(loaded, kind, source))


def places(scene: Scene) -> dict[str, complex]:
    """The lettered points of a scene."""
    return {
        letter.strip(): complex(mark.point[0])
        for mark in scene.marks
        for letter in mark.text.split(",")
        if _LETTERS.fullmatch(letter.strip())
    }


def _size(axes: Axes) -> float:
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    return max(right - left, high - low)


def _frame(axes: Axes) -> None:
    """The axes x and y at the origin."""
    length = 0.16 * _size(axes)
    for end, name in ((length, "x"), (1j * length, "y")):
        where = (end.real, end.imag) if isinstance(end, complex) else (end, 0.0)
        axes.annotate("", where, (0.0, 0.0), arrowprops={"arrowstyle": "-|>", "color": _RED, "lw": 1.4}, zorder=9)
        axes.annotate(name, where, xytext=(3, 3), textcoords="offset points", color=_RED, fontsize=11, style="italic")


def _length(axes: Axes, start: complex, end: complex, text: str, size: float) -> None:
    """A text beside the middle of a size."""
    del size
    middle, along = 0.5 * (start + end), end - start
    normal = 1j * along / abs(along) if along else 1j
    if normal.imag < 0.0:
        normal = -normal
    axes.annotate(text, (middle.real, middle.imag), xytext=(11 * normal.real, 11 * normal.imag),
                  textcoords="offset points", ha="center", va="center", fontsize=9, color=_RED, zorder=10,
                  bbox=_paper())  # fmt: skip


def _angle(axes: Axes, start: complex, end: complex, text: str, size: float) -> None:
    """An arc from the x direction to a link, with its text."""
    turn, radius = float(np.angle(end - start)) % (2.0 * np.pi), 0.10 * size
    arc = start + radius * np.exp(1j * np.linspace(0.0, turn, 60))
    axes.plot(arc.real, arc.imag, color=_RED, linewidth=1.1, zorder=9)
    axes.plot([start.real, start.real + 1.25 * radius], [start.imag] * 2, color=_GREY, linewidth=0.8, dashes=(4, 3))
    at = start + 1.3 * radius * np.exp(0.5j * turn)
    axes.text(at.real, at.imag, text, ha="center", va="center", fontsize=9, color=_RED, zorder=10, bbox=_paper())


def _circle(axes: Axes, center: complex, radius: float, text: str) -> None:
    """A dashed circle with its text below on the left, where drawings have least."""
    turn = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 181))
    rim = center + radius * turn
    axes.plot(rim.real, rim.imag, color=_RED, linewidth=0.9, dashes=(5, 3), zorder=8)
    at = center + radius * np.exp(1.25j * np.pi)
    axes.text(at.real, at.imag, text, ha="center", va="center", fontsize=9, color=_RED, zorder=10, bbox=_paper())


def _paper() -> dict[str, Any]:
    return {"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.8}
