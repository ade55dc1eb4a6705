"""Whole drives of every variant against a second way in 80-bit numbers: motion, standstills, back-step and dwell.

Errors are in eps = 2^-52 times a condition number: the sum of what the last digit of each length and of the crank
angle moves the result by (differences of the second way itself), and of the magnitudes of the terms that make it up.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from oracles.drive_search import TURN, Turn, turns
from oracles.long_drive import Drives
from stress.random_drives import VARIANTS, Design, arrays, designs, turning
from stress.worst import COUNTS, EPS, LONG, LONGER_NUMBERS, MANY, Worst

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.kinds import KINDS
from gearlink.core.machines.planet_linkages.planet import PlanetLinkage
from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.parts.linkages.checks import check_linkage
from gearlink.core.parts.linkages.fourbar.loop import closing_range
from gearlink.core.parts.linkages.fourbar.position import FourBar
from tests.oracles.three_gear_output import output_motion

pytestmark = LONGER_NUMBERS

QUANTITIES = ("turned", "speed", "acceleration")
MOTION_LIMITS = {"turned": 4.0, "speed": 6.0, "acceleration": 4.0}
KEY_LIMITS = {
    "speed_ratio_max": 8.0,
    "speed_ratio_min": 8.0,
    "standstill": 4.0,
    "phi12": 4.0,
    "back-step": 4.0,
    "phi13": 4.0,
}
FEW_KEYS = [21, pytest.param(max(1, MANY // 20), marks=pytest.mark.stress)]


def scalar(design: Design, phi: float) -> tuple[float, ...]:
    """Angle, speed and acceleration by the formulas for one position."""
    output = Output(design.linkage, design.train)
    return output.angle(phi), output.speed(phi), output.acceleration(phi)


def sweep(design: Design, phi: float) -> tuple[float, ...]:
    """The same by the formulas for arrays."""
    motion = output_motion(design.linkage, design.train, np.array([phi]))
    return tuple(float(x[0]) for x in (motion.output_angle, motion.speed_ratio, motion.acceleration_ratio))


def take_worst(worst: Worst, drives: Drives, phi: Any, found: dict[str, Any], names: list[str], labels: list) -> None:
    """The worst of every quantity; names tell the variants apart, labels the designs."""
    for quantity, values in found.items():
        gaps = np.abs(values - getattr(drives, quantity)(phi))
        errors = (gaps / (EPS * drives.condition(quantity, phi))).astype(float)
        for i, (error, name) in enumerate(zip(errors, names, strict=True)):
            worst.take(f"{name} {quantity}".strip(), float(error), (str(labels[i]), float(phi[i])))


def clear_of_dead_points(drives: Drives, phi: Any) -> Any:
    """Whether sin(gamma) is at least 1e-3, here and at the crank angle 0: nearer has tests of its own."""
    with np.errstate(invalid="ignore"):  # 80 bits may miss by a rounding that it closes at all
        return np.minimum(np.abs(drives.loop(phi).sine), np.abs(drives.loop(0.0 * phi).sine)) >= 1e-3


@pytest.mark.parametrize("count", COUNTS)
def test_motion_of_whole_drives(count: int) -> None:
    """Output angle over two turns either way, speed and acceleration; one position and arrays; both assemblies."""
    rng, worst = np.random.default_rng(21), Worst()
    drawn, phi = designs(rng, count), rng.uniform(-13.0, 13.0, count)
    good = clear_of_dead_points(Drives.three_gears(*arrays(drawn)), phi)
    drawn, phi = [design for design, keep in zip(drawn, good, strict=True) if keep], phi[good]
    assert len(drawn) >= 0.99 * count
    drives, names = Drives.three_gears(*arrays(drawn)), [design.variant for design in drawn]
    for way in (scalar, sweep):
        columns = np.array([way(design, float(x)) for design, x in zip(drawn, phi, strict=True)]).T
        take_worst(worst, drives, phi, dict(zip(QUANTITIES, columns, strict=True)), names, drawn)
    limits = {f"{variant} {quantity}": MOTION_LIMITS[quantity] for variant in VARIANTS for quantity in QUANTITIES}
    worst.check("whole drives", count, limits)


@pytest.mark.parametrize("count", COUNTS)
def test_net_turns_of_whole_drives(count: int) -> None:
    """After a revolution of the crank the output has gained 2 pi times the mean ratio, in the second way as well."""
    drawn = designs(np.random.default_rng(22), count // 10)
    drives = Drives.three_gears(*arrays(drawn))
    gained = drives.turned(np.full(len(drawn), TURN)) / TURN
    ratios = np.array([Output(design.linkage, design.train).mean_ratio for design in drawn])
    assert np.abs(gained / ratios - 1.0).max() <= 2.0 * EPS


@pytest.mark.parametrize("count", COUNTS)
def test_linkages_that_do_not_turn_are_no_drives(count: int) -> None:
    """Rocker-cranks and double-rockers are refused as drives; at one position their rates are still good."""
    rng, worst, kinds = np.random.default_rng(23), Worst(), set()
    drawn: list[Design] = []
    phi: list[float] = []
    while len(drawn) < count // 10:
        lengths = (float(x) for x in 10.0 ** (rng.uniform(-6, 6) + rng.uniform(-1, 1, 4)))
        linkage = FourBar(*lengths, int(rng.choice((-1, 1))))
        train = GearTrain(*(int(z) for z in rng.integers(10, 200, 3)))
        if linkage.kind() not in ("rocker-crank", "double-rocker"):
            continue
        kinds.add(linkage.kind())
        for refused in (check_linkage, lambda x, t=train: Output(x, t).places):
            with pytest.raises(NoSolution):
                refused(linkage)
        low, high = closing_range(linkage.reading)
        drawn.append(Design(linkage.kind(), linkage, train))
        phi.append(int(rng.choice((-1, 1))) * (low + (high - low) * float(rng.uniform(0.01, 0.99))))
    assert len(kinds) == 2
    outputs = [Output(design.linkage, design.train) for design in drawn]
    columns = np.array([(o.speed(x), o.acceleration(x)) for o, x in zip(outputs, phi, strict=True)]).T
    names = [design.variant for design in drawn]
    drives = Drives.three_gears(*arrays(drawn))
    take_worst(worst, drives, np.array(phi), dict(zip(QUANTITIES[1:], columns, strict=True)), names, drawn)
    worst.check(
        "other classes", len(drawn), {f"{kind} {q}": MOTION_LIMITS[q] for kind in kinds for q in QUANTITIES[1:]}
    )


@pytest.mark.parametrize("carrier", ["crank", "rocker"])
@pytest.mark.parametrize("count", COUNTS)
def test_drives_without_an_idler(carrier: Any, count: int) -> None:
    """Two-gear four-bar (sun or ring gear on the crank's axis) and geared rocker, crank-rockers and drag links."""
    rng, worst = np.random.default_rng(24), Worst()
    planets, phi = [], rng.uniform(-13.0, 13.0, count // 4)
    for _ in phi:
        b, c = (float(x) for x in 10.0 ** (rng.uniform(-6, 6) + rng.uniform(-1, 1, 2)))
        short, long = turning(rng, b, c)
        lengths = (short, b, c, long) if rng.random() < 0.5 else (long, b, c, short)
        ring, ratio = rng.random() < 0.3, 10.0 ** float(rng.uniform(-1.0, 1.0))
        ratio = min(ratio, 0.95 / ratio) if ring else -ratio
        planets.append(PlanetLinkage(FourBar(*lengths, int(rng.choice((-1, 1)))), ratio, carrier))
    links = np.array([(p.linkage.crank, p.linkage.coupler, p.linkage.rocker, p.linkage.frame) for p in planets]).T
    sides, ratios = (
        np.array([value(p) for p in planets]) for value in (lambda p: p.linkage.assembly, lambda p: p.ratio)
    )
    good = clear_of_dead_points(Drives.one_mesh(links, sides, ratios, carrier), phi)
    drives, phi = Drives.one_mesh(links[:, good], sides[good], ratios[good], carrier), phi[good]
    planets = [planet for planet, keep in zip(planets, good, strict=True) if keep]
    columns = np.array(
        [(p.angle(x), p.speed(x), p.acceleration(x)) for p, x in zip(planets, phi.tolist(), strict=True)]
    ).T
    found = dict(zip(QUANTITIES, columns, strict=True))
    labels = [f"{x.linkage} {x.ratio}" for x in planets]
    take_worst(worst, drives, phi, found, ["" for _ in planets], labels)
    worst.check(f"gear on the coupler, {carrier} carries", len(planets), MOTION_LIMITS)


def place_condition(turn: Turn, function: str, place: Any) -> Any:
    """Condition of a zero: that of the function over its slope, and the angle's own."""
    drive, step = turn.drive, LONG(1e-8)
    after, before = (getattr(drive, function)(place + side * step) for side in (1, -1))
    return drive.condition(function, place) / abs((after - before) / (2 * step)) + TURN


def take_keys(worst: Worst, turn: Turn, design: Any, name: str = "") -> None:
    """Errors of standstills, back-step and dwell of anything with the names of a design, in eps of their condition.

    A gain of the output has the width of the interval times the condition of the speed in it, and the size of the
    output angles; phi13 has that over the speed at its end.
    """
    start, width, angle, regained = turn.back_step()
    drive, at_places = turn.drive, [place_condition(turn, "speed", place) for place in turn.standstills]
    for place, found, condition in zip(turn.standstills, design.dwell_crank_angles, at_places, strict=True):
        worst.take(f"{name}standstill", float(abs(found - place) / (EPS * condition)), str(design))
    worst.take(f"{name}phi12", float(abs(design.back_step_crank_angle - width) / (EPS * sum(at_places))), str(design))
    ends = drive.size("turned", start)
    condition = width * turn.over("speed", start, width) + ends
    worst.take(f"{name}back-step", float(abs(design.back_step_angle - angle) / (EPS * condition)), str(design))
    gain = regained * turn.over("speed", start, regained) + ends
    condition = gain / drive.speed(start + regained) + sum(at_places)
    worst.take(f"{name}phi13", float(abs(design.dwell_angle - regained) / (EPS * condition)), str(design))


class Analysed:
    """A drive with the names of a design: what `analyze` gives, from links and gears alone."""

    def __init__(self, design: Design) -> None:
        output = Output(design.linkage, design.train)
        self.design, self.speed_ratio_max, self.speed_ratio_min = design, output.speed_ratio_max, output.speed_ratio_min
        self.dwell_crank_angles = output.places
        if len(self.dwell_crank_angles) == 2:
            step = output.back_step
            self.back_step_crank_angle, self.back_step_angle = step.crank_angle, step.angle
            self.dwell_angle = output.dwell_angle

    def __str__(self) -> str:
        return str(self.design)


def take_extremes(worst: Worst, turn: Turn, design: Any, name: str = "") -> None:
    """Errors of the maximum and the minimum speed ratio."""
    for key, place in (("speed_ratio_max", turn.greatest), ("speed_ratio_min", turn.least)):
        gap = abs(getattr(design, key) - turn.drive.speed(place))
        worst.take(name + key, float(gap / (EPS * turn.drive.condition("speed", place))), str(design))


@pytest.mark.parametrize("count", FEW_KEYS)
def test_key_quantities_of_whole_drives(count: int) -> None:
    """Number and places of standstills, back-step, dwell and extremes, by a dense search over the revolution.

    Within 1e-9 of a momentary dwell the program has one standstill by its own rule; there the count is held to that.
    """
    drawn, worst, numbers = designs(np.random.default_rng(25), count), Worst(), set()
    good = clear_of_dead_points(Drives.three_gears(*arrays(drawn)), np.full(count, math.pi))
    drawn = [design for design, keep in zip(drawn, good, strict=True) if keep]
    for design, turn in zip(drawn, turns(Drives.three_gears(*arrays(drawn)), len(drawn)), strict=True):
        found, least = Analysed(design), turn.least
        take_extremes(worst, turn, found)
        number = len(found.dwell_crank_angles)
        share = float(abs(turn.drive.speed(least)) / turn.drive.size("speed", least))
        if share > 2e-9:
            assert number == len(turn.standstills), str(design)
        elif share < 0.5e-9:
            assert number == 1, str(design)
        if number == 2 and len(turn.standstills) == 2:
            take_keys(worst, turn, found)
        numbers.add(number)
    assert numbers == {0, 1, 2}
    worst.check("key quantities of whole drives", len(drawn), KEY_LIMITS)


TASKS: dict[str, Any] = {  # from a share of what is possible and i3
    "dwell": lambda share, i3: {"dwell": {"angle": share * 360.0 * (1.0 - i3) / (2.0 - i3)}},
    "back-step": lambda share, _: {"back_step": {"crank_angle": share * 180.0}},
    "variable-speed": lambda share, _: {"speed": {"min": share * 100.0, "max": 100.0}},
}


@pytest.mark.quick(1)
@pytest.mark.parametrize("task", TASKS)
@pytest.mark.parametrize("count", [10, pytest.param(max(1, MANY // 300), marks=pytest.mark.stress)])
def test_syntheses_from_file_to_quantities(task: str, count: int) -> None:
    """Design files with random tasks: the quantities, most of them closed forms, against a search on the links."""
    rng, worst, made = np.random.default_rng(26), Worst(), []
    kind = KINDS["three-gear-four-bar"]
    for _ in range(count):
        z1, z3 = (int(z) for z in rng.integers(12, 200, 2))
        gears = {"module": 10.0 ** float(rng.uniform(-6, 6)), "crank": z1, "idler": z3, "output": z1}
        share = float(rng.uniform(0.01, 0.97))
        text = {"kind": kind.name, "gears": gears, "assembly": int(rng.choice((-1, 1))), **TASKS[task](share, -z3 / z1)}
        made.append(kind.design(f"synth {task}", kind.spec_model().model_validate(text)))
    drawn = [Design(task, design.linkage, design.train) for design in made]
    for design, plain, turn in zip(made, drawn, turns(Drives.three_gears(*arrays(drawn)), count), strict=True):
        labelled = Labelled(design, plain)
        take_extremes(worst, turn, labelled)
        if task != "variable-speed":
            take_keys(worst, turn, labelled)
        else:
            assert design.dwell_crank_angles == turn.standstills == []
    limits = KEY_LIMITS if task != "variable-speed" else {"speed_ratio_max": 8.0, "speed_ratio_min": 8.0}
    worst.check(f"synth {task}", count, limits)


class Labelled:
    """A design that prints as its links and gears."""

    def __init__(self, design: Any, plain: Design) -> None:
        self.design, self.plain = design, plain

    def __getattr__(self, name: str) -> Any:
        return getattr(self.design, name)

    def __str__(self) -> str:
        return str(self.plain)


@pytest.mark.parametrize("count", [10, pytest.param(max(1, MANY // 100), marks=pytest.mark.stress)])
def test_momentary_dwells_stand_still_where_they_say(count: int) -> None:
    """The minimum speed of the second way is zero to the last digits and lies at the crank angle of the standstill."""
    drawn, worst = designs(np.random.default_rng(27), count, ("momentary-dwell",)), Worst()
    for design, turn in zip(drawn, turns(Drives.three_gears(*arrays(drawn)), count), strict=True):
        (place,) = Output(design.linkage, design.train).places
        rest = abs(turn.drive.speed(turn.least)) / (EPS * turn.drive.condition("speed", turn.least))
        worst.take("speed left", float(rest), str(design))
        gap = abs(math.remainder(place - float(turn.least), 2.0 * math.pi))
        condition = float(place_condition(turn, "acceleration", turn.least))
        worst.take("place", gap / (EPS * condition), str(design))
    worst.check("momentary dwells", count, {"speed left": 8.0, "place": 8.0})
