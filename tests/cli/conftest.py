"""What the tests of the command line share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from gearlink.core.parts.gears.shifts import contour


@pytest.fixture(scope="module", autouse=True)
def _few_lines_of_blocking_contours() -> Iterator[None]:
    """Contours are traced on fewer diagonals: each takes a second at its full fineness, and what a sheet, a page or a
    file shows of one does not depend on it. tests/core/gears/shifts/test_contour.py judges the lines."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(contour, "_DIAGONALS", 17)
        patch.setattr(contour, "_UPRIGHTS", 9)
        yield


@pytest.fixture
def no_remedies(monkeypatch: pytest.MonkeyPatch) -> None:
    """What would repair a finding is sought for long, and not asked here."""
    monkeypatch.setattr("gearlink.core.base.remedies.trials.Bench.remedy", lambda *_: ())
