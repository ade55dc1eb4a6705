"""The study file: which designs, what is sought, what must hold."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import DesignSpec, Spec, only_one, refused, unit

_MOST_OBJECTIVES = 6
_MOST_DESIGNS = 1e12


Amount = Annotated[float, unit("the key's")]
Value = Amount | Annotated[int, unit("the key's")] | str | bool
Resolution = Annotated[float, unit("the quantity's")] | str


class VariableSpec(Spec):
    """A key of the design and its values: a list, or a range."""

    from_: Amount | None = Field(None, alias="from", description="minimum value, in multiples of `times`")
    to: Amount | None = Field(None, description="maximum value, in multiples of `times`")
    step: Annotated[float, unit("the key's", gt=0)] | None = Field(
        None, description="step of the range; default 1 for whole numbers; without it real numbers are sampled"
    )
    points: Annotated[int, unit("1", ge=2, le=100_000)] | None = Field(
        None, description="number of values from `from` to `to`, instead of step"
    )
    log: bool = Field(False, description="sampled, or divided into points, by equal ratios")
    times: str | None = Field(None, description="path of a variable above, whose multiples `from` and `to` are")
    values: Annotated[list[Value], Field(min_length=1, max_length=100_000)] | None = Field(
        None, description="list of values, instead of from and to"
    )
    also: list[str] = Field([], description="keys that always take the same value")

    @model_validator(mode="after")
    def _one_form(self) -> Self:
        if self.values is not None:
            for name in ("from_", "to", "step", "points", "times"):
                if getattr(self, name) is not None:
                    message = "values goes without from, to, step, points and times\ngive the one or the others"
                    raise refused(message, name.rstrip("_"))
            if self.log:
                raise refused("values are taken as they are\nomit log", "log")
            return self
        if self.from_ is None or self.to is None:
            missing = "from" if self.from_ is None else "to"
            raise refused("give from and to, or values", missing, "GL106")
        only_one(self, "step", "points")
        if self.times is not None and self.points is not None:
            raise refused("points cannot be combined with times\ngive step", "points")
        if self.to < self.from_:
            raise refused(f"the range is empty: from {self.from_:g} is above to {self.to:g}\nexchange them", "to")
        if self.log and self.step is not None:
            raise refused("step makes equal steps, log equal ratios\ngive points instead of step, or omit log", "log")
        if self.log and not self.from_ > 0.0:
            raise refused("log needs a range above 0", "from", "GL108")
        return self


class Checks(Spec):
    """Which checks a design must pass."""

    must_pass: Literal["default", "all", "none"] | list[str] = Field(
        "default", description="default: those that do not fail in the base; all, none, or a list of codes"
    )
    warn_counts: bool = Field(False, description="a warning counts as a failure")


class Sampling(Spec):
    """How many designs, and how they are chosen."""

    method: Literal["auto", "grid", "sobol"] = Field(
        "auto", description="auto: the whole grid where there is one within the budget, else a sample"
    )
    budget: Annotated[float, unit("1", ge=1, le=_MOST_DESIGNS)] | None = Field(
        None,
        description="maximum number of designs; default 1e8 on a grid, 2^17 sampled (20,000 and 2^12 of a scalar kind)",
    )
    seed: Annotated[int, unit("1", ge=0, le=2**31 - 1)] = Field(1, description="seed of the sample")


class Refine(Spec):
    """Local refinement of a sample."""

    steps: Annotated[int, unit("1", ge=0, le=1000)] = Field(
        40, description="maximum number of improvement rounds from each kept design; 0: none"
    )


class StudySpec(DesignSpec):
    """Many designs of one kind and which of them are the best."""

    kind: Literal["study"]
    of: str | None = Field(None, description="design file of the base design, relative to the study")
    design: dict[str, Any] | None = Field(None, description="the base design itself, instead of of")
    command: str | None = Field(None, description="whose checks count; default: the first that the base specifies")
    variables: Annotated[dict[str, VariableSpec], Field(min_length=1, max_length=64)] = Field(
        description="by the paths of the design's keys: {from, to, step}, or {values: [...]}"
    )
    define: dict[str, str] = Field({}, description="names of expressions of quantities")
    minimize: dict[str, Resolution] = Field({}, description="quantities and their resolution, as 10 mm")
    maximize: dict[str, Resolution] = Field({}, description="quantities and their resolution, as 2 deg")
    where: list[str] = Field([], description="conditions on quantities, as frame_length <= 220 mm")
    checks: Checks = Checks.model_construct()
    sampling: Sampling = Sampling.model_construct()
    refine: Refine = Refine.model_construct()

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        if (self.of is None) == (self.design is None):
            raise refused("give `of` or `design`, exactly one", "of" if self.of is not None else "design", "GL150")
        objectives = [*self.minimize, *self.maximize]
        if not objectives:
            raise refused("give minimize, maximize or both", "minimize", "GL106")
        if len(objectives) > _MOST_OBJECTIVES:
            message = f"{len(objectives)} objectives are more than {_MOST_OBJECTIVES}"
            key = "maximize" if self.maximize else "minimize"
            raise refused(f"{message}\nmake some of them conditions under where", key, "GL108")
        return self

    def commands(self) -> tuple[str, ...]:
        """A study is explored."""
        return ("explore",)
