"""The cams of a machine as one part of it: what stands of them, and why there are none."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Design
from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.results import cached_property, kept

if TYPE_CHECKING:
    from gearlink.core.base.report import Report
    from gearlink.core.parts.cams.disc_cam import DiscCam


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


class DiscCams:
    """Base of the cams of a machine: they may be impossible where its motion is not."""

    @property
    def discs(self) -> tuple[DiscCam, ...]:
        """Main cam, and the return cam where there is one."""
        raise NotImplementedError

    def require_motion(self) -> None:
        """Compute the motion that the cams are to make.

        Raises
            NoSolution - where the motion itself does not exist
        """
        raise NotImplementedError

    def explained(self, refusal: NoSolution) -> NoSolution:
        """The refusal of a cam, with what would help where it does not say so itself."""
        return refusal

    def seek(self) -> None:
        """Seek the extremes of all cams together, unless some are known; where a cam cannot be, each search says so."""
        from gearlink.core.parts.cams.disc_cam import FOUND_TOGETHER, seek_together

        with suppress(NoSolution):
            if not any(kept(cam, *FOUND_TOGETHER) for cam in self.discs):
                seek_together(self.discs)

    @cached_property
    def refusal(self) -> NoSolution | None:
        """Why there are no such cams; None where there are.

        Raises
            NoSolution - where the motion itself does not exist
        """
        self.require_motion()
        self.seek()
        try:
            for cam in self.discs:
                _ = cam.max_pressure_angle, cam.min_curvature_radius
        except MissingSection:
            raise
        except NoSolution as error:
            return self.explained(error)
        return None

    @property
    def is_refused(self) -> bool:
        """Whether the cams alone are impossible; a motion that is refused says so itself."""
        try:
            return self.refusal is not None
        except NoSolution:
            return False
