"""What the spec models share: strictness, and number types that carry their unit into the JSON Schema."""

import re
import unicodedata
from functools import cached_property
from importlib import import_module
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field
from pydantic_core import PydanticCustomError, core_schema

from gearlink.core.base.errors import named

if TYPE_CHECKING:
    from pydantic import TypeAdapter


_PLAIN = "[A-Za-z][A-Za-z0-9_]*"


class Spec(BaseModel):
    """A section of a design file: strict, frozen, no unknown keys, finite numbers only."""

    model_config = ConfigDict(strict=True, frozen=True, extra="forbid", allow_inf_nan=False, defer_build=True)


STANDARD_TERMS: set[str] = set()
"""Every term that `also` names, of the models that are imported."""


def also(*names: str) -> dict[str, Any]:
    """For `json_schema_extra` of a key: the standard terms that files may write instead of its name."""
    STANDARD_TERMS.update(names)
    return {"also": list(names)}


def unit(name: str, **bounds: Any) -> Any:
    """Annotates a number: its unit in files, and between which bounds it lies.

    Parameters
        name : str - "mm", "1" of a number without one
        bounds : gt, ge, lt, le - as `Field` takes them
    """
    return Field(json_schema_extra={"unit": name}, **bounds)


def refused(message: str, key: str = "", code: str = "GL111") -> PydanticCustomError:
    """What is wrong with values that contradict each other, for a validator to raise.

    Parameters
        message : str - what is wrong; after a line break how to fix it
        key : str - where, below the section; "" the section itself
        code : str - of the finding
    """
    return PydanticCustomError(code, "{message}", {"message": message, "key": key})


def only_one(spec: Any, *names: str, at: str = "", needed: str = "") -> None:
    """Refuse a section with more than one of some keys.

    Parameters
        at : str - key of the finding; default: the second of those that are given
        needed : str - what to give where there is none of them; empty: none is needed
    """
    given = [name for name in names if getattr(spec, name) is not None]
    if needed and not given:
        raise refused(needed, names[0], "GL106")
    if len(given) > 1:
        listed = f"{', '.join(names[:-1])} and {names[-1]}"
        fix = "keep one of them" if len(names) > 2 else f"omit {names[0]} or {names[1]}"
        raise refused(f"{listed} exclude each other\n{fix}", at or given[1])


def plain_name(name: str, key: str = "") -> str:
    """The name of a part: it begins with a letter and has only ASCII letters, digits and _, so that relations, options
    and files can contain it.

    Raises
        PydanticCustomError - for any other name, with the nearest one that is valid
    """
    if re.fullmatch(_PLAIN, name):
        return name
    letters = unicodedata.normalize("NFKD", name.replace("ß", "ss")).encode("ascii", "ignore").decode()
    near = re.sub("[^A-Za-z0-9]+", "_", letters).strip("_")
    fix = next(each for each in (near, f"n{near}") if re.fullmatch(_PLAIN, each))
    rule = "a name begins with a letter and has only letters a to z, digits and _"
    raise refused(f"{named(name)} is not a valid name: {rule}\nwrite {fix}", key, "GL108")


class Entries:
    """Annotates a list of fixed length: what each of its entries is, and a list to show for an example.

    Parameters
        names : str - "[x, y]"
        example : str - "[0, -9.81]"; empty: none
        units : (str, ...) - of each entry, "" where it is that of the list; empty: of all
    """

    def __init__(self, names: str, example: str = "", units: tuple[str, ...] = ()) -> None:
        self.names = names
        self.example = example
        self.units = units

    def unit(self, place: int) -> str:
        """The unit of an entry where it has its own."""
        return self.units[place] if place < len(self.units) else ""


class OfFollower:
    """Annotates a number of a cam whose unit is another one where the follower turns.

    Parameters
        turning : str - the unit with an oscillating follower, "deg"
    """

    def __init__(self, turning: str) -> None:
        self.turning = turning


MOST_NAME = 200
"""Characters of a design's name at most: it heads pictures and pages, and names files."""


def _fit_to_print(name: str) -> str:
    if len(name) > MOST_NAME:
        raise refused(f"name has {len(name)} characters (limit <= {MOST_NAME})\nshorten it", code="GL108")
    if name.isprintable():
        return name
    import unicodedata

    if wrong := next((each for each in name if unicodedata.category(each) in ("Cc", "Cs") and each not in "\t\n"), ""):
        raise refused(f"name contains the control character U+{ord(wrong):04X}\nremove it", code="GL108")
    return name


class DesignSpec(Spec):
    """The keys that every kind of design file has."""

    name: Annotated[str, AfterValidator(_fit_to_print)] = Field(
        "design",
        description="name of the design; default: file name without its ending",
        json_schema_extra={"maxLength": MOST_NAME},
    )

    own_commands: ClassVar[tuple[str, ...]] = ("analyze",)
    """What every file of the kind asks for."""

    def commands(self) -> tuple[str, ...]:
        """What the file asks for."""
        return *self.own_commands, *self._loads()

    def _loads(self) -> tuple[str, ...]:
        return () if getattr(self, "loads", None) is None else ("loads",)

    def pages(self) -> tuple[str, ...]:
        """Commands that a report shows: those that the file asks for, less what another one of them contains."""
        return self.commands()

    def sized_by(self, _command: str) -> str:
        """The synthesis that sizes the design before a command runs on it; empty where the file is complete for it."""
        return ""


