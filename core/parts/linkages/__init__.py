"""Linkages of any machine: four-bar, slider-crank, dyad, standstills, mobility.

Begin with `fourbar`.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gearlink.core.parts.linkages.fourbar.position import FourBar as FourBar
    from gearlink.core.parts.linkages.slider_crank import SliderCrank as SliderCrank

_PLACES = {"FourBar": "fourbar.position", "SliderCrank": "slider_crank"}


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_PLACES[name]}"), name)
