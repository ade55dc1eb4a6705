"""The whole cycle of a wide swing, whose cams are closed contours.

In its own stroke the cam guides the rocker; in the other stroke the rocker comes back, guided by the other cam, and
this one only has to keep clear of the roller. During the rests the contour is an arc about the cam axis.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.report import Table
from gearlink.core.base.results import cached_property
from gearlink.core.base.rows import row_numbers
from gearlink.core.machines.wide_swing.cam import CurveState, StrokeLaw, WideSwingCam
from gearlink.core.machines.wide_swing.law import MiddleView
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.numerics.extremes import Extreme, extremes_over
from gearlink.core.numerics.together import kept_last
from gearlink.core.parts.cams.undercut import Undercut, undercut

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.design import WideSwingDesign


SECTORS = ("stroke", "rest", "free", "rest before")
_TURN = 2.0 * math.pi
_RAMP = 0.1
"""Share of the free sector over which the clearance grows from the arc's, and falls to it again."""


_PLACES, _SAMPLES = (0.0, 3.0, 4.0, 7.0, 8.0), 4097
"""Where the sectors start among the places that are searched for a cut: a stroke has three times those of a rest."""


def _parts_of_sectors(places: Reals) -> Iterator[tuple[int, NDArray[np.intp], Reals]]:
    """Number of each sector, which places lie in it, and there the parts of it."""
    number = np.searchsorted(_PLACES[1:4], places, side="right")
    for sector, (start, end) in enumerate(pairwise(_PLACES)):
        here = np.flatnonzero(number == sector)
        if here.size:
            yield sector, here, (places[here] - start) / (end - start)


Seen: TypeAlias = tuple[MiddleView, Reals]


def _seen(law: StrokeLaw, turn: Reals) -> Seen:
    """A law, and k - k*, at its angles."""
    return law.view_at(turn), law.share_from_middle(turn)


@lru_cache(maxsize=8)
def _kept(law: StrokeLaw, turns: bytes) -> Seen:
    """The same, kept for the other cam and other designs of one law, which ask at the same angles."""
    return _seen(law, np.frombuffer(turns))


@dataclass(frozen=True, slots=True)
class Joint:
    """Where two sectors of a contour meet; radii and angles are those of the pitch curve.

    Fields
        cam_angle : float [rad] - from the start of the cam's own stroke
        radius : float [mm] - from the cam axis to the roller centre
        tangent_step : float [rad] - between the tangents of the two sectors
        before, after : float [mm] - curvature radius on either side, positive with the centre towards the cam axis
    """

    cam_angle: float
    radius: float
    tangent_step: float
    before: float
    after: float


