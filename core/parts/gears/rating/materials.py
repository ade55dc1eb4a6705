"""Materials of gears by ISO 6336-5: classes, named steels, and what the rating takes of each class."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

Quality = Literal["ML", "MQ", "ME"]
"""Grades of material quality."""


class Line(NamedTuple):
    """sigma = slope x hardness + start [N/mm^2]."""

    slope: float
    start: float

    def at(self, hardness: float) -> float:
        """The strength at a hardness."""
        return self.slope * hardness + self.start


class Endurance(NamedTuple):
    """A line of the S-N curve: the load cycles of the static and of the long-life knee, and the factor at the first.

    Source
        ISO 6336-2 and -3, figures of Z_NT and Y_NT
    """

    static: float
    reference: float
    factor: float


_STEEL_FLANK, _STEEL_ROOT = Endurance(1e5, 5e7, 1.6), Endurance(1e4, 3e6, 2.5)
_IRON_FLANK, _IRON_ROOT = Endurance(1e5, 2e6, 1.3), Endurance(1e3, 3e6, 1.6)


@dataclass(frozen=True, kw_only=True)
class MaterialClass:
    """A class of materials.

    Fields
        contact, bending : (Line, Line, Line) - sigma_Hlim and sigma_Flim of ML, MQ and ME
        hardness : (float, float) - the range in which the lines hold, of ML and MQ
        best_hardness : (float, float) or None - that of ME, where it differs
        brinell : bool - the hardness is HBW, else HV
        hard : bool - its flank is hard: it smooths and hardens a softer mate
        running_in : str - "soft" (by sigma_Hlim), "iron" or "hard"
        notch : float or None [mm] - rho', None: by the yield point
        surface : str - which line of Y_RrelT: "steel", "normalized" or "iron"
        size : str - which line of Y_X: "soft", "hard" or "iron"
        static_notch : str - which form of Y_drelT at the static knee: "case", "nitrided", "soft" or "none"
        yield_strength : float [N/mm^2] - of a class that names no steel
    """

    contact: tuple[Line, Line, Line]
    bending: tuple[Line, Line, Line]
    hardness: tuple[float, float]
    best_hardness: tuple[float, float] | None = None
    brinell: bool = False
    hard: bool = False
    running_in: str = "soft"
    notch: float | None = None
    surface: str = "steel"
    size: str = "soft"
    flank: Endurance = _STEEL_FLANK
    root: Endurance = _STEEL_ROOT
    static_notch: str = "soft"
    yield_strength: float = 300.0

    @property
    def needs_hardness(self) -> bool:
        """Whether its strengths depend on the hardness."""
        return any(line.slope for line in (*self.contact, *self.bending))

    def range_of(self, quality: Quality) -> tuple[float, float]:
        """The range of hardness in which the strengths of a quality hold."""
        return self.best_hardness if quality == "ME" and self.best_hardness is not None else self.hardness


_PLACE: dict[str, int] = {"ML": 0, "MQ": 1, "ME": 2}


def strength(lines: tuple[Line, Line, Line], quality: Quality, hardness: float) -> float:
    """sigma_Hlim or sigma_Flim of a class [N/mm^2].

    Example
        >>> strength(CLASSES["through-hardened"].contact, "MQ", 300.0)
        766.9
        >>> strength(CLASSES["case-hardened"].bending, "MQ", 720.0)
        425.0

    Source
        ISO 6336-5, from memory; a printed report meets case-hardened MQ 1500 alone
    """
    return float(lines[_PLACE[quality]].at(hardness))


def _lines(*pairs: tuple[float, float]) -> tuple[Line, Line, Line]:
    one, two, three = (Line(*pair) for pair in pairs)
    return one, two, three


CLASSES = {
    "normalized": MaterialClass(
        contact=_lines((1.0, 190), (1.0, 190), (1.52, 250)),
        bending=_lines((0.455, 69), (0.455, 69), (0.386, 147)),
        hardness=(110, 210),
        brinell=True,
        surface="normalized",
    ),
    "nodular-iron": MaterialClass(
        contact=_lines((1.434, 211), (1.434, 211), (1.5, 250)),
        bending=_lines((0.35, 119), (0.35, 119), (0.38, 134)),
        hardness=(175, 300),
        brinell=True,
    ),
    "grey-iron": MaterialClass(
        contact=_lines((1.033, 132), (1.033, 132), (1.465, 122)),
        bending=_lines((0.256, 8), (0.256, 8), (0.2, 53)),
        hardness=(150, 240),
        best_hardness=(175, 275),
        brinell=True,
        running_in="iron",
        notch=0.3095,
        surface="iron",
        size="iron",
        flank=_IRON_FLANK,
        root=_IRON_ROOT,
        static_notch="none",
    ),
    "through-hardened-carbon": MaterialClass(
        contact=_lines((0.963, 283), (0.925, 360), (0.838, 432)),
        bending=_lines((0.25, 108), (0.24, 163), (0.283, 202)),
        hardness=(115, 215),
        yield_strength=430.0,
    ),
    "through-hardened": MaterialClass(
        contact=_lines((1.313, 188), (1.313, 373), (2.213, 260)),
        bending=_lines((0.423, 104), (0.425, 187), (0.358, 231)),
        hardness=(200, 360),
        best_hardness=(200, 390),
        yield_strength=700.0,
    ),
    "case-hardened": MaterialClass(
        contact=_lines((0, 1300), (0, 1500), (0, 1650)),
        bending=_lines((0, 312), (0, 425), (0, 525)),
        hardness=(600, 800),
        best_hardness=(660, 800),
        hard=True,
        running_in="hard",
        notch=0.003,
        size="hard",
        root=Endurance(1e3, 3e6, 2.5),
        static_notch="case",
        yield_strength=850.0,
    ),
    "induction-hardened": MaterialClass(
        contact=_lines((0.74, 602), (0.541, 882), (0.505, 1013)),
        bending=_lines((0.305, 76), (0.138, 290), (0.271, 237)),
        hardness=(485, 615),
        hard=True,
        running_in="hard",
        notch=0.003,
        size="hard",
        root=Endurance(1e3, 3e6, 2.5),
        static_notch="case",
        yield_strength=700.0,
    ),
    "nitrided": MaterialClass(
        contact=_lines((0, 1125), (0, 1250), (0, 1450)),
        bending=_lines((0, 270), (0, 420), (0, 468)),
        hardness=(650, 900),
        hard=True,
        running_in="hard",
        notch=0.1005,
        surface="iron",
        size="hard",
        flank=_IRON_FLANK,
        root=_IRON_ROOT,
        static_notch="nitrided",
        yield_strength=800.0,
    ),
    "nitrided-through": MaterialClass(
        contact=_lines((0, 788), (0, 998), (0, 1217)),
        bending=_lines((0, 258), (0, 363), (0, 432)),
        hardness=(450, 650),
        hard=True,
        running_in="hard",
        notch=0.1005,
        surface="iron",
        size="hard",
        flank=_IRON_FLANK,
        root=_IRON_ROOT,
        static_notch="nitrided",
        yield_strength=700.0,
    ),
}
"""The classes of ISO 6336-5 by name."""


class NamedSteel(NamedTuple):
    """A steel by name: its class, the hardness that is usual, and the yield point [N/mm^2]."""

    of: str
    hardness: float
    yield_strength: float


STEELS = {
    "16MnCr5": NamedSteel("case-hardened", 700, 650),
    "20MnCr5": NamedSteel("case-hardened", 720, 700),
    "18CrNiMo7-6": NamedSteel("case-hardened", 720, 850),
    "42CrMo4": NamedSteel("through-hardened", 300, 700),
    "34CrNiMo6": NamedSteel("through-hardened", 310, 800),
    "C45": NamedSteel("through-hardened-carbon", 200, 430),
    "31CrMoV9": NamedSteel("nitrided", 750, 800),
    "42CrMo4-nitrided": NamedSteel("nitrided-through", 550, 700),
    "42CrMo4-induction": NamedSteel("induction-hardened", 560, 700),
}
MATERIALS = (*STEELS, *CLASSES)
"""What `rating.material` may name."""
_HARD_FROM = 1000.0
_UNNAMED = {True: "case-hardened", False: "through-hardened"}


@dataclass(frozen=True, kw_only=True)
class GearSteel:
    """The material of one gear as the rating takes it.

    Parameters
        name : str - a steel or class, as the file names it; of a gear that names none its class
        of : str - name of the class
        hardness : float or None - HV, of the classes in Brinell HBW; None where nothing depends on it
        brinell : float or None - HBW, for Z_W
        yield_strength : float [N/mm^2]
        contact_limit, bending_limit : float [N/mm^2] - sigma_Hlim, sigma_Flim
        given : frozenset of str - names of the values above that the file gives itself
    """

    name: str
    of: str
    hardness: float | None
    brinell: float | None
    yield_strength: float
    contact_limit: float
    bending_limit: float
    given: frozenset[str] = frozenset()

    @property
    def kind(self) -> MaterialClass:
        """Its class."""
        return CLASSES[self.of]


def gear_steel(
    name: str | None,
    quality: Quality,
    *,
    hardness: float | None = None,
    brinell: float | None = None,
    yield_strength: float | None = None,
    contact_limit: float | None = None,
    bending_limit: float | None = None,
) -> GearSteel:
    """A material from what a file says; what it leaves out is that of the named steel, or of the class.

    Parameters
        name : str or None - a steel or a class; None where both limits are given: then case-hardened from a
            contact limit of 1000 N/mm^2 on, through-hardened below
    Example
        >>> steel = gear_steel("42CrMo4", "MQ")
        >>> steel.of, steel.contact_limit, steel.bending_limit
        ('through-hardened', 766.9, 314.5)
    """
    values = {
        "hardness": hardness,
        "brinell": brinell,
        "yield_strength": yield_strength,
        "contact_limit": contact_limit,
        "bending_limit": bending_limit,
    }
    given = frozenset(key for key, value in values.items() if value is not None)
    if name is None:
        assert contact_limit is not None, "the file gives material or both limits"
        name = _UNNAMED[contact_limit >= _HARD_FROM]
    steel = STEELS.get(name)
    of = name if steel is None else steel.of
    made = CLASSES[of]
    if hardness is None and steel is not None:
        hardness = steel.hardness
    if yield_strength is None:
        yield_strength = made.yield_strength if steel is None else steel.yield_strength
    at = 0.0 if hardness is None else hardness
    return GearSteel(
        name=name,
        of=of,
        hardness=hardness,
        brinell=hardness if brinell is None else brinell,
        yield_strength=yield_strength,
        contact_limit=strength(made.contact, quality, at) if contact_limit is None else contact_limit,
        bending_limit=strength(made.bending, quality, at) if bending_limit is None else bending_limit,
        given=given,
    )
