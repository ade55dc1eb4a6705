"""What is shown on a mechanism besides its links: vectors, paths, earlier positions, instant centres, what fails.

All of it comes from the motion of the design, whatever its kind; a scene that stands elsewhere than the motion, as that
of a press does, is found by its joints.

Letters stand beside their points clear of links, of the pitch circles of gears, and of each other.
"""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from gearlink.cli.views.scenes import linkages, of_motion
from gearlink.cli.views.scenes.of_motion import Frame
from gearlink.cli.views.scenes.scene import (
    BLACK,
    GREEN,
    GREY,
    PURPLE,
    RED,
    TURN,
    WRONG,
    Arrow,
    Body,
    Chain,
    Fault,
    Key,
    Line,
    Mark,
    Part,
    Points,
    Reals,
    Scene,
    circle,
    drawn,
    points_of,
    round_below,
    wheel,
)
from gearlink.core.base.errors import GearlinkError, NoSolution, named
from gearlink.core.base.kinds import KINDS
from gearlink.core.mechanism import vectors
from gearlink.core.mechanism.joints import Pin
from gearlink.core.mechanism.links import FRAME, Mechanism
from gearlink.core.studies.loads.names import RPM

if TYPE_CHECKING:
    from gearlink.core.base.report import Check
    from gearlink.core.mechanism.motion import Input
    from gearlink.core.numerics.arrays import Mask
    from gearlink.core.studies.clearance import Clearance, Layout


_WAYS = np.exp(1j * TURN * np.arange(24) / 24)
_POSITIONS = 60
"""So many positions of a loop tell where a letter is in the way."""
_Clearance: TypeAlias = Callable[[Points], Reals]


def on_disc(body: Body) -> float:
    """Distance of the words on a body without teeth from its axis [mm]: half-way out on a disc."""
    return 0.5 * abs(complex(body.outline[0])) if body.repeats == 0 else 0.0


