"""The section `rating` of gears: what ISO 6336 needs to compute its factors."""

from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from gearlink.core.base.spec import Entries, Spec, only_one, refused, unit
from gearlink.core.base.wording import unlike
from gearlink.core.parts.gears.keys.types import AccuracyGrade, OneOrTwo, Stress, Two
from gearlink.core.parts.gears.rating.conditions import Conditions, Modification, Point, Shaft, System
from gearlink.core.parts.gears.rating.materials import CLASSES, MATERIALS, STEELS, GearSteel, Quality, gear_steel

_MOST_SHARE = 1e-9
_WEBS = ((0.2, 1.2), (1.0, 30.0))
"""Of b_s/b and s_R/m, where C_R is known."""


def _a_material(name: str) -> str:
    if name in MATERIALS:
        return name
    from difflib import get_close_matches

    near = get_close_matches(name, MATERIALS, 1, 0.6)
    meant = f"did you mean {near[0]}? " if near else ""
    others = "another steel by the class of its heat treatment"
    help = f"{meant}steels: {', '.join(STEELS)}; {others}: {', '.join(CLASSES)}"
    raise refused(f"no material is called {name!r}\n{help}", code="GL108")


MaterialName = Annotated[str, AfterValidator(_a_material), Field(json_schema_extra={"enum": list(MATERIALS)})]
Hardness = Annotated[float, unit("1", ge=50, le=1200)]
Roughness = Annotated[float, unit("um", gt=0, le=500)]
Micrometers = Annotated[float, unit("um", gt=0, le=1e4)]
Viscosity = Annotated[float, unit("mm^2/s", ge=1, le=1e4)]
Bore = Annotated[float, unit("mm", ge=0, le=1e6)]
Reach = Annotated[float, unit("mm", gt=0, le=1e6)]
Contacts = Annotated[float, unit("1", ge=0, le=100)]
WebRatio = Annotated[float, unit("1", ge=0.2, le=30)]
MeanStress = Annotated[float, unit("1", gt=0, le=1)]


class RoughnessSpec(Spec):
    """Roughness of flank and root: each one number, or one for each gear."""

    flank: OneOrTwo[Roughness] = Field(4.8, description="Rz of the flanks")
    root: OneOrTwo[Roughness] = Field(20.0, description="Rz of the root fillets")
    ra: OneOrTwo[Roughness] | None = Field(None, description="Ra of the flanks; default: Rz/8")


class LubricantSpec(Spec):
    """The oil: its viscosity at 40 deg C, and further data for the safety against scuffing."""

    vg: Viscosity | None = Field(None, description="viscosity class ISO VG, the viscosity at 40 deg C")
    viscosity_40: Viscosity | None = Field(None, description="viscosity at 40 deg C, instead of vg")
    viscosity_100: Viscosity | None = Field(None, description="viscosity at 100 deg C, for scuffing")
    temperature: Annotated[float, unit("deg C", ge=-50, le=250)] | None = Field(
        None, description="temperature of the oil, for scuffing"
    )
    scuffing_stage: Annotated[int, unit("1", ge=8, le=14)] | None = Field(
        None, description="failure load stage of the oil in the test FZG A/8.3/90, for scuffing"
    )

    @model_validator(mode="after")
    def _whole(self) -> Self:
        needed = "give vg or viscosity_40, the viscosity at 40 deg C"
        only_one(self, "vg", "viscosity_40", needed=needed)
        names = ("viscosity_100", "temperature", "scuffing_stage")
        missing = [name for name in names if getattr(self, name) is None]
        if missing and len(missing) < len(names):
            message = f"scuffing needs {', '.join(names)} together: {missing[0]} is missing"
            raise refused(message, missing[0], "GL106")
        if self.viscosity_100 is not None and self.viscosity_100 >= self.at_40:
            message = "viscosity_100 is not below the viscosity at 40 deg C\nreduce viscosity_100"
            raise refused(message, "viscosity_100")
        return self

    @property
    def at_40(self) -> float:
        """nu_40 [mm^2/s]."""
        found = self.viscosity_40 if self.vg is None else self.vg
        assert found is not None, "the validator requires one"
        return found


