"""Gear pairs with profile shift, and the single gear's teeth.

Tolerances
* published (TY-460 report): cases of `gearlink verify`; here, ten digits of the working pressure angle.
* reference cases: 1e-13 relative. Measured: 1.3e-14, in the tip shortening of a centre distance rounded to a double,
  whose condition number is 2 a'/(a' - a) = 250.
* mpmath: 16 eps relative, times the condition number of the datum: a'/(a' - a) for what hangs on a' - a, and
  1/tan^2(alpha') for the pressure angle and what is built on it (see `condition`). Differences of two such
  quantities are held to that share of their larger term.
"""

import json
import math
import random
from pathlib import Path

import mpmath as mp
import pytest
from factory import design
from hypothesis import assume, given
from hypothesis import strategies as st
from sweeps import ALL, examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.mesh.pair import GearPair, no_involute_at_tip
from gearlink.core.parts.gears.tooth import teeth

EPS = 2.0**-52
ALPHA = math.radians(20.0)
REFERENCE = Path(__file__).parents[3] / "reference"
CONTRACT = json.loads((REFERENCE / "contract" / "gear.json").read_text())
PRESS = json.loads((REFERENCE / "flatbed_press.json").read_text())["gear_pair"]
LENGTHS = ("center_distance", "working_radius", "base_radius", "tip_radius", "root_radius", "tooth_thickness")


pytestmark = pytest.mark.usefixtures("forty_digits")


def both(value):
    return value if isinstance(value, tuple) else (value,)


def inv(angle):
    return mp.tan(angle) - angle


def truth(module, teeth, alpha, addendum, clearance, shift=None, distance=None):
    """The pair in 40 digits from the textbook's own formulas, the working pressure angle by bisection."""
    m, al, h, c = (mp.mpf(v) for v in (module, alpha, addendum, clearance))
    z = [mp.mpf(n) for n in teeth]
    total = sum(z)
    a = m * total / 2
    if distance is not None:
        aw = mp.mpf(distance)
        working = mp.acos(a * mp.cos(al) / aw)
        x_sum = total * (inv(working) - inv(al)) / (2 * mp.tan(al))
        x = [x_sum / 2, x_sum / 2]
    else:
        x = [mp.mpf(v) for v in shift]
        x_sum = x[0] + x[1]
        wanted = inv(al) + 2 * x_sum * mp.tan(al) / total
        low, high = mp.mpf(0), mp.pi / 2
        for _ in range(125):
            middle = (low + high) / 2
            low, high = (low, middle) if inv(middle) > wanted else (middle, high)
        working = low
        aw = a * mp.cos(al) / mp.cos(working)
    y = (aw - a) / m
    lost = x_sum - y
    r = [m * n / 2 for n in z]
    rb = [v * mp.cos(al) for v in r]
    ra = [r[i] + (h + x[i] - lost) * m for i in (0, 1)]
    rf = [r[i] - (h + c - x[i]) * m for i in (0, 1)]
    s = [m * (mp.pi / 2 + 2 * x[i] * mp.tan(al)) for i in (0, 1)]
    at = [mp.acos(rb[i] / ra[i]) for i in (0, 1)]
    sa = [ra[i] * (s[i] / r[i] - 2 * (inv(at[i]) - inv(al))) for i in (0, 1)]
    tip = [mp.sqrt(ra[i] ** 2 - rb[i] ** 2) for i in (0, 1)]
    line = aw * mp.sin(working)
    sliding = [1 - (z[i] / z[1 - i]) * tip[1 - i] / (line - tip[1 - i]) for i in (0, 1)]
    return {
        "working_pressure_angle": working,
        "center_distance": aw,
        "reference_center_distance": a,
        "shift_sum": x_sum,
        "center_distance_modification": y,
        "tip_shortening": lost,
        "contact_ratio": (tip[0] + tip[1] - line) / (mp.pi * m * mp.cos(al)),  # path over base pitch
        "profile_shift": x,
        "reference_radius": r,
        "base_radius": rb,
        "working_radius": [v / mp.cos(working) for v in rb],
        "tip_radius": ra,
        "root_radius": rf,
        "tooth_thickness": s,
        "tip_pressure_angle": at,
        "tip_thickness": sa,
        "min_shift_no_undercut": [h - n * mp.sin(al) ** 2 / 2 for n in z],
        "min_teeth_no_undercut": [(h - v) * 2 / mp.sin(al) ** 2 for v in x],
        "interference_margin": [line - tip[0], line - tip[1]],
        "specific_sliding": sliding,
    }


