"""A Dask cluster: the same bytes as in one process, with a worker killed on the way. Needs the package distributed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
import yaml

from gearlink.cli.parallel import shares as clusters
from gearlink.cli.reading.diagnostics import DesignFileError

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


@pytest.mark.slow
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


@pytest.mark.slow
def test_no_scheduler_is_said(gearlink: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    study = tmp_path / "study.yaml"
    study.write_text(yaml.safe_dump(STUDY, sort_keys=False))
    monkeypatch.setattr("gearlink.cli.parallel.shares._SECONDS", 1)
    ended = gearlink("explore", study, "--dask", "tcp://127.0.0.1:9", "--format", "json")
    assert (ended.status, ended.json["errors"][0]["code"]) == (2, "GL115")


# What a client is asked, by a client of our own


class Client:
    """A client of `distributed` whose workers run these programs."""

    programs: list[dict[str, str]] = []
    answers: bool | Exception = True

    def __init__(self, address: str, timeout: int) -> None:
        if isinstance(self.answers, Exception):
            raise self.answers
        if not self.answers:
            raise OSError("timed out")
        self.address, self.timeout, self.open = address, timeout, False

    def __enter__(self) -> Client:
        self.open = True
        return self

    def __exit__(self, *_: object) -> None:
        self.open = False

    def run(self, function: Any) -> dict[str, dict[str, str]]:
        assert function is clusters.program
        return {f"tcp://w{i}": found for i, found in enumerate(self.programs)}


@pytest.fixture
def distributed(monkeypatch: pytest.MonkeyPatch) -> type[Client]:
    made = type("Client", (Client,), {})
    monkeypatch.setitem(sys.modules, "distributed", SimpleNamespace(Client=made))
    return made


def refusal(address: str) -> Any:
    with pytest.raises(DesignFileError) as refused, clusters.client(address):
        pass
    (found,) = refused.value.diagnostics
    return found


def test_workers_with_the_same_program_are_taken(distributed: type[Client]) -> None:
    distributed.programs = [clusters.program(), clusters.program()]
    with clusters.client("tcp://here:1") as client:
        assert (client.address, client.timeout, client.open) == ("tcp://here:1", 20, True)
    assert not client.open


@pytest.mark.parametrize("name", ["gearlink", "python", "numpy", "scipy", "cpu"])
def test_a_worker_with_another_program_is_refused(distributed: type[Client], name: str) -> None:
    """Last bits depend on each of them."""
    own = clusters.program()
    distributed.programs = [own, {**own, name: "another"}]
    found = refusal("tcp://here:1")
    assert (found.code, found.key) == ("GL158", "tcp://here:1")
    assert found.message == f"the worker tcp://w1 has {name} another; this is {own[name]}"
    assert "same versions" in found.help


def test_where_no_client_can_be_had(distributed: type[Client], monkeypatch: pytest.MonkeyPatch) -> None:
    distributed.answers = False
    found = refusal("tcp://there:2")
    assert (found.code, found.key) == ("GL115", "tcp://there:2")
    assert found.message == "no Dask scheduler answers at tcp://there:2: timed out"
    monkeypatch.setitem(sys.modules, "distributed", None)  # not installed
    found = refusal("tcp://there:2")
    assert (found.code, found.key) == ("GL115", "--dask")
    assert "pip install distributed" in found.message


def test_another_server_is_no_lack_of_memory(distributed: type[Client]) -> None:
    """The first eight bytes of a web server's answer are the size of a message: of 3 EiB."""
    distributed.answers = MemoryError((3543824036068086856,))
    found = refusal("tcp://there:8787")
    assert (found.code, found.key) == ("GL115", "tcp://there:8787")
    assert found.message == "the server at tcp://there:8787 is not a Dask scheduler (MemoryError)"
    assert "dashboard" in found.help
