"""What figures are made of: imported in the command's own process without what nobody there asks for."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

from gearlink.cli import process
from gearlink.cli.quiet import without_notes

if TYPE_CHECKING:
    from matplotlib.font_manager import FontProperties

_Heights: TypeAlias = tuple[float, float, float] | tuple[None, None, None]
_TABLES = (("OS/2", "sTypoAscender", "sTypoDescender", "sTypoLineGap"), ("hhea", "ascent", "descent", "lineGap"))
"""Where a font tells how high its lines are, the first that it has."""


def load_what_is_drawn(ending: str) -> None:
    """Import what figures are made of, without the texts of `help` on every artist's properties and without solid axes.

    Those are a fifth of the import, for matplotlib's `kwdoc` reads the docstrings of all setters, and these, which
    matplotlib can do without, a twelfth. Nobody asks for them in a process of the command; in one of Python or a
    notebook, somebody may, and nothing is left out.
    """
    if not process.runs_the_command_alone or "matplotlib.figure" in sys.modules:
        return
    with without_notes("matplotlib"):
        import matplotlib.artist as artists

    def nothing(artist: Any) -> str:  # noqa: ARG001 - the name is part of what is replaced
        return ""

    described = artists.kwdoc
    artists.kwdoc = nothing
    missing: dict[str, Any] = {"mpl_toolkits.mplot3d": None}
    sys.modules.update(missing)
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", message="Unable to import Axes3D")
            import matplotlib.figure  # noqa: F401
            from matplotlib.backends.backend_agg import RendererAgg

            renderers: list[Any] = [(RendererAgg, lambda renderer: renderer.dpi)]
            if ending == "svg":
                from matplotlib.backends.backend_svg import RendererSVG

                renderers.append((RendererSVG, lambda _: 72.0))
    finally:
        artists.kwdoc = described
        del sys.modules["mpl_toolkits.mplot3d"]
    for renderer, resolution in renderers:
        renderer._get_font_height_metrics = heights_of_lines(resolution)


def heights_of_lines(resolution: Callable[[Any], float]) -> Callable[[Any, FontProperties], _Heights]:
    """How high the lines of a font are on a renderer [pixel]: above and below the base line, and between two.

    From 3.11 on, matplotlib seeks the font and reads two of its tables for every text that it measures, which takes a
    twentieth of the time of a sheet, unless the renderer says it; earlier ones do not ask.
    """
    known: dict[int, tuple[int, tuple[int, int, int]] | None] = {}

    def heights(renderer: Any, font: FontProperties) -> _Heights:
        name = hash(font)  # a text may give the same object another size later
        if name not in known:
            known[name] = _read(font)
        if (found := known[name]) is None:
            return None, None, None
        units, (above, below, between) = found
        scale = 1 / units * font.get_size_in_points() * resolution(renderer) / 72
        return above * scale, below * scale, between * scale

    return heights


def _read(font: FontProperties) -> tuple[int, tuple[int, int, int]] | None:
    """Units of a font to its size, and in these the heights above and below the base line, and between two lines; None
    where it does not tell them, and matplotlib measures letters."""
    from matplotlib import font_manager

    face: Any = font_manager.get_font(font_manager.findfont(font))
    for name, above, below, between in _TABLES:
        if (table := face.get_sfnt_table(name)) is not None:
            return face.get_sfnt_table("head")["unitsPerEm"], (table[above], -table[below], table[between])
    return None
