"""What machines share whose followers run on disc cams."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Design
from gearlink.core.base.errors import NoSolution

if TYPE_CHECKING:
    from gearlink.core.base.report import Report
    from gearlink.core.parts.cams.disc_cams import DiscCams


class OnDiscCams(Design):
    """A machine whose cams explain why they cannot be, and what would let them."""

    @property
    def cams(self) -> DiscCams:
        """Its cams."""
        raise NotImplementedError

    def require(self, command: str) -> None:
        """Compute every quantity of a command; where a cam cannot be, the refusal says why, or where it can."""
        try:
            super().require(command)
        except NoSolution as error:
            raise self.cams.explained(error) from error

    def report(self, command: str, **asked: Any) -> Report:
        """The report of a command, with the same refusal."""
        try:
            return super().report(command, **asked)
        except NoSolution as error:
            raise self.cams.explained(error) from error
