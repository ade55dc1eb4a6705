"""Explanations: every code has one and every one a code; names lead to their topic. No tolerances: texts."""

from __future__ import annotations

import math
import re
import time
from collections import Counter
from pathlib import Path
from typing import Any

import pytest
from factory import DESIGNS, design, each_kind, worked
from sweeps import mostly_slow

from gearlink.cli.commands.explain import FORMULAS, column_words, find, names
from gearlink.cli.texts.codes import explanations
from gearlink.cli.texts.schema import index, inner_keys
from gearlink.core.base.codes import rules
from gearlink.core.base.kinds import FILES as KINDS
from gearlink.core.base.nomenclature import TERMS
from gearlink.core.parts.cams.laws import REST_TO_REST, law

ROOT = Path(__file__).parents[3]
PATHS = [
    path
    for top in ("core", "cli")
    for path in sorted((ROOT / top).rglob("*.py"))
    if path.name not in ("codes.py", "files.py", "studies.py")
]
SOURCES = [path.read_text() for path in PATHS]


def emitted() -> set[str]:
    """The codes of files and command lines in the source of the program, but for their texts."""
    return {code for text in SOURCES for code in re.findall(r"\bGL1\d{2}\b", text)}


def test_every_code_is_explained_and_every_explanation_has_a_code() -> None:
    assert {code for code in explanations() if code.startswith("GL1")} == emitted()


def test_findings_are_made_from_rules_alone() -> None:
    """No code is written where a check is made, and every rule judges somewhere."""
    checks = [text for path, text in zip(PATHS, SOURCES, strict=True) if "core" in path.parts]
    assert [text for text in checks if re.search(r'\bCheck\(\s*"GL', text)] == []
    used = {name for text in checks for name in re.findall(r"\b[A-Z][A-Z_]+\b", text)}
    named = []
    for path in (ROOT / "core").rglob("codes.py"):
        head, *rules_of = re.split(r"(?m)^(?=[A-Z_]+ = Rule)", path.read_text())
        named += [each.partition(" ")[0] for each in rules_of]
        used |= {name for text in (head, *rules_of) for name in re.findall(r"\((?:[a-z]+=)?([A-Z_]+),", text)}
    assert len(named) == len(rules())
    assert set(named) <= used


def test_every_check_of_a_design_is_explained() -> None:
    explained = {check for text in explanations().values() for check in text.checks}
    classes = {kind.design_class(command) for kind in KINDS.values() for command in kind.commands}
    shown = {check for cls in classes for outline in cls.outlines.values() for check in outline.checks}
    assert shown <= explained


@pytest.mark.parametrize("code", explanations())
def test_texts_are_whole(code: str) -> None:
    text = explanations()[code]
    assert text.title
    for words in (text.what, text.why, text.remedy):
        assert words.endswith(".")
    if not code.startswith("GL1"):
        assert text.formula
        assert text.source
        assert text.checks
        assert text.keys


def test_no_check_stands_under_two_codes() -> None:
    checks = Counter(check for text in explanations().values() for check in text.checks)
    assert [check for check, count in checks.items() if count > 1] == ["resonance"]  # of teeth, and of a drive


def test_keys_of_the_explanations_exist_in_a_kind() -> None:
    """A finding of `gearlink check` is placed at them."""
    from gearlink.cli.texts.schema import spec_keys

    paths = {key.path for kind in KINDS.values() for key in spec_keys(kind)}
    missing = {(code, key) for code, text in explanations().items() for key in text.keys if key not in paths}
    assert missing == set()


@pytest.mark.slow
def test_what_is_known_is_what_models_and_classes_say() -> None:
    """After a change of specs or outlines: `make docs`."""
    from docs.generate import index_text, schemas_text
    from gearlink.cli.texts import schema

    assert schema.SCHEMAS.read_text(encoding="utf-8") == schemas_text()
    assert schema.INDEX.read_text(encoding="utf-8") == index_text()


def test_formulas_belong_to_quantities() -> None:
    assert set(FORMULAS) <= set(TERMS)


NAMES = names()


@pytest.mark.quick(12)
@pytest.mark.parametrize("name", mostly_slow([*NAMES[::5], *(name for name in NAMES if name not in NAMES[::5])], 65))
def test_everything_can_be_explained(gearlink: Any, name: str) -> None:
    ended = gearlink("explain", name)
    assert (ended.status, ended.err) == (0, "")
    assert re.search(rf"(?m)^{re.escape(name)}: ", ended.out)  # a term of the field of that name comes first
    assert max(map(len, ended.out.splitlines())) <= 120


