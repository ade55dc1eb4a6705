"""The glossary is whole, names what there is, and is found by every way of writing. No tolerances: words."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import pytest
from factory import DESIGNS

from gearlink.cli.commands.explain import find, plain_names
from gearlink.cli.glossary import folded, glossary, meanings, named_places, named_terms, places
from gearlink.cli.texts.codes import explanations
from gearlink.cli.texts.schema import known_keys, spec_keys
from gearlink.cli.views.figures.chart_list import CHARTS
from gearlink.core.base.kinds import FILES
from gearlink.core.base.nomenclature import TERMS
from gearlink.core.parts.cams.laws import law

KEYS_OF = {kind.name: {key.path for key in spec_keys(kind)} for kind in FILES.values()}
KEYS = {key.path for key, _ in known_keys()}
CHECKS = {check for rule in explanations().values() for check in rule.checks}
SHEETS = {"motion", "timing", "pressure", "drawing"}

FIELD = """
    transmission angle; pressure angle; dwell; dead centre; dead center; limit position; return stroke; prime
    circle; base circle; profile shift; contact ratio; undercut; backlash; tip clearance; addendum
    modification; polydyne; force closure; form closure; jump of the follower; register; gripper; front lay;
    feeder; dog; Geneva drive; Grashof; coupler curve; cognate; pole; centrode; pilgrim; pilgrim-step motion;
    progressive oscillation; back-step; instantaneous dwell; momentary dwell; non-uniform transmission;
    variable-speed; coefficient of speed fluctuation; pick-up position; impression cylinder; sheet transfer;
    handover; conjugate cams; primary and complementary cam; double-cam drive; cam-follower separation;
    force-closed; form-closed; positive drive; prime-circle radius; prime_radius; distribution; contributor;
    sensitivities; Pareto front; knee; toggle position; change point; overhung shaft; internal gear; ring
    gear; dimension over balls; diametral measurement; tip alteration; start of active profile; SAP; base
    tangent length; mating gear; clearance; intermittent gear; mutilated gear; geared linkage; geared four-bar
    mechanism; bed drive; cylinder drive; balancing device; crank; coupler; rocker; frame; crank-rocker;
    double-rocker; drag link; pitch curve; follower; lift; modified sine; 345; MCV; profile shift coefficient;
    working pressure angle; specific sliding; span measurement; flywheel; shaking force; energy fluctuation;
    preload; worst case; RSS; tip relief; plate cam; indexing; globoidal; translating; planetary;
    dwell-rise-dwell-return; reducer; Druckwinkel; Rast; Pilgerschritt; Kurbelschwinge; Doppelkurbel; Totlage;
    Übertragungswinkel; Uebertragungswinkel; Rollenmittelpunktsbahn; Vorgreifer; Vordermarke; Flankenspiel;
    Profilverschiebung; 传动角; 停歇; 根切; 槽轮机构
"""
FIELD += """;
    trace point; whole depth; circular pitch; diametral pitch; transverse module; crowning;
    application factor; Burmester; Gruebler; Freudenstein equation; mechanical advantage; snap;
    parabolic motion; double dwell; indexing table; bearer; Rastgetriebe; Kurbelwinkel;
    Zahnfußfestigkeit; Hubkurve; 曲柄摇杆; 间歇机构; blanket cylinder; forme; precision points
"""
FIELD += """;
    twin cam; balancing coefficient; K_y1; step angle; 联动凸轮组合机构; 凸轮-连杆组合机构; 凸轮-齿轮组合机构;
    平均角速度比; 曲柄滑块; 位移补偿量; 远休止; 近休止; 返程; 副凸轮; 递纸机构; 递纸摆动机构
"""
FIELD += """;
    oscillogram; 靠山; 凸轮反求; 偏心上摆式; 定心下摆式; 滚筒传动链; 平台传动链; 圆压平型印刷机; 圆压圆型印刷机;
    同步补偿凸轮机构; 递纸滚筒; 时间分配图; 实际轮廓; 咬纸; 机构主运动简图; 右推凸轮; 左推凸轮; 一端停歇;
    函数再现; 最大径向尺寸
