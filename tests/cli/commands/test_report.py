"""`report`: one self-contained HTML page."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest
from factory import design
from matplotlib.figure import Figure
from sweeps import ALL

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.render.numbers import thinning
from gearlink.cli.views.page import sections
from gearlink.core.base.report import Table


class Page(HTMLParser):
    """Collects what the tests look at, and holds every tag to be closed."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.sources: list[str] = []
        self.text: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        named = dict(attrs)
        self.sources += [value for key in ("src", "href", "xlink:href") if (value := named.get(key))]
        if tag not in ("meta", "img"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text.append(data)


@pytest.fixture
def crank(tmp_path: Path) -> Path:
    path = tmp_path / "crank.yaml"
    path.write_text("kind: slider-crank\nname: <b>A & B</b>\nstroke: 310   # a comment with <tags>\nrod: 520\n")
    return path


@pytest.mark.slow
def test_page_is_whole_and_self_contained_and_the_same_every_time(gearlink: Any, crank: Path, tmp_path: Path) -> None:
    folders = ["a", *("b" if ALL else "")]
    for folder in folders:
        assert gearlink("report", crank, "--out", tmp_path / folder, "-q").status == ExitCode.OK
    path, *again = (next((tmp_path / folder).iterdir()) for folder in folders)
    assert all(path.read_bytes() == other.read_bytes() for other in again)
    page = Page(path.read_text())
    assert page.open == []
    assert all(source.startswith("#") for source in page.sources)  # within the SVG
    assert not re.search(r"""\bsrc=|@import|url\((?!#)""", path.read_text())
    assert "Crank 155, rod 520 [mm]" in page.text  # words of the sheet are text
    # names and comments are text
    assert "<b>A & B</b>" not in path.read_text()
    assert "# a comment with <tags>" in "".join(page.text)


@pytest.fixture
def pictures_are_blank(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures are drawn by tests of their own."""
    monkeypatch.setattr("gearlink.cli.views.figures.write.draw", lambda *_: Figure(figsize=(1, 1)))


@pytest.mark.usefixtures("pictures_are_blank")
def test_all_commands_of_the_design(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    ended = gearlink("report", designs / "ty460.yaml", "--out", tmp_path)
    text = (tmp_path / "TY-460.html").read_text()
    assert ended.status == ExitCode.OK
    assert re.findall(r"<h2>(\w+)</h2>", text) == ["press", "cam", "gear"]
    assert "154.211592" in text
    assert "TY-460 report 3.2" in text


@pytest.mark.usefixtures("pictures_are_blank")
def test_failing_design_is_still_reported(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    ended = gearlink("report", designs / "thesis_example_3_as_printed.yaml", "--out", tmp_path)
    assert ended.status == ExitCode.FINDING
    assert (
        "interference of the crank gear and the output gear: 1.6 mm"
        in (tmp_path / "thesis-example-3-as-printed.html").read_text()
    )


def test_wrong_design_writes_nothing(gearlink: Any, crank: Path, tmp_path: Path) -> None:
    ended = gearlink("report", crank, "--set", "stroke=99999", "--out", tmp_path / "out")
    assert ended.status == ExitCode.WRONG_INPUT
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("step", "words"), [(1, "1st"), (2, "2nd"), (3, "3rd"), (11, "11th"), (12, "12th"), (23, "23rd")]
)
def test_rows_left_out_are_counted_in_english(step: int, words: str) -> None:
    table = Table("positions", ("x",), ("1",), (range(360),))
    assert thinning(step, table) == f"every {words} of 360 rows"


@pytest.mark.slow
def test_sheets_drawn_side_by_side_are_the_same(
    gearlink: Any, designs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pages = []
    for processors in ({0}, {0, 1}):
        monkeypatch.setattr("os.sched_getaffinity", lambda _, found=processors: found, raising=False)
        out = tmp_path / str(len(processors))
        assert gearlink("report", designs / "two_gear_drag_link.yaml", "--out", out, "-q").status in (0, 1)
        pages.append((out / "two-gear-drag-link.html").read_bytes())
    assert pages[0] == pages[1]


def test_limits_of_two_gears_are_lines_of_a_cell() -> None:
    """Four numbers side by side, which do not break, left the meanings a column of three words."""
    page = sections.results(design("gear_pair").report("gear"))
    (cell,) = re.findall(r"<td>span measurement limits</td><td>[^<]*</td><td class=n>(.*?)</td>", page)
    assert [len(line.split()) for line in cell.split("<br>")] == [2, 2]
    widest = max(len(line) for cell in re.findall(r"<td class=n>(.*?)</td>", page) for line in cell.split("<br>"))
    assert widest < 30


def test_keys_in_force_are_written_as_in_a_file() -> None:
    """Lists and truth values are not Python's: ['right', 'left'], False."""
    rows = dict(sections._keys({"hand": ["right", "left"], "sobol": False, "teeth": (23, 71), "own": {"width": 20.0}}))
    assert rows == {"hand": "[right, left]", "sobol": "false", "teeth": "[23, 71]", "own.width": "20.0"}


@pytest.mark.slow
@pytest.mark.usefixtures("pictures_are_blank")
def test_a_report_is_in_the_order_of_a_review(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    """What has changed is said first, the file stands last; every link of the contents has its place."""
    other = tmp_path / "old.yaml"
    text = (designs / "crank_rocker_links.yaml").read_text(encoding="utf-8")
    other.write_text(re.sub(r"crank: [\d.]+", "crank: 30.25", text, count=1), encoding="utf-8")
    asked = ("report", designs / "crank_rocker_links.yaml", "--against", other, "--out", tmp_path)
    assert gearlink(*asked).status == ExitCode.OK
    page = (tmp_path / "crank-rocker-links.html").read_text(encoding="utf-8")
    places = re.findall(r'<section id="([\w-]+)">', page)
    assert places[:2] == ["changes", "animation"]
    assert places[-1] == "input"
    assert [f"#{place}" for place in places] == re.findall(r'<a href="(#[\w-]+)">', page)
    rows = dict(re.findall(r"<tr><td>links.crank</td><td class=n>([\d.]+)</td><td class=n>([\d.]+)</td>", page))
    assert rows == {"30.25": "40"}
    assert "prefers-color-scheme: dark" in page
    assert "@media print" in page
    assert gearlink("report", other, "--against", designs / "lift_cam.yaml", "--out", tmp_path).status == 2


def test_the_film_of_a_report_shows_what_is_asked_for(gearlink: Any, crank: Path, tmp_path: Path) -> None:
    asked = ("report", crank, "--out", tmp_path / "out", "--show")
    assert gearlink(*asked, "velocity:Q").status == ExitCode.WRONG_INPUT
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_a_report_as_pdf_is_the_same_every_time(gearlink: Any, crank: Path, tmp_path: Path) -> None:
    for folder in ("a", "b"):
        assert gearlink("report", crank, "--format", "pdf", "--out", tmp_path / folder, "-q").status == ExitCode.OK
    one, other = (next((tmp_path / folder).iterdir()).read_bytes() for folder in ("a", "b"))
    assert one.startswith(b"%PDF")
    assert one == other
    assert len(re.findall(rb"/Type /Page\b", one)) >= 3


def test_a_pdf_shows_no_animation(gearlink: Any, crank: Path, tmp_path: Path) -> None:
    """What was to be shown had been passed over."""
    ended = gearlink("report", crank, "--format", "pdf", "--show", "velocity", "--out", tmp_path / "out")
    assert ended.status == 2
    assert "--show velocity is for the animation, which a pdf does not have" in ended.err
    assert not (tmp_path / "out").exists()


def test_many_numbers_of_a_result_leave_room_for_its_meaning() -> None:
    """Six critical speeds in one line squeezed the column of meanings to a word a line, and cut that of sources."""
    shown = sections._below_each_other([1573.89255, 7446.51986, 8748.20861, 12027.7346, 22553.3568, 26046.3173])
    assert [len(line.split()) for line in shown.splitlines()] == [3, 3]
    assert sections._below_each_other([0.31, 0.05]) == "0.31 0.05"
