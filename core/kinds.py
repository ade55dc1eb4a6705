"""The kinds of design and the commands that each understands; classes are imported only when one is wanted."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, NamedTuple
from weakref import WeakValueDictionary

if TYPE_CHECKING:
    from gearlink.core.design import Design
    from gearlink.core.design_axis import Maker
    from gearlink.core.mechanism.motion import Motion


class Kind(NamedTuple):
    """Where the spec model and, for each command, the design class of a kind stand ("module:Class").

    `axis` is where its array form stands, which computes many designs at once; empty where it has none. `motion` is
    where the function stands that gives the motion of a design; empty where nothing moves.
    """

    name: str
    spec: str
    commands: dict[str, str]
    axis: str = ""
    motion: str = ""

    def spec_model(self) -> Any:
        """The pydantic model of the kind's design file."""
        return _load(f"gearlink.core.{self.spec}")

    def design(self, command: str, spec: Any) -> Design:
        """The design of a spec, of the class that the command needs."""
        return FileDesigns(self, spec).of(command)

    def class_for(self, command: str, spec: Any) -> Any:
        """The class that serves a command on a spec: that of a synthesis where the file leaves its links to it."""
        return self.design_class(spec.sized_by(command) or command)

    def design_class(self, command: str) -> Any:
        """The class that serves a command."""
        return _load(f"gearlink.core.{self.commands[command]}")

    def motion_of(self, design: Design) -> Motion:
        """The motion of a design of this kind."""
        found: Motion = _load(f"gearlink.core.{self.motion}")(design)
        return found

    def axis_maker(self) -> Maker | None:
        """What makes the kind's array form, where it has one."""
        found: Maker | None = _load(f"gearlink.core.{self.axis}") if self.axis else None
        return found


class FileDesigns:
    """The designs of one file: commands of one class share theirs, and so do remedies that look at other commands.

    They last as long as something else holds them.
    """

    def __init__(self, kind: Kind, spec: Any) -> None:
        self._kind, self._spec = kind, spec
        self._made: WeakValueDictionary[Any, Design] = WeakValueDictionary()

    def __reduce__(self) -> tuple[Any, ...]:
        return FileDesigns, (self._kind, self._spec)

    def of(self, command: str) -> Design:
        """The design that serves a command."""
        cls = self._kind.class_for(command, self._spec)
        design = self._made.get(cls)
        if design is None:
            design = self._made[cls] = cls(self._spec)
            design.kin = self
        return design

    def changed(self, spec: Any) -> FileDesigns:
        """The designs of another file of the kind."""
        return FileDesigns(self._kind, spec)


def _load(place: str) -> Any:
    module, _, name = place.partition(":")
    return getattr(import_module(module), name)


_THREE_GEAR = "three_gear.design:ThreeGearFourBar"
_PRESS = "flatbed_press.design:FlatbedPress"
_GRIPPER = "swing_gripper.design:SwingGripper"
_SWING = "wide_swing.design:WideSwingDesign"
_TWO_GEAR = "planet_linkages.two_gear_design:TwoGearFourBar"
_GEARED_ROCKER = "planet_linkages.rocker_design:GearedRocker"
_HYPOCYCLOID = "dwell_gears.hypocycloid_design:HypocycloidDwell"
_FIVE_BAR = "five_bar.design:GearedFiveBar"
_SIX_BAR = "six_bar.design:GearedSixBar"
_MUTILATED = "dwell_gears.mutilated_design:MutilatedGearDwell"

_UNTOLERANCED = ("gear-train-mobility",)

