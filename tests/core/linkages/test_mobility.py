"""Degrees of freedom of linkages with gear trains.

No tolerances: everything is whole numbers. The second method counts the rank of the velocity constraints of pins and
meshes at a random position, with a threshold of 1e-9 of the largest singular value (the nearest ones differ by 1e-3).
"""

import cmath
import json
import math
import random
from pathlib import Path

import factory
import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.spec_paths import changed
from gearlink.core.machines.mobility import Constraints, common_links, linkage_mobility, pin_names, train_change

REFERENCE = Path(__file__).parents[2] / "reference"
CASES = {case["id"]: case for case in json.loads((REFERENCE / "gear_linkage.json").read_text())["cases"]}
FOUR_BAR = {"frame": "AD", "crank": "AB", "coupler": "BC", "rocker": "CD"}
FIVE_BAR = {"frame": "AE", "input": "AB", "left": "BC", "right": "CD", "output": "DE"}
SIX_LOOP = {"frame": "AF", "p": "AB", "q": "BC", "r": "CD", "s": "DE", "t": "EF"}
WATT = {"frame": "ADG", "crank": "AB", "coupler": "BC", "plate": "CDE", "link": "EF", "output": "FG"}


def design(links, trains, wanted=1):
    data = {
        "kind": "gear-train-mobility",
        "links": {name: {"pins": list(pins)} for name, pins in links.items()},
        "trains": trains,
        "mobility": wanted,
    }
    return factory.design(data)


def train(*gears, **keys):
    """A train from pins: "A" is free, "A:crank" fixed to the crank."""
    parts = [gear.partition(":") for gear in gears]
    return {"gears": [{"at": pin, **({"fixed_to": link} if link else {})} for pin, _, link in parts], **keys}


def freedom_by_rank(links, trains, seed=1):
    """Degrees of freedom from the rank of the velocity constraints, the first link at rest."""
    draw = random.Random(seed)
    places = {pin: cmath.rect(1.0, draw.uniform(0.0, 2.0 * math.pi)) for pin in pin_names(links)}
    names = list(links)
    free = [(i, j) for i, t in enumerate(trains) for j, gear in enumerate(t["gears"]) if "fixed_to" not in gear]
    size = 3 * len(names) + len(free)
    rows = []

    def spin(i, j):
        gear = trains[i]["gears"][j]
        row = np.zeros(size)
        row[3 * names.index(gear["fixed_to"]) + 2 if "fixed_to" in gear else 3 * len(names) + free.index((i, j))] = 1.0
        return row

    def velocity(link, pin):
        x, y = np.zeros(size), np.zeros(size)
        k = 3 * names.index(link)
        x[k], x[k + 2], y[k + 1], y[k + 2] = 1.0, -places[pin].imag, 1.0, places[pin].real
        return x, y

    for pin in places:
        first, *others = [name for name in names if pin in links[name]]
        for other in others:
            rows += [p - q for p, q in zip(velocity(first, pin), velocity(other, pin), strict=True)]
    for i, t in enumerate(trains):
        for j in range(len(t["gears"]) - 1):
            one, other = t["gears"][j]["at"], t["gears"][j + 1]["at"]
            carrier = np.zeros(size)
            carrier[3 * names.index(common_links(links, one, other)[0]) + 2] = 1.0
            share = draw.uniform(0.2, 0.8)
            rows.append(share * (spin(i, j) - carrier) + (1.0 - share) * (spin(i, j + 1) - carrier))
    for k in range(3):
        row = np.zeros(size)
        row[k] = 1.0
        rows.append(row)
    values = np.linalg.svd(np.array(rows), compute_uv=False)
    return size - int(np.sum(values > 1e-9 * values[0]))


def test_reference_cases():
    case = CASES["structure"]
    found = [f + train_change(r) for f, _, r in case["inputs"]["cases"]]
    assert found == case["outputs"]["F"]
    assert 3 + 2 * train_change(2) == case["outputs"]["six_bar_two_trains_R2"]


