"""The one place where tests make designs: from the data of a design file, or from an example, with changes."""

from __future__ import annotations

import copy
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import yaml

from gearlink.core.base.kinds import KINDS

DESIGNS = Path(__file__).resolve().parents[1] / "designs"

QUICK = {
    "candy_feed",
    "ring_feed",
    "two_gear_drag_link",
    "wide_lever",
    "crank_rocker",
    "hypocycloid_slider",
    "mutilated_gear_press",
    "five_bar_path",
    "six_bar_two_trains",
    "gear_pair",
    "ty460_slider_crank",
    "ty460",
    "swing_gripper",
    "wide_swing_twin_cam",
}
"""Worked designs of `make test` where any of its kind serves: each kind, each form, none that is searched for long."""


def each_kind(paths: Iterable[Path]) -> list[Any]:
    """Design files for `pytest.mark.parametrize`: those of QUICK, the others in `make check-full` alone."""
    return [path if path.stem in QUICK else pytest.param(path, marks=pytest.mark.slow) for path in paths]


def design(given: str | Mapping[str, Any], /, *, command: str = "analyze", **keys: Any) -> Any:
    """The design of a file's data.

    Parameters
        given : the data, or the name of an example ("ty460")
        command : str - whose design class it is; "analyze" stands for all but the four of `synth`
        keys - changes as in `changed`
    """
    data = changed(worked(given) if isinstance(given, str) else given, **keys)
    kind = KINDS[data["kind"]]
    return kind.design(command, kind.spec_model().model_validate(data))


def changed(data: Mapping[str, Any], **keys: Any) -> dict[str, Any]:
    """A copy of the data of a design file with values set by their keys, `cam__roller_radius=8.0` for a key of a
    section (sections are made where they are missing); None takes a key out."""
    copied = copy.deepcopy(dict(data))
    for path, value in keys.items():
        *sections, last = path.split("__")
        place = copied
        for section in sections:
            place = place.setdefault(section, {})
        if value is None:
            place.pop(last, None)
        else:
            place[last] = copy.deepcopy(value)
    return copied


def worked(name: str) -> dict[str, Any]:
    """The data of an example by the name of its file, named after it where it has no name, as the program does, and the
    designs of its members after those."""
    return copy.deepcopy(_read(name))


@cache
def _read(name: str) -> dict[str, Any]:
    data: dict[str, Any] = _keys_as_written(yaml.safe_load((DESIGNS / f"{name}.yaml").read_text(encoding="utf-8")))
    for called, member in data["members"].items() if data["kind"] == "machine" else ():
        if "design" in member:
            member["design"] = {"name": called} | member["design"]
    return {"name": name} | data


def _keys_as_written(node: Any) -> Any:
    """PyYAML takes the key `on` for true; the program's own reader takes it as it stands."""
    if isinstance(node, list):
        return [_keys_as_written(item) for item in node]
    if isinstance(node, dict):
        return {"on" if key is True else key: _keys_as_written(value) for key, value in node.items()}
    return node
