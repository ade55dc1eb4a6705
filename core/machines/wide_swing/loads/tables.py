"""Tables of the loads of a wide-swing mechanism: by k over the stroke, by cam angle over a whole turn."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.report import Table
from gearlink.core.studies.loads import tables

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.loads.design import WideSwingLoads
    from gearlink.core.numerics.arrays import Reals

_STEPS = 100


def rows(design: WideSwingLoads, samples: int | None) -> tuple[Reals, dict[str, tuple[Any, str]]]:
    """Input angles of a table's rows [rad], and its first columns; k over the stroke where the file has no cycle."""
    import numpy as np

    from gearlink.core.studies.loads.design import LoadsDesign

    if design.whole:
        return LoadsDesign.rows(design, samples)
    k = np.arange((samples or _STEPS) + 1) / (samples or _STEPS)
    phi = k * design.cam.cycle_angle
    return phi, {"k": (k, "1"), "input_angle": (np.degrees(phi), "deg")}


def contact_stroke(design: WideSwingLoads, samples: int | None = None) -> Table:
    """Force, pressure and speeds of the roller over each stroke; empty where it touches nothing."""
    import numpy as np

    k = np.arange((samples or _STEPS) + 1) / (samples or _STEPS)
    columns: dict[str, tuple[Any, str]] = {"k": (k, "1")}
    for stroke in design.strokes:
        later = "" if stroke.name == "main" else "return_"
        found = stroke.columns(k)
        columns[f"{later}cam_angle"] = (np.degrees(stroke.angle(k)), "deg")
        columns |= {f"{stroke.name}_{name}": found[name] for name in ("force", "pressure", "radius")}
        columns |= {f"{later}{name}": found[name] for name in ("roller_speed", "entrainment")}
        torque = np.full_like(k, np.nan) if design.locked else design.machine.torque(stroke.angle(k))
        columns[f"{later}input_torque"] = (torque, "N m")
    return Table.of("contact_stroke", columns)


def harmonics(design: WideSwingLoads, samples: int | None = None) -> Table:
    """Harmonics of the rocker's motion over a whole turn."""
    if not design.whole:
        if design.spec.slider is not None:
            raise NoSolution("harmonics are those of a whole turn, and here the stroke alone is known", key="loads")
        message = "harmonics are those of a whole turn: give cycle in place of cycle_angle"
        raise MissingSection(message, key="cycle_angle")
    return tables.harmonics(design, samples)
