"""The loads of mechanisms of gears or links with cams; grooves and cams hold their rollers both ways."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydantic import Field

from gearlink.core.base.design import geometry, placed
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec import Spec
from gearlink.core.machines.cam_drives.grooved import CamGear, CamLinkage
from gearlink.core.machines.cam_drives.linked import LinkedCams
from gearlink.core.studies.loads.design import LoadsDesign, loads_outline
from gearlink.core.studies.loads.spec import Body, Loads

if TYPE_CHECKING:
    from gearlink.core.machines.cam_drives.spec import CamGearSpec, CamLinkageSpec, LinkedCamsSpec

_NOTHING = "masses; a part without an entry has no mass"


class CamGearMasses(Spec):
    """Masses of the links."""

    carrier: Body | None = Field(None, description="carrier, from A to the planet's axis B")
    planet: Body | None = Field(None, description="planet with its lever, from B to the roller")
    sun: Body | None = Field(None, description="sun with all parts that turn with it, about D")


class CamGearSection(Loads):
    """Masses, forces and drive of a cam-gear."""

    links: CamGearMasses = Field(CamGearMasses.model_construct(), description=_NOTHING)


class CamLinkageMasses(Spec):
    """Masses of the links."""

    input: Body | None = Field(None, description="input link, from A to B")
    coupler: Body | None = Field(None, description="coupler, from B to C")
    follower: Body | None = Field(None, description="follower, from D to C")
    output: Body | None = Field(None, description="output link, from E to D, with all that turns with it")


class CamLinkageSection(Loads):
    """Masses, forces and drive of a cam-linkage."""

    links: CamLinkageMasses = Field(CamLinkageMasses.model_construct(), description=_NOTHING)


class LinkedMasses(Spec):
    """Masses of shaft and slides."""

    cam: Body | None = Field(None, description="shaft with both cams")
    slide_x: Body | None = Field(None, description="slide along x")
    slide_y: Body | None = Field(None, description="slide along y")
    table: Body | None = Field(None, description="parts that move along the path")


class LinkedCamsSection(Loads):
    """Masses, forces and drive of linked cams."""

    links: LinkedMasses = Field(LinkedMasses.model_construct(), description=_NOTHING)


class GroovedLoads(LoadsDesign):
    """What both drives with a groove have: an output that stands where the file says so."""

    stands = True
    quiet_zones: list[tuple[float, float]] = placed("design.output_motion.dwells")


class CamGearLoads(GroovedLoads):
    """Input angle: the carrier's, from +x."""

    kind = "cam-gear"
    spec: CamGearSpec
    section: CamGearSection
    links, output = ("carrier", "planet", "sun"), "sun"
    pins, meshes = ("A", "B", "D"), ("mesh",)
    outlines = loads_outline(pins, meshes)
    design: cached_property[CamGear] = geometry(CamGear)


class CamLinkageLoads(GroovedLoads):
    """Input angle: that of AB, from +x."""

    kind = "cam-linkage"
    spec: CamLinkageSpec
    section: CamLinkageSection
    links, output = ("input", "coupler", "follower", "output"), "output"
    pins, meshes = ("A", "B", "C", "D", "E"), ()
    outlines = loads_outline(pins, meshes)
    design: cached_property[CamLinkage] = geometry(CamLinkage)

    @property
    def transmission_angle(self) -> float | None:
        """None: the pressure angle stands instead."""
        return None


class LinkedCamsLoads(LoadsDesign):
    """Input angle: the shaft's."""

    kind = "linked-cams"
    spec: LinkedCamsSpec
    section: LinkedCamsSection
    links, sliding = ("cam", "slide_x", "slide_y", "table"), ("slide_x", "slide_y")
    output = "table"
    pins, meshes = ("O",), ()
    outlines = loads_outline(pins, meshes)
    design: cached_property[LinkedCams] = geometry(LinkedCams)
