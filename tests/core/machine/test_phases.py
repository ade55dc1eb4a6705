"""Free phases against brute force over all phases, and against the slack of every circle."""

from __future__ import annotations

import functools
import itertools
import math
import random
import re
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from machines import FEED, GRIPPER, cam, machine, of, wrapped

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.spec_paths import changed
from gearlink.core.machines.machine.timing import Tie, solve


def least(ties: Sequence[Tie], phases: Mapping[str, Any], dial: float) -> Any:
    """Minimum margin of some phases, numbers or arrays, by the definition alone."""
    found = []
    for tie in ties:
        x = wrapped(phases.get(tie.two, 0.0) - phases.get(tie.one, 0.0) + tie.offset, dial)
        found += [x - tie.least, tie.most - x]
    return functools.reduce(np.minimum, found)


def random_ties(seed: int, names: Sequence[str], count: int) -> list[Tie]:
    chance = random.Random(seed)
    found = []
    for i in range(count):
        one, two = chance.sample(["", *names], 2)
        most = chance.choice([math.inf, float(chance.randint(40, 170))])
        found.append(Tie(one, two, float(chance.randint(-180, 180)), float(chance.randint(-5, 20)), most, f"tie {i}"))
    return found


@pytest.mark.quick(8)
@pytest.mark.parametrize("seed", range(24))
def test_no_phases_of_a_grid_do_better(seed: int) -> None:
    names, dial = ("a", "b"), 360.0
    ties = random_ties(seed, names, 3 + seed % 4)
    found = solve(names, ties, dial)
    assert least(ties, found.phases, dial) == pytest.approx(found.margin, abs=1e-7)  # wraps are rounded to 1e-10 deg
    step = 2.0
    grid = dict(zip(names, np.meshgrid(*[np.arange(0.0, dial, step)] * 2), strict=True))
    best = float(np.max(least(ties, grid, dial)))
    # a margin changes by at most the change of both its phases: of the nearest point of the grid by a step
    assert best <= found.margin + 1e-7
    assert found.margin <= best + step + 1e-7


def test_three_members_that_chase_each_other_share_the_dial() -> None:
    ties = [Tie(a, b, 0.0, 0.0, math.inf, f"{a} before {b}") for a, b in itertools.pairwise("abca")]
    found = solve("abc", ties, 360.0)
    assert found.margin == pytest.approx(120.0, abs=1e-9)
    assert set(found.limiting) == {tie.text for tie in ties}
    assert found.room["a"] == 360.0
    assert found.phases["a"] == 0.0


def test_twelve_members_are_solved_at_once_and_to_the_last_circle() -> None:
    names = [f"m{i}" for i in range(12)]
    ties = [Tie(names[i], names[(i + 1) % 12], 10.0, 2.0, math.inf, f"ring {i}") for i in range(12)]
    ties += [Tie(names[i], names[i + 3], 0.0, 5.0, 150.0, f"span {i}") for i in range(9)]
    ties.append(Tie("", "m0", 0.0, 0.0, math.inf, "first"))
    found = solve(names, ties, 360.0)
    assert least(ties, found.phases, 360.0) == pytest.approx(found.margin, abs=1e-7)
    # a span of 5 to 150 deg leaves (150 - 5)/2 to either side, whatever the others ask
    assert found.margin == pytest.approx(72.5, abs=1e-7)


def test_a_phase_that_is_left_open_is_the_middle_of_its_interval() -> None:
    """The tight circle of a leaves b between two events of what stands fast."""
    ties = [
        Tie("a", "", 30.0, 0.0, math.inf, "a1"),
        Tie("", "a", -10.0, 0.0, math.inf, "a2"),
        Tie("b", "", 100.0, 0.0, math.inf, "b1"),
        Tie("", "b", 0.0, 0.0, math.inf, "b2"),
    ]
    found = solve("ab", ties, 360.0)
    assert found.margin == pytest.approx(10.0, abs=1e-9)
    assert found.phases == pytest.approx({"a": 20.0, "b": 50.0}, abs=1e-8)
    assert found.room == pytest.approx({"a": 0.0, "b": 80.0}, abs=1e-8)


