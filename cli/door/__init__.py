"""gearlink from Python: `load` a design file or give a `design` by keywords, ask for what you need of it.

The import costs nothing; each name is looked up when it is first used.

    >>> import gearlink
    >>> pair = gearlink.design(kind="gear-pair", module=4, teeth=(72, 72), center_distance=290.2912330746487)
    >>> round(pair.reference_center_distance, 9)
    288.0
"""

TYPE_CHECKING = False
if TYPE_CHECKING:
    from gearlink.cli.opening import changed as changed
    from gearlink.cli.opening import design as design
    from gearlink.cli.opening import figure as figure
    from gearlink.cli.opening import load as load
    from gearlink.core.base.errors import GearlinkError as GearlinkError
    from gearlink.core.base.errors import NoSolution as NoSolution

    __version__: str

_PLACES = {
    "load": ("gearlink.cli.opening", "load"),
    "design": ("gearlink.cli.opening", "design"),
    "changed": ("gearlink.cli.opening", "changed"),
    "figure": ("gearlink.cli.opening", "figure"),
    "GearlinkError": ("gearlink.core.base.errors", "GearlinkError"),
    "NoSolution": ("gearlink.core.base.errors", "NoSolution"),
    "__version__": ("gearlink.core.version", "VERSION"),
}
__all__ = ["GearlinkError", "NoSolution", "__version__", "changed", "design", "figure", "load"]


def __getattr__(name: str) -> object:
    if name not in _PLACES:
        raise AttributeError(f"module 'gearlink' has no attribute {name!r}")
    from importlib import import_module

    module, own = _PLACES[name]
    value: object = getattr(import_module(module), own)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
