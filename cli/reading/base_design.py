"""The base design of a study, which stands in it or in the file that it names; and faults of a study located."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from gearlink.cli.reading.design_file import fixed_path, has_term, load, read_kind, validate
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.reading.loaded_file import LoadedFile
from gearlink.cli.reading.places import ENDINGS, base_path, is_design_name
from gearlink.cli.reading.yaml_reader import format_path
from gearlink.core.base.kinds import KINDS
from gearlink.core.studies.study.faults import Fault


def with_base(loaded: LoadedFile, spec: Any) -> Any:
    """A study's spec with the data of its base design, validated, in `design`.

    Raises
        DesignFileError - GL156 at the places of the base, GL101 where there is no such file
    """
    if spec.of is None:
        base = loaded.part(("design",))
        where = "the base design"
    else:
        path = base_path(loaded.file, spec.of)
        if not is_design_name(path.name):
            message = f"the base design {path} is not a design file ({', '.join(ENDINGS)})"
            raise DesignFileError([loaded.report("GL101", message, ("of",))])
        try:
            base = load(str(path))
        except DesignFileError as error:
            if error.diagnostics[0].code != "GL101":
                raise
            wrong = error.diagnostics[0]
            message = f"the base design {path}: {wrong.message}"
            raise DesignFileError([loaded.report("GL101", message, ("of",), help=wrong.help)]) from None
        where = f"the base design of {loaded.file}"
    try:
        validate(base, KINDS[read_kind(base, tuple(KINDS))].spec_model())
    except DesignFileError as error:
        below = "" if spec.of is not None else "design."
        if spec.of is None and isinstance(base.data, dict) and set(base.data) == {"of"}:
            message = "'of' replaces design and cannot be inside it"
            remedy = f"write of: {base.data['of']} without design:"
            raise DesignFileError(
                [loaded.report("GL156", message, ("design", "of"), key="design.of", help=remedy)]
            ) from None
        raise DesignFileError([_of_base(d, where, below) for d in error.diagnostics]) from None
    return spec.model_copy(update={"design": base.data, "variables": _variables(spec.variables, base)})


def _variables(given: dict[str, Any], base: LoadedFile) -> dict[str, Any]:
    """The variables of a study by the fixed names of the keys of its base design."""
    model = KINDS[read_kind(base, tuple(KINDS))].spec_model()
    found = {}
    for path, each in given.items():
        if each.times is not None and has_term(each.times):
            each = each.model_copy(update={"times": fixed_path(each.times, model, base.data)})
        if any(map(has_term, each.also)):
            each = each.model_copy(update={"also": [fixed_path(name, model, base.data) for name in each.also]})
        found[fixed_path(path, model, base.data)] = each
    return found


def _of_base(wrong: Diagnostic, where: str, below: str) -> Diagnostic:
    return replace(wrong, code="GL156", message=f"{where}: {wrong.message}", key=f"{below}{wrong.key}")


def located(loaded: LoadedFile, faults: Sequence[Fault]) -> list[Diagnostic]:
    """Faults of a study at their keys."""
    found = []
    for fault in faults:
        place = ("of",) if fault.place[:1] == ("design",) and "design" not in loaded.data else fault.place
        key = unquoted(format_path(tuple(fault.place)))
        found.append(loaded.report(fault.code, fault.message, place, key=key, help=fault.help))
    return found


def unquoted(key: str) -> str:
    """A key of a study as scripts read it: the variables are paths themselves, `variables.gears.crank.to`."""
    return key.replace('"', "")


def with_plain_keys(error: DesignFileError) -> DesignFileError:
    """The errors of a study's model, their keys unquoted."""
    return DesignFileError([replace(wrong, key=unquoted(wrong.key)) for wrong in error.diagnostics])
