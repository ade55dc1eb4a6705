"""Six-bars whose searches run together have what each finds by itself.

Tolerance: 1e-12 of a value, for positions that are computed beside others; places of extremes to the root of that.
"""

from __future__ import annotations

from typing import Any

import pytest
from six_bars import SIX_BARS
from sweeps import spread

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.six_bar.design import GearedSixBar
from gearlink.core.studies.explore.base import Base, single, singles

RANGE = {"range": {"start": -40, "end": 60}}
FILES = {name: {key: value for key, value in data.items() if key != "loads"} for name, data in SIX_BARS.items()}
CASES = [*((name, {}) for name in FILES), *((name, RANGE) for name in list(FILES)[:2])]


def _rows(data: dict[str, Any], count: int, by: float = 0.02) -> list[list[tuple[str, Any]]]:
    sizes = [(f"{part}.{key}", value) for part in ("links", "start") for key, value in data[part].items()]
    return [[(key, value + by * ((i * (k + 2)) % count)) for k, (key, value) in enumerate(sizes)] for i in range(count)]


@pytest.mark.quick(1)
@pytest.mark.parametrize(("name", "more"), CASES)
def test_six_bars_of_a_study_are_those_of_each_alone(name: str, more: dict[str, Any]) -> None:
    base = Base(FILES[name] | more, "analyze")
    names = [each for each in base.design().outline("analyze").quantities if base.design().raw(each) is not None]
    codes, rows = list(base.codes), _rows(base.data, 9)
    for row, many in spread(zip(rows, singles(base, rows, names, codes), strict=True), 2):
        alone = single(base, row, names, codes)
        assert alone.refused == many.refused == ""
        for each, value in alone.values.items():
            exact = {"abs": 2e-5} if each.endswith("_at") else {"rel": 1e-12, "abs": 1e-12}
            assert many.values[each] == (value if value is None else pytest.approx(value, **exact)), each
        assert [(c.code, c.status, c.what) for c in alone.findings] == [
            (c.code, c.status, c.what) for c in many.findings
        ]


def test_all_that_is_searched_for_is_found_together() -> None:
    base = Base(FILES["free gear on B"], "analyze")
    designs: list[Any] = [base.design(row) for row in _rows(base.data, 9)]
    stuck = base.design([("links.frame", 500.0)])
    with pytest.raises(NoSolution):
        stuck.raw("output_swing")
    GearedSixBar.find_together([*designs, stuck], ["output_swing", "gear-collision", "transmission-angle"])
    kept = {"speed_turnings", "acceleration_turnings", "dwell_crank_angles", "_transmission", "moving_reaches"}
    assert all(kept <= set(vars(design)) for design in designs)
    assert len({str(design.speed_turnings) for design in designs}) == 9
    assert not kept & set(vars(stuck))
