"""The exit status of every command."""

from enum import IntEnum


class ExitCode(IntEnum):
    """What a script can rely on."""

    OK = 0  # all checks pass, warnings allowed
    FINDING = 1  # the design was computed and a check fails
    WRONG_INPUT = 2  # command line or design file wrong, or no such mechanism exists
    FAULT = 3  # a fault of the program itself
    INTERRUPTED = 130
