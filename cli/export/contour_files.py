"""The blocking contour of a gear pair as a file: SVG of its plane with the design, CSV of its lines and margins."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING, Any

from gearlink.cli.export.header import design_hash
from gearlink.cli.export.options import FileFormat
from gearlink.core.base.errors import GearlinkError
from gearlink.core.version import VERSION

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SHARE = 0.7
"""Of a page's height."""


class NoContourFile(GearlinkError):
    """The contour is no body."""


def contour_file(design: Any, form: FileFormat) -> tuple[bytes, str]:
    """The bytes of the file and a word on it.

    Raises
        NoContourFile - for formats other than SVG and CSV
        NoSolution - for a gear on a rack
    """
    design.require_two_gears("a blocking contour")
    points = sum(map(len, design.contour.points.values())) if form in (FileFormat.SVG, FileFormat.CSV) else 0
    if form is FileFormat.SVG:
        return _svg(design), f"{points} points of {len(design.contour.lines)} lines"
    if form is FileFormat.CSV:
        return _csv(design), f"{points} points of {len(design.contour.lines)} lines"
    raise NoContourFile(f"the blocking contour is no profile for {form}: take --as svg or --as csv")


def _svg(design: Any) -> bytes:
    from gearlink.cli.views.figures.drawing import panels
    from gearlink.cli.views.figures.drawing.placing import settled
    from gearlink.cli.views.figures.gears.contour import contour_plot
    from gearlink.cli.views.figures.write import save

    def made() -> Figure:
        figure = panels.page(design.spec.name, _SHARE)
        grid = figure.add_gridspec(2, 1, height_ratios=(1.0, 0.12))
        contour_plot(figure.add_subplot(grid[0]), figure.add_subplot(grid[1]), design.contour)
        return settled(figure)

    stream = io.BytesIO()
    save(made, design.spec.name, stream, "svg")
    return stream.getvalue()


def _csv(design: Any) -> bytes:
    """Comment lines with the design, its shifts and margins, then a row for each point of a line."""
    text, contour = io.StringIO(), design.contour
    x1, x2 = contour.pair.profile_shift
    said = {"program": f"gearlink {VERSION}", "design": " ".join(design.spec.name.split())}
    said |= {"design_sha256": design_hash(design.spec), "x1": repr(x1), "x2": repr(x2)}
    for key, value in said.items():
        text.write(f"# {key}: {value}\n")
    writer = csv.writer(text, lineterminator="\n")
    for line in contour.lines:
        less, more = contour.margins[line.name]
        text.write(f"# margin of {line.name}: {_way(less)} to {_way(more)} in x1 at the same shift sum\n")
    writer.writerow(["line", "x1", "x2"])
    writer.writerows((name, *point) for name, points in contour.points.items() for point in points)
    return text.getvalue().encode("utf-8")


def _way(value: float | None) -> str:
    return "none" if value is None else repr(value)
