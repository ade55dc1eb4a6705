"""`--suggest`: what a failing or refused design should change, tried round by round, and the repaired design."""

from __future__ import annotations

import csv
import io
import json
import shlex
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.cli.commands.design import plot, print_report, show_refusal
from gearlink.cli.commands.save import require_place, save
from gearlink.cli.evaluate import build, exit_status, open_design, read_spec, require_command
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite
from gearlink.cli.options import Format, Options
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.core.errors import NoSolution
from gearlink.core.report import Check, Remedy, Report, remedy_words
from gearlink.core.spec_paths import changed, value_at

if TYPE_CHECKING:
    from gearlink.core.design import Design
    from gearlink.core.kinds import Kind

_ROUNDS = 8


@dataclass(frozen=True, slots=True)
class Change:
    """A key of the design file that was changed; None stands for a key that is left out."""

    path: str
    old: Any
    new: Any
    why: str


def run_suggested(command: str, source: str, options: Options) -> int:
    """Repair the design file `source` by its own suggestions, print changes and report, give its exit status."""
    changes: list[Change] = []
    saved: int = ExitCode.OK
    try:
        require_place(options)
        loaded, kind = open_design(source, options)
        require_command(loaded, kind, command)
        spec, changes = repair(kind, command, read_spec(loaded, kind, source))
        design, report = build(loaded, kind, command, spec, options)
        if options.plot:
            plot(command, design, options, report)
        if options.save is not None:
            saved = save(loaded, kind, command, design, options, changes)
    except (DesignFileError, CannotWrite, NoSolution) as error:
        _print_refused(changes, options)
        return show_refusal(error, source, options)
    _print(changes, report, options)
    return max(saved, exit_status(report, strict=options.strict))


def repair(kind: Kind, command: str, spec: Any) -> tuple[Any, list[Change]]:
    """The spec after up to eight rounds, each the first suggestion of the design as it then stands.

    Notes
        Rounds end where nothing fails, where a design has nothing more to suggest, and where a value returns.
    """
    changes: list[Change] = []
    seen = {spec.model_dump_json()}
    for _ in range(_ROUNDS):
        tried = ((step, changed(spec, step.remedy)) for step in _steps(kind.design(command, spec), command))
        fresh = next(((step, new) for step, new in tried if new and new.model_dump_json() not in seen), None)
        if fresh is None:
            break
        step, repaired = fresh
        changes += [Change(path, value_at(spec, path), value, step.why) for path, value in step.remedy]
        seen.add(repaired.model_dump_json())
        spec = repaired
    return spec, changes


class _Step(NamedTuple):
    """What may be changed in one round, and why."""

    remedy: Remedy
    why: str


def _steps(design: Any, command: str) -> Iterator[_Step]:
    """What would repair a design, none where it holds: its own suggestions, then the remedies of what fails."""
    failing = _failing(design, command)
    if failing is not None and not failing:
        return
    for path, value, why in design.suggestions():
        yield _Step(((path, value),), why)
    for check in failing or ():
        if check.remedy:
            yield _Step(check.remedy, check.message.removesuffix(f"; {remedy_words(check.remedy)}"))


def _failing(design: Design, command: str) -> list[Check] | None:
    """The checks that fail; None where the design is refused."""
    try:
        return [check for check in design.report(command, findings_only=True).checks if check.status == "fail"]
    except NoSolution:
        return None


def _as_plain(changes: Sequence[Change]) -> list[dict[str, Any]]:
    return [{"path": c.path, "old": c.old, "new": c.new, "why": c.why} for c in changes]


def _print(changes: Sequence[Change], report: Report, options: Options) -> None:
    if options.format is Format.JSON:
        from gearlink.cli.render.json_report import as_plain

        whole = as_plain(report) | {"suggestions": _as_plain(changes)}
        print(json.dumps(whole, ensure_ascii=False, allow_nan=False))
        return
    text = _as_text(changes, options)
    if options.format is Format.TABLE and options.quantities:
        # results alone belong on standard output
        print(text, file=sys.stderr)
    else:
        sys.stdout.write(text + "\n")
    print_report(report, options)


def _print_refused(changes: Sequence[Change], options: Options) -> None:
    """The changes that were tried in vain, apart from the error."""
    if changes and options.format is not Format.JSON:
        print(_as_text(changes, options), file=sys.stderr)


def _as_text(changes: Sequence[Change], options: Options) -> str:
    if options.format is Format.CSV:
        stream = io.StringIO()
        rows = [("change", "old", "new", "why"), *((c.path, c.old, c.new, c.why) for c in changes)]
        csv.writer(stream, lineterminator="\n").writerows(rows)
        return stream.getvalue()
    if options.format is Format.MARKDOWN:
        from gearlink.cli.render.markdown_report import markdown_table

        rows = [(f"`{c.path}`", _shown(c.old), _shown(c.new), c.why) for c in changes]
        return (
            f"## Suggestions\n\n{markdown_table(('change', 'old', 'new', 'why'), rows)}\n\n`{overrides(changes)}`\n"
            if changes
            else "## Suggestions\n\nnone\n"
        )
    if not changes:
        return "suggestions: none\n"
    lines = [f"  {c.path}: {_shown(c.old)} -> {_shown(c.new)}    {c.why}" for c in changes]
    return "\n".join(["suggestions, tried in this order:", *lines, f"  as options: {overrides(changes)}", ""])


def overrides(changes: Sequence[Change]) -> str:
    """The options that make the changes, quoted for a shell; of a key that was changed twice the last value counts.

    Example
        >>> overrides([Change("teeth[0]", 10, 17, "undercut"), Change("cam.rocker_radius", 80.0, None, "a loop")])
        "--set 'teeth[0]=17' --set cam.rocker_radius=null"
    """
    last = {change.path: change.new for change in changes}
    return " ".join(f"--set {shlex.quote(f'{path}={json.dumps(value)}')}" for path, value in last.items())


def _shown(value: Any) -> str:
    return "left out" if value is None else f"{value:.12g}"
