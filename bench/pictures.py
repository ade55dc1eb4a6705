"""Whole processes that a designer waits for: pictures, reports and films against the least that a picture costs."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

from bench.start_up import RUN, compile_all, designs
from bench.timing import Family, Method, measure

LEAST = """import sys
from matplotlib.figure import Figure
from matplotlib.backends.backend_agg import FigureCanvasAgg
made = Figure(figsize=(8.27, 11.69), dpi=130, layout="constrained")
FigureCanvasAgg(made)
made.subplots(5)
made.savefig(sys.argv[1])
"""
"""A process that draws five empty panels of the size of a page: no picture is had for less."""
WAITS = {
    "cam --plot, press": ["cam", "ty460.yaml", "--plot"],
    "press --plot": ["press", "ty460.yaml", "--plot"],
    "synth dwell --plot": ["synth", "dwell", "candy_feed.yaml", "--plot"],
    "gripper --plot": ["gripper", "swing_gripper.yaml", "--plot"],
    "swing --plot": ["swing", "wide_swing_twin_cam.yaml", "--plot"],
    "gear --plot": ["gear", "ty460_input_gears.yaml", "--plot"],
    "report, press": ["report", "ty460.yaml"],
    "report, three gears": ["report", "candy_feed.yaml"],
    "report, wide swing": ["report", "wide_swing_twin_cam.yaml"],
    "animate, GIF": ["animate", "candy_feed.yaml"],
    "animate, HTML": ["animate", "candy_feed.yaml", "--format", "html"],
}


def family(quick: bool) -> Family:
    """The table of the family."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        least = folder / "least.py"
        least.write_text(LEAST, encoding="utf-8")
        compile_all()
        methods = [Method(what, 1, process(folder, "-c", RUN, *line, "--out", name)) for what, line in WAITS.items()]
        reference = process(folder, str(least), str(folder / "least.png"))
        rows = measure(methods, reference, 1, 3 if quick else 5)
    return Family(
        "pictures",
        "Figures, reports and animations: the whole process of a command",
        "none",
        "a process that draws five empty panels and saves them as PNG",
        rows,
        ("the examples; modules compiled beforehand",),
    )


FOLDERS = {"check of the examples": ["check", "."], "batch of the examples": ["batch", ".", "--jobs", "1"]}


def folders(quick: bool) -> Family:
    """All examples in one process."""
    compile_all()
    methods = [Method(what, 1, process(designs(), "-c", RUN, *line)) for what, line in FOLDERS.items()]
    reference = process(designs(), "-c", RUN, "check", "candy_feed.yaml")
    return Family(
        "folders",
        "All examples in one process",
        "none",
        "the check of one of them, candy_feed.yaml",
        measure(methods, reference, 1, 1 if quick else 3),
        ("some of the designs are searches and studies of a tenth to a whole second each",),
    )


def process(folder: Path, *arguments: str) -> Callable[[], object]:
    """A call of Python in a process of its own that must do what it is asked; a finding is no fault."""
    here = designs()

    def run() -> object:
        line = [sys.executable, *(str(here / text) if (here / text).is_file() else text for text in arguments)]
        done = subprocess.run(line, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False)
        if done.returncode not in (0, 1):
            raise RuntimeError(f"{' '.join(line[3:])}: {done.stderr.decode(errors='replace')[-300:]}")
        return done

    return run
