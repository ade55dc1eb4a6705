"""`--profile` tells what was computed; without it nothing is in the way of the results."""

from __future__ import annotations

import pytest

from gearlink.cli.commands.design import Profile
from gearlink.cli.main import run

CRANK = ["crank", "designs/ty460_slider_crank.yaml", "--quantity", "crank_length"]


def test_profile_names_what_was_computed_and_no_more(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(CRANK) == 0
    plain = capsys.readouterr()
    assert run([*CRANK, "--profile"]) == 0
    profiled = capsys.readouterr()
    assert profiled.out == plain.out
    computed = [line.split()[-1] for line in profiled.err.splitlines()[1:]]
    assert "SliderCrank.crank_length" in computed
    assert {"read", "validate", "formulas", "compute", "print"} <= set(computed)
    assert not {name for name in computed if "dead_center" in name or "max_stroke" in name}


def test_results_are_steps_of_the_one_that_asked_for_them(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["press", "designs/ty460.yaml", "--all", "--profile", "-q"]) == 0
    lines = [line[22:] for line in capsys.readouterr().err.splitlines()]
    depth = {line.strip(): (len(line) - len(line.lstrip())) // 2 for line in lines}
    assert depth["compute"] < depth["PressMotion.sync_start"] < depth["PressMotion.cylinder"]
    assert depth["FlatbedPress.table_positions"] == depth["FlatbedPress.check_sync_speed"] == depth["compute"] + 1


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("command", "design", "own"),
    [
        ("loads", "loaded_feed", {"ThreeGearLoads.prepare", "LoadsDesign.torque_range"}),
        ("analyze", "planar_watt", {"PlanarMechanism.prepare", "PlanarMechanism.structure"}),
    ],
)
def test_what_is_sought_together_is_a_step(
    capsys: pytest.CaptureFixture[str], command: str, design: str, own: set[str]
) -> None:
    """Else most of a planar mechanism's time would be that of no result."""
    assert run([command, f"designs/{design}.yaml", "--profile", "-q"]) == 0
    steps = {line.split()[-1]: line.split()[:2] for line in capsys.readouterr().err.splitlines()[1:]}
    assert own <= set(steps)
    total, alone = map(float, steps["compute"])
    assert alone < 0.5 * total


def test_profile_reports_a_design_that_fails(capsys: pytest.CaptureFixture[str]) -> None:
    assert run([*CRANK, "--profile", "--set", "stroke=1e6"]) == 2
    assert "compute" in capsys.readouterr().err


def test_own_times_add_up_to_the_total() -> None:
    profile = Profile()
    with profile.step("outer"):
        with profile.step("first"):
            pass
        with profile.step("second"), profile.step("inner"):
            pass
    outer, *inner = profile.steps
    assert [step.depth for step in profile.steps] == [0, 1, 1, 2]
    # sums of four doubles: a few ulp of the total
    assert abs(outer.own + sum(step.own for step in inner) - outer.total) <= 8 * 2**-53 * max(1.0, outer.total)
