"""bench/: what it prints; its errors are real measurements, its times are not tested."""

from __future__ import annotations

import asyncio
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from bench import four_bar, machines, studio, timing, write_page
from bench.__main__ import main
from bench.families import measured
from bench.page import as_markdown, as_text, curves, duration, write_pictures
from bench.timing import Family, Row, interleaved, mpmath, worst

FAMILY = Family(
    "cam",
    "Cams",
    "mm",
    "itself",
    (
        Row("closed", 10, 5.0, 1e-15, 1.0),
        Row("Newton, 2 steps", 10, 9.0, 1e-4, 2.0),
        Row("whole", 1, 2e6, math.nan, 9.0),
    ),
    ("a note",),
)


@pytest.mark.slow
def test_unloading_family_shows_the_errors_of_its_methods(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(timing, "interleaved", lambda runs, *_: [1.0] * len(runs))
    error = {row.method: row.error for row in measured("unloading", quick=True).rows}
    assert error["quadrature, 16 nodes"] < 1e-15 < error["quadrature, 4 nodes"] < 1e-6
    assert 1e-4 < error["the dissertation's iteration, 20 steps"] < 1e-3  # the figure of its docstring: 8e-4


@pytest.mark.slow
def test_loads_family_shows_what_the_textbook_leaves_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(timing, "interleaved", lambda runs, *_: [1.0] * len(runs))
    monkeypatch.setattr("bench.loads.KINDS", ("loaded_feed",))
    error = {row.method: row.error for row in measured("loads", quick=True).rows}
    exact = ("three-gear-four-bar: all forces", "flywheel, exact with J(phi)", "motor, periodic by Newton")
    assert all(error[name] < 1e-13 for name in exact)
    assert error["residual after a cycloid"] < 1e-12
    assert error["flywheel, textbook"] > 0.05
    assert 1e-6 < error["three-gear-four-bar: torque, J' by differences"] < 1e-3


def _errors(name: str, monkeypatch: pytest.MonkeyPatch) -> dict[str, float]:
    monkeypatch.setattr(timing, "interleaved", lambda runs, *_: [1.0] * len(runs))
    return {f"{row.method}, {row.size}": row.error for row in measured(name, quick=True).rows}


@pytest.mark.slow
def test_planar_family_shows_what_differences_cost(monkeypatch: pytest.MonkeyPatch) -> None:
    error = _errors("planar", monkeypatch)
    assert max(error["course, order 2, 1"], error["course, order 2, 360"]) < 1e-13
    assert error["textbook dyads, FFT, 360"] < 1e-9 < error["textbook dyads, numpy.gradient, 360"] < 1e-2
    assert 1e-6 < error["scipy fsolve and differences, step 0.01, 360"] < 1e-3


@pytest.mark.slow
def test_cam_size_family_shows_what_a_scan_misses(monkeypatch: pytest.MonkeyPatch) -> None:
    error = _errors("cam-size", monkeypatch)
    exact = ("best offset: corner of the exact limits, 1", "curvature radius: largest root at each cam angle, 1")
    assert all(error[name] < 1e-12 for name in exact)
    assert 1e-3 < error["scipy over the offset, step 4, 1"] < error["textbook scan of offsets, step 4, 1"] < 4.0
    assert 1e-4 < error["scipy brentq of the least radius, step 1, 1"] < 1e-1


@pytest.mark.slow
def test_crank_rocker_family_shows_the_digits_of_a_flat_extreme(monkeypatch: pytest.MonkeyPatch) -> None:
    error = _errors("crank-rocker", monkeypatch)
    assert error["swing: root of the cubic, 1"] < 1e-15
    assert (
        1e-10 < error["scipy minimize_scalar, to 1e-12, 1"] < 1e-6 < error["textbook scan of couplers, step 0.001, 1"]
    )


@pytest.mark.slow
def test_cam_samples_family_finds_together_what_each_finds_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    error = _errors("cam-samples", monkeypatch)
    assert max(error["searches together, 256"], error["one by one, 16"]) < 1e-13
    assert 1e-5 < error["textbook scan, step 1 deg, 256"] < 1e-2


@pytest.mark.slow
def test_drum_samples_family_shows_what_the_development_omits(monkeypatch: pytest.MonkeyPatch) -> None:
    error = _errors("drum-samples", monkeypatch)
    assert max(error["searches together, 256"], error["one by one, 16"]) < 1e-13
    assert 1e-7 < error["textbook scan, step 1 deg, 256"] < 1e-4 < error["textbook development, 0.25 deg, 256"] < 0.1


@pytest.mark.slow
def test_machines_family_sums_the_torques_of_formulas(monkeypatch: pytest.MonkeyPatch) -> None:
    error = _errors("machines", monkeypatch)
    assert error["torque of the machine, 1"] < 1e-13
    assert error["phases: tightest circle of relations, 1"] < 1e-9
    assert 1e-8 < error["textbook differences of the motion, step 0.001, 1"] < 1e-5
    assert 0.01 < error["textbook crank with two harmonics, 1"] < 0.1
    assert abs(float(machines.margin(machines.by_milp())) - machines.MARGIN) < 1e-9


@pytest.mark.slow
def test_planar_samples_family_finds_at_once_what_each_finds_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    error = _errors("planar-samples", monkeypatch)
    assert max(error["at once, 256"], error["one by one, 3"]) < 1e-12
    assert 1e-6 < error["textbook scan, 360 positions, 256"] < 1e-2


@pytest.mark.slow
def test_motion_laws_family_shows_what_lies_between_the_places(monkeypatch: pytest.MonkeyPatch) -> None:
    error = _errors("motion-laws", monkeypatch)
    assert 0.0 < error["optimal law, proved, 1"] < 1e-5 < error["scipy linprog, 100 places, 1"] < 1e-2
    assert error["residual: Gauss panels, 1"] < 1e-13
    assert 1e-6 < error["textbook trapezoids, 400 places, 1"] < 1e-4
    assert error["scipy solve_ivp, to 1e-06, 1"] < 1e-5


def test_wrong_family_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(["five-bar"])
    assert "the families are four-bar" in capsys.readouterr().err


def test_reference_of_the_four_bar_is_the_loop_itself() -> None:
    mp = mpmath(30)
    a, b, c, d = (mp.mpf(x) for x in (18.0, 50.0, 100.0, 121.4))
    for phi in (0.3, 2.0, -4.0):
        x, y, speed, _ = four_bar.reference(phi)
        opening = abs(d + c * mp.mpc(x, y) - a * mp.expj(mp.mpf(phi))) - b
        assert abs(opening) < mp.mpf(10) ** -27
        step = mp.mpf(10) ** -10
        further = four_bar.reference(phi)[:2]
        assert further == (x, y)
        assert abs(speed) < 1 + step


def test_textbook_rival_and_march_agree_with_the_reference() -> None:
    phi = np.sort(four_bar.positions(50))
    # textbook forms keep 14 digits on this linkage; a march to 1e-12 ends with a step far below
    assert four_bar.error_of(lambda: four_bar.textbook(four_bar.LINKAGE, phi), "textbook", phi) < 100
    assert four_bar.error_of(lambda: four_bar.march(phi, 1e-12), "Newton with", phi) < 100


@pytest.mark.slow
def test_pages_hold_every_row(tmp_path: Path) -> None:
    machine = timing.machine()
    for page in (as_text([FAMILY], machine), as_markdown([FAMILY], machine)):
        assert all(text in page for text in ("closed", "5 ns", "2 ms", "1e-15", "a note", machine["numpy"]))
    alone = {"closed": [(5.0, 1e-15)], "Newton, 2 steps": [(9.0, 1e-4)]}
    assert curves(FAMILY) == alone
    stepped = replace(FAMILY, rows=(*FAMILY.rows, Row("Newton, 3 steps", 10, 12.0, 1e-8, 2.5)))
    assert curves(stepped) == {"closed": [(5.0, 1e-15)], "Newton": [(9.0, 1e-4), (12.0, 1e-8)]}
    said: list[str] = []
    assert write_pictures([FAMILY], tmp_path, said.append) == {"cam": "bench-cam.png"}
    assert (tmp_path / "bench-cam.png").stat().st_size > 10_000
    assert said


def test_times_are_of_one_call_each() -> None:
    calls = [0, 0]

    def count(i: int) -> None:
        calls[i] += 1

    fast, slow = interleaved([lambda: count(0), lambda: [count(1) for _ in range(200)]], 3)
    assert 0.0 < fast < slow
    assert duration(999.0) == "999 ns"


def test_errors_are_in_units_of_the_last_place() -> None:
    mp = mpmath(30)
    assert worst([1.0 + 2**-52], [mp.mpf(1)]) == 1.0


@pytest.mark.slow
def test_yields_family_shows_what_scrambled_points_are_worth(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(timing, "interleaved", lambda runs, *_: [1.0] * len(runs))
    error = {row.method: row.error for row in measured("yields", quick=True).rows}
    for name, share in (("four-branch", 0.00222), ("RP22", 0.00421)):
        textbook = math.sqrt((1.0 - share) / (share * 2**14))
        assert 0.5 * textbook < error[f"{name}, random points"] < 2.0 * textbook
        assert error[f"{name}, scrambled points"] < textbook


def test_one_family_is_renewed_on_the_page_and_all_else_stays() -> None:
    page = (Path(__file__).parents[2] / "docs" / "benchmarks.md").read_text(encoding="utf-8")
    rows = tuple(Row(f"{what}: key results", 1, 60e6, math.nan, 9.0) for what in studio.SLIDERS)
    own = Family("studio", "Studio: from the input of a slider to what the page shows", "none", "reading", rows)
    found = write_page.renewed(page, {"studio": own}, write_page.goals(wide_vectors=True), {})
    lines = {line for line in page.splitlines() if line.startswith("| ") and "key results" not in line}
    assert {line for line in lines if "animation" not in line or "animate" in line} <= set(found.splitlines())
    assert found.count("| 50 ms | 60 ms | missed |") == 3
    assert found.count("| 120 ms | 60 ms | met |") == 1
    assert found.count("\n## ") == page.count("\n## ")


@pytest.mark.slow
@pytest.mark.parametrize("what", studio.SLIDERS)
def test_studio_times_the_numbers_of_another_design_each_time(what: str) -> None:
    name, key, values = studio.SLIDERS[what]
    loop = asyncio.new_event_loop()
    session = studio.session_of(loop, studio.designs() / name)
    shown = []
    for value in values:
        session.move(next(number.path for number in session.state.numbers if number.name == key), value)
        assert loop.run_until_complete(session.make())
        shown.append({name: [r.quantity.value for r in found] for name, found in session.state.results.items()})
    loop.close()
    assert shown[0] != shown[1]
