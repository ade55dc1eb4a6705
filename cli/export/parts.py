"""The parts of a design that have a profile: which there are, and the curves of each, made when one is asked for."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.export import sizes
from gearlink.cli.export.contour import JOIN, Circle, Part
from gearlink.cli.export.options import PATH
from gearlink.cli.export.sampling import Stretch
from gearlink.core.base.errors import MissingSection, NoSolution, at_key
from gearlink.core.base.kind import load
from gearlink.core.base.kinds import KINDS
from gearlink.core.base.wording import amount
from gearlink.core.machines.dwell_gears.wheel import end_tooth_radius
from gearlink.core.mechanism.vectors import place_of, rates_of
from gearlink.core.numerics.arrays import Points, Reals, unit_vector
from gearlink.core.numerics.curves import Curve, arc, straight
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.cams.checks import undercut_checks
from gearlink.core.parts.cams.disc_cam import DiscCam
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.drawing import drawing_table, lines_of, rack_drawing
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.outline.rack_profile import RackProfile
from gearlink.core.parts.gears.outline.ring_profile import RingProfile
from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile
from gearlink.core.parts.gears.rack import RackMesh
from gearlink.core.parts.gears.tooth.teeth import rim_radius

if TYPE_CHECKING:
    from gearlink.core.machines.dwell_gears.locking import Lock
    from gearlink.core.machines.dwell_gears.mutilated_design import MutilatedGearDwell
    from gearlink.core.machines.wide_swing.strokes import AnyCam
    from gearlink.core.parts.cams.flat_cam import FlatCam


Makers = dict[str, Callable[[], "Part"]]
_Piece = tuple[str, Curve, float, float]
"""Name and curve of a stretch, and the range of its parameter."""


def makers(design: Any, asked: tuple[str, ...] = ()) -> Makers:
    """Makers of every part that the design has, by the name that --part takes, and of paths that are asked for.

    Raises
        MissingSection - where the design file lacks the sections that a profile needs
    """
    paths = [name for name in asked if name.startswith(PATH)] if KINDS[design.kind].motion else []
    made: Makers = {}
    if not paths or len(paths) < len(asked):
        made = load(KINDS[design.kind].profiles)(design)
    return {**{name: partial(_path, design, name.removeprefix(PATH)) for name in paths}, **made}


def kinds() -> tuple[str, ...]:
    """The kinds of design that have profiles."""
    return tuple(kind.name for kind in KINDS.values() if kind.profiles)


def _lacking(what: str) -> Makers:
    raise MissingSection(f"no profile to export: {what}", key="")


def press(design: Any) -> Makers:
    """Both cams and the gears of the input, as far as the file has their sections."""
    found = {} if design.spec.cam is None else _both_cams(design)
    if design.spec.input_gears is not None:
        found |= gear_pair(design, "input_gears")
    if design.spec.cylinder.gears is not None:
        data, titles = design.teeth.cylinder, ("gear 3, on MN", "gear 4, on the cylinder")
        found |= of_mesh(data.pair, ("gear3", "gear4"), titles, "cylinder.gears", data_of=lambda: data)
    if design.spec.bed.pinion is not None:
        mesh, (lower, upper) = design.teeth.pinion, design.teeth.rack_teeth
        found |= on_rack(mesh, ("pinion", "lower_rack"), ("pinion", "lower rack"), "bed.pinion", lower)
        above = on_rack(mesh, ("pinion", "upper_rack"), ("", "upper rack"), "bed.pinion", upper)
        found["upper_rack"] = above["upper_rack"]
    return found or _lacking("the file has no section cam and no gears: input_gears, cylinder.gears, bed.pinion")


def _both_cams(design: Any) -> Makers:
    """Main and return cam on their shaft."""

    def made(name: str) -> Part:
        return _on_shaft(disc_cam(name, getattr(design, name)), design.spec.cam.shaft_radius)

    return {name: partial(made, name) for name in ("main_cam", "return_cam")}


def gripper(design: Any) -> Makers:
    """The cams, and that of the fingers."""
    found = {} if design.spec.cam is None else _both_cams(design)
    if found and design.spec.cam.return_roller is None:
        del found["return_cam"]
    if design.spec.fingers is not None:
        found["finger_cam"] = lambda: disc_cam("finger_cam", design.fingers.cam)
    return found or _lacking("the file has no section cam: center, sense, roller")


def follower_cam(design: Any) -> Makers:
    """The cam of a follower, or both walls of its groove; return cam and cutter path where the file has them."""
    cams, cutter, shaft = design.cams, design.spec.cam.cutter_radius, design.spec.cam.shaft_radius
    if design.spec.is_flat:
        flat: Makers = {"main_cam": lambda: _on_shaft(flat_cam("main_cam", cams.flat), shaft)}
        if cutter is not None:
            words = f"path of a cutter of radius {cutter:.9g} mm"
            flat["cutter"] = lambda: replace(flat_cam("cutter", cams.flat.outside(cutter), words), body=False)
        return flat
    found: Makers = {"main_cam": lambda: _on_shaft(disc_cam("main_cam", cams.main), shaft)}
    if design.spec.closure == "groove":
        found = {
            "groove_inner": lambda: _on_shaft(disc_cam("groove_inner", replace(cams.main, name="inner wall")), shaft),
            "groove_outer": lambda: disc_cam("groove_outer", cams.outer_wall),
        }
    if cams.back is not None:
        found["return_cam"] = lambda: _on_shaft(disc_cam("return_cam", cams.back), shaft)
    if cutter is not None:
        path = replace(cams.main, name="cutter path", roller_radius=cams.main.roller_radius - cutter)
        words = f"path of a cutter of radius {cutter:.9g} mm; {_touching(cams.main)}"
        found["cutter"] = lambda: replace(disc_cam("cutter", path, words), body=False)
    return found


def _on_shaft(part: Part, radius: float) -> Part:
    """The part with its shaft, where the file names one."""
    return replace(part, circles=(*part.circles, Circle("SHAFT", radius))) if radius > 0.0 else part


def cycloidal(design: Any) -> Makers:
    """The disc with its holes, and the ring with its pins."""
    return {"disc": partial(cycloidal_disc, design), "ring": partial(cycloidal_ring, design)}


def geneva(design: Any) -> Makers:
    """The slotted wheel, and the crank's locking disc where the file has one."""
    found: Makers = {"wheel": lambda: geneva_wheel(design)}
    if design.spec.locking_radius is not None:
        found["driver"] = lambda: geneva_driver(design)
    return found


def grooved(design: Any) -> Makers:
    """Both walls of a groove in the frame, each with the path of the roller's centre."""
    return {name: partial(_wall, design, name, place) for place, name in enumerate(("groove_inner", "groove_outer"))}


