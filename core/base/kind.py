"""A kind of file and what follows from its record: its spec model and its designs, imported on demand."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any, NamedTuple
from weakref import WeakValueDictionary

if TYPE_CHECKING:
    from gearlink.core.base.design import Design, Made
    from gearlink.core.base.design_axis import Maker
    from gearlink.core.base.report import Remedy
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.mechanism.motion import Motion

_SHARED = {
    "explore": "studies.explore.exploration:Exploration",
    "tolerance": "studies.tolerance_study.design:ToleranceStudy",
    "register": "studies.register:MotionRegister",
}
"""Commands that are no kind's own."""


class Kind(NamedTuple):
    """The record of a kind; locations are "module:name", below `folder` or below gearlink (cli).

    Fields
        name, summary : str - as `kind` in a file has it; the kind in a few words
        folder : str - of core, in which the kind stands
        spec : str - the model of the design file
        commands : dict - class of the design by command; "": one that serves all kinds
        motion : str - what gives the motion of a design, of which all that is generic is made; "": nothing moves
        codes : str - module of the rules that its checks alone judge by; "": it has none
        array : str - its array form, which computes many designs at once; "": none
        samples : str - array form of the designs as manufactured, for `tolerance`; "": each is computed alone
        outputs : dict - columns of the output over the cycle, by table; the first that a design shows counts
        errors : str - what its sizes, gears and pins move, for `register`; "": pins alone are known
        register_at : str - where `register` looks where the file does not say
        drawn : commands that all kinds share and whose picture is its own all the same
        picture, scene : str - what draws its own commands, what builds its animation; "": what any motion has
        profiles, parts : str, (names) - what makes the parts that `export` takes; their names, where a kind fixes them
        cut : bool - whether its parts have workshop drawings, as gears do; disc cams have them with their followers
        rexs : (names) or None - its gears in REXS, in the order of the file; (): as the file names them; None: no pair
        sheets : dict - what gives the content of a sheet, by its name; "": it has not the one that any motion has
        worked : str - stem of the example to begin with, where it is not called as the kind
        terms : dict - fields of the `nomenclature.Term` of a quantity that has another meaning in the other kinds
    """

    name: str
    summary: str
    folder: str
    spec: str
    commands: Mapping[str, str]
    motion: str = "mechanism:motion"
    codes: str = ""
    array: str = ""
    samples: str = ""
    outputs: Mapping[str, tuple[str, ...]] = {}
    errors: str = ""
    register_at: str = "range"
    picture: str = ""
    drawn: tuple[str, ...] = ()
    scene: str = ""
    profiles: str = ""
    parts: tuple[str, ...] = ()
    cut: bool = False
    rexs: tuple[str, ...] | None = None
    sheets: Mapping[str, str] = {}
    worked: str = ""
    terms: Mapping[str, tuple[str, ...]] = {}

    @property
    def all_sheets(self) -> dict[str, str]:
        """What gives the content of each sheet: that of the motion stands for itself."""
        sheets = "cli.views.figures.sheets"
        of_motion = {
            "motion": f"{sheets}.motion_sheet:of_motion",
            "vectors": f"{sheets}.vector_sheet:draw",
            "dwell": f"{sheets}.motion_sheet:dwell",
        }
        if not self.motion:
            of_motion = {}
        if "loads" in self.commands and self.motion:
            of_motion["forces"] = "cli.views.figures.loads:draw_forces"
        return {name: place for name, place in {**of_motion, **self.sheets}.items() if place}

    def spec_model(self) -> Any:
        """The pydantic model of the kind's design file."""
        return self._own(self.spec)

    def design(self, command: str, spec: Any) -> Design:
        """The design of a spec, of the class that the command needs."""
        return FileDesigns(self, spec).of(command)

    def class_for(self, command: str, spec: Any) -> Any:
        """The class that serves a command on a spec: that of a synthesis where the file leaves its links to it."""
        return self.design_class(spec.sized_by(command) or command)

    def completed(self, spec: Any) -> Any:
        """The spec with what its one synthesis finds, where the file leaves its links to that."""
        if not spec.sized_by("analyze"):
            return spec
        from gearlink.core.base.spec_paths import changed

        found = self.class_for("analyze", spec)(spec).completion()
        return changed(spec, [(one.path, one.value) for one in found])

    def design_class(self, command: str) -> Any:
        """The class that serves a command."""
        place = self.commands[command]
        return self._own(place) if place else load(f"core.{_SHARED[command]}")

    def motion_of(self, design: Design) -> Motion:
        """The motion of a design of this kind."""
        found: Motion = self._own(self.motion)(design)
        return found

    def movable(self, design: Design, mechanism: Mechanism) -> Any:
        """The `Movable` of a design: the elements moved by its sizes, gears and pins."""
        if self.errors:
            return self._own(self.errors)(design, mechanism)
        return load("core.studies.movable:Movable")()

    def axis_maker(self) -> Maker | None:
        """The maker of the kind's array form; None without one."""
        found: Maker | None = self._own(self.array) if self.array else None
        return found

    def samples_maker(self) -> Any:
        """What makes the array form of a nominal design as manufactured; None where it has none."""
        return self._own(self.samples) if self.samples else None

    def _own(self, place: str) -> Any:
        return load(f"core.{self.folder}.{place}")


class FileDesigns:
    """The designs of one file: commands of one class share theirs, and so do remedies that look at other commands.

    They last as long as something else holds them.
    """

    def __init__(self, kind: Kind, spec: Any) -> None:
        self._kind, self._spec = kind, spec
        self._made: WeakValueDictionary[Any, Design] = WeakValueDictionary()
        self.remedies: list[Remedy] = []

    def __reduce__(self) -> tuple[Any, ...]:
        return FileDesigns, (self._kind, self._spec)

    def of(self, command: str) -> Design:
        """The design that serves a command."""
        found: Design = self.of_class(self._kind.class_for(command, self._spec), self._spec)
        return found

    def of_class(self, cls: type[Made], spec: Any) -> Made:
        """The design of a class, that of a command or the geometry of one; one of its own for a completed spec."""
        if spec is not self._spec:
            return cls(spec)
        made: Any = self._made.get(cls)
        if made is None:
            made = cls.__new__(cls)
            made.kin = self  # before the rest, which may ask for the others
            made.__init__(self._spec)
            self._made[cls] = made
        found: Made = made
        return found

    def changed(self, spec: Any) -> FileDesigns:
        """The designs of another file of the kind."""
        return FileDesigns(self._kind, spec)


def load(place: str) -> Any:
    """The object at a location below gearlink, "package.module:name"."""
    module, _, name = place.partition(":")
    return getattr(import_module(f"gearlink.{module}"), name)
