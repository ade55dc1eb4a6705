"""What `require` leaves out of a gear pair refuses nothing, and the pin is found without trying every pin."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterable
from typing import Any

import pytest
from pydantic import ValidationError

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import observed
from gearlink.core.parts.gears.drawing_names import DERIVED
from gearlink.core.parts.gears.measures.inspection import PREFERRED_PINS, Ball, preferred_pin
from gearlink.core.parts.gears.mesh.pair import GearPair
from tests.factory import design
from tests.sweeps import ALL


def _files(count: int) -> list[dict[str, Any]]:
    """Pairs, racks and rings, most of them odd, with and without what a drawing adds."""
    draw = random.Random(7)
    return [_file(draw) for _ in range(count)]


def _file(draw: random.Random) -> dict[str, Any]:
    second: Any = draw.choice([draw.randint(4, 90), -draw.randint(12, 160), "rack"])
    data: dict[str, Any] = {
        "kind": "gear-pair",
        "name": "odd",
        "module": draw.choice([0.3, 2.0, 12.0]),
        "teeth": [draw.randint(4, 60), second],
        "pressure_angle": draw.choice([14.5, 20.0, 28.0]),
        "profile_shift": [draw.uniform(-1.2, 1.5), 0.0 if second == "rack" else draw.uniform(-1.2, 1.5)],
        "addendum": draw.uniform(0.5, 1.4),
    }
    if draw.random() < 0.4:
        data["helix_angle"] = draw.uniform(1.0, 44.0)
    if draw.random() < 0.6 and second != "rack":
        data["allowances"] = {"upper": [-0.02, draw.uniform(-0.4, 0.4)], "lower": [-0.06, -0.9]}
        data["face_width"] = draw.uniform(0.5, 60.0)
        data["load"] = {"torque": 20.0, "speed": 300.0}
    return data


def _refusal(what: Callable[..., Any], *given: Any) -> str:
    try:
        what(*given)
    except NoSolution as error:
        return str(error)
    return ""


def _first(what: Callable[[str], Any], names: Iterable[str]) -> str:
    return next(filter(None, (_refusal(what, name) for name in names)), "")


def test_what_require_leaves_out_refuses_nothing() -> None:
    """The same pairs are refused, in the same words, whether or not the derived quantities are computed."""
    refused = 0
    for data in _files(400 if ALL else 80):
        try:
            pair = design(data, command="gear")
        except ValidationError:  # what the spec refuses is refused in every way
            continue
        said = _refusal(pair.require, "gear") or _first(pair.check, pair.outline("gear").checks)
        whole = design(data, command="gear")
        asked = _first(whole.raw, whole.outline("gear").quantities)
        assert bool(said) == bool(asked), (data, said, asked)
        refused += bool(said)
    assert refused


def test_findings_of_a_pair_form_no_measures() -> None:
    """A batch that shows findings alone computes neither pins nor chords of a pair that has no allowances."""
    seen: list[str] = []

    class Watch:
        def __init__(self, name: str) -> None:
            seen.append(name)

        def __enter__(self) -> None: ...
        def __exit__(self, *_: object) -> None: ...

    with observed(Watch):
        design("ty460_input_gears", command="gear").report("gear", findings_only=True)
    assert "GearPair.contact_ratio" in seen
    assert not {"GearData.pin_diameter", "Ball.pressure_angle", "GearData._chords"} & set(seen)
    assert "contact_ratio" not in DERIVED


@pytest.mark.quick(2)
@pytest.mark.parametrize("helix", [0.0, 25.0])
@pytest.mark.parametrize("second", [57, -83])
def test_pin_nearest_to_its_circle_of_all(helix: float, second: int) -> None:
    """Trying every pin that can be bought gives the same one."""
    draw = random.Random(3)
    for _ in range(20):
        pair = GearPair(
            module=draw.uniform(0.2, 30.0),
            teeth=(draw.randint(8, 50), second),
            helix_angle=math.radians(helix),
            given_shift=(draw.uniform(-0.5, 0.6), draw.uniform(-0.5, 0.2)),
            tip="none",
        )
        for gear in (0, 1):
            wanted = pair.reference_radius[gear] + pair.module * pair.profile_shift[gear]
            found = []
            for diameter in PREFERRED_PINS:
                ball = Ball(pair=pair, gear=gear, diameter=diameter)
                if not _refusal(getattr, ball, "contact_radius"):
                    found.append((abs(ball.contact_radius - wanted), diameter))
            assert preferred_pin(pair, gear) == (min(found)[1] if found else None)
