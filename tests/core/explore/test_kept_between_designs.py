"""What a design keeps for the next of a study: the same bits as designs that keep nothing, in threads too."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest
from factory import worked

from gearlink.core.parts.cams import disc_cam
from gearlink.core.studies.explore.base import Base, single

NAMES = ("max_radius[0]", "max_radius[1]", "max_pressure_angle[0]", "min_curvature_radius[1]")


def base() -> Base:
    return Base(worked("swing_gripper"), "cam")


def changes() -> Iterator[tuple[tuple[str, Any], ...]]:
    """Of the cams alone, and of the linkage, whose motion is then another."""
    for arm in (150.0, 160.0, 170.0):
        for angle in (46.0, 52.0):
            yield (("cam.roller.arm", arm), ("cam.roller.angle", angle))
    yield (("cam.roller.arm", 160.0), ("links.input", 151.0))


@pytest.fixture
def hurried() -> Iterator[None]:
    """Threads that take turns at every chance."""
    usual = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(usual)


@pytest.mark.slow
def test_threads_share_what_a_gripper_keeps(hurried: None) -> None:
    alone = [single(base(), each, NAMES, ()) for each in changes()]
    shared = base()
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda each: single(shared, each, NAMES, ()), 3 * [*changes()]))
    assert not any(one.refused for one in alone)
    assert len({one.values["max_radius[0]"] for one in alone}) == len(alone)
    for one, other in zip(3 * alone, together, strict=True):
        assert np.array_equal([one.values[name] for name in NAMES], [other.values[name] for name in NAMES])


def test_checks_and_the_one_quantity_of_a_study_are_sought_together(monkeypatch: pytest.MonkeyPatch) -> None:
    """Searches of one extreme alone are counted: none with the checks, some where the quantity alone is asked for."""
    alone: list[int] = []

    def counted(search: Any) -> Any:
        def found(*given: Any, **more: Any) -> Any:
            alone.append(1)
            return search(*given, **more)

        return found

    for name in ("maximum_over", "minimum_over"):
        monkeypatch.setattr(disc_cam, name, counted(getattr(disc_cam, name)))
    made = base()
    found = single(made, (), NAMES[2:3], list(made.codes))
    assert found.findings
    assert not alone
    assert single(base(), (), NAMES[2:3], ()).values == pytest.approx(found.values, rel=1e-12)
    assert alone
