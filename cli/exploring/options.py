"""What the user asked of `gearlink explore`."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from gearlink.cli.options import Options


@dataclass(frozen=True, slots=True)
class Exploring:
    """Options of the command besides the shared ones.

    Fields
        store : Path or None - where finished chunks are kept
        resume, merge : bool
        jobs : int - processes, 0: chosen by the work to be done
        executor : str - "module:factory"; empty for processes
        dask : str - address of a scheduler; empty for none
        show : str - index of a design, or mK for the nearest miss of row K of the table why; empty for none
        write : Path or None - folder for the kept designs
        shard : (int, int) - I of N, counted from 1
    """

    options: Options
    store: Path | None = None
    resume: bool = False
    merge: bool = False
    jobs: int = 0
    executor: str = ""
    dask: str = ""
    show: str = ""
    write: Path | None = None
    shard: tuple[int, int] = (1, 1)
    sources: tuple[str, ...] = field(default=())
