"""Blocks of a page that the program fills, and what else turns a page of the repository into one of the manual.

```console      commands without output get it from a run; with output they are left, and tests compare them
```figure       the picture that a command draws, with the command and a caption (`caption: ...`)
```session      commands of one page that follow each other in one folder
```picture      a file that the page's session left: `name.png: caption`
```drawing      a mechanism with its points, sizes, angles and frame (drawings.py)
```keys         keys of a kind, or those of the sections that are named after it
```checks       checks of a kind
```design       a file of designs/
```math         equations in TeX, one a line; `$...$` within text
"""

from __future__ import annotations

import math
import re
import shlex
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from docs.manual import runs, tables, typeset
from docs.manual.drawings import Drawing
from docs.manual.runs import ROOT

_FENCE = re.compile(
    r"^(?P<tick>`{3,})(?P<language>[\w-]*)[^\n]*\n(?P<body>.*?)^(?P=tick)[ ]*$\n?", re.DOTALL | re.MULTILINE
)
_LINK = re.compile(r"(!?\[[^\]]*\])\(([^)\s]+)\)")
_SOURCE = re.compile(r'(src|href)="([^"]+)"')
_CODE = re.compile(r"`(GL[1-6]\d\d)`|`[^`]*`|(?<![\w/#.])(GL[1-6]\d\d)(?![\w.]|-\d)")
"""A code of a check, or code in which none is looked for."""


@dataclass(slots=True)
class Page:
    """A page on its way from the repository to the manual.

    Fields
        source : Path - its file, or that in whose place it is written
        target : str - its file in the manual, "kinds/gear-pair.md"
        text : str
        stale : bool - results of another state of the program may be shown
        pictures : the pictures that it shows, by their name in `runs.KEPT`
    """

    source: Path
    target: str
    text: str
    stale: bool = False
    pictures: set[str] = field(default_factory=set)

    @property
    def up(self) -> str:
        """The way to the root of the manual."""
        return "../" * self.target.count("/")

    def image(self, name: str, caption: str) -> str:
        """A picture of `runs.KEPT`."""
        self.pictures.add(name)
        return f"![{caption}]({self.up}pictures/{name}){{ loading=lazy }}\n"


def commands(text: str) -> Iterator[tuple[str, bool]]:
    """The commands that the blocks of a page run, each with whether its picture is wanted."""
    for found in _FENCE.finditer(text):
        if found["language"] == "figure":
            yield _asked(found["body"])[0], True
        elif found["language"] == "console":
            for command, output in parts(found["body"]):
                if not output and command.startswith("gearlink "):
                    yield command, False


def parts(body: str) -> list[tuple[str, list[str]]]:
    """Commands of a console block with the lines printed below each.

    Example
        >>> parts("$ gearlink new\\nfirst\\nsecond\\n$ gearlink schema\\n")
        [('gearlink new', ['first', 'second']), ('gearlink schema', [])]
    """
    found: list[tuple[str, list[str]]] = []
    for line in body.rstrip("\n").split("\n"):
        if line.startswith("$ "):
            found.append((line[2:], []))
        elif found:
            found[-1][1].append(line)
    return found


def expanded(page: Page, map_link: Callable[[Page, str], str]) -> str:
    """The text of a page with its blocks filled, equations typeset, links led to pages of the manual."""
    made, at = [], 0
    steps = _told(page)
    for found in _FENCE.finditer(page.text):
        made += [_prose(page, page.text[at : found.start()], map_link), _filled(page, found, steps)]
        at = found.end()
    return "".join([*made, _prose(page, page.text[at:], map_link)])


def told(text: str) -> Iterator[tuple[str, list[str]]]:
    """The commands of a page whose output it holds, with that output."""
    for found in _FENCE.finditer(text):
        if found["language"] == "console":
            yield from ((command, lines) for command, lines in parts(found["body"]) if lines)


def refreshed(text: str) -> str:
    """A page of the repository whose console blocks say what the program prints now; blocks without output, and what
    differs in the last digits or in times alone, stay."""

    def block(found: re.Match[str]) -> str:
        if found["language"] != "console" or not all(c.startswith("gearlink ") for c, _ in parts(found["body"])):
            return found[0]
        lines = []
        for command, output in parts(found["body"]):
            now = runs.run(command).text.split("\n") if output else []
            lines += [f"$ {command}", *(output if unchanged(now, output) else now)]
        return f"{found['tick']}console\n" + "\n".join(lines) + f"\n{found['tick']}\n"

    return _FENCE.sub(block, text)


_NUMBER = re.compile(r"-?\d+\.?\d*(?:e[-+]?\d+)?$")
_TIMED = re.compile(r"(pass|warn|fail|error) +(\d+|unchanged)$")


