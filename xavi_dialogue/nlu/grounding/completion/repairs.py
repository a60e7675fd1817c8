"""Repairs: answers to a clarification, and "no, I meant the other one"."""

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import Act, Ask, Claim, Elliptic, Feel, Repair, Request
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import Described, Event, Pronoun, Thing, Vehicle
from xavi_dialogue.nlu.grounding.completion.ellipsis import complete as ellipsis_of
from xavi_dialogue.nlu.grounding.completion.ellipsis import under_discussion
from xavi_dialogue.nlu.grounding.completion.replacing import with_thing
from xavi_dialogue.nlu.grounding.context import Grounder
from xavi_dialogue.nlu.grounding.things.looks import bearing_cost, colour_cost, kind_cost, size_cost
from xavi_dialogue.nlu.grounding.things.match import MISS
from xavi_dialogue.nlu.joining.apposition import guessed


def complete(spoken: Repair, g: Grounder) -> Act:
    """Complete a repair to the act that is meant; one that needs no completing stays as it is."""
    match spoken.kind:
        case "pick" | "yes" | "no":
            return _picked(spoken, g) or spoken
        case "correct" | "meant":
            return _meant(spoken, g) or spoken
    return spoken


def answers_clarification(spoken: Elliptic | Repair, g: Grounder) -> Act | None:
    """Take a fragment for the answer to an open clarification, where it can be one."""
    discourse = g.context.discourse
    if not (discourse.offered_things or discourse.offered):
        return None
    if isinstance(spoken, Elliptic) and spoken.form not in ("same", "which"):
        return None
    chosen = None if spoken.thing is None else _offered(spoken.thing, g)
    if chosen is not None:
        return chosen
    event = spoken.event if isinstance(spoken, Elliptic) else None
    if event is not None:
        return next((act for act in discourse.offered if _has(act, event)), None)
    return None


def _picked(spoken: Repair, g: Grounder) -> Act | None:
    discourse = g.context.discourse
    if spoken.thing is not None:
        found = answers_clarification(spoken, g)
        if found is not None:
            return found
    if spoken.pick is not None and not (discourse.offered or discourse.offered_things):
        if spoken.pick not in g.context.world.vehicles:
            guess = guessed(under_discussion(g), spoken.pick)  # "110?"
            if guess is not None:
                return guess
        return ellipsis_of(Elliptic(Vehicle(spoken.pick)), g) if spoken.pick > 0 else None
    if spoken.pick is not None:
        return _number(spoken.pick, g)
    if spoken.kind == "yes" and len(discourse.offered) == 1:
        return discourse.offered[0]
    if spoken.kind == "yes" and discourse.pending is not None and not discourse.offered:
        return discourse.pending
    if spoken.kind == "no" and len(discourse.offered) == 2:
        return None
    return _meant(spoken, g) if spoken.thing is not None or spoken.question else None


def _number(pick: int, g: Grounder) -> Act | None:
    discourse = g.context.discourse
    index = pick - 1 if pick > 0 else len(discourse.offered) + pick
    if 0 <= index < len(discourse.offered):
        return discourse.offered[index]
    if 0 <= index < len(discourse.offered_things):
        return _filled(discourse.offered_things[index], g)
    return None


def _offered(thing: Thing, g: Grounder) -> Act | None:
    """Find the offer that a thing names: by number, rank or looks."""
    discourse = g.context.discourse
    numbers = [t.number for t in discourse.offered_things if isinstance(t, Vehicle)]
    if isinstance(thing, Vehicle):
        return _of_vehicle(thing.number, numbers, g) if thing.number in numbers else None
    if not isinstance(thing, Described):
        return None
    if thing == Described(kind=thing.kind, rank=thing.rank, definite=thing.definite):
        return None if thing.rank is None else _number(thing.rank, g)
    fitting = [n for n in numbers if _fits(thing, n, g)]
    if thing.extreme is not None or (len(fitting) > 1 and thing.bearing is not None):
        fitting = sorted(
            fitting, key=lambda n: _distance(n, g), reverse=thing.extreme == "farthest"
        )
        fitting = fitting[:1]
    return _of_vehicle(fitting[0], numbers, g) if len(fitting) == 1 else None


def _distance(number: int, g: Grounder) -> float:
    look = g.context.look(number, g.context.now)
    return 1e4 if look is None else look.distance


def _fits(thing: Described, number: int, g: Grounder) -> bool:
    look = g.context.look(number, g.context.now)
    if look is None:
        return False
    costs = (
        kind_cost(thing.kind, look),
        colour_cost(thing.colour, look),
        size_cost(thing.size, look),
        bearing_cost(thing.bearing, look),
    )
    return sum(costs) < MISS


def _of_vehicle(number: int, numbers: list[int], g: Grounder) -> Act | None:
    offered = g.context.discourse.offered
    if len(offered) == len(numbers):
        return offered[numbers.index(number)]
    return _filled(Vehicle(number), g)


def _filled(thing: Thing, g: Grounder) -> Act | None:
    """Put the thing that was chosen into the act that waits for it."""
    pending = g.context.discourse.pending
    if pending is None:
        return None
    if first(pending, (Described, Pronoun)) is not None:
        return with_thing(pending, thing, g.context)
    return pending


def _has(act: Act, event: Event) -> bool:
    found = first(act, Event)
    return found is not None and (found.action, found.side) == (event.action, event.side)


def _meant(spoken: Repair, g: Grounder) -> Act | None:
    """Ask the question under discussion again with what is corrected."""
    if spoken.question is not None:
        return Ask(spoken.question)
    if spoken.thing is None:
        return None
    found = answers_clarification(spoken, g)
    if found is not None:
        return found
    thing = spoken.thing
    if isinstance(thing, Described) and thing.rank is None and thing.colour is None:
        thing = _other(thing, g)
    question = under_discussion(g)
    if question is not None:
        return Ask(with_thing(question, thing, g.context))
    for act in g.context.discourse.last_acts:
        if isinstance(act, Claim | Request | Feel):
            return with_thing(act, thing, g.context)
    return None


def _other(thing: Described, g: Grounder) -> Described:
    """Take a bare "the car", said to correct, for another one than was spoken of."""
    spoken = first(under_discussion(g), Vehicle)
    look = None if spoken is None else g.context.look(spoken.number, g.context.now)
    bare = thing == Described(kind=thing.kind, definite=thing.definite)
    if not bare or look is None or kind_cost(thing.kind, look) >= MISS:
        return thing
    return replace(thing, other=True)
