"""Compares what the program takes today with docs/benchmarks.json: ratios to the floors of the same run.

A ratio that is more than a quarter above the one on record fails, after two further measurements of its family: a busy
machine slows both sides, but not always alike. Processors with AVX-512 have a record of their own, for there numpy's
part of the work takes a third of the time. `python -m bench.guard --record [FAMILY]` renews the record of the class of
this machine without the page.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from bench.families import measured
from bench.timing import Family, machine

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


def record() -> dict[str, dict[str, float]]:
    """What is on record of processors such as this one, by family and method: ratios."""
    whole: dict[str, dict[str, dict[str, float]]] = json.loads(RECORD.read_text(encoding="utf-8"))
    return whole.get(_class(), {})


def keep(families: dict[str, Family]) -> None:
    """Put the ratios of these families on record."""
    whole = json.loads(RECORD.read_text(encoding="utf-8"))
    own = whole.setdefault(_class(), {})
    for name, family in families.items():
        own[name] = {f"{row.method}, {row.size}": float(f"{row.ratio:.4g}") for row in family.rows}
    RECORD.write_text(json.dumps(whole, indent=1) + "\n", encoding="utf-8")


def _class() -> str:
    return "with AVX-512" if machine()["AVX-512"] == "yes" else "without AVX-512"


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
    """Measure the families of the command line, or all; say what is slower, or keep it; give the exit status."""
    names = [name for name in sys.argv[1:] if name != "--record"] or FAMILIES
    if "--record" in sys.argv[1:]:
        keep({name: measured(name, quick=True) for name in names})
        return 0
    known, found = record(), 0
    for name in names:
        print(f"measuring {name} ...", file=sys.stderr)
        try:
            late = slower(name, known.get(name, {}))
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
