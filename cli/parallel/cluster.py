"""A Dask cluster that runs already, as an ordinary executor; and what two programs must share to give one result."""

from __future__ import annotations

import platform
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.core.version import VERSION

_SECONDS = 20


def processor() -> str:
    """The type of this processor, as far as last bits of numbers depend on it."""
    import numpy as np

    core = "_core" if int(np.__version__.partition(".")[0]) > 1 else "core"
    features = import_module(f"numpy.{core}._multiarray_umath").__cpu_features__
    wide = next((name for name in ("AVX512_SKX", "AVX512F", "AVX2", "SVE", "ASIMD") if features.get(name)), "")
    return f"{platform.machine()} {wide}".strip()


def program() -> dict[str, str]:
    """What last bits of numbers depend on."""
    import numpy as np

    return {"gearlink": VERSION, "numpy": np.__version__, "cpu": processor()}


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
