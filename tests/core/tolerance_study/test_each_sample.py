"""Every check of every sample: what `tolerance` counts is what the same machine gets by itself.

A sample is drawn, its sizes are put into the completed file, and that file is computed anew by its class, as `check`
does: nothing is shared with the study, neither a search nor an array form. Widths and limits are such that each study
has checks that hold for some samples and fail for others. Deviations that no key of a file can say are left at zero
here; centre distances, which are no keys either, are compared with gear pairs of that distance.
"""

from __future__ import annotations

import copy
from typing import Any, NamedTuple

import factory
import numpy as np
import pytest
from pydantic import ValidationError
from sweeps import mostly_slow

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.kinds import KINDS
from gearlink.core.base.spec_paths import put
from gearlink.core.machines.three_gear.register import over_sorted
from gearlink.core.studies.tolerance.sampling import SEEN
from gearlink.core.studies.tolerance_study import samples
from gearlink.core.studies.tolerance_study.samples import judged

SAMPLES = 8


class Study(NamedTuple):
    """An example, how far its sizes scatter to either side, changed keys, and codes that must mix."""

    design: str
    widths: dict[str, float]
    mixed: set[str]
    keys: dict[str, Any] = {}
    command: str | None = None


STUDIES = {
    "window of given links": Study("standing_feed", {"links.crank": 0.5, "links.frame": 0.5}, {"GL301", "GL313"}),
    "window of a synthesis by margin": Study(
        "ring_feed", {"links.crank": 1.0, "links.frame": 1.0}, {"GL303"}, {"limits__transmission_angle": 42.7}
    ),
    "window in a play": Study(
        "candy_feed",
        {"links.crank": 0.6, "links.frame": 0.6},
        {"GL313", "GL303"},
        {
            "dwell": None,
            "links": {"crank": 38.942, "frame": 153.53},
            "dwell_backlash": 14.3,
            "dwell_window": 178,
            "limits": {"transmission_angle": 61.5},
        },
    ),
    "teeth of a drive alone": Study(
        "drawn_feed", {"gears.profile_shift[0]": 0.5}, {"GL203"}, {"limits": {"contact_ratio": 1.5}}
    ),
    "two gears": Study("two_gear_standing", {"links.coupler": 8, "links.frame": 8}, {"GL303"}),
    "rocker": Study("wide_lever", {"links.frame": 8}, {"GL303"}, {"limits__transmission_angle": 50.8}),
    "crank-rocker": Study(
        "crank_rocker_links", {"links.crank": 8, "links.frame": 8}, {"GL303"}, {"limits__transmission_angle": 46.5}
    ),
    "crank": Study("ty460_slider_crank", {"stroke": 60, "rod": 150, "offset": 60}, set()),
    "reducer": Study("cycloidal_reducer", {"pin_radius": 30, "pin_circle_radius": 20}, {"GL201"}),
    "cam gear": Study("cam_gear", {"lever.length": 8}, {"GL401"}, {"limits__pressure_angle": 43.7}),
    "cam linkage": Study("cam_linkage", {"links.coupler": 2}, {"GL401"}, {"limits__pressure_angle": 41.5}),
    "linked cams": Study("linked_cams", {"cams.y.base_radius": 5}, {"GL401"}, {"limits__pressure_angle": 20.0}),
    "geneva": Study("geneva_drive", {"center_distance": 8, "locking_radius": 20}, {"GL344"}),
    "drum": Study("barrel_cam", {"cam.radius": 2.0}, {"GL401"}, {"limits__pressure_angle": 26.5}),
    "disc cam": Study("loaded_cam", {"cam.prime_radius": 2.0}, {"GL401"}, {"limits__pressure_angle": 25.95}, "cam"),
    "measured cam": Study("loaded_measured_cam", {"follower.offset": 2.0}, {"GL401"}, {"limits__pressure_angle": 23.1}),
    "pair by shifts": Study(
        "gear_pair", {"profile_shift[0]": 0.5, "profile_shift[1]": 0.5}, {"GL203"}, {"limits__contact_ratio": 2.1}
    ),
    "pair by its distance": Study("ty460_input_gears", {"center_distance": 2.0}, {"GL205", "GL208"}),
    "ring pair": Study("ring_pair", {"profile_shift[0]": 0.8}, {"GL201", "GL204", "GL207"}),
    "mutilated": Study(
        "mutilated_gear_press", {"links.crank": 6, "links.rocker": 20}, {"GL303"}, {"limits__transmission_angle": 53.13}
    ),
    "hypocycloid": Study("hypocycloid_slider", {"rod.length": 20}, {"GL311"}),
    "teeth of a drive": Study("drawn_feed", {"links.crank": 6, "gears.profile_shift[0]": 0.3}, {"GL302"}),
    "five-bar": Study("five_bar_path", {"links.input": 6, "links.coupler": 6, "phase": 20}, {"GL303"}),
    "function": Study(
        "five_bar_function_tolerances", {"phase": 0.02}, {"GL307"}, {"target__function__tolerance": 0.0006}
    ),
    "six-bar": Study("geared_six_bar", {"links.output": 8, "links.frame": 8}, {"GL303"}),
    "press": Study("ty460", {"bed.rod": 60, "bed.stroke": 20}, {"GL401", "GL502"}),
    "press and cams": Study(
        "ty460", {"cam.base_radius": 6, "cam.roller_radius": 4}, {"GL401"}, {"limits__pressure_angle": 13.03}, "analyze"
    ),
    "gripper": Study(
        "swing_gripper", {"links.input": 2, "pivots.output[0]": 2}, {"GL303"}, {"limits__transmission_angle": 69.7}
    ),
    "gripper's cams alone": Study(
        "swing_gripper",
        {"cam.roller.arm": 12, "cam.return_roller.arm": 12},
        {"GL401"},
        {"limits__pressure_angle": 27.55},
    ),
    "slider of a wide swing": Study(
        "wide_swing_slider", {"slider.crank": 20, "slider.rod": 30}, {"GL303"}, {"limits__transmission_angle": 70.5}
    ),
    "wide swing": Study("wide_swing_twin_cam", {"unloader.pivot_ratio": 0.2, "cam.roller_radius": 3}, {"GL504"}),
    "planar mechanism": Study(
        "planar_watt", {"links.arm[2]": 4, "frame.D[0]": 1}, {"GL303"}, {"limits__transmission_angle": 11.2}
    ),
    "machine": Study(
        "sheet_feeder", {"members.forwarder.phase": 12, "members.lays.design.cam.prime_radius": 1}, {"GL530"}
    ),
}


