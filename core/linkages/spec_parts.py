"""Sections that the design files of several gear-linkages share."""

from __future__ import annotations

from pydantic import Field

from gearlink.core.spec import AcuteAngle, GearLimits, Length, Spec


class LinkageLimits(GearLimits):
    """Limits of the checks."""

    transmission_angle: AcuteAngle = Field(40.0, description="least transmission angle")


class FourLinks(Spec):
    """A whole four-bar."""

    crank: Length = Field(description="crank AB")
    coupler: Length = Field(description="coupler BC")
    rocker: Length = Field(description="rocker CD")
    frame: Length = Field(description="frame AD")
