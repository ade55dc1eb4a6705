"""What each command shows first: named by every kind, there in the report, and beside what the file asks for."""

from __future__ import annotations

import math
from collections.abc import Iterator
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

import pytest
from factory import DESIGNS, design, each_kind
from pydantic import BaseModel

import gearlink
from gearlink.cli.evaluate import open_design, read_spec
from gearlink.cli.options import Options
from gearlink.core.base.design import Design
from gearlink.core.base.key_results import FEWEST, MOST, SHARED, TITLES, Key, KeyResult
from gearlink.core.base.kinds import KINDS
from gearlink.core.base.nomenclature import term
from gearlink.core.base.report import Quantity

COMMANDS = [(kind.name, command) for kind in KINDS.values() for command in kind.commands]


def keys_of(kind: str, command: str) -> tuple[Key, ...]:
    """The key results that a command of a kind names."""
    cls: type[Design] = KINDS[kind].design_class(command)
    return cls.keys.get(command) or SHARED.get(command, ())


def split(key: Key) -> tuple[str, tuple[str, ...]]:
    """The name of a key result and the keys of the file which it answers, without what stands before them."""
    name, *paths = (key,) if isinstance(key, str) else key
    return name.lstrip("?^"), tuple(path.lstrip("<>?") for path in paths)


def models(part: Any) -> Iterator[type[BaseModel]]:
    """The models of sections that an annotation or what stands beside it allows."""
    if isinstance(part, type) and issubclass(part, BaseModel):
        yield part
    for inner in (*getattr(part, "__args__", ()), *getattr(part, "__metadata__", ())):
        yield from models(inner)
    if hasattr(part, "place"):
        yield from models(part.model())


def has(model: type[BaseModel], path: str) -> bool:
    """Whether a design file may have a key."""
    first, _, rest = path.partition(".")
    field = next((f for name, f in model.model_fields.items() if first in (name, f.alias)), None)
    if field is None or not rest:
        return field is not None
    inner = [*models(field.annotation), *(each for part in field.metadata for each in models(part))]
    return any(has(each, rest) for each in inner)


@pytest.mark.parametrize(("kind", "command"), COMMANDS)
def test_every_command_names_key_results_that_it_has(kind: str, command: str) -> None:
    cls = KINDS[kind].design_class(command)
    own = command in cls.keys and cls.keys[command] not in SHARED.values()
    assert keys_of(kind, command), "no key results"
    shown = cls.outlines[command].quantities
    known = {*cls.quantity_names()} if isinstance(cls.quantity_names(), tuple) else {*shown}
    names = [split(key)[0] for key in keys_of(kind, command)]
    assert len(set(names)) == len(names)
    if own:
        assert [name for name in names if "*" not in name and name not in known] == []
    assert any(fnmatchcase(name, pattern) for name in known | {*shown} for pattern in names)


@pytest.mark.parametrize(("kind", "command"), [each for each in COMMANDS if each[1] not in SHARED])
def test_what_is_answered_are_keys_of_the_file(kind: str, command: str) -> None:
    cls, model = KINDS[kind].design_class(command), KINDS[kind].spec_model()
    paths = [path for key in keys_of(kind, command) for path in split(key)[1]]
    wrong = [path for path in paths if not (hasattr(cls, path[1:]) if path[0] == "." else has(model, path))]
    assert wrong == []


def test_titles_are_of_quantities() -> None:
    assert all(term(name).words for name in TITLES)
    assert max(map(len, TITLES.values())) <= 34


@pytest.mark.quick(3)
@pytest.mark.parametrize("path", each_kind(sorted(DESIGNS.glob("*.yaml"))), ids=lambda path: path.stem)
def test_a_report_has_six_to_ten_of_them(path: Path) -> None:
    """Fewer only where all that there is to say is said."""
    loaded, kind = open_design(str(path), Options())
    spec = read_spec(loaded, kind, str(path))
    for command in spec.commands():
        report = kind.design(command, spec).report(command, key_tables=True)
        names = [each.quantity.name for each in report.key]
        there = [q.name for q in report.quantities if q.value != []]
        assert len(set(names)) == len(names)
        assert set(names) <= set(there)
        plain = [name for name in there if not name.endswith(("_at", "power_identity", "massless", ".travel"))]
        assert min(FEWEST, len(plain)) <= len(names) <= MOST, command