def build(spec):
    alpha = math.radians(spec.get("pressure_angle", 20.0))
    teeth = tuple(spec["teeth"])
    if "center_distance" in spec:
        return GearPair(
            module=spec["module"], teeth=teeth, given_distance=spec["center_distance"], pressure_angle=alpha
        )
    return GearPair.from_shift(spec["module"], teeth, tuple(spec["profile_shift"]), alpha)


@pytest.mark.parametrize("case", CONTRACT, ids=[c["id"] for c in CONTRACT])
def test_contract_cases(case):
    pair = build(case["spec"])
    for name, wanted in case["quantities"].items():
        value = both(getattr(pair, name))
        if name.endswith("angle"):
            value = tuple(math.degrees(v) for v in value)
        assert value == pytest.approx(both(wanted) if not isinstance(wanted, list) else wanted, rel=1e-13, abs=0.0), (
            name
        )


@pytest.mark.parametrize("case", PRESS)
def test_reference_cases(case):
    data, wanted = case["input"], case["expect"]
    m, teeth = float(data["m"]), (data["z1"], data["z2"])
    if "aw" in data:
        pair = GearPair(module=m, teeth=teeth, given_distance=data["aw"])
    else:
        pair = GearPair.from_shift(m, teeth, (float(data["x1"]), float(data["x2"])))
    per_gear = {name: (wanted["gear1"][name], wanted["gear2"][name]) for name in wanted["gear1"]}
    single = {name: value for name, value in wanted.items() if not name.startswith("gear")}
    for name, value in {**single, **per_gear}.items():
        got = both(getattr(pair, name))
        got = tuple(math.degrees(v) for v in got) if name.endswith("angle") else got
        assert got == pytest.approx(both(value), rel=1e-13, abs=0.0), name


def test_contact_ratios_of_the_thesis_gears():
    mesh = next(c for c in json.loads((REFERENCE / "gear_linkage.json").read_text())["cases"] if c["id"] == "mesh")
    for pair, eps in zip(mesh["inputs"]["pairs"], mesh["outputs"]["eps"], strict=True):
        assert GearPair.from_shift(2.0, tuple(pair)).contact_ratio == pytest.approx(eps, rel=1e-14, abs=0.0)
    assert GearPair.from_shift(2.0, (40, 72)).min_teeth_of(0) == pytest.approx(mesh["outputs"]["zmin"], rel=1e-15)


def test_press_report_table():
    pair = GearPair(module=4.0, teeth=(72, 72), given_distance=math.hypot(290.0, 13.0))
    assert pair.reference_center_distance == 288.0
    assert math.degrees(pair.working_pressure_angle) == pytest.approx(21.2076131545, abs=5e-11)
    assert pair.reference_radius == (144.0, 144.0)
    # the report prints r' = r = 144; gears of ratio 1 roll at half the centre distance
    assert pair.working_radius == pytest.approx((145.14561653732433,) * 2, rel=1e-15, abs=0.0)


def condition(pair, name):
    """Condition numbers of a quantity in the data, as the module's notes give them."""
    steep = 1.0 + 1.0 / math.tan(pair.working_pressure_angle) ** 2
    if pair.given_distance is None:
        return steep
    gap = abs(pair.given_distance - pair.reference_center_distance)
    close = pair.given_distance / gap if gap else 1.0
    if name in ("shift_sum", "profile_shift", "center_distance_modification"):
        return steep * close
    return steep * 2.0 * close if name == "tip_shortening" else steep


def scale(pair, name, true):
    """What a difference of large terms is measured by."""
    m = pair.module
    if name in ("interference_margin", "tip_thickness"):
        return max(pair.center_distance * math.tan(pair.working_pressure_angle), m)
    if name == "contact_ratio":
        return 1.0 + max(abs(math.tan(a)) for a in pair.tip_pressure_angle) * max(pair.teeth) / math.pi
    if name == "specific_sliding":
        line = pair.center_distance * math.sin(pair.working_pressure_angle)
        return max(1.0 + (1.0 + abs(s)) * line / abs(g) for s, g in zip(true, pair.interference_margin, strict=True))
    if name == "profile_shift":
        return 1.0 + sum(abs(float(x)) for x in true)
    if name == "min_shift_no_undercut":
        return 1.0 + max(pair.teeth)
    if name == "min_teeth_no_undercut":
        return 2.0 * scale(pair, "profile_shift", pair.profile_shift) / math.sin(pair.pressure_angle) ** 2
    return 0.0


