"""Owing: why we must let somebody go first, and the basis of that rule."""

from typing import Final, Literal, TypeAlias

from msgspec.structs import replace

from planner.record.places import RoadFacts
from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.answers import Answer, Priority
from xavi_dialogue.domain.facts import Look
from xavi_dialogue.domain.meaning import HowKnow, Why
from xavi_dialogue.domain.terms import Ego, Event, Happens, Proposition, Related, Vehicle, Vehicles
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.propositions import reasons
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import Window, is_past, window
from xavi_dialogue.explain.answers.reference.naming import number, somebodies
from xavi_dialogue.explain.answers.reference.reading import unwrapped
from xavi_dialogue.explain.answers.ride.priority import goes_first, priority_at, right_of_way

Grounds: TypeAlias = Literal["right", "across", "beside", "on-foot", "road"]
LETTING: Final = frozenset[ActionName](("wait", "give-way", "let-go"))
DUTIES: Final = frozenset(("must", "should"))
BESIDE: Final = 4.0  # [m] maximum sideways distance of somebody who drives along beside us
SOON: Final = 1.5  # [s] for which a rule that was read holds


def reason(asked: Asked, told: Priority) -> Priority:
    """Return a rule that holds now with its basis, if the road record shows it."""
    road = asked.world.road(asked.now)
    past = asked.now - told.time > SOON or told.first is not None
    if road is None or past or told.rule != "give-way" or told.vehicle is None:
        return told
    looks = (asked.world.look(v, asked.now) for v in (told.vehicle, *told.others))
    return replace(told, why=grounds(asked, road, tuple(x for x in looks if x is not None)))


def before_us(question: Why, asked: Asked) -> Answer:
    """Return the rule by which somebody goes first, and its basis.

    Raises:
        Unanswered: the vehicle is unknown, or the record does not hold the rule.
    """
    found = goes_first(question, asked)
    return reason(asked, found) if isinstance(found, Priority) else found


def is_owed(of: Proposition) -> bool:
    """Check whether a proposition says that we must let somebody named go first."""
    match of:
        case Happens(event=Event(actor=Ego(), action=action, modal=modal, object=other)):
            named = isinstance(other, Vehicle | Vehicles)
            return named and action in LETTING and modal in DUTIES
    return False


def must_let(event: Event, asked: Asked) -> bool:
    """Check whether the question is if we must let somebody go first, and by the rule we must."""
    vehicle = number(event.object)
    if not is_owed(Happens(event)) or event.tense != "present" or vehicle is None:
        return False
    return priority_at(asked, vehicle, Window(asked.now, asked.now)).rule == "give-way"


def is_rule(of: Proposition | None) -> bool:
    """Check whether a proposition says which of two has right of way."""
    plain, _ = unwrapped(of)
    return isinstance(plain, Related) and plain.relation in ("has-priority-over", "must-yield-to")


def asks_rule(question: Why | HowKnow) -> bool:
    """Check whether a question is about a rule; one how we know it also about "it gives way"."""
    known = isinstance(question, HowKnow) and _rule(question.of) is not None
    return known or is_rule(question.of)


def _rule(of: Proposition | None) -> Related | None:
    """Return the rule that a proposition states, also as "it gives way to us"."""
    plain, _ = unwrapped(of)
    match plain:
        case Related():
            return plain
        case Happens(Event("give-way", Vehicle() as who, None | Ego(), tense="present") as event):
            return Related("must-yield-to", who, Ego(), event.time)
    return None


def why_rule(question: Why | HowKnow, asked: Asked) -> Answer:
    """Return who has right of way, and the basis of that.

    Raises:
        Unanswered: a vehicle is unknown, or the record does not hold the rule.
    """
    of = _rule(question.of)
    assert of is not None
    told = right_of_way(asked, of.thing, of.to, window(asked, of.time, of.tense))
    told = reason(asked, told)
    return replace(told, grounds=told.why is None)


def why_owed(question: Why, asked: Asked) -> Answer:
    """Return the rule by which we must let somebody go first; without one, why we wait.

    Raises:
        Unanswered: a vehicle is unknown, we do not wait, or rollouts are needed.
    """
    assert isinstance(question.of, Happens)
    event = question.of.event
    others = tuple(n for v in somebodies(asked, event.object, asked.now) if (n := number(v)))
    past = is_past(asked, event.time, event.tense)
    about = window(asked, event.time, "past") if past else Window(asked.now, asked.now)
    told = [priority_at(asked, n, about) for n in others]
    owed = [one for one in told if one.rule == "give-way"]
    if not owed:
        return reasons.why(question, asked)
    rest = tuple(one.vehicle for one in owed[1:] if one.vehicle is not None)
    return reason(asked, replace(owed[0], others=rest))


def grounds(asked: Asked, road: RoadFacts, before: tuple[Look, ...]) -> Grounds | None:
    """Return why they go first: they walk, come from the right, or we turn."""
    if before and all(x.kind in ON_FOOT for x in before):
        return "on-foot"
    step = asked.world.junction(asked.now)
    if step is None or not before:
        return None
    if step.rule == "equal" and all(x.left < 0.0 and not x.oncoming for x in before):
        return "right"
    if step.turn == "exit-left" and step.kind == "junction" and all(x.oncoming for x in before):
        return "across"
    if step.turn == "exit-right" and all(-BESIDE < x.left < 0.0 and not x.oncoming for x in before):
        return "beside"
    from_sides = all(abs(x.left) > BESIDE and not x.oncoming for x in before)
    plain = step.rule == "give-way" and step.kind == "junction" and not road.lights
    return "road" if plain and from_sides else None
