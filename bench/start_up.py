"""Whole processes: every command against a minimal Typer program; a batch against its reading, two against one."""

from __future__ import annotations

import gc
import os
import subprocess
import sys
from collections.abc import Callable
from contextlib import redirect_stdout
from pathlib import Path
from tempfile import TemporaryDirectory

from bench.timing import Family, Method, Row, measure

MINIMAL = """import typer
app = typer.Typer(pretty_exceptions_enable=False)
@app.command()
def hello(name: str = "you") -> None:
    print("hello", name)
app()
"""
NAIVE = """import typer
import numpy, scipy.optimize, matplotlib.pyplot
app = typer.Typer(pretty_exceptions_enable=False)
@app.command()
def hello(name: str = "you") -> None:
    print("hello", name)
app()
"""
COMMANDS = {
    "--version": ["--version"],
    "--help": ["--help"],
    "synth dwell, json": ["synth", "dwell", "candy_feed.yaml", "--format", "json"],
    "synth dwell, table": ["synth", "dwell", "candy_feed.yaml"],
    "gear, json": ["gear", "ty460_input_gears.yaml", "--format", "json"],
    "crank, json": ["crank", "ty460_slider_crank.yaml", "--format", "json"],
    "analyze, json": ["analyze", "thesis_example_3_as_printed.yaml", "--format", "json"],
    "press, json": ["press", "ty460.yaml", "--format", "json"],
    "press, table": ["press", "ty460.yaml"],
    "cam, json": ["cam", "ty460.yaml", "--format", "json"],
    "gripper, json": ["gripper", "swing_gripper.yaml", "--format", "json"],
    "swing, json": ["swing", "wide_swing_twin_cam.yaml", "--format", "json"],
    "explain": ["explain", "GL301"],
    "schema": ["schema", "gear-pair"],
    "new": ["new", "gear-pair"],
}
KINDS = {
    "analyze, planar mechanism": ["analyze", "planar_watt.yaml"],
    "analyze, motion law": ["analyze", "quiet_law.yaml"],
    "analyze, machine of 8 members": ["analyze", "sheet_press.yaml"],
    "cam, disc cam": ["cam", "lift_cam.yaml"],
    "cam, cylindrical cam": ["cam", "barrel_cam.yaml"],
    "synth swing, crank-rocker": ["synth", "swing", "crank_rocker.yaml"],
    "loads, machine of 8 members": ["loads", "sheet_press.yaml"],
    "register, swing gripper": ["register", "swing_gripper_register.yaml"],
}
RUN = "import sys; from gearlink.cli.main import main; sys.exit(main())"


def designs() -> Path:
    """The folder of the examples."""
    import gearlink.designs as package

    return Path(str(package.__file__)).parent


def family(quick: bool) -> Family:
    """The table of the family."""
    with TemporaryDirectory() as folder:
        naive = Path(folder) / "naive.py"
        naive.write_text(NAIVE, encoding="utf-8")
        methods = [
            Method("python, doing nothing", 1, process("-c", "pass")),
            Method("Typer with scipy and pyplot at the top", 1, process(str(naive))),
            *(Method(name, 1, process("-c", RUN, *arguments)) for name, arguments in COMMANDS.items()),
        ]
        rows = _over_minimal(methods, 5 if quick else 15)
    return Family("start-up", "Start-up: the whole process of a command", "none", _MINIMAL, rows, (_COMPILED,))


_MINIMAL = "a minimal Typer program with one command"
_COMPILED = "the examples; modules compiled beforehand, as an installed package's are"


def kinds(quick: bool) -> Family:
    """The table of commands of the kinds that the start-up does not have."""
    methods = [Method(name, 1, process("-c", RUN, *arguments, "--format", "json")) for name, arguments in KINDS.items()]
    title = "Planar mechanisms, cams, crank-rockers, machines, register: the whole process of a command, JSON"
    return Family("kinds", title, "none", _MINIMAL, _over_minimal(methods, 3 if quick else 9), (_COMPILED,))


def _over_minimal(methods: list[Method], rounds: int) -> tuple[Row, ...]:
    with TemporaryDirectory() as folder:
        minimal = Path(folder) / "minimal.py"
        minimal.write_text(MINIMAL, encoding="utf-8")
        compile_all()
        return measure(methods, process(str(minimal)), 1, rounds)


def compile_all() -> None:
    """Byte code of the program, which an editable install in an environment that writes none would lack."""
    import compileall

    import gearlink.cli as cli
    import gearlink.core as core

    for package in (core, cli):
        compileall.compile_dir(next(iter(package.__path__)), quiet=2)


def process(*arguments: str) -> Callable[[], object]:
    """A call of Python in a process of its own, its output thrown away."""

    def run() -> object:
        return subprocess.run(
            [sys.executable, *arguments],
            cwd=designs(),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            check=False,
        )

    return run


def batch(quick: bool) -> Family:
    """A thousand designs in a batch against reading and validating their files."""
    count = 200 if quick else 1000
    with TemporaryDirectory() as name:
        folder = Path(name)
        written = write_designs(folder, count)
        gc.collect()
        gc.freeze()  # what this process has loaded besides is no part of a batch
        methods = [
            Method("batch in one process", count, lambda: _batch(folder, 1)),
            Method("batch in two processes", count, lambda: _batch(folder, 2)),
            Method("batch, as the program chooses", count, lambda: _batch(folder, 0)),
        ]
        rows: tuple[Row, ...] = measure(methods, lambda: _validate(written), count, 3 if quick else 7)
    return Family(
        "batch",
        f"Batch of {count} designs",
        "none",
        "reading and validating the same files in one process",
        rows,
        ("gear pairs, slider-cranks and dwell syntheses in equal shares",),
    )


def parallel(quick: bool) -> Family:
    """A hundred presses in a batch of two processes against one."""
    count = 20 if quick else 100
    with TemporaryDirectory() as name:
        folder = Path(name)
        write_designs(folder, count, PRESS)
        gc.collect()
        gc.freeze()
        methods = [Method("two processes", count, lambda: _batch(folder, 2))]
        rows = measure(methods, lambda: _batch(folder, 1), count, 3 if quick else 7)
    return Family("parallel", f"Batch of {count} presses", "none", "the same batch in one process", rows)


SMALL = ("candy_feed.yaml", "ty460_input_gears.yaml", "ty460_slider_crank.yaml")
PRESS = ("ty460.yaml",)


def write_designs(folder: Path, count: int, kinds: tuple[str, ...] = SMALL) -> list[Path]:
    """Copies of examples, no two files alike."""
    texts = [(designs() / kind).read_text(encoding="utf-8") for kind in kinds]
    written = []
    for i in range(count):
        path = folder / f"design_{i:04d}.yaml"
        path.write_text(f"{texts[i % len(texts)]}# {i}\n", encoding="utf-8")
        written.append(path)
    return written


def _validate(files: list[Path]) -> None:
    from gearlink.cli.evaluate import open_design, read_spec
    from gearlink.cli.options import Options

    for path in files:
        loaded, kind = open_design(str(path), Options())
        read_spec(loaded, kind, str(path))


def _batch(folder: Path, jobs: int) -> None:
    from gearlink.cli.batch.options import BatchFormat, BatchOptions
    from gearlink.cli.batch.run import run_batch
    from gearlink.cli.options import Options

    options = BatchOptions(Options(quiet=True), BatchFormat.JUNIT, jobs=jobs)
    with open(os.devnull, "w", encoding="utf-8") as nowhere, redirect_stdout(nowhere):
        run_batch([str(folder)], options)