def unchanged(now: list[str], told: list[str]) -> bool:
    """Whether lines that a command prints are those of a page, but for last digits and times."""
    a, b = ([_TIMED.sub(r"\1", line) for line in lines] for lines in (now, told))
    return len(a) == len(b) and all(map(same, a, b))


def same(got: str, want: str) -> bool:
    """Whether two lines are equal but for the last digits of numbers.

    A printed value may differ at 1e-9 of it between machines' libraries; those that are printed whole, with 15 digits
    and more, by 8 ulp: the pages show quantities so only where an ulp of an input moves them by no more than an ulp or
    two, and a library's functions are off by one or two themselves.

    Example
        >>> same("18.058100927176056 mm", "18.058100927176052 mm"), same("18.1 mm", "18.2 mm")
        (True, False)
    """
    a, b = got.split(), want.split()
    if set(got) == set(want) == {"─"}:
        return True  # a rule under a column of times
    if len(a) != len(b):
        return False
    for x, y in zip(a, b, strict=True):
        if x != y and not (_NUMBER.match(x) and _NUMBER.match(y) and abs(float(x) - float(y)) <= _tolerance(y)):
            return False
    return True


def _tolerance(printed: str) -> float:
    digits = re.sub(r"e.*|\D", "", printed).lstrip("0")
    return 8.0 * math.ulp(float(printed)) if len(digits) >= 15 else 1e-9 * abs(float(printed))


def _filled(page: Page, found: re.Match[str], told: dict[str, str]) -> str:
    language, body = found["language"], found["body"]
    made = {"figure": _figure, "drawing": _drawing, "picture": _picture}.get(language)
    if made is not None:
        return made(page, body) + "\n"
    if language == "console":
        return _console(body)
    if language == "session":
        return "```console\n" + "\n".join(told[command] for command, _ in parts(body)) + "\n```\n"
    if language == "math":
        return typeset.display(body) + "\n\n"
    if language == "keys":
        kind, *sections = body.split()
        return tables.keys(kind, sections) + "\n"
    if language == "checks":
        return tables.checks(body.strip(), page.up) + "\n"
    if language == "design":
        return f'```yaml title="{body.strip()}"\n{(ROOT / body.strip()).read_text(encoding="utf-8").rstrip()}\n```\n'
    return found[0]


def _console(body: str) -> str:
    lines = []
    for command, output in parts(body):
        if not output and command.startswith("gearlink "):
            output = runs.result(command).text.split("\n")
        lines += [f"$ {command}", *output]
    return "```console\n" + "\n".join(lines or [body.rstrip()]) + "\n```\n"


def _asked(body: str) -> tuple[str, str]:
    """Command and caption of a figure."""
    lines = body.strip().split("\n")
    caption = next((line.partition(":")[2].strip() for line in lines if line.startswith("caption:")), "")
    return next(line[2:] for line in lines if line.startswith("$ ")), caption


def _figure(page: Page, body: str) -> str:
    command, caption = _asked(body)
    ended = runs.result(command, picture=True)
    name = caption or shlex.split(command)[2]
    return f"{page.image(ended.picture, name)}\n*{caption + ': ' if caption else ''}`{command}`*\n"


def _drawing(page: Page, body: str) -> str:
    drawing = Drawing.read(body)
    name = drawing.picture(page.stale)
    return f"{page.image(name, 'Drawing with points, sizes and coordinate frame')}\n*Drawing of `{drawing.design}`*\n"


def _session(page: Page) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Commands of a page's session, and the files that its pictures show."""
    blocks = list(_FENCE.finditer(page.text))
    steps = tuple(c for found in blocks if found["language"] == "session" for c, _ in parts(found["body"]))
    files = tuple(found["body"].partition(":")[0].strip() for found in blocks if found["language"] == "picture")
    return steps, files


def _told(page: Page) -> dict[str, str]:
    steps, files = _session(page)
    if not steps:
        return {}
    return {
        ended.command: f"$ {ended.command}\n{ended.text}".rstrip() for ended in runs.session(steps, files, page.stale)
    }


def _picture(page: Page, body: str) -> str:
    name, _, caption = body.strip().partition(":")
    return page.image(runs.session_file(_session(page)[0], name.strip()), caption.strip())


def _check_link(found: re.Match[str], page: Page) -> str:
    code = found[1] or found[2]
    return f"[{code}]({page.up}checks/{code}.md)" if code and tables.known(code) else found[0]


def _prose(page: Page, text: str, map_link: Callable[[Page, str], str]) -> str:
    text = _LINK.sub(lambda found: f"{found[1]}({map_link(page, found[2])})", text)
    text = _SOURCE.sub(lambda found: f'{found[1]}="{map_link(page, found[2])}"', text)
    lines = []
    for line in text.split("\n"):
        if not line.startswith("#") and "](" not in line:
            line = _CODE.sub(lambda found: _check_link(found, page), line)
        lines.append(typeset.inline(line))
    return "\n".join(lines)
