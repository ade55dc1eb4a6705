"""`gearlink` and `python -m gearlink` begin here; nothing else imports this module.

Ctrl-C ends the process from the first line on, by the system's own way, and by the program's as soon as that is loaded.
"""

import _signal  # type: ignore[import-not-found]  # of Python; `signal` takes longer to load than all that follows

if _signal.getsignal(_signal.SIGINT) is _signal.default_int_handler:
    _signal.signal(_signal.SIGINT, _signal.SIG_DFL)

from gearlink.cli.process import end_at_interrupt

end_at_interrupt()

from gearlink.cli.main import main  # noqa: E402

if __name__ == "__main__":
    main()
