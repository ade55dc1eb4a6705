"""Writes docs/benchmarks.md and its pictures: goals with what was reached, tables of all families, the peers."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bench.families import FAMILIES, measured
from bench.guard import keep
from bench.page import as_markdown, curves, duration, write_pictures
from bench.pictures import WAITS
from bench.timing import Family, machine

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
PEERS = ROOT / "bench" / ".venv" / "bin" / "python"

_HEAD = """# Run time against error

This page is written by `make bench`. `.venv/bin/python -m bench` prints the tables;
`.venv/bin/python -m bench.write_page FAMILY` measures one table again.

How long does a computation take, and how large is its error? Each table compares the method of gearlink with others for
the same numbers; a figure shows error over time, so that good methods are at the lower left.

* A time is the median of several rounds. In each round all methods of a table are measured one after the other, so the
  ratios within a table also hold on a busy machine; single times do not.
* An error is the maximum difference from results with 30 digits or more, on a sample of the inputs.
* The ratio is the time over that of the reference below the table. A numpy pass is one sine, cosine, arc tangent and
  square root of each number: the least that a computation with angles costs.
* N is the number of results that are computed together.
"""
_REASONS = """## Where a goal is missed, and why

* **Small arrays.** A numpy call costs 0.3 to 1 us for any size, and the sweep of a four-bar makes about seventy. Up to
  some hundred positions the scalar kernel is faster; the program uses it for single positions (2 to 3 us).
* **Times in ns and ms** are goals for an idle machine with AVX-512, on which numpy evaluates sine, cosine, arc tangent
  and square root for eight numbers at a time. Such a machine reached 8.7 ns for the inverse involute, 19 ns for the
  frame, 2.7 ms for the press and 1.43 passes for the cam profile. Without AVX-512 these functions take three to five
  times as long; code that numba compiles does not slow down as much. Compare the ratios to the numpy pass.
* **Four-bar.** Angles that are continuous over the revolutions take a tangent and three arc tangents of quotients, a
  pass has one arc tangent. Results are new arrays, whose memory pages take a tenth of the time; the pass has its own.
  Directions as unit vectors without any angle took 0.93 passes and 0.048 of the time of pylinkage; nothing in the
  program is content with them, so that this form is not kept. Without AVX-512 it takes 2.2 passes.
* **numba** is not used. The four-bar's unit vectors with two derivatives as one compiled loop (numba 0.68, AVX-512,
  N = 1e6, processor time in one process) took 0.90 of the time of the numpy blocks, and 0.60 with `fastmath`, which
  allows other rounding and removes the tests for NaN. It costs 0.2 s of import and 0.4 s of compilation in each
  process: the time that 150 million positions save, or 40 million with `fastmath`.
* **Frame of the instantaneous dwell.** The goal holds for a call on its own. In this table it runs between other
  methods: the caches are cold, and the arrays of results are new memory pages each time.
* **Cam profile.** The points alone take less than a pass. The whole profile writes seven columns (two complex, three
  real), the pass writes four, into arrays that exist. In blocks the profile stays in the cache, at constant memory.
* **Planar mechanism.** gearlink has no formula for these links, only their joints: 15 equations, solved by Newton's
  steps and differentiated by one linear system for each order. It takes 60 to 200 times as long as the formula of this
  one linkage, and about a tenth of the time of fsolve with differences.
* **Minimum disc cam.** A third of the time goes to the pressure angle, each limit refined in each stroke, half to the
  curvature radius: the roots of a polynomial at 512 cam angles. A scan is faster; its error is that of its step.
* **Crank-rocker for a function.** Of a grid of start directions the best alone is refined. In this task another start,
  which the grid passes by, has a sixth of the structural error; searches from four starts find it.
* **Samples of cams.** What all checks of a cam need is sought for all samples together: extremes of each stroke, of
  curvature and radius, refined to rounding. A scan gives the two quantities alone, with the error of its step.
* **Start-up.** Simple command lines are read without Typer, the search of pydantic for plug-ins is switched off, and
  its models are built when a file needs them. The remainder is the import of pydantic (two thirds of a scalar command),
  of numpy for sweeps and of rich for tables on a terminal.
