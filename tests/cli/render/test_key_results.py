"""The key results on a terminal: what is shown, in how many digits, and what `--all` adds."""

from __future__ import annotations

import json
import math
from typing import Any

import pytest
from factory import DESIGNS
from hypothesis import given
from hypothesis import strategies as st

from gearlink.cli.render import key_results
from gearlink.cli.render.numbers import drawn

FEED = DESIGNS / "standing_feed.yaml"


@pytest.fixture(autouse=True)
def _eighty_columns(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")


def test_the_answer_stands_in_the_first_rows_of_one_screen(gearlink: Any) -> None:
    lines = gearlink("synth", "dwell", FEED).out.splitlines()
    assert lines[1].split() == ["dwell", "71.07", "deg", "(required", "70)", "tolerance_dwell_angle"]
    assert lines[2].split()[-5:] == ["0.44", "deg", "(at", "most", "0.5)", "dwell_tolerance"][-5:]
    assert lines[-2:] == ["24 more quantities: --all", "checks: 32 pass"]
    assert len(lines) <= 24
    assert max(map(len, lines)) <= 80


def test_all_shows_every_quantity_table_and_check(gearlink: Any) -> None:
    data = json.loads(gearlink("analyze", FEED, "--format", "json").out)
    brief, whole = gearlink("analyze", FEED).out, gearlink("analyze", FEED, "--all").out
    for name in data["quantities"]:
        assert f"\n{name} " in whole
    assert "\nmotion" in whole
    assert "\nmotion, every" not in brief
    assert "GL301" in whole
    assert "GL301" not in brief


def test_a_table_that_is_asked_for_is_shown(gearlink: Any) -> None:
    shown = gearlink("analyze", FEED, "--table", "motion").out
    assert "\nmotion, every 15th of 360 rows" in shown
    assert "24 more quantities: --all" in shown
    assert "checks: 32 pass" in shown


def test_checks_that_do_not_pass_are_shown_and_the_others_counted(gearlink: Any) -> None:
    ended = gearlink("analyze", DESIGNS / "thesis_example_3_as_printed.yaml")
    assert ended.status == 1
    assert "gear-collision" in ended.out
    assert "tooth-form" not in ended.out
    assert ended.out.splitlines()[-1] == "checks: 1 fail, 1 warn, 27 pass"


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("digits", "shown"), [("3", "71.1"), ("7", "71.06686"), ("full", "71.0668600816"), ("17", "71.0668600816")]
)
def test_digits_are_those_asked_for(gearlink: Any, digits: str, shown: str) -> None:
    for more in ((), ("--all",)):
        assert f" {shown}" in gearlink("synth", "dwell", FEED, "--digits", digits, *more).out


@pytest.mark.parametrize("digits", ["0", "18", "few", "-1", ""])
def test_digits_that_are_none_are_refused(gearlink: Any, digits: str) -> None:
    ended = gearlink("synth", "dwell", FEED, "--digits", digits)
    assert ended.status == 2
    assert "--digits" in ended.err


@pytest.mark.quick(1)
@pytest.mark.parametrize("form", ["json", "csv", "md"])
def test_the_other_forms_stay_complete_and_in_full_precision(gearlink: Any, form: str) -> None:
    whole = gearlink("synth", "dwell", FEED, "--format", form).out
    assert whole == gearlink("synth", "dwell", FEED, "--format", form, "--digits", "3", "--all").out
    assert "frame_ratio_interval" in whole
    assert "GL212" in whole


def test_a_quantity_by_name_is_in_full_precision(gearlink: Any) -> None:
    shown = gearlink("synth", "dwell", FEED, "--quantity", "crank_length", "--digits", "3").out
    assert len(shown.split()[0]) > 10


@given(
    st.floats(min_value=-1e6, max_value=1e6).filter(lambda x: abs(x) > 1e-9), st.sampled_from(["mm", "deg", "1", "N"])
)
def test_what_is_drawn_is_near(value: float, unit: str) -> None:
    """To half of the last digit: of 0.001 mm or 0.01 deg, or of the second digit that counts; else of the fourth."""
    exponent = math.floor(math.log10(abs(value)))
    places = {"mm": 3, "deg": 2}.get(unit)
    step = 10.0 ** (exponent - 3) if places is None else 10.0 ** min(-places, exponent - 1)
    assert abs(float(drawn(value, unit)) - value) <= 0.5 * step * (1.0 + 1e-9)


def test_long_lists_run_on_below_their_first_value() -> None:
    """Numbers as many as there is space for, texts one by one; what is short stays as it is."""
    numbers = "flips  " + " ".join(f"{k}.00" for k in range(10, 40)) + " deg"
    folded = key_results._folded(numbers, 40, " " * 7)
    assert max(map(len, folded)) <= 40
    assert " ".join(line.strip() for line in folded) == numbers
    texts = key_results._folded("limiting  a before b by 5; b before c by 2", 30, " " * 10)
    assert texts == ["limiting  a before b by 5;", "          b before c by 2"]
    assert key_results._folded("short  1 2", 40, " " * 7) == ["short  1 2"]
