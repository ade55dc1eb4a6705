"""One word, one meaning, one unit: the nomenclature against every kind's outlines and against the contract.

No tolerance: names and units are text.
"""

import json
import re
from collections import Counter
from pathlib import Path

import pytest

import gearlink
from gearlink.core.base import nomenclature
from gearlink.core.base.design import Design
from gearlink.core.base.errors import GearlinkError
from gearlink.core.base.kinds import KINDS
from gearlink.core.base.nomenclature import TERMS, Term, term
from gearlink.core.parts.gears.checks import GEAR_CHECKS

REFERENCE = Path(__file__).parents[1] / "reference" / "contract"
DESIGNS = Path(__file__).parents[2] / "designs"
UNITS = {
    "kg",
    "kg m^2",
    "kg/mm",
    "N/(mm um)",
    "deg C",
    "W",
    "J",
    "N/mm^2",
    "kg mm",
    "Hz",
    "h",
    "ms",
    "um",
    "mm",
    "deg",
    "1",
    "mm/s",
    "mm/s^2",
    "mm^6",
    "mm/rad",
    "mm/rad^2",
    "mm/rad^3",
    "rad/s",
    "rad/s^2",
    "1/min",
    "N",
    "N/mm",
    "N m",
    "sheets/h",
}
OUTLINES = [
    pytest.param(kind.design_class(command).outlines[command], id=f"{kind.name} {command}")
    for kind in KINDS.values()
    for command in kind.commands
]
# Angles and lengths whose unit scripts depend on, as they stand in the contract.
FIXED = {
    "i3": "1",
    "crank_length": "mm",
    "frame_length": "mm",
    "dwell_crank_angles": "deg",
    "back_step_angle": "deg",
    "min_transmission_angle": "deg",
    "gear_gap": "mm",
    "nonuniformity": "1",
    "working_pressure_angle": "deg",
    "tip_thickness": "mm",
    "span_measurement": "mm",
    "contact_ratio": "1",
    "quick_return_ratio": "1",
    "dead_center_extended": "deg",
    "max_stroke": "mm",
    "sync_start": "deg",
    "cam_sync_end": "deg",
    "compensation": "mm",
    "end_slope": "mm/rad",
    "transition_rise": "mm",
    "return_end": "deg",
    "roller_center_distance": "mm",
    "max_pressure_angle": "deg",
    "min_curvature_radius": "mm",
    "handover_speed": "mm/s",
    "lift_off_speed": "sheets/h",
    "force": "N",
    "spring_rate": "N/mm",
    "phase_angle": "deg",
    "profile_correction": "deg",
    "transition_zone": "1",
}


@pytest.mark.parametrize("outline", OUTLINES)
def test_every_quantity_of_an_outline_has_its_term(outline):
    for name in outline.quantities:
        assert term(name).words, name


@pytest.mark.parametrize("outline", OUTLINES)
def test_an_outline_names_nothing_twice(outline):
    for names in (outline.quantities, outline.checks, outline.tables):
        assert [name for name, count in Counter(names).items() if count > 1] == []


# Letters of two standards or sources, of quantities that no command gives side by side.
TWO_SOURCES = {
    frozenset(pair.split())
    for pair in (
        "nonuniformity speed_fluctuation",
        "phase speed_fluctuation",
        "tangential_force tooth_force_max",
        "cam_sync_end dead_center_extended",
        "base_radius cam_base_radius",
        "energy_parameter samples",
        "equivalent force",
        "five_bar_ratio span_teeth",
        "input_length reference_center_distance",
        "reference_radius rocker_radius",
        "follower_length tip_clearance",
        "point_radius reference_radius",
    )
}


@pytest.mark.parametrize("kind", KINDS.values(), ids=lambda kind: kind.name)
def test_a_symbol_stands_for_one_quantity_of_a_kind(kind):
    of_symbol = {}
    for command in kind.commands:
        for name in kind.design_class(command).quantity_names():
            last = name.rpartition(".")[2]
            of_symbol.setdefault(term(last).symbol, set()).add(last)
    shared = {symbol: names for symbol, names in of_symbol.items() if symbol and len(names) > 1}
    assert {symbol: names for symbol, names in shared.items() if names not in TWO_SOURCES} == {}


@pytest.mark.parametrize("outline", OUTLINES)
def test_a_symbol_stands_for_one_quantity_of_a_command_those_of_its_meshes_too(outline):
    of_symbol = {}
    for name in outline.quantities:
        last = name.rpartition(".")[2]
        of_symbol.setdefault(term(last).symbol, set()).add(last)
    assert [names for symbol, names in of_symbol.items() if symbol and len(names) > 1] == []


def test_units_are_spelled_as_in_the_contract():
    assert {name: entry.unit for name, entry in TERMS.items() if entry.unit not in UNITS} == {}


@pytest.mark.parametrize(("name", "unit"), FIXED.items())
def test_unit_that_scripts_depend_on(name, unit):
    assert term(name).unit == unit


def test_no_meaning_has_two_names():
    words = Counter(entry.words.casefold().strip(" .") for entry in TERMS.values())
    assert [meaning for meaning, count in words.items() if count > 1] == []