def _wall(design: Any, name: str, place: int) -> Part:
    groove = design.groove
    joints = [joint for joint in groove.joints if 0.0 < joint < _TURN]

    def points(theta: Reals) -> Points:
        return np.stack([groove.walls(theta)[place], groove.path(theta).place])

    def extra(theta: Reals) -> Reals:
        return np.stack([np.degrees(theta), np.degrees(groove.pressure_angle(theta)), groove.curvature(theta)])

    found = list(design.check("cam-undercut"))[place]
    return Part(
        name=name,
        title=f"{name.removeprefix('groove_')} wall of the groove",
        stretches=tuple(Stretch(CAM_LAYERS, points, *span, extra=extra) for span in pairwise([0.0, *joints, _TURN])),
        closed=True,
        notes=(f"roller radius {groove.roller_radius:.9g} mm", "frame: axis of the input at the origin"),
        findings=(found.message,) if found.status == "fail" else (),
        extra_columns=("input_angle [deg]", "pressure_angle [deg]", "curvature [1/mm]"),
        dimensions=sizes.centre_line(groove),
    )


def track(design: Any) -> Makers:
    """Both walls of a drum's track, developed at the outside and at the bottom, each with the pitch line."""
    drum, walls = design.drum, (("upper", 1), ("lower", -1))
    radii = (("outside", drum.outside), ("bottom", drum.bottom))
    return {
        f"{place}_{wall}": partial(_developed, design, f"{place}_{wall}", radius, side)
        for place, radius in radii
        for wall, side in walls
    }


_LOOKS_OF_TRACK = 1441


def _developed(design: Any, name: str, radius: float, side: int) -> Part:
    drum = design.drum
    joints = [joint for joint in design.follower_motion.joints if 0.0 < joint < _TURN]

    def points(phi: Reals, which: int, low: float, high: float) -> Points:
        within = np.clip(phi, low and math.nextafter(low, _TURN), math.nextafter(high, 0.0))  # one side of a joint
        arc, along = drum.developed(radius, which, within)
        return np.asarray(arc + 1j * along)

    def stretch(low: float, high: float) -> Stretch:
        def both(phi: Reals) -> Points:
            return np.stack([points(phi, each, low, high) for each in (side, 0)])

        def extra(phi: Reals) -> Reals:
            angle = np.degrees(drum.pressure_angle(radius, phi))
            return np.stack([np.degrees(phi), angle, drum.curvature(radius, phi)])

        return Stretch(CAM_LAYERS, both, low, high, extra=extra)

    found = design.check_cam_undercut()
    off = float(drum.off_development(radius, np.linspace(0.0, _TURN, _LOOKS_OF_TRACK)).max())
    beside = f"about {off:.2g} mm" if math.isfinite(off) else "more than a roller radius"
    return Part(
        name=name,
        title=f"{name.partition('_')[2]} wall of the track, developed at the {name.partition('_')[0]}",
        stretches=tuple(stretch(low, high) for low, high in pairwise([0.0, *joints, _TURN])),
        closed=False,
        notes=(
            f"developed at radius {radius:.9g} mm; roller radius {drum.roller_radius:.9g} mm",
            f"plane development: on the cylinder a wall lies up to {beside} from its line; the table walls is exact",
            "frame: x along the circumference from cam angle 0 on, y along the axis, lift 0 at y 0; seen from "
            f"{'inside' if drum.sense > 0 else 'outside'} the drum",
        ),
        findings=(found.message,) if found.status == "fail" else (),
        extra_columns=("cam_angle [deg]", "pressure_angle [deg]", "curvature [1/mm]"),
    )


def linked_cams(design: Any) -> Makers:
    """Both cams."""
    return {f"{axis}_cam": partial(disc_cam, f"{axis}_cam", cam) for axis, cam in zip("xy", design.cams, strict=True)}


def wide_swing(design: Any) -> Makers:
    """The profiles of the stroke, and the contours of the closed cams of a cycle."""
    if design.spec.cam is None:
        return _lacking("the file has no section cam: center_distance, roller_radius")

    # A cam on the rocker of a crank-rocker serves both strokes, and that of a slider, turning back, the return.
    names = ("main_cam", "return_cam") if design.spec.drive is None and design.spec.slider is None else ("main_cam",)
    found: Makers = {name: partial(swing_cam, name, design) for name in names}
    if design.spec.cycle is not None:
        found |= {name: partial(closed_cam, name, design) for name in ("contour", "return_contour")}
    return found


def gear_pair(design: Any, key: str = "") -> Makers:
    """Both gears, or gear 1 and the rack."""
    data = design.gear_data if design.kind == "flatbed-press" else design.data
    rim = data.rims[1]
    if rim is not None:
        rim += abs(data.pair.root_radius[1])
    titles = ("gear 1", "gear 2")
    hands = pair_hands(design)
    found = of_mesh(design.gear_pair, ("gear1", "gear2"), titles, key, data_of=lambda: data, rim=rim, hands=hands)
    if not getattr(design.spec, "rack", False):
        return found
    lines = partial(_rack_lines, design.rack, 0, hands)
    return {"gear1": lambda: replace(found["gear1"](), lines=lines), "rack": lambda: _rack(design)}


def _rack(design: Any) -> Part:
    width, hands = design.data.face_width[1] if design.data.face_width else None, pair_hands(design)
    made = rack_of(design.rack, design.rack_teeth, design.rack_back, "rack", "rack", width, hands[1])
    return replace(made, lines=partial(_rack_lines, design.rack, 1, hands))


def _rack_lines(rack: RackMesh, number: int, hands: tuple[str, str]) -> list[Any]:
    return lines_of(rack_drawing(rack, _told(rack.pair, hands)), number)


def slider_racks(design: Any) -> Makers:
    """Pinion and racks at the rod end, of both meshes; the pinion once where its teeth are the same."""
    if design.rack_drive is None:
        return _lacking("the file has no section racks: module, fixed, moving")
    given, drive = design.spec.racks, design.rack_drive
    lengths = {"fixed_rack": drive.fixed_rack_length, "moving_rack": drive.moving_rack_length}
    found: Makers = {}
    for name, mesh in drive.meshes.items():
        teeth = math.ceil(lengths[name] / mesh.pitch_on_line)
        pinion = "pinion" if given.fixed == given.moving else f"{name.removesuffix('_rack')}_pinion"
        found |= on_rack(mesh, (pinion, name), ("pinion", name.replace("_", " ")), "racks", teeth)
    return found


