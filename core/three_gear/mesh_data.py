"""What the drawing of the meshes of a three-gear drive needs, and its checks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gearlink.core.errors import at_key
from gearlink.core.gears.data import GearData
from gearlink.core.gears.drawing import drawing_table
from gearlink.core.gears.drawing_checks import drawing_check
from gearlink.core.gears.pair import GearPair
from gearlink.core.gears.train import Place, train_data, train_pairs
from gearlink.core.report import Check, Table
from gearlink.core.three_gear.names import MESHES

if TYPE_CHECKING:
    from gearlink.core.three_gear.spec import Gears, ThreeGearSpec


def _places(gears: Gears, idler: int) -> list[Place]:
    """Both meshes, a ring as the second gear of its pair."""
    first = Place((1, 0), (idler, gears.crank)) if gears.crank < 0 else Place((0, 1), (gears.crank, idler))
    return [first, Place((1, 2), (idler, gears.output))]


def pairs(gears: Gears, idler: int) -> list[GearPair]:
    """Both pairs, a ring as the second gear of its pair.

    Parameters
        gears : Gears - the section of the file
        idler : int - teeth of the idler
    """
    with at_key("gears"):
        return train_pairs(gears, _places(gears, idler), gears.module, gears.pressure_angle)


def data(gears: Gears, idler: int) -> dict[str, GearData]:
    """The meshes by name with all that their drawing needs; parameters as of `pairs`."""
    found = zip(_places(gears, idler), pairs(gears, idler), strict=True)
    with at_key("gears"):
        return {mesh: train_data(gears, place, pair) for mesh, (place, pair) in zip(MESHES, found, strict=True)}


def drawings(found: Mapping[str, GearData]) -> Table:
    """The gear tables of the meshes, one below the other."""
    tables = {mesh: drawing_table(data) for mesh, data in found.items()}
    names = [mesh for mesh, table in tables.items() for _ in range(table.length)]
    one, *_ = tables.values()
    columns = [[value for table in tables.values() for value in table.data[i]] for i in range(len(one.columns))]
    return Table("drawing", ("mesh", *one.columns), ("", *one.units), (names, *columns))


def drawing_checks(name: str, found: Mapping[str, GearData], spec: ThreeGearSpec) -> list[Check]:
    """The findings of one of TRAIN_CHECKS; fillets are judged where the file gives their tool."""
    if name == "fillet-interference" and spec.gears.tool is None:
        return []
    limits: Any = spec.limits  # the two checks read no strength
    return [
        replace(check, message=f"{mesh.replace('_', '-')} mesh: {check.message}")
        for mesh, data in found.items()
        for check in drawing_check(name, data, limits)
    ]
