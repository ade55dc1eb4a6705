"""The page of the studio: editor, sliders, results, findings and sheets of NiceGUI; the drawing is our own."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from contextlib import contextmanager
from html import escape
from importlib import resources
from typing import TYPE_CHECKING, Any

from nicegui import ui

from gearlink.cli.render.numbers import drawn
from gearlink.cli.views.films.page import as_script, part

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gearlink.cli.reading.diagnostics import Diagnostic
    from gearlink.cli.studio.numbers import Number
    from gearlink.cli.studio.session import Session
    from gearlink.core.base.key_results import KeyResult
    from gearlink.core.base.report import Check

_OFTEN = 0.016
"""Between two values of a slider that is moved [s]."""
_VALUE, _CHECKED = "event => emit(event.target.value)", "event => emit(event.target.checked)"
_ACTIONS = {"undo": "Undo", "redo": "Redo", "save": "Save", "revert": "Revert"}


def _file(package: str, name: str) -> str:
    return (resources.files(package) / name).read_text(encoding="utf-8")


def _plain(tag: str, said: str = "", /, *, words: str = "", **looks: Any) -> ui.element:
    """An element of HTML itself, which takes the browser next to nothing: a page has hundreds.

    Parameters
        said, words : class, text
    """
    made = ui.element(tag).classes(said)
    made.props.update({name.replace("_", "-"): value for name, value in looks.items()})
    if words:
        with made:
            ui.html(escape(words), sanitize=False, tag="span")
    return made


class _Row:
    """A number of the file: its name, a field, its unit, a lock, a slider.

    What stands in field and slider is set by `studio.numbers`, never by NiceGUI, which would draw again what the hand
    has left behind already.
    """

    def __init__(self, number: Number, page: StudioPage) -> None:
        self._page, self.number = page, number
        low, high = self.range = number.range
        step = number.step if len(number.choices) != 2 else high - low
        with _plain("div", "number"):
            name = number.name.removeprefix(f"{number.section}.") if number.section else number.name
            with _plain("span", "name", title=number.words or number.name):
                ui.html(re.sub(r"([._])", r"\1<wbr>", escape(name)), sanitize=False, tag="span")
            shared: dict[str, Any] = {"step": "any", "aria_label": number.name}
            field = _plain("input", type="number", data_path=number.name, **shared)
            _plain("span", "unit", words="" if number.unit == "1" else number.unit)
            lock = _plain("input", type="checkbox", data_lock=number.name, title="locked: a dragged joint leaves it")
            lock.props["checked"] = not page.session.may_change(number)
            shared = {"min": low, "max": high, "step": step, "aria_label": f"{number.name}, slider"}
            self._slider = _plain("input", type="range", data_slider=number.name, **shared)
        field.on("input", self._typed, js_handler=_VALUE, throttle=_OFTEN)
        lock.on("change", self._lock, js_handler=_CHECKED)
        self._slider.on("input", self._moved, js_handler=_VALUE, throttle=_OFTEN)

    def take(self, number: Number) -> list[Any] | None:
        """The number as the text now has it: what its field and slider show; None where that is as it was."""
        if number.value == self.number.value and number.path == self.number.path:
            return None
        self.number = number
        if not self.range[0] <= number.value <= self.range[1]:
            self.range = number.range
            self._slider.props.update({"min": self.range[0], "max": self.range[1]})
        return [number.name, *self.range, f"{number.value:.15g}"]

    def _typed(self, event: Any) -> None:
        value = _read(str(event.args))
        if value is not None:
            self._page.session.move(self.number.path, value)

    def _moved(self, event: Any) -> None:
        value = _read(str(event.args))
        if value is not None:
            self._page.session.move(self.number.path, self.number.on_grid(value))

    def _lock(self, event: Any) -> None:
        self._page.session.locks[self.number.name] = bool(event.args)


def _read(text: str) -> float | None:
    """A number as it is typed, whole where it is."""
    try:
        value = float(text)
    except ValueError:
        return None
    if not math.isfinite(value):
        return None
    return int(value) if value.is_integer() and abs(value) < 1e15 else value


class StudioPage:
    """The page in one browser."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.quiet = True
        self._rows: dict[str, _Row] = {}
        self._shown_results: list[str] = []
        self._shown_checks: list[tuple[str, ...]] = []
        self._sheets: dict[str, Any] = {}
        self._ghost: dict[str, Any] | None = None
        self._build()
        self.quiet = False
        self._client = ui.context.client
        self._client.on_connect(lambda: self._once())
        self._client.on_delete(lambda: session.pages.remove(self) if self in session.pages else None)
        self._joined = False

    def _once(self) -> None:
        """Begin when the browser listens: what is drawn before that would be lost."""
        if not self._joined:
            self._joined = True
            self.session.join(self)

    @contextmanager
    def _silently(self) -> Iterator[None]:
        """What is set here is no wish of the hand."""
        before, self.quiet = self.quiet, True
        try:
            with self._client:
                yield
        finally:
            self.quiet = before

    def _build(self) -> None:
        own = "gearlink.cli.studio"
        ui.add_css(part("player.css") + _file(own, "studio.css"))
        script = "\n".join([part("player.js"), _file("gearlink.cli.views.page", "page.js"), _file(own, "studio.js")])
        ui.add_body_html(f"<script>{script}</script>")
        with ui.element("div").classes("bar w-full"):
            ui.html(f"<h1>{escape(self.session.document.path.name)}</h1>", sanitize=False)
            self._buttons = {name: self._button(name, words) for name, words in _ACTIONS.items()}
            self._note = ui.label().classes("note grow").props("role=status id=note")
        self._problem = ui.html("", sanitize=False).props("id=problem role=alert")
        with ui.element("div").classes("desk"):
            self._editor = ui.codemirror("", language="YAML", line_wrapping=True, on_change=self._typed).classes(
                "editor"
            )
            self._numbers = ui.column().classes("scrolls")
            with ui.column().classes("scrolls") as self._right:
                self._film = ui.element("div").classes("film").classes("w-full")
                _plain("div", "shown", id="shown", role="group", aria_label="shown on the mechanism")
                self._key = (
                    ui.select([], label="key that a target may change")
                    .props("dense options-dense")
                    .style("min-width: 16em")
                )
                self._key.props["data-key"] = "wish"
                self._results = ui.column().classes("w-full gap-0")
                self._checks = ui.column().classes("w-full gap-0")
                ui.label("Changed since the file was opened").classes("section")
                self._changed = ui.html("nothing", sanitize=False).props("data-changed").classes("w-full")
                self._drawings = ui.column().classes("w-full")
        ui.on("grip", lambda event: self.session.grip(event.args["which"], event.args["fraction"]))
        ui.on("drag", lambda event: self.session.drag(event.args["place"]))
        ui.on("drop", lambda: self.session.drop())
        ui.on("show", lambda event: self.session.show(str(event.args["show"])))

    def _button(self, action: str, words: str) -> Any:
        button = ui.button(words, on_click=lambda: self.session.act(action)).props("dense no-caps outline")
        button.props["data-action"] = action
        return button

    def _typed(self, event: Any) -> None:
        if not self.quiet:
            self.session.put(event.value or "", "text")

    # What the session shows

    def text(self, text: str) -> None:
        """The text of the file."""
        if self._editor.value != text:
            with self._silently():
                self._editor.value = text

    def numbers(self, found: Sequence[Number]) -> None:
        """Every number of the file; made anew where there are others than before."""
        with self._silently():
            if [number.name for number in found] == list(self._rows):
                shown = [row for number in found if (row := self._rows[number.name].take(number)) is not None]
            else:
                self._make_rows(found)
                shown = [[number.name, *number.range, f"{number.value:.15g}"] for number in found]
        if shown:
            self._run(f"studio.numbers({as_script(shown)})")

    def _make_rows(self, found: Sequence[Number]) -> None:
        self._numbers.clear()
        self._rows = {}
        section = None
        with self._numbers:
            for number in found:
                if number.section != section:
                    section = number.section
                    with _plain("div", "section", words=section or "design"):
                        _plain("span", "lock", words="lock")
                self._rows[number.name] = _Row(number, self)
        names = [number.name for number in found]
        kept = self._key.value if self._key.value in names else next((n.name for n in found if n.is_geometry), None)
        self._key.set_options(names, value=kept)

    def actions(self, can: dict[str, bool]) -> None:
        """Which buttons would do something."""
        with self._silently():
            for name, button in self._buttons.items():
                if button.enabled != can[name]:
                    button.set_enabled(can[name])

    def results(self, found: Sequence[KeyResult], before: dict[str, KeyResult]) -> None:
        """The key results with their change."""
        names = [result.quantity.name for result in found]
        shown = {}
        for result in found:
            name, unit = result.quantity.name, result.quantity.unit
            now, old = _with_unit(result.quantity.value, unit), before.get(name)
            was = "" if old is None else _with_unit(old.quantity.value, unit)
            title = f"{result.title} ({result.how} {result.asked:g})" if result.asked is not None else result.title
            shown[name] = [now, f"was {was}" if was not in ("", now) else "", title]
        if names != self._shown_results:
            self._shown_results = names
            with self._silently():
                self._results.clear()
                with self._results:
                    for result in found:
                        self._result(result)
        self._run(f"studio.results({as_script(shown)})")

    def _result(self, result: KeyResult) -> None:
        name = result.quantity.name
        with _plain("div", "result"):
            _plain("span", data_title=name, title=f"{name}: {result.quantity.words}")
            _plain("span", "value", data_quantity=name)
            _plain("span", "was", data_was=name)
            if isinstance(result.quantity.value, bool) or not isinstance(result.quantity.value, (int, float)):
                return
            wish = _plain("input", type="text", placeholder="target", data_wish=name, aria_label=f"target for {name}")
        wish.on("keydown.enter", lambda event: self._wish(name, event), js_handler=_VALUE)

    async def _wish(self, name: str, event: Any) -> None:
        """`75` or `dwell 75` beside a result."""
        words = str(event.args)
        number = words.replace("=", " ").split()[-1:]
        try:
            target = float(number[0])
        except (ValueError, IndexError):
            self.say(f"a target is a number, such as {name} 75")
            return
        await self.session.wish(name, target, str(self._key.value or ""))

    def checks(self, found: Sequence[Check]) -> None:
        """The findings; those that pass in a fold."""
        shown = [(c.code, c.name, c.status, *c.lines) for c in found]
        if shown == self._shown_checks:
            return
        self._shown_checks = shown
        passing = [check for check in found if check.status == "pass"]
        with self._silently():
            self._checks.clear()
            with self._checks:
                _plain("div", "section", words=f"Checks: {len(found) - len(passing)} of {len(found)} do not pass")
                for check in found[: len(found) - len(passing)]:
                    self._check(check)
                with _plain("details"):
                    _plain("summary", words=f"{len(passing)} pass")
                    for check in passing:
                        self._check(check)

    def _check(self, check: Check) -> None:
        with _plain("div", "check", data_check=check.code, data_status=check.status):
            _plain("span", "said", words=f"{check.code} {check.name}: {check.message}")
            if check.remedy:
                button = _plain("button", type="button", data_fix=check.code, words=check.fix or "")
                button.on("click", lambda: self.session.apply(check.remedy))
            elif check.fix:
                _plain("span", "more", words=f"fix: {check.fix}")
            for note in check.note:
                _plain("span", "more", words=f"note: {note}")

    def film(self, data: dict[str, Any] | None, ghost: dict[str, Any] | None) -> None:
        """The mechanism in motion, and pale behind it as it was opened."""
        same, self._ghost = ghost is self._ghost, ghost
        behind = "undefined" if same else as_script(ghost)
        self._run(f"studio.animation('{self._film.html_id}', {as_script(data)}, {behind})")

    def sheets(self, commands: Sequence[str]) -> None:
        """A place for each sheet."""
        if list(self._sheets) == list(commands):
            return
        with self._silently():
            self._drawings.clear()
            with self._drawings:
                self._sheets = {command: ui.element("div").classes("w-full") for command in commands}

    def sheet(self, command: str, html: str) -> None:
        """The sheet of a command."""
        if command in self._sheets:
            whole = f'<div class="section">{escape(command)}</div>{html}' if html else ""
            self._run(f"studio.sheet('{self._sheets[command].html_id}', {as_script(whole)})")

    def changed(self, html: str) -> None:
        """What is not as it was opened."""
        with self._silently():
            self._changed.content = html or "nothing"

    def problem(self, wrong: Sequence[Diagnostic], html: str) -> None:
        """What is wrong: on top, and at its line in the editor; the last good design is pale meanwhile."""
        if html == self._problem.content:
            return
        with self._silently():
            self._problem.content = html
            self._right.classes(add="old") if html else self._right.classes(remove="old")
            own = [each for each in wrong if each.file == str(self.session.document.path)]
            self._editor.decorations = [
                {"kind": "line", "line": line, "class": "wrong"} for line in sorted({each.line for each in own})
            ]
            self._editor.line_tooltips = {each.line: "\n".join(each.lines) for each in own}

    def say(self, words: str) -> None:
        """A word about what was just asked for."""
        if words == self._note.text:
            return
        with self._silently():
            self._note.text = words

    def answered(self) -> None:
        """The joint has come where it can."""
        self._run("studio.answered()")

    def _run(self, script: str) -> None:
        self._client.run_javascript(script)


def _with_unit(value: Any, unit: str) -> str:
    return drawn(value, unit) + (f" {unit}" if unit not in ("", "1") else "")