@pytest.mark.slow
def test_the_machine_takes_what_was_found() -> None:
    members = {"feed": of(cam(FEED), phase=20), "gripper": of(cam(GRIPPER), phase="free")}
    require = ["gripper.rise_end before feed.rise_start by 2", "feed.rise_end before gripper.return_start by 2"]
    found = machine(members, require=require)
    assert math.degrees(found.least_margin or 0.0) == pytest.approx(18.0, abs=1e-9)
    assert found.quantity("gripper.phase").value == pytest.approx(310.0, abs=1e-9)  # type: ignore[union-attr]
    assert found.limiting_relations == require
    grid = [
        machine({**members, "gripper": of(cam(GRIPPER), phase=float(p))}, require=require) for p in range(0, 360, 15)
    ]
    assert max(math.degrees(each.least_margin or 0.0) for each in grid) <= 18.0 + 1e-9


def test_a_relation_within_one_member_asks_for_another_motion_of_it() -> None:
    members = {"feed": of(cam(FEED), phase=20), "gripper": of(cam(GRIPPER), phase="free")}
    found = machine(members, require=["feed.rise_end before feed.return_start by 200", "gripper.rise_end before 10"])
    own, other = found.check("timing-relation")
    assert (own.status, own.fix) == ("fail", "change the motion of feed")
    assert own.note == ("both events belong to one member: no phase changes the margin",)
    assert other.status == "pass"


FIRST = ["feed.return_end before gripper.rise_start by 5", "gripper.rise_end before feed.rise_start by 5"]


@pytest.mark.quick(3)
@pytest.mark.parametrize(
    ("require", "fix"),
    [
        (FIRST, "set members.feed.phase to 60"),
        (["gripper.velocity at 25 <= 3"], "set members.gripper.phase to 21"),
        (
            ["gripper.rise within feed.dwell by 20"],
            "set require[0] to gripper.rise within feed.dwell by 15 and members.feed.phase to 255",
        ),
        (
            ["feed.rise_end before feed.return_start by 200"],
            "set require[0] to feed.rise_end before feed.return_start by 80",
        ),
    ],
)
def test_the_fix_of_a_relation_is_a_phase_or_a_relation_that_asks_for_less(require: list[str], fix: str) -> None:
    """The phases are those of the maximum margin: 20 deg are left of the dial, 80 - 50 deg of a dwell."""
    found = machine({"feed": of(cam(FEED)), "gripper": of(cam(GRIPPER))}, require=require)
    failing = [each for each in found.findings("analyze", "timing-relation") if each.status == "fail"]
    assert {(each.fix or "").removesuffix(" (relaxes the requirement)") for each in failing} == {fix}
    repaired = machine_of(found, failing[0].remedy)
    assert all(each.status == "pass" for each in repaired.check("timing-relation"))


def machine_of(old: Any, remedy: Any) -> Any:
    return type(old)(changed(old.spec, remedy))


def test_where_no_phases_will_do_the_relations_that_limit_each_other_are_named() -> None:
    members = {"feed": of(cam(FEED)), "gripper": of(cam(GRIPPER), phase="free")}
    found = machine(
        members, require=["gripper.rise within feed.dwell by 20", "feed.rise_start before gripper.rise_end"]
    )
    failing = [each for each in found.check("timing-relation") if each.status == "fail"]
    assert len(failing) == 1
    assert failing[0].value == pytest.approx(-5.0, abs=1e-9)  # a dwell of 80 deg holds a rise of 50 with 15 to spare
    assert "no phases give a larger margin" in failing[0].note[0]


def test_a_dial_of_several_turns() -> None:
    """A member at half the speed: its events stand once in two turns, and the shorter way round is up to a turn."""
    members = {"slow": of(cam(FEED), ratio=0.5), "fast": of(cam(GRIPPER), phase="free")}
    found = machine(
        members, require=["slow.rise_end before fast.rise_start", "fast.rise_end[2] before slow.rise_start"]
    )
    assert found.cycle_turns == 2
    phase = float(found.quantity("fast.phase").value)  # type: ignore[union-attr, arg-type]
    ways = [wrapped(phase - 180.0, 720.0), wrapped(0.0 - (phase + 410.0), 720.0)]
    assert math.degrees(found.least_margin or 0.0) == pytest.approx(min(ways), abs=1e-9)
    best = max(min(wrapped(p - 180.0, 720.0), wrapped(-p - 410.0, 720.0)) for p in np.arange(0.0, 720.0, 1.0).tolist())
    assert best - 1e-9 <= min(ways) <= best + 1.0


