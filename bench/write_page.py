"""Writes docs/benchmarks.md and its pictures: goals with what was reached, tables of all families, the peers."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bench.families import FAMILIES, measured
from bench.page import as_markdown, duration, write_pictures
from bench.pictures import WAITS
from bench.timing import Family, machine

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
PEERS = ROOT / "bench" / ".venv" / "bin" / "python"

_HEAD = """# Run time against error

Written by `make bench` (`python -m bench` prints the tables alone). Every time is a median of rounds in which all
methods of a table take their turn, so ratios within a table hold even on a busy machine; single times do not.
Errors are against 30 digits and more on a sample.
"""
_REASONS = """## Where a goal is missed, and why

* **Small arrays.** A numpy call costs 0.3 to 1 us whatever its size, and the sweep makes some seventy: up to a few
  hundred positions the scalar kernel or the textbook form is the faster one. The program takes the scalar kernel
  (2 to 3 us) for single positions.
* **Times in ns and ms**, and those against pylinkage, are goals for an idle machine with AVX-512, where numpy's sine,
  cosine, arc tangent and square root take eight numbers at a time; AVX-512 and load are said under Machine. With it the
  same code reached 0.98 passes for the four-bar, 0.031 of pylinkage's time, 8.7 ns for the inverse involute, 19 ns for
  the frame, 2.7 ms for the press and 1.43 passes for the cam profile. Without it those functions take three to five
  times as long, and a goal in ns is not to be had from them; what numba compiles does not lose as much. Compare the
  ratios to the numpy pass.
* **Momentary frame.** The goal is that of a call that stands alone; in this table, between others, the caches are cold
  and the arrays of results are new pages each time. phi13 has no goal: what studies use takes some Newton steps inside
  a bracket and freezes each design that rests, so that its last bit does not depend on its neighbours.
* **Cam profile.** Points alone take less than a pass. The whole profile in one go writes seven columns (two complex,
  three real) where the pass writes four into arrays that are there: new pages from the system, not arithmetic, are
  the remainder. In blocks it stays in the cache, at constant memory.
* **Start-up.** Plain command lines are read without Typer, pydantic's search for plug-ins is switched off, and its
  models are built when a file needs them; what remains is the import of pydantic (which Typer's own floor includes, and
  which is two thirds of a scalar command), of numpy for sweeps, and of rich for tables on a terminal.
* **Pictures, reports, films.** Of `cam --plot`, the imports of matplotlib and numpy are a third, drawing a fifth (half
  of it words), making the panels an eighth and their layout a tenth; words are measured once, and stand where they were
  measured. `gear --plot` draws six panels with symbols set as mathematics, and the blocking contour, a tenth of its
  time: some two thousand roots and forty thousand values of pairs, as arrays. A report computes and draws its commands
  in as many processes as there are processors, each the next that none has taken. A film of a machine with true teeth
  spends its time on polygons, reduction and encoding, some 10 ms a frame, drawn in as many processes as there are
  processors.
* **All examples.** The folder holds searches, studies and loads of a second or two each (a five-bar's function, a
  press with its joint forces, a study of gripper cams); a folder of designs that are complete takes milliseconds each.
* **Batch.** Reading and validating a small file takes 0.1 to 0.2 ms, for libyaml and pydantic-core are compiled; the
  results and checks take 0.1 ms (slider-crank), 0.6 ms (gear pair) and 1.6 ms (synthesis with its meshes, dwell and
  extremes) a design in Python. What cannot refuse a pair of gears, as its measures over pins, is computed where it is
  shown alone. The program takes a second process from 0.15 s of work on.
  Two processes are 1.5 to 1.7 times as fast as one, on small designs and on presses, on a busy machine no faster at
  all: forking, sending results back and the caches that both cores share are the rest. Where the output
  shows findings alone (everything but JSON and `--out`), quantities are computed, since they tell whether there is a
  mechanism at all, but put into no words, and no table is computed.
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
    vectors = "closed form, unit vectors"
    return [
        Goal(
            "four-bar, 2 derivatives, N = 1e6, over a numpy pass",
            1.0 if wide_vectors else 1.5,
            "x",
            _row("four-bar", vectors),
        ),
        Goal("its error", 4.0, "eps", _row("four-bar", vectors, "error")),
        Goal("four-bar, N = 1, scalar", 5000.0, "ns", _row("four-bar", "closed form, scalar", "nanoseconds", 1)),
        Goal(
            "inverse involute, 1e5 values",
            15.0,
            "ns",
            _row("involute", "rational start, one Newton step", "nanoseconds"),
        ),
        Goal("its error", 2.0, "ulp", _row("involute", "rational start, one Newton step", "error")),
        Goal("momentary frame, 1e5 designs", 20.0, "ns", _row("dwell", "frame: closed form", "nanoseconds")),
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
            "press: chains, zone, both cams, 3600 positions",
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
        return lambda found: _row("four-bar", "closed form, unit vectors")(found) / float(theirs)

    return [
        Goal("four-bar over pylinkage (numba)", 1.0 / 30.0, "x", over("pylinkage (numba)")),
        Goal("four-bar over mechanism", 1e-4, "x", over("mechanism")),
    ]


def goals_table(found: dict[str, Family], wanted: list[Goal]) -> str:
    """The goals as Markdown."""
    lines = ["## Goals", "", "| what | goal | reached | |", "|---|---:|---:|---|"]
    for goal in wanted:
        value = goal.value(found)
        shown = [duration(x) if goal.unit == "ns" else f"{x:.3g} {goal.unit}" for x in (goal.limit, value)]
        lines.append(f"| {goal.what} | {shown[0]} | {shown[1]} | {'met' if value <= goal.limit else 'missed'} |")
    return "\n".join(lines)


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
    own = found["four-bar"].row("closed form, unit vectors")
    assert own is not None
    lines += ["", f"gearlink at N = {own.size}: {duration(own.nanoseconds)}, {own.ratio:.2f} passes.", ""]
    starts = ", ".join(f"{name} {1e3 * seconds:.0f} ms" for name, seconds in peers["starts"].items())
    lines.append(
        f"A process that imports the package and ends: {starts}. The error is the coupler pin's, for the crank"
    )
    lines.append("pin that the package itself gives.")
    return "\n".join(lines)


def main() -> None:
    """Measure, write, say where."""
    quick = "--quick" in sys.argv[1:]
    found = {}
    for name in FAMILIES:
        print(f"measuring {name} ...", file=sys.stderr)
        found[name] = measured(name, quick)
    here = machine()
    pictures = write_pictures(list(found.values()), DOCS, lambda text: print(text, file=sys.stderr))
    wanted = goals(here["AVX-512"] == "yes")
    parts = [_REASONS]
    if PEERS.exists():
        print("measuring the peers ...", file=sys.stderr)
        done = subprocess.run([PEERS, ROOT / "bench" / "peers.py"], capture_output=True, text=True, check=True)
        peers = json.loads(done.stdout)
        wanted += peer_goals(peers)
        parts.append(peers_table(peers, found))
    parts = [_HEAD, goals_table(found, wanted), *parts]
    parts.append("## Machine\n\n" + as_markdown(list(found.values()), here, pictures))
    (DOCS / "benchmarks.md").write_text("\n\n".join(part.strip() for part in parts) + "\n", encoding="utf-8")
    record = {
        name: {f"{row.method}, {row.size}": float(f"{row.ratio:.4g}") for row in family.rows}
        for name, family in found.items()
    }
    (DOCS / "benchmarks.json").write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    print(f"wrote {DOCS / 'benchmarks.md'} and benchmarks.json", file=sys.stderr)


if __name__ == "__main__":
    main()
