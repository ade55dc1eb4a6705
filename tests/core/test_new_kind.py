"""A new kind is a folder and a record: everything generic comes with them, without another line elsewhere."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

import gearlink.core
from gearlink.core.base.kind import Kind
from gearlink.core.base.kinds import FILES, KINDS

TOYS = Path(__file__).parents[1] / "toy_kinds"
RECORD = Kind(
    "push-rod",
    "crank that pushes a slider",
    "push_rod",
    "spec:PushRodSpec",
    {"analyze": "design:PushRod", "loads": "design:PushRodLoadsDesign", "register": "", "tolerance": ""},
    errors="mechanism:errors",
    outputs={"motion": ("displacement",)},
)
TEXT = """kind: push-rod
name: push-rod
crank: 40
rod: 150
input_speed: 120
loads:
  speed: 120
  links:
    crank: {mass: 1, inertia: 0.001}
    slider: {mass: 3}
  forces:
    - {on: slider, force: -20}
tolerance:
  seed: 1
  samples: 256
  sources:
    crank: {plus_minus: 0.05}
    rod: {plus_minus: 0.1}
    pins.C: {clearance: [0.01, 0.03]}
"""
STUDY = """kind: study
name: rods
of: push-rod.yaml
command: analyze
variables:
  rod: {from: 120, to: 200, step: 20}
minimize: {stroke: 0.001 mm}
"""


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Any:
    """The program, which knows the kind, in a folder with a design of it."""
    from gearlink.cli.app import app

    monkeypatch.setattr(gearlink.core, "__path__", [*gearlink.core.__path__, str(TOYS)])
    for known in (KINDS, FILES):
        monkeypatch.setitem(known, RECORD.name, RECORD)
    (tmp_path / "push-rod.yaml").write_text(TEXT)
    (tmp_path / "rods.yaml").write_text(STUDY)
    monkeypatch.chdir(tmp_path)

    def call(*words: str) -> Any:
        done = CliRunner().invoke(app, words)
        assert done.exit_code == 0, (words, done.output, done.exception)
        return done.stdout

    return call


def _quantities(text: str) -> dict[str, Any]:
    return {name: each["value"] for name, each in json.loads(text)["quantities"].items()}


def test_quantities_and_tables(run: Any) -> None:
    found = json.loads(run("analyze", "push-rod.yaml", "--format", "json", "--samples", "8"))
    assert _quantities(json.dumps(found))["stroke"] == pytest.approx(80.0, abs=1e-9)
    table = found["tables"]["motion"]
    assert [*table["columns"]] == ["crank_angle", "displacement", "velocity", "time", "slider_velocity"]
    angle = np.radians(np.array([row[0] for row in table["rows"]]))
    wanted = 40.0 * np.cos(angle) + np.sqrt(150.0**2 - (40.0 * np.sin(angle)) ** 2)
    assert np.array([row[1] for row in table["rows"]]) == pytest.approx(wanted, rel=1e-14)


def test_loads(run: Any) -> None:
    found = _quantities(run("loads", "push-rod.yaml", "--format", "json"))
    assert found["power_identity"] < 1e-12
    assert found["pin_A.peak"] > 0.0


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("words", "suffix"),
    [
        (("animate", "--format", "html"), ".html"),
        (("report",), ".html"),  # has sheet, animation and figure
        (("analyze", "--plot"), ".png"),
        (("sheet", "motion"), ".png"),
    ],
)
def test_sheet_film_report_and_picture(run: Any, tmp_path: Path, words: tuple[str, ...], suffix: str) -> None:
    run(words[0], "push-rod.yaml", *words[1:], "--out", "made")
    assert suffix in {path.suffix for path in (tmp_path / "made").iterdir()}


def test_film_runs_on_the_pins(run: Any) -> None:
    """The animation's bar from A over B to C, at the fractions of a revolution that it is asked for."""
    from gearlink.cli.views.scenes.of_motion import build
    from gearlink.cli.views.scenes.scene import Chain
    from gearlink.core.push_rod.design import PushRod

    design = PushRod(RECORD.spec_model().model_validate({"kind": "push-rod", "crank": 40, "rod": 150}))
    fraction = np.array([0.0, 0.1, 0.37, 0.8])
    scene, crank = build(design, fraction), 40.0 * np.exp(2j * np.pi * fraction)
    end = crank.real + np.sqrt(150.0**2 - crank.imag**2)
    bars = [part.joints for part in scene.parts if isinstance(part, Chain)]
    assert any(np.allclose(bar, [0.0 * crank, crank], rtol=0.0, atol=1e-12) for bar in bars)
    assert any(np.allclose(bar, [crank, end], rtol=0.0, atol=1e-12) for bar in bars)
    assert {mark.text for mark in scene.marks} >= {"A", "B", "C"}
    (curve,) = scene.chart.curves
    assert curve.now == pytest.approx(end, rel=1e-13)
    assert run("analyze", "push-rod.yaml")


def test_register(run: Any) -> None:
    found = json.loads(run("register", "push-rod.yaml", "--at", "0", "--format", "json"))
    rows = found["tables"]["budget"]["rows"]
    columns = list(found["tables"]["budget"]["columns"])
    gains = {row[columns.index("source")]: row[columns.index("gain")] for row in rows}
    assert gains == pytest.approx({"crank": 1.0, "rod": 1.0, "pins.C": 1.0}, rel=1e-12)


@pytest.mark.slow
def test_tolerance_and_explore(run: Any) -> None:
    band = json.loads(run("tolerance", "push-rod.yaml", "--format", "json", "--table", "band"))
    assert band["tables"]["band"]["rows"]
    assert json.loads(run("explore", "rods.yaml", "--format", "json", "--jobs", "1"))["tables"]["front"]["rows"]
