"""The budget of an error: bands about a mean, against the normal distribution itself and against samples of a chain."""

from __future__ import annotations

import json
import math
import re
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.studies.tolerance.budget import Contribution, budget, normal_band
from gearlink.core.studies.tolerance.sampling import COMPUTED_BY, replication
from gearlink.core.studies.tolerance.sources import deviations_of

COVERED = math.erf(3.0 / math.sqrt(2.0))  # 99.73 %
CANDY: dict[str, Any] = {
    "kind": "three-gear-four-bar",
    "name": "candy",
    "gears": {"module": 2.0, "crank": 40, "idler": 72, "output": 40},
    "links": {"crank": 38.94178567, "frame": 153.53024891},
}


SMALL = {"sources": {"links.crank": {"plus_minus": 0.02}}, "samples": 64, "seed": 5}


def register(sources: dict[str, Any], **section: Any) -> Any:
    samples = section.pop("samples", 2**15)
    data = CANDY | {"tolerance": {"sources": sources, "samples": samples}, "register": section}
    return factory.design(data, command="register")


@pytest.mark.parametrize("mean", [0.0, 1e-9, 0.01, 0.7, 1.0, 3.0, 30.0])
def test_a_band_holds_the_share_of_three_sigma(mean: float) -> None:
    """By erf, which the band does not use; both tails to rounding."""
    b = float(normal_band(np.array([mean]), np.array([1.0]))[0])
    inside = 0.5 * (math.erf((b - mean) / math.sqrt(2.0)) + math.erf((b + mean) / math.sqrt(2.0)))
    assert inside == pytest.approx(COVERED, abs=4e-16)


def test_a_band_does_not_depend_on_sign_or_unit() -> None:
    mean, sigma = np.array([0.5, -0.5, 0.0, -2.0]), np.array([0.2, 0.2, 0.2, 0.0])
    found = normal_band(mean, sigma)
    assert found[0] == found[1]
    assert found[2:].tolist() == pytest.approx([0.6, 2.0], abs=1e-15)
    assert normal_band(1e-6 * mean, 1e-6 * sigma) == pytest.approx(1e-6 * found, rel=1e-14)


@pytest.mark.parametrize("count", [1, 2, 3, 4, 12])
def test_what_most_machines_keep_ends_where_the_sources_do(count: int) -> None:
    """3 sigma of n uniform sizes is sqrt(3 n) of their limit: more than all n together up to n = 3."""
    sources = [Contribution(f"{i}", np.array([1.0]), 0.01, 0.01 / math.sqrt(3.0)) for i in range(count)]
    found = budget(sources, None)
    assert found.band[0] == pytest.approx(0.01 * math.sqrt(3.0 * count), rel=1e-14)
    assert found.kept[0] == pytest.approx(0.01 * min(count, math.sqrt(3.0 * count)), rel=1e-14)


def test_a_register_that_no_machine_exceeds_does_not_fail() -> None:
    """3 sigma of one pin that touches its hole are more than half its clearance."""
    given = {"at": 100.0, "radius": 40.0}
    worst, band = (
        max(getattr(register({"pins.A": {"clearance": [0.0, 0.02]}}, **given), name)) for name in ("worst", "band")
    )
    assert worst < band
    for limit, status in ((1.001 * worst, "pass"), (0.999 * worst, "fail")):
        made = register({"pins.A": {"clearance": [0.0, 0.02]}}, tolerance=limit, **given)
        (check,) = made.check("register-budget")
        assert (check.status, check.value) == (status, pytest.approx(worst, rel=1e-12))


