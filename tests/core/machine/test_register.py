"""The register of a machine against the members' own registers, and its yield against samples."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest
from machines import FEED, ROCKER, cam, machine, of

from gearlink.cli.opening import design
from gearlink.core.base.errors import GearlinkError
from gearlink.core.machines.machine.register import RegisterOfMachine

ARM: dict[str, Any] = ROCKER | {
    "tolerance": {"sources": {"links.coupler": {"plus_minus": 0.02}, "links.rocker": {"plus_minus": 0.03}}},
    "register": {"radius": 200},
}
LIFT = cam(FEED) | {"tolerance": {"sources": {"follower.roller_radius": {"plus_minus": 0.01}}}}
CHAIN = {"arm": 1.0, "lift": -0.5}


def registered(**more: Any) -> RegisterOfMachine:
    members = {"arm": of(ARM, phase=30), "lift": of(LIFT, phase=-20, ratio=2)}
    section = {"at": 214, "chain": CHAIN, "tolerance": 0.06} | more
    return RegisterOfMachine(machine(members, register=section).spec)


def own(data: dict[str, Any], angle: float) -> Any:
    return design("register", **{**data, "register": data.get("register", {}) | {"at": angle}})


def test_members_stand_where_the_machine_has_them_at_the_print() -> None:
    found, arm, lift = registered(), own(ARM, 184.0), own(LIFT, (2 * 234) % 360)
    assert found.worst == pytest.approx(max(arm.worst) + 0.5 * max(lift.worst), rel=1e-9)
    assert found.rss == pytest.approx(math.hypot(max(arm.rss), 0.5 * max(lift.rss)), rel=1e-9)
    assert found.band == pytest.approx(3.0 * found.rss, rel=1e-9)
    shares = found.table("shares")
    assert shares["member_input"].tolist() == pytest.approx([184.0, 108.0], abs=1e-9)
    assert float(shares["share"].sum()) == pytest.approx(1.0, abs=1e-12)


def test_the_sources_add_up_to_the_whole() -> None:
    found = registered()
    table = found.table("budget")
    assert float(np.sum(table["worst"])) == pytest.approx(found.worst, rel=1e-12)
    assert math.sqrt(float(np.sum(table["sigma"] ** 2))) == pytest.approx(found.rss, rel=1e-12)
    assert float(table["share"].sum()) == pytest.approx(1.0, rel=1e-12)
    assert set(table["member"].tolist()) == {"arm", "lift"}


def test_the_yield_is_that_of_samples_of_all_sources() -> None:
    found = registered(tolerance=0.02)
    table = found.table("budget")
    chance = np.random.default_rng(7)
    errors = chance.standard_normal((200_000, len(table["sigma"]))) @ table["sigma"]
    share = float(np.mean(np.abs(errors) <= 0.02))
    want = found.machine_yield
    assert want is not None
    assert 0.5 < want < 0.9999
    # 200000 samples know a share to 4 of its standard deviations of sqrt(p q/N)
    assert share == pytest.approx(want, abs=4.0 * math.sqrt(want * (1.0 - want) / 200_000))


@pytest.mark.parametrize(("limit", "status"), [(0.2, "pass"), (0.01, "fail")])
def test_the_budget_is_judged(limit: float, status: str) -> None:
    (check,) = registered(tolerance=limit).check("register-budget")
    assert check.status == status
    assert check.limit == limit
    if status == "fail":
        assert "register error, 99.73 %" in check.message


@pytest.mark.parametrize("share", [0.9, 0.3])
def test_a_budget_is_kept_by_tightening_the_sources_that_are_named(share: float) -> None:
    """Each source by the name of its member; the band of what is left is summed from the table."""
    found = registered()
    (check,) = registered(tolerance=share * found.band).check("register-budget")
    which, percent = re.fullmatch(r"tighten (.*) to ([\d.]+) % of (?:its|their) limits", check.fix or "").groups()  # type: ignore[union-attr]
    table = found.table("budget")
    named = [f"{source} of {member}" for member, source in zip(table["member"], table["source"], strict=True)]
    chosen = named if which == "all sources" else which.split(" and ")
    assert set(chosen) <= set(named)
    left = [float(percent) / 100.0 if name in chosen else 1.0 for name in named]
    band = 3.0 * math.sqrt(float(np.sum((table["sigma"] * left) ** 2)))
    assert share * found.band * 0.95 < band <= share * found.band


def test_wind_up_at_the_print_is_the_lag_of_the_output_at_its_radius() -> None:
    """A soft shaft to a member that works against a steady torque: twist M/c, times the tip's way per angle."""
    pulled = ARM | {"loads": {"links": {}, "forces": [{"on": "crank", "torque": -8.0}]}}
    members = {"arm": of(pulled, phase=30)}
    shaft = {"inertias": [1.0, 1.0], "stiffnesses": [5000.0], "members": ["motor", "arm"]}
    found = RegisterOfMachine(machine(members, register={"at": 214, "chain": {"arm": 1.0}}, shaft=shaft, speed=60).spec)
    rate = machine(members).members["arm"].rates(np.radians([184.0]), 1)[1][0]
    assert found.wind_up_at_print == pytest.approx(-8.0 / 5000.0 * 200.0 * rate, rel=1e-9)


def test_a_member_of_the_chain_needs_sources() -> None:
    members = {"arm": of(ARM), "lift": of(cam(FEED))}
    found = RegisterOfMachine(machine(members, register={"at": 10, "chain": CHAIN}).spec)
    with pytest.raises(GearlinkError) as wrong:
        found.report("register")
    assert wrong.value.key == "members.lift.design.tolerance.sources"  # type: ignore[attr-defined]
    with pytest.raises(GearlinkError) as wrong:
        machine(members, register={"at": 10, "chain": {"arn": 1.0}})
    assert wrong.value.key == "register.chain.arn"  # type: ignore[attr-defined]
