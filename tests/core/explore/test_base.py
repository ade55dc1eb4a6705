"""Files that differ from the base of a study by some keys: as text and as data the same."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from factory import DESIGNS, design, each_kind, worked

from gearlink.core.base.kinds import KINDS
from gearlink.core.studies.explore.base import Base, single

PRESS = worked("ty460")
CHANGES: list[list[tuple[str, Any]]] = [
    [],
    [("bed.rod", 501.5)],
    [("bed.rod", 1e300), ("cylinder.radius", float("inf")), ("bed.stroke", float("nan"))],
    [("cylinder.radius", 3), ("bed.rod", 2)],  # not in the order of the file
    [("bed.rod", 1.0), ("bed.rod", 2.0)],  # the last one holds
    [("sync", {"length": 3}), ("sync.length", 4.0)],  # one within the other
    [("limits.gear_gap", None), ("new.section.key", 'word " \u0000 0 \u0000')],
    [("name", "\u00001\u0000"), ("speed", 7)],
]


@pytest.mark.parametrize("changes", CHANGES)
def test_text_of_a_changed_file(changes: list[tuple[str, Any]]) -> None:
    base = Base(PRESS, "press")
    for _ in range(2):  # made, then put together from what was made
        assert base._changed_text(changes) == json.dumps(base.changed(changes))


def test_marks_in_the_file_itself() -> None:
    base = Base({**PRESS, "name": "\u00000\u0000"}, "press")
    assert base._changed_text([("bed.rod", 3.0)]) == json.dumps(base.changed([("bed.rod", 3.0)]))


@pytest.mark.parametrize("path", ["bed.rod.x", "name.x"])
def test_paths_that_lead_nowhere_are_refused_as_ever(path: str) -> None:
    with pytest.raises((LookupError, TypeError, AttributeError)):
        Base(PRESS, "press")._changed_text([(path, 1.0)])


def test_findings_that_only_warn_are_left_out_where_they_do_not_count() -> None:
    gripper = worked("swing_gripper")
    changes = [("limits.accelerate_pressure_angle", 1.0)]
    every, failing = (single(Base(gripper, "cam", warnings), changes, (), ("GL401",)) for warnings in (True, False))
    assert {check.status for check in every.findings} == {"pass", "warn"}
    assert [*failing.findings] == [check for check in every.findings if check.status == "pass"]


@pytest.mark.parametrize("path", each_kind(sorted(DESIGNS.glob("*.yaml"))), ids=lambda path: path.stem)
def test_every_check_that_a_command_shows_is_known_beforehand(path: Path) -> None:
    """What the sections of a file add to the checks of a command counts in studies of it."""
    data = worked(path.stem)
    for command in KINDS[data["kind"]].commands if data["kind"] in KINDS else ():
        if command in ("loads", "register", "tolerance") or command.startswith("synth"):
            continue
        made = design(data, command=command)
        assert set(made.outline(command).checks) <= set(type(made).judged(command, made.spec)), command
