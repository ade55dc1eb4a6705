"""What a synthesis is needed where the output is to stand within a tolerance."""

from typing import Annotated

from pydantic import Field

from gearlink.core.base.spec import Spec, unit
from gearlink.core.parts.linkages.spec_parts import DwellTolerance


class DwellBand(Spec):
    """A dwell within a tolerance: a crank angle, a tolerance, or both."""

    window: Annotated[float, unit("deg", gt=0, lt=360)] | None = Field(
        None, description="crank angle over which the output stays within +-tolerance"
    )
    tolerance: Annotated[DwellTolerance, Field(lt=180)] | None = Field(
        None, description="output tolerance +- in the window; alone: the longest window is found"
    )
    margin: Annotated[float, unit("1", ge=0, lt=1)] | None = Field(
        None, description="share of the tolerance kept as a margin, with tolerance alone; default 0.01"
    )
