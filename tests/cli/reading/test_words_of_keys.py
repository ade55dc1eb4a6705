"""Whoever types the words of the field as keys is led to the key of that kind. No tolerances: words."""

from __future__ import annotations

import copy
import json
from typing import Any

import pytest
import yaml

from gearlink.cli.glossary import Meaning, folded, meaning_in, meanings
from gearlink.cli.reading.design_file import parse, validate
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.texts.schema import spec_keys, worked_design
from gearlink.core.base.kinds import FILES

WORKED = {name: yaml.safe_load(worked_design(kind)) for name, kind in FILES.items()}
CASES = [(kind, meaning) for meaning in meanings() for kind in meaning.kinds]


def told(data: dict[str, Any]) -> list[Diagnostic]:
    """What is wrong with a design file."""
    with pytest.raises(DesignFileError) as caught:
        validate(parse(json.dumps(data).encode(), "a.yaml"), FILES[data["kind"]].spec_model())
    return caught.value.diagnostics


def without(data: dict[str, Any], path: str) -> dict[str, Any]:
    changed = copy.deepcopy(data)
    *sections, last = path.split(".")
    section = changed
    for step in sections:
        section = section.get(step, {})
    section.pop(last, None)
    return changed


@pytest.mark.quick(5)
@pytest.mark.parametrize(("kind", "meaning"), CASES, ids=[f"{kind}-{meaning.words[0]}" for kind, meaning in CASES])
def test_a_word_names_the_key_of_its_kind(kind: str, meaning: Meaning) -> None:
    """On top of a file and in the section of the key; that the key is missing is not said as well."""
    value: Any = [20, 40, 60][: len(meaning.keys)] if meaning.each else 7.5
    sections = {"", *(key.rpartition(".")[0] for key in meaning.keys if key.count(".") == 1)}
    known = {key.path for key in spec_keys(FILES[kind])}
    for word in meaning.words:
        for section in sections:
            of_section = (path.rpartition(".")[2] for path in known if path.rpartition(".")[0] == section)
            if folded(word) in map(folded, of_section):
                continue
            data = WORKED[kind]
            for key in meaning.keys:
                data = without(data, key)
            data = copy.deepcopy(data)
            inner = data.setdefault(section, {}) if section else data
            if not isinstance(inner, dict):
                continue
            inner[word] = value
            wrong = told(data)
            (found,) = [each for each in wrong if each.key == ".".join(filter(None, (section, word)))]
            assert found.code == "GL105"
            assert found.help.startswith(f"{word} is {meaning.means}")
            assert len(found.help) <= 240
            here = [key for key in meaning.keys if section and key.startswith(f"{section}.")] or meaning.keys
            if not meaning.says and here:
                written = [f"`{key.rpartition('.')[2]}: " for key in (meaning.keys if meaning.each else here)]
                assert any(line in found.help for line in written)
                assert "7.5`" in found.help or meaning.each
            assert all(f"quantity `{name}`" in found.help for name in meaning.quantities)
            missing = {each.key for each in wrong if each.code == "GL106"}
            assert missing.isdisjoint(meaning.keys)


@pytest.mark.parametrize(
    ("kind", "section", "word", "value", "help"),
    [
        ("three-gear-four-bar", "links", "e", 28, "e is the crank length here: write `crank: 28` in `links`"),
        ("three-gear-four-bar", "dwell", "E", 28, "E is the crank length here: write `crank: 28` in `dwell`"),
        ("three-gear-four-bar", "gears", "tooth-counts", [20, 21, 60],
         "tooth-counts is one number of teeth for each gear here: "
         "write `crank: 20`, `idler: 21`, `output: 60` in `gears`"),
        ("three-gear-four-bar", "gears", "teeth", [20, 60],
         "teeth is one number of teeth for each gear here: write `crank: ...`, `idler: ...`, `output: ...` in `gears`"),
        ("slider-crank", "", "eccentricity", 50,
         "eccentricity is the offset of the slide line here: write `offset: 50` at the top level of the file"),
        ("flatbed-press", "bed", "eccentricity", 50,
         "eccentricity is the offset of the slide line here: write `offset: 50` in `bed`"),
        ("flatbed-press", "cam", "r0", 65,
         "r0 is the radius from the cam axis to the roller centre at zero lift here: write `base_radius: 65` in `cam`"),
        ("hypocycloid-dwell", "", "stroke", 160, "stroke is a result: it follows from the gears: quantity `stroke`"),
        ("swing-gripper", "", "dwell_angle", 60,
         "dwell_angle is the cylinder angle of a dwell here: write `near_dwell: 60` or `far_dwell: 60` in `phases`"),
        ("crank-rocker", "", "time_ratio", "1,2",
         "time_ratio is the time ratio of the strokes here: write `quick_return_ratio: ...` in `swing`"),
        ("gear-pair", "", "Zähnezahl", [20, 40], "Zähnezahl is the number of teeth: write `teeth`"),
        ("gear-pair", "", "模数", 3, "模数 is the module: write `module`"),
        ("crank-rocker", "", "Schwinge", 60, "Schwinge is the rocker: write `links.rocker`"),
        ("crank-rocker", "swing", "Gestell", 100, "Gestell is the frame: write `frame`"),
    ],
)  # fmt: skip
def test_the_help_has_the_value_of_the_file(kind: str, section: str, word: str, value: Any, help: str) -> None:
    data = copy.deepcopy(WORKED[kind])
    inner = data.setdefault(section, {}) if section else data
    inner[word] = value
    assert help in [each.help for each in told(data)]


