"""Mutations of design files and studies: what a slip of the pen, a bad export or ill will may make of one."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from random import Random

from gearlink.cli.texts.schema import known_keys
from gearlink.core.base.kinds import FILES

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = (ROOT / "designs", ROOT / "designs" / "studies", Path(__file__).parent / "seeds")
SEEDS = {path: path.read_text(encoding="utf-8") for folder in FOLDERS for path in sorted(folder.glob("*.yaml"))}
COMMANDS = {name: [*kind.commands] for name, kind in FILES.items()}
MORE = {
    "tolerance": ["--samples 16", "--samples 16 --sobol", "--samples 16 --worst-case", "--samples 16 --allocate"],
    "register": ["", "", "--at 10", "--at dwell", "--method mc --samples 64", "--radius 1e-6", "--table cycle"],
    "explore": ["--budget 8 -j 1", "--budget 8 -j 1 --show m1", "--budget 8 -j 1 --show 3"],
    "loads": ["", "", "--samples 7", "--table joints --table teeth", "--table harmonics --table spectrum --samples 9"],
    "gear": ["", "--table drawing", "--table path", "--table contour", "--table margins", "--candidates"],
    "cam": ["", "--table cam --samples 5"],
}
ANY = ("", "", "", "", "", "--strict", "--samples 5", "--suggest", "--save saved.yaml --force", "--save - --round 0.1")
NUMBER = re.compile(r"(?<![\w.])-?\d+\.?\d*(?:e-?\d+)?(?![\w.])")
NUMBERS = (
    *("0", "-1", "1", "1e-300", "1e300", "-1e300", "1e-6", "1e6", "5e-324", ".nan", ".inf", "-.inf", "1e400"),
    *("40", "180", "360", "359.999999999", "1e-17", "17", "0x10", "010", "2147483648", "99999999999999999999"),
)
WORDS = (
    "null",
    "true",
    "no",
    "[]",
    "{}",
    "''",
    "[1, 2]",
    "{a: 1}",
    "text",
    "-",
    "1 mm",
    "12,5",
    "40:20",
    "~",
    "&a 1",
    "*a",
    "!!int 3",
)
CHARACTERS = "\t\x00\x07\u00a0\uff1a\u2028#:-{}[]&*!|>'\"%@`,\\\r\n eE0"


def base_of(seed: Path) -> str:
    """The text of a seed; the file that a study is of, by its full path."""
    return re.sub(r"(?m)^of: (.*\.yaml)$", lambda m: f"of: {(seed.parent / m[1]).resolve()}", SEEDS[seed])


def command_of(text: str, rng: Random) -> list[str]:
    """A command that suits the kind, or one that takes any kind, with options and overridden keys."""
    match = re.search(r"^kind:\s*([\w-]+)", text, re.MULTILINE)
    kind = match[1] if match else ""
    if rng.random() < 0.1:
        return [rng.choice(("check", "batch"))]
    if rng.random() < 0.03:
        return ["export", "--as", rng.choice(("dxf", "svg", "csv", "rexs"))]
    fits = [
        name for name in COMMANDS.get(kind, ["analyze"]) if _section(name) is None or f"\n{_section(name)}:" in text
    ]
    command = rng.choice(fits or ["analyze"])
    options = rng.choice(MORE.get(command, ANY)).split()
    return [*command.split(), *options, *(_overridden(kind, rng) if rng.random() < 0.4 else ())]


def _section(command: str) -> str | None:
    """The section of a file without which a command has nothing to do."""
    return {"loads": "loads", "tolerance": "tolerance", "register": "tolerance"}.get(command)


def _overridden(kind: str, rng: Random) -> list[str]:
    """`--set` of a key that the kind knows, with a value that may be anything."""
    keys = _keys(kind)
    if not keys:
        return []
    path, value = rng.choice(keys), rng.choice((*NUMBERS, *NUMBERS, *WORDS, "0.3", "2", "12", "25", "60", "120"))
    return ["--set", f"{path}={value}"] if path != "target.budget" else []  # a search takes the time that it is given


@cache
def _keys(kind: str) -> list[str]:
    return [key.path for key, kinds in known_keys() if kind in kinds]


def mutated(text: str, rng: Random) -> bytes:
    """A design file with one to four mutations."""
    for _ in range(rng.choice((1, 1, 1, 2, 2, 3, 4))):
        text = rng.choice(_WAYS)(text, rng)
    data = text.encode("utf-8", "surrogatepass")
    if rng.random() < 0.05 and data:
        at = rng.randrange(len(data))
        data = data[:at] + bytes([rng.randrange(256)]) + data[at + rng.randrange(2) :]
    return data


def _number(text: str, rng: Random) -> str:
    found = list(NUMBER.finditer(text))
    if not found:
        return text
    spot = rng.choice(found)
    return text[: spot.start()] + rng.choice(NUMBERS) + text[spot.end() :]


def _scaled(text: str, rng: Random) -> str:
    found = list(NUMBER.finditer(text))
    if not found:
        return text
    spot = rng.choice(found)
    value = float(spot[0]) * rng.choice(
        (-1.0, 0.5, 2.0, 1.1, 0.9, 1 + 1e-12, 10.0, 0.1, 1e3, 1e-3, rng.uniform(0.0, 3.0))
    )
    new = f"{value:.0f}" if "." not in spot[0] and abs(value) >= 1.0 and rng.random() < 0.7 else repr(value)
    return text[: spot.start()] + new + text[spot.end() :]


def _word(text: str, rng: Random) -> str:
    found = list(re.finditer(r"(?<=: )[^\n{\[]+", text))
    if not found:
        return text
    spot = rng.choice(found)
    return text[: spot.start()] + rng.choice(WORDS) + text[spot.end() :]


def _lines(text: str, rng: Random) -> str:
    lines = text.split("\n")
    at, to = rng.randrange(len(lines)), rng.randrange(len(lines))
    way = rng.randrange(6)
    if way == 0:
        del lines[at]
    elif way == 1:
        lines.insert(to, lines[at])
    elif way == 2:
        lines[at], lines[to] = lines[to], lines[at]
    elif way == 3:
        lines[at] = " " * rng.randrange(1, 5) + lines[at]
    elif way == 4:
        lines[at] = lines[at].lstrip()
    else:
        lines = lines[: max(1, at)]
    return "\n".join(lines)


def _character(text: str, rng: Random) -> str:
    at = rng.randrange(len(text) + 1)
    return text[:at] + rng.choice(CHARACTERS) + text[at + rng.randrange(2) :]


def _key(text: str, rng: Random) -> str:
    found = list(re.finditer(r"[a-z_]+(?=:)", text))
    if not found:
        return text
    spot = rng.choice(found)
    word = rng.choice((spot[0][:-1], spot[0] + "s", spot[0].upper(), rng.choice(found)[0], spot[0].replace("_", "-")))
    return text[: spot.start()] + word + text[spot.end() :]


def _graft(text: str, rng: Random) -> str:
    other = rng.choice(list(SEEDS.values())).split("\n")
    tops = [i for i, line in enumerate(other) if line[:1].isalpha() and not line.startswith("kind")]
    if tops and rng.random() < 0.5:  # a whole section
        at = rng.choice(tops)
        end = next((i for i in range(at + 1, len(other)) if other[i][:1].strip()), len(other))
        return text + "\n" + "\n".join(other[at:end])
    at = rng.randrange(len(other))
    return text + "\n" + "\n".join(other[at : at + rng.randrange(1, 4)])


_WAYS = (_number, _number, _number, _scaled, _scaled, _scaled, _scaled, _word, _lines, _character, _key, _graft)
