"""The manual: its pages have one plan, its blocks can be filled, its links lead somewhere, its examples still fail."""

from __future__ import annotations

import doctest
import re
import shlex
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import browser
import pytest

from docs.manual import blocks, drawings, links, reference, tables, typeset
from gearlink.cli.texts.codes import explanations
from gearlink.core.base.kinds import FILES

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
WRITTEN = {path: path.read_text(encoding="utf-8") for path in sorted(DOCS.rglob("*.md"))}
PLAN = ["What it is for", "Drawing", "Keys", "Equations", "Example", "Checks that matter", "Typical mistakes"]


def _blocks(language: str) -> Iterator[tuple[str, str]]:
    for path, text in WRITTEN.items():
        yield from ((path.stem, body) for body in re.findall(rf"(?ms)^```{language}\n(.*?)^```", text))


def test_every_kind_has_a_page_of_one_plan() -> None:
    assert {path.stem for path in (DOCS / "kinds").glob("*.md")} == set(FILES)
    for kind in set(FILES) - {"study"}:
        found = re.findall(r"^## (.*)$", WRITTEN[DOCS / "kinds" / f"{kind}.md"], re.MULTILINE)
        assert found == [*PLAN, "References"], kind


def test_every_kind_stands_on_the_page_that_leads_to_it() -> None:
    assert set(re.findall(r"kinds/([\w-]+)\.md", WRITTEN[DOCS / "which_kind.md"])) == set(FILES)


def test_every_page_is_in_the_navigation() -> None:
    text = (DOCS / "manual" / "site.toml").read_text(encoding="utf-8")
    nav = re.findall(r'"([\w/-]+\.md)"', text)
    written = {str(path.relative_to(DOCS)) for path in WRITTEN} | {"index.md", "contributing.md", "changelog.md"}
    listed = {name for name in reference.targets() if not re.search(r"GL\d|reference/(?!index|commands)", name)}
    assert sorted(nav) == sorted(written | listed | {"security.md"})
    theme = tomllib.loads(text)["project"]
    assert theme["theme"]["font"] is False, "fonts of another host"
    assert "offline" in theme["plugins"]


@pytest.mark.quick(2)
@pytest.mark.parametrize(("page", "block"), list(_blocks("drawing")), ids=lambda x: x if "\n" not in x else "")
def test_drawings_name_points_that_are_there(page: str, block: str) -> None:
    drawing = drawings.Drawing.read(block)
    letters = {letter for name, _ in drawing.sizes for letter in re.findall(r"[A-Z]\d*", name)}
    assert all(
        drawings.size_of(drawing.design, name.split()[2]) > 0.0
        for name, _ in drawing.sizes
        if name.startswith("circle ")
    )
    assert letters <= set(drawings.places(drawings.scene_of(drawing.design, drawing.fraction))), page


@pytest.mark.parametrize(("page", "block"), list(_blocks("math")), ids=lambda x: x if "\n" not in x else "")
def test_equations_are_typeset(page: str, block: str) -> None:
    made = typeset.display(block)
    assert made.count("<math") == sum(len(typeset.parts(line)) for line in block.strip().split("\n")), page
    left = re.sub(r"<[^>]*>", "", made)
    assert not re.search(r"\\[a-z]", left), f"{page}: {left}"


@pytest.mark.parametrize("path", WRITTEN, ids=lambda path: path.stem)
def test_equations_within_text_end_in_their_line(path: Path) -> None:
    """Others are left as they are written."""
    text = re.sub(r"(?ms)^(`{3,}).*?^\1[^\n]*$", "", WRITTEN[path])
    assert [line for line in text.split("\n") if re.sub(r"`[^`]*`", "", line).count("$") % 2] == []


def test_an_equation_at_the_start_of_a_line_stays_in_its_paragraph() -> None:
    from markdown import markdown

    made = markdown(typeset.inline("$K_v$ follows from $B_p$, $B_f$") + "\n" + typeset.inline("$B_k$ and so on"))
    assert made.count("<p>") == 1
    assert made.startswith("<p><span><math")


def test_keys_of_a_section_that_a_file_need_not_have_are_not_the_kinds_own() -> None:
    table = tables.keys("three-gear-four-bar", ["own"])
    assert "| `gears.module` |" in table
    assert "`gears.rating.life`" not in table


def test_no_block_that_is_to_be_filled_is_indented() -> None:
    """Within a list it would be left as it is."""
    for path, text in WRITTEN.items():
        assert not re.search(r"(?m)^ +```(console|figure|drawing|keys|checks|session|picture|design|math)$", text), path


def test_keys_and_checks_that_pages_ask_for_exist() -> None:
    for page, block in _blocks("keys"):
        kind, *sections = block.split()
        assert tables.keys(kind, sections).count("\n") > 2, page
    told = {code for text in WRITTEN.values() for code in re.findall(r"\bGL\d{3}\b", text)}
    assert [code for code in sorted(told) if not tables.known(code)] == []


def test_keys_of_a_section_like_an_earlier_one_are_not_said_again() -> None:
    table = tables.keys("swing-gripper", ["laws"])
    assert "| `laws.decelerate` | rest-to-speed law, run backwards; keys as in `laws.accelerate` |" in table
    assert "`laws.accelerate.start.speed`" in table
    assert "`laws.decelerate." not in table


