"""The section `loads` of a flatbed press."""

from typing import Annotated, Literal

from pydantic import Field

from gearlink.core.base.spec import Length, Spec, unit
from gearlink.core.studies.loads.spec import Body, CommonLoads, Material, Roller, masses

Direction = Annotated[float, unit("deg", ge=-360, le=360)]


class PressMasses(Spec):
    """Masses of the links; a gear or a cam that is fixed to a link belongs to it."""

    gear2: Body | None = Field(None, description="gear 2 with crank AB")
    BC: Body | None = Field(None, description="coupler of the bed drive")
    CDE: Body | None = Field(None, description="driven crank of the bed drive with the cams, from D to C")
    EF: Body | None = Field(None, description="connecting rod, from E to F")
    carriage: Body | None = Field(None, description="carriage of the pinion, at F")
    pinion: Body | None = Field(None, description="pinion on F")
    rack: Body | None = Field(None, description="lower rack with the cam's follower")
    bed: Body | None = Field(None, description="bed with the upper rack")
    gear1: Body | None = Field(None, description="gear 1 with crank GH")
    HM: Body | None = Field(None, description="coupler of the cylinder drive, from H to M")
    MN: Body | None = Field(None, description="driven crank of the cylinder drive with gear 3, from N to M")
    cylinder: Body | None = Field(None, description="cylinder with gear 4")


class PressLoads(CommonLoads):
    """Masses, forces and drive of a flatbed press; its speed is the press's own."""

    links: PressMasses = masses(PressMasses)
    bed_side: Literal[1, -1] = Field(
        1,
        description=(
            "side of F on which the bed lies, along x: 1, and N lies from G along +x; -1, the machine as drawn, bed "
            "and N towards -x, which is upwards: gravity [9.81, 0]"
        ),
    )
    gear_1_direction: Direction | None = Field(
        None, description="direction from A to G; default: no bearing forces of gears 1 and 2"
    )
    cylinder_direction: Direction | None = Field(
        None, description="direction from N to the cylinder's axis; default: no bearing forces of gear 3 and cylinder"
    )
    drive_gear: Literal[1, 2] = Field(2, description="the gear that the motor drives")
    pinion_radius: Length | None = Field(
        None, description="pitch radius of the pinion; default: 5/31 of the bed's stroke, as in the TY-460"
    )
    cylinder_gear_radius: Length | None = Field(
        None, description="pitch radius of gear 4; default: 34/35 of the cylinder's radius, as in the TY-460"
    )
    roller: Roller | None = None
    material: Material | None = None
