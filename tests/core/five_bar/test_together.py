"""Five-bars whose extremes are sought together have what each finds by itself.

Tolerance: 1e-12 of a value; places of extremes to the root of rounding.
"""

from __future__ import annotations

from typing import Any

import factory
import pytest
from sweeps import spread

from gearlink.core.base.spec_paths import number_at
from gearlink.core.studies.explore.base import Base, single, singles

VARIED = {
    "five_bar_function_tolerances": ("links.follower", "links.frame", "range.end"),
    "five_bar_path": ("links.coupler", "links.follower", "coupler_point.along"),
}
KEPT = {"five_bar_function_tolerances": {"motion_extremes"}, "five_bar_path": {"motion_extremes", "_extent"}}


@pytest.mark.parametrize("name", VARIED)
def test_five_bars_of_a_study_are_those_of_each_alone(name: str) -> None:
    data = {key: value for key, value in factory.worked(name).items() if key not in ("tolerance", "register")}
    base = Base(data, "analyze")
    design: Any = base.design()
    names = [each for each in design.outline("analyze").quantities if design.raw(each) is not None]
    codes, spec = list(base.codes), base.spec()
    rows = [[(key, float(number_at(spec, key)) * (1.0 + 1e-4 * ((i * (k + 2)) % 9))) for k, key in
             enumerate(VARIED[name])] for i in range(9)]  # fmt: skip
    for row, many in spread(zip(rows, singles(base, rows, names, codes), strict=True), 2):
        alone = single(base, row, names, codes)
        assert alone.refused == many.refused == ""
        for each, value in alone.values.items():
            exact = {"abs": 2e-5} if each.endswith("_at") else {"rel": 1e-12, "abs": 1e-12}
            assert many.values[each] == (value if isinstance(value, str) else pytest.approx(value, **exact)), each
        shown = [[(c.code, c.status, c.what) for c in one.findings] for one in (alone, many)]
        assert shown[0] == shown[1]
    designs = [base.design(row) for row in rows]
    type(design).find_together(designs, names)
    assert all(KEPT[name] <= set(vars(one)) for one in designs)
    assert len({str(vars(one)["motion_extremes"]) for one in designs}) == len(designs)
