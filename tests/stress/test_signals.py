"""A batch that is killed in the middle: no worker outlives it, readers get their end, results are whole or absent."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytestmark = [pytest.mark.stress, pytest.mark.skipif(sys.platform != "linux", reason="forked processes")]
DESIGNS = Path(__file__).resolve().parents[2] / "designs"


def _heed_signals() -> None:
    """A runner in the background, or under nohup, hands ignored signals down to its children."""
    for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGINT):
        signal.signal(number, signal.SIG_DFL)


@pytest.mark.parametrize("seconds", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP", "SIGQUIT", "SIGINT", "SIGKILL"])
def test_a_killed_batch(tmp_path: Path, name: str, seconds: float) -> None:
    """Killed so long after the first result of a worker, which are those of the files that are not in the sample."""
    files, out = tmp_path / "files", tmp_path / "out"
    files.mkdir()
    for i in range(800):
        (files / f"t{i:03}.yaml").write_text((DESIGNS / "ty460.yaml").read_text())
    command = [sys.executable, "-m", "gearlink.cli.main", "batch", str(files), "-j", "3", "--out", str(out), "-q"]
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        preexec_fn=_heed_signals,
    ) as batch:
        while not list(out.rglob("t001-*.json")):
            assert batch.poll() is None
            time.sleep(0.02)
        time.sleep(seconds)
        batch.send_signal(getattr(signal, name))
        sent = time.monotonic()
        _, talk = batch.communicate(timeout=60.0)
        assert time.monotonic() - sent < 20.0
    assert batch.returncode == (130 if name == "SIGINT" else -getattr(signal, name))
    assert b"Traceback" not in talk
    written = [path for path in out.rglob("*") if path.is_file()]
    assert 0 < len([json.loads(path.read_text()) for path in written if path.suffix == ".json"]) < 2400
    assert name == "SIGKILL" or not [path for path in written if path.name.startswith(".")]
