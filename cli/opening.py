"""Designs for Python: opened from a file or from keywords, changed, drawn; a refusal knows its place in the file."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING, Any, cast

from gearlink.cli.evaluate import named, require_command
from gearlink.cli.reading.design_file import load as load_file
from gearlink.cli.reading.design_file import parse, read_kind, validate, with_overrides
from gearlink.cli.reading.loaded_file import LoadedFile, parse_path
from gearlink.core.errors import NoSolution
from gearlink.core.kinds import KINDS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gearlink.core.design import Design

    class Opened(Design):
        """A design of some kind: type checkers know the methods of all, and take quantities by name for any type."""

        def __getattr__(self, name: str) -> Any: ...


_KEYWORDS = "<design>"
Values = Mapping[str, Any]
"""Values by the dotted paths of a design file, as for `--set`: {"gears.crank": 42, "teeth[1]": 20}."""


def load(source: str | os.PathLike[str], values: Values | None = None, *, command: str | None = None) -> Opened:
    """The design of a file.

    Parameters
        source : path of a design file
        values : values put over those of the file, by dotted path, in the units of design files
        command : str - a command of its kind, such as "analyze"; by default the first that the file asks for
    Returns
        a design; its quantities are attributes in mm and radians, computed when asked for; `quantity` and `table`
        give them in the units of design files
    Raises
        GearlinkError - with file, line, column and key of the first thing that is wrong
    Example
        >>> press = load("designs/ty460.yaml")
        >>> round(press.crank_length, 6), press.quantity("crank_length").unit
        (154.211592, 'mm')
    """
    return _opened(load_file(source, overrides=_settings(values)), command)


def design(command: str | None = None, **keys: Any) -> Opened:
    """The design that the keys of a design file describe.

    Parameters
        command : as for `load`
        keys : the first keys of a design file; sections are dicts, lists may be tuples or arrays
    Raises
        GearlinkError - as `load`; the lines are those of the keys written as JSON
    Example
        >>> crank = design(kind="slider-crank", stroke=310, rod=520, offset=50)
        >>> round(crank.crank_length, 6)
        154.211592
    """
    return _opened(parse(_text(keys, indent=1).encode(), _KEYWORDS), command)


def changed(design: Design, values: Values) -> Opened:
    """A design like another with some values of its file changed; the other stays as it is.

    Parameters
        design : made by `load`, `design` or `changed`
        values : as for `load`
    Raises
        GearlinkError - as `load`
        TypeError - for a design that was made in another way, and so has no file
    Example
        >>> crank = load("designs/ty460_slider_crank.yaml")
        >>> round(changed(crank, {"stroke": 320}).crank_length - crank.crank_length, 3)
        4.969
    """
    loaded = vars(design).get("_loaded")
    if not isinstance(loaded, LoadedFile):
        raise TypeError("this design was not made by gearlink.load or gearlink.design")
    return _opened(with_overrides(loaded, _settings(values)), vars(design)["_command"])


def figure(design: Design, command: str | None = None) -> Figure:
    """The sheet that `--plot` draws, as a matplotlib figure.

    Parameters
        design : any design
        command : str - whose sheet; by default the command that the design was opened for
    Raises
        NoSolution - where the sheet shows something that the design does not have
    """
    from gearlink.cli.figures.write import draw

    return draw(command or vars(design)["_command"], design)


def _opened(loaded: LoadedFile, command: str | None) -> Opened:
    kind = KINDS[read_kind(loaded, tuple(KINDS))]
    spec = named(validate(loaded, kind.spec_model()), "-" if loaded.file == _KEYWORDS else loaded.file)
    wanted = command or spec.commands()[0]
    require_command(loaded, kind, wanted)
    made = cast("Opened", _placed(kind.class_for(wanted, spec))(spec))
    vars(made).update(_loaded=loaded, _command=wanted)
    return made


@cache
def _placed(kind: type[Design]) -> type[Design]:
    """The class of a design whose refusals know their place in its file."""

    def get(self: Design, name: str) -> Any:
        try:
            return kind.__getattribute__(self, name)
        except NoSolution as error:
            loaded = object.__getattribute__(self, "__dict__").get("_loaded")
            if loaded is not None:
                error.line, error.column, error.file = loaded.locate(parse_path(error.key) or ())
            raise

    def reduce(self: Design) -> Any:
        return _opened, (vars(self)["_loaded"], vars(self)["_command"])

    own = {"__getattribute__": get, "__reduce__": reduce, "__module__": kind.__module__, "__doc__": kind.__doc__}
    return type(kind.__name__, (kind,), own)


def _settings(values: Values | None) -> list[str]:
    return [f"{path}={_text(value)}" for path, value in (values or {}).items()]


def _text(value: Any, indent: int | None = None) -> str:
    """JSON, which is YAML too; arrays and numbers of numpy become Python's own."""
    return json.dumps(value, indent=indent, default=lambda other: other.tolist())
