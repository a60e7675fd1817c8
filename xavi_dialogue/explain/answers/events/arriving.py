"""Arriving: whether we have arrived, nearly have, or will."""

from xavi_dialogue.domain.answers import Course
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event
from xavi_dialogue.explain.answers.expectations.plans import foreseen
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.reference.moments import is_ahead
from xavi_dialogue.explain.answers.ride.places import to_go, told

NEARLY = 10.0  # [s] before arrival in which we are nearly there
AT_HAND = 150.0  # [m] maximum distance at which we are nearly there


def arrived(asked: Asked, event: Event) -> Finding:
    """Check whether we have arrived, or are going to."""
    if is_ahead(asked, event.time, event.tense) and not asked.ride.arrived:
        found = foreseen(asked, event)
        facts = told(to_go(asked, asked.now))
        way = all(fact.gap != "no-way" for fact in facts)
        comes = way and (found is None or found.share >= 0.5)
        return Finding(comes, facts if way else facts[:1])
    if asked.ride.arrived:
        time = next(e.sim_time for e in asked.ride.events if e.kind == "arrived")
        return Finding(True, (Episode(Ego(), "arrive", time, time),))
    facts = told(to_go(asked, asked.now))
    soon = next((m.value for m in facts if m.attribute == "time-to-go"), None)
    left = next((m.value for m in facts if m.attribute == "distance-to-go"), None)
    if soon is not None and soon <= NEARLY and (left or 0.0) <= AT_HAND:
        return Finding(None, facts, answer=Course("nearly", (), left=left, soon=soon))
    return Finding(False, facts)
