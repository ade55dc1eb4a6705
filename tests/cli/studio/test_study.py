"""Wishes and joints that are dragged, against the design itself."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from sweeps import ALL

from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.studio.numbers import Number, numbers
from gearlink.cli.studio.study import Grip, Look, Refused, Study, changes, moving, point_of, wished
from gearlink.cli.studio.text import with_value
from gearlink.core.base.errors import NoSolution

FEED = """# a feed
kind: three-gear-four-bar
gears: {module: 2, crank: 40, idler: 72, output: 40}
links: {crank: 38.857, frame: 153.552}   # measured
"""
DESIGNS = Path(__file__).parents[3] / "designs"
ROCKER = (DESIGNS / "crank_rocker_links.yaml").read_text(encoding="utf-8")


def _keys(text: str) -> dict[str, Number]:
    study = Study(text, "feed.yaml")
    return {number.name: number for number in numbers(study.loaded, study.kind.spec_model(), {})}


def _back_step(text: str) -> float:
    found = Study(text, "feed.yaml").design("analyze").quantity("back_step_angle")
    assert found is not None
    assert isinstance(found.value, float)
    return found.value


@pytest.mark.parametrize("target", [25.0, 12.0])
def test_a_wish_is_met(target: float) -> None:
    found = wished(FEED, "feed.yaml", "analyze", "back_step_angle", target, _keys(FEED)["links.crank"])
    assert _back_step(found.text) == pytest.approx(target, abs=5e-5 * target)  # what is printed as the wish
    assert found.result == pytest.approx(_back_step(found.text), abs=1e-12 * target)
    assert found.text.endswith("# measured\n")


def test_a_wish_is_refused_with_the_limit() -> None:
    """The limit is that of a sweep: over the frame the transmission angle is largest near where it stands."""
    key = _keys(FEED)["links.frame"]
    with pytest.raises(Refused, match=r"at most 61\.5") as refused:
        wished(FEED, "feed.yaml", "analyze", "min_transmission_angle", 75.0, key)
    told = float(str(refused.value).partition("at most ")[2].partition(",")[0])
    swept = []
    for frame in np.linspace(*key.range, 400 if ALL else 100):
        try:
            study = Study(with_value(FEED, key.path, float(frame)), "feed.yaml")
            swept.append(study.design("analyze").quantity("min_transmission_angle").value)  # type: ignore[union-attr]
        except (DesignFileError, NoSolution):
            continue
    assert told >= max(swept) - 0.05  # a step of the sweep is 0.4 mm, or 1.6 mm, which moves it by less
    assert told < 75.0


def _example(name: str) -> tuple[str, str]:
    path = DESIGNS / f"{name}.yaml"
    return path.read_text(encoding="utf-8"), str(path)


def _keys_of(text: str, file: str) -> dict[str, Number]:
    study = Study(text, file)
    return {number.name: number for number in numbers(study.loaded, study.kind.spec_model(), {})}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "command", "quantity", "target", "key"),
    [
        ("planar_watt", "analyze", "output.swing", 45.0, "links.crank[2]"),
        ("crank_rocker_links", "analyze", "rocker_swing", 70.0, "links.crank"),
        ("lift_cam", "cam", "max_radius", 80.0, "follower.roller_radius"),
    ],
)
def test_wishes_are_met_by_other_kinds(name: str, command: str, quantity: str, target: float, key: str) -> None:
    text, file = _example(name)
    found = wished(text, file, command, quantity, target, _keys_of(text, file)[key])
    reached = Study(found.text, file).design(command).quantity(quantity)
    assert reached is not None
    assert reached.value == pytest.approx(target, rel=5e-5)
    changed = {name: key.value for name, key in _keys_of(found.text, file).items()}
    before = {name: key.value for name, key in _keys_of(text, file).items()}
    assert {name for name, value in changed.items() if value != before[name]} == {key}


@pytest.mark.slow
def test_wishes_are_refused_with_the_limit_by_other_kinds() -> None:
    text, file = _example("crank_rocker_links")
    with pytest.raises(Refused, match=r"at most 97\.34\d*, with links\.crank 60$"):  # the end of the slider
        wished(text, file, "analyze", "rocker_swing", 200.0, _keys_of(text, file)["links.crank"])
    text, file = _example("loaded_cam")
    with pytest.raises(Refused, match=r"at least 25\.6\d*, with cam\.prime_radius 78\.8") as refused:
        wished(text, file, "cam", "max_pressure_angle", 4.0, _keys_of(text, file)["cam.prime_radius"])
    told = float(str(refused.value).partition("at least ")[2].partition(",")[0])
    for radius in (76.0, 80.0, 90.0):
        study = Study(with_value(text, ("cam", "prime_radius"), radius), file)
        assert study.design("cam").quantity("max_pressure_angle").value > told  # type: ignore[union-attr]


@pytest.mark.slow
def test_a_wish_that_takes_long_is_refused_with_the_nearest_of_what_was_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    """That of a planar mechanism had been refused without a number."""
    monkeypatch.setattr("gearlink.cli.studio.study._SECONDS", 1.0)
    text, file = _example("planar_watt")
    with pytest.raises(Refused, match=r"at most [\d.]+, with links\.crank\[2\] [\d.]+ of \d+ values tried in 1 s$"):
        wished(text, file, "analyze", "output.swing", 170.0, _keys_of(text, file)["links.crank[2]"])


def test_a_whole_number_is_chosen_among_whole_numbers() -> None:
    found = wished(FEED, "feed.yaml", "analyze", "mean_ratio", 2.0, _keys(FEED)["gears.output"])
    assert (found.value, found.result) == (20.0, pytest.approx(2.0, rel=1e-12))


@pytest.mark.quick(1)
@pytest.mark.parametrize("fraction", [0.1, 0.37])
def test_a_joint_follows_the_hand(fraction: float) -> None:
    keys = [key for key in _keys(FEED).values() if key.is_geometry]
    at = Study(FEED, "feed.yaml").scene(np.array([fraction]))
    which = ("marks", next(k for k, mark in enumerate(at.marks) if mark.text == "C"), 0)
    goal = point_of(at, which) + complex(2.0, -1.5)
    text = Grip(FEED, "feed.yaml", which, fraction, keys).to(goal)
    reached = point_of(Study(text, "feed.yaml").scene(np.array([fraction])), which)
    assert abs(reached - goal) < 0.02  # links on a grid of 0.01 mm
    assert [name for name, key in _keys(text).items() if key.value != _keys(FEED)[name].value] == [
        "links.crank",
        "links.frame",
    ]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "which", "fraction"),
    [("planar_watt", "C", 0.13), ("crank_rocker_links", "C", 0.13), ("loaded_cam", ("parts", 1, 1), 0.13)],
)
def test_joints_of_other_kinds_follow_the_hand(name: str, which: str | tuple[str, int, int], fraction: float) -> None:
    text, file = _example(name)
    keys = [key for key in _keys_of(text, file).values() if key.is_geometry]
    at = Study(text, file).scene(np.array([fraction]))
    if isinstance(which, str):
        which = ("marks", next(k for k, mark in enumerate(at.marks) if mark.text == which), 0)
    goal = point_of(at, which) + complex(1.0, -0.8)
    made = Grip(text, file, which, fraction, keys).to(goal)
    reached = point_of(Study(made, file).scene(np.array([fraction])), which)
    assert abs(reached - goal) < 0.15  # lengths and angles on the grid of what can be built
    before = {key.name: key.value for key in keys}
    changed = {name for name, key in _keys_of(made, file).items() if key.value != before.get(name, key.value)}
    assert changed
    locked = sorted(changed)[0]
    rest = [key for key in keys if key.name != locked]
    again = Grip(text, file, which, fraction, rest).to(goal)
    assert _keys_of(again, file)[locked].value == before[locked]


def test_a_hand_that_no_key_can_follow_moves_nothing() -> None:
    """The crank alone, pulled across its own direction: there is no step, and none is divided by."""
    text, file = _example("ty460_slider_crank")
    keys = [_keys_of(text, file)["stroke"]]
    at = Study(text, file).scene(np.array([0.25]))
    which = ("marks", next(k for k, mark in enumerate(at.marks) if mark.text == "E"), 0)
    grip = Grip(text, file, which, 0.25, keys)
    start = point_of(at, which)
    along = complex(*grip._slopes[:, 0])
    assert grip.to(start + 1j * along / abs(along)) == text


def test_the_keys_that_are_locked_stay() -> None:
    """With the crank alone the joint comes as near as that link allows: no other crank is nearer."""
    keys, fraction = [_keys(FEED)["links.crank"]], 0.2
    at = Study(FEED, "feed.yaml").scene(np.array([fraction]))
    which = ("marks", next(k for k, mark in enumerate(at.marks) if mark.text == "C"), 0)
    goal = point_of(at, which) + complex(0.0, 3.0)

    def miss(text: str) -> float:
        return abs(point_of(Study(text, "feed.yaml").scene(np.array([fraction])), which) - goal)

    text = Grip(FEED, "feed.yaml", which, fraction, keys).to(goal)
    crank = _keys(text)["links.crank"].value
    assert _keys(text)["links.frame"].value == 153.552
    for other in (crank - 0.2, crank + 0.2):
        assert miss(text) <= miss(with_value(FEED, ("links", "crank"), other)) + 1e-3
    with pytest.raises(Refused, match="locked"):
        Grip(FEED, "feed.yaml", which, fraction, [])


def test_a_joint_stops_where_the_mechanism_ends() -> None:
    keys = [key for key in _keys(FEED).values() if key.is_geometry]
    at = Study(FEED, "feed.yaml").scene(np.array([0.25]))
    which = ("marks", next(k for k, mark in enumerate(at.marks) if mark.text == "C"), 0)
    grip = Grip(FEED, "feed.yaml", which, 0.25, keys)
    text = grip.to(point_of(at, which) + 400.0)
    assert grip.stopped
    Study(text, "feed.yaml").results("analyze")


@pytest.mark.slow
def test_key_results_by_name_are_those_of_the_whole_command() -> None:
    for text in (FEED, ROCKER):
        study = Study(text, "x.yaml")
        for command in study.commands:
            found = study.results(command)
            again = Study(text, "x.yaml").results(command, [result.quantity.name for result in found])
            assert again == found


def test_what_is_made_beside_the_page() -> None:
    changed = with_value(FEED, ("links", "crank"), 39.5)
    assert "links.crank" in changes(FEED, changed, "feed.yaml")
    assert changes(FEED, FEED, "feed.yaml") == ""
    checks, film = moving(FEED, "feed.yaml", ["analyze"], 24, Look())
    assert [check.code for check in checks["analyze"]]
    data, reach = film
    again = moving(changed, "feed.yaml", ["analyze"], 24, Look(reach, 0.3))[1]
    assert (data["count"], again[1]) == (24, reach)
    now = Study(changed, "feed.yaml").scene(np.array([0.3]))
    shown = [mark["p"][2 * 7] for mark in again[0]["marks"]]  # 0.3 of 24 pictures lies in the seventh
    stage = [mark.point[0].real for mark in now.marks]
    assert np.corrcoef(shown, stage)[0, 1] == pytest.approx(1.0, abs=1e-6)  # hundredths of a pixel


@pytest.mark.quick(1)
@pytest.mark.parametrize("show", ["velocity,force", "centres,ghosts", "path:C"])
def test_what_is_shown_leaves_the_joints_that_are_dragged(show: str) -> None:
    """A joint has the same place among the parts of the mechanism, whatever stands before and behind it."""
    plain, data = (Study(FEED, "feed.yaml").film(8, Look(show=words))[0] for words in ("", show))
    assert "force" not in data["words"]  # the file has no loads
    assert {"A", "B", "C"} & set(data["points"])
    assert data["refused"] == ""
    first, after, marks = data["own"]
    assert [part["is"] for part in data["parts"][first:after]] == [part["is"] for part in plain["parts"]]
    assert [mark["text"] for mark in data["marks"][:marks]] == [mark["text"] for mark in plain["marks"]]
    assert len(data["parts"]) > after - first
    scene = Study(FEED, "feed.yaml").scene(np.array([0.2]), show)
    assert len(scene.parts) == after - first


def test_instants_that_fail_are_red_as_in_a_film() -> None:
    text = FEED + "limits: {transmission_angle: 65}\n"
    data = moving(text, "feed.yaml", ["analyze"], 24, Look())[1][0]
    assert any("GL303" in words for instant in data["faults"] for words in instant)
    assert 0 < sum(data["framed"]) < 24
    assert moving(FEED, "feed.yaml", ["analyze"], 24, Look())[1][0]["faults"] == []
