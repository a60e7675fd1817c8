"""Ranking: "and in the first?" after a question on the second of several turns or junctions."""

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import Act, Ask, Elliptic
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import Described, Event, Junction, Rank, Relative, Time, Unsaid
from xavi_dialogue.nlu.grounding.context import Grounder


def anchor_of(spoken: Act | None) -> Event | Junction | None:
    """Give the one of several deeds or junctions by which the time of a question is told."""
    if not isinstance(spoken, Ask):
        return None
    time = first(spoken, Relative)
    anchor = None if time is None or time.relation != "during" else time.anchor
    if isinstance(anchor, Junction) and anchor.rank is not None:
        return anchor
    if isinstance(anchor, Event) and isinstance(anchor.time, Rank):
        return anchor
    event = first(spoken, Event)
    return event if event is not None and isinstance(event.time, Rank) else None


def ranked(spoken: Elliptic, g: Grounder) -> Elliptic:
    """Take "the first one" for the time of the deed or junction of that rank, if one was named."""
    anchor, thing = g.context.discourse.anchor, spoken.thing
    if anchor is None or not isinstance(thing, Described) or thing.rank is None:
        return spoken
    plain = Described(rank=thing.rank, definite=thing.definite)
    if thing != plain or not isinstance(spoken.time, Unsaid):
        return spoken
    g.notes.leaned = True
    time: Time = (
        Relative("during", replace(anchor, rank=thing.rank))
        if isinstance(anchor, Junction)
        else Relative("during", replace(anchor, time=Rank(thing.rank)))
    )
    return replace(spoken, thing=None, time=time)
