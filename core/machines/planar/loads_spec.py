"""The section `loads` of a planar mechanism."""

from typing import Annotated

from pydantic import Field

from gearlink.core.studies.loads.spec import Body, Loads


class PlanarLoads(Loads):
    """Masses, forces and drive of a planar mechanism, by the names of its links."""

    links: Annotated[dict[str, Body], Field(max_length=100)] = Field(
        {},
        description="masses of the links by name, centres in their own coordinates; a link without an entry has "
        "no mass",
    )
