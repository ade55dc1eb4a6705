"""The same four-bar by pylinkage and mechanism, timed in their own environment; prints JSON for bench/write_page.py.

Run by `make bench` with bench/.venv, which holds pylinkage, numba and mechanism and nothing of gearlink.
"""

from __future__ import annotations

import contextlib
import importlib.metadata
import io
import json
import math
import statistics
import subprocess
import sys
import time
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np

CRANK, COUPLER, ROCKER, FRAME = 18.0, 50.0, 100.0, 121.4
STARTS = {
    "pylinkage": "import pylinkage",
    "mechanism": "import mechanism",
}


def main() -> None:
    """Measure and print."""
    warnings.simplefilter("ignore")
    sizes = [int(text) for text in sys.argv[1:]] or [360, 3600, 100_000]
    rows = []
    for size in sizes:
        base = timed(lambda n=size: numpy_pass(n), 5)
        ways = {"pylinkage (numba)": pylinkage_fast}
        if size <= 3600:
            ways["pylinkage (python)"] = pylinkage_python
            ways["mechanism"] = mechanism_sweep
        for name, way in ways.items():
            with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
                points = way(size)
                took = timed(lambda run=way, n=size: run(n), 1 if name == "mechanism" else 3)
            each = took / size
            rows.append(
                {"method": name, "size": size, "nanoseconds": 1e9 * each, "error": error(points), "ratio": took / base}
            )
    packages = {name: importlib.metadata.version(name) for name in ("pylinkage", "numba", "mechanism", "numpy")}
    print(
        json.dumps({"versions": packages, "rows": rows, "starts": {name: start(code) for name, code in STARTS.items()}})
    )


def timed(run: Callable[[], object], rounds: int) -> float:
    """Median seconds of a call, after a first one that compiles and warms up."""
    run()
    taken = []
    for _ in range(rounds):
        begun = time.perf_counter()
        run()
        taken.append(time.perf_counter() - begun)
    return statistics.median(taken)


def numpy_pass(size: int) -> None:
    """The pass that the program's own tables divide by."""
    x = np.linspace(-3.0, 3.0, size)
    sine, cosine = np.sin(x), np.cos(x)
    np.arctan2(sine, cosine)
    np.sqrt(sine * sine)


def start(code: str) -> float:
    """Median seconds of a process that imports a package and ends."""
    taken = []
    for _ in range(5):
        begun = time.perf_counter()
        subprocess.run([sys.executable, "-c", code], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        taken.append(time.perf_counter() - begun)
    return statistics.median(taken)


def pylinkage_linkage(size: int) -> Any:
    """The four-bar as a pylinkage Linkage whose crank makes one revolution in `size` steps."""
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import RRRDyad
    from pylinkage.simulation import Linkage

    left, right = Ground(0.0, 0.0, name="A"), Ground(FRAME, 0.0, name="D")
    crank = Crank(anchor=left, radius=CRANK, angular_velocity=2.0 * math.pi / size, initial_angle=0.0, name="B")
    pin = RRRDyad(anchor1=crank.output, anchor2=right, distance1=COUPLER, distance2=ROCKER, name="C", x=34.0, y=48.0)
    linkage = Linkage([left, right, crank, pin], name="four-bar")
    linkage.set_input_velocity(crank, 2.0 * math.pi / size, 0.0)
    return linkage


def pylinkage_fast(size: int) -> Any:
    """Crank pin and coupler pin with velocities and accelerations, by the compiled path."""
    positions, _, _ = pylinkage_linkage(size).step_fast_with_kinematics(iterations=size, dt=1.0)
    return positions[:, -2] + 0.0, positions[:, -1] + 0.0


def pylinkage_python(size: int) -> Any:
    """The same by its generator."""
    states = [state[0] for state in pylinkage_linkage(size).step_with_derivatives(iterations=size, dt=1.0)]
    positions = np.array([[tuple(point) for point in state] for state in states], dtype=float)
    return positions[:, -2], positions[:, -1]


def mechanism_sweep(size: int) -> Any:
    """Positions, velocities and accelerations by mechanism's fsolve at every position."""
    from mechanism import Mechanism, Vector, get_joints

    a, b, c, d = get_joints("A B C D")
    crank, coupler = Vector((a, b), r=CRANK), Vector((b, c), r=COUPLER)
    rocker, frame = Vector((d, c), r=ROCKER), Vector((a, d), r=FRAME, theta=0, style="ground")

    def loops(x: Any, i: float) -> Any:
        return crank(i) + coupler(x[0]) - frame() - rocker(x[1])

    theta = np.linspace(0.0, 2.0 * math.pi, size, endpoint=False)
    ones, zeros = np.ones(size), np.zeros(size)
    guess = (np.radians([72.0, 151.6]), np.array([-0.17, -0.17]), np.array([0.05, 0.05]))
    made = Mechanism(
        vectors=(crank, coupler, frame, rocker), origin=a, loops=loops, pos=theta, vel=ones, acc=zeros, guess=guess
    )
    made.iterate()
    return np.column_stack((b.x_positions, b.y_positions)), np.column_stack((c.x_positions, c.y_positions))


def error(points: Any) -> float:
    """Maximum relative error of the coupler pin for the crank pin that the package itself gives, in 30 digits."""
    import mpmath as mp

    mp.mp.dps = 30
    worst = 0.0
    b_points, c_points = points
    for i in np.linspace(0, len(c_points) - 1, 40).astype(int):
        v = mp.mpc(FRAME) - mp.mpc(*b_points[i])
        n = abs(v)
        along = (mp.mpf(COUPLER) ** 2 - n**2 - mp.mpf(ROCKER) ** 2) / (2 * n * ROCKER)
        across = mp.sqrt(1 - along**2)
        both = [FRAME + ROCKER * v / n * mp.mpc(along, side * across) for side in (1, -1)]
        found = mp.mpc(*c_points[i])
        worst = max(worst, float(min(abs(found - point) for point in both)) / ROCKER)
    return worst


if __name__ == "__main__":
    main()
