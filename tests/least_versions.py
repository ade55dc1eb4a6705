"""The least versions that pyproject.toml promises, as exact requirements for pip: what `make test-least` installs."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[1] / "pyproject.toml"
EXTRAS = ("cluster",)
"""Of the extras those whose libraries the tests import; `step` is a program of its own of some hundred MB."""


def least_versions() -> list[str]:
    """`name==version` of every library that a user's installation takes.

    Raises
        ValueError - for a requirement without a lower bound
    """
    project = tomllib.loads(PROJECT.read_text(encoding="utf-8"))["project"]
    extras = [requirement for extra in EXTRAS for requirement in project["optional-dependencies"][extra]]
    return [_least(requirement) for requirement in [*project["dependencies"], *extras]]


def _least(requirement: str) -> str:
    found = re.match(r"([\w.-]+)>=([\d.]+)(,|$)", requirement)
    if found is None:
        raise ValueError(f"{requirement} has no lower bound: write it as name>=version")
    return f"{found[1]}=={found[2]}"


if __name__ == "__main__":
    print(*least_versions())
