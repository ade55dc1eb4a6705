"""Commands around the design files: new, schema, explain, check, diff; and verify.

Each imports what it runs when it runs.
"""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from gearlink.cli.options import Format, Options, file, folder
from gearlink.cli.typer_options import offers, option, place, takes
from gearlink.core.base.kinds import FILES


class PageFormat(StrEnum):
    """How text is printed that is no table of numbers."""

    TABLE = "table"
    JSON = "json"
    MARKDOWN = "md"


PageOption = Annotated[PageFormat, option("format", help="how the answer is printed")]


def register(app: typer.Typer) -> None:
    """Add the commands of this module to the command tree."""
    for name, command in (
        ("check", _check),
        ("diff", _diff),
        ("new", _new),
        ("schema", _schema),
        ("explain", _explain),
        ("verify", _verify),
    ):
        app.command(name)(command)


@takes("quiet")
def _new(
    options: Options,
    kind: Annotated[
        str,
        typer.Argument(metavar="KIND", help="kind of design; default: list the kinds", autocompletion=offers("kinds")),
    ] = "",
    out: Annotated[
        Path | None, option("out", type=file, metavar="FILE", help="file to write; default, and -: the screen")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="overwrite the file")] = False,
) -> None:
    from gearlink.cli.commands.new import run_new

    raise typer.Exit(run_new(kind, out, force=force, quiet=options.quiet))


_new.__doc__ = f"""Write a commented example of a design file, ready to run and to change; without KIND, list the kinds.

    Kinds: {", ".join(FILES)}.

    Example: gearlink new gear-pair --out pair.yaml
    """


def _schema(
    kind: Annotated[
        str | None,
        typer.Argument(metavar="KIND", help="kind of design; default: all kinds", autocompletion=offers("kinds")),
    ] = None,
    write: Annotated[
        Path | None, place(folder, "--write", metavar="DIR", help="write it there, with settings for VS Code")
    ] = None,
) -> None:
    """JSON Schema (draft-07) of the design files, for editors that check and complete while you type.

    With --write DIR the editor knows design files by their name: DIR gets gearlink.schema.json, and, where there is
    none, .vscode/settings.json, which names the schema for designs/**/*.yaml and *.gearlink.yaml. Without it, give the
    schema's name in the first line of a design: `# yaml-language-server: $schema=gear-pair.schema.json`.

    Example: gearlink schema --write .
    """
    from gearlink.cli.commands.schema import run_schema, write_schema

    raise typer.Exit(run_schema(kind) if write is None else write_schema(kind, write))


def _explain(
    name: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="NAME",
            help="term, code, check, quantity, symbol, key, column, kind or law; (4-26) or figure 2-4 of a source",
            autocompletion=offers("explained"),
        ),
    ] = None,
    format: PageOption = PageFormat.TABLE,
) -> None:
    """Explain a term of the field, a code, check, quantity, symbol, key, column, kind or motion law.

    Terms are known in English, German and Chinese; without NAME, list the codes.

    Example: gearlink explain transmission angle
    """
    from gearlink.cli.commands.explain import run_explain

    raise typer.Exit(run_explain(" ".join(name) if name else None, Format(format.value)))


@takes("format", "overrides", "strict", "quiet")
def _check(
    places: Annotated[list[str], typer.Argument(metavar="SPEC|DIR", help="design files, folders, or -")],
    options: Options,
    verbose: Annotated[bool, typer.Option("--verbose", "-v", help="show passed checks as well")] = False,
) -> None:
    """Run only the checks of designs; each finding is shown with its line in the design file.

    Example: gearlink check designs --strict
    """
    from gearlink.cli.commands.check import run_check

    raise typer.Exit(run_check(places, options, verbose=verbose))


@takes("digits", "color", digits="significant digits of values, or full; default: 9")
def _diff(
    old: Annotated[str, typer.Argument(metavar="OLD", help="design file, or result written with --format json")],
    new: Annotated[str, typer.Argument(metavar="NEW", help="the same sort of file")],
    options: Options,
    format: PageOption = PageFormat.TABLE,
    tolerance: Annotated[
        float,
        typer.Option(
            min=0.0,
            help="inputs are equal within this times their magnitude, results within this times max(1, magnitude)",
        ),
    ] = 1e-9,
) -> None:
    """Compare two designs or two results: inputs, quantities, checks. Exit status 0: equal, 1: different.

    Example: gearlink diff press.yaml press-new.yaml --tolerance 1e-6
    """
    from gearlink.cli.commands.diff import run_diff

    raise typer.Exit(run_diff(old, new, options._replace(format=Format(format.value)), tolerance))


@takes("format", "color", "quiet")
def _verify(
    options: Options,
    prefixes: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="CASE-PREFIX", help="cases that begin so; default: all", autocompletion=offers("published_cases")
        ),
    ] = None,
    everything: Annotated[bool, typer.Option("--all", help="show every number, not a line for each case")] = False,
) -> None:
    """Compute published cases with this installation and compare each number with its source.

    Books, standards and reports, kept with the program. Exit status 0: every number is met, 1: one is not.

    Example: gearlink verify khurmi
    """
    from gearlink.cli.commands.verify import run_verify

    raise typer.Exit(run_verify(prefixes or (), options, everything=everything))
