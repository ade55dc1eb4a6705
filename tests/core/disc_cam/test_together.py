"""Designs of disc cams whose searches run together have what each finds by itself; sizes are kept in samples."""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.many_designs import Unlike, column, hand_in, hand_out, in_groups, stacked, together
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec_paths import unit_at
from gearlink.core.numerics.extremes import maximum_over
from gearlink.core.studies.explore.base import Base
from gearlink.core.studies.study.faults import WrongStudy
from gearlink.core.studies.tolerance_study.problem import problem
from gearlink.core.studies.tolerance_study.samples import evaluated

MOTION = [
    {"to": 80, "lift": 12, "law": "modified-sine"},
    {"to": 150},
    {"to": 240, "lift": 0, "law": "polynomial-4567"},
    {"to": 360},
]
ROLLER = {"type": "translating-roller", "roller_radius": 12, "offset": 5, "mass": 2}
ROCKER = {"type": "oscillating-roller", "roller_radius": 15, "arm": 100, "center_distance": 140, "inertia": 0.04}
SPRING = {"least_force": 40, "rate": 6}
FILES: dict[str, dict[str, Any]] = {
    "spring": {
        "follower": ROLLER, "cam": {"prime_radius": 60, "shaft_radius": 20, "cutter_radius": 5}, "spring": SPRING,
    },
    "edge": {
        "follower": {"type": "translating-knife-edge", "offset": 5, "mass": 2},
        "cam": {"base_radius": 60, "shaft_radius": 20, "cutter_radius": 5}, "spring": SPRING,
    },
    "rocking edge": {
        "follower": {"type": "oscillating-knife-edge", "arm": 100, "center_distance": 140, "inertia": 0.04},
        "cam": {"base_radius": 80, "sense": -1}, "spring": {"preload": 12, "rate": 20},
    },
    "groove": {"follower": ROLLER, "cam": {"prime_radius": 60}, "closure": "groove"},
    "conjugate": {
        "follower": ROLLER, "cam": {"prime_radius": 60}, "closure": "conjugate", "return_roller": {"radius": 11},
    },
    "flat": {
        "follower": {"type": "translating-flat", "face": [60, 60], "mass": 2}, "cam": {"base_radius": 60},
        "spring": {"preload": 100, "rate": 6},
    },
    "rocker": {"follower": ROCKER, "cam": {"prime_radius": 80, "sense": -1}, "spring": {"preload": 12, "rate": 20}},
    "rockers": {
        "follower": ROCKER, "cam": {"prime_radius": 80}, "closure": "conjugate",
        "return_roller": {"radius": 14, "arm": 95, "angle": 90},
    },
    "rocking face": {
        "follower": {"type": "oscillating-flat", "center_distance": 120, "face_offset": 6, "inertia": 0.04},
        "cam": {"base_radius": 50}, "spring": {"preload": 12, "rate": 20},
    },
}  # fmt: skip
CHANGES = {
    "follower.roller_radius": 0.3, "follower.offset": 1.0, "follower.mass": 0.1, "follower.arm": 1.0,
    "follower.center_distance": 1.0, "follower.inertia": 0.002, "follower.face_offset": 0.3, "cam.prime_radius": 1.0,
    "cam.base_radius": 1.0, "spring.rate": 0.2, "errors.profile": 0.001, "return_roller.radius": 0.3,
    "return_roller.arm": 0.3, "cam.shaft_radius": 0.5, "cam.cutter_radius": 0.1,
    "errors.run_out": 0.001, "errors.key": 0.002, "errors.roller_radius": 0.001, "spring.preload": 1.0,
    "spring.least_force": 2.0,
}  # fmt: skip


def _file(name: str, **keys: Any) -> dict[str, Any]:
    errors: dict[str, Any] = {"profile": 0.01, "run_out": 0.02, "key": 0.03, "waves": 40}
    errors |= {} if "edge" in name else {"roller_radius": 0.005}
    whole = {"kind": "disc-cam", "name": "x", "speed": 150, "motion": MOTION, "errors": errors, "servo": {"rows": 73}}
    return whole | FILES[name] | keys


