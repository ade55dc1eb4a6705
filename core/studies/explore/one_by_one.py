"""Designs computed each by its own class: the form that every kind has, and the judge of the array form."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from gearlink.core.base.design_axis import Single
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Check
from gearlink.core.studies.explore.base import Base, Changes, Refused


def single(base: Base, changes: Changes, names: Iterable[str], codes: Sequence[str]) -> Single:
    """Compute a design by its class.

    Parameters
        base : Base
        changes : paths and values that differ from it
        names : quantities that are wanted
        codes : of the checks that are wanted
    """
    try:
        design = base.design(changes)
        values = base.values(design, names)
        return Single(values, tuple(findings_of(base, design, codes)))
    except Refused as error:
        return Single({}, (), error.key or "kind", str(error))


def findings_of(base: Base, design: Any, codes: Sequence[str]) -> Iterable[Check]:
    """The findings of a design under some codes.

    Raises
        Refused - where a check finds that there is no mechanism
    """
    names = {name for code in codes for name in base.codes[code]}
    try:
        shown = dict.fromkeys(name for name in design.outline(base.command).checks if name in names)
        return [check for name in shown for check in design.check(name)]
    except NoSolution as error:
        raise Refused(error.key, str(error), error.code) from error
