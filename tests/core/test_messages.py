"""The form of messages: WHAT: value unit (limit op limit unit) at PLACE, then a fix and notes on lines of their own.

Numbers are rounded to the safe side: what a message compares says the same as the check that it is of, exactly.
"""

import math
import re

import pytest
from factory import DESIGNS, worked
from hypothesis import assume, example, given
from hypothesis import strategies as st

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.kinds import KINDS
from gearlink.core.base.report import NO_NUMBER, Check, Rule, Shown, safely_above, safely_below
from gearlink.core.base.wording import apart, compared, short, within

RULE = Rule("GL303", "", "", "", "", checks=("transmission-angle",))
LONGEST = 240
FINITE = st.floats(-1e12, 1e12, allow_subnormal=False)
NUMBER = r"-?\d[\d.]*(?:e[-+]?\d+)?"
CONDITION = re.compile(rf": ({NUMBER})[^(:]*\((?:limit|recommended|required) (>=|<=|>|<) ({NUMBER})")
# words that the field does not use for these things
FOREIGN = re.compile(r"\b(greatest|least|turns? back|stands?|way back|wanted|asked for|left out)\b(?! to)")


def holds(value: float, op: str, limit: float) -> bool:
    return {">=": value >= limit, "<=": value <= limit, ">": value > limit, "<": value < limit}[op]


def wrong_in(check: Check) -> str:
    """What is wrong with the message of a check, in words; empty where nothing is."""
    message, *below = check.lines
    if len(message) > LONGEST or "\n" in message:
        return "too long"
    if sum(line.startswith("fix: ") for line in below) > 1 or (check.status == "pass" and check.fix):
        return "one fix, of what does not pass"
    if not all(line.startswith(("fix: ", "note: ")) for line in below):
        return "lines of their own"
    if found := CONDITION.search(message):
        value, op, limit = float(found[1]), found[2], float(found[3])
        if holds(value, op, limit) is not (check.status == "pass"):
            return "a condition that says something else than the check"
    if check.status != "pass" and re.search(r"\d{7}|\d\.\d{6}", message):
        return "more digits than somebody reads"
    return "a word that is not the field's" if FOREIGN.search(message) else ""


def findings(spec):
    """Every finding of the commands that a design file asks for; those of searches over many designs are left out."""
    for command in spec.commands():
        if command in ("tolerance", "register", "explore") or command not in KINDS[spec.kind].commands:
            continue
        design = KINDS[spec.kind].design(command, spec)
        try:
            for name in design.outline(command).checks:
                yield from design.check(name)
        except NoSolution as error:
            if max(len(error.message), len(error.fix)) > LONGEST:
                raise ValueError("too long") from error


@pytest.mark.slow
@pytest.mark.parametrize("path", sorted(DESIGNS.glob("*.yaml")), ids=lambda path: path.stem)
def test_messages_of_each_design_have_the_form(path):
    data = worked(path.stem)
    spec = KINDS[data["kind"]].spec_model().model_validate(data)
    assert [(check.lines, wrong) for check in findings(spec) if (wrong := wrong_in(check))] == []


LIMITS = {
    "candy_feed": {"limits": {"transmission_angle": 89.0, "gear_gap": 500.0, "contact_ratio": 3.0}},
    "thesis_example_3_as_printed": {"limits": {"transmission_angle": 80.0, "gear_gap": -5.0, "tip_thickness": 2.0}},
    "two_gear_ring": {"limits": {"transmission_angle": 85.0}},
    "gear_pair": {"limits": {"contact_ratio": 3.0, "tip_thickness": 2.0, "sliding": 0.1}},
    "swing_gripper": {"limits": {"pressure_angle": 5.0, "accelerate_pressure_angle": 1.0, "transmission_angle": 80.0}},
    "ty460": {"limits": {"pressure_angle": 5.0, "transmission_angle": 70.0}},
    "wide_swing_twin_cam": {"limits": {"pressure_angle": 2.0, "transition_zone": 1e-4}},
    "lift_cam": {"limits": {"pressure_angle": 5.0}},
}


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", LIMITS)
def test_messages_of_what_fails_have_the_form_and_a_fix(name):
    data = worked(name) | LIMITS[name]
    spec = KINDS[data["kind"]].spec_model().model_validate(data)
    found = list(findings(spec))
    assert [(check.lines, wrong) for check in found if (wrong := wrong_in(check))] == []
    failed = [check for check in found if check.status == "fail"]
    assert failed
    assert all(check.fix for check in failed)


