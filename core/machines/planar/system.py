"""The equations of a planar mechanism, their matrix, and their Taylor coefficients along a motion, row by row.

Unknown are origin x_k and direction t_k of every link. All equations are of two sorts: pins, and rows that add up a
coordinate along or across a line, a weighted sum of directions, the lift of a cam, a constant and a share of the input.
Lengths are in units of `size`, so that directions and places weigh alike.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gearlink.core.machines.planar.structure import GearJoint, Line, LineJoint, RackJoint, Structure
from gearlink.core.mechanism.blocks import Block, blocks
from gearlink.core.numerics.arrays import Points, Reals

if TYPE_CHECKING:
    from gearlink.core.machines.planar.cams import CamJoint, Contact, Lift

_STRUCTURAL = 1e-12
_SKEW = 0.7  # rad, by which lines are turned where the structure is looked at: those along an axis are no other


class Row(NamedTuple):
    """factor Re or Im(z) of a line + sum of directions by body - lift + contact - constant - rate q = 0."""

    line: Line | None
    across: bool = False
    factor: float = 1.0
    turns: Mapping[int, float] = {}
    constant: Any = 0.0
    rate: float = 0.0
    lift: Lift | None = None
    contact: Contact | None = None


@dataclass
class Jets:
    """Taylor coefficients of origins and directions over the input, by order; bodies in columns, the frame first.

    Fields
        x, t, e : lists of (N, bodies) arrays - origins, directions, e^(i t)
        side : +1 or -1 - of inputs at which a law changes, the one just after or just before
        kept : what rows and systems know of the places, for all orders
    """

    x: list[Points]
    t: list[Reals]
    e: list[Points] = field(default_factory=list)
    side: int = 1
    kept: dict[Any, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        while len(self.e) < len(self.t):
            self.e.append(_unit(self.t, self.e))

    @classmethod
    def of(cls, y: Reals) -> Jets:
        """Of unknowns alone, (N, unknowns)."""
        x, t = split(y)
        return cls([x], [t])

    @property
    def order(self) -> int:
        """The highest order."""
        return len(self.t) - 1

    def point(self, body: int, place: complex, k: int) -> Points:
        """Coefficient of a point of a body."""
        return np.asarray(self.x[k][:, body] + place * self.e[k][:, body])

    def seen(self, line: Line, k: int) -> Points:
        """Coefficient of z of a line."""
        turned = np.exp(-1j * line.direction)
        found = np.zeros(self.t[0].shape[0], dtype=np.complex128)
        for j in range(k + 1):
            apart = self.point(line.other, line.point, k - j) - self.x[k - j][:, line.body]
            found += np.conj(self.e[j][:, line.body]) * apart
        return np.asarray(turned * (found - line.through if k == 0 else found))

    def and_next(self, x: Points, t: Reals) -> Jets:
        """With one more order."""
        return Jets([*self.x, x], [*self.t, t], list(self.e), self.side, self.kept)


def _unit(t: Sequence[Reals], e: Sequence[Points]) -> Points:
    """The next coefficient of e^(i t): k E_k = i sum_(j=1..k) j t_j E_(k-j)."""
    k = len(e)
    if k == 0:
        return np.asarray(np.exp(1j * t[0]))
    return np.asarray(1j / k * sum(j * t[j] * e[k - j] for j in range(1, k + 1)))


class _Lines(NamedTuple):
    """The rows factor Re or Im(z) of lines, side by side; numbers (lines,), of N mechanisms (N, lines).

    Fields
        rows : numbers of the rows
        a, b : bodies of the lines and of the points
        turned, through, point : e^(-i g), a point of the line, the point that is seen
        unit : factor of z whose real part counts
        columns : (lines, 6) - of the matrix
    """

    rows: NDArray[np.intp]
    a: NDArray[np.intp]
    b: NDArray[np.intp]
    turned: Points
    through: Points
    point: Points
    unit: Points
    columns: NDArray[np.intp]

    @classmethod
    def of(cls, on: Sequence[tuple[int, Row, Line]]) -> _Lines:
        """Of rows by number, each with its line."""
        numbers, rows, lines = zip(*on, strict=True)
        a, b = np.array([line.body for line in lines]), np.array([line.other for line in lines])
        turned = np.exp(-1j * _side_by_side([line.direction for line in lines], np.float64))
        through = _side_by_side([line.through for line in lines], np.complex128)
        point = _side_by_side([line.point for line in lines], np.complex128)
        unit = np.array([-1j * row.factor if row.across else row.factor + 0j for row in rows])
        columns = np.stack([3 * b, 3 * b + 1, 3 * b + 2, 3 * a, 3 * a + 1, 3 * a + 2], axis=1)
        return cls(np.array(numbers), a, b, turned, through, point, unit, columns)

    def apart(self, jets: Jets, k: int) -> Points:
        """Coefficient of the points from the origins of the lines' bodies."""
        return np.asarray(jets.x[k][:, self.b] + self.point * jets.e[k][:, self.b] - jets.x[k][:, self.a])

    def seen(self, jets: Jets, k: int) -> Points:
        """Coefficient of z."""
        found = np.conj(jets.e[0][:, self.a]) * self.apart(jets, k)
        for j in range(1, k + 1):
            found += np.conj(jets.e[j][:, self.a]) * self.apart(jets, k - j)
        return np.asarray(self.turned * (found - self.through if k == 0 else found))

    def slopes(self, jets: Jets) -> Reals:
        """Derivatives of the rows by the unknowns of both bodies; (N, lines, 6)."""
        c = self.unit * self.turned * np.conj(jets.e[0][:, self.a])
        arm, reach = 1j * c * self.point * jets.e[0][:, self.b], -1j * c * self.apart(jets, 0)
        return np.stack([c.real, -c.imag, arm.real, -c.real, c.imag, reach.real], axis=-1)


