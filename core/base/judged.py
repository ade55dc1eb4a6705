"""The comparison that a check makes, for one design or many, without its text."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from gearlink.core.base.design_axis import Findings
    from gearlink.core.base.report import Check, Rule


class Judged(NamedTuple):
    """A value beside its limit, and whether it fails or warns; numbers, or arrays over designs.

    Fields
        value, limit : float or (N,) array - in the units of design files
        fails, warns : bool or (N,) array - never both
    """

    rule: Rule
    value: Any
    limit: Any
    fails: Any
    warns: Any
    unit: str

    def check(self, what: str, fix: str = "", **parts: Any) -> Check:
        """The finding of one design, of the words of `Rule.check`, with a fix where it does not pass."""
        status: Any = "fail" if self.fails else "warn" if self.warns else "pass"
        return self.rule.check(status, what, self.value, self.limit, self.unit, fix=fix, **parts)

    def of(self, count: int) -> Findings:
        """The findings of so many designs."""
        import numpy as np

        from gearlink.core.base.design_axis import Findings

        value, limit, fails, warns = (np.broadcast_to(np.asarray(each), (count,)) for each in self[1:5])
        return Findings(self.rule.code, value, limit, fails, warns, self.unit)


def below(rule: Rule, value: Any, limit: Any, warn: Any, unit: str) -> Judged:
    """What fails unless it reaches a limit, and warns below another, as `Rule.below`."""
    keeps = value >= limit
    return Judged(rule, value, limit, keeps ^ True, keeps & (value < warn), unit)