def _member(i: int) -> dict[str, Any]:
    """Of every four members a crank-rocker and three cams, with their loads."""
    if i % 4 == 3:
        links = {"crank": 28 + i, "coupler": 110, "rocker": 80, "frame": 120}
        masses = {
            "crank": {"mass": 1.2, "inertia": 0.001},
            "rocker": {"mass": 1.5, "center": [40, 0], "inertia": 0.012},
        }
        return {"kind": "crank-rocker", "links": links, "loads": {"links": masses}}
    motion = [{"to": 60 + 5 * i, "lift": 8 + i}, {"to": 200}, {"to": 300, "lift": 0}, {"to": 360}]
    return {
        "kind": "disc-cam",
        "motion": motion,
        "follower": {"type": "translating-roller", "roller_radius": 12, "mass": 0.8},
        "cam": {"prime_radius": 70, "shaft_radius": 20},
        "spring": {"preload": 400, "rate": 12},
        "loads": {"roller": {"width": 16}},
    }


@pytest.mark.slow
def test_a_machine_of_twelve_members_is_quick(tmp_path: Path) -> None:
    """Timing, phases, checks, torsion and loads take at most 20 times a minimal command of Typer, 0.1 s where that was
    measured; processor time."""
    count = 12
    file = {
        "kind": "machine",
        "name": "twelve",
        "speed": 150,
        "members": {f"m{i}": {"phase": "free" if i % 3 else 20 * i, "design": _member(i)} for i in range(count)},
        "require": [
            f"m{i - 1}.rise_start before m{i}.rise_end by 2"
            if i % 2
            else f"m{i}.rise_start before m{i - 1}.return_start"
            for i in range(1, count)
        ],
        "shaft": {
            "inertias": [0.08] * count,
            "stiffnesses": [15000] * (count - 1),
            "members": [f"m{i}" for i in range(count)],
        },
        "loads": {"flywheel": {"inertia": 2}},
    }
    (tmp_path / "twelve.yaml").write_text(yaml.safe_dump(file, sort_keys=False))
    minimal = "import typer\napp = typer.Typer()\n@app.command()\ndef main(name: str = 'x'): print(name)\napp()"
    least = min(_processor_time([sys.executable, "-c", minimal]) for _ in range(3))
    whole = 0.0
    for command in ("analyze", "loads"):
        line = [sys.executable, "-m", "gearlink", command, str(tmp_path / "twelve.yaml"), "--format", "json"]
        whole += min(_processor_time(line) for _ in range(2))
    assert whole <= 20.0 * least


def _processor_time(line: list[str]) -> float:
    resource = pytest.importorskip("resource")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(line, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode in (0, 1), done.stderr
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def test_a_gap_beyond_every_dial_is_said_to_fail() -> None:
    """Its margin is so large that the least step towards it is below the rounding of the number."""
    members = {"feed": of(cam(FEED)), "gripper": of(cam(GRIPPER), phase="free")}
    found = machine(members, require=["feed.rise_start before gripper.rise_end by 2147483648"])
    assert [each.status for each in found.check("timing-relation")] == ["fail"]


@pytest.mark.parametrize(
    ("run", "fix"),
    [
        ("drive.dwell", "give members.drive.design.dwell_tolerance: then a dwell within this tolerance is found"),
        ("drive.rise[3]", "name one from rise[1] to rise[1]"),
        ("push.dwell", "name rise or return"),
    ],
)
def test_a_run_that_a_member_does_not_have_leads_to_one(run: str, fix: str) -> None:
    step = {"kind": "three-gear-four-bar", "gears": {"module": 1.5, "crank": 36, "idler": 40, "output": 36}}
    members = {
        "drive": of(step | {"links": {"crank": 20.5545884, "frame": 77.9455509}}),
        "push": of({"kind": "slider-crank", "stroke": 20, "rod": 80}),
        "hold": of(cam(FEED)),
    }
    with pytest.raises(NoSolution, match=rf"has no {re.escape(run.partition('.')[2])}") as refused:
        _ = machine(members, require=[f"{run} within hold.dwell"]).least_margin
    assert refused.value.fix == fix


def test_the_tolerance_that_the_fix_names_makes_a_run() -> None:
    step = {"kind": "three-gear-four-bar", "gears": {"module": 1.5, "crank": 36, "idler": 40, "output": 36}}
    drive = of(step | {"links": {"crank": 20.5545884, "frame": 77.9455509}, "dwell_tolerance": 0.6})
    assert machine({"drive": drive, "hold": of(cam(FEED))}, require=["drive.dwell within hold.dwell"]).least_margin