def shifts(scene: Scene, reach: float, label_reach: Callable[[Body], float]) -> tuple[list[complex], list[complex]]:
    """From each mark to its letters, and from the axis of each body with a label to that label [mm].

    Parameters
        scene : Scene - of one position or of many; a letter keeps its side over all of them
        reach : float [mm] - distance of letters from their points
        label_reach : function - distance of a body's label from its axis [mm]; 0 puts it there
    """
    every = max(1, len(scene.marks[0].point) // _POSITIONS)
    gears = [part for part in scene.parts if isinstance(part, Body) and part.pitch]
    chains = [part for part in scene.parts if isinstance(part, Chain)]
    taken = [_from_link(a[::every], b[::every]) for chain in chains for a, b in pairwise(chain.joints)]
    found = []
    for mark in scene.marks:
        point = mark.point[::every]
        others = [_from_point(other.point[::every]) for other in scene.marks if other is not mark]
        circles = [_from_circle(gear.place[::every], gear.pitch) for gear in gears]
        found.append(_clearest(point, reach, reach, [*taken, *others], circles) if mark.text else 0j)
        taken += [_from_point(point + found[-1])] if mark.text else []
    taken += [_from_point(mark.point[::every]) for mark in scene.marks]
    labels = []
    for body in scene.parts:
        if isinstance(body, Body) and body.label:
            far, place = label_reach(body), body.place[::every]
            circles = [_from_circle(gear.place[::every], gear.pitch) for gear in gears if gear is not body]
            labels.append(_clearest(place, far, 2.0 * reach, taken, circles) if far else 0j)
            taken.append(_from_point(place + labels[-1]))
    return found, labels


def _clearest(
    point: Points, distance: float, enough: float, taken: list[_Clearance], circles: list[_Clearance]
) -> complex:
    """The shift that keeps farthest from all that is taken, as far as `enough`, circles included; up and right among
    equals. A letter on a circle can still be read, so that of two shifts as near to one the freer counts."""
    places = point[:, None] + distance * _WAYS[None, :]
    free = np.min([_known(clearance(places)) for clearance in taken], axis=0)
    clear = np.min([free, *(_known(clearance(places)) for clearance in circles)], axis=0)
    room = np.minimum(enough, clear).mean(axis=0) + 0.5 * np.minimum(enough, free).mean(axis=0)
    upwards = (_WAYS * np.exp(-0.125j * TURN)).real
    return complex(distance * _WAYS[int(np.argmax(room + 0.02 * enough * upwards))])


def _known(distances: Reals) -> Reals:
    """What is not there at a position is far."""
    return np.asarray(np.nan_to_num(distances, nan=np.inf, posinf=np.inf))


def _from_point(point: Points) -> _Clearance:
    return lambda places: np.abs(places - point[:, None])


def _from_circle(center: Points, radius: float) -> _Clearance:
    return lambda places: np.abs(np.abs(places - center[:, None]) - radius)


def _from_link(start: Points, end: Points) -> _Clearance:
    first, way = start[:, None], (end - start)[:, None]
    square = np.maximum(np.abs(way) ** 2, 1e-300)

    def clearance(places: Points) -> Reals:
        along = np.clip(((places - first) * way.conj()).real / square, 0.0, 1.0)
        return np.asarray(np.abs(places - first - along * way))

    return clearance


Maker: TypeAlias = Callable[[Any, Reals], Scene]
WORDS = ("velocity", "acceleration", "force", "path", "centres", "ghosts")
"""What can be asked for; with `:POINT` at one point alone, which of a path is required."""
_LONGEST, _GHOSTS, _APART = 0.28, 4, 1.0 / 24.0
"""Longest arrow by the size of the drawing; earlier positions, and their distance in the loop."""
_SAMPLES, _FAR = 180, 1.15
_BESIDE = 0.06
"""Of the size of the drawing: numbers of a path that are nearer to each other are one text."""
_PROBES = 15
_COLORS = {"velocity": GREEN, "acceleration": PURPLE, "force": RED}
_NEAR = 1e-4
"""Of the size of the drawing, less than the width of a line: a direction of the file has a few digits."""
_OFF = complex(math.nan, math.nan)
_DEGREES = re.compile(r"(-?\d[\d.]*(?:e[-+]?\d+)?) deg")


class WrongShow(GearlinkError):
    """What was asked to be shown cannot be: an unknown word, or what the design has not."""


class Wish(NamedTuple):
    """One thing that is to be shown, at one point where it has a name."""

    what: str
    point: str = ""


def wishes(text: str) -> tuple[Wish, ...]:
    """What an option `--show` asks for.

    Raises
        WrongShow - for a word that is none, and a path without a point
    Example
        >>> wishes("velocity,path:C")
        (Wish(what='velocity', point=''), Wish(what='path', point='C'))
    """
    found = []
    for part in filter(None, text.replace(" ", "").split(",")):
        what, _, point = part.partition(":")
        if what not in WORDS:
            raise WrongShow(f"--show knows no {named(what)}; it knows {', '.join(WORDS)}")
        if what == "path" and not point:
            raise WrongShow("--show path needs a point: path:POINT")
        if point and what in ("ghosts", "centres"):
            raise WrongShow(f"--show {what} needs no point")
        found.append(Wish(what, point))
    return tuple(found)


# Where the scene stands


def frame_of(design: Any, build: Maker) -> Frame | None:
    """Where a scene stands: as its module says, else where the motion does; None where its joints stand elsewhere.

    Notes
        Of a scene that goes on beyond the range of the motion the positions within it count.
    """
    said: Callable[[Any], Frame] | None = getattr(sys.modules[build.__module__], "frame", None)
    found = of_motion.frame(design) if said is None else said(design)
    fraction = np.linspace(0.0, 0.93, _PROBES)
    q = found.inputs(fraction)
    inside = within(found.motion.input, q)
    try:
        mechanism = found.motion.at(q[inside], 0)
    except NoSolution:
        return None
    pins = {each.name: found.at(each.at) for each in mechanism.connections if isinstance(each, Pin)}
    known = [mark for mark in build(design, fraction).marks if mark.text in pins]
    off = max((float(np.abs(pins[mark.text] - mark.point[inside]).max()) for mark in known), default=0.0)
    size = max((float(np.abs(at - at[0]).max()) for at in pins.values()), default=0.0)
    return found if off <= _NEAR * (1.0 + size) else None


def within(given: Input, q: Reals) -> Mask:
    """Which inputs are within the range of a motion; all of one that repeats."""
    if given.turns is not None:
        return np.ones(q.shape, dtype=bool)
    return np.asarray((q >= given.start - 1e-9) & (q <= given.end + 1e-9))


# Scenes with more on them


def build(design: Any, fraction: Reals, wanted: Sequence[Wish] = (), checks: Sequence[Check] = ()) -> Scene:
    """The scene of a design over fractions of its loop with what is asked for, and red where a check fails.

    Parameters
        wanted : what is shown
        checks : findings of the design; those that fail are marked at their instants
    Raises
        WrongShow - where the design has not what is asked for
    """
    if not wanted:
        own = linkages.builder(design.kind)
        return _with_faults(own(design, fraction), design, fraction, own, checks)
    maker, frame = _base(design)
    return _with_faults(_shown(design, fraction, maker, frame, wanted), design, fraction, maker, checks)


def maker_of(design: Any, wanted: Sequence[Wish] = ()) -> Maker:
    """What builds the mechanism on which things are shown: its own scene, or that of its motion.

    Raises
        WrongShow - where there is no motion
    """
    return _base(design)[0] if wanted else linkages.builder(design.kind)


def _base(design: Any) -> tuple[Maker, Frame]:
    if not has_motion(design):
        raise WrongShow(f"--show: a {design.kind} has no motion of its own; show the files of its members")
    own = linkages.builder(design.kind)
    frame = frame_of(design, own)
    if frame is not None:
        return own, frame
    return of_motion.build, of_motion.frame(design)


def possible(design: Any) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """What can be asked for of a design, and the points that have a path.

    Returns
        words, points : of `WORDS`, without force where the file has no loads; both empty without a motion
    """
    if not has_motion(design):
        return (), ()
    given = design.moving.input
    points = vectors.moving_points(design.moving.at(of_motion.inputs(given, np.linspace(0.0, 0.93, _PROBES)), 0))
    loaded = _is_loaded(design) or _names_loads(design)
    return tuple(word for word in WORDS if loaded or word != "force"), tuple(points)


def _is_loaded(design: Any) -> bool:
    return hasattr(type(design), "machine") and hasattr(type(design), "unknown_joints")


def _names_loads(design: Any) -> bool:
    """Whether the file has loads of which its kind computes the forces."""
    return getattr(design.spec, "loads", None) is not None and "loads" in KINDS[design.kind].commands


def has_motion(design: Any) -> bool:
    """Whether the links of a design are known by their motion."""
    return design.kind in KINDS and bool(KINDS[design.kind].motion)


def _shown(design: Any, fraction: Reals, maker: Maker, frame: Frame,
           wanted: Sequence[Wish]) -> Scene:  # fmt: skip
    scene = maker(design, fraction)
    picture = Picture(design, fraction, maker, frame)
    behind: list[Part] = []
    before: list[Part] = []
    marks, keys = list(scene.marks), list(scene.keys)
    for wish in wanted:
        parts, words, key = picture.of(wish)
        (behind if wish.what == "ghosts" else before).extend(parts)
        marks += words
        keys += key
    own = len(behind), len(behind) + len(scene.parts), len(scene.marks)
    return replace(scene, parts=(*behind, *scene.parts, *before), marks=tuple(marks), keys=tuple(keys), own=own)


def _reach(scene: Scene) -> float:
    """The greater side of a scene [mm]."""
    whole = _points(scene)
    return float(max(np.ptp(whole.real), np.ptp(whole.imag), 1e-9))


def _points(scene: Scene) -> Points:
    bodies = points_of(part for part in scene.parts if isinstance(part, Body | Chain))
    return np.concatenate([bodies, *(mark.point for mark in scene.marks)])


Found: TypeAlias = tuple[list[Part], list[Mark], list[Key]]


@dataclass(frozen=True)
class Picture:
    """What is drawn on the scene of one design at fractions of its loop."""

    design: Any
    fraction: Reals
    maker: Maker
    frame: Frame

    @cached_property
    def _probes(self) -> Scene:
        """The scene at some positions of its loop."""
        return self.maker(self.design, np.linspace(0.0, 0.93, _PROBES))

    @cached_property
    def size(self) -> float:
        """The greater side of the drawing [mm]."""
        return _reach(self._probes)

    @cached_property
    def box(self) -> tuple[complex, complex]:
        """Middle of the drawing, and half its width and height [mm]."""
        whole = _points(self._probes)
        low, high = complex(whole.real.min(), whole.imag.min()), complex(whole.real.max(), whole.imag.max())
        return 0.5 * (low + high), 0.5 * (high - low) + 1e-9 * self.size * (1 + 1j)

    def _within(self, track: Points) -> bool:
        """Whether a point is on the drawing, or near it."""
        middle, half = self.box
        off = self.frame.at(track) - middle
        return bool((np.abs(off.real) <= _FAR * half.real).all() and (np.abs(off.imag) <= _FAR * half.imag).all())

    def _beside(self, track: Callable[[Mechanism], Points]) -> complex:
        """From a point that lies beyond the drawing to a body of the drawing that moves as it does; 0 within it."""
        at = self.frame.at(track(self._mechanism(0, np.linspace(0.0, 0.93, _PROBES))))
        middle, half = self.box
        off = at - middle
        if (np.abs(off.real) <= 1.02 * half.real).all() and (np.abs(off.imag) <= 1.02 * half.imag).all():
            return 0j
        for part in self._probes.parts:
            if isinstance(part, Body) and float(np.ptp(part.turn)) == 0.0:
                apart = part.place - at
                if float(np.abs(apart - apart[0]).max()) <= _NEAR * self.size:
                    return complex(apart[0]) + complex(part.outline[:-1].mean())
        return 0j

    def of(self, wish: Wish) -> Found:
        """Parts, marks and keys of one wish.

        Raises
            WrongShow
        """
        if wish.what in ("velocity", "acceleration"):
            return self._vectors(wish)
        if wish.what in ("force", "path"):
            return self._forces(wish) if wish.what == "force" else self._path(wish)
        return self._centres() if wish.what == "centres" else self._ghosts()

    def _mechanism(self, order: int, fraction: Reals | None = None) -> Mechanism:
        """The links there; beyond the range of the motion at its end."""
        q = self.frame.inputs(self.fraction if fraction is None else fraction)
        return self.frame.motion.at(_clipped(self.frame.motion.input, q), order)

    def _known(self, track: Points) -> Points:
        """A track of the motion in the scene, which is not there beyond the range of the motion."""
        inside = within(self.frame.motion.input, self.frame.inputs(self.fraction))
        return np.where(inside, self.frame.at(track), _OFF)

    @property
    def _whole(self) -> Reals:
        return np.arange(_SAMPLES) / _SAMPLES

    def _places(self, point: str) -> dict[str, vectors.Place]:
        """The points of a wish by name."""
        whole = self._mechanism(0, self._whole)
        try:
            return {point: vectors.place_of(whole, point)} if point else vectors.moving_points(whole)
        except vectors.UnknownPoint as error:
            raise WrongShow(f"--show: {error}") from None

    def _arrows(self, what: str, tracks: Mapping[str, tuple[Points, Points]], most: float, unit: str) -> Found:
        """Arrows of one scale, the longest of the whole loop a set share of the drawing, and the key of the scale."""
        if most <= 0.0 or not math.isfinite(most):
            return [], [], [Key(f"{what}: none", _COLORS[what], 0.0)]
        scale = _LONGEST * self.size / most
        parts: list[Part] = [
            Arrow(start=self._known(at), vector=scale * self.frame.along(vector), color=_COLORS[what],
                  name=f"{what} {name}")
            for name, (at, vector) in tracks.items()
        ]  # fmt: skip
        round_ = round_below(0.5 * most)
        return parts, [], [Key(f"{what} {round_:g} {unit}", _COLORS[what], scale * round_)]

    def _vectors(self, wish: Wish) -> Found:
        """Velocity or acceleration, in real time where the speed of the input is known."""
        order = 1 if wish.what == "velocity" else 2
        speed = speed_of(self.design)
        factor = 1.0 if speed is None else speed**order
        places = self._places(wish.point)
        now, whole = self._mechanism(order), self._mechanism(order, self._whole)
        sizes = (float(np.abs(vectors.rates_of(whole, each).derivative(order)).max()) for each in places.values())
        most = max(sizes, default=0.0)
        tracks = {}
        for name, each in places.items():
            rates = vectors.rates_of(now, each)
            beside = self._beside(lambda links, at=each: vectors.rates_of(links, at).value)  # type: ignore[misc]
            tracks[name] = rates.value + self.frame.back(beside), factor * rates.derivative(order)
        per = self.frame.motion.input.unit
        unit = ("mm/s", "mm/s²")[order - 1] if speed is not None else (f"mm/{per}", f"mm/{per}²")[order - 1]
        return self._arrows(wish.what, tracks, abs(factor) * most, unit)

    def _forces(self, wish: Wish) -> Found:
        """Forces on the second link of each joint, and of teeth on the second gear, at the constant speed."""
        loaded = loads_design(self.design)
        if loaded is None:
            raise WrongShow("--show force needs the loads of the design: a section `loads`")
        if loaded.locked:
            raise WrongShow("--show force: friction locks the mechanism, so that it has no forces")
        machine, unknown = loaded.machine, tuple(loaded.unknown_joints)
        now = vectors.loads_of(machine.reactions(self._loaded(machine, self.fraction)), unknown)
        whole = vectors.loads_of(machine.reactions(self._loaded(machine, self._whole)), unknown)
        if wish.point and wish.point not in now:
            raise WrongShow(f"--show force:{wish.point}: the connections are {', '.join(now)}")
        chosen = {name: each for name, each in now.items() if wish.point in ("", name)}
        most = max((float(np.nanmax(np.abs(whole[name].force))) for name in chosen), default=0.0)
        drawn = {name: (each.at, each.force) for name, each in chosen.items() if self._within(each.at)}
        return self._arrows("force", drawn, most, "N")

    def _loaded(self, machine: Any, fraction: Reals) -> Reals:
        """Inputs of the loads, which may run over another period than the motion."""
        return _clipped(machine.motion.input, self.frame.inputs(fraction))

    def _path(self, wish: Wish) -> Found:
        """The path of a point, with a tick every 30 deg of a turning input, numbers at every 90, and its direction."""
        place = self._places(wish.point)[wish.point]
        path = self.frame.at(vectors.rates_of(self._mechanism(0, np.linspace(0.0, 1.0, 361)), place).value)
        parts: list[Part] = [Line(points=path, color=BLACK, width=1.4, name=f"path of {wish.point}")]
        given, marks = self.frame.motion.input, []
        if given.unit == "rad" and given.end - given.start <= TURN * (1.0 + 1e-9):
            degrees = np.arange(math.ceil(math.degrees(given.start) / 30.0 - 1e-9) * 30.0,
                                math.degrees(given.end) - 1e-6, 30.0)  # fmt: skip
            point = vectors.rates_of(self.frame.motion.at(np.radians(degrees), 1), place)
            at, way = self.frame.at(point.value), self.frame.along(point.first)
            for k, degree in enumerate(degrees.tolist()):
                across = 1j * way[k] / abs(way[k]) if abs(way[k]) > 1e-9 * self.size else 1j
                long = 0.012 if round(degree) % 90 else 0.02
                tick = at[k] + long * self.size * across * np.array([-1.0, 1.0])
                parts.append(Line(points=tick, color=BLACK, width=1.2))
            marks = self._numbers(dict(zip(degrees.tolist(), at.tolist(), strict=True)))
        parts += [self._head(path, k) for k in (30, 150, 270)]
        return parts, marks, [Key(f"path of {wish.point}", BLACK, 0.0)]

    def _numbers(self, places: Mapping[float, complex]) -> list[Mark]:
        """Every 90 deg of a path, those that would lie on each other in one."""
        found: list[tuple[complex, list[str]]] = []
        for degree, at in places.items():
            if round(degree) % 90 == 0:
                near = next((words for place, words in found if abs(place - at) < _BESIDE * self.size), None)
                if near is None:
                    found.append((at, [f"{degree:g}°"]))
                else:
                    near.append(f"{degree:g}°")
        return [Mark(np.full(self.fraction.shape, at), " ".join(words)) for at, words in found]

    def _head(self, path: Points, k: int) -> Part:
        """An arrow head on a path, in its direction."""
        way = path[k + 1] - path[k - 1]
        way = way / abs(way) if abs(way) > 0.0 else 1.0
        head = path[k] + 0.018 * self.size * way * np.array([1.0, -1.0 + 0.6j, -1.0 - 0.6j, 1.0])
        return Line(points=head, color=BLACK, width=1.4)

    def _centres(self) -> Found:
        """Instant centres against the frame of the links that no pin of the frame holds, with rays to two joints."""
        now = self._mechanism(1)
        held = {name for each in now.connections if isinstance(each, Pin) and FRAME in (each.first, each.second)
                for name in (each.first, each.second)}  # fmt: skip
        parts, marks, keys = list[Part](), list[Mark](), list[Key]()
        middle, half = self.box
        for name, link in now.links.items():
            pole = self._known(vectors.centre(now, name))
            turning = np.abs(link.turn.first) > 1e-9
            off = pole - middle
            far = ~((np.abs(off.real) < _FAR * half.real) & (np.abs(off.imag) < _FAR * half.imag)) | ~turning
            if name in held or not turning.any():
                continue
            if (away := far & turning & np.isfinite(pole)).any():
                arrow, mark, more = self._beyond(name, off, away)
                parts, marks, keys = [*parts, arrow], [*marks, mark], [*keys, *more]
            pole = np.where(far, _OFF, pole)
            if not np.isfinite(pole).any():
                continue
            ends = [each.at for each in now.connections if isinstance(each, Pin) and name in (each.first, each.second)]
            parts += [Chain(joints=(pole, self.frame.at(end)), color=GREY, width=0.8, marked=False) for end in ends[:2]]
            level = np.zeros(pole.shape)
            parts.append(wheel(pole, 0.009 * self.size, level, color=RED, fill=RED))
            marks.append(Mark(pole, f"P {name}"))
        return parts, marks, [Key("P: instant centre against the frame", RED, 0.0), *keys] if parts else []

    def _beyond(self, name: str, off: Points, away: Mask) -> tuple[Arrow, Mark, list[Key]]:
        """An arrow at the edge towards an instant centre that lies beyond it, with its distance on a still picture."""
        middle, half = self.box
        off = np.where(away, off, 1.0)
        across = np.maximum(np.abs(off.real) / half.real, np.abs(off.imag) / half.imag)
        edge, way = middle + off / across, 0.06 * self.size * off / np.abs(off)
        far = float(np.abs(off[0]) * (1.0 - 1.0 / across[0]))
        keys = [Key(f"P {name}: {far:.3g} mm beyond the edge", RED, 0.0)] if len(off) == 1 else []
        arrow = Arrow(start=np.where(away, edge - way, _OFF), vector=way, color=RED)
        return arrow, Mark(np.where(away, edge - 2.0 * way, _OFF), f"P {name}"), keys

    def _ghosts(self) -> Found:
        """Earlier positions, the paler the older."""
        parts: list[Part] = []
        given = self.frame.motion.input
        step = _APART / max(given.turns or 1, 1)
        for k in range(_GHOSTS, 0, -1):
            earlier = self.maker(self.design, (self.fraction - k * step) % 1.0)
            color = _grey(k)
            for part in earlier.parts:
                if isinstance(part, Chain) and part.marked:
                    parts.append(replace(part, color=color, width=0.6 * part.width, marked=False))
                elif isinstance(part, Body) and part.repeats == 1 and not part.pitch and np.ptp(part.place.real) > 0.0:
                    parts.append(replace(part, color=color, fill="", width=1.0, label="", name=""))
        words = "earlier positions"
        if given.turns is not None and given.unit == "rad":
            words += f", {math.degrees(given.end - given.start) * step:.4g}° apart"
        return parts, [], [Key(words, _grey(1), 0.0)] if parts else []


def _clipped(given: Input, q: Reals) -> Reals:
    """Inputs, those beyond a range at its end."""
    return np.asarray(q if given.turns is not None else np.minimum(np.maximum(q, given.start), given.end))


def _grey(k: int) -> str:
    level = 150 + 22 * k
    return f"#{level:02x}{level:02x}{level:02x}"


def speed_of(design: Any) -> float | None:
    """Speed of the input [rad/s, mm/s], where the file has one."""
    found, given = getattr(design, "angular_speed", None), getattr(design.spec, "speed", None)
    if found is None and given is not None:  # of cams, in 1/min; machines in sheets/h have the other
        return float(given) * RPM
    if found is None and getattr(design.spec, "loads", None) is not None:
        loaded = loads_design(design)
        found = None if loaded is None else loaded.speed
    return None if found is None else float(found)


def loads_design(design: Any) -> Any:
    """The design of the loads of the same file; None where the file or the kind has none."""
    if _is_loaded(design):
        return design
    return design.of_command("loads") if _names_loads(design) else None


# What fails


def _with_faults(scene: Scene, design: Any, fraction: Reals, maker: Maker, checks: Sequence[Check]) -> Scene:
    failed = [check for check in checks if check.status == "fail"]
    if not failed:
        return scene
    found = list(_Failing(scene, design, fraction, maker).of(failed))
    parts = [part for _, more in found for part in more]
    own = scene.own or (0, len(scene.parts), len(scene.marks))
    return replace(scene, parts=(*scene.parts, *parts), faults=tuple(fault for fault, _ in found), own=own)


def layouts_of(design: Any) -> Iterable[Layout]:
    """The bodies of a design, plane by plane; none of one without gears in a plane."""
    if hasattr(type(design), "layouts"):
        return tuple(design.layouts)
    return (design.layout,) if hasattr(type(design), "layout") else ()


def clashes(design: Any) -> Iterator[Clearance]:
    """Pairs of bodies that fail: gears nearer than limits.gear_gap, shafts of the file that are not clear."""
    least = getattr(design.spec.limits, "gear_gap", 0.0)
    for layout in layouts_of(design):
        yield from (pair for pair in layout.gear_pairs if pair.gap < least)
        yield from (pair for pair in layout.shaft_pairs if pair.gap < 0.0 and not pair.bare)


Told: TypeAlias = "Iterator[tuple[Mask, list[Part]]]"


@dataclass(frozen=True)
class _Failing:
    """Where on a scene what fails, over fractions of its loop."""

    scene: Scene
    design: Any
    fraction: Reals
    maker: Maker

    def of(self, failed: Sequence[Check]) -> Iterator[tuple[Fault, list[Part]]]:
        """Each failing check with its instants and the bodies that fail, as far as the motion tells them."""
        told = {"GL301": self._clashes, "GL302": self._clashes, "GL303": self._transmission, "GL401": self._pressure}
        seen: set[str] = set()
        for check in failed:
            words = drawn(check.brief)
            if words in seen:
                continue
            seen.add(words)
            made = list(told[check.code]()) if check.code in told else []
            at = np.zeros(self.fraction.shape, dtype=bool)
            for mask, _ in made:
                at |= mask
            if not at.any():
                at = self._named_instant(check)
            yield Fault(words, at | (not at.any()), bool(at.any())), [part for _, parts in made for part in parts]

    @cached_property
    def _frame(self) -> Frame | None:
        return frame_of(self.design, self.maker) if has_motion(self.design) else None

    @cached_property
    def _inputs(self) -> Reals | None:
        """Inputs of the motion at the positions; None where the scene does not tell."""
        return None if self._frame is None else self._frame.inputs(self.fraction)

    def _clashes(self) -> Told:
        """Gears and shafts that are too near, at the positions at which they are."""
        from gearlink.core.studies.clearance import Shaft, gaps

        places = {mark.text: np.asarray(mark.point) for mark in self.scene.marks}
        least = getattr(self.design.spec.limits, "gear_gap", 0.0)
        for pair in clashes(self.design):
            if pair.one.axis not in places or pair.other.axis not in places:
                continue
            apart = np.abs(places[pair.one.axis] - places[pair.other.axis])
            limit = 0.0 if isinstance(pair.one, Shaft) or isinstance(pair.other, Shaft) else least
            mask = np.max([*gaps(pair.one, pair.other, apart, apart)], axis=0) < limit - 1e-9
            parts: list[Part] = [
                _red(circle(radius), places[body.axis], mask)
                for body in (pair.one, pair.other)
                for radius in sorted({body.outer, max(body.inner, 0.0)} - {0.0})
            ]
            yield mask, parts

    def _transmission(self) -> Told:
        """The links in red where the transmission angle is below its limit."""
        q = self._inputs
        angle = None if q is None else self._least_transmission(q)
        if angle is None:
            return
        mask = angle < self.design.spec.limits.transmission_angle
        links = [part for part in self.scene.parts if isinstance(part, Chain) and part.marked]
        joints = [tuple(np.where(mask, joint, _OFF) for joint in part.joints) for part in links]
        yield mask, [replace(part, joints=own, color=WRONG) for part, own in zip(links, joints, strict=True)]

    def _least_transmission(self, q: Reals) -> Reals | None:
        """The least transmission angle at inputs [deg], infinite beyond the range of the motion."""
        motion = self.design.moving
        if motion.transmission is None:
            return None
        inside = within(motion.input, q)
        angle = motion.transmission.rates(motion, np.where(inside, q, motion.input.start), 1)[0]
        return np.where(inside, np.degrees(angle), np.inf)

    def _pressure(self) -> Told:
        """A red ring about the roller where the pressure angle is above its limit."""
        frame, spec = self._frame, self.design.spec
        limits = getattr(spec, "pressure_limits", None)
        limit = max(limits()) if limits is not None else getattr(spec.limits, "pressure_angle", None)
        if frame is None or limit is None or getattr(spec, "is_flat", False):
            return
        size, q, given = _reach(self.scene), self._inputs, frame.motion.input
        assert q is not None, "the frame has them"
        inside = within(given, q)
        there = frame.motion.at(np.where(inside, q, given.start), 1)
        for at, angle in vectors.pressure_angles(there).values():
            mask = inside & (np.degrees(angle) > limit)
            yield mask, [_red(circle(0.05 * size), frame.at(at), mask)]

    def _named_instant(self, check: Check) -> Mask:
        """The position nearest to the place that a finding names; none where it names no input of the motion."""
        found, q = _DEGREES.search(check.at), None
        if found and has_motion(self.design):
            words = self.design.moving.input.column.replace("_", " ")
            q = self._inputs if words in check.at or "input angle" in check.at else None
        if found is None or q is None:
            return np.zeros(self.fraction.shape, dtype=bool)
        apart = np.abs((np.degrees(q) - float(found[1]) + 180.0) % 360.0 - 180.0)
        return np.asarray(apart <= float(apart.min()) + 1e-9)


def _red(outline: Points, place: Points, mask: Mask) -> Body:
    at = np.where(mask, place, _OFF)
    return Body(outline=outline, place=at, turn=np.zeros(len(mask)), color=WRONG, width=2.4, repeats=0)
