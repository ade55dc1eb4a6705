"""The law of motion that a device gives a rocker: exact, and by the iteration of the source.

A tension device (pneumatic cylinder of constant force, or spring) joins a pin on the rocker at radius r_d to a
base pin at a_d from the pivot; pins and pivot are collinear at mid-swing. The rocker swings as the free motion
of this one-degree system, so the device carries the inertia load and the cam only guides. Written here is that
law of motion over one stroke, k = t/T from 0 to 1, in invariants: displacement a, velocity b = da/dk,
acceleration c = db/dk, jerk dc/dk.

The iteration is kept to compare with; the exact law needs none.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.wide_swing.device import Device, DeviceGeometry, Gravity, Pneumatic, Spring, require_swing
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.elliptic import complete_integral, incomplete_integral, jacobi_sn_cn
from gearlink.core.numerics.extremes import maximum_over
from gearlink.core.numerics.periodic import CosineSeries, RisingTable, cosine_series
from gearlink.core.numerics.roots import roots_on
from gearlink.core.numerics.roots_sweep import newton_places

_MOST, _SIZE = 64, 4096
_GRID = math.pi / 512.0
Turned = TypeVar("Turned", bound=tuple[Any, ...])
Kept: TypeAlias = dict[tuple[tuple[int, ...], bytes], Turned]
"""Results by the places that they are of."""


def kept_for(kept: Kept[Turned], k: Reals, compute: Callable[[Reals], Turned]) -> Turned:
    """What is computed of an array of places, computed once for those that are asked for again.

    Parameters
        kept : dict - where results stand, at most 64 of arrays up to 4096 places
        k : array - places
        compute : function of the array
    Returns
        results : tuple - whoever gets it leaves its arrays as they are
    """
    if k.size > _SIZE:
        return compute(k)
    places = k.shape, k.tobytes()
    found = kept.get(places)
    if found is None:
        found = compute(k)
        if len(kept) >= _MOST:
            kept.clear()
        kept[places] = found
    return found


@dataclass(frozen=True)
class Clock:
    """Time over the pendulum angle, counted from a place of the stroke on, and read backwards; of many laws in rows.

    Fields
        time, slowness : functions of an array of angles - time, in a unit of its own, and its derivative
        whole : float - time of the stroke
        end : float [rad] - angle to which it runs
        floor : float - times are known no better
    """

    time: Callable[[Reals], Reals]
    slowness: Callable[[Reals], Reals]
    whole: float
    end: float
    floor: float = 0.0

    @cached_property
    def _table(self) -> RisingTable:
        """So fine that one of Newton's steps from between its places is the last for all but the sharpest laws."""
        grid = np.linspace(0.0, self.end, round(self.end / _GRID) + 1)
        return RisingTable(grid, self.time(grid) / self.whole, self.slowness(grid) / self.whole)

    def angles(self, k: Reals) -> Reals | None:
        """The angles at fractions of the stroke, by Newton steps; None where some do not rest."""

        def excess(at: Reals, rows: Any) -> tuple[Reals, Reals]:
            return self.time(at) - k[..., rows] * self.whole, self.slowness(at)

        return newton_places(excess, self._table.places_of(k), self.end, self.floor)


def for_each(series: CosineSeries, k: Reals) -> Reals:
    """Places as they are, or where a series is one of many a row of them for each."""
    rows = series.coefficients.shape[:-1]
    return np.broadcast_to(k, (*rows, k.shape[-1])) if rows else k


def columns_of(chosen: npt.NDArray[np.bool_]) -> npt.NDArray[np.intp]:
    """The columns in which some places are chosen; of an array without rows the places."""
    return np.flatnonzero(chosen if chosen.ndim < 2 else chosen.any(axis=0))


def require_share(k: Reals) -> None:
    """Refuse what is no fraction of a stroke."""
    if not bool(np.all((k >= 0.0) & (k <= 1.0))):
        raise NoSolution("the fraction of the stroke k must lie between 0 and 1")


# The law of motion