@pytest.mark.parametrize(("links", "expected"), [(FOUR_BAR, 1), (FIVE_BAR, 2), (SIX_LOOP, 3), (WATT, 1)])
def test_linkages(links, expected):
    assert linkage_mobility(links) == expected == freedom_by_rank(links, [])


@pytest.mark.parametrize("gears", [2, 3, 7])
@pytest.mark.parametrize("fixed", [0, 1, 2])
def test_rule_counts_bodies_and_joints(gears, fixed):
    assert train_change(fixed) == 3 * (gears - fixed) - 2 * (gears - fixed) - (gears - 1)


@pytest.mark.parametrize(
    ("links", "trains"),
    [
        (FOUR_BAR, [train("B:crank", "C", "D")]),
        (FOUR_BAR, [train("A", "B:coupler")]),
        (FOUR_BAR, [train("B", "C", "D")]),
        (FOUR_BAR, [train("B:crank", "C", "D:frame")]),
        (FIVE_BAR, [train("A:input", "E:output")]),
        (FIVE_BAR, [train("A:frame", "B:left")]),
        (SIX_LOOP, [train("A:frame", "B:q"), train("F:frame", "E:s")]),
        (WATT, [train("C:coupler", "E:link")]),
    ],
)
def test_rule_against_the_rank_of_the_constraints(links, trains):
    made = design(links, trains, 0)
    assert made.mobility == freedom_by_rank(links, trains)
    assert [c.status for c in made.check("train-fit")] == ["pass"] * len(trains)


TWICE = [("A:frame", 20), ("B:q", 20)], [("A:frame", 40), ("B:q", 40)]
HELD = [("A:frame", 20), ("B:q", 20)], [("A:frame", 50), ("B:q", 30)]


def toothed(*gears):
    made = train(*(gear for gear, _ in gears))
    return {"gears": [{**gear, "teeth": z} for gear, (_, z) in zip(made["gears"], gears, strict=True)]}


def test_two_trains_that_tie_the_same_count_once():
    """Equal gears on A and B twice: the loop keeps two degrees of freedom, though 3 - 1 - 1 = 1 is counted."""
    made = design(SIX_LOOP, [toothed(*gears) for gears in TWICE])
    (found,) = made.check("mobility")
    assert made.mobility == 1
    assert (found.status, found.value) == ("fail", 2.0)
    assert "mobility F by the constraints" in found.message
    assert {check.status for check in made.check("train-fit")} == {"pass"}


def test_two_trains_that_hold_their_gears_fast():
    """Other ratios on the same pins: AB and BC stand, and what moves are the four links beyond."""
    made = design(SIX_LOOP, [toothed(*gears) for gears in HELD])
    assert [check.status for check in made.check("train-fit")] == ["fail", "fail"]
    assert [check.status for check in made.check("mobility")] == ["pass"]
    other = design(SIX_LOOP, [toothed(("A:frame", 20), ("B:q", 20)), toothed(("F:frame", 20), ("E:s", 30))])
    assert {check.status for name in ("train-fit", "mobility") for check in other.check(name)} == {"pass"}


def test_a_bar_too_many_in_one_part_does_not_pay_for_a_bar_too_few_in_another():
    links = {"frame": "ABDP", "one": "AC", "two": "BC", "three": "DC", "crank": "PQ", "rod": "QR"}
    assert linkage_mobility(links) == 1
    assert freedom_by_rank(links, []) == 2
    (found,) = design(links, []).check("mobility")
    assert (found.status, found.value) == ("fail", 2.0)
    assert "mobility F by the constraints" in found.message


