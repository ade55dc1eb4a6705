"""The page of the studio: editor, sliders, results, findings and sheets of NiceGUI; the drawing is our own."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import contextmanager
from html import escape
from importlib import resources
from typing import TYPE_CHECKING, Any

from nicegui import ui
from nicegui.elements.mixins.value_element import ValueElement

from gearlink.cli.render.numbers import drawn
from gearlink.cli.views.films.page import part
from gearlink.cli.views.page.sheets import as_script

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gearlink.cli.reading.diagnostics import Diagnostic
    from gearlink.cli.studio.numbers import Number
    from gearlink.cli.studio.session import Session
    from gearlink.core.base.key_results import KeyResult
    from gearlink.core.base.report import Check

_OFTEN = 0.016
"""Between two values of a slider that is moved [s]: NiceGUI's own sends one in 0.05 s."""
_ACTIONS = {"undo": "Undo", "redo": "Redo", "save": "Save", "revert": "Revert"}


def _file(package: str, name: str) -> str:
    return (resources.files(package) / name).read_text(encoding="utf-8")


class _Slider(ValueElement[float]):
    """A slider that says where it is as often as pictures are shown."""

    def __init__(self, low: float, high: float, step: float, value: float, on_change: Callable[[Any], None]) -> None:
        super().__init__(tag="q-slider", value=value, on_value_change=on_change, throttle=_OFTEN)
        self.props["min"], self.props["max"], self.props["step"] = low, high, step


class _Row:
    """A number of the file: its name, a field, a lock, a slider."""

    def __init__(self, number: Number, page: StudioPage) -> None:
        self._page, self.number = page, number
        with ui.element("div").classes("number"):
            name = number.name.removeprefix(f"{number.section}.") if number.section else number.name
            ui.label(name).classes("name").tooltip(number.words or number.name)
            self._field = ui.number(value=number.value, step=number.step, on_change=self._typed).props("dense borderless")
            self._field.props["data-path"] = number.name
            ui.label("" if number.unit == "1" else number.unit).classes("unit")
            locked = not page.session.may_change(number)
            lock = ui.checkbox(value=locked, on_change=self._lock).props("dense size=xs").tooltip("a dragged joint leaves it")
            lock.props["data-lock"] = number.name
            low, high = number.range
            self._slider = _Slider(low, high, number.step, number.value, self._moved)
            self._slider.props["data-slider"] = number.name

    def take(self, number: Number) -> None:
        """The number as the text now has it."""
        same, self.number = number.value == self.number.value, number
        if same and self._field.value == number.value and self._slider.value == number.value:
            return
        if self._field.value != number.value:
            self._field.value = number.value
        low, high = self._slider.props["min"], self._slider.props["max"]
        if not low <= number.value <= high:
            self._slider.props["min"], self._slider.props["max"] = number.range
        if self._slider.value != number.value:
            self._slider.value = number.value

    def _typed(self, event: Any) -> None:
        if not self._page.quiet and event.value is not None:
            value = int(event.value) if float(event.value).is_integer() else float(event.value)
            self._page.session.move(self.number.path, value)

    def _moved(self, event: Any) -> None:
        if not self._page.quiet and event.value is not None:
            self._page.session.move(self.number.path, self.number.on_grid(float(event.value)))

    def _lock(self, event: Any) -> None:
        self._page.session.locks[self.number.name] = bool(event.value)


