"""Each comparison of arrays says how near: numpy's own tolerances would stand in silently for those of a head."""

from __future__ import annotations

import re
from pathlib import Path

TESTS = Path(__file__).parent
SILENT = {"assert_allclose": ("rtol",), "allclose": ("rtol", "atol"), "isclose": ("rtol", "atol")}
"""numpy's comparisons, and what each adds when it is not told: rtol 1e-7 and atol 0, or rtol 1e-5 and atol 1e-8."""
_CALL = re.compile(rf"\bnp(?:\.testing)?\.({'|'.join(SILENT)})\(")


def silent_tolerances(text: str) -> list[str]:
    """Calls that leave a tolerance to numpy, by their text up to the closing bracket."""
    found = []
    for call in _CALL.finditer(text):
        depth, end = 1, call.end()
        while depth:
            depth += {"(": 1, ")": -1}.get(text[end], 0)
            end += 1
        whole = text[call.start() : end]
        if any(f"{word}=" not in whole for word in SILENT[call[1]]):
            found.append(whole)
    return found


def test_silence_is_seen() -> None:
    told = "np.testing.assert_allclose(f(x), y, rtol=0.0, atol=1e-9)"
    assert silent_tolerances(told) == []
    untold = "np.testing.assert_allclose(f(x), y, atol=1e-9)"
    assert silent_tolerances(f"{told}\n{untold}\n") == [untold]
    assert silent_tolerances("np.allclose(a, b, rtol=1e-9)") == ["np.allclose(a, b, rtol=1e-9)"]


def test_no_tolerance_is_left_to_numpy() -> None:
    silent = {
        path.relative_to(TESTS).as_posix(): calls
        for path in sorted(TESTS.rglob("*.py"))
        if path != Path(__file__) and (calls := silent_tolerances(path.read_text(encoding="utf-8")))
    }
    assert silent == {}