def _value(data: Any, path: str) -> Any:
    for key in path.split("."):
        data = data.get(key) if isinstance(data, dict) else None
    return data


def _rows(data: dict[str, Any], count: int) -> list[list[tuple[str, float]]]:
    random_numbers = random.Random(3)
    known = [(path, float(_value(data, path)), by) for path, by in CHANGES.items() if _value(data, path) is not None]
    return [[(path, value + random_numbers.uniform(-by, by)) for path, value, by in known] for _ in range(count)]


def _same(name: str, count: int) -> None:
    data = _file(name)
    base, rows = Base(data, "cam"), _rows(data, count)
    alone, many = [base.design(row) for row in rows], [base.design(row) for row in rows]
    names = [name for name in alone[0].outline("cam").quantities if alone[0].raw(name) is not None]
    type(many[0]).find_together(many, names)
    for one, other in zip(alone, many, strict=True):
        cam = other.cams.flat if data["follower"]["type"].endswith("flat") else other.cams.main
        assert "max_radius" in vars(cam), "found together"
        for each in names:
            assert other.raw(each) == pytest.approx(one.raw(each), rel=1e-12, abs=1e-12), each
        checks = [
            [(c.code, c.status) for check in d.outline("cam").checks for c in d.check(check)] for d in (one, other)
        ]
        assert checks[0] == checks[1]
    assert len({str(design.raw("max_radius")) for design in many}) == count


@pytest.mark.slow
@pytest.mark.parametrize("name", FILES)
def test_every_follower_and_closure_is_found_together_as_alone(name: str) -> None:
    _same(name, 24)


def test_one_that_does_not_exist_leaves_the_others_found_together() -> None:
    data = _file("rocker")
    base = Base(data, "cam")
    designs = [base.design([("cam.prime_radius", 80.0 + 0.1 * k)]) for k in range(15)]
    alone = base.design([("cam.prime_radius", 80.3)]).raw("max_radius")
    designs.append(base.design([("cam.prime_radius", 250.0)]))  # makes no triangle
    type(designs[0]).find_together(designs, ["max_radius"])
    assert ["max_radius" in vars(design.cams.main) for design in designs[:8]] == [True] * 8
    assert designs[3].raw("max_radius") == pytest.approx(alone, rel=1e-12)
    with pytest.raises(NoSolution, match=r"prime_radius: 250 mm \(limit < 240 mm"):
        designs[-1].raw("max_radius")


def test_samples_of_a_sized_cam_keep_the_nominal_size_and_preload() -> None:
    section = {"sources": {"follower.roller_radius": {"plus_minus": 0.5}, "spring.rate": {"plus_minus": 0.5}}}
    data = _file("spring", cam={"size": {"pressure_angle": 25}}, tolerance=section)
    made = problem(factory.design(data).spec)
    nominal = factory.design(data)
    assert made.base.data["cam"] == {"size": None, "prime_radius": nominal.prime_radius}
    assert made.base.data["limits"] == {"pressure_angle": 25}
    assert made.base.data["spring"] == {"rate": 6, "least_force": None, "preload": nominal.spring_preload}
    columns = {"follower.roller_radius": np.array([11.5, 12.5]), "spring.rate": np.array([5.5, 6.5])}
    found = evaluated(made, columns).quantities
    assert found["prime_radius"].tolist() == [nominal.prime_radius] * 2
    assert found["base_radius"].tolist() == pytest.approx(
        [nominal.prime_radius - 11.5, nominal.prime_radius - 12.5], rel=1e-12
    )


def test_rows_of_a_function_are_sought_as_each_alone() -> None:
    shift = np.array([0.3, 1.0, 5.9])

    def rows(x: Any, shifts: Any = shift[:, None]) -> Any:
        return np.cos(x - shifts) + 0.3 * np.sin(3.0 * x)

    found = maximum_over(rows, samples=128)
    for k, each in enumerate(shift):
        alone = maximum_over(lambda x, each=each: rows(x, each), samples=128)
        assert np.ravel(found.value)[k] == pytest.approx(alone.value, rel=1e-15)
        assert np.ravel(found.place)[k] == pytest.approx(alone.place, abs=1e-12)