@dataclass(frozen=True, slots=True, eq=False)
class MiddleView:
    """A law of motion as the cam profile needs it about mid-swing.

    Fields
        angle : (N,) array [rad] - rocker angle phi from mid-swing
        velocity, deficit, acceleration : (N,) arrays - b, B - b, c
    """

    angle: Reals
    velocity: Reals
    deficit: Reals
    acceleration: Reals


@dataclass(frozen=True)
class ElasticLaw:
    """Law of motion of a rocker that its unloading device alone would swing; every part is computed when read.

    b^2 = N E(a), k(u) = 1/2 - Int_0^u F du/(gamma sqrt N), sin(phi/2) = sin(gamma/4) sin u

    Parameters
        device : Pneumatic or Spring
        swing : float [rad] - full swing gamma, 0 to 340 deg
    Raises
        NoSolution - for a swing outside (0, 340 deg]
    Notes
        The pendulum angle u makes the integrand F regular at both ends. A second, elliptic substitution of
        modulus k' = l0/L (the device's retracted over extended length), u -> y with l = l0/dn(y), takes the branch
        points of l(u) far from the real axis. With both the equal-weight rule converges geometrically for every
        pivot ratio: 32 or 64 nodes in common, a few hundred for 1 + 1e-6 and 300 deg.
        a, b, c, jerk against 40-digit references: 1e-14 of their peaks for pivot ratios of 1.05 and more. Nearer
        to 1 the motion itself turns over in a time (lambda - 1) about mid-swing; c and jerk there have that
        condition in k, everything else stays at 1e-13.
    Example
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> round(law.energy_parameter, 12), round(law.velocity_peak, 12), round(law.acceleration_peak, 12)
        (4.191240425408, 1.687523657051, 4.360085722005)
        >>> [round(float(x[0]), 12) for x in law.invariants(np.array([0.25]))]
        [0.135009882749, 1.066293386479, 3.979970378927]

    Source
        wide-swing dissertation (2), (6) to (15); quadrature instead of its iteration: own derivation
    """

    device: Device
    swing: float
    place, middle_place, offset, acceleration, symmetric = 0.5, 0.5, 0.0, 0.0, True
    """Of mid-swing, about which both half strokes are mirror images."""
    turns = -0.5 * math.pi, 0.5 * math.pi
    """Pendulum angle u at the start and the end of the stroke [rad]."""

    def __post_init__(self) -> None:
        require_swing(self.swing)

    @cached_property
    def geometry(self) -> DeviceGeometry:
        """Lengths of the device in arms."""
        return DeviceGeometry(self.device, self.swing)

    @cached_property
    def modulus_complement(self) -> float:
        """k' = l0/L of the elliptic substitution."""
        return self.geometry.shortest / self.geometry.longest

    @cached_property
    def modulus(self) -> float:
        """k of the elliptic substitution."""
        return self.geometry.reach * self.geometry.half_sine / self.geometry.longest

    def slowness(self, sine: Reals, cosine: Reals) -> Reals:
        """F(u) = gamma sqrt(N) |dk/du| from sin u and cos u of the pendulum angle, 0 at mid-swing."""
        g = self.geometry
        stretch = (g.longest + g.length(sine)) / (g.ratio * g.mean_force(sine))
        return np.sqrt(stretch) / g.half_cosine_at(cosine)

    def _integrand(self, z: Reals) -> Reals:
        """F du/dz with z = 0 at the start of the stroke and K at mid-swing; du/dz = l/L."""
        cosine, sine = jacobi_sn_cn(z, self.modulus, self.modulus_complement)
        return self.slowness(sine, cosine) * self.geometry.length(sine) / self.geometry.longest

    @cached_property
    def clock(self) -> CosineSeries:
        """gamma sqrt(N) dk/dz as a cosine series over half the stroke."""
        refusal = "the motion law reverses too sharply at mid-swing\nincrease unloader.pivot_ratio, or reduce swing"
        with at_key("unloader.pivot_ratio"):
            return cosine_series(self._integrand, complete_integral(self.modulus_complement), refusal)

    @cached_property
    def energy_parameter(self) -> float:
        """N = 2 P r_d T^2/(J gamma^2), or 2 c r_d^2 T^2/(J gamma^2) (dissertation (6), (11)) [-]."""
        return self._rate**2

    @cached_property
    def _rate(self) -> float:
        """sqrt(N) = (2/gamma) Int F du."""
        return 2.0 / self.swing * self.clock.total

    @cached_property
    def velocity_peak(self) -> float:
        """B = b(1/2) (dissertation (8), (13)) [-]."""
        return float(self._velocity(np.zeros(1), np.ones(1))[0])

    @cached_property
    def middle_jerk(self) -> float:
        """dc/dk at mid-swing, negative (zero for a spring mounted without stretch) [-]."""
        return float(self._jerk(np.zeros(1), np.ones(1))[0])

    @cached_property
    def acceleration_peak(self) -> float:
        """C, the largest |c| of the stroke [-]."""
        start = self.geometry.half_sine**2
        turns = self._torque_peaks(start)
        sines = np.array([1.0, *(math.sqrt(s / start) for s in turns)])
        cosines = np.array([0.0, *(math.sqrt((start - s) / start) for s in turns)])
        return float(np.max(self._acceleration(sines, cosines)))

    @property
    def torque_peak(self) -> float:
        """The same: the device bears the inertia of the rocker."""
        return self.acceleration_peak

    @cached_property
    def power_peak(self) -> float:
        """max(b c), pi^3/8 = 3.876 for the harmonic law."""

        def power(v: Reals) -> Reals:
            sine, cosine = np.cos(v), np.sin(v)
            return np.asarray(self._velocity(sine, cosine) * self._acceleration(sine, cosine))

        return maximum_over(power, 0.0, 0.5 * math.pi, samples=128).value

    def _torque_peaks(self, start: float) -> list[float]:
        """Places s = sin^2(phi/2) inside the swing where the device torque is stationary."""
        g = self.geometry
        tangent = g.shortest / (2.0 * g.ratio)  # cos phi = 1/lambda: pin, base pin and arm make a right angle
        if tangent >= start:
            return []
        if isinstance(self.device, Pneumatic):
            return [tangent]
        grid = np.geomspace(tangent, start, 65).tolist()
        return roots_on(self._torque_rise, grid)

    def _torque_rise(self, s: float) -> float:
        """Sign of d(device torque)/d(phi) at s = sin^2(phi/2)."""
        g = self.geometry
        sine = np.array([math.sqrt(s) / g.half_sine])
        bend = (g.shortest + 2.0 * s) * (g.shortest - 2.0 * g.ratio * s)
        lever = 4.0 * g.ratio * s * (1.0 - s) * float(g.length(sine)[0])
        return float(g.force(sine)[0]) * bend + g.stiffness * lever

    def device_torque(self, k: Reals) -> Reals:
        """Torque of the device over J gamma/T^2: c."""
        return self.invariants(k, 2)[2]

    def kinetic(self, k: Reals) -> Reals:
        """Energy of motion over J (gamma/T)^2/2: b^2."""
        return self.invariants(k, 1)[1] ** 2

    def invariants(self, k: Reals, order: int = 2) -> tuple[Reals, ...]:
        """Displacement, velocity, acceleration and jerk invariants, as many as asked for.

        a = 1/2 - phi/gamma, b = sqrt(N E), c = (N/2) lambda gamma X sin(phi)/l, dc/dk

        Parameters
            k : array - fraction of the stroke, 0 to 1
            order : int - 0 gives (a,), 1 (a, b), 2 (a, b, c), 3 (a, b, c, jerk)
        Returns
            invariants : tuple of order + 1 arrays of the shape of k
        Raises
            NoSolution - for k outside 0 to 1
        Notes
            k(u) is inverted by Newton steps, counted from the nearer of start and mid-swing, so a(k) has a small
            relative error near k = 0 and 1 - a(k) near k = 1. k = 0, 1/2 and 1 are exact.
        Source
            wide-swing dissertation (6), (10), (11), (15); jerk: own derivation
        """
        sine, cosine, second = self._pendulum(k)
        a = self.displacement(sine, cosine)
        odd = np.where(second, -1.0, 1.0)
        results = [np.where(second, 1.0 - a, a)]
        if order >= 1:
            results.append(self._velocity(sine, cosine))
        if order >= 2:
            results.append(odd * self._acceleration(sine, cosine))
        if order >= 3:
            results.append(self._jerk(sine, cosine))
        return tuple(results)

    def middle_view(self, k: Reals) -> MiddleView:
        """The motion seen from mid-swing, every number with a small relative error there.

        phi = (a - 1/2) gamma, B - b = N (E(mid) - E)/(B + b)

        Parameters
            k : (N,) array - fraction of the stroke, 0 to 1
        Raises
            NoSolution - for k outside 0 to 1
        """
        sine, cosine, second = self._pendulum(k)
        return self._view(np.where(second, sine, -sine), cosine)

    def _view(self, sine: Reals, cosine: Reals) -> MiddleView:
        """The same from sin u and cos u, both signs of u."""
        g = self.geometry
        velocity = self._velocity(sine, cosine)
        spent = self.energy_parameter * g.extension(sine) * g.mean_force_to_middle(sine)
        deficit = spent / (self.velocity_peak + velocity)
        return MiddleView(g.angle(sine, cosine), velocity, deficit, -self._acceleration(sine, cosine))

    # The same by the pendulum angle u, 0 at mid-swing: no place has to be solved for

    def view_at(self, turn: Reals) -> MiddleView:
        """`middle_view` at pendulum angles."""
        return self._view(np.sin(turn), np.cos(turn))

    def share_from_middle(self, turn: Reals) -> Reals:
        """k - 1/2 at pendulum angles, of small relative error."""
        scale = self.swing * self._rate
        return np.asarray(np.sign(turn) * self._from_middle.time(np.abs(turn)) / scale)

    def turn_near(self, share: float) -> float:
        """About the pendulum angle at k - 1/2, by the pace at mid-swing."""
        return share * self.swing * self._rate / float(self.slowness(np.zeros(1), np.ones(1))[0])

    def turn_at(self, share: float) -> float:
        """The pendulum angle at k - 1/2."""
        sine, cosine = self.pendulum(np.array([0.5 - abs(share)]))
        return math.copysign(math.atan2(float(sine[0]), float(cosine[0])), share)

    def displacement(self, sine: Reals, cosine: Reals) -> Reals:
        """a in the first half from sin u and cos u, counted from the end of the half stroke that keeps the digits."""
        g = self.geometry
        s, c = g.half_sine * sine, g.half_cosine_at(cosine)
        from_middle = 0.5 - 2.0 / self.swing * np.arctan2(s, c)
        turned = np.arctan2(
            g.half_sine * cosine**2 / (c + sine * g.half_cosine), g.half_cosine * c + g.half_sine**2 * sine
        )
        return np.where(cosine < sine, 2.0 / self.swing * turned, from_middle)

    def _velocity(self, sine: Reals, cosine: Reals) -> Reals:
        g = self.geometry
        energy = g.mean_force(sine) / (g.longest + g.length(sine))
        return self._rate * g.reach * g.half_sine * np.sqrt(energy) * cosine

    def _acceleration(self, sine: Reals, cosine: Reals) -> Reals:
        g = self.geometry
        return 0.5 * self.energy_parameter * self.swing * g.force(sine) * g.lever(sine, cosine)

    def _jerk(self, sine: Reals, cosine: Reals) -> Reals:
        g = self.geometry
        s = (g.half_sine * sine) ** 2
        bend = g.ratio * (g.shortest + 2.0 * s) * (g.shortest - 2.0 * g.ratio * s) / g.length(sine) ** 3
        change = g.force(sine) * bend + g.stiffness * g.lever(sine, cosine) ** 2
        return -0.5 * self.energy_parameter * self.swing**2 * self._velocity(sine, cosine) * change

    def pendulum(self, k: Reals) -> tuple[Reals, Reals]:
        """|sin u| and cos u of every k, |sin(phi/2)| = sin(gamma/4) |sin u|."""
        return self._pendulum(k)[:2]

    def _pendulum(self, k: Reals) -> tuple[Reals, Reals, npt.NDArray[np.bool_]]:
        """sin u, cos u of every k folded into the first half, and which k lay in the second."""
        return kept_for(self._kept, for_each(self.clock, np.asarray(k, dtype=np.float64)), self._turned)

    @cached_property
    def _kept(self) -> Kept[tuple[Reals, Reals, npt.NDArray[np.bool_]]]:
        return {}

    def _turned(self, k: Reals) -> tuple[Reals, Reals, npt.NDArray[np.bool_]]:
        require_share(k)
        second = k > 0.5
        folded = np.where(second, 1.0 - k, k)
        near_start = folded <= 0.25
        some, others = columns_of(near_start), columns_of(~near_start)
        v = self._angles(self._from_start, np.minimum(folded[..., some], 0.25))
        u = self._angles(self._from_middle, np.minimum(0.5 - folded[..., others], 0.25))
        sine, cosine = np.empty_like(folded), np.empty_like(folded)
        sine[..., some], cosine[..., some] = np.cos(v), np.sin(v)
        late = ~near_start[..., others]
        sine[..., others] = np.where(late, np.sin(u), sine[..., others])
        cosine[..., others] = np.where(late, np.cos(u), cosine[..., others])
        return sine, cosine, second

    def _angles(self, clock: Clock, k: Reals) -> Reals:
        """Angles at fractions k of the stroke, counted from where the clock starts."""
        found = clock.angles(k) if k.size else k
        if found is not None:
            return found
        raise NoSolution(
            "the motion law reverses too sharply for its positions to be resolved",
            key="unloader.pivot_ratio",
            fix="increase the pivot ratio, or reduce the swing",
        )

    @cached_property
    def _from_start(self) -> Clock:
        """gamma sqrt(N) times the fraction of the stroke from the start to v = pi/2 - u."""

        def time(v: Reals) -> Reals:
            return self.clock.integral(self._elliptic(np.sin(v), np.cos(v)))

        return Clock(time, lambda v: self.slowness(np.cos(v), np.sin(v)), self.swing * self._rate, 0.5 * math.pi)

    @cached_property
    def _clock_from_middle(self) -> CosineSeries:
        return self.clock.from_far_end()

    @cached_property
    def _from_middle(self) -> Clock:
        """The same from mid-swing to u; counted from there k itself is known to its last bit only."""

        def time(u: Reals) -> Reals:
            return self._clock_from_middle.integral(self._elliptic(np.sin(u), self.modulus_complement * np.cos(u)))

        whole = self.swing * self._rate
        return Clock(time, lambda u: self.slowness(np.sin(u), np.cos(u)), whole, 0.5 * math.pi, 4e-16 * whole)

    def _elliptic(self, sine: Reals, cosine: Reals) -> Reals:
        return incomplete_integral(sine, cosine, self.modulus, self.modulus_complement)