def test_what_exceeds_its_limit_has_its_own_band_beside_the_limits_of_the_others() -> None:
    """C_p 0.5: 3 sigma are twice the limit. Samples of the sum: 2^18 know a quantile of 0.9973 to a few thousandths."""
    loose = [Contribution(f"l{i}", np.array([1.0]), 0.01, 0.02 / 3.0, keeps=False) for i in range(2)]
    even = Contribution("even", np.array([1.0]), 0.09, 0.09 / math.sqrt(3.0))
    rho = {("l0", "l1"): 0.5, ("l1", "l0"): 0.5, ("even", "l0"): 0.2, ("l0", "even"): 0.2}
    (band,) = budget([*loose, even], None, rho).kept
    assert band == pytest.approx(0.09 + 0.02 * math.sqrt(3.0), rel=1e-14)
    chance = np.random.default_rng(3)
    x, y, z = chance.multivariate_normal(np.zeros(3), [[1, 0.5, 0.2], [0.5, 1, 0], [0.2, 0, 1]], 2**18).T
    total = 0.02 / 3.0 * (x + y) + 0.09 * np.vectorize(math.erf)(z / math.sqrt(2.0))
    assert np.quantile(np.abs(total), COVERED) < band


@pytest.mark.parametrize(
    ("law", "keeps"),
    [
        ({}, True),
        ({"law": "uniform"}, True),
        ({"cp": 1.5, "cpk": 1.0, "shift": "up"}, True),
        ({"cp": 1.5, "cpk": 0.9, "shift": "up"}, False),
        ({"cp": 0.5}, False),
    ],
)
def test_parts_keep_their_limits_where_the_process_is_capable(law: dict[str, Any], keeps: bool) -> None:
    made = register({"links.crank": {"plus_minus": 0.02} | law, "pins.A": {"clearance": [0.0, 0.02]}}, at=100.0)
    one = {each.source: each for each in made.contributions(made.input_angles, 1)}
    assert (one["links.crank"].keeps, one["pins.A"].keeps) == (keeps, True)
    assert (made.kept[0] <= made.worst[0]) is (law.get("cp") != 0.5)


@pytest.mark.parametrize(
    ("method", "title", "words"),
    [
        ("rss", "99.73 % of the machines, torque + and -", "99.73 %: "),
        ("worst", "all of the machines, torque + and -", "worst case: "),
        ("mc", "99.73 % of the samples, torque + and -", "99.73 %: "),
    ],
)
def test_a_band_is_called_by_its_method(method: str, title: str, words: str) -> None:
    source = {"links.crank": {"plus_minus": 0.02}}
    report = register(source, method=method, tolerance=1e-3, samples=256).report("register")
    assert [each.title for each in report.key if each.quantity.name == "band"] == [title]
    (check,) = (each for each in report.checks if each.code == "GL520")
    assert words in check.message
    assert ("99.73" in check.message) is (method != "worst")


def test_an_uneven_profile_counts_at_both_ends() -> None:
    """At worst it is high here and low at the start; at random the two are independent."""
    one = Contribution("profile", np.array([1.0, 2.0]), 0.03, 0.01, relative=False)
    found = budget([one], 0)
    assert found.worst[1] == pytest.approx(0.03 * 3.0, rel=1e-15)
    assert found.rss[1] == pytest.approx(0.01 * math.sqrt(5.0), rel=1e-15)
    assert (found.rows[0].gain, found.rows[0].worst) == (3.0, pytest.approx(0.09, rel=1e-12))
    assert budget([one], None).worst.tolist() == pytest.approx([0.03, 0.06], rel=1e-12)


def test_a_mean_is_relative_to_the_start_as_gains_are() -> None:
    one = Contribution("long", np.array([1.0, 3.0]), 0.02, 0.0, mean=0.01)
    found = budget([one], 0)
    assert found.mean.tolist() == [0.0, 0.02]
    assert found.band.tolist() == [0.0, 0.02]
    assert (found.at, found.rows[0].mean, found.rows[0].share) == (1, 0.02, 0.0)


