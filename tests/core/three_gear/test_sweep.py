"""Sweeps of the three-gear four-bar against the scalar kernels.

Tolerances: 1e-13 for rates of order one (both methods' rounding, gamma well away from 0 and 180 deg); closed forms
2e-15 relative; roots 1e-13 relative, the condition of the dwell angle's equation at small back-steps.
"""

import math

import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear import symmetric
from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.machines.three_gear.momentary import (
    momentary_crank_angle,
    momentary_frame_length,
    tangency_range,
)
from gearlink.core.machines.three_gear.sweep import momentary_dwells
from gearlink.core.machines.three_gear.symmetric import dwell_angle
from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.numerics.elementary_sweep import ARRAYS
from gearlink.core.parts.linkages.fourbar.position import FourBar
from tests.oracles.three_gear_output import output_motion

EX3 = FourBar(18.0, 50.0, 100.0, 121.4)
TURN = np.arange(360) * (math.tau / 360)
EX3_TRAIN = GearTrain(20, 20, 60)
DRAG = FourBar(50.47, 35.785689262214326, 40.265643369620086, 20.88, -1)
DRAG_TRAIN = GearTrain(23.441236459944996, 12.003476037635881, 27.87850422292809)


@pytest.mark.parametrize(("linkage", "train"), [(EX3, EX3_TRAIN), (DRAG, DRAG_TRAIN)])
def test_motion_agrees_with_the_scalar_kernels(linkage, train):
    phi = np.linspace(-7.0, 14.0, 301)
    motion, output = output_motion(linkage, train, phi), Output(linkage, train)
    for rate, scalar in (
        (motion.output_angle, output.angle),
        (motion.speed_ratio, output.speed),
        (motion.acceleration_ratio, output.acceleration),
    ):
        assert rate == pytest.approx(np.array([scalar(x) for x in phi]), abs=1e-13 * 10)
    assert np.all((motion.transmission_angle > 0.0) & (motion.transmission_angle <= math.pi / 2))
    assert motion.transmission_angle.min() >= linkage.min_transmission_angle() - 1e-15


def test_motion_starts_at_zero_and_gains_the_mean_ratio():
    motion = output_motion(EX3, EX3_TRAIN, TURN[::45])
    assert motion.output_angle[0] == pytest.approx(0.0, abs=2e-15)  # sums of angles up to pi, each rounded
    assert output_motion(EX3, EX3_TRAIN, 2.0 * math.pi).output_angle == pytest.approx(2.0 * math.pi / 3.0, abs=1e-14)
    assert output_motion(DRAG, DRAG_TRAIN, 2.0 * math.pi).output_angle == pytest.approx(2.0 * math.pi, abs=1e-13)


def test_motion_keeps_the_shape_of_the_angles():
    grid = TURN.reshape(60, 6)
    assert output_motion(EX3, EX3_TRAIN, grid).speed_ratio.shape == (60, 6)


def test_momentary_dwells_agree_with_the_scalar_forms():
    rng = np.random.default_rng(3)
    r1, r3, r5 = rng.uniform(5.0, 100.0, (3, 200))
    low = np.array([tangency_range(*radii)[0] for radii in zip(r1, r3, r5, strict=True)])
    e = np.abs(low + rng.uniform(-0.2, 1.2, 200) * (r1 - low))
    found = momentary_dwells(r1, r3, r5, e)
    assert 0 < found.exists.sum() < 200
    for i in range(200):
        if found.exists[i]:
            assert found.frame[i] == pytest.approx(momentary_frame_length(r1[i], r3[i], r5[i], e[i]), rel=2e-15)
            assert found.crank_angle[i] == pytest.approx(momentary_crank_angle(r1[i], r3[i], r5[i], e[i]), rel=4e-15)
        else:
            assert math.isnan(found.frame[i])
            assert math.isnan(found.crank_angle[i])
            with pytest.raises(NoSolution):
                momentary_frame_length(r1[i], r3[i], r5[i], e[i])


def test_dwell_angles_of_studies_agree_with_the_scalar_root():
    i3, phi12 = np.meshgrid(-np.geomspace(0.5, 12.0, 15), np.linspace(0.35, 3.1, 20))
    found = 0.5 * phi12.ravel() + symmetric.regained(1.0 - i3.ravel(), 0.5 * phi12.ravel(), ARRAYS)
    exact = np.array([dwell_angle(float(r), float(p)) for r, p in zip(i3.flat, phi12.flat, strict=True)])
    assert np.max(np.abs(found / exact - 1.0)) < 1e-13
