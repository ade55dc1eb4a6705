"""What is wrong with the names and the wiring of a planar mechanism's file, before anything is computed."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.errors import named

if TYPE_CHECKING:
    from gearlink.core.machines.planar.spec import CamPair, PlanarSpec, Teeth

FRAME = "frame"
RESERVED = (FRAME, "input", "time")
Fault = tuple[str, str, str]


def faults(spec: PlanarSpec) -> Iterator[Fault]:
    """Code, key and words of what is wrong, the first of each sort that others rest on."""
    yield from _names(spec)
    yield from _bars(spec)
    yield from _slides(spec)
    for name, mesh in spec.meshes.items():
        yield from _mesh(spec, f"meshes.{name}", mesh)
    for name, cam in spec.cams.items():
        yield from _cam(spec, f"cams.{name}", cam)
    yield from _drives(spec)
    yield from _starts(spec)
    yield from _outputs(spec)
    yield from _hanging(spec)
    yield from _sizes(spec)


def _sizes(spec: PlanarSpec) -> Iterator[Fault]:
    """Sources of tolerances that are no sizes of parts."""
    for key in () if spec.tolerance is None else spec.tolerance.sources:
        section = key.partition(".")[0]
        if section in ("start", "drive", "range", "limits", "input_speed"):
            words = f"{section} is not a size of a part\nname a number of frame, links, slides or slots, or pins.PIN"
            yield "GL170", f'tolerance.sources."{key}"', words


def _names(spec: PlanarSpec) -> Iterator[Fault]:
    seen: dict[str, str] = {}
    for section in ("links", "slides", "slots", "meshes", "cams"):
        for name in getattr(spec, section):
            key = f"{section}.{name}"
            if name in RESERVED:
                yield "GL111", key, f"{name} is reserved: use another name"
            if name in seen:
                yield (
                    "GL111",
                    key,
                    f"{seen[name]} already has this name: links, slides, slots, meshes and cams need different names",
                )
            seen[name] = key


def _bars(spec: PlanarSpec) -> Iterator[Fault]:
    for name, link in spec.links.items():
        if isinstance(link, dict):
            continue
        first, second, length = link
        for k, point in enumerate((first, second)):
            if not isinstance(point, str):
                yield "GL111", f"links.{name}[{k}]", "a bar is [first point, second point, length]\nname its points"
        if isinstance(length, str):
            yield "GL111", f"links.{name}[2]", "a bar is [first point, second point, length]\ngive its length in mm"
        if first == second:
            yield "GL111", f"links.{name}[1]", "a bar connects two different points\nname two"


def _near(wrong: str, known: Iterable[str]) -> str:
    names = list(known)
    close = difflib.get_close_matches(wrong, names, 1)
    if close:
        return f"did you mean {close[0]}?"
    return f"there are {', '.join(names[:12])}{' ...' if len(names) > 12 else ''}" if names else "there is none"


def _called(what: str, name: str, known: Iterable[str], key: str) -> Iterator[Fault]:
    if name not in known:
        yield "GL111", key, f"no {what} is called {named(name)}: {_near(name, known)}"


def _body(spec: PlanarSpec, name: str, key: str) -> Iterator[Fault]:
    return _called("link", name, [FRAME, *spec.links], key)


def _point(spec: PlanarSpec, point: str, body: str, key: str) -> Iterator[Fault]:
    points = spec.bodies[body]
    if point not in points:
        yield "GL111", key, f"{body} has no point {named(point)}: {_near(point, points)}"


def _slides(spec: PlanarSpec) -> Iterator[Fault]:
    taken: dict[str, str] = {}
    for name, slide in spec.slides.items():
        key = f"slides.{name}"
        yield from _called("link", slide.link, spec.links, f"{key}.link")
        yield from _body(spec, slide.on, f"{key}.on")
        if slide.on == slide.link:
            yield "GL111", f"{key}.on", "a link cannot slide on itself\nname the body that has the line"
        if slide.point is not None:
            yield from _point(spec, slide.point, slide.link, f"{key}.point")
        if slide.link in taken:
            words = (
                f"{slide.link} already runs on slide {taken[slide.link]}: for a second line use a slot for one of its "
                "points"
            )
            yield "GL111", f"{key}.link", words
        taken[slide.link] = name
    points = dict.fromkeys(point for body in spec.bodies.values() for point in body)
    for name, slot in spec.slots.items():
        key = f"slots.{name}"
        yield from _body(spec, slot.on, f"{key}.on")
        if slot.point not in points:
            yield "GL111", f"{key}.point", f"no body has a point {named(slot.point)}: {_near(slot.point, points)}"
        if not any(slot.point in body for other, body in spec.bodies.items() if other != slot.on):
            words = f"{slot.point} is a point of {slot.on}, which has the slot\nname a point of another body"
            yield "GL111", f"{key}.point", words


def _mesh(spec: PlanarSpec, key: str, mesh: Teeth) -> Iterator[Fault]:
    if mesh.gears is None:
        yield from _body(spec, mesh.rack or "", f"{key}.rack")
        yield from _called("link", mesh.pinion or "", spec.links, f"{key}.pinion")
        yield from _point(spec, str(mesh.at), mesh.pinion or "", f"{key}.at")
        if mesh.rack == mesh.pinion:
            yield "GL111", f"{key}.pinion", "rack and pinion are one link\nname two"
        return
    for k, (gear, point) in enumerate(zip(mesh.gears, mesh.at, strict=True)):
        yield from _body(spec, gear, f"{key}.gears[{k}]")
        yield from _point(spec, point, gear, f"{key}.at[{k}]")
    if mesh.gears[0] == mesh.gears[1]:
        yield "GL111", f"{key}.gears[1]", "both gears are one body\nname two"
    if mesh.at[0] == mesh.at[1]:
        yield "GL111", f"{key}.at", "both gears have one centre, which leaves no distance for teeth\nname two points"
    if mesh.carrier is not None:
        yield from _body(spec, mesh.carrier, f"{key}.carrier")
        for point in mesh.at:
            yield from _point(spec, point, mesh.carrier, f"{key}.carrier")
    holder = carrier_of(spec, mesh)
    if holder is None:
        words = f"no body has both points {' and '.join(mesh.at)}, so nothing keeps the centre distance of the gears"
        yield "GL111", f"{key}.at", f"{words}\nadd a link between them"
    elif spec.bodies[holder][mesh.at[0]] == spec.bodies[holder][mesh.at[1]]:
        yield "GL111", f"{key}.at", "the centres of the gears coincide\nmove one of them"


def _cam(spec: PlanarSpec, key: str, cam: CamPair) -> Iterator[Fault]:
    for part in ("cam", "follower"):
        yield from _called("link", getattr(cam, part), spec.links, f"{key}.{part}")
    if cam.cam == cam.follower:
        yield "GL111", f"{key}.follower", "cam and follower are one link\nname two"
    yield from _point(spec, cam.point, cam.follower, f"{key}.point")
    if cam.on is not None:
        yield from _body(spec, cam.on, f"{key}.on")
    if bearer_of(spec, cam) is None:
        words = f"no body carries {cam.cam} on a pin and {cam.follower} on a pin or slide"
        yield "GL111", f"{key}.on" if cam.on else key, f"{words}\ngive both one body that they turn or slide on"
    own = spec.slid.get(cam.follower, cam.follower)
    if own in (spec.drive.main, *spec.drive.others):
        yield "GL111", f"{key}.follower", f"{own} is driven already\nname a follower that is free"


def bearer_of(spec: PlanarSpec, cam: CamPair) -> str | None:
    """The body that a cam turns on and its follower turns or slides on: that of the file, or the first that does."""
    slide = spec.slid.get(cam.follower)
    for name, points in spec.bodies.items():
        if name in (cam.cam, cam.follower) or cam.on not in (None, name):
            continue
        held = spec.slides[slide].on == name if slide else {*points} & {*spec.bodies[cam.follower]}
        if held and {*points} & {*spec.bodies[cam.cam]}:
            return name
    return None


def _drives(spec: PlanarSpec) -> Iterator[Fault]:
    drive = spec.drive
    if drive.link is not None:
        yield from _called("link", drive.link, spec.links, "drive.link")
    if drive.slide is not None:
        yield from _called("slide", drive.slide, spec.slides, "drive.slide")
    if drive.link in spec.slid:
        yield "GL111", "drive.link", f"{drive.link} slides\ngive slide: {spec.slid[drive.link]} instead of link"
    for name in drive.others:
        key = f"drive.with.{name}"
        yield from _called("link or slide", name, [*spec.links, *spec.slides], key)
        if name in spec.slid:
            yield "GL111", key, f"{name} slides\nname its slide {spec.slid[name]} instead of the link"
        if name == drive.main:
            yield "GL111", key, f"{name} is the drive itself, which the input moves with ratio 1\nomit it"
    if drive.slide is not None and spec.range is None:
        words = "a slide as drive needs a range: {start, end} (mm), since nothing repeats"
        yield "GL106", "range", words


def _starts(spec: PlanarSpec) -> Iterator[Fault]:
    known = [*(name for name in spec.links if name not in spec.slid), *spec.slides]
    for name in spec.start:
        if name in spec.slid:
            yield "GL111", f"start.{name}", f"{name} slides\ngive the position of {spec.slid[name]}, or omit it"
        yield from _called("link or slide", name, known, f"start.{name}")
    given = {spec.drive.main, *spec.drive.others, *tied(spec).values(), *spec.start, *spec.slid}
    for name in spec.links:
        if name not in given:
            words = f"{name} has no start\ngive start.{name}, its rough direction at input 0 (deg)"
            yield "GL106", f"start.{name}", words


def carrier_of(spec: PlanarSpec, mesh: Teeth) -> str | None:
    """The body that holds both centres of two gears: that of the file, or the first that has both points."""
    return mesh.carrier or next((name for name, body in spec.bodies.items() if {*mesh.at} <= {*body}), None)


def tied(spec: PlanarSpec) -> dict[str, str]:
    """By cam and mesh, what its start value makes exact: the follower; the second link, the first where that is taken,
    or then the carrier; a slide's place of a link that slides. One of which all are taken is left out.
    """
    taken = {spec.drive.main, *spec.drive.others}
    found = {}
    for name, cam in spec.cams.items():
        own = spec.slid.get(cam.follower, cam.follower)
        if own not in taken:
            found[name] = own
            taken.add(own)
    for name, mesh in spec.meshes.items():
        links = [mesh.pinion, mesh.rack] if mesh.gears is None else [*mesh.gears[::-1], carrier_of(spec, mesh)]
        for link in links:
            if link is None:
                continue
            own = spec.slid.get(link, link)
            if own not in taken and own != FRAME:
                found[name] = own
                taken.add(own)
                break
    return found


def _outputs(spec: PlanarSpec) -> Iterator[Fault]:
    points = dict.fromkeys(point for link, body in spec.bodies.items() if link != FRAME for point in body)
    known = [*spec.links, *spec.slides, *spec.slots, *points]
    for k, name in enumerate(spec.outputs or ()):
        yield from _called("link, slide, slot or point of a link", name, known, f"outputs[{k}]")
        if name in (spec.outputs or ())[:k]:
            yield "GL111", f"outputs[{k}]", f"{name} is listed twice\nomit one"
    for name in spec.shafts:
        point, _, rest = name.rpartition("_")
        if rest != "radius" or point not in spec.frame:
            shafts = [f"{each}_radius" for each in spec.frame]
            yield "GL111", f"shafts.{name}", f"{name}: a shaft is at a point of the frame\n{_near(name, shafts)}"


def _hanging(spec: PlanarSpec) -> Iterator[Fault]:
    """Links that no chain of joints leads to from the frame."""
    near: dict[str, set[str]] = {name: set() for name in spec.bodies}

    def join(one: str, other: str) -> None:
        near[one].add(other)
        near[other].add(one)

    for point in {point for body in spec.bodies.values() for point in body}:
        holders = [name for name, body in spec.bodies.items() if point in body]
        for other in holders[1:]:
            join(holders[0], other)
    for slide in spec.slides.values():
        join(slide.link, slide.on)
    for slot in spec.slots.values():
        join(slot.on, next(name for name, body in spec.bodies.items() if slot.point in body and name != slot.on))
    reached, edge = {FRAME}, [FRAME]
    while edge:
        edge = [name for each in edge for name in near[each] if name not in reached and not reached.add(name)]  # type: ignore[func-returns-value]
    for name in spec.links:
        if name not in reached:
            words = f"{name} is not connected: no pin, slide or slot leads from the frame to it\ngive it a common point"
            yield "GL111", f"links.{name}", words