def _side_by_side(numbers: Sequence[Any], dtype: Any) -> Any:
    """Numbers as an array, (M,); where some are (N,) arrays, (N, M)."""
    return np.stack(np.broadcast_arrays(*numbers), axis=-1).astype(dtype) if numbers else np.zeros(0, dtype)


@dataclass(frozen=True)
class System:
    """Equations of a mechanism; pins first, two each, then the rows.

    Parameters
        bodies : int - the frame among them
        pins : ((first, second, place on first, place on second, play), ...) in units of size; as the numbers of lines
            and rows, places may be (N,) arrays of N mechanisms, a row each
        rows : Row, ...
        whole : bool - solved at once: for one row at a time that is quicker than part by part
    """

    bodies: int
    pins: tuple[tuple[int, int, complex, complex, complex], ...]
    rows: tuple[Row, ...]
    whole: bool = False

    @classmethod
    def of(cls, structure: Structure, rows: Iterable[Row]) -> System:
        """Of the pins of a structure, and rows."""
        size = structure.size
        pins = (
            (each.first, each.second, each.at_first / size, each.at_second / size, each.play / size)
            for each in structure.pins
        )
        return cls(len(structure.bodies), tuple(pins), tuple(rows))

    @property
    def count(self) -> int:
        """How many equations."""
        return 2 * len(self.pins) + len(self.rows)

    @property
    def unknowns(self) -> int:
        """How many unknowns: x, y, direction of each link."""
        return 3 * (self.bodies - 1)

    @cached_property
    def _pins(self) -> tuple[NDArray[np.intp], NDArray[np.intp], Points, Points, Points]:
        a, b, *places = zip(*self.pins, strict=True) if self.pins else ((), (), (), (), ())
        s, r, play = (_side_by_side(each, np.complex128) for each in places)
        return np.array(a, dtype=np.intp), np.array(b, dtype=np.intp), s, r, play

    @cached_property
    def _turns(self) -> Reals:
        """Shares of the directions by row and body; (rows, bodies), of N mechanisms (N, rows, bodies)."""
        count = max((np.size(share) for row in self.rows for share in row.turns.values()), default=1)
        shares = np.zeros((count, len(self.rows), self.bodies))
        for i, row in enumerate(self.rows):
            for body, share in row.turns.items():
                shares[:, i, body] = share
        return shares if count > 1 else shares[0]

    @cached_property
    def _constants(self) -> tuple[Reals, Reals]:
        """What the rows are less, and that per input; (rows,) or (N, rows)."""
        constants = _side_by_side([row.constant for row in self.rows], np.float64)
        return constants, _side_by_side([row.rate for row in self.rows], np.float64)

    @cached_property
    def _lines(self) -> _Lines | None:
        """The rows that see a point from a line; None without any."""
        on = [(i, row, row.line) for i, row in enumerate(self.rows) if row.line is not None]
        return _Lines.of(on) if on else None

    def values(self, jets: Jets, k: int, q: Reals) -> Reals:
        """Coefficient k of all equations along a motion; (N, count).

        Parameters
            q : (N,) array - the input, of which coefficient 1 is 1
        """
        pins, (a, b, *_, play) = 2 * len(self.pins), self._pins
        found = np.empty((q.size, self.count))
        x, (first, second) = jets.x[k], self._arms(jets, k)
        gaps = x[:, b] + second - x[:, a] - first
        if k == 0:
            gaps -= play
        found[:, 0:pins:2], found[:, 1:pins:2] = gaps.real, gaps.imag
        if not self.rows:
            return found
        total, shares = found[:, pins:], self._turns
        total[:] = jets.t[k] @ shares.T if shares.ndim == 2 else np.einsum("nrb,nb->nr", shares, jets.t[k])
        if k <= 1:
            constants, rates = self._constants
            total -= constants + rates * q[:, None] if k == 0 else rates
        if (lines := self._lines) is not None:
            total[:, lines.rows] += (lines.unit * lines.seen(jets, k)).real
        for i, row in self._of_cams:
            if row.lift is not None:
                total[:, i] -= row.lift.coefficient(jets, k)
            if row.contact is not None:
                total[:, i] += row.contact.coefficient(jets, k)
        return found

    def _arms(self, jets: Jets, k: int) -> tuple[Points, Points]:
        """Coefficient of what leads from the origins of the first and second bodies to the pins; of order 0 kept."""
        a, b, s, r, _ = self._pins
        if k:
            return s * jets.e[k][:, a], r * jets.e[k][:, b]
        if (kept := (id(self), "arms")) not in jets.kept:
            jets.kept[kept] = s * jets.e[0][:, a], r * jets.e[0][:, b]
        first, second = jets.kept[kept]
        return first, second

    @cached_property
    def _of_cams(self) -> list[tuple[int, Row]]:
        return [(i, row) for i, row in enumerate(self.rows) if row.lift is not None or row.contact is not None]

    @cached_property
    def _still(self) -> Reals:
        """What no motion changes in the matrix, the frame's columns among them; (count, 3 bodies) or (N, ...)."""
        pins, (a, b, *_) = 2 * len(self.pins), self._pins
        shares, even = self._turns, np.arange(0, 2 * len(self.pins), 2)
        found = np.zeros((*shares.shape[:-2], self.count, 3 * self.bodies))
        for bodies, sign in ((a, -1.0), (b, 1.0)):
            found[..., even, 3 * bodies] = sign
            found[..., even + 1, 3 * bodies + 1] = sign
        found[..., pins:, 2::3] = shares
        return found

    def matrix(self, jets: Jets) -> Reals:
        """Derivatives of the equations by the unknowns x_1, y_1, t_1, x_2, ...; (N, count, unknowns)."""
        pins, (a, b, *_) = 2 * len(self.pins), self._pins
        found = np.empty((jets.t[0].shape[0], self.count, 3 * self.bodies))
        found[:] = self._still
        even, (first, second) = np.arange(0, pins, 2), self._arms(jets, 0)
        # i (x + i y) = -y + i x
        for columns, real, imag in ((3 * a + 2, first.imag, -first.real), (3 * b + 2, -second.imag, second.real)):
            found[:, even, columns] = real
            found[:, even + 1, columns] = imag
        if (lines := self._lines) is not None:
            found[:, pins + lines.rows[:, None], lines.columns] += lines.slopes(jets)
        for i, row in self._of_cams:
            if row.lift is not None:
                slope = row.lift.slope(jets)
                for body, share in row.lift.turns.items():
                    found[:, pins + i, 3 * body + 2] -= share * slope
            if row.contact is not None:
                line = _Lines.of([(i, row, row.contact.across(jets))])
                found[:, pins + i, line.columns[0]] += line.slopes(jets)[:, 0]
        return found[:, :, 3:]

    @cached_property
    def pattern(self) -> NDArray[np.bool_]:
        """Where the matrix is not 0 by its structure; (count, unknowns)."""
        rng = np.random.default_rng(1)
        x = rng.normal(size=(3, self.bodies)) + 1j * rng.normal(size=(3, self.bodies))
        t = rng.normal(size=(3, self.bodies))
        x[:, 0], t[:, 0] = 0.0, 0.0
        rows = (_skewed(row) for row in self.rows)
        skew = System(self.bodies, self.pins, tuple(rows))
        return np.asarray(np.abs(skew.matrix(Jets([x], [t]))).max(axis=0) > _STRUCTURAL)

    @cached_property
    def blocks(self) -> tuple[Block, ...]:
        """The parts that can be solved one after the other; all in one where the structure alone is singular."""
        return blocks(tuple(tuple(np.flatnonzero(column).tolist()) for column in self.pattern.T))

    def solved(self, matrix: Reals) -> Solved:
        """The matrix made ready to be solved."""
        everything = Block(tuple(range(self.count)), tuple(range(self.unknowns)))
        return Solved(matrix, (everything,) if self.whole else self.blocks)

    def step(self, jets: Jets, q: Reals) -> Reals:
        """Newton's step; (N, unknowns)."""
        if self.whole:
            right = -self.values(jets, 0, q)[..., None]
            return np.asarray(np.linalg.solve(self.matrix(jets), right)[..., 0])
        return self.solved(self.matrix(jets)).solve(-self.values(jets, 0, q))

    def onward(self, jets: Jets, q: Reals, order: int, matrix: Reals | None = None) -> Jets:
        """Coefficients up to an order by J y_n = -F_n, F_n the coefficient of F with y_n = 0.

        Parameters
            matrix : J, where it is known
        Raises
            LinAlgError - where the matrix is singular
        """
        if order <= jets.order:
            return jets
        solved = self.solved(self.matrix(jets) if matrix is None else matrix)
        still_x, still_t = np.zeros_like(jets.x[0]), np.zeros_like(jets.t[0])
        for k in range(jets.order + 1, order + 1):
            rest = self.values(jets.and_next(still_x, still_t), k, q)
            y = solved.solve(-rest)
            jets = jets.and_next(*split(y))
        return jets

    # Bounds of the certified step

    def bounds(self, jets: Jets) -> tuple[float, float, float, float]:
        """K, K', M of the step, and the fastest that a point moves against a line of a moving body; one row."""
        a, b, s, r, _ = self._pins
        first = np.abs(s), np.abs(r)
        turn = np.abs(jets.t[1][0])
        k = [first[0] + first[1], first[0] * turn[a] + first[1] * turn[b],
             first[0] * turn[a] ** 2 + first[1] * turn[b] ** 2]  # fmt: skip
        squares, fastest = [float(np.sum(each * each)) for each in k], 0.0
        for row in self.rows:
            parts = np.zeros(3) if row.lift is None else np.array(row.lift.bounds(jets))
            line = row.line
            if row.contact is not None:
                parts, line = parts + row.contact.bounds(jets), row.contact.line
            if line is not None:
                of_line, moved = _line_bounds(line, jets)
                parts, fastest = parts + of_line, max(fastest, moved)
            squares = [total + part * part for total, part in zip(squares, parts.tolist(), strict=True)]
        k_size, k_rate, m_size = (total**0.5 for total in squares)
        return k_size, k_rate, m_size, fastest


