"""A quantity has one unit: a result and a study of the design say the same.

No tolerance: both convert one value once.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from factory import DESIGNS, design, worked

from gearlink.core.base.errors import GearlinkError, NoSolution
from gearlink.core.base.kinds import KINDS
from gearlink.core.studies.explore.base import Base

QUICK = {"loaded_wide_swing", "wide_swing_twin_cam"}
PATHS = [
    path if path.stem in QUICK else pytest.param(path, marks=pytest.mark.slow)
    for path in sorted(DESIGNS.glob("*.yaml"))
]


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_a_study_has_the_numbers_and_units_of_the_results(path: Path) -> None:
    data = worked(path.stem)
    kind = KINDS[data["kind"]]
    for command in kind.commands:
        if command in ("tolerance", "register") or (command == "loads" and "loads" not in data):
            continue
        try:
            made, base = design(data, command=command), Base(data, command)
        except NoSolution:  # of a synthesis that its dimensions do not allow
            continue
        for name in made.names_for(made.spec):
            try:
                found = made.quantity(name)
            except GearlinkError:  # that it needs a section, or does not exist, is no matter of units
                continue
            if found is not None and base.places[name] == command:
                assert base.unit(name) == found.unit, (command, name)
                assert base.values(made, [name])[name] == found.value, (command, name)
