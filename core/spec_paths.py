"""Values of a spec by the dotted paths of the design file."""

from __future__ import annotations

from typing import Any


def value_at(spec: Any, path: str) -> Any:
    """The value that a path leads to.

    Parameters
        spec : a spec, or anything with attributes
        path : str - such as `cam.roller_radius`
    Example
        >>> from types import SimpleNamespace
        >>> value_at(SimpleNamespace(cam=SimpleNamespace(roller_radius=8.0)), "cam.roller_radius")
        8.0
    """
    for step in path.split("."):
        spec = getattr(spec, step)
    return spec


def replaced(spec: Any, path: str, value: Any) -> Any:
    """A copy of a spec with the value of one path changed; the spec itself stays as it is.

    Parameters
        spec : pydantic model
        path : str - such as `cam.roller_radius`
        value - not validated: it must be one that the spec allows
    """
    head, _, rest = path.partition(".")
    inner = replaced(getattr(spec, head), rest, value) if rest else value
    return spec.model_copy(update={head: inner})
