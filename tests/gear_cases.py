"""Published gears and their design files."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

CASES = json.loads((Path(__file__).parent / "reference" / "gears.json").read_text())["cases"]
KEYS = (
    "module", "teeth", "pressure_angle", "helix_angle", "addendum", "center_distance", "profile_shift", "shift_split",
    "tip_diameter", "face_width", "tool", "span_teeth", "pin_diameter",
)  # fmt: skip


def spec_of(given: dict[str, Any]) -> dict[str, Any]:
    """The design file of a case."""
    spec: dict[str, Any] = {"kind": "gear-pair"} | {key: given[key] for key in KEYS if key in given}
    if "F_t" in given:
        spec["load"] = {"tangential_force": given["F_t"]}
    if "tip_shortening" in given and "tip_diameter" not in given:
        spec["tip_shortening"] = "full" if given["tip_shortening"] else "none"
    return spec
