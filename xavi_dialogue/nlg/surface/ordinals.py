"""Ordinals: first, second, third."""

WORDS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth",
         "tenth")  # fmt: skip


def ordinal(rank: int) -> str:
    """Return an ordinal number; -1 is the last."""
    if rank == -1:
        return "last"
    if 1 <= rank <= len(WORDS):
        return WORDS[rank - 1]
    ending = (
        {1: "st", 2: "nd", 3: "rd"}.get(rank % 10, "th") if rank % 100 not in (11, 12, 13) else "th"
    )
    return f"{rank}{ending}"
