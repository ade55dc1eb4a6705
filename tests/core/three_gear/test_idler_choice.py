"""Choice of the idler. Tolerances: none, teeth are whole numbers; the choice is compared with a plain walk."""

import math

import factory
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.momentary import momentary_linkage
from gearlink.core.machines.three_gear.symmetric import (
    crank_angle_for_dwell,
    frame_ratio_for_back_step,
    frame_ratio_for_speed_band,
    symmetric_linkage,
)
from gearlink.core.machines.three_gear.synthesis import idler_for_ratio, smallest_idler
from gearlink.core.machines.three_gear.train import GearTrain, gear_gap
from gearlink.core.parts.linkages.fourbar.position import FourBar

LIMITS = {"min_transmission_angle": math.radians(40.0), "min_gear_gap": 0.0}


def dwell_design(module, teeth, phi13):
    def design(idler):
        i3 = -idler / teeth
        d = frame_ratio_for_back_step(i3, crank_angle_for_dwell(i3, phi13))
        return symmetric_linkage(d, module * (teeth + idler) / 2.0)

    return design


def holds(linkage, idler, module, teeth, angle, gap):
    train = GearTrain(teeth, idler, teeth)
    return linkage.min_transmission_angle() >= angle and gear_gap(linkage, train, module) >= gap


@pytest.mark.parametrize("phi13", [60.0, 90.0, 135.0, 180.0])
def test_smallest_idler_of_a_dwell(phi13):
    design = dwell_design(2.0, 40, math.radians(phi13))
    idler = smallest_idler(design, 40, 40, 2.0, **LIMITS)
    assert holds(design(idler), idler, 2.0, 40, math.radians(40.0), 0.0)
    assert not any(holds(design(z), z, 2.0, 40, math.radians(40.0), 0.0) for z in range(17, idler))


def test_smallest_idler_of_example_2():
    """The thesis takes 21 teeth for a gap of 3 modules; 20 give 2.5 modules."""

    def design(idler):
        return symmetric_linkage(frame_ratio_for_speed_band(-idler / 20, 100.0, 300.0), float(20 + idler))

    limits = {"min_transmission_angle": math.radians(60.0)}
    assert smallest_idler(design, 20, 20, 2.0, min_gear_gap=4.5, **limits) == 20
    assert smallest_idler(design, 20, 20, 2.0, min_gear_gap=6.0, **limits) == 21


def test_idlers_without_a_design_are_passed_over():
    """270 deg of dwell need -i3 above 2: the first idlers have no frame at all."""
    design = dwell_design(2.0, 40, math.radians(270.0))
    with pytest.raises(NoSolution):
        design(80)
    limits = {"min_transmission_angle": 0.0, "min_gear_gap": -1e9}
    assert smallest_idler(design, 40, 40, 2.0, **limits) == 81


def test_first_idler_is_17():
    assert smallest_idler(dwell_design(2.0, 17, 1.0), 17, 17, 2.0, min_transmission_angle=0.0, min_gear_gap=-1e9) == 17


def test_nearest_idler_of_a_ratio():
    assert idler_for_ratio(-1.7798080356711419, 40) == 71
    assert idler_for_ratio(-0.5, 41) == 21
    with pytest.raises(NoSolution, match=r"limit <= -0\.05"):
        idler_for_ratio(-0.01, 20)
    with pytest.raises(NoSolution, match="one tooth"):
        idler_for_ratio(math.nan, 20)


def test_names_the_gap_as_the_obstacle():
    with pytest.raises(NoSolution, match="no idler from") as caught:
        smallest_idler(dwell_design(2.0, 40, 2.0), 40, 40, 2.0, min_transmission_angle=0.0, min_gear_gap=1000.0)
    assert caught.value.key == "gears.idler"


def test_names_the_transmission_angle_as_the_obstacle():
    limits = {"min_transmission_angle": math.radians(89.0), "min_gear_gap": -1000.0}
    with pytest.raises(NoSolution, match="no idler from"):
        smallest_idler(dwell_design(2.0, 40, 2.0), 40, 40, 2.0, **limits)


def test_names_both_limits_where_only_both_together_fail():
    """A frame that shrinks as the idler grows: the transmission angle rises and the gear gap falls."""

    def design(idler):
        return FourBar(10.0, 60.0, 60.0, 109.0 - 0.1 * idler)

    angle, gap = design(100).min_transmission_angle(), gear_gap(design(99), GearTrain(40, 99, 40), 2.0)
    with pytest.raises(NoSolution, match="no idler from") as caught:
        smallest_idler(design, 40, 40, 2.0, min_transmission_angle=angle, min_gear_gap=gap)
    assert caught.value.key == "gears.idler"
    lowered = math.radians(float(caught.value.fix.removeprefix("set limits.transmission_angle to ")))
    assert smallest_idler(design, 40, 40, 2.0, min_transmission_angle=lowered, min_gear_gap=gap) <= 99


def test_a_task_that_no_idler_can_do_keeps_its_own_refusal():
    """The design class names the key of the task, so it stays open here."""
    with pytest.raises(NoSolution, match="step back") as caught:
        smallest_idler(lambda z: momentary_linkage(25.0, 1.25 * z, 75.0, 26.0), 20, 60, 2.5, **LIMITS)
    assert caught.value.key == ""


@pytest.mark.quick(1)
@pytest.mark.parametrize("radius", [10.0, 37.0])
def test_the_idler_clears_the_shafts_of_the_file(radius):
    """Brute force over the idlers: limits and shafts; 37 mm is more than the idler beside the output shaft leaves."""
    data = {"kind": "three-gear-four-bar", "gears": {"module": 2, "crank": 40, "output": 40}, "dwell": {"angle": 90.0}}

    def statuses(**keys):
        made = factory.design(data, command="synth dwell", **keys)
        names = ("gear-collision", "transmission-angle", "shaft-clearance")
        return made.idler_teeth, {name: {check.status for check in made.check(name)} for name in names}

    bare, _ = statuses()
    shafts = {"input_radius": 0.5, "output_radius": radius}
    chosen, found = statuses(shafts=shafts)
    kept = {idler: statuses(gears__idler=idler, shafts=shafts)[1] for idler in range(17, 160)}
    good = [idler for idler, each in kept.items() if not any("fail" in status for status in each.values())]
    assert chosen == (good[0] if good else bare)
    assert bool(good) == ("fail" not in found["shaft-clearance"])


@pytest.mark.slow
def test_more_teeth_on_crank_and_output_make_room_for_the_input_shaft():
    """The idler keeps r1 - m from the crank's axis where it folds: only larger gears 1 and 5 help."""
    data = {"kind": "three-gear-four-bar", "gears": {"module": 2, "crank": 40, "output": 40}, "dwell": {"angle": 90.0}}
    report = factory.design(data, command="synth dwell", shafts={"input_radius": 12.0}).report("synth dwell")
    (failed,) = [check for check in report.checks if check.status == "fail"]
    assert failed.name == "shaft-clearance"
    assert [key for key, _ in failed.remedy] == ["gears.crank", "gears.output"]
    assert {value for _, value in failed.remedy} == {failed.remedy[0][1]}
    assert failed.remedy[0][1] > 40


def test_a_ring_too_small_for_any_idler_is_refused_at_its_key() -> None:
    with pytest.raises(NoSolution, match="no idler fits into a ring of 1 teeth") as refused:
        smallest_idler(dwell_design(2.0, 40, 1.0), 40, -1, 2.0, **LIMITS)
    assert refused.value.key == "gears.output"
