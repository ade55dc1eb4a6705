"""One command on one design file, from its text to a report: what every command that reads designs stands on."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from typing import TYPE_CHECKING, Any

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import stem_of
from gearlink.cli.options import Format, Options
from gearlink.cli.reading.design_file import diagnose_no_solution, load, read_kind, validate
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.reading.loaded_file import LoadedFile
from gearlink.core.base.design import Design, UnknownName
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.kind import FileDesigns, Kind
from gearlink.core.base.kinds import FILES, STUDY
from gearlink.core.base.wording import first_of

if TYPE_CHECKING:
    from gearlink.core.base.report import Check, Report
    from gearlink.core.studies.study.faults import WrongStudy


def open_design(source: str, options: Options) -> tuple[LoadedFile, Kind]:
    """The text of a design file as located data, and its kind."""
    loaded = load(source, overrides=options.overrides)
    return loaded, FILES[read_kind(loaded, tuple(FILES))]


def read_spec(loaded: LoadedFile, kind: Kind, source: str) -> Any:
    """The validated spec, named after the file where it names no design."""
    if kind is not STUDY:
        return named(validate(loaded, kind.spec_model()), source)
    from gearlink.cli.reading.base_design import with_base, with_plain_keys

    try:
        spec = named(validate(loaded, kind.spec_model()), source)
    except DesignFileError as error:
        raise with_plain_keys(error) from None
    return with_base(loaded, spec)


def build(
    loaded: LoadedFile,
    kind: Kind,
    command: str,
    spec: Any,
    options: Options,
    *,
    findings_only: bool = False,
    key_tables: bool = False,
    designs: FileDesigns | None = None,
) -> tuple[Design, Report]:
    """The design of a validated spec (one of `designs`, where its other commands have some) and its report; what the
    mechanism refuses becomes a located error."""
    only = options.candidates or (bool(options.tables) and options.format is Format.CSV)
    wanted = {
        "quantities": options.quantities,
        "tables": (*options.tables, *(("candidates",) if options.candidates else ())),
        "only": only,
        "samples": options.samples,
        "in_parts": options.format is Format.CSV,
        "findings_only": findings_only,
        "key_tables": key_tables,
    }
    try:
        made = partial(kind.design, command, spec) if designs is None else partial(designs.of, command)
        with refusals_located(loaded, None if kind is STUDY else made, command):
            design = made()
            if options.format is Format.JSON and not (only or options.quantities or findings_only):
                wanted["tables"] = (*options.tables, *design.tables_of_data(command))
            report = design.report(command, **wanted)  # type: ignore[arg-type]
    except UnknownName as error:
        if options.candidates and error.name == "candidates":
            message = f"`{command}` has no values to be chosen, so there are no candidates"
            raise DesignFileError([Diagnostic("GL115", message, file="<--candidates>")]) from error
        raise DesignFileError([_unknown_name(error)]) from error
    return design, report


def whole_design(kind: Kind, spec: Any) -> Design:
    """The design by the command whose class knows links and parts: an analysis of given ones before a synthesis."""
    asked: tuple[str, ...] = spec.commands()
    return kind.design("analyze" if "analyze" in asked else asked[0], spec)


def checks_of(kind: Kind, spec: Any, known: Any = None) -> Sequence[Check]:
    """The findings of all commands of a file, without tested fixes; of one that refuses the design there are none.

    Parameters
        known : Kin - the designs of the file, where some are made already
    """
    designs = FileDesigns(kind, spec) if known is None else known
    found: list[Check] = []
    for command in spec.commands():
        with suppress(NoSolution):
            design = designs.of(command)
            design.require(command)
            names = design.outline(command).checks
            found += [check for name in names for check in design.check(name) if check.status != "pass"]
    return found


def failures(checks: Iterable[Check]) -> list[str]:
    """What fails in a few words, each check once with the first value that does."""
    found: dict[tuple[str, str], str] = {}
    for check in checks:
        if check.status == "fail":
            found.setdefault((check.code, check.name), check.brief)
    return list(found.values())


def wrong_kind(loaded: LoadedFile, message: str) -> DesignFileError:
    """The refusal of a file for its kind."""
    line, column, file = loaded.locate(("kind",))
    return DesignFileError([Diagnostic("GL113", message, file=file, line=line, column=column, key="kind")])


@contextmanager
def refusals_located(loaded: LoadedFile, made: Callable[[], Design] | None = None, command: str = "") -> Iterator[None]:
    """What a mechanism or a study refuses becomes an error at its place in the file.

    Parameters
        made : gives the design that is refused, on which a fix is tried for the command
    Raises
        DesignFileError - instead of NoSolution and WrongStudy
    """
    try:
        yield
    except NoSolution as error:
        told = error if made is None else _with_fix(made, command, error)
        raise DesignFileError([diagnose_no_solution(loaded, told)]) from error
    except _wrong_study() as error:  # its class is looked up where something is raised, not before
        from gearlink.cli.reading.base_design import located

        raise DesignFileError(located(loaded, error.faults)) from error


def _with_fix(made: Callable[[], Design], command: str, error: NoSolution) -> NoSolution:
    """The refusal with a fix that was tried; as it is where there is no design to try one on."""
    from gearlink.core.base.remedies.trials import with_fix

    with suppress(NoSolution):
        return with_fix(made(), command, error)
    return error


def _wrong_study() -> type[WrongStudy]:
    from gearlink.core.studies.study.faults import WrongStudy

    return WrongStudy


def refused_sections(
    loaded: LoadedFile, kind: Kind, spec: Any, done: Collection[str] = (), designs: FileDesigns | None = None
) -> Iterator[tuple[str, list[Diagnostic]]]:
    """What the sections `tolerance` and `register` name and the design does not have, by the command that reads them.

    Parameters
        done : commands that have said so themselves
        designs : those of the file that are made already, whose results are shared
    """
    designs = FileDesigns(kind, spec) if designs is None else designs
    sections = {"tolerance": ("tolerance",), "register": ("tolerance", "register_")}
    for command, keys in sections.items():
        given = any(getattr(spec, key, None) is not None for key in keys)
        if not given or command in done or command not in kind.commands:
            continue
        try:
            with refusals_located(loaded):
                designs.of(command).require_named()
        except DesignFileError as error:
            yield command, error.diagnostics
            return  # the other reads the same sources


def named(spec: Any, source: str) -> Any:
    """The spec with the file's stem for a name where the file gives none."""
    if "name" in spec.model_fields_set or source == "-":
        return spec
    return spec.model_copy(update={"name": stem_of(source)})


