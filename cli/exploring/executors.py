"""Executors beyond this machine's processes: one that a factory makes, or a Dask cluster's."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from gearlink.cli.exploring.computing import Means
from gearlink.cli.exploring.store import CannotStore, processor
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.core.version import VERSION

_SECONDS = 20


@contextmanager
def means_of(factory: str, dask: str) -> Iterator[Means]:
    """What a command line names to compute by.

    Raises
        DesignFileError - GL115 where it cannot be had
        CannotStore - GL158 for a worker with another program
    """
    if factory and dask:
        raise _usage("--executor and --dask exclude each other", dask)
    if dask:
        with _client(dask) as client:
            yield Means(executor=lambda: client.get_executor(), workers=max(1, len(client.ncores())))
    else:
        yield Means(executor=_factory(factory))


def _factory(name: str) -> Any:
    module, colon, function = name.partition(":")
    sys.path.insert(0, os.getcwd())
    try:
        made = getattr(import_module(module), function) if colon else None
    except (ImportError, AttributeError, ValueError) as error:
        raise _usage(f"--executor {name}: {error}", name) from None
    finally:
        sys.path.pop(0)
    if not callable(made):
        raise _usage(f"--executor {name!r} is not MODULE:FACTORY, a function that makes an executor", name)

    def make() -> Executor:
        executor = made()
        if not hasattr(executor, "submit"):
            raise _usage(f"--executor {name} makes no executor, but a {type(executor).__name__}", name)
        return executor  # type: ignore[no-any-return]

    return make


@contextmanager
def _client(address: str) -> Iterator[Any]:
    """A client of a Dask scheduler whose workers have this program."""
    try:
        from distributed import Client
    except ImportError:
        message = "--dask needs the package distributed: pip install 'gearlink-design[cluster]'"
        raise _usage(message, "--dask") from None
    try:
        client = Client(address, timeout=_SECONDS)
    except (OSError, ValueError) as error:
        raise _usage(f"no Dask scheduler answers at {address}: {error}", address) from None
    with client:
        _same_program(client)
        yield client


def _same_program(client: Any) -> None:
    own = program()
    for worker, theirs in client.run(program).items():
        for name, version in own.items():
            if theirs.get(name) != version:
                message = f"the worker {worker} has {name} {theirs.get(name)}; this is {version}"
                raise CannotStore("GL158", message, "install the same versions on every worker")


def program() -> dict[str, str]:
    """What last bits of numbers depend on."""
    import numpy as np

    return {"gearlink": VERSION, "numpy": np.__version__, "cpu": processor()}


def _usage(message: str, key: str) -> DesignFileError:
    return DesignFileError([Diagnostic("GL115", message, file="<command line>", key=key)])