def on_rack(mesh: Any, names: tuple[str, str], titles: tuple[str, str], key: str, teeth: int) -> Makers:
    """A pinion and its rack of so many teeth."""
    data = mesh.data
    widths = data.face_width or (None, None)
    back = data.rims[1] if data.rims[1] is not None else 2.0 * mesh.pair.module

    def pinion() -> Part:
        with at_key(key):
            made = gear_of(mesh.pair, 0, names[0], titles[0], widths[0], "right")
        return replace(made, lines=partial(_rack_lines, mesh, 0, ("right", "left")))

    def rack() -> Part:
        with at_key(key):
            made = rack_of(mesh, teeth, back, names[1], titles[1], widths[1], "left")
        return replace(made, lines=partial(_rack_lines, mesh, 1, ("right", "left")))

    return {names[0]: pinion, names[1]: rack}


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
        return in_machine(design, label, (one, other), (titles[one], titles[other]))

    first = of("crank_idler", *(("gear3", "gear1") if design.crank_teeth < 0 else ("gear1", "gear3")))
    second = of("idler_output", "gear3", "gear5")
    one, other = (second, first) if design.crank_teeth < 0 else (first, second)

    def idler() -> Part:
        made, more = one["gear3"](), other["gear3"]().lines
        assert made.lines is not None
        assert more is not None
        lines, mate = made.lines, more
        return replace(made, lines=lambda: [*lines(), *(line for line in mate() if line[0] in _OF_MATE)])

    return {"gear1": first["gear1"], "gear3": idler, "gear5": second["gear5"]}


_OF_MATE = ("teeth of the mating gear", "centre distance", "centre distance allowance +-")
"""Lines of a gear's table that it has for each of its mates."""


def two_gears(design: Any) -> Makers:
    """The coupler's gear and the output."""
    return in_machine(design, "", ("gear2", "gear5"), ("gear 2, on the coupler", "gear 5, the output"))


def hypocycloid(design: Any) -> Makers:
    """Planet and ring."""
    return in_machine(design, "", ("planet", "ring"), ("planet", "ring gear, fixed"))


def mutilated(design: Any) -> Makers:
    """The wheel and the driven gear; the locking disc and plate where the file has them."""
    hands = train_hands(design)

    def data_of() -> GearData:
        found: GearData = design.mesh_data[""]
        return found

    made = of_mesh(design.mesh, ("", "gear2"), ("", "gear 2, driven"), "gears", data_of=data_of, hands=hands)

    def wheel() -> Part:
        with at_key("gears"):
            widths = design.widths_of()
            found = wheel_of(design, widths[0] if widths else None, hands[0])
        return replace(found, lines=partial(_lines, data_of, 0, _told(design.mesh, hands)))

    found: Makers = {"wheel": wheel, "gear2": made["gear2"]}
    if design.spec.locking is not None:
        found |= {"disc": lambda: locking_disc(design), "plate": lambda: locking_plate(design)}
    return found


def in_machine(design: Any, label: str, names: tuple[str, str], titles: tuple[str, str]) -> Makers:
    """Both gears of a mesh inside a machine."""
    more = {"rim": design.outer_rim(label), "hands": train_hands(design, label)}
    return of_mesh(design.meshes[label], names, titles, "gears", data_of=lambda: design.mesh_data[label], **more)


def _lines(data_of: Callable[[], GearData], number: int, hands: tuple[str, str] | None) -> list[Any]:
    return lines_of(drawing_table(data_of(), hands), number)


def _told(pair: Any, hands: tuple[str, str]) -> tuple[str, str] | None:
    """Hands of helix, of helical teeth."""
    return hands if pair.helix_angle else None


def five_bar(design: Any) -> Makers:
    """Both gears of every mesh."""
    found: Makers = {}
    for label, mesh in design.meshes.items():
        names = label.split("_") if label else _five_bar_gears(design, mesh)
        parts, titles = ((f"{names[0]}{end}", f"{names[1]}{end}") for end in ("_gear", " gear"))
        found |= in_machine(design, label, parts, titles)
    return found | ({f"{PATH}M": partial(_path, design, "M")} if design.is_path else {})


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
    data_of: Callable[[], GearData] | None = None,
    rim: float | None = None,
    hands: tuple[str, str] = ("right", "left"),
) -> Makers:
    """Both gears of a mesh; `gears` is the section of the file that may name the rim of a ring, or `rim` is it."""
    data = data_of or (lambda: GearData(pair=mesh))

    def gear(number: int) -> Part:
        with at_key(key):
            widths = data().face_width
            width = widths[number] if widths else None
            bore = _bore(data(), number)
            if number == 1 and mesh.internal:
                outer = rim_radius(mesh.root_radius[1], mesh.module, getattr(gears, "rim", rim) or bore)
                made = ring_of(mesh, outer, names[1], titles[1], width, hands[1])
            else:
                made = gear_of(mesh, number, names[number], titles[number], width, hands[number])
                made = made if bore is None else replace(made, circles=(*made.circles, Circle("BORE", bore)))
            return replace(made, lines=partial(_lines, data, number, _told(mesh, hands)))

    return {name: partial(gear, number) for number, name in enumerate(names)}


def _bore(data: GearData, number: int) -> float | None:
    """Radius of the bore that the rating names, of a ring that of its outside [mm]; None where it names none."""
    return None if data.conditions is None else 0.5 * data.conditions.bores[number] or None


SENSES = {"right": 1.0, "left": -1.0}
"""Which way teeth of a hand turn on their way up the axis."""


def gear_of(
    pair: GearPair, number: int, name: str, title: str, width: float | None = None, hand: str = "right"
) -> Part:
    """Gear 0 or 1 of a pair, its first tooth space on the x axis; helical ones of a hand.

    Raises
        NoSolution - where no involute is left between root and tip
    """
    profile = ToothProfile.of(pair, number)
    return Part(
        name=name,
        title=title,
        stretches=tuple(_stretch(*piece) for piece in _half(profile)),
        closed=True,
        teeth=pair.teeth[number],
        circles=(
            Circle("REFERENCE_CIRCLE", profile.reference_radius),
            Circle("WORKING_CIRCLE", pair.working_radius[number]),
            Circle("BASE_CIRCLE", profile.base_radius),
            Circle("TIP_CIRCLE", profile.outer_radius),
            Circle("ROOT_CIRCLE", profile.root_radius),
        ),
        notes=_notes(pair, number, profile, hand),
        width=width,
        twist=SENSES[hand] * math.tan(pair.helix_angle) / pair.reference_radius[number],
    )


def ring_of(mesh: GearPair, rim: float, name: str, title: str, width: float | None = None, hand: str = "right") -> Part:
    """The ring of a pair, the middle of a tooth space on the x axis, within its rim [mm]; helical ones of a hand.

    Raises
        NoSolution - where the ring's tips lie inside its base circle
    Notes
        Without its cutter the flanks are involutes down to the root circle: how a cutter rounds the root depends on it.
    """
    shape = RingProfile(mesh)
    return Part(
        name=name,
        title=title,
        stretches=tuple(_stretch(*piece) for piece in _lasting(shape.pieces(), shape.root)),
        closed=True,
        teeth=shape.teeth,
        circles=(
            Circle("REFERENCE_CIRCLE", abs(mesh.reference_radius[1])),
            Circle("BASE_CIRCLE", shape.base),
            Circle("TIP_CIRCLE", shape.tip),
            Circle("ROOT_CIRCLE", shape.deepest),
            Circle("RIM", rim),
        ),
        notes=_ring_notes(mesh, shape, rim),
        width=width,
        twist=SENSES[hand] * math.tan(mesh.helix_angle) / abs(mesh.reference_radius[1]),
        rim=rim,
    )


