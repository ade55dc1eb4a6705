"""Compares what the program takes today with docs/benchmarks.json: ratios to the floors of the same run.

A ratio that is more than a quarter above the one on record fails, after two further measurements of its family: a busy
machine slows both sides, but not always alike.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from gearlink.cli.bench.families import measured

RECORD = Path(__file__).resolve().parents[1] / "docs" / "benchmarks.json"
FAMILIES = ("start-up", "pictures", "four-bar", "involute", "press", "studies")
ALLOWED = 1.25
TRIES = 3


def slower(name: str, recorded: dict[str, float]) -> dict[str, tuple[float, float]]:
    """Methods of a family that are slower than on record: the least ratio of several tries, and that on record."""
    best: dict[str, float] = {}
    for _ in range(TRIES):
        for row in measured(name, quick=True).rows:
            key = f"{row.method}, {row.size}"
            best[key] = min(row.ratio, best.get(key, row.ratio))
        late = {k: (best[k], recorded[k]) for k in best if k in recorded and best[k] > ALLOWED * recorded[k]}
        if not late:
            return {}
    return late


def main() -> int:
    """Measure, say what is slower, give the exit status."""
    record = json.loads(RECORD.read_text(encoding="utf-8"))
    found = 0
    for name in FAMILIES:
        print(f"measuring {name} ...", file=sys.stderr)
        for what, (now, then) in slower(name, record.get(name, {})).items():
            found += 1
            print(f"{name}: {what}: {now:.3g} times its floor, {then:.3g} on record")
    print("nothing is slower than on record" if not found else f"{found} slower than on record (a quarter is allowed)")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
