"""Gear trains on a linkage as a design: degrees of freedom, the rule of a train, and why a train does not fit."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, count, islice, pairwise
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Field

from gearlink.core.base.design import Design, Outline
from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.report import Check, Remedy, Status, Table
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec import DesignSpec, Length, Spec, Teeth, unit
from gearlink.core.base.wording import unlike
from gearlink.core.parts.linkages.codes import MOBILITY, TRAIN_FIT

Name = Annotated[str, Field(min_length=1, max_length=40)]


class Link(Spec):
    """A rigid link."""

    pins: Annotated[list[Name], Field(min_length=1, max_length=20)] = Field(description="pins that the link carries")
    length: Length | None = Field(None, description="distance of its two pins; then centre distances are checked")


class Gear(Spec):
    """A gear of a train."""

    at: Name = Field(description="pin on which the gear sits")
    fixed_to: Name | None = Field(None, description="link to which the gear is fixed; default: it turns freely")
    teeth: Teeth | None = Field(None, description="teeth; with the train's module the centre distances are checked")
    ring: bool = Field(False, description="an internal gear")


class Train(Spec):
    """Gears in mesh one after the other."""

    gears: Annotated[list[Gear], Field(min_length=2, max_length=50)] = Field(description="in the order of the meshes")
    module: Length | None = Field(None, description="module of the train")


class GearTrainMobilitySpec(DesignSpec):
    """A pin-jointed linkage and the gear trains on it."""

    kind: Literal["gear-train-mobility"]
    links: Annotated[dict[Name, Link], Field(min_length=2, max_length=50)] = Field(
        description="every link by name, the frame among them"
    )
    trains: Annotated[list[Train], Field(max_length=20)] = Field(default_factory=list, description="the gear trains")
    mobility: Annotated[int, unit("1", ge=0, le=20)] = Field(1, description="required degrees of freedom")


MOST_FIXED_ENDS = 2


def linkage_mobility(links: Mapping[str, Sequence[str]]) -> int:
    """Degrees of freedom of a planar pin-jointed linkage, its frame counted among the links.

    F = 3 (n - 1) - 2 sum(k - 1),   k the number of links that meet at a pin

    Parameters
        links : mapping - name of each link and the pins that it carries
    Returns
        F : int - of a linkage in general position
    Raises
        NoSolution - for a link that names a pin twice, or a linkage that falls into parts
    Example
        >>> linkage_mobility({"frame": "AD", "crank": "AB", "coupler": "BC", "rocker": "CD"})
        1

    Source
        thesis 2.1; the rule is P. L. Chebyshev's and M. Gruebler's
    """
    for name, pins in links.items():
        if len(set(pins)) < len(pins):
            raise NoSolution(f"link {name} names the same pin twice ({', '.join(pins)})", fix="give each pin once")
    _require_one_piece(links)
    meeting = [sum(pin in pins for pins in links.values()) for pin in pin_names(links)]
    return 3 * (len(links) - 1) - 2 * sum(k - 1 for k in meeting)


def pin_names(links: Mapping[str, Sequence[str]]) -> list[str]:
    """The pins of a linkage, each once, in the order of the links.

    Example
        >>> pin_names({"frame": "AD", "crank": "AB"})
        ['A', 'D', 'B']
    """
    return list(dict.fromkeys(pin for pins in links.values() for pin in pins))


def train_change(fixed: int) -> int:
    """What a train of meshing gears adds to the degrees of freedom of the linkage that carries it.

    dF = 3 (J - R) - 2 (J - R) - (J - 1) = 1 - R

    Parameters
        fixed : int - R, end gears fixed to a link: 0, 1 or 2; the number J of gears does not matter
    Raises
        NoSolution - for another R: a train has two ends
    Example
        A four-bar takes one train with one end fixed, a six-bar loop two with two.

        >>> [train_change(fixed) for fixed in (0, 1, 2)]
        [1, 0, -1]

    Source
        thesis 2.1
    """
    if not 0 <= fixed <= MOST_FIXED_ENDS:
        raise NoSolution(
            f"{fixed} gears of one train are fixed to links; only its two end gears may be",
            fix="split the train at the gears between, each of which ends one train and begins the next",
        )
    return 1 - fixed


def common_links(links: Mapping[str, Sequence[str]], first: str, second: str) -> list[str]:
    """Links that carry both pins: there the distance of the two never changes, and gears on them may mesh.

    Example
        >>> common_links({"frame": "AD", "crank": "AB", "coupler": "BC"}, "A", "B")
        ['crank']

    Source
        thesis 2.1, item 1
    """
    return [name for name, pins in links.items() if first in pins and second in pins]


def _require_one_piece(links: Mapping[str, Sequence[str]]) -> None:
    """Refuse a linkage in which some link cannot be reached from the first."""
    names = list(links)
    reached, border = {names[0]}, [names[0]]
    while border:
        pins = set(links[border.pop()])
        for name in names:
            if name not in reached and pins & set(links[name]):
                reached.add(name)
                border.append(name)
    lost = [name for name in names if name not in reached]
    if lost:
        raise NoSolution(
            (f"the linkage is not connected: {', '.join(lost)} shares no pin with {', '.join(sorted(reached))}"),
            fix="name the pin at which they meet in both",
        )


_MOST = 60
"""Ways to fix or free gears that are tried."""


def candidates_table(design: GearTrainMobility, check: str) -> Iterator[Remedy]:
    """Remedies of a check, the minimum change first."""
    if check == "mobility":
        yield from islice(_freed_or_fixed(design), _MOST)
        return
    if check != "train-fit":
        return
    single = [*_lengths(design), *_fixings(design)]
    yield from single
    if len(single) > 1:  # a train may have more than one fault
        yield tuple(dict(change for remedy in single for change in remedy).items())
    yield from _teeth(design)


def _lengths(design: GearTrainMobility) -> Iterator[Remedy]:
    """Links as long as their gears mesh."""
    for train in design.spec.trains:
        for (one, other), distance in zip(pairwise(train.gears), design.distances_of(train), strict=True):
            common = common_links(design.links, one.at, other.at) if one.at != other.at else []
            if distance is None or not common or not _is_path(common[0]):
                continue
            length = design.spec.links[common[0]].length
            if length is not None and length != distance:
                yield ((f"links.{common[0]}.length", distance),)


def _teeth(design: GearTrainMobility) -> Iterator[Remedy]:
    """Each gear as large as what holds its distance to its neighbour leaves it."""
    for i, train in enumerate(design.spec.trains):
        for j, (one, other) in enumerate(pairwise(train.gears)):
            apart = design.apart(one, other)
            if train.module is None or one.teeth is None or other.teeth is None or apart is None:
                continue
            total = 2.0 * apart / train.module
            for place, mate, ring in ((j, other, one.ring), (j + 1, one, other.ring)):
                assert mate.teeth is not None, "both have teeth"
                needed = total + mate.teeth if ring else mate.teeth - total if mate.ring else total - mate.teeth
                if needed >= 1.0 and abs(needed - round(needed)) < 1e-6:
                    yield ((f"trains[{i}].gears[{place}].teeth", round(needed)),)


def _fixings(design: GearTrainMobility) -> Iterator[Remedy]:
    """Gears between others set free, end gears fixed to a link at their pin, one of two ends on one link set free."""
    for i, train in enumerate(design.spec.trains):
        for j, gear in enumerate(train.gears):
            if gear.fixed_to is not None and 0 < j < len(train.gears) - 1:
                yield ((_fixing(i, j), None),)
            elif gear.fixed_to is not None and gear.at not in design.links[gear.fixed_to]:
                yield from (((_fixing(i, j), name),) for name, pins in design.links.items() if gear.at in pins)
        if train.gears[0].fixed_to is not None and train.gears[0].fixed_to == train.gears[-1].fixed_to:
            yield from (((_fixing(i, j), None),) for j in _ends(train))


def _freed_or_fixed(design: GearTrainMobility) -> Iterator[Remedy]:
    """As many end gears free, or fixed to a link at their pins, as degrees of freedom are missing or too many."""
    excess = design.mobility - design.spec.mobility
    if excess == 0:  # what holds twice is not told by the count
        return
    ends = [(i, j) for i, train in enumerate(design.spec.trains) for j in _ends(train)]
    gears = {(i, j): design.spec.trains[i].gears[j] for i, j in ends}
    if excess < 0:
        fixed = [place for place in ends if gears[place].fixed_to is not None]
        for several in combinations(fixed, -excess):
            yield tuple((_fixing(*place), None) for place in several)
        return
    free = [place for place in ends if gears[place].fixed_to is None]
    for several in combinations(free, excess):
        able = [[name for name, pins in design.links.items() if gears[place].at in pins] for place in several]
        for turn in range(max(map(len, able), default=0)):
            yield tuple((_fixing(*place), names[turn % len(names)]) for place, names in zip(several, able, strict=True))


def _ends(train: Train) -> tuple[int, int]:
    return 0, len(train.gears) - 1


def _fixing(train: int, gear: int) -> str:
    return f"trains[{train}].gears[{gear}].fixed_to"


def _is_path(name: str) -> bool:
    """Whether a link's name can stand in a dotted path."""
    return re.fullmatch(r"(?!\d+$)[^.\[\]]+", name) is not None


