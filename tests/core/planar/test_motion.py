"""Positions to jerks of planar mechanisms, their extremes and dead centres, against other ways to the same numbers."""

from __future__ import annotations

import math
import re
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from oracles.planar import motion
from oracles.planar_zoo import FOUR_BAR, WATT, ZOO, made
from sweeps import ALL, mostly_slow, spread

from gearlink.cli.opening import design, load
from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.planar import course
from gearlink.core.machines.planar.design import PlanarMechanism
from gearlink.core.machines.planar.system import joined
from gearlink.core.mechanism import follow

DESIGNS = Path(__file__).parents[3] / "designs"


@cache
def of_zoo(name: str) -> PlanarMechanism:
    return PlanarMechanism(made(name))


def planar(name: str, **more: Any) -> PlanarMechanism:
    return PlanarMechanism(made(name, **more)) if more else of_zoo(name)


_QUICK = [("four-bar", 0.31), ("slide-on-lever", 0.83)]


@pytest.mark.parametrize(
    ("name", "share"),
    mostly_slow(
        [*_QUICK, *((name, share) for name in ZOO for share in (0.31, 0.83) if (name, share) not in _QUICK)], 1
    ),
)
def test_positions_and_three_derivatives_against_forty_digits(name: str, share: float) -> None:
    """Joints written down anew from the file, a root of 40 digits, differences of nine places."""
    course = planar(name).course
    size = course.structure.size
    x, t = course.at_start.closed
    start = _unknowns(x[None] * size, t[None])
    q = course.start + share * (course.end - course.start)
    jets = course.jets(np.array([q]), 3)
    scale = 1.0 / size if course.by_slide else 1.0
    found = [_unknowns(jets.x[k] * size, jets.t[k]) * (math.factorial(k) * scale**k) for k in range(4)]
    wanted = motion(ZOO[name], start.tolist(), found[0].tolist(), q)
    for order, (mine, other) in enumerate(zip(found, wanted, strict=True)):
        exact = np.array([float(each) for each in other])
        assert mine == pytest.approx(exact, rel=1e-10, abs=1e-11 * max(1.0, np.abs(exact).max())), (order, share)


def _unknowns(x: Any, t: Any) -> Any:
    return joined(x, t)[0]


def test_a_geared_five_bar_is_the_kind_of_that_name() -> None:
    mine, other = load(DESIGNS / "planar_five_bar.yaml"), load(DESIGNS / "five_bar_path.yaml")
    one, two = mine.table("points"), other.table("path")
    for column in ("x", "y"):
        names = [name for name in two.columns if name.endswith(f"{column}") or name == f"point_{column}"]
        data = np.asarray(two.data[two.columns.index(names[0])])
        assert np.asarray(one.data[one.columns.index(f"M_{column}")]) == pytest.approx(data, abs=1e-12)


def test_a_slot_on_a_pin_of_the_frame() -> None:
    """A bar on a crank, through a trunnion at C: its pin slides by the distance of the crank pin, -|B - C|."""
    radius, center = 200.0, -600.0
    mine = design(
        kind="planar-mechanism",
        frame={"A": [0, 0], "C": [center, 0]},
        links={"crank": ["A", "B", radius], "bar": {"B": [0, 0], "D": [-1000, 0]}},
        slots={"sleeve": {"point": "C", "on": "bar", "through": [0, 0], "direction": 0}},
        drive={"link": "crank"},
        start={"crank": 0, "bar": 0},
        outputs=["sleeve"],
    )
    table = mine.table("slides", samples=12)
    place, speed = (
        np.asarray(table.data[table.columns.index(f"sleeve_{each}")]) for each in ("position", "velocity_ratio")
    )
    pin = radius * np.exp(1j * np.radians(np.arange(0.0, 360.0, 30.0)))
    assert place == pytest.approx(-np.abs(pin - center), rel=1e-13)
    assert speed == pytest.approx(-(np.conj(pin - center) * 1j * pin).real / np.abs(pin - center), abs=1e-11)


@pytest.mark.slow
def test_the_bed_chain_is_that_of_the_press() -> None:
    mine, press = load(DESIGNS / "planar_bed_chain.yaml"), load(DESIGNS / "ty460.yaml")
    degrees = np.arange(0.0, 360.0, 30.0)
    table = press.table("positions")
    bed = np.asarray(table.data[table.columns.index("bed_displacement")])
    slides = mine.table("slides", samples=12)
    place = np.asarray(slides.data[slides.columns.index("guide_bed_position")])
    assert len(bed) == len(degrees) == len(place)
    assert place[0] - place == pytest.approx(bed, abs=1e-10)