@pytest.mark.parametrize("seed", range(12))
def test_freedom_of_random_linkages_against_the_rank(seed):
    """Loops with further bars, and trains of free and fixed gears on them."""
    draw = random.Random(seed)
    links = dict(draw.choice([FOUR_BAR, FIVE_BAR, SIX_LOOP, WATT]))
    pins = pin_names(links)
    for k in range(draw.randrange(3)):
        links[f"more {k}"] = draw.sample(pins, 2) if draw.random() < 0.6 else [draw.choice(pins), f"Z{k}"]
    carriers = [name for name, own in links.items() if len(own) > 1]
    trains = []
    for _ in range(draw.randrange(3)):
        ends = draw.sample(list(links[draw.choice(carriers)]), 2)
        held = [draw.choice(["", *(f":{name}" for name, own in links.items() if end in own)]) for end in ends]
        trains.append(train(*(end + fixed for end, fixed in zip(ends, held, strict=True))))
    found = Constraints(links, design(links, trains).spec.trains)
    assert found.freedom == freedom_by_rank(links, trains)
    assert bool(found.repeated) == (found.freedom != linkage_mobility(links) + sum(
        train_change(sum("fixed_to" in gear for gear in each["gears"])) for each in trains
    ))  # fmt: skip


@pytest.mark.parametrize(("ring", "status"), [(60, "pass"), (41, "pass"), (40, "fail"), (20, "fail")])
def test_a_ring_has_more_teeth_than_the_gear_in_it(ring, status):
    gears = [{"at": "B", "fixed_to": "coupler", "teeth": 40}, {"at": "A", "teeth": ring, "ring": True}]
    made = design(FOUR_BAR, [{"module": 2.0, "gears": gears}])
    assert [check.status for check in made.check("train-fit")] == [status]


def test_ends_on_one_link_take_no_freedom_away():
    """The rule counts -1, the rank shows that nothing is lost: the check says so."""
    trains = [train("B:coupler", "C:coupler")]
    made = design(FOUR_BAR, trains)
    assert (made.mobility, freedom_by_rank(FOUR_BAR, trains)) == (0, 1)
    (found,) = made.check("train-fit")
    assert found.status == "fail"
    assert "carries the whole train" in found.message


@pytest.mark.parametrize(
    ("gears", "words"),
    [
        (("A", "C"), "no link carries both"),
        (("B", "C:rocker", "D"), "only end gears"),
        (("B:frame", "C"), "fix it to crank or coupler"),
        (("B", "B"), "same pin B"),
    ],
)
def test_reasons(gears, words):
    found = design(FOUR_BAR, [train(*gears)]).check("train-fit")
    assert any(c.status == "fail" and words in "; ".join(c.lines) for c in found)


def test_centre_distance_against_the_link():
    data = train("A", "B:coupler", module=2.0)
    data["gears"][0]["teeth"], data["gears"][1]["teeth"] = 18, 36
    spec = {"kind": "gear-train-mobility", "links": {n: {"pins": list(p)} for n, p in FOUR_BAR.items()}}
    spec["trains"] = [data]
    for length, status in ((54.0, "pass"), (54.001, "fail")):
        spec["links"]["crank"]["length"] = length
        (found,) = factory.design(spec).check("train-fit")
        assert found.status == status
    assert "54 mm" in found.message
    data["gears"][0]["ring"], data["gears"][0]["teeth"] = True, 90
    spec["links"]["crank"]["length"] = 54.0
    (found,) = factory.design(spec).check("train-fit")
    assert found.status == "pass"


@pytest.mark.parametrize(
    ("links", "trains", "remedy"),
    [
        (FOUR_BAR, [train("B:crank", "C", "D:frame")], "free one end gear"),
        (FOUR_BAR, [train("B", "C", "D")], "fix one end gear"),
        (FIVE_BAR, [train("A:input", "E")], "fix one end gear"),
        (FIVE_BAR, [], "both ends of 1 more train (each"),
        (SIX_LOOP, [], "both ends of 2 more trains (each"),
    ],
)
def test_wrong_freedom_names_the_remedy(links, trains, remedy):
    (found,) = design(links, trains).check("mobility")
    assert found.status == "fail"
    assert remedy in found.fix


