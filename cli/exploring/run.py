"""`gearlink explore` from the study file, or from a store, to the page."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from gearlink.cli.evaluate import exit_status, open_design, read_spec, require_command
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.exploring.computing import Means, Opened, compute, kept_in
from gearlink.cli.exploring.options import Exploring
from gearlink.cli.exploring.store import (
    CannotStore,
    Kept,
    Memory,
    chunks_of,
    is_store,
    of_another_program,
    opened,
    others,
    problem_in,
    ready,
)
from gearlink.cli.files import CannotWrite, require_folder
from gearlink.cli.options import Format
from gearlink.cli.patience import patience
from gearlink.cli.printable import visible
from gearlink.cli.progress import progress
from gearlink.cli.reading.base_design import located
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.render.errors import show_errors, show_refusal
from gearlink.core.explore.chunks import together
from gearlink.core.explore.exploration import Exploration
from gearlink.core.explore.front import Found
from gearlink.core.explore.preparing import problem
from gearlink.core.explore.problem import Problem
from gearlink.core.report import Report
from gearlink.core.study.faults import BrokenPromise, WrongStudy
from gearlink.core.wording import amount


def run_explore(asked: Exploring) -> int:
    """Do what the command line asks for, and give the exit status."""
    try:
        return _run(asked)
    except CannotStore as error:
        place = str(asked.store or asked.source)
        show_errors([Diagnostic(error.code, str(error), file=place, help=error.help)], asked.options)
        return ExitCode.WRONG_INPUT
    except (DesignFileError, CannotWrite) as error:
        return show_refusal(error, asked.source, asked.options)


def _run(asked: Exploring) -> int:
    if asked.show and (asked.write is not None or asked.options.plot):
        other = "--plot" if asked.write is None else "--write"
        raise _usage(f"--show prints one design and writes no file: leave {other} out, or --show", "--show")
    for folder in (asked.write, asked.options.out if asked.options.plot else None):
        if folder is not None:
            require_folder(folder)
    source = asked.source
    if is_store(source):
        return _shown(Path(source), asked)
    made = _read(source, asked)
    if asked.show and not asked.show.startswith("m"):
        from gearlink.cli.exploring.designs import show

        return show(made, None, asked.show)
    return _computed(made, asked)


def _shown(path: Path, asked: Exploring) -> int:
    """Print what a store holds; where another program computed it, that is said.

    Raises
        CannotStore - GL158 where this program computes one of its designs otherwise
    """
    with opened(path) as store:
        made = problem_in(store)
        meta = store.meta()
        for name, was, now in others(meta):
            _tell(f"note: {visible(str(path))} was computed with {name} {visible(was)}; this is {now}", asked)
        try:
            return _answer(made, store, asked)
        except BrokenPromise as error:
            if not others(meta):
                raise
            raise of_another_program(path, meta, f"here, {str(error).removeprefix('GL160: ')}") from None


def _read(source: str, asked: Exploring) -> Problem:
    """The study of a file, ready to be computed."""
    loaded, kind = open_design(source, asked.options)
    require_command(loaded, kind, "explore")
    spec = read_spec(loaded, kind, source)
    try:
        made = problem(spec)
        made.order  # noqa: B018 - refused here, where its places in the file are known
    except WrongStudy as error:
        raise DesignFileError(located(loaded, error.faults)) from None
    return made


def _computed(made: Problem, asked: Exploring) -> int:
    keep = _keep(made, asked)
    with keep() as kept:
        done = kept.finished()
    todo = [number for number in range(made.chunks) if number not in done]
    shown = progress(len(todo), "exploring", quiet=asked.options.quiet, each=made.chunk_size)
    with _means(asked) as means, shown as advance:
        whole = compute(made, todo, keep, means, advance)
    with keep() as kept:
        if not whole:
            return _interrupted(made, kept, asked)
        return _answer(made, kept, asked)


def _keep(made: Problem, asked: Exploring) -> Opened:
    """Where chunks are kept: in the store, which is made ready, or in memory."""
    if asked.store is None:
        if asked.resume:
            raise _usage("--resume needs --store FILE", "--store")
        return kept_in(Memory())
    path = asked.store
    with opened(path) as store:
        ready(store, made, resume=asked.resume)
        store.log("begun" if not store.finished() else "continued")
    return lambda: opened(path)


@contextmanager
def _means(asked: Exploring) -> Iterator[Means]:
    if asked.dask:
        from gearlink.cli.parallel.cluster import client

        with client(asked.dask) as cluster:
            yield Means(executor=cluster.get_executor, workers=max(1, len(cluster.ncores())))
    else:
        yield Means(asked.jobs)


def _interrupted(made: Problem, kept: Kept, asked: Exploring) -> int:
    done = len(kept.finished())
    text = f"interrupted: {done} of {made.chunks} chunks are finished"
    if asked.store is not None:
        text += f"; continue by: gearlink explore {asked.source} --store {asked.store} --resume"
    print(text, file=sys.stderr)
    return ExitCode.INTERRUPTED


def _answer(made: Problem, kept: Kept, asked: Exploring) -> int:
    """Print what was found, or that something is missing."""
    missing = made.chunks - len(kept.finished())
    if missing:
        text = f"{missing} of {made.chunks} chunks are missing: continue with the study file, --store and --resume"
        raise CannotStore("GL159", text)
    with patience("putting the designs together", quiet=asked.options.quiet):
        found = Found.of(made, together(made, chunks_of(kept, made)))
    if asked.show:
        from gearlink.cli.exploring.designs import show

        return show(made, found, asked.show)
    return _print(Exploration(made.spec, found), asked)


def _print(study: Exploration, asked: Exploring) -> int:
    from gearlink.cli.commands.design import print_report, written_beside

    with patience("computing the results of the study", quiet=asked.options.quiet):
        report = study.report("explore")
    if asked.options.format is Format.TABLE:
        from gearlink.cli.exploring.page import show as show_page

        show_page(study, report, asked.options)
    else:
        print_report(report, asked.options)
    beside = written_beside(lambda: _write(study, report, asked), asked.source, asked.options)
    return max(beside, exit_status(report, strict=asked.options.strict))


def _write(study: Exploration, report: Report, asked: Exploring) -> None:
    """Write the files that are asked for besides."""
    if asked.write is not None:
        from gearlink.cli.exploring.designs import write

        count, others = write(study.found, asked.write)
        earlier = f", beside {others} of an earlier run" if others else ""
        _tell(f"wrote {amount(count, 'design')} to {visible(str(asked.write))}{earlier}", asked)
    if asked.options.plot:
        from gearlink.cli.commands.design import plot

        plot("explore", study, asked.options, report)


def _tell(text: str, asked: Exploring) -> None:
    if not asked.options.quiet:
        print(text, file=sys.stderr)


def _usage(message: str, key: str) -> DesignFileError:
    return DesignFileError([Diagnostic("GL115", message, file="<command line>", key=key)])