def _ring_notes(mesh: GearPair, shape: RingProfile, rim: float) -> tuple[str, ...]:
    section = "; transverse section" if mesh.helix_angle else ""
    root = "involute down to the root circle; the fillet depends on the cutter, which the file does not give"
    if shape.shaped is not None:
        cutter = shape.shaped.cutter
        root = (
            f"root shaped by a pinion cutter of {cutter.teeth} teeth with a tip rounding of {cutter.rounding:.6g} "
            f"module; involute to {shape.shaped.form_radius:.9g} mm"
        )
    return (
        f"module {mesh.module:g} mm, ring of {shape.teeth} teeth, "
        f"profile shift {mesh.profile_shift[1]:.9g} (ISO 21771 sign)",
        f"tip radius {shape.tip:.9g} mm, root radius {shape.deepest:.9g} mm, outer radius {rim:.9g} mm",
        root,
        "no backlash: reduce the tooth thickness by the allowance of the drawing",
        "frame: gear axis at the origin, middle of a tooth space on the x axis; the body lies outside the profile"
        + section,
    )


def rack_of(
    rack: RackMesh, teeth: int, back: float, name: str, title: str, width: float | None = None, hand: str = "left"
) -> Part:
    """A rack of so many teeth, from the middle of a space to the middle of a space; helical ones of a hand.

    Parameters
        back : float [mm] - thickness of the body below the root line
    Raises
        NoSolution - for a rack that no tool leaves, and for one of more teeth than a file should hold
    """
    if teeth > _MOST_RACK_TEETH:
        text = f"a file holds a rack of at most {_MOST_RACK_TEETH} teeth, not {teeth}"
        raise NoSolution(text, key="rack_teeth", fix="give rack_teeth")
    profile, pair = rack.profile, rack.pair
    named = ((name, *rest) for name, rest in zip(_RACK_NAMES, profile.pieces(), strict=True))
    half = list(_lasting(named, profile.pitch))
    places = [profile.pitch * (k - 0.5 * teeth) for k in range(teeth)]
    pieces = [part for at in places for part in _one_pitch(half, at, profile.pitch)]
    left, right, low = places[0], places[-1] + profile.pitch, profile.root - back
    corners = [complex(right, profile.root), complex(right, low), complex(left, low), complex(left, profile.root)]
    pieces += [_line("body", "PROFILE", *ends) for ends in pairwise(corners)]
    lines = (("datum line", "DATUM_LINE", 0.0), ("pitch line", "PITCH_LINE", pair.profile_shift[0] * pair.module))
    pieces += [_line(words, layer, complex(left, y), complex(right, y)) for words, layer, y in lines]
    return Part(
        name=name,
        title=title,
        stretches=tuple(pieces),
        closed=True,
        notes=_rack_notes(rack, profile, teeth, low, hand),
        width=width,
        slant=-SENSES[hand] * math.tan(pair.helix_angle),
    )


_MOST_RACK_TEETH = 1000
_RACK_NAMES = ("root line", "rounding", "flank", "tip line")


def _one_pitch(half: list[_Piece], at: float, pitch: float) -> Iterator[Stretch]:
    """The stretches of a tooth, from the middle of the space at `at` to the middle of the next one."""
    for piece, curve, low, high in half:
        yield _stretch(piece, lambda t, curve=curve: at + curve(t), low, high)  # type: ignore[misc]
    for piece, curve, low, high in reversed(half):
        yield _stretch(piece, lambda t, curve=curve: at + pitch - curve(-t).conj(), -high, -low)  # type: ignore[misc]


def _line(words: str, layer: str, start: complex, end: complex) -> Stretch:
    curve = straight(start, end)
    return Stretch((layer,), lambda share: curve(share)[None, :], 0.0, 1.0, words, steps=1)


def _rack_notes(rack: RackMesh, profile: RackProfile, teeth: int, low: float, hand: str) -> tuple[str, ...]:
    pair = rack.pair
    helix = _helix(pair, hand)
    section = "; transverse section" if pair.helix_angle else ""
    return (
        f"module {pair.module:g} mm, rack of {teeth} teeth, pressure angle {math.degrees(pair.pressure_angle):.9g} deg"
        f"{helix}, pitch {profile.pitch:.9g} mm",
        f"tip line {profile.tip:.9g} mm above the datum line, root line {-profile.root:.9g} mm below it, back "
        f"{-low:.9g} mm below it; tooth and space equal on the datum line",
        f"root left by a tool with a tip rounding of {profile.tool.rounding:.6g} module",
        f"axis of the gear {rack.center_distance:.9g} mm above the datum line",
        "no backlash: reduce the tooth thickness by the allowance of the drawing",
        f"frame: datum line on the x axis, the middle of the rack at the origin, teeth up{section}",
    )


def _lasting(pieces: Iterable[_Piece], size: float) -> Iterator[_Piece]:
    """The pieces whose ends are apart, on a part of some size [mm]."""
    for name, curve, low, high in pieces:
        start, end = curve(np.array([low, high])).tolist()
        if high > low and abs(end - start) > 1e-14 * size:
            yield name, curve, low, high


def _helix(pair: GearPair, hand: str) -> str:
    return f", helix angle {math.degrees(pair.helix_angle):.9g} deg {hand}-hand" if pair.helix_angle else ""


def _notes(pair: GearPair, number: int, profile: ToothProfile, hand: str) -> tuple[str, ...]:
    helix = _helix(pair, hand)
    section = "; transverse section" if pair.helix_angle else ""
    return (
        f"module {pair.module:g} mm, {profile.cut.teeth} teeth, profile shift {profile.cut.shift:.9g}, "
        f"pressure angle {math.degrees(pair.pressure_angle):.9g} deg{helix}",
        f"tip radius {profile.outer_radius:.9g} mm, root radius {profile.root_radius:.9g} mm, "
        f"tooth thickness on the reference circle (normal section) {pair.tooth_thickness[number]:.9g} mm",
        f"root cut by a rack tool with a tip rounding of {profile.cut.tool.rounding:.6g} module; involute from "
        f"radius {profile.form_radius:.9g} mm" + (", undercut" if profile.undercut else ""),
        "no backlash: reduce the tooth thickness by the allowance of the drawing",
        f"frame: gear axis at the origin, middle of a tooth space on the x axis{section}",
    )


_NAMES = ("root circle", "trochoid", "involute", "tip circle")


