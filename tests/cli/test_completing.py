"""What Tab offers: by the functions, and by the script that a real bash, zsh or fish runs. No tolerances: words."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest
from factory import DESIGNS, each_kind
from sweeps import mostly_slow
from systems import LINUX

from gearlink.cli import completing
from gearlink.cli.commands.sheet import sheets_of
from gearlink.cli.evaluate import open_design, read_spec, whole_design
from gearlink.cli.export.parts import kinds, makers
from gearlink.cli.options import Options
from gearlink.core.base.errors import MissingSection
from gearlink.core.base.kinds import FILES, KINDS

BIN = Path(sys.executable).parent


def typed(path: Path) -> str:
    """A path as it stands on a line that is being typed."""
    return shlex.quote(str(path))


@pytest.fixture
def line(monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    monkeypatch.setenv("COMP_WORDS", f"gearlink press {typed(DESIGNS / 'ty460.yaml')} --quantity cr")
    return monkeypatch


def words(offers: list[tuple[str, str]]) -> list[str]:
    return [name for name, _ in offers]


def test_kinds_have_a_summary_each() -> None:
    assert all(kind.summary for kind in FILES.values())
    assert words(completing.kinds("wide")) == ["wide-swing-cam"]


def test_codes_quantities_and_laws_to_explain() -> None:
    assert "GL301" in words(completing.explained("gl30"))
    assert "frame_length" in words(completing.explained("frame_"))
    assert {("phi12", "back_step_crank_angle"), ("phi13", "dwell_angle")} <= set(completing.explained("phi1"))
    assert "phi13" not in words(completing.explained("")), "symbols are many: one is offered once it is begun"
    assert words(completing.laws("modified-s")) == ["modified-sine"]
    assert words(completing.charts("back")) == ["back-step"]


def test_quantities_and_tables_are_those_of_the_design_and_the_command(line: pytest.MonkeyPatch) -> None:
    assert words(completing.quantities("crank_")) == ["crank_length"]
    assert completing.tables("pos") == [("positions", "")]
    line.setenv("COMP_WORDS", "gearlink press nowhere.yaml")
    assert "cusps" in words(completing.quantities(""))
    assert completing.tables("") == []


def test_keys_are_those_of_the_design(line: pytest.MonkeyPatch) -> None:
    assert words(completing.settings("cam.base")) == ["cam.base_radius="]
    assert "gears.idler=" not in words(completing.settings(""))
    line.setenv("COMP_WORDS", "gearlink press 'an open quote")
    assert "gears.idler=" in words(completing.settings("gears."))


OF_KINDS = each_kind(sorted(DESIGNS.glob("*.yaml")))


@pytest.mark.quick(2)
@pytest.mark.parametrize("path", OF_KINDS, ids=lambda path: path.stem)
def test_parts_sheets_and_places_are_those_of_the_design(monkeypatch: pytest.MonkeyPatch, path: Path) -> None:
    """The names that Tab offers are written down; here each comes from the design itself."""
    loaded, kind = open_design(str(path), Options())
    design = whole_design(kind, read_spec(loaded, kind, str(path)))
    monkeypatch.setenv("COMP_WORDS", f"gearlink export {typed(path)} ")
    if kind.name in kinds() and getattr(design.spec, "cam", True) is not None:
        with suppress(MissingSection):  # a file without what is exported
            assert set(makers(design)) <= set(words(completing.parts("")))
    elif kind.name not in kinds():
        assert completing.parts("") == []
    assert set(sheets_of(design)) <= set(words(completing.sheets("")))
    offered = words(completing.places(""))
    own = getattr(kind.design_class("register"), "default_at", "") if "register" in kind.commands else ""
    assert bool(offered) is bool(own)  # the register of a machine is that of its members
    if offered:
        assert offered == [kind.design_class("register").default_at]


def test_without_a_design_all_names_are_offered(line: pytest.MonkeyPatch) -> None:
    line.setenv("COMP_WORDS", "gearlink export nowhere.yaml --part ")
    assert {"rack", "main_cam", "gear5"} <= set(words(completing.parts("")))
    assert {"motion", "drawing"} <= set(words(completing.sheets("")))
    assert set(words(completing.places(""))) == {"dwell", "zone", "handover", "range"}


def test_commands() -> None:
    assert "synth" in words(completing.commands(""))


@pytest.mark.parametrize(
    ("begun", "start", "wanted"), [("sy", "sy", "synth"), ("synth ", "", "dwell"), ("synth b", "b", "back-step")]
)
def test_help_offers_commands_and_those_of_a_group(
    line: pytest.MonkeyPatch, begun: str, start: str, wanted: str
) -> None:
    line.setenv("COMP_WORDS", f"gearlink help {begun}")
    assert wanted in words(completing.commands(start))


def test_names_of_designs_are_offered_without_heavy_libraries() -> None:
    """What needs the design itself would take seconds on Tab."""
    code = (
        "import sys; from gearlink.cli import completing; "
        "completing.parts(''), completing.sheets(''), completing.places(''), completing.commands(''); "
        "print([name for name in ('numpy', 'scipy', 'matplotlib', 'pydantic') if name in sys.modules])"
    )
    env = {**os.environ, "COMP_WORDS": f"gearlink export {typed(DESIGNS / 'ty460.yaml')} "}
    done = subprocess.run([sys.executable, "-c", code], env=env, capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_a_fault_offers_nothing(line: pytest.MonkeyPatch, tmp_path: Path) -> None:
    assert completing.offered("nonsense", "") == []
    folder = tmp_path / "x.yaml"
    folder.write_bytes(b"\xff\xfekind: gear-pair\x00")
    line.setenv("COMP_WORDS", f"gearlink gear {typed(folder)}")
    assert completing.offered("quantities", "contact_r")


@pytest.mark.parametrize("name", KINDS)
def test_every_kind_has_keys_and_quantities_to_offer(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, name: str
) -> None:
    path = tmp_path / "x.yaml"
    path.write_text(f"# a comment\nkind: {name}\n")
    monkeypatch.setenv("COMP_WORDS", f"gearlink analyze {typed(path)} ")
    assert completing.settings("")
    assert completing.quantities("")


LINES = [
    ("gearlink sy", "synth"),
    ("gearlink new wide", "wide-swing-cam"),
    ("gearlink explain GL30", "GL301"),
    (f"gearlink analyze {typed(DESIGNS / 'ty460.yaml')} --set cylinder.ra", "cylinder.radius="),
    ("gearlink laws --law modified-s", "modified-sine"),
    (f"gearlink sheet {typed(DESIGNS / 'ty460.yaml')} ti", "timing"),
    (f"gearlink export {typed(DESIGNS / 'gear_pair.yaml')} --part blo", "blocking_contour"),
    (f"gearlink register {typed(DESIGNS / 'ty460_register.yaml')} --at z", "zone"),
    ("gearlink help synth mom", "momentary-dwell"),
]


def asked(shell: str, line: str) -> str:
    """What the installed script gets for a line: bash runs its function, the others their question."""
    env = {**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}"}
    env.pop("_GEARLINK_COMPLETE", None)
    if shell == "bash":
        given = shlex.join(shlex.split(line, posix=False))  # with the quotes of each word, as bash hands them on
        script = subprocess.run(
            ["bash", "-c", f"source <({_script('bash')}); COMP_WORDS=({given}); COMP_CWORD=$((${{#COMP_WORDS[@]}}-1)); "
             '_gearlink_completion gearlink; printf "%s\\n" "${COMPREPLY[@]}"'],
            env=env, capture_output=True, text=True, check=False,
        )  # fmt: skip
        return script.stdout
    env |= {"_TYPER_COMPLETE_ARGS": line, "_GEARLINK_COMPLETE": f"complete_{shell}"}
    env |= {"_TYPER_COMPLETE_FISH_ACTION": "get-args"}
    return subprocess.run(["gearlink"], env=env, capture_output=True, text=True, check=False).stdout


def _script(shell: str) -> str:
    code = (
        "from gearlink.cli.completing import BASH, ZSH; "
        f"print({shell.upper()} % dict(complete_func='_gearlink_completion', prog_name='gearlink', "
        "autocomplete_var='_GEARLINK_COMPLETE'))"
    )
    return shlex.join([sys.executable, "-c", code])


@LINUX
@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("shell", "line", "wanted"),
    mostly_slow(
        [("bash", *LINES[3]), ("zsh", *LINES[0]), ("fish", *LINES[0]), ("bash", *LINES[0]), ("zsh", *LINES[3])], 3
    ),
)
def test_a_shell_is_answered(shell: str, line: str, wanted: str) -> None:
    assert wanted in asked(shell, line)


@LINUX
@pytest.mark.slow
@pytest.mark.parametrize(("line", "wanted"), LINES)
@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_every_sort_of_word_is_completed(shell: str, line: str, wanted: str) -> None:
    assert wanted in asked(shell, line)


@pytest.mark.parametrize("shell", ["bash", "zsh"])
def test_the_scripts_are_valid_and_those_that_are_installed(shell: str) -> None:
    import typer._completion_shared as shared

    completing.better_scripts()
    script = shared.get_completion_script(prog_name="gearlink", complete_var="_GEARLINK_COMPLETE", shell=shell)
    assert ("nospace" in script) if shell == "bash" else ("funcstack" in script)
    if shutil.which(shell):
        every = {**os.environ, "LC_ALL": "C"}  # bash warns of a locale that is not there
        checked = subprocess.run([shell, "-n", "-c", script], capture_output=True, text=True, env=every, check=False)
        assert (checked.returncode, checked.stderr) == (0, "")


def test_a_shell_that_asks_in_another_form_is_offered_nothing(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The line stands in a variable of another name, say."""
    from gearlink.cli.main import run

    def as_typer(_: object) -> int:
        return len(os.environ["COMP_WORDS"])

    monkeypatch.setenv("_GEARLINK_COMPLETE", "complete_bash")
    monkeypatch.delenv("COMP_WORDS", raising=False)
    monkeypatch.setattr("gearlink.cli.app.invoke", as_typer)
    assert run(["analyze", "x.yaml"]) == 2
    assert capsys.readouterr() == ("", "")
