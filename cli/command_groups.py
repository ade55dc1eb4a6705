"""The list of commands in the order of work, under headings."""

from __future__ import annotations

from typing import Any

from typer.core import TyperGroup

GROUPS = {
    "Learn and start": ("new", "explain", "schema", "laws", "chart", "help"),
    "Find a design": ("synth", "gears", "explore"),
    "Compute a design": ("analyze", "gear", "crank", "press", "gripper", "swing", "cam", "loads"),
    "Checks and tolerances": ("check", "diff", "tolerance", "register", "verify"),
    "Show and export": ("report", "watch", "studio", "sheet", "animate", "export"),
    "Many designs": ("batch",),
}
"""Headings and the commands below them; a command that stands in none comes last."""


class OrderOfWork(TyperGroup):
    """A group of commands that lists them as `GROUPS` says."""

    def list_commands(self, _ctx: Any) -> list[str]:
        """Names of the commands, in the order of work."""
        names = [name for group in GROUPS.values() for name in group if name in self.commands]
        return [*names, *(name for name in self.commands if name not in names)]

    def format_commands(self, _ctx: Any, formatter: Any) -> None:
        """Write each group under its heading."""
        known = {name for group in GROUPS.values() for name in group}
        rest = tuple(name for name in self.commands if name not in known)
        width = max(map(len, self.commands), default=0)
        for heading, group in {**GROUPS, "More": rest}.items():
            rows = [
                (f"{name:<{width}}", self._summary(name, formatter.width - width - 6))
                for name in group
                if name in self.commands
            ]
            if rows:
                with formatter.section(heading):
                    formatter.write_dl(rows)

    def _summary(self, name: str, limit: int) -> str:
        return str(self.commands[name].get_short_help_str(limit))
