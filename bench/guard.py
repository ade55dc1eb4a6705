"""Compares what the program takes today with docs/benchmarks.json: ratios to the floors of the same run.

A ratio that is more than a quarter above the one on record fails, after two further measurements of its family: a busy
machine slows both sides, but not always alike.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from bench.families import measured

RECORD = Path(__file__).resolve().parents[1] / "docs" / "benchmarks.json"
FAMILIES = (
    *("start-up", "pictures", "four-bar", "involute", "press", "studies"),
    *("planar", "planar-samples", "cam-size", "crank-rocker", "cam-samples", "drum-samples"),
    *("motion-laws", "machines", "kinds"),
)
"""Start-up, reports and pictures, kernels, kinds: those whose quick tables have rows of the whole ones."""
OTHERS = ("tan a - a", "brentq", "textbook", "scipy", "Typer with", "python, doing", "Newton", "double-double")
"""How the names of methods begin that are there for comparison: nobody here makes them slower."""
ALLOWED = 1.25
TRIES = 3


def slower(name: str, recorded: dict[str, float]) -> dict[str, tuple[float, float]]:
    """Methods of a family that are slower than on record: the minimum ratio of several tries, and that on record.

    Raises
        LookupError - where the record has none of the family's methods, so that nothing would be compared
    """
    best: dict[str, float] = {}
    late: dict[str, tuple[float, float]] = {}
    for _ in range(TRIES):
        for row in (row for row in measured(name, quick=True).rows if not row.method.startswith(OTHERS)):
            key = f"{row.method}, {row.size}"
            best[key] = min(row.ratio, best.get(key, row.ratio))
        known = [key for key in best if key in recorded]
        if not known:
            raise LookupError(f"{RECORD.name} has nothing of {name}: make bench")
        late = {key: (best[key], recorded[key]) for key in known if best[key] > ALLOWED * recorded[key]}
        if not late:
            break
    return late


def main() -> int:
    """Measure the families of the command line, or all; say what is slower; give the exit status."""
    record = json.loads(RECORD.read_text(encoding="utf-8"))
    found = 0
    for name in sys.argv[1:] or FAMILIES:
        print(f"measuring {name} ...", file=sys.stderr)
        try:
            late = slower(name, record.get(name, {}))
        except LookupError as error:
            found += 1
            print(f"{name}: {error.args[0]}")
            continue
        for what, (now, then) in late.items():
            found += 1
            print(f"{name}: {what}: {now:.3g} times its floor, {then:.3g} on record")
    print(
        "nothing is slower than on record"
        if not found
        else f"{found} slower than on record, or not there (a quarter is allowed)"
    )
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
