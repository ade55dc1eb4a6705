"""The gear table of a gear on a rack: the gear's column is that of the gear alone. No tolerances: the same numbers."""

import math
from typing import Any

import pytest
from factory import design

GEAR = {"kind": "gear-pair", "module": 3, "allowances": {"series": "25cd"}, "helix_angle": 10, "face_width": 30}


def test_a_rack_has_the_lines_of_its_teeth_alone() -> None:
    on_rack = design(GEAR | {"teeth": [20, "rack"], "profile_shift": [0.2, 0]}, command="gear").table("drawing")
    of_pair = design(GEAR | {"teeth": [20, 30], "profile_shift": [0.2, 0]}, command="gear").table("drawing")
    pair = {
        (item, unit): gear for item, gear, unit in zip(of_pair.data[0], of_pair.data[2], of_pair.data[4], strict=True)
    }
    lines = {
        item: (gear, rack) for item, gear, rack in zip(on_rack.data[0], on_rack.data[2], on_rack.data[3], strict=True)
    }
    assert lines["number of teeth"] == (20, "rack")
    assert lines["normal module"] == (3.0, 3.0)
    for item in ("span measurement, minimum", "measure over balls, maximum", "thickness allowance, upper"):
        gear = pair[(item, "mm")]
        assert lines[item] == (gear, gear if item.startswith("thickness") else None), item  # a rack takes its gear's
    assert lines["axis to the datum line of the rack"][0] == lines["reference diameter"][0] / 2 + 0.6
    assert lines["face width"] == (30.0, 30.0)


def test_allowances_bear_the_symbols_of_their_limits() -> None:
    """E_sns and E_sni of ISO 21771: both lines were called E_sn."""
    pair = GEAR | {"teeth": [20, 30], "profile_shift": [0.2, 0]}
    table = design(pair, command="gear").table("drawing")
    symbols = dict(zip(table.data[0], table.data[1], strict=True))
    assert symbols["thickness allowance, upper"] == "E_sns"
    assert symbols["thickness allowance, lower"] == "E_sni"


@pytest.mark.parametrize("written", ["cd25", "25 cd", "cd 25", ["25cd", "cd25"]])
def test_a_series_of_allowances_may_be_written_as_elsewhere(written: Any) -> None:
    pair = GEAR | {"teeth": [20, 30], "profile_shift": [0.2, 0]}
    other = design(pair | {"allowances": {"series": written}}, command="gear")
    assert other.report("gear").quantities == design(pair, command="gear").report("gear").quantities


def test_a_rack_has_its_own_lines_to_cut_and_measure_it_by() -> None:
    """The pin in a space of 45 deg flanks, moved to 20 deg: it touches both flanks, found by its distance from them."""
    made = design(GEAR | {"teeth": [20, "rack"], "profile_shift": [0.2, 0], "pin_diameter": [5.5, 5.0]}, command="gear")
    table = made.table("drawing")
    rack = dict(zip(table.data[0], table.data[3], strict=True))
    assert rack["pitch of the rack"] == math.pi * 3 / math.cos(math.radians(10))
    assert (rack["tip line above the datum line"], rack["root line below the datum line"]) == (3.0, 3.75)
    alpha, allowance = math.radians(20.0), rack["thickness allowance, upper"]
    center = rack["datum line to ball top, maximum"] - 2.5
    half = 0.25 * math.pi * 3 - 0.5 * allowance  # of the space on the datum line
    to_flank = (half + center * math.tan(alpha)) * math.cos(alpha)
    assert abs(to_flank - 2.5) < 1e-12
    assert rack["datum line to ball top, minimum"] < rack["datum line to ball top, maximum"]
    assert rack["theoretical backlash, minimum"] == made.quantity("backlash_normal").value[0]


@pytest.mark.parametrize(("teeth", "pins", "words"), [
    ([18, 57], [100.0, 4.25], "beyond its tips"),
    ([18, 57], [0.1, 4.25], "falls through the spaces of gear 1"),
    ([18, 57], [4.25, 3.2], "gear 2"),
    ([18, -57], [4.25, 30.0], "gear 2"),
    ([18, "rack"], [60.0, 4.0], "beyond its tips"),
])  # fmt: skip
def test_balls_that_do_not_measure_the_teeth_are_named(teeth: list[Any], pins: list[float], words: str) -> None:
    """A ball between the flanks passes without a word, and so does every preferred one that a remedy names."""
    known = {"kind": "gear-pair", "module": 2.5, "teeth": teeth, "profile_shift": [0.2, 0.0]}
    made = design(known | {"pin_diameter": pins}, command="gear")
    (found,) = made.check("inspection")
    assert (found.code, found.status) == ("GL213", "warn")
    assert words in found.message
    best = float(found.fix.partition("set pin_diameter to ")[2].partition(" mm")[0])
    mended = [pins[0], best] if "gear 2" in words else [best, pins[1]]
    assert design(known | {"pin_diameter": mended}, command="gear").check("inspection") == []
    assert design(known, command="gear").check("inspection") == []


