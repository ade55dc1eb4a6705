"""Keys of a gear pair at a given centre distance, as inside a machine: what its drawing needs beside the teeth."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from gearlink.core.gears.key_types import FaceWidth, Rim, ToothKeys
from gearlink.core.gears.spec_parts import (
    AllowanceSpec,
    LoadSpec,
    MaterialSpec,
    TipShortening,
    ToolSpec,
    TwoLengths,
    TwoRims,
    TwoShifts,
    TwoTools,
    TwoWidths,
)
from gearlink.core.spec import Length, PressureAngle


class PairKeys(ToothKeys):
    """The keys of a `gear-pair` that a pair at a given centre distance takes."""

    module: Length = Field(description="module; of helical gears the normal one")
    pressure_angle: PressureAngle = Field(20.0, description="pressure angle of the reference profile")
    profile_shift: TwoShifts | None = Field(
        None, description="profile shift coefficients of gear 1 and 2; what the centre distance leaves is backlash"
    )
    tip_shortening: TipShortening | None = Field(
        None, description="full (default), none, or tip alterations k of both gears"
    )
    face_width: FaceWidth | TwoWidths | None = Field(None, description="face width of both gears, or of each")
    rim_thickness: Rim | TwoRims | None = Field(
        None, description="thickness of the rim under the tooth roots of both gears, or of each, for Y_B"
    )
    tool: ToolSpec | TwoTools | None = Field(
        None, description="rack tool of both gears, or of each; left out: straight to the addendum"
    )
    pin_diameter: Length | TwoLengths | None = Field(
        None, description="measuring balls or pins of both gears, or of each; left out: a preferred size"
    )
    allowances: AllowanceSpec | None = None
    center_distance_allowance: Literal["js7"] | Length | None = Field(
        None, description="plus and minus of the centre distance: js7, or a number in mm"
    )
    load: LoadSpec | None = Field(None, description="load of the rating by ISO 6336 (loads is for forces of a drive)")
    material: MaterialSpec = MaterialSpec.model_construct()