def wheel_of(design: MutilatedGearDwell, width: float | None = None, hand: str = "right") -> Part:
    """The wheel, the middle of a gap on the x axis; half a group and its gap, mirrored and turned, make it all.

    Raises
        NoSolution - where the groups leave no gaps, and where no involute is left between root and tip
    """
    _ = design.mutilated  # refuses groups that fill the wheel
    profile, mesh = ToothProfile.of(design.mesh, 0), design.mesh
    count, groups, step = design.group_teeth, design.spec.gears.groups, 2.0 * math.pi / design.full_teeth
    cut = min(end_tooth_radius(mesh), profile.outer_radius)  # a pointed tooth ends below the tip circle
    half_gap = math.pi / groups - 0.5 * count * step
    whole = list(_half(profile))
    ends = _cut_down(whole, cut, math.pi / design.full_teeth)
    root = profile.root_radius
    stretches = [_stretch("gap", arc(root), 0.0, half_gap)]
    for k in range(math.ceil(0.5 * count)):
        pieces, start = ends if k in (0, count - 1) else whole, half_gap + k * step
        stretches += [_turned(*piece, start) for piece in pieces]
        if 2 * k + 1 != count:  # the middle tooth of an odd group ends at the mirror
            stretches += [_mirrored(*piece, start + step) for piece in reversed(pieces)]
    return Part(
        name="wheel",
        title=f"wheel, {groups} x {count} of {design.full_teeth} teeth",
        stretches=tuple(stretches),
        closed=True,
        teeth=groups,
        circles=(
            Circle("REFERENCE_CIRCLE", profile.reference_radius),
            Circle("BASE_CIRCLE", profile.base_radius),
            Circle("TIP_CIRCLE", profile.outer_radius),
            Circle("ROOT_CIRCLE", profile.root_radius),
        ),
        notes=(
            f"{amount(groups, 'group')} of {amount(count, 'tooth', 'teeth')}, {design.full_teeth} teeth without gaps; "
            f"module {mesh.module:g} mm",
            f"first and last tooth of a group cut to radius {cut:.6g} mm, so that they clear the gear at rest",
            "the motion begins with a step of the speed; an entry tooth is omitted",
            *([] if design.spec.locking is not None else ["nothing locks the driven gear: the file has no locking"]),
            "no backlash: reduce the tooth thickness by the allowance of the drawing",
            "frame: wheel axis at the origin, middle of a gap on the x axis",
        ),
        width=width,
        twist=SENSES[hand] * math.tan(mesh.helix_angle) / mesh.reference_radius[0],
    )


def locking_disc(design: MutilatedGearDwell) -> Part:
    """The locking disc of a mutilated wheel, the middle of an arc on the x axis.

    Raises
        NoSolution - for radii with which no disc and plate exist
    """
    lock, groups, shafts = _lock_of(design), design.spec.gears.groups, design.spec.shafts
    end, middle = 0.5 * lock.arc, math.pi / groups
    edge = cmath.rect(1.0, end)
    return Part(
        name="disc",
        title="locking disc next to the wheel",
        stretches=(
            _stretch("locking arc", arc(lock.radius), 0.0, end),
            _stretch("edge", straight(lock.radius * edge, lock.cut * edge), 0.0, 1.0),
            _stretch("cut-out", arc(lock.cut), end, middle),
        ),
        closed=True,
        teeth=groups,
        circles=() if shafts is None or shafts.W_radius is None else (Circle("SHAFT", shafts.W_radius),),
        notes=(
            f"arcs of {math.degrees(lock.arc):.9g} deg, cut-out to radius {lock.cut:.9g} mm with radial edges",
            "to be fixed to the wheel next to its teeth, the middle of an arc in the middle of a gap",
            "frame: axis of the wheel at the origin, middle of an arc on the x axis",
        ),
        findings=_failed(design, "locking"),
        lines=partial(sizes.disc_lines, design),
        dimensions=sizes.disc(lock, groups),
    )


def locking_plate(design: MutilatedGearDwell) -> Part:
    """The plate of a driven gear with its concave arcs, the middle of one on the x axis."""
    lock, shafts = _lock_of(design), design.spec.shafts
    return Part(
        name="plate",
        title="locking plate next to the driven gear",
        stretches=(
            _stretch("locking arc", lambda at: lock.distance - lock.hollow * unit_vector(-at), 0.0, lock.reach),
            _stretch("rim", arc(lock.plate), lock.half_arc, math.pi / lock.stops),
        ),
        closed=True,
        teeth=lock.stops,
        circles=() if shafts is None or shafts.A_radius is None else (Circle("SHAFT", shafts.A_radius),),
        notes=(
            f"{amount(lock.stops, 'arc')} of radius {lock.hollow:.9g} mm about the wheel's axis in the dwell, "
            f"{_wider(lock.clearance, 'the disc')}",
            "to be fixed to the driven gear next to its teeth, the middle of an arc in the middle of a tooth",
            "frame: axis of the driven gear at the origin, middle of an arc on the x axis",
        ),
        findings=_failed(design, "locking"),
        lines=partial(sizes.plate_lines, design),
        dimensions=sizes.plate(lock),
    )


def _lock_of(design: MutilatedGearDwell) -> Lock:
    lock = design.lock
    assert lock is not None, "a design without the section has no maker of these parts"
    return lock


def _failed(design: Any, check: str) -> tuple[str, ...]:
    """Messages of the findings of a check that fail."""
    return tuple(found.message for found in design.check(check) if found.status == "fail")


def _half(profile: ToothProfile) -> Iterator[_Piece]:
    """A tooth from the middle of the space before it, on the x axis, to its own middle."""
    named = ((name, *rest) for name, rest in zip(_NAMES, profile.pieces(), strict=True))
    return _lasting(named, profile.tip_radius)


def _cut_down(pieces: list[_Piece], radius: float, middle: float) -> list[_Piece]:
    """The same up to a radius [mm], from there an arc to the middle of the tooth [rad]."""
    kept: list[_Piece] = []
    start = 0.0
    for name, curve, low, high in pieces:

        def beyond(at: float, curve: Curve = curve) -> float:
            return abs(complex(curve(np.array([at]))[0])) - radius

        last = beyond(high) > 0.0
        if last and beyond(low) >= 0.0:
            break
        end = bracketed_root(beyond, low, high) if last else high
        kept.append((name, curve, low, end))
        start = cmath.phase(complex(curve(np.array([end]))[0]))
        if last:
            break
    if start < middle:
        kept.append(("cut", arc(radius), start, middle))
    return kept


def _turned(name: str, curve: Curve, low: float, high: float, angle: float) -> Stretch:
    unit = cmath.rect(1.0, angle)
    return _stretch(name, lambda at: unit * curve(at), low, high)


def _mirrored(name: str, curve: Curve, low: float, high: float, angle: float) -> Stretch:
    """The other flank of a tooth, from its middle outwards."""
    unit = cmath.rect(1.0, angle)
    return _stretch(name, lambda at: unit * np.conj(curve(low + high - at)), low, high)


def _stretch(name: str, curve: Curve, low: float, high: float) -> Stretch:
    def points(parameter: Reals) -> Points:
        row: Points = np.asarray(curve(parameter), dtype=np.complex128)[None, :]
        return row

    return Stretch(("PROFILE",), points, low, high, name, steps=1)


