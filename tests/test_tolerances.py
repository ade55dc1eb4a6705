"""Each comparison says how near: the tolerances of numpy and pytest would stand in silently for those of a head."""

from __future__ import annotations

import re
from pathlib import Path

TESTS = Path(__file__).parent
SILENT = {"assert_allclose": ("rtol=",), "allclose": ("rtol=", "atol="), "isclose": ("rtol=", "atol=")}
"""numpy's comparisons, and what each adds when it is not told: rtol 1e-7 and atol 0, or rtol 1e-5 and atol 1e-8."""
_CALL = re.compile(rf"\bnp(?:\.testing)?\.({'|'.join(SILENT)})\(|\bpytest\.approx\(")
_TOLD = re.compile(r"\b(?:rel|abs)=|\*\*")
"""pytest adds rel 1e-6 where neither is given, and nothing to the one that is."""


def silent_tolerances(text: str) -> list[str]:
    """Calls that leave a tolerance to numpy or pytest, by their text up to the closing bracket."""
    found = []
    for call in _CALL.finditer(text):
        depth, end = 1, call.end()
        while depth:
            depth += {"(": 1, ")": -1}.get(text[end], 0)
            end += 1
        whole = text[call.start() : end]
        told = all(word in whole for word in SILENT[call[1]]) if call[1] else _TOLD.search(whole)
        if not told:
            found.append(whole)
    return found


def test_silence_is_seen() -> None:
    told = "np.testing.assert_allclose(f(x), y, rtol=0.0, atol=1e-9)"
    assert silent_tolerances(told) == []
    untold = "np.testing.assert_allclose(f(x), y, atol=1e-9)"
    assert silent_tolerances(f"{told}\n{untold}\n") == [untold]
    assert silent_tolerances("np.allclose(a, b, rtol=1e-9)") == ["np.allclose(a, b, rtol=1e-9)"]
    assert silent_tolerances("a == pytest.approx(b, rel=1e-9) != pytest.approx(f(c))") == ["pytest.approx(f(c))"]


def test_no_tolerance_is_left_to_the_library() -> None:
    silent = {
        path.relative_to(TESTS).as_posix(): calls
        for path in sorted(TESTS.rglob("*.py"))
        if path != Path(__file__) and (calls := silent_tolerances(path.read_text(encoding="utf-8")))
    }
    assert silent == {}