@pytest.mark.slow
@pytest.mark.parametrize("name", mostly_slow(["four-bar", "cylinder", "watt", "quick-return"], 1))
def test_extremes_against_dense_rows(name: str) -> None:
    """None of 20,000 rows lies beyond an extreme, and the row next to its place comes near it."""
    design = planar(name)
    course = design.course
    q = np.linspace(course.start, course.end, 20_001)
    jets = course.jets(q, 3)
    for key, meaning in design.meanings.items():
        if meaning.side not in ("max", "min"):
            continue
        value, place = design.raw(key), design.raw(f"{key}_at")
        if value is None:
            continue
        rows = course.derivatives(meaning.output.coefficient, jets, meaning.order)[meaning.order]
        top = rows.max() if meaning.side == "max" else rows.min()
        size = np.abs(rows).max() + 1e-12
        assert abs(value - top) <= 2e-6 * size
        assert (value - top) * (1 if meaning.side == "max" else -1) >= -1e-12 * size
        here = course.jets(np.array([place]), 3)
        again = course.derivatives(meaning.output.coefficient, here, meaning.order)[meaning.order][0]
        assert again == pytest.approx(value, abs=1e-11 * size)


@pytest.mark.slow
def test_quick_return() -> None:
    """Of a slotted lever, whose strokes end where it touches the circle of the crank pin; None without two strokes."""
    design = planar("quick-return", outputs=["lever", "slot", "crank"])
    back = 2.0 * math.acos(150.0 / 300.0)
    assert design.raw("lever.quick_return_ratio") == pytest.approx((2.0 * math.pi - back) / back, rel=1e-12)
    assert design.raw("slot.quick_return_ratio") == pytest.approx(1.0, rel=1e-12)  # along the line of both axes
    assert design.raw("crank.quick_return_ratio") is None
    swept = planar("quick-return", outputs=["lever"], range={"start": 0, "end": 40})
    assert swept.raw("lever.quick_return_ratio") is None
    assert planar("planet", outputs=["guide"]).raw("guide.quick_return_ratio") is None  # six strokes


def test_quick_return_of_four_bar() -> None:
    """By the triangles of both dead centres, in which crank and coupler are in line."""
    frame = math.hypot(120.0, 15.0)
    far, near = (
        math.acos((reach * reach + frame * frame - 78.0 * 78.0) / (2.0 * reach * frame)) for reach in (96 + 32, 96 - 32)
    )
    away = math.pi + near - far
    expected = max(away, 2.0 * math.pi - away) / min(away, 2.0 * math.pi - away)
    assert planar("four-bar").raw("rocker.quick_return_ratio") == pytest.approx(expected, rel=1e-12)


@pytest.mark.slow
def test_lengths_of_paths() -> None:
    """Of the circle of a crank pin, of an arc that a rocker goes to and fro, of a coupler curve by quadrature."""
    design = planar("four-bar", outputs=["B", "C", "P", "rocker"])
    assert design.raw("B.path_length") == pytest.approx(2.0 * math.pi * 32.0, rel=1e-13)
    assert design.raw("C.path_length") == pytest.approx(2.0 * 78.0 * design.raw("rocker.swing"), rel=1e-12)

    node, weight = np.polynomial.legendre.leggauss(20)  # on 16 stretches: 1e-13 of the whole
    places = math.pi / 16.0 * (np.arange(16)[:, None] * 2.0 + 1.0 + node)
    speed = np.abs(design.moving.at(places.ravel(), 1).links["coupler"].at("P").first).reshape(places.shape)
    assert design.raw("P.path_length") == pytest.approx(math.pi / 16.0 * float((speed @ weight).sum()), rel=1e-9)


@pytest.mark.slow
def test_dead_centres_of_a_driven_rocker_are_the_ends_of_its_swing() -> None:
    swing = planar("four-bar")
    file = {**FOUR_BAR, "drive": {"link": "rocker"}, "range": {"start": -1, "end": 1}, "outputs": ["crank"]}
    file["start"] = {**FOUR_BAR["start"], "rocker": 113.0}
    from gearlink.core.machines.planar.spec import PlanarSpec

    design = PlanarMechanism(PlanarSpec.model_validate({"kind": "planar-mechanism", **file}))
    low, high = (math.degrees(each) for each in design.raw("free_range"))
    assert low + 113.0 == pytest.approx(math.degrees(swing.raw("rocker.angle_min")), abs=1e-8)
    assert high + 113.0 == pytest.approx(math.degrees(swing.raw("rocker.angle_max")), abs=1e-8)


