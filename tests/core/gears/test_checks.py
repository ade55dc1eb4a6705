"""Gear checks at their limits: one status on each side, what a remedy names repairs, no sliding without an involute.

Tolerances: limits are met from both sides at 1e-9 of the datum; quantities themselves are held in test_gear_pair.py.
Undercut begins at x_min = h_a* - z sin^2(alpha)/2; tip thickness and contact ratio fall as x grows, so the shifts at
which they meet a limit are bracketed roots.
"""

import math
import re
from functools import partial

import factory
import pytest
from pydantic import ValidationError

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.spec import GearLimits
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.gears.checks import (
    GEAR_CHECKS,
    GEAR_QUANTITIES,
    contact_check,
    gear_check,
    gear_quantity,
    of_mesh,
)
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.drawing_checks import pair_check
from gearlink.core.parts.gears.mesh.pair import GearPair

LIMITS = GearLimits()
SIN2 = math.sin(math.radians(20.0)) ** 2


def pair_of(teeth=(20, 60), shift=(0.0, 0.0), module=2.5, **profile) -> GearPair:
    return GearPair.from_shift(module, teeth, shift, **profile)


design = partial(factory.design, {"kind": "gear-pair", "module": 3.0, "teeth": [20, 60]})


def checks(name, pair, limits=LIMITS, mesh=""):
    return of_mesh(mesh, gear_check(name, pair, limits, shifts=True))


def test_findings_on_a_mesh_begin_with_its_name() -> None:
    helical = GearPair(module=2.0, teeth=(20, 40), helix_angle=0.3, given_shift=(0.0, 0.0))
    found = pair_check("contact-ratio", GearData(pair=helical, face_width=(20.0, 20.0)), LIMITS, mesh="crank_idler")
    found += checks("tip-thickness", pair_of((8, 60), (1.6, 0.0)), mesh="crank_idler")
    assert [each.what.partition(":")[0] for each in found] == ["crank-idler mesh"] * 3
    assert "pointed" in found[1].what


# Undercut


@pytest.mark.parametrize(
    ("teeth", "status"), [(18, "pass"), (17, "warn"), (16, "fail"), (8, "fail")], ids=["18", "17", "16", "8"]
)
def test_unshifted_gears_and_undercut(teeth, status):
    first, second = checks("undercut", pair_of((teeth, 60)))
    assert (first.code, first.status, second.status) == ("GL201", status, "pass")
    assert first.value == pytest.approx(-(1.0 - teeth * SIN2 / 2.0), abs=1e-14)
    assert first.limit == -0.05


@pytest.mark.parametrize(
    ("beyond", "status"), [(1e-9, "pass"), (-1e-9, "warn"), (-0.05 + 1e-9, "warn"), (-0.05 - 1e-9, "fail")]
)
def test_undercut_at_its_limits(beyond, status):
    least = 1.0 - 12 * SIN2 / 2.0
    assert checks("undercut", pair_of((12, 40), (least + beyond, 0.0)))[0].status == status


@pytest.mark.parametrize("teeth", range(6, 17))
def test_shift_that_is_named_takes_the_undercut_away(teeth):
    check = checks("undercut", pair_of((teeth, 60)))[0]
    named = float(re.search(r"increase its profile shift to (-?[\d.]+)", check.fix)[1])
    assert checks("undercut", pair_of((teeth, 60), (named, 0.0)))[0].status == "pass"
    assert named == pytest.approx(1.0 - teeth * SIN2 / 2.0, rel=1e-3)


def test_margin_of_the_file_counts():
    limits = GearLimits(undercut=0.2)
    assert [checks("undercut", pair_of((14, 60)), given)[0].status for given in (LIMITS, limits)] == ["fail", "warn"]


# Tips, contact ratio, clearance


def shift_where(quantity, value, low, high):
    """Shift of gear 1 at which a quantity of the pair passes a value."""
    return bracketed_root(lambda x: quantity(pair_of((20, 60), (x, 0.0))) - value, low, high)


