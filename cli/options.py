"""The options that the design commands share."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path


class Format(StrEnum):
    """How results are printed."""

    TABLE = "table"
    JSON = "json"
    CSV = "csv"
    MARKDOWN = "md"


class PlotFormat(StrEnum):
    """How plots are written."""

    PNG = "png"
    SVG = "svg"
    PDF = "pdf"


@dataclass(frozen=True, slots=True)
class Options:
    """What the user asked for besides the command and the design file."""

    format: Format = Format.TABLE
    plot: bool = False
    plot_format: PlotFormat = PlotFormat.PNG
    out: Path = field(default_factory=Path)
    overrides: tuple[str, ...] = ()
    quantities: tuple[str, ...] = ()
    tables: tuple[str, ...] = ()
    samples: int | None = None
    strict: bool = False
    color: bool = True
    quiet: bool = False
    profile: bool = False
