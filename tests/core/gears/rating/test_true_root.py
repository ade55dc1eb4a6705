"""The root on its generated fillet: stress in closed form, equilibrium, a reference, the fillet of a shaped ring.

Tolerances: polynomial stress on 24 panels a half 1e-7; forces and moments 1e-12; the reference within 2 %, since its
contour of the rim is another one; panels half as long 1 %, of the ring of 56 teeth; curvature by differences 1e-3.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from factory import design
from hypothesis import given
from hypothesis import strategies as st

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.mesh.ring_cutter import ShapedRing
from gearlink.core.parts.gears.rating import true_root
from gearlink.core.parts.gears.rating.true_root import HalfContour, RootContour, TrueRoot, panels
from gearlink.core.parts.gears.tooth.tools import PinionCutter

PAIR: dict[str, Any] = {
    "kind": "gear-pair",
    "module": 4,
    "teeth": [23, 71],
    "profile_shift": [0.25, 0.1],
    "face_width": 40,
    "tool": {"addendum": 1.25, "rounding": 0.38},
    "load": {"torque": 220.0, "speed": 480.0, "factors": {"application": 1.25}},
    "rating": {"life": 20000, "material": "42CrMo4", "grade": 6, "lubricant": {"vg": 220}},
}
RINGS: dict[str, dict[str, Any]] = {
    "56": {
        "module": 45,
        "teeth": [17, -56],
        "center_distance": 863,
        "profile_shift": [0.8021, -0.5013],
        "face_width": 491,
        "tip_diameter": [905.470, 2475.118],
        "cutter": {"teeth": 36, "rounding": 0.3, "addendum": 1.3134},
    },
    "93": {
        "module": 21,
        "teeth": [36, -93],
        "center_distance": 584,
        "profile_shift": [0.5039, 0.1171],
        "face_width": 550,
        "tip_diameter": [815.663, 1906.081],
        "cutter": {"teeth": 30, "rounding": 0.3, "addendum": 1.2517},
    },
}


def made(**keys: Any) -> Any:
    return design(PAIR | keys, command="gear")


def smooth(kind: str) -> HalfContour:
    """The right half of a closed curve, from below to above."""

    def curve(t: Any) -> Any:
        if kind == "ellipse":
            return 1.3 * np.cos(t) + 0.8j * np.sin(t)
        bulge = 1.0 + 0.25 * np.cos(2.0 * t) if kind == "peanut" else 1.0 - 0.15 * np.sin(3.0 * t)
        return bulge * np.exp(1j * t)

    return HalfContour(panels(curve, np.linspace(-0.5 * math.pi, 0.5 * math.pi, 25)))


@pytest.mark.parametrize("kind", ["ellipse", "peanut", "trefoil"])
def test_polynomial_stress_is_found_again(kind: str) -> None:
    """phi and psi are chosen: f = phi + z conj phi' + conj psi, and sigma_t + sigma_n = 4 Re phi'."""
    half = smooth(kind)

    def loads(z: Any) -> Any:
        slope = 0.3 + 0.2 * z + 0.6j * z**2
        return 0.3 * z + 0.1 * z**2 + 0.2j * z**3 + z * slope.conj() + (0.5 * z**2 - 1j * z).conj()

    here, there = loads(half.points), loads(-half.points.conj())
    mirrored, other = half.solved(0.5 * (here - there.conj()), 0.5 * (here + there.conj()))
    every = range(len(half.points))
    found = half.stress_sums(1.0, mirrored, every) + half.stress_sums(-1.0, other, every)
    expected = 4.0 * (0.3 + 0.2 * half.points + 0.6j * half.points**2).real
    assert np.allclose(found, expected, rtol=0.0, atol=1e-7)


@pytest.mark.parametrize("gear", [0, 1])
def test_the_load_is_balanced_at_the_far_side(gear: int) -> None:
    data = made(**RINGS["56"]).data
    root = data.true_roots[gear]
    right, left = root._forces
    points = root._pieces[0].points
    assert abs((right + left).sum()) < 1e-12
    turn = (points.conj() * right).imag.sum() + ((-points.conj()).conj() * left).imag.sum()
    assert abs(turn) < 1e-12 * np.abs(points).max()
    load = right[root._panels("load")]
    around = (points[root._panels("load")].conj() * load).imag.sum()
    reference = 0.5 * root.contour.teeth
    assert abs(around) == pytest.approx(reference, rel=1e-5), "F_t = 1 N/mm on the reference circle"


def test_the_contour_is_closed_and_counter_clockwise() -> None:
    for pair in (made(), made(**RINGS["56"]), made(helix_angle=20.0, teeth=[9, 71], profile_shift=[0.5, 0.0])):
        data = pair.data
        for gear in (0, 1):
            root = data.true_roots[gear]
            pieces = root.contour.pieces(root.load_radius)
            ends = [curve(np.array([breaks[0], breaks[-1]])) for _, curve, breaks in pieces]
            for (_, end), (start, _) in pairwise(ends):
                assert abs(start - end) < 1e-12 * root.contour.teeth
            assert abs(ends[0][0].real) + abs(ends[-1][1].real) < 1e-12 * root.contour.teeth
            half = root._pieces[0]
            assert (half.points.conj() * half.steps).imag.sum() > 0.0


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("keys", "gear", "reference"),
    [({}, 0, 2.49669), ({}, 1, 2.53467), (RINGS["56"], 1, 2.644), (RINGS["93"], 1, 2.443)],
)
def test_the_factor_of_another_program(keys: dict[str, Any], gear: int, reference: float) -> None:
    one = made(**keys)
    assert one.raw("generated_root_factor")[gear] == pytest.approx(reference, rel=0.02)
    section = one.data.root.sections[gear]
    assert (
        0.75 < one.raw("generated_root_factor")[gear] / (section.form_factor * section.stress_correction_factor) < 1.0
    )


@pytest.mark.slow
@pytest.mark.parametrize("name", RINGS)
def test_shorter_panels_change_little(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    coarse = made(**RINGS[name]).data.true_roots[1].tension.factor
    for places in ("_FILLET", "_LAND", "_FLANK"):
        given_places = getattr(true_root, places)
        halves = sorted({*given_places, *(0.5 * (a + b) for a, b in pairwise(given_places))})
        monkeypatch.setattr(true_root, places, tuple(halves))
    assert made(**RINGS[name]).data.true_roots[1].tension.factor == pytest.approx(coarse, rel=0.01)


def test_the_integral_comes_with_its_table_alone_and_with_all_factors() -> None:
    one = made()
    assert "generated_root_factor" not in {each.name for each in one.report("gear").quantities}
    assert "true_roots" not in vars(one.data)
    report = one.report("gear", tables=("root",))
    assert {"generated_root_factor", "generated_root_stress"} <= {each.name for each in report.quantities}
    assert [check.status for check in report.checks if check.name == "true-fillet"] == ["pass", "pass"]
    stress = [
        factor * scale for factor, scale in zip(one.data.generated_root_factor, one.data.root_stress_scale, strict=True)
    ]
    assert one.raw("generated_root_stress") == pytest.approx(stress, rel=1e-12)
    section = one.data.root.sections[0]
    nominal = one.raw("root_stress")[0] / (section.form_factor * section.stress_correction_factor)
    assert one.data.root_stress_scale[0] == pytest.approx(nominal, rel=1e-12)
    (table,) = report.tables
    greatest = max(value for gear, value in zip(table.data[0], table.data[3], strict=True) if gear == "gear 1")
    assert greatest == pytest.approx(stress[0], rel=0.01)


def test_a_fillet_that_the_standard_misjudges_warns(monkeypatch: pytest.MonkeyPatch) -> None:
    one = made()
    factor = one.data.root.sections[0].form_factor * one.data.root.sections[0].stress_correction_factor
    for share, status in ((0.76, "pass"), (0.74, "warn"), (1.24, "pass"), (1.26, "warn")):
        monkeypatch.setattr(type(one.data), "generated_root_factor", (share * factor, None))
        assert [check.status for check in one.check("true-fillet")] == [status]


def test_the_thickness_of_the_rim_changes_it_within_what_is_said() -> None:
    usual, thinner = (made(**keys).data.true_roots[0].tension.factor for keys in ({}, {"rim_thickness": 12.0}))
    assert 0.005 < abs(thinner / usual - 1.0) < 0.04


def test_a_ring_without_its_cutter_has_no_generated_root() -> None:
    keys = {key: value for key, value in RINGS["93"].items() if key != "cutter"}
    first, second = made(**keys).raw("generated_root_factor")
    assert first is not None
    assert second is None


@pytest.mark.parametrize("tip", [1906.081, 1960.0])
def test_the_contour_of_a_ring_ends_at_its_tips(tip: float) -> None:
    """Also where they lie outside of the reference circle of 1953 mm: they were as far within it."""
    data = made(**RINGS["93"] | {"tip_diameter": [815.663, tip]}).data
    contour = RootContour.of(data.pair, 1, data.cut_shift[1], None)
    assert contour is not None
    assert 2.0 * 21.0 * contour.tip == pytest.approx(tip, rel=1e-14)


def test_a_pointed_tooth_has_none() -> None:
    pair = made(teeth=[12, 71], profile_shift=[0.9, 0.0], tip_shortening="none").data.pair
    assert RootContour.of(pair, 0, pair.profile_shift[0], None) is None


# The fillet of a shaped ring


def curvature(ring: ShapedRing, turn: float, step: float = 1e-4) -> tuple[float, float]:
    """Radius of the fillet, and the angle of its tangent with the middle of the tooth, by differences."""
    before, at, after = (ring.fillet(turn + k * step) for k in (-1.0, 0.0, 1.0))
    rate, bent = (after - before) / (2.0 * step), (after - 2.0 * at + before) / step**2
    radius = abs(rate) ** 3 / abs((bent * rate.conjugate()).imag)
    ahead = rate * complex(math.cos(math.pi / ring.teeth), math.sin(math.pi / ring.teeth))
    return radius, math.degrees(math.atan2(abs(ahead.imag), abs(ahead.real)))


@given(st.integers(12, 40), st.integers(20, 90), st.floats(-0.6, 0.4), st.floats(0.1, 0.35), st.floats(-0.2, 0.3))
def test_the_fillet_radius_is_that_of_the_points_of_the_fillet(
    cutter: int, more: int, shift: float, rounding: float, ground: float
) -> None:
    try:
        ring = ShapedRing(
            module=1.0,
            teeth=-cutter - more,
            shift=shift,
            cutter=PinionCutter(teeth=cutter, shift=ground, addendum=1.25, rounding=rounding),
            pressure_angle=math.radians(20.0),
        )
    except NoSolution:
        return
    radius = ring.fillet_radius
    if radius is None:
        return
    assert radius > rounding, "a hollow is nowhere sharper than the tip that cuts it"
    low, high = ring.turns
    for _ in range(40):  # the angle of the tangent falls from root to flank
        middle = 0.5 * (low + high)
        low, high = (middle, high) if curvature(ring, middle)[1] > 60.0 else (low, middle)
    assert curvature(ring, low)[0] == pytest.approx(radius, rel=1e-3)


def test_a_helical_ring_is_judged_on_its_virtual_gear() -> None:
    keys = {"teeth": [20, -71], "profile_shift": [0.3, -0.1], "cutter": {"teeth": 25, "rounding": 0.25}}
    spur, slight = (made(helix_angle=angle, **keys).raw("root_fillet_radius")[1] for angle in (0.0, 0.01))
    assert slight == pytest.approx(spur, rel=1e-5)
    one = made(helix_angle=15.0, **keys)
    assert one.raw("root_fillet_radius")[1] > 0.25 * one.spec.module


@pytest.mark.parametrize("helix", [0.0, 15.0])
def test_a_ring_is_rated_as_it_is_cut_to_the_upper_allowance(helix: float) -> None:
    """A cutter that goes deeper leaves the root of a ring of that shift: section, fillet and contour."""
    keys: dict[str, Any] = {"teeth": [20, -71], "cutter": {"teeth": 25, "rounding": 0.2}, "helix_angle": helix}
    upper = -0.2
    shift = -0.1 + upper / (2.0 * 4.0 * math.tan(math.radians(20.0)))
    thinner = made(**keys, profile_shift=[0.3, -0.1], allowances={"upper": [0.0, upper], "lower": [-0.1, -0.3]})
    cut = made(**keys, profile_shift=[0.3, shift])
    for quantity in ("root_fillet_radius", "root_chord"):
        assert thinner.raw(quantity)[1] == pytest.approx(cut.raw(quantity)[1], rel=1e-12)
    one, other = (RootContour.of(of.data.pair, 1, of.data.cut_shift[1], None) for of in (thinner, cut))
    assert one is not None
    assert other is not None
    assert (one.root, one.form, one.at_base) == pytest.approx((other.root, other.form, other.at_base), rel=1e-12)
    nominal = made(**keys, profile_shift=[0.3, -0.1])
    assert thinner.raw("root_fillet_radius")[1] != pytest.approx(nominal.raw("root_fillet_radius")[1], rel=1e-3)


def test_the_standard_s_reading_is_named_beside() -> None:
    one = made(**RINGS["56"])
    assert "ISO 6336-3:2007 with |z_n| gives 22.24 mm, root stress 17 % lower" in one.rests_on("root_fillet_radius")
    iso = made(**RINGS["56"], rating=PAIR["rating"] | {"ring_root": "iso"})
    assert iso.raw("root_fillet_radius")[1] == pytest.approx(22.243, abs=1e-3)
    assert "the shaped ring itself is 13.57 mm" in iso.rests_on("root_fillet_radius")


def test_the_tooth_beside_a_gap_is_cut_down_and_loaded_at_its_tip() -> None:
    gears = {"module": 3, "full_teeth": 80, "group_teeth": 20, "driven": 20}
    wheel = design({"kind": "mutilated-gear-dwell", "gears": gears, "reduction": 6}, command="gear")
    ending, driven = wheel.generated_roots
    assert ending.contour.tip * 3 < wheel.raw("tip_radius")[0]
    assert ending.load_radius == ending.contour.tip
    assert wheel.raw("generated_root_factor") == [ending.tension.factor, driven.tension.factor]
    low = TrueRoot(ending.contour, 0.5 * (ending.contour.form + ending.contour.tip), ending.pressure_angle)
    assert low.tension.factor < ending.tension.factor
    (found,) = wheel.check("true-fillet")
    assert found.code == "GL219"
    assert "rated only by the boundary integral" in found.note[0]
