"""Prints the tables of families: `python -m bench [--quick] [FAMILY ...]` in the folder of the checkout."""

from __future__ import annotations

import argparse
import sys

from bench.families import FAMILIES, measured
from bench.page import as_text
from bench.timing import machine


def main(arguments: list[str]) -> None:
    """Measure the families that are named, or all, and print their tables."""
    parser = argparse.ArgumentParser(prog="python -m bench", description="Run time against error of the solvers.")
    parser.add_argument("families", nargs="*", metavar="FAMILY", help=", ".join(FAMILIES))
    parser.add_argument("--quick", action="store_true", help="fewer rounds, nothing above 1e5")
    asked = parser.parse_args(arguments)
    names = asked.families or FAMILIES
    if wrong := [name for name in names if name not in FAMILIES]:
        parser.error(f"no family {', '.join(wrong)}; the families are {', '.join(FAMILIES)}")
    found = []
    for name in dict.fromkeys(names):
        print(f"measuring {name} ...", file=sys.stderr)
        found.append(measured(name, asked.quick))
    print(as_text(found, machine()))


if __name__ == "__main__":
    main(sys.argv[1:])
