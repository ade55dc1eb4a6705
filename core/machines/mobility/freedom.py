"""Degrees of freedom of a linkage that carries gear trains, and the rule by which a train is put on it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from gearlink.core.base.errors import NoSolution

MOST_FIXED_ENDS = 2


def linkage_mobility(links: Mapping[str, Sequence[str]]) -> int:
    """Degrees of freedom of a planar pin-jointed linkage, its frame counted among the links.

    F = 3 (n - 1) - 2 sum(k - 1),   k the number of links that meet at a pin

    Parameters
        links : mapping - name of each link and the pins that it carries
    Returns
        F : int - of a linkage in general position
    Raises
        NoSolution - for a link that names a pin twice, or a linkage that falls into parts
    Example
        >>> linkage_mobility({"frame": "AD", "crank": "AB", "coupler": "BC", "rocker": "CD"})
        1

    Source
        thesis 2.1; the rule is P. L. Chebyshev's and M. Gruebler's
    """
    for name, pins in links.items():
        if len(set(pins)) < len(pins):
            raise NoSolution(f"link {name} names the same pin twice ({', '.join(pins)})", fix="give each pin once")
    _require_one_piece(links)
    meeting = [sum(pin in pins for pins in links.values()) for pin in pin_names(links)]
    return 3 * (len(links) - 1) - 2 * sum(k - 1 for k in meeting)


def pin_names(links: Mapping[str, Sequence[str]]) -> list[str]:
    """The pins of a linkage, each once, in the order of the links.

    Example
        >>> pin_names({"frame": "AD", "crank": "AB"})
        ['A', 'D', 'B']
    """
    return list(dict.fromkeys(pin for pins in links.values() for pin in pins))


def train_change(fixed: int) -> int:
    """What a train of meshing gears adds to the degrees of freedom of the linkage that carries it.

    dF = 3 (J - R) - 2 (J - R) - (J - 1) = 1 - R

    Parameters
        fixed : int - R, end gears fixed to a link: 0, 1 or 2; the number J of gears does not matter
    Returns
        dF : int
    Raises
        NoSolution - for another R: a train has two ends
    Example
        A four-bar takes one train with one end fixed, a six-bar loop two with two.

        >>> [train_change(fixed) for fixed in (0, 1, 2)]
        [1, 0, -1]

    Source
        thesis 2.1
    """
    if not 0 <= fixed <= MOST_FIXED_ENDS:
        raise NoSolution(
            f"{fixed} gears of one train are fixed to links; only its two end gears may be",
            fix="split the train at the gears between, each of which ends one train and begins the next",
        )
    return 1 - fixed


def common_links(links: Mapping[str, Sequence[str]], first: str, second: str) -> list[str]:
    """Links that carry both pins: there the distance of the two never changes, and gears on them may mesh.

    Example
        >>> common_links({"frame": "AD", "crank": "AB", "coupler": "BC"}, "A", "B")
        ['crank']

    Source
        thesis 2.1, item 1
    """
    return [name for name, pins in links.items() if first in pins and second in pins]


def _require_one_piece(links: Mapping[str, Sequence[str]]) -> None:
    """Refuse a linkage in which some link cannot be reached from the first."""
    names = list(links)
    reached, border = {names[0]}, [names[0]]
    while border:
        pins = set(links[border.pop()])
        for name in names:
            if name not in reached and pins & set(links[name]):
                reached.add(name)
                border.append(name)
    lost = [name for name in names if name not in reached]
    if lost:
        raise NoSolution(
            (f"the linkage falls into parts: {', '.join(lost)} shares no pin with {', '.join(sorted(reached))}"),
            fix="name the pin at which they meet in both",
        )
