"""What may stand on a command line: the commands on a design file, and the options that commands share.

One table for both readers of a line: `gearlink.cli.quick` reads plain lines by it, `gearlink.cli.typer_options` makes
Typer's parameters of it.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum
from pathlib import Path
from typing import Any, NamedTuple

from gearlink.core.base.rows import FEWEST_ROWS, MOST_ROWS

STREAM = Path("-")
"""Standard output, where a file is asked for."""


def file(text: str) -> Path:
    """The path of a file to write; `-` is standard output.

    Raises
        ValueError - for an empty one, which a variable of a script leaves that is not set
    """
    if not text:
        raise ValueError("the name is empty\ngive a file")
    path = Path(text)
    return path.absolute() if path == STREAM and text != "-" else path


def plain_file(text: str) -> Path:
    """The path of a file that cannot be a stream.

    Raises
        ValueError - for an empty one, and for `-`
    """
    return _no_stream(file(text), "plain file")


_WRITTEN = (".html", ".pdf", ".png", ".svg", ".gif", ".mp4", ".dxf", ".csv", ".step", ".json", ".xml")
"""Endings of files that commands write: what a folder is hardly called."""


def folder(text: str) -> Path:
    """The path of a folder to write to.

    Raises
        ValueError - for an empty one, for `-`, and for one that is called as a file
    """
    if not text:
        raise ValueError("the name is empty\ngive a folder, . for the current one")
    path = file(text)
    if path.suffix.lower() in _WRITTEN and not path.is_dir():
        above = ". for the current one" if path.parent == Path() else path.parent
        raise ValueError(f"{path} is the name of a file, a folder is required\ngive {above}")
    return _no_stream(path, "folder")


FULL = "full"
"""As digits: as many as a number has."""


def digits(text: str) -> int | str:
    """How many significant digits are shown.

    Raises
        ValueError - for what is neither a number from 1 to 17 nor `full`
    """
    if text == FULL:
        return FULL
    if text.isascii() and text.isdecimal() and 1 <= int(text) <= 17:
        return int(text)
    raise ValueError(f"{text!r} is neither a number of digits from 1 to 17 nor {FULL}")


def _no_stream(path: Path, what: str) -> Path:
    if path == STREAM:
        raise ValueError(f"standard output is not a {what}: for one of that name give ./-")
    return path


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


DPI = 130
"""Pixels per inch of a picture: 1075 across a page."""


class Keyed(NamedTuple):
    """A key that an option of its own sets: what is wrong with it is wrong with the option.

    option : str - such as --at
    path : str - dotted path of the key
    """

    option: str
    path: str
    value: bool | float | str


class Options(NamedTuple):
    """What the user asked for besides the command and the design file."""

    format: Format = Format.TABLE
    plot: bool = False
    plot_format: PlotFormat = PlotFormat.PNG
    dpi: int = DPI
    out: Path = Path()
    overrides: tuple[str | Keyed, ...] = ()
    quantities: tuple[str, ...] = ()
    tables: tuple[str, ...] = ()
    samples: int | None = None
    strict: bool = False
    color: bool = True
    quiet: bool = False
    profile: bool = False
    suggest: bool = False
    save: Path | None = None
    round: float | None = None
    force: bool = False
    candidates: bool = False
    all: bool = False
    digits: int | str | None = None

    @property
    def brief(self) -> bool:
        """Whether the key results are shown, not all."""
        return self.format is Format.TABLE and not self.all


class Option(NamedTuple):
    """An option as it is written: names, type of its value, what --help says of it.

    Parameters
        flags : names, the long one first
        type : makes the value from its text; bool: the option has no value
        metavar : str or None - what stands for the value in --help; None: its type
        minimum, most : bounds of a number
        repeatable : bool - each use adds a value
        stands_for : bool - what an option without a value sets
        offers : str - function of `gearlink.cli.completing` that a shell asks on Tab
    """

    flags: tuple[str, ...]
    help: str
    type: Callable[[str], Any] = bool
    metavar: str | None = None
    least: float | None = None
    most: float | None = None
    repeatable: bool = False
    stands_for: bool = True
    offers: str = ""


OPTIONS = {
    "format": Option(("--format", "-f"), "format of the results", Format),
    "all": Option(("--all",), "show every quantity, table and check, not only the key results"),
    "digits": Option(
        ("--digits",), "significant digits of the table form, or full; default: 0.001 mm, 0.01 deg, else 4", digits, "N"
    ),
    "plot": Option(("--plot",), "write the figure NAME-COMMAND.png"),
    "plot_format": Option(("--plot-format",), "file format of the figure", PlotFormat),
    "dpi": Option(("--dpi",), "pixels per inch of a png", int, least=20, most=1200),
    "out": Option(("--out",), "folder for files that are written", folder, "DIR"),
    "overrides": Option(
        ("--set",), "override a key (repeatable)", str, "PATH=VALUE", repeatable=True, offers="settings"
    ),
    "quantities": Option(
        ("--quantity",), "print only this quantity (repeatable)", str, "NAME", repeatable=True, offers="quantities"
    ),
    "tables": Option(
        ("--table",),
        "add a table; with csv print only this table (repeatable)",
        str,
        "NAME",
        repeatable=True,
        offers="tables",
    ),
    "samples": Option(("--samples",), "rows per revolution or stroke", int, least=FEWEST_ROWS, most=MOST_ROWS),
    "strict": Option(("--strict",), "treat a warning as a failure"),
    "color": Option(("--no-color",), "print without colours, as with NO_COLOR=1", stands_for=False),
    "quiet": Option(("--quiet", "-q"), "print no notes on standard error"),
    "profile": Option(("--profile",), "list on standard error the computed results and their times"),
    "suggest": Option(("--suggest",), "try the recommended changes and show the repaired design"),
    "save": Option(
        ("--save",), "write the complete design with the values found, with --suggest also those changed", file, "FILE"
    ),
    "round": Option(
        ("--round",), "with --save: round the lengths found to this step in mm", float, least=1e-6, most=100
    ),
    "candidates": Option(
        ("--candidates",), "compare designs for the same task (if the file leaves values to be found)"
    ),
    "force": Option(("--force",), "overwrite an existing file with --save"),
}
"""The options that commands share, by the field of `Options` that keeps their value."""

OF_REPORT = ("out", "overrides", "strict", "quiet")
"""Those that `report` has."""
OF_ANIMATE = ("out", "overrides", "quiet")
"""Those that `animate` has, besides its own."""

COMMANDS = {
    "analyze": "Full analysis of a design: kinematics over a revolution, dwells, all checks.",
    "gear": "Gear pairs: a gear-pair design, or the pairs inside a press or a geared linkage.",
    "crank": "Crank length from the stroke of a slider-crank.",
    "press": "Flatbed press: both chains, 12 positions, velocities, synchronous zone.",
    "gripper": "Swing gripper: six-phase law, vector loop, handover, cams, force closure.",
    "swing": "Wide-swing cam mechanism with unloading device: law, sizing, profile, balancing.",
    "cam": "The cams of a design: follower motion, profiles, pressure angle, curvature.",
    "loads": "Torque, joint and tooth forces, flywheel and motor, contact stress, vibration.",
    "synth dwell": "Size the linkage for a dwell over a given crank angle.",
    "synth back-step": "Size the linkage for a back-step.",
    "synth variable-speed": "Size the linkage for an output speed that varies between two values.",
    "synth momentary-dwell": "Size the frame for one momentary standstill per revolution.",
    "synth swing": "Crank-rocker from swing and time ratio, with the best transmission angle.",
    "synth function": "Crank-rocker through three pairs of crank and rocker angle.",
}
"""The commands on one design file and what each does; `gearlink.core.base.kinds` says which kind understands which."""