* **Figures, reports, animations.** In `cam --plot` the imports of matplotlib and numpy take a third, drawing a fifth
  (half of it texts), making the panels an eighth and their layout a tenth. `gear --plot` draws six panels with symbols
  in mathematical type and the blocking contour, `swing --plot` eight panels; `press --plot` takes 1.36
  to 1.44 from run to run. A report computes and draws its commands in as many processes as there are processors. An
  animation with real teeth takes some 5 ms a frame for polygons, colours and encoding, in as many processes.
* **All examples.** The folder contains searches, studies and loads of a tenth to a whole second each (the function of a
  five-bar, a machine with loads, a study of motion laws). A folder of complete designs takes milliseconds each.
  A process of `check` takes the files of one kind together, since it builds the models of a kind once. Of `check` a
  third are imports and models of 25 kinds, a third the forces of six machines, a fifth four five-bars (170 linear
  programs of 0.3 ms, descents from 300 and 1500 starts). A round of a search under loads makes some hundred numpy calls
  and takes 1.5 to 4 ms, for two places as for two hundred; an extreme at a jump takes ten rounds and more.
* **Batch.** Reading and validating a small file takes 0.1 to 0.2 ms (libyaml and pydantic-core are compiled). Results
  and checks take 0.2 ms (slider-crank), 0.4 ms (gear pair) or 0.6 ms (synthesis with meshes, dwell and extremes): some
  forty quantities and checks of a command, 10 to 20 us of Python each. A second process is used from 0.15 s of work on,
  after four files where these tell that the rest takes as long. Two processes are 1.5 to 1.7 times as fast as one, and
  no faster on a busy machine: forking, sending results back and shared caches take the rest.
  `check`, and a summary without JSON and `--out`, compute the quantities that the checks use, and no table.
* **Studies by class.** Cams, grippers and wide swings are sought together, 0.5 to 3 ms a design; a wide swing with a
  slider takes 7 ms, a closed cycle 10 ms, most of it for cutting the contour, one on a crank-rocker (`drive`) 23 ms,
  for it is still computed by itself. In a machine or a press each design refines its extremes by itself as well.
* **Studio.** The key results are shown first, findings and animation follow from a second process, sheets when the
  slider rests. Results of commands that take more than 40 ms (loads, register, many searches) follow with the findings.
