"""The colours of all pictures, which stay apart for colour-blind readers and in grey print (Okabe and Ito)."""

BLUE, ORANGE, GREEN, RED = "#0072B2", "#E69F00", "#009E73", "#D55E00"
PURPLE, SKY, BLACK = "#CC79A7", "#56B4E9", "#222222"
DWELL, STEP = "#CFE8F7", "#F9D9A8"
"""Bands of a dwell and of a back-step."""
PHASE_TINTS = {
    "lead-in": "#FBE3C8",
    "accelerate": "#FBE3C8",
    "rise": "#FBE3C8",
    "sync": "#CFE8F7",
    "constant": "#CFE8F7",
    "transition": "#FDF3C0",
    "decelerate": "#FDF3C0",
    "return": "#E6D9EE",
    "forward": "#CFE8F7",
    "back": "#E6D9EE",
    "contact": "#CFE8F7",
    "free": "#F2F2F2",
    "fall": "#E6D9EE",
    "far-dwell": "#E4E4E4",
    "dwell": "#F2F2F2",
    "near-dwell": "#F2F2F2",
}
"""Phases of a motion."""
GREY, LIGHT, WHITE = "#777777", "#DDDDDD", "#ffffff"
WRONG = "#D00000"
"""What fails."""


def pale(color: str, share: float = 0.18) -> str:
    """A colour mixed with white: fills are opaque, so that parts in front hide those behind.

    Example
        >>> pale("#000000", 0.2)
        '#cccccc'
    """
    parts = (int(color[i : i + 2], 16) for i in (1, 3, 5))
    return "#" + "".join(f"{round(255 - share * (255 - part)):02x}" for part in parts)