def _skewed(row: Row) -> Row:
    """A row whose parts all show in the pattern: no line along an axis, no law at a standstill."""
    if row.line is not None:
        row = row._replace(line=row.line._replace(direction=row.line.direction + _SKEW))
    if row.lift is not None:
        row = row._replace(lift=None, turns={**row.lift.turns, **row.turns})
    if row.contact is not None:
        line = row.contact.line
        row = row._replace(contact=None, line=line._replace(direction=line.direction + _SKEW))
    return row


def _line_bounds(line: Line, jets: Jets) -> tuple[tuple[float, float, float], float]:
    """K, K', M of a line, and the fastest that its point moves against it."""
    a, b, s = line.body, line.other, abs(line.point)
    t_b = abs(float(jets.t[1][0, b]))
    if a == 0:
        return (s, s * t_b, s * t_b * t_b), 0.0
    t_a = abs(float(jets.t[1][0, a]))
    moved = abs(complex(jets.x[1][0, b] - jets.x[1][0, a]))
    reach = abs(complex(jets.x[0][0, b] - jets.x[0][0, a])) + 1.0
    against = abs(float(jets.t[1][0, b] - jets.t[1][0, a]))
    root = 2.0**0.5
    return (
        reach + root + 2.0 * s,
        (reach + root) * t_a + moved + root * s * against,
        reach * t_a * t_a + 2.0 * t_a * moved + s * against * against,
    ), moved


