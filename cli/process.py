"""How a process of the command ends, how often it collects garbage, and how many processors it may use."""

import gc
import os
import sys

TYPE_CHECKING = False  # as typing has it
if TYPE_CHECKING:
    from collections.abc import Callable

output_is_read = True
"""False once the reader of a pipe on standard output has gone: what is written there from then on is lost."""

before_the_end: "list[Callable[[], None]]" = []
"""What is done first where a signal ends the process: unfinished files are removed, a line of progress is wiped out."""

_INTERRUPTED = 130


def end_at_interrupt() -> None:
    """From now on Ctrl-C ends this process with status 130 and one line, whatever it is doing.

    Notes
        Python's own way, an exception, is lost or becomes another error where it meets the loading of a library, a
        callback of compiled code or of a weak reference. It stays where Python code has imported gearlink; and what
        the parent of the process chose to ignore (nohup, a script's background) stays ignored.
    """
    import _signal  # type: ignore[import-not-found]  # of Python; `signal` takes longer to load than --version to answer

    if _signal.getsignal(_signal.SIGINT) not in (_signal.default_int_handler, _signal.SIG_DFL):
        return
    own = os.getpid()

    def end(_number: int, _frame: object) -> None:
        if os.getpid() == own:  # not a process that was forked a moment ago: the files and the word are the parent's
            do_before_the_end()
            say_interrupted()
        os._exit(_INTERRUPTED)

    _signal.signal(_signal.SIGINT, end)


def do_before_the_end() -> None:
    """Call each of `before_the_end`."""
    for call in tuple(before_the_end):
        call()


def say_interrupted() -> None:
    """Say so on standard error, past its stream, which may be in the middle of writing."""
    if sys.stderr is None:  # closed by the parent: its number may be another file's
        return
    try:  # noqa: SIM105 - contextlib is not loaded yet, and a signal is no time for it
        os.write(2, b"interrupted\n")
    except OSError:
        pass


_RARELY = (400_000, 20, 100)
_pythons: "tuple[int, int, int] | None" = None
"""The collector's thresholds before `collect_rarely`."""


def collect_rarely() -> None:
    """Let the collector look for garbage after many more objects than Python has it."""
    global _pythons
    _pythons = gc.get_threshold()
    gc.set_threshold(*_RARELY)


def collect_as_python_does() -> None:
    """Take back `collect_rarely`: objects that know each other may be few and hold many MB."""
    if _pythons is not None:
        gc.set_threshold(*_pythons)


class WhileMuchIsComputed:
    """Collect as Python does as long as designs are computed, one after the other."""

    def __enter__(self) -> None:
        self._before = gc.get_threshold()
        collect_as_python_does()

    def __exit__(self, *_: object) -> None:
        gc.set_threshold(*self._before)


def processors() -> int:
    """Those that the system lets it run on, where it says so; else those of the machine."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1
