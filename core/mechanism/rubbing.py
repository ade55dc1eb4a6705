"""The sizes that friction has: joint forces and what they rub, one making the other."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.arrays import Reals

_PASSES, _PLAIN, _KEPT = 60, 4, 5
_SETTLED, _NEARLY, _BEYOND = 1e-14, 1e-11, 1e6
LOCKS = 0.9
"""A mechanism of which a pass leaves more of a change counts as self-locking."""
LOCKED = (
    "with this friction the mechanism locks itself: the forces grow from pass to pass; make pins thinner, or friction "
    "smaller"
)


class SelfLocking(NoSolution):
    """With its friction the mechanism locks itself: there are no forces with which it moves."""


@dataclass(frozen=True)
class Rubbing:
    """What friction and separating forces do: each has the size of a joint's force, and acts by a response.

    x = x_0 + sum f_j S_j,  f_j = mu_j |F_j(x)|, or mu_j max(s_j F_j(x), 0) of one side

    Fields
        free : (n, N) array - x_0, the unknowns without them
        responses : (m, n, N) array - S_j, the unknowns that a unit makes
        shares : (m,) array - mu_j: mu r, mu, (1 - eta) r, and 1 of a mesh's separating force
        places : (m, 2) array of int - unknowns whose magnitude F_j is; the same twice where it is one
        sides : (m, N) array - s_j, +-1 where the size is that of the force on one side, 0 where of either
    """

    free: Reals
    responses: Reals
    shares: Reals
    places: Any
    sides: Reals | float = 0.0

    @cached_property
    def _read(self) -> tuple[Reals, Reals]:
        """The unknowns that sizes are read from, (N, m, 2), and what units make of them, (N, m, 2, m)."""
        base = self.free[self.places].transpose(2, 0, 1)
        response = self.responses[:, self.places, :].transpose(3, 1, 2, 0)
        return base, np.ascontiguousarray(response)

    @cached_property
    def _single(self) -> Any:
        return self.places[:, 0] == self.places[:, 1]

    def forces(self, sizes: Reals) -> Reals:
        """Parts of the joint forces at sizes (N, m), as (N, m, 2), 0 on the other side than a size is of.

        Of one unknown the second part is 0.
        """
        base, response = self._read
        count = len(self.shares)
        flat = response.reshape(len(sizes), 2 * count, count)  # none where friction vanishes in rounding
        found = base + (flat @ sizes[..., None]).reshape(base.shape)
        found[:, self._single, 1] = 0.0
        return np.asarray(np.where((np.asarray(self.sides).T * found[..., 0] < 0.0)[..., None], 0.0, found))

    def rates(self, forces: Reals) -> Reals:
        """Change of the sizes by the sizes, (N, m, m)."""
        response = self._read[1]
        length = np.hypot(forces[..., 0], forces[..., 1])
        along = np.divide(forces, length[..., None], out=np.zeros_like(forces), where=length[..., None] > 0.0)
        return np.asarray(self.shares[:, None] * np.einsum("nmk,nmkj->nmj", along, response))

    def sizes(self, forces: Reals) -> Reals:
        """f_j of joint forces, (N, m)."""
        return np.asarray(self.shares * np.hypot(forces[..., 0], forces[..., 1]))

    def unknowns(self, sizes: Reals) -> Reals:
        """All unknowns at sizes, (n, N)."""
        return np.asarray(self.free + np.einsum("jin,nj->in", self.responses, sizes))

    def settled(self) -> Reals:
        """The sizes that make themselves, (N, m).

        Raises
            SelfLocking - where no sizes do
        Notes
            A few passes first, which suffice where the friction is small; then Newton's steps, whose matrix is kept for
            five, since near locking each pass takes off hardly anything. Relative to the maximum force: 1e-14.
        """
        found = np.zeros((self.free.shape[-1], len(self.shares)))
        inverse = np.eye(len(self.shares))
        scale = np.max(np.abs(self._read[0]), initial=0.0) * (self.shares + 1e-300)
        for step in range(_PASSES):
            forces = self.forces(found)
            change = self.sizes(forces) - found
            worst = float(np.max(np.abs(change) / scale, initial=0.0)) if scale.any() else 0.0
            if worst <= _SETTLED:
                return found
            if not worst < _BEYOND:
                break
            if step >= _PLAIN:
                if (step - _PLAIN) % _KEPT == 0:
                    try:
                        inverse = np.asarray(np.linalg.inv(np.eye(len(self.shares)) - self.rates(forces)))
                    except np.linalg.LinAlgError:
                        break
                change = (inverse @ change[..., None])[..., 0]
            found = found + change
        else:
            if worst <= _NEARLY:
                return found
        raise SelfLocking(LOCKED, key="loads.friction")

    def ratio(self, sizes: Reals) -> Reals:
        """What passes leave of a disturbance, each of what the one before left, at each row, (N,).

        The spectral radius of the rates: no unit that sizes are in changes it, torques of pins beside forces of teeth.
        """
        return np.asarray(np.abs(np.linalg.eigvals(self.rates(self.forces(sizes)))).max(axis=1, initial=0.0))
