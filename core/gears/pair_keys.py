"""Keys of a gear pair inside a machine, which fixes its centre distance: what its drawing needs beside the teeth."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from gearlink.core.gears.key_types import AccuracyGrade, FaceWidth, HelixAngle, Rim
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
from gearlink.core.spec import Coefficient, Length, PressureAngle, Spec


class PairKeys(Spec):
    """The keys of a `gear-pair` that a pair at a given centre distance takes."""

    module: Length = Field(description="module; of helical gears the normal one")
    pressure_angle: PressureAngle = Field(20.0, description="pressure angle of the reference profile")
    helix_angle: HelixAngle = Field(0.0, description="helix angle on the reference circle, its magnitude")
    profile_shift: TwoShifts | None = Field(
        None, description="profile shift coefficients of gear 1 and 2; what the centre distance leaves is backlash"
    )
    addendum: Coefficient = Field(1.0, description="addendum coefficient")
    clearance: Annotated[float, Field(ge=0, le=1, json_schema_extra={"unit": "1"})] = Field(
        0.25, description="clearance coefficient"
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
    load_share: Literal["third", "half"] = Field(
        "third", description="share of a flank pair beside another: third (1/3 to 2/3) or half"
    )
    material: MaterialSpec = MaterialSpec()
    accuracy_grade: AccuracyGrade | None = Field(
        None, description="accuracy grade of ISO 1328: 4 or better lowers the root stress of deep teeth (Y_DT)"
    )
    edition: Literal[2006, 2019] = Field(2006, description="of ISO 6336; 2019 is not verified")
