"""The exceptions of gearlink: everything the program raises on purpose is a GearlinkError."""

from __future__ import annotations

TYPE_CHECKING = False  # as typing has it, whose import takes longer than all of this module
if TYPE_CHECKING:
    from typing import Any, Literal, TypeVar

    Kind = TypeVar("Kind", bound="GearlinkError")

_MOST_CHARACTERS = 40  # of a name that a message repeats


class GearlinkError(Exception):
    """Base of every error that the user can repair.

    Attributes
        file : str - the design file; empty where there is none
        line, column : int - position of the key in it, from 1; 0 where it is not known
        key : str - dotted path of the key, "gears.module"; empty where it is not known
    """

    file = ""
    line = 0
    column = 0
    key = ""

    def __reduce__(self) -> tuple[object, ...]:
        """Between processes an error keeps what it says and where; a pool waits for ever for one that cannot travel."""
        return _again, (type(self), self.args, dict(vars(self)))


def _again(kind: type[Kind], args: tuple[object, ...], state: dict[str, object]) -> Kind:
    """An error as it was, whatever its class takes."""
    error = kind.__new__(kind, *args)
    vars(error).update(state)
    return error


def named(text: str) -> str:
    """A name that somebody gave, in quotation marks, as a message repeats it: a long one is cut.

    Example
        >>> named("gears.crank"), named("x" * 50)
        ("'gears.crank'", "'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...'")
    """
    return repr(text if len(text) <= _MOST_CHARACTERS else text[: _MOST_CHARACTERS - 3] + "...")


class NoSolution(GearlinkError):
    """No mechanism exists for the given numbers; raised when a quantity of it is read.

    Attributes
        message : str - value and limit, "stroke: 2000 mm (limit < 988.7 mm ...)"
        fix : str - the change that would help; empty where none is known
        key, file, line, column - as of GearlinkError
        code : str - "GL112"
    Notes
        `message` names the value and the limit, `fix` the change that would help, in the imperative. `key` is
        the dotted path of the design file's key to change; kernels, which know no design files, leave it empty
        and the design class adds it with `at_key`. A message of two lines is message and fix.
    """

    code = "GL112"

    fix = ""

    def __init__(self, message: str, *, key: str = "", fix: str = "") -> None:
        super().__init__(message)
        self.message, _, below = message.partition("\n")
        self.key = key
        self.fix = fix or below

    def __str__(self) -> str:
        return f"{self.message}; {self.fix}" if self.fix else self.message


class MissingSection(NoSolution):
    """The command needs a section that the design file does not have."""

    code = "GL113"


def section_of(spec: Any, name: str, words: str) -> Any:
    """A section of the file that a synthesis needs; `words` say what it holds.

    Raises
        MissingSection - where the file has it not
    Example
        >>> from types import SimpleNamespace
        >>> section_of(SimpleNamespace(dwell=None), "dwell", "angle (deg)")
        Traceback (most recent call last):
        ...
        gearlink.core.base.errors.MissingSection: this synthesis needs the section dwell: angle (deg)
    """
    value = getattr(spec, name)
    if value is None:
        raise MissingSection(f"this synthesis needs the section {name}: {words}", key=name)
    return value


def anew(error: NoSolution) -> NoSolution:
    """A stored refusal to be raised again, without the traceback of the first time.

    Notes
        Raised itself, it would keep every function that it has ever passed, with all that these held.
    Example
        >>> kept = NoSolution("too long", key="stroke")
        >>> (anew(kept).message, anew(kept).key), anew(kept) is kept
        (('too long', 'stroke'), False)
    """
    return _again(type(error), error.args, dict(vars(error)))


class at_key:
    """Give a NoSolution raised inside the block the design file's key, where it has none yet.

    Notes
        A class, since contextlib's generators cost as much as a quantity does.
    """

    __slots__ = ("_key",)

    def __init__(self, key: str) -> None:
        self._key = key

    def __enter__(self) -> None:
        return None

    def __exit__(self, _kind: object, error: object, _traceback: object) -> Literal[False]:
        if isinstance(error, NoSolution) and not error.key:
            error.key = self._key
        return False


class in_section(at_key):
    """Give a NoSolution raised inside the block the section of the design file in which its key stands."""

    __slots__ = ()

    def __exit__(self, _kind: object, error: object, _traceback: object) -> Literal[False]:
        if isinstance(error, NoSolution):
            inner, error.key = error.key, f"{self._key}.{error.key}" if error.key else self._key
            for end in (" ", "."):  # a fix that names the key, or one below it, does so by its whole path as well
                if inner:
                    error.fix = error.fix.replace(f"set {inner}{end}", f"set {error.key}{end}")
        return False