def compare(pair, expected):
    for name, true in expected.items():
        if name == "specific_sliding" and min(pair.interference_margin) <= 0.0:
            continue
        values, wanted = both(getattr(pair, name)), true if isinstance(true, list) else [true]
        size = scale(pair, name, wanted)
        for value, exact in zip(values, wanted, strict=True):
            limit = 16.0 * EPS * condition(pair, name) * max(abs(float(exact)), size)
            assert abs(mp.mpf(value) - exact) <= limit, (name, value, exact)


def samples(count, seed):
    rng = random.Random(seed)
    while count:
        teeth = (rng.randint(6, 300), rng.randint(6, 300))
        shift = (rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0))
        alpha = math.radians(rng.choice([14.5, 20.0, 25.0, 30.0]))
        module = 10.0 ** rng.uniform(-6.0, 6.0)
        try:
            pair = GearPair.from_shift(module, teeth, shift, alpha)
            _ = pair.tip_pressure_angle
        except NoSolution:
            continue
        if pair.working_pressure_angle > 0.05:
            count -= 1
            yield pair


def test_from_shift_against_many_digits():
    for pair in samples(150 if ALL else 20, 3):
        compare(pair, truth(pair.module, pair.teeth, pair.pressure_angle, 1.0, 0.25, shift=pair.given_shift))


@pytest.mark.slow
def test_from_center_distance_against_many_digits():
    rng = random.Random(4)
    for source in samples(150 if ALL else 60, 5):
        # the reference distance m (z1 + z2)/2 is exact for these modules, so that a' - a is the datum's
        m = 2.0 ** rng.randint(-20, 20)
        distance = source.center_distance / source.module * m
        pair = GearPair(module=m, teeth=source.teeth, given_distance=distance, pressure_angle=source.pressure_angle)
        try:
            _ = pair.tip_pressure_angle
        except NoSolution:
            continue
        compare(pair, truth(m, pair.teeth, pair.pressure_angle, 1.0, 0.25, distance=distance))


@pytest.mark.parametrize("offset", [1e-13, -1e-13, 1e-9, 1e-6, -1e-3])
def test_close_to_the_reference_distance_nothing_cancels(offset):
    distance = 128.0 * (1.0 + offset)  # 128.0 is the reference distance, so that the difference is exact
    pair = GearPair(module=4.0, teeth=(24, 40), given_distance=distance)
    wanted = truth(4.0, (24, 40), ALPHA, 1.0, 0.25, distance=distance)
    for name in ("shift_sum", "center_distance_modification", "tip_shortening"):
        assert getattr(pair, name) == pytest.approx(float(wanted[name]), rel=8 * EPS, abs=0.0), name


def test_at_the_reference_distance_everything_is_exact():
    for pair in (GearPair(module=0.7, teeth=(17, 40), given_distance=0.7 * 57 / 2), GearPair.from_shift(0.7, (17, 40))):
        assert pair.working_pressure_angle == ALPHA
        assert pair.center_distance == pair.reference_center_distance
        assert (pair.shift_sum, pair.center_distance_modification, pair.tip_shortening) == (0.0, 0.0, 0.0)
        assert pair.profile_shift == (0.0, 0.0)


def test_split_of_the_shift_sum():
    equal = GearPair(module=3.0, teeth=(12, 24), given_distance=56.0)
    given_x1 = GearPair(module=3.0, teeth=(12, 24), given_distance=56.0, given_first_shift=0.5)
    assert equal.profile_shift[0] == equal.profile_shift[1] == equal.shift_sum / 2.0
    assert given_x1.profile_shift == (0.5, given_x1.shift_sum - 0.5)
    assert given_x1.shift_sum == equal.shift_sum


def test_tooth_thicknesses_fill_the_working_pitch():
    """No backlash, by the thicknesses at the working circles: independent of the shift equation."""
    for pair in samples(60, 6):
        rise = pair.working_pressure_angle - pair.pressure_angle
        lost = 2.0 * (
            math.tan(rise)
            - rise
            + math.tan(rise) * math.tan(pair.pressure_angle) * math.tan(pair.pressure_angle + rise)
        )
        arcs = [pair.working_radius[i] * (pair.tooth_thickness[i] / pair.reference_radius[i] - lost) for i in (0, 1)]
        pitch = 2.0 * math.pi * pair.working_radius[0] / pair.teeth[0]
        assert math.fsum(arcs) == pytest.approx(pitch, rel=1e-12 / min(1.0, pair.working_pressure_angle) ** 2, abs=0.0)


