"""The drawings of the meshes of a train, and the checks that go with them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from gearlink.core.base.report import Check, Table
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.drawing import drawing_table
from gearlink.core.parts.gears.drawing_checks import pair_check
from gearlink.core.parts.gears.train.meshes import Place


def drawings(found: Mapping[str, GearData], hands: Sequence[str] | None, places: Sequence[Place]) -> Table:
    """The gear tables of the meshes, one below the other; a single one as it is.

    Parameters
        found : GearData of the meshes by name, a ring second; the columns have the order of the file's lists
        hands : of helix of all gears, or None
        places : Places of the meshes
    """
    tables = {
        mesh: _in_order(
            drawing_table(data, None if hands is None else (hands[place.gears[0]], hands[place.gears[1]])), place
        )
        for (mesh, data), place in zip(found.items(), places, strict=True)
    }
    one, *_ = tables.values()
    if len(tables) == 1:
        return one
    names = [mesh for mesh, table in tables.items() for _ in range(table.length)]
    columns = [[value for table in tables.values() for value in table.data[i]] for i in range(len(one.columns))]
    return Table("drawing", ("mesh", *one.columns), ("", *one.units), (names, *columns))


def _in_order(table: Table, place: Place) -> Table:
    """The gears in the order of the file's lists, where a ring stands before its mate."""
    if place.gears[0] < place.gears[1]:
        return table
    item, symbol, pinion, ring, *rest = table.data
    return Table(table.name, table.columns, table.units, (item, symbol, ring, pinion, *rest))


def judgement(name: str, found: Mapping[str, GearData], spec: Any) -> dict[str, list[Check]]:
    """The findings of one of TRAIN_CHECKS on each mesh.

    Parameters
        name : str
        found : GearData of the meshes by name
        spec : of the design, with sections `gears` and `limits`
    """
    radial = spec.gears.assembly == "radial"
    return {mesh: pair_check(name, data, spec.limits, mesh=mesh, radial=radial) for mesh, data in found.items()}
