"""What the user asks of an export; light, for the command tree imports it."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

from gearlink.cli.options import Options

if TYPE_CHECKING:
    from gearlink.core.base.kind import Kind

LEAST_TOLERANCE = 1e-5
MOST_TOLERANCE = 10.0
DEFAULT_TOLERANCE = 0.001


CONTOUR = "blocking_contour"
"""As --part takes the blocking contour of a gear pair, which is no profile: as svg or csv."""
PATH = "PATH-"
"""Begins the name of the path of a point of a link, which can be asked for of all that moves."""


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


_TOGETHER = {"groove_inner": "groove", "groove_outer": "groove"}
"""Parts that one drawing shows: both walls of a groove."""


def drawing_of(kind: Kind, part: str, cams: Collection[str] = ()) -> str:
    """Name of the workshop drawing of a part; empty for what is not cut, and for disc cams, drawn with their followers.

    Parameters
        cams : names of the disc cams of a file that names them
    """
    followed = ("main_cam", "return_cam", *cams) if "drawing" in kind.sheets else ()
    if not kind.cut or part == CONTOUR or part.startswith(PATH) or part in followed:
        return ""
    return _TOGETHER.get(part, part)


@dataclass(frozen=True, slots=True)
class Export:
    """What the user asked for besides the design file."""

    formats: tuple[FileFormat, ...]
    parts: tuple[str, ...]
    tolerance: float
    curve: CurveForm
    options: Options
    width: float | None = None
