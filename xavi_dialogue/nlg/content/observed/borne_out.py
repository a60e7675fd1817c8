"""Facts of verdicts: those that are stated with a verdict, or that say the same as it."""

from xavi_dialogue.domain import terms
from xavi_dialogue.domain.answers import Verdict
from xavi_dialogue.domain.facts import Belief, Episode, Fact, Look, Measure, Relating
from xavi_dialogue.domain.terms import (
    Believed,
    Compares,
    Event,
    Has,
    Is,
    Not,
    Proposition,
    Related,
    Vehicle,
)
from xavi_dialogue.nlg.content.clauses.measures import STANDING
from xavi_dialogue.nlg.content.clauses.propositions import PLACES, eventful
from xavi_dialogue.nlg.context import SpeechContext

#: First part of the bearing that goes with a relation to us.
_BEARINGS = {"ahead-of": "ahead", "behind": "behind", "beside": "beside", "oncoming-to": "oncoming",
             "left-of": "left", "right-of": "right"}  # fmt: skip
TELLING = frozenset(("brake", "slow-down", "speed-up"))


def telling(answer: Verdict) -> tuple[Fact, ...]:
    """Return the facts that add something to the verdict; for places, looks come first."""
    that, event = bare(answer.that), eventful(answer.that)
    holds = answer.holds != isinstance(answer.that, Not)
    placed = isinstance(that, Related) and that.relation in PLACES
    facts: list[Fact] = []
    for fact in answer.facts:
        if isinstance(fact, Relating) and isinstance(that, Related):
            same = (fact.relation, fact.thing, fact.to) == (that.relation, that.thing, that.to)
            if same and fact.holds == holds:
                continue
        if _said_by_other(fact, answer.facts) or _said_by_verdict(fact, answer):
            continue
        asked = event is not None and event.action == "change-plan"
        if isinstance(fact, Episode) and fact.action == "change-plan" and not asked:
            continue
        facts.append(fact)
    if placed:
        facts.sort(key=lambda f: not isinstance(f, Look))
    return tuple(facts)


def _said_by_other(fact: Fact, facts: tuple[Fact, ...]) -> bool:
    """Check whether another fact implies a speed (standing, a change of speed) or a moving."""
    if isinstance(fact, Measure) and fact.attribute == "speed":
        thing = fact.thing
        deeds = [f for f in facts if isinstance(f, Episode) and f.actor == thing]
        stands = (fact.value or 0.0) < STANDING
        if stands and any(f.action in ("stand", "stop", "wait", "give-way") for f in deeds):
            return True
        return any(f.action in TELLING and f.speed_to is not None for f in deeds)
    if isinstance(fact, Episode) and fact.action in ("go", "move"):
        return any(
            isinstance(f, Episode) and f.actor == fact.actor and f.action == "speed-up"
            for f in facts
        )
    return False


def _said_by_verdict(fact: Fact, answer: Verdict) -> bool:
    """Check whether a fact repeats a verdict that something stands still."""
    that = bare(answer.that)
    if not isinstance(that, Is):
        return False
    if isinstance(fact, Episode) and fact.action in ("stop", "stand"):
        return that.state == "stationary" and fact.end is None and bool(answer.holds)
    if not isinstance(fact, Measure) or fact.attribute != "speed":
        return False
    still = that.state == "stationary" and answer.holds != isinstance(answer.that, Not)
    return still and fact.value is not None and fact.value < STANDING


def bare(that: Proposition) -> Proposition:
    """Return a proposition without its negations."""
    return bare(that.content) if isinstance(that, Not) else that


def tells_it(answer: Verdict, context: SpeechContext) -> bool:
    """Check whether the first fact alone says what the verdict says."""
    if not answer.facts:
        return False
    fact, event = answer.facts[0], eventful(answer.that)
    if not answer.holds:
        did = isinstance(answer.that, Not) and isinstance(fact, Episode) and event is not None
        if did and isinstance(fact, Episode) and event is not None:
            return fact.actor == event.actor and _alike(fact, event)
        return _other_value(answer.that, fact)
    if isinstance(answer.that, Not):
        return False
    if isinstance(fact, Episode) and event is not None:
        return fact.actor == event.actor and _alike(fact, event)
    if isinstance(fact, Measure):
        that = answer.that
        if isinstance(that, Compares):
            return _other_value(that, fact)
        return isinstance(that, Has) and that.attribute == fact.attribute
    if isinstance(fact, Look):
        that = answer.that
        if not isinstance(that, Related) or that.thing != Vehicle(fact.vehicle):
            return False
        return fact.bearing.startswith(_BEARINGS.get(that.relation, "?"))
    if isinstance(fact, Belief):
        return isinstance(answer.that, Believed)
    return isinstance(fact, Relating)


def within_limit(answer: Verdict) -> Measure | None:
    """Return the speed with its limit, if a verdict on allowed, fast or slow depends on it."""
    that = bare(answer.that)
    if not isinstance(that, Is) or that.state not in ("allowed", "fast", "slow"):
        return None
    speeds = (f for f in answer.facts if isinstance(f, Measure) and f.attribute == "speed")
    return next((m for m in speeds if m.reference is not None and m.value is not None), None)


def _other_value(that: Proposition, fact: Fact) -> bool:
    """Check whether a fact is the actual value of what a proposition compares or ascribes."""
    if isinstance(that, Compares) and isinstance(fact, Measure):
        number = isinstance(that.right, terms.Quantity)
        return number and (that.left.attribute, that.left.thing) == (fact.attribute, fact.thing)
    if isinstance(that, Has) and isinstance(fact, Measure):
        return that.attribute == fact.attribute and that.thing == fact.thing
    return False


def _alike(episode: Episode, event: Event) -> bool:
    """Check whether an episode, in its own words, affirms an event."""
    place = isinstance(event.object, terms.Junction)
    if event.object is not None and not place and event.object != episode.object:
        return False
    if event.action == "leave" and place and episode.action.startswith("exit-"):
        return episode.place is not None and episode.place.form == "roundabout"
    return episode.action == event.action or (
        event.action in ("turn", "change-lane") and event.side == episode.side
    )
