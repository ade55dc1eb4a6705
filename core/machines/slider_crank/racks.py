"""A pinion at the rod end of a slider-crank between a fixed and a moving rack: the long stroke of thesis 2.2.2 III."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from pydantic import Field, model_validator

from gearlink.core.base.errors import in_section
from gearlink.core.base.report import Check
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec import Teeth, refused
from gearlink.core.parts.gears.from_spec import rack_at
from gearlink.core.parts.gears.keys.pair import PairKeys

if TYPE_CHECKING:
    from gearlink.core.mechanism.joints import Connection
    from gearlink.core.mechanism.links import Link
    from gearlink.core.parts.gears.rack import RackMesh

NAMES = ("fixed_rack", "moving_rack")


class Racks(PairKeys):
    """Pinion between two racks; one toothed wheel where both teeth are equal, else two on one shaft."""

    fixed: Teeth = Field(description="teeth of the pinion on the fixed rack")
    moving: Teeth = Field(description="teeth of the pinion on the moving rack")
    side: Literal["opposite", "same"] = Field(
        "opposite",
        description="where the moving rack lies, seen from the pinion: opposite the fixed one, or next to it",
    )

    @model_validator(mode="after")
    def _moves(self) -> Racks:
        if self.side == "same" and self.fixed == self.moving:
            message = "equal teeth on the same side leave the rack at rest\ngive other teeth, or side: opposite"
            raise refused(message, "moving")
        return self


@dataclass(frozen=True)
class RackDrive:
    """What the racks of a file make of a stroke.

    Parameters
        stroke : float [mm] - of the rod end
    Source
        thesis 2.2.2 III (2): the pinion rolls on the fixed rack
    """

    given: Racks
    stroke: float

    @cached_property
    def meshes(self) -> dict[str, RackMesh]:
        """Pinion and rack, of the fixed and of the moving one.

        Raises
            NoSolution - where they cannot mesh
        """
        with in_section("racks"):
            teeth = (self.given.fixed, self.given.moving)
            return {name: rack_at(self.given, z) for name, z in zip(NAMES, teeth, strict=True)}

    @property
    def radii(self) -> tuple[float, float]:
        """Radii with which the pinion rolls on both racks [mm]."""
        one, other = (mesh.pair.reference_radius[0] for mesh in self.meshes.values())
        return one, other

    @property
    def side(self) -> float:
        """+1 with the racks on opposite sides, -1 on the same."""
        return 1.0 if self.given.side == "opposite" else -1.0

    @property
    def stroke_ratio(self) -> float:
        """Stroke of the moving rack over that of the rod end, 1 +- z_m/z_f; negative: against it."""
        return 1.0 + self.side * self.given.moving / self.given.fixed

    @property
    def output_stroke(self) -> float:
        """Stroke of the moving rack [mm]."""
        return abs(self.stroke_ratio) * self.stroke

    @property
    def pinion_turns(self) -> float:
        """Turns of the pinion in a stroke."""
        return self.stroke / (2.0 * math.pi * self.radii[0])

    @property
    def fixed_rack_travel(self) -> float:
        """How far the pinion rolls on the fixed rack [mm]."""
        return self.stroke

    @property
    def moving_rack_travel(self) -> float:
        """How far it rolls on the moving rack [mm]."""
        return self.stroke * self.given.moving / self.given.fixed

    @property
    def fixed_rack_length(self) -> float:
        """Minimum length of the fixed rack [mm]: travel and path of contact."""
        return self.fixed_rack_travel + self._contact("fixed_rack")

    @property
    def moving_rack_length(self) -> float:
        """Minimum length of the moving rack [mm], likewise."""
        return self.moving_rack_travel + self._contact("moving_rack")

    def _contact(self, name: str) -> float:
        path = self.meshes[name].path
        return (path.end - path.start) * math.cos(self.meshes[name].working_pressure_angle)

    def quantity(self, name: str) -> Any:
        """A quantity by name, of a mesh after the name of its rack."""
        rack, _, quantity = name.rpartition(".")
        return self.meshes[rack].quantity(quantity) if rack else getattr(self, name)

    def checks(self, name: str, limits: Any) -> Iterator[Check]:
        """The findings of a gear check on both racks; on one where both are alike."""
        alike = self.given.fixed == self.given.moving
        for rack, mesh in self.meshes.items():
            with in_section("racks"):
                for found in mesh.checks(name, limits):
                    what = found.what if alike else f"{found.what} ({rack.replace('_', ' ')})"
                    yield found._replace(what=what)
            if alike:
                return

    # The mechanism, which imports numpy

    def links(self, slider: Link) -> dict[str, Link]:
        """Pinion and moving rack; the rod end is the pinion's axis, and travels along -y."""
        from gearlink.core.mechanism.links import Link
        from gearlink.core.mechanism.rates import Point, Turn

        (fixed, moving), end, ratio = self.radii, slider.origin, self.stroke_ratio
        turn = Turn(*(-each.imag / fixed for each in end))
        value, *rates = end
        place = Point(value.real - self.side * moving + 1j * ratio * value.imag, *(ratio * each for each in rates))
        level = Turn(*(0.0 * each for each in turn))
        return {"pinion": Link(end, turn, {"F": 0.0}), "rack": Link(place, level)}

    def joints(self, links: dict[str, Link]) -> list[Connection]:
        """The pinion's pin, both racks, and the guide of the moving one."""
        from gearlink.core.mechanism.joints import Guide, Pin, Rack
        from gearlink.core.mechanism.links import FRAME

        (fixed, moving), center = self.radii, links["pinion"].origin.value
        tangent = math.tan(self.meshes["fixed_rack"].working_pressure_angle)
        return [
            Pin("pinion", "slider", "pinion", center),
            Rack("mesh_fixed", FRAME, "pinion", center, -1j, -1.0 + 0j, fixed, tangent),
            Rack("mesh_moving", "rack", "pinion", center, -1j, complex(self.side), moving, tangent),
            Guide("rack_guide", FRAME, "rack", links["rack"].origin.value, -1j),
        ]