def alone(made: Any, sizes: dict[str, float]) -> dict[str, bool] | None:
    """Whether each code holds for the completed file with other sizes; None where there is no such machine."""
    data = copy.deepcopy(made.base.data)
    for key, value in sizes.items():
        put(data, key, value)
    kind, held = KINDS[data["kind"]], dict[str, bool]()
    try:
        design = kind.design(made.base.command, kind.spec_model().model_validate(data))
        design.advises = False  # the verdict is asked for, not what would help
        checks = [check for name in design.outline(made.base.command).checks for check in design.check(name)]
    except (ValidationError, NoSolution):
        return None
    for check in checks:
        held[check.code] = held.get(check.code, True) and check.status != "fail"
    return held


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", mostly_slow(list(STUDIES), 10))
def test_a_sample_passes_what_it_passes_by_itself(name: str) -> None:
    study = STUDIES[name]
    sources = {key: {"plus_minus": width, "law": "uniform"} for key, width in study.widths.items()}
    section = {"sources": sources, "samples": 16} | ({"command": study.command} if study.command else {})
    made = factory.design(study.design, command="tolerance", tolerance=section, **study.keys).problem
    costly = made.nominal.kind == "planar-mechanism"  # by its class
    count = SAMPLES * (5 if made.is_quick and not costly else 1)
    points = np.random.default_rng(3).random((count, made.coordinates))
    found, sizes = judged(made, points), made.sizes(points)
    seen: dict[str, list[bool]] = {}
    for i in range(count):
        held = alone(made, {key: float(column[i]) for key, column in sizes.items()})
        assert bool(found.exists[i]) == (held is not None)
        counted = {code: bool(mask[i]) for code, mask in found.passes.items()}
        # a code that says nothing of this machine fails none; one without any finding has no row
        assert counted == dict.fromkeys(counted, held is not None) | (held or {})
        for code, passed in (held or {}).items():
            seen.setdefault(code, []).append(passed)
    assert {code for code, row in seen.items() if len(set(row)) == 2} >= study.mixed


