"""Freed: consequences of a vehicle's absence for us, and for another one that waits for it."""

from xavi_dialogue.domain.answers import Answer
from xavi_dialogue.domain.meaning import HowMuch, Question, Whether
from xavi_dialogue.domain.terms import Event, Happens, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reasons import others
from xavi_dialogue.explain.answers.reference.asked import Asked

WAITING = frozenset[ActionName](("wait", "give-way", "stand", "stop", "let-go", "brake"))


def freed(then: Question | None, without: int | None, scene: Asked) -> Answer | None:
    """Return who a vehicle waited for, if that one is supposed to be absent; else None.

    Raises:
        Unanswered: rollouts are needed.
    """
    that = then.that if isinstance(then, Whether) else None
    event = that.event if isinstance(that, Happens) else None
    if event is None or event.action not in WAITING or without is None:
        return None
    waits = scene.world.episodes(event.actor, ("give-way", "wait"), object=Vehicle(without))
    if not waits:
        return None
    over = waits[-1].end is not None
    told = Event("give-way", event.actor, tense="past" if over else "present")
    return others.why(told, scene, negated=False)


def asks_pace(then: Question | None) -> bool:
    """Check whether the question is how much faster we could go, for our speed and the limit."""
    event = then.of.event if isinstance(then, HowMuch) else None
    return event is not None and event.action in ("go", "move") and event.modal == "could"
