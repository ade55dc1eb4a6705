"""`gearlink gears`: the integer search of gear pairs."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated

import typer

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.options import Options
from gearlink.cli.typer_options import takes

if TYPE_CHECKING:
    from gearlink.core.parts.gears.shifts.search import PairTask


@takes("format", "color", "quiet")
def gears(
    options: Options,
    ratio: Annotated[float, typer.Option("--ratio", metavar="I", min=1e-3, max=1e3, help="teeth 2 over teeth 1")],
    center_distance: Annotated[
        float, typer.Option("--center-distance", metavar="A", min=1e-3, max=1e6, help="centre distance, mm")
    ],
    modules: Annotated[
        str, typer.Option("--modules", metavar="M,M", help="normal modules, mm; default: ISO 54 series I from 1 to 20")
    ] = "",
    shift_sum: Annotated[
        str, typer.Option("--shift-sum", metavar="MIN:MAX", help="x1 + x2, ISO signs; default: -0.5:1, rings -0.5:0.5")
    ] = "",
    ratio_tolerance: Annotated[
        float, typer.Option("--ratio-tolerance", min=0.0, max=1.0, help="greatest relative error of the ratio")
    ] = 0.02,
    helix: Annotated[float, typer.Option("--helix", min=0.0, max=45.0, help="helix angle, deg")] = 0.0,
    internal: Annotated[bool, typer.Option("--internal", help="gear 2 is a ring")] = False,
    least_teeth: Annotated[int, typer.Option("--least-teeth", min=3, max=1000, help="of gear 1")] = 17,
) -> None:
    """Find whole teeth and modules for a ratio at a centre distance, the best first.

    x1 is shared for equal sliding; margin is how far it may move until undercut, a thin tip, a root fillet or a small
    contact ratio is met, negative where one is met already. Of more than 1000 pairs the nearest to the ratio are shown.
    Exit status 1: no pair meets the conditions.

    Example: gearlink gears --ratio 3.2 --center-distance 120
    """
    from gearlink.core.parts.gears.shifts.search import MODULES, PairTask

    task = PairTask(
        ratio=ratio,
        distance=center_distance,
        modules=_numbers(modules, ",", "--modules") or MODULES,
        shift_sum=_window(shift_sum, internal),
        tolerance=ratio_tolerance,
        helix_angle=math.radians(helix),
        internal=internal,
        least_teeth=least_teeth,
    )
    if internal and ratio <= 1.0:
        raise typer.BadParameter("a ring has more teeth than its pinion: give a ratio above 1", param_hint="--ratio")
    raise typer.Exit(run_gears(task, options))


def run_gears(task: PairTask, options: Options) -> int:
    """Print the candidates and give the exit status."""
    import sys

    from gearlink.cli.commands.design import print_report
    from gearlink.cli.patience import patience
    from gearlink.core.base.report import Report
    from gearlink.core.parts.gears.shifts.search import candidates, table_of

    with patience("searching for gears", quiet=options.quiet):
        found = candidates(task)
    print_report(Report(kind="gear-search", name="gears", command="gears", tables=(table_of(found),)), options)
    if found:
        return ExitCode.OK
    if not options.quiet:
        print(f"no pair meets these conditions: {_remedy(task)}", file=sys.stderr)
    return ExitCode.FINDING


def _remedy(task: PairTask) -> str:
    """What may bring pairs; a large ratio is beyond all of them."""
    from gearlink.core.parts.gears.shifts.search import MOST_TEETH

    fewest = task.least_teeth * abs(task.ratio + (-1.0 if task.internal else 1.0))
    if fewest > MOST_TEETH * (1.0 + task.tolerance):
        return (
            f"gear 1 of {task.least_teeth} teeth and more takes a sum of {fewest:.0f}, and pairs are sought up to "
            f"{MOST_TEETH}: lower --least-teeth or --ratio"
        )
    return "widen --shift-sum or --ratio-tolerance, or name other --modules"


def _window(text: str, internal: bool) -> tuple[float, float]:
    if not text:
        return (-0.5, 0.5) if internal else (-0.5, 1.0)
    numbers = _numbers(text, ":", "--shift-sum")
    if len(numbers) != 2 or numbers[0] > numbers[1]:
        raise typer.BadParameter(
            f"{text!r} is not MIN:MAX with MIN below MAX, such as -0.5:1", param_hint="--shift-sum"
        )
    return numbers[0], numbers[1]


def _numbers(text: str, sign: str, option: str) -> tuple[float, ...]:
    try:
        numbers = tuple(float(part) for part in text.split(sign) if part.strip())
    except ValueError:
        raise typer.BadParameter(f"{text!r} holds something that is no number", param_hint=option) from None
    least, most = (1e-3, 1e3) if option == "--modules" else (-10.0, 10.0)
    if not all(least <= number <= most for number in numbers):
        words = f"{text!r} holds a number that is not from {least:g} to {most:g}"
        raise typer.BadParameter(words, param_hint=option)
    return numbers