_FEW = 32
"""Rows that are solved faster as they are than block by block."""


@dataclass(frozen=True)
class Solved:
    """A matrix (N, m, m), whose blocks are inverted once."""

    matrix: Reals
    blocks: tuple[Block, ...]

    @cached_property
    def _inverses(self) -> list[Reals]:
        found: list[Reals] = []
        for block in self.blocks:
            part = self.matrix[:, np.array(block.rows)[:, None], np.array(block.columns)]
            found.append(np.asarray(1.0 / part if len(block.rows) == 1 else np.linalg.inv(part), dtype=np.float64))
        return found

    def solve(self, right: Reals) -> Reals:
        """x of matrix x = right, of many rows by their blocks and once corrected; (N, m)."""
        if len(right) <= _FEW:
            return np.asarray(np.linalg.solve(self.matrix, right[..., None])[..., 0])
        with np.errstate(all="ignore"):
            found = self._once(right)
            return found + self._once(right - np.einsum("nij,nj->ni", self.matrix, found))

    def _once(self, right: Reals) -> Reals:
        found = np.zeros_like(right)
        for block, inverse in zip(self.blocks, self._inverses, strict=True):
            rows, columns = np.array(block.rows), np.array(block.columns)
            rest = right[:, rows] - np.einsum("nij,nj->ni", self.matrix[:, rows], found)
            found[:, columns] = np.einsum("nij,nj->ni", inverse, rest)
        return found


