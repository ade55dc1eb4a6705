"""A Dask cluster that runs already, as an ordinary executor, all of whose workers have this program."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from gearlink.cli.program import program
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic

_SECONDS = 20


@contextmanager
def client(address: str) -> Iterator[Any]:
    """A client of a Dask scheduler, all of whose workers have this program.

    Raises
        DesignFileError - GL115 where none can be had, GL158 for a worker with another program
    """
    try:
        make: Any = import_module("distributed").Client
    except ImportError:
        message = "--dask needs the package distributed: pip install distributed"
        raise _refused("GL115", message, "--dask") from None
    try:
        made = make(address, timeout=_SECONDS)
    except (OSError, ValueError) as error:
        raise _refused("GL115", f"no Dask scheduler answers at {address}: {error}", address) from None
    except Exception as error:  # what another server says is no message of Dask: MemoryError for its size, and others
        message = f"what answers at {address} is no Dask scheduler ({type(error).__name__})"
        remedy = "`dask scheduler` prints the address; that of its dashboard is another"
        raise _refused("GL115", message, address, remedy) from None
    with made:
        own = program()
        for worker, theirs in made.run(program).items():
            for name, version in own.items():
                if theirs.get(name) != version:
                    message = f"the worker {worker} has {name} {theirs.get(name)}; this is {version}"
                    raise _refused("GL158", message, address, "install the same versions on every worker")
        yield made


def _refused(code: str, message: str, key: str, help: str = "") -> DesignFileError:
    return DesignFileError([Diagnostic(code, message, file="<--dask>", key=key, help=help)])
