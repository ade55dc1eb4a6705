"""All rules of checks by their codes. Each rule is defined next to its checks, without importing their kernels."""

from __future__ import annotations

from functools import cache
from importlib import import_module

from gearlink.core.base.kinds import FILES
from gearlink.core.base.report import Rule

_LIBRARIES = ("parts.cams", "parts.linkages", "parts.gears", "studies")


@cache
def rules() -> dict[str, Rule]:
    """The rules by their codes, in the order of the codes."""
    rooms = dict.fromkeys([f"{kind.folder}.{kind.codes}" for kind in FILES.values() if kind.codes])
    modules = [import_module(f"gearlink.core.{place}") for place in (*(f"{name}.codes" for name in _LIBRARIES), *rooms)]
    found = [rule for module in modules for rule in vars(module).values() if isinstance(rule, Rule)]
    return {rule.code: rule for rule in sorted(found, key=lambda rule: rule.code)}
