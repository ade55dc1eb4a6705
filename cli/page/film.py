"""The film of a design inside a page: its positions as data for the player."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gearlink.core.errors import NoSolution

if TYPE_CHECKING:
    from gearlink.core.design import Design

_FPS, _MOST = 25, 150
"""A page takes no more pictures; faster teeth than these show are no loss beside the numbers."""


def film_data(design: Design, pictures: int = 0) -> dict[str, Any] | None:
    """What the player draws; None where the design has no film, or cannot make its loop.

    Parameters
        pictures : int - how many; 0 leaves it to the teeth
    """
    import numpy as np

    from gearlink.cli.moving.page import player_data
    from gearlink.cli.scenes import loops

    if design.kind not in loops.moving_kinds():
        return None
    try:
        count = pictures or min(_MOST, loops.pictures_for(loops.build(design, np.arange(96) / 96), _FPS))
        scene = loops.build(design, np.arange(count) / count)
    except NoSolution:
        return None
    return player_data(scene, design.spec.name, _FPS)