class ShaftSpec(Spec):
    """The shaft of the pinion, whose deflection is in the face load factor."""

    position: Literal["a", "b", "c", "d", "e"] = Field(
        description=(
            "arrangement of the pinion by ISO 6336-1: a between bearings with the torque from the far side, b from "
            "the near side, c overhung, d and e on further shafts"
        )
    )
    span: Reach = Field(description="distance l of the bearings")
    offset: Bore = Field(description="distance s of the pinion from their middle")
    diameter: Reach = Field(description="diameter d_sh of the shaft")
    stiffened: bool = Field(False, description="the body of the pinion supports the shaft")


class FaceSpec(Spec):
    """What is known of the contact across the face."""

    shaft: ShaftSpec | None = Field(None, description="the shaft of the pinion; default: no deflection of a shaft")
    misalignment: Micrometers | None = Field(
        None, description="F_betax before running-in as measured, instead of shaft and tolerances"
    )
    modification: Modification | None = Field(None, description="of the helix: none (default), crowning, or end-relief")

    @model_validator(mode="after")
    def _one_way(self) -> Self:
        if self.misalignment is None:
            return self
        for key in ("shaft", "modification"):
            if getattr(self, key) is not None:
                message = f"misalignment already includes all effects\nomit {key}"
                raise refused(message, key)
        return self


class PointSpec(Spec):
    """A row of the load spectrum, in multiples of `load`."""

    torque: Annotated[float, unit("1", ge=0, le=1e3)] = Field(1.0, description="torque over load.torque")
    speed: Annotated[float, unit("1", gt=0, le=1e3)] = Field(1.0, description="speed over load.speed")
    share: Annotated[float, unit("1", ge=0, le=1)] = Field(description="share of the life; all add up to 1")


