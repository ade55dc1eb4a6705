"""The quick tests of a copy of this checkout, where little is as usual: `make test-elsewhere`.

Its folder has a blank and an umlaut and is called gearlink, its user has no home, another locale, time zone and
terminal, files that only the user may read, a numpy without the processor's newer instructions and the linear algebra
of an old processor; the tests come in another order. What a test takes from these by mistake fails here, and not first
on somebody's machine.
"""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

ROOT = Path(__file__).resolve().parents[1]
LEFT_OUT = (".git", ".venv*", ".types", "*_cache", "__pycache__", ".hypothesis", "build", "dist", "*.egg-info")
OPTIONAL_FEATURES = """
from numpy._core import _multiarray_umath as numpy
print(*(name for name in numpy.__cpu_dispatch__ if numpy.__cpu_features__[name]))
"""
"""The names that NPY_DISABLE_CPU_FEATURES takes here: of another processor it warns, and warnings are errors."""


def environment(folder: Path, features: str) -> dict[str, str]:
    """What the tests find in their environment; `folder` is there already."""
    temporary = folder / "temporary files"
    temporary.mkdir()
    blas = {"OPENBLAS_CORETYPE": "Nehalem"} if platform.machine() in ("x86_64", "AMD64") else {}
    usual = {name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MAKELEVEL", "TERM")}
    hostile = {
        "HOME": str(folder / "nowhere"),
        "TMPDIR": str(temporary),
        "LANG": "tr_TR.UTF-8",
        "LC_ALL": "tr_TR.UTF-8",
        "TZ": "Pacific/Chatham",
        "COLUMNS": "40",
        "LINES": "10",
        "PYTHONHASHSEED": "4242",
        "NPY_DISABLE_CPU_FEATURES": features,
    }
    return usual | blas | hostile


def order() -> str:
    """Options of pytest-random-order: the same order every time, or with GEARLINK_SEEDS=random always another."""
    seed = int.from_bytes(os.urandom(3)) if os.environ.get("GEARLINK_SEEDS") == "random" else 1
    return f"--random-order-bucket=module --random-order-seed={seed}"


def main() -> int:
    with TemporaryDirectory(prefix="gearlink ") as folder:
        copy = Path(folder) / "Räder und Hebel" / "gearlink"
        shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(*LEFT_OUT))
        make = ["make", "--no-print-directory", f"PYTHON={sys.executable}", "VENV=.venv"]
        subprocess.run([*make, ".venv/.ready"], cwd=copy, check=True)
        asked = [copy / ".venv/bin/python", "-c", OPTIONAL_FEATURES]
        features = subprocess.run(asked, capture_output=True, text=True, check=True).stdout.strip()
        options = order()
        print(f"In {copy}, without {features or 'nothing'} of the processor, {options}:", flush=True)
        os.umask(0o077)
        hostile = environment(Path(folder), features)
        return subprocess.run([*make, "test", f"OPTIONS={options}"], cwd=copy, env=hostile).returncode


if __name__ == "__main__":
    sys.exit(main())