# The dissertation's own synthesis of the law of motion: trapezoid march and rescaling of the energy parameter


_FIXED_POINT_LIMIT = 400
_SETTLED, _MOST_PASSES = 1e-12, 100


@dataclass(frozen=True, slots=True)
class LegacyLaw:
    """Result of the iteration.

    Fields
        energy_parameter : float - N
        passes : int - marches until N settled
        rows : list of (pass, N, mu, displacement from the start, displacement from the end)
    """

    energy_parameter: float
    passes: int
    rows: list[tuple[int, float, float, float, float]]


def legacy_law(
    device: Device, swing: float, inertia: Callable[[float], float] | None = None, *, steps: int = 20
) -> LegacyLaw:
    """Law of motion by the dissertation's iteration, marched from both ends to k = 1/2.

    a_{i+1} = a_i + (b_i + b_{i+1}) dk/2 from k = 0 to 1/2 with b = sqrt(N E(a)/j(a))
    mu = 1/(a_forward(1/2) + a_backward(1/2));  N <- mu N, from N = 4 j(1/2)/E(1/2)

    Parameters
        device : Pneumatic, Spring or Gravity
        swing : float [rad] - gamma, 0 to 340 deg
        inertia : function of the share of the swing - j = j0 + (1 - j0) b_kp^2 with a slider; None: 1, of a rocker
            alone, whose halves are mirror images
        steps : int - steps in half the stroke, dk = 0.5/steps
    Raises
        NoSolution - when |mu - 1| has not fallen to 1e-12 in 100 passes, or the rocker leaves its swing during a march
    Notes
        Starts from b(1/2) = 2; a pass shrinks the error by |1 - b(1/2)/2|. The trapezoid leaves an error O(dk^2): with
        the device of the example N is 6.62e-4 too large with 20 steps, 2.65e-5 with 100. The source's exponent of mu is
        illegible; 1 converges for every device tried.
    Example
        >>> from gearlink.core.machines.wide_swing.device import Pneumatic
        >>> law = legacy_law(Pneumatic(2.5), math.radians(120), steps=20)
        >>> round(law.energy_parameter, 3), law.passes < 20
        (4.194, True)

    Source
        wide-swing dissertation (5) to (9), (11) to (14), (16), (17) and figure 4; the two marches: own derivation
    """
    require_swing(swing)
    if steps < 1:
        raise NoSolution(f"{steps} steps: the march needs at least 1", key="iteration_steps")
    geometry = DeviceGeometry(device, swing)
    ways = [_HalfSwing(geometry, inertia)]
    if inertia is not None:
        ways.append(_HalfSwing(geometry, lambda a: inertia(1.0 - a)))
    parameter, rows = (2.0 / ways[0].velocity(0.5, 1.0)) ** 2, []
    for passes in range(1, _MOST_PASSES + 1):
        ends = [_march(way, parameter, steps) for way in ways]
        scale = 1.0 / math.fsum((ends[0], ends[-1]))
        rows.append((passes, parameter, scale, ends[0], ends[-1]))
        if abs(scale - 1.0) <= _SETTLED:
            return LegacyLaw(parameter, passes, rows)
        parameter *= scale
    speed = ways[0].velocity(ends[0], parameter)
    raise NoSolution(
        f"the iteration of the source does not converge: velocity invariant {short(speed)} at half the time",
        key="method",
        fix="omit method",
    )