def test_span_measurement_is_the_thickness_and_pitches_on_the_base_circle():
    for pair in samples(60, 7):
        for i in (0, 1):
            rb, r = pair.base_radius[i], pair.reference_radius[i]
            alpha = pair.pressure_angle
            half_tooth = pair.tooth_thickness[i] / (2.0 * r) + math.tan(alpha) - alpha
            width = 2.0 * rb * (half_tooth + (pair.span_teeth[i] - 1) * math.pi / pair.teeth[i])
            assert pair.span_measurement[i] == pytest.approx(width, rel=1e-12, abs=0.0)


def test_span_touches_nearest_to_the_shifted_circle():
    for pair in samples(150 if ALL else 50, 8):
        for z, x, k in zip(pair.teeth, pair.profile_shift, pair.span_teeth, strict=True):
            base, alpha = z / 2.0 * math.cos(pair.pressure_angle), pair.pressure_angle

            def distance(n, z=z, x=x, base=base, alpha=alpha):
                width = teeth.span_measurement(1.0, z, x, alpha, n)
                return abs(math.sqrt(base**2 + width**2 / 4.0) - (z / 2.0 + x))

            best = min(range(2, z + 1), key=distance)
            assert distance(k) <= distance(best) + 1e-12 * z


def test_no_span_over_one_tooth():
    """Nearest to r + x m would be one tooth, which the planes meet at its root."""
    pair = GearPair(module=3.0, teeth=(19, 47), given_distance=96.0)
    assert pair.span_teeth == (2, 5)
    assert pair.form_radius[0] < pair.span_contact(0, 2) < pair.tip_radius[0]


def test_known_span_measurement():
    # shop tables for module 1, 20 deg: z = 20 over 3 teeth 7.6604, z = 40 over 5 teeth 13.8448
    assert GearPair.from_shift(1.0, (20, 40)).span_teeth == (3, 5)
    assert GearPair.from_shift(1.0, (20, 40)).span_measurement == pytest.approx((7.6604, 13.8448), abs=5e-5)


def test_undercut_limit_is_where_the_cutter_passes_the_base_tangent_point():
    shifts = {z: GearPair.from_shift(1.0, (z, 40)).min_shift_of(0) for z in (6, 12, 16, 17, 40)}
    for z, x in shifts.items():
        depth = z / 2.0 - (z / 2.0 * math.cos(ALPHA)) * math.cos(ALPHA)  # pitch line to base tangent point
        assert 1.0 - x == pytest.approx(depth, rel=1e-14, abs=0.0)
    assert shifts[17] < shifts[16]


def test_the_shift_sum_without_backlash_is_not_called_that_of_given_shifts():
    """With a distance and shifts they differ; without one of both they are the same."""
    keys = {"kind": "gear-pair", "module": 2.5, "teeth": [19, 37], "helix_angle": 17, "profile_shift": [0.32, -0.11]}
    sums = [design(keys | more, command="gear").quantity("shift_sum") for more in ({}, {"center_distance": 74.2})]
    assert sums[0].value == pytest.approx(0.21, rel=1e-14)
    assert sums[1].value == pytest.approx(0.418755997685981579, rel=1e-12)  # mpmath, 30 digits
    assert sums[1].symbol == "x_Sigma"


def test_interference_of_a_small_pinion_with_a_large_gear():
    pair = GearPair.from_shift(1.0, (10, 100))
    assert pair.interference_margin[1] < 0.0 < pair.interference_margin[0]  # the wheel's tip digs into the pinion
    with pytest.raises(
        NoSolution, match=r"tip of gear 2 beyond the base tangent point of gear 1: \d[\d.]* mm \(limit < 0 mm"
    ):
        _ = pair.specific_sliding


def test_pointed_tip_is_a_negative_thickness():
    assert GearPair.from_shift(1.0, (8, 40), (0.9, 0.0)).tip_thickness[0] < 0.0


shifts = st.floats(-0.6, 0.8)


@examples(100)
@given(st.integers(12, 200), st.integers(12, 200), shifts, shifts, st.floats(-6.0, 6.0))
def test_scale_and_exchange(z1, z2, x1, x2, exponent):
    try:
        pair = GearPair.from_shift(1.0, (z1, z2), (x1, x2))
        _ = pair.tip_pressure_angle
    except NoSolution:
        assume(False)
    factor = 10.0**exponent
    large = GearPair.from_shift(factor, (z1, z2), (x1, x2))
    swapped = GearPair.from_shift(1.0, (z2, z1), (x2, x1))
    assert large.working_pressure_angle == pair.working_pressure_angle == swapped.working_pressure_angle
    assert large.contact_ratio == pytest.approx(pair.contact_ratio, rel=1e-13, abs=1e-14)
    assert swapped.contact_ratio == pytest.approx(pair.contact_ratio, rel=1e-15, abs=0.0)
    for name in LENGTHS:
        values = both(getattr(pair, name))
        assert both(getattr(large, name)) == pytest.approx([factor * v for v in values], rel=8 * EPS, abs=0.0), name
        assert both(getattr(swapped, name)) == values[::-1]
    assert swapped.span_teeth == pair.span_teeth[::-1]
    assert swapped.tip_thickness == pair.tip_thickness[::-1]