@pytest.mark.parametrize("name", ["speed", "gears.tip_shortening", "margin"])
def test_what_bears_the_name_itself_comes_first(gearlink: Any, name: str) -> None:
    """A key of one word, the path of a key whose last word is a quantity, a column that is the last word of a key."""
    topics = gearlink("explain", name, "--format", "json").json["topics"]
    assert topics[0]["name"] == name
    assert len(topics) > 1


def test_code_says_what_why_formula_source_and_how_to_mend(gearlink: Any) -> None:
    topic = gearlink("explain", "GL301", "--format", "json").json["topics"][0]
    assert {"what", "why", "formula", "source", "how_to_mend", "checks", "kinds"} <= set(topic)
    assert topic["about"] == "code"
    assert topic["kinds"].startswith("three-gear-four-bar, geared-five-bar, geared-six-bar, planar-mechanism")


@pytest.mark.parametrize("written", ["gl301", "GL301"])
def test_case_does_not_matter(gearlink: Any, written: str) -> None:
    assert gearlink("explain", written).out.startswith("GL301: ")


def test_check_name_leads_to_its_code(gearlink: Any) -> None:
    concept, topic = gearlink("explain", "gear-collision", "--format", "json").json["topics"][:2]
    assert (concept["about"], topic["about"]) == ("term", "check")
    assert "GL301" in topic["title"]


def test_kinds_of_an_optional_check(gearlink: Any) -> None:
    """The lift-off check is shown only where a file has spring and masses, but the kind has it."""
    topics = gearlink("explain", "lift-off", "--format", "json").json["topics"]
    kinds = next(each for each in topics if each["about"] == "check")["kinds"]
    assert kinds == "swing-gripper, planar-mechanism, disc-cam, measured-cam"


def test_quantity_says_unit_symbol_formula_and_who_gives_it(gearlink: Any) -> None:
    topics = gearlink("explain", "quick_return_ratio", "--format", "json").json["topics"]
    topic = next(each for each in topics if each["about"] == "quantity")
    assert topic["symbol"] == "K"
    assert topic["unit"] == "1 (no dimension)"
    assert topic["formula"].startswith("K = (180 + t)/(180 - t)")
    assert topic["source"] == "VDI 2142"
    assert "slider-crank (crank, analyze)" in topic["given_by"]
    assert "flatbed-press (crank)" in topic["given_by"]


def test_lift_off_speed_is_that_of_each_kind_with_its_unit(gearlink: Any) -> None:
    topic = gearlink("explain", "lift_off_speed", "--format", "json").json["topics"][1]
    assert topic["unit"] == "sheets/h; 1/min (disc-cam, measured-cam, wide-swing-cam)"
    assert all(f"{kind}: n* = " in topic["formula"] for kind in ("disc-cam", "swing-gripper", "wide-swing"))


def test_every_shown_quantity_has_a_giver(gearlink: Any) -> None:
    topic = gearlink("explain", "start_curvature_radius", "--format", "json").json["topics"][0]
    assert "wide-swing-cam (" in topic["given_by"]


def test_name_that_carries_its_mesh(gearlink: Any) -> None:
    assert gearlink("explain", "crank_idler.contact_ratio").out.startswith("contact_ratio: ")


def test_hyphen_for_underscore_finds_the_other_where_there_is_none(gearlink: Any) -> None:
    assert gearlink("explain", "frame-length").out.startswith("frame_length: ")
    assert "\ngear-collision: " in gearlink("explain", "gear_collision").out


def test_kind_names_its_commands_and_keys(gearlink: Any) -> None:
    out = gearlink("explain", "slider-crank").out
    assert "gearlink crank" in out
    assert "stroke, crank, quick_return_ratio, rod, offset" in " ".join(out.split())
    assert "Needs: gears, links" in gearlink("explain", "geared-rocker").out


def test_law_gives_its_peaks(gearlink: Any) -> None:
    """Known closed values: Cv = 2, Ca = 2 pi, Cj = 4 pi^2."""
    topic = gearlink("explain", "cycloidal", "--format", "json").json["topics"][0]
    assert "velocity Cv 2, acceleration Ca 6.28319, jerk Cj 39.4784" in topic["peaks"]
    assert gearlink("explain", "velocity-345").out.count("kappa = 0.5 ") == 1


