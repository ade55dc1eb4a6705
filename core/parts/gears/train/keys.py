"""Keys of the gears of a train, lists with an entry per gear: what teeth and drawings need beside the numbers."""

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import Deferred, Length, also, refused
from gearlink.core.parts.gears.keys.types import Hand, ToothKeys

if TYPE_CHECKING:
    from gearlink.core.parts.gears.keys.pair import PairKeys

_LISTS = (
    "profile_shift",
    "helix_hand",
    "tip_shortening",
    "tool",
    "face_width",
    "rim_thickness",
    "span_teeth",
    "pin_diameter",
)
_OF_TEETH = ("tool", "helix_angle", "tip_shortening", "cutter", "span_teeth")
RATED = ("load", "material", "rating")


class TrainKeys(ToothKeys):
    """The keys of a train, which a machine adds to its section `gears`."""

    drawn: ClassVar[tuple[str, ...]] = ()
    """Names of the gears, in the order of the lists."""

    profile_shift: Annotated[Any, Deferred("parts.gears.train.key_sections:Shifts")] | None = Field(
        None, description="profile shift coefficients, a list with one for each gear; default: 0"
    )
    helix_hand: Annotated[Any, Deferred("parts.gears.train.key_sections:Hands")] | None = Field(
        None, description="hands of helix, a list with one for each gear, for drawing and exports"
    )
    tip_shortening: Annotated[Any, Deferred("parts.gears.train.key_sections:TipShortenings")] | None = Field(
        None,
        description="full (default of external meshes), none (of rings), or tip alterations k of all gears",
        json_schema_extra=also("tip_alteration"),
    )
    tool: Annotated[Any, Deferred("parts.gears.train.key_sections:Tools")] | None = Field(
        None, description="rack tool of all gears, or of each; default: straight to the addendum"
    )
    cutter: Annotated[Any, Deferred("parts.gears.keys.sections:CutterSpec")] | None = Field(
        None, description="pinion cutter of a ring: needed to compute its fillets"
    )
    face_width: Annotated[Any, Deferred("parts.gears.train.key_sections:FaceWidths")] | None = Field(
        None, description="face width of all gears, or of each"
    )
    rim_thickness: Annotated[Any, Deferred("parts.gears.train.key_sections:Rims")] | None = Field(
        None, description="thickness of the rim under the tooth roots of all gears, or of each, for Y_B"
    )
    span_teeth: Annotated[Any, Deferred("parts.gears.train.key_sections:Spans")] | None = Field(
        None, description="number of teeth of the span measurement of each gear; default: chosen"
    )
    pin_diameter: Annotated[Any, Deferred("parts.gears.train.key_sections:Pins")] | None = Field(
        None, description="measuring balls or pins of all gears, or of each; default: a preferred size"
    )
    allowances: Annotated[Any, Deferred("parts.gears.train.key_sections:TrainAllowances")] | None = Field(
        None, description="allowances of the tooth thickness of every gear"
    )
    center_distance_allowance: Literal["js7"] | Length | None = Field(
        None, description="allowance +- of every centre distance: js7, or a number in mm"
    )
    assembly: Literal["axial", "radial"] | None = Field(None, description="assembly of a gear and its ring")
    load: Annotated[Any, Deferred("parts.gears.train.key_sections:TrainLoad")] | None = Field(
        None, description="load of the rating by ISO 6336; each free gear transmits it to the next"
    )
    rating: Annotated[Any, Deferred("parts.gears.train.rating_keys:TrainRating")] | None = Field(
        None, description="rating by ISO 6336 with all factors computed: life, material, grade, oil"
    )
    material: Annotated[Any, Deferred("parts.gears.train.key_sections:TrainMaterial")] | None = Field(
        None, description="materials, for the rating"
    )

    def gear_names(self) -> tuple[str, ...]:
        """Names of the gears of this file, in the order of the lists."""
        return self.drawn

    def rings(self) -> tuple[bool, ...]:
        """Which of them are rings."""
        return (False,) * len(self.gear_names())

    @model_validator(mode="after")
    def _an_entry_for_each_gear(self) -> Self:
        names = self.gear_names()
        for key, value in self._lists():
            if isinstance(value, list) and len(value) != len(names):
                message = f"{key} needs an entry for each gear ({', '.join(names)}), not {len(value)}"
                raise refused(message, key, "GL107")
        given = None if self.load is None else self.load.gear
        if given is not None and given not in names:
            raise refused(f"load.gear must be one of {', '.join(names)}, not {given}", "load.gear", "GL108")
        return self

    def _lists(self) -> Iterator[tuple[str, Any]]:
        """Every key that may be a list with an entry for each gear, and its value."""
        yield from ((key, getattr(self, key)) for key in _LISTS)
        for section in ("allowances", "material", "rating"):
            found = getattr(self, section) or ()
            yield from ((f"{section}.{key}", value) for key, value in found if key not in ("web", "spectrum"))
        if self.rating is not None:
            yield from ((f"rating.roughness.{key}", value) for key, value in self.rating.roughness)

    @model_validator(mode="after")
    def _rated(self) -> Self:
        if self.rating is None:
            return self
        from gearlink.core.parts.gears.keys.rating import require_rated

        require_rated(self, self.rating)
        if self.rating.system != "pair":
            message = "system applies only to a gear-pair\nomit it, and give reduced_mass where planets matter"
            raise refused(message, "rating.system")
        return self

    @model_validator(mode="after")
    def _fits_its_gears(self) -> Self:
        rings = self.rings()
        for key in ("cutter", "assembly"):
            if getattr(self, key) is not None and not any(rings):
                raise refused(f"{key} applies only to a ring gear\nomit it", key)
        if self.helix_hand is None:
            return self
        if self.helix_angle == 0.0:
            message = "spur gears have no hand of helix\nomit it, or give helix_angle"
            raise refused(message, "helix_hand")
        for (one, other), internal in zip(pairwise(self.helix_hand), map(any, pairwise(rings)), strict=True):
            if (one == other) != internal:
                message = "helix_hand: a gear and its ring have the same hand, two external gears opposite ones"
                raise refused(message, "helix_hand")
        return self

    def hands(self) -> list[Hand]:
        """Hands of helix, given or as the meshes need them: of a ring its mate's, of an external gear the other."""
        found: list[Hand] = list(self.helix_hand or ("right",))
        for ring in list(map(any, pairwise(self.rings())))[len(found) - 1 :]:
            found.append(found[-1] if ring else "left" if found[-1] == "right" else "right")
        return found

    @property
    def own_teeth(self) -> bool:
        """Whether the teeth are not those of the standard spur profile without shift."""
        shifted = self.profile_shift is not None and any(self.profile_shift)
        other = any(getattr(self, key) not in (None, 0.0) for key in _OF_TEETH)
        return shifted or other or (self.addendum, self.clearance) != (1.0, 0.25)

    @property
    def drawing(self) -> bool:
        """Whether the file gives keys of a train: then it asks for its gears too."""
        given = self.model_fields_set.intersection(TrainKeys.model_fields)
        return any(getattr(self, key) is not None for key in given)

    @property
    def rated(self) -> bool:
        """Whether the file asks for the strength of its teeth."""
        return any(getattr(self, key) is not None for key in RATED)

    @property
    def transverse_module(self) -> float:
        """m_t = m/cos(beta) [mm]; of spur gears the module itself."""
        module = float(getattr(self, "module"))  # noqa: B009  # each machine has its own
        return module / math.cos(math.radians(self.helix_angle)) if self.helix_angle else module

    def shift(self, gear: int) -> float:
        """x of a gear by its place in the lists."""
        return 0.0 if self.profile_shift is None else self.profile_shift[gear]

    def rim_at(self, gear: int, root_radius: float) -> float | None:
        """Outer radius of a ring by its place in the lists [mm], as its rim_thickness gives it; None without one."""
        given = self.rim_thickness
        thickness = given[gear] if isinstance(given, list) else given
        return None if thickness is None else abs(root_radius) + float(thickness)

    def off_center(self, meshes: int) -> bool:
        """Whether the profile shifts of one of the first meshes do not cancel, which moves its centre distance."""
        return any(self.shift(i) + self.shift(i + 1) for i in range(meshes))

    def of(self, one: int, other: int, module: float, pressure_angle: float) -> "PairKeys":
        """The keys of the mesh of two gears by their places in the lists, but for the load.

        Parameters
            module : float [mm]
            pressure_angle : float [deg]
        """
        from gearlink.core.parts.gears.keys.pair import PairKeys
        from gearlink.core.parts.gears.train.key_sections import entries

        shared = PairKeys.model_fields.keys() & TrainKeys.model_fields.keys()
        own = shared - {"allowances", "load", "material", "rating"}
        given = entries({name: getattr(self, name) for name in own}, (one, other))
        given["profile_shift"] = [self.shift(one), self.shift(other)]
        if self.allowances is not None:
            given["allowances"] = self.allowances.of((one, other))
        if self.material is not None:
            given["material"] = self.material.of((one, other))
        return PairKeys(module=module, pressure_angle=pressure_angle, **given)
