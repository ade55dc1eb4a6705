"""Candidates side by side: each row is the design of the file with the row's keys, the file's own row among them."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import pytest
from factory import design, worked
from sweeps import mostly_slow

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.five_bar import design as five_bar_candidates
from gearlink.core.machines.five_bar import function_fit
from gearlink.core.machines.five_bar.function_motion import StructuralError

CASES = [
    ("mutilated_gear_times", "analyze", {"groups": "gears__groups", "driven_teeth": "gears__driven"}, "motion_turns"),
    ("ty460_slider_crank", "crank", {"rod": "rod", "offset": "offset"}, "crank_length"),
    ("ty460", "gear", {"module": "input_gears__module"}, "contact_ratio"),
    (
        "two_gear_standing",
        "synth dwell",
        {"planet_teeth": "gears__planet", "output_teeth": "gears__ring"},
        "frame_length",
    ),
    (
        "wide_lever",
        "analyze",
        {"coupler_gear_teeth": "gears__coupler", "output_teeth": "gears__output"},
        "crank_length",
    ),
]


@cache
def rows_of(name: str, command: str = "analyze") -> list[dict[str, Any]]:
    table = design(name, command=command).table("candidates")
    return [dict(zip(table.columns, row, strict=True)) for row in zip(*table.data, strict=True)]


@pytest.mark.parametrize(
    ("name", "command", "keys", "quantity"), mostly_slow(CASES, 3), ids=[case[0] for case in CASES]
)
def test_rows_are_designs_of_their_own(name: str, command: str, keys: dict[str, str], quantity: str) -> None:
    found = rows_of(name, command)
    assert len(found) >= 6
    made = [row for row in found if row[quantity] is not None]
    assert made
    for row in (made[0], made[-1]):
        own = design(name, command=command, **{key: row[column] for column, key in keys.items()})
        assert row[quantity] == own.quantity(quantity).value


@pytest.mark.parametrize(("name", "command"), mostly_slow([(case[0], case[1]) for case in CASES], 3))
def test_the_own_design_is_among_them(name: str, command: str) -> None:
    found, own = rows_of(name, command), design(name, command=command)
    names = [column for column in found[0] if column in own.quantity_names()]
    values = {column: own.quantity(column).value for column in names if own.quantity(column) is not None}
    same = [row for row in found if all(row[c] in (v, min(v) if isinstance(v, list) else v) for c, v in values.items())]
    assert same, "the file as it stands"


@pytest.mark.slow
def test_the_rods_of_every_rule() -> None:
    found = {row["rod"]: row for row in rows_of("hypocycloid_slider")}
    assert {"tangent-circle", "osculating", "minimax", "least-ripple"} <= set(found)
    made = design("hypocycloid_slider")
    assert found["osculating"]["rod_length"] == made.osculating_length
    least = min(row["dwell_ripple"] for row in found.values())
    assert math.isclose(found["least-ripple"]["dwell_ripple"], least, rel_tol=1e-9)


@pytest.mark.slow
def test_searches_of_a_five_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(five_bar_candidates, "_RATIOS", ())
    found = rows_of("five_bar_points")
    assert [row["assembly"] for row in found] == [1, -1]
    assert found[0]["path_deviation_rms"] == design("five_bar_points").path_deviation_rms


def test_what_was_found_is_not_searched_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """The row of the file's own gears is the design itself; its names of tables begin no search either."""
    made = design("five_bar_function")
    searched: list[float] = []

    def search(first: Any, *_: Any) -> Any:
        searched.append(first.coupler_ratio)
        raise NoSolution("nothing is looked for here")

    monkeypatch.setattr(function_fit, "fit_function", search)
    assert "search" in made.table_names_shown()
    assert searched == []
    error = StructuralError(1e-3, 0.0, (0.0, 1.0), (1e-3, -1e-3))
    made.__dict__["function_fit"] = function_fit.FunctionFit(made.start_function, 0.5, error, ())  # as if it was found
    table = made.table("candidates")
    assert len(searched) == table.length - 1 == 2
    assert table["structural_error"][0] == pytest.approx(math.degrees(1e-3), rel=1e-12)
    assert table["findings"][1] == "GL112 target.function"


@pytest.mark.slow
def test_a_mechanism_that_does_not_exist_says_why() -> None:
    found = rows_of("two_gear_standing", "synth dwell")
    assert any(row["frame_length"] is None and row["findings"].startswith("GL112 ") for row in found)


@pytest.mark.parametrize("name", ["mutilated_gear_press", "five_bar_path"])
def test_files_that_leave_nothing_to_be_found(name: str) -> None:
    with pytest.raises(NoSolution, match="determines everything"):
        design(name).table("candidates")
    with pytest.raises(NoSolution, match="determines everything"):
        design(worked("wide_lever"), target=None, links__crank=20.0).table("candidates")
