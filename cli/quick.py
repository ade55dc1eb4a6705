"""Plain command lines of the design commands, read without Typer, whose import alone takes longer than most designs.

Only what is certain is taken: a design command, one design file, options spelled out with proper values. For all
else `plain_line` gives None and Typer reads the line, so that help, abbreviations and every error are its own.
A test holds the two readings to the same result.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeAlias

from gearlink.cli.options import Format, Options, PlotFormat

DESIGN_COMMANDS = frozenset({"analyze", "gear", "crank", "press", "gripper", "swing", "cam"})
SYNTH_COMMANDS = frozenset({"dwell", "back-step", "variable-speed", "momentary-dwell"})
MOST_SAMPLES = 10_000_000
"""Rows of a table at most; the least are 2."""

Line: TypeAlias = tuple[str, str, Options]
"""Command, design file, options."""

_FLAGS = {"--plot": ("plot", True), "--strict": ("strict", True), "--profile": ("profile", True)} | {
    "--no-color": ("color", False),
    "--quiet": ("quiet", True),
    "-q": ("quiet", True),
}


def _samples(text: str) -> int:
    number = int(text) if text.isascii() and text.isdecimal() else 0
    if not 2 <= number <= MOST_SAMPLES:
        raise ValueError(text)
    return number


_VALUES: dict[str, tuple[str, Callable[[str], Any]]] = {
    "--format": ("format", Format),
    "-f": ("format", Format),
    "--plot-format": ("plot_format", PlotFormat),
    "--out": ("out", Path),
    "--samples": ("samples", _samples),
}
_LISTS = {"--set": "overrides", "--quantity": "quantities", "--table": "tables"}


def plain_line(arguments: list[str]) -> Line | None:
    """Command, design file and options of a plain command line; None where Typer has to read it.

    Example
        >>> command, source, options = plain_line(["press", "ty460.yaml", "-f", "json"])
        >>> command, source, options.format.value
        ('press', 'ty460.yaml', 'json')
        >>> plain_line(["press", "--help"]) is None
        True
    """
    command, rest = _command(arguments)
    if not command:
        return None
    try:
        sources, chosen = _read(iter(rest))
    except (LookupError, ValueError, StopIteration):
        return None
    return (command, sources[0], Options(**chosen)) if len(sources) == 1 else None


def _command(arguments: list[str]) -> tuple[str, list[str]]:
    if arguments[:1] == ["synth"] and len(arguments) > 1 and arguments[1] in SYNTH_COMMANDS:
        return f"synth {arguments[1]}", arguments[2:]
    if arguments and arguments[0] in DESIGN_COMMANDS:
        return arguments[0], arguments[1:]
    return "", []


def _read(rest: Iterator[str]) -> tuple[list[str], dict[str, Any]]:
    """Positional arguments and chosen options; raises where an argument is not plain."""
    sources: list[str] = []
    chosen: dict[str, Any] = {}
    for argument in rest:
        if argument in _FLAGS:
            name, value = _FLAGS[argument]
            chosen[name] = value
        elif argument == "-" or not argument.startswith("-"):
            sources.append(argument)
        else:
            _value(argument, rest, chosen)
    return sources, chosen


def _value(argument: str, rest: Iterator[str], chosen: dict[str, Any]) -> None:
    option, sign, text = argument.partition("=") if argument.startswith("--") else (argument, "", "")
    if not sign:
        text = next(rest)
    if not text or text.startswith("-"):
        raise ValueError(text)
    if option in _LISTS:
        chosen[_LISTS[option]] = (*chosen.get(_LISTS[option], ()), text)
    else:
        name, read = _VALUES[option]
        chosen[name] = read(text)