@pytest.mark.parametrize(("width", "over"), [(15.5, 6), (9.0, None)])
def test_a_span_beyond_the_face_of_a_helical_gear_is_named(width: float, over: int | None) -> None:
    """The planes touch along lines at the base helix angle, so their places stand W_k sin(beta_b) apart along the axis.

    Followed, the finding is gone; wide gears and spur ones have none.
    """
    known: dict[str, Any] = {"kind": "gear-pair", "module": 2, "teeth": [41, 40], "profile_shift": [0.2, 0.0]}
    helical = known | {"helix_angle": 25}
    made = design(helical | {"face_width": [width, 40]}, command="gear")
    (found,) = made.check("inspection")
    assert (found.code, found.status) == ("GL213", "warn")
    span, bend = made.quantity("span_measurement").value[0], made.gear_pair.base_helix_angle
    assert found.limit == pytest.approx(span * math.sin(bend) + 1.2 * math.cos(bend), rel=1e-12)
    assert found.fix == ("measure over balls" if over is None else f"measure over {over} teeth")
    if over is not None:
        fewer = {"face_width": [width, 40], "span_teeth": [over, 5]}
        assert design(helical | fewer, command="gear").check("inspection") == []
    assert design(helical | {"face_width": 40}, command="gear").check("inspection") == []
    assert design(known | {"face_width": 1}, command="gear").check("inspection") == []


@pytest.mark.parametrize("teeth", [[18, 57], [18, -57], [18, "rack"]])
def test_a_load_without_a_width_is_not_left_without_a_word(teeth: list[Any]) -> None:
    known = {"kind": "gear-pair", "module": 2.5, "teeth": teeth, "profile_shift": [0.2, 0.0], "load": {"torque": 10}}
    said = [check for check in design(known, command="gear").check("bending") if "face_width" in check.message]
    assert [(check.code, check.status) for check in said] == [("GL211", "warn")]
    wide = design(known | {"face_width": 20}, command="gear").check("bending")
    assert not [check for check in wide if "face_width" in check.message]


@pytest.mark.parametrize(("given", "lines"), [
    ({"accuracy_grade": 6, "face_width": [25, 24]}, True),
    ({"accuracy_grade": 6}, False),
    ({"accuracy_grade": 6, "face_width": [25, 3]}, False),  # the standard begins at 4 mm
    ({"face_width": 25}, None),
])  # fmt: skip
def test_a_grade_alone_has_its_tolerances(given: dict[str, Any], lines: bool | None) -> None:
    """By formulas of ISO 1328-1:2013 for d = 60, b = 25 mm: f_pt = sqrt(2) (0.06 + 1.2 + 5), rounded to 0.5 um."""
    table = design(GEAR | {"face_width": None, "helix_angle": 0, "teeth": [20, 40], "profile_shift": [0, 0]} | given,
                   command="gear").table("drawing")  # fmt: skip
    found = {item: (one, other) for item, one, other in zip(table.data[0], table.data[2], table.data[3], strict=True)}
    assert (found.get("accuracy grade, ISO 1328-1:2013") == (6, 6)) is bool(lines)
    assert ("accuracy grade, ISO 1328-1" in found) is (lines is False)
    assert ("single pitch deviation" in found) is bool(lines)
    if lines:
        assert found["single pitch deviation"] == (9.0, 9.0)
        slope, form = 0.05 * math.sqrt(60) + 0.35 * 5 + 4, 0.07 * math.sqrt(60) + 0.45 * 5 + 4
        assert found["total helix deviation"][0] == round(math.sqrt(2) * math.hypot(slope, form))
        assert found["runout"][0] == round(0.9 * math.sqrt(2) * (0.12 + 0.55 * math.sqrt(60) + 2.1 + 12))


def test_a_ring_is_measured_between_balls() -> None:
    """In lines of its own, whatever the order of the gears; of external gears there are none."""
    known = {"kind": "gear-pair", "module": 2, "profile_shift": [0.2, 0.0], "pin_diameter": [3.5, 3.5]}
    for limits in ({}, {"allowances": {"upper": [-0.05, -0.06], "lower": [-0.08, -0.1]}}):
        made = design(known | limits | {"teeth": [20, -60]}, command="gear")
        items, _, first, second, _ = made.table("drawing").data
        rows = {item: (one, two) for item, one, two in zip(items, first, second, strict=True) if "balls" in item}
        measured = made.raw("measure_limits") if limits else made.raw("measure_over_balls")
        for way, place in (("over", 0), ("between", 1)):
            found = [row for item, row in rows.items() if f"{way} balls" in item]
            assert found
            assert all(row[1 - place] is None for row in found)
            values = measured[place][::-1] if limits else [measured[place]]
            assert [row[place] for row in found] == pytest.approx(values, rel=1e-12)
        plain = design(known | limits | {"teeth": [20, 60]}, command="gear").table("drawing").data[0]
        assert not any("between balls" in item for item in plain)