def test_what_is_asked_for_stands_first() -> None:
    """The window of a dwell, the return of one that is given by phi13, and the speeds of a varying one."""
    found = design("standing_feed", command="synth dwell").report("synth dwell").key
    assert [(each.quantity.name, each.title, each.asked, each.how) for each in found[:2]] == [
        ("tolerance_dwell_angle", "dwell", 70.0, "required"),
        ("dwell_tolerance", "dwell, half range +-", 0.5, "at most"),
    ]
    found = design("candy_feed", command="synth dwell").report("synth dwell").key
    assert (found[0].quantity.name, found[0].asked) == ("dwell_angle", 135.0)
    assert "tolerance_dwell_angle" not in [each.quantity.name for each in found]
    found = design("thesis_example_2", command="synth variable-speed").report("synth variable-speed").key
    assert [each.asked for each in found[:2]] == pytest.approx([0.5, 1.5], rel=1e-12)


def test_of_many_joints_the_one_that_bears_most_is_shown() -> None:
    """Sought here through all of them."""
    report = design("crank_rocker_links", command="loads").report("loads")
    peaks = {q.name: q.value for q in report.quantities if q.name.endswith(".peak")}
    shown = [each.quantity.name for each in report.key if each.quantity.name.endswith(".peak")]
    assert shown == [max(peaks, key=lambda name: float(str(peaks[name])))]


def test_the_two_values_of_a_register_are_named() -> None:
    """One for each sense of the torque: without that two equal numbers stand side by side."""
    for value, title in (([0.1, 0.2], "worst case, torque + and -"), (0.2, "register, worst case")):
        assert KeyResult(Quantity("worst", value, "mm", "", "")).title == title


@pytest.mark.parametrize("kind", ["disc-cam", "cylindrical-cam"])
def test_of_a_return_that_is_faster_the_minimum_is_shown(kind: str) -> None:
    """A rise of 120 deg and a return of 60 deg by one law: twice the speed, four times the acceleration, downwards."""
    motion = [{"to": 120, "lift": 9, "law": "cycloidal"}, {"to": 180, "lift": 0, "law": "cycloidal"}, {"to": 360}]
    cam = {"prime_radius": 60} if kind == "disc-cam" else {"radius": 60, "depth": 8}
    follower = {"type": "translating-roller", "roller_radius": 8}
    drive = gearlink.design(kind=kind, speed=100, motion=motion, follower=follower, cam=cam)
    names = [each.quantity.name for each in drive.report("cam").key]
    assert {"follower_velocity_min", "velocity_min"} < set(names)
    assert {"follower_velocity_max", "velocity_max"}.isdisjoint(names)
    assert math.isclose(drive.quantity("velocity_min").value, -2 * drive.quantity("velocity_max").value, rel_tol=1e-12)


def test_a_class_that_names_both_extremes_shows_both() -> None:
    names = [each.quantity.name for each in design("loaded_cam", command="loads").report("loads").key]
    assert names[:2] == ["input_torque_max", "input_torque_min"]


def test_the_faster_extreme_is_shown_whatever_its_sign() -> None:
    """A ring gear runs backwards: its speed is the minimum; maximum and minimum of one size show the maximum."""
    ring = design("ring_feed", command="synth dwell")
    shown = {each.quantity.name: each.quantity.value for each in ring.report("synth dwell").key}
    assert "speed_ratio_max" not in shown
    assert abs(shown["speed_ratio_min"]) > abs(ring.quantity("speed_ratio_max").value)
    even = design("thesis_example_1", command="synth back-step")
    names = [each.quantity.name for each in even.report("synth back-step").key]
    assert "acceleration_ratio_max" in names
    assert "acceleration_ratio_min" not in names
