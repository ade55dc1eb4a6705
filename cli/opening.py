"""Designs for Python: opened from a file or from keywords, changed, drawn; a refusal knows its place in the file."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from functools import cache
from numbers import Number
from threading import Lock
from typing import TYPE_CHECKING, Any, cast

from gearlink.cli.evaluate import named as with_name
from gearlink.cli.evaluate import require_command
from gearlink.cli.reading.design_file import load as load_file
from gearlink.cli.reading.design_file import parse, read_kind, validate, with_overrides
from gearlink.cli.reading.loaded_file import LoadedFile, parse_path
from gearlink.core.base.design import Design, UnknownName
from gearlink.core.base.errors import GearlinkError, NoSolution, named
from gearlink.core.base.kind import FileDesigns
from gearlink.core.base.kinds import KINDS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gearlink.core.base.report import Quantity

    class Shown(Quantity):
        """A quantity whose value is of the type that its name brings: a number, a text, a list."""

        value: Any

    class Opened(Design):
        """A design of some kind: type checkers know the methods of all, and take quantities by name for any type."""

        def __getattr__(self, name: str) -> Any: ...

        def quantity(self, name: str) -> Shown | Any:
            """None where it does not apply to this design; who asks for it by its name knows whether it does."""


_KEYWORDS = "<design>"
_one_at_a_time = Lock()
"""matplotlib's reader of formulas is one for all threads, and fails where two draw."""
Values = Mapping[str, Any]
"""Values by the dotted paths of a design file, as for `--set`: {"gears.crank": 42, "teeth[1]": 20}."""


def load(source: str | os.PathLike[str], values: Values | None = None, *, command: str | None = None) -> Opened:
    """Open the design of a file.

    Parameters
        source : str or os.PathLike - path of a design file (YAML)
        values : mapping of str to value, optional - values that replace those of the file, by dotted path
            ("gears.crank", "teeth[1]"), in the units of design files (mm, deg, 1/min)
        command : str, optional - a command of its kind, such as "analyze"; default: the first that the file specifies
    Returns
        design : Design - its quantities are attributes in mm, rad, N and s, computed when they are first read;
            `quantity`, `table` and `report` give them in the units of design files
    Raises
        GearlinkError - a file that cannot be read or is wrong, with the attributes file, line, column and key
        NoSolution - when a quantity is read of a mechanism that does not exist, with message, key and fix
        TypeError - `values` that are no mapping, a path or a command that is no text
    Example
        >>> press = load("designs/ty460.yaml")
        >>> round(press.crank_length, 6), press.quantity("crank_length").unit
        (154.211592, 'mm')
    """
    return _opened(load_file(os.fsdecode(source), overrides=_settings(values)), command)


def design(command: str | None = None, **keys: Any) -> Opened:
    """Make a design from the keys of a design file.

    Parameters
        command : str, optional - as for `load`
        **keys - the top keys of a design file, `kind` among them, in its units (mm, deg, 1/min); sections are
            dicts, lists may be tuples, ranges or arrays of shape (n,), numbers those of numpy, Decimal or Fraction
    Returns
        design : Design - as `load`
    Raises
        GearlinkError - as `load`; the lines are those of the keys written as JSON
        NoSolution - as `load`, when a quantity is read
        TypeError - a kind, a file or a dict in the place of the command
    Example
        >>> crank = design(kind="slider-crank", stroke=310, rod=520, offset=50)
        >>> round(crank.crank_length, 6)
        154.211592
    """
    if isinstance(command, str) and command in KINDS and "kind" not in keys:
        raise TypeError(f"{command} is a kind, not a command: write kind={command!r}")
    if isinstance(command, Mapping):
        raise TypeError("the keys of a design are keywords: write design(**keys)")
    if isinstance(command, (str, os.PathLike)) and os.fsdecode(command).endswith((".yaml", ".yml")):
        raise TypeError(f"{os.fsdecode(command)} is a file, not a command: write load({os.fsdecode(command)!r})")
    return _opened(parse(_keywords(keys).encode(), _KEYWORDS), command)


def changed(design: Design, values: Values) -> Opened:
    """Make a design like another with some values of its file changed; the other remains as it is.

    Parameters
        design : Design - made by `load`, `design` or `changed`
        values : mapping of str to value - as for `load`, in the units of design files
    Returns
        design : Design - a new one, for the same command
    Raises
        GearlinkError - as `load`
        TypeError - for a design that was made in another way, and so has no file
    Example
        >>> crank = load("designs/ty460_slider_crank.yaml")
        >>> round(changed(crank, {"stroke": 320}).crank_length - crank.crank_length, 3)
        4.969
    """
    loaded, command = _origin(design)
    return _opened(with_overrides(loaded, _settings(values)), command)


def figure(design: Design, command: str | None = None) -> Figure:
    """Draw the figure of a command (as `--plot`) with matplotlib.

    Parameters
        design : Design - made by `load`, `design` or `changed`
        command : str, optional - the command whose figure is drawn; default: the one that the design was opened for
    Returns
        figure : matplotlib.figure.Figure - not shown and not saved; one figure is drawn at a time
    Raises
        GearlinkError - for a command that the design does not have
        NoSolution - where the figure shows something that the mechanism does not have
        TypeError - without a command for a design that was not opened for one
    Example
        >>> sheet = figure(load("designs/ty460_slider_crank.yaml"))
        >>> len(sheet.axes) > 0
        True
    """
    from gearlink.cli.views.figures.write import draw

    wanted = _origin(design)[1] if command is None else command
    if not (isinstance(wanted, str) and wanted in design.outlines):
        raise UnknownName("command", wanted, tuple(design.outlines), design.kind)
    with _one_at_a_time:
        return draw(wanted, design)


