"""What to write instead of a command line that Typer refuses: the option, command or value that was meant."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from enum import Enum
from typing import Any, get_args

_FORMATS = ("--format", "-f", "--as", "--plot-format", "--type", "--to")
_PLACES = ("--out", "-o", "--output", "--outdir", "--out-dir", "--output-dir", "--outfile", "--file", "--dir", "--save")
_ALIASES = {"markdown": "md", "text": "table", "txt": "table", "stp": "step", "htm": "html", "yml": "yaml"}
_ALIASES |= {"jpg": "png", "jpeg": "png", "xls": "csv", "xlsx": "csv", "jsonlines": "jsonl", "xml": "junit"}
_FIRST = ("analyze", "export", "animate", "batch")
"""Commands that are named first where several write a format."""

_NAMED = 4
"""So many commands are named that have an option."""

_ONE = ("spec", "names", "name")
"""Arguments of commands on one design file."""

_WITHOUT = {"report": "html", "new": "yaml", "schema": "json"}
"""Commands with one format, and no option for it."""


_ON_DASK = "`--dask ADDRESS` computes on a cluster, `--jobs N` in processes"
_GONE = {
    ("batch", "--cache"): "`--out DIR --unchanged skip` skips designs that passed and are unchanged since",
    ("explore", "--shard"): _ON_DASK,
    ("explore", "--merge"): f"one store holds the whole study: {_ON_DASK}",
    ("explore", "--executor"): _ON_DASK,
    ("tolerance", "--executor"): _ON_DASK,
    ("register", "--executor"): _ON_DASK,
}
"""What serves instead of options that were once there."""

_NO_MORE = {"bench": "run times are measured in a checkout of gearlink, by `make bench`"}
"""The same of commands."""


def complete(wrong: Any, arguments: Sequence[str], tree: Any) -> None:
    """Put into an error of usage what would have been right; it stays as it is where nothing is known.

    Parameters
        wrong : typer.TyperException - changed in place
        arguments : the words of the command line
        tree : Typer's group of all commands
    """
    command: Any = getattr(getattr(wrong, "ctx", None), "command", None)
    message = str(getattr(wrong, "message", ""))
    if command is not None and (long := _with_one_dash(arguments, command)):
        wrong.message = f"{message.removeprefix('Value error, ').rstrip('.')}\ngive -{long}, with two dashes"
        if hasattr(wrong, "possibilities"):
            wrong.possibilities = None
    elif hasattr(wrong, "possibilities"):
        remedy = _of_option(wrong.option_name, arguments, command, tree)
        if remedy:
            wrong.message, wrong.possibilities = f"{message}\n{remedy}", None
    elif hasattr(wrong, "param_type"):
        wrong.message = message or f"\n{getattr(wrong.param, 'help', '') or ''}".rstrip()
    elif getattr(wrong, "param", None) is not None:
        wrong.message = _of_value(wrong, arguments, command, tree)
    elif command is tree and (gone := _NO_MORE.get(message.removeprefix("No such command '").partition("'")[0])):
        wrong.message = f"{message.partition('.')[0]}\n{gone}"
    elif message.startswith("No such command") and "Did you mean" not in message:
        remedy = _of_command(message.split("'")[1], command, tree)
        wrong.message = f"{message.rstrip('.')}\n{remedy}" if remedy else message
    elif message.startswith("Got unexpected extra") and command.name == "laws":
        wrong.message = f"{message}\n{of_law(message.rpartition('(')[2].rstrip(').').split(' ')[0])}"
    elif message.startswith("Got unexpected extra") and [p.name for p in command.params if p.name in _ONE] == ["spec"]:
        several = f"{command.name} accepts one file; `gearlink batch` and `gearlink check` accept several"
        wrong.message = f"{message}\n{_of_setting(arguments) or several}"


def _of_setting(arguments: Sequence[str]) -> str:
    """How a setting is written whose value stands behind a blank."""
    for option, path, value in zip(arguments, arguments[1:], arguments[2:], strict=False):
        if option == "--set" and "=" not in path and not value.startswith("-"):
            return f"write --set {path}={value}"
    return ""


# Options


def _of_option(name: str, arguments: Sequence[str], command: Any, tree: Any) -> str:
    if (command.name, name) in _GONE:
        return _GONE[command.name, name]
    if name in _FORMATS:
        choices = [
            f"{param.opts[0]} takes {', '.join(values)}" for param in command.params if (values := _values(param))
        ]
        return _writer(_value_after(arguments, (name,)), command, tree) or "; ".join(choices)
    if name in _PLACES:
        known = {param.name: param for param in command.params}
        return "; ".join(_written(known[each]) for each in ("out", "save", "write") if each in known)
    having = [path for path, each in _leaves(tree) if any(name in param.opts for param in each.params)]
    more = ", ..." if len(having) > _NAMED else ""
    return f"it is an option of {', '.join(having[:_NAMED])}{more}" if having else ""


def _written(param: Any) -> str:
    return f"{param.opts[0]} {param.metavar}: {param.help}"


def _writer(word: str, command: Any, tree: Any) -> str:
    """What writes a format: an option of this command, or else another command; empty where nothing does."""
    word = _ALIASES.get(word.lower(), word.lower())
    own = [param for param in command.params if word in _values(param)]
    if own:
        return f"give {_line(own[0], word, command)}"
    if word == "yaml" and any(param.name == "save" for param in command.params):
        return "give --save FILE, which writes the design as YAML"
    if _WITHOUT.get(command.name) == word:
        return f"{command.name} always writes {word.upper()}"
    printed = any("table" in _values(param) for param in command.params)  # without this form, on purpose
    return "" if printed and word in ("json", "csv", "md") else _elsewhere(word, tree)


def _line(param: Any, word: str, command: Any) -> str:
    picture = "--plot " if param.name == "plot_format" and any(p.name == "plot" for p in command.params) else ""
    return f"{picture}{param.opts[0]} {word}"


def _elsewhere(word: str, tree: Any) -> str:
    if word == "html":
        return "use `gearlink report SPEC` for a page, `gearlink animate SPEC --format html` for an animation"
    takers = {
        path: _line(param, word, command)
        for path, command in _leaves(tree)
        for param in command.params
        if word in _values(param)
    }
    best = [path for path in (*_FIRST, *takers) if path in takers]
    return f"use `gearlink {best[0]} {_argument(tree, best[0])} {takers[best[0]]}`" if best else ""


def _argument(tree: Any, path: str) -> str:
    params = dict(_leaves(tree))[path].params
    return " ".join(str(p.metavar) for p in params if p.param_type_name == "argument" and p.metavar)


def _leaves(group: Any, before: str = "") -> Iterator[tuple[str, Any]]:
    for name, command in group.commands.items():
        if hasattr(command, "commands"):
            yield from _leaves(command, f"{before}{name} ")
        else:
            yield before + name, command


def _values(param: Any) -> list[str]:
    """The words that an option chooses from; none where it takes numbers or names."""
    kind = param.type_descriptor.annotation
    members = [each for each in (kind, *get_args(kind)) if isinstance(each, type) and issubclass(each, Enum)]
    return [str(member.value) for member in members[0]] if members else []


# Values


def _of_value(wrong: Any, arguments: Sequence[str], command: Any, tree: Any) -> str:
    message = str(wrong.message).removeprefix("Value error, ").rstrip(".")
    value = _value_after(arguments, wrong.param.opts)
    if message.startswith("Input should be") and value:
        return f"{value!r} is not {_number(wrong.param)}{_in_digits(value, wrong.param)}"
    remedy = _writer(value, command, tree) if value and _values(wrong.param) else ""
    return f"{message}\n{remedy}" if remedy else message


def _number(param: Any) -> str:
    """A number within the limits of an option, in words."""
    whole = param.type_descriptor.annotation is int or int in get_args(param.type_descriptor.annotation)
    what = "a whole number" if whole else "a number"
    low, high = param.min, param.max
    ends = ((word, end) for word, end in (("from", low), ("to", high)) if end is not None)
    limits = " ".join(f"{word} {end:.15g}" for word, end in ends)
    return f"{what} {limits}{' on' if limits and high is None else ''}".strip()


def _in_digits(value: str, param: Any) -> str:
    """What to write for 1e3 where a whole number is wanted, for 3,5 and 19/7; nothing for 3,000, which is either."""
    if re.search(r",\d{3}$", value):
        return ""
    over, slash, under = value.replace(",", ".").partition("/")
    try:
        number = float(over) / (float(under) if slash else 1.0)
    except (ValueError, ZeroDivisionError):
        return ""
    low, high = (end if end is not None else number for end in (param.min, param.max))
    written = f"{number:.0f}" if number.is_integer() else "" if "whole" in _number(param) else f"{number:.12g}"
    return f"\nwrite {written}" if written and low <= number <= high else ""


def _with_one_dash(arguments: Sequence[str], command: Any) -> str:
    """A long option of the command that was written with one dash, as -format."""
    known = {name for param in command.params for name in param.opts if name.startswith("--")}
    return next((word for word in arguments if len(word) > 2 and word[1] != "-" and f"-{word}" in known), "")


def _value_after(arguments: Sequence[str], names: Sequence[str]) -> str:
    """What follows the last use of an option, by a space or by =; empty where nothing does."""
    found = ""
    for place, word in enumerate(arguments):
        name, equals, value = word.partition("=")
        if name in names:
            found = value if equals else "".join(arguments[place + 1 : place + 2])
        elif word[:2] in names and len(word) > 2:  # -j8
            found = word[2:]
    return found


# Commands


def of_law(name: str) -> str:
    """The option that takes the name of a law, and the laws where it is none."""
    from gearlink.core.parts.cams.laws import REST_TO_REST, REST_TO_SPEED

    known = (*REST_TO_REST, *REST_TO_SPEED)
    return f"give --law {name}" if name in known else f"give --law NAME; the laws are {', '.join(known)}"


def _of_command(name: str, group: Any, tree: Any) -> str:
    """A command of a group inside this one; a file instead of a command."""
    inner = [path for path, _ in _leaves(tree) if path.endswith(f" {name}") and group is tree]
    if inner:
        return f"use `gearlink {inner[0]}`"
    if name.lower().endswith((".yaml", ".yml", ".json")):
        first = "analyze" if group is tree else f"{group.name} {next(iter(group.commands))}"
        return f"for a file: `gearlink {first} {name}`"
    return "" if group is tree else f"`gearlink {group.name}` takes one of {', '.join(group.commands)}"
