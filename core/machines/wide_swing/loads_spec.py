"""The section `loads` of a wide swing: inertia and device stand in its own sections."""

from typing import Annotated, Any

from pydantic import Field, field_validator

from gearlink.core.base.spec import Spec, unit
from gearlink.core.studies.loads.spec import Body, CommonLoads, Material, Roller

Direction = Annotated[float, unit("deg", ge=-360, le=360)]


class SwingMasses(Spec):
    """Masses of what has none elsewhere; those of rocker and slider are the keys inertia and slider.mass."""

    cam: Body | None = Field(
        None, description="cam, in the frame of main_cam; one on a crank-rocker with its rocker, x to C"
    )
    return_cam: Body | None = Field(
        None, description="second cam of a twin-cam with its cycle, in the frame of return_cam"
    )
    rod: Body | None = Field(None, description="rod to the slider, from the rocker's pin E to F")
    crank: Body | None = Field(None, description="crank of the drive, from its pivot A to B")
    coupler: Body | None = Field(None, description="coupler of the drive, from B to C")


class SwingLoads(CommonLoads):
    """Forces, rollers and vibration of a wide-swing mechanism; its speed, inertia and device are its own.

    The bearing of the rollers is called roller: `bearings: {roller: {dynamic_rating: 8000, life: 20000}}`.

    Directions are counter-clockwise from the line of centres: from D to O of a twin-cam, from O to D of a twin-rocker.
    """

    device_direction: Direction | None = Field(
        None,
        description="direction from the rocker's axis D to the base pin of the device, or to the mass of type: gravity "
        "at mid-swing; default: no force at D",
    )
    slider_direction: Direction | None = Field(
        None, description="direction from D in which the slider is farthest; default: -90, and no force at D"
    )
    drive_direction: Direction | None = Field(
        None, description="direction from the cam's axis O to the crank's pivot A; default: -60, and no force at O"
    )

    @field_validator("bearings", mode="before")
    @classmethod
    def _kind_of_roller(cls, given: Any) -> Any:
        """A cam follower's rolling bodies are rollers, where the file does not say otherwise."""
        roller = given.get("roller") if isinstance(given, dict) else None
        return {**given, "roller": {"kind": "roller", **roller}} if isinstance(roller, dict) else given

    links: SwingMasses = Field(
        SwingMasses.model_construct(),
        description="masses of cams, rod and crank-rocker; a part without an entry has no mass",
    )
    roller: Roller | None = None
    material: Material | None = None
