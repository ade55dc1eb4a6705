"""Commands around the design files: new, schema, explain, check, diff. Each imports what it runs when it runs."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from gearlink.cli.options import Format, Options


class PageFormat(StrEnum):
    """How text is printed that is no table of numbers."""

    TABLE = "table"
    JSON = "json"
    MARKDOWN = "md"


KindArgument = Annotated[str, typer.Argument(metavar="KIND", help="kind of design, such as gear-pair")]
FormatOption = Annotated[Format, typer.Option("--format", "-f", help="how findings are printed")]
PageOption = Annotated[PageFormat, typer.Option("--format", "-f", help="how the answer is printed")]
NoColorOption = Annotated[bool, typer.Option("--no-color", help="no colours, as with NO_COLOR=1")]
QuietOption = Annotated[bool, typer.Option("--quiet", "-q", help="print no notes on standard error")]


def register(app: typer.Typer) -> None:
    """Add the commands of this module to the command tree."""
    for name, command in (
        ("check", _check),
        ("diff", _diff),
        ("new", _new),
        ("schema", _schema),
        ("explain", _explain),
    ):
        app.command(name)(command)


def _new(
    kind: KindArgument,
    out: Annotated[Path | None, typer.Option("--out", metavar="FILE", help="write it there, not to the screen")] = None,
    force: Annotated[bool, typer.Option("--force", help="overwrite the file")] = False,
    quiet: QuietOption = False,
) -> None:
    """A commented design file of a kind that runs as it stands, to begin from.

    Example: gearlink new gear-pair --out pair.yaml
    """
    from gearlink.cli.commands.new import run_new

    raise typer.Exit(run_new(kind, out, force=force, quiet=quiet))


def _schema(
    kind: Annotated[str | None, typer.Argument(metavar="KIND", help="kind of design; left out: all kinds")] = None,
) -> None:
    """JSON Schema (draft-07) of the design files, for editors that check and complete while you type.

    Name it in the first line of the design: `# yaml-language-server: $schema=gear-pair.schema.json`.

    Example: gearlink schema gear-pair > gear-pair.schema.json
    """
    from gearlink.cli.commands.schema import run_schema

    raise typer.Exit(run_schema(kind))


def _explain(
    name: Annotated[str | None, typer.Argument(metavar="NAME", help="code, check, quantity, kind or law")] = None,
    format: PageOption = PageFormat.TABLE,
) -> None:
    """What a code, a check, a quantity, a kind of design or a law of motion means; without NAME the list of codes.

    Example: gearlink explain GL301
    """
    from gearlink.cli.commands.explain import run_explain

    raise typer.Exit(run_explain(name, Format(format.value)))


def _check(
    places: Annotated[list[str], typer.Argument(metavar="SPEC|DIR", help="design files, folders, or -")],
    format: FormatOption = Format.TABLE,
    verbose: Annotated[bool, typer.Option("--verbose", "-v", help="show passed checks as well")] = False,
    set_: Annotated[list[str], typer.Option("--set", metavar="PATH=VALUE", help="override a key (repeatable)")] = [],  # noqa: B006
    strict: Annotated[bool, typer.Option("--strict", help="a warning counts as a failure")] = False,
    quiet: QuietOption = False,
) -> None:
    """Reads, validates and runs the checks alone; each finding with its line in the design file.

    Example: gearlink check designs --strict
    """
    from gearlink.cli.commands.check import run_check

    options = Options(format=format, overrides=tuple(set_), strict=strict, quiet=quiet)
    raise typer.Exit(run_check(places, options, verbose=verbose))


def _diff(
    old: Annotated[str, typer.Argument(metavar="OLD", help="design file, or result written with --format json")],
    new: Annotated[str, typer.Argument(metavar="NEW", help="the same sort of file")],
    format: PageOption = PageFormat.TABLE,
    tolerance: Annotated[
        float, typer.Option(min=0.0, help="numbers are equal within this times max(1, magnitude)")
    ] = 1e-9,
    no_color: NoColorOption = False,
) -> None:
    """What changed between two designs or two results: inputs, quantities, checks. Exit 0 equal, 1 different.

    Example: gearlink diff press.yaml press-new.yaml --tolerance 1e-6
    """
    from gearlink.cli.commands.diff import run_diff

    raise typer.Exit(run_diff(old, new, Options(format=Format(format.value), color=not no_color), tolerance))