@pytest.mark.parametrize("name", REST_TO_REST)
def test_a_law_has_a_formula_of_its_own(name: str) -> None:
    """That of another law is no answer for a new one; where it gives s, it is evaluated as it stands.

    Tolerance: 1e-14, a few roundings of terms up to 84.
    """
    (topic,) = [each for each in find(name) if each.title.startswith("motion law")]
    formula = topic.paragraphs["Formula"]
    assert ("middle runs NN percent" in formula) == name.startswith("mcv-")
    if formula.startswith("s = "):
        written = re.sub(r"(?<=[\w)]) (?=[a-z])", "*", formula.removeprefix("s = ")).replace("^", "**")
        for x in (0.0, 0.2, 0.5, 0.9):
            at = eval(written, {"x": x, "pi": math.pi, "sin": math.sin, "cos": math.cos})
            assert at == pytest.approx(law(name).derivatives(x, 0, 0)[0], abs=1e-14)


def test_list_of_codes(gearlink: Any) -> None:
    ended = gearlink("explain")
    assert ended.status == 0
    assert [line[:5] for line in ended.out.splitlines() if line.startswith("GL")] == list(explanations())
    listed = gearlink("explain", "--format", "json").json["topics"]
    assert [topic["name"] for topic in listed] == list(explanations())
    assert gearlink("explain", "--format", "md").out.startswith("| code | meaning | check |")


def test_markdown(gearlink: Any) -> None:
    out = gearlink("explain", "GL401", "--format", "md").out
    assert out.startswith("# GL401: ")
    assert "**How to repair:** " in out


@pytest.mark.slow
def test_unknown_name_gives_the_nearest(gearlink: Any) -> None:
    ended = gearlink("explain", "GL901")
    assert ended.status == 2
    assert ended.out == ""
    assert "nearest: GL" in ended.err
    ended = gearlink("explain", "crank_lenght")
    assert ended.status == 2
    assert "nearest: crank_length" in ended.err
    ended = gearlink("explain", "xyzzy", "--format", "json")
    assert ended.status == 2
    assert ended.json["errors"][0]["code"] == "GL115"


def test_csv_is_refused(gearlink: Any) -> None:
    assert gearlink("explain", "GL301", "--format", "csv").status == 2


def test_help_has_an_example(gearlink: Any) -> None:
    assert "Example: gearlink explain" in gearlink("explain", "--help").out


@pytest.mark.parametrize(("name", "about", "words"), [
    ("phi13", "symbol", "dwell_angle: crank angle from the start of the back-step"),
    ("mu_min", "symbol", "min_transmission_angle: "),
    ("cam.lead_in", "key", "cam angle before the zone"),
    ("lead_in", "key", "cam angle before the zone"),
    ("gears.module", "key", "module of all three gears"),
    ("speed_ratio", "column", "output speed per input speed"),
    ("mesh_13", "column", "tangential force in that mesh"),
    ("kappa", "constant", "rest-to-speed law"),
    ("P15", "column", "instant centre P15"),
    ("segments", "table", "each segment with its law"),
    ("walls", "table", "points of both walls in space"),
])  # fmt: skip
def test_symbols_keys_columns_and_constants_are_known(gearlink: Any, name: str, about: str, words: str) -> None:
    topics = gearlink("explain", name, "--format", "json").json["topics"]
    assert [topic["title"] for topic in topics if topic["about"] == about and words in topic["title"]]


def test_a_table_says_what_it_holds_for_each_kind(gearlink: Any) -> None:
    page = gearlink("explain", "motion").out
    assert "slider-crank: Slider and rod over a revolution of the crank" in page
    assert "cam-gear, cam-linkage: The output over a revolution of the input" in page
    assert "Most kinds: Every source" in gearlink("explain", "budget").out


def test_every_table_is_explained() -> None:
    tables = {
        name for kind in KINDS.values() for cls in map(kind.design_class, kind.commands) for name in cls.table_names()
    }
    assert len(tables) > 80
    assert tables == set(index().tables)
    assert all(words.strip() for texts in index().tables.values() for words, _, _ in texts)


