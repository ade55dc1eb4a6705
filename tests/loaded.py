"""An example of every kind that has loads, for tests that hold of all of them."""

from __future__ import annotations

from typing import Any

import factory

_MASSES = {"mass": 1.5, "inertia": 0.01}
LOADS: dict[str, tuple[str, dict[str, Any]]] = {
    "three-gear-four-bar": ("loaded_feed", {}),
    "gear-pair": ("gear_pair", {"speed": 500, "links": {"gear2": _MASSES}, "forces": [{"on": "gear2", "torque": 30}]}),
    "slider-crank": ("ty460_slider_crank", {"speed": 75, "links": {"rod": _MASSES, "slider": {"mass": 240}}}),
    "crank-rocker": ("crank_rocker_links", {}),
    "flatbed-press": ("loaded_press", {}),
    "swing-gripper": ("loaded_gripper", {}),
    "wide-swing-cam": ("loaded_swing_cycle", {}),
    "mutilated-gear-dwell": ("mutilated_gear_press", {"speed": 60, "links": {"wheel": _MASSES, "rocker": _MASSES}}),
    "two-gear-four-bar": ("two_gear_ring", {"speed": 60, "links": {"coupler": _MASSES, "output": _MASSES}}),
    "geared-rocker": ("wide_lever", {"speed": -60, "links": {"coupler": _MASSES, "output": _MASSES}}),
    "geared-five-bar": ("five_bar_path", {"speed": 60, "links": {"coupler": _MASSES, "output": _MASSES}}),
    "geared-six-bar": ("six_bar_swing", {"speed": 60, "links": {"coupler_2": _MASSES, "output": _MASSES}}),
    "planar-mechanism": ("planar_watt", {"speed": 60, "links": {"coupler": _MASSES, "output": _MASSES}}),
    "disc-cam": ("loaded_cam", {}),
    "measured-cam": ("loaded_measured_cam", {}),
    "cycloidal-reducer": ("loaded_cycloidal", {}),
    "cam-gear": ("loaded_cam_gear", {}),
    "cam-linkage": ("cam_linkage", {"speed": 60, "links": {"coupler": _MASSES, "output": _MASSES}}),
    "linked-cams": ("linked_cams", {"speed": 60, "links": {"table": _MASSES, "slide_x": {"mass": 3}}}),
    "geneva-drive": ("loaded_geneva", {}),
    "hypocycloid-dwell": ("hypocycloid_slider", {"speed": 60, "links": {"planet": _MASSES, "slider": {"mass": 3}}}),
}


def loaded(kind: str, **more: Any) -> Any:
    """The loads of a kind's design, with further keys of the section `loads`."""
    base, loads = LOADS[kind]
    keys = {"loads": {**loads, **more}} if loads else {f"loads__{key}": value for key, value in more.items()}
    return factory.design(base, command="loads", **keys)
