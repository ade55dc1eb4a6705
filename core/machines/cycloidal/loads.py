"""The loads of a cycloidal reducer: eccentric, discs, output."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydantic import Field

from gearlink.core.base.design import geometry
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec import Spec
from gearlink.core.machines.cycloidal.design import CycloidalReducer
from gearlink.core.studies.loads.design import LoadsDesign, loads_outline
from gearlink.core.studies.loads.spec import Body, Loads

if TYPE_CHECKING:
    from gearlink.core.machines.cycloidal.spec import CycloidalReducerSpec


class ReducerMasses(Spec):
    """Masses of the links."""

    eccentric: Body | None = Field(None, description="shaft with the eccentrics, about its axis A")
    disc_1: Body | None = Field(None, description="first disc, about its centre E1")
    disc_2: Body | None = Field(None, description="second disc")
    disc_3: Body | None = Field(None, description="third disc")
    output: Body | None = Field(None, description="what turns as the output, with all that it drives")


class ReducerSection(Loads):
    """Masses, forces and drive of a cycloidal reducer."""

    links: ReducerMasses = Field(
        ReducerMasses.model_construct(), description="masses; a part without an entry has no mass"
    )


class ReducerLoads(LoadsDesign):
    """Input angle: the eccentric's; the pins that push are those of the side to which the torque presses."""

    kind = "cycloidal-reducer"
    spec: CycloidalReducerSpec
    section: ReducerSection
    links, output = ("eccentric", "disc_1", "disc_2", "disc_3", "output"), "output"
    pins, meshes = ("A", "D", "E1", "E2", "E3"), ()
    outlines = loads_outline(pins, meshes)
    design: cached_property[CycloidalReducer] = geometry(CycloidalReducer)

    @property
    def own_links(self) -> tuple[str, ...]:
        """As many discs as there are."""
        return ("eccentric", *(f"disc_{k}" for k in range(1, self.spec.discs + 1)), "output")

    @property
    def turns(self) -> int:
        """Turns of the eccentric after which the output comes home."""
        return abs(self.design.ratio)