def _touching(cam: DiscCam) -> str:
    """What touches a cam."""
    return f"roller radius {abs(cam.roller_radius):.9g} mm" if cam.roller_radius else "knife edge"


CAM_LAYERS = ("PROFILE", "PITCH_CURVE")
_TURN = 2.0 * math.pi
# A joint belongs to the stretch that begins there; so far inside [rad] each stretch is asked, 1e-10 mm of a cam.
_INSIDE = 1e-12


def disc_cam(name: str, cam: DiscCam, words: str = "") -> Part:
    """A closed cam: profile and pitch curve over a revolution, a vertex at each joint of its law.

    Parameters
        words : what it is, where the offset from the pitch curve is not the radius of the roller
    Raises
        NoSolution - where the cam does not exist
    """
    layers = CAM_LAYERS if cam.roller_radius or words else CAM_LAYERS[:1]  # an edge goes along the profile
    stretches = [_of_turn(cam, layers, low, high) for low, high in pairwise(_joints(cam))]
    rounded = []
    for stretch, following in zip(stretches, [*stretches[1:], stretches[0]], strict=True):
        rounded += [stretch, *_round_corner(cam, stretch, following)]
    # a wall or a path outside the pitch curve has no roller that could cut it
    judged = (cam,) if cam.roller_radius > 0.0 else ()
    failed = tuple(check.message for check in undercut_checks(judged) if check.status == "fail")
    return Part(
        name=name,
        title=cam.name,
        stretches=tuple(rounded),
        closed=True,
        circles=(Circle("BASE_CIRCLE", cam.min_radius),) if cam.min_radius > 0.0 else (),  # else the roller covers it
        notes=_cam_notes(words or _touching(cam), cam),
        findings=failed,
        extra_columns=("cam_angle [deg]", "pressure_angle [deg]", "curvature_radius [mm]"),
    )


def flat_cam(name: str, cam: FlatCam, words: str = "flat face") -> Part:
    """A closed cam under a flat face: its profile over a revolution, a vertex at each joint of its law.

    Parameters
        words : what it is
    """

    def stretch(low: float, high: float) -> Stretch:
        inside = _within(low, high)

        def extra(theta: Reals) -> Reals:
            return np.stack([np.degrees(theta), cam.touch(inside(theta)).radius])

        return Stretch(CAM_LAYERS[:1], lambda theta: cam.points(inside(theta))[0][None, :], low, high, extra=extra)

    undercut = cam.min_curvature_radius.value <= 0.0
    return Part(
        name=name,
        title=cam.name,
        stretches=tuple(stretch(low, high) for low, high in pairwise(_joints(cam))),
        closed=True,
        circles=(Circle("BASE_CIRCLE", cam.min_radius),),
        notes=_cam_notes(words, cam),
        findings=("the profile is undercut: it cannot be made",) if undercut else (),
        extra_columns=("cam_angle [deg]", "curvature_radius [mm]"),
    )


def _cam_notes(words: str, cam: DiscCam | FlatCam) -> tuple[str, ...]:
    return (
        f"{words}, cam turns {'counter-' if cam.sense > 0 else ''}clockwise",
        "frame: cam axis at the origin, x parallel to the machine's x at cam angle 0",
        "base circle: the largest about the axis inside the profile",
    )


def _within(low: float, high: float) -> Callable[[Reals], Reals]:
    """Cam angles kept inside the stretch between two joints."""
    return lambda theta: np.clip(theta, low + _INSIDE if low else 0.0, high - _INSIDE)


def _joints(cam: DiscCam | FlatCam) -> list[float]:
    """Cam angles from 0 to a revolution where stretches meet."""
    inside = sorted(joint % _TURN for joint in cam.joints)
    apart = [0.0]
    for joint in inside:
        if joint - apart[-1] > 1e-9 and _TURN - joint > 1e-9:
            apart.append(joint)
    return [*apart, _TURN]


def _of_turn(cam: DiscCam, layers: tuple[str, ...], low: float, high: float) -> Stretch:
    inside = _within(low, high)

    def points(theta: Reals) -> Points:
        pitch, contact = cam.points(inside(theta))
        return np.stack([contact, pitch][: len(layers)])

    def extra(theta: Reals) -> Reals:
        rows = cam.at(inside(theta))
        return np.stack([np.degrees(theta), np.degrees(rows.pressure_angle), rows.curvature_radius])

    return Stretch(layers, points, low, high, extra=extra)


def _round_corner(cam: DiscCam, before: Stretch, after: Stretch) -> list[Stretch]:
    """The arc of the roller about a corner of the pitch curve, where the law's velocity jumps; none elsewhere."""
    left = before.points(np.array([before.high]))[:, 0]
    right = after.points(np.array([after.low]))[:, 0]
    if abs(left[0] - right[0]) <= JOIN:
        return []
    center, degrees = complex(right[1]), math.degrees(before.high)
    start, turn = cmath.phase(left[0] - center), cmath.phase((right[0] - center) / (left[0] - center))

    def points(way: Reals) -> Points:
        return arc(abs(cam.roller_radius), center)(start + turn * way)[None, :]

    def extra(way: Reals) -> Reals:
        return np.stack([np.full_like(way, degrees), np.full_like(way, math.nan), np.full_like(way, math.nan)])

    return [Stretch(("PROFILE",), points, 0.0, 1.0, "corner", extra, steps=1)]


def swing_cam(name: str, design: Any) -> Part:
    """A wide-swing cam: the profile of run-up and run-out as far as the roller touches it, open at both ends.

    Raises
        NoSolution - where the profile does not exist
    """
    cam, mirror = _served(name, design)
    contact = design.contact_of(cam)
    places = sorted({0.0, *contact[0], cam.middle, *contact[1], 1.0})
    middle = complex(cam.points(np.array([cam.middle])).pitch[0])
    middle = middle.conjugate() if mirror else middle
    made = Part(
        name=name,
        title=f"{'main' if name == 'main_cam' else 'return'} cam, {'ex' if cam.sense > 0 else 'in'}ternal profile",
        stretches=tuple(_of_stroke(cam, mirror, part, part in contact) for part in pairwise(places)),
        closed=False,
        circles=(Circle("ROLLER_AT_MID_SWING", cam.roller_radius, middle),),
        notes=_swing_notes(cam, mirror),
        findings=_swing_findings(cam, design),
        extra_columns=("k", "cam_angle [deg]", "pressure_angle [deg]", "curvature_radius [mm]"),
    )
    return _on_shaft(made, design.section.shaft_radius)


def _served(name: str, design: Any) -> tuple[AnyCam, bool]:
    """The cam of a stroke, and whether its mirror image is meant."""
    if name == "main_cam":
        return design.cam, False
    return design.return_cam or design.cam, design.spec.layout != "twin-rocker"


def _swing_findings(cam: AnyCam, design: Any) -> tuple[str, ...]:
    """Undercut of this cam; the findings of a design with two shapes tell them apart by their words."""
    others = [words for words, other in design.cams.items() if other is not cam]
    found = _failed(design, "cam-undercut")
    return tuple(message for message in found if not any(words in message for words in others))


