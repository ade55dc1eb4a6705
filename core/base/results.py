"""Results that are computed on request and stored, and the only place where an observer can monitor them."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from typing import TYPE_CHECKING, Any, TypeAlias

Observer: TypeAlias = Callable[[str], AbstractContextManager[None]]
"""Given the name of a result, a context that is held while it is computed."""

_observer: Observer | None = None


@contextmanager
def observed(by: Observer) -> Iterator[None]:
    """Every result that is computed within is computed under the observer's context of its name."""
    global _observer
    before, _observer = _observer, by
    try:
        yield
    finally:
        _observer = before


def step(name: str) -> AbstractContextManager[None]:
    """The observer's context of a result; none where nobody watches."""
    return nullcontext() if _observer is None else _observer(name)


def keep(owner: Any, **results: Any) -> None:
    """Store known results in an owner, so that they are not computed on request.

    Raises
        TypeError - for a name that is no kept result of the owner's class
    """
    for name, value in results.items():
        if not isinstance(getattr(type(owner), name, None), functools.cached_property):
            raise TypeError(f"{type(owner).__name__}.{name} is not a result that is kept")
        owner.__dict__[name] = value


def kept(owner: Any, *names: str) -> dict[str, Any]:
    """The named results that an owner has already stored, with their values."""
    return {name: owner.__dict__[name] for name in names if name in owner.__dict__}


if TYPE_CHECKING:
    from functools import cached_property as cached_property
else:

    class cached_property(functools.cached_property):
        """functools' own without its lock, which an observer may watch; a kept value is read without coming here."""

        def __set_name__(self, owner: type, name: str) -> None:
            super().__set_name__(owner, name)
            self.label = f"{owner.__name__}.{name}"

        def __get__(self, instance: Any, owner: type | None = None) -> Any:
            if instance is None:
                return self
            kept = instance.__dict__
            if self.attrname in kept:  # asked of the property itself, not through the instance
                return kept[self.attrname]
            if _observer is None:
                value = kept[self.attrname] = self.func(instance)
                return value
            with _observer(self.label):
                value = kept[self.attrname] = self.func(instance)
            return value
