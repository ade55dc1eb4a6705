"""Candidates: each row is the synthesis of that module and idler. Tolerance 1e-14: the same formulas and numbers."""

import math

import pytest
from factory import design

from gearlink.core.base.candidates import modules

TASKS = [
    pytest.param("synth dwell", "standing_feed", {}, marks=pytest.mark.slow),  # a window for each row
    ("synth dwell", "candy_feed", {}),
    ("synth back-step", "thesis_example_1", {}),
    ("synth variable-speed", "thesis_example_2", {}),
    ("synth momentary-dwell", "thesis_example_3_mended", {}),
]


@pytest.mark.quick(2)
@pytest.mark.parametrize(("command", "name", "keys"), TASKS)
def test_every_row_is_a_synthesis_of_its_own(command, name, keys):
    made = design(name, command=command, **keys)
    table = made.table("candidates")
    rows = [dict(zip(table.columns, row, strict=True)) for row in table.each_row()]
    assert {row["module"] for row in rows} == set(modules(made.spec.gears.module))
    assert min(row["idler_teeth"] for row in rows) == made.idler_teeth
    for row in rows[::5]:
        keys = {"gears__module": row["module"], "gears__idler": row["idler_teeth"]}
        own = design(name, command=command, **keys)
        if row["crank_length"] is None:
            assert row["findings"].startswith("GL1")
            continue
        assert row["frame_length"] == pytest.approx(own.frame_length, rel=1e-14)
        assert row["gear_gap"] == pytest.approx(own.gear_gap, rel=1e-12)
        codes = {f"{c.status} {c.code}" for c in own.report(command).checks if c.status != "pass"}
        assert set(row["findings"].split(", ")) == (codes or {"pass"})
        reach = own.spec.gears.module * (own.crank_teeth + own.output_teeth + 4) / 2.0
        assert row["length"] == pytest.approx(own.crank_length + own.frame_length + reach, rel=1e-12)


def test_dwell_is_phi13():
    assert design("candy_feed", command="synth dwell").table("candidates")["dwell"] == pytest.approx(135.0, rel=1e-12)


@pytest.mark.slow
def test_dwell_is_the_window_within_the_tolerance():
    standing = design("standing_feed", command="synth dwell").table("candidates")
    assert all(70.0 <= window < 73.5 for window in standing["dwell"] if math.isfinite(window or math.nan))


def test_one_table_alone_is_shown(gearlink):
    from factory import DESIGNS

    ended = gearlink("synth", "dwell", DESIGNS / "candy_feed.yaml", "--candidates", "--format", "json")
    assert ended.status == 0
    assert list(ended.json["tables"]) == ["candidates"]
    assert ended.json["quantities"] == {}
    refused = gearlink("gripper", DESIGNS / "swing_gripper.yaml", "--candidates")
    assert refused.status == 2
    assert "candidates" in refused.err
