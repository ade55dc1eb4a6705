"""Writing a design's figure: the figure module of its kind is imported here and nowhere else."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from gearlink.cli.files import safe_stem, write_atomically
from gearlink.cli.options import Options

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gearlink.core.design import Design

_FIXED_METADATA: dict[str, dict[str, Any]] = {
    "png": {"Software": "gearlink"},
    "svg": {"Date": None, "Creator": "gearlink"},
    "pdf": {"CreationDate": None, "Creator": "gearlink"},
}


def draw(command: str, design: Design) -> Figure:
    """The figure of a command on a design, from the module named after the kind."""
    module = import_module("gearlink.cli.plots." + design.kind.replace("-", "_"))
    made: Figure = module.draw(command, design)
    return made


def write_plot(command: str, design: Design, options: Options, *, stem: str = "") -> Path:
    """Draw a design and write STEM-COMMAND.FORMAT into the folder of the options; the stem is its name by default.

    Raises
        CannotWrite - where the folder or the disk does not take the file
        NoSolution - where the figure shows something that the design does not have
    """
    import matplotlib

    ending = options.plot_format.value
    made = draw(command, design)
    path = options.out / f"{stem or safe_stem(design.spec.name)}-{command.replace(' ', '-')}.{ending}"

    def write(stream: IO[bytes]) -> None:
        with matplotlib.rc_context({"svg.hashsalt": "gearlink", "svg.fonttype": "path", "pdf.fonttype": 42}):
            made.savefig(stream, format=ending, metadata=_FIXED_METADATA[ending])

    write_atomically(path, write)
    return path
