"""Laws of distribution of a toleranced size, by their inverse: a share of the parts below in, the size out."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from gearlink.core.numerics.arrays import Reals

Form = Literal["normal", "uniform", "triangular", "truncated", "fixed"]
_LEAST_SHARE, _MOST_SHARE = 2.0**-54, 1.0 - 2.0**-53


@dataclass(frozen=True, slots=True)
class Law:
    """Distribution of a deviation from the nominal size [mm, rad: the unit of the size].

    Parameters
        form : normal - may pass its limits, as its process capability says; uniform, triangular - between the limits;
            truncated - normal, parts outside of the limits sorted out; fixed - one part, measured
        lower, upper : float - limits of the deviation
        mean, sigma : float - of the normal law, before it is truncated
        mode : float - peak of the triangular law
    """

    form: Form
    lower: float
    upper: float
    mean: float = 0.0
    sigma: float = 0.0
    mode: float = 0.0

    def deviations(self, share: Reals) -> Reals:
        """Deviations below which the given shares of the parts lie.

        Parameters
            share : array - above 0, below 1; what is nearer than 2^-54 to 0 or 2^-53 to 1 is taken there
        Returns
            deviation : array of its shape
        Notes
            By the inverse of the distribution: moments agree with the closed forms of `moments`.
        Example
            >>> Law("triangular", -0.02, 0.05, mode=0.015).deviations(np.array([0.0, 0.5, 1.0])).round(6).tolist()
            [-0.02, 0.015, 0.05]

        Source
            inverse distribution functions; N. L. Johnson, S. Kotz, Continuous Univariate Distributions
        """
        u = np.clip(share, _LEAST_SHARE, _MOST_SHARE)
        result: Reals
        if self.form == "fixed":
            result = np.full(u.shape, self.mean)
        elif self.form == "uniform":
            result = self.lower + (self.upper - self.lower) * u
        elif self.form == "triangular":
            result = self._triangular(u)
        elif self.form == "truncated":
            below, above = self._normal_share(self.lower), self._normal_share(self.upper)
            result = self._normal(below + u * (above - below))
        else:
            result = self._normal(u)
        return result

    def moments(self) -> tuple[float, float]:
        """Mean and standard deviation, in closed form.

        Example
            >>> Law("uniform", -0.01, 0.03).moments()
            (0.01, 0.011547005383792516)

        Source
            closed forms of the laws
        """
        width = self.upper - self.lower
        if self.form in ("normal", "fixed"):
            return self.mean, self.sigma
        if self.form == "uniform":
            return self.lower + 0.5 * width, width / math.sqrt(12.0)
        if self.form == "triangular":
            left, right = self.mode - self.lower, self.upper - self.mode
            return (self.lower + self.upper + self.mode) / 3.0, math.sqrt(
                (left * left + left * right + right * right) / 18.0
            )
        return self._truncated_moments()

    def _triangular(self, u: Reals) -> Reals:
        width = self.upper - self.lower
        peak = (self.mode - self.lower) / width
        rising = self.lower + width * np.sqrt(u * peak)
        return np.where(u < peak, rising, self.upper - width * np.sqrt((1.0 - u) * (1.0 - peak)))

    def _normal(self, u: Reals) -> Reals:
        from scipy.special import ndtri

        result: Reals = self.mean + self.sigma * ndtri(u)
        return result

    def _normal_share(self, deviation: float) -> float:
        return 0.5 * math.erfc((self.mean - deviation) / (self.sigma * math.sqrt(2.0)))

    def _truncated_moments(self) -> tuple[float, float]:
        low, high = (self.lower - self.mean) / self.sigma, (self.upper - self.mean) / self.sigma
        inside = self._normal_share(self.upper) - self._normal_share(self.lower)
        at_low, at_high = (math.exp(-0.5 * z * z) / math.sqrt(2.0 * math.pi) for z in (low, high))
        shift = (at_low - at_high) / inside
        variance = 1.0 + (low * at_low - high * at_high) / inside - shift * shift
        return self.mean + self.sigma * shift, self.sigma * math.sqrt(variance)


def normal_between(
    lower: float, upper: float, capability: float = 1.0, centred: float | None = None, up: bool = True
) -> Law:
    """Normal law of a process of known capability.

    sigma = (upper - lower)/(6 C_p),   mean = middle +- (upper - lower)/2 (1 - C_pk/C_p)

    Parameters
        lower, upper : float - limits of the deviation
        capability : float - C_p, positive
        centred : float - C_pk, at most C_p; default: the process runs in the middle
        up : bool - towards which limit the process lies
    Example
        >>> law = normal_between(-0.02, 0.02, capability=1.33, centred=1.0)
        >>> round(law.mean, 9), round(law.sigma, 9)
        (0.004962406, 0.005012531)

    Source
        ISO 22514-2, capability indices
    """
    width = upper - lower
    off = 0.5 * width * (1.0 - centred / capability) if centred is not None else 0.0
    return Law("normal", lower, upper, 0.5 * (lower + upper) + (off if up else -off), width / (6.0 * capability))
