"""Design charts of wide swings over the swing: peaks and energy parameter of the law, curvature of the profile."""

from __future__ import annotations

from functools import partial
from typing import Literal

from numpy.typing import ArrayLike

from gearlink.core.machines.wide_swing.cam import WideSwingCam, middle_radius_estimate
from gearlink.core.machines.wide_swing.device import Pneumatic, Spring, least_pivot_ratio_pneumatic
from gearlink.core.machines.wide_swing.law import ElasticLaw
from gearlink.core.numerics.arrays import Reals, where_it_exists

Name = Literal["velocity_peak", "acceleration_peak", "energy_parameter"]


def _law(gamma: float, pivot_ratio: float | None, stretch_ratio: float | None) -> ElasticLaw:
    """The law of a cylinder, or of a spring where there is a stretch ratio; without a pivot ratio the least of (3)."""
    ratio = least_pivot_ratio_pneumatic(gamma) if pivot_ratio is None else pivot_ratio
    return ElasticLaw(Pneumatic(ratio) if stretch_ratio is None else Spring(ratio, stretch_ratio), gamma)


def peaks(name: Name, swing: ArrayLike, pivot_ratio: float, *, stretch_ratio: float | None = None) -> Reals:
    """B, C or N of the law over the swing at constant pivot ratio.

    Parameters
        name : which one
        swing : array [rad] - above 0, at most 340 deg
        pivot_ratio : float - lambda, above 1
        stretch_ratio : float or None - of a spring; None: the law of a cylinder
    Returns
        peak : array [1] - not a number where there is no law
    Example
        >>> import numpy as np
        >>> velocity_peak(np.radians([120.0]), 2.5).round(9).tolist()
        [1.687523657]
        >>> energy_parameter(np.radians([120.0]), 2.5).round(9).tolist()
        [4.191240425]

    Source
        wide-swing dissertation, chapter 2, (8), (10), (9); of springs (13), (15), (14)
    """
    return where_it_exists(lambda gamma: float(getattr(_law(gamma, pivot_ratio, stretch_ratio), name)), swing)


def curvature_ratio(
    swing: ArrayLike, cycle_angle: float, *, pivot_ratio: float | None = None, stretch_ratio: float | None = None
) -> Reals:
    """The source's estimate of the minimum curvature radius of an internal profile over its maximum radius.

    (27)/rho_max

    Parameters
        swing : array [rad]
        cycle_angle : float [rad] - phi_ud, cam angle of a stroke
        pivot_ratio : float or None - None: the minimum of (3)
        stretch_ratio : float or None - of a spring; None: the law of a cylinder
    Returns
        ratio : array [1] - not a number where B alpha is not above 1, or the profile does not exist
    Example
        >>> import numpy as np
        >>> curvature_ratio(np.radians([120.0]), np.radians(60.0)).round(6).tolist()
        [0.012907]

    Source
        wide-swing dissertation, figure 6
    """

    def value(gamma: float) -> float:
        cam = WideSwingCam("twin-rocker", _law(gamma, pivot_ratio, stretch_ratio), cycle_angle, 1.0, 1e-3)
        return middle_radius_estimate(cam) / cam.max_radius

    return where_it_exists(value, swing)


velocity_peak = partial(peaks, "velocity_peak")
acceleration_peak = partial(peaks, "acceleration_peak")
energy_parameter = partial(peaks, "energy_parameter")
