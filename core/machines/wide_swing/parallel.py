"""Twin cams on parallel shafts: two bodies of their own, geared one to one, each with its arm of the rocker.

The rocker's axis D at 0, the first shaft at a_1 on the reference direction, the second at a_2 in the direction psi;
each roller arm lies on the line from D to its shaft at mid-swing.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.errors import MissingSection, in_section
from gearlink.core.base.report import Check
from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.checks import GEAR_QUANTITIES

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.cam import WideSwingCam
    from gearlink.core.machines.wide_swing.cycle import ClosedCam
    from gearlink.core.machines.wide_swing.design import WideSwingDesign
    from gearlink.core.machines.wide_swing.spec import SecondShaft
    from gearlink.core.numerics.arrays import Points, Reals
    from gearlink.core.parts.gears.mesh.pair import GearPair

OF_GEARS = tuple(f"shaft_gears.{name}" for name in GEAR_QUANTITIES)
_TURN = 2.0 * math.pi
_COARSE, _FINE = (120, 48), (360, 400)
"""Angles of a revolution and points of a piece of a contour, in the two rounds of the search."""


@dataclass(frozen=True)
class ParallelShafts:
    """Both shafts, from the design; lengths in mm.

    Source
        wide-swing dissertation, figure 2, whose drawing is lost: the layout is a reconstruction
    """

    design: WideSwingDesign

    @property
    def _second(self) -> SecondShaft:
        second = self.design.section.second
        if second is None:
            raise MissingSection("this needs layout: twin-cam-parallel and cam.second: direction", key="cam")
        return second

    @property
    def roller_arm_angle(self) -> float:
        """psi, between the arms of the two rollers, that of the directions to both shafts [rad]."""
        return math.radians(self._second.direction)

    @property
    def cams(self) -> tuple[WideSwingCam, WideSwingCam]:
        """The cam of the working stroke and that of the return stroke."""
        _ = self._second
        other = self.design.return_cam
        assert other is not None, "the second cam has a shaft of its own"
        return self.design.even_cam, other

    @property
    def shafts(self) -> tuple[complex, complex]:
        """Both shafts, from the rocker's axis [mm]."""
        first, second = self.cams
        return complex(first.center_distance), cmath.rect(second.center_distance, self.roller_arm_angle)

    @property
    def shaft_distance(self) -> float:
        """|O1 O2|, |.|^2 = a_1^2 + a_2^2 - 2 a_1 a_2 cos psi [mm]."""
        return abs(self.shafts[1] - self.shafts[0])

    @property
    def _outer(self) -> tuple[float, float]:
        """Maximum radius of both profiles [mm]."""
        first, second = self.cams
        return first.max_radius - first.roller_radius, second.max_radius - second.roller_radius

    @property
    def cam_gap(self) -> float:
        """Room between the circles of both cams, as if in one plane [mm]; negative where they overlap."""
        return self.shaft_distance - sum(self._outer)

    @property
    def cam_shaft_gap(self) -> float:
        """Minimum room between a cam and the shaft of the other [mm]."""
        return self.shaft_distance - max(self._outer) - self.design.section.shaft_radius

    @cached_property
    def gears(self) -> GearPair:
        """The pair 1:1 between the shafts, so that the cams turn against each other."""
        from gearlink.core.parts.gears.from_spec import pair_at

        given = self.design.spec.gears
        if given is None:
            raise MissingSection("this needs the section gears: module", key="gears")
        # what m z leaves of the distance is made up by positive shift
        teeth = given.teeth or int(self.shaft_distance * math.cos(math.radians(given.helix_angle)) / given.module)
        with in_section("gears"):
            return pair_at(given, (teeth, teeth), self.shaft_distance)

    # In one plane

    @cached_property
    def plane_gap(self) -> float:
        """Least room in one plane [mm]: circles where they clear, else the contours over a turn; and each roller
        beside the other cam."""
        gap = self.cam_gap
        if gap < 0.0 and self.design.spec.cycle is not None:
            gap = self._contour_gap
        return min(gap, self._roller_gap)

    @property
    def _roller_gap(self) -> float:
        """Minimum clearance between a roller, over its swing, and the circle of the other cam [mm]."""
        from gearlink.core.numerics.extremes import minimum_over

        half, found = 0.5 * self.design.motion.swing, []
        for number, cam in enumerate(self.cams):
            arm = cmath.rect(cam.rocker_radius, (0.0, self.roller_arm_angle)[number])
            other = self.shafts[1 - number]

            def room(phi: Reals, arm: complex = arm, other: complex = other) -> Reals:
                return np.asarray(np.abs(arm * np.exp(1j * phi) - other))

            nearest = minimum_over(room, -half, half, samples=128).value
            found.append(nearest - self._outer[1 - number] - cam.roller_radius)
        return min(found)

    @property
    def _contour_gap(self) -> float:
        """Minimum distance of both closed contours while the cams turn against each other; negative: how deep they cut.

        Notes
            Looked for from coarse to fine, points against points: off by the square of their distance over the gap.
        """
        whole = self.design.cycle
        pairs = [(_outline(whole.main, count), _outline(whole.back, count)) for _, count in (_COARSE, _FINE)]
        angles = np.linspace(0.0, _TURN, _COARSE[0], endpoint=False)
        rough = self._gaps(*pairs[0], angles)
        best, step = float(angles[int(np.argmin(rough))]), _TURN / _COARSE[0]
        near = np.linspace(best - step, best + step, _FINE[0] // 8)
        return float(self._gaps(*pairs[1], near).min())

    def _gaps(self, first: Points, second: Points, angles: Reals) -> Reals:
        """The gap at cam angles from the start of the working stroke."""
        from scipy.spatial import cKDTree

        whole, (near, far) = self.design.cycle, self.shafts
        tree = cKDTree(np.column_stack((second.real, second.imag)))
        order = np.argsort(np.angle(second))
        polar, radius = np.angle(second)[order], np.abs(second)[order]
        turned = cmath.exp(-1j * self.roller_arm_angle)
        late = whole.angles[0] + whole.angles[1]
        found = []
        for angle in angles.tolist():
            world = near + first * cmath.exp(-1j * (angle - 0.5 * whole.main.own))
            seen = np.conj((world - far) * turned) * cmath.exp(1j * (angle - late - 0.5 * whole.back.own))
            distance = tree.query(np.column_stack((seen.real, seen.imag)))[0]
            inside = np.abs(seen) < np.interp(np.angle(seen), polar, radius, period=_TURN)
            found.append(float(np.where(inside, -distance, distance).min()))
        return np.array(found)


def _outline(cam: ClosedCam, count: int) -> Points:
    return np.concatenate([points for _, points in cam.outline(count)])


def cam_clearance(design: WideSwingDesign) -> Iterator[Check]:
    """GL541: two cams on parallel shafts beside each other."""
    from gearlink.core.machines.wide_swing import codes

    if design.section.second is None or not design.has_profile:
        return
    shafts, limit = design.shafts, design.spec.limits.cam_gap
    same = design.section.planes == "same"
    gap = min(shafts.cam_shaft_gap, shafts.plane_gap) if same else shafts.cam_shaft_gap
    what = "cams, rollers and shafts in one plane" if same else "each cam and the shaft of the other"
    fix = "set cam.planes to separate" if same else "set cam.second.direction farther from 0"
    yield codes.CAM_CLEARANCE.check(
        "fail" if gap < limit else "pass", f"clearance between {what}", gap, limit, "mm", fix=fix if gap < limit else ""
    )
