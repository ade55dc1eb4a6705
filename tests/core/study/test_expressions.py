"""Expressions of study files: values against Python's own, units, and what cannot be read. Values are exact."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gearlink.core.studies.study.expressions import NotAnExpression, parse

QUANTITIES = {"a": 3.0, "b.c[1]": -2.5, "d_2": 7.0}
UNITS = {"a": "mm", "b.c[1]": "mm", "d_2": "deg"}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("a", 3.0),
        ("1 + 2 * 3 - 4 / 8", 6.5),
        ("-(a - d_2) * 2", 8.0),
        ("--a - -1", 4.0),
        ("b.c[1] / a", -2.5 / 3.0),
        ("max(a, d_2, 1) - min(a)", 4.0),
        ("abs(b.c[1]) + sqrt(a * a)", 5.5),
        ("10 - 4 - 3", 3.0),
        ("16 / 4 / 2", 2.0),
        ("1e-3*a", 0.003),
    ],
)
def test_values(text: str, value: float) -> None:
    assert parse(text).value(QUANTITIES) == value
    arrays = {name: np.full(3, number) for name, number in QUANTITIES.items()}
    assert (np.broadcast_to(parse(text).value(arrays), 3) == value).all()


def test_what_does_not_exist_is_no_number() -> None:
    assert math.isnan(parse("1 / sqrt(-1)").value(QUANTITIES))
    assert math.isnan(parse("sqrt(b.c[1])").value(QUANTITIES))
    assert not math.isfinite(parse("a / (a - 3)").value(QUANTITIES))


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("a + b.c[1]", "mm"),
        ("2 * a", "mm"),
        ("a / 2", "mm"),
        ("a + 1", "mm"),
        ("abs(a)", "mm"),
        ("min(a, b.c[1])", "mm"),
        ("a + d_2", None),
        ("a * a", None),
        ("a / a", None),
        ("2 / a", None),
        ("sqrt(a)", None),
        ("2 + 3", None),
    ],
)
def test_units(text: str, unit: str | None) -> None:
    assert parse(text).unit(UNITS.__getitem__) == unit


@pytest.mark.parametrize(
    ("text", "at"),
    [
        ("", 0),
        ("a +", 3),
        ("a b", 2),
        ("(a", 2),
        ("a)", 1),
        ("f(a)", 1),
        ("a ? b", 2),
        ("sqrt(a, a)", 10),
        ("a[x]", 1),
        ("a / 0", 4),
        ("a/(1-1)", 2),
        ("1/-0.0", 2),
        ("a * 2 / min(0, 1)", 8),
    ],
)
def test_what_is_no_expression(text: str, at: int) -> None:
    with pytest.raises(NotAnExpression) as caught:
        parse(text)
    assert caught.value.at == at


def test_brackets_without_end() -> None:
    for text in ("(" * 1_000, "(" * 200 + "a" + ")" * 200, "a" * 5000):
        with pytest.raises(NotAnExpression):
            parse(text)


@given(st.text(alphabet="ab1.+-*/()[], ", max_size=20))
def test_any_text_is_read_or_refused(text: str) -> None:
    try:
        found = parse(text)
    except NotAnExpression:
        return
    found.value(dict.fromkeys(found.names, 2.0))