_PRIME = 2**61 - 1
_BASE = 0x1E3779B97F4A7C15
"""Its powers to the squares are spread over the numbers below the prime: a general position, the same every time."""
Row: TypeAlias = dict[tuple[str, ...], int]
"""Coefficients of the velocities, by link or gear and component."""


class _Rows:
    """Equations that do not follow from each other, each without the unknowns that those before it give."""

    def __init__(self) -> None:
        self.kept: dict[tuple[str, ...], Row] = {}

    def left_of(self, row: Row) -> Row:
        """What is left of an equation once the others are put into it; empty where it says nothing new."""
        left = dict(row)
        for pivot, known in self.kept.items():
            if share := left.get(pivot, 0):
                for name, value in known.items():
                    left[name] = (left.get(name, 0) - share * value) % _PRIME
        return {name: value for name, value in left.items() if value % _PRIME}

    def add(self, row: Row) -> bool:
        """Keep an equation; whether it says something new."""
        left = self.left_of(row)
        if not left:
            return False
        pivot = next(iter(left))
        inverse = pow(left[pivot], -1, _PRIME)
        self.kept[pivot] = {name: value * inverse % _PRIME for name, value in left.items()}
        return True


@dataclass(frozen=True)
class Constraints:
    """The joints of a linkage and the meshes of the trains on it.

    Parameters
        links : mapping - name of each link and the pins that it carries
        trains : Trains of the file, whose gears sit on pins of links that carry their neighbours too
    Example
        A third bar to the point that two hold says again what they say: the crank besides moves, the count is 0.

        >>> truss = {"frame": "ABDP", "one": "AC", "two": "BC", "three": "DC"}
        >>> held = Constraints({**truss, "crank": "PQ"}, ())
        >>> held.freedom, held.repeated
        (1, ['pin C'])
    """

    links: Mapping[str, Sequence[str]]
    trains: Sequence[Train]

    @cached_property
    def _found(self) -> tuple[_Rows, list[str]]:
        rows, again, numbers = _Rows(), list[str](), (pow(_BASE, k * k, _PRIME) for k in count(1))
        for pin in pin_names(self.links):
            x, y = next(numbers), next(numbers)
            one, *others = (name for name, pins in self.links.items() if pin in pins)
            for other in others:
                across: Row = {(one, "x"): 1, (other, "x"): -1, (one, "w"): -y, (other, "w"): y}
                along: Row = {(one, "y"): 1, (other, "y"): -1, (one, "w"): x, (other, "w"): -x}
                if not all([rows.add(across), rows.add(along)]):
                    again.append(f"pin {pin}")
        for i, train in enumerate(self.trains, start=1):
            known = all(gear.teeth is not None for gear in train.gears)
            radii = [gear.teeth if known and gear.teeth else next(numbers) for gear in train.gears]
            for j in range(len(train.gears) - 1):
                row = self._mesh(i, train, j, radii)
                if row is not None and not rows.add(row):
                    again.append(f"train {i}")
        return rows, list(dict.fromkeys(again))

    def _mesh(self, i: int, train: Train, j: int, radii: Sequence[int]) -> Row | None:
        """r_1 (w_1 - w_c) +- r_2 (w_2 - w_c) = 0, minus where one of the gears is a ring."""
        one, other = train.gears[j : j + 2]
        carriers = common_links(self.links, one.at, other.at)
        if not carriers:
            return None
        ring = -1 if one.ring or other.ring else 1
        row: Row = {}
        terms = ((_turn(i, j, one), radii[j]), (_turn(i, j + 1, other), ring * radii[j + 1]))
        for name, radius in terms:
            for key, value in ((name, radius), ((carriers[0], "w"), -radius)):
                row[key] = row.get(key, 0) + value
        return row

    @property
    def repeated(self) -> list[str]:
        """The pins and trains that say again what those before them say."""
        return self._found[1]

    @cached_property
    def freedom(self) -> int:
        """Degrees of freedom against any one link."""
        free = sum(gear.fixed_to is None for train in self.trains for gear in train.gears)
        return 3 * len(self.links) + free - len(self._found[0].kept) - 3

    def held(self) -> Iterator[int]:
        """Numbers of the trains, from 1 on, of which no gear can turn against its link while other parts move."""
        rows = self._found[0]
        if not self.freedom:
            return
        for i, train in enumerate(self.trains, start=1):
            turns: list[Row] = []
            for j, (one, other) in enumerate(pairwise(train.gears)):
                carriers = common_links(self.links, one.at, other.at)
                turns += [
                    {_turn(i, k, gear): 1, (carrier, "w"): -1}
                    for k, gear in ((j, one), (j + 1, other))
                    for carrier in carriers[:1]
                    if _turn(i, k, gear) != (carrier, "w")
                ]
            if turns and not any(rows.left_of(turn) for turn in turns):
                yield i


