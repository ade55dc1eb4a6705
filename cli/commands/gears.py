"""`gearlink gears`: the integer search of gear pairs."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.options import Options
from gearlink.cli.typer_options import takes

if TYPE_CHECKING:
    from gearlink.core.parts.gears.shifts.search import Carried, PairTask


Torque = Annotated[
    float | None, typer.Option("--torque", min=1e-6, max=1e9, help="torque of gear 1, N m, for the rating")
]
Speed = Annotated[float | None, typer.Option("--speed", min=1e-3, max=1e6, help="speed of gear 1, 1/min")]
Life = Annotated[float, typer.Option("--life", min=1e-3, max=1e9, help="required life under the torque, h")]
Material = Annotated[str, typer.Option("--material", metavar="A,B", help="steel of both gears, or of each gear")]
Application = Annotated[float, typer.Option("--application", min=0.1, max=10.0, help="application factor K_A")]
Grade = Annotated[int, typer.Option("--grade", min=1, max=11, help="accuracy grade of ISO 1328-1")]
Oil = Annotated[float, typer.Option("--vg", min=1.0, max=1e4, help="viscosity of the oil at 40 deg C, mm^2/s")]
Crowned = Annotated[bool, typer.Option("--crowned", help="the helix is crowned")]
_BEST = 10
"""Pairs that are shown first."""
WidthRatio = Annotated[float, typer.Option("--width-ratio", min=0.05, max=3.0, help="maximum face width over d1")]


@takes("format", "all", "digits", "color", "quiet", all="show every pair, not only the best ten")
def gears(
    options: Options,
    ratio: Annotated[
        float, typer.Option("--ratio", metavar="I", min=1e-3, max=1e3, help="number of teeth of gear 2 over gear 1")
    ],
    center_distance: Annotated[
        float | None,
        typer.Option(
            "--center-distance",
            metavar="A",
            min=1e-3,
            max=1e6,
            help="centre distance, mm; default with --torque: the minimum is found",
        ),
    ] = None,
    modules: Annotated[
        str, typer.Option("--modules", metavar="M,M", help="normal modules, mm; default: ISO 54 series I from 1 to 20")
    ] = "",
    shift_sum: Annotated[
        str, typer.Option("--shift-sum", metavar="MIN:MAX", help="x1 + x2, ISO signs; default: -0.5:1, rings -1:0.5")
    ] = "",
    ratio_tolerance: Annotated[
        float, typer.Option("--ratio-tolerance", min=0.0, max=1.0, help="maximum relative error of the ratio")
    ] = 0.02,
    helix: Annotated[float, typer.Option("--helix", min=0.0, max=45.0, help="helix angle, deg")] = 0.0,
    internal: Annotated[bool, typer.Option("--internal", help="gear 2 is a ring")] = False,
    least_teeth: Annotated[
        int, typer.Option("--least-teeth", min=3, max=1000, help="minimum number of teeth of gear 1")
    ] = 17,
    torque: Torque = None,
    speed: Speed = None,
    life: Life = 20000.0,
    material: Material = "16MnCr5",
    application: Application = 1.0,
    grade: Grade = 6,
    vg: Oil = 220.0,
    crowned: Crowned = False,
    width_ratio: WidthRatio = 1.0,
) -> None:
    """Find whole teeth and modules for a ratio at a centre distance, the best first.

    x1 is shared for equal sliding; margin is the distance of x1 from undercut, a thin tip, a root fillet or a small
    contact ratio, negative beyond one. Of more than 1000 pairs the nearest to the ratio are shown.
    With --torque and --speed each pair is rated by ISO 6336: the minimum face width that carries the load for the life
    with S_H 1 and S_F 1.4, the narrowest first. Widths are whole mm from a quarter of the maximum (--width-ratio) on,
    and from 4 mm on. Exit status 1: no pair meets the conditions.

    Examples: gearlink gears --ratio 3.2 --center-distance 120

    gearlink gears --ratio 3 --torque 200 --speed 480 --life 20000 --material 16MnCr5
    """
    from gearlink.core.parts.gears.shifts.search import MODULES, PairTask

    carried = None
    if torque is not None or speed is not None:
        if torque is None or speed is None:
            missing = "--speed" if torque else "--torque"
            raise typer.BadParameter("a load needs both torque and speed", param_hint=missing)
        load: dict[str, Any] = {"torque": torque, "speed": speed, "life": life, "application": application}
        gearing = {"grade": grade, "viscosity": vg, "crowned": crowned, "width_ratio": width_ratio}
        carried = _carried(material, **load, **gearing)
    if center_distance is None and carried is None:
        raise typer.BadParameter("give it, or --torque and --speed to find the minimum", param_hint="--center-distance")

    task = PairTask(
        ratio=ratio,
        distance=0.0 if center_distance is None else center_distance,
        modules=_numbers(modules, ",", "--modules") or MODULES,
        shift_sum=_window(shift_sum, internal),
        tolerance=ratio_tolerance,
        helix_angle=math.radians(helix),
        internal=internal,
        least_teeth=least_teeth,
    )
    if internal and ratio <= 1.0:
        words = "a ring gear has more teeth than its pinion\ngive a ratio above 1"
        raise typer.BadParameter(words, param_hint="--ratio")
    raise typer.Exit(run_gears(task, options, carried, sought=center_distance is None))


def _carried(material: str, **conditions: Any) -> Carried:
    """What the pairs carry; a material by its name, or one for each gear."""
    from gearlink.core.parts.gears.rating.materials import CLASSES, MATERIALS, STEELS
    from gearlink.core.parts.gears.shifts.search import Carried

    names = [name.strip() for name in material.split(",")]
    for name in names:
        if name not in MATERIALS:
            from difflib import get_close_matches

            near = get_close_matches(name, MATERIALS, 1, 0.6)
            text = f"did you mean {near[0]}?" if near else f"known are {', '.join(STEELS)}"
            raise typer.BadParameter(f"no material is called {name}\n{text}", param_hint="--material")
        if name in CLASSES and CLASSES[name].needs_hardness:
            text = f"the strength of {name} depends on its hardness\ngive a steel: {', '.join(STEELS)}"
            raise typer.BadParameter(text, param_hint="--material")
    if len(names) > 2:
        words = f"{len(names)} materials for 2 gears\ngive one steel, or one for each gear"
        raise typer.BadParameter(words, param_hint="--material")
    return Carried(materials=(names[0], names[-1]), **conditions)


def run_gears(task: PairTask, options: Options, carried: Carried | None = None, *, sought: bool = False) -> int:
    """Print the candidates and give the exit status."""
    import sys

    from gearlink.cli.commands.design import print_report
    from gearlink.cli.progress import patience
    from gearlink.core.base.report import Report
    from gearlink.core.base.wording import amount
    from gearlink.core.parts.gears.shifts.search import candidates, carrying, rated_table, smallest, table_of

    with patience("searching for gears", quiet=options.quiet):
        if carried is None:
            table = table_of(candidates(task))
        else:  # the pairs that carry the load, at the given centre distance or the smallest one
            table = rated_table(smallest(task, carried)[1] if sought else carrying(task, carried))
    shown = replace(table, data=tuple(each[:_BEST] for each in table.data)) if options.brief else table
    print_report(Report(kind="gear-search", name="gears", command="gears", tables=(shown,)), options)
    if table.length > shown.length:
        print(f"{amount(table.length - shown.length, 'more pair')}: --all")
    if table.length:
        if not options.quiet and table["margin"][0] < 0.0:  # those within come first
            print("no pair is within all limits (margin < 0): widen --shift-sum", file=sys.stderr)
        return ExitCode.OK
    if not options.quiet:
        remedy = "increase --center-distance or --width-ratio, or name a better --material"
        remedy = _remedy(task) if carried is None else remedy
        print(f"no pair meets these conditions: {remedy}", file=sys.stderr)
    return ExitCode.FINDING


def _remedy(task: PairTask) -> str:
    """What may bring pairs; a large ratio is beyond all of them."""
    from gearlink.core.parts.gears.shifts.search import MOST_TEETH

    fewest = task.least_teeth * abs(task.ratio + (-1.0 if task.internal else 1.0))
    if fewest > MOST_TEETH * (1.0 + task.tolerance):
        return (
            f"gear 1 of {task.least_teeth} teeth and more takes a sum of {fewest:.0f}, but pairs are searched only up "
            f"to {MOST_TEETH}: reduce --least-teeth or --ratio"
        )
    return "widen --shift-sum or --ratio-tolerance, or name other --modules"


def _window(text: str, internal: bool) -> tuple[float, float]:
    if not text:
        return (-1.0, 0.5) if internal else (-0.5, 1.0)
    numbers = _numbers(text, ":", "--shift-sum")
    if len(numbers) != 2 or numbers[0] > numbers[1]:
        words = f"{text!r} is not MIN:MAX with MIN below MAX, such as -0.5:1"
        raise typer.BadParameter(words, param_hint="--shift-sum")
    return numbers[0], numbers[1]


def _numbers(text: str, sign: str, option: str) -> tuple[float, ...]:
    try:
        numbers = tuple(float(part) for part in text.split(sign) if part.strip())
    except ValueError:
        fix = f"write numbers with {sign} between them, such as 2{sign}3"
        words = f"{text!r} contains something other than numbers\n{fix}"
        raise typer.BadParameter(words, param_hint=option) from None
    least, most = (1e-3, 1e3) if option == "--modules" else (-10.0, 10.0)
    if not all(least <= number <= most for number in numbers):
        words = f"{text!r} contains a number that is not from {least:g} to {most:g}"
        raise typer.BadParameter(words, param_hint=option)
    return numbers
