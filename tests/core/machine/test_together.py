"""Machines of a study whose members are shared and find together: what each machine by itself has.

Tolerance: 1e-12 of a value, for extremes that are refined to rounding over other samples.
"""

from __future__ import annotations

import random
from typing import Any

import factory
import numpy as np
import pytest
from sweeps import spread

from gearlink.core.base.kinds import KINDS
from gearlink.core.base.spec_paths import number_at
from gearlink.core.machines.machine.design import Machine
from gearlink.core.studies.explore.base import Base, single, singles
from gearlink.core.studies.tolerance_study.problem import problem
from gearlink.core.studies.tolerance_study.samples import evaluated

GRIPPER = {"gripper.design.cam.return_roller.angle": 0.5, "gripper.design.links.coupler": 0.5, "gripper.phase": 0.5}
CAMS = {"suckers.design.cam.prime_radius": 5.0, "suckers.design.spring.preload": 50.0}
NAMES = ("least_margin", "gripper.max_pressure_angle[0]", "gripper.newton_agreement", "suckers.max_pressure_angle",
         "suckers.lift_off_speed", "wheels.rocker_swing", "cylinder_grippers.phase")  # fmt: skip
CHANGES = {"gripper": GRIPPER, "cams": CAMS, "driven": {"wheels.phase": 1.0}, "all": {**GRIPPER, **CAMS}}


def _base() -> Base:
    return Base({key: value for key, value in factory.worked("sheet_press").items() if key != "register"}, "analyze")


def _rows(base: Base, widths: dict[str, float], count: int) -> list[list[tuple[str, Any]]]:
    own, spec = random.Random(7), base.spec()
    paths = {f"members.{path}": by for path, by in widths.items()}
    return [[(path, float(number_at(spec, path)) + own.uniform(-by, by)) for path, by in paths.items()]
            for _ in range(count)]  # fmt: skip


@pytest.mark.quick(1)
@pytest.mark.parametrize("varied", ["cams", "gripper", "driven", "all"])
def test_machines_of_a_study_are_those_of_each_alone(varied: str) -> None:
    base = _base()
    codes, rows = list(base.codes), _rows(base, CHANGES[varied], 9)
    for row, many in spread(zip(rows, singles(base, rows, NAMES, codes), strict=True), 1):
        alone = single(_base(), row, NAMES, codes)
        assert alone.refused == many.refused == ""
        for name, value in alone.values.items():
            assert many.values[name] == (value if value is None else pytest.approx(value, rel=1e-12)), name
        shown = [[(c.code, c.status, c.what, c.name) for c in one.findings] for one in (alone, many)]
        assert shown[0] == shown[1]


def test_members_that_do_not_differ_are_made_once() -> None:
    base = _base()
    designs: list[Any] = [base.design(row) for row in _rows(base, GRIPPER, 9)]
    Machine.find_together(designs, ["least_margin", "gripper.max_pressure_angle[0]"])
    for name in designs[0].spec.members:
        made = {id(design.members.own(name)) for design in designs}
        assert len(made) == (9 if name == "gripper" else 1), name
    assert all("max_pressure_angle" in vars(design.members["gripper"].design.main_cam) for design in designs)


def test_samples_of_a_tolerance_study_find_together(monkeypatch: pytest.MonkeyPatch) -> None:
    """In the order of the study: all of a block are made before any of them is computed."""
    data = factory.worked("sheet_feeder")
    data["tolerance"] = {"samples": 32, "sources": {"members.forwarder.design.links.crank": {"plus_minus": 0.1}}}
    made: list[str] = []
    kinds = type(KINDS["disc-cam"])
    design = kinds.design

    def counted(self: Any, command: str, spec: Any) -> Any:
        made.append(self.name)
        return design(self, command, spec)

    study = problem(KINDS["machine"].spec_model().model_validate(data))
    assert study.names == ("least_margin",)  # of the nominal design
    monkeypatch.setattr(kinds, "design", counted)
    found = evaluated(study, {"members.forwarder.design.links.crank": np.linspace(29.0, 31.0, 12)})
    assert [made.count(kind) for kind in ("disc-cam", "crank-rocker")] == [2, 12]
    assert len(set(found.quantities["least_margin"])) == 12
