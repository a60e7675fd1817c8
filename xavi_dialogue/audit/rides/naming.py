"""Road users in words."""

from xavi_dialogue.explain.facts.world import World


def name(known: World, vehicle: int, at: float) -> str:
    """Return a road user in words, as it looked at a time [s]."""
    look = known.look(vehicle, at)
    words = () if look is None else tuple(word for word in (look.colour, look.kind) if word)
    return f"{' '.join(words) or 'vehicle'} {vehicle}"
