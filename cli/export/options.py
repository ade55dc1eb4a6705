"""What the user asks of an export; light, for the command tree imports it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from gearlink.cli.options import Options

LEAST_TOLERANCE = 1e-5
MOST_TOLERANCE = 10.0
DEFAULT_TOLERANCE = 0.001


CONTOUR = "blocking_contour"
"""As --part takes the blocking contour of a gear pair, which is no profile: as svg or csv."""


class FileFormat(StrEnum):
    """What is written."""

    DXF = "dxf"
    SVG = "svg"
    CSV = "csv"
    STEP = "step"
    REXS = "rexs"


class CurveForm(StrEnum):
    """How a curve is written."""

    POLYLINE = "polyline"
    SPLINE = "spline"


@dataclass(frozen=True, slots=True)
class Export:
    """What the user asked for besides the design file."""

    formats: tuple[FileFormat, ...]
    parts: tuple[str, ...]
    tolerance: float
    curve: CurveForm
    options: Options
    width: float | None = None
