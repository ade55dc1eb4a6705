"""The tooth loss factor against the mean over a dense mesh, and against Ohlendorf's form where that holds.

Tolerance: the midpoint rule over 20,000 phases errs by the square of their step and by a step at each change of pairs,
5e-5 of the mean in all; the closed form is met to rounding.
"""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.parts.gears.mesh.contact import PathOfContact
from gearlink.core.parts.gears.mesh.pair import GearPair

PAIRS: dict[str, tuple[Any, ...]] = {
    "plain": (2.0, (40, 72)),
    "pinion": (3.0, (20, 40)),
    "ring, pitch point where two pairs are in contact": (3.0, (17, -60)),
    "shifted": (2.5, (18, 57), (0.4, 0.1)),
    "helical": (),
    "contact after the pitch point only": (2.0, (30, 30), (1.4, -1.2)),
}


HELICAL = {"kind": "gear-pair", "module": 2.5, "teeth": [23, 57], "profile_shift": [0.2, 0], "helix_angle": 15}


def _path(name: str) -> PathOfContact:
    if not PAIRS[name]:
        found: PathOfContact = factory.design(HELICAL, command="gear").data.path
        return found
    return PathOfContact(GearPair.from_shift(*PAIRS[name]))


def _parts(path: PathOfContact) -> tuple[float, float]:
    pitch = path.pair.base_pitch
    return (path.end - path.pitch) / pitch, (path.pitch - path.start) / pitch


@pytest.mark.parametrize("name", PAIRS)
def test_it_is_the_mean_over_the_mesh(name: str) -> None:
    path = _path(name)
    recess, approach = _parts(path)
    phase = (np.arange(20_000) + 0.5) / 20_000
    places = phase - approach + np.arange(-4, 5)[:, None]
    inside = (places >= -approach) & (places <= recess)
    mean = float((np.where(inside, np.abs(places), 0.0).sum(axis=0) / inside.sum(axis=0)).mean())
    z1, z2 = path.pair.teeth
    wanted = 2.0 * math.pi * (1.0 / z1 + 1.0 / z2) * mean / math.cos(path.pair.base_helix_angle)
    assert path.loss_factor == pytest.approx(wanted, rel=2e-4)


@pytest.mark.parametrize("name", ["plain", "pinion", "helical"])
def test_it_is_ohlendorfs_with_the_pitch_point_under_one_pair(name: str) -> None:
    path = _path(name)
    recess, approach = _parts(path)
    assert max(recess, approach) < 1.0
    z1, z2 = path.pair.teeth
    form = 1.0 - (recess + approach) + recess**2 + approach**2
    wanted = math.pi * (1.0 / z1 + 1.0 / z2) * form / math.cos(path.pair.base_helix_angle)
    assert path.loss_factor == pytest.approx(wanted, rel=1e-12)
