"""The parts of a design that have a profile: which there are, and the curves of each, made when one is asked for."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import MissingSection, at_key
from gearlink.core.base.kind import load
from gearlink.core.base.kinds import KINDS
from gearlink.core.parts.gears.tooth.teeth import rim_radius

if TYPE_CHECKING:
    from gearlink.cli.export.contour import Part

Makers = dict[str, Callable[[], "Part"]]


def makers(design: Any) -> Makers:
    """Makers of every part that the design has, by the name that --part takes.

    Raises
        MissingSection - where the design file lacks the sections that a profile needs
    """
    made: Makers = load(KINDS[design.kind].profiles)(design)
    return made


def kinds() -> tuple[str, ...]:
    """The kinds of design that have profiles."""
    return tuple(kind.name for kind in KINDS.values() if kind.profiles)


def _lacking(what: str) -> Makers:
    raise MissingSection(f"no profile to export: {what}", key="")


def press(design: Any) -> Makers:
    """Both cams and the gears of the input, as far as the file has their sections."""
    found: Makers = {}
    if design.spec.cam is not None:
        from gearlink.cli.export.cam_parts import disc_cam

        found["main_cam"] = lambda: disc_cam("main_cam", design.main_cam)
        found["return_cam"] = lambda: disc_cam("return_cam", design.return_cam)
    if design.spec.input_gears is not None:
        found |= gear_pair(design, "input_gears")
    return found or _lacking("the file has neither a section cam nor a section input_gears")


def gripper(design: Any) -> Makers:
    """The cams."""
    if design.spec.cam is None:
        return _lacking("the file has no section cam: center, sense, roller")
    from gearlink.cli.export.cam_parts import disc_cam

    found: Makers = {"main_cam": lambda: disc_cam("main_cam", design.main_cam)}
    if design.spec.cam.return_roller is not None:
        found["return_cam"] = lambda: disc_cam("return_cam", design.return_cam)
    return found


def follower_cam(design: Any) -> Makers:
    """The cam of a follower, or both walls of its groove; return cam and cutter path where the file has them."""
    from dataclasses import replace

    from gearlink.cli.export.cam_parts import disc_cam, flat_cam

    cams, cutter = design.cams, design.spec.cam.cutter_radius
    if design.spec.is_flat:
        return {"main_cam": lambda: flat_cam("main_cam", cams.flat)}
    found: Makers = {"main_cam": lambda: disc_cam("main_cam", cams.main)}
    if design.spec.closure == "groove":
        found = {
            "groove_inner": lambda: disc_cam("groove_inner", replace(cams.main, name="inner wall")),
            "groove_outer": lambda: disc_cam("groove_outer", cams.outer_wall),
        }
    if cams.back is not None:
        found["return_cam"] = lambda: disc_cam("return_cam", cams.back)
    if cutter is not None:
        path = replace(cams.main, name="cutter path", roller_radius=cams.main.roller_radius - cutter)
        found["cutter"] = lambda: disc_cam("cutter", path)
    return found


def wide_swing(design: Any) -> Makers:
    """The profiles of the stroke, and the contours of the closed cams of a cycle."""
    if design.spec.cam is None:
        return _lacking("the file has no section cam: center_distance, roller_radius")
    from gearlink.cli.export.cam_parts import closed_cam, swing_cam

    # A cam on the rocker of a crank-rocker serves both strokes, and that of a slider, turning back, the return.
    names = ("main_cam", "return_cam") if design.spec.drive is None and design.spec.slider is None else ("main_cam",)
    found: Makers = {name: partial(swing_cam, name, design) for name in names}
    if design.spec.cycle is not None:
        found |= {name: partial(closed_cam, name, design) for name in ("contour", "return_contour")}
    return found


def gear_pair(design: Any, key: str = "") -> Makers:
    """Both gears, or gear 1 and the rack."""
    data = design.gear_data if design.kind == "flatbed-press" else design.data
    widths, rim = data.face_width, data.rims[1]
    if rim is not None:
        rim += abs(data.pair.root_radius[1])
    titles = ("gear 1", "gear 2")
    hands = pair_hands(design)
    found = of_mesh(design.gear_pair, ("gear1", "gear2"), titles, key, widths_of=lambda: widths, rim=rim, hands=hands)
    return {"gear1": found["gear1"], "rack": lambda: _rack(design)} if getattr(design.spec, "rack", False) else found


def _rack(design: Any) -> Part:
    from gearlink.cli.export.gear_parts import rack_of

    width = design.data.face_width[1] if design.data.face_width else None
    hand = pair_hands(design)[1]
    return rack_of(design.rack, design.rack_teeth, design.rack_back, "rack", "rack", width, hand)


def pair_hands(design: Any) -> tuple[str, str]:
    """Hands of helix of a gear pair, as given or with gear 1 right-hand."""
    given = getattr(design.spec, "helix_hand", None)
    if given is not None:
        return given[0], given[1]
    return "right", "right" if design.gear_pair.internal else "left"


def train_hands(design: Any, label: str = "") -> tuple[str, str]:
    """Hands of helix of the gears of a mesh inside a machine, a ring second."""
    hands = design.spec.gears.hands()
    one, other = design.teeth_train.places[design.mesh_names.index(label)].gears
    return hands[one], hands[other]


def three_gears(design: Any) -> Makers:
    """Gears 1, 3 and 5; of a mesh with a ring the idler is the pinion."""
    titles = {"gear1": "gear 1, on the crank", "gear3": "gear 3, the idler", "gear5": "gear 5, the output"}

    def of(label: str, one: str, other: str) -> Makers:
        words = (titles[one], titles[other])
        widths, hands, rim = partial(design.widths_of, label), train_hands(design, label), design.outer_rim(label)
        return of_mesh(design.meshes[label], (one, other), words, "gears", widths_of=widths, rim=rim, hands=hands)

    first = of("crank_idler", *(("gear3", "gear1") if design.crank_teeth < 0 else ("gear1", "gear3")))
    second = of("idler_output", "gear3", "gear5")
    idler = second if design.crank_teeth < 0 else first
    return {"gear1": first["gear1"], "gear3": idler["gear3"], "gear5": second["gear5"]}


def two_gears(design: Any) -> Makers:
    """The coupler's gear and the output."""
    titles, hands = ("gear 2, on the coupler", "gear 5, the output"), train_hands(design)
    rim = design.outer_rim()
    return of_mesh(design.mesh, ("gear2", "gear5"), titles, "gears", widths_of=design.widths_of, rim=rim, hands=hands)


