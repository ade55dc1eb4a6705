"""Plain command lines of the commands that are used most, read without Typer, whose import takes longer than most.

Only what is certain is taken: a design command, `report` or `animate`, one design file, options spelled out with proper
values; and `batch`, `check`, `explain`, `explore`, `new`, `schema`, `sheet` and `verify` without options.
For all else `plain_line` gives None and Typer reads the line, so that help, abbreviations and every error are its own.
A test holds the two readings to the same result.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, TypeAlias

from gearlink.cli.options import COMMANDS, OF_ANIMATE, OF_REPORT, OPTIONS, Format, Option, Options

Line: TypeAlias = tuple[str, str, Options]
"""Command, design file, options."""
Words: TypeAlias = tuple[str, ...]

_OWN = {"report": OF_REPORT, "animate": OF_ANIMATE}
"""The options of other commands on a design file."""
_BY_FLAG = {flag: name for name, option in OPTIONS.items() for flag in option.flags}


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
    if not chosen.keys() <= set(_OWN.get(command, chosen)):
        return None
    return (command, sources[0], Options(**chosen)) if len(sources) == 1 else None


def plain_reference(arguments: list[str]) -> tuple[str, ...] | None:
    """Command and words of a plain line of a command without options; None where Typer reads it.

    Example
        >>> plain_reference(["explain", "GL301"])
        ('explain', 'GL301')
        >>> plain_reference(["new", "gear-pair", "--out", "pair.yaml"]) is None
        True
    """
    command, *words = arguments or [""]
    if command not in _PLAIN or any(not word or word.startswith("-") for word in words):
        return None
    _, fewest, most = _PLAIN[command]
    return (command, *words) if fewest <= len(words) <= most else None


def run_reference(command: str, *words: str) -> int:
    """Run one of these commands without options, and give the exit status."""
    run, _, _ = _PLAIN[command]
    return run(words)


def _batch(words: Words) -> int:
    from gearlink.cli.batch.options import BatchOptions
    from gearlink.cli.batch.run import run_batch

    return run_batch(words, BatchOptions())


def _check(words: Words) -> int:
    from gearlink.cli.commands.check import run_check

    return run_check(words, Options())


def _explain(words: Words) -> int:
    from gearlink.cli.commands.explain import run_explain

    return run_explain(" ".join(words), Format.TABLE)


def _explore(words: Words) -> int:
    from gearlink.cli.exploring.options import Exploring
    from gearlink.cli.exploring.run import run_explore

    return run_explore(Exploring(Options(), words[0]))


def _new(words: Words) -> int:
    from gearlink.cli.commands.new import run_new

    return run_new(words[0], None)


def _schema(words: Words) -> int:
    from gearlink.cli.commands.schema import run_schema

    return run_schema(words[0])


def _sheet(words: Words) -> int:
    from gearlink.cli.commands.sheet import Asked, run_sheet

    return run_sheet(words[0], list(words[1:]), Options(), Asked())


def _verify(words: Words) -> int:
    from gearlink.cli.commands.verify import run_verify

    return run_verify(words, Options())


_PLAIN: dict[str, tuple[Callable[[Words], int], int, float]] = {
    "batch": (_batch, 1, math.inf),
    "check": (_check, 1, math.inf),
    "explain": (_explain, 1, math.inf),
    "explore": (_explore, 1, 1),
    "new": (_new, 1, 1),
    "schema": (_schema, 1, 1),
    "sheet": (_sheet, 1, math.inf),
    "verify": (_verify, 0, math.inf),
}
"""Commands without options: what runs them, the fewest and the most words."""


def run_line(command: str, source: str, options: Options) -> int:
    """Run a command on a design file as the options ask, and give the exit status."""
    if command == "report":
        from gearlink.cli.commands.report import run_report

        return run_report(source, options)
    if command == "animate":
        from gearlink.cli.commands.animate import Asked, run_animate

        return run_animate(source, Asked(), options)
    if options.suggest:
        from gearlink.cli.commands.suggest import run_suggested

        return run_suggested(command, source, options)
    from gearlink.cli.commands.design import run_design

    return run_design(command, source, options)


def _command(arguments: list[str]) -> tuple[str, list[str]]:
    words = 2 if arguments[:1] == ["synth"] else 1
    command = " ".join(arguments[:words])
    return (command, arguments[words:]) if command in COMMANDS or command in _OWN else ("", [])


def _read(rest: Iterator[str]) -> tuple[list[str], dict[str, Any]]:
    """Positional arguments and chosen options; raises where an argument is not plain."""
    sources: list[str] = []
    chosen: dict[str, Any] = {}
    for argument in rest:
        if argument == "-" or not argument.startswith("-"):
            sources.append(argument)
            continue
        flag, sign, text = argument.partition("=") if argument.startswith("--") else (argument, "", "")
        name = _BY_FLAG[flag]
        option = OPTIONS[name]
        if option.type is not bool:
            value = _value(option, text if sign else next(rest))
            chosen[name] = (*chosen.get(name, ()), value) if option.repeatable else value
        elif sign:
            raise ValueError(argument)
        else:
            chosen[name] = option.stands_for
    return sources, chosen


def _value(option: Option, text: str) -> Any:
    """The value of an option; raises where it is not plain."""
    if not text or text.startswith("-"):
        raise ValueError(text)
    if option.least is None or option.most is None:
        return option.type(text)
    if option.type is float:
        if not option.least <= float(text) <= option.most:
            raise ValueError(text)
        return float(text)
    if not (text.isascii() and text.isdecimal() and option.least <= int(text) <= option.most):
        raise ValueError(text)
    return int(text)