def test_a_key_says_unit_range_choice_and_kinds(gearlink: Any) -> None:
    topic = gearlink("explain", "cam.lead_in", "--format", "json").json["topics"][0]
    assert (topic["unit"], topic["range"], topic["choice"]) == ("deg", "from 0, below 360", "default 0")
    assert topic["kinds"] == "flatbed-press"


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("path", "key"),
    [
        ("loads.bearings.C.reliability", "loads.bearings.NAME.reliability"),
        ("loads.bearings.C.life", "loads.bearings.NAME.life"),  # and not the quantity first
        ("motion[1].lift", "motion[].lift"),
        ("shaft.stiffnesses[1].diameter", "shaft.stiffnesses[].diameter"),
        ("tolerance.sources.links.crank.plus_minus", "tolerance.sources.NAME.plus_minus"),
        ("loads.forces[0].torque.zones[2].from", "loads.forces[].torque.zones[].from"),
    ],
)
def test_a_path_as_it_stands_in_a_file_leads_to_its_key(gearlink: Any, path: str, key: str) -> None:
    topics = gearlink("explain", path, "--format", "json").json["topics"]
    assert (topics[0]["about"], topics[0]["name"]) == ("key", key)


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("wrong", "near"), [("cam.leadin", "cam.lead_in"), ("phi31", "phi13"), ("lead-in_", "lead_in")]
)
def test_nearest_of_keys_and_symbols(gearlink: Any, wrong: str, near: str) -> None:
    ended = gearlink("explain", wrong)
    assert ended.status == 2
    assert near in ended.err


@pytest.mark.quick(1)
@pytest.mark.parametrize("word", ["envelope", "lazy tongs", "teapot", "hovercraft"])
def test_a_word_of_its_own_has_no_nearest(gearlink: Any, word: str) -> None:
    """Names that share some letters with it are no help."""
    ended = gearlink("explain", word)
    assert ended.status == 2
    assert "nearest" not in ended.err
    assert "`gearlink new` the kinds" in ended.err


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("word", "near"),
    [
        ("height", "path_height"),
        ("gear-four-bar", "two-gear-four-bar, three-gear-four-bar"),
        ("train-mobility", "gear-train-mobility"),
        ("dwel", "dwell"),
        ("phi31", "phi13"),
        ("trasmission-angle", "transmission-angle"),
        ("GL3O1", "GL301"),
    ],
)
def test_a_part_of_a_name_and_a_slip_are_near(gearlink: Any, word: str, near: str) -> None:
    assert f"nearest: {near}" in gearlink("explain", word).err


@pytest.mark.quick(5)
@pytest.mark.parametrize(
    ("name", "about", "words"),
    [
        ("rise_end", "event", "end of the rise of a member"),
        ("dwell start", "event", "start of the dwell of a member"),
        ("velocity_maximum", "event", "where a member has its maximum velocity"),
        ("osculating", "value", "value of the key rod.rule"),
        ("translating-flat", "value", "follower.type"),
        ("inflection", "key", "cams.NAME.motion[].law.inflection"),
        ("grades", "key", "IT grade that may be chosen"),
        ("scca", "key", "[0, 1, 0, 0]: parabolic motion"),
        ("Whitworth", "term", "more time for one stroke"),
        ("profile error", "term", "cam's profile as manufactured"),
    ],
)
def test_events_values_and_keys_of_entries_are_known(name: str, about: str, words: str) -> None:
    assert [each for each in find(name) if each.about == about and words in f"{each.name} {each.title}"]


@pytest.mark.slow
def test_every_key_and_every_word_that_a_key_takes_is_explained() -> None:
    words = {word for key in inner_keys() for word in (key.path.rpartition(".")[2].removesuffix("[]"), *key.choices)}
    assert [word for word in sorted(words - {"kind", "NAME"}) if not find(word)] == []


def test_what_texts_say_is_found_in_them(gearlink: Any) -> None:
    """No name has this word, nor a spelling near it."""
    assert "occurs in the texts of root_radius" in gearlink("explain", "space").err


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("asked", "within"), [("how long is the dwell", "dwell"), ("预定停歇角", "停歇角"), ("is a rocker good", "rocker")]
)
def test_of_a_phrase_the_terms_within_it_are_named(gearlink: Any, asked: str, within: str) -> None:
    assert gearlink("explain", asked).err.rstrip().endswith(f"terms within it: {within}")


def test_a_long_text_is_answered_at_once(gearlink: Any) -> None:
    """Every word was compared with every name, and every phrase of any length looked up: a minute for 3,000 words."""
    begun = time.process_time()
    text = " ".join(f"word{i} dwell" for i in range(1500))
    assert gearlink("explain", text).err.rstrip().endswith("terms within it: dwell")
    assert time.process_time() - begun < 3.0


def test_a_symbol_of_two_ends_is_found_without_them() -> None:
    assert [topic.title.partition(":")[0] for topic in find("j_bn")] == ["backlash_normal"]
    assert {"span_measurement", "span_measurement_limits"} < {topic.title.partition(":")[0] for topic in find("W_k")}