def hypocycloid(design: Any) -> Makers:
    """Planet and ring."""
    titles, hands = ("planet", "ring gear, fixed"), train_hands(design)
    rim = design.outer_rim()
    return of_mesh(design.mesh, ("planet", "ring"), titles, "gears", widths_of=design.widths_of, rim=rim, hands=hands)


def mutilated(design: Any) -> Makers:
    """The wheel as it is drawn, without its locking arcs, which are no result of the design; the driven gear."""
    hands = train_hands(design)
    titles = ("", "gear 2, driven")
    made = of_mesh(design.mesh, ("", "gear2"), titles, "gears", widths_of=design.widths_of, hands=hands)

    def wheel() -> Part:
        from gearlink.cli.export.wheel_parts import wheel_of

        with at_key("gears"):
            widths = design.widths_of()
            return wheel_of(design, widths[0] if widths else None, hands[0])

    return {"wheel": wheel, "gear2": made["gear2"]}


def five_bar(design: Any) -> Makers:
    """Both gears of every mesh."""
    found: Makers = {}
    for label, mesh in design.meshes.items():
        names = label.split("_") if label else _five_bar_gears(design, mesh)
        parts = (f"{names[0]}_gear", f"{names[1]}_gear")
        titles = (f"{names[0]} gear", f"{names[1]} gear")
        widths, hands, rim = partial(design.widths_of, label), train_hands(design, label), design.outer_rim(label)
        found |= of_mesh(mesh, parts, titles, "gears", widths_of=widths, rim=rim, hands=hands)
    return found


def _five_bar_gears(design: Any, mesh: Any) -> list[str]:
    """Names of the two gears of a five-bar with a single mesh, the ring last."""
    if not design.is_path:
        return ["planet", "ring" if mesh.internal else "sun"]
    gears = design.spec.gears
    return ["output", "input"] if mesh.internal and gears.input > gears.output else ["input", "output"]


def six_bar(design: Any) -> Makers:
    """The gears of both trains by train and pin; one between two others from the mesh before it."""
    found: Makers = {}
    for i, (train, meshes) in enumerate(zip(design.spec.trains, design.train_meshes, strict=True)):
        for k, mesh in enumerate(meshes):
            pins, teeth = train.pins[k : k + 2], train.gears[k : k + 2]
            ordered = sorted(zip(teeth, pins, strict=True), key=lambda pair: pair[0] < 0) if min(teeth) < 0 else None
            first, second = (pin for _, pin in ordered) if ordered else pins
            names = (f"gear{i + 1}{first}", f"gear{i + 1}{second}")
            titles = (f"train {i + 1}, gear on {first}", f"train {i + 1}, gear on {second}")
            found = of_mesh(mesh, names, titles, f"trains[{i}]", train) | found
    return dict(sorted(found.items()))


def of_mesh(
    mesh: Any,
    names: tuple[str, str],
    titles: tuple[str, str],
    key: str,
    gears: Any = None,
    widths_of: Callable[[], tuple[float, float] | None] = lambda: None,
    rim: float | None = None,
    hands: tuple[str, str] = ("right", "left"),
) -> Makers:
    """Both gears of a mesh; `gears` is the section of the file that may name the rim of a ring, or `rim` is it."""

    def gear(number: int) -> Part:
        from gearlink.cli.export import gear_parts

        with at_key(key):
            widths = widths_of()
            width = widths[number] if widths else None
            if number == 1 and mesh.internal:
                outer = rim_radius(mesh.root_radius[1], mesh.module, getattr(gears, "rim", rim))
                return gear_parts.ring_of(mesh, outer, names[1], titles[1], width, hands[1])
            return gear_parts.gear_of(mesh, number, names[number], titles[number], width, hands[number])

    return {name: partial(gear, number) for number, name in enumerate(names)}
