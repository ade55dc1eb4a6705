"""The band of a register by samples: machines whose parts have random errors, each closed as a whole."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.studies.tolerance.budget import Contribution, counted
from gearlink.core.studies.tolerance.correlation import coordinate_root, together
from gearlink.core.studies.tolerance.laws import Law
from gearlink.core.studies.tolerance.sampling import replication, rounded_up
from gearlink.core.studies.tolerance.shares import is_shared, of_replications

if TYPE_CHECKING:
    from gearlink.core.studies.register.design import RegisterDesign

SIGNS = (1, -1)
_SAMPLES = 16_384
_PLACES = 13


def sampled_band(register: RegisterDesign) -> list[float]:
    """What 99.73 % of the samples of the whole chain keep, to either side, for either torque sign [mm]."""
    _ = register.correlations, register.input_angles  # refused before anything is sampled
    model = type(register.spec)
    text = str(register.spec.model_dump_json(exclude_unset=True, exclude_none=True, by_alias=True))
    share = partial(_share_of, type(register), model, text) if is_shared() else partial(sampled_share, register)
    found = np.mean(list(of_replications(share)), axis=0)
    return [float(one.max()) for one in found]


def sampled_share(register: RegisterDesign, number: int) -> Reals:
    """The band at some places of the stretch by one replication; (2, places) array [mm]."""
    section = register.spec.tolerance
    count = rounded_up(section.samples or _SAMPLES)
    chosen, own = register.sampled_places, register.own_errors
    width = sum(one.coordinates for one in register.sources)
    points = replication(width + len(own[0]), count, section.seed, number)
    parts = _parts_of(register, together(points[:, :width], coordinate_root(section, register.sources)))
    bands, errors = [], np.zeros(0)
    for sign, beside in zip(SIGNS, own, strict=True):
        if sign == SIGNS[0] or register.chain(chosen, sign) is not register.chain(chosen, SIGNS[0]):
            errors = sampled_errors(register, chosen, sign, parts)
            if chosen.size > 1:
                errors = errors - errors[0]
        bands.append([_band(one) for one in errors + _scattered(beside, points[:, width:])])
    return np.array(bands)


def sampled_errors(register: RegisterDesign, input_angle: Reals, torque_sign: int, parts: Mapping[str, Any]) -> Reals:
    """Errors of machines as made, the whole chain of each closed; (places, N) array [mm].

    Parameters
        input_angle : (places,) array [rad]
        parts : errors of all machines by source; of pins and gears vectors
    """
    chain = register.chain(input_angle, torque_sign)
    output = register.output(input_angle[:, None])
    errors: list[Any] = []
    for source in register.sources:
        error = parts[source.key]
        if source.coordinates == 2 and not register.moves.is_vector(source):
            error = np.real(error)
        errors += [(shift, error) for shift in register.shifts(source, chain.mechanism)]
    return chain.output(lambda made: output(made, parts), errors, output)


def own_errors(register: RegisterDesign, chosen: Reals) -> list[list[Contribution]]:
    """What the machine adds to the sources of the file, for either torque sign, as it counts over the stretch."""
    keys = {one.key for one in register.sources}
    start = 0 if chosen.size > 1 else None
    return [
        [
            replace(one, gain=counted(one, start))
            for one in register.contributions(chosen, sign)
            if one.source not in keys
        ]
        for sign in SIGNS
    ]


def _parts_of(register: RegisterDesign, points: Reals) -> dict[str, Any]:
    """Errors of the parts in all samples, by source: sizes, and of pins and gears vectors."""
    found: dict[str, Any] = {}
    at = 0
    for source in register.sources:
        part = points[:, at : at + source.coordinates]
        at += source.coordinates
        size = source.law.deviations(part[:, 0])
        if source.coordinates == 2:
            half = 0.5 if source.kind == "pin" else 1.0
            size = half * size * np.exp(2j * math.pi * part[:, 1])
        found[source.key] = size
    return found


@lru_cache(maxsize=4)
def _made(register: type[RegisterDesign], model: type[Any], text: str) -> RegisterDesign:
    return register(model.model_validate_json(text))


def _share_of(register: type[RegisterDesign], model: type[Any], text: str, number: int) -> Reals:
    made = _made(register, model, text)  # type: ignore[arg-type]  # mypy takes a class for unhashable
    return sampled_share(made, number)


def places(input_angles: Reals) -> Reals:
    """Some of the angles of a stretch, its ends among them."""
    count = input_angles.size
    chosen: Reals = input_angles[np.linspace(0, count - 1, min(count, _PLACES)).astype(int)]
    return chosen


def _scattered(own: Sequence[Contribution], points: Reals) -> Any:
    """Errors by gains: what all machines have alike, and normal scatter about it; (places, N) array."""
    found: Any = 0.0
    for one, share in zip(own, points.T, strict=True):
        law = Law("normal", -one.limit, one.limit, one.mean, one.sigma)
        found = found + np.real(one.gain)[:, None] * law.deviations(share)
    return found


def _band(errors: Reals) -> float:
    ordered = np.sort(np.abs(errors))
    return float(ordered[min(ordered.size - 1, math.ceil(0.9973 * ordered.size) - 1)])