def test_every_term_names_a_result_of_the_engine():
    engine = Path(nomenclature.__file__).parents[1]
    used = {
        word
        for path in engine.rglob("*.py")
        if path.name not in ("nomenclature.py", "terms.py")
        for word in re.findall(r"\w+", path.read_text())
    }
    stems = {name: re.sub(r"_(max|min)(_at)?$", "", name) for name in TERMS}  # of a curve's extremes, made of its name
    assert {name for name, stem in stems.items() if not {name, stem} & used} == set()


@pytest.mark.parametrize("file", sorted(REFERENCE.glob("*.json")), ids=lambda path: path.stem)
def test_quantities_of_the_contract_have_terms(file):
    for case in json.loads(file.read_text()):
        for name in case.get("quantities", {}):
            assert isinstance(term(name), Term), name


def test_names_are_words_and_not_symbols():
    for name in TERMS:
        assert name == name.lower()
        assert name.isidentifier()
        assert name in ("i3", "rss", "gap") or len(name) > 3


def test_mesh_before_the_name_does_not_matter():
    assert term("crank_idler.contact_ratio") is term("contact_ratio")


@pytest.mark.parametrize("name", ["", "contact", "contact_ratio.crank_idler", "Contact_ratio"])
def test_unknown_name(name):
    with pytest.raises(GearlinkError, match="no nomenclature entry"):
        term(name)


# Kinds


@pytest.mark.parametrize("name", KINDS)
def test_kind_and_its_models_bear_one_name(name):
    kind = KINDS[name]
    assert kind.name == name
    assert kind.spec_model().model_fields["kind"].annotation.__args__ == (name,)
    for command in kind.commands:
        cls = kind.design_class(command)
        assert cls.kind == (name if kind.commands[command] else "")  # one class serves all kinds
        assert command in cls.outlines


@pytest.mark.parametrize("name", KINDS)
def test_every_check_and_table_of_an_outline_exists(name):
    for command in KINDS[name].commands:
        cls = KINDS[name].design_class(command)
        outline = cls.outlines[command]
        for check in outline.checks:
            own = check in GEAR_CHECKS or hasattr(cls, "check_" + check.replace("-", "_"))
            assert own or cls.check is not Design.check, check
        for table in (*outline.tables, *cls.extra_tables):
            assert hasattr(cls, f"table_{table}"), table


def test_every_kind_can_be_analysed():
    assert all("analyze" in kind.commands for kind in KINDS.values())


# Words that say something of themselves

_FILLERS = {"of", "the", "a", "an", "on", "in", "per", "and", "to", "at", "for", "by", "s", "with"}
_POINTING = r"(it|its|that|this|these|those|they|their|which|what|how|where|when|whether|to)\b"
_AS_ABOVE = r"\bthat (interval|iteration|size|chord|dyad|mesh|circle|passes)\b|\bat which (it|that)\b|does so|\bof it\b"


def _parts(text: str) -> set[str]:
    """The words of a text, plurals as one, spelled as names are."""
    words = re.findall(r"[a-z]+", text.lower().replace("centre", "center"))
    return {word.removesuffix("s") if len(word) > 3 else word for word in words} - _FILLERS


def test_a_term_needs_neither_its_name_nor_its_neighbour() -> None:
    """It says more than its name, and speaks of nothing that stands above it in a table."""
    words = {name: each.words for name, each in TERMS.items()}
    assert [name for name, said in words.items() if _parts(said) <= _parts(name)] == []
    assert [name for name, said in words.items() if re.match(_POINTING, said)] == []
    assert [name for name, said in words.items() if re.search(_AS_ABOVE, said)] == []


def test_no_quantity_is_overwritten_by_another_of_its_name() -> None:
    """`TERMS` is put together from tables, of which the last would win; a kind's own stand in its record."""
    tables = [
        (name, table)
        for name, table in vars(nomenclature).items()
        if isinstance(table, dict) and name not in ("TERMS", "STEPPING", "ALIASES") and name[:2] != "__"
    ]
    owners = Counter(name for _, table in tables for name in table)
    assert len(tables) > 20
    assert set(owners) == set(TERMS)
    assert [name for name, count in owners.items() if count > 1] == []


@pytest.mark.parametrize(
    ("file", "name", "words"),
    [
        ("slider_crank_quick_return", "return_angle", "input angle of the slider's stroke towards the crank's axis"),
        ("swing_gripper", "return_angle", "angle of the input in the return"),
        ("mutilated_gear_times", "cycle_turns", "input revolutions per output cycle"),
        ("sheet_press", "cycle_turns", "revolutions of the main shaft until all motions repeat"),
        ("five_bar_path", "phase", "direction of the output link at input angle 0; of the coupler where a function is"),
    ],
)
def test_a_quantity_means_what_it_is_in_its_kind(file: str, name: str, words: str) -> None:
    quantity = gearlink.load(DESIGNS / f"{file}.yaml").quantity(name)
    assert quantity is not None
    assert quantity.words.startswith(words)
