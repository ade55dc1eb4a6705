"""Sheets that a design has besides the picture of its command; what each shows is imported when it is drawn."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gearlink.core.base.kinds import KINDS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Makers = dict[str, Callable[[], "Figure"]]


def kinds() -> tuple[str, ...]:
    """The kinds whose designs have sheets."""
    return tuple(kind.name for kind in KINDS.values() if kind.all_sheets)


def sheets_of(design: Any) -> Makers:
    """The sheets that a design has, by name; a drawing for each cam (`drawing-1`, `drawing-2`).

    Raises
        NoSolution - where the mechanism cannot make its turn
    """
    from gearlink.cli.views.figures.sheets import cam_sheets, motion_sheet, timing_sheet

    found: Makers = {}
    if motion_sheet.courses(design):
        found["motion"] = lambda: motion_sheet.draw(design)
    if "timing" in KINDS[design.kind].sheets:
        found["timing"] = lambda: timing_sheet.draw(design)
    cams = cam_sheets.discs(design)
    if cams:
        found["pressure"] = lambda: cam_sheets.pressure(design)
    for i in range(len(cams)):
        found[f"drawing-{i + 1}"] = lambda i=i: cam_sheets.drawing(design, i)  # type: ignore[misc]
    return found