"""


@dataclass(frozen=True, slots=True)
class Goal:
    """A goal: what, the figure to reach, how it is read off the families."""

    what: str
    limit: float
    unit: str
    value: Callable[[dict[str, Family]], float]


def _row(
    family: str, method: str, field: str = "ratio", size: int | None = None
) -> Callable[[dict[str, Family]], float]:
    def read(found: dict[str, Family]) -> float:
        row = found[family].row(method, size)
        assert row is not None, (family, method, size)
        return float(getattr(row, field))

    return read


def goals(wide_vectors: bool) -> list[Goal]:
    """The goals; two of them depend on whether the machine has AVX-512."""
    start = [
        Goal(f"`{name}`, whole process, over a minimal Typer command", limit, "x", _row("start-up", name))
        for name, limit in (
            ("--version", 0.5),
            ("synth dwell, json", 1.3),
            ("synth dwell, table", 1.5),
            ("press, json", 2.2),
            ("cam, json", 2.2),
            ("explain", 1.3),
            ("schema", 1.3),
            ("new", 1.3),
        )
    ]
    seconds = [
        Goal(f"{what}, whole process", limit, "ns", _row(family, what, "nanoseconds"))
        for family, what, limit in (
            ("folders", "check of the examples", 0.6e9),
            ("folders", "batch of the examples", 0.6e9),
            ("pictures", "report, press", 1.5e9),
            ("pictures", "report, wide swing", 1.5e9),
            ("pictures", "animate, GIF", 1.5e9),
            ("pictures", "animate, HTML", 0.7e9),
        )
    ]
    waits = [
        Goal(f"`{what}` over five empty panels", 2.5 if what.startswith("report") else 1.4, "x", _row("pictures", what))
        for what in WAITS
        if not what.startswith("animate")
    ]
    angles = "closed form, angles"
    return [
        Goal(
            "four-bar, 2 derivatives, N = 1e6, over a numpy pass",
            1.0 if wide_vectors else 1.5,
            "x",
            _row("four-bar", angles),
        ),
        Goal("four-bar: error", 4.0, "eps", _row("four-bar", angles, "error")),
        Goal("four-bar, N = 1, scalar", 5000.0, "ns", _row("four-bar", "closed form, scalar", "nanoseconds", 1)),
        Goal(
            "inverse involute, 1e5 values",
            15.0,
            "ns",
            _row("involute", "rational start, one Newton step", "nanoseconds"),
        ),
        Goal("inverse involute: error", 2.0, "ulp", _row("involute", "rational start, one Newton step", "error")),
        Goal(
            "frame of the instantaneous dwell, 1e5 designs",
            20.0,
            "ns",
            _row("dwell", "frame: closed form", "nanoseconds"),
        ),
        *(
            Goal(
                f"design of a study, {command} with all checks",
                limit,
                "ns",
                _row("studies", f"{command}, at once", "nanoseconds"),
            )
            for command, limit in (
                ("synth dwell", 2000.0),
                ("synth variable-speed", 2000.0),
                ("synth back-step", 4000.0),
                ("synth momentary-dwell", 4000.0),
                ("analyze", 4000.0),
            )
        ),
        Goal(
            "press: both drives, zone, both cams, 3600 positions",
            3e6,
            "ns",
            _row("press", "chains, zone, both cams", "nanoseconds"),
        ),
        Goal("loads of a press, 360 positions", 5e6, "ns", _row("loads", "flatbed-press: all forces", "nanoseconds")),
        Goal(
            "cam profile, N = 1e6, over a numpy pass",
            1.5,
            "x",
            _row("cam", "envelope with all, in blocks of 8000, constant memory"),
        ),
        *start,
        *waits,
        *seconds,
        *(
            Goal(
                f"studio, {what}: to the key results",
                limit,
                "ns",
                _row("studio", f"{what}: key results", "nanoseconds"),
            )
            for what, limit in (
                ("feed, links.crank", 50e6),
                ("feed, dwell.window, idler chosen", 50e6),
                ("two gears, dwell.window, teeth given", 50e6),
                ("press, bed.rod", 120e6),
            )
        ),
        Goal(
            "1000 designs in a batch over reading their files", 2.0, "x", _row("batch", "batch, as the program chooses")
        ),
        Goal("100 presses in two processes over one", 1.0 / 1.6, "x", _row("parallel", "two processes")),
    ]


def peer_goals(peers: dict[str, Any]) -> list[Goal]:
    """The goals against other packages, in their times for one position of the largest sweep that they were given."""

    def over(method: str) -> Callable[[dict[str, Family]], float]:
        rows = [row for row in peers["rows"] if row["method"] == method]
        theirs = max(rows, key=lambda row: int(row["size"]))["ratio"]
        return lambda found: _row("four-bar", "closed form, angles")(found) / float(theirs)

    return [
        Goal("four-bar over pylinkage (numba)", 1.0 / 30.0, "x", over("pylinkage (numba)")),
        Goal("four-bar over mechanism", 1e-4, "x", over("mechanism")),
    ]


def goals_table(found: dict[str, Family], wanted: list[Goal]) -> str:
    """The goals as Markdown."""
    return "\n".join([*_GOALS_HEAD, *(f"| {goal.what} | {_goal_cells(goal, found)}" for goal in wanted)])


_GOALS_HEAD = ("## Goals", "", "| what | goal | reached | |", "|---|---:|---:|---|")


def _goal_cells(goal: Goal, found: dict[str, Family]) -> str:
    value = goal.value(found)
    shown = [duration(x) if goal.unit == "ns" else f"{x:.3g} {goal.unit}" for x in (goal.limit, value)]
    return f"{shown[0]} | {shown[1]} | {'met' if value <= goal.limit else 'missed'} |"


def peers_table(peers: dict[str, Any], found: dict[str, Family]) -> str:
    """What pylinkage and mechanism take for the same four-bar."""
    lines = ["## Peers: the same four-bar with velocities and accelerations", ""]
    lines += [", ".join(f"{name} {version}" for name, version in peers["versions"].items()), ""]
    lines += ["| method | N | time each | relative error | over a numpy pass |", "|---|---:|---:|---:|---:|"]
    for row in peers["rows"]:
        lines.append(
            f"| {row['method']} | {row['size']} | {duration(row['nanoseconds'])} | {row['error']:.1g} "
            f"| {row['ratio']:.3g} |"
        )
    own = found["four-bar"].row("closed form, angles")
    assert own is not None
    lines += ["", f"gearlink at N = {own.size}: {duration(own.nanoseconds)}, {own.ratio:.2f} passes.", ""]
    starts = ", ".join(f"{name} {1e3 * seconds:.0f} ms" for name, seconds in peers["starts"].items())
    lines.append(
        f"A process that imports the package and ends: {starts}. The error is the coupler pin's, for the crank"
    )
    lines.append("pin that the package itself gives.")
    return "\n".join(lines)


def renewed(page: str, found: dict[str, Family], wanted: list[Goal], here: dict[str, str]) -> str:
    """A page with the tables, goals and pictures of some families measured anew, and the texts as they are now."""
    blocks = ("\n" + page).split("\n## ")[1:]
    parts = {block.partition("\n")[0]: f"## {block.strip()}" for block in blocks}
    goals_then = dict(re.findall(r"^\| (.+?) \| (\S.*\|)$", parts["Goals"], re.MULTILINE))
    lines = []
    for goal in wanted:
        with suppress(KeyError):
            goals_then[goal.what] = _goal_cells(goal, found)
        if goal.what in goals_then:
            lines.append(f"| {goal.what} | {goals_then[goal.what]}")
    rest = [what for what in goals_then if what not in {goal.what for goal in wanted} | {"what"}]
    lines += [f"| {what} | {goals_then[what]}" for what in rest if not what.startswith("-")]
    parts["Goals"] = "\n".join([*_GOALS_HEAD, *lines])
    reasons = _REASONS.strip()
    parts[reasons.partition("\n")[0].removeprefix("## ")] = reasons
    own = as_markdown(list(found.values()), here, {name: f"bench-{name}.png" for name, f in found.items() if curves(f)})
    parts |= {block.partition("\n")[0]: f"## {block.strip()}" for block in own.split("\n## ")[1:]}
    return "\n\n".join([_HEAD.strip(), *parts.values()]) + "\n"


def main() -> None:
    """Measure all families, or those of the command line; write the page."""
    quick = "--quick" in sys.argv[1:]
    names = [name for name in sys.argv[1:] if name in FAMILIES]
    found = {}
    for name in names or FAMILIES:
        print(f"measuring {name} ...", file=sys.stderr)
        found[name] = measured(name, quick)
    here = machine()
    wanted, peers = goals(here["AVX-512"] == "yes"), None
    if PEERS.exists() and "four-bar" in found:
        print("measuring the peers ...", file=sys.stderr)
        done = subprocess.run([PEERS, ROOT / "bench" / "peers.py"], capture_output=True, text=True, check=True)
        peers = peers_table(json.loads(done.stdout), found)
        wanted += peer_goals(json.loads(done.stdout))
    if names:
        page = renewed((DOCS / "benchmarks.md").read_text(encoding="utf-8"), found, wanted, here)
        if peers is not None:
            page = re.sub(r"^## Peers.*?(?=^## )", lambda _: f"{peers}\n\n", page, flags=re.MULTILINE | re.DOTALL)
        _write(page, found)
        write_pictures(list(found.values()), DOCS, lambda text: print(text, file=sys.stderr))
        return
    pictures = write_pictures(list(found.values()), DOCS, lambda text: print(text, file=sys.stderr))
    parts = [_HEAD, goals_table(found, wanted), _REASONS, *([] if peers is None else [peers])]
    parts.append("## Machine\n\n" + as_markdown(list(found.values()), here, pictures))
    _write("\n\n".join(part.strip() for part in parts) + "\n", found)


def _write(page: str, found: dict[str, Family]) -> None:
    (DOCS / "benchmarks.md").write_text(page, encoding="utf-8")
    keep(found)
    print(f"wrote {DOCS / 'benchmarks.md'} and benchmarks.json", file=sys.stderr)


if __name__ == "__main__":
    main()
