"""What is refused stands at the key to change, in words of its own; and nothing waits or speaks that should not."""

from __future__ import annotations

import copy
import json
import logging
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from systems import UNIX

from gearlink.cli.quiet import without_notes
from gearlink.cli.reading.design_file import parse, validate
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.core.base.kinds import FILES

_ALLOWED = """\
{kind: gear-pair, module: 1e-5, teeth: [23, 71], profile_shift: [0.35, 0.15], center_distance_allowance: js7}
"""
_ROCKER = """\
{kind: geared-rocker, gears: {module: 2.4, coupler: 30, output: 20}, links: {coupler: 70, frame: 80},
 target: {swing: 1e-5}}
"""


@pytest.mark.parametrize(
    ("text", "key", "words"),
    [
        (_ALLOWED, "center_distance_allowance", "centre distance at a limit of its allowance: -0.0"),
        (_ROCKER, "target.swing", "too small to be computed; set target.swing to "),
    ],
)
def test_the_key_that_is_to_change(gearlink: Any, tmp_path: Path, text: str, key: str, words: str) -> None:
    path = tmp_path / "design.yaml"
    path.write_text(text)
    ended = gearlink("check", path, "--format", "json")
    assert ended.status == 2
    (found,) = [each for each in ended.json["findings"] if each["status"] == "error"]
    assert found["key"] == key
    assert words in f"{found['message']}; {found.get('help', '')}"
    assert "sign change" not in found["message"]


@pytest.mark.parametrize(("key", "value"), [("gears.rim", "2.5"), ("gears.cutter.teeth", "500")])
def test_a_refusal_that_every_command_meets_is_one_at_its_key(
    gearlink: Any, designs: Path, key: str, value: str
) -> None:
    """The meshes of a linkage are looked at by several commands, each by a way of its own to the key."""
    ended = gearlink("check", designs / "drawn_ring.yaml", "--set", f"{key}={value}", "--format", "json")
    assert [(each["file"], each["key"]) for each in ended.json["findings"]] == [("<--set>", key)]


@pytest.mark.parametrize(
    ("key", "value", "fixed"),
    [
        ("gears.cutter.teeth", "440", "gears.cutter.teeth"),
        ("gears.cutter.teeth", "11", "gears.cutter.rounding"),
    ],
)
def test_a_fix_in_a_section_names_the_whole_key(gearlink: Any, designs: Path, key: str, value: str, fixed: str) -> None:
    """`set cutter.teeth` is the key of a gear pair; with --set it was unknown, and the rounding stood at `kind`."""
    ended = gearlink("check", designs / "drawn_ring.yaml", "--set", f"{key}={value}", "--format", "json")
    (found,) = [each for each in ended.json["findings"] if each["status"] == "error"]
    assert found["key"].startswith("gears.cutter.")
    assert f"set {fixed}" in found["help"]


def test_a_cutter_that_shapes_no_ring_is_refused_at_its_key_by_every_command(gearlink: Any, designs: Path) -> None:
    """The table was at `kind`, with a fix that named cutter.rounding, then one that two meshes refuse in turn."""
    ended = gearlink("gear", designs / "drawn_ring.yaml", "--set", "gears.cutter.rounding=1", "--table", "drawing")
    assert ended.status == 2
    assert "remove gears.cutter.rounding" in ended.err
    assert gearlink("gear", designs / "drawn_ring.yaml", "--table", "drawing").status == 0


