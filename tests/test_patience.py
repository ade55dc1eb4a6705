"""A test that waits for ever ends its run with the stacks of all threads."""

import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


@pytest.mark.slow
def test_a_test_that_waits_is_shown_and_ends_the_run(tmp_path: Path) -> None:
    for name in ("conftest.py", "sweeps.py"):
        shutil.copy(ROOT / "tests" / name, tmp_path)
    (tmp_path / "test_cases.py").write_text("import time\ndef test_it():\n    time.sleep(100.0)\n")
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--patience", "0.5"]
    command += ["-c", str(ROOT / "pyproject.toml"), "--rootdir", str(tmp_path), str(tmp_path / "test_cases.py")]
    ended = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, timeout=60)
    assert ended.returncode == (1 if sys.platform == "win32" else -signal.SIGALRM)
    assert "test_cases.py" in ended.stderr
    assert "in test_it" in ended.stderr
