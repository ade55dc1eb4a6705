"""A ring as a pinion cutter shapes it: root and form radius, fillet, and the rack tool that stands for the cutter; its
interferences with a pinion: involute, tip fouling, radial assembly.

Each margin is a length at the ring's tip circle, negative where the teeth cut into each other.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar, cast

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import unlike
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.gears.mesh.pitch_pair import PitchPair, bound_of_shift_sum
from gearlink.core.parts.gears.tooth.tools import PinionCutter, RackTool

if TYPE_CHECKING:
    from gearlink.core.parts.gears.mesh.pair import GearPair


@dataclass(frozen=True, kw_only=True)
class ShapedRing:
    """The root of a ring.

    inv(alpha_w0) = inv(alpha_t) + 2 (x_2 + x_0) tan(alpha_n)/(z_2 + z_0),  |r_f2| = |a_0| + r_a0

    Parameters
        module : float [mm]
        teeth : int - z_2, negative
        shift : float [module] - x_2
        pressure_angle, helix_angle : float [rad] - alpha_n, beta
    Returns
        Properties: lengths in mm; radii are magnitudes.
    Raises
        NoSolution - where the cutter is too large for the ring, leaves no pressure angle, or its tip rounding does not
            fit on its teeth
    Notes
        The rounding of a helical cutter is taken as a circle of the transverse section.
    Example
        >>> cutter = PinionCutter(teeth=25, shift=0.1)
        >>> ring = ShapedRing(module=2.0, teeth=-67, shift=-0.3, cutter=cutter, pressure_angle=math.radians(20.0))
        >>> round(ring.root_radius, 6), round(ring.form_radius, 6)
        (70.086958, 69.599935)

    Source
        ISO 21771; own derivation of the form radius
    """

    meshes: ClassVar[type[PitchPair]] = PitchPair

    module: float
    teeth: int
    shift: float
    cutter: PinionCutter
    pressure_angle: float
    helix_angle: float = 0.0

    def __post_init__(self) -> None:
        self._require_tip()
        self._require_pressure_angle()

    def _require_tip(self) -> None:
        if self._spare(self.cutter.rounding) >= 0.0:
            return
        if self._spare(0.0) < 0.0:
            base = self.mesh.base_radius[0]
            what, way = ("pointed", "reduce") if self.cutter_tip > base else ("without an involute", "increase")
            text = f"the teeth of the cutter are {what}: {way} its addendum or its shift"
            raise NoSolution(text, key="cutter.addendum")
        most = bracketed_root(self._spare, 0.0, self.cutter.rounding)
        raise NoSolution(
            f"tip rounding of the cutter: {unlike(self.cutter.rounding, most)} modules (limit <= "
            f"{unlike(most, self.cutter.rounding)} modules)",
            key="cutter.rounding",
            fix=f"set cutter.rounding to at most {safely_below(most)}",
        )

    def _require_pressure_angle(self) -> None:
        total, bound = self.mesh.shift_sum, bound_of_shift_sum(self.mesh)
        if not total <= bound:
            raise NoSolution(
                f"sum of the profile shifts of cutter and ring: {unlike(total, bound)} (limit <= "
                f"{unlike(bound, total)}: no working pressure angle of the cutter in the ring)",
                key="cutter.shift",
                fix="reduce cutter.shift or the profile shift of the ring",
            )

    def _spare(self, rounding: float) -> float:
        """Room for the tip rounding [module], negative where its centre lies inside the base circle or beyond the
        middle of the tooth.
        """
        center, base = self.cutter_tip - self.module * rounding, self.mesh.base_radius[0]
        inside = (center - base) / self.module
        return inside if inside < 0.0 else min(inside, self._beside(center, rounding) * center / self.module)

    @cached_property
    def mesh(self) -> PitchPair:
        """Cutter and ring while the last cut is taken."""
        return self.meshes(
            module=self.module,
            teeth=(self.cutter.teeth, self.teeth),
            pressure_angle=self.pressure_angle,
            helix_angle=self.helix_angle,
            given_shift=(self.cutter.shift, self.shift),
        )

    @cached_property
    def cutter_tip(self) -> float:
        """r_a0 = r_0 + (h_a0* + x_0) m."""
        return self.mesh.reference_radius[0] + self.module * (self.cutter.addendum + self.cutter.shift)

    @cached_property
    def root_radius(self) -> float:
        """|r_f2| = |a_0| + r_a0."""
        return self.cutter_tip - self.mesh.center_distance

    @cached_property
    def depth(self) -> float:
        """h_fP2* of the rack tool that leaves the same root circle [module]."""
        return (self.root_radius + self.mesh.reference_radius[1]) / self.module + self.shift

    @cached_property
    def _rounding_center(self) -> float:
        return self.cutter_tip - self.module * self.cutter.rounding

    @cached_property
    def _flank_end(self) -> float:
        """Radius of curvature of the cutter's flank where its rounding begins."""
        base = self.mesh.base_radius[0]
        center = self._rounding_center
        return math.sqrt(max(0.0, (center - base) * (center + base))) + self.module * self.cutter.rounding

    @cached_property
    def form_radius(self) -> float:
        """|r_Ff2|, where the involute that the cutter's flank leaves ends towards the root."""
        r0, r2 = self.mesh.base_radius
        fn = self.mesh.fn
        mate = (r0 + r2) * fn.tan(self.mesh.working_pressure_angle) - self._flank_end
        return fn.least(self.root_radius, fn.hypot(r2, mate))

    @cached_property
    def substitute(self) -> RackTool:
        """The rack tool whose fillet stands for the cutter's in the rating of the root.

        rho_fPv* = rho_0* + (x_0 + h_fP* - rho_0*)^1.95/(3.156 1.036^z_0)

        Notes
            Its section and lever serve; its fillet radius does not: up to 18 % less than the shaped one, less even than
            the rounding of the cutter's own tip, which is impossible (11.17 mm for 13.57 of a tip of 13.50).
        Source
            ISO 6336-3, from memory
        """
        rho, left = self.cutter.rounding, self.cutter.shift + self.depth - self.cutter.rounding
        rounding = rho + self.mesh.fn.greatest(0.0, left) ** 1.95 / (3.156 * 1.036**self.cutter.teeth)
        return RackTool(addendum=self.depth, rounding=rounding)

    @cached_property
    def virtual(self) -> ShapedRing:
        """The ring of module 1 in the normal section: virtual spur gears of z/(cos^2(beta_b) cos(beta)) teeth."""
        turned = math.cos(self.mesh.base_helix_angle) ** 2 * math.cos(self.helix_angle)
        cutter = replace(self.cutter, teeth=cast(int, self.cutter.teeth / turned))
        return replace(self, module=1.0, teeth=cast(int, self.teeth / turned), cutter=cutter, helix_angle=0.0)

    @cached_property
    def fillet_radius(self) -> float | None:
        """rho_F* of the fillet where its tangent makes 60 deg with the middle of the tooth [module]; None without.

        rho = rho_0 + |C'|^3/|Im(C'' conj C')|, C the path of the centre of the cutter's rounding: a hollow that a round
        tip cuts is nowhere sharper than the tip.
        """
        ring = self.virtual
        start, end = ring.turns
        if (ring.leaning(start) > 0.0) == (ring.leaning(end) > 0.0):
            return None
        return ring.radius_at(bracketed_root(ring.leaning, start, end))

    def leaning(self, turn: float) -> float:
        """Angle between the tangent of the fillet and the middle of the tooth, less 60 deg [rad]."""
        fn = self.mesh.fn
        ahead: Any = self._path(turn)[1] * fn.turn(math.pi / self.teeth)  # the ring's teeth are negative
        return fn.atan2(abs(ahead.imag), abs(ahead.real)) - math.pi / 3.0

    def radius_at(self, turn: float) -> float:
        """Radius of the fillet [module] of a ring of module 1."""
        _, ahead, bent = self._path(turn)
        across: Any = bent * ahead.conjugate()
        found: float = self.cutter.rounding + abs(ahead) ** 3 / abs(across.imag)
        return found

    def _path(self, turn: float) -> tuple[complex, complex, complex]:
        """The path of the centre of the cutter's rounding and its derivatives by the turn of `fillet`."""
        fn, rolled = self.mesh.fn, self.cutter.teeth / -self.teeth
        beside, sense = self._half_angle_of_center, fn.copysign(1.0, self._turned_to_flank)
        turn = sense * turn - (1.0 - sense) * beside
        carried = -self.mesh.center_distance * fn.turn(-rolled * turn)
        own, by = self._rounding_center * fn.turn((1.0 - rolled) * turn + beside), 1.0 - rolled
        return carried + own, 1j * (by * own - rolled * carried), -(by * by * own + rolled * rolled * carried)

    def fillet(self, turn: float) -> complex:
        """Point of the fillet, the ring's x axis in the middle of a space, over the angle of the cutter [rad].

        The cutter's rounding leaves the envelope of its circle: the centre's path, moved outwards along its normal,
        which passes the pitch point. Where that lies beyond the centre the cutter turns the other way from the root
        circle to the flank.
        """
        z0, z2, fn = self.cutter.teeth, -self.teeth, self.mesh.fn
        a0, radius = -self.mesh.center_distance, self._rounding_center
        beside, sense = self._half_angle_of_center, fn.copysign(1.0, self._turned_to_flank)
        turn = sense * turn - (1.0 - sense) * beside
        axis = turn * z0 / z2
        back = fn.turn(-axis)
        center = a0 * back + radius * fn.turn(turn - axis + beside)
        normal, where = sense * (center - (a0 + a0 * z0 / (z2 - z0)) * back), cast(Any, fn.where)
        normal = where(normal == 0.0, center, normal)  # a centre on the pitch point leaves its own arc
        point: complex = center + self.module * self.cutter.rounding * normal / abs(normal)
        return point

    @cached_property
    def _turned_to_flank(self) -> float:
        """Turn of the cutter from where its rounding leaves the root circle to where its flank ends [rad].

        The angle from the line of centres to the rounding's centre when that lies on the line of action; negative
        where the pitch point lies beyond it.
        """
        rolled = self._flank_end - self.module * self.cutter.rounding
        return math.atan2(rolled, self.mesh.base_radius[0]) - self.mesh.working_pressure_angle

    @cached_property
    def turns(self) -> tuple[float, float]:
        """Turns at the ends of the fillet: root circle and flank [rad], counted so that they rise."""
        start = -self._half_angle_of_center
        return start, start + abs(self._turned_to_flank)

    @cached_property
    def _half_angle_of_center(self) -> float:
        """Polar angle of the rounding's centre beside the middle of the cutter's tooth [rad]."""
        return self._beside(self._rounding_center, self.cutter.rounding)

    def _beside(self, center: float, rounding: float) -> float:
        mesh, x0, z0 = self.mesh, self.cutter.shift, self.cutter.teeth
        base, alpha = mesh.base_radius[0], mesh.transverse_pressure_angle
        half = (math.pi / 2.0 + 2.0 * x0 * math.tan(self.pressure_angle)) / z0 + math.tan(alpha) - alpha
        roll = math.sqrt(max(0.0, (center / base) ** 2 - 1.0))
        offset = self.module * rounding / base
        return half - (roll - math.atan(roll)) - offset


