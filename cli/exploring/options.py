"""What the user asked of `gearlink explore`."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from gearlink.cli.options import Options


@dataclass(frozen=True, slots=True)
class Exploring:
    """Options of the command besides the shared ones.

    Fields
        source : str - file of the study, or a store
        store : Path or None - where finished chunks are kept
        jobs : int - processes, 0: chosen by the work to be done
        dask : str - address of a scheduler; empty for none
        show : str - index of a design, or mK for the nearest miss of row K of the table why; empty for none
        write : Path or None - folder for the kept designs
    """

    options: Options
    source: str
    store: Path | None = None
    resume: bool = False
    jobs: int = 0
    dask: str = ""
    show: str = ""
    write: Path | None = None
