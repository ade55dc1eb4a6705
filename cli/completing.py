"""What a shell offers on Tab: kinds, codes and words to explain, quantities and tables of the design, keys for --set.

A shell asks by running gearlink with the line in its environment; a design file among the words of the line decides
which quantities and keys there are. What cannot be read offers what every kind has.
"""

from __future__ import annotations

import os
import re
import shlex
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from gearlink.core.base.kind import Kind

Offer: TypeAlias = list[tuple[str, str]]
_KIND = re.compile(r"^\W*kind\W+([\w-]+)", re.MULTILINE)
_CASE = re.compile(r"^  - id: (\S+)", re.MULTILINE)
_ENOUGH = 65_536
_LINES = ("COMP_WORDS", "_TYPER_COMPLETE_ARGS")


def kinds(incomplete: str) -> Offer:
    """Kinds of design files."""
    from gearlink.core.base.kinds import FILES

    return _beginning(incomplete, ((kind.name, kind.summary) for kind in FILES.values()))


def explained(incomplete: str) -> Offer:
    """Everything that `explain` knows."""
    from gearlink.cli.commands.explain import names, plain_names, symbols
    from gearlink.cli.glossary import glossary

    known = names() if "." in incomplete else plain_names()  # paths of keys only where one is begun: they take a second
    more = ((symbol, words) for symbol, words in symbols() if incomplete)  # many, and short
    begun = ((name.replace(" ", "-"), term) for term in glossary().values() for name in term.names() if incomplete)
    terms = {name: term.definition.partition(". ")[0] for name, term in begun if re.fullmatch(r"[\w-]+", name)}
    return _beginning(incomplete, (*((name, "") for name in known if name not in terms), *terms.items(), *more))


def laws(incomplete: str) -> Offer:
    """Names of the motion laws."""
    from gearlink.core.parts.cams.laws import REST_TO_REST, REST_TO_SPEED

    return _beginning(incomplete, ((name, "") for name in (*REST_TO_REST, *REST_TO_SPEED)))


def charts(incomplete: str) -> Offer:
    """Names of the design charts."""
    from gearlink.cli.views.figures.chart_list import CHARTS, OF_FILES

    return _beginning(incomplete, ((name, "") for name in (*CHARTS, *OF_FILES)))


def quantities(incomplete: str) -> Offer:
    """Quantities of the design file on the line, with what they mean."""
    from gearlink.core.base.nomenclature import TERMS, term

    names, (kind, _) = _of_design("quantity_names") or TERMS, _design()
    return _beginning(incomplete, ((name, term(name, kind.name if kind else "").words) for name in names))


def tables(incomplete: str) -> Offer:
    """Tables of the design file on the line."""
    return _beginning(incomplete, ((name, "") for name in _of_design("table_names")))


def settings(incomplete: str) -> Offer:
    """Keys of the design file on the line, as `--set` takes them."""
    from gearlink.cli.texts.schema import spec_keys

    keys = [key for kind in _kinds() for key in spec_keys(kind)]
    return _beginning(
        incomplete, ((f"{key.path}=", key.words) for key in keys if not key.section and key.path != "kind")
    )


def parts(incomplete: str) -> Offer:
    """Parts that `export` takes of the design file on the line."""
    kinds = _kinds()
    of_file: Iterable[str] = ()
    if [bool(kind.profiles and not kind.parts) for kind in kinds] == [True]:
        of_file = _planar_parts() if kinds[0].name == "planar-mechanism" else _gears_on_pins()
    return _beginning(incomplete, ((name, "") for name in (*of_file, *(name for kind in kinds for name in kind.parts))))


def sheets(incomplete: str) -> Offer:
    """Further sheets of the design file on the line."""
    from gearlink.cli.export.options import drawing_of

    kinds = _kinds()
    names = [name for kind in kinds for name in kind.all_sheets]
    cams = [*_planar().get("cams", {})] if [kind.name for kind in kinds] == ["planar-mechanism"] else []
    count = max(3 if re.search(r"^fingers\b", next(_texts(_words()), ""), re.MULTILINE) else 2, len(cams))
    discs = ("zone", "contact", *(f"drawing-{k + 1}" for k in range(count))) if "drawing" in names else ()
    cut = (f"drawing-{found}" for kind in kinds for name, _ in parts("") if (found := drawing_of(kind, name, cams)))
    return _beginning(incomplete, ((name, "") for name in (*names, "tornado", *discs, *cut)))


def places(incomplete: str) -> Offer:
    """Where the register of the design file on the line is asked for, beside angles."""
    kinds = (kind for kind in _kinds() if "register" in kind.commands and kind.register_at)
    return _beginning(incomplete, ((kind.register_at, "") for kind in kinds))


def published_cases(incomplete: str) -> Offer:
    """Cases that `verify` computes, by the lines that name them: to read their files takes longer."""
    from gearlink.cli.verification.cases import FOLDER, names

    texts = ((FOLDER / f"{name}.yaml").read_text(encoding="utf-8").partition("\ndiffers:")[0] for name in names())
    return _beginning(incomplete, ((name, "") for text in texts for name in _CASE.findall(text)))