def _of_stroke(cam: AnyCam, mirror: bool, part: tuple[float, float], touches: bool) -> Stretch:
    def points(k: Reals) -> Points:
        at = cam.points(k)
        curves = np.stack([at.profile, at.pitch]) if touches else at.pitch[None, :]
        return curves.conj() if mirror else curves

    def extra(k: Reals) -> Reals:
        at = cam.points(k)
        return np.stack([k, np.degrees(at.cam_angle), np.degrees(at.pressure_angle), at.curvature_radius])

    name = "profile" if touches else "slot"
    return Stretch(CAM_LAYERS if touches else CAM_LAYERS[1:], points, *part, name, extra)


def _swing_notes(cam: AnyCam, mirror: bool) -> tuple[str, ...]:
    body = "inside" if cam.sense > 0 else "outside"
    (first, start), (end, last) = cam.contact
    return (
        f"roller radius {cam.roller_radius:.9g} mm, centre distance {cam.center_distance:.9g} mm, "
        f"rocker radius {cam.rocker_radius:.9g} mm",
        f"open profile: the body lies {body} it; hub and rim are to be designed",
        f"profile given for k = {first:.9g} to {start:.9g} and {end:.9g} to {last:.9g}; between them the roller at "
        "mid-swing cuts its own circle (layer ROLLER_AT_MID_SWING)",
        "frame: cam axis at the origin, mid-swing on the x axis" + ("; mirror image of main_cam" if mirror else ""),
    )


def cycloidal_disc(design: Any) -> Part:
    """A disc of a cycloidal reducer as it is ground, one lobe after the other, with its holes."""
    spec, disc = design.spec, design.disc.ground(*design.changes)
    pitch = _TURN / disc.lobes

    def points(tau: Reals) -> Points:
        return np.stack([disc.profile(tau)[0]])

    def extra(tau: Reals) -> Reals:
        return np.stack([np.degrees(tau), disc.profile(tau)[1]])

    ends = pitch * np.arange(disc.lobes + 1)
    circles = [] if spec.bearing_radius is None else [Circle("BORE", spec.bearing_radius)]
    if spec.output_pins is not None:
        given = spec.output_pins
        places = (cmath.rect(given.circle_radius, _TURN * k / given.count) for k in range(given.count))
        circles += [Circle("OUTPUT_HOLES", design.output_hole_radius, place) for place in places]
    return Part(
        name="disc",
        title="cycloidal disc",
        stretches=tuple(Stretch(CAM_LAYERS[:1], points, *span, extra=extra) for span in pairwise(ends.tolist())),
        closed=True,
        circles=tuple(circles),
        notes=(
            f"{disc.lobes} lobes of eccentricity {disc.eccentricity:.9g} mm, ground for pins of radius "
            f"{disc.pin:.9g} mm on a circle of radius {disc.circle:.9g} mm",
            "frame: centre of the disc at the origin, a valley between two lobes on the x axis",
        ),
        findings=_failed(design, "undercut"),
        extra_columns=("parameter [deg]", "curvature_radius [mm]"),
        width=spec.width,
        dimensions=sizes.lobes(disc),
    )


def cycloidal_ring(design: Any) -> Part:
    """The circle of the ring pins, a vertex at the centre of each, with the pins."""
    disc = design.disc
    pitch = _TURN / disc.pins
    ends = pitch * np.arange(disc.pins + 1)
    pins = (Circle("PINS", disc.pin, cmath.rect(disc.circle, pitch * k)) for k in range(disc.pins))

    def points(angle: Reals) -> Points:
        return np.stack([disc.circle * np.exp(1j * angle)])

    def extra(angle: Reals) -> Reals:
        return np.stack([np.degrees(angle)])

    return Part(
        name="ring",
        title="ring with pins",
        stretches=tuple(Stretch(("PIN_CIRCLE",), points, *span, extra=extra) for span in pairwise(ends.tolist())),
        closed=True,
        circles=tuple(pins),
        notes=(f"{disc.pins} pins of radius {disc.pin:.9g} mm, the first on the x axis",),
        extra_columns=("angle [deg]",),
        lines=partial(sizes.ring_lines, disc),
    )


def geneva_wheel(design: Any) -> Part:
    """The wheel of a Geneva drive, the middle of a slot on the x axis; of an internal one its inner contour."""
    spec, inner = design.spec, design.drive.sign < 0.0
    locking = spec.locking_radius
    outlines = design.outlines_with(locking or 0.0)
    blank = Circle("TIP_CIRCLE", outlines.tip)
    arcs = "no locking arcs: the file has no locking_radius"
    if locking is not None:
        arcs = f"locking arcs of radius {locking + spec.locking_clearance:.9g} mm about the crank's axis in the dwell"
        arcs += f", {_wider(spec.locking_clearance, 'the disc')}"
    form = "inner contour, the body lies outside it; the rim is to be designed" if inner else "outer contour"
    return Part(
        name="wheel",
        title=f"{'internal ' if inner else ''}wheel of {spec.slots} slots",
        stretches=tuple(_stretch(*piece) for piece in outlines.wheel_half()),
        closed=True,
        teeth=spec.slots,
        circles=(blank,) if spec.hub_radius is None else (blank, Circle("HUB", spec.hub_radius)),
        notes=(
            f"{form}; slots {2.0 * spec.pin_radius + spec.slot_clearance:.9g} mm wide, "
            f"{_wider(spec.slot_clearance, 'the pin')}",
            arcs,
            f"distance of the axes {spec.center_distance:.9g} mm",
            "frame: axis of the wheel at the origin, the middle of a slot on the x axis",
        ),
        findings=_failed(design, "locking"),
        lines=partial(sizes.wheel_lines, design),
        dimensions=sizes.wheel(outlines),
    )


def _wider(clearance: float, than: str) -> str:
    return f"{clearance:.9g} mm more than {than}" if clearance else f"as {than}: add the running clearance"


def geneva_driver(design: Any) -> Part:
    """The locking disc of a Geneva drive with its cut-outs, and the places of the pins."""
    spec, drive = design.spec, design.drive
    outlines = design.outlines_with(spec.locking_radius)
    pins = [Circle("PINS", spec.pin_radius, cmath.rect(drive.crank, _TURN * k / drive.pins)) for k in range(drive.pins)]
    shaft = [] if spec.shaft_radius is None else [Circle("SHAFT", spec.shaft_radius)]
    deep = ""
    if spec.shaft_radius is not None and outlines.cut_vertex <= spec.shaft_radius:
        deep = f"; the shaft of radius {spec.shaft_radius:.9g} mm does not go through the disc"
    return Part(
        name="driver",
        title="locking disc and pins of the crank",
        stretches=tuple(_stretch(*piece) for piece in outlines.driver()),
        closed=True,
        circles=(*pins, *shaft),
        notes=(
            f"pins of radius {spec.pin_radius:.9g} mm at {drive.crank:.9g} mm from the axis",
            "the crank's arm, which carries pin and disc, lies in front of the wheel and is not drawn",
            f"cut-out: {outlines.cut_vertex:.9g} mm from the axis on the pin's radius{deep}",
            "frame: axis of the crank at the origin, a pin on the x axis",
        ),
        findings=_failed(design, "locking"),
        lines=partial(sizes.driver_lines, design, outlines),
        dimensions=sizes.driver(outlines),
    )


