"""What other programs read of the repository: workflow, action, hooks; each names commands and versions that exist."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest
import yaml
from systems import UNIX

from gearlink.cli.commands.schema import PATTERNS

ROOT = Path(__file__).parents[1]


def _text(name: str) -> str:
    return (ROOT / name).read_text()


def _read(name: str) -> Any:
    return yaml.safe_load(_text(name))


def _run(job: Any) -> list[str]:
    return [step["run"] for step in job["steps"] if "run" in step]


def _pythons(job: Any) -> list[str]:
    return [step["with"]["python-version"] for step in job["steps"] if "python-version" in step.get("with", {})]


def test_the_workflow_runs_the_checks_on_every_python() -> None:
    job = _read(".github/workflows/check.yml")["jobs"]["check"]
    assert job["strategy"]["matrix"]["python"] == ["3.11", "3.12", "3.13", "3.14", "3.15"]
    assert _run(job) == ["make check"]
    systems = _read(".github/workflows/check.yml")["jobs"]["systems"]
    assert systems["strategy"]["matrix"]["system"] == ["windows-latest", "macos-latest"]
    assert "gearlink verify" in _run(systems)
    least = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["requires-python"]
    assert least == ">=3.11"


@pytest.mark.parametrize("workflow", ["check", "versions"])
def test_the_least_versions_are_tried_on_the_least_python(workflow: str) -> None:
    job = _read(f".github/workflows/{workflow}.yml")["jobs"]["least"]
    assert (_run(job), _pythons(job)) == (["make test-least"], ["3.11"])


def test_the_newest_versions_are_tried_every_week() -> None:
    """On the minimum Python, whose libraries are others, and on the newest."""
    workflow = _read(".github/workflows/versions.yml")
    (when,) = workflow[True]["schedule"]  # YAML 1.1 reads the word `on` so
    assert len(when["cron"].split()) == 5
    assert when["cron"].split()[2:] == ["*", "*", "1"]
    job = workflow["jobs"]["newest"]
    assert job["strategy"]["matrix"]["python"] == ["3.11", "3.15"]
    assert _run(job) == ["make test-newest"]


def test_the_tests_are_run_where_little_is_as_usual() -> None:
    job = _read(".github/workflows/check.yml")["jobs"]["elsewhere"]
    assert _run(job)[-1] == "make test-elsewhere"
    full = (ROOT / "Makefile").read_text().partition("\ncheck-full:")[2].partition("\n\n")[0]
    assert "$(MAKE) test-elsewhere" in full


def test_files_that_the_workflows_name_are_there() -> None:
    named = re.findall(r"(?:cache-dependency-path: |\$SOURCE/)([\w/.]+)", _text("action.yml"))
    for workflow in sorted((ROOT / ".github" / "workflows").glob("*.yml")):
        text = workflow.read_text()
        named += re.findall(r"cache-dependency-path: (\S+)", text)
        for target in re.findall(r"- run: make (\S+)", text):
            assert re.search(rf"^{target}:", _text("Makefile"), re.MULTILINE), target
    assert len(named) == 5
    assert [name for name in named if not (ROOT / name).is_file()] == []


@UNIX
@pytest.mark.slow
def test_the_action_runs_a_batch(tmp_path: Path) -> None:
    action = _read("action.yml")
    defaults = {name: given["default"] for name, given in action["inputs"].items()}
    script = action["runs"]["steps"][-1]["run"]
    scripts = tmp_path / "gearlink" / "bin"
    scripts.mkdir(parents=True)
    (scripts / "gearlink").symlink_to(Path(sys.executable).parent / "gearlink")
    given = {"PATHS": "designs/thesis_example_2.yaml", "FAIL_ON": defaults["fail-on"]}
    environment = os.environ | {"RUNNER_TEMP": str(tmp_path)} | given
    ended = subprocess.run(["bash", "-ec", script], cwd=ROOT, env=environment, capture_output=True, text=True)
    assert (ended.returncode, ended.stderr) == (0, "1 result: 1 pass\n")


@UNIX
def test_the_action_takes_every_line_of_its_paths(tmp_path: Path) -> None:
    """`read` stops at the first line unless told otherwise; designs of the others would pass unseen."""
    called = tmp_path / "gearlink" / "bin" / "gearlink"
    called.parent.mkdir(parents=True)
    called.write_text('#!/bin/sh\nfor word; do echo "$word"; done\n')
    called.chmod(0o755)
    given = {
        "RUNNER_TEMP": str(tmp_path),
        "PATHS": "a.yaml b.yaml\n  --dask=c.yaml\n",
        "FAIL_ON": "failure",
    }
    command = [
        "bash",
        "--noprofile",
        "--norc",
        "-eo",
        "pipefail",
        "-c",
        _read("action.yml")["runs"]["steps"][-1]["run"],
    ]
    words = subprocess.run(command, env=given, capture_output=True, text=True, check=True).stdout.split("\n")
    assert words[words.index("--") + 1 :] == ["a.yaml", "b.yaml", "--dask=c.yaml", ""]


def test_the_release_tries_the_wheel_on_three_systems_and_publishes_nothing() -> None:
    workflow = _read(".github/workflows/release.yml")
    build, install = workflow["jobs"]["build"], workflow["jobs"]["install"]
    assert "python -m twine check --strict dist/*" in _run(build)
    assert install["strategy"]["matrix"]["system"] == ["ubuntu-latest", "windows-latest", "macos-latest"]
    assert "gearlink verify" in _run(install)
    assert workflow["permissions"] == {"contents": "read"}
    uses = [step.get("uses", "") for job in workflow["jobs"].values() for step in job["steps"]]
    assert not [name for name in uses if "publish" in name]


def test_the_hooks_of_the_repository_use_what_make_installs() -> None:
    (repo,) = _read(".pre-commit-config.yaml")["repos"]
    assert repo["repo"] == "local"
    assert [hook["id"] for hook in repo["hooks"]] == ["ruff-format", "ruff-check", "mypy", "words"]
    named = [word for hook in repo["hooks"] for word in hook["entry"].split() if word.startswith("tests/")]
    assert [name for name in named if not (ROOT / name).is_file()] == []


def test_the_hook_checks_design_files() -> None:
    (hook,) = _read(".pre-commit-hooks.yaml")
    assert (hook["id"], hook["entry"]) == ("gearlink-check", "gearlink check")


@pytest.mark.slow
def test_schema_and_settings_of_an_editor(gearlink: Any, tmp_path: Path) -> None:
    ended = gearlink("schema", "--write", tmp_path)
    assert ended.status == 0
    schema = json.loads((tmp_path / "gearlink.schema.json").read_text())
    assert schema == json.loads(gearlink("schema").out)
    settings = tmp_path / ".vscode" / "settings.json"
    assert json.loads(settings.read_text())["yaml.schemas"] == {"./gearlink.schema.json": list(PATTERNS)}
    settings.write_text("{}")
    again = gearlink("schema", "--write", tmp_path)
    assert "left as it is" in again.err
    assert settings.read_text() == "{}"


@pytest.mark.quick(1)
@pytest.mark.parametrize("folder", ["none/of/it", ""])
def test_schema_says_where_it_cannot_write(gearlink: Any, tmp_path: Path, folder: str) -> None:
    (tmp_path / "file").write_text("")
    ended = gearlink("schema", "--write", tmp_path / "file" / folder)
    assert ended.status == 2
    assert "GL116" in ended.err
