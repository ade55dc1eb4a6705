"""The shares of a pair's shift sum side by side."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Table
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.pitch_pair import Pair
from gearlink.core.parts.gears.shifts.shift_split import SPLITS, Diagonal, Split

if TYPE_CHECKING:
    from gearlink.core.base.report import Column


def strengths(data: GearData) -> Pair | None:
    """Y_F Y_S over width and permissible stress of both gears; None where a root has no section."""
    root = data.root
    widths = root.bearing_width or (1.0, 1.0)
    found = []
    for section, width, material in zip(root.sections, widths, data.materials, strict=True):
        if section is None:
            return None
        permissible = (material.bending_limit or 1.0) * material.bending_factors
        found.append(section.form_factor * section.stress_correction_factor / (width * permissible))
    return found[0], found[1]


def strength_of(data: GearData) -> Callable[[GearPair], Pair | None]:
    """`strengths` of any pair with the data of this one."""
    return lambda pair: strengths(replace(data, pair=pair))


def candidates_table(data: GearData) -> Table:
    """The table `candidates`: the pair as it stands, and each criterion with what it leads to.

    Notes
        A criterion without a share has its statement alone.
    """
    diagonal = Diagonal(data.pair)
    found: list[tuple[str, Split]] = [("given", Split(data.pair.profile_shift[0], "as it stands"))]
    for name in SPLITS:
        try:
            found.append((name, diagonal.split(name, strength_of(data))))
        except NoSolution as error:
            found.append((name, Split(float("nan"), str(error))))
    rows = [_values(data, diagonal, split.first) for _, split in found]
    columns: dict[str, tuple[Column, str]] = {"split": ([name for name, _ in found], "1")}
    for name in _COLUMNS:
        columns[name] = ([row.get(name) for row in rows], "mm" if name.startswith("tip_thickness") else "1")
    columns["statement"] = ([split.statement for _, split in found], "1")
    return Table.of("candidates", columns)


_COLUMNS = (
    "x1",
    "x2",
    "sliding_1",
    "sliding_2",
    "tip_thickness_1",
    "tip_thickness_2",
    "root_factor_1",
    "root_factor_2",
    "undercut_margin_1",
    "undercut_margin_2",
    "contact_ratio",
)


def _values(data: GearData, diagonal: Diagonal, first: float) -> dict[str, float | None]:
    if first != first:
        return {}
    shift_sum = diagonal.shift_sum
    values: dict[str, float | None] = {"x1": first, "x2": shift_sum - first}
    try:
        pair = diagonal.at(first)
        tips, sliding = pair.tip_thickness, pair.specific_sliding if pair.slides else (None, None)
        root = replace(data, pair=pair).root
    except NoSolution:
        return values
    values["contact_ratio"] = pair.contact_ratio
    for gear, section in enumerate(root.sections):
        least = pair.min_shift_no_undercut[gear]
        values[f"sliding_{gear + 1}"] = sliding[gear]
        values[f"tip_thickness_{gear + 1}"] = tips[gear]
        values[f"root_factor_{gear + 1}"] = (
            None if section is None else section.form_factor * section.stress_correction_factor
        )
        values[f"undercut_margin_{gear + 1}"] = None if least is None else pair.profile_shift[gear] - least
    return values