def test_the_least_swing_that_is_named_is_taken(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "design.yaml"
    path.write_text(_ROCKER.replace("1e-5", "0.000248"))
    assert gearlink("analyze", path, "--quantity", "crank_length").status == 0


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
@pytest.mark.parametrize("words", [["check"], ["gear"], ["diff", "{}"], ["explore"]])
def test_a_pipe_that_nobody_fills_is_not_waited_for(gearlink: Any, tmp_path: Path, words: list[str]) -> None:
    pipe = tmp_path / "design.yaml"
    os.mkfifo(pipe)
    ended = gearlink(*(word.format(pipe) for word in words), pipe)
    assert ended.status == 2
    assert "give - and the pipe as standard input" in ended.out + ended.err


@UNIX
def test_a_pipe_that_a_shell_has_opened_is_read(gearlink: Any) -> None:
    reading, writing = os.pipe()
    with open(writing, "w") as stream:
        stream.write("{kind: gear-pair, module: 4, teeth: [17, 40], profile_shift: [0, 0]}")
    ended = gearlink("gear", f"/dev/fd/{reading}", "--quantity", "center_distance")
    os.close(reading)
    assert (ended.status, ended.out) == (0, "114.0 mm\n")


def test_libraries_keep_their_notes_while_they_are_loaded() -> None:
    logger = logging.getLogger("gearlink.test")
    with without_notes("gearlink.test"):
        assert not logger.isEnabledFor(logging.WARNING)
    assert logger.isEnabledFor(logging.WARNING)


@UNIX
@pytest.mark.slow
@pytest.mark.parametrize("words", [["cam", "--plot", "--quantity", "min_radius"], ["export", "--part", "main_cam"]])
def test_a_home_that_cannot_be_written_changes_nothing(designs: Path, tmp_path: Path, words: list[str]) -> None:
    command = [sys.executable, "-m", "gearlink.cli.main", *words, str(designs / "ty460.yaml"), "-q"]
    home = {"HOME": "/dev/null/home", "PATH": os.environ["PATH"]}
    ended = subprocess.run(command, cwd=tmp_path, env=home, capture_output=True, text=True)
    assert (ended.returncode, ended.stderr) == (0, "")


def _pipe_with(data: bytes) -> str:
    reading, writing = os.pipe()
    with open(writing, "wb") as stream:
        stream.write(data)
    return f"/dev/fd/{reading}"


@UNIX
def test_two_pipes_that_a_shell_has_opened_are_compared(gearlink: Any, designs: Path) -> None:
    """As in `gearlink diff <(git show HEAD:a.yaml) a.yaml`: what is looked at first is not lost."""
    rack = (designs / "rack_drive.yaml").read_bytes()
    assert gearlink("diff", _pipe_with(rack), _pipe_with(rack)).status == 0
    result = gearlink("gear", designs / "rack_drive.yaml", "--format", "json").out.encode()
    assert gearlink("diff", _pipe_with(result[:60_000]), designs / "rack_drive.yaml").status == 2
    assert gearlink("explore", _pipe_with(b"{kind: study}")).err.count("'variables' is missing") == 1


def test_a_batch_of_one_has_one_result(gearlink: Any, designs: Path) -> None:
    assert "\n1 result: 1 pass" in gearlink("batch", designs / "rack_drive.yaml").out


def test_an_element_is_named_in_brackets(gearlink: Any, designs: Path) -> None:
    assert "write teeth[0]" in gearlink("gear", designs / "rack_drive.yaml", "--set", "teeth.0=20").err


def test_what_the_system_refuses_is_named(gearlink: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(_: Any) -> int:
        raise PermissionError(13, "Permission denied", "/home/who/.bashrc")

    monkeypatch.setattr("gearlink.cli.main._invoke", refused)
    ended = gearlink("--install-completion", "bash")
    assert (ended.status, ended.err) == (2, "error: /home/who/.bashrc: Permission denied\n")


@pytest.mark.parametrize(
    ("wrong", "right"), [("A-radius", "A_radius"), ("d_radius", "D_radius"), ("a_raduis", "A_radius")]
)
def test_keys_with_capitals_are_recognised(gearlink: Any, tmp_path: Path, wrong: str, right: str) -> None:
    """The near key of A-radius is A_radius, not that of another shaft."""
    path = tmp_path / "design.yaml"
    path.write_text(_ROCKER.replace(" target:", f" shafts: {{{wrong}: 3}}, target:"))
    assert f"did you mean '{right}'?" in gearlink("analyze", path).err


def test_choices_in_capitals_are_recognised(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "design.yaml"
    path.write_text("{kind: gear-pair, module: 2, teeth: [23, 71], profile_shift: [0, 0], assembly: Axial}")
    assert "did you mean 'axial'?" in gearlink("gear", path).err


def test_quantities_with_capitals_are_recognised(gearlink: Any, designs: Path) -> None:
    ended = gearlink("loads", designs / "loaded_feed.yaml", "--quantity", "pin_a.peak")
    assert "nearest: pin_A.peak, " in ended.err


@pytest.mark.parametrize("asked", ["pitting_safety", "SH", "S_H", "safty_piting", "pitting"])
def test_quantities_are_found_by_symbol_and_by_their_words_in_any_order(
    gearlink: Any, designs: Path, asked: str
) -> None:
    ended = gearlink("gear", designs / "gear_pair.yaml", "--quantity", asked)
    assert re.search(r"nearest: .*safety_pitting", ended.err)


def test_of_many_quantities_the_first_are_listed(gearlink: Any, designs: Path) -> None:
    ended = gearlink("gear", designs / "gear_pair.yaml", "--quantity", "xyzzy")
    assert re.search(r"help: known: (\w+, ){12}and \d+ more, which --all shows", ended.err)


def paths_of(data: Any, before: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The paths of all keys of a file."""
    for step, inner in data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ():
        if isinstance(step, str):
            yield (*before, step)
        yield from paths_of(inner, (*before, step))


def misspelled(data: Any, path: tuple[Any, ...]) -> Any:
    """The data with another last letter of one key."""
    made = copy.deepcopy(data)
    place = made
    for step in path[:-1]:
        place = place[step]
    items = [(key[:-1] + "x" if key == path[-1] else key, value) for key, value in place.items()]
    place.clear()
    place.update(items)
    return made


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    "name", ["loaded_geneva", "planar_quick_return", "wide_swing_cycle", "rated_pair", "ty460", "candy_feed_tolerances"]
)
def test_a_misspelled_key_is_one_error(designs: Path, name: str) -> None:
    """Nor is the key said to be missing that it stands for, or one that is wanted instead of it."""
    path = designs / f"{name}.yaml"
    data = parse(path.read_bytes(), path.name).data
    model = FILES[data["kind"]].spec_model()
    told = {}
    for place in paths_of(data):
        if place == ("kind",):
            continue
        text = json.dumps(misspelled(data, place))
        try:
            validate(
                parse(text.encode(), path.name), model
            )  # a name that the file chooses, or a source looked up later
        except DesignFileError as error:
            told[place] = [each.message for each in error.diagnostics]
    assert len(told) > 5
    assert {place: words for place, words in told.items() if len(words) > 1} == {}


def test_sources_in_a_list_are_refused(gearlink: Any, designs: Path) -> None:
    ended = gearlink("tolerance", designs / "slider_crank_tolerances.yaml", "--set", "tolerance.sources=[1, x]")
    assert (ended.status, "tolerance.sources must be a section of keys" in ended.err) == (2, True)
