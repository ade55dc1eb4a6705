"""Keys of the gears of a train, lists with an entry per gear: what teeth and drawings need beside the numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from gearlink.core.gears.spec_parts import Allowance, AllowanceSpec, FaceWidth, Series, Shift, ToolSpec
from gearlink.core.spec import Coefficient, Length, Spec

if TYPE_CHECKING:
    from gearlink.core.gears.pair_keys import PairKeys

_Shifts = Annotated[list[Shift], Field(min_length=2, max_length=4)]
_Widths = Annotated[list[FaceWidth], Field(min_length=2, max_length=4)]
_Lengths = Annotated[list[Length], Field(min_length=2, max_length=4)]
_Tools = Annotated[list[ToolSpec | None], Field(min_length=2, max_length=4)]
_Allowances = Annotated[list[Allowance], Field(min_length=2, max_length=4)]
_Series = Annotated[list[Series], Field(min_length=2, max_length=4)]


class TrainAllowances(Spec):
    """Allowances of the tooth thickness of every gear: a series of DIN 3967, or limits in mm."""

    series: Series | _Series | None = Field(None, description="of DIN 3967, such as 25cd; one, or one for each gear")
    upper: _Allowances | None = Field(None, description="upper allowances E_sns of every gear, usually negative [mm]")
    lower: _Allowances | None = Field(None, description="lower allowances E_sni of every gear [mm]")

    @model_validator(mode="after")
    def _one_way(self) -> Self:
        pairs = [range(2)] if self.upper is None or self.lower is None else _both(len(self.upper), len(self.lower))
        for places in pairs:
            AllowanceSpec(**_entries(dict(self), places))  # the rules of a pair
        return self


def _both(one: int, other: int) -> list[range]:
    if one != other:
        message = "upper and lower need an entry for each gear"
        raise PydanticCustomError("GL107", message, {"key": "lower"})
    return [range(first, first + 2) for first in range(one - 1)]


def _entries(values: dict[str, Any], places: Any) -> dict[str, Any]:
    """Values of two gears, of the lists that have an entry for each."""
    return {
        name: [value[place] for place in places] if isinstance(value, list) else value for name, value in values.items()
    }


class TrainKeys(Spec):
    """The keys of a train, which a machine adds to its section `gears`."""

    drawn: ClassVar[tuple[str, ...]] = ()
    """Names of the gears, in the order of the lists."""

    profile_shift: _Shifts | None = Field(
        None, description="profile shift coefficients, a list with one for each gear; left out: 0"
    )
    addendum: Coefficient = Field(1.0, description="addendum coefficient")
    clearance: Annotated[float, Field(ge=0, le=1, json_schema_extra={"unit": "1"})] = Field(
        0.25, description="clearance coefficient"
    )
    tool: ToolSpec | _Tools | None = Field(
        None, description="rack tool of all gears, or of each; left out: straight to the addendum"
    )
    face_width: FaceWidth | _Widths | None = Field(None, description="face width of all gears, or of each")
    pin_diameter: Length | _Lengths | None = Field(
        None, description="measuring balls or pins of all gears, or of each; left out: a preferred size"
    )
    allowances: TrainAllowances | None = None
    center_distance_allowance: Literal["js7"] | Length | None = Field(
        None, description="plus and minus of every centre distance: js7, or a number in mm"
    )

    @model_validator(mode="after")
    def _an_entry_for_each_gear(self) -> Self:
        lists = {name: getattr(self, name) for name in ("profile_shift", "tool", "face_width", "pin_diameter")}
        lists |= {f"allowances.{name}": value for name, value in (self.allowances or ())}
        for key, value in lists.items():
            if isinstance(value, list) and len(value) != len(self.drawn):
                message = "{key} needs an entry for each gear ({names}), not {count}"
                words = {"key": key, "names": ", ".join(self.drawn), "count": len(value)}
                raise PydanticCustomError("GL107", message, words)
        return self

    @property
    def own_teeth(self) -> bool:
        """Whether the teeth are not those of the standard profile without shift."""
        shifted = self.profile_shift is not None and any(self.profile_shift)
        return shifted or self.tool is not None or (self.addendum, self.clearance) != (1.0, 0.25)

    def shift(self, gear: int) -> float:
        """x of a gear by its place in the lists."""
        return 0.0 if self.profile_shift is None else self.profile_shift[gear]

    def of(self, one: int, other: int, module: float, pressure_angle: float) -> PairKeys:
        """The keys of the mesh of two gears by their places in the lists.

        Parameters
            one, other : int
            module : float [mm]
            pressure_angle : float [deg]
        """
        from gearlink.core.gears.pair_keys import PairKeys

        values = {name: getattr(self, name) for name in TrainKeys.model_fields if name != "allowances"}
        given = _entries(values, (one, other))
        if self.allowances is not None:
            given["allowances"] = AllowanceSpec(**_entries(dict(self.allowances), (one, other)))
        given["profile_shift"] = [self.shift(one), self.shift(other)]
        return PairKeys(module=module, pressure_angle=pressure_angle, **given)