def test_what_differs_by_words_stands_in_no_column() -> None:
    one, other = (
        factory.design(_file("groove", motion=motion)).spec
        for motion in (MOTION, [*MOTION[:2], {"to": 360, "lift": 0}])
    )
    with pytest.raises(Unlike):
        together([one, other])
    with pytest.raises(Unlike):
        column([1.0, None])
    thicker = factory.design(_file("groove", cam={"prime_radius": 61})).spec
    assert together([one, thicker]).cam.prime_radius.tolist() == [[60.0], [61.0]]
    with pytest.raises(Unlike):
        together([one, thicker], ("prime_radius",))


@dataclass(frozen=True)
class Part:
    size: Any
    inner: Any = None
    pair: Any = (1.0, 2.0)


def test_dataclasses_of_numbers_are_stacked() -> None:
    one, other = Part(1.0, Part(2.0), (1.0, 2.0j)), Part(1.0, Part(3.0), (1.0, 4.0 + 0j))
    many = stacked([one, other])
    assert (many.size, many.inner.size.tolist(), many.pair[0]) == (1.0, [[2.0], [3.0]], 1.0)
    assert many.pair[1].tolist() == [[2.0j], [4.0 + 0j]]
    assert stacked([one, other], inner="known", pair=()).inner == "known"
    for unlike in (Part(1.0, None), Part(1.0, Part("x")), Part(1.0, Part(2.0), (1.0,))):
        with pytest.raises(Unlike):
            stacked([one, unlike])


def test_results_are_handed_in_as_columns() -> None:
    class Holder:
        def __init__(self, number: float) -> None:
            self.number = number

        @cached_property
        def value(self) -> Any:
            return self.number, {"twice": 2.0 * self.number}["twice"]

    many = Holder(0.0)
    hand_in(many, [Holder(1.0), Holder(2.0)], "value")
    assert [each.tolist() for each in many.value] == [[[1.0], [2.0]], [[2.0], [4.0]]]


def test_designs_are_grouped_in_their_order() -> None:
    assert in_groups([3, 1, 4, 1, 5], lambda each: each % 2) == [[3, 1, 1, 5], [4]]


def test_results_are_handed_out_row_by_row() -> None:
    class Holder:
        @cached_property
        def value(self) -> Any:
            return np.array([[1.0], [2.0]]), 7.0, None

    owners = [Holder(), Holder()]
    hand_out(Holder(), owners, "value")
    assert [owner.value for owner in owners] == [(1.0, 7.0, None), (2.0, 7.0, None)]


def test_the_lift_of_a_rocker_has_no_class_and_that_of_a_slide_has() -> None:
    """Its width is that of a length."""
    section = {"sources": {"motion[0].lift": {"class": "js7"}}}
    with pytest.raises(WrongStudy, match=r"motion\[0\].lift is in deg"):
        _ = problem(factory.design(_file("rocker", tolerance=section)).spec).sources
    (source,) = problem(factory.design(_file("groove", tolerance=section)).spec).sources
    assert source.law.upper == pytest.approx(0.009, rel=1e-12)  # js7 of 12 mm
    assert [unit_at(factory.design(_file(name)).spec, "spring.rate") for name in ("flat", "rocker")] == [
        "N/mm",
        "N m/rad",
    ]


def test_a_requirement_of_a_size_is_no_source_and_what_was_found_is_named() -> None:
    section = {"sources": {"cam.size.pressure_angle": {"plus_minus": 1}}}
    data = _file("spring", cam={"size": {"pressure_angle": 25}}, tolerance=section)
    with pytest.raises(WrongStudy, match=r"name one of spring\.preload, cam\.prime_radius"):
        _ = problem(factory.design(data).spec).sources
