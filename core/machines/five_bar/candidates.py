"""Designs side by side: the same task by other gears, each searched anew."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.base.candidates import Sought, nothing_sought, table

if TYPE_CHECKING:
    from gearlink.core.base.report import Table
    from gearlink.core.machines.five_bar.design import GearedFiveBar

_RATIOS = ((1, 1), (2, 1), (1, 2))
_LINKS = ("input_length", "coupler_length", "follower_length", "output_length", "frame_length", "phase")
_QUALITY = ("path_deviation_rms", "path_deviation_max", "structural_error", "min_transmission_angle")


def five_bar(design: GearedFiveBar) -> Table:
    """Gears in the ratios 1, 2 and 1/2 in both assemblies; each row is a search of its own."""
    if design.spec.target is None:
        raise nothing_sought("give target: points, positions or a function")
    one, other = _names(design)
    own = getattr(design.spec.gears, one), getattr(design.spec.gears, other)
    keys = {
        f"gears.{one}": (f"{one}_teeth", "1"),
        f"gears.{other}": (f"{other}_teeth", "1"),
        "assembly": ("assembly", "1"),
    }
    teeth = list(dict.fromkeys((own, *((min(own) * p, min(own) * q) for p, q in _RATIOS))))
    # A function's search takes seconds: it keeps to the file's assembly.
    sides = (1, -1) if design.is_path else (design.spec.assembly,)
    rows = [(*pair, side) for pair in teeth for side in sides]
    return table(design, Sought("analyze", keys, rows, (*_LINKS, *_QUALITY)))


def _names(design: GearedFiveBar) -> tuple[str, str]:
    if design.is_path:
        return "input", "output"
    return "planet", "ring" if design.spec.gears.ring is not None else "sun"