def test_small_words_do_not_hide_a_term() -> None:
    assert [topic.name for topic in find("angle of the dwell")] == [topic.name for topic in find("angle dwell")] != []


@pytest.mark.parametrize("width", [60, 80, 100])
def test_text_fits_the_width(gearlink: Any, monkeypatch: pytest.MonkeyPatch, width: int) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    assert max(map(len, gearlink("explain", "GL301").out.splitlines())) <= width


def test_no_paragraph_repeats_the_headline(gearlink: Any) -> None:
    words = " ".join(gearlink("explain", "dwell_angle").out.split())
    assert words.count("crank angle from the start of the back-step until the output is back at that position") == 1


@pytest.mark.quick(2)
@pytest.mark.parametrize("path", each_kind(sorted(DESIGNS.glob("*.yaml"))), ids=lambda path: path.stem)
def test_every_column_of_a_worked_design_has_words(path: Path) -> None:
    name = path.stem
    for command in ("analyze", "gripper", "press", "swing"):
        if command not in KINDS[worked(name)["kind"]].commands:
            continue
        made = design(name, command=command)
        for table in made.outline(command).tables:
            columns = made.table(table, samples=2).columns
            assert [each for each in columns if not (column_words(each) or each in TERMS)] == [], table


@pytest.mark.parametrize(
    ("name", "units"),
    [
        ("lift_off_speed", "sheets/h; 1/min (disc-cam, measured-cam, wide-swing-cam)"),
        ("velocity_max", "mm/rad; 1 (disc-cam); mm/s (planar-mechanism)"),
        ("crank_length", "mm"),
    ],
)
def test_a_quantity_names_its_units_in_all_kinds(name: str, units: str) -> None:
    """Oscillating followers have angles, outputs of a planar mechanism real speeds, presses sheets."""
    assert next(topic for topic in find(name) if topic.about == "quantity").paragraphs["Unit"] == units


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("member_input", "at which its errors are evaluated"),
        ("output_error_at_print", "at register.at"),
        ("alone_removes", "fail only this check"),
        ("tip_thickness[0]", "tip_thickness"),
        ("teeth[1]", "teeth of gear 1 and 2"),
    ],
)
def test_columns_of_machines_and_studies_are_known(name: str, words: str) -> None:
    assert any(words in f"{topic.name} {topic.title}" for topic in find(name))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["ring_pair", "rack_drive", "rated_pair"])
def test_every_column_of_the_tables_of_a_gear_pair_has_words(name: str) -> None:
    made = design(name, command="gear")
    tables = made.extra_tables if made.rack is None else ("drawing", "path")
    for table in tables:
        if table in ("factors", "root") and made.spec.rating is None:
            continue
        columns = made.table(table).columns
        assert [each for each in columns if not (column_words(each) or each in TERMS)] == [], table


@pytest.mark.slow
def test_every_column_of_the_search_for_teeth_has_words(gearlink: Any) -> None:
    found = gearlink("gears", "--ratio", 3, "--center-distance", 120, "--format", "json").json
    columns = found["tables"]["candidates"]["columns"] if isinstance(found["tables"], dict) else found["columns"]
    assert "teeth1" in columns
    assert [each for each in columns if not (column_words(each) or each in TERMS)] == []


@pytest.mark.parametrize(
    ("name", "command", "tables"),
    [
        ("loaded_gripper", "loads", ("torque", "contact", "joints", "teeth", "frame", "harmonics")),
        ("loaded_press", "loads", ("torque", "contact", "joints", "teeth", "frame")),
        ("slider_crank_tolerances", "tolerance", ("allocation",)),
        ("sheet_press", "loads", ("torque", "wind_up")),
    ],
)
def test_every_column_that_is_asked_for_has_words(name: str, command: str, tables: tuple[str, ...]) -> None:
    more: dict[str, Any] = {}
    if command == "tolerance":
        section = worked(name)["tolerance"]
        section["sources"]["crank"]["grades"] = [4, 9]
        more = {"tolerance": section | {"samples": 64, "target_yield": 0.5}}
    made = design(name, command=command, **more)
    for table in tables:
        columns = made.table(table, samples=4).columns
        assert [each for each in columns if not (column_words(each) or each in TERMS)] == [], table


def test_a_key_in_capitals_is_the_key(gearlink: Any) -> None:
    """Not only the column of the same name."""
    assert gearlink("explain", "Rod").out == gearlink("explain", "rod").out
    assert "key of a design file" in gearlink("explain", "Module").out
