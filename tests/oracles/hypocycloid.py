"""Acceleration and jerk of the slider of a hypocycloid dwell, derived by hand from its closed form."""

from __future__ import annotations

import math

from gearlink.core.machines.dwell_gears.hypocycloid_design import HypocycloidSlider


def acceleration(slider: HypocycloidSlider, t: float) -> float:
    """Outwards at constant carrier speed, d2s/dt2 [mm/rad^2]."""
    (_, y_1), (x_2, y_2), y = _rates(slider, t), _second_rates(slider, t), slider.point(t).imag
    w = math.sqrt(slider.rod**2 - y * y)
    return x_2 - (y_1 * y_1 + y * y_2) / w - (y * y_1) ** 2 / w**3


def jerk(slider: HypocycloidSlider, t: float) -> float:
    """Outwards at constant carrier speed, d3s/dt3 [mm/rad^3].

    w w''' + 3 w' w'' = -(3 y' y'' + y y'''),   w = sqrt(L^2 - y^2)
    """
    k, scale = slider.cusps - 1, slider.planet_radius * (slider.cusps - 1)
    (_, y_1), (_, y_2), y = _rates(slider, t), _second_rates(slider, t), slider.point(t).imag
    x_3 = scale * (math.sin(t) - slider.ratio * k * k * math.sin(k * t))
    y_3 = -scale * (slider.ratio * k * k * math.cos(k * t) + math.cos(t))
    w = math.sqrt(slider.rod**2 - y * y)
    w_1 = -y * y_1 / w
    w_2 = -(y_1 * y_1 + y * y_2 + w_1 * w_1) / w
    return x_3 - (3.0 * (y_1 * y_2 + w_1 * w_2) + y * y_3) / w


def _rates(slider: HypocycloidSlider, t: float) -> tuple[float, float]:
    k, far = slider.cusps - 1, slider.ratio
    scale = slider.planet_radius * k
    return scale * (far * math.sin(k * t) - math.sin(t)), scale * (far * math.cos(k * t) + math.cos(t))


def _second_rates(slider: HypocycloidSlider, t: float) -> tuple[float, float]:
    k, scale = slider.cusps - 1, slider.planet_radius * (slider.cusps - 1)
    bent = slider.ratio * k
    return scale * (bent * math.cos(k * t) - math.cos(t)), -scale * (bent * math.sin(k * t) + math.sin(t))