@pytest.mark.parametrize(("share", "below"), [(0.25, ("warn", "fail")), (0.4, ("pass", "warn"))])
def test_tip_thickness_at_its_limits(share, below):
    x = shift_where(lambda pair: pair.tip_thickness[0] / 2.5, share, 0.3, 1.2)
    statuses = tuple(checks("tip-thickness", pair_of((20, 60), (x + d, 0.0)))[0].status for d in (-1e-9, 1e-9))
    assert statuses == below
    assert checks("tip-thickness", pair_of((20, 60), (x, 0.0)))[0].value == pytest.approx(share, rel=1e-12)


def test_pointed_tip_fails_with_a_thickness_below_nothing():
    check = checks("tip-thickness", pair_of((12, 60), (1.2, 0.0)))[0]
    assert (check.code, check.status) == ("GL202", "fail")
    assert check.value < 0.0
    assert "reduce its profile shift" in check.fix


@pytest.mark.parametrize(("limit", "below"), [(1.1, ("warn", "fail")), (1.2, ("pass", "warn"))])
def test_contact_ratio_at_its_limits(limit, below):
    x = bracketed_root(lambda x: pair_of((20, 20), (x, x)).contact_ratio - limit, 0.3, 1.0)
    statuses = tuple(checks("contact-ratio", pair_of((20, 20), (x + d, x + d)))[0].status for d in (-1e-9, 1e-9))
    assert statuses == below


@pytest.mark.parametrize(
    ("ratio", "status"), [(0.8, "warn"), (1.0 - 1e-9, "warn"), (1.0 + 1e-9, "pass"), (0.4, "fail")]
)
def test_a_limit_below_1_does_not_let_an_interrupted_drive_pass(ratio, status):
    """Whatever the file allows: with 0.5 a pair of 0.8, whose teeth come apart, had passed without a word."""
    found = contact_check(ratio, GearLimits(contact_ratio=0.5), "the contact ratio", "take more teeth")
    assert found.status == status
    assert ("interrupted" in found.message) == (status == "warn")


def test_one_contact_ratio_of_a_pair():
    (check,) = checks("contact-ratio", pair_of((20, 20)))
    assert (check.code, check.status) == ("GL203", "pass")
    assert check.value == pytest.approx(1.556838, abs=5e-7)


@pytest.mark.parametrize(
    ("clearance", "status"), [(0.0, "fail"), (0.049, "fail"), (0.05, "warn"), (0.149, "warn"), (0.15, "pass")]
)
def test_root_clearance_at_its_limits(clearance, status):
    found = checks("root-clearance", pair_of((20, 60), clearance=clearance))
    assert [(check.code, check.status) for check in found] == [("GL205", status)] * 2


@pytest.mark.parametrize("keys", [{"tip_shortening": "none"}, {"tool": {"addendum": 1.0625, "rounding": 0.2}}])
def test_the_increase_that_is_named_gives_the_clearance(keys):
    keys = {"profile_shift": [0.3, -0.1]} | (keys if "tool" in keys else {"clearance": 0.05, **keys})
    for place, check in enumerate(design(**keys).check("root-clearance")):
        more = float(re.fullmatch(r"increase the .+ by ([\d.]+) modules, or shorten the tips of gear .", check.fix)[1])
        grown = {"tool__addendum": 1.0625 + more} if "tool" in keys else {"clearance": 0.05 + more}
        assert check.status != "pass"
        assert design(**keys | grown).check("root-clearance")[place].status == "pass"


# Interference


def test_interference_and_sliding_without_bound():
    # the tips of a rack-like wheel reach below the base circle of eight unshifted teeth
    pair = pair_of((8, 80))
    margin = pair.center_distance * math.sin(pair.working_pressure_angle) - math.sqrt(
        pair.tip_radius[1] ** 2 - pair.base_radius[1] ** 2
    )
    first, second = checks("involute-interference", pair)
    assert (first.code, first.status, second.status) == ("GL204", "pass", "fail")
    assert second.value == pytest.approx(margin, rel=1e-9)
    assert "increase the profile shift of gear 1" in second.fix
    assert gear_quantity(pair, "specific_sliding") is None
    assert gear_quantity(pair, "contact_ratio") == pair.contact_ratio