def test_every_kind_and_every_way_to_judge_many_is_tried() -> None:
    tried = {factory.worked(study.design)["kind"] for study in STUDIES.values()}
    assert tried == {name for name, kind in KINDS.items() if "tolerance" in kind.commands}


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("name", "source", "left"),
    [
        ("belt_feed", "links.frame", {"GL314": "dwell-edge evaluates the search for dwell,"}),
        (
            "two_gear_standing",
            "links.frame",
            {"GL314": "for dwell,", "gear": "tolerance.command"},
        ),
        (
            "wide_lever",
            "links.frame",
            {"GL307": "target evaluates the search for target,", "gear": "tolerance.command"},
        ),
        ("loaded_feed", "links.crank", {"loads": "samples carry no loads"}),
        ("slider_crank_tolerances", "rod", {"analyze": "tolerance.command"}),
        ("geneva_drive", "center_distance", {}),
    ],
)
def test_what_no_sample_is_judged_by_has_no_row_and_a_reason(name: str, source: str, left: dict[str, str]) -> None:
    section = {"sources": {source: {"plus_minus": 0.01}}, "samples": 16}
    made = factory.design(name, command="tolerance", tolerance=section)
    table, rows = made.table("not_sampled"), set(made.table("requirements").data[0])
    found = dict(zip(*table.data, strict=True))
    assert found.keys() == left.keys()
    assert all(words in found[code] for code, words in left.items())
    assert not rows & found.keys()
    assert ("not_sampled" in made.outline("tolerance").tables) == bool(left)
    nominal = made.problem.nominal
    judged_too = {
        check.code for each in nominal.outline(made.problem.base.command).checks for check in nominal.check(each)
    }
    assert rows == judged_too


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("name", "widths"), [("standing_feed", {"links.crank": 0.5}), ("ring_pair", {"profile_shift[0]": 0.8})]
)
def test_blocks_change_no_verdict(monkeypatch: pytest.MonkeyPatch, name: str, widths: dict[str, float]) -> None:
    """Also where a check says nothing of a whole block; 1e-9 are last bits that steps to a root may leave otherwise."""
    sources = {key: {"plus_minus": width, "law": "uniform"} for key, width in widths.items()}
    made = factory.design(name, command="tolerance", tolerance={"sources": sources, "samples": 16}).problem
    points = np.random.default_rng(4).random((40, made.coordinates))
    whole = judged(made, points)
    monkeypatch.setattr(samples, "_BLOCK", 7)
    monkeypatch.setattr(made.nominal, "at_once", 1)
    told: list[int] = []
    token = SEEN.set(told.append)
    try:
        parts = judged(made, points)
    finally:
        SEEN.reset(token)
    assert {code: mask.tolist() for code, mask in parts.passes.items()} == {
        code: mask.tolist() for code, mask in whole.passes.items()
    }
    assert (parts.good == whole.good).all()
    assert (parts.exists == whole.exists).all()
    for quantity, values in whole.quantities.items():
        np.testing.assert_allclose(parts.quantities[quantity], values, rtol=1e-9, atol=1e-9)
    assert sum(told) == 40
    assert len(told) > 4


