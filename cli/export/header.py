"""What every exported file says of itself: design, units, tolerance asked for and error reached."""

from __future__ import annotations

import hashlib
import json
import math
from typing import Any

from gearlink.cli.export.contour import Contour
from gearlink.cli.export.options import CurveForm
from gearlink.core.version import VERSION


def design_hash(spec: Any) -> str:
    """sha256 of the design's canonical form: every key with its value, defaults included, in JSON, sorted."""
    plain = spec.model_dump(mode="json", by_alias=True)
    text = json.dumps(plain, sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def rounded_up(value: float) -> str:
    """Three digits that are not below the value.

    Example
        >>> rounded_up(0.00087212), rounded_up(0.0)
        ('0.000873', '0')
    """
    if value == 0.0:
        return "0"
    unit = 10.0 ** (math.floor(math.log10(value)) - 2)
    up = math.ceil(value / unit)
    text = f"{up * unit:.3g}"
    return text if float(text) >= value else f"{(up + 1) * unit:.3g}"


def error_name(contour: Contour) -> str:
    """What the reached error is called: that of chords, or that of cubics through the points."""
    return "spline error" if contour.form is CurveForm.SPLINE else "chord error"


def describe(contour: Contour, spec: Any, extra_error: float = 0.0) -> dict[str, str]:
    """The lines of a file's header.

    Parameters
        contour : Contour
        spec : the design's spec
        extra_error : float [mm] - what the file's own rounding adds
    """
    part = contour.part
    named = {
        "program": f"gearlink {VERSION}",
        "design": spec.name,
        "kind": spec.kind,
        "design_sha256": design_hash(spec),
        "part": f"{part.name} ({part.title})",
        "unit": "mm",
        "curve": str(contour.form),
        "tolerance": f"{contour.tolerance:g} mm",
        error_name(contour).replace(" ", "_"): f"{rounded_up(contour.error + extra_error)} mm",
        "points": ", ".join(f"{line.layer} {line.nodes.size}" for line in contour.lines),
    }
    notes = {f"note_{number}": note for number, note in enumerate(part.notes, 1)}
    return named | notes | {f"warning_{number}": text for number, text in enumerate(part.findings, 1)}
