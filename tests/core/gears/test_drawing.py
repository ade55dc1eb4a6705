"""The gear table of a gear on a rack: the gear's column is that of the gear alone. No tolerances: the same numbers."""

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
    for item in ("span measurement, least", "measure over balls, greatest", "thickness allowance, upper"):
        assert lines[item] == (pair[(item, "mm")], None), item
    assert lines["axis to the datum line of the rack"][0] == lines["reference diameter"][0] / 2 + 0.6
    assert lines["face width"] == (30.0, 30.0)
