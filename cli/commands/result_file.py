"""A result that was kept as JSON, read as what it may be: another program's, edited, or no result at all."""

from __future__ import annotations

import json
from io import BytesIO
from typing import Any

from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.reading.places import is_named_pipe, piped

LARGEST = 1 << 26
"""Bytes; the results of a batch of some thousand designs, tables left out of account."""
_DEEPEST = 12  # a result of a batch has 6 levels, and a value may be a list of lists
_MOST_DIGITS = 308  # beyond them a whole number is beyond all floats
_HEAD = 4096


def read_result(file: str) -> dict[str, Any] | None:
    """The result that a file holds; None where only the reader of design files can judge it.

    Raises
        DesignFileError - GL117 where it is too large, nested too deeply, or has a number beyond all floats
    """
    text = _text(file)
    if text is None:
        return None
    try:
        data = json.loads(text, parse_int=lambda digits: _whole(digits, file))
    except ValueError:
        return None
    except RecursionError:
        raise incomparable(file, _TOO_DEEP) from None
    if not isinstance(data, dict) or "gearlink" not in data:
        return None
    if _deeper(data, _DEEPEST):
        raise incomparable(file, _TOO_DEEP)
    return data


_TOO_DEEP = f"nested deeper than the {_DEEPEST} levels that a result may have"


def incomparable(file: str, message: str) -> DesignFileError:
    """Why a file cannot be compared."""
    return DesignFileError([Diagnostic("GL117", message, file=file)])


def _text(file: str) -> bytes | None:
    """What a file holds that begins as a JSON object does."""
    if file == "-" or is_named_pipe(file):
        return None
    held = piped(file, LARGEST + 1)
    try:
        with BytesIO(held) if held is not None else open(file, "rb") as stream:
            data = stream.read(_HEAD)
            if data.lstrip()[:1] != b"{":
                return None
            data += stream.read(LARGEST + 1 - len(data))
    except (OSError, ValueError):
        return None
    if len(data) > LARGEST:
        help_ = "compare results without their tables, or of fewer designs"
        message = f"larger than {LARGEST >> 20} MiB, more than is compared"
        raise DesignFileError([Diagnostic("GL117", message, file=file, help=help_)])
    return data


def _whole(digits: str, file: str) -> int:
    if len(digits.lstrip("-")) > _MOST_DIGITS:
        raise incomparable(file, f"a whole number of {len(digits.lstrip('-'))} digits is no value of a design")
    return int(digits)


def _deeper(node: Any, levels: int) -> bool:
    if not isinstance(node, (dict, list)):
        return False
    inner = node.values() if isinstance(node, dict) else node
    return levels == 0 or any(_deeper(each, levels - 1) for each in inner if isinstance(each, (dict, list)))
