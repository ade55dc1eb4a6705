"""`gearlink verify`: the published cases are met, told in every form, and on the page.

Limits are those of the cases. The page has a digit less than what another processor rounds otherwise, so cells are
compared at one unit of their last digit.
"""

from __future__ import annotations

import json
import re
from itertools import chain, zip_longest
from pathlib import Path
from typing import Any

import pytest

from docs import generate
from gearlink.cli import completing
from gearlink.cli.commands import verify
from gearlink.cli.commands.verify import KERNELS, computed
from gearlink.cli.verification import cases
from gearlink.cli.verification.cases import Case, Source

ROOT = Path(__file__).resolve().parents[3]
ALL: list[Source] = [cases.read(name) for name in cases.names()]
CASES: list[Case] = [case for source in ALL for case in source.cases]
DIFFERING: list[Case] = [case for source in ALL for case in source.differs]
COLUMNS = ["case", "source", "name", "published", "computed", "difference", "limit", "ok", "unit"]
OFF = """source: A book
cases:
  - id: a-circle
    place: page 1
    command: crank
    design: {kind: slider-crank, stroke: 310, rod: 520, offset: 50}
    numbers:
      - {name: crank, published: "154.21", quantity: crank_length}
      - {name: crank that is off, published: "154.20", quantity: crank_length}
"""


