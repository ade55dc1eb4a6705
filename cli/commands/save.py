"""`--save FILE`: the design of a command as a complete file, with what was found and where each number is from.

`--save -` writes it to standard output, instead of the results.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import require_free, stem_of, write_atomically
from gearlink.cli.options import STREAM, Options
from gearlink.cli.printable import visible
from gearlink.cli.progress import patience
from gearlink.cli.reading.design_file import parse, validate
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.texts.schema import spec_keys
from gearlink.cli.texts.written_design import flow, written
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.spec_paths import part_at, put
from gearlink.core.version import VERSION

if TYPE_CHECKING:
    from pathlib import Path

    from gearlink.cli.commands.suggest import Change
    from gearlink.cli.reading.loaded_file import LoadedFile
    from gearlink.core.base.design import Design
    from gearlink.core.base.kind import Kind
    from gearlink.core.base.report import Check

_KEY_ORDER = ("kind", "name", "input_speed")


def require_place(options: Options) -> None:
    """Refuse before anything is computed a file that is there and may not be overwritten.

    Raises
        CannotWrite
        DesignFileError - GL115 for `--round` without `--save`
    """
    if options.round is not None and options.save is None:
        raise DesignFileError([Diagnostic("GL115", "--round needs --save FILE", file="<command line>", key="--round")])
    if options.save is not None and options.save != STREAM:
        require_free(options.save, "--save", force=options.force)


def save(
    loaded: LoadedFile, kind: Kind, command: str, design: Design, options: Options, changes: Sequence[Change] = ()
) -> int:
    """Write the design where the options want it, say so, and give the exit status of what was written.

    Raises
        CannotWrite - where the file is there already, or the disk does not take it
    """
    assert options.save is not None
    again = "analyze" if "analyze" in kind.commands else command
    with patience("computing the design to be saved", quiet=options.quiet):
        text = complete(loaded, kind, command, design, options.save, options.round, changes)
        rounded = _as_rounded(kind, again, text, options)
    if options.save == STREAM:
        sys.stdout.write(text)
    else:
        write_atomically(options.save, lambda stream: stream.write(text.encode()))
        if not options.quiet:
            path = visible(str(options.save))
            print(f"wrote {path}; try: gearlink {again} {path}", file=sys.stderr)
    worse = [] if rounded is None else _worse(rounded, again, design, command)
    for check in worse:
        print(f"rounded to {options.round:g} mm it fails {check.code} {check.name}: {check.message}", file=sys.stderr)
    return ExitCode.FINDING if worse else ExitCode.OK


def _as_rounded(kind: Kind, command: str, text: str, options: Options) -> Design | None:
    """The rounded design, computed; None where nothing is rounded.

    Raises
        DesignFileError - GL115 where rounding leaves no mechanism
    """
    if options.round is None:
        return None
    try:
        design = kind.design(command, validate(parse(text.encode(), str(options.save)), kind.spec_model()))
        design.require(command)
        _failing(design, command)
    except (DesignFileError, NoSolution) as error:
        reason = error.message if isinstance(error, NoSolution) else error.diagnostics[0].message
        words = f"rounded to {options.round:g} mm the mechanism does not exist: {reason}\ngive a smaller --round"
        raise DesignFileError([Diagnostic("GL115", words, file="<command line>", key="--round")]) from error
    return design


def _worse(rounded: Design, again: str, design: Design, command: str) -> list[Check]:
    """What the rounded design fails and the design does not; remedies are sought of that alone."""
    failing = _failing(rounded, again)
    known = {code for codes in _failing(design, command).values() for code in codes}
    new = {code for codes in failing.values() for code in codes} - known
    found = [check for name, codes in failing.items() if codes & new for check in rounded.findings(again, name)]
    return [check for check in found if check.status == "fail" and check.code in new]


def _failing(design: Design, command: str) -> dict[str, set[str]]:
    """The codes of what fails, by check; advice, which nobody reads, is not sought."""
    advises, design.advises = design.advises, False
    try:
        found = {name: design.check(name) for name in design.outline(command).checks}
    finally:
        design.advises = advises
    return {name: {each.code for each in checks if each.status == "fail"} for name, checks in found.items()}


def complete(
    loaded: LoadedFile,
    kind: Kind,
    command: str,
    design: Design,
    file: Path,
    step: float | None,
    changes: Iterable[Change] = (),
) -> str:
    """The text of the complete design.

    Parameters
        command : str - that was run on the file
        step : float [mm] or None - to which the lengths that were found are rounded
        changes : that `--suggest` made
    """
    data = _ordered(design.spec.model_dump(mode="json", exclude_unset=True, by_alias=True), loaded.data)
    notes = {".".join(map(str, o.path)): f"from {o.source.file.strip('<>')}" for o in loaded.overrides}
    for change in (each for each in changes if each.new is not None):
        notes[change.path] = f"was {'not given' if change.old is None else flow(change.old)}: --suggest"
    left_out, units = [], {key.path: key.unit for key in spec_keys(kind)}
    for found in design.completion():
        if found.value is None:
            left_out += [(found.path, old)] if (old := part_at(data, found.path)) is not None else []
            put(data, found.path, None)
            continue
        value, words = _rounded(found.value, found.path, units, step)
        for path, word in words.items():
            own = part_at(found.value, path.removeprefix(found.path).lstrip("."))
            given = _given(loaded.data, path, own) if found.why.startswith("found") else ""
            if given != path:  # else it is as the file has it
                why = f"given as {given}" if given else found.why
                notes[path] = "; ".join(w for w in (why, word) if w)
        put(data, found.path, value)
    _write_units(data, loaded)
    data["name"] = stem_of(file) if "name" not in loaded.data and file != STREAM else design.spec.name
    head = [f"{data['name']}: `gearlink {command} {loaded.file}` (gearlink {VERSION})"]
    head += [f"required: {path}: {flow(value)}" for path, value in left_out]
    return written(kind, _ordered(data, dict.fromkeys(_KEY_ORDER) | dict(_with_links(loaded.data))), head, notes)


def _given(data: Any, path: str, value: Any, before: str = "") -> str:
    """Where a file gives the number that was to be found: under this key, or one of its name elsewhere; "" if nowhere.

    Example
        >>> _given({"dwell": {"crank": 30, "window": 70.0}}, "links.crank", 30.0)
        'dwell.crank'
    """
    found = ""
    for key, inner in data.items():
        place = f"{before}.{key}".lstrip(".")
        if isinstance(inner, Mapping):
            found = found or _given(inner, path, value, place)
        elif key == path.rpartition(".")[2] and inner == value and isinstance(value, (int, float)):
            found = found if found and place != path else place
    return found


def _write_units(data: dict[str, Any], loaded: LoadedFile) -> None:
    """Put the texts of the file back where the numbers that its values with units gave still hold."""
    for (*sections, last), (text, value) in loaded.as_written.items():
        place: Any = data
        try:
            for step in sections:
                place = place[step]
            if place[last] == value:
                place[last] = text
        except (LookupError, TypeError):
            continue


def _with_links(order: Mapping[str, Any]) -> Iterable[tuple[str, Any]]:
    """The order of a file's keys, with `links` behind `gears` where it has none."""
    for key, value in order.items():
        yield key, value
        if key == "gears" and "links" not in order:
            yield "links", {}


def _rounded(value: Any, path: str, units: Mapping[str, str], step: float | None) -> tuple[Any, dict[str, str]]:
    """A value, or a section of values, with its lengths rounded; and what is to be said of the rounding, by path."""
    if isinstance(value, Mapping):
        parts = {key: _rounded(inner, f"{path}.{key}", units, step) for key, inner in value.items()}
        words = {place: word for _, told in parts.values() for place, word in told.items()}
        return {key: part for key, (part, _) in parts.items()}, words
    if step is None or units.get(path) != "mm" or not isinstance(value, float):
        return value, {path: ""}
    digits = max(0, 1 - math.floor(math.log10(step)))
    return round(round(value / step) * step, digits), {path: f"{value:.10g} rounded to {step:g} mm"}


def _ordered(data: Mapping[str, Any], order: Mapping[str, Any]) -> dict[str, Any]:
    """The data with its keys in the order of another, what that does not have behind."""
    keys = [key for key in order if key in data] + [key for key in data if key not in order]
    return {
        key: _ordered(data[key], order[key])
        if isinstance(data[key], dict) and isinstance(order.get(key), dict)
        else data[key]
        for key in keys
    }