def test_the_key_of_a_translated_word_is_not_said_to_be_missing_as_well() -> None:
    wrong = told({"kind": "gear-pair", "Modul": 3, "Zähnezahl": [20, 40], "profile_shift": [0, 0]})
    assert [(each.code, each.key) for each in wrong] == [("GL105", "Modul"), ("GL105", "Zähnezahl")]


def test_a_key_of_a_section_is_no_misspelled_one_beside_it() -> None:
    """`angle` at the top level is that of `swing`, not `range`, though four of their five letters are the same."""
    helps = [each.help for each in told({"kind": "crank-rocker", "angle": 60})]
    assert any(help.startswith("it belongs to 'swing'") for help in helps)


def test_a_key_misspelled_in_its_own_section_is_that_key() -> None:
    """And masses have letters of their own."""
    data = copy.deepcopy(WORKED["gear-pair"]) | {"Teeth": [17, 40]}
    assert told(data)[0].help.startswith("did you mean 'teeth'?")
    data = copy.deepcopy(WORKED["three-gear-four-bar"]) | {"loads": {"links": {"crank": {"m": 2}}}}
    assert all("module" not in each.help for each in told(data) if each.key == "loads.links.crank.m")


def test_a_runout_in_tolerance_leads_to_the_source() -> None:
    data = copy.deepcopy(WORKED["slider-crank"]) | {"tolerance": {"eccentricity": 0.02, "sources": {}}}
    (found,) = [each for each in told(data) if each.key == "tolerance.eccentricity"]
    assert "`gears.NAME: {eccentricity: 0.01}` in `tolerance.sources`" in found.help


CARD = ("module", "teeth", "tooth_counts", "z1", "eccentricity", "stroke", "dwell_angle", "ratio", "i")
CARD += ("prime_radius", "base_radius", "offset")


@pytest.mark.quick(8)
@pytest.mark.parametrize("kind", FILES)
def test_a_word_of_the_card_leads_on_in_every_kind(kind: str) -> None:
    """To keys or results of the kind, to the section that has the key, or to the kinds that have such a thing."""
    words = [word for word in CARD if word not in WORKED[kind]]
    known = {key.path for key in spec_keys(FILES[kind])}
    for found in told(WORKED[kind] | dict.fromkeys(words, 7.5)):
        if found.key not in words or found.key in known:
            continue
        to_kinds = f"{kind} has no {found.key}: kinds that have it: " in found.help
        assert to_kinds or found.help.startswith((f"{found.key} is ", "it belongs to '")), found.help
        belongs = found.help.partition(";")[0] if found.help.startswith("it belongs") else ""
        assert not any(name in belongs for name in ("rating", "tolerance", "loads"))


def test_a_key_of_another_form_of_its_section_is_not_recommended_again() -> None:
    assert meaning_in("offset", "disc-cam", ("follower",)) is None
    assert meaning_in("offset", "disc-cam", ("cam",)) is not None


@pytest.mark.parametrize(
    ("kind", "key", "help"),
    [
        ("two-gear-four-bar", "planet", "an internal gear is written by `ring` (teeth z5 of an internal output gear"),
        ("geared-five-bar", "input", "an internal gear is written by `ring` (function: "),
        ("hypocycloid-dwell", "ring", "allowed: from 1"),
        ("geared-rocker", "output", "allowed: from 1"),
    ],
)
def test_negative_teeth_lead_to_the_key_of_a_ring(kind: str, key: str, help: str) -> None:
    data = copy.deepcopy(WORKED[kind])
    data["gears"][key] = -40
    (found,) = [each for each in told(data) if each.key == f"gears.{key}"]
    assert found.help.startswith(help)


@pytest.mark.parametrize("word", ["tolerance", "tol", "deviation"])
def test_the_limits_of_a_source(word: str) -> None:
    """`tolerance` was taken for a slip of `clearance`."""
    data = {**WORKED["slider-crank"], "tolerance": {"sources": {"rod": {word: 0.05}}}}
    (found,) = told(data)
    assert "write `plus_minus: 0.02`, `lower` and `upper`, or a `grade` of ISO 286" in found.help


@pytest.mark.parametrize(
    ("kind", "word", "key"),
    [
        ("gear-pair", "centre_distance", "center_distance"),
        ("gear-pair", "a", "center_distance"),
        ("gear-pair", "beta", "helix_angle"),
        ("slider-crank", "connecting_rod", "rod"),
        ("slider-crank", "r", "crank"),
        ("crank-rocker", "K", "quick_return_ratio"),
        ("geneva-drive", "pin_diameter", "pin_radius"),
    ],
)
def test_letters_of_textbooks(kind: str, word: str, key: str) -> None:
    assert f"`{key}" in next(each.help for each in told({**WORKED[kind], word: 7.5}) if each.key == word)


@pytest.mark.parametrize(("kind", "path"), [("cylindrical-cam", "follower.type"), ("geneva-drive", "type")])
def test_a_missing_word_is_named_though_it_be_the_only_one(kind: str, path: str) -> None:
    (found,) = told(without(WORKED[kind], path))
    assert found.help.endswith("(translating-roller)" if kind == "cylindrical-cam" else "(external or internal)")
