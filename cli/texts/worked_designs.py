"""The example that shows a kind."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

from gearlink import designs

if TYPE_CHECKING:
    from gearlink.core.base.kind import Kind

_KIND = re.compile(r"^kind:\s*([\w-]+)", re.MULTILINE)


def worked_design(kind: Kind) -> str:
    """The text of the kind's example: the file that bears its name, else the first by name."""
    folder = Path(str(designs.__file__)).parent
    files = [(file.stem, file.read_text(encoding="utf-8")) for file in folder.rglob("*.yaml")]
    own = {stem: text for stem, text in files if (found := _KIND.search(text)) and found[1] == kind.name}
    if not own:
        raise LookupError(f"no example of kind {kind.name} in gearlink.designs")
    return own.get(kind.worked or kind.name.replace("-", "_"), own[min(own)])
