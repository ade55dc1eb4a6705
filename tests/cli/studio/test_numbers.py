"""What the sliders of a file may do."""

from __future__ import annotations

from pathlib import Path

import pytest

from gearlink.cli.reading.design_file import parse, validate
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.studio.numbers import Number, numbers
from gearlink.cli.studio.text import with_value
from gearlink.core.base.kinds import FILES

DESIGNS = sorted((Path(__file__).parents[3] / "designs").glob("*.yaml"))


def _numbers(text: str) -> dict[str, Number]:
    loaded = parse(text.encode(), "design.yaml")
    return {number.name: number for number in numbers(loaded, FILES[loaded.data["kind"]].spec_model(), {})}


@pytest.mark.parametrize(
    ("line", "name", "unit", "step", "least_and_most"),
    [
        ("module: 2\nteeth: [25, 40]", "teeth[1]", "teeth", 1.0, (20.0, 60.0)),
        ("module: 2\nteeth: [25, 40]\nhelix_angle: 12", "helix_angle", "deg", 0.5, (0.0, 45.0)),
        ("module: 2\nteeth: [25, 40]\ncenter_distance: 66.25", "center_distance", "mm", 0.01, (33.13, 99.37)),
        ("module: 2\nteeth: [25, 40]\nface_width: 1 in", "face_width", "in", 0.001, (0.5, 1.5)),
    ],
)
def test_ranges_and_steps(line: str, name: str, unit: str, step: float, least_and_most: tuple[float, float]) -> None:
    number = _numbers(f"kind: gear-pair\n{line}\n")[name]
    assert (number.unit, number.step) == (unit, pytest.approx(step, rel=1e-12))
    assert number.range == pytest.approx(least_and_most, rel=1e-9)


def test_grids() -> None:
    found = _numbers("kind: gear-pair\nmodule: 2\nteeth: [25, 40]\nface_width: 20\n")
    assert found["module"].on_grid(2.3) == 2.5  # ISO 54
    assert found["teeth[0]"].on_grid(26.4) == 26
    assert f"{found['face_width'].on_grid(20.1300000001)}" == "20.1"
    assert not found["module"].is_geometry


@pytest.mark.quick(2)
@pytest.mark.parametrize("path", DESIGNS, ids=lambda path: path.stem)
def test_the_schema_allows_both_ends_of_every_slider(path: Path) -> None:
    """The other way: the model reads the file with either end; what several keys say together may refuse."""
    text = path.read_text(encoding="utf-8")
    model = FILES[parse(text.encode(), path.name).data["kind"]].spec_model()
    for number in _numbers(text).values():
        assert number.range[0] <= number.value <= number.range[1]
        for end in number.range:
            value = int(end) if number.whole else end
            loaded = parse(with_value(text, number.path, value, as_written=True).encode(), str(path))
            try:
                validate(loaded, model)
            except DesignFileError as error:
                said = [d.message for d in error.diagnostics if d.key == number.name]
                assert not [words for words in said if words.startswith(f"{number.name} must be")]
