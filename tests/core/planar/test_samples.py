"""Planar mechanisms as manufactured: many at once against each by its class, the play of pins, studies of them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from oracles.planar_zoo import FOUR_BAR, QUICK_RETURN, ZOO, made
from sweeps import mostly_slow

from gearlink.cli.opening import design
from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.planar.course import contact_row
from gearlink.core.machines.planar.design import PlanarMechanism
from gearlink.core.machines.planar.samples import PlanarSamples
from gearlink.core.machines.planar.spec import PlanarSpec
from gearlink.core.machines.planar.system import Jets, System
from gearlink.core.studies.tolerance_study.problem import problem
from gearlink.core.studies.tolerance_study.samples import _one_by_one, design_of, evaluated


def planar(name: str, **more: Any) -> PlanarMechanism:
    return PlanarMechanism(made(name, **more))


def sources(file: dict[str, Any]) -> dict[str, Any]:
    """A size of every link, line and rack, and the play of the first pin."""
    found: dict[str, Any] = {}
    for name, link in file["links"].items():
        points = [] if isinstance(link, list) else [*link][1:]
        keys = [f"links.{name}[2]"] if isinstance(link, list) else [f"links.{name}.{point}[1]" for point in points]
        found |= {key: {"plus_minus": 0.05} for key in keys}
    for group in ("slides", "slots"):
        found |= {f"{group}.{name}.through[1]": {"plus_minus": 0.05} for name in file.get(group, {})}
        found |= {f"{group}.{name}.direction": {"plus_minus": 0.02} for name in file.get(group, {})}
    found |= {f"slides.{name}.angle": {"plus_minus": 0.03} for name, each in file.get("slides", {}).items()
              if each["link"] in file["links"] and "on" in each}  # fmt: skip
    for name, mesh in file.get("meshes", {}).items():
        if "rack" in mesh:
            found |= {f"meshes.{name}.{key}": {"plus_minus": 0.02} for key in ("direction", "module")}
    pin = PlanarSamples(
        PlanarMechanism(PlanarSpec.model_validate({"kind": "planar-mechanism", "name": "x", **file}))
    ).parts
    return found | {f"pins.{pin.pins[0]}": {"clearance": [0.01, 0.05]}}


def study(file: dict[str, Any], given: dict[str, Any]) -> Any:
    whole = {"kind": "planar-mechanism", "name": "x", **file, "tolerance": {"sources": given}}
    return problem(PlanarSpec.model_validate(whole))


GEARED = {
    "frame": {"A": [0, 0], "E": [50, 0]},
    "links": {"crank": ["A", "B", 20], "coupler": ["B", "C", 60], "follower": ["D", "C", 60], "output": ["E", "D", 20]},
    "meshes": {"pair": {"gears": ["crank", "output"], "at": ["A", "E"], "teeth": [20, 20], "module": 2.5}},
    "drive": {"link": "crank"},
    "start": {"crank": 0, "output": 90, "coupler": 95, "follower": 125},
    "outputs": ["C"],
}  # fmt: skip
SAMPLED = ZOO | {"geared": GEARED}


@pytest.mark.parametrize(
    "name",
    mostly_slow(["four-bar", "rack-on-link", "geared", "cylinder", "quick-return", "watt", "slide-on-lever"], 1),
)
def test_samples_at_once_are_those_of_the_class(name: str) -> None:
    """Every quantity within 1e-9 of its magnitude, and each verdict; places of flat extremes to 1e-6."""
    made_ = study(SAMPLED[name], sources(SAMPLED[name]))
    assert made_.is_quick
    columns = made_.sizes(np.random.default_rng(5).uniform(size=(2, made_.coordinates)))
    many = evaluated(made_, columns)
    few = _one_by_one(made_, columns, made_.names)
    assert len(made_.quick_names) >= 9
    for key in made_.quick_names:
        size = max(1.0, np.abs(few.quantities[key]).max())
        room = 1e-6 if key.endswith("_at") else 1e-9
        assert many.quantities[key] == pytest.approx(few.quantities[key], abs=room * size), key
    judged, one_by_one = (
        sorted((each.code, each.fails.tolist(), each.warns.tolist()) for each in found.findings)
        for found in (many, few)
    )
    assert judged == one_by_one


@pytest.mark.slow
@pytest.mark.parametrize(("name", "width"), [("watt", 0.8), ("rocking face", 2.0)])
def test_samples_far_from_nominal_run_beside_it_by_way_of_others(name: str, width: float) -> None:
    """Errors at which the theorem says nothing at once: what is certain by stages is what the class finds."""
    file = CAMS[name] if name in CAMS else ZOO[name]
    widths = {key: {"plus_minus": width} for key in sources(file) if key.startswith("links.")}
    widths |= {f"cams.{cam}.profile": {"plus_minus": 0.5 * width} for cam in file.get("cams", {})}
    made_ = study(file, widths)
    assert made_.axis is not None
    columns = made_.sizes(np.random.default_rng(2).uniform(size=(4, made_.coordinates)))
    at_once = [
        not made_.axis.run_beside({key: each[k : k + 1] for key, each in columns.items()}, 1)[0] for k in range(4)
    ]
    assert any(at_once), "some need a stage between"
    found = made_.axis.evaluate(columns, made_.quick_names)
    assert found.unsure is not None
    certain = ~found.unsure
    assert np.count_nonzero(certain & at_once) > 0
    few = _one_by_one(made_, {key: each[certain] for key, each in columns.items()}, made_.quick_names)
    for key in made_.quick_names:
        size = max(1.0, np.abs(few.quantities[key]).max())
        room = 1e-6 if key.endswith("_at") else 1e-9
        assert found.quantities[key][certain] == pytest.approx(few.quantities[key], abs=room * size), key


def test_samples_whose_gears_do_not_mesh_are_left_to_the_class() -> None:
    """A module of 2.7 mm sets the base circles of 20 and 20 teeth 50.7 mm apart, 0.7 mm farther than the centres."""
    made_ = study(GEARED, {"meshes.pair.module": {"plus_minus": 0.05}})
    assert made_.axis is not None
    found = made_.axis.evaluate({"meshes.pair.module": np.array([2.5, 2.7])}, ["C.path_length"])
    assert found.unsure is not None
    assert found.unsure.tolist() == [False, True]


def off_by(width: float, *keys: str, played: str = "") -> dict[str, Any]:
    return {key: {"plus_minus": width} for key in keys} | {f"pins.{pin}": {"clearance": [0.02, 0.06]} for pin in played}


SHAFTED = {**GEARED, "frame": {"A": [0, 0], "E": [50, 0], "F": [-40, 0]}, "shafts": {"F_radius": 6, "A_radius": 20}}
ROUND_SHAFTS = {
    **ZOO["planet"], "frame": {"A": [0, 0], "Z": [0.2, 0.1], "Y": [15, 5]}, "shafts": {"Y_radius": 2, "Z_radius": 3},
    "meshes": {"ring": {"gears": ["planet", "frame"], "at": ["B", "A"], "teeth": [20, -60], "module": 2}},
}  # fmt: skip
WITHIN_THE_RING = {
    **ROUND_SHAFTS, "links": {**ZOO["planet"]["links"], "wheel": {"B": [0, 0], "V": [5, 0]}},
    "meshes": {**ROUND_SHAFTS["meshes"], "pair": {"gears": ["rod", "wheel"], "at": ["P", "B"], "teeth": [10, 10]}},
    "start": {**ZOO["planet"]["start"], "wheel": 0},
}  # fmt: skip
ON_A_FOUR_BAR = {
    **FOUR_BAR, "shafts": {"A_radius": 3},
    "links": {**FOUR_BAR["links"], "one": {"A": [0, 0], "X": [5, 0]}, "two": {"D": [0, 0], "Y": [5, 0]}},
    "meshes": {"first": {"gears": ["coupler", "one"], "at": ["B", "A"], "teeth": [20, 12], "module": 2},
               "second": {"gears": ["coupler", "two"], "at": ["C", "D"], "teeth": [18, 60], "module": 2}},
    "start": {**FOUR_BAR["start"], "one": 0, "two": 0},
}  # fmt: skip
RACK_AND_SHAFTS = {**ZOO["rack-on-link"], "frame": {"A": [0, 0], "P": [100, 0], "Q": [150, 40]},
                   "shafts": {"A_radius": 5, "Q_radius": 4}}  # fmt: skip
BY_RACK = {
    "frame": {"A": [0, 0], "Q": [10, 70]}, "shafts": {"A_radius": 15, "Q_radius": 12},
    "links": {"crank": ["A", "B", 40], "rod": ["B", "F", 160], "ram": {"F": [0, 0]}, "pinion": {"F": [0, 0]}},
    "slides": {"guide": {"link": "ram", "through": [0, 8], "direction": 0}},
    "meshes": {"teeth": {"rack": "frame", "pinion": "pinion", "at": "F", "direction": 0, "side": 1, "teeth": 20,
                         "module": 2}},
    "drive": {"link": "crank"}, "start": {"crank": 0, "rod": 0, "guide": 200}, "outputs": ["guide", "pinion"],
}  # fmt: skip
TWINS = {  # two planets that run round alike, nominally at one distance
    "frame": {"A": [0, 0], "D": [90, 20]}, "drive": {"link": "crank", "with": {"other": 1}},
    "links": {"crank": ["A", "B", 30], "other": ["D", "E", 30], "first": {"B": [0, 0], "P": [9, 2]},
              "second": {"E": [0, 0], "Q": [9, 2]}},
    "meshes": {"one": {"gears": ["first", "frame"], "at": ["B", "A"], "teeth": [20, 12]},
               "two": {"gears": ["second", "frame"], "at": ["E", "D"], "teeth": [14, 18]}},
    "start": {"crank": 20, "other": 20, "first": 0, "second": 0}, "outputs": ["P"],
}  # fmt: skip
GAPS = {
    "shafted": (SHAFTED, off_by(0.02, "frame.F[0]", "frame.E[0]", "meshes.pair.module", "links.crank[2]")),
    "planet": (ROUND_SHAFTS, off_by(0.02, "links.carrier[2]", "frame.Y[1]", "meshes.ring.module", played="AB")),
    "ring": (WITHIN_THE_RING, off_by(0.02, "links.carrier[2]", "links.planet.P[0]", played="P")),
    "twins": (TWINS, off_by(0.02, "frame.D[1]", "links.crank[2]", "links.other[2]", played="E")),
    "four-bar": (ON_A_FOUR_BAR, off_by(0.02, "frame.D[0]", "links.crank[2]", "links.coupler.C[0]", played="ABC")),
    "rack": (RACK_AND_SHAFTS, off_by(0.05, "frame.Q[0]", "links.crank[2]", "frame.P[1]")),
    "pinion": (BY_RACK, off_by(0.05, "frame.Q[1]", "links.crank[2]", "meshes.teeth.module", played="F")),
}


def of_gaps(found: Any) -> list[Any]:
    return [each for each in found.findings if each.code in ("GL301", "GL302")]


@pytest.mark.parametrize("name", mostly_slow([*GAPS], 1))
def test_gaps_of_samples_at_once_are_those_of_the_class(name: str) -> None:
    """Between axes of the frame, of one link, of planets, and where the play of a pin moves what nominally stands
    still; they are of the places of an extreme, which count squared: 1e-9 mm of lengths up to 250 mm."""
    made_ = study(*GAPS[name])
    assert made_.is_quick
    assert made_.axis is not None
    columns = made_.sizes(np.random.default_rng(5).uniform(size=(2, made_.coordinates)))
    many = made_.axis.evaluate(columns, made_.quick_names)
    assert many.unsure is not None
    assert not many.unsure.any()
    found, wanted = of_gaps(many), of_gaps(_one_by_one(made_, columns, made_.names))
    assert len(found) == len(wanted) >= 3
    for own, other in zip(found, wanted, strict=True):
        assert own.value == pytest.approx(other.value, rel=0.0, abs=1e-9)
        assert own.limit == pytest.approx(other.limit, rel=0.0, abs=1e-12)
        assert (own.code, own.fails.tolist(), own.warns.tolist()) == (
            other.code, other.fails.tolist(), other.warns.tolist())  # fmt: skip


JUST_PASSED = (
    {**ROUND_SHAFTS, "shafts": {"Y_radius": 2.18}},
    off_by(0.05, "links.carrier[2]", "frame.Y[1]", "meshes.ring.module", played="A"),
)
JUST_SEATED = (  # root 0.5 * 20 * 2.5 - 1.25 * 2.5, less half of the height 1.125 * 2.5
    {**SHAFTED, "shafts": {"A_radius": 21.875 - 2.8125}},
    off_by(0.05, "meshes.pair.module", "frame.F[0]"),
)


@pytest.mark.slow
@pytest.mark.parametrize(("case", "verdict"), [(JUST_PASSED, "fails"), (JUST_SEATED, "warns")])
def test_gaps_cross_their_limit_within_the_samples(case: Any, verdict: str) -> None:
    """A shaft that the planet just passes, and one whose gear has just enough of a rim left round it."""
    made_ = study(*case)
    assert made_.is_quick
    columns = made_.sizes(np.random.default_rng(5).uniform(size=(8, made_.coordinates)))
    many, few = evaluated(made_, columns), _one_by_one(made_, columns, made_.names)
    judged, one_by_one = (sorted((each.code, each.fails.tolist(), each.warns.tolist()) for each in of_gaps(found))
                          for found in (many, few))  # fmt: skip
    assert judged == one_by_one
    assert any(0 < np.count_nonzero(getattr(each, verdict)) < 8 for each in of_gaps(many))


def test_the_play_of_the_carrier_takes_its_planet_to_and_fro() -> None:
    """The planet's centre runs on a circle about the pin that is off: from a place z it is at least r - |A + play - z|
    away. Nominally it stands still from A, and nearly from Z."""
    made_ = study(ROUND_SHAFTS, off_by(0.02, "links.carrier[2]", played="A"))
    assert made_.is_quick
    assert made_.axis is not None
    r, play = np.array([40.01, 39.99, 40.02]), np.array([0.03 + 0.01j, -0.02 + 0.03j, 0.0])
    found = made_.axis.evaluate({"links.carrier[2]": r, "pins.A": play}, ["guide.stroke"])
    assert found.unsure is not None
    assert not found.unsure.any()
    shafts = {0j: 0.0, 0.2 + 0.1j: 3.0, 15 + 5j: 2.0}
    wanted = [np.abs(r - np.abs(play - place)) - 22.0 - radius for place, radius in shafts.items()]
    rows = [each.value for each in of_gaps(found)]
    for one in wanted:
        assert min(float(np.abs(row - one).max()) for row in rows) < 1e-11


@pytest.mark.slow
def test_gaps_that_no_extreme_tells_are_left_to_the_class() -> None:
    """Points that lie on one another and may part, since gears of them are then on two axes; and a distance that the
    play of a pin alone moves, over a range."""
    file = {**ROUND_SHAFTS, "frame": {**ROUND_SHAFTS["frame"], "X": [15, 5]}}
    assert study(file, off_by(0.05, "frame.A[0]")).is_quick
    assert not study(file, off_by(0.05, "frame.Y[0]")).is_quick
    part = {**ROUND_SHAFTS, "frame": {"A": [0, 0], "Y": [15, 5]}, "shafts": {}, "range": {"start": 0, "end": 90}}
    assert study(part, off_by(0.05, "links.carrier[2]", "frame.A[0]")).is_quick
    assert not study(part, off_by(0.05, "links.carrier[2]", played="A")).is_quick


@pytest.mark.slow
def test_samples_next_to_a_dead_centre_are_left_to_the_class() -> None:
    """A rocker that stretches within some hundredths of a degree: errors of 0.05 mm may jam it."""
    file = {**FOUR_BAR, "links": {**FOUR_BAR["links"], "rocker": ["D", "C", 56.935]}}
    made_ = study(file, {"links.rocker[2]": {"plus_minus": 0.05}})
    assert made_.axis is not None
    found = made_.axis.evaluate({"links.rocker[2]": np.array([56.935, 56.90, 80.0])}, ["rocker.swing"])
    assert found.unsure is not None
    assert found.unsure.tolist() == [False, True, True]


@pytest.mark.slow
def test_the_closure_error_of_samples_is_that_of_all_that_was_sought() -> None:
    """Whichever quantity is asked for first; it is rounding of places up to 120 mm, and of many never all zero."""
    made_ = study(FOUR_BAR, {"links.crank[2]": {"plus_minus": 0.05}})
    assert made_.axis is not None
    columns = {"links.crank[2]": np.linspace(31.96, 32.04, 9)}
    names = ["closure_error", "rocker.swing"]
    found = [made_.axis.evaluate(columns, order).quantities["closure_error"] for order in (names, names[::-1])]
    assert found[0].tolist() == found[1].tolist()
    assert 0.0 < found[0].max() < 1e-11
    alone = made_.axis.evaluate(columns, names[:1]).quantities["closure_error"]
    assert 0.0 < alone.max() <= found[0].max()


@pytest.mark.slow
def test_the_course_of_samples_is_that_of_their_tables() -> None:
    made_ = study({**QUICK_RETURN, "outputs": ["lever"]}, {"links.crank[2]": {"plus_minus": 0.5}})
    assert made_.axis is not None
    columns, q = {"links.crank[2]": np.array([149.6, 150.2])}, np.array([0.0, 60.0, 240.0])
    off = np.degrees(made_.axis.course(columns, np.radians(q)))
    for k, crank in enumerate(columns["links.crank[2]"]):
        rows = [planar("quick-return", outputs=["lever"], links={**QUICK_RETURN["links"], "crank": ["A", "B", each]})
                .table("motion", samples=6)["lever_angle"] for each in (crank, 150.0)]  # fmt: skip
        wanted = (np.asarray(rows[0]) - np.asarray(rows[1]))[[0, 1, 4]]
        assert off[:, k] == pytest.approx(wanted, abs=1e-9)


LAW = [{"to": 120, "lift": 10, "law": "cycloidal"}, {"to": 150}, {"to": 270, "lift": 0, "law": "polynomial-345"},
       {"to": 360}]  # fmt: skip
SLIDING = {
    "frame": {"O": [0, 0]},
    "links": {"cam": {"O": [0, 0]}, "ram": {"B": [0, 0]}},
    "slides": {"guide": {"link": "ram", "through": [6, 0], "direction": 90}},
    "drive": {"link": "cam"}, "start": {"guide": 50}, "outputs": ["guide"],
}  # fmt: skip
ROCKING = {
    "frame": {"O": [0, 0], "A": [120, 10]},
    "links": {"cam": {"O": [0, 0]}, "lever": {"A": [0, 0], "F": [100, 10]}},
    "drive": {"link": "cam"}, "start": {"lever": 145}, "outputs": ["lever"],
}  # fmt: skip


def with_cam(file: dict[str, Any], **more: Any) -> dict[str, Any]:
    follower, point = ("ram", "B") if "slides" in file else ("lever", "F")
    return {**file, "cams": {"c": {"cam": "cam", "follower": follower, "point": point, "motion": LAW, **more}}}


CAMS = {
    "sliding roller": with_cam(SLIDING, roller_radius=9, sense=-1),
    "sliding face": with_cam(SLIDING, face=90),
    "rocking face": with_cam(ROCKING, face=4),
    "rocking roller": with_cam(ROCKING, roller_radius=12, phase=20),
}


def row_of(file: dict[str, Any]) -> tuple[PlanarMechanism, Any]:
    """A mechanism and the equation of its cam as cut, the only other row being those of the joints."""
    made_ = PlanarMechanism(PlanarSpec.model_validate({"kind": "planar-mechanism", "name": "x", **file}))
    cam = made_.structure.cams["c"]
    row = contact_row(cam, made_.structure, made_.course.at_start.lifts["c"], {})
    return made_, System(len(made_.structure.bodies), (), (row,))


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", CAMS)
def test_the_row_of_a_cam_as_cut_is_the_gap_to_its_profile(name: str) -> None:
    """Along any motion of cam and follower near the start: the roller's nearest point of a dense profile, the face's
    farthest one; Taylor coefficients against differences of that row alone."""
    made_, system = row_of(CAMS[name])
    cam, size = made_.structure.cams["c"], made_.structure.size
    x, t = (each[None] for each in made_.course.at_start.closed)
    rng = np.random.default_rng(7)
    dx, dt = (0.02 * rng.normal(size=(4, x.shape[1])) for _ in range(2))
    dx[:, 0] = dt[:, 0] = 0.0

    def jets(q: float) -> Jets:
        """x + sum dx_k q^k about q."""
        ways = np.concatenate([[x[0]], dx[1:] * (1 + 0.5j)]), np.concatenate([[t[0]], dt[1:]])
        parts = [
            [sum(math.comb(n, k) * way[n] * q ** (n - k) for n in range(k, 4))[None] for k in range(4)] for way in ways
        ]
        return Jets(parts[0], parts[1])

    here = jets(0.3)
    turn = np.exp(1j * here.t[0][0])
    profile, touching = cam.shapes(made_.course.at_start.lifts["c"].phase)
    body, other = made_.structure.numbers["cam"], cam.follower
    phi = np.linspace(0.0, 2.0 * math.pi, 200_001)
    outline = (
        cam.bore
        + np.exp(1j * cam.sense * made_.course.at_start.lifts["c"].phase)
        * (cam.profile.points(phi)[0 if cam.given.face is not None else 1])
    )
    there = here.x[0][0] * size
    points = there[body] + outline * turn[body]
    if cam.given.face is None:
        gap = np.abs(points - (there[other] + cam.point * turn[other])).min() - cam.given.roller_radius
    else:
        normal = cam.face_normal / cam.ahead * turn[other]
        gap = -(np.conj(normal) * (points - (there[other] + cam.point * turn[other]))).real.max()
    assert system.values(here, 0, np.zeros(1))[0, 0] * size == pytest.approx(gap, abs=1e-6)
    assert profile.size > 700
    assert touching.size > 1
    h = 1e-3
    for k in range(1, 4):
        beside = [system.values(jets(0.3 + way * h), k - 1, np.zeros(1))[0, 0] for way in (-2, -1, 1, 2)]
        slope = (beside[0] - 8.0 * beside[1] + 8.0 * beside[2] - beside[3]) / (12.0 * h) / k
        assert system.values(here, k, np.zeros(1))[0, 0] == pytest.approx(slope, abs=2e-8), k


@pytest.mark.slow
@pytest.mark.parametrize("name", CAMS)
def test_samples_of_a_cam_at_once_are_those_of_the_class(name: str) -> None:
    file = CAMS[name]
    key = "slides.guide.through[0]" if "slides" in file else "frame.A[0]"
    more = "cams.c.phase" if "slides" in file else "links.lever.F[1]"
    given = {each: {"plus_minus": 0.05} for each in (key, more, "cams.c.profile")}
    if "roller_radius" in file["cams"]["c"]:
        given["cams.c.roller_radius"] = {"plus_minus": 0.02}
    made_ = study(file, given | {"pins.O": {"clearance": [0.01, 0.05]}})
    assert made_.is_quick
    columns = made_.sizes(np.random.default_rng(5).uniform(size=(2, made_.coordinates)))
    many = evaluated(made_, columns)
    few = _one_by_one(made_, columns, made_.names)
    assert len(made_.quick_names) >= 7
    for name_ in made_.quick_names:
        size = max(1.0, np.abs(few.quantities[name_]).max())
        assert many.quantities[name_] == pytest.approx(few.quantities[name_], rel=0.0, abs=1e-9 * size), name_
    assert {one.code for one in many.findings} == {one.code for one in few.findings}


@pytest.mark.slow
def test_a_lever_as_made_dwells_on_the_arcs_of_the_profile() -> None:
    """By the law of cosines: its roller, larger, on arcs of the nominal cam that are farther out."""
    given = ("links.lever.F[0]", "frame.A[0]", "cams.c.profile", "cams.c.roller_radius")
    made_ = study(CAMS["rocking roller"], {each: {"plus_minus": 0.5} for each in given})
    values = dict(zip(given, (100.21, 119.7, 0.13, 12.05), strict=True))
    assert made_.axis is not None
    names = ["lever.angle_max", "lever.angle_min"]
    found = made_.axis.evaluate({key: np.array([value]) for key, value in values.items()}, names).quantities
    radii = np.abs(made_.nominal.structure.cams["c"].profile.points(np.linspace(0.0, 2.0 * math.pi, 720_001))[1])
    pivot, arm = 119.7 + 10j, 100.21 + 10j
    angles = []
    for reach in (radii.max() + 12.05 + 0.13, radii.min() + 12.05 + 0.13):
        cosine = (abs(pivot) ** 2 + abs(arm) ** 2 - reach**2) / (2.0 * abs(pivot) * abs(arm))
        angles.append(np.angle(-pivot / abs(pivot) * np.exp(-1j * math.acos(cosine)) / arm) % (2.0 * math.pi))
    want = sorted(np.degrees(angles))
    assert [found[name][0] for name in reversed(names)] == pytest.approx(want, rel=0.0, abs=1e-6)


def test_what_is_no_size_of_a_cam_is_refused() -> None:
    """The lift of a law: the profile is cut by it."""
    with pytest.raises(NoSolution) as refused:
        _ = study(CAMS["sliding face"], {"cams.c.motion[0].lift": {"plus_minus": 0.05}}).is_quick
    assert refused.value.key == "tolerance.sources"


@pytest.mark.slow
@pytest.mark.parametrize("pin", ["B", "C"])
def test_the_play_of_a_pin_is_that_of_a_pivot_beyond_it(pin: str) -> None:
    """A hole of the coupler off the crank's pin, in the frame, moves the crank's circle as its pivot would; one of the
    rocker off the coupler's pin moves the rocker's pivot back."""
    off = 0.3 - 0.2j
    played = PlanarSamples(planar("four-bar")).design({f"pins.{pin}": off})
    a, d = (off, 120 + 15j) if pin == "B" else (0j, 120 + 15j - off)
    frame = {"A": [a.real, a.imag], "D": [d.real, d.imag]}
    moved = planar("four-bar", frame=frame)
    for name in ("rocker.angle_max", "rocker.speed_ratio_max", "rocker.jerk_ratio_min", "min_transmission_angle"):
        assert played.raw(name) == pytest.approx(moved.raw(name), rel=1e-10), name


@pytest.mark.slow
def test_samples_follow_the_keys_of_the_file_and_the_play() -> None:
    """A yield of the four-bar with a require line on its own output, twice the same."""
    tolerance = {
        "seed": 3,
        "samples": 16,
        "sources": {"links.crank[2]": {"plus_minus": 0.05}, "pins.C": {"clearance": [0.01, 0.03]}},
        "require": ["rocker.swing <= 48.5 deg"],
    }
    made_ = design("tolerance", kind="planar-mechanism", name="four", **ZOO["four-bar"], tolerance=tolerance)
    assert 0.0 < made_.raw("yield") < 1.0
    table = made_.table("contributions")
    assert {*table["source"]} == {"links.crank[2]", "pins.C"}


@pytest.mark.slow
def test_the_course_of_a_slide_is_that_of_each_design() -> None:
    """A ram on a cam whose roller is larger: its place against the table of the single design."""
    made_ = study(CAMS["sliding roller"], {"cams.c.roller_radius": {"plus_minus": 0.5}})
    assert made_.axis is not None
    off = made_.axis.course({"cams.c.roller_radius": np.array([9.3])}, np.radians([0.0, 60.0, 200.0]))
    single = design_of(made_, {"cams.c.roller_radius": 9.3}).table("motion", samples=36)["guide_position"]
    nominal = made_.nominal.table("motion", samples=36)["guide_position"]
    want = (np.asarray(single) - np.asarray(nominal))[[0, 6, 20]]
    assert off[:, 0] == pytest.approx(want, rel=0.0, abs=1e-9)


@pytest.mark.slow
def test_the_band_is_that_of_the_first_output() -> None:
    """Links that may be longer alone: the rocker's band over the cycle, with its nominal angle."""
    tolerance = {"seed": 3, "samples": 16, "sources": {"links.crank[2]": {"plus_minus": 0.05}}}
    made_ = design("tolerance", kind="planar-mechanism", name="four", **ZOO["four-bar"], tolerance=tolerance)
    table = made_.table("band")
    assert {*table["output"]} == {"rocker_angle"}
    nominal = planar("four-bar").table("motion", samples=120)
    assert np.asarray(table["nominal"]) == pytest.approx(np.asarray(nominal["rocker_angle"]), abs=1e-12)
