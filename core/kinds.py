"""The kinds of design and the commands that each understands; classes are imported only when one is wanted."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gearlink.core.design import Design


@dataclass(frozen=True, slots=True)
class Kind:
    """Where the spec model and, for each command, the design class of a kind stand ("module:Class")."""

    name: str
    spec: str
    commands: dict[str, str]

    def spec_model(self) -> Any:
        """The pydantic model of the kind's design file."""
        return _load(f"gearlink.core.specs.{self.spec}")

    def design(self, command: str, spec: Any, samples: int | None = None) -> Design:
        """The design of a spec, of the class that the command needs."""
        design: Design = self.design_class(command)(spec, samples)
        return design

    def design_class(self, command: str) -> Any:
        """The class that serves a command."""
        return _load(f"gearlink.core.{self.commands[command]}")


def _load(place: str) -> Any:
    module, _, name = place.partition(":")
    return getattr(import_module(module), name)


_THREE_GEAR = "three_gear_four_bar:ThreeGearFourBar"
_PRESS = "flatbed_press:FlatbedPress"
_GRIPPER = "swing_gripper:SwingGripper"
_SWING = "wide_swing_design:WideSwingDesign"
_TWO_GEAR = "two_gear_four_bar:TwoGearFourBar"
_GEARED_ROCKER = "geared_rocker:GearedRocker"
_HYPOCYCLOID = "hypocycloid_dwell:HypocycloidDwell"
_FIVE_BAR = "geared_five_bar:GearedFiveBar"
_MUTILATED = "mutilated_gear_dwell:MutilatedGearDwell"

KINDS: dict[str, Kind] = {
    kind.name: kind
    for kind in (
        Kind(
            "three-gear-four-bar",
            "three_gear:ThreeGearSpec",
            {
                "synth dwell": "three_gear_synthesis:DwellSynthesis",
                "synth back-step": "three_gear_synthesis:BackStepSynthesis",
                "synth variable-speed": "three_gear_synthesis:VariableSpeedSynthesis",
                "synth momentary-dwell": "three_gear_synthesis:MomentaryDwellSynthesis",
                "analyze": _THREE_GEAR,
                "gear": _THREE_GEAR,
            },
        ),
        Kind(
            "gear-pair",
            "gear_pair:GearPairSpec",
            {"gear": "gear_pair_design:GearPairDesign", "analyze": "gear_pair_design:GearPairDesign"},
        ),
        Kind(
            "slider-crank",
            "slider_crank:SliderCrankSpec",
            {
                "crank": "slider_crank_design:SliderCrankDesign",
                "analyze": "slider_crank_design:SliderCrankDesign",
            },
        ),
        Kind(
            "flatbed-press",
            "flatbed_press:FlatbedPressSpec",
            {"press": _PRESS, "cam": _PRESS, "gear": _PRESS, "crank": _PRESS, "analyze": _PRESS},
        ),
        Kind(
            "swing-gripper",
            "swing_gripper:SwingGripperSpec",
            {"gripper": _GRIPPER, "cam": _GRIPPER, "analyze": _GRIPPER},
        ),
        Kind("wide-swing-cam", "wide_swing:WideSwingSpec", {"swing": _SWING, "cam": _SWING, "analyze": _SWING}),
        Kind(
            "gear-train-mobility",
            "gear_train_mobility:GearTrainMobilitySpec",
            {"analyze": "gear_train_mobility:GearTrainMobility"},
        ),
        Kind(
            "mutilated-gear-dwell",
            "mutilated_gear_dwell:MutilatedGearDwellSpec",
            {"analyze": _MUTILATED, "gear": _MUTILATED},
        ),
        Kind(
            "two-gear-four-bar",
            "two_gear_four_bar:TwoGearFourBarSpec",
            {"analyze": _TWO_GEAR, "gear": _TWO_GEAR},
        ),
        Kind(
            "geared-rocker",
            "geared_rocker:GearedRockerSpec",
            {"analyze": _GEARED_ROCKER, "gear": _GEARED_ROCKER},
        ),
        Kind("geared-five-bar", "geared_five_bar:GearedFiveBarSpec", {"analyze": _FIVE_BAR, "gear": _FIVE_BAR}),
        Kind(
            "hypocycloid-dwell",
            "hypocycloid_dwell:HypocycloidDwellSpec",
            {"analyze": _HYPOCYCLOID, "gear": _HYPOCYCLOID},
        ),
    )
}