def test_codes_of_checks_are_links_but_not_within_code() -> None:
    page = blocks.Page(ROOT / "docs" / "x.md", "x.md", "GL301, `GL302`; `gearlink explain GL303`\n")
    told = blocks.expanded(page, lambda _, target: target)
    assert told == "[GL301](checks/GL301.md), [GL302](checks/GL302.md); `gearlink explain GL303`\n"


def _unprinted() -> list[str]:
    texts = WRITTEN.values()
    return sorted({command for text in texts for command, picture in blocks.commands(text) if not picture})


@pytest.mark.quick(2)
@pytest.mark.parametrize("command", _unprinted())
def test_commands_whose_output_the_manual_prints_run(
    command: str, gearlink: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`make docs` stops at a fault of the program alone; a wrong key on a page is seen here."""
    monkeypatch.chdir(ROOT)
    ended = gearlink(*shlex.split(command)[1:])
    on_purpose = re.search(r"gears\.modul=|window=120", command)
    assert ended.status == 2 if on_purpose else ended.status <= 1, ended.err


@pytest.mark.quick(1)
@pytest.mark.parametrize(("code", "command"), list(reference.FAILING.items()))
def test_example_of_a_check_still_fails(
    code: str, command: str, gearlink: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    ended = gearlink(*shlex.split(command))
    told = ended.out + ended.err
    assert re.search(rf"(fail|warn|error) {code}\b|\b{code} +(fail|warn)\b", told), told


WITHOUT_EXAMPLE = {
    "GL157": "a store that an earlier command made",
    "GL158": "a store that another program made",
    "GL160": "a fault of the program",
    "GL178": "kinks are told of first; tests/core/tolerance_study/test_design.py gives the shares",
    "GL199": "a fault of the program",
    "GL305": "a fault of the program",
    "GL601": "a fault of the program",
}
"""Codes that no single command on the examples leads to, and why."""


def test_every_other_code_has_an_example() -> None:
    assert set(explanations()) - set(reference.FAILING) == set(WITHOUT_EXAMPLE)


def test_links_of_a_site(tmp_path: Path) -> None:
    (tmp_path / "sub").mkdir()
    (tmp_path / "index.html").write_text(
        '<h1 id="top"></h1><a href="sub/a.html#x"></a><a href="https://example.org/"></a><a href="sub/none.html"></a>'
    )
    (tmp_path / "sub" / "a.html").write_text(
        '<h1 id="x"></h1><a href="../index.html#bottom"></a><script src="https://example.org/x.js"></script>'
    )
    assert links.broken(tmp_path) == [
        "index.html: sub/none.html is not there",
        "sub/a.html loads https://example.org/x.js from another host",
        "sub/a.html: ../index.html#bottom has no such anchor",
    ]


def test_a_command_that_changed_makes_its_page_stale() -> None:
    page = "```console\n$ gearlink --version\ngearlink 0.0.1\n```\n"
    assert "gearlink 0.0.1" not in blocks.refreshed(page)
    assert blocks.refreshed("```console\n$ gearlink --version\n```\n") == "```console\n$ gearlink --version\n```\n"


def test_examples_of_the_docstrings() -> None:
    assert sum(doctest.testmod(module).failed for module in (blocks, drawings, typeset, reference)) == 0


@pytest.mark.slow
def test_pictures_of_the_readme_are_those_that_the_program_draws(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """But for a few grey levels at edges, which other versions of libraries move."""
    import numpy as np
    from PIL import Image

    from docs import pictures

    committed = pictures.TARGET
    monkeypatch.setattr(pictures, "TARGET", tmp_path)
    pictures.write_all()
    stale = []
    for path in sorted(tmp_path.iterdir()):
        with Image.open(path) as now, Image.open(committed / path.name) as before:
            same = now.size == before.size and getattr(now, "n_frames", 1) == getattr(before, "n_frames", 1)
            if (
                not same
                or np.abs(np.asarray(now.convert("L"), int) - np.asarray(before.convert("L"), int)).mean() > 2.0
            ):
                stale.append(path.name)
    assert stale == [], "run `make docs`"
    assert {path.name for path in tmp_path.iterdir()} == {path.name for path in committed.iterdir()}


@pytest.mark.slow
@pytest.mark.skipif(not browser.installed(), reason=browser.MISSING)
@pytest.mark.skipif(not (ROOT / "build/manual/site").exists(), reason="the site is built by `make site`")
def test_the_search_works_from_the_disk_and_pages_fit_a_phone() -> None:
    site = ROOT / "build" / "manual" / "site"
    with browser.browser() as shown:
        shown.size(390, 800)
        for name in ("index.html", "which_kind.html", "kinds/disc-cam.html", "checks/GL301.html"):
            shown.open(site / name)
            assert shown.run("return document.documentElement.scrollWidth") <= 390, name
        shown.size(1280, 800)
        shown.wait("return document.querySelector('.md-search__button')")
        shown.run("document.querySelector('.md-search__button').click()")
        host = "[...document.querySelectorAll('div')].find(each => each.shadowRoot)"
        shown.wait(f"return document.activeElement === {host}")
        shown.press(*"pressure angle")
        shown.wait(f"return /GL401/.test({host}.shadowRoot.textContent)")
        assert shown.problems() == []
