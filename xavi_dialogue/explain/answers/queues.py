"""Queues: who stands at the head of the queue that we stand in."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, Identified
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import Which
from xavi_dialogue.domain.terms import (
    Between,
    Event,
    Feature,
    Happens,
    Proposition,
    Related,
    Vehicle,
    Wanted,
)
from xavi_dialogue.explain.answers.propositions.identify import identified, which
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.sight.standing_row import head


def who(question: Which, asked: Asked) -> Answer:
    """Return for whom something holds; for the head of a queue, who stands there.

    Raises:
        Unanswered: it presupposes something that did not happen.
    """
    first = head(asked, asked.moment) if is_head(question.such) else None
    if first is not None:
        return identified(asked, first, asked.moment)
    found = which(question, asked)
    match question.such:
        case Happens(Event(time=Between(begin, end))) if isinstance(found, Identified):
            return _at(found, begin, end)
    return found


def _at(found: Identified, begin: float, end: float) -> Identified:
    """Keep the one who did something at just that time: "which of them crossed last?"."""
    deeds = [f for f in found.facts if isinstance(f, Episode) and isinstance(f.actor, Vehicle)]
    exact = [e for e in deeds if (e.begin, e.end) == (begin, end)]
    if len(exact) != 1 or len(deeds) < 2:
        return found
    looks = tuple(x for x in found.looks if Vehicle(x.vehicle) == exact[0].actor)
    return replace(found, looks=looks, facts=(exact[0],))


def is_head(such: Proposition | None) -> bool:
    """Check whether the question is who is at the front of a queue."""
    match such:
        case Related(relation="on" | "ahead-of" | "near", thing=Wanted(), to=Feature("queue")):
            return True
    return False
