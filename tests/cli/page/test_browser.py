"""Report, player and watch in a real browser: no errors, keys, cursors, narrow screens, pictures soon after a save."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest
from browser import MISSING, Browser, NoBrowser, browser, installed

pytestmark = pytest.mark.skipif(not installed(), reason=MISSING)
NUMBER = "return Number(document.querySelector('#number').value.split(' ')[0])"


@pytest.fixture(scope="module")
def window() -> Iterator[Browser]:
    with ExitStack() as block:
        try:
            made = block.enter_context(browser())
        except NoBrowser as error:
            pytest.skip(str(error))
        yield made


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A report and a animation of one design."""
    from gearlink.cli.commands.animate import Asked, run_animate
    from gearlink.cli.commands.report import run_report
    from gearlink.cli.options import Options

    folder = tmp_path_factory.mktemp("pages")
    spec = str(Path(__file__).parents[3] / "designs/candy_feed.yaml")
    assert run_report(spec, Options(out=folder, quiet=True)) == 0
    assert run_animate(spec, Asked("html", seconds=1.0), Options(out=folder, quiet=True)) == 0
    return folder


@pytest.mark.slow
@pytest.mark.parametrize(("width", "height"), [(1280, 900), (390, 800)])
def test_report_fits_and_its_film_is_in_view(window: Browser, pages: Path, width: int, height: int) -> None:
    window.size(width, height)
    window.open(pages / "candy-feed.html")
    assert window.run("return document.documentElement.scrollWidth") == width
    # The key results stand first; the animation, from its heading to its controls, is seen as a whole.
    where = "return document.querySelector(arguments[0]).getBoundingClientRect()"
    assert window.run(f"{where}.bottom", ".controls") - window.run(f"{where}.top", "#animation") < height
    # Words of the sheet are at least 8 pixels high where the screen is narrow.
    assert window.run("return document.querySelector('.sheet text').getBoundingClientRect().height") > 8
    inked = (
        "const c = document.querySelector('.{0}'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;"
    )
    # The names that programs use are there where they have room, so that no word is broken into letters.
    heads = "[...document.querySelector('.results tr').cells].filter(cell => cell.offsetWidth).length"
    assert window.run(f"return {heads}") == (4 if width < 600 else 5)
    for canvas in ("stage", "strip"):
        assert window.run(inked.format(canvas) + "return d.some(value => value < 200)")
    assert window.problems() == []


@pytest.mark.slow
@pytest.mark.parametrize(("width", "columns"), [(1280, 2), (390, 1)])
def test_keys_in_force_fill_the_width(window: Browser, pages: Path, width: int, columns: int) -> None:
    """The table takes the width of the page, and no key is broken within a word."""
    window.size(width, 900)
    window.open(pages / "candy-feed.html")
    rows = "Array.from(document.querySelectorAll('.keys tr')).map(row => row.getBoundingClientRect().left)"
    assert len(set(window.run(f"return {rows}"))) == columns
    heights = "Array.from(document.querySelectorAll('.keys tr')).map(row => row.getBoundingClientRect().height)"
    found = window.run(f"return {heights}")
    assert max(found) < 1.5 * min(found), "each key in one line"


@pytest.mark.slow
@pytest.mark.parametrize(("width", "height"), [(1280, 900), (390, 700), (800, 420)])
def test_player_needs_no_scrolling(window: Browser, pages: Path, width: int, height: int) -> None:
    window.size(width, height)
    window.open(pages / "candy-feed-motion.html")
    size = window.run("const e = document.documentElement; return [e.scrollWidth, e.scrollHeight]")
    assert size == [width, height]
    for control in ("#play", "#place", "#speed"):
        box = window.run(
            "const b = document.querySelector(arguments[0]).getBoundingClientRect(); return [b.right, b.bottom]",
            control,
        )
        assert box[0] <= width
        assert box[1] <= height
    assert window.problems() == []


@pytest.mark.slow
def test_keys_play_and_step(window: Browser, pages: Path) -> None:
    window.size(1280, 900)
    window.open(pages / "candy-feed-motion.html")
    window.wait(f"{NUMBER} > 1")  # a browser drops keys that come before its first picture
    window.press("Home")
    assert window.run(NUMBER) == 1
    window.press("ArrowRight", "ArrowRight", "ArrowRight", "ArrowLeft")
    assert window.run(NUMBER) == 3
    window.press("End")
    assert window.run(NUMBER) == 25
    window.press("Space")
    window.wait(f"{NUMBER} < 20")
    window.press("Space")
    still = window.run(NUMBER)
    time.sleep(0.15)
    assert window.run(NUMBER) == still