Speed = Annotated[float, unit("1/min", ge=1e-6, le=1e6)]


class Deferred:
    """Annotates a section whose model is imported when a file has that section, not before.

    Parameters
        place : str - "module:Name", below `gearlink.core`, of a model, or of a type made of models
    """

    def __init__(self, place: str) -> None:
        self.place = place

    def model(self) -> Any:
        """The section's model, or type."""
        module, _, name = self.place.partition(":")
        return getattr(import_module(f"gearlink.core.{module}"), name)

    @cached_property
    def _adapter(self) -> "TypeAdapter[Any]":
        from pydantic import TypeAdapter

        model = self.model()
        return TypeAdapter(model, config=None if isinstance(model, type) else Spec.model_config)

    def __get_pydantic_core_schema__(self, _source: Any, _handler: Any) -> core_schema.CoreSchema:
        return core_schema.no_info_plain_validator_function(self._validated)

    def _validated(self, value: Any) -> Any:
        model = self.model()
        if not isinstance(model, type):
            return self._adapter.validate_python(value)
        section: type[BaseModel] = model
        # A design whose spec is changed and validated anew brings a section that is valid already.
        return value if isinstance(value, section) else section.model_validate(value)

    def __get_pydantic_json_schema__(self, _schema: Any, handler: Any) -> dict[str, Any]:
        found: dict[str, Any] = handler(self._adapter.core_schema)
        return found


Length = Annotated[float, unit("mm", gt=0)]
SignedLength = Annotated[float, unit("mm")]
Distance = Annotated[float, unit("mm", ge=0)]
Angle = Annotated[float, unit("deg", ge=-360, le=360)]
PressureAngle = Annotated[float, unit("deg", gt=0, lt=45)]
AcuteAngle = Annotated[float, unit("deg", ge=0, lt=90)]
Teeth = Annotated[int, unit("teeth", ge=1, le=10_000)]
Coefficient = Annotated[float, unit("1", gt=0, le=3)]
Ratio = Annotated[float, unit("1", gt=0)]
Share = Annotated[float, unit("1", ge=0)]
Assembly = Literal[1, -1]


class Scatter(Spec):
    """The keys of sizes that scatter."""

    tolerance: Annotated[Any, Deferred("studies.tolerance.spec:Tolerance")] | None = Field(
        None, description="tolerances of dimensions, for the commands tolerance and register"
    )
    register_: Annotated[Any, Deferred("studies.tolerance.spec:Register")] | None = Field(
        None, alias="register", description="allowed error of the output, for the command register"
    )


class TolerancedSpec(Scatter, DesignSpec):
    """The keys of a kind whose sizes may scatter."""


class DrivenSpec(Scatter, DesignSpec):
    """The keys of a kind whose input turns at an even speed."""

    input_speed: Speed | None = Field(
        None,
        description="speed of the input, counter-clockwise: with it real speeds, accelerations and times are computed",
    )

    own_commands: ClassVar[tuple[str, ...]] = ("analyze", "gear")


class LoadLimits(Spec):
    """Limits of the checks of the loads."""

    torque_margin: Ratio = Field(1.0, description="minimum ratio of the motor's torque to the required one")
    frequency_ratio: Ratio = Field(
        10.0, description="minimum ratio of the output's natural frequency to the input's frequency"
    )


class GearLimits(Spec):
    """Limits of the gear checks."""

    undercut: Share = Field(0.05, description="permitted amount of the profile shift below x_min")
    tip_thickness: Share = Field(0.25, description="minimum tip thickness over the module")
    contact_ratio: Ratio = Field(1.1, description="minimum transverse contact ratio")
    sliding: Ratio | None = Field(None, description="maximum specific sliding; default: only above 8 is reported")


class DrawingLimits(Spec):
    """Limits of what only a drawing fixes: backlash and strength of gears."""

    backlash: SignedLength = Field(0.0, description="minimum normal backlash; below it a warning")
    safety_pitting: Ratio = Field(1.0, description="minimum safety against pitting")
    safety_bending: Ratio = Field(1.4, description="minimum safety against tooth breakage")
    safety_scuffing: Ratio = Field(1.8, description="minimum safety against scuffing, with rating")


def require_offset_below_rod(rod: float, offset: float, key: str) -> None:
    """Refuse a slide line that the connecting rod cannot reach."""
    if abs(offset) >= rod:
        message = f"offset {offset:g} mm is not below the rod's {rod:g} mm"
        raise refused(f"{message}\nlengthen the rod or reduce the offset", key)
