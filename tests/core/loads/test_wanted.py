"""What a command asks of the loads is searched together; what it does not ask for is not searched."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from sweeps import spread

from gearlink.core.base.results import observed
from gearlink.core.mechanism.motion import Motion
from tests.factory import design


def _loads() -> Any:
    return design("loaded_feed", command="loads")


def test_one_quantity_searches_its_own_extreme_alone() -> None:
    """`--quantity pin_A.peak` looks for no other force, no torque and no reversal."""
    loads = _loads()
    loads.report("loads", quantities=["pin_A.peak"])
    assert set(loads._found) == {("pin_A", True)}
    assert "reversals" not in vars(loads.pin("A"))


def test_quantities_found_together_are_those_found_alone() -> None:
    """Each quantity of the outline has the same bits, asked for alone."""
    together = {q.name: q.value for q in _loads().report("loads").quantities}
    names = ("input_torque_min", "shaking_force_max", "pin_B.peak", "pin_C.equivalent", "reflected_inertia_max")
    for name in spread(names, 2):
        (alone,) = _loads().report("loads", quantities=[name]).quantities
        assert alone.value == together[name], name


def test_links_are_computed_once_for_all_that_look_at_them() -> None:
    """All quantities together compute the links as often as a few searches do: 19 times ahead, 60 in all."""
    loads, asked = _loads(), []
    plain = loads.moving
    loads.moving = Motion(lambda phi, *more: asked.append(phi.size) or plain.make(phi, *more))
    loads.prepare(loads.outline("loads").quantities)
    searched = len(asked)
    for name in loads.outline("loads").quantities:
        loads.raw(name)
    assert searched < 25
    assert len(asked) < 75


def test_findings_compute_no_quantity_that_no_check_looks_at() -> None:
    """A check needs no root mean square, no moment on the frame, and of the pins those alone that have a bearing."""
    seen: list[str] = []

    @contextmanager
    def watch(name: str) -> Iterator[None]:
        seen.append(name)
        yield

    loads = _loads()
    with observed(watch):
        loads.report("loads", findings_only=True)
    assert "LoadsDesign.power_identity" in seen
    assert not {"LoadsDesign.input_torque_rms", "LoadsDesign.shaking_moment_max", "Vibrating.twisted_ripple"} & set(
        seen
    )
    peaks = {course for course, _ in loads._found if course.startswith("pin_")}
    assert peaks == {f"pin_{name}" for name in loads.section.bearings}


def test_the_commands_of_a_file_share_its_geometry() -> None:
    """What `swing` has found of the cams is not sought again by `loads`; a design by itself makes its own."""
    from gearlink.core.base.kind import FileDesigns
    from gearlink.core.base.kinds import KINDS

    spec = design("loaded_wide_swing", command="loads").spec
    designs = FileDesigns(KINDS[spec.kind], spec)
    geometry, loads = designs.of("swing"), designs.of("loads")
    assert loads.design is geometry  # type: ignore[attr-defined]
    assert design("loaded_wide_swing", command="loads").design is not geometry
