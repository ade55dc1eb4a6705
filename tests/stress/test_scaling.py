"""Sweeps in blocks up to ten million positions: the time of one position and the memory do not grow."""

from __future__ import annotations

import statistics
import subprocess
import sys
import tracemalloc
from collections.abc import Callable, Iterator
from pathlib import Path
from time import process_time

import numpy as np
import pytest

from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.numerics.arrays import BLOCK
from gearlink.core.parts.cams.profile import profile, translating
from gearlink.core.parts.linkages.fourbar import sweep as fourbar_sweep
from gearlink.core.parts.linkages.fourbar.position import FourBar
from tests.oracles.three_gear_output import output_motion

LINKAGE, TRAIN = FourBar(18.0, 50.0, 100.0, 121.4), GearTrain(20, 20, 60)
SIZES = (100_000, 1_000_000, 10_000_000)
ROUNDS = 3
GROWTH, MEGABYTES = 1.5, 4.0


def turn_blocks(samples: int) -> Iterator[np.ndarray]:
    """Angles that divide the turn into equal steps, a block at a time."""
    step = 2.0 * np.pi / samples
    for start in range(0, samples, BLOCK):
        yield np.arange(start, min(start + BLOCK, samples), dtype=np.float64) * step


def four_bar(count: int) -> float:
    """Maximum acceleration of the rocker, from angles, velocities and accelerations."""
    return max(fourbar_sweep.solve(LINKAGE, phi, 2).rocker_acceleration.max() for phi in turn_blocks(count))


def three_gears(count: int) -> float:
    """Minimum speed ratio of a three-gear four-bar."""
    return min(output_motion(LINKAGE, TRAIN, phi).speed_ratio.min() for phi in turn_blocks(count))


def cam(count: int) -> float:
    """Maximum pressure angle of a cam, with profile and curvature."""
    found = 0.0
    for theta in turn_blocks(count):
        cosine, sine = np.cos(2.0 * theta), np.sin(2.0 * theta)
        path = translating(50.0 - 10.0 * cosine, 20.0 * sine, 40.0 * cosine)
        found = max(found, float(profile(theta, path, sense=1, roller_radius=12.0).pressure_angle.max()))
    return found


SWEEPS: dict[str, Callable[[int], float]] = {f.__name__: f for f in (four_bar, three_gears, cam)}


def seconds_per_position(sweep: Callable[[int], float], count: int) -> float:
    """Processor time, so that other work on the machine counts less; small sweeps are repeated to ten times as much."""
    repeats = max(1, SIZES[1] // count)
    start = process_time()
    for _ in range(repeats):
        sweep(count)
    return (process_time() - start) / (repeats * count)


@pytest.mark.stress
@pytest.mark.parametrize("name", SWEEPS)
def test_time_grows_linearly(name: str) -> None:
    """All sizes in turn, round after round, and the medians of the rounds."""
    sweep = SWEEPS[name]
    rounds = [[seconds_per_position(sweep, count) for count in SIZES] for _ in range(ROUNDS)]
    times = [statistics.median(column) for column in zip(*rounds, strict=True)]
    shown = ", ".join(f"{1e9 * time:.0f} ns at {count:.0e}" for time, count in zip(times, SIZES, strict=True))
    print(f"\n{name}: {shown}")
    assert max(times) <= GROWTH * times[0]


MEASURE = """
import sys
sys.path.insert(0, {folder!r})
from stress.test_scaling import SIZES, SWEEPS
for count in (SIZES[0], SIZES[-1]):
    SWEEPS[{name!r}](count)
    with open("/proc/self/status") as status:
        print(next(line.split()[1] for line in status if line.startswith("VmHWM")))
"""


@pytest.mark.stress
@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="no /proc: getrusage would tell the parent's peak")
@pytest.mark.parametrize("name", SWEEPS)
def test_memory_of_the_process_stays(name: str) -> None:
    """Maximum resident memory of a process of its own, after 1e5 positions and after 1e7 more."""
    code = MEASURE.format(folder=str(Path(__file__).parents[1]), name=name)
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    few, many = (int(line) / 1024.0 for line in out.split())
    print(f"\n{name}: {few:.1f} MB after {SIZES[0]:.0e} positions, {many - few:.1f} MB more after {SIZES[-1]:.0e}")
    assert many - few <= MEGABYTES


def traced(sweep: Callable[[int], float], count: int) -> float:
    """Maximum memory in use during a sweep, in MB."""
    tracemalloc.start()
    sweep(count)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return peak / 2.0**20


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", SWEEPS)
def test_memory_in_use_stays(name: str) -> None:
    """A sweep of twenty blocks needs what one of four blocks needs."""
    few, many = (traced(SWEEPS[name], blocks * BLOCK) for blocks in (4, 20))
    assert many <= few + 0.1


@pytest.mark.parametrize("name", SWEEPS)
def test_blocks_find_the_same(name: str) -> None:
    """The extreme of a sweep of many blocks is that of a finer one, to the square of the step."""
    coarse, fine = SWEEPS[name](20_000), SWEEPS[name](60_000)
    assert coarse == pytest.approx(fine, abs=1e-6)
