"""The entry point: the quick answers, the mapping of every end to an exit status."""

from __future__ import annotations

import gc
import io
import os
import sys

from gearlink.cli import process
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite, leave_nothing_behind
from gearlink.cli.printable import visible

_STANDARD_OUTPUT = 1
_LEAST_MEMORY = 500 << 20
"""Below it some commands cannot load their libraries."""
_COMPLETES = "_GEARLINK_COMPLETE"
_NO_READER_OF_WINDOWS = 22
"""EINVAL: what a pipe says there whose reader has gone; elsewhere that is a BrokenPipeError."""
_HEEDS_ESCAPES = 4
"""ENABLE_VIRTUAL_TERMINAL_PROCESSING of a Windows console."""
_MOST_DIGITS = 9
"""Of the size of a terminal."""

TYPE_CHECKING = False  # as typing has it, whose import takes longer than --version
if TYPE_CHECKING:
    from typing import Any, TextIO


def main() -> None:
    """Run gearlink on the process's arguments and leave with its exit status."""
    try:
        _prepare_process()
        if not _asks_version(sys.argv[1:]):
            leave_nothing_behind()
        sys.stdout, sys.stderr = _output(sys.stdout, BrokenPipeError), _output(sys.stderr, OSError)
        status = run(sys.argv[1:])
    except KeyboardInterrupt:  # before the command has begun, or after its end
        status = ExitCode.INTERRUPTED
    gc.freeze()  # else the interpreter walks all that it has loaded several times before it ends: a sixth of a command
    sys.exit(status)


def _prepare_process() -> None:
    """Leave out what costs time at the start of a process and serves nothing here.

    The collector would walk the modules and the parts of a picture over and over while they are made: a twelfth of
    a report's time; workers, studies and samples collect as Python does, a batch and a machine's forces call it
    themselves once there is something to free. And pydantic
    would read the metadata of every installed package in search of plug-ins. Pictures are drawn into files,
    whatever backend the user's environment names, and a wrong name must not keep matplotlib from loading. The
    matrices here are too small for threads, and those of OpenBLAS wait for ever where the memory of the process is
    limited. A size of the terminal that is no size counts as none.
    """
    process.collect_rarely()
    if os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "1") == "1":
        _leave_plugins_out()
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    os.environ["MPLBACKEND"] = "agg"
    for name in ("COLUMNS", "LINES"):
        if (size := os.environ.get(name, "")).isdigit() and not (size.isdecimal() and len(size) <= _MOST_DIGITS):
            del os.environ[name]  # rich takes 2 squared for a number, and so many digits that Python refuses them


class _NoPlugins(type(sys)):  # type: ignore[misc]  # the class of modules
    """Stands for pydantic's finder of plug-ins and finds none; what else is asked of it, the finder itself gives."""

    get_plugins = tuple

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        from importlib import import_module

        if sys.modules.get(self.__name__) is self:
            del sys.modules[self.__name__]
        return getattr(import_module(self.__name__), name)


def _leave_plugins_out() -> None:
    """Have pydantic find no plug-ins: even where it is told to, it imports what reads the metadata of packages, with
    email, sockets and archives, which takes a tenth of a command."""
    sys.modules.setdefault("pydantic.plugin._loader", _NoPlugins("pydantic.plugin._loader"))


class _Output(io.FileIO):
    """A stream of the process that drops what it cannot write: silently where the reason is one that it ignores.

    The exit status is the design's, whether or not the reader of a pipe stays to the end and wherever notes go.
    """

    ignored: type[OSError]

    def write(self, data: Any) -> int:
        try:
            return super().write(data)
        except OSError as error:
            os.dup2(os.open(os.devnull, os.O_WRONLY), self.fileno())  # for this and the interpreter's last flush
            if isinstance(error, self.ignored) or (sys.platform == "win32" and error.errno == _NO_READER_OF_WINDOWS):
                process.output_is_read = process.output_is_read and self.fileno() != _STANDARD_OUTPUT
                return len(data)
            raise OSError(error.errno, f"standard output cannot be written: {error.strerror}") from None


