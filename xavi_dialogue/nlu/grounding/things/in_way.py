"""In the way: who "anybody in our way" is."""

from msgspec.structs import replace

from xavi_dialogue.domain.terms import Described, Exists, Nobody, Related, Vehicle, Wanted
from xavi_dialogue.nlu.grounding.context import Grounder, Window
from xavi_dialogue.nlu.grounding.things.descriptions import is_such


def anybody_in_way(spoken: Related, g: Grounder, window: Window) -> Related | Exists | None:
    """Take the nearest one for "anybody in our way", or nobody; None: it asks about another."""
    thing, world = spoken.thing, g.context.world
    if spoken.relation != "in-the-way-of" or not isinstance(thing, Described) or thing.definite:
        return None
    at, to = window.end, g.thing(spoken.to, window)
    looks = (world.look(v, at) for v in world.in_view(at))
    near = sorted((look.distance, look.vehicle) for look in looks if look is not None)
    there = (Vehicle(v) for _, v in near if world.relation("in-the-way-of", Vehicle(v), to, at))
    found = next((one for one in there if is_such(one, thing, g, window)), None)
    if found is not None:
        return replace(spoken, thing=found, to=to, time=window.term)
    such = replace(spoken, thing=Wanted(), to=to, time=window.term)
    return Exists(Nobody(replace(thing, such=such)), window.term, spoken.tense)
