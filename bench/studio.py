"""The studio: from the input of a slider to the key results on the page, and to findings and animation after them."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future
from itertools import cycle
from pathlib import Path
from time import process_time
from typing import TYPE_CHECKING, Any, cast

from bench.start_up import designs
from bench.timing import Family, Method, measure

if TYPE_CHECKING:
    from gearlink.cli.studio.session import Page, Session

SLIDERS = {
    "feed, links.crank": ("drawn_feed.yaml", "links.crank", (17.9, 18.1)),
    "feed, dwell.window, idler chosen": ("standing_feed.yaml", "dwell.window", (69.5, 70.5)),
    "two gears, dwell.window, teeth given": ("two_gear_standing.yaml", "dwell.window", (59.5, 60.5)),
    "press, bed.rod": ("ty460.yaml", "bed.rod", (519.5, 520.5)),
    "swing gripper, speed": ("swing_gripper.yaml", "speed", (11900.0, 12100.0)),
    "wide swing, speed": ("wide_swing_twin_cam.yaml", "speed", (99.0, 101.0)),
    "gear pair, module": ("gear_pair.yaml", "module", (2.0, 2.5)),
}
"""A design, the number that is moved, and two values of it."""
PICTURES = 48


class Silent:
    """A page that takes everything and shows nothing."""

    def __getattr__(self, _name: str) -> Callable[..., None]:
        return lambda *_: None


class Nobody(Executor):
    """In place of the processes beside the page: they have processors of their own."""

    def submit(self, *_: Any, **__: Any) -> Future[Any]:
        """A future that is never done."""
        return Future()


def family(quick: bool) -> Family:
    """The table of the family."""
    rounds = 5 if quick else 25
    loop = asyncio.new_event_loop()
    try:
        methods = []
        for what, (name, key, values) in SLIDERS.items():
            methods += [
                Method(f"{what}: key results", 1, numbers_of(loop, designs() / name, key, values)),
                Method(f"{what}: findings and animation", 1, motion_of(loop, designs() / name, key, values)),
            ]
        rows = measure(methods, _read_feed, 1, rounds, process_time)
    finally:
        loop.close()
    return Family(
        "studio",
        "Studio: from the input of a slider to what the page shows",
        "none",
        "reading and validating the file of the feed",
        rows,
        (
            "processor time of the process, which hardly depends on what else the machine does",
            "key results: change and read the text, compute the results of all quick commands, give them to the page",
            f"findings and animation of {PICTURES} frames: in a second process, while the next input is read",
            "without the browser (tests/cli/studio/test_browser.py measures the whole way)",
        ),
    )


def session_of(loop: asyncio.AbstractEventLoop, path: Path) -> Session:
    """A session on a design file whose page shows nothing."""
    from gearlink.cli.studio.session import Session
    from gearlink.cli.studio.text import Document

    made = [Session(Document(path), Nobody()) for _ in range(2)]
    for session in made:  # the first one imports, and what it took says nothing of how long its commands take
        session.pages.append(cast("Page", Silent()))
        loop.run_until_complete(session.make())
    return made[1]


def numbers_of(
    loop: asyncio.AbstractEventLoop, path: Path, key: str, values: tuple[float, float]
) -> Callable[[], object]:
    """A call that moves a slider and ends with its key results."""
    session, turns = session_of(loop, path), cycle(values)

    def run() -> object:
        session.move(_path_of(session, key), next(turns))
        return loop.run_until_complete(session.make())

    return run


def motion_of(
    loop: asyncio.AbstractEventLoop, path: Path, key: str, values: tuple[float, float]
) -> Callable[[], object]:
    """A call that computes what follows the numbers: findings and an animation of few pictures."""
    from gearlink.cli.studio import study
    from gearlink.cli.studio.text import with_value

    session = session_of(loop, path)
    text, place = session.document.text, _path_of(session, key)
    texts: Iterator[str] = cycle(
        [with_value(text, place, value, as_written=True) for value in (*values, values[0] * 1.001)]
    )

    def run() -> object:
        made = next(texts)
        commands = study.Study(made, str(path)).commands[:1]
        return study.moving(made, str(path), commands, PICTURES, study.Look())

    return run


def _path_of(session: Session, key: str) -> Any:
    return next(number.path for number in session.state.numbers if number.name == key)


def _read_feed() -> object:
    from gearlink.cli.studio.study import Study

    path = designs() / "drawn_feed.yaml"
    return Study(path.read_text(encoding="utf-8"), str(path))
