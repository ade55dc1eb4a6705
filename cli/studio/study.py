"""A design as it stands in a text: what the page shows of it, and what its own sensitivities say of its keys."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache, cached_property, lru_cache
from multiprocessing import parent_process
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.cli.evaluate import read_spec, refusals_located
from gearlink.cli.reading.design_file import parse, read_kind
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.studio.text import with_value
from gearlink.core.base.errors import GearlinkError, NoSolution
from gearlink.core.base.key_results import KeyResult, key_results
from gearlink.core.base.kind import FileDesigns
from gearlink.core.base.kinds import KINDS

if TYPE_CHECKING:
    from gearlink.cli.studio.numbers import Number
    from gearlink.cli.views.films.page import Reach
    from gearlink.cli.views.scenes.scene import Scene
    from gearlink.cli.views.scenes.shown import Wish
    from gearlink.core.base.design import Design
    from gearlink.core.base.report import Check


class Look(NamedTuple):
    """How an animation is to be shown.

    Fields
        reach : x from, x to, y from, y to [mm] - what the picture has shown so far
        held : float - the fraction of the loop at which a joint is held: one picture is of it, and `reach` stays
        show : str - what is shown on the mechanism, as `animate --show` has it
        bare : bool - the mechanism alone, drawn as it is where that is shown on it
    """

    reach: Reach | None = None
    held: float | None = None
    show: str = ""
    bare: bool = False


class Study:
    """The designs of a text, each computed as far as it is asked for.

    Raises
        DesignFileError - for a text that is no design
    """

    def __init__(self, text: str, file: str) -> None:
        self.text, self.file = text, file
        self.loaded = parse(text.encode(), file)
        self.kind = KINDS[read_kind(self.loaded, tuple(KINDS))]
        self.spec = read_spec(self.loaded, self.kind, file)
        self.commands: tuple[str, ...] = tuple(self.spec.commands())
        self._designs = FileDesigns(self.kind, self.spec)
        self._kept: dict[str, Design] = {}

    def design(self, command: str) -> Design:
        """The design that serves a command."""
        if command not in self._kept:
            with refusals_located(self.loaded):
                self._kept[command] = self._designs.of(command)
        return self._kept[command]

    def results(self, command: str, names: Sequence[str] = ()) -> tuple[KeyResult, ...]:
        """The key results of a command.

        Parameters
            names : the quantities of which they are, where that is known; else all of the command are computed
        Raises
            DesignFileError - where it is refused, at its line
        """
        design = self.design(command)
        with refusals_located(self.loaded):
            asked = tuple(names) or design.outline(command).quantities
            design.prepare(asked)
            found = [quantity for name in asked if (quantity := design.quantity(name)) is not None]
            return key_results(design, command, found)

    def checks(self, command: str, *, advised: bool) -> list[Check]:
        """The findings of a command; where they are `advised`, with what was tried to repair them."""
        design = self.design(command)
        before, design.advises = design.advises, advised and design.advises
        try:
            with refusals_located(self.loaded):
                names = design.outline(command).checks
                judge: Callable[[str], Any] = (lambda name: design.findings(command, name)) if advised else design.check
                return [check for name in names for check in judge(name)]
        finally:
            design.advises = before

    @property
    def moves(self) -> bool:
        """Whether there is something to be seen moving."""
        return bool(self.kind.scene or self.kind.motion)

    @property
    def moved(self) -> Design:
        """The design that is shown moving: an analysis of given links before a synthesis."""
        return self.design("analyze" if "analyze" in self.commands else self.commands[0])

    @cached_property
    def showable(self) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """What can be shown on the mechanism, and the points that have a path."""
        from gearlink.cli.views.scenes import shown

        with refusals_located(self.loaded):
            return shown.possible(self.moved)

    def wanted(self, show: str) -> tuple[Wish, ...]:
        """What is to be shown, as far as this design has it."""
        from gearlink.cli.views.scenes import shown

        words, points = self.showable if show else ((), ())
        found = shown.wishes(show)
        return tuple(wish for wish in found if wish.what in words and (not wish.point or wish.point in points))

    def scene(self, fractions: Any, show: str = "") -> Scene:
        """The mechanism over fractions of its loop, as it stands where something is shown on it, without that."""
        from gearlink.cli.views.scenes import shown

        with refusals_located(self.loaded):
            return shown.maker_of(self.moved, self.wanted(show))(self.moved, fractions)

    @cached_property
    def pictures(self) -> int:
        """How many pictures show its teeth turning the right way, as far as a page takes them."""
        import numpy as np

        from gearlink.cli.views.scenes import linkages

        return min(_MOST_PICTURES, linkages.pictures_for(self.scene(np.arange(96) / 96), FPS))

    def film(self, most: int, look: Look, checks: Sequence[Check] = ()) -> tuple[dict[str, Any], Reach]:
        """What the player draws, and what its picture shows: `look.reach` as long as that suits it.

        Parameters
            most : pictures, at most
            checks : findings; instants at which one fails are red
        """
        import numpy as np

        from gearlink.cli.views.films.page import player_data, player_stage

        count = min(most, self.pictures)
        after = 0.0 if look.held is None else look.held * count % 1.0
        fractions = (np.arange(count) + after) / count
        scene, refused = (
            (self.scene(fractions, look.show), "") if look.bare else self._shown(fractions, look.show, checks)
        )
        own = player_stage(scene, "").own_reach
        kept = look.bare or look.held is not None
        reach = look.reach if look.reach and (kept or _within(own, look.reach)) else _roomy(own)
        data = player_data(scene, self.spec.name, FPS * count / self.pictures, reach=reach)
        words, points = self.showable
        return data | {"show": look.show, "words": words, "points": points, "refused": refused}, reach

    def _shown(self, fractions: Any, show: str, checks: Sequence[Check]) -> tuple[Scene, str]:
        """The scene with what is shown on it and what fails; without the former, and why, where that is refused."""
        from gearlink.cli.views.scenes import shown

        with refusals_located(self.loaded):
            wanted = self.wanted(show)
            try:
                return shown.build(self.moved, fractions, wanted, checks), ""
            except (shown.WrongShow, NoSolution) as error:
                if not wanted:
                    raise
                return shown.build(self.moved, fractions, (), checks), str(error).removeprefix("--show ")


FPS, _MOST_PICTURES = 25, 150
_ROOM = 0.06


def _within(own: Reach, reach: Reach) -> bool:
    """Whether a picture shows all that moves, and not much besides."""
    inside = own[0] >= reach[0] and own[1] <= reach[1] and own[2] >= reach[2] and own[3] <= reach[3]
    return inside and max(own[1] - own[0], own[3] - own[2]) > 0.6 * max(reach[1] - reach[0], reach[3] - reach[2])


def _roomy(own: Reach) -> Reach:
    """With some room about it, so that the picture need not change its scale at each step of a slider."""
    room = _ROOM * max(own[1] - own[0], own[3] - own[2])
    return own[0] - room, own[1] + room, own[2] - room, own[3] + room


# What takes longer, in a process beside the page


@cache
def step_back() -> None:
    """Let the page go first: what is computed beside it takes the processors that it leaves."""
    if parent_process() is not None and hasattr(os, "nice"):
        os.nice(4)


@lru_cache(2)
def _study(text: str, file: str) -> Study:
    step_back()
    return Study(text, file)


def moving(text: str, file: str, commands: Sequence[str], count: int, look: Look) -> tuple[Any, Any]:
    """The findings of some commands, and an animation of few pictures; None where nothing moves."""
    study = _study(text, file)
    checks = {command: study.checks(command, advised=False) for command in commands}
    return checks, film(text, file, count, look, checks)


def slow(text: str, file: str, names: Mapping[str, Sequence[str]]) -> tuple[Any, Any, dict[str, float]]:
    """Results and findings of commands that take long, and how long the results took [s].

    Parameters
        names : their key results, where they are known
    """
    study, results, seconds = _study(text, file), {}, {}
    for command, known in names.items():
        begun = time.perf_counter()
        results[command] = study.results(command, known)
        seconds[command] = time.perf_counter() - begun
    return results, {command: study.checks(command, advised=False) for command in names}, seconds


def whole(text: str, file: str, look: Look) -> tuple[Any, Any, Any]:
    """Key results and findings of all commands, these with what would repair them, and the whole animation."""
    study = _study(text, file)
    results = {command: study.results(command) for command in study.commands}
    checks = {command: study.checks(command, advised=True) for command in study.commands}
    return results, checks, film(text, file, _MOST_PICTURES, look, checks)


def film(
    text: str, file: str, most: int, look: Look, checks: Mapping[str, Sequence[Check]] | None = None
) -> tuple[dict[str, Any], Reach] | None:
    """The animation of at most so many pictures; None where nothing moves, or it cannot be drawn."""
    study = _study(text, file)
    if not study.moves:
        return None
    try:
        return study.film(most, look, [check for each in (checks or {}).values() for check in each])
    except DesignFileError:
        return None


def changes(old: str, new: str, file: str) -> str:
    """What `diff` says of two texts, as HTML; empty where nothing has changed."""
    from gearlink.cli.commands.diff import compared, parts_of, side_of
    from gearlink.cli.render.numbers import number
    from gearlink.cli.views.page.sections import table

    sides = [side_of(study.loaded, study.kind) for study in (_study(old, file), _study(new, file))]
    heads = ("old", "new", "unit", "change", "command")
    found = compared(sides[0], sides[1], (file, file))
    parts = parts_of(found, lambda value: number(value, 7))
    return "".join(table((part, *heads), rows, numeric=(1, 2)) for part, rows in parts)


def sheet(text: str, file: str, command: str) -> str:
    """The sheet of a command as HTML; empty where it has none."""
    from gearlink.cli.views.page.sections import sheet as drawn

    study = _study(text, file)
    with refusals_located(study.loaded):
        return drawn(command, study.design(command), study.checks(command, advised=False))


# A wish: the value of one key with which a result is what it should be


class Refused(GearlinkError):
    """What is wished cannot be had; the message says what can."""


class Solved(NamedTuple):
    """The text with another value of a key, and what its result is."""

    text: str
    value: float
    result: float


_SIDE, _LEAST_SIDE, _SECONDS = 24, 6, 20.0
"""Places of the key on either side of its value, at least so many of a slow design, and the time for a wish [s]."""
_CLOSE = 5e-5
"""Of the wish: what comes so near is printed as the wish."""
_HALVINGS = 60


def wished(text: str, file: str, command: str, name: str, target: float, key: Number) -> Solved:
    """Change one key so that a result becomes what is wished.

    Parameters
        name, target : the quantity, and its value in its own unit
        key : Number - the range of its slider is searched, the nearest places first
    Raises
        Refused - with the limit, where no value of the key gives that
    Notes
        Between two places whose results lie on either side of the wish it is found by regula falsi (Illinois); the
        value is then rounded as coarsely as leaves the result within 5e-5 of the wish. Own procedure.
    """
    end = time.monotonic() + _SECONDS

    def made(value: float) -> str:
        return with_value(text, key.path, int(value) if key.whole else value, as_written=True)

    def off(value: float) -> float | None:
        if time.monotonic() > end:
            raise _Late
        result = _value(made(value), file, command, name)
        return None if result is None else result - target

    seen: dict[float, float | None] = {}
    try:
        for low, high in _intervals(key, off, seen):
            value = high if seen[high] == 0.0 else _root(off, low, high, seen, whole=key.whole)
            for step in (key.step,) if key.whole else [key.step * 10.0**-k for k in range(7)]:
                near = round(round(value / step) * step, max(0, 2 - math.floor(math.log10(step))))
                miss = off(near)
                if miss is not None and (key.whole or abs(miss) <= _CLOSE * max(abs(target), _CLOSE)):
                    return Solved(made(near), near, target + miss)
    except _Late:
        raise _limit(key, name, target, None, seen) from None
    raise _limit(key, name, target, off, seen)


class _Late(Exception):
    """The time for a wish is over."""


def _value(text: str, file: str, command: str, name: str) -> float | None:
    """A result of a text; None where there is no such design, or no such number."""
    try:
        study = Study(text, file)
        if command not in study.commands:
            return None
        with refusals_located(study.loaded):
            found = study.design(command).quantity(name)
    except DesignFileError:
        return None
    value = found.value if found is not None else None
    return float(value) if isinstance(value, (int, float)) and math.isfinite(value) else None


def _intervals(
    key: Number, off: Callable[[float], float | None], seen: dict[float, float | None]
) -> Iterator[tuple[float, float]]:
    """Neighbouring values of the key between which the result passes the wish, from where it stands outwards."""
    low, high = key.range
    begun = time.monotonic()
    seen[key.value] = off(key.value)
    affordable = 0.25 * _SECONDS / max(time.monotonic() - begun, 1e-6)  # half of the time, for both sides
    count = min(_SIDE, max(_LEAST_SIDE, int(affordable)))
    last = {-1: key.value, 1: key.value}
    for k in range(1, count + 1):
        for side, end in ((-1, low), (1, high)):
            value = key.value + (end - key.value) * k / count
            value = float(round(value)) if key.whole else value
            before = last[side]
            if value == before:
                continue
            last[side], seen[value] = value, off(value)
            was, now = seen[before], seen[value]
            if was is not None and now is not None and was * now <= 0.0:
                yield before, value


def _root(
    off: Callable[[float], float | None], low: float, high: float, seen: dict[float, float | None], *, whole: bool
) -> float:
    """Where the wish lies between two values; of whole ones the nearer."""
    a, b = seen[low] or 0.0, seen[high] or 0.0
    for _ in range(0 if whole else _HALVINGS):
        middle = low + (high - low) * a / (a - b) if a != b else 0.5 * (low + high)
        c = off(middle)
        if c is None:
            middle = 0.5 * (low + high)
            c = off(middle)
        if c is None or c == 0.0 or abs(high - low) <= 1e-13 * max(abs(low), abs(high)):
            return middle
        if c * b < 0.0:
            low, a = high, b
        else:
            a *= 0.5
        high, b = middle, c
        if abs(c) < 1e-12:
            return middle
    return low if abs(a) < abs(b) else high


def _limit(
    key: Number, name: str, target: float, off: Callable[[float], float | None] | None, seen: dict[float, float | None]
) -> Refused:
    """The refusal of a wish, with the nearest that the key can give; `off` is None where the time is over."""
    known = {value: miss for value, miss in seen.items() if miss is not None}
    if not known:
        return Refused(f"{name}: no value of {key.name} from {key.range[0]:g} to {key.range[1]:g} gives a mechanism")
    best = min(known, key=lambda value: abs(known[value]))
    places = sorted(seen)
    at = places.index(best)
    left, right = places[max(0, at - 1)], places[min(len(places) - 1, at + 1)]
    side = math.copysign(1.0, known[best])
    try:
        for _ in range(0 if key.whole or off is None else 12):  # thirds: it is at an extreme, or where no more exists
            one, two = left + (right - left) / 3.0, right - (right - left) / 3.0
            misses = [off(one), off(two)]  # type: ignore[misc]
            far = [math.inf if miss is None else abs(miss) for miss in misses]
            for value, miss in zip((one, two), misses, strict=True):
                if miss is not None and abs(miss) < abs(known[best]):
                    best, known[value] = value, miss
            left, right = (left, two) if far[0] <= far[1] else (one, right)
        tried = "" if off is not None else f" of {len(seen)} values tried in {_SECONDS:g} s"
    except _Late:
        tried = f" of {len(seen)} values tried in {_SECONDS:g} s"
    word = "at least" if side > 0.0 else "at most"
    reached = target + known[best]
    return Refused(
        f"{name} {target:g} cannot be reached by {key.name} from {key.range[0]:g} to {key.range[1]:g}: {word} "
        f"{reached:.6g}, with {key.name} {best:.6g}{tried}"
    )


# A joint that is dragged


class Grip:
    """A joint that is held: which keys move it, and by how much.

    Parameters
        text, file : the design when it is taken
        which : (list of the scene, index, joint) - ("marks", 3, 0), ("parts", 2, 1)
        fraction : float - of the loop, at which the mechanism stands
        keys : the numbers that may change
        show : what is shown on the mechanism
    Raises
        Refused - where none of them moves the joint
    """

    def __init__(
        self, text: str, file: str, which: tuple[str, int, int], fraction: float, keys: Sequence[Number], show: str = ""
    ) -> None:
        import numpy as np

        self._text, self._file, self._which, self.fraction, self._show = text, file, which, fraction, show
        self.stopped = ""
        self._built = text
        start = self._point(text)
        if start is None:
            raise Refused("the mechanism has no such joint")
        self._at = np.array([start.real, start.imag])
        self._keys: list[Number] = []
        columns = []
        for key in keys:
            column = self._column(key, start)
            if column is not None:
                self._keys.append(key)
                columns.append(column)
        if not columns:
            locked = "every key that moves it is locked" if not keys else "no unlocked key moves this joint"
            raise Refused(locked)
        self._slopes = np.array(columns).T
        self._values = np.array([key.value for key in self._keys])
        self._sizes = np.array([max(abs(key.value), 10.0 * key.step) for key in self._keys])

    def _column(self, key: Number, start: complex) -> tuple[float, float] | None:
        """How the joint moves with a key, by its difference to one side [mm per unit]; None where it does not."""
        for side in (1.0, -1.0):
            by = side * max(1e-5 * abs(key.value), 1e-3 * key.step)
            moved = self._point(with_value(self._text, key.path, key.value + by, as_written=True))
            if moved is not None:
                slope = (moved - start) / by
                return (slope.real, slope.imag) if abs(slope) * max(abs(key.value), key.step) > 1e-6 else None
        return None

    def _point(self, text: str) -> complex | None:
        import numpy as np

        try:
            scene = Study(text, self._file).scene(np.array([self.fraction]), self._show)
            return point_of(scene, self._which)
        except DesignFileError as error:
            self.stopped = error.diagnostics[0].message
        except LookupError:
            self.stopped = "the mechanism no longer has this joint"
        return None

    def to(self, target: complex) -> str:
        """The text with which the joint is as near to a point [mm] as the keys allow, each on the grid of what can be
        built, and all changed by as small a share as possible; `stopped` says why it goes no farther.

        Notes
            Newton steps on the design's own sensitivities, brought up to date by Broyden's rank-one rule; a step that
            leads to no mechanism is halved. Minimum change: Moore-Penrose inverse of the scaled slopes.
        """
        import numpy as np

        goal = np.array([target.real, target.imag])
        self.stopped = ""
        for _ in range(4):
            miss = goal - self._at
            if float(np.hypot(*miss)) < 1e-3:
                self.stopped = ""
                break
            step = self._sizes * (np.linalg.pinv(self._slopes * self._sizes, rcond=1e-4) @ miss)
            share = float(np.max(np.abs(step / self._sizes)))
            if share < 1e-12 or not self._go(step * min(1.0, 0.3 / share)):  # no key leads nearer, or none may
                break
        made = self._made(self._values, on_grid=True)
        if made != self._built and self._point(made) is not None:
            self._built = made
        return self._built

    def _go(self, step: Any) -> bool:
        import numpy as np

        for _ in range(5):
            values = self._values + step
            point = self._point(self._made(values)) if self._allowed(values) else None
            if point is not None:
                moved = np.array([point.real, point.imag]) - self._at
                self._slopes = self._slopes + np.outer(moved - self._slopes @ step, step / self._sizes**2) / float(
                    np.sum((step / self._sizes) ** 2)
                )
                self._at, self._values = self._at + moved, values
                return True
            step = 0.5 * step
        return False

    def _allowed(self, values: Any) -> bool:
        return all(key.least < value < key.most for key, value in zip(self._keys, values.tolist(), strict=True))

    def _made(self, values: Any, *, on_grid: bool = False) -> str:
        text = self._text
        for key, value in zip(self._keys, values.tolist(), strict=True):
            text = with_value(text, key.path, key.on_grid(value) if on_grid else value, as_written=True)
        return text


def point_of(scene: Scene, which: tuple[str, int, int]) -> complex:
    """A joint of a scene at its first picture.

    Raises
        LookupError - where the scene has none there
    """
    from gearlink.cli.views.scenes.scene import Body, Chain

    place, index, joint = which
    if place == "marks":
        return complex(scene.marks[index].point[0])
    part = scene.parts[index]
    if isinstance(part, Chain):
        return complex(part.joints[joint][0])
    if isinstance(part, Body):
        return complex(part.place[0])
    raise LookupError("a line does not move")
