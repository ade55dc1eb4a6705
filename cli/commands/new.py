"""`gearlink new`: the example of a kind as a template, with a list of the keys that it leaves out."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator, Mapping, Sequence, Set
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.options import STREAM, Options
from gearlink.cli.printable import visible
from gearlink.cli.texts.schema import SpecKey, index, spec_keys, worked_design
from gearlink.core.base.kinds import FILES, KINDS

if TYPE_CHECKING:
    from gearlink.core.base.kind import Kind


_WARNED = re.compile(r"# GL\d{3}[^:]* warns?: ")
"""A remark of an example on a warning that stands."""


def run_new(kind_name: str, out: Path | None, *, force: bool = False, quiet: bool = False) -> int:
    """Print the template of a kind or write it to a file; give the exit status."""
    from gearlink.cli.commands.schema import kind_named
    from gearlink.cli.files import CannotWrite, require_free, stem_of, write_atomically

    if not kind_name:
        print(list_of_kinds())
        return ExitCode.OK
    kind = kind_named(kind_name)
    if kind is None:
        return ExitCode.WRONG_INPUT
    text = template(kind, "" if out in (None, STREAM) else stem_of(out))
    if out in (None, STREAM):
        sys.stdout.write(text)
        return ExitCode.OK
    try:
        require_free(out, "--out", force=force)
        write_atomically(out, lambda stream: stream.write(text.encode()))
    except CannotWrite as error:
        from gearlink.cli.render.errors import show_refusal

        return show_refusal(error, str(out), Options())
    if not quiet:
        path = visible(str(out))
        print(f"wrote {path}; try: gearlink {index().first_commands[kind.name]} {path}", file=sys.stderr)
    return ExitCode.OK


def list_of_kinds() -> str:
    """Each kind with a few words, and what to do with them."""
    from gearlink.cli.render.lists import hanging, listed

    more = "`gearlink new KIND --out FILE.yaml` writes a design of that kind, ready to run and to change."
    return f"{listed((kind.name, kind.summary) for kind in FILES.values())}\n\n{hanging(more, '')}"


def template(kind: Kind, name: str = "") -> str:
    """The text of a template: the schema's line, the example, and the keys that it leaves out as comments.

    Parameters
        name : what the design is called; empty: it is named after its file
    Raises
        LookupError - for a kind without an example in `gearlink.designs`
    """
    from gearlink.cli.texts.written_design import written

    worked = design = worked_design(kind)
    if kind.name in KINDS:  # under another name, every key with its unit, its meaning and who chooses it
        rest = {key: value for key, value in _read(worked).items() if key not in ("kind", "name")}
        design = written(kind, {"kind": kind.name, **({"name": name} if name else {}), **rest})
    asked = index().first_commands[kind.name]
    head = (
        f"# yaml-language-server: $schema={kind.name}.schema.json\n"
        f"# (for editors that check as you type; make it by: gearlink schema {kind.name} > {kind.name}.schema.json)\n"
        f"# Run it with: gearlink {asked} FILE\n"
        "# A number is in the unit named after it; another unit may be written with the number\n"
    )
    warned = "".join(f"{line}\n" for line in worked.splitlines() if design != worked and _WARNED.match(line))
    return f"{head}{warned}\n" + design.rstrip("\n") + "\n" + _left_out(kind, design)


def _read(text: str) -> Any:
    from gearlink.cli.reading.design_file import parse

    return parse(text.encode(), "template").data


def _left_out(kind: Kind, text: str) -> str:
    """The keys that a design leaves out, as comments; nothing where it uses all."""
    data, keys = _read(text), spec_keys(kind, entries=True)
    of: dict[str, set[str]] = {}
    for key in keys:
        parent, _, name = key.path.rpartition(".")
        of.setdefault(parent, set()).add(name)
    rows: list[tuple[str, str]] = []
    begun = {""}
    for key in keys:
        parent, _, name = key.path.rpartition(".")
        holders = _holders(data, parent)
        there = [each for each in holders if isinstance(each, dict)]
        if any(name in each for each in there) or _is_second(data, parent, of):
            continue
        if parent not in begun and not there:
            rows += _heading(parent, holders, listed=parent.removesuffix("[]") in of)
        # In a section that the file has, the whole path tells where the key belongs.
        label = key.path if there else _indented(parent, name, parent not in begun)
        default = "" if {f"{key.path}[]", f"{key.path}.NAME"} & of.keys() else _default(key)
        rows.append((f"# {label}:{default}", _meaning(key)))
        begun.add(parent)
    if not rows:
        return ""
    width = max(len(label) for label, _ in rows)
    lines = [f"{label:<{width}}   # {words}" for label, words in rows]
    return "\n# Keys that this file omits, with their defaults; a.b is b in the section a:\n" + "\n".join([*lines, ""])


def _holders(data: Any, parent: str) -> list[Any]:
    """What stands in the file at a section, at each element of a list, or at each entry with a name."""
    found = [data]
    for step in re.split(r"\.|(?=\[\])", parent) if parent else ():
        if step == "[]":
            found = [each for part in found if isinstance(part, list) for each in part]
        elif step == "NAME":
            found = [each for part in found if isinstance(part, dict) for each in part.values()]
        else:
            found = [part[step] for part in found if isinstance(part, dict) and step in part]
    return found


def _is_second(data: Any, parent: str, of: Mapping[str, Set[str]]) -> bool:
    """Whether it is in a list, not in the file, that may stand instead of a section with the same keys."""
    ends = [sign.start() for sign in re.finditer(r"\[\]", parent)]
    lists = [(parent[:end], parent[: end + 2]) for end in ends]
    return any(of.get(one) == of.get(all_) and not _holders(data, all_) for one, all_ in lists)


def _heading(parent: str, holders: Sequence[Any], *, listed: bool) -> Iterator[tuple[str, str]]:
    """The line above the keys of a section that the file has as one word or a list, or of entries with names."""
    given = [each for each in holders if isinstance(each, str | list)]
    if given:
        yield f"# {parent}:", f"a section instead of {given[0] if isinstance(given[0], str) else 'the list'}"
    elif parent.endswith("[]") and listed:
        before, _, name = parent.removesuffix("[]").rpartition(".")
        yield f"# {_margin(f'{before}.') if before else ''}{name}:", "a list instead of the section"
    elif parent.endswith(".NAME"):
        yield f"# {_margin(parent.removesuffix('.NAME'))}  NAME:", "one entry for each, under its name"


def _margin(path: str) -> str:
    return "  " * (path.count(".") + path.count("[]"))


def _indented(parent: str, name: str, first: bool) -> str:
    """A key as it stands in a section of its own; the first one of an element of a list with its dash."""
    before = _margin(f"{parent}.") if parent else ""
    return f"{before[:-2]}- {name}" if first and parent.endswith("[]") else f"{before}{name}"


def _default(key: SpecKey) -> str:
    if key.section or key.default is None:
        return ""
    words = str(key.default).lower() if isinstance(key.default, bool) else key.default
    return f" {words:.12g}" if isinstance(words, float) else f" {words}"


def _meaning(key: SpecKey) -> str:
    """Unit, meaning and range."""
    from gearlink.cli.texts.written_design import uncapitalised

    if key.section:
        return uncapitalised(key.words)
    unit = "" if key.unit in ("", "1", "teeth") else f"{key.unit}: "
    needed = "; required" if key.required else ""
    return unit + key.words + (f" ({key.range})" if key.range else "") + needed