class RatingSpec(Spec):
    """Life, material, accuracy, surface and oil; what stands for each gear is one value, or a list of two."""

    life: Annotated[float, unit("h", gt=0, le=1e9)] = Field(description="required life")
    material: OneOrTwo[MaterialName] | None = Field(
        None, description="steel or class of ISO 6336-5; optional if the material gives both limits"
    )
    hardness: Hardness | Two[Hardness | None] | None = Field(
        None, description="HV, of cast iron and normalized steel HBW; default: usual for the steel"
    )
    brinell: Hardness | Two[Hardness | None] | None = Field(
        None, description="HBW of the flank, for the work hardening; default: hardness"
    )
    yield_strength: Stress | Two[Stress | None] | None = Field(
        None, description="yield point, for the notch sensitivity; default: that of the steel"
    )
    quality: Quality = Field("MQ", description="of the material: ML, MQ or ME")
    grade: OneOrTwo[AccuracyGrade] | None = Field(
        None, description="accuracy grade of ISO 1328-1; default: accuracy_grade"
    )
    tolerance_edition: Literal[1995, 2013] = Field(2013, description="edition of ISO 1328-1")
    roughness: RoughnessSpec = RoughnessSpec.model_construct()
    lubricant: LubricantSpec
    tip_relief: Micrometers | None = Field(None, description="C_a of both gears")
    bore: OneOrTwo[Bore] = Field(0.0, description="bore; of a ring the outside diameter")
    web: Annotated[Two[WebRatio], Entries("[b_s/b, s_R/m]", "[0.25, 5]")] | None = Field(
        None, description="thickness of the web over the width, and of the rim over the module; default: solid"
    )
    system: System = Field(
        "pair", description="pair, sun-planet (gear 1 the sun) or planet-ring, as seen from the carrier"
    )
    planets: Annotated[int, unit("1", ge=1, le=20)] | None = Field(
        None, description="planets of sun-planet and planet-ring"
    )
    reduced_mass: Annotated[float, unit("kg/mm", gt=0, le=1e9)] | None = Field(
        None, description="m_red, instead of the one of system and bore"
    )
    contacts: OneOrTwo[Contacts] = Field(
        1.0, description="load contacts of a tooth per revolution; a sun has as many as planets, a ring too"
    )
    face: FaceSpec | None = Field(None, description="shaft, modification, or misalignment; default: none")
    long_life: Annotated[float, unit("1", ge=0.85, le=1)] = Field(
        0.85, description="life factor at 1e10 load cycles; 1 only for best material and experience"
    )
    pitting: Literal["none", "allowed"] = Field("none", description="limited pitting: none or allowed")
    mean_stress: OneOrTwo[MeanStress] | None = Field(
        None, description="mean stress influence factor Y_M; default: 1, of an idler or planet 0.7"
    )
    root_shift: Literal["generating", "nominal"] = Field(
        "generating", description="profile shift of the root in the rating: with the upper allowance, or nominal"
    )
    ring_root: Literal["generated", "iso"] = Field(
        "generated", description="fillet radius of a ring with cutter: of its cutter, or that of ISO 6336-3 with |z_n|"
    )
    spectrum: Annotated[list[PointSpec], Field(min_length=1, max_length=1000)] | None = Field(
        None, description="load spectrum in multiples of load"
    )

    @model_validator(mode="after")
    def _whole(self) -> Self:
        if self.spectrum is not None and abs(sum(row.share for row in self.spectrum) - 1.0) > _MOST_SHARE:
            total = sum(row.share for row in self.spectrum)
            message = f"sum of the shares of the spectrum: {unlike(total, 1.0)} (required 1)"
            message += f"\nchange one of them by {1.0 - total:+.4g}"
            raise refused(message, "spectrum")
        if self.spectrum is not None and not any(row.torque and row.share for row in self.spectrum):
            raise refused("the spectrum has no load\ngive a torque above 0", "spectrum")
        for place, (low, high) in enumerate(_WEBS if self.web is not None else ()):
            if self.web is not None and not low <= self.web[place] <= high:
                message = f"web[{place}] must be from {low:g} to {high:g}, not {self.web[place]:g}"
                raise refused(message, f"web[{place}]", "GL108")
        if self.system == "pair" and self.planets is not None:
            message = "planets applies only with system: sun-planet or planet-ring\nomit it"
            raise refused(message, "planets")
        if self.system != "pair" and self.planets is None and self.reduced_mass is None:
            raise refused(f"{self.system} needs planets, their number", "planets", "GL106")
        return self

    def _steel(self, gear: int, limits: tuple[float | None, float | None]) -> GearSteel:
        values = {name: one_of(getattr(self, name), gear) for name in ("hardness", "brinell", "yield_strength")}
        name = one_of(self.material, gear)
        return gear_steel(name, self.quality, **values, contact_limit=limits[0], bending_limit=limits[1])

    def conditions(
        self, limits: tuple[tuple[float | None, float | None], ...], accuracy_grade: int | None
    ) -> Conditions:
        """What the rating takes.

        Parameters
            limits : ((sigma_Hlim, sigma_Flim), ...) of gear 1 and 2 [N/mm^2] - None: by the material
            accuracy_grade : int or None - for a file without rating.grade
        """
        rough, oil, face = self.roughness, self.lubricant, self.face
        flank = two(rough.flank)
        grades = two(accuracy_grade if self.grade is None else self.grade)
        return Conditions(
            life=self.life,
            steels=(self._steel(0, limits[0]), self._steel(1, limits[1])),
            quality=self.quality,
            grades=grades,
            edition=self.tolerance_edition,
            flank_roughness=flank,
            root_roughness=two(rough.root),
            ra=(flank[0] / 8.0, flank[1] / 8.0) if rough.ra is None else two(rough.ra),
            viscosity_40=oil.at_40,
            viscosity_100=oil.viscosity_100,
            oil_temperature=oil.temperature,
            scuffing_stage=oil.scuffing_stage,
            tip_relief=self.tip_relief,
            bores=two(self.bore),
            web=None if self.web is None else two(self.web),
            system=self.system,
            planets=self.planets or 1,
            reduced_mass=self.reduced_mass,
            contacts=two(self.contacts),
            shaft=None if face is None or face.shaft is None else Shaft(**face.shaft.model_dump()),
            misalignment=None if face is None else face.misalignment,
            modification="none" if face is None or face.modification is None else face.modification,
            long_life=self.long_life,
            pitting_allowed=self.pitting == "allowed",
            mean_stress=None if self.mean_stress is None else two(self.mean_stress),
            generating_root=self.root_shift == "generating",
            generated_ring=self.ring_root == "generated",
            spectrum=tuple(Point(row.torque, row.speed, row.share) for row in self.spectrum or ()),
            given=self._named,
        )

    @property
    def _named(self) -> frozenset[str]:
        """The keys that the file has, those of sections with the section before them."""
        found = set(self.model_fields_set)
        for section in ("roughness", "lubricant", "face"):
            part = getattr(self, section)
            found |= {f"{section}.{key}" for key in (part.model_fields_set if part is not None else ())}
        return frozenset(found)


