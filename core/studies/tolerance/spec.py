"""The section `tolerance` of a design file."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.errors import NoSolution, named
from gearlink.core.base.spec import Angle, Distance, Length, Spec, also, refused, unit
from gearlink.core.base.torsion import OfShaft

_SIZES = (
    "plus_minus",
    "lower",
    "limits",
    "sigma",
    "class",
    "fit",
    "group",
    "clearance",
    "grade",
    "eccentricity",
    "measured",
)
Deviation = Annotated[float, unit("mm")]  # of an angle deg
Width = Annotated[float, unit("mm", gt=0)]
Positive = Annotated[float, unit("1", gt=0)]
FlankClass = Annotated[int, Field(json_schema_extra={"unit": "1", "minimum": 1, "maximum": 11})]
Grade = Annotated[int, Field(json_schema_extra={"unit": "1", "minimum": 1, "maximum": 18})]
Torque = Annotated[float, unit("N m")]
Share = Annotated[float, unit("1", gt=0, lt=1)]
Pair = Annotated[list[Deviation], Field(min_length=2, max_length=2)]


class ToleranceSource(Spec):
    """Tolerance of one dimension: its limits in one of several forms, and its distribution."""

    plus_minus: Width | None = Field(None, description="limits at the same distance to either side; of an angle in deg")
    lower: Deviation | None = Field(None, description="lower limit of the deviation")
    upper: Deviation | None = Field(None, description="upper limit of the deviation")
    limits: Pair | None = Field(None, description="[lower, upper] limit of the deviation")
    sigma: Width | None = Field(None, description="standard deviation of a normal law; limits at 3 sigma")
    class_: str | None = Field(
        None, alias="class", description="tolerance class of ISO 286 at the nominal size, such as js7"
    )
    fit: str | None = Field(None, description="fit of a pin in its hole, such as H7/g6")
    size: Length | None = Field(None, description="nominal diameter of the fit")
    group: str | None = Field(None, description="clearance group of a deep-groove ball bearing: C2, CN, C3, C4, C5")
    bore: Length | None = Field(None, description="bore of the bearing")
    clearance: Pair | None = Field(None, description="[minimum, maximum] clearance in diameter")
    reduction: Distance = Field(0.0, description="reduction of the bearing's clearance by fits and heat")
    grade: FlankClass | None = Field(None, description="flank tolerance class of ISO 1328-1:2013, 1 to 11")
    width: Length | None = Field(None, description="face width of the gear")
    eccentricity: Length | None = Field(None, description="maximum distance of a gear's pitch circle from its axis")
    phase: Angle | None = Field(
        None, description="measured direction of the eccentricity at input angle 0; default: any"
    )
    measured: Deviation | None = Field(None, description="absolute size of one part in reserve: it does not vary")
    law: Literal["normal", "uniform", "triangular", "truncated"] = Field(
        "normal", description="law of distribution", json_schema_extra=also("distribution")
    )
    mode: Deviation | None = Field(None, description="deviation at the peak of a triangular law; default: the middle")
    cp: Positive = Field(1.0, description="process capability C_p: limits lie at 3 C_p standard deviations")
    cpk: Positive | None = Field(None, description="capability C_pk of a process off the middle, at most C_p")
    shift: Literal["up", "down"] | None = Field(None, description="limit towards which the process is shifted")
    play: Literal["contact", "floating"] = Field(
        "contact", description="contact of the pin with its hole: touching, or anywhere in it"
    )
    cost: Positive = Field(1.0, description="cost of this part at IT9, in any unit")
    grades: Annotated[list[Grade], Field(min_length=2, max_length=2)] | None = Field(
        None, description="[finest, coarsest] IT grade that may be chosen"
    )

    @property
    def form(self) -> str:
        """The key that gives the size of the scatter."""
        return next(name for name in _SIZES if getattr(self, name if name != "class" else "class_") is not None)

    @model_validator(mode="after")
    def _one_form(self) -> Self:
        given = [name for name in _SIZES if getattr(self, name if name != "class" else "class_") is not None]
        if self.upper is not None and self.lower is None:
            raise refused("upper without lower\ngive both, or plus_minus", code="GL171")
        if self.lower is not None and self.upper is None:
            raise refused("lower without upper\ngive both, or plus_minus", code="GL171")
        if not given and self.grades is not None:
            text = "grades alone give no initial tolerance, which --allocate needs\nadd class: js8, or plus_minus"
            raise refused(text, code="GL171")
        if not given:
            raise refused(f"no limits\ngive one of {', '.join(_SIZES)}", code="GL171")
        if len(given) > 1:
            raise refused(f"{' and '.join(given)} exclude each other\nkeep one", code="GL171")
        self._complete(given[0])
        self._process()
        return self

    def _complete(self, form: str) -> None:
        for one, other in (("fit", "size"), ("group", "bore"), ("grade", "width")):
            if (form == one) != (getattr(self, other) is not None):
                what = f"{other} belongs to {one}" if form != one else f"{one} needs {other}"
                fix = "give both or neither" + ("; for a length write class: js7" if one == "grade" else "")
                raise refused(f"{what}\n{fix}", code="GL171")
        for name, pair in (("limits", self.limits), ("clearance", self.clearance), ("lower", (self.lower, self.upper))):
            if form == name and pair is not None and not pair[0] < pair[1]:  # type: ignore[operator]
                raise refused(
                    f"the limits {pair[0]:g} and {pair[1]:g} have no width: the first must be the smaller", code="GL171"
                )
        if self.clearance is not None and self.clearance[0] < 0:
            raise refused(f"a clearance of {self.clearance[0]:g} mm is an interference\ngive 0 or more", code="GL171")
        if self.grades is not None and not 1 <= self.grades[0] <= self.grades[1] <= 18:
            raise refused(
                f"grades {self.grades}\ngive the finest and the coarsest of IT1 to IT18, in that order", code="GL173"
            )

    def _process(self) -> None:
        if self.cpk is not None and self.cpk > self.cp:
            raise refused(
                f"cpk: {self.cpk:g} (limit <= {self.cp:g}, cp)\nreduce cpk or increase cp (equal at mid-tolerance)",
                code="GL172",
            )
        if self.cpk is not None and self.cpk < self.cp and self.shift is None:
            raise refused(
                f"cpk: {self.cpk:g} (limit >= {self.cp:g}, cp, without shift)\ngive shift: up or down", code="GL172"
            )
        if self.mode is not None and self.law != "triangular":
            raise refused(f"mode applies only to the triangular law, not to {self.law}\nomit it", code="GL171")


class Correlation(Spec):
    """Sources that vary together."""

    sources: Annotated[list[str], Field(min_length=2)] = Field(description="keys of `sources`")
    rho: Annotated[float, Field(json_schema_extra={"unit": "1", "minimum": -1, "maximum": 1})] = Field(
        description="correlation of each pair of them (Gaussian copula)"
    )

    @model_validator(mode="after")
    def _a_correlation(self) -> Self:
        if not -1.0 <= self.rho <= 1.0:
            raise refused(f"rho: {self.rho:g} (limit -1 to 1)\ngive a correlation within -1 and 1", "rho", "GL176")
        return self


class Cost(Spec):
    """What a finer grade costs."""

    ratio: Annotated[float, unit("1", gt=1)] = Field(
        1.6, description="cost of one IT grade finer over that of the grade"
    )


class Tolerance(Spec):
    """Tolerances of a design, for the commands tolerance and register."""

    command: str | None = Field(
        None, description="command whose quantities and checks are evaluated; default the file's first"
    )
    seed: Annotated[int, unit("1", ge=0, le=2**32 - 1)] = Field(1, description="the same seed gives the same samples")
    samples: Annotated[int, unit("1", ge=16, le=2**24)] | None = Field(
        None, description="rounded up to 16 x 2^k; default 131072, 4096 where each design is computed alone"
    )
    sources: dict[str, ToleranceSource] = Field(description="tolerances of dimensions, by the keys of this file")
    correlated: list[Correlation] = Field([], description="sources that vary together")
    require: list[str] = Field(
        [], description="conditions in addition to the checks, such as back_step_angle <= 20.4 deg"
    )
    target_yield: Share | None = Field(None, description="required share of good designs; below it the command fails")
    cost: Cost = Cost.model_construct()
    sobol: bool = Field(False, description="Sobol' indices in the table contributions (--sobol)")

    @model_validator(mode="after")
    def _known_sources(self) -> Self:
        for group in self.correlated:
            if unknown := [name for name in group.sources if name not in self.sources]:
                raise refused(
                    f"{named(unknown[0])} of correlated is not a source\nname keys of `sources`", "correlated", "GL176"
                )
            if twice := [name for name in group.sources if group.sources.count(name) > 1]:
                raise refused(
                    f"{named(twice[0])} is listed twice in one group of correlated\nname different sources",
                    "correlated",
                    "GL176",
                )
        return self


class Register(Spec):
    """What the register of a printing machine may lose, for the command register."""

    tolerance: Length | None = Field(None, description="maximum error that is allowed, to either side")
    at: str | Annotated[float, unit("deg")] | None = Field(
        None, description="dwell, zone, handover, range, or an input angle in degrees"
    )
    method: Literal["worst", "rss", "mc"] = Field("rss", description="how the band is computed")
    radius: Length | None = Field(
        None, description="radius at which the output's error is measured; default its reference radius"
    )
    output: str | None = Field(
        None, description="output whose error is computed, if there are several; default: the first"
    )
    direction: Annotated[float, unit("deg", ge=-360, le=360)] | None = Field(
        None, description="of an output that is a point: direction in which its error counts; default along x"
    )
    backlash: Distance | dict[str, Distance] | None = Field(
        None, description="circumferential backlash of each mesh by its name, or one value for all"
    )
    cam_error: Length | None = Field(None, description="maximum error of a cam's profile, at right angles to it")
    output_inertia: Annotated[float, unit("kg m^2", gt=0)] | None = Field(
        None, description="moment of inertia of all parts that turn with the output"
    )
    friction: Annotated[Torque, Field(ge=0)] = Field(0.0, description="friction torque on the output")
    load: Torque = Field(0.0, description="load torque of the machine on the output")
    stiffness: Annotated[float, unit("N m/rad", gt=0)] | OfShaft | None = Field(
        None, description="of the output shaft, or its sizes; default: rigid"
    )

    def backlash_of(self, meshes: tuple[str, ...]) -> dict[str, float]:
        """Backlash of each mesh of a machine; empty where none is given."""
        given = self.backlash
        if given is None:
            return {}
        if not isinstance(given, dict):
            return dict.fromkeys(meshes, given)
        if unknown := [name for name in given if name not in meshes]:
            message = f"no mesh {named(unknown[0])}: there are {', '.join(meshes)}"
            raise NoSolution(message, key=f'register.backlash."{unknown[0]}"')
        return {name: given.get(name, 0.0) for name in meshes}
