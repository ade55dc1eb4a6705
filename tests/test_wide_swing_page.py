"""The page on wide swings: its table of convergence and its numbers are what the engine gives.

Tolerance: orders of magnitude in the table; the last of them, near rounding, are shown as < 1e-12.
"""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest
from factory import DESIGNS, design
from oracles.unloading_limits import energy_parameter, iterated

from gearlink.core.base.nomenclature import TERMS
from gearlink.core.machines.wide_swing.device import Pneumatic
from gearlink.core.machines.wide_swing.law import ElasticLaw, legacy_law

PAGE = Path(__file__).resolve().parents[1] / "docs" / "wide_swing.md"
NODES = (2, 4, 8, 16, 32, 64)
CASES = ((2.5, 120.0), (1.5, 180.0), (1.2, 300.0), (1.05, 300.0))
MARK = "<!-- convergence -->\n"


def convergence() -> str:
    """The table of nodes against error; printed by `python tests/test_wide_swing_page.py`, which writes it."""
    rows = ["| nodes | " + " | ".join(f"ratio {ratio:g}, {swing:g} deg" for ratio, swing in CASES) + " |"]
    rows.append("|" + " ---: |" * (len(CASES) + 1))
    laws = [ElasticLaw(Pneumatic(ratio), math.radians(swing)) for ratio, swing in CASES]
    for nodes in NODES:
        errors = [abs(energy_parameter(law, nodes) / law.energy_parameter - 1.0) for law in laws]
        rows.append(f"| {nodes} | " + " | ".join(f"{e:.0e}" if e > 1e-12 else "< 1e-12" for e in errors) + " |")
    return "\n".join(rows) + "\n"


def test_convergence_table() -> None:
    assert MARK + "\n" + convergence() in PAGE.read_text()


@pytest.mark.slow
def test_numbers_of_the_iteration() -> None:
    law, device = ElasticLaw(Pneumatic(2.5), math.radians(120.0)), Pneumatic(2.5)
    for steps, error in ((10, 2.7e-3), (20, 6.6e-4), (100, 2.65e-5)):
        found = legacy_law(device, law.swing, steps=steps).energy_parameter / law.energy_parameter - 1.0
        assert found == pytest.approx(error, rel=0.03, abs=0.0)
    assert legacy_law(device, law.swing, steps=20).passes <= 16
    with pytest.raises(ArithmeticError, match="no end in 100 passes"):
        iterated(4.0, math.radians(300.0), steps=20, exponent=2)


@pytest.mark.slow
def test_passes_of_the_worked_designs() -> None:
    found = [
        design(path.stem, command="swing", method="iteration").quantity("iteration_passes").value
        for path in sorted(DESIGNS.glob("wide_swing_*.yaml"))
    ]
    words = re.search(r"(\d+) to (\d+) passes in the\s+examples", PAGE.read_text())
    assert words, "the page says how many"
    assert [int(word) for word in words.groups()] == [min(found), max(found)]


def test_what_the_longer_stroke_has_to_spare() -> None:
    """Page, nomenclature and GL510 have the quantity's formula; the comment of the design rounds it."""
    made = design("wide_swing_cycle", command="swing")
    found = made.quantity("longer_stroke_reserve").value
    working, _, back, _ = made.spec.cycle.lengths
    assert found == pytest.approx((1.0 + made.spec.unloader.reserve) * (back / working) ** 2 - 1.0, rel=1e-12, abs=0.0)
    for words in (PAGE.read_text(), TERMS["longer_stroke_reserve"].words):
        assert "(1 + rho)(longer/shorter)^2 - 1" in words
    assert "angles of strokes and dwells" in next(iter(made.check("cycle-angles"))).message
    assert f"reserve is {found:.2f} of the required force" in (DESIGNS / "wide_swing_cycle.yaml").read_text()


def test_constants_of_formula_3() -> None:
    q = 13.0 / 9.0
    assert round(2.0 * q * q, 4) == 4.1728
    assert round(0.5 / (q * q - 1.0), 3) == 0.460
    assert round((0.5 / (q * q - 1.0)) ** 2, 3) == 0.212


if __name__ == "__main__":
    head, _, rest = PAGE.read_text().partition(MARK)
    PAGE.write_text(head + MARK + "\n" + convergence() + rest[rest.index("\n`gearlink` doubles") :])