def closed_cam(name: str, design: Any) -> Part:
    """A wide-swing cam over the whole cycle as one closed contour; a twin-rocker's two in the frame of one body.

    Raises
        NoSolution - where the profile does not exist
    """
    cycle = design.cycle
    late = name != "contour"
    closed, frame = (cycle.back, cycle.of_back) if late else (cycle.main, cycle.of_main)
    start, end = (k * closed.own for k in closed.cam.slot)
    places = [(0, 0.0), (0, start), (0, 0.5 * closed.own), (0, end), *((i, closed.starts[i]) for i in (1, 2, 3))]
    ends = [t for _, t in places[1:]] + [closed.starts[4]]
    spans = [(i, low, high) for (i, low), high in zip(places, ends, strict=True) if high > low]
    found = design.check("closed-contour")
    made = Part(
        name=name,
        title=f"{'return' if late else 'main'} cam, closed {'ex' if closed.cam.sense > 0 else 'in'}ternal contour",
        stretches=tuple(_of_sector(closed, frame, *span) for span in spans),
        closed=True,
        notes=_closed_notes(closed, cycle, late),
        findings=(found[late].message,) if found[late].status == "fail" else (),
        extra_columns=("cam_angle_of_own_stroke [deg]",),
    )
    return _on_shaft(made, design.section.shaft_radius)


def _of_sector(closed: Any, frame: Any, sector: int, low: float, high: float) -> Stretch:
    from gearlink.core.machines.wide_swing.cycle import SECTORS

    def points(t: Reals) -> Points:
        return np.stack([frame(closed.contour_of(sector, t)), frame(closed.pitch_of(sector, t))])

    return Stretch(CAM_LAYERS, points, low, high, SECTORS[sector], lambda t: np.degrees(t)[None, :])


def _closed_notes(closed: Any, cycle: Any, late: bool) -> tuple[str, ...]:
    cam = closed.cam
    sectors = ", ".join(f"{math.degrees(angle):.9g}" for angle in closed.sectors)
    frame = "cam axis at the origin, mid-swing of " + ("the return stroke" if late else "the working stroke")
    if late and not cycle.external_working:
        frame = "that of the internal contour: both profiles are on one body in their true position to each other"
    else:
        frame += " on the x axis"
    return (
        f"roller radius {cam.roller_radius:.9g} mm, centre distance {cam.center_distance:.9g} mm, "
        f"rocker radius {cam.rocker_radius:.9g} mm",
        f"sectors of the pitch curve from its own stroke on: driven, arc, free, arc: {sectors} deg; in the free sector "
        f"the contour keeps {closed.clearance:.9g} mm from the roller",
        f"the body lies {'in' if cam.sense > 0 else 'out'}side; the roller's slot at mid-swing is part of it",
        f"frame: {frame}",
    )


_RATES = ("velocity", "acceleration")
_LOOKS = 36


def coupler_path(design: Any) -> Makers:
    """The path of the coupler point of a four-bar."""
    if design.coupler_point is None:
        raise MissingSection(
            "no path to export: the file has no coupler_point",
            key="",
            fix=f"give coupler_point: [x, y], or --part {PATH}B",
        )
    return {f"{PATH}P": partial(_path, design, "P")}


def planar(design: Any) -> Makers:
    """Makers of the paths by `PATH-POINT`, of the gears, with standard teeth, by mesh and link, and of the cams."""
    found: Makers = {**{f"{PATH}{name}": partial(_path, design, name) for name in design.traced}, **_gears(design)}
    found |= {name: partial(_planar_cam, name, cam) for name, cam in design.structure.cams.items()}
    if not found:
        raise MissingSection("no path to export", key="outputs", fix="name a point of a link in outputs")
    return found


def _planar_cam(name: str, cam: Any) -> Part:
    made = flat_cam(name, cam.profile) if cam.given.face is not None else disc_cam(name, cam.profile)
    return _on_shaft(made, cam.shaft)


def _path(design: Any, name: str) -> Part:
    """The path of a point over the period or range, its rates beside it.

    Raises
        UnknownPoint - for a point that no link has, or that stands still
    """
    motion, given = design.moving, design.moving.input
    place, per = place_of(motion.at(np.linspace(given.start, given.end, _LOOKS), 0), name), given.unit

    def points(q: Reals) -> Points:
        return np.asarray([rates_of(motion.at(q, 0), place).value])

    def extra(q: Reals) -> Reals:
        point = rates_of(motion.at(q, 2), place)
        shown = np.degrees(q) if per == "rad" else q
        return np.asarray([shown, *(part for rate in point[1:3] for part in (rate.real, rate.imag))])

    units = (f"mm/{per}", f"mm/{per}^2") if per == "rad" else ("1", "1/mm")
    columns = [f"{axis}_{rate}_ratio [{unit}]" for rate, unit in zip(_RATES, units, strict=True) for axis in "xy"]
    ends = [given.start, *(joint for joint in given.joints if given.start < joint < given.end), given.end]
    steps = math.ceil(_LOOKS * max(1, given.turns or 1) / (len(ends) - 1))
    return Part(
        name=f"{PATH}{name.replace('/', '_')}",
        title=f"path of {name}",
        stretches=tuple(Stretch(("PATH",), points, *span, extra=extra, steps=max(8, steps)) for span in pairwise(ends)),
        closed=given.turns is not None,
        notes=("frame: that of the design", "rates are per input"),
        extra_columns=(f"{given.column} [{'deg' if per == 'rad' else 'mm'}]", *columns),
    )


def _gears(design: Any) -> Makers:
    from gearlink.core.machines.planar.structure import RackJoint

    found: Makers = {}
    for name, mesh in design.structure.meshes.items():
        alpha, names = math.radians(design.spec.meshes[name].pressure_angle), design.structure.names
        if isinstance(mesh, RackJoint):
            teeth, links = (round(2.0 * mesh.radius / mesh.module),) * 2, (names[mesh.line.other], "")
        else:
            teeth, links = mesh.teeth, (names[mesh.first], names[mesh.second])
            if teeth[0] < 0:
                teeth, links = teeth[::-1], links[::-1]
        made = of_mesh(
            GearPair.from_shift(mesh.module, teeth, pressure_angle=alpha),
            (f"{name}_{links[0]}", f"{name}_{links[1]}"),
            (f"gear of {links[0]}", f"gear of {links[1]}"),
            f"meshes.{name}",
        )
        found |= {part: maker for part, maker in made.items() if not part.endswith("_")}
    return found