@pytest.mark.slow
def test_cursors_are_linked_and_tell_values(window: Browser, pages: Path) -> None:
    window.size(1280, 900)
    window.open(pages / "candy-feed.html")
    window.press("Home")
    place = """
    const sheet = document.querySelector('.sheet'), svg = sheet.querySelector('svg');
    svg.scrollIntoView({block: 'end', behavior: 'instant'});
    const charts = JSON.parse(sheet.querySelector('script.charts').textContent), chart = charts[charts.length - 1];
    const box = svg.getBoundingClientRect(), unit = box.width / Number(svg.getAttribute('viewBox').split(' ')[2]);
    return [box.left + unit * (chart.box[0] + 0.75 * (chart.box[2] - chart.box[0])),
            box.top + unit * 0.5 * (chart.box[1] + chart.box[3])];
    """
    x, y = window.run(place)
    window.point(x, y)
    window.wait(f"{NUMBER} > 100")
    words = window.run("return [...document.querySelectorAll('.cursor text')].map(text => text.textContent)")
    shown = [float(re.sub("[^0-9.]", "", text)) for text in words if text.startswith("crank angle")]
    assert len(shown) == 3  # output angle, the dwell magnified, speed ratio
    assert shown == pytest.approx([270.0] * 3, abs=0.5)
    speed = next(text for text in words if text.startswith("output speed"))
    assert float(speed.split()[-1].replace("−", "-")) == pytest.approx(-0.3345, abs=1e-3)
    assert window.run(NUMBER) == pytest.approx(1 + 150 * 0.75, abs=1)
    assert window.problems() == []


@pytest.fixture
def edited(tmp_path: Path) -> Iterator[tuple[Path, str, subprocess.Popen[str]]]:
    path = tmp_path / "pair.yaml"
    path.write_text("kind: gear-pair\nmodule: 4\nteeth: [20, 40]\nprofile_shift: [0, 0]\n")
    command = [sys.executable, "-m", "gearlink.cli.main", "watch", str(path)]
    watching = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    assert watching.stderr is not None
    line = watching.stderr.readline()
    yield path, line.split(": ")[1].split(" ")[0], watching
    watching.kill()
    watching.wait()
    watching.stderr.close()


@pytest.mark.slow
def test_watch_shows_what_is_saved(window: Browser, edited: tuple[Path, str, Any]) -> None:
    path, address, watching = edited
    window.size(1280, 900)
    window.open(address)
    window.wait("return document.querySelector('.sheet svg') && document.querySelector('.film canvas')")
    path.write_text("kind: gear-pair\nmodule: 4\nteeth: [20, 41]\nprofile_shift: [0, 0]\n")
    window.wait("return document.querySelector('.sheet')?.textContent.includes('z = 41')")
    path.write_text("kind: gear-pair\nmodul: 4\nteeth: [20, 41]\nprofile_shift: [0, 0]\n")
    window.wait("return document.querySelector('#problem').textContent.includes('GL105')")
    words = window.run("return document.querySelector('#problem').textContent")
    assert "pair.yaml:2:1: error GL105" in words
    assert "\n  modul: 4\n  ^" in words
    assert window.run("return document.querySelector('.sheet') !== null")  # the last picture stays
    path.write_text("kind: gear-pair\nmodule: 4\nteeth: [20, 42]\nprofile_shift: [0, 0]\n")
    window.wait("return document.querySelector('.sheet').textContent.includes('z = 42')")
    assert window.run("return document.querySelector('#problem').textContent") == ""
    assert window.problems() == []
    watching.send_signal(signal.SIGINT)
    assert watching.wait(60) == 130


@pytest.mark.slow
@pytest.mark.parametrize("share", [0.02, 0.26, 0.5, 0.74, 0.98])
def test_what_a_cursor_says_covers_no_words_of_the_sheet(window: Browser, pages: Path, share: float) -> None:
    """Boxes on the screen: the values stand within their panel, clear of the labels of its extremes."""
    window.size(1280, 900)
    window.open(pages / "candy-feed.html")
    sheet = """const sheet = document.querySelector('.sheet'), svg = sheet.querySelector('svg');
        svg.scrollIntoView({block: 'end'});
        const of = each => {
            const box = each.getBoundingClientRect(); return [box.left, box.top, box.right, box.bottom];
        };
        const [left, top, right] = of(svg), scale = (right - left) / Number(svg.getAttribute('viewBox').split(' ')[2]);
        const panels = JSON.parse(sheet.querySelector('script.charts').textContent).map(
            chart => chart.box.map((side, k) => (k % 2 ? top : left) + scale * side));
        """
    a, b, c, d = window.run(f"{sheet} return panels[panels.length - 1];")
    window.point(a + share * (c - a), 0.5 * (b + d))
    said, labels, panels = window.run(
        sheet
        + """return [[...svg.querySelectorAll('.cursor text')].map(of),
                [...svg.querySelectorAll('g[id^="text_"]')].map(of), panels];"""
    )
    assert len(said) >= 2 * 2
    for left, top, right, bottom in said:
        assert any(a <= left + 1 and right <= c + 1 and b <= top + 3 and bottom <= d + 3 for a, b, c, d in panels)
        assert not any(a < right and left < c and b < bottom - 2 and top + 2 < d for a, b, c, d in labels)
    assert window.problems() == []


