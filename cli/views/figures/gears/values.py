"""The table beside a mesh: words, symbols, units and values of both gears."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from gearlink.cli.views.figures.drawing import style
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.nomenclature import term

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Quantity = Callable[[str], Any]
"""A quantity of a mesh by name, of two gears a pair; None where it has none."""

_OF_MESH = (
    "center_distance",
    "working_pressure_angle",
    "contact_ratio",
    "shift_sum",
    "tip_shortening",
)
_OF_GEAR = (
    "profile_shift",
    "reference_radius",
    "base_radius",
    "working_radius",
    "tip_radius",
    "root_radius",
    "tooth_thickness",
    "tip_thickness",
    "specific_sliding",
)
_WORDS = {
    "center_distance": "centre distance",
    "working_pressure_angle": "working pressure angle",
    "base_radius": "base radius",
    "tip_radius": "tip radius",
    "root_radius": "root radius",
    "reference_radius": "reference radius",
    "tooth_thickness": "thickness, reference circle",
    "working_radius": "working pitch radius",
    "specific_sliding": "specific sliding, foot of flank",
    "shift_sum": "sum of the profile shifts",
    "tip_shortening": "tip shortening coefficient",
    "contact_stress": "contact stress",
    "safety_pitting": "safety against pitting",
    "root_stress": "root stress",
    "safety_bending": "safety against breaking",
}
_SYMBOL = 1
"""The column of the symbols, as the nomenclature writes them."""
_SIGNS = {"alpha": "α", "beta": "β", "eps": "ε", "gamma": "γ", "rho": "ρ", "sigma": "σ", "zeta": "ζ"}


def ruled(
    axes: Axes,
    head: Sequence[str],
    rows: Sequence[Sequence[str]],
    *,
    size: float = 7.5,
    rows_of: int = 0,
    at: tuple[float, float] = (0.38, 0.46),
) -> None:
    """Rows of text with light rules: words, symbol and unit on the left, numbers on the right.

    Parameters
        at : (float, float) - places of symbol and unit in the width
        rows_of : int - so many rows fill the height; 0: those that there are
    """
    axes.set_axis_off()
    extra = 1.0 if "\n" in head[-1] else 0.0  # a head of two lines
    axes.set_xlim(0.0, 1.0)
    axes.set_ylim((rows_of or len(rows)) + 1.0 + extra, 0.0)
    numbers = len(head) - 3
    edges = [at[1] + 0.06 + (0.94 - at[1]) * (i + 1) / numbers - 0.01 for i in range(numbers)]
    places = [(0.0, "left"), *((place, "left") for place in at), *((edge, "right") for edge in edges)]
    for row, line in enumerate([head, *rows]):
        middle = row + 0.5 + (extra if row else 0.5 * extra)
        for column, ((x, side), text) in enumerate(zip(places, line, strict=True)):
            if row and column == _SYMBOL and text:
                _set_symbol(axes, (x, middle), text, size)
                continue
            weight = "normal" if row else "bold"
            # To measure each cell for the layout takes longer than to draw it; a remark alone in its row may need room.
            alone = not any(line[1:])
            axes.text(x, middle, text, fontsize=size, ha=side, va="center", fontweight=weight, in_layout=alone)
        axes.axhline(row + 1.0 + extra, color=style.LIGHT if row else style.GREY, linewidth=0.6)


def headed(name: str) -> tuple[str, str, str]:
    """Words, symbol and unit of a quantity."""
    entry = term(name)
    words = _WORDS.get(name, entry.words)
    return words, entry.symbol, "" if entry.unit == "1" else entry.unit.replace("^2", "²")


def value_rows(teeth: list[str], modules: list[str], quantities: Sequence[Quantity]) -> list[list[str]]:
    """Rows of words, symbol, unit and values: two columns for each mesh, its own values in the first of them."""
    rows = [["teeth", "z", "", *teeth], ["module", "m", "mm", *modules]]
    for name in _OF_GEAR:
        rows.append([*headed(name), *(_text(quantity, name, gear) for quantity in quantities for gear in (0, 1))])
    for name in _OF_MESH:
        rows.append([*headed(name), *(text for quantity in quantities for text in (_text(quantity, name), ""))])
    return rows


def _text(quantity: Quantity, name: str, gear: int | None = None) -> str:
    """A value to six digits; what the pair does not have is a dash."""
    try:
        found = quantity(name)
    except NoSolution:
        found = None
    value = found[gear or 0] if isinstance(found, tuple) else found
    if value is None:
        return "–"
    return style.number(math.degrees(value) if term(name).unit == "deg" else value)


def gear_text(value: Any) -> str:
    """A cell of a gear table: numbers to six digits, minus signs, nothing for what a gear does not have."""
    if value is None:
        return ""
    return str(value) if isinstance(value, str) else style.number(value)


def _set_symbol(axes: Axes, place: tuple[float, float], symbol: str, size: float) -> None:
    """A symbol of the nomenclature: its letter, and smaller texts beside it.

    matplotlib's own formulas take ten times as long as text, for it reads them by a grammar.
    """
    (letter, *_), *beside = _parted(symbol)
    stem: Any = axes.text(*place, letter, fontsize=size, fontstyle="italic", va="center", in_layout=False)
    before = stem
    for words, height, align, share in beside:
        look: dict[str, Any] = {"fontsize": share * size, "fontstyle": "italic", "va": align, "in_layout": False}
        of: Any = (before, stem)  # whatever stands before it, it is as high as the first letter says
        before = axes.annotate(words, (1.0, height), (0.3, 0.0), xycoords=of, textcoords="offset points", **look)


def _parted(symbol: str) -> list[tuple[str, float, str, float]]:
    """Letters, indices and star of a symbol, each with its place on the height of a letter, and its share of its size.

    Example
        >>> [words for words, *_ in _parted("alpha_wt")], [words for words, *_ in _parted("x1+x2")]
        (['α', 'wt'], ['x', '1', '+x', '2'])
        >>> _parted("h_fP*")
        [('h', 0.0, 'bottom', 1.0), ('fP', 0.0, 'bottom', 0.7), ('*', 1.0, 'top', 0.9)]
    """
    plain = symbol.removesuffix("*")
    letter, _, index = plain.partition("_")
    words = [_SIGNS[letter]] if letter in _SIGNS else re.findall(r"\d+|\D+", letter)
    found = [(each, 0.0, "bottom", 0.7 if each.isdigit() else 1.0) for each in words]
    if index:
        found.append((_SIGNS.get(index, index), 0.0, "bottom", 0.7))
    return [*found, ("*", 1.0, "top", 0.9)] if plain != symbol else found