def test_interference_at_its_limit():
    x = bracketed_root(lambda x: pair_of((10, 60), (x, 0.0)).interference_margin[1], -0.2, 0.8)
    apart, touching = pair_of((10, 60), (x + 1e-9, 0.0)), pair_of((10, 60), (x - 1e-9, 0.0))
    assert [checks("involute-interference", pair)[1].status for pair in (apart, touching)] == ["pass", "fail"]
    assert gear_quantity(apart, "specific_sliding")[0] < -1e6
    assert gear_quantity(touching, "specific_sliding") is None


def test_sliding_is_left_out_of_the_report_where_there_is_none():
    def names(**keys):
        found = [quantity.name for quantity in design(profile_shift=[0.0, 0.0], **keys).report("gear").quantities]
        return [name for name in found if name in GEAR_QUANTITIES]

    assert names(teeth=[8, 80]) == [name for name in GEAR_QUANTITIES if name != "specific_sliding"]
    assert names() == list(GEAR_QUANTITIES)


# The mesh in the message, the design around it


@pytest.mark.parametrize("name", GEAR_CHECKS)
def test_message_names_the_mesh_of_a_design_with_several(name):
    assert all(check.message.startswith("crank-idler mesh: ") for check in checks(name, pair_of(), mesh="crank_idler"))
    assert not any(check.message.startswith("crank") for check in checks(name, pair_of()))


@pytest.mark.parametrize("given", ["center_distance", "profile_shift", "both"])
def test_pair_by_distance_by_shifts_or_by_both_in_agreement(given):
    sections = {"center_distance": 120.0, "profile_shift": [0.0, 0.0]}
    spec = sections if given == "both" else {given: sections[given]}
    found = design(**spec)
    assert found.quantity("center_distance").value == pytest.approx(120.0, rel=1e-15)
    assert found.quantity("profile_shift").value == pytest.approx([0.0, 0.0], abs=1e-15)


@pytest.mark.parametrize(
    ("off", "fits"), [(0.9e-6, True), (-0.9e-6, True), (1.1e-6, False), (-1.1e-6, False), (1.0, False)]
)
def test_distance_and_shifts_may_differ_by_a_millionth_of_the_module(off, fits):
    exact = pair_of((20, 60), (0.3, 0.1), 3.0).center_distance
    found = design(center_distance=exact + 3.0 * off, profile_shift=[0.3, 0.1])
    assert found.quantity("profile_shift").value == [0.3, 0.1]
    if fits:
        assert found.quantity("center_distance").value == pytest.approx(exact, rel=1e-14)
        assert found.quantity("shift_sum").value == 0.4
        return
    # beyond it the distance decides the mesh, and what the shifts lack is backlash
    assert found.quantity("center_distance").value == exact + 3.0 * off
    mesh = GearPair(module=3.0, teeth=(20, 60), given_distance=exact + 3.0 * off)
    assert found.quantity("shift_sum").value == pytest.approx(mesh.shift_sum, rel=1e-14)
    shortened = max(0.0, 0.4 - mesh.center_distance_modification)
    assert found.quantity("tip_shortening").value == pytest.approx(shortened, abs=1e-14)


def test_pair_without_either_is_a_fault_of_the_file():
    with pytest.raises(ValidationError, match="center_distance or profile_shift"):
        design()


@pytest.mark.parametrize(
    ("spec", "key"),
    [
        ({"center_distance": 100.0}, "center_distance"),  # below the sum of the base radii, 112.8 mm
        ({"profile_shift": [-2.0, -2.0]}, "profile_shift"),
        ({"teeth": [6, 40], "profile_shift": [-0.9, 0.0], "addendum": 0.3}, "profile_shift"),  # tip below base circle
        ({"teeth": [6, 40], "center_distance": 66.4, "shift_split": -1.2, "addendum": 0.2}, "center_distance"),
    ],
)
def test_refusals_name_the_key_that_places_the_gears(spec, key):
    with pytest.raises(NoSolution) as refusal:
        design(**spec).report("gear")
    assert refusal.value.key == key


def test_shift_split():
    equal = design(center_distance=121.0).quantity("profile_shift").value
    assert equal[0] == equal[1]
    first = design(center_distance=121.0, shift_split=0.2).quantity("profile_shift").value
    assert first[0] == 0.2
    assert sum(first) == pytest.approx(sum(equal), rel=1e-15)
