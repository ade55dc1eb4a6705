"""The design file of a gear pair."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import (
    Deferred,
    DrawingLimits,
    Entries,
    GearLimits,
    Length,
    LoadLimits,
    TolerancedSpec,
    also,
    only_one,
    refused,
    unit,
)
from gearlink.core.parts.gears.keys.pair import PairKeys
from gearlink.core.parts.gears.keys.types import Shift, SignedTeeth, TwoShifts


class PairLimits(DrawingLimits, GearLimits, LoadLimits):
    """Limits of the checks of a gear pair."""


class GearPairSpec(TolerancedSpec, PairKeys):
    """Cylindrical gears with profile shift, spur or helical, external or internal, by centre distance or shifts."""

    own_commands = ("gear",)
    kind: Literal["gear-pair"]
    teeth: Annotated[
        list[SignedTeeth | Literal["rack"]], Field(min_length=2, max_length=2), Entries("[gear 1, gear 2]", "[25, 40]")
    ] = Field(description="teeth of gear 1 and 2; a negative number is a ring, rack instead of gear 2 a rack")
    center_distance: Length | None = Field(
        None, description="working centre distance; with profile_shift the difference is backlash"
    )
    profile_shift: TwoShifts | None = Field(None, description="profile shift coefficients of gear 1 and 2 (ISO signs)")
    helix_hand: Annotated[Any, Deferred("parts.gears.keys.types:TwoHands")] | None = Field(
        None, description="hands of helix of gear 1 and 2, for drawing and exports"
    )
    tip_shortening: Annotated[Any, Deferred("parts.gears.keys.types:TipShortening")] | None = Field(
        None,
        description="full (default of external pairs), none (of internal ones), or tip alterations k of both gears",
        json_schema_extra=also("tip_alteration"),
    )
    tip_diameter: Annotated[Any, Deferred("parts.gears.keys.types:TwoLengths")] | None = Field(
        None, description="tip diameters, instead of tip_shortening"
    )
    rim_thickness: Annotated[Any, Deferred("parts.gears.keys.types:RimOrTwo")] | None = Field(
        None,
        description="thickness of the rim under the tooth roots, of both or of each: for Y_B, and the back of a ring "
        "or rack in exports, default 2 modules",
    )
    rack_teeth: Annotated[int, unit("teeth", ge=1, le=10_000)] | None = Field(
        None, description="teeth of the rack in figures and exports; default: as many as gear 1 has"
    )
    cutter: Annotated[Any, Deferred("parts.gears.keys.sections:CutterSpec")] | None = Field(
        None, description="pinion cutter of a ring: needed to compute its fillets"
    )
    span_teeth: Annotated[Any, Deferred("parts.gears.keys.types:TwoSpans")] | None = Field(
        None, description="number of teeth of the span measurement of each gear; default: chosen"
    )
    assembly: Literal["axial", "radial"] = Field("axial", description="assembly of pinion and ring: radial or axial")
    shift_split: Literal["equal", "sliding", "tip", "root", "undercut"] | Shift = Field(
        "equal", description="how the shift sum is shared when center_distance alone is given: by a criterion, or x1"
    )
    limits: PairLimits = PairLimits.model_construct()
    loads: Annotated[Any, Deferred("machines.gear_pair.loads_spec:PairLoads")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _placed(self) -> Self:
        require_teeth(self.teeth)
        if self.center_distance is None and self.profile_shift is None:
            message = "either center_distance or profile_shift is needed\ngive profile_shift: [0, 0] for standard gears"
            raise refused(message, "center_distance", "GL106")
        only_one(self, "tip_shortening", "tip_diameter")
        for place, spanned in enumerate(self.span_teeth or ()):
            z = self.teeth[place]
            if isinstance(z, int) and spanned > abs(z):
                key = f"span_teeth[{place}]"
                message = f"a gear of {abs(z)} teeth has no span over {spanned}\nset {key} to at most {abs(z)}"
                raise refused(message, key)
        return self

    @model_validator(mode="after")
    def _fits_its_kind(self) -> Self:
        second = self.teeth[1]
        internal = isinstance(second, int) and second < 0
        self._fits_a_rack()
        if self.cutter is not None and not internal:
            raise refused("a pinion cutter applies only to a ring (negative teeth)\nomit it, or give tool", "cutter")
        if self.cutter is not None and isinstance(second, int) and self.cutter.teeth >= -second:
            message = f"a cutter of {self.cutter.teeth} teeth does not fit into a ring of {-second}"
            raise refused(f"{message}\nset cutter.teeth to at most {-second - 1}", "cutter.teeth")
        self._fits_its_system(internal)
        if self.helix_hand is None:
            return self
        if self.helix_angle == 0.0:
            raise refused("spur gears have no hand of helix\nomit it, or give helix_angle", "helix_hand")
        if (self.helix_hand[0] == self.helix_hand[1]) != internal:
            message = "helix_hand: a pinion and its ring have the same hand, two external gears opposite ones"
            raise refused(message, "helix_hand")
        return self

    def _fits_its_system(self, internal: bool) -> None:
        """Refuse a place in a planetary gear that the pair does not have."""
        system = None if self.rating is None else self.rating.system
        if system in (None, "pair") or (system == "planet-ring") == internal:
            return
        message = "system: planet-ring needs a gear and its ring (negative teeth), sun-planet two external gears"
        raise refused(message, "rating.system")

    @property
    def rack(self) -> bool:
        """Whether gear 2 is a rack."""
        return self.teeth[1] == "rack"

    def _fits_a_rack(self) -> None:
        """Refuse what a rack cannot have."""
        if not self.rack:
            if self.rack_teeth is not None:
                raise refused("rack_teeth applies only with teeth: [z, rack]\nomit it", "rack_teeth")
            return
        if self.profile_shift is not None and (self.center_distance is not None or self.profile_shift[1] != 0.0):
            message = "a rack has no shift\ngive profile_shift: [x1, 0], or center_distance to its datum line"
            key = "profile_shift[1]" if self.center_distance is None else "profile_shift"
            raise refused(message, key)
        if self.shift_split != "equal":
            message = "shift_split does not apply to a rack\nomit it; center_distance alone gives x1"
            raise refused(message, "shift_split")
        for key in ("loads", "tip_diameter", "rating"):
            if getattr(self, key) is not None:
                raise refused(f"{key} is not supported for a gear on a rack\nomit it", key)


def require_teeth(teeth: list[Any]) -> None:
    """Refuse teeth that no pair has: gear 1 is external, gear 2 external, a ring (negative), or a rack."""
    first, second = teeth
    if first == "rack":
        message = "teeth[0] must be a number: gear 1 is external\ngive the rack as gear 2: teeth: [z, rack]"
        raise refused(message, "teeth[0]", "GL108")
    for place, z in enumerate((first, second)):
        if z == 0 or (place == 0 and z < 0):
            key = f"teeth[{place}]"
            message, help_ = f"{key} must be at least 1, not {z}", "allowed: from 1 to 10000"
            if z < 0:
                help_ = "a ring must be gear 2: teeth: [21, -67]"
            if place == 1:
                message = f"{key} must be 1 or more, -1 or less for a ring, or rack, not {z}"
                help_ = "allowed: from 1 to 10000, from -10000 to -1, rack"
            raise refused(f"{message}\n{help_}", key, "GL108")
    if second != "rack" and second < 0 and -second <= first:
        message = f"a gear of {first} teeth does not fit into a ring of {-second}\nset teeth[1] to at most -{first + 1}"
        raise refused(message, "teeth[1]")
