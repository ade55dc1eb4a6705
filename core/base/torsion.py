"""Shafts as torsion springs: a stiffness, or the sizes of a shaft that it follows from."""

import math
from typing import Annotated, Self, TypeAlias

from pydantic import Field, model_validator

from gearlink.core.base.spec import Distance, Length, Spec, refused

SHEAR_MODULUS = 79300.0
"""Of steel [N/mm^2]."""


class ShaftPiece(Spec):
    """A cylindrical piece of a steel shaft, for its stiffness in torsion."""

    diameter: Length = Field(description="outer diameter")
    length: Length = Field(description="length between the parts that it connects")
    bore: Distance = Field(0.0, description="inner diameter")

    @model_validator(mode="after")
    def _hollow(self) -> Self:
        if self.bore >= self.diameter:
            message = f"bore {self.bore:g} mm is not below the diameter {self.diameter:g} mm"
            raise refused(f"{message}\nset a smaller bore", "bore")
        return self

    @property
    def stiffness(self) -> float:
        """c = pi G (d^4 - d_i^4)/(32 l), G = 79300 N/mm^2 of steel [N m/rad]."""
        return 1e-3 * math.pi * SHEAR_MODULUS * (self.diameter**4 - self.bore**4) / (32.0 * self.length)


OfShaft: TypeAlias = ShaftPiece | Annotated[list[ShaftPiece], Field(min_length=1, max_length=100)]
"""A piece of a shaft, or the pieces of a stepped one."""


def torsional_stiffness(given: float | ShaftPiece | list[ShaftPiece]) -> float:
    """Stiffness of a shaft that is given by it, or by the sizes of its pieces [N m/rad]."""
    if isinstance(given, ShaftPiece):
        return given.stiffness
    if isinstance(given, list):
        return 1.0 / math.fsum(1.0 / piece.stiffness for piece in given)
    return given
