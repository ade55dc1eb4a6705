"""The table `contact` of rollers on cams."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.core.base.report import Table

if TYPE_CHECKING:
    from gearlink.core.studies.loads.cams.design import CamLoadsDesign

_RPM = 2.0 * math.pi / 60.0


def contact(design: CamLoadsDesign, samples: int | None = None) -> Table:
    """Force, pressure, relative radius, roller speed and entrainment of each roller over the input angle."""
    import numpy as np

    from gearlink.core.numerics.arrays import turn_degrees

    degrees = turn_degrees(samples, design.turns)
    phi = np.radians(degrees)
    columns: dict[str, tuple[Any, str]] = {"cam_angle": (design.cam_degrees(phi), "deg")}
    for i, name in enumerate(design.own_rollers):
        roller, line = design.roller_on_cam(name, phi), design.contact(name, phi)
        none = np.full_like(phi, math.nan)
        later = "" if i == 0 else f"{name}_"
        columns |= {
            f"{name}_force": (design.contact_force(name, phi), "N"),
            f"{name}_pressure": (none if line is None else line.pressure, "N/mm^2"),
            f"{name}_radius": (roller.relative_radius, "mm"),
            f"{later}roller_speed": (design.roller_speed(name, phi) / _RPM, "1/min"),
            f"{later}entrainment": (design.entrainment(name, phi), "mm/s"),
        }
    return Table.of("contact", columns)