def commands(incomplete: str) -> Offer:
    """Commands to have help on; behind `synth` its own."""
    from gearlink.cli.command_groups import GROUPS
    from gearlink.cli.options import COMMANDS

    words = _words()[2:]
    group = words[0] if words and (len(words) > 1 or not incomplete) else ""
    inner = [name.removeprefix(f"{group} ") for name in COMMANDS if group and name.startswith(f"{group} ")]
    outer = [] if group else [name for names in GROUPS.values() for name in names]
    return _beginning(incomplete, ((name, "") for name in (*inner, *outer)))


_PINS = re.compile(r"\bpins\W*:\s*\[([^\]]*)\]")


def _gears_on_pins() -> Iterator[str]:
    """Gears of the trains of a geared six-bar, as far as its pins stand in brackets."""
    text = next(_texts(_words()), "")
    for number, train in enumerate(_PINS.findall(text), 1):
        yield from (f"gear{number}{pin}" for pin in re.findall(r"\w+", train))


def _planar_parts() -> Iterator[str]:
    """Paths of the output points, gears of the meshes and cams of a planar mechanism."""
    data = _planar()
    points = {name for link in data["links"].values() for name in (link if isinstance(link, dict) else link[:2])}
    yield from (f"PATH-{name}" for name in data.get("outputs", ()) if name in points)
    for name, mesh in data.get("meshes", {}).items():
        yield from (f"{name}_{link}" for link in mesh.get("gears", (mesh.get("pinion"),)))
    yield from data.get("cams", {})


def _planar() -> Any:
    """The data of the first design file on the line."""
    import yaml

    return yaml.safe_load(next(_texts(_words()), ""))


def _beginning(incomplete: str, offers: Iterable[tuple[str, str]]) -> Offer:
    """Those that begin as the word does; letters count alike, large or small."""
    start = incomplete.casefold()
    return list({name: words for name, words in offers if name.casefold().startswith(start)}.items())


def _of_design(names: str) -> tuple[str, ...]:
    """Names that the design class of the line gives: of the command on the line, else of all of the kind."""
    kind, words = _design()
    if kind is None:
        return ()
    asked = [command for command in kind.commands if command.split() == words[1 : 1 + len(command.split())]]
    found: dict[str, None] = {}
    for command in asked or kind.commands:
        found |= dict.fromkeys(getattr(kind.design_class(command), names)())
    return tuple(found)


def _design() -> tuple[Kind | None, list[str]]:
    """The kind of the first design file on the line, and the words of the line."""
    from gearlink.core.base.kinds import KINDS

    words = _words()
    for text in _texts(words):
        if (found := _KIND.search(text)) and found[1] in KINDS:
            return KINDS[found[1]], words
    return None, words


def _kinds() -> list[Kind]:
    """The kind of the first design file on the line; without one, all kinds."""
    from gearlink.core.base.kinds import KINDS

    kind, _ = _design()
    return [*KINDS.values()] if kind is None else [kind]


def _words() -> list[str]:
    line = next((os.environ[name] for name in _LINES if os.environ.get(name)), "")
    try:
        return shlex.split(line.replace("\n", " "))
    except ValueError:  # a quote that is still open
        return line.split()


def _texts(words: list[str]) -> Iterator[str]:
    for word in words[1:]:
        path = os.path.expanduser(word)
        if os.path.isfile(path):
            try:
                with open(path, "rb") as stream:
                    yield stream.read(_ENOUGH).decode(errors="replace")
            except OSError:
                continue


def offered(name: str, incomplete: str) -> Offer:
    """What one of the functions above offers; nothing where it fails, since a fault must not spoil the line."""
    try:
        found: Offer = globals()[name](incomplete)
    except Exception:
        return []
    return found


BASH = """
%(complete_func)s() {
    local IFS=$'\\n'
    COMPREPLY=( $( env COMP_WORDS="${COMP_WORDS[*]}" \\
                   COMP_CWORD=$COMP_CWORD \\
                   %(autocomplete_var)s=complete_bash $1 2>/dev/null ) )
    [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *= ]] && compopt -o nospace
    return 0
}

complete -o default -F %(complete_func)s %(prog_name)s
"""
"""Typer's script, which after a key for --set leaves the cursor behind the =."""

ZSH = """
#compdef %(prog_name)s

%(complete_func)s() {
  local line="${words[1,$CURRENT]}"
  local offer="$(env _TYPER_COMPLETE_ARGS=$line %(autocomplete_var)s=complete_zsh %(prog_name)s 2>/dev/null)"
  if [[ "${words[CURRENT-1]}" == --set ]]; then
    compadd() { builtin compadd -S "" "$@" }
    eval $offer
    unfunction compadd
  else
    eval $offer
  fi
}

if [[ "${funcstack[1]}" == _%(prog_name)s ]]; then
  %(complete_func)s "$@"
else
  compdef %(complete_func)s %(prog_name)s
fi
"""
"""Typer's script, which as an autoloaded function completes from the first Tab on."""


def better_scripts() -> None:
    """Let --install-completion and --show-completion give these scripts."""
    from typer import _completion_shared

    _completion_shared._completion_scripts |= {"bash": BASH, "zsh": ZSH}