DRIVES = {
    "external": {"module": 2, "crank": 40, "idler": 72, "output": 40},
    "ring": {"module": 1, "crank": 48, "idler": 36, "output": -118},
    "few teeth": {"module": 2, "crank": 18, "idler": 36, "output": 18},
    "ring whose tips reach too deep": {"module": 2, "crank": 24, "idler": 17, "output": -54},
}
LINKS = {
    "external": {"crank": 38.942, "frame": 153.53},
    "ring": {"crank": 23.539, "frame": 53.767},
    "few teeth": {"crank": 18.0, "frame": 75.0},
    "ring whose tips reach too deep": {"crank": 22.0, "frame": 46.0},
}
OF_DISTANCE = {"contact-ratio", "involute-interference", "root-clearance", "tip-fouling"}


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", DRIVES)
def test_teeth_of_a_drive_are_judged_at_the_distance_as_made(name: str) -> None:
    """Half a module to either side, against gear pairs of given shifts and tips at that distance."""
    gears = DRIVES[name]
    data = {"kind": "three-gear-four-bar", "name": name, "gears": gears, "links": LINKS[name]}
    data["limits"] = {"gear_gap": -50.0, "transmission_angle": 5.0}
    width = {"plus_minus": 0.5 * gears["module"], "law": "uniform"}
    sources = {"centers.crank_idler": width, "centers.idler_output": width}
    made = factory.design(data, command="tolerance", tolerance={"sources": sources, "samples": 16}).problem
    points = np.random.default_rng(5).random((24, 2))
    found, sizes = judged(made, points), made.sizes(points)
    wanted = [
        {
            code
            for teeth, key in (
                ((gears["crank"], gears["idler"]), "centers.crank_idler"),
                ((gears["idler"], gears["output"]), "centers.idler_output"),
            )
            for code in pair_fails(gears["module"], teeth, float(sizes[key][i]))
        }
        for i in range(24)
    ]
    assert found.exists.all()
    codes = {"GL203", "GL204", "GL205", "GL206"} & found.passes.keys()
    got = [{code for code in codes if not found.passes[code][i]} for i in range(24)]
    assert got == [row & codes for row in wanted]
    assert len({frozenset(row) for row in got}) > 1


def pair_fails(module: float, teeth: tuple[int, int], distance: float) -> set[str]:
    """Codes of what depends on the centre distance that fail on a pair of its own."""
    data = {
        "kind": "gear-pair",
        "module": module,
        "teeth": list(teeth),
        "profile_shift": [0.0, 0.0],
        "tip_shortening": [0.0, 0.0],
        "center_distance": distance,
    }
    pair = factory.design(data, command="gear")
    # the clearance at the roots of a ring by standard teeth is not judged by a drive
    names = OF_DISTANCE if teeth[1] > 0 else OF_DISTANCE - {"root-clearance"}
    return {check.code for name in names for check in pair.check(name) if check.status == "fail"}


def test_what_changes_few_times_is_looked_at_few_times() -> None:
    """The same as looking at each of 4,096 numbers."""
    values = np.random.default_rng(1).normal(size=4096)
    asked = []

    def state(value: float) -> frozenset[str]:
        asked.append(value)
        return frozenset(code for code, low in (("a", -1.0), ("b", 0.5), ("c", 9.0)) if value < low)

    found = over_sorted(state, values)
    assert len(asked) < 60
    got: list[frozenset[str]] = [frozenset()] * values.size
    for each, places in found:
        for place in places:
            got[place] = each
    assert got == [state(value) for value in values]
    assert sorted(int(place) for _, places in found for place in places) == list(range(values.size))


def test_a_single_machine_has_one_state() -> None:
    (state, places), *rest = over_sorted(lambda _: frozenset("x"), np.ones(1))
    assert (state, places.tolist()) == (frozenset("x"), [0])
    assert all(not more.size for _, more in rest)
