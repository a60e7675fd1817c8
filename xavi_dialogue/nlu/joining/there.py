"""There: "the middle lane is free, go there" asks for that lane."""

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import Act, Request
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import Ego, Event, Lane


def to_lane(before: Act, act: Act) -> Request | None:
    """Take a lane that was just spoken of for where we are asked to go; None otherwise."""
    lane = first(before, Lane)
    match act:
        case Request(Event("head" | "go" | "move", Ego(), None, where=None) as event):
            if lane is not None and lane.which != "own":
                return replace(act, event=replace(event, action="go", object=lane))
    return None
