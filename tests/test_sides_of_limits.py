"""The side of its limit on which a check passes is said by its rule, not guessed from the numbers.

Tolerance: 1e-9 of the limit, which is what the checks themselves leave to rounding.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from factory import DESIGNS, each_kind, worked

from gearlink.core.base.kinds import KINDS
from gearlink.core.base.report import Check, Rule
from gearlink.core.parts.linkages.checks import dwell_edge_check


def findings(name: str) -> Iterator[Check]:
    """What the checks of all commands of an example say."""
    data = worked(name)
    kind = KINDS[data["kind"]]
    spec = kind.spec_model().model_validate(data)
    for command in spec.commands():
        yield from kind.design(command, spec).report(command).checks


@pytest.mark.quick(6)
@pytest.mark.parametrize("path", each_kind(sorted(DESIGNS.glob("*.yaml"))), ids=lambda path: path.stem)
def test_what_passes_is_on_the_side_of_its_rule(path: Path) -> None:
    wrong = []
    for check in findings(path.stem):
        if check.status != "pass" or check.value is None or check.limit is None:
            continue
        off = (check.value - check.limit) * {">=": 1.0, "<=": -1.0, "": 0.0}[check.side]
        if off < -1e-9 * abs(check.limit):
            wrong.append((check.code, check.value, check.side, check.limit))
    assert not wrong


def test_a_share_of_the_band_beyond_its_edge_passes_on_the_other_side() -> None:
    assert [dwell_edge_check(share, None).side for share in (0.5, 1.5)] == ["<=", ">="]


def test_a_finding_has_the_side_of_its_rule_unless_it_is_told_another() -> None:
    rule = Rule("GL000", "", "", "", "", checks=("c",), side="<=")
    assert rule.check("pass", "").side == "<="
    assert rule.check("pass", "", side="").side == ""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (("swing", "wide_swing_twin_cam", "--set", "cycle_angle=180"), "cycle-angles GL510 360 <= 360 deg"),
        (("loads", "loaded_feed"), "load-reversal (2x) GL602 0 <= 0"),
        (("analyze", "six_bar_two_trains"), "mobility GL309 1 1"),
    ],
)
def test_a_limit_that_is_just_met_is_shown_on_its_side(gearlink: Any, arguments: tuple[str, ...], line: str) -> None:
    command, name, *rest = arguments
    ended = gearlink(command, DESIGNS / f"{name}.yaml", *rest, "--all")
    assert line in [" ".join(each.split()) for each in ended.out.splitlines()]
