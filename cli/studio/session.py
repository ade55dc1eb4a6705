"""What happens between the hand and the numbers: the newest text is computed, what matters first, and shown."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Coroutine, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from html import escape
from typing import TYPE_CHECKING, Any, Protocol

from gearlink.cli.printable import visible
from gearlink.cli.reading.design_file import parse, read_kind
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.studio import study as making
from gearlink.cli.studio.numbers import Number, numbers
from gearlink.cli.studio.study import Grip, Refused, Study
from gearlink.cli.studio.text import CannotPlace, Changed, Document, with_value, with_values
from gearlink.core.base.errors import GearlinkError, NoSolution
from gearlink.core.base.kinds import KINDS

if TYPE_CHECKING:
    from gearlink.cli.views.films.page import Reach
    from gearlink.cli.views.films.stage import Stage
    from gearlink.core.base.key_results import KeyResult
    from gearlink.core.base.report import Check, Remedy

_AT_ONCE = 48
"""Pictures of an animation while the hand moves."""
_QUICK = 0.04
"""Results of further commands that take longer are computed beside the page [s]."""
_REST = 0.35
"""After so many seconds without a change the hand rests [s]."""


class Page(Protocol):
    """What a page in a browser takes."""

    def text(self, text: str) -> None:
        """The text of the file."""

    def numbers(self, found: Sequence[Number]) -> None:
        """Every number of it."""

    def actions(self, can: dict[str, bool]) -> None:
        """Which buttons would do something."""

    def results(self, found: Sequence[KeyResult], before: dict[str, KeyResult]) -> None:
        """The key results, and those of the first design that the file had."""

    def checks(self, found: Sequence[Check]) -> None:
        """The findings."""

    def film(self, data: dict[str, Any] | None, ghost: dict[str, Any] | None) -> None:
        """The mechanism in motion."""

    def sheet(self, command: str, html: str) -> None:
        """The sheet of a command."""

    def sheets(self, commands: Sequence[str]) -> None:
        """Which sheets there are."""

    def changed(self, html: str) -> None:
        """What is not as it was opened."""

    def problem(self, wrong: Sequence[Diagnostic], html: str) -> None:
        """What is wrong with the text; none where nothing is."""

    def say(self, words: str) -> None:
        """A word about what was just asked for."""

    def answered(self) -> None:
        """A joint that is dragged has come where it can."""


@dataclass
class State:
    """The last design that could be made, as it was shown."""

    study: Study | None = None
    numbers: list[Number] = field(default_factory=list)
    results: dict[str, tuple[KeyResult, ...]] = field(default_factory=dict)
    checks: dict[str, list[Check]] = field(default_factory=dict)
    film: dict[str, Any] | None = None
    reach: Reach | None = None
    changed: str = ""
    sheets: dict[str, str] = field(default_factory=dict)


class Session:
    """A file under the hand.

    Parameters
        beside : two processes in which what takes longer is computed
    """

    def __init__(self, document: Document, beside: Executor) -> None:
        self.document, self._beside = document, beside
        self.pages: list[Page] = []
        self.state = State()
        self.locks: dict[str, bool] = {}
        self._show = ""
        self._first = State()
        self._ghost: dict[str, Any] | None = None
        self._ghost_look: making.Look | None = None
        self._known: dict[Any, Any] = {}
        self._kind = ""
        self._version = self._shown = 0
        self._cost: dict[str, float] = {}
        self._news, self._followed = asyncio.Event(), asyncio.Event()
        self._grip: tuple[Grip, Stage] | None = None
        self._wrong: tuple[list[Diagnostic], str] = ([], "")

    # What a page asks for

    def join(self, page: Page) -> None:
        """A page that has been opened: it is shown what there is."""
        self.pages.append(page)
        state = self.state
        page.text(self.document.text)
        page.numbers(state.numbers)
        page.actions(self.document.can)
        page.results(self._all_results(), self._before())
        page.checks(self._all_checks())
        if state.study is not None:
            page.film(state.film, self._ghost)
            page.sheets(state.study.commands)
            for command, html in state.sheets.items():
                page.sheet(command, html)
        page.changed(state.changed)
        page.problem(*self._wrong)

    def put(self, text: str, hand: str = "") -> None:
        """Another text."""
        if self.document.change(text, hand):
            self._fresh()

    def move(self, path: Any, value: float) -> None:
        """Another number, by a slider that is held or a field that is typed in."""
        self._try(lambda: self.put(with_value(self.document.text, path, value, as_written=True), str(path)))

    def apply(self, remedy: Remedy) -> None:
        """Change what a finding says."""
        self._try(lambda: self.put(with_values(self.document.text, remedy)))

    def act(self, action: str) -> None:
        """One of undo, redo, save, revert; a joint that is held is let go where it was last shown."""
        self._grip = None

        def run() -> None:
            done: Any = getattr(self.document, action)()
            if action == "save":
                self._each(lambda page: page.say(f"written: {visible(str(self.document.path))}"))
            if done is not False:
                self._fresh()

        self._try(run)

    def show(self, words: str) -> None:
        """What is shown on the mechanism, as `animate --show` has it."""
        from gearlink.cli.views.scenes import shown

        def run() -> None:
            shown.wishes(words)
            self._show = words
            self._fresh()

        self._try(run)

    def _try(self, run: Callable[[], None]) -> None:
        try:
            run()
        except (CannotPlace, Changed, GearlinkError, OSError, ValueError) as error:
            words = str(error)
            self._each(lambda page: page.say(words))

    async def wish(self, name: str, target: float, path: str) -> None:
        """Change one key so that a result becomes what is wished."""
        key = next((each for each in self.state.numbers if each.name == path), None)
        command = next(
            (c for c, found in self.state.results.items() if any(r.quantity.name == name for r in found)), ""
        )
        if key is None or not command:
            self._each(lambda page: page.say(f"choose the key that may change for {name}"))
            return
        text = self.document.text
        self._each(lambda page: page.say(f"{name} {target:g}: searching for {key.name}"))
        try:
            found = await asyncio.to_thread(making.wished, text, str(self.document.path), command, name, target, key)
        except (Refused, CannotPlace) as refused:
            words = str(refused)
            self._each(lambda page: page.say(words))
            return
        if self.document.text == text:
            self.put(found.text)
        words = f"{name} {found.result:.6g} with {key.name} {found.value:.12g}"
        self._each(lambda page: page.say(words))

    def may_change(self, key: Number) -> bool:
        """Whether a joint that is dragged may change a key: what makes the shape, unless it is locked."""
        return not self.locks.get(key.name, not key.is_geometry)

    async def grip(self, which: Sequence[Any], fraction: float) -> None:
        """A joint is taken."""
        keys = [key for key in self.state.numbers if self.may_change(key)]
        self._grip = None
        try:
            taken = (str(which[0]), int(which[1]), int(which[2]))
            given = self.document.text, str(self.document.path), taken, float(fraction), keys, self._show
            self._grip = await asyncio.to_thread(self._taken, *given)
        except (Refused, LookupError, ValueError) as refused:
            words = str(refused)
            self._each(lambda page: page.say(words))
        self._each(lambda page: page.answered())

    def _taken(self, *given: Any) -> tuple[Grip, Stage]:
        """A joint, and the picture in which it is held: that keeps its scale until the joint is let go.

        Raises
            Refused
        """
        import numpy as np

        from gearlink.cli.views.films.page import player_stage

        if self.state.study is None:
            raise Refused("there is no mechanism yet")
        scene = self.state.study.scene(np.array([0.0]), self._show)
        return Grip(*given), player_stage(scene, "", reach=self.state.reach)

    @property
    def _look(self) -> making.Look:
        """How the animation is to be shown now."""
        return making.Look(self.state.reach, None if self._grip is None else self._grip[0].fraction, self._show)

    async def drag(self, place: Sequence[float]) -> None:
        """The joint that is held is drawn to a place of the picture [pixels]."""
        if self._grip is not None:
            grip, stage = self._grip
            text = await asyncio.to_thread(grip.to, stage.place(complex(*map(float, place[:2]))))
            if self._grip is not None and self._grip[0] is grip:
                self.put(text, "drag")
                words = f"the joint cannot move farther: {grip.stopped}" if grip.stopped else ""
                self._each(lambda page: page.say(words))
                await self._made_once()
        self._each(lambda page: page.answered())

    def drop(self) -> None:
        """The joint is let go."""
        self._grip = None
        self.document.rest()
        self._fresh()

    # What is computed

    def _fresh(self) -> None:
        self._version += 1
        self._news.set()

    def _each(self, show: Callable[[Page], None]) -> None:
        for page in list(self.pages):
            show(page)

    async def run(self) -> None:
        """Compute the newest text until the end: its quick numbers here, what follows them in the processes beside."""
        follow = asyncio.create_task(self._follow())
        self._fresh()
        try:
            while True:
                await self._news.wait()
                self._news.clear()
                version, text = self._version, self.document.text
                if await self._guarded(self.make(version)):
                    self._followed.set()
                self._shown = version
                self._each(lambda page, text=text: page.text(text))  # type: ignore[misc]
                self._each(lambda page: page.actions(self.document.can))
        finally:
            follow.cancel()

    async def _follow(self) -> None:
        """What is drawn and judged of the newest design whose numbers are shown; all of it when the hand rests."""
        resting: asyncio.Task[Any] | None = None
        while True:
            await self._followed.wait()
            self._followed.clear()
            if resting is not None:
                resting.cancel()
            study, version = self.state.study, self._version
            if study is not None and await self._guarded(self._moving(study, version)):
                resting = asyncio.create_task(self._guarded(self._at_rest(study, version)))

    async def _guarded(self, work: Coroutine[Any, Any, bool]) -> bool:
        """What is refused, and a fault as well, is shown; the next change is another try."""
        try:
            return await work
        except (DesignFileError, NoSolution) as error:
            wrong = error.diagnostics if isinstance(error, DesignFileError) else []
            self._refuse(wrong, str(error) if wrong else f"{getattr(error, 'code', '')}: {error}")
        except Exception as fault:
            self._refuse([], f"fault of the program: {type(fault).__name__}: {fault}")
        return False

    async def _made_once(self) -> None:
        """Wait until the numbers of the newest text have been shown, or are known not to be."""
        version = self._version
        while self._shown < version:
            await asyncio.sleep(0.002)

    async def make(self, version: int | None = None) -> bool:
        """The numbers of the text, and its quick results; those of further commands unless the text has changed.

        Parameters
            version : of the text; None is the present one
        """
        version = self._version if version is None else version
        text = self.document.text
        self._read(text)
        study = await asyncio.to_thread(Study, text, str(self.document.path))
        state = self.state
        for other in [command for command in state.results if command not in study.commands]:
            del state.results[other]
            state.checks.pop(other, None)
        for command in study.commands:
            if self._slow(command):
                continue
            begun = time.perf_counter()
            state.results[command] = await asyncio.to_thread(study.results, command, self._names(command))
            self._cost[command] = time.perf_counter() - begun
            self._each(lambda page: page.results(self._all_results(), self._before()))
            if self._version != version and state.study is not None:
                break
        state.study = study
        if self._first.study is None:
            self._first = State(study, results=dict(state.results))
        self._accept()
        return True

    def _slow(self, command: str) -> bool:
        """Whether the results of a command would hold up those of the first."""
        return self._cost.get(command, 0.0) > _QUICK and command != next(iter(self._cost))

    def _names(self, command: str) -> list[str]:
        return [result.quantity.name for result in self.state.results.get(command, ())]

    def _read(self, text: str) -> None:
        """The numbers of a text, of one too that makes no design."""
        loaded = parse(text.encode(), str(self.document.path))
        kind = read_kind(loaded, tuple(KINDS))
        if kind != self._kind:
            self._kind, self._known, self._cost = kind, {}, {}
        self.state.numbers = numbers(loaded, KINDS[kind].spec_model(), self._known)
        self._each(lambda page: page.numbers(self.state.numbers))

    async def _moving(self, study: Study, version: int) -> bool:
        """Animation and findings, and at the same time what takes longer; whether the text is still the newest."""
        slow = [command for command in study.commands if self._slow(command)]
        quick = [command for command in study.commands if command not in slow]
        given = study.text, study.file
        names = {command: self._names(command) for command in slow}
        later = self._beside.submit(making.slow, *given, names) if slow else None
        checks, film = await self._beside_page(making.moving, *given, quick, _AT_ONCE, self._look)
        self.state.checks |= checks
        self._each(lambda page: page.checks(self._all_checks()))
        await self._show_film(film)
        if later is not None:
            results, checks, seconds = await asyncio.wrap_future(later)
            self._cost |= {command: min(self._cost[command], each) for command, each in seconds.items()}
            self.state.results |= results
            self.state.checks |= checks
            self._each(lambda page: page.results(self._all_results(), self._before()))
            self._each(lambda page: page.checks(self._all_checks()))
        return self._version == version

    async def _show_film(self, film: tuple[dict[str, Any], Reach] | None) -> None:
        """The animation, before that of the design as it was opened, drawn to the same scale."""
        if film is None:
            if self.state.study is not None and not self.state.study.moves:
                self._each(lambda page: page.film(None, None))
            return
        self.state.film, self.state.reach = film
        first, look = self._first.study, making.Look(self.state.reach, show=self._show, bare=True)
        changed = first is not None and self.document.text != first.text
        if changed and first is not None and look != self._ghost_look:
            found = await self._beside_page(making.film, first.text, first.file, _AT_ONCE, look)
            self._ghost, self._ghost_look = found[0] if found else None, look
        ghost = self._ghost if changed else None
        self._each(lambda page: page.film(self.state.film, ghost))
        refused = str(self.state.film["refused"])
        if refused:
            self._each(lambda page: page.say(refused))

    async def _at_rest(self, study: Study, version: int) -> bool:
        """All of it, when the hand rests."""
        await asyncio.sleep(_REST)
        if self._version != version:
            return False
        self.document.rest()
        state, given = self.state, (study.text, study.file)
        results, checks, film = await self._beside_page(making.whole, *given, self._look)
        if self._version != version:
            return False
        state.results, state.checks = results, checks
        self._each(lambda page: page.results(self._all_results(), self._before()))
        self._each(lambda page: page.checks(self._all_checks()))
        await self._show_film(film)
        first = self._first.study or study
        state.changed = await self._beside_page(making.changes, first.text, *given)
        self._each(lambda page: page.changed(state.changed))
        self._each(lambda page: page.sheets(study.commands))
        for command in study.commands:
            if self._version != version:
                return False
            state.sheets[command] = html = await self._beside_page(making.sheet, *given, command)
            self._each(lambda page, command=command, html=html: page.sheet(command, html))  # type: ignore[misc]
        return True

    async def _beside_page(self, make: Callable[..., Any], *given: Any) -> Any:
        """What another process makes."""
        return await asyncio.wrap_future(self._beside.submit(make, *given))

    def _refuse(self, wrong: list[Diagnostic], words: str) -> None:
        self._wrong = (wrong, f"<pre>{escape(visible_lines(words))}</pre>")
        self._each(lambda page: page.problem(*self._wrong))

    def _accept(self) -> None:
        self._wrong = ([], "")
        self._each(lambda page: page.problem([], ""))

    def _all_results(self) -> list[KeyResult]:
        found = {result.quantity.name: result for each in self.state.results.values() for result in each}
        return list(found.values())

    def _before(self) -> dict[str, KeyResult]:
        return {result.quantity.name: result for each in self._first.results.values() for result in each}

    def _all_checks(self) -> list[Check]:
        """Each once, though several commands may show it; what fails first."""
        found = {(c.code, c.name, c.message): c for each in self.state.checks.values() for c in each}
        return sorted(found.values(), key=lambda check: ("fail", "warn", "pass").index(check.status))


def visible_lines(words: str) -> str:
    """Words of several lines as a page may show them."""
    return "\n".join(map(visible, words.split("\n")))
