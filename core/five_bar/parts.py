"""Gears, links and synthesis of a geared five-bar; what it does with them: `geared_five_bar`."""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import TYPE_CHECKING

from gearlink.core.design import Found, placed
from gearlink.core.errors import NoSolution, at_key
from gearlink.core.five_bar.function_motion import FunctionFiveBar
from gearlink.core.five_bar.path_motion import PathFiveBar
from gearlink.core.gears.train.meshed import Meshed
from gearlink.core.gears.train.single_mesh import mesh_quantity
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.five_bar.fit import Fit
    from gearlink.core.five_bar.function_fit import FunctionFit
    from gearlink.core.five_bar.spec import GearedFiveBarSpec
    from gearlink.core.five_bar.timed_fit import TimedFit
    from gearlink.core.five_bar.wanted import Wanted

MESHES = ("input_idler", "idler_output")
_TURN = 2.0 * math.pi
_LINK_TOLERANCE = 1e-9


class FiveBarParts(Meshed):
    """The five-bar of a design file, given or found, in either form."""

    spec: GearedFiveBarSpec

    form: str = placed("spec.form")

    @property
    def is_path(self) -> bool:
        """Whether the coupler point's path counts."""
        return self.spec.form == "path"

    def completion(self) -> Iterator[Found]:
        """The links that were found in place of the target."""
        target = self.spec.target
        if target is None or (target.function is not None and target.function.links == "given"):
            return
        bar, why = self.bar, "found for target"
        names = ("input", "coupler", "follower", "output", "frame")
        yield Found("links", {name: float(getattr(bar, name)) for name in names}, why)
        yield Found("phase", math.degrees(math.remainder(bar.phase, _TURN)), why)
        yield Found("assembly", bar.assembly, why)
        if self.is_path:
            yield Found("coupler_point", {"along": self.offset.real, "across": self.offset.imag}, why)
        else:
            start, end = (math.degrees(angle) for angle in self.input_range)
            yield Found("range", {"start": start, "end": end}, "from target" if self.spec.range is None else "")
        yield Found("target", None)

    def as_found(self) -> Iterator[Found]:
        """The links; a function that was to be generated goes on judging them."""
        target = self.spec.target
        for one in self.completion():
            judged = one.path == "target" and target is not None and target.function is not None
            yield Found("target.function.links", "given") if judged else one

    # Gears

    own_quantities = frozenset(("center_distance", "contact_ratio"))

    @property
    def signed_teeth(self) -> tuple[int, ...]:
        """Input, idler and output gear of a path, planet and fixed gear of a function."""
        gears = self.spec.gears
        teeth = [getattr(gears, name) or 0 for name in gears.gear_names()]
        return tuple(-z if ring else z for z, ring in zip(teeth, gears.rings(), strict=True))

    @property
    def output_play(self) -> tuple[float, float] | None:
        """Free turn of the output gear of a path [rad]; the output of a function is a link."""
        return super().output_play if self.is_path else None

    @property
    def mesh_names(self) -> tuple[str, ...]:
        """Both meshes of an idler, or the only one."""
        return MESHES if self.spec.gears.idler is not None else ("",)

    @property
    def given_distances(self) -> tuple[float | None, ...]:
        """Frame of a path with gears in direct mesh, input of a function, where the file gives it."""
        links = self.spec.links
        if self.spec.gears.idler is not None:
            return None, None
        return (links.frame if self.is_path else links.input,)

    @property
    def center_distance(self) -> list[float]:  # type: ignore[override]  # one for each mesh
        """Centre distance of each mesh [mm]."""
        return [abs(mesh.center_distance) for mesh in self.meshes.values()]

    @property
    def contact_ratio(self) -> list[float] | None:  # type: ignore[override]
        """Contact ratio of each mesh; None where a ring's tips have no involute."""
        with at_key("gears"):
            found = [mesh_quantity(mesh, "contact_ratio") for mesh in self.meshes.values()]
        return None if None in found else found

    @property
    def ratio(self) -> Fraction:
        """Path: k, output over input speed. Function: m, coupler over input speed."""
        gears = self.spec.gears
        if self.is_path:
            same = gears.idler is not None or gears.mesh == "internal"
            return Fraction(gears.input or 0, gears.output or 1) * (1 if same else -1)
        turn = Fraction(gears.ring or gears.sun or 0, gears.planet or 1)
        return 1 - turn if gears.ring is not None else 1 + turn

    @property
    def five_bar_ratio(self) -> float | None:
        """k of the path form."""
        return float(self.ratio) if self.is_path else None

    @property
    def coupler_ratio(self) -> float | None:
        """m of the function form."""
        return None if self.is_path else float(self.ratio)

    period_turns: int = placed("ratio.denominator")

    @property
    def phase_step(self) -> float | None:
        """Step in which the phase can be set by putting the gears together a tooth on [rad]."""
        return _TURN / self.spec.gears.output if self.is_path and self.spec.gears.output else None

    # Links

    def _fixed_length(self, name: str) -> float:
        """The link that is the gears' centre distance; given too, it must agree."""
        given, distance = getattr(self.spec.links, name), self.center_distance[0]
        fixed = given is not None and self.spec.gears.profile_shift is None
        if fixed and abs(given - distance) > _LINK_TOLERANCE * distance:
            raise NoSolution(
                f"{name} {given:.9g} mm is not the centre distance of the gears, {distance:.9g} mm: leave it out, or "
                "change module or teeth",
                key=f"links.{name}",
            )
        return distance

    def _frame(self) -> float:
        """The frame of the path form."""
        links = self.spec.links
        if self.spec.gears.idler is None:
            return self._fixed_length("frame")
        frame, (first, second) = links.frame or 0.0, self.center_distance
        if not abs(first - second) < frame < first + second:
            raise NoSolution(
                f"the idler does not reach: its centre distances are {first:g} and {second:g} mm, so the frame must "
                f"lie between {abs(first - second):g} and {first + second:g} mm, not {frame:g}: change the idler",
                key="links.frame",
            )
        return frame

    @cached_property
    def start_path(self) -> PathFiveBar:
        """The five-bar of the file, path form; with a target it is the start."""
        links, frame = self.spec.links, self._frame()
        with at_key("links"):
            return PathFiveBar(
                links.input or 0.0,
                links.coupler,
                links.follower,
                links.output,
                frame,
                self.ratio,
                math.radians(self.spec.phase),
                self.spec.assembly,
            )

    @cached_property
    def fit(self) -> Fit | None:
        """What the synthesis of a path found, where the file asks for one."""
        target = self.spec.target
        if not self.is_path or target is None or target.points is None:
            return None
        import numpy as np

        from gearlink.core.five_bar.fit import fit_path

        if self.timed_fit is not None:
            return self.timed_fit.fit
        points = np.array([complex(x, y) for x, y in target.points])
        with at_key("target.points"):
            return fit_path(
                self.start_path, self._start_offset, points, math.radians(self.spec.limits.transmission_angle)
            )

    @cached_property
    def timed_fit(self) -> TimedFit | None:
        """What the synthesis of timed points found, where the file asks for one."""
        target = self.spec.target
        if target is None or target.points is None or target.input_angles is None:
            return None
        import numpy as np

        from gearlink.core.five_bar.timed_fit import fit_timed

        points = np.array([complex(x, y) for x, y in target.points])
        least = math.radians(self.spec.limits.transmission_angle)
        with at_key("target.points"):
            angles = np.radians(target.input_angles)
            return fit_timed(self.start_path, self._start_offset, points, angles, least, target.budget)

    @property
    def _start_offset(self) -> complex:
        point = self.spec.coupler_point
        return 0j if point is None else complex(point.along, point.across)

    @cached_property
    def path_bar(self) -> PathFiveBar:
        """The five-bar of the path form, given or found; it closes over its whole period."""
        bar = self.start_path if self.fit is None else self.fit.bar
        with at_key("links"):
            bar.closure()
        return bar

    @property
    def offset(self) -> complex:
        """The coupler point, u + i v [mm]."""
        return self._start_offset if self.fit is None else self.fit.offset

    @cached_property
    def positions(self) -> list[tuple[float, float]] | None:
        """Pairs of input and output angle that are asked for [rad]."""
        target = self.spec.target
        if target is None or target.positions is None:
            return None
        return [(math.radians(phi), math.radians(psi)) for phi, psi in target.positions]

    @cached_property
    def wanted(self) -> Wanted | None:
        """The function that is asked for."""
        target = self.spec.target
        if target is None or target.function is None:
            return None
        from gearlink.core.five_bar.wanted import Wanted

        asked = target.function
        circular = asked.name in ("sine", "cosine", "tangent")
        low, high = (math.radians(x) if circular else x for x in asked.x)
        with at_key("target.function.x"):
            swings = math.radians(asked.input_swing), math.radians(asked.output_swing)
            return Wanted(asked.name, (low, high), *swings, asked.exponent or 1.0)

    @cached_property
    def function_fit(self) -> FunctionFit | None:
        """What the synthesis of a function found, or how far given links are from it."""
        target, wanted = self.spec.target, self.wanted
        if wanted is None or target is None or target.function is None:
            return None
        from gearlink.core.five_bar.function_fit import FunctionFit, fit_function
        from gearlink.core.five_bar.wanted import structural_error

        if target.function.links == "given":
            start = math.radians(self.spec.range.start) if self.spec.range is not None else 0.0
            with at_key("links"):
                return FunctionFit(self.start_function, start, structural_error(self.start_function, start, wanted), ())
        least = math.radians(self.spec.limits.transmission_angle)
        with at_key("target.function"):
            return fit_function(self.start_function, 0.0, wanted, least, target.budget)

    @cached_property
    def start_function(self) -> FunctionFiveBar:
        """The five-bar of the file, function form; with a target it is the start."""
        links = self.spec.links
        lengths = (self._fixed_length("input"), links.coupler, links.follower, links.output, links.frame or 0.0)
        with at_key("links"):
            return FunctionFiveBar(*lengths, float(self.ratio), math.radians(self.spec.phase), self.spec.assembly)

    @cached_property
    def function_bar(self) -> FunctionFiveBar:
        """The five-bar of the function form, given or found; it closes over the range."""
        if self.function_fit is not None:
            return self.function_fit.bar
        bar, positions = self.start_function, self.positions
        if positions is not None:
            from gearlink.core.five_bar.positions import five_bar_for_positions

            with at_key("target.positions"):
                bar = five_bar_for_positions(bar, positions, math.radians(self.spec.limits.transmission_angle))
        with at_key("range" if self.spec.range is not None else "links"):
            bar.closure(*self.input_range)
        return bar

    @cached_property
    def input_range(self) -> tuple[float, float]:
        """Input angles of the function form [rad]: given, from the first position to the last, or one period."""
        asked = self.spec.range
        if self.function_fit is not None and self.wanted is not None:
            return self.function_fit.start, self.function_fit.start + self.wanted.input_swing
        if asked is not None:
            return math.radians(asked.start), math.radians(asked.end)
        if self.positions is not None:
            return self.positions[0][0], self.positions[-1][0]
        return 0.0, _TURN * self.period_turns

    @property
    def bar(self) -> PathFiveBar | FunctionFiveBar:
        """The five-bar of either form."""
        return self.path_bar if self.is_path else self.function_bar
