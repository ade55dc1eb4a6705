"""The design file of a push rod."""

from typing import Annotated, Any, Literal

from pydantic import Field

from gearlink.core.base.spec import Deferred, DrivenSpec, Length, LoadLimits, SignedLength, Spec
from gearlink.core.studies.loads.spec import Body, Loads


class PushRodMasses(Spec):
    """Masses of the links."""

    crank: Body | None = Field(None, description="crank")
    rod: Body | None = Field(None, description="rod")
    slider: Body | None = Field(None, description="slider")


class PushRodLoads(Loads):
    """Masses, forces and drive."""

    links: PushRodMasses = Field(PushRodMasses.model_construct(), description="masses of the links")


class PushRodSpec(DrivenSpec):
    """Crank, rod, slider on +x."""

    kind: Literal["push-rod"]
    crank: Length = Field(description="crank")
    rod: Length = Field(description="rod")
    offset: SignedLength = Field(0.0, description="height of the slide line over the axis of the crank")
    limits: LoadLimits = LoadLimits.model_construct()
    loads: Annotated[Any, Deferred("push_rod.spec:PushRodLoads")] | None = Field(None, description="masses and forces")

    def commands(self) -> tuple[str, ...]:
        """What the file asks for."""
        return ("analyze", *(("loads",) if self.loads is not None else ()))