@pytest.mark.slow
def test_a_cylinder_jams_where_rod_and_lever_are_in_line() -> None:
    """|A - E| = 140 + 90 and 140 - 90, E on the line through (-200, -10) at 4 deg, less the start at 20 mm."""
    low, high = planar("cylinder").raw("free_range")
    way = complex(math.cos(math.radians(4.0)), math.sin(math.radians(4.0)))
    for found, distance in ((low, 230.0), (high, 50.0)):
        assert abs(complex(-200.0, -10.0) + (20.0 + found) * way) == pytest.approx(distance, abs=1e-8)


@pytest.mark.slow
def test_the_assembly_is_never_changed() -> None:
    """A rocker that nearly stretches, by some hundredths of a degree: the dyad keeps its side."""
    design = planar("four-bar", links={**FOUR_BAR["links"], "rocker": ["D", "C", 56.935]})
    assert design.raw("min_transmission_angle") < math.radians(3.0)
    q = np.linspace(0.0, design.course.end, 5000)
    (dyad,) = design.course.dyads
    angle = dyad.angle(design.course.jets(q, 0), 0)
    assert (np.sign(angle) == np.sign(angle[0])).all()


def test_rough_starts_choose_the_nearer_closing() -> None:
    """Both closings of the coupler's dyad by rough starts on either side, mirrored at the line B-D."""
    one, other = planar("four-bar"), planar("four-bar", start={"crank": 20, "coupler": -40, "rocker": -100})
    x1, t1 = one.course.at_start.closed
    _, t2 = other.course.at_start.closed
    b = complex(x1[2]) * one.structure.size
    line = np.angle(complex(120, 15) - b)
    assert t2[2] == pytest.approx(2.0 * line - t1[2], abs=1e-12)


def test_the_grashof_sorts() -> None:
    assert planar("four-bar").grashof == ["A B C D: crank-rocker"]
    assert planar("quick-return").grashof is None


@pytest.mark.parametrize(
    ("change", "key", "words"),
    [
        ({"drive": {"link": "crank", "with": {"rocker": 1.0}}}, "links", "more than it can take"),
        ({"links": {**FOUR_BAR["links"], "extra": ["P", "Z", 10]}, "start": {**FOUR_BAR["start"], "extra": 0}}, "drive",
         "2 degrees of freedom and 1 drive"),
        ({"links": {**FOUR_BAR["links"], "rocker": ["D", "C", 1]}}, "start", "do not close"),
        ({"links": {**FOUR_BAR["links"], "rocker": ["D", "C", 30]}}, "range", "dead centre"),
    ],
)  # fmt: skip
def test_refusals(change: dict[str, Any], key: str, words: str, monkeypatch: pytest.MonkeyPatch) -> None:
    if not ALL:
        monkeypatch.setattr(course, "_TRIES", 2)  # of links that no start closes
    with pytest.raises(NoSolution, match=words) as refusal:
        planar("four-bar", **change).require("analyze")
    assert refusal.value.key == key


@pytest.mark.quick(1)
@pytest.mark.parametrize("length", [30.0, 45.0, 52.7])
def test_the_range_between_dead_centres_is_free_as_it_is_printed(length: float) -> None:
    links = {**FOUR_BAR["links"], "rocker": ["D", "C", length]}
    with pytest.raises(NoSolution, match="dead centre") as refusal:
        planar("four-bar", links=links).require("analyze")
    low, high = map(float, re.findall(r"range.start to (\S+) and range.end to (\S+) deg", refusal.value.fix)[0])
    planar("four-bar", links=links, range={"start": low, "end": high}).require("analyze")
    for wrong in spread([{"start": low - 0.01, "end": high}, {"start": low, "end": high + 0.01}], 1):
        with pytest.raises(NoSolution, match="set range"):
            planar("four-bar", links=links, range=wrong).require("analyze")


def test_three_parallel_cranks_name_the_joints_that_repeat_each_other() -> None:
    from gearlink.core.machines.planar.spec import PlanarSpec

    spec = PlanarSpec.model_validate(
        {
            "kind": "planar-mechanism",
            "frame": {"A": [0, 0], "D": [100, 0], "F": [50, 0]},
            "links": {"crank": ["A", "B", 40], "coupler": {"B": [0, 0], "C": [100, 0], "E": [50, 0]},
                      "rocker": ["D", "C", 40], "third": ["F", "E", 40]},
            "drive": {"link": "crank"},
            "start": {"crank": 60, "coupler": 0, "rocker": 60, "third": 60},
        }
    )  # fmt: skip
    with pytest.raises(NoSolution) as refusal:
        PlanarMechanism(spec).require("analyze")
    assert all(f"{joint}," in str(refusal.value) for joint in "ADFBC")
    assert refusal.value.key == "links"