@dataclass(frozen=True)
class ClosedCam:
    """Contour of a cam over one revolution, in lengths of mm and the frame of `CurveState`: mid-stroke on the -x axis.

    z = e^{i theta}(-1 + lambda e^{i psi}) a, psi(theta): the law, +gamma/2, the law backwards, -gamma/2

    Parameters
        cam : WideSwingCam - of its own stroke
        after : float [rad] - cam angle of the rest that follows its own stroke
        other : float [rad] - cam angle of the stroke that the other cam guides
        clearance : float [mm] - room between the roller and the free sector
    Raises
        NoSolution - for angles that do not leave room in a revolution, and a profile that does not exist
    Notes
        The clearance grows from nothing at both ends of the free sector, so that the contour has no corner there.
    Example
        >>> from gearlink.core.machines.wide_swing.law import ElasticLaw, Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.6), math.radians(120))
        >>> cam = WideSwingCam("twin-cam", law, math.radians(100), 200.0, 8.0)
        >>> closed = ClosedCam(cam, math.radians(60), math.radians(120))
        >>> [round(math.degrees(x), 9) for x in closed.sectors]
        [62.058733486, 60.0, 157.941266514, 80.0]
    """

    cam: WideSwingCam
    after: float
    other: float
    clearance: float = 0.0

    def __post_init__(self) -> None:
        self.cam.require_profile()
        if self.other <= 0.0 or min(self.after, self.before) < 0.0:
            raise NoSolution(
                "the sectors of a closed cam must be 0 or more, its strokes above 0, and fill one revolution"
            )

    @property
    def own(self) -> float:
        """Cam angle of its own stroke [rad]."""
        return self.cam.cycle_angle

    @property
    def before(self) -> float:
        """Cam angle of the rest that comes before its own stroke [rad]; rounding of the sum is taken off."""
        rest = _TURN - self.own - self.after - self.other
        return 0.0 if abs(rest) < 1e-12 else rest

    @cached_property
    def starts(self) -> tuple[float, float, float, float, float]:
        """Cam angles at which the four sectors start, and a whole revolution [rad]."""
        second = self.own + self.after
        return 0.0, self.own, second, second + self.other, _TURN

    @cached_property
    def sectors(self) -> tuple[float, float, float, float]:
        """Polar angles of driven profile, arc, free sector, arc on the cam [rad]; their sum is one revolution.

        own - 2 xi, after, other + 2 xi, before; xi the profile correction at the ends of the stroke
        """
        turned = 2.0 * self.cam.profile_correction
        return self.own - turned, self.after, self.other + turned, self.before

    @property
    def rest_radius(self) -> float:
        """Pitch radius during both rests [mm]; the maximum of an external, the minimum of an internal profile."""
        return self.cam.end_radius

    # Points

    def sector_at(self, t: Reals) -> Reals:
        """Number of the sector in which a cam angle from 0 to a turn lies; a joint belongs to the one that follows."""
        return np.asarray(np.searchsorted(self.starts[1:4], t, side="right"))

    def swing_share(self, t: Reals) -> Reals:
        """k, fraction of its own stroke at which the rocker stands so."""
        return np.asarray(np.interp(t, self.starts, (0.0, 1.0, 1.0, 0.0, 0.0)))

    def state(self, sector: int, t: Reals) -> CurveState:
        """The state of the pitch curve at cam angles of one sector, by that sector's own formula to its ends."""
        start, end = self.starts[sector], self.starts[sector + 1]
        if sector % 2:
            return self._resting(t, 1.0 if sector == 1 else 0.0)
        share = np.clip((t - start) / (end - start), 0.0, 1.0)
        k = share if sector == 0 else 1.0 - share
        return self._driven(sector, self.cam.law.middle_view(k), k - 0.5, t)

    def _driven(self, sector: int, view: MiddleView, share: Reals, t: Reals) -> CurveState:
        """The state in one of both strokes, of a view of the law at k - 1/2."""
        cam = self.cam
        driven = cam.state_of(view, share)
        if sector == 0:
            return driven
        a, bend = cam.rates(view, -self.other)
        return replace(driven, theta=t - 0.5 * self.own, a=a, e=1.0 - cam.ratio * a, bend=bend)

    def _resting(self, t: Reals, end: float) -> CurveState:
        at, ones = self.cam.state(np.array([end])), np.ones_like(t)
        theta = t - 0.5 * self.own
        return replace(at, k=end * ones, theta=theta, psi=at.psi * ones, turning=ones, s=at.s * ones).resting()

    def _by_turn(
        self, sector: int, part: Reals, seen: Callable[[StrokeLaw, Reals], Seen] = _seen
    ) -> tuple[CurveState, Reals]:
        """The state, and the cam angle, at parts of a sector, which divide a stroke evenly by the angle of the law."""
        start, end, law = self.starts[sector], self.starts[sector + 1], self.cam.law
        if sector % 2:
            t = start + part * (end - start)
            return self.state(sector, t), t
        sense = 1.0 if sector == 0 else -1.0
        view, share = seen(law, sense * law.turns[1] * (2.0 * part - 1.0))
        t = start + (0.5 + sense * share) * (end - start)
        return self._driven(sector, view, share, t), t

    def pitch(self, t: Reals) -> Points:
        """Roller centres in the cam's frame at cam angles from 0 to a revolution [mm]."""
        return self._by_sector(t, self.pitch_of)

    def pitch_of(self, sector: int, t: Reals) -> Points:
        """Roller centres at cam angles of one sector [mm]."""
        return self._pitch(self.state(sector, t))

    def _pitch(self, state: CurveState) -> Points:
        points: Points = self.cam.center_distance * state.pitch
        return points

    def contour(self, t: Reals) -> Points:
        """Points of the contour at cam angles from 0 to a turn [mm]; about mid-stroke those of the roller's slot."""
        return self._by_sector(t, self.contour_of)

    def contour_of(self, sector: int, t: Reals) -> Points:
        """Points of the contour at cam angles of one sector [mm]."""
        state = self.state(sector, t)
        return self._contour(sector, state, t, self._pitch(state))

    def _contour(self, sector: int, state: CurveState, t: Reals, pitch: Points) -> Points:
        cam = self.cam
        size = cam.roller_radius + (self.clearance * self._share(t) if sector == 2 else 0.0)
        found = pitch + cam.sense * size * state.normal
        if sector:
            return np.asarray(found)
        start, end = cam.slot
        inside = (state.k > start) & (state.k < end)
        found[inside] = cam.slot_bottom((state.k[inside] - start) / (end - start))
        return np.asarray(found)

    def _share(self, t: Reals) -> Reals:
        """Share of the clearance over the free sector: none at its ends, all after a tenth of it, without a corner."""
        _, _, start, end, _ = self.starts
        way = (t - start) / (end - start)
        u = np.minimum(1.0, np.minimum(way, 1.0 - way) / _RAMP)
        grown: Reals = u - np.sin(_TURN * u) / _TURN
        return grown

    def _by_sector(self, t: Reals, curve: Callable[[int, Reals], Points]) -> Points:
        found = np.empty(t.shape, dtype=np.complex128)
        number = self.sector_at(t)
        for sector in range(4):
            here = number == sector
            if here.any():
                found[here] = curve(sector, t[here])
        return found

    def outline(self, count: int = 160) -> tuple[tuple[str, Points], ...]:
        """The contour in pieces, each beginning where the one before it ends.

        Parameters
            count : int - points of the longest pieces
        Returns
            pieces : (name, points) pairs - "profile", "slot", "profile", "arc", "free", "arc"
        """
        start, end = self.cam.slot
        parts = [(0, "profile", 0.0, start * self.own), (0, "slot", start * self.own, end * self.own)]
        parts.append((0, "profile", end * self.own, self.own))
        parts += [(i, ("arc", "free")[i == 2], self.starts[i], self.starts[i + 1]) for i in (1, 2, 3)]
        steps = np.linspace(0.0, 1.0, count)
        return tuple((name, self.contour_of(i, low + (high - low) * steps)) for i, name, low, high in parts)

    # What is judged

    @cached_property
    def joints(self) -> tuple[Joint, ...]:
        """The joints at the start and end of its own stroke and of the other stroke, in the order of the turn."""
        size = self.cam.center_distance
        ends = [self.state(i, np.array(self.starts[i : i + 2])) for i in range(4)]
        along = [state.normal.tolist() for state in ends]
        bends = [(state.curvature / size).tolist() for state in ends]
        radii = [[1.0 / bend if bend else math.inf for bend in pair] for pair in bends]
        starts = [abs(complex(state.pitch[0])) * size for state in ends]
        return tuple(
            Joint(self.starts[i], starts[i], cmath.phase(along[i][0] / along[i - 1][1]), radii[i - 1][1], radii[i][0])
            for i in range(4)
        )

    @cached_property
    def cut(self) -> Undercut:
        """Deepest cut of the roller, on its way round the turn, into the contour."""

        def points(places: Reals) -> tuple[Points, Points]:
            pitch, contour = (np.empty(places.shape, dtype=np.complex128) for _ in range(2))
            for sector, here, part in _parts_of_sectors(places):
                state, t = self._by_turn(sector, part, lambda law, turn: _kept(law, turn.tobytes()))
                pitch[here] = centres = self._pitch(state)
                contour[here] = self._contour(sector, state, t, centres)
            return pitch, contour

        found = undercut(points, self.cam.roller_radius, end=_PLACES[4], samples=_SAMPLES)
        if found.depth == 0.0:
            return found
        at = np.empty(2)
        for sector, here, part in _parts_of_sectors(np.array([found.cam_angle, found.roller_angle])):
            at[here] = self._by_turn(sector, part)[1]
        return Undercut(found.depth, *at.tolist())

    @cached_property
    def largest_clearance(self) -> float:
        """Clearance from which on the free sector's contour crosses itself [mm]; 0 where the roller alone is too large.

        minimum (R - r_p)/share of the clearance there, R the curvature radius where the roller's path bulges
        """
        sharpest, worst, _ = (each.value for each in self.free)
        if self.cam.roller_radius * sharpest >= 1.0:
            return 0.0
        return 1.0 / worst if worst > 0.0 else math.inf

    @cached_property
    def free(self) -> tuple[Extreme, ...]:
        """Extremes over the free sector: maximum bulge of the roller's path [1/mm] and of its share/(R - r_p), minimum
        distance of the contour from the axis [mm]; of its first half, of which the other is the mirror image."""
        cam, roller = self.cam, self.cam.roller_radius

        def each(part: Reals) -> tuple[Reals, Reals, Reals]:
            state, t = self._by_turn(2, part)
            bend = np.maximum(0.0, state.bulge / cam.center_distance)
            with np.errstate(divide="ignore", invalid="ignore"):
                worst = self._share(t) * bend / (1.0 - roller * bend)
            return bend, worst, np.abs(self._contour(2, state, t, self._pitch(state)))

        of = kept_last(each)
        wanted = [(lambda part, i=i: of(part)[i], i < 2) for i in range(3)]
        return tuple(extremes_over(wanted, 0.0, 0.5, samples=128))

    @cached_property
    def least_radius(self) -> float:
        """Minimum distance of the contour from the cam axis [mm]."""
        slot = self.cam.middle_radius - self.cam.sense * self.cam.roller_radius
        return min(self.free[2].value, slot, self.rest_radius - self.cam.sense * self.cam.roller_radius)