def one_of(value: Any, gear: int) -> Any:
    """The value of a gear, of one for both or a list."""
    return value[gear] if isinstance(value, list) else value


def two(value: Any) -> Any:
    """The values of both gears."""
    return one_of(value, 0), one_of(value, 1)


def require_rated(spec: Any, rating: Any) -> None:
    """Refuse a rating that lacks what it needs, or contradicts what else stands in the file.

    Parameters
        spec : with load, material, face_width, accuracy_grade
        rating : RatingSpec
    Raises
        PydanticCustomError
    """

    def refuse(code: Literal["GL106", "GL111"], key: str, message: str) -> None:
        raise refused(message, key, code)

    if spec.load is None:
        refuse("GL106", "load", "rating needs load: torque (or power, or tangential_force) and speed")
    if spec.load.speed is None:
        refuse("GL106", "load.speed", "rating needs load.speed, the speed of gear 1")
    if spec.face_width is None:
        refuse("GL106", "face_width", "rating needs face_width")
    if rating.grade is None and spec.accuracy_grade is None:
        refuse(
            "GL106", "rating.grade", "rating needs an accuracy grade of ISO 1328-1\ngive rating.grade or accuracy_grade"
        )
    material = spec.material
    for product in ("contact_factors", "bending_factors"):
        if material is not None and product in material.model_fields_set:
            text = f"rating computes the factors whose product is material.{product}\nomit it"
            refuse("GL111", f"material.{product}", text)
    factors = spec.load.factors.model_fields_set
    if rating.face is not None and "face_contact" in factors:
        refuse(
            "GL111",
            "rating.face",
            "load.factors.face_contact already gives the face load factor\nomit face or load.factors.face_contact",
        )
    limits = [None if material is None else getattr(material, f"{name}_limit") for name in ("contact", "bending")]
    if rating.material is None and None in limits:
        refuse(
            "GL106", "rating.material", "rating needs the material of the gears: a steel, or both limits in material"
        )
    _require_hardness(rating, any(limit is None for limit in limits), refuse)


def _require_hardness(rating: Any, by_material: bool, refuse: Any) -> None:
    names = rating.material if isinstance(rating.material, list) else [rating.material]
    for place, name in enumerate(names):
        hardness = one_of(rating.hardness, place) if len(names) > 1 else rating.hardness
        lacking = hardness is None or (isinstance(hardness, list) and None in hardness)
        if by_material and name in CLASSES and CLASSES[name].needs_hardness and lacking:
            text = f"the strength of {name} depends on its hardness, which is missing\ngive rating.hardness"
            refuse("GL106", "rating.hardness", text)