"""
NAMES = [" ".join(name.split()) for name in FIELD.split(";")]


def test_the_twin_cam_of_a_wide_swing_is_no_pair_of_conjugate_cams() -> None:
    assert [term.name for term in named_terms("twin-cam")] == ["wide-swing cam"]
    assert "wide-swing-cam" not in glossary()["conjugate cams"].kinds


def test_there_are_terms_for_the_whole_field() -> None:
    assert len(glossary()) >= 100
    assert len(NAMES) == len(set(NAMES)) >= 100


@pytest.mark.quick(60)
@pytest.mark.parametrize("name", glossary())
def test_a_record_is_whole_and_names_what_there_is(name: str) -> None:
    term = glossary()[name]
    assert len(re.findall(r"\.(?= [A-Z]|$| gearlink)", term.definition)) == 2
    assert term.definition[0].isupper()
    assert term.german
    assert term.chinese
    assert all(re.search("[\u4e00-\u9fff]", each) for each in term.chinese)
    assert term.keys or term.quantities or term.checks or term.kinds or term.see
    assert set(term.keys) <= KEYS
    assert set(term.quantities) <= set(TERMS)
    assert set(term.checks) <= CHECKS
    assert set(term.kinds) <= set(FILES)
    assert set(term.see) <= set(glossary()) - {name}
    assert folded(name) not in map(folded, term.also)


@pytest.mark.parametrize("term", [term for term in glossary().values() if term.picture], ids=lambda term: term.name)
def test_a_picture_is_a_command_with_what_there_is(term: Any) -> None:
    program, command, *words = shlex.split(term.picture)
    assert program == "gearlink"
    if command == "synth":
        command = f"synth {words.pop(0)}"
    files = [word for word in words if word.endswith(".yaml")]
    assert all((DESIGNS.parent / file).is_file() for file in files)
    if command == "chart":
        assert words[0] in CHARTS
    elif command == "laws":
        assert all(law(words[i + 1]) for i, word in enumerate(words) if word == "--law")
    elif command == "sheet":
        assert {re.sub(r"-\d$", "", word) for word in words[1:]} <= SHEETS  # drawing-1 is that of the first cam
    else:
        kind = re.search(r"(?m)^kind: (\S+)", (DESIGNS.parent / files[0]).read_text())
        assert kind is not None
        assert command in FILES[kind[1]].commands
    assert command == "sheet" or words[-1] == "--plot"


def test_only_words_with_several_meanings_stand_twice() -> None:
    """A name leads to more than one term where the field itself uses it so."""
    known = Counter(spelled for term in glossary().values() for spelled in {folded(name) for name in term.names()})
    several = {
        "basecircle",
        "grundkreis",
        "基圆",
        "pressureangle",
        "压力角",
        "undercut",
        "undercutting",
        "unterschnitt",
    }
    several |= {"clearance", "hub", "ruck", "loadreversal", "totlage", "死点", "连杆"}
    assert {name for name, count in known.items() if count > 1} <= several


@pytest.mark.parametrize("name", NAMES)
def test_terms_of_the_field_are_found(name: str) -> None:
    """However they are written, and before anything of the program that bears the name."""
    assert named_terms(name)
    for spelled in (name.upper(), name.replace(" ", "_"), name.replace("-", " "), name.replace(" ", "")):
        assert [term.name for term in named_terms(spelled)] == [term.name for term in named_terms(name)]


@pytest.mark.parametrize(
    "name", ["dwell", "undercut", "register", "transmission-angle", "crank-rocker", "backlash", "stroke"]
)
def test_the_concept_comes_first_and_the_names_of_the_program_follow(name: str) -> None:
    about = [topic.about for topic in find(name)]
    assert about[0] == "term"
    assert len(set(about)) > 1
    assert about == sorted(about, key=lambda each: each != "term")


def test_explain_takes_several_words_with_and_without_quotes(gearlink: Any) -> None:
    ended = gearlink("explain", "transmission", "angle")
    assert ended.status == 0
    assert ended.out == gearlink("explain", "transmission angle").out
    assert ended.out == gearlink("explain", "Transmission_Angle").out
    assert "German: Übertragungswinkel" in ended.out
    as_json = gearlink("explain", "Druckwinkel", "--format", "json").json["topics"][0]
    assert (as_json["about"], as_json["name"]) == ("term", "pressure angle of a cam")
    assert as_json["picture"] == "`gearlink sheet designs/lift_cam.yaml pressure`"


def test_the_words_of_a_quantity_may_be_in_another_order(gearlink: Any) -> None:
    assert gearlink("explain", "angle back step").out.startswith("back_step_angle")


@pytest.mark.slow
def test_a_misspelled_term_has_its_neighbour(gearlink: Any) -> None:
    for wrong, near in (
        ("transmision angle", "transmission-angle"),
        ("Druckwinkl", "Druckwinkel"),
        ("centrod", "centrode"),
    ):
        ended = gearlink("explain", wrong)
        assert ended.status == 2
        assert f"nearest: {near}" in ended.err


# Figures and equations


@pytest.mark.parametrize("place", places(), ids=lambda place: f"{place.source}-{place.what}-{place.first}")
def test_places_lead_to_kinds_and_commands_that_there_are(place: Any) -> None:
    assert set(place.kinds) <= set(FILES)
    for command in place.commands:
        if command.startswith("chart "):
            assert command.removeprefix("chart ") in CHARTS
        elif command != "sheet":
            assert any(command in FILES[kind].commands for kind in place.kinds), command
    assert place.holds(place.first)
    assert place.holds(place.last)


@pytest.mark.parametrize(
    ("name", "source", "what", "command"),
    [
        ("(4-26)", "thesis", "equation", "synth momentary-dwell"),
        ("equation (4-26)", "thesis", "equation", "synth momentary-dwell"),
        ("eq. 4-31", "thesis", "equation", "synth momentary-dwell"),
        ("figure 2-4", "thesis", "figure", "analyze"),
        ("Fig. 4-5", "thesis", "figure", "chart back-step"),
        ("图4-5", "thesis", "figure", "chart back-step"),
        ("thesis (4-16)", "thesis", "equation", "synth back-step"),
        ("dissertation (18)", "wide-swing dissertation", "equation", "cam"),
        ("TY-460 3.2", "TY-460 report", "section", "press"),
        ("paper (5)", "swing-gripper paper", "equation", "gripper"),
        ("Gl. 4-26", "thesis", "equation", "synth momentary-dwell"),
        ("Bild 4-5", "thesis", "figure", "chart back-step"),
        ("例1", "thesis", "example", "synth back-step"),
        ("Example 2", "thesis", "example", "synth variable-speed"),
        ("section 4.2.3", "thesis", "section", "synth momentary-dwell"),
    ],
)
def test_a_place_of_a_source_leads_to_its_command(name: str, source: str, what: str, command: str) -> None:
    found = [(place.source, place.what) for _, place in named_places(name)]
    assert found == [(source, what)]
    assert any(command in place.commands for _, place in named_places(name))


def test_every_equation_and_figure_with_a_mechanism_of_the_thesis_is_known() -> None:
    assert all(list(named_places(f"(4-{number})")) for number in range(1, 34))
    assert all(list(named_places(f"figure 2-{number}")) for number in range(1, 8))
    assert all(list(named_places(f"figure 4-{number}")) for number in range(1, 11))
    assert all(list(named_places(f"dissertation ({number})")) for number in range(1, 28))
    assert list(named_places("(4-34)")) == list(named_places("345")) == list(named_places("12")) == []


def test_an_equation_names_the_quantities_that_cite_it(gearlink: Any) -> None:
    topic = gearlink("explain", "(4-16)", "--format", "json").json["topics"][0]
    assert topic["quantities"] == "back_step_angle"
    assert topic["kinds"] == "three-gear-four-bar"


# Keys


def test_the_range_of_a_key_of_several_sections_has_them_all(gearlink: Any) -> None:
    assert "Range: pneumatic or spring" in gearlink("explain", "unloader.type").out


def test_no_term_is_named_as_a_code() -> None:
    assert not {folded(name) for term in glossary().values() for name in term.names()} & {
        folded(name) for name in plain_names() if name.startswith("GL")
    }


def test_words_of_other_tools_name_keys_of_their_kinds() -> None:
    for meaning in meanings():
        assert meaning.keys or meaning.quantities or meaning.says
        assert set(meaning.quantities) <= set(TERMS)
        assert meaning.kinds or meaning.section in KEYS
        for kind in meaning.kinds:
            assert set(meaning.keys) <= KEYS_OF[kind], (meaning.words, kind)


def test_nothing_reads_the_glossary_before_it_is_asked_for() -> None:
    """No module imports it at its head, and a code is explained without it."""
    heads = [
        path for path in (DESIGNS.parent / "cli").rglob("*.py") if "\nfrom gearlink.cli.glossary" in path.read_text()
    ]
    assert heads == []
    probe = "import sys\nfrom gearlink.cli.commands.explain import find\nassert find('gl301')\n"
    probe += "assert 'gearlink.cli.glossary' not in sys.modules"
    subprocess.run([sys.executable, "-c", probe], check=True, cwd=DESIGNS.parent)


@pytest.mark.quick(3)
@pytest.mark.parametrize(
    ("symbol", "name"),
    [
        ("K_A", "application factor"),
        ("K_gamma", "mesh load factor"),
        ("\u03b5_\u03b1", "eps_alpha"),
        ("\u03b1_wt", "alpha_wt"),
        ("\u03c3_Hlim", "sigma_Hlim"),
        ("K_H\u03b2", "face load factor"),
        ("\u03c6\u2081\u2083", "phi13"),
    ],
)
def test_symbols_are_found_as_figures_print_them(gearlink: Any, symbol: str, name: str) -> None:
    """Greek letters, as every figure has them, were unknown, and so were symbols that a term alone has."""
    assert gearlink("explain", symbol, "--format", "json").json["topics"][0]["name"] == name


@pytest.mark.parametrize(
    "place", [place for place in places() if place.what == "example"], ids=lambda place: place.first
)
def test_examples_of_the_thesis_name_their_design_files(gearlink: Any, place: Any) -> None:
    assert gearlink("explain", f"example {place.first}").status == 0
    file = place.says.split("; ")[-1].removeprefix("designs/")
    assert (DESIGNS / file).is_file()


@pytest.mark.parametrize(
    ("line", "help"),
    [
        ("motion: [{for: 90, lift: 5}, {to: 360, lift: 0}]", "write `to`, the angle at its end, counted from 0"),
        ("cam: {prime_radius: 70, bore: 30}", "write `shaft_radius` in `cam`, half of it"),
        ("follower: {type: oscillating-roller, arm_length: 95}", "write `arm` in `follower`"),
        ("follower: {type: oscillating-roller, pivot: [130, 0]}", "write `center_distance` and `pivot_direction`"),
        ("motion: [{to: 90, lift: 5}, {to: 60}, {to: 360, lift: 0}]", "set motion[1].to to 225"),
    ],
)
def test_words_of_a_cam_designer_lead_to_their_keys(gearlink: Any, tmp_path: Path, line: str, help: str) -> None:
    """They were answered with the list of all keys."""
    other = {
        "motion": "motion: [{to: 90, lift: 5, law: cycloidal}, {to: 360, lift: 0, law: cycloidal}]",
        "follower": "follower: {type: oscillating-roller, arm: 95, center_distance: 130, roller_radius: 14}",
        "cam": "cam: {prime_radius: 70}",
    } | {line.partition(":")[0]: line}
    file = tmp_path / "cam.yaml"
    file.write_text("\n".join(["kind: disc-cam", *other.values()]))
    ended = gearlink("cam", str(file))
    assert ended.status == 2
    assert help in ended.err


@pytest.mark.parametrize(
    ("kind", "line", "help"),
    [
        ("swing-gripper", "links: {AC: 150, CD: 260, ED: 100}", "write `input: 150` in `links`"),
        ("swing-gripper", "links: {l1: 150, l3: 260, l4: 100}", "one of the links AC and ED; the paper does not say"),
        ("swing-gripper", "phases: {theta_A1: 100}", "write the length of each phase in `phases`"),
        ("gear-pair", "bore: 30", "write `bore: 30` in `rating`"),
        ("wide-swing-cam", "phi: 120", "write `cycle_angle: 120`"),
        ("wide-swing-cam", "cam: {a: 200, r_p: 8}", "write `center_distance: 200` in `cam`"),
        ("three-gear-four-bar", "back_step: {phi5: 20, phi12: 90}", "write `angle: 20` in `back_step`"),
    ],
)
def test_symbols_of_the_sources_lead_to_their_keys(
    gearlink: Any, tmp_path: Path, kind: str, line: str, help: str
) -> None:
    """They were answered with the list of all keys."""
    file = tmp_path / "source.yaml"
    file.write_text(f"kind: {kind}\n{line}\n")
    assert help in gearlink("analyze", str(file)).err