@given(FINITE, FINITE, st.sampled_from([">=", "<="]))
@example(-999999999999.0, -999999999999.0, "<=")  # met, and not by the limit without the noise of its last digits
def test_a_comparison_says_the_same_as_its_numbers(value, limit, side):
    met = value >= limit if side == ">=" else value <= limit
    shown, bound = map(float, compared(value, limit, side, met))
    assert holds(shown, side, bound) is met


@given(FINITE)
def test_bounds_are_rounded_to_the_safe_side(value):
    low, high, near = float(safely_below(value)), float(safely_above(value)), float(short(value))
    assert low <= value <= high
    assert near in (low, high)
    assert len(re.sub(r"e.*|\D", "", safely_below(value).replace(".", "")).strip("0")) <= 4


@given(FINITE, FINITE)
def test_a_range_is_rounded_inwards_and_two_numbers_are_told_apart(one, other):
    assume(one != other)
    low, high = sorted((one, other))
    ends = within(low, high, "1").split(" to ")
    assert low <= float(ends[0]) < float(ends[1]) <= high
    assert len(set(apart(one, other))) == 2


def test_a_value_that_fails_next_to_its_limit_is_not_shown_as_the_limit():
    found = RULE.below(math.nextafter(40.0, 0.0), 40.0, 45.0, "deg", "transmission angle", "lengthen l4")
    assert found.message == "transmission angle: 39.99 deg (limit >= 40 deg)"
    equal = RULE.check("fail", "roller radius", 8.0, 8.0, "mm", side="<=")
    assert equal.message == "roller radius: 8 mm (limit < 8 mm)"


def test_no_condition_that_is_met_is_listed():
    warned = RULE.below(42.0, 40.0, 45.0, "deg", "transmission angle", "lengthen l4")
    assert warned.message == "transmission angle: 42 deg (recommended >= 45 deg)"
    other = RULE.check("warn", "transmission angle", 42.0, 40.0, "deg")
    assert other.message == "transmission angle: 42 deg"


def test_an_overlap_is_no_negative_distance():
    place = {"at": "input angle 0 deg", "aside": "AD - AB"}
    found = RULE.check("fail", "gap", -2.5, 0.5, "mm", overlap="interference", **place)
    assert found.message == "interference: 2.5 mm (limit <= 0 mm; AD - AB) at input angle 0 deg"
    assert (
        RULE.check("fail", "gap", 0.25, 0.5, "mm", overlap="interference").message == "gap: 0.25 mm (limit >= 0.5 mm)"
    )


def test_the_fix_is_the_change_that_was_tried_in_place_of_advice():
    advised = RULE.check("fail", "gap", -1.0, 0.0, "mm", fix="shorten the tips", note="nominal")
    assert advised.lines[1:] == ("fix: shorten the tips", "note: nominal")
    tried = Check(
        "GL301", "gap", "fail", "gap", remedy=(("gears.output", 39),), advice="shorten the tips", relaxes=True
    )
    assert tried.fix == "set gears.output to 39 (relaxes the requirement)"
    assert RULE.check("pass", "gap", 1.0, 0.0, "mm", fix="shorten the tips").fix is None


def test_a_message_is_never_longer_than_it_may_be():
    long = RULE.check("fail", "gap " * 80, 1.0, 2.0, "mm", aside="aside " * 80)
    assert len(long.message) == LONGEST
    assert RULE.check("fail", "gap", 1.0, 2.0, "mm", aside="aside " * 80).message == "gap: 1 mm (limit >= 2 mm)"


def test_a_statement_shows_no_number():
    assert RULE.check("fail", "the gears do not mesh", -37.4, 1.1, shown=NO_NUMBER).message == "the gears do not mesh"
    assert RULE.check("fail", "torque", 9.0, 8.0, shown=Shown(7191.4, 400.0, "N m", "<=")).message == (
        "torque: 7192 N m (limit <= 400 N m)"
    )
