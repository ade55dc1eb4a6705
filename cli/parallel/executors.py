"""Executors beyond this machine's processes: one that a factory makes, or a Dask cluster's."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from gearlink.cli.parallel.cluster import client
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic

_WORKERS = 8  # of an executor that does not say


@contextmanager
def executor_of(factory: str, dask: str) -> Iterator[tuple[Callable[[], Executor], int]]:
    """What a command line names to compute by: what makes an executor, and how many workers that has at least.

    Raises
        DesignFileError - GL115 where it cannot be had, GL158 for a worker with another program
    """
    if factory and dask:
        raise _usage("--executor and --dask exclude each other", dask)
    if dask:
        with client(dask) as made:
            yield made.get_executor, max(1, len(made.ncores()))
    else:
        yield _factory(factory), _WORKERS


def _factory(name: str) -> Any:
    module, colon, function = name.partition(":")
    sys.path.insert(0, os.getcwd())
    try:
        with _theirs(name, "cannot be loaded"):
            made = getattr(import_module(module), function) if colon else None
    finally:
        sys.path.pop(0)
    if not callable(made):
        raise _usage(f"--executor {name!r} is not MODULE:FACTORY, a function that makes an executor", name)

    def make() -> Executor:
        with _theirs(name, "cannot make one"):
            executor = made()
        if not hasattr(executor, "submit"):
            raise _usage(f"--executor {name} makes no executor, but a {type(executor).__name__}", name)
        return executor  # type: ignore[no-any-return]

    return make


@contextmanager
def _theirs(name: str, words: str) -> Iterator[None]:
    """Code of the user's own, which may raise anything: a wrong command line, no fault of this program.

    Raises
        DesignFileError - GL115 with what was raised as its cause
    """
    try:
        yield
    except Exception as error:
        raise _usage(f"--executor {name} {words}: {type(error).__name__}: {error}", name) from error


def _usage(message: str, key: str) -> DesignFileError:
    return DesignFileError([Diagnostic("GL115", message, file="<--executor>", key=key)])