KINDS: dict[str, Kind] = {
    kind.name: kind
    for kind in (
        Kind(
            "three-gear-four-bar",
            "three_gear.spec:ThreeGearSpec",
            {
                "synth dwell": "three_gear.synthesis.dwell:DwellSynthesis",
                "synth back-step": "three_gear.synthesis.back_step:BackStepSynthesis",
                "synth variable-speed": "three_gear.synthesis.variable_speed:VariableSpeedSynthesis",
                "synth momentary-dwell": "three_gear.synthesis.momentary:MomentaryDwellSynthesis",
                "analyze": _THREE_GEAR,
                "gear": _THREE_GEAR,
                "loads": "three_gear.loads:ThreeGearLoads",
                "register": "three_gear.register.budget:ThreeGearRegister",
            },
            "three_gear.many.axis:axis",
            "three_gear.mechanism:motion",
        ),
        Kind(
            "gear-pair",
            "gears.spec:GearPairSpec",
            {
                "gear": "gears.design:GearPairDesign",
                "analyze": "gears.design:GearPairDesign",
                "loads": "gears.loads:GearPairLoads",
            },
            "gears.axis:axis",
            "gears.mechanism:motion",
        ),
        Kind(
            "slider-crank",
            "linkages.slider_crank.spec:SliderCrankSpec",
            {
                "crank": "linkages.slider_crank.design:SliderCrankDesign",
                "analyze": "linkages.slider_crank.design:SliderCrankDesign",
                "loads": "linkages.slider_crank.loads:SliderCrankLoads",
            },
            "linkages.slider_crank.axis:axis",
            "linkages.slider_crank.mechanism:motion",
        ),
        Kind(
            "flatbed-press",
            "flatbed_press.spec:FlatbedPressSpec",
            {
                "press": _PRESS,
                "cam": _PRESS,
                "gear": _PRESS,
                "crank": _PRESS,
                "analyze": _PRESS,
                "loads": "flatbed_press.loads:PressLoads",
                "register": "flatbed_press.register:PressRegister",
            },
        ),
        Kind(
            "swing-gripper",
            "swing_gripper.spec:SwingGripperSpec",
            {
                "gripper": _GRIPPER,
                "cam": _GRIPPER,
                "analyze": _GRIPPER,
                "loads": "swing_gripper.loads:GripperLoads",
                "register": "swing_gripper.register:GripperRegister",
            },
        ),
        Kind(
            "wide-swing-cam",
            "wide_swing.spec:WideSwingSpec",
            {
                "swing": _SWING,
                "cam": _SWING,
                "analyze": _SWING,
                "loads": "wide_swing.loads.design:WideSwingLoads",
            },
            motion="wide_swing.mechanism:motion",
        ),
        Kind(
            "gear-train-mobility",
            "linkages.mobility.spec:GearTrainMobilitySpec",
            {"analyze": "linkages.mobility.design:GearTrainMobility"},
        ),
        Kind(
            "mutilated-gear-dwell",
            "dwell_gears.mutilated_spec:MutilatedGearDwellSpec",
            {"analyze": _MUTILATED, "gear": _MUTILATED, "loads": "dwell_gears.mutilated_loads:MutilatedGearLoads"},
            motion="dwell_gears.mutilated_mechanism:motion",
        ),
        Kind(
            "two-gear-four-bar",
            "planet_linkages.two_gear_spec:TwoGearFourBarSpec",
            {
                "synth dwell": "planet_linkages.two_gear_synthesis:DwellSynthesis",
                "synth back-step": "planet_linkages.two_gear_synthesis:BackStepSynthesis",
                "synth momentary-dwell": "planet_linkages.two_gear_synthesis:MomentaryDwellSynthesis",
                "analyze": _TWO_GEAR,
                "gear": _TWO_GEAR,
                "loads": "planet_linkages.loads:TwoGearLoads",
            },
            motion="planet_linkages.mechanism:two_gears",
        ),
        Kind(
            "geared-rocker",
            "planet_linkages.rocker_spec:GearedRockerSpec",
            {"analyze": _GEARED_ROCKER, "gear": _GEARED_ROCKER, "loads": "planet_linkages.loads:GearedRockerLoads"},
            motion="planet_linkages.mechanism:geared_rocker",
        ),
        Kind(
            "geared-five-bar",
            "five_bar.spec:GearedFiveBarSpec",
            {"analyze": _FIVE_BAR, "gear": _FIVE_BAR, "loads": "five_bar.loads:FiveBarLoads"},
            motion="five_bar.mechanism:motion",
        ),
        Kind(
            "geared-six-bar",
            "six_bar.spec:GearedSixBarSpec",
            {"analyze": _SIX_BAR, "gear": _SIX_BAR, "loads": "six_bar.loads:SixBarLoads"},
            motion="six_bar.mechanism:motion",
        ),
        Kind(
            "hypocycloid-dwell",
            "dwell_gears.hypocycloid_spec:HypocycloidDwellSpec",
            {
                "analyze": _HYPOCYCLOID,
                "gear": _HYPOCYCLOID,
                "loads": "dwell_gears.hypocycloid_loads:HypocycloidDwellLoads",
            },
            motion="dwell_gears.hypocycloid_mechanism:motion",
        ),
    )
}
for _kind in KINDS.values():
    if _kind.name not in _UNTOLERANCED:
        _kind.commands["tolerance"] = "tolerance_study.design:ToleranceStudy"

STUDY = Kind("study", "study.spec:StudySpec", {"explore": "explore.exploration:Exploration"})
FILES: dict[str, Kind] = {**KINDS, STUDY.name: STUDY}
"""Every kind of file: designs, and studies of many designs."""

SUMMARIES = {
    "three-gear-four-bar": "feed drive that dwells: gear on the crank, idler, output gear on the rocker's axis",
    "gear-pair": "two gears in mesh",
    "slider-crank": "offset slider-crank from its stroke",
    "flatbed-press": "flatbed cylinder press: bed and cylinder chain, synchronous zone, compensation cam",
    "swing-gripper": "swing gripper of a sheet-fed press: law, linkage, handover, cams",
    "wide-swing-cam": "cam drive of a wide swing with a device that bears the inertia",
    "gear-train-mobility": "degrees of freedom of a linkage that carries gear trains",
    "mutilated-gear-dwell": "long dwell by a wheel with teeth left out",
    "two-gear-four-bar": "planet on the coupler drives a sun or a ring on the crank's axis",
    "geared-rocker": "rocker whose swing a gear on the coupler multiplies",
    "geared-five-bar": "five-bar held by gears: path of a point, or output as a function of the input",
    "geared-six-bar": "loop of six links that two gear trains drive by one input",
    "hypocycloid-dwell": "slider that dwells on an arc of a hypocycloid",
    "study": "search through many designs of one kind, for `gearlink explore`",
}
"""Each kind of file in a few words."""