@dataclass(frozen=True, slots=True)
class _HalfSwing:
    """b(a) of (6), (11), (16), (17) in plain scalars; `inertia`: j(a), none: 1."""

    geometry: DeviceGeometry
    inertia: Callable[[float], float] | None = None

    def velocity(self, a: float, parameter: float) -> float:
        geometry = self.geometry
        device, swing = geometry.device, geometry.swing
        angle = (0.5 - a) * swing
        length = math.hypot(geometry.shortest, geometry.reach * math.sin(0.5 * angle))
        product = math.sin(0.25 * swing - 0.5 * angle) * math.sin(0.25 * swing + 0.5 * angle)
        x = 4.0 * device.pivot_ratio * product / (geometry.longest + length)
        if x < 0.0:
            raise NoSolution(
                f"the source's iteration leaves the swing, at {short(a)} of it",
                key="method",
                fix="increase iteration_steps, or omit method, which gives the law by its integral",
            )
        energy = x
        if isinstance(device, Spring):
            energy *= (1.0 + device.stretch_ratio) * geometry.stroke - 0.5 * x
        elif isinstance(device, Gravity):
            energy = 2.0 * product
        return math.sqrt(parameter * energy if self.inertia is None else parameter * energy / self.inertia(a))


def _require_rest(guess: float, following: float, start: float) -> None:
    """Refuse a step that does not settle; one that swings between its last bits has."""
    if not abs(following - guess) <= 1e-13 * abs(following):
        raise NoSolution(
            f"a step of the source's iteration does not settle, at {start:.4g} of the swing",
            key="iteration_steps",
            fix="increase iteration_steps",
        )


def _march(half: _HalfSwing, parameter: float, steps: int) -> float:
    """Displacement at k = 1/2 by the implicit trapezoid, each step a fixed point."""
    dk = 0.5 / steps
    a = b = 0.0
    for _ in range(steps):
        # a = 0 solves the first step too; any a > 0 leads away from it
        guess = a + (b * dk if b > 0.0 else 0.25 * dk)
        for _ in range(_FIXED_POINT_LIMIT):
            b_next = half.velocity(guess, parameter)
            following = a + 0.5 * (b + b_next) * dk
            settled = abs(following - guess) <= 4e-16 * following
            guess = following
            if settled:
                break
        else:
            _require_rest(guess, following, a)
        a = guess
        b = half.velocity(guess, parameter)
    return a