class StudioPage:
    """The page in one browser."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.quiet = True
        self._rows: dict[str, _Row] = {}
        self._shown_results: dict[str, tuple[Any, ...]] = {}
        self._shown_checks: list[tuple[Any, ...]] = []
        self._check_words: list[Any] = []
        self._sheets: dict[str, Any] = {}
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
            self._editor = ui.codemirror("", language="YAML", on_change=self._typed).classes("editor")
            self._numbers = ui.column().classes("scrolls")
            with ui.column().classes("scrolls") as self._right:
                self._film = ui.element("div").classes("film w-full")
                self._key = ui.select([], label="a wish may change").props("dense options-dense").style("min-width: 16em")
                self._key.props["data-key"] = "wish"
                self._results = ui.column().classes("w-full gap-0")
                self._checks = ui.column().classes("w-full gap-0")
                ui.label("Changed since it was opened").classes("section")
                self._changed = ui.html("nothing", sanitize=False).props("data-changed").classes("w-full")
                self._drawings = ui.column().classes("w-full")
        ui.on("grip", lambda event: self.session.grip(event.args["which"], event.args["fraction"]))
        ui.on("drag", lambda event: self.session.drag(event.args["place"]))
        ui.on("drop", lambda: self.session.drop())

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
                for number in found:
                    self._rows[number.name].take(number)
                return
            self._numbers.clear()
            self._rows = {}
            section = None
            with self._numbers:
                for number in found:
                    if number.section != section:
                        section = number.section
                        ui.label(section or "design").classes("section")
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
        with self._silently():
            if [result.quantity.name for result in found] != list(self._shown_results):
                self._results.clear()
                self._shown_results = {}
                with self._results:
                    for result in found:
                        self._shown_results[result.quantity.name] = self._result(result)
            for result in found:
                quantity = result.quantity
                value, was = self._shown_results[quantity.name]
                value.text = _with_unit(quantity.value, quantity.unit)
                old = before.get(quantity.name)
                same = old is None or _with_unit(old.quantity.value, quantity.unit) == value.text
                was.text = "" if same or old is None else f"was {_with_unit(old.quantity.value, quantity.unit)}"

    def _result(self, result: KeyResult) -> tuple[Any, Any]:
        name = result.quantity.name
        with ui.element("div").classes("result"):
            asked = f"{result.title} ({result.how} {result.asked:g})" if result.asked is not None else result.title
            ui.label(asked).tooltip(f"{name}: {result.quantity.words}")
            value = ui.label().classes("value")
            value.props["data-quantity"] = name
            was = ui.label().classes("was")
            wish = ui.input(placeholder="wish").props("dense borderless")
            wish.props["data-wish"] = name
            wish.on("keydown.enter", lambda: self._wish(name, wish.value))
        return value, was

    async def _wish(self, name: str, words: str) -> None:
        """`75` or `dwell 75` beside a result."""
        number = (words or "").replace("=", " ").split()[-1:]
        try:
            target = float(number[0])
        except (ValueError, IndexError):
            self.say(f"a wish is a number, such as {name} 75")
            return
        await self.session.wish(name, target, str(self._key.value or ""))

    def checks(self, found: Sequence[Check]) -> None:
        """The findings; those that pass in a fold."""
        shown = [(c.code, c.name, c.status, _fix(c)) for c in found]
        with self._silently():
            if shown != self._shown_checks:
                self._checks.clear()
                self._shown_checks, self._check_words = shown, []
                passing = sum(check.status == "pass" for check in found)
                with self._checks:
                    ui.label(f"Checks: {len(found) - passing} of {len(found)} do not pass").classes("section")
                    for check in found[: len(found) - passing]:
                        self._check(check)
                    with ui.expansion(f"{passing} pass").props("dense").classes("w-full"):
                        for check in found[len(found) - passing :]:
                            self._check(check)
            for words, check in zip(self._check_words, found, strict=True):
                words.text = f"{check.code} {check.name}: {check.message}"

    def _check(self, check: Check) -> None:
        row = ui.element("div").classes("check")
        row.props["data-check"], row.props["data-status"] = check.code, check.status
        with row:
            self._check_words.append(ui.label().classes("said"))
            if words := _fix(check):
                button = ui.button(words, on_click=lambda: self.session.apply(check.remedy)).props("dense no-caps flat")
                button.props["data-fix"] = check.code

    def film(self, data: dict[str, Any] | None, ghost: dict[str, Any] | None) -> None:
        """The mechanism in motion, and pale behind it as it was opened."""
        self._run(f"studio.film('{self._film.html_id}', {as_script(data)}, {as_script(ghost)})")

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
            self._editor.line_tooltips = {each.line: each.as_sentence for each in own}

    def say(self, words: str) -> None:
        """A word about what was just asked for."""
        with self._silently():
            self._note.text = words

    def answered(self) -> None:
        """The joint has come where it can."""
        self._run("studio.answered()")

    def _run(self, script: str) -> None:
        self._client.run_javascript(script)


def _with_unit(value: Any, unit: str) -> str:
    return drawn(value, unit) + (f" {unit}" if unit not in ("", "1") else "")


def _fix(check: Check) -> str:
    """What a button says that applies the remedy of a finding."""
    from gearlink.core.base.report import remedy_words

    return remedy_words(check.remedy) if check.remedy else ""
