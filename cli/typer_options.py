"""The shared options as parameters that Typer reads."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import wraps
from importlib import import_module
from inspect import Parameter, signature
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.models import OptionInfo

from gearlink.cli.options import OPTIONS, Keyed, Options, digits, file, folder, plain_file

Spec = Annotated[str, typer.Argument(metavar="SPEC", help="design file, or - for standard input")]
Jobs = Annotated[int, typer.Option("--jobs", "-j", min=0, help="number of processes; 0: chosen automatically")]
Dask = Annotated[str, typer.Option("--dask", metavar="ADDRESS", help="compute on the Dask cluster of this scheduler")]


def option(name: str, **changed: Any) -> OptionInfo:
    """Typer's form of a shared option, with whatever a command changes in it.

    Example
        >>> option("samples", help="rows of the table", most=1000).max
        1000
    """
    shared = OPTIONS[name]._replace(**changed)
    if shared.type in READ:
        return place(shared.type, *shared.flags, help=shared.help, metavar=shared.metavar)
    info: OptionInfo = typer.Option(
        *shared.flags,
        help=shared.help,
        metavar=shared.metavar,
        min=shared.least,
        max=shared.most,
        autocompletion=offers(shared.offers) if shared.offers else None,
    )
    return info


READ: dict[Callable[[str], Any], Any] = {file: Path, folder: Path, plain_file: Path, digits: object}
"""What reads a value and says what is wrong with it, and what it gives."""


def place(kind: Callable[[str], Any], *flags: str, help: str, metavar: str | None) -> OptionInfo:
    """An option whose value a function reads, such as a place to write to, with the reason where it can be none."""

    def read(text: str) -> Any:
        try:
            return kind(text)
        except ValueError as error:
            raise typer.BadParameter(str(error)) from None

    info: OptionInfo = typer.Option(*flags, help=help, metavar=metavar, parser=read)
    return info


def offers(name: str) -> Callable[[str], list[tuple[str, str]]]:
    """What a shell is offered on Tab, by a function of `gearlink.cli.completing`, which is loaded when one asks."""

    def found(incomplete: str) -> list[tuple[str, str]]:
        completing = import_module("gearlink.cli.completing")  # which knows the commands that use these options
        offer: list[tuple[str, str]] = completing.offered(name, incomplete)
        return offer

    return found


def share(text: str) -> tuple[int, int]:
    """The share I of N that --shard names, counted from 1."""
    index, _, count = text.partition("/")
    if text.isascii() and index.isdecimal() and count.isdecimal() and 1 <= int(index) <= int(count):
        return int(index), int(count)
    raise typer.BadParameter(f"{text!r} is not I/N with 1 <= I <= N", param_hint="--shard")


def keyed(options: Options, section: str, keys: Mapping[str, bool | float | str | None]) -> Options:
    """Options with the keys of a section set that other options name, those that were given.

    Parameters
        keys : values by option; the key is called as its option
    """
    given = (
        Keyed(flag, f"{section}.{flag.removeprefix('--')}", value) for flag, value in keys.items() if value is not None
    )
    return options._replace(overrides=(*options.overrides, *given))


def takes(*names: str, **words: str) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Give a command the named shared options, collected in its parameter `options`.

    Parameters
        names : fields of `Options`
        words : help texts of options for which this command has its own
    """

    def decorated(command: Callable[..., None]) -> Callable[..., None]:
        @wraps(command)
        def run(**given: Any) -> None:
            chosen = {name: _value(name, given.pop(name)) for name in names}
            command(**given, options=Options(**chosen))

        whole = signature(command, eval_str=True)
        own = [each for each in whole.parameters.values() if each.name != "options"]
        shared = [_parameter(name, words.get(name, OPTIONS[name].help)) for name in names]
        run.__signature__ = whole.replace(parameters=[*own, *shared])  # type: ignore[attr-defined]
        return run

    return decorated


def _parameter(name: str, words: str) -> Parameter:
    kind: Any = READ.get(OPTIONS[name].type, OPTIONS[name].type)
    default = _value(name, getattr(Options(), name))
    if OPTIONS[name].repeatable:
        kind, default = list[kind], []
    elif default is None:
        kind = kind | None
    annotation = Annotated[kind, option(name, help=words)]
    return Parameter(name, Parameter.KEYWORD_ONLY, default=default, annotation=annotation)


def _value(name: str, given: Any) -> Any:
    """What `Options` keeps of a value that Typer gives, and the other way round."""
    if not OPTIONS[name].stands_for:
        return not given
    return tuple(given) if isinstance(given, list) else given
