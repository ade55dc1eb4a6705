"""The families that are measured, by name; modules are imported only when theirs is asked for."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bench.timing import Family

FAMILIES = {
    "four-bar": "four_bar:family",
    "involute": "involute:family",
    "dwell": "dwell:family",
    "unloading": "unloading:family",
    "cam": "cam:family",
    "press": "cam:press",
    "gear-search": "gears:search",
    "contour": "gears:contour",
    "start-up": "start_up:family",
    "pictures": "pictures:family",
    "folders": "pictures:folders",
    "batch": "start_up:batch",
    "parallel": "start_up:parallel",
    "studies": "studies:family",
    "samples": "samples:family",
    "yields": "yields:family",
    "loads": "loads:family",
    "studio": "studio:family",
    "planar": "planar:family",
    "planar-samples": "planar:samples",
    "cam-size": "sizes:cams",
    "crank-rocker": "sizes:rockers",
    "cam-samples": "samples:cams",
    "drum-samples": "samples:drums",
    "motion-laws": "laws:family",
    "machines": "machines:family",
    "kinds": "start_up:kinds",
}


def measured(name: str, quick: bool) -> Family:
    """The table of a family."""
    module, _, function = FAMILIES[name].partition(":")
    family: Family = getattr(import_module(f"bench.{module}"), function)(quick)
    return family