def _output(stream: TextIO, ignored: type[OSError]) -> TextIO:
    if stream is None or (sys.platform == "win32" and stream.isatty()):
        # Closed by the parent; or a console of Windows, whose stream alone shows every sign: bytes of a descriptor are
        # taken there for those of an old code page.
        if stream is not None:
            _heed_escapes(stream.fileno())
        return stream
    raw = _Output(stream.fileno(), "w", closefd=False)
    raw.ignored = ignored
    return io.TextIOWrapper(io.BufferedWriter(raw), encoding=stream.encoding, line_buffering=stream.isatty())


def _heed_escapes(number: int) -> None:
    """Let a console of Windows 10 and later heed the codes of colours and of a line that is taken back."""
    import ctypes

    kernel: Any = ctypes.windll.kernel32  # type: ignore[attr-defined]
    handle, mode = kernel.GetStdHandle(-10 - number), ctypes.c_ulong()
    if kernel.GetConsoleMode(handle, ctypes.byref(mode)):
        kernel.SetConsoleMode(handle, mode.value | _HEEDS_ESCAPES)


def run(arguments: list[str]) -> int:
    """Exit status of a command line; every way out is mapped here, and none shows a traceback."""
    _replace_closed_streams()
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")
    try:
        status = _invoke(arguments)
        sys.stdout.flush()
        return status
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return ExitCode.INTERRUPTED
    except Exception as fault:
        if _COMPLETES in os.environ:  # asked in another form than the shells' scripts ask: there is nothing to offer
            return ExitCode.WRONG_INPUT
        return _fault(fault)


def _replace_closed_streams() -> None:
    """Give the process the streams that its parent closed: an empty input, outputs that nobody reads."""
    if sys.stdin is None:
        sys.stdin = open(os.devnull, encoding="utf-8")  # noqa: SIM115 - open as long as the process
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115


def _invoke(arguments: list[str]) -> int:
    if _asks_version(arguments):
        from gearlink.core.version import VERSION

        print(f"gearlink {VERSION}")
        return ExitCode.OK
    if (limit := _memory_limit()) < _LEAST_MEMORY:
        print(
            f"error: the memory of this process is limited to {limit >> 20} MB (ulimit -v): gearlink needs "
            f"{_LEAST_MEMORY >> 20} MB",
            file=sys.stderr,
        )
        return ExitCode.WRONG_INPUT
    if _COMPLETES not in os.environ:  # else a shell asks for completions
        from gearlink.cli.quick import plain_line, plain_reference, run_line, run_reference

        if line := plain_line(arguments):
            return run_line(*line)
        if words := plain_reference(arguments):
            return run_reference(*words)
    from gearlink.cli.app import invoke

    return invoke(arguments)


def _asks_version(arguments: list[str]) -> bool:
    return arguments in (["--version"], ["-V"])


def _memory_limit() -> int:
    """How many bytes the process may map; libraries end it with a status of their own where these do not suffice."""
    try:
        import resource
    except ImportError:  # not on this system
        return _LEAST_MEMORY
    limit = resource.getrlimit(resource.RLIMIT_AS)[0]
    return _LEAST_MEMORY if limit == resource.RLIM_INFINITY else limit


def _fault(fault: Exception) -> int:
    if isinstance(fault, OSError):
        where = f"{fault.filename}: " if fault.filename else ""
        print(f"error: {visible(f'{where}{fault.strerror or fault}')}", file=sys.stderr)
        return ExitCode.WRONG_INPUT
    if isinstance(fault, MemoryError):
        print("error: out of memory\n  help: reduce rows, samples or --jobs, or increase the limit", file=sys.stderr)
        return ExitCode.WRONG_INPUT
    if isinstance(fault, CannotWrite):
        what, _, remedy = str(fault).partition("\n")
        print(f"error: {visible(what)}" + (f"\n  help: {visible(remedy)}" if remedy else ""), file=sys.stderr)
        return ExitCode.WRONG_INPUT
    if os.environ.get("GEARLINK_TRACEBACK"):
        import traceback

        traceback.print_exception(fault)
    print(
        f"gearlink: fault of the program: {type(fault).__name__}: {visible(str(fault))}\n"
        "  Please report it with the design file; GEARLINK_TRACEBACK=1 shows where it arose.",
        file=sys.stderr,
    )
    return ExitCode.FAULT


if __name__ == "__main__":
    main()