@pytest.fixture
def injected(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of cases instead of the program's own."""
    monkeypatch.setattr(cases, "FOLDER", tmp_path)
    return tmp_path / "a-circle.yaml"


# The cases themselves


@pytest.fixture
def computed_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """The command and the page take the same numbers."""
    for module in (verify, generate):
        monkeypatch.setattr(module, "computed", lambda cases: chain.from_iterable(map(_outcomes, cases)))


_found: dict[str, list[Any]] = {}


def _outcomes(case: Case) -> list[Any]:
    key = repr(case)
    if key not in _found:
        _found[key] = list(computed([case]))
    return _found[key]


@pytest.mark.usefixtures("computed_once")
def test_everything_is_met_in_json(gearlink: Any) -> None:
    ended = gearlink("verify", "--format", "json")
    result = json.loads(ended.out)
    table = result["tables"]["cases"]
    rows = [dict(zip(table["columns"], row, strict=True)) for row in table["rows"]]
    assert [row for row in rows if not row["ok"]] == []
    assert (ended.status, result["kind"], result["ok"]) == (0, "verification", True)
    assert table["columns"] == COLUMNS
    counts = {name: quantity["value"] for name, quantity in result["quantities"].items()}
    assert counts == {"cases": len(CASES), "numbers": len(rows), "met": len(rows)}
    assert counts["numbers"] > 500
    for row in rows:
        assert row["difference"] == row["computed"] - row["published"]
        assert abs(row["difference"]) <= row["limit"] * (1.0 + 1e-9)


def test_what_is_known_to_differ_does() -> None:
    """Else it is a case like the others."""
    assert [(each.case.id, each.number.name) for each in computed(DIFFERING) if each.met] == []
    assert [case.id for case in DIFFERING if not case.why] == []


def test_cases_are_told_apart_and_named_after_their_file() -> None:
    ids = [case.id for case in (*CASES, *DIFFERING)]
    assert len(set(ids)) == len(ids)
    for source in ALL:
        assert source.read_at
        for case in (*source.cases, *source.differs):
            assert re.fullmatch(rf"{source.name}[a-z0-9.-]*", case.id), case.id
            assert case.place, case.id
            assert bool(case.command) != bool(case.kernel), case.id


def test_every_limit_is_half_a_digit_or_argued() -> None:
    for case in (*CASES, *DIFFERING):
        for number in case.numbers:
            plain = number.limit == cases.half_unit(number.published)
            assert plain or len(number.because) > 10, (case.id, number.name)
            assert number.scale in (1.0, 2.0, 0.5) or number.unit or number.limit < 1e-8, (case.id, number.name)
            assert number.name.isascii(), (case.id, number.name)


def test_every_kernel_serves_a_case() -> None:
    assert {case.kernel for case in CASES} - {""} == set(KERNELS)


def test_a_number_keeps_its_printed_digits() -> None:
    assert cases.half_unit("22.850") == 0.0005
    assert cases.half_unit("360") == 0.5
    for wrong in ("about 3", "NaN"):
        with pytest.raises((ArithmeticError, ValueError)):
            cases.half_unit(wrong)


# The command


def test_an_off_number_is_shown_and_gives_status_1(gearlink: Any, injected: Path) -> None:
    injected.write_text(OFF)
    ended = gearlink("verify")
    assert ended.status == 1
    assert re.search(r"crank that is off \[mm\] +154\.20 +154\.212 +0\.0116 +0\.005 +OFF$", ended.out, re.MULTILINE)
    assert "  crank [mm]" not in ended.out
    assert ended.out.endswith("1 of 2 numbers within their limit\n")
    result = json.loads(gearlink("verify", "-f", "json").out)
    assert (result["ok"], result["quantities"]["met"]["value"]) == (False, 1)


def test_a_refused_design_is_not_met_and_says_why(gearlink: Any, injected: Path) -> None:
    injected.write_text(OFF.replace("stroke: 310", "stroke: 1310"))
    ended = gearlink("verify")
    assert ended.status == 1
    assert "refused: " in ended.out
    assert "0 of 2 numbers within their limit" in ended.out
    row = json.loads(gearlink("verify", "-f", "json").out)["tables"]["cases"]["rows"][0]
    assert row[COLUMNS.index("computed")] is None
    assert row[COLUMNS.index("difference")] is None


def test_a_prefix_chooses_and_shows_every_number(gearlink: Any) -> None:
    ended = gearlink("verify", "khurmi-12.5", "KHURMI-12.7")
    assert ended.status == 0
    assert "R. S. Khurmi" in ended.out
    assert re.search(r"path of contact \[mm\] +28\.04 +28\.035 +-0\.0047 +0\.005$", ended.out, re.MULTILINE)
    assert ended.out.endswith("6 of 6 numbers within their limit\n")
    one = gearlink("verify", "khurmi-12.7", "-f", "csv")
    assert one.out.splitlines()[5].split(",") == COLUMNS


@pytest.mark.parametrize("form", ["table", "json"])
def test_a_prefix_that_no_case_has_is_refused(gearlink: Any, form: str) -> None:
    ended = gearlink("verify", "khurmi", "no-such-book", "--format", form)
    assert ended.status == 2
    assert "no case begins with 'no-such-book'" in ended.out + ended.err
    assert "ty460" in ended.out + ended.err


@pytest.mark.slow
def test_the_table_fits_80_columns(gearlink: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    for line in (("verify",), ("verify", "--all")):
        assert [row for row in gearlink(*line).out.splitlines() if len(row) > 80] == []


def test_a_shell_is_offered_the_cases() -> None:
    offered = [name for name, _ in completing.offered("published_cases", "thesis-ex")]
    assert offered == [case.id for case in CASES if case.id.startswith("thesis-ex")]
    assert [name for name, _ in completing.offered("published_cases", "")] == [case.id for case in CASES]


# The page


@pytest.mark.usefixtures("computed_once")
def test_the_page_is_that_of_the_cases() -> None:
    written = (ROOT / "docs" / "validation.md").read_text(encoding="utf-8").splitlines()
    for line, (now, then) in enumerate(zip_longest(generate.validation_text().splitlines(), written, fillvalue=""), 1):
        assert _same(now, then), f"line {line}, run `make docs`:\n{now}\n{then}"


def test_a_page_that_has_drifted_is_seen() -> None:
    assert _same("| x | 1.234 |", "| x | 1.235 |")
    assert not _same("| x | 1.234 |", "| x | 1.237 |")
    assert not _same("| x | 1.234 |", "| y | 1.234 |")
    assert not _same("words of 1.234", "words of 1.235")


def _same(now: str, then: str) -> bool:
    """Equal, cells of numbers within a unit of their last digit."""
    if now == then:
        return True
    a, b = now.split(" | "), then.split(" | ")
    return len(a) == len(b) > 1 and all(map(_near, a, b))


def _near(a: str, b: str) -> bool:
    a, b = a.strip("| "), b.strip("| ")
    if a == b:
        return True
    number = re.compile(r"-?\d+(\.\d+)?(e[-+]\d+)?")
    if not (number.fullmatch(a) and number.fullmatch(b)):
        return False
    unit = 10.0 ** min(cases.decimals(a), cases.decimals(b))
    return abs(float(a) - float(b)) < 1.5 * unit


def test_computed_numbers_have_a_digit_more_than_published_ones() -> None:
    case = next(case for case in CASES if case.id == "khurmi-12.7-internal")
    (outcome,) = computed([case])
    assert (verify.computed_digits(outcome), verify.difference(outcome), verify.limit(outcome)) == (
        "28.035",
        "-0.0047",
        "0.005",
    )
