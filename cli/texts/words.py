"""What columns of tables and constants mean, and the formulas of quantities: the words of `words.json`.

A column that bears the name of a quantity is that quantity, place by place. Formulas are in the symbols of
`gearlink.core.base.nomenclature`; where a name serves several kinds of design, each has its part. Inputs have none.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

_WORDS: dict[str, dict[str, str]] = json.loads((Path(__file__).parent / "words.json").read_text(encoding="utf-8"))
COLUMNS, CONSTANTS, FORMULAS = (_WORDS[name] for name in ("columns", "constants", "formulas"))
_ROLLER = {
    "force": "force between cam and roller",
    "pressure": "Hertzian pressure between cam and roller",
    "radius": "relative radius of curvature of cam and roller, 1/(1/roller + 1/cam)",
    "roller_speed": COLUMNS["roller_speed"],
    "entrainment": COLUMNS["entrainment"],
    "cam_angle": COLUMNS["cam_angle"],
    "input_torque": COLUMNS["input_torque"],
}
_ROLLERS = {"main": "the main cam", "return": "the return cam"}
_OF_ROLLER = re.compile(rf"(?P<cam>main|return)_(?P<part>{'|'.join(_ROLLER)})")
_PLACE = re.compile(r"(?P<axis>[xy])_(?P<pin>[A-Z])")
_COUPLER = re.compile(r"coupler_(?P<number>[123])_(?P<rest>\w+)")
_FORCE = re.compile(r"(?P<pin>[A-Z]|[A-Z]_[a-z]+|planet|cylinder|guide|guide_[a-z]+?)_(?P<part>x|y)")
_JOINT = re.compile(r"[A-HMNO]|[A-O]_(sum|return|idler|output|pinion)|planet|cylinder|guide(_[a-z]+)?")
_MESH = re.compile(r"(mesh_\w+?|rack_lower|rack_upper)(_radial)?")


def column_words(name: str) -> str:
    """What a column means; empty where nothing is said of it.

    Example
        >>> column_words("mesh_13")
        'tangential force in that mesh, signed; of a column ..._radial the radial one'
    """
    if name in COLUMNS:
        return COLUMNS[name]
    if name.removesuffix("_pm") in COLUMNS:
        return f"half-width of the 95 % interval of {name.removesuffix('_pm')}"
    if found := _PLACE.fullmatch(name):
        return f"{found['axis']} of the pin {found['pin']}"
    if found := _COUPLER.fullmatch(name):
        words = COLUMNS.get(f"coupler_{found['rest']}", "")
        return words.replace("coupler", f"coupler {('BC', 'CD', 'DE')[int(found['number']) - 1]} of a six-bar")
    if found := _OF_ROLLER.fullmatch(name):
        return f"{_ROLLER[found['part']]}, of {_ROLLERS[found['cam']]}"
    if found := _FORCE.fullmatch(name):
        if found["pin"].endswith("_sum"):
            return f"{found['part']} component of the forces of the frame on all shafts about {found['pin'][0]}"
        return f"{found['part']} component of the force at the pin {found['pin']} on the second body named there"
    if _MESH.fullmatch(name):
        return "tangential force in that mesh, signed; of a column ..._radial the radial one"
    if name.startswith("guide") and name.endswith("_moment"):
        return "couple of the guide on what slides in it"
    return f"magnitude of the force at the joint {name}, in the table joints" if _JOINT.fullmatch(name) else ""