def _turn(i: int, j: int, gear: Gear) -> tuple[str, ...]:
    """The turning speed of a gear: that of the link that it is fixed to, or its own."""
    return (gear.fixed_to, "w") if gear.fixed_to is not None else ("gear", str(i), str(j))


# As for a gear pair that is given by shifts and centre distance: a share of the module.
_DISTANCE_TOLERANCE = 1e-6


class GearTrainMobility(Design):
    """A pin-jointed linkage with gear trains on its pins."""

    kind = "gear-train-mobility"
    spec: GearTrainMobilitySpec
    keys = {"analyze": (("mobility", "mobility"), "linkage_mobility", "mobility_changes")}
    outlines = {
        "analyze": Outline(
            ("link_count", "linkage_mobility", "train_count", "fixed_ends", "mobility_changes", "mobility"),
            ("train-fit", "mobility"),
            ("trains",),
        )
    }

    @cached_property
    def links(self) -> dict[str, tuple[str, ...]]:
        """Pins of each link."""
        return {name: tuple(link.pins) for name, link in self.spec.links.items()}

    @property
    def link_count(self) -> int:
        """Links, the frame among them."""
        return len(self.links)

    @cached_property
    def linkage_mobility(self) -> int:
        """Degrees of freedom of the linkage alone."""
        with at_key("links"):
            return linkage_mobility(self.links)

    @property
    def train_count(self) -> int:
        """Gear trains."""
        return len(self.spec.trains)

    @cached_property
    def fixed_ends(self) -> list[int]:
        """R of each train: gears that are fixed to a link."""
        self.require_names()
        return [sum(gear.fixed_to is not None for gear in train.gears) for train in self.spec.trains]

    @cached_property
    def mobility_changes(self) -> list[int]:
        """What each train adds to the degrees of freedom."""
        changes = []
        for i, fixed in enumerate(self.fixed_ends):
            with at_key(f"trains[{i}].gears"):
                changes.append(train_change(fixed))
        return changes

    @cached_property
    def mobility(self) -> int:
        """Degrees of freedom of the whole."""
        return self.linkage_mobility + sum(self.mobility_changes)

    def table_trains(self, _samples: int | None = None) -> Table:
        """A row per train: its gears, where they sit, fixed ends, change of the degrees of freedom."""
        trains = self.spec.trains
        columns: dict[str, tuple[list[Any], str]] = {
            "train": ([float(i) for i in range(1, len(trains) + 1)], "1"),
            "gears": ([_words(train) for train in trains], "1"),
            "fixed_ends": ([float(fixed) for fixed in self.fixed_ends], "1"),
            "change": ([float(change) for change in self.mobility_changes], "1"),
        }
        return Table.of("trains", columns)

    # Checks

    candidates = candidates_table

    def check_train_fit(self) -> Iterator[Check]:
        """GL308: what keeps a train from running on the linkage, one finding per reason."""
        self.require_names()
        for i, train in enumerate(self.spec.trains, start=1):
            reasons = self._reasons[i - 1]
            if i in self._held:
                reasons = [
                    ("its gears cannot turn: the links that they are fixed to prevent it", "put it on other pins")
                ]
            for reason, fix in reasons:
                yield TRAIN_FIT.check("fail", f"train {i}: {reason}", fix=fix)
            if not reasons:
                yield TRAIN_FIT.check("pass", f"train {i} fits: {_words(train)}")

    def check_mobility(self) -> Check:
        """GL309: degrees of freedom against those that are wanted."""
        found, wanted = self.mobility, self.spec.mobility
        terms = "".join(f" {change:+d}" for change in self.mobility_changes)
        aside = f"linkage {self.linkage_mobility}, gear trains{terms or ' none'}"
        if found == wanted and (general := self._general()):
            return general
        fix = "" if found == wanted else self._mobility_remedy(found - wanted)
        status: Status = "pass" if found == wanted else "fail"
        return MOBILITY.check(status, "mobility F", float(found), float(wanted), side="", aside=aside, fix=fix)

    @cached_property
    def _reasons(self) -> list[list[tuple[str, str]]]:
        """Why each train does not fit, and what would make it fit, one by one."""
        return [[*self._fixing(train), *self._meshes(train)] for train in self.spec.trains]

    @cached_property
    def _constraints(self) -> Constraints | None:
        """Joints and meshes of trains that fit; None where one does not."""
        return None if any(self._reasons) else Constraints(self.links, self.spec.trains)

    @cached_property
    def _held(self) -> frozenset[int]:
        return frozenset(() if self._constraints is None else self._constraints.held())

    def _general(self) -> Check | None:
        """GL309 where constraints that repeat others leave more freedom than is counted; None where they do not."""
        found, wanted = self._constraints, self.spec.mobility
        if found is None or found.freedom == wanted:
            return None
        again = " and ".join(found.repeated)
        what = "mobility F by the constraints"
        aside = f"{again} {'repeats' if len(found.repeated) == 1 else 'repeat'} the constraint of other parts"
        fix, free = "put it on other pins or links", float(found.freedom)
        return MOBILITY.check("fail", what, free, float(wanted), side="", aside=aside, fix=fix)

    def _mobility_remedy(self, excess: int) -> str:
        """What brings the degrees of freedom to those that are wanted, by the rule of composition."""
        count = abs(excess)
        times = "one end gear" if count == 1 else f"{count} end gears"
        if excess < 0:
            return f"free {times} from the link" if sum(self.fixed_ends) >= count else "add a link or free a joint"
        free = 2 * self.train_count - sum(self.fixed_ends)
        if free >= count:
            return f"fix {times} to the link at its pin"
        more = count - free
        ends = "both ends of every train and " if free else ""
        return f"fix {ends}both ends of {more} more {'train' if more == 1 else 'trains'} (each reduces F by 1)"

    def _fixing(self, train: Train) -> Iterator[tuple[str, str]]:
        """Why the fixing of the gears does not fit, and what would."""
        for j, gear in enumerate(train.gears, start=1):
            if gear.fixed_to is None:
                continue
            if 1 < j < len(train.gears):
                yield (
                    f"gear {j} is between others and fixed to {gear.fixed_to}; only end gears may be fixed",
                    "end the train there and begin the next with the same gear",
                )
            if gear.at not in self.links[gear.fixed_to]:
                able = " or ".join(name for name, pins in self.links.items() if gear.at in pins)
                yield f"gear {j} is on pin {gear.at}, which {gear.fixed_to} does not carry", f"fix it to {able}"
        first, last = train.gears[0].fixed_to, train.gears[-1].fixed_to
        if first is not None and first == last and all(gear.at in self.links[first] for gear in train.gears):
            yield (
                f"both ends are fixed to {first}, which carries the whole train: it removes no degree of freedom",
                "free one end",
            )

    def _meshes(self, train: Train) -> Iterator[tuple[str, str]]:
        """Why neighbours cannot stay in mesh, and what would let them."""
        for j, (one, other) in enumerate(pairwise(train.gears), start=1):
            if one.at == other.at:
                yield f"gears {j} and {j + 1} are on the same pin {one.at}", "put them on two pins of one link"
                continue
            common = common_links(self.links, one.at, other.at)
            if not common:
                yield (
                    f"no link carries both pin {one.at} and pin {other.at} of gears {j} and {j + 1}",
                    "put them on two pins of one link",
                )
                continue
            yield from self._distance(train.module, one, other, common[0], f"gears {j} and {j + 1}")

    def _distance(
        self, module: float | None, one: Gear, other: Gear, link: str, which: str
    ) -> Iterator[tuple[str, str]]:
        """Why the centre distance is not the link's length or another mesh's, where the file tells them."""
        distance, length = _distance(module, one, other), self.spec.links[link].length
        if distance is None or module is None:
            return
        if one.ring and other.ring:
            yield f"{which} are both internal gears, which cannot mesh", "remove ring at one of them"
            return
        ring, inner = (one, other) if one.ring else (other, one)
        if ring.ring and ring.teeth is not None and inner.teeth is not None and ring.teeth <= inner.teeth:
            yield f"{which}: internal gear of {ring.teeth} teeth, pinion of {inner.teeth}", "give the ring more teeth"
            return
        if length is not None:
            if abs(distance - length) > _DISTANCE_TOLERANCE * module:
                yield (
                    f"centre distance of {which}: {unlike(distance, length)} mm (links.{link}.length "
                    f"{unlike(length, distance)} mm)",
                    f"set links.{link}.length to {distance:.9g} mm",
                )
            return
        first, apart = self._first_distance[frozenset((one.at, other.at))]
        if abs(distance - apart) > _DISTANCE_TOLERANCE * module:
            yield (
                f"centre distance of {which}: {unlike(distance, apart)} mm (by train {first} "
                f"{unlike(apart, distance)} mm between {one.at} and {other.at})",
                "change module or teeth of one of the two",
            )

    @cached_property
    def _first_distance(self) -> dict[frozenset[str], tuple[int, float]]:
        """For two pins the first train that tells their distance [mm], counted from 1, and the distance."""
        found: dict[frozenset[str], tuple[int, float]] = {}
        for i, train in enumerate(self.spec.trains, start=1):
            for one, other in pairwise(train.gears):
                distance = _distance(train.module, one, other)
                if distance is not None:
                    found.setdefault(frozenset((one.at, other.at)), (i, distance))
        return found

    def distances_of(self, train: Train) -> list[float | None]:
        """Centre distance of each mesh of a train [mm]; None where the file does not tell it."""
        return [_distance(train.module, one, other) for one, other in pairwise(train.gears)]

    def apart(self, one: Gear, other: Gear) -> float | None:
        """Distance of the pins of two gears [mm], by the link that carries both or the first train that tells it."""
        if one.at == other.at:
            return None
        common = common_links(self.links, one.at, other.at)
        length = self.spec.links[common[0]].length if common else None
        known = self._first_distance.get(frozenset((one.at, other.at)))
        return length if length is not None or known is None else known[1]

    def require_names(self) -> None:
        """Refuse gears on pins or links that the linkage does not have."""
        pins = pin_names(self.links)
        for i, train in enumerate(self.spec.trains):
            for j, gear in enumerate(train.gears):
                place = f"trains[{i}].gears[{j}]"
                if gear.at not in pins:
                    raise NoSolution(f"the linkage has no pin {gear.at}; it has {', '.join(pins)}", key=f"{place}.at")
                if gear.fixed_to is not None and gear.fixed_to not in self.links:
                    known = ", ".join(self.links)
                    raise NoSolution(
                        f"the linkage has no link {gear.fixed_to}; it has {known}", key=f"{place}.fixed_to"
                    )


def _distance(module: float | None, one: Gear, other: Gear) -> float | None:
    """Centre distance of two gears [mm], None where the file does not tell it; a ring gear has the other within it."""
    if module is None or one.teeth is None or other.teeth is None:
        return None
    teeth = abs(one.teeth - other.teeth) if one.ring or other.ring else one.teeth + other.teeth
    return module * teeth / 2.0


def _words(train: Train) -> str:
    """A train in words: the pins in mesh order, a fixed gear with its link."""
    return " - ".join(gear.at + (f" (on {gear.fixed_to})" if gear.fixed_to else "") for gear in train.gears)