# The whole cycle of a wide-swing mechanism: working stroke, far dwell, return stroke, near dwell, and its cams


PHASES = ("working", "far-dwell", "return", "near-dwell")


class WholeCycle:
    """Both closed contours over one revolution, from the design; every result is computed when it is read."""

    def __init__(self, design: WideSwingDesign) -> None:
        self.design = design
        self.angles = design.motion.cycle_angles
        self.external_working = design.spec.layout != "twin-rocker"

    @cached_property
    def main(self) -> ClosedCam:
        """The cam that guides the working stroke."""
        _, far, back, _ = self.angles
        with at_key("cycle.working"):
            return ClosedCam(self.design.even_cam, far, back, self.design.section.free_clearance)

    @cached_property
    def back(self) -> ClosedCam:
        """The cam that guides the return stroke, in its own frame."""
        working, _, _, near = self.angles
        with at_key("cycle.return"):
            cam = self.design.return_cam or self.design.even_cam
            return ClosedCam(cam, near, working, self.design.section.free_clearance)

    @property
    def contours(self) -> dict[str, ClosedCam]:
        """Both cams by the words that a message calls them."""
        words = ("cam", "return cam") if self.external_working else ("internal profile", "external profile")
        return dict(zip(words, (self.main, self.back), strict=True))

    # Sectors

    @property
    def sectors_external(self) -> tuple[float, ...]:
        """Driven profile, arc, free sector, arc of the external profile [rad]; a twin-cam's of its working stroke."""
        return self.main.sectors if self.external_working else self.back.sectors

    @property
    def sectors_internal(self) -> tuple[float, ...] | None:
        """The same of a twin-rocker's internal profile."""
        return None if self.external_working else self.main.sectors

    @property
    def sectors_return(self) -> tuple[float, ...] | None:
        """The same of a twin-cam's second cam."""
        return self.back.sectors if self.external_working else None

    @property
    def longer_stroke_reserve(self) -> float | None:
        """Force to spare in the longer stroke over what balances it, (1 + rho)(longer/shorter)^2 - 1; None where both
        are as long."""
        working, _, back, _ = self.angles
        if working == back:
            return None
        ratio = max(working, back) / min(working, back)
        return (1.0 + self.design.unloading.size.reserve) * ratio**2 - 1.0

    @property
    def plane_room(self) -> float | None:
        """Room between the bodies of a twin-rocker's two profiles during the rests, as if in one plane [mm]."""
        if self.external_working:
            return None
        rollers = self.main.cam.roller_radius + self.back.cam.roller_radius
        return self.main.rest_radius - self.back.rest_radius - rollers

    # In the cams' frames

    def of_main(self, points: Points) -> Points:
        """Points of the working stroke's cam in the frame of the table `main_cam`."""
        return points if self.external_working else -points.conj()

    def of_back(self, points: Points) -> Points:
        """Points of the return stroke's cam: on the twin-rocker's one body, in the frame of its internal profile."""
        if self.external_working:
            return points.conj()
        working, far, back, _ = self.angles
        turned: Points = points.conj() * cmath.exp(-1j * (math.pi + 0.5 * working + far + 0.5 * back))
        return turned

    # Tables

    def table(self, samples: int | None = None) -> Table:
        """Both contours over a revolution of the cam; empty where the roller at mid-swing has cut the profile away."""
        count = samples or 360
        rows = row_numbers(samples, count)
        t = 2.0 * math.pi * np.arange(rows.start, rows.stop) / count
        late = np.mod(t - self.angles[0] - self.angles[1], 2.0 * math.pi)
        sector, swing = self.main.sector_at(t), self.design.motion.swing
        law = self.design.motion.law
        angle = (law.invariants(self.main.swing_share(t), 0)[0] - 0.5) * swing
        columns: dict[str, tuple[Any, str]] = {
            "cam_angle": (np.degrees(t), "deg"),
            "phase": ([PHASES[i] for i in sector], "1"),
            "rocker_angle": (np.degrees(angle), "deg"),
            **_columns("", self.main, t, self.of_main),
            **_columns("return_", self.back, late, self.of_back),
        }
        return Table.of("contour", columns)

    def joints(self) -> Table:
        """The joints of both contours: place, radii, and how tangent and curvature go over."""
        rows = [
            (words, PHASES[(i + 2 * late) % 4], joint)
            for late, (words, cam) in enumerate(self.contours.items())
            for i, joint in enumerate(cam.joints)
        ]
        start = self.angles[0] + self.angles[1]
        places = [joint.cam_angle + (start if late >= 4 else 0.0) for late, (*_, joint) in enumerate(rows)]
        columns: dict[str, tuple[Any, str]] = {
            "cam": ([words for words, *_ in rows], "1"),
            "start_of": ([phase for _, phase, _ in rows], "1"),
            "cam_angle": ([math.degrees(place) % 360.0 for place in places], "deg"),
            "radius": ([joint.radius for *_, joint in rows], "mm"),
            "tangent_step": ([math.degrees(joint.tangent_step) for *_, joint in rows], "deg"),
            "curvature_radius_before": ([joint.before for *_, joint in rows], "mm"),
            "curvature_radius_after": ([joint.after for *_, joint in rows], "mm"),
        }
        return Table.of("joints", columns)


def _columns(prefix: str, cam: ClosedCam, t: Reals, frame: Callable[[Points], Points]) -> dict[str, tuple[Reals, str]]:
    start, end = cam.cam.slot
    k = cam.swing_share(t)
    gone = (cam.sector_at(t) == 0) & (k > start) & (k < end)
    pitch, contour = frame(cam.pitch(t)), frame(cam.contour(t))
    return {
        f"{prefix}pitch_x": (pitch.real, "mm"),
        f"{prefix}pitch_y": (pitch.imag, "mm"),
        f"{prefix}x": (np.where(gone, np.nan, contour.real), "mm"),
        f"{prefix}y": (np.where(gone, np.nan, contour.imag), "mm"),
    }
