"""Pages that the program gives: a page for each check and each kind, the commands, the gallery, Python's names."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import yaml

from docs.manual import runs, tables
from docs.manual.runs import ROOT
from gearlink.cli.texts import schema
from gearlink.cli.texts.codes import explanations
from gearlink.core.base.kinds import FILES
from gearlink.core.base.report import Rule

DESIGNS = sorted((ROOT / "designs").glob("*.yaml"))
FAILING: dict[str, str] = yaml.safe_load((Path(__file__).parent / "failing.yaml").read_text(encoding="utf-8"))
"""For each code a command in which its check fails or warns: `check designs/x.yaml --set key=value`."""

API = {
    "Open, change, draw": ["gearlink.load", "gearlink.design", "gearlink.changed", "gearlink.figure"],
    "Designs": ["gearlink.core.base.design.Design"],
    "Reports": [f"gearlink.core.base.report.{name}" for name in ("Report", "Quantity", "Table", "Check")],
    "Errors": ["gearlink.GearlinkError", "gearlink.NoSolution"],
    "Linkages": ["gearlink.core.parts.linkages.FourBar"],
    "Gears": ["gearlink.core.parts.gears.GearPair"],
}
"""Names of the page of the Python interface; of classes their public methods too."""


def commands() -> Iterator[tuple[str, bool]]:
    """What these pages run, each with whether its picture is wanted."""
    yield from ((f"gearlink {command}", False) for command in FAILING.values())
    yield from ((f"{drawn(path)} --plot --quiet", True) for path in DESIGNS)
    yield from ((f"gearlink {name} --help", False) for name in names_of_commands())
    yield from ((f"gearlink new {kind}", False) for kind in FILES)


def names_of_commands() -> list[str]:
    """Every command, those of a group with its name."""
    import typer

    from gearlink.cli.app import app

    found = typer.main.get_command(app)
    names = []
    for name, command in found.commands.items():  # type: ignore[attr-defined]
        below = getattr(command, "commands", {})
        names += [f"{name} {each}" for each in below] or [name]
    return names


def kind_of(path: Path) -> str:
    """The kind of a design file."""
    found = re.search(r"^kind:\s*([\w-]+)", path.read_text(encoding="utf-8"), re.MULTILINE)
    return found[1] if found else ""


def drawn(path: Path) -> str:
    """The command that draws a design: the first that its file asks for."""
    import gearlink

    first = gearlink.load(path).spec.commands()[0]
    return f"gearlink {first} designs/{path.name}"


def targets() -> set[str]:
    """Names of the generated pages."""
    fixed = {"gallery.md", "api.md", "checks/index.md", "reference/index.md", "reference/commands.md"}
    return fixed | {f"checks/{code}.md" for code in explanations()} | {f"reference/{kind}.md" for kind in FILES}


def pages() -> Iterator[tuple[str, str]]:
    """Name and text of every generated page; texts have the blocks of a page."""
    yield "gallery.md", _gallery()
    yield "checks/index.md", _check_list()
    yield from ((f"checks/{code}.md", _check(rule)) for code, rule in explanations().items())
    yield from ((f"reference/{kind}.md", _kind(kind)) for kind in FILES)
    yield "reference/index.md", _kind_list()
    yield "reference/commands.md", _commands()
    yield "api.md", _api()


def _gallery() -> str:
    parts = [
        "# Gallery\n\nEvery design of the repository, with its figure, its file and the command "
        "that draws it. Installed, the files are in the package `gearlink.designs`; `gearlink new KIND` writes the "
        "first of a kind.\n"
    ]
    for kind in FILES:
        own = [path for path in DESIGNS if kind_of(path) == kind]
        if not own:
            continue
        parts.append(f"## {kind}\n\n{FILES[kind].summary}. [How it works](kinds/{kind}.md)\n")
        for path in own:
            text = path.read_text(encoding="utf-8").rstrip()
            parts.append(f"### {path.stem}\n\n```figure\n$ {drawn(path)} --plot --quiet\n```\n")
            parts.append(f'??? example "designs/{path.name}"\n\n    ```yaml\n' + _indented(text) + "\n    ```\n")
    return "\n".join(parts)


def _indented(text: str) -> str:
    return "\n".join(f"    {line}" if line else "" for line in text.split("\n"))


def _check_list() -> str:
    rows = [
        f"| [{code}]({code}.md) | {', '.join(f'`{name}`' for name in rule.checks)} | {tables.cell(rule.title)} |"
        for code, rule in explanations().items()
    ]
    head = (
        "# Checks and errors\n\nGL1xx: design files, studies, tolerances. GL2xx: gears. GL3xx: linkages and "
        "drives. GL4xx: cams. GL5xx: presses, grippers, wide swings, machines. GL6xx: loads.\n\n"
        "| code | check | finding |\n| --- | --- | --- |\n"
    )
    return head + "\n".join(rows) + "\n"


def _check(rule: Rule) -> str:
    lines = [
        f"# {rule.code} {rule.name if rule.checks else rule.title}\n",
        f"**{rule.title}**\n" if rule.checks else "",
    ]
    lines += [f"**What.** {rule.what}\n", f"**Why.** {rule.why}\n"]
    lines += [f"**Limit.** `{rule.formula}`\n"] if rule.formula else []
    lines += [f"**How to repair.** {rule.remedy}\n"]
    lines += [f"**Keys.** {', '.join(f'`{key}`' for key in rule.keys)}\n"] if rule.keys else []
    kinds = sorted({kind for name in rule.checks for kind in schema.index().checks.get(name, ())})
    lines += [f"**Kinds.** {', '.join(f'[{kind}](../kinds/{kind}.md)' for kind in kinds)}\n"] if kinds else []
    lines += [f"**Source.** {rule.source}\n"] if rule.source else []
    if rule.code in FAILING:
        command = FAILING[rule.code]
        file = re.search(r"designs/(\w+)\.yaml", command)
        shown = f"[{file[1]}](../gallery.md#{file[1]})" if file and (ROOT / file[0]).exists() else "a design"
        what = "This check does not pass for" if rule.checks else "This is reported of"
        lines += [f"## Example\n\n{what} {shown}, changed as the command says:\n"]
        lines += [f"```console\n$ gearlink {command}\n```\n"]
    return "\n".join(line for line in lines if line)


def _kind_list() -> str:
    rows = [f"| [{kind}]({kind}.md) | {tables.cell(FILES[kind].summary)} |" for kind in FILES]
    head = (
        "# Keys and results of each kind\n\nAll keys with unit, default and range, all checks and all quantities. The "
        "pages below [Kinds](../which_kind.md) explain how a kind works.\n\n| kind | what it is |\n| --- | --- |\n"
    )
    return head + "\n".join(rows) + "\n"


def _kind(kind: str) -> str:
    record = FILES[kind]
    keys = tables.keys_of(kind)
    sections = dict.fromkeys(key.path.partition(".")[0] for key in keys)
    shared = [name for name in tables.SHARED if name in sections]
    what = record.summary[:1].upper() + record.summary[1:]
    text = f"# Reference: {kind}\n\n{what}. [How it works](../kinds/{kind}.md)\n\n"
    text += (
        f"Commands: {', '.join(f'`{command}`' for command in record.commands)}.\n\n## Keys\n\n```keys\n{kind}\n```\n"
    )
    for name in shared:
        text += (
            f"\n### Section {name}\n\nDescribed in [{name}](../{tables.SHARED[name]}).\n\n```keys\n{kind} {name}\n```\n"
        )
    if tables.codes_of(kind):
        text += f"\n## Checks\n\n```checks\n{kind}\n```\n"
    if kind != "study" and (table := tables.quantities(kind)):
        text += f"\n## Quantities\n\nUnits are those of the results.\n\n{table}"
    return text + f"\n## Template\n\n```console\n$ gearlink new {kind}\n```\n"


def _commands() -> str:
    parts = [
        "# Options of every command\n\n[Commands](../commands.md) gives an overview. "
        "This page is what `--help` prints.\n"
    ]
    for name in names_of_commands():
        text = runs.result(f"gearlink {name} --help").text
        parts.append(f"## gearlink {name}\n\n```text\n{text}\n```\n")
    return "\n".join(parts)


# The Python interface, from docstrings


def _api() -> str:
    parts = [
        "# Python interface\n\nMade from the docstrings. [gearlink in Python](python.md) is the introduction. Lengths "
        "in mm, angles in rad, unless a docstring says otherwise.\n"
    ]
    for title, names in API.items():
        parts.append(f"## {title}\n")
        for name in names:
            module, _, last = name.rpartition(".")
            parts += _documented(name if module == "gearlink" else last, getattr(import_module(module), last), module)
    return "\n".join(parts)


def _documented(name: str, thing: Any, module: str) -> Iterator[str]:
    where = "" if module == "gearlink" else f"\n\n`from {module} import {name}`"
    yield f"### {name}{where}\n\n{_signature(name, thing)}\n\n{docstring(inspect.getdoc(thing) or '')}\n"
    if inspect.isclass(thing):
        for own, value in sorted(vars(thing).items()):
            member = value.__func__ if isinstance(value, classmethod | staticmethod) else value
            member = getattr(member, "func", None) or getattr(member, "fget", None) or member
            if own.startswith("_") or not inspect.isfunction(member) or not member.__doc__:
                continue
            shown = (
                f"`{own}`" if not callable(value) and not isinstance(value, classmethod) else _signature(own, member)
            )
            yield f"#### {name}.{own}\n\n{shown}\n\n{docstring(inspect.cleandoc(member.__doc__))}\n"


def _signature(name: str, thing: Any) -> str:
    try:
        parameters = str(inspect.signature(thing))
    except (TypeError, ValueError):
        return f"`{name}`"
    parameters = re.sub(r"(?<![\w.'])'([^']*)'", r"\1", parameters).replace("self, ", "").replace("(self)", "()")
    return f"```python\n{name}{parameters}\n```"


_ENTRY = re.compile(r"[\w.,* ]+ (:|-) ")
_SECTIONS = ("Parameters", "Returns", "Raises", "Example", "Examples", "Fields", "Source", "Yields")


def docstring(text: str) -> str:
    """A docstring of the house as Markdown: its sections as bold headings, parameters as lists, examples as code.

    Example
        >>> print(docstring("A thing.\\n\\nReturns\\n    a number"))
        A thing.
        <BLANKLINE>
        **Returns**
        <BLANKLINE>
        * a number
        <BLANKLINE>
    """
    made: list[str] = []
    section = ""
    for line in text.split("\n"):
        if line in _SECTIONS:
            _close(made, section)
            section = line
            made += [*([""] if made and made[-1] else []), f"**{line}**", ""]
            made += ["```python"] if line.startswith("Example") else []
        elif section and not line.startswith("    ") and line.strip():
            _close(made, section)
            section = ""
            made += ["", line]
        elif section.startswith("Example"):
            made.append(line.removeprefix("    "))
        elif section and line.strip():
            inner = line[4:]
            goes_on = inner.startswith(" ") or (made[-1] and not _ENTRY.match(inner))
            made.append(f"  {inner.strip()}" if goes_on else f"* {_parameter(inner)}")
        else:
            made.append(line)
    _close(made, section)
    return "\n".join(made)


def _close(made: list[str], section: str) -> None:
    while made and not made[-1].strip():
        made.pop()
    if section:
        made += ["```", ""] if section.startswith("Example") else [""]


def _parameter(line: str) -> str:
    names, colon, told = line.partition(" : ")
    return f"`{names}`: {told}" if colon and re.fullmatch(r"[\w, *]+", names) else line
