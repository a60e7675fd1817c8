"""Colours in words."""

_PALETTE = {
    "white": (255, 255, 255),
    "grey": (128, 128, 128),
    "black": (0, 0, 0),
    "red": (255, 0, 0),
    "orange": (255, 165, 0),
    "yellow": (255, 255, 0),
    "green": (0, 160, 0),
    "blue": (0, 0, 255),
    "purple": (128, 0, 128),
    "brown": (139, 69, 19),
}


def colour_name(red: int, green: int, blue: int) -> str:
    """The word for a colour, by the nearest of a small palette.

    Args:
        red, green, blue: 0 to 255.
    """

    def distance(word: str) -> int:
        r, g, b = _PALETTE[word]
        return (r - red) ** 2 + (g - green) ** 2 + (b - blue) ** 2

    return min(_PALETTE, key=distance)
