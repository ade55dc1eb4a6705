"""What is wrong with the names and joints of a file is said at its key, before anything is computed."""

from __future__ import annotations

import copy
from typing import Any

import pytest
from oracles.planar_zoo import PLANET, QUICK_RETURN, RACK_ON_LINK, WATT

from gearlink.cli.opening import design
from gearlink.cli.reading.design_file import parse, validate
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.kinds import KINDS


def refusal(file: dict[str, Any]) -> tuple[str, str, str]:
    """Code, key and message with help of the first error of a file."""
    import json

    text = json.dumps({"kind": "planar-mechanism", "name": "one", **file}, indent=1)
    with pytest.raises(DesignFileError) as found:
        validate(parse(text.encode(), "one.yaml"), KINDS["planar-mechanism"].spec_model())
    first = found.value.diagnostics[0]
    return first.code, first.key, f"{first.message}\n{first.help}"


def changed(base: dict[str, Any], path: str, value: Any) -> dict[str, Any]:
    """A file with another value at a path; None leaves the key out."""
    made = copy.deepcopy(base)
    *way, last = path.split("/")
    place = made
    for step in way:
        place = place[step]
    if value is None:
        del place[last]
    else:
        place[last] = value
    return made


SLIDER_CRANK: dict[str, Any] = {
    "frame": {"A": [0, 0]},
    "links": {"crank": ["A", "B", 40], "rod": ["B", "C", 140], "piston": {"C": [0, 0]}},
    "slides": {"guide": {"link": "piston", "on": "frame", "through": [0, 10], "direction": 0}},
    "drive": {"link": "crank"},
    "start": {"crank": 0, "rod": 0, "guide": 180},
}


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("outputs", "shown"),
    [
        (["piston"], ["guide"]),
        (["guide", "piston"], ["guide"]),
        (["C", "piston"], ["C", "guide"]),
        (None, ["rod", "guide"]),
    ],
)
def test_a_link_that_only_slides_is_shown_as_its_slide(outputs: list[str] | None, shown: list[str]) -> None:
    """Its direction never changes: every row of it would be 0."""
    made: Any = design(kind="planar-mechanism", **{**SLIDER_CRANK, "outputs": outputs})
    assert made.spec.shown == shown
    assert made.quantity("guide.stroke").value == pytest.approx(80.22, abs=0.01)


@pytest.mark.parametrize("crank", [{"B": [40, 0]}, ["X", "B", 40]])
def test_a_link_that_one_pin_holds_is_named(crank: Any) -> None:
    made: Any = design(kind="planar-mechanism", **changed(SLIDER_CRANK, "links/crank", crank))
    with pytest.raises(NoSolution, match="3 degrees of freedom and 1 drive") as refused:
        made.report("analyze")
    assert refused.value.fix == "give crank a second point that the frame or another link has, or a slide"


@pytest.mark.parametrize(
    ("base", "path", "value", "code", "key", "words"),
    [
        (WATT, "drive", {"link": "cranc"}, "GL111", "drive.link", "did you mean crank"),
        (WATT, "start/arm", None, "GL106", "start.arm", "rough direction"),
        (WATT, "start/nobody", 3, "GL111", "start.nobody", "no link or slide"),
        (WATT, "links/arm", ["E", "G", "H"], "GL111", "links.arm[2]", "length in mm"),
        (WATT, "links/arm", ["E", 3, 120], "GL111", "links.arm[1]", "name its points"),
        (WATT, "links/arm", ["E", "E", 120], "GL111", "links.arm[1]", "name two"),
        (WATT, "links/free", ["X", "Y", 120], "GL106", "start.free", "no start"),
        (WATT, "links/input", ["E", "Z", 10], "GL111", "links.input", "is reserved"),
        (WATT, "outputs", ["output", "output"], "GL111", "outputs[1]", "twice"),
        (WATT, "shafts", {"X_radius": 3}, "GL111", "shafts.X_radius", "point of the frame"),
        (WATT, "range", {"start": 5, "end": 5}, "GL111", "range.end", "ends before it starts"),
        (QUICK_RETURN, "slots/slot/point", "Z", "GL111", "slots.slot.point", "no body has a point"),
        (QUICK_RETURN, "slides/guide/link", "ramm", "GL111", "slides.guide.link", "did you mean ram"),
        (QUICK_RETURN, "slides/guide/on", "ram", "GL111", "slides.guide.on", "cannot slide on itself"),
        (QUICK_RETURN, "start/ram", 90, "GL111", "start.ram", "give the position of guide"),
        (QUICK_RETURN, "drive", {"link": "ram"}, "GL111", "drive.link", "give slide: guide"),
        (QUICK_RETURN, "drive", {"slide": "guide"}, "GL106", "range", "needs a range"),
        (PLANET, "meshes/ring/teeth", [20, -18], "GL111", "meshes.ring.teeth", "more teeth"),
        (PLANET, "meshes/ring/at", ["P", "A"], "GL111", "meshes.ring.at", "no body has both points"),
        (RACK_ON_LINK, "meshes/teeth/side", None, "GL106", "meshes.teeth.rack", "side is missing"),
        (RACK_ON_LINK, "meshes/teeth/pinion", "bar", "GL111", "meshes.teeth.at", "bar has no point"),
    ],
)
def test_what_is_wrong_is_said_at_its_key(
    base: dict[str, Any], path: str, value: Any, code: str, key: str, words: str
) -> None:
    found = refusal(changed(base, path, value))
    assert found[:2] == (code, key)
    assert words in found[2]


def test_a_link_that_hangs_on_nothing() -> None:
    file = changed(WATT, "links/free", ["X", "Y", 120])
    code, key, words = refusal({**file, "start": {**file["start"], "free": 0}})
    assert (code, key) == ("GL111", "links.free")
    assert "is not connected" in words


def test_a_start_is_no_size_that_scatters() -> None:
    code, _, words = refusal({**WATT, "tolerance": {"sources": {"start.crank": {"plus_minus": 1}}}})
    assert code == "GL170"
    assert "not a size of a part" in words


@pytest.mark.parametrize(
    ("name", "valid"), [("upper bar", "upper_bar"), ("2te Stange", "n2te_Stange"), ("Fuß-2", "Fuss_2"), ("连杆", "n")]
)
def test_a_name_that_is_not_valid_says_one_that_is(name: str, valid: str) -> None:
    """It was refused without a word on what to write."""
    code, _, text = refusal(changed(WATT, "links", {**WATT["links"], name: ["A", "B", 20.0]}))
    assert (code, text.splitlines()[1]) == ("GL108", f"write {valid}")
    assert "letters a to z, digits and _" in text
