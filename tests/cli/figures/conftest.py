"""A figure takes a second to draw: of the many designs that must draw, `make test` takes the first few of each test."""

from collections import Counter
from pathlib import Path

import pytest

FEW = {"odd": 2, "every_command_draws": 2, "cams_are_drawn_to_scale": 3, "law_is_the_table_s": 2}
"""Part of a test's name, and how many of its cases `make test` draws; `make check-full` draws all."""


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    seen: Counter[str] = Counter()
    for item in items:
        if Path(__file__).parent in item.path.parents:
            test = item.nodeid.partition("[")[0]
            seen[test] += 1
            if any(part in test and seen[test] > few for part, few in FEW.items()):
                item.add_marker(pytest.mark.slow)