def require_command(loaded: LoadedFile, kind: Kind, command: str) -> None:
    """Refuse a command that this kind of design does not understand.

    Raises
        DesignFileError - naming the commands that it does understand, and the kinds that understand this one
    """
    if command in kind.commands:
        return
    message = f"`{command}` does not apply to a {kind.name}; available for this kind: {', '.join(kind.commands)}"
    alike = set(kind.name.split("-"))
    takers = [name for name, other in FILES.items() if command in other.commands]
    takers.sort(key=lambda name: -len(alike.intersection(name.split("-"))))  # a cam's first where a cam was given
    help = (
        f"kinds with `{command}`: {first_of(takers)}; `gearlink new {takers[0]}` writes a file of one" if takers else ""
    )
    raise DesignFileError([loaded.report("GL113", message, ("kind",), help=help)])


def exit_status(report: Report, *, strict: bool = False) -> int:
    """0 where all checks pass, 1 where one fails (with `strict`, also where one warns)."""
    bad = {"fail", "warn"} if strict else {"fail"}
    return ExitCode.FINDING if any(check.status in bad for check in report.checks) else ExitCode.OK


def _unknown_name(error: UnknownName) -> Diagnostic:
    message, file = error.args[0], f"<--{error.what}>"
    return Diagnostic("GL115", message, file=file, line=1, column=1, key=error.name, help=error.remedy)
