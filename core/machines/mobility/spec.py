"""The design file of a linkage that carries gear trains: how many degrees of freedom has the whole?"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from gearlink.core.base.spec import DesignSpec, Length, Spec, Teeth

Name = Annotated[str, Field(min_length=1, max_length=40)]


class Link(Spec):
    """A rigid link."""

    pins: Annotated[list[Name], Field(min_length=1, max_length=20)] = Field(description="pins that the link carries")
    length: Length | None = Field(None, description="distance of its two pins; then centre distances are checked")


class Gear(Spec):
    """A gear of a train."""

    at: Name = Field(description="pin on which the gear sits")
    fixed_to: Name | None = Field(None, description="link to which the gear is fixed; default: it turns freely")
    teeth: Teeth | None = Field(None, description="teeth; with the train's module the centre distances are checked")
    ring: bool = Field(False, description="an internal gear")


class Train(Spec):
    """Gears in mesh one after the other."""

    gears: Annotated[list[Gear], Field(min_length=2, max_length=50)] = Field(description="in the order of the meshes")
    module: Length | None = Field(None, description="module of the train")


class GearTrainMobilitySpec(DesignSpec):
    """A pin-jointed linkage and the gear trains on it."""

    kind: Literal["gear-train-mobility"]
    links: Annotated[dict[Name, Link], Field(min_length=2, max_length=50)] = Field(
        description="every link by name, the frame among them"
    )
    trains: Annotated[list[Train], Field(max_length=20)] = Field(default_factory=list, description="the gear trains")
    mobility: Annotated[int, Field(ge=0, le=20, json_schema_extra={"unit": "1"})] = Field(
        1, description="required degrees of freedom"
    )

    def commands(self) -> tuple[str, ...]:
        """What the file asks for."""
        return ("analyze",)
