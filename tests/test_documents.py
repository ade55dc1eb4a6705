"""README and documents say what the program does: their commands are run and their output compared, as `blocks.same`
and `blocks.unchanged` say. Output that `make docs` puts into the manual, tests/test_manual.py looks at.
"""

from __future__ import annotations

import math
import os
import re
import shlex
import subprocess
from pathlib import Path
from typing import Any

import pytest
import typer
from factory import DESIGNS, each_kind
from matplotlib.figure import Figure

from docs.manual import blocks, reference
from gearlink.cli.app import app
from gearlink.cli.exit_codes import ExitCode
from gearlink.core.base.kinds import FILES

ROOT = Path(__file__).resolve().parents[1]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]


def sessions() -> list[tuple[str, str, list[str]]]:
    """Page, command and printed output of every command of a console block that has its output."""
    texts = ((page.name, page.read_text(encoding="utf-8")) for page in PAGES)
    return [(name, command, output) for name, text in texts for command, output in blocks.told(text)]


def test_a_figure_that_has_drifted_is_seen() -> None:
    assert blocks.same("18.058100927176056 mm", "18.058100927176052 mm")
    assert not blocks.same("18.058100927176056 mm", "18.058100927176245 mm")
    assert blocks.same("18.0581009 mm", "18.0581009001 mm")


@pytest.mark.quick(6)
@pytest.mark.parametrize(("page", "command", "output"), sessions(), ids=lambda x: x if isinstance(x, str) else "")
def test_console_blocks(
    page: str, command: str, output: list[str], gearlink: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    words = shlex.split(command)
    assert words[0] == "gearlink", f"{page}: only gearlink commands are run"
    monkeypatch.chdir(ROOT)
    monkeypatch.setenv("COLUMNS", "80")
    ended = gearlink(*words[1:])
    assert ended.status in (ExitCode.OK, ExitCode.FINDING, ExitCode.WRONG_INPUT)
    got = [line.rstrip() for line in (ended.out + ended.err).rstrip().split("\n")]
    assert blocks.unchanged(got, output), f"{page}: stale, run `make docs`; `{command}` prints\n" + "\n".join(got)


def test_readme_opens_with_a_real_result() -> None:
    assert any(page == "README.md" and command.startswith("gearlink synth dwell") for page, command, _ in sessions())


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    """To a file, or to a page that `make docs` makes of the program."""
    made = {ROOT / "docs" / name for name in reference.targets()}
    for target in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", re.sub(r"(?ms)^```.*?^```", "", page.read_text("utf-8"))):
        if not target.startswith("http"):
            path = Path(os.path.normpath(page.parent / target))
            assert path.exists() or path in made, target


def test_figures_of_the_readme_are_those_of_the_script_and_small() -> None:
    """`make docs` draws them; an animation of more than 400 kB is too large for a first page."""
    script = (ROOT / "docs" / "pictures.py").read_text()
    kinds = re.findall(r'^    "([\w-]+)": \((?:"\w+", )?"([\w/]+)", [(\d]', script, re.MULTILINE)
    assert [name for _, name in kinds if not (DESIGNS / f"{name}.yaml").exists()] == []
    sizes = {path.name: path.stat().st_size for path in (ROOT / "docs" / "img").iterdir()}
    shown = re.findall(r"docs/img/([\w.-]+)", (ROOT / "README.md").read_text())
    assert (
        sorted(shown)
        == sorted(sizes)
        == sorted(["feed.gif", "press.png", "first-result.png", *(f"{kind}.png" for kind, _ in kinds)])
    )
    assert sizes["feed.gif"] < 400_000
    assert sum(sizes.values()) < 1_500_000


def test_the_readme_has_every_kind_and_is_a_page() -> None:
    text = (ROOT / "README.md").read_text()
    assert set(re.findall(r"^\|.*?\| \[`([\w-]+)`\]", text, re.MULTILINE)) == set(FILES)
    assert text.count("\n") < 200
    assert [line for line in text.split("\n") if len(line) > 120 and not line.startswith("|")] == []


def test_the_page_of_the_commands_has_all_of_them() -> None:
    text = (ROOT / "docs" / "commands.md").read_text()
    assert [name for name in typer.main.get_command(app).commands if not re.search(rf"\b{name}\b", text)] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_files_that_are_named_are_there(page: Path) -> None:
    """Paths below the folders of the repository; a star stands for any letters."""
    named = re.findall(r"(?<![\w/])(?:core|cli|docs|designs|tests|bench)/[\w/*-]+\.(?:py|yaml|md)", page.read_text())
    assert [path for path in named if not list(ROOT.glob(path))] == []
    parts = re.findall(r"`((?:core|cli)/[a-z_/]+)[.`]", page.read_text())
    assert [path for path in parts if not (ROOT / path).is_dir() and not list(ROOT.glob(f"{path}.*"))] == []


def test_nomenclature_and_glossary_are_those_of_the_program() -> None:
    import importlib.util

    spec = importlib.util.spec_from_file_location("generate", ROOT / "docs" / "generate.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert (ROOT / "docs" / "nomenclature.md").read_text() == module.text(), "run `make docs`"
    assert (ROOT / "docs" / "glossary.md").read_text(encoding="utf-8") == module.glossary_text(), "run `make docs`"


@pytest.mark.quick(5)
@pytest.mark.parametrize("path", each_kind(sorted(DESIGNS.glob("*.yaml"))), ids=lambda path: path.name)
def test_every_worked_design_runs(path: Path, gearlink: Any) -> None:
    """With its tables; that all of them pass, tests/cli/commands/test_check.py holds."""
    ended = gearlink("batch", path, "--format", "json")
    printed_wrong = path.name == "thesis_example_3_as_printed.yaml"
    assert ended.status == (ExitCode.FINDING if printed_wrong else ExitCode.OK), ended.out


def test_make_targets_of_the_readme_exist() -> None:
    makefile = (ROOT / "Makefile").read_text()
    for target in re.findall(r"^make ([\w-]+)", (ROOT / "README.md").read_text(), re.MULTILINE):
        assert re.search(rf"^{target}:", makefile, re.MULTILINE), target


def test_demo_fits_a_screen(gearlink: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Both results of `make demo`, the lines that make shows of them and what it says, on 24 lines of 80."""
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setattr("gearlink.cli.views.figures.write.draw", lambda *_: Figure(figsize=(1, 1)))
    recipe = subprocess.run(["make", "-n", "demo"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    lines = [line for line in recipe.splitlines() if re.match(r"\S+/gearlink |echo", line)]
    commands = [line.split()[1:] for line in lines if not line.startswith("echo")]
    assert [command[:3] for command in commands] == [
        ["synth", "dwell", "designs/standing_feed.yaml"],
        ["cam", "designs/ty460.yaml", "--plot"],
    ]
    picture = str(ROOT / "TY-460-cam.png")
    assert picture in lines[-1]
    lines[-1] = lines[-1].replace(picture, "/home/name/gearlink/TY-460-cam.png")  # however deep this checkout lies
    shown = sum(math.ceil(len(line) / 80) for line in lines)
    monkeypatch.chdir(ROOT)
    for command in commands:
        ended = gearlink(*command, "--out", tmp_path)
        assert ended.status == ExitCode.OK
        shown += (ended.out + ended.err).count("\n")
    assert shown <= 24
    assert (tmp_path / "TY-460-cam.png").exists()


def test_ci_runs_the_check() -> None:
    script = (ROOT / ".ci" / "run").read_text()
    assert "make check" in script
    assert os.access(ROOT / ".ci" / "run", os.X_OK)
