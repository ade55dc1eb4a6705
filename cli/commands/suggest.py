"""`--suggest`: what a failing or refused design should change, tried round by round, and the repaired design."""

from __future__ import annotations

import csv
import io
import json
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from gearlink.cli.commands.design import plotted, print_report
from gearlink.cli.commands.save import require_place, save
from gearlink.cli.evaluate import build, exit_status, open_design, read_spec, require_command
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite, require_folder
from gearlink.cli.options import STREAM, Format, Options
from gearlink.cli.printable import for_shell, json_text
from gearlink.cli.progress import progress
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.render.errors import show_refusal
from gearlink.cli.render.json_report import as_plain
from gearlink.cli.render.markdown_report import markdown_table
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.remedies.trials import Bench
from gearlink.core.base.report import Check, Remedy, Report
from gearlink.core.base.spec_paths import changed, given_at

if TYPE_CHECKING:
    from gearlink.core.base.design import Design
    from gearlink.core.base.kind import Kind

_ROUNDS = 8
_NONE_FOUND = "no change found with which every check passes"


@dataclass(frozen=True, slots=True)
class Change:
    """A key of the design file that was changed; None stands for a key that is not given."""

    path: str
    old: Any
    new: Any
    why: str


def run_suggested(command: str, source: str, options: Options) -> int:
    """Repair the design file `source` by its own remedies, print changes and report, give its exit status.

    Notes
        Where no changes were found with which the design holds, the report is that of the file as it stands.
    """
    changes: list[Change] | None = []
    saved: int = ExitCode.OK
    try:
        require_place(options)
        if options.plot:
            require_folder(options.out)
        loaded, kind = open_design(source, options)
        require_command(loaded, kind, command)
        spec = read_spec(loaded, kind, source)
        words = f"searching for changes with which all checks of {spec.name} pass"
        with progress(_ROUNDS, words, quiet=options.quiet) as advance:
            repaired, changes = repair(kind, command, spec, strict=options.strict, advance=advance)
            design, report = build(loaded, kind, command, repaired, options, key_tables=options.brief)
        if options.save is not None:
            saved = save(loaded, kind, command, design, options, changes or ())
    except (DesignFileError, CannotWrite, NoSolution) as error:
        if changes is None and options.format is not Format.JSON:
            print(_as_text(changes, options), file=sys.stderr)
        return show_refusal(error, source, options)
    _print(changes, report, options)
    beside = plotted(command, design, options, report, source)
    return max(saved, beside, exit_status(report, strict=options.strict))


def repair(
    kind: Kind, command: str, spec: Any, *, strict: bool = False, advance: Callable[[int], None] = lambda _: None
) -> tuple[Any, list[Change] | None]:
    """The spec with which a design holds, and the changes that lead there.

    Parameters
        strict : bool - warnings are repaired as well
        advance : called with 1 after each round
    Returns
        spec, changes - the spec as it was and None where no such changes were found
    Notes
        Up to eight rounds, each the first remedy of the design as it then stands. What repairs a finding at the price
        of others is no way to go twice: the finding came back.
    """
    changes: list[Change] = []
    taken: set[tuple[str, ...]] = set()
    given, seen = spec, {spec.model_dump_json()}
    for _ in range(_ROUNDS):
        bad = {"fail", "warn"} if strict else {"fail"}
        design = kind.design(command, spec)
        remedies = _remedies(design, command, bad, taken)
        if remedies is None:
            return spec, changes
        tried = ((remedy, why, changed(spec, remedy)) for remedy, why in remedies)
        fresh = next((each for each in tried if each[2] and each[2].model_dump_json() not in seen), None)
        if fresh is None:
            break
        remedy, why, repaired = fresh
        changes += [Change(path, given_at(spec, path), value, why) for path, value in remedy]
        seen.add(repaired.model_dump_json())
        spec = repaired
        advance(1)
    return given, None


def _remedies(
    design: Design, command: str, bad: set[str], taken: set[tuple[str, ...]]
) -> Iterator[tuple[Remedy, str]] | None:
    """What would repair a design, each with the reason, sought when it is asked for; None where the design holds."""
    bench = Bench(design, command, patient=True)
    try:
        design.require(command)
        found = [each for name in design.outline(command).checks for each in enumerate(design.check(name))]
    except NoSolution as error:
        why = error.message
        return ((remedy, why) for remedy in bench.of_refusal(error))
    wrong = [(index, check) for index, check in found if check.status in bad]
    return _steps(bench, wrong, taken) if wrong else None


def _steps(
    bench: Bench, wrong: Sequence[tuple[int, Check]], taken: set[tuple[str, ...]]
) -> Iterator[tuple[Remedy, str]]:
    """Remedies of what is wrong; where there are none, what repairs one finding at the price of others, by keys that
    were not `taken` for it before."""
    for index, check in wrong:
        if remedy := bench.remedy(check, index):
            yield remedy, check.message
    for index, check in wrong:
        remedy = bench.detour(check, index)
        way = (check.name, *(key for key, _ in remedy))
        if remedy and way not in taken:
            taken.add(way)
            yield remedy, check.message


def _print(changes: Sequence[Change] | None, report: Report, options: Options) -> None:
    if options.save == STREAM:  # the design stands there, so that nothing else may
        if not options.quiet:
            print(_as_text(changes, options), file=sys.stderr)
        return
    if options.format is Format.JSON:
        print(json_text(as_plain(report) | {"suggestions": list(map(asdict, changes or ()))}))
        return
    text = _as_text(changes, options)
    if options.format is Format.TABLE and options.quantities:
        # results alone belong on standard output
        print(text, file=sys.stderr)
    else:
        sys.stdout.write(text + "\n")
    print_report(report, options)


def _as_text(changes: Sequence[Change] | None, options: Options) -> str:
    nothing = "none" if changes is not None else _NONE_FOUND
    changes = changes or ()
    if options.format is Format.CSV:
        stream = io.StringIO()
        rows = [("change", "old", "new", "why"), *((c.path, c.old, c.new, c.why) for c in changes)]
        csv.writer(stream, lineterminator="\n").writerows(rows)
        return stream.getvalue()
    if options.format is Format.MARKDOWN:
        rows = [(f"`{c.path}`", _shown(c.old), _shown(c.new), c.why) for c in changes]
        table = f"{markdown_table(('change', 'old', 'new', 'why'), rows)}\n\n`{overrides(changes)}`"
        return f"## Suggestions\n\n{table if changes else nothing}\n"
    if not changes:
        return f"suggestions: {nothing}\n"
    lines = [f"  {c.path}: {_shown(c.old)} -> {_shown(c.new)}    {c.why}" for c in changes]
    return "\n".join(["suggestions, tried in this order:", *lines, f"  as options: {overrides(changes)}", ""])


def overrides(changes: Sequence[Change]) -> str:
    """The options that make the changes, quoted for a shell; of a key that was changed twice the last value counts.

    Example
        >>> overrides([Change("teeth[0]", 10, 17, "undercut"), Change("cam.rocker_radius", 80.0, None, "a loop")])
        "--set 'teeth[0]=17' --set cam.rocker_radius=null"
    """
    last = {change.path: change.new for change in changes}
    return " ".join(f"--set {for_shell(f'{path}={json.dumps(value)}')}" for path, value in last.items())


def _shown(value: Any) -> str:
    if isinstance(value, (int, float)):
        return f"{value:.12g}"
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(_shown, value))}]"
    return "not given" if value is None else str(value)