def split(y: Reals) -> tuple[Points, Reals]:
    """Unknowns as origins and directions, the frame's before them."""
    x = np.zeros((y.shape[0], y.shape[1] // 3 + 1), dtype=np.complex128)
    t = np.zeros(x.shape)
    x[:, 1:] = y[:, 0::3] + 1j * y[:, 1::3]
    t[:, 1:] = y[:, 2::3]
    return x, t


def joined(x: Points, t: Reals) -> Reals:
    """The unknowns of origins and directions."""
    y = np.empty((x.shape[0], 3 * (x.shape[1] - 1)))
    y[:, 0::3], y[:, 1::3], y[:, 2::3] = x[:, 1:].real, x[:, 1:].imag, t[:, 1:]
    return y


# Systems of a structure


def scaled(line: Line, size: float) -> Line:
    """A line in units of size."""
    return line._replace(through=line.through / size, point=line.point / size)


def joint_rows(structure: Structure, turns: Mapping[str, float]) -> list[Row]:
    """Rows of slides and slots; `turns` are whole revolutions [rad] that the direction of a slide's link is apart."""
    found = []
    for slide in structure.slides.values():
        line = scaled(slide.line, structure.size)
        found.append(Row(line, across=True))
        lean = 0.0 if slide.lean is None else slide.lean
        lean = slide.line.direction + lean + turns.get(slide.name, 0.0)
        found.append(Row(None, turns=_weights((line.other, 1.0), (line.body, -1.0)), constant=lean))
    found += (Row(scaled(slot.line, structure.size), across=True) for slot in structure.slots.values())
    return found


def mesh_row(mesh: GearJoint | RackJoint, size: float, constant: float = 0.0) -> Row:
    """The row of a mesh."""
    if isinstance(mesh, RackJoint):
        line, radius = scaled(mesh.line, size), mesh.radius / size
        turns = _weights((line.other, radius), (line.body, -radius))
        return Row(line, factor=float(mesh.side), turns=turns, constant=constant)
    one, other = (radius / size for radius in mesh.radii)
    turns = _weights((mesh.first, one), (mesh.second, other), (mesh.carrier, -one - other))
    return Row(None, turns=turns, constant=constant)


def cam_row(cam: CamJoint, size: float, phase: float, constant: float = 0.0) -> Row:
    """The row of a cam: direction of its follower against the carrier, or place of its slide, less the lift."""
    lift = cam.lift(size, phase)
    if cam.slide is not None:
        return Row(scaled(cam.slide.line, size), constant=constant, lift=lift)
    return Row(None, turns=_weights((cam.follower, 1.0), (cam.carrier, -1.0)), constant=constant, lift=lift)


def driven_row(body: int, slide: LineJoint | None, size: float, start: float, rate: float = 0.0) -> Row:
    """The row of a drive: a direction, or a place of a slide, from its start [rad or size]."""
    if slide is None:
        return Row(None, turns={body: 1.0}, constant=start, rate=rate)
    return Row(scaled(slide.line, size), constant=start, rate=rate)


def _weights(*shares: tuple[int, float]) -> dict[int, float]:
    """Shares by body; the frame does not turn."""
    found: dict[int, float] = {}
    for body, share in shares:
        if body:
            found[body] = found.get(body, 0.0) + share
    return {body: share for body, share in found.items() if np.any(share)}


def at_rest(row: Row, bodies: int, jets: Jets) -> Row:
    """A row whose constant is such that it holds at places; of N places N constants."""
    value = System(bodies, (), (row,)).values(jets, 0, np.zeros(len(jets.t[0])))[:, 0]
    return row._replace(constant=float(value[0]) if value.size == 1 else value)


def meshes_at_rest(structure: Structure, jets: Jets) -> list[Row]:
    """The rows of the meshes, such that they hold at places."""
    bodies, size = len(structure.bodies), structure.size
    return [at_rest(mesh_row(mesh, size), bodies, jets) for mesh in structure.meshes.values()]


def drive_rows(structure: Structure, starts: Mapping[str, float]) -> list[Row]:
    """The rows of the drives from their starts [rad or size]; the input is in rad, of a slide in units of size."""
    size, by_slide = structure.size, structure.drives[0].slide is not None
    found = []
    for each in structure.drives:
        unit = 1.0 if (each.slide is not None) == by_slide else size if by_slide else 1.0 / size
        found.append(driven_row(each.body, each.slide, size, starts[each.name], each.ratio * unit))
    return found
