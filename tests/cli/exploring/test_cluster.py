"""A Dask cluster: the same bytes as in one process, with a worker killed on the way. Needs the package distributed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml

pytestmark = pytest.mark.slow

STUDY: dict[str, Any] = {
    "kind": "study",
    "name": "cranks",
    "design": {"kind": "slider-crank", "stroke": 300, "rod": 500, "offset": 20},
    "variables": {
        "rod": {"from": 200, "to": 400, "step": 0.2},
        "offset": {"values": [0, 10, 20, 30]},
        "stroke": {"values": [280, 310]},
        "name": {"values": ["crank"]},  # a word, which no array form takes: chunks are those of design classes
    },
    "minimize": {"crank_length": "1 mm", "max_stroke": "20 mm"},
    "maximize": {"quick_return_ratio": 0.01},
    "checks": {"must_pass": "none"},
}


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as made:
        yield made


def run(*words: object) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "gearlink.cli", *map(str, words)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def test_explore_and_batch_on_a_cluster_that_loses_a_worker(cluster: Any, tmp_path: Path) -> None:
    study = tmp_path / "study.yaml"
    study.write_text(yaml.safe_dump(STUDY, sort_keys=False))
    alone, _ = run("explore", study, "-j", 1, "--format", "json", "-q").communicate()
    process = run("explore", study, "--dask", cluster.scheduler_address, "--format", "json", "-q")
    time.sleep(4.0)
    os.kill(next(iter(cluster.workers.values())).process.pid, signal.SIGKILL)
    out, err = process.communicate(timeout=120)
    assert process.returncode == 0, err
    assert out == alone
    process = run("batch", study, "--dask", cluster.scheduler_address, "--format", "json", "-q")
    out, err = process.communicate(timeout=120)
    assert process.returncode == 0, err
    assert '"result": "pass"' in out or '"result":"pass"' in out or '"warn"' in out


def test_no_scheduler_is_said(gearlink: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    study = tmp_path / "study.yaml"
    study.write_text(yaml.safe_dump(STUDY, sort_keys=False))
    monkeypatch.setattr("gearlink.cli.cluster._SECONDS", 1)
    ended = gearlink("explore", study, "--dask", "tcp://127.0.0.1:9", "--format", "json")
    assert (ended.status, ended.json["errors"][0]["code"]) == (2, "GL115")
