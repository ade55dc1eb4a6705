"""Tolerance studies of whole designs: closed forms, the study's own numbers at more samples, refusals."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.studies.study.faults import WrongStudy
from gearlink.core.studies.tolerance.iso_286 import standard_tolerance
from gearlink.core.studies.tolerance.laws import Law
from gearlink.core.studies.tolerance_study import design
from gearlink.core.studies.tolerance_study.design import Graded, Requirement, choices, normal_yield
from gearlink.core.studies.tolerance_study.samples import evaluated

CASES = json.loads((Path(__file__).parents[2] / "reference/tolerance.json").read_text(encoding="utf-8"))
CANDY = {
    "kind": "three-gear-four-bar",
    "name": "candy",
    "gears": {"module": 2.0, "crank": 40, "idler": 72, "output": 40},
    "links": {"crank": 38.94178567, "frame": 153.53024891},
}
FOUR = {
    key: {"plus_minus": 0.02} for key in ("links.crank", "links.frame", "centers.crank_idler", "centers.idler_output")
}


def study(data: dict[str, Any], /, **section: Any) -> Any:
    return factory.design(data | {"tolerance": section}, command="tolerance")


def rows(table: Any) -> list[dict[str, Any]]:
    return [dict(zip(table.columns, row, strict=True)) for row in zip(*table.data, strict=True)]


@pytest.fixture(scope="module")
def candy() -> Any:
    require = ["back_step_angle <= 20.4 deg", "dwell_swing <= 10.17 deg"]
    return study(CANDY, sources=FOUR, require=require, samples=2**15)


def test_a_linear_quantity_has_the_slopes_spread(candy: Any) -> None:
    """Slopes of the back-step are Richardson differences of 40 digits; the deviation is the root of their squares."""
    found = {row["quantity"]: row for row in rows(candy.table_quantities())}["back_step_angle"]
    assert found["nominal"] == pytest.approx(20.2955181747, abs=1e-7)
    assert found["sigma"] == pytest.approx(0.022538, abs=3e-5)
    gains = [slope.gain[0] for slope in candy.slopes["back_step_angle"]]
    assert [abs(gain) for gain in gains] == pytest.approx(
        [2.9581448247, 0.7503110467, 1.0285307299, 1.0285307299], rel=1e-6
    )


def test_an_exact_dwell_is_a_kink_and_has_no_linear_shares(candy: Any) -> None:
    shares = {(row["quantity"], row["source"]): row for row in rows(candy.table_contributions())}
    assert shares["dwell_swing", "links.crank"]["kink"]
    assert shares["dwell_swing", "links.crank"]["linear"] is None
    assert shares["back_step_angle", "links.crank"]["linear"] == pytest.approx(0.7656, abs=2e-4)


def test_yield_of_the_swing(candy: Any) -> None:
    """97.575 % at 2^21 samples elsewhere; here 2^15, whose interval is about 0.15 %."""
    found = {row["name"]: row for row in rows(candy.table_requirements())}["dwell_swing <= 10.17 deg"]
    assert found["yield"] == pytest.approx(0.97575, abs=2e-3)
    assert found["low"] <= 0.97575 <= found["high"]
    assert found["check"] == ""
    assert {row["name"]: row["check"] for row in rows(candy.table_requirements())}["GL301"] == "gear-collision"


def test_corners_hold_the_worst_swing() -> None:
    made = study(CANDY, sources=FOUR, require=["dwell_swing <= 10.17 deg"], samples=16)
    (found,) = rows(made.table_corners())
    assert found["greatest"] == pytest.approx(10.205467, abs=1e-6)
    assert found["signs"] == "++--"


@pytest.mark.slow
def test_play_of_pins_counts_in_the_worst_case() -> None:
    """The back-step is as good as linear: |slope| times limit of each size, of a pin times half its clearance.

    Half the range has no second order, the third leaves 1e-4. None of 4,096 corners with pins anywhere is beyond.
    """
    sources = FOUR | {"pins.A": {"clearance": [0.02, 0.06]}, "pins.D": {"fit": "H7/g6", "size": 20}}
    made = study(CANDY, sources=sources, require=["back_step_angle <= 20.4 deg"], samples=16)
    (found,) = rows(made.table_corners())
    slopes = made.slopes["back_step_angle"]
    limits = [0.02] * 4 + [0.03, 0.5 * (0.021 + 0.020)]
    width = sum(math.hypot(*slope.gain) * limit for slope, limit in zip(slopes, limits, strict=True))
    nominal = made.nominal["back_step_angle"]
    assert 0.5 * (found["greatest"] - found["least"]) == pytest.approx(width, rel=1e-4)
    assert found["signs"].endswith("oo")
    random = np.random.default_rng(1)
    keys = [source.key for source in made.problem.sources]
    shifts = [
        dict(zip(keys[:4], random.choice([-0.02, 0.02], 4), strict=True))
        | dict(zip(keys[4:], limits[4:] * np.exp(2j * math.pi * random.random(2)), strict=True))
        for _ in range(4096)
    ]
    values = evaluated(made.problem, made.problem.offsets(shifts)).quantities["back_step_angle"]
    assert found["least"] < values.min() < nominal - 0.8 * width
    assert nominal + 0.8 * width < values.max() < found["greatest"]


@pytest.mark.slow
def test_where_no_corner_is_a_mechanism_there_is_no_worst_case() -> None:
    made = study(CANDY, sources={"links.crank": {"plus_minus": 36.0}}, samples=16)
    found = {row["quantity"]: row for row in rows(made.table_corners())}["back_step_angle"]
    assert np.isnan([found["least"], found["greatest"]]).all()
    assert found["signs"] == ""


@pytest.mark.slow
def test_the_worst_case_of_many_sizes_is_climbed_to() -> None:
    """As if four were more than all corners are computed of."""
    few = study(CANDY, sources=FOUR, require=["dwell_swing <= 10.17 deg"], samples=16)
    (wanted,) = rows(few.table_corners())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(design, "_MOST", 3)
        made = study(CANDY, sources=FOUR, require=["dwell_swing <= 10.17 deg"], samples=16)
        (found,) = rows(made.table_corners())
    assert found["greatest"] == pytest.approx(wanted["greatest"], rel=1e-12)


def test_a_synthesis_is_done_once_and_its_links_scatter() -> None:
    data = {key: value for key, value in CANDY.items() if key != "links"} | {"dwell": {"angle": 135.0}}
    made = study(data, sources={"links.crank": {"plus_minus": 0.02}}, require=["dwell_angle >= 134.9 deg"], samples=256)
    (found,) = rows(made.table_quantities())
    assert found["nominal"] == pytest.approx(135.0, abs=1e-9)
    assert found["sigma"] > 0.01


def test_yield_of_a_stroke_is_erf() -> None:
    case = next(case for case in CASES if case["input"]["what"] == "slider-yield")
    given = case["input"]
    data = {"kind": "slider-crank", "name": "stroke", "crank": given["crank"], "rod": given["rod"], "offset": 0.0}
    section = {"sources": {"crank": {"plus_minus": given["tol"]}}, "samples": 512, "seed": given["seed"]}
    limits = [
        f"stroke <= {2.0 * given['crank'] + given['limit']} mm",
        f"stroke >= {2.0 * given['crank'] - given['limit']} mm",
    ]
    made = study(data, **section, require=limits)
    # 512 samples instead of 2^17: 0.6 % of a standard error.
    assert made.raw("yield") == pytest.approx(case["expected"], abs=0.012)
    spread = rows(made.table_quantities())[0]
    assert spread["sigma"] == pytest.approx(2.0 * given["tol"] / 3.0, rel=0.03)


def _normal(half: float) -> Law:
    """Of a part to either side of its size, C_p = 1."""
    return Law("normal", -half, half, 0.0, half / 3.0)


def test_cheapest_grades_are_those_of_all_choices() -> None:
    case = next(case for case in CASES if case["input"]["what"] == "grades")
    given = case["input"]
    graded = [Graded(given["finest"], given["coarsest"])] * len(given["sizes"])
    grades = range(given["finest"], given["coarsest"] + 1)
    laws = [{g: _normal(0.5 * standard_tolerance(size, g)) for g in grades} for size in given["sizes"]]
    requirement = Requirement(tuple(given["gains"]), given["limit"], given["limit"])
    found = next(choices(graded, normal_yield(laws, requirement), given["yield"], 1.6))
    assert list(found.grades) == case["expected"][0]
    assert found.cost == pytest.approx(case["expected"][1], abs=1e-9)


@pytest.mark.quick(1)
@pytest.mark.parametrize(("low", "high"), [(20.2, 20.42), (20.22, 20.36), (None, 20.37), (20.24, None)])
def test_capability_of_a_normal_quantity_is_that_of_its_deviation(low: float | None, high: float | None) -> None:
    """C_p = (U - L)/6 sigma, C_pk the nearer limit in 3 sigma: sigma of 40-digit slopes, quantiles of 2^13 samples."""
    wide = ["back_step_angle >= 20 deg", "back_step_angle <= 21 deg"]
    ends = [f"back_step_angle {sign} {limit} deg" for sign, limit in ((">=", low), ("<=", high)) if limit is not None]
    made = study(CANDY, sources=FOUR, require=[*ends, *(wide if len(ends) == 2 else [])], samples=2**13)
    row = {row["quantity"]: row for row in rows(made.table_quantities())}["back_step_angle"]
    sigma, mean = 0.022538, 20.2955181747
    sides = [abs(limit - mean) / (3.0 * sigma) for limit in (low, high) if limit is not None]
    assert row["cpk"] == pytest.approx(min(sides), rel=0.05)
    if low is not None and high is not None:  # the wider limits of the same quantity do not count
        assert row["cp"] == pytest.approx((high - low) / (6.0 * sigma), rel=0.05)
    else:
        assert row["cp"] is None or math.isnan(row["cp"])


def test_a_source_made_to_a_grade_keeps_the_place_of_its_mode() -> None:
    """The mode lies at three quarters of the limits, and so it does after: -0.1 + 0.75 0.2."""
    law = {"limits": [0.01, 0.05], "law": "triangular", "mode": 0.04}
    (source,) = study(CANDY, sources={"links.crank": law}).problem.sources
    made = source.within(0.1).law
    assert (made.lower, made.upper, made.mode) == pytest.approx((-0.1, 0.1, 0.05), rel=1e-12)


@pytest.mark.slow
def test_allocation_reaches_its_target() -> None:
    sources = {key: value | {"grades": [5, 11]} for key, value in FOUR.items()}
    made = study(CANDY, sources=sources, require=["back_step_angle <= 20.36 deg"], target_yield=0.99, samples=2**15)
    found = rows(made.table_allocation())
    assert all(row["yield_low"] >= 0.99 for row in found)
    assert all(5 <= row["grade"] <= 11 for row in found)


@pytest.mark.slow
def test_correlated_sources_scatter_together() -> None:
    """Both centre distances from one jig: their slopes add before they are squared."""
    sources = {"centers.crank_idler": {"plus_minus": 0.02}, "centers.idler_output": {"plus_minus": 0.02}}
    group = [{"sources": list(sources), "rho": 1.0}]
    made = study(CANDY, sources=sources, require=["back_step_angle <= 21 deg"], correlated=group, samples=4096)
    alone = study(CANDY, sources=sources, require=["back_step_angle <= 21 deg"], samples=4096)
    sigma, of_both = (rows(one.table_quantities())[0]["sigma"] for one in (alone, made))
    assert of_both == pytest.approx(math.sqrt(2.0) * sigma, rel=5e-3)


@pytest.mark.slow
def test_sobol_indices_of_a_linear_quantity_are_its_shares() -> None:
    made = study(CANDY, sources=FOUR, require=["back_step_angle <= 20.4 deg"], samples=2**13, sobol=True)
    found = rows(made.table_contributions())
    for row in found:
        assert row["first"] == pytest.approx(row["linear"], abs=0.02)
        assert row["total"] == pytest.approx(row["linear"], abs=0.02)
        assert 0.0 <= row["first"] <= row["total"]


BAD: dict[str, tuple[dict[str, Any], str]] = {
    "no such key": ({"sources": {"links.rank": {"plus_minus": 0.1}}}, "GL170"),
    "what is found once": ({"sources": {"dwell.angle": {"plus_minus": 0.1}}}, "GL170"),
    "whole number": ({"sources": {"gears.crank": {"plus_minus": 0.1}}}, "GL170"),
    "no such pin": ({"sources": {"pins.Z": {"clearance": [0.0, 0.1]}}}, "GL170"),
    "interference": ({"sources": {"pins.A": {"fit": "H7/s6", "size": 20.0}}}, "GL171"),
    "no such class": ({"sources": {"links.crank": {"class": "q6"}}}, "GL173"),
    "grade": ({"sources": {"gears.crank": {"grade": 13, "width": 20.0}}}, "GL174"),
    "contradictory": (
        {
            "sources": {key: {"plus_minus": 0.1} for key in ("links.crank", "links.frame", "centers.crank_idler")},
            "correlated": [
                {"sources": ["links.crank", "links.frame"], "rho": 1.0},
                {"sources": ["links.frame", "centers.crank_idler"], "rho": 1.0},
                {"sources": ["links.crank", "centers.crank_idler"], "rho": -1.0},
            ],
        },
        "GL176",
    ),
    "unknown quantity": ({"sources": {"links.crank": {"plus_minus": 0.1}}, "require": ["bakc_step <= 3 deg"]}, "GL152"),
    "entry of a number": ({"sources": {"links.crank": {"plus_minus": 0.1}}, "require": ["i3[0] <= 3"]}, "GL152"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_wrong_study_says_where(name: str) -> None:
    section, code = BAD[name]
    with pytest.raises(WrongStudy) as found:
        study(CANDY, **section, samples=16).raw("yield")
    assert found.value.faults[0].code == code
    assert found.value.faults[0].place[0] == "tolerance"


def test_designs_as_made_that_do_not_exist_are_a_share() -> None:
    """A frame longer than coupler + rocker - crank is no crank-rocker; uniform, so that its share is a length."""
    made = study(
        CANDY,
        sources={"links.frame": {"plus_minus": 40.0, "law": "uniform"}},
        require=["min_transmission_angle >= 1 deg"],
        samples=64,
    )
    links = factory.design(CANDY).linkage
    share = (links.frame + 40.0 - (links.coupler + links.rocker - links.crank)) / 80.0
    (check,) = made.check("no-mechanism")
    assert (check.code, check.status, check.limit) == ("GL177", "warn", 0.0)
    assert check.value == pytest.approx(share, abs=1.0 / 64.0)


def test_slopes_that_leave_a_tenth_of_the_variance_unexplained_are_told() -> None:
    made = study(CANDY, sources=FOUR, require=["back_step_angle <= 20.4 deg"], samples=256)
    assert list(made.check("linear-shares")) == []
    slopes = made.slopes
    for share, codes in ((0.85, ["GL178"]), (0.95, [])):
        less = {
            name: [replace(row, sigma=math.sqrt(share) * row.sigma) for row in rows] for name, rows in slopes.items()
        }
        vars(made)["slopes"] = less
        found = list(made.check_linear_shares())
        assert [check.code for check in found] == codes
        assert all(check.value == pytest.approx(share, abs=0.02) for check in found)


def test_too_many_sources_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    data = CANDY | {"limits": {"gear_gap": 0.0}}
    sources = {"links.crank": {"plus_minus": 0.1}} | {f"pins.{pin}": {"clearance": [0.0, 0.1]} for pin in "ABCD"}
    made = study(data, sources=sources, sobol=True, samples=16)
    assert made.problem.coordinates == 9
    assert np.isfinite(made.raw("yield"))
    for most in (
        "gearlink.core.studies.tolerance_study.design.MOST_WITH_INDICES",
        "gearlink.core.studies.tolerance.sources.MOST_COORDINATES",
    ):
        monkeypatch.setattr(most, 8)
        with pytest.raises(WrongStudy) as found:
            _ = study(data, sources=sources, sobol=True, samples=16).problem
        (fault,) = found.value.faults
        assert (fault.code, fault.place) == ("GL175", ("tolerance", "sources"))


def register(rho: float | None, method: str = "rss", **more: Any) -> Any:
    sources = {key: FOUR[key] for key in ("centers.crank_idler", "centers.idler_output")} | more
    group = [] if rho is None else [{"sources": list(sources), "rho": rho}]
    section = {"sources": sources, "correlated": group, "samples": 2**15}
    return factory.design(CANDY | {"tolerance": section, "register": {"method": method}}, command="register")


def test_sizes_that_scatter_as_one_add_up_in_the_register() -> None:
    """rho = 1: the two standard deviations add; rho = -1 and equal gains: they cancel."""
    alone, one, against = register(None), register(1.0), register(-1.0)
    gains = np.array([row["sigma"] for row in rows(alone.table_budget()) if row["torque_sign"] == 1])
    assert alone.rss[0] == pytest.approx(math.hypot(*gains), rel=1e-14)
    assert one.rss[0] == pytest.approx(gains.sum(), rel=1e-14)
    assert against.rss[0] == pytest.approx(0.0, abs=1e-9)  # the root of a difference that is rounding
    assert one.worst == alone.worst
    assert sum(row["share"] for row in rows(one.table_budget()) if row["torque_sign"] == 1) == pytest.approx(
        1.0, rel=1e-12
    )


@pytest.mark.slow
def test_correlated_samples_of_the_chain_are_the_correlated_budget() -> None:
    """A quantile of 2^15 samples of a normal error: some thousandths."""
    assert register(0.7, "mc").band == pytest.approx(register(0.7).band, rel=0.02)


@pytest.mark.parametrize("key", ["require", "command", "correlated"])
def test_words_numbers_and_commands_that_fit_nothing_are_refused(key: str) -> None:
    wrong = {"require": ["motion >= 3"], "command": "loads"}
    if key == "correlated":
        with pytest.raises(WrongStudy, match="has a direction"):
            register(0.5, **{"pins.A": {"clearance": [0.01, 0.02]}}).report("register")
        return
    with pytest.raises((WrongStudy, NoSolution), match=r"word|loads"):
        study(CANDY, sources=FOUR, samples=64, **{key: wrong[key]}).report("tolerance")


def test_limits_beyond_all_machines_leave_no_mechanism() -> None:
    made = study(CANDY, sources={"links.crank": {"plus_minus": 1e12}}, samples=64)
    assert (made.no_mechanism, made.raw("yield")) == (1.0, 0.0)


@pytest.mark.slow
def test_indices_of_correlated_sources_are_those_of_their_group() -> None:
    """Of a nearly linear quantity: the group's share of the variance, (g1 + g2)^2 where both are one, and the rest."""
    group = [{"sources": ["centers.crank_idler", "centers.idler_output"], "rho": 1.0}]
    section = {"sources": FOUR, "correlated": group, "require": ["back_step_angle <= 21 deg"], "sobol": True}
    found = rows(study(CANDY, **section, samples=2**13).table_contributions())
    crank, frame, both = 2.9581448247**2, 0.7503110467**2, (2.0 * 1.0285307299) ** 2
    shares = {"links.crank": crank, "links.frame": frame, "centers.crank_idler": both, "centers.idler_output": both}
    for row in found:
        assert row["first"] == pytest.approx(shares[row["source"]] / (crank + frame + both), abs=0.01)
        assert row["total"] == pytest.approx(row["first"], abs=0.01)
        half = 0.5 if row["source"].startswith("centers") else 1.0  # each of the two covers half of the group's
        assert row["linear"] == pytest.approx(half * shares[row["source"]] / (crank + frame + both), rel=1e-6)


def test_a_check_that_fails_more_than_any_requirement_is_named() -> None:
    """The transmission angle of half of the drives lies below a limit just at the nominal one."""
    data = CANDY | {"limits": {"transmission_angle": 61.4}}
    nominal = factory.design(data).min_transmission_angle
    data = CANDY | {"limits": {"transmission_angle": math.degrees(nominal) - 1e-6}}
    made = study(data, sources=FOUR, require=["back_step_angle <= 21 deg"], samples=512, target_yield=0.9)
    (found,) = made.check("target-yield")
    assert found.status == "fail"
    assert "GL303, which fails most" in found.fix
    assert f"yield: {100.0 * made.result.good.low:.4g} % (limit >= 90 %" in found.message
