"""Standing rules: who goes first at a crossing for people on foot, and to whom we gave way."""

from typing import Final

from msgspec.structs import replace

from planner.record.trace import ON_FOOT
from sim.scene import EGO
from xavi_dialogue.domain.answers import Answer, Priority, Verdict
from xavi_dialogue.domain.meaning import WhatIf, Whether
from xavi_dialogue.domain.terms import Ego, Event, Feature, Happens, Nobody, Proposition, Related
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.reference.naming import is_us, number
from xavi_dialogue.explain.answers.ride.priority import priority_at
from xavi_dialogue.explain.facts.episodes.waiting import top_holders

HALTING: Final = frozenset[ActionName](
    ("stop", "wait", "stand", "brake", "slow-down", "give-way", "let-go")
)


def at_crossing(of: Proposition | None) -> bool:
    """Check whether the question is if we must stop at a crossing for people on foot."""
    event = of.event if isinstance(of, Happens) else Event("happen")
    place = event.where.to if event.where is not None else event.object
    crossing = isinstance(place, Feature) and place.kind == "crossing"
    return crossing and _is_owed(Happens(event))


def whether(question: Whether, asked: Asked) -> Answer:
    """Return that we must stop for people who are on foot there now, else only for such people.

    Raises:
        Unanswered: the record does not hold the rule.
    """
    del question
    walker = _walker(asked)
    if walker is None:
        return _rule(asked, holds=False)
    return replace(priority_at(asked, walker, Window(asked.now, asked.now)), holds=True)


def supposes_walker(question: WhatIf) -> bool:
    """Check whether the question is if we must stop with somebody, or nobody, on a crossing."""
    if not isinstance(question.then, Whether) or not _is_owed(question.then.that):
        return False
    match question.supposed:
        case Happens(event=Event(action="cross" | "move", actor=Nobody())):
            return True
        case Related(relation="on" | "near", thing=Nobody()):
            return True
    return False


def supposed(question: WhatIf, asked: Asked) -> Answer:
    """Answer whether we must stop there, by the rule."""
    empty = isinstance(question.supposed, Related) and question.supposed.thing == Nobody()
    return _rule(asked, holds=not empty)


def ever_given(asked: Asked, event: Event) -> Finding:
    """Return to whom we gave way on the whole ride, as recorded; the rules are not considered."""
    kinds: tuple[ActionName, ...] = ("give-way", "let-go", "wait")
    given = asked.world.episodes(actor=Ego(), actions=kinds, end=asked.now)
    whom, those = number(event.object), tuple(e for e in given if number(e.object))
    held = tuple(e for e in those if whom in (None, number(e.object)))
    that = Happens(Event("give-way", object=event.object, time=event.time))
    return Finding(bool(held), answer=Verdict(that, bool(held), held or those[-2:]))


def _rule(asked: Asked, *, holds: bool) -> Priority:
    return Priority(asked.now, "give-way", walkers=True, holds=holds)


def _is_owed(of: Proposition) -> bool:
    """Check whether a proposition says that we must stop."""
    if not isinstance(of, Happens) or of.event.modal not in ("must", "should"):
        return False
    event = of.event
    return is_us(event.actor) and event.action in HALTING and event.tense == "present"


def _walker(asked: Asked) -> int | None:
    """Find somebody on foot who goes before us now."""
    held = top_holders(asked.world.states, asked.ride.latest, EGO)
    found = (v for v, how in held if how == "right-of-way")
    looks = ((v, asked.world.look(v, asked.now)) for v in found)
    return next((v for v, look in looks if look is not None and look.kind in ON_FOOT), None)