def _origin(design: Any) -> tuple[LoadedFile, str]:
    """The file of a design that this module has opened, and the command that it was opened for."""
    own = getattr(design, "__dict__", {})
    if not isinstance(own.get("_loaded"), LoadedFile):
        raise TypeError("this design was not made by gearlink.load or gearlink.design")
    return own["_loaded"], own["_command"]


def _opened(loaded: LoadedFile, command: str | None) -> Opened:
    kind = KINDS[read_kind(loaded, tuple(KINDS))]
    spec = with_name(validate(loaded, kind.spec_model()), "-" if loaded.file == _KEYWORDS else loaded.file)
    wanted = spec.commands()[0] if command is None else command
    if not isinstance(wanted, str):
        raise TypeError(f"a command is text, such as {spec.commands()[0]!r}, not {type(wanted).__name__}")
    require_command(loaded, kind, wanted)
    made = cast("Opened", _placed(kind.class_for(wanted, spec))(spec))
    vars(made).update(_loaded=loaded, _command=wanted, kin=FileDesigns(kind, spec))
    return made


@cache
def _placed(kind: type[Design]) -> type[Design]:
    """The class of a design whose refusals know their place in its file, and whose lists the caller may write to.

    Its keys and quantities cannot be set: what had been computed before would not follow.
    """
    names = frozenset(kind.quantity_names())

    def get(self: Design, name: str) -> Any:
        try:
            value = kind.__getattribute__(self, name)
        except NoSolution as error:
            loaded = object.__getattribute__(self, "__dict__").get("_loaded")
            if loaded is not None:
                error.line, error.column, error.file = loaded.locate(parse_path(error.key) or ())
            raise
        return _copied(value) if type(value) is list and name in names else value

    def raw(self: Design, name: str) -> Any:
        return _copied(kind.raw(self, name))

    def put(self: Design, name: str, value: Any) -> None:
        opened = "_loaded" in vars(self)
        if opened and (name == "spec" or name in names or name in type(self.spec).model_fields):
            raise AttributeError(
                f"{name}: a design cannot be changed: gearlink.changed(design, {{...}}) makes a new one"
            )
        object.__setattr__(self, name, value)

    def reduce(self: Design) -> Any:
        return _opened, (vars(self)["_loaded"], vars(self)["_command"])

    own = {
        "__getattribute__": get,
        "__setattr__": put,
        "raw": raw,
        "__reduce__": reduce,
        "__module__": kind.__module__,
        "__doc__": kind.__doc__,
    }
    return type(kind.__name__, (kind,), own)


def _copied(value: Any) -> Any:
    """The reader's own: what the reader does to it changes no result that the design keeps."""
    return [_copied(item) for item in value] if type(value) is list else value


def _settings(values: Values | None) -> list[str]:
    if values is None:
        return []
    if not isinstance(values, Mapping):
        raise TypeError(f"values are a mapping of paths to values, not {type(values).__name__}")
    return [f"{_path(path)}={_text(value, path)}" for path, value in values.items()]


def _keywords(keys: dict[str, Any]) -> str:
    """The text of a design file with these keys, each on a line of its own."""
    for key, value in keys.items():
        _text(value, key)
    return _text(keys, "", indent=1)


def _path(path: Any) -> str:
    if not isinstance(path, str):
        raise TypeError(f"a path in a design file is text, not {type(path).__name__}")
    if "=" in path:
        raise _refused("is not a path: the value is next to it", path)
    return path


def _text(value: Any, key: str, indent: int | None = None) -> str:
    """JSON, which is YAML too; arrays and numbers of numpy and others become Python's own.

    Raises
        GearlinkError - for what a file cannot hold
    """
    try:
        return json.dumps(value, indent=indent, default=_as_python, allow_nan=False)
    except _NoValue as error:
        refusal = f"is of type {error}, which no design file can hold\ngive a number, text, a list or a dict"
    except TypeError:
        refusal = "has a section whose keys are not text"
    except (ValueError, RecursionError) as error:
        refusal = "contains itself, or endlessly nested sections"
        if "JSON compliant" in str(error):
            refusal = "is or contains a number that is not finite\ngive finite numbers"
    raise _refused(refusal, key)


class _NoValue(Exception):
    """A value that is none of a design file, by the name of its type."""


def _as_python(value: Any) -> Any:
    if isinstance(value, range):
        return list(value)
    plain = value.tolist() if callable(getattr(value, "tolist", None)) else value
    if type(plain) is not type(value):
        return plain
    if isinstance(value, Number) and hasattr(value, "__float__"):
        return float(value)
    raise _NoValue(type(value).__name__)


def _refused(refusal: str, key: str) -> GearlinkError:
    error = GearlinkError(f"{named(key)} {refusal}" if key else f"the design {refusal}")
    error.key = key
    return error
