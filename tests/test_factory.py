"""The factory of designs: what it changes and what it leaves alone."""

import pytest
from factory import DESIGNS, changed, design, worked
from pydantic import ValidationError

from gearlink.cli.evaluate import open_design, read_spec
from gearlink.cli.options import Options
from gearlink.core.machines.three_gear.dwell_synthesis import DwellSynthesis


@pytest.mark.quick(12)
@pytest.mark.parametrize("path", sorted(DESIGNS.glob("*.yaml")), ids=lambda path: path.stem)
def test_a_worked_design_is_the_one_that_the_program_reads(path):
    loaded, kind = open_design(str(path), Options())
    made = design(path.stem)
    read = kind.design("analyze", read_spec(loaded, kind, str(path)))  # which may complete its spec
    assert made.spec == read.spec
    assert type(made) is type(read)


def test_changes_reach_sections_and_take_keys_out():
    data = {"kind": "x", "cam": {"center": [0.0, 0.0], "roller": {"radius": 30.0}}}
    made = changed(data, cam__roller__radius=8.0, cam__center=None, spring__torque=1.0)
    assert made == {"kind": "x", "cam": {"roller": {"radius": 8.0}}, "spring": {"torque": 1.0}}
    assert data == {"kind": "x", "cam": {"center": [0.0, 0.0], "roller": {"radius": 30.0}}}


def test_one_design_does_not_change_another():
    worked("ty460")["cam"]["roller_radius"] = 1.0
    assert design("ty460", cam__roller_radius=24.0).spec.cam.roller_radius == 24.0
    assert design("ty460").spec.cam.roller_radius == 25.0


def test_command_chooses_the_class_and_bad_data_is_refused():
    assert isinstance(design("candy_feed", command="synth dwell"), DwellSynthesis)
    with pytest.raises(ValidationError):
        design("ty460", bed=None)