def test_a_rough_start_far_off_is_told() -> None:
    (found,) = planar("four-bar", start={**FOUR_BAR["start"], "coupler": 120}).check("assembly")
    assert found.status == "warn"
    assert found.value == pytest.approx(120.0 - 52.0353, abs=1e-3)
    assert planar("four-bar").check("assembly") == []


@pytest.mark.slow
def test_the_limit_of_the_transmission_angle_is_judged() -> None:
    assert [each.status for each in planar("watt").check("transmission-angle")] == ["warn"]
    strict = planar("watt", limits={**WATT["limits"], "transmission_angle": 12})
    assert [each.status for each in strict.check("transmission-angle")] == ["fail"]


def test_poles_are_where_a_link_stands_still() -> None:
    """A point of each link at its pole has no velocity; the Watt coupler's pole is where crank and rocker meet."""
    design_ = planar("watt")
    table = design_.table("poles", samples=7)
    links = design_.moving.at(np.radians(np.asarray(table.data[0])), 1).links
    for name, link in links.items():
        pole = np.asarray(table[f"{name}_pole_x"]) + 1j * np.asarray(table[f"{name}_pole_y"])
        arm = pole - link.origin.value
        assert np.abs(link.origin.first + 1j * link.turn.first * arm).max() < 1e-9
    b, c = links["coupler"].at("B").value, links["coupler"].at("C").value
    pole = np.asarray(table["coupler_pole_x"]) + 1j * np.asarray(table["coupler_pole_y"])
    assert np.abs(((pole - b) * np.conj(b)).imag / np.abs(b)).max() < 1e-6  # on the line of the crank
    assert np.abs(((pole - c) * np.conj(c - 110.0)).imag / 90.0).max() < 1e-6


def test_a_differential_of_two_drives() -> None:
    """Willis: with sun and ring driven the arm runs at (z_s w_s + z_r w_r)/(z_s + z_r), all home after 8 turns."""
    made_ = design(
        "analyze", kind="planar-mechanism", name="differential", frame={"A": [0, 0]},
        links={"sun": {"A": [0, 0]}, "arm": ["A", "B", 50], "planet": {"B": [0, 0]}, "ring": {"A": [0, 0]}},
        meshes={"sp": {"gears": ["sun", "planet"], "at": ["A", "B"], "teeth": [20, 20]},
                "pr": {"gears": ["planet", "ring"], "at": ["B", "A"], "teeth": [20, -60]}},
        drive={"link": "sun", "with": {"ring": 0.5}}, outputs=["arm", "planet"],
    )  # fmt: skip
    arm = (20.0 + 60.0 * 0.5) / 80.0
    assert made_.raw("arm.speed_ratio_max") == pytest.approx(arm, rel=1e-14)
    assert made_.raw("planet.speed_ratio_min") == pytest.approx(arm - (1.0 - arm), rel=1e-13)
    assert (made_.raw("period_turns"), made_.raw("arm.turns")) == (8, 5.0)


@pytest.mark.slow
def test_a_certain_step_leads_where_many_small_ones_do() -> None:
    """From every tenth certified place to the next, in one step and in thirty: the same to rounding."""
    course = planar("watt").course
    follower, rows = course.walk.follower, course.walk.rows
    count = len(course.walk.start)
    for here, there in zip(rows[::10], rows[1::10], strict=False):
        u = tuple(here[1 : 1 + count])
        for q in np.linspace(here[0], there[0], 31)[1:]:
            u = follower.closed(float(q), u)
        assert np.array(u) == pytest.approx(there[1 : 1 + count], abs=1e-12)


@pytest.mark.slow
def test_certified_steps_never_reach_beyond_a_dead_centre() -> None:
    """Of a driven rocker: each reach ends before the dead centre that its linkage has in closed form."""
    design_ = planar("cylinder", range={"start": -49.7, "end": 130.3})
    low, high = design_.raw("free_range")
    for q, *_ in design_.course.walk.rows:
        place = design_.course.walk.follower.place(float(q), tuple(design_.course.walk.tangents(np.array([q]))[0]))
        assert place is not None
        assert low < (q - place.reach) * design_.structure.size
        assert (q + place.reach) * design_.structure.size < high


def test_a_motion_of_too_many_steps_is_refused_as_such(monkeypatch: pytest.MonkeyPatch) -> None:
    """The bed chain takes 320; a module of 4000 mm would take 30 times as many, and a minute."""
    monkeypatch.setattr(follow, "_MOST_STEPS", 100)
    with pytest.raises(NoSolution, match="too fast to be computed: 100 steps") as caught:
        load(DESIGNS / "planar_bed_chain.yaml").raw("closure_error")
    assert caught.value.key == "meshes"
