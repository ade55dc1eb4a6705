"""The colours of all pictures, which stay apart for colour-blind readers and in grey print (Okabe and Ito)."""

BLUE, ORANGE, GREEN, RED = "#0072B2", "#E69F00", "#009E73", "#D55E00"
PURPLE, SKY, BLACK = "#CC79A7", "#56B4E9", "#222222"
GREY, LIGHT, WHITE = "#777777", "#DDDDDD", "#ffffff"


def pale(color: str, share: float = 0.18) -> str:
    """A colour mixed with white: fills are opaque, so that parts in front hide those behind.

    Example
        >>> pale("#000000", 0.2)
        '#cccccc'
    """
    parts = (int(color[i : i + 2], 16) for i in (1, 3, 5))
    return "#" + "".join(f"{round(255 - share * (255 - part)):02x}" for part in parts)
