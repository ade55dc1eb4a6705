"""The key of a design file that a check's finding is about."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

from gearlink.cli.texts.codes import explanations
from gearlink.core.base.report import Check

_PATH = re.compile(r"\b[a-z][a-z0-9_]*(?:\.[a-z][a-z0-9_]*)+\b")


def key_of(data: dict[str, Any], check: Check) -> str:
    """The key of a file that a check is about: one that its message names, else the most telling one of its code.

    Of a section it is the key that the remedy changes, where that stands in it.

    Example
        >>> key_of({"cam": {"base_radius": 9}}, Check("GL405", "sum", "fail", "", advice="raise cam.base_radius"))
        'cam.base_radius'
    """
    if member := _member(data, check):
        design = f"members.{member}.design"
        remedy = tuple((key.removeprefix(f"{design}."), value) for key, value in check.remedy)
        own = replace(check, what=check.what.removeprefix(f"{member}: "), remedy=remedy)
        return f"{design}.{key_of(data['members'][member]['design'], own)}"
    known = explanations().get(check.code)
    # The keys of a remedy may stand anywhere: what is about to be changed is not what the finding is about.
    for path in (
        *([check.what] if check.what.isidentifier() else ()),
        *_PATH.findall(f"{check.what} {check.aside} {'' if check.remedy else check.advice}"),
        *(known.keys if known else ()),
    ):
        if _has(data, path):
            changed = (key for key, _ in check.remedy if key.startswith(f"{path}.") and _has(data, key))
            return next(changed, _line(data, path, check.what))
    return "kind"


def _member(data: dict[str, Any], check: Check) -> str:
    """The member of a machine whose name begins the message; "" without one."""
    name, colon, _ = check.what.partition(": ")
    members = data.get("members")
    design = members.get(name) if colon and isinstance(members, dict) else None
    return name if isinstance(design, dict) and isinstance(design.get("design"), dict) else ""


def _line(data: dict[str, Any], path: str, what: str) -> str:
    """Of a list of texts the one with which the message begins."""
    lines = data.get(path)
    if isinstance(lines, list):
        for i, line in enumerate(lines):
            if isinstance(line, str) and what.startswith(" ".join(line.split())):
                return f"{path}[{i}]"
    return str(path)


def _has(data: Any, path: str) -> bool:
    for step in path.split("."):
        if not isinstance(data, dict) or data.get(step) is None:
            return False
        data = data[step]
    return True
