"""Gears inside linkages at the command line: errors at their place, what is missing, tables in 80 columns, the page.

Tolerances: none of its own.
"""

import factory
import numpy as np
import pytest
from factory import worked

from gearlink.cli.views.scenes.gears import gear

LEVER = """kind: geared-rocker
gears:
  module: 2
  coupler: 28
  output: 20
  {key}
links: {{crank: 20, coupler: 60, frame: 62}}
"""


@pytest.fixture
def lever(tmp_path):
    def write(key):
        path = tmp_path / "lever.yaml"
        path.write_text(LEVER.format(key=key))
        return path

    return write


@pytest.mark.parametrize(
    ("key", "place", "words"),
    [
        ("profile_shift: [0.1, oops]", "6:24", "must be a number"),
        ("profile_shift: [0.1, 5.5]", "6:24", "at most 5"),
        ("profile_shift: [0.1]", "6:3", "2 entries"),
        ("load: {torque: -3}", "6:10", "greater than 0"),
        ("load: {torque: 3, gear: outptu}", "6:21", "must be one of coupler, output"),
        ("load: {}", "6:3", "give torque"),
        ("allowances: {series: 25zz}", "6:16", "DIN 3967 has no series 25zz"),
        ("tool: [{rounding: 0.3}, {roundingg: 2}]", "6:28", "did you mean 'rounding'"),
        ("material: {bending_limit: [400, x]}", "6:35", "must be a number"),
        ("span_teeth: [3, 21]", "6:19", "a gear of 20 teeth has no span over 21"),
        ("cutter: {teeth: 20}", "6:3", "applies only to a ring"),
        ("helix_hand: [right, left]", "6:3", "give helix_angle"),
        ("tool: {rounding: 3}", "6:3", "full round"),
        ("profle_shift: [0, 0]", "6:3", "did you mean 'profile_shift'"),
    ],
)
def test_errors_stand_at_their_place(lever, gearlink, key, place, words):
    ended = gearlink("gear", lever(key))
    assert ended.status == 2
    assert f"lever.yaml:{place}: error" in ended.err
    assert words in ended.err
    assert "^" in ended.err


def test_a_quantity_without_a_value_names_the_keys_it_needs(lever, gearlink):
    ended = gearlink(
        "gear", lever("load: {torque: 5}"), "--quantity", "safety_bending", "--quantity", "center_distance"
    )
    assert ended.status == 0
    assert ended.out.split()[0] == "48.0"
    assert ended.err.strip() == (
        "safety_bending: not known of this design; give gears.face_width, gears.material.bending_limit"
    )
    assert gearlink("gear", lever("load: {torque: 5}"), "--quantity", "safety_bending", "--quiet").err == ""


def test_a_safety_alone_says_what_it_rests_on(lever, gearlink, designs):
    load = "load: {torque: 5, factors: {application: 1.25}}\n  face_width: 20\n  material: {bending_limit: 400}"
    ended = gearlink("gear", lever(load), "--quantity", "safety_bending")
    assert float(ended.out.split()[0]) > 0.0
    assert ended.err.strip() == (
        "safety_bending: K_A 1.25, K_v 1, K_Fb 1, K_Fa 1; K and life factors are those of the file, else 1"
    )
    assert gearlink("gear", lever(load), "--quantity", "safety_bending", "--quiet").err == ""
    assert gearlink("gear", lever(load), "--quantity", "root_chord").err == ""
    for source, name in (("drawn_feed", "crank_idler.contact_stress"), ("gear_pair", "safety_pitting")):
        assert "K_Hb" in gearlink("gear", designs / f"{source}.yaml", "--quantity", name, "-f", "json").err


def test_each_mesh_has_its_columns_in_a_narrow_terminal(gearlink, designs, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    ended = gearlink("gear", designs / "drawn_feed.yaml", "--table", "drawing", "--all")
    lines = ended.out.splitlines()
    heads = [line.split() for line in lines if line.startswith(("crank_idler. ", "idler_output. "))]
    assert [head[0] for head in heads] == ["crank_idler.", "idler_output."]
    assert heads[0][2:] == ["crank", "idler", "unit"]
    assert any(line.split()[:2] == ["crank_idler.backlash_normal", "j_bn"] for line in lines)
    assert [line for line in lines if line.startswith("drawing of ")] == [
        "drawing of crank_idler",
        "drawing of idler_output",
    ]
    assert max(map(len, lines)) <= 80


@pytest.mark.parametrize("name", ["drawn_ring", "drawn_feed", "drawn_lever"])
def test_worked_gears_pass_and_are_asked_for_by_their_file(gearlink, designs, name):
    ended = gearlink("check", designs / f"{name}.yaml")
    assert ended.status == 0
    assert "fail" not in ended.out
    from gearlink.core.base.kinds import KINDS

    data = worked(name)
    assert "gear" in KINDS[data["kind"]].spec_model().model_validate(data).commands()


@pytest.mark.slow
def test_the_page_shows_the_gear_tables(gearlink, designs, tmp_path):
    ended = gearlink("report", designs / "drawn_lever.yaml", "--out", tmp_path, "--quiet")
    assert ended.status == 0
    page = (tmp_path / "drawn-lever.html").read_text()
    assert "span measurement, maximum" in page


def test_a_ring_has_one_rim_whichever_key_gives_it() -> None:
    """Shafts are checked against rim_thickness, by which the ring is rated, where it gives more than two modules."""
    base = factory.worked("five_bar_positions")
    keys = {
        "target": None,
        "gears": {"module": 2, "planet": 20, "ring": 60},
        "links": {"coupler": 30, "follower": 150, "output": 110, "frame": 120},
        "shafts": {"E_radius": 40},
    }
    thick = {"gears__rim_thickness": [None, 20.0]}
    for more in ({}, {"gears__profile_shift": [0.1, -0.1]}):
        made = factory.design(base, **keys, **more, **thick)
        root = abs(made.meshes[""].root_radius[1])
        given = factory.design(base, **keys, **more, gears__rim=root + 20.0)
        checks = made.check("shaft-clearance")
        assert [(c.status, c.value) for c in checks] == [(c.status, c.value) for c in given.check("shaft-clearance")]
        assert "fail" in {c.status for c in checks}
        assert "fail" not in {c.status for c in factory.design(base, **keys, **more).check("shaft-clearance")}
    ring = factory.design("ring_feed", command="synth dwell", gears__rim_thickness=[None, None, 9.0])
    outer = 9.0 - ring.meshes["idler_output"].root_radius[1]
    assert ring.layout.gears[2].outer == outer
    mesh, still = ring.meshes["idler_output"], np.zeros(1)
    drawn = gear(mesh, 1, still + 0j, still, 1.0, "#000000", "5", rim=ring.outer_rim("idler_output"))
    assert np.abs(drawn[0].outline) == pytest.approx(outer, rel=1e-12)