@pytest.mark.slow
def test_on_paper_the_film_is_a_still_picture(window: Browser, pages: Path) -> None:
    """The mechanism as it stands, not stretched, and no buttons: not a heading over nothing."""
    window.size(794, 1123)
    window.open(pages / "candy-feed.html")
    window.media("print")
    try:
        shown = "const {{display, objectFit}} = getComputedStyle(document.querySelector('.film {0}'));"
        shown += "return [display, objectFit]"
        assert window.run(shown.format(".stage")) == ["block", "contain"]
        assert window.run("return document.querySelector('.film .stage').getBoundingClientRect().height") > 100
        assert [window.run(shown.format(each))[0] for each in (".controls", ".strip")] == ["none", "none"]
    finally:
        window.media("")


@pytest.mark.slow
@pytest.mark.parametrize("width", [1280, 390])
def test_words_of_a_machine_lie_within_its_picture(window: Browser, tmp_path: Path, width: int) -> None:
    """The names of the members in the top row were cut through, at either width; those of curves ran over the left end.

    What is written on a canvas is recorded with its box in pixels of the canvas.
    """
    from gearlink.cli.commands.report import run_report
    from gearlink.cli.options import Options

    spec = str(Path(__file__).parents[3] / "designs/sheet_press.yaml")
    assert run_report(spec, Options(out=tmp_path, quiet=True)) == 0
    window.size(width, 900)
    window.open(tmp_path / "sheet-press.html")
    window.run("""window.written = [];
        const old = CanvasRenderingContext2D.prototype.fillText;
        CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
            const m = this.measureText(text), at = this.getTransform(), k = at.a;
            window.written.push([this.canvas.className, text,
                at.e + k * (x - m.actualBoundingBoxLeft), at.f + k * (y - m.actualBoundingBoxAscent),
                at.e + k * (x + m.actualBoundingBoxRight), at.f + k * (y + m.actualBoundingBoxDescent),
                this.canvas.width, this.canvas.height]);
            return old.call(this, text, x, y);
        };
        document.querySelector('#on').click();""")
    written = window.run("return window.written")
    assert {"suckers", "jogger"} <= {text for name, text, *_ in written if name == "stage"}
    assert {"suckers", "jogger"} <= {text for name, text, *_ in written if name == "strip"}
    for _, text, left, top, right, bottom, wide, high in written:
        assert -1.0 <= left <= right <= wide + 1.0, text
        assert -1.0 <= top <= bottom <= high + 1.0, text
    long = "[...document.querySelectorAll('.results table')].map(t => t.offsetWidth - t.parentElement.offsetWidth)"
    if width > 1000:
        assert max(window.run(f"return {long}")) <= 0


@pytest.mark.slow
@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_what_a_cursor_says_keeps_clear_of_the_curves(window: Browser, pages: Path, share: float) -> None:
    """Of the panels that leave room; points of curves in the box of the words."""
    window.size(1280, 900)
    window.open(pages / "candy-feed.html")
    said, hidden = window.run(
        """const sheet = document.querySelector('.sheet'), svg = sheet.querySelector('svg');
        svg.scrollIntoView({block: 'end'});
        const charts = JSON.parse(sheet.querySelector('script.charts').textContent), chart = charts[charts.length - 1];
        cursors.say(chart.over, chart.x[0] + arguments[0] * (chart.x[1] - chart.x[0]), null);
        const outer = svg.getBoundingClientRect();
        const scale = outer.width / Number(svg.getAttribute('viewBox').split(' ')[2]);
        const boxes = [...svg.querySelectorAll('.cursor text')].map(each => each.getBoundingClientRect());
        const inside = each => each.curves.map(curve => curve.x.filter((x, k) => {
            const [a, b, c, d] = each.box;
            const at = outer.left + scale * (a + (x - each.x[0]) / (each.x[1] - each.x[0]) * (c - a));
            const up = outer.top + scale * (d - (curve.y[k] - each.y[0]) / (each.y[1] - each.y[0]) * (d - b));
            return boxes.some(box => box.left < at && at < box.right && box.top < up && up < box.bottom);
        }).length).reduce((sum, one) => sum + one, 0);
        return [boxes.length, charts.filter(each => each.over === chart.over).map(inside)];""",
        share,
    )
    assert len(hidden) >= 3
    assert said >= len(hidden)
    assert sorted(hidden)[len(hidden) // 2] == 0
    assert sum(hidden) < 20 * len(hidden)


@pytest.mark.slow
def test_meanings_of_results_are_words_on_a_phone(window: Browser, pages: Path) -> None:
    """Their column had shrunk to a letter, and rows were as high as it was long; it scrolls instead."""
    window.size(390, 800)
    window.open(pages / "candy-feed.html")
    cells = "[...document.querySelectorAll('.scroll td:nth-child(5):not(.n)')]"
    widths = window.run(f"return {cells}.map(cell => cell.offsetWidth).filter(wide => wide)")
    assert len(widths) > 10
    assert min(widths) > 100
    assert window.run("return document.documentElement.scrollWidth") == 390