def test_a_process_off_its_middle_moves_the_band() -> None:
    """C_p 2, C_pk 0.5: the crank is 15 um too long in the mean, 4.5 sigma: one tail alone counts."""
    made = register({"links.crank": {"plus_minus": 0.02, "cp": 2.0, "cpk": 0.5, "shift": "up"}}, at=270.0)
    (row,) = made.budgets[0].rows
    assert abs(row.mean) == pytest.approx(row.gain * 0.015, rel=1e-14)
    assert made.band[0] == pytest.approx(row.gain * (0.015 + 2.7821749705 * 0.02 / 6.0), rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("law", [{"cp": 1.5, "cpk": 0.6, "shift": "down"}, {}])
def test_samples_of_the_chain_keep_the_band(law: dict[str, Any]) -> None:
    """A quantile of 2^15 samples of a normal error: some thousandths."""
    sources = {"links.crank": {"plus_minus": 0.02} | law, "links.frame": {"limits": [-0.01, 0.05]}}
    assert register(sources, method="mc").band == pytest.approx(register(sources).band, rel=0.01)


@pytest.mark.quick(1)
@pytest.mark.parametrize("method", ["rss", "worst"])
@pytest.mark.parametrize("share", [0.9, 0.6, 0.3, 0.01])
def test_the_advice_keeps_the_budget_where_it_is_followed(share: float, method: str) -> None:
    """It named the first row alone, also where that row could vanish and the budget not be kept. The file is written
    anew by what the advice says: it passes, and with a twentieth more it fails again."""
    limits = {"links.crank": 0.02, "links.frame": 0.03, "centers.crank_idler": 0.02}

    def judged(tighter: Any = (), factor: float = 1.0, limit: float = 1.0) -> Any:
        sources = {key: {"plus_minus": one * (factor if key in tighter else 1.0)} for key, one in limits.items()}
        return next(iter(register(sources, tolerance=limit, method=method).check("register-budget")))

    limit = share * judged().value
    found = judged(limit=limit)
    which, percent = re.fullmatch(r"tighten (.*) to ([\d.]+) % of (?:its|their) limits", found.fix).groups()  # type: ignore[union-attr]
    named = set(limits) if which == "all sources" else set(re.split(", | and ", which))
    assert named <= set(limits)
    assert judged(named, float(percent) / 100.0, limit).value <= limit
    assert judged(named, 1.05 * float(percent) / 100.0, limit).status == "fail"
    fewer = [judged(named - {one}, 0.4, limit).status for one in named]
    assert share < 0.4 or len(named) == 1 or "fail" in fewer


def test_a_share_that_is_computed_elsewhere_is_that_of_the_design() -> None:
    """What is sent is the design's text: the same file, so the same samples to the last bit."""
    made = factory.design(CANDY | {"tolerance": SMALL, "register": {"method": "mc"}}, command="register")
    sent: list[Any] = []

    def elsewhere(function: Any, numbers: Any, _work: int) -> list[Any]:
        sent.append(function.args)
        return [function(number) for number in list(numbers)[:2]]

    token = COMPUTED_BY.set(elsewhere)
    try:
        found = made.sampled_band
    finally:
        COMPUTED_BY.reset(token)
    ((_, _, text),) = sent
    assert json.loads(text) == json.loads(made.spec.model_dump_json(exclude_unset=True, by_alias=True))
    here = np.sort(np.concatenate([made.sampled_share(number) for number in range(2)], axis=2), axis=2)
    assert found == [float(one[:, -1].max()) for one in here]  # 99.73 % of 64 are all of them


@pytest.mark.slow
def test_the_band_of_samples_is_that_of_the_place_where_the_errors_are_largest() -> None:
    """Thirteen even places missed it: 0.78 of the band of this cam, whose slopes are short."""
    sources = {"follower.roller_radius": {"plus_minus": 0.02}, "cam.profile": {"plus_minus": 0.02}}
    one, other = (
        factory.design("lift_cam", command="register", tolerance={"sources": sources}, register={"method": method})
        for method in ("rss", "mc")
    )
    assert other.band == pytest.approx(one.band, rel=0.05)


@pytest.mark.slow
def test_the_band_keeps_99_73_percent_of_all_samples() -> None:
    """The mean of the bands of the replications, each of 64 samples here, kept fewer."""
    tolerance = {"sources": {"links.crank": {"plus_minus": 0.02}, "links.frame": {"plus_minus": 0.02}}, "samples": 1024}
    place = {"method": "mc", "at": "100"}
    made = factory.design(CANDY | {"tolerance": tolerance, "register": place}, command="register")
    drawn = (replication(sum(one.coordinates for one in made.sources), 1024, 1, number) for number in range(16))
    every = np.concatenate([made.sampled_errors(made.sampled_places, 1, deviations_of(made.sources, points))
                            for points in drawn], axis=1)  # fmt: skip
    assert np.count_nonzero(np.abs(every[0]) <= made.band[0]) == math.ceil(0.9973 * 1024)


@pytest.mark.parametrize("place", [{}, {"at": "100"}])
def test_samples_that_do_not_close_are_refused(place: dict[str, str]) -> None:
    """They had a band of NaN. 3.4 % of these rods are shorter than crank and offset together."""
    data = {"kind": "slider-crank", "name": "s", "crank": 154.2116, "rod": 520.0, "offset": 50.0}
    tolerance = {"sources": {"rod": {"plus_minus": 520.0}, "crank": {"plus_minus": 0.02}}, "samples": 1024}
    made = factory.design(data | {"tolerance": tolerance, "register": {"method": "mc"} | place}, command="register")
    with pytest.raises(
        NoSolution, match=r"samples too far off nominal to be closed: .* % \(limit <= 0.27 %\)"
    ) as found:
        _ = made.band
    assert (found.value.key, found.value.fix) == ("tolerance.sources", "tighten rod, which moves the output most")


def test_a_measured_part_is_an_error_without_scatter() -> None:
    made = register({"links.crank": {"measured": 38.95178567}, "links.frame": {"plus_minus": 1e-6}}, at=270.0)
    gain = {row.source: row.gain for row in made.budgets[0].rows}["links.crank"]
    frame = {row.source: row.sigma for row in made.budgets[0].rows}["links.frame"]
    assert made.band[0] == pytest.approx(0.01 * gain + 2.7821749705 * frame, rel=1e-9)


def test_a_pin_that_floats_lies_anywhere_in_its_hole() -> None:
    """Of a disc of radius r one coordinate scatters by r/2, of its edge by r/sqrt(2)."""
    fit, at = {"clearance": [0.04, 0.04 + 1e-9]}, 100.0
    one, other = (register({"pins.B": fit | {"play": play}}, at=at) for play in ("contact", "floating"))
    gain = abs(one.contributions(one.input_angles, 1)[0].gain[0])
    assert one.rss[0] == pytest.approx(gain * 0.02 / math.sqrt(2.0), rel=1e-6)
    assert other.rss[0] == pytest.approx(gain * 0.01, rel=1e-6)
    sampled = register({"pins.B": fit | {"play": "floating"}}, at=at, method="mc")
    assert gain * 0.0195 < sampled.band[0] < gain * 0.02  # the share 0.27 % of a disc lies beyond 0.98 of its radius


@pytest.mark.slow
def test_twist_of_a_shaft_counts_in_band_and_samples_alike() -> None:
    twist = {"stiffness": 500.0, "load": 3.0, "at": 100.0}
    one, other = (register({"links.crank": {"plus_minus": 0.002}}, method=m, **twist) for m in ("rss", "mc"))
    assert one.band[0] > 40.0 * 3.0 / 500.0
    assert other.band == pytest.approx(one.band, rel=2e-3)


def test_samples_in_portions_keep_the_same_band(monkeypatch: pytest.MonkeyPatch) -> None:
    """Portions of 100 and of all: the same samples, closed by Newton's method to rounding."""
    sources = {"links.crank": {"plus_minus": 0.02}, "links.frame": {"limits": [-0.01, 0.05]}}
    whole = register(sources, method="mc", samples=256).band
    monkeypatch.setattr("gearlink.core.studies.register._AT_ONCE", 100)
    assert register(sources, method="mc", samples=256).band == pytest.approx(whole, rel=1e-9)