@pytest.mark.parametrize(
    ("links", "trains", "key"),
    [
        (FOUR_BAR, [train("B", "X")], "trains[0].gears[1].at"),
        (FOUR_BAR, [train("B:lever", "C")], "trains[0].gears[0].fixed_to"),
        (FOUR_BAR, [train("B:crank", "C:rocker", "D:frame")], "trains[0].gears"),
        ({"frame": "AD", "crank": "BC"}, [], "links"),
        ({"frame": "AD", "crank": "DAD"}, [], "links"),
    ],
)
def test_refusals(links, trains, key):
    with pytest.raises(NoSolution) as refused:
        _ = design(links, trains).mobility
    assert refused.value.key == key


def test_two_trains_hold_two_pins_at_one_distance():
    """Own derivation: A and E stay 40 mm apart by the first train, 50 by the second."""
    first, second = train("A:input", "E:output", module=2.0), train("A", "E", module=2.0)
    for data, teeth in ((first, (20, 20)), (second, (20, 30))):
        for gear, count in zip(data["gears"], teeth, strict=True):
            gear["teeth"] = count
    found = design(FIVE_BAR, [first, second], wanted=2).check("train-fit")
    assert [check.status for check in found] == ["pass", "fail"]
    assert "50 mm" in found[1].message
    assert "40 mm" in found[1].message
    second["gears"][1]["teeth"] = 20
    assert {check.status for check in design(FIVE_BAR, [first, second], wanted=2).check("train-fit")} == {"pass"}


@pytest.mark.slow
@pytest.mark.parametrize(("at", "status"), [("A", 0), ("nowhere", 2)])
def test_the_diagram_asks_for_names_first(gearlink, tmp_path, at, status):
    path = tmp_path / "six.yaml"
    path.write_text(
        "kind: gear-train-mobility\nlinks: {frame: {pins: [A, F]}, crank: {pins: [A, B]}}\n"
        f"trains: [{{gears: [{{at: {at}}}, {{at: A}}]}}]\n"
    )
    ended = gearlink("analyze", path, "--quantity", "link_count", "--plot", "--out", tmp_path)
    assert ended.status == status


def test_a_length_that_does_not_fit_is_named_by_its_key():
    data = train("A", "B:coupler", module=2.0)
    data["gears"][0]["teeth"], data["gears"][1]["teeth"] = 18, 36
    for name in ("crank", "7"):
        links = {name if n == "crank" else n: {"pins": list(p)} for n, p in FOUR_BAR.items()}
        links[name]["length"] = 52.0
        made = factory.design({"kind": "gear-train-mobility", "links": links, "trains": [data]})
        (found,) = made.findings("analyze", "train-fit")
        assert f"links.{name}.length 52 mm" in found.message
        # a name of digits alone is no key of a path: the teeth are changed there
        assert (
            found.remedy == ((f"links.{name}.length", 54.0),) if name == "crank" else found.remedy[0][0][-5:] == "teeth"
        )
        assert {c.status for c in type(made)(changed(made.spec, found.remedy)).check("train-fit")} == {"pass"}


@pytest.mark.parametrize(
    ("links", "trains"),
    [
        (FOUR_BAR, [train("B", "C:rocker", "D:frame")]),
        (FOUR_BAR, [train("B:frame", "C")]),
        (FOUR_BAR, [train("B:coupler", "C:coupler")]),
        (FOUR_BAR, [train("B:crank", "C", "D:frame")]),
        (FOUR_BAR, [train("B", "C", "D")]),
        (FIVE_BAR, [train("A:input", "E")]),
        (FIVE_BAR, [train("A", "E")]),
    ],
)
def test_followed_remedies_of_trains(links, trains):
    made = design(links, trains)
    wrong = [c for name in ("train-fit", "mobility") for c in made.findings("analyze", name) if c.status == "fail"]
    assert wrong
    for found in wrong:
        if found.remedy:
            after = type(made)(changed(made.spec, found.remedy))
            assert {c.status for c in after.check(found.name)} == {"pass"}
            for name in ("train-fit", "mobility"):
                if all(c.status == "pass" for c in made.check(name)):
                    assert all(c.status == "pass" for c in after.check(name))
    assert any(found.remedy for found in wrong)