@dataclass(frozen=True)
class InternalInterference:
    """What may keep a pinion and a ring from turning, or from being put together.

    Parameters
        pair : GearPair - with a ring as gear 2
    Notes
        Tip fouling is exact: 320 pairs followed through a whole revolution agreed in sign. Radial assembly covers every
        phase of the teeth: 80 pairs pushed in at 12 phases agreed.
    Example
        >>> from gearlink.core.parts.gears.mesh.pair import GearPair
        >>> close = InternalInterference(GearPair(module=1.0, teeth=(43, -50), given_shift=(0.0, -0.06)))
        >>> round(close.tip_fouling_angle, 7), round(close.radial_assembly_angle, 5)
        (0.0004113, -0.02215)

    Source
        own derivation; SDP/SI D785 table 5-4 for published pairs
    """

    pair: GearPair

    @property
    def involute_margin(self) -> float:
        """rho_A1: how far contact at the ring's tip stays from the pinion's base tangent point [mm]."""
        return self.pair.interference_margin[1]

    @cached_property
    def _tips(self) -> tuple[float, float]:
        """r_a1, |r_a2| [mm]."""
        return self.pair.tip_radius[0], -self.pair.tip_radius[1]

    def _gain(self, gear: int) -> float:
        """inv(alpha_a) - inv(alpha_wt) [rad]."""
        working = self.pair.working_pressure_angle
        return self.pair.fn.involute_rise(working, self.pair.tip_pressure_angle[gear] - working)

    @property
    def tip_circles_apart(self) -> float:
        """|a_w| - (r_a1 - |r_a2|) [mm]; negative where the pinion's tip circle encloses the ring's."""
        return -self.pair.center_distance - (self._tips[0] - self._tips[1])

    @cached_property
    def _heron(self) -> float:
        """16 squared areas of the triangle of both axes and the crossing of the tip circles; negative: none."""
        (tip1, tip2), a = self._tips, -self.pair.center_distance
        return (tip1 + tip2 + a) * (tip1 + tip2 - a) * (a + tip1 - tip2) * self.tip_circles_apart

    @cached_property
    def tip_fouling_angle(self) -> float | None:
        """F [rad] at the ring's axis; None where the tip circles do not cross, so that nothing can foul.

        F = z_1/|z_2| (d_1 + inv(alpha_a1) - inv(alpha_wt)) + inv(alpha_wt) - inv(alpha_a2) - d_2,
        d_1, d_2 the angles from the line of centres to where the tip circles cross
        """
        return None if self._heron < 0.0 else self._fouling_angle

    @property
    def _fouling_angle(self) -> float:
        (tip1, tip2), a, fn = self._tips, -self.pair.center_distance, self.pair.fn
        # Four areas (Heron): an arctangent stands a touch of the circles.
        area, squares = fn.sqrt(self._heron), (tip2 - tip1) * (tip2 + tip1)
        d1, d2 = fn.atan2(area, squares - a * a), fn.atan2(area, squares + a * a)
        z1, z2 = self.pair.teeth
        return z1 / -z2 * (d1 + self._gain(0)) - self._gain(1) - d2

    @property
    def tip_fouling_margin(self) -> float | None:
        """F |r_a2| [mm]."""
        angle = self.tip_fouling_angle
        return None if angle is None else angle * self._tips[1]

    @property
    def _opening(self) -> float:
        """Q = |r_a2|/r_a1."""
        return self._tips[1] / self._tips[0]

    @property
    def _is_too_large(self) -> bool:
        return self._opening <= 1.0

    @property
    def _always_opens(self) -> bool:
        return self.pair.teeth[0] * self._opening >= -self.pair.teeth[1]

    @cached_property
    def radial_assembly_angle(self) -> float | None:
        """G [rad] at the pinion's axis, -inf where the pinion is larger than the opening; None where it always fits.

        G = t_1 + inv(alpha_a1) - inv(alpha_wt) - |z_2|/z_1 (t_2 + inv(alpha_a2) - inv(alpha_wt)),
        sin(t_1) = sqrt((1 - (z_1 Q/z_2)^2)/(1 - (z_1/z_2)^2)), sin(t_2) = sin(t_1)/Q, Q = |r_a2|/r_a1; for every phase
        of the teeth, which helical gears as wide as an axial pitch have all at once
        """
        if self._is_too_large:
            return -math.inf
        return None if self._always_opens else self._assembly_angle

    @property
    def _assembly_angle(self) -> float:
        q, fn = self._opening, self.pair.fn
        z1, z2 = self.pair.teeth[0], -self.pair.teeth[1]
        ratio = z1 / z2
        # Both cosines are sqrt(q^2 - 1) times a number: nothing has to be held below 1.
        sine, cosine = fn.sqrt((1.0 - ratio * q) * (1.0 + ratio * q)), fn.sqrt((q - 1.0) * (q + 1.0))
        t1, t2 = fn.atan2(sine, ratio * cosine), fn.atan2(sine, cosine)
        return t1 + self._gain(0) - z2 / z1 * (t2 + self._gain(1))

    @property
    def radial_assembly_margin(self) -> float | None:
        """G z_1/|z_2| |r_a2| [mm]."""
        angle = self.radial_assembly_angle
        if angle is None:
            return None
        return angle * self.pair.teeth[0] / -self.pair.teeth[1] * self._tips[1]