@examples(100)
@given(st.integers(6, 300), st.integers(6, 300), shifts, shifts)
def test_center_distance_leads_back_to_the_shifts(z1, z2, x1, x2):
    try:
        pair = GearPair.from_shift(1.0, (z1, z2), (x1, x2))
    except NoSolution:
        assume(False)
    assume(pair.working_pressure_angle > 0.1)
    back = GearPair(module=1.0, teeth=(z1, z2), given_distance=pair.center_distance, given_first_shift=x1)
    # a' carries a'/m eps of y, and dx/dy = tan(alpha')/tan(alpha)
    slope = max(1.0, math.tan(pair.working_pressure_angle) / math.tan(ALPHA))
    assert abs(back.shift_sum - pair.shift_sum) <= 8.0 * EPS * pair.center_distance * slope
    assert pair.tip_shortening >= 0.0


def test_only_what_is_asked_for_is_computed():
    pair = GearPair.from_shift(2.0, (40, 72))
    before = set(vars(pair))
    assert pair.reference_center_distance == 112.0
    assert set(vars(pair)) - before == {"reference_center_distance"}


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: GearPair(module=4.0, teeth=(72, 72), given_distance=270.0),
            r"limit >= 270\.6 mm, sum of the base radii",
        ),
        (lambda: GearPair(module=4.0, teeth=(72, 72), given_distance=math.nan), "centre distance: nan"),
        (lambda: GearPair.from_shift(2.0, (8, 8), (-0.8, -0.8)), r"limit >= -0\.327"),
        (lambda: GearPair.from_shift(2.0, (8, 8), (math.nan, 0.0)), "no working pressure angle"),
        (lambda: GearPair.from_shift(0.0, (20, 20)), "module 0 mm"),
        (lambda: GearPair.from_shift(math.inf, (20, 20)), "module inf mm"),
        (lambda: GearPair.from_shift(2.0, (20, 20.5)), r"teeth 20\.5"),
        (lambda: GearPair.from_shift(2.0, (0, 20)), "teeth 0"),
        (lambda: GearPair.from_shift(2.0, (True, 20)), "teeth True"),
        (lambda: GearPair.from_shift(2.0, (20, 20), pressure_angle=1.6), "between 0 and 90 deg"),
        (lambda: GearPair.from_shift(2.0, (20, 20), addendum=0.0), "addendum must be positive"),
        (lambda: GearPair(module=2.0, teeth=(20, 20)), "either both profile shifts or"),
    ],
)
def test_refusals_name_the_limit(make, message):
    with pytest.raises(NoSolution, match=message):
        make()


def test_a_ring_pair_pushed_far_apart_names_its_distance():
    """The shift that follows is far below any: the fix asked for an increase by a negative number of modules."""
    pair = GearPair(module=4.0, teeth=(69, -72), given_distance=290.2912330746487)
    refusal = no_involute_at_tip(pair, 0)
    assert refusal.message.startswith("tip radius of gear 1: -269.4 mm (limit >= 129.7 mm")
    assert refusal.fix.startswith("set the centre distance near 6 mm")


def test_a_distance_that_takes_the_tips_names_what_fits_it():
    """66 teeth fill 100 mm with a module of 3.03 mm; a module of 10 um cannot, whatever the shifts."""
    pair = GearPair(module=1e-5, teeth=(19, 47), given_distance=100.0)
    with pytest.raises(NoSolution, match=r"the tips vanish at gear 1: .* near 0\.00033 mm, or .* near 3\.03 mm"):
        _ = pair.tip_pressure_angle


def test_tip_inside_the_base_circle_is_refused_with_the_remedy():
    pair = GearPair(module=1.0, teeth=(60, 60), given_distance=60.0, given_first_shift=-3.0)
    assert pair.tip_radius[0] < pair.base_radius[0]
    with pytest.raises(NoSolution, match=r"tip radius of gear 1: 28 mm \(limit >= 28\.19.* by at least 0\.191 modules"):
        _ = pair.tip_pressure_angle
    with pytest.raises(NoSolution, match=r"9 mm \(limit >= 9\.397 mm, the base radius"):
        teeth.pressure_angle_rise(10.0, -1.0, ALPHA)
