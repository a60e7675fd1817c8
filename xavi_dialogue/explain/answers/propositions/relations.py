"""Relations: whether two things stand, stood or ever stood in a relation."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Verdict
from xavi_dialogue.domain.facts import Fact, Look, Relating
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Everyone,
    Exists,
    Happens,
    Related,
    Road,
    Thing,
    Unsaid,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.domain.vocabulary import Attribute, Relation
from xavi_dialogue.explain.answers.events.happens import happens
from xavi_dialogue.explain.answers.propositions.duties import owed_to_all
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding, known, unknown
from xavi_dialogue.explain.answers.reference.moments import SHORT, Window, is_past, window
from xavi_dialogue.explain.answers.reference.naming import is_us, looks, number, somebodies
from xavi_dialogue.explain.answers.ride.cycling import likely_let
from xavi_dialogue.explain.answers.ride.priority import owed, right_of_way, where_rule_holds
from xavi_dialogue.explain.answers.ride.reaching import on_our_way
from xavi_dialogue.explain.answers.sight.sight import others_mind
from xavi_dialogue.explain.causes.vehicles.actions import EXITS
from xavi_dialogue.explain.history.ride import planned

BODY = 1.5  # [m] minimum that somebody between two others takes up
LATELY = 10.0  # [s] after a turn, up to which it shows that somebody goes our way
STEP = 0.5  # [s] between the times at which a relation is checked over a stretch
COMPARING: dict[Relation, Attribute] = {
    "faster-than": "speed", "slower-than": "speed", "closer-than": "distance",
    "near": "distance",
}  # fmt: skip
SIDES: frozenset[Relation] = frozenset(
    ("ahead-of", "behind", "left-of", "right-of", "beside", "near", "oncoming-to", "between",
     "in-the-way-of", "on", "from", "to", "with")
)  # fmt: skip


def related(of: Related, asked: Asked) -> Finding:
    """Weigh that two things stand in a relation.

    Raises:
        Unanswered: a vehicle was never seen.
    """
    about = window(asked, of.time, of.tense)
    if of.relation in ("has-priority-over", "must-yield-to"):
        return _right_of_way(of, asked, about)
    other = number(of.thing) or number(of.to)
    road = of.to.which if isinstance(of.to, Road) and of.relation in ("on", "from") else None
    if road in ("main", "side") and other is not None:
        first: Relation = "has-priority-over" if road == "main" else "must-yield-to"
        return _right_of_way(replace(of, relation=first, to=Ego()), asked, about)
    if road == "fitting" and is_us(of.thing):
        return on_our_way(asked)
    if of.relation == "waiting-for":
        return _waiting(of, asked)
    seer = number(of.thing)
    if of.relation == "can-see" and seer is not None:
        return others_mind(asked, seer)
    if of.relation == "can-see" and isinstance(of.thing, Vehicles | Everyone):
        return unknown("others-thoughts")
    if of.relation == "can-see" and is_us(of.thing) and number(of.to) is not None:
        seeing = Event("see", of.thing, of.to, time=of.time, tense=of.tense)
        return happens(Happens(seeing), asked)
    if of.relation == "can-see" and is_us(of.thing) and isinstance(of.to, Vehicles):
        seen = tuple(x for x in looks(asked, of.to.numbers, asked.now) if x.in_view)
        if len(seen) == len(of.to.numbers):  # "have you noticed both?"
            return Finding(True, answer=Verdict(Exists(of.to), True, seen))
    if of.relation == "same-as":
        one, other = number(of.thing), number(of.to)
        both = somebodies(asked, of.thing, about.end) + somebodies(asked, of.to, about.end)
        numbers = dict.fromkeys(v.number for v in both if isinstance(v, Vehicle))
        seen = looks(asked, tuple(numbers), about.end)
        return Finding(one == other, seen)
    if of.relation == "between" and isinstance(of.to, Vehicles):
        return _in_the_middle(of, asked, of.to.numbers, about.end)
    found = [_between(of, asked, thing, to, about) for thing in _each(asked, of.thing, about.end)
             for to in _each(asked, of.to, about.end)]  # fmt: skip
    true = next((one for one in found if one.holds), None)
    return true or next((one for one in found if one.holds is None), found[0])


def holds_over(
    asked: Asked, relation: Relation, thing: Thing, to: Thing, about: Window
) -> tuple[bool | None, float]:
    """Check whether a relation held at any time in a stretch, and when [s]."""
    if about.instant:
        return asked.world.relation(relation, thing, to, about.middle), about.middle
    answers: list[bool | None] = []
    at = about.end
    while at >= about.begin - 1e-6:
        found = asked.world.relation(relation, thing, to, at)
        if found:
            return True, at
        answers.append(found)
        at -= STEP
    return (None if all(a is None for a in answers) else False), about.end


def _between(of: Related, asked: Asked, thing: Thing, to: Thing, about: Window) -> Finding:
    near = about if is_past(asked, of.time, of.tense) else Window(asked.now, asked.now)
    if of.relation == "with" and isinstance(of.time, Unsaid):
        near = Window(asked.now, asked.now)  # one who came with us is with us
    holds, at = holds_over(asked, of.relation, thing, to, near)
    facts = _facts(of, asked, thing, to, at)
    if holds is False and of.relation == "with" and is_us(to):
        holds = _went_our_way(asked, thing)
    if holds is False and is_us(to) and of.relation == "in-the-way-of" and of.tense == "future":
        holds = likely_let(asked, number(thing))  # who is on foot or on a bicycle counts as well
    if holds is False and is_us(to) and of.relation in ("behind", "ahead-of"):
        side = "behind" if of.relation == "behind" else "ahead"
        holds = any(isinstance(f, Look) and f.bearing.startswith(side) for f in facts)
    if holds is None:
        lost = any(look.in_view is False for look in facts if hasattr(look, "in_view"))
        return unknown("out-of-view" if lost else "not-recorded", *facts)
    return Finding(holds, (Relating(of.relation, thing, to, at, holds), *facts))


def _in_the_middle(of: Related, asked: Asked, sides: tuple[int, ...], at: float) -> Finding:
    """Weigh that a vehicle is between two others: the way past it is no longer."""
    one, other = Vehicle(sides[0]), Vehicle(sides[-1])
    pairs = ((one, of.thing), (of.thing, other), (one, other))
    found = [asked.world.measure("distance", a, at, b) for a, b in pairs]
    near, far, apart = (measure.value for measure in found)
    if of.thing in (one, other):
        return Finding(False)
    if near is None or far is None or apart is None:
        return unknown("out-of-view")
    seen = tuple(n for n in (number(of.thing),) if n is not None)
    return Finding(near + far <= apart - BODY, looks(asked, seen, at))


def _facts(of: Related, asked: Asked, thing: Thing, to: Thing, at: float) -> tuple[Fact, ...]:
    """Return facts that show how two things relate: their looks, or the values compared."""
    attribute = COMPARING.get(of.relation)
    if attribute == "speed":
        speeds = (asked.world.measure("speed", one, at) for one in (thing, to))
        return known(*speeds)
    numbers = tuple(n for one in (thing, to) if (n := number(one)) is not None)
    seen: tuple[Fact, ...] = looks(asked, numbers, at)
    if attribute == "distance" and numbers:
        return (*seen, *known(asked.world.measure("distance", Ego(), at, Vehicle(numbers[0]))))
    return seen


def _went_our_way(asked: Asked, thing: Thing) -> bool:
    """Check whether somebody has just made the turn that we are going to make."""
    ours = next((action for action in planned(asked.ride.latest) if action in EXITS), None)
    if ours is None or not isinstance(thing, Vehicle):
        return False
    made = asked.world.episodes(thing, (ours,), begin=asked.now - LATELY)
    return any(episode.action == ours for episode in made)


def _right_of_way(of: Related, asked: Asked, about: Window) -> Finding:
    """Return who goes first as right of way, whichever way round the question is."""
    ours = is_us(of.thing) == (of.relation == "has-priority-over")
    past = is_past(asked, of.time, of.tense)
    near = where_rule_holds(asked, about) if past else Window(asked.now, asked.now)
    several = of.thing if isinstance(of.thing, Vehicles) else of.to
    if isinstance(several, Vehicles):
        return owed_to_all(asked, several.numbers, near, ours=not ours)
    found = right_of_way(asked, of.thing, of.to, near)
    if found.rule == "none" and ours:  # "do we fit in before it gets here?"
        return Finding(None, answer=found)
    return owed(found, ours_yield=not ours)


def _waiting(of: Related, asked: Asked) -> Finding:
    """Weigh that somebody waits for another: by an episode, else by the relation."""
    event = Event("wait", of.thing, of.to, time=of.time, tense=of.tense)
    found = happens(Happens(event), asked)
    if found.holds or number(of.thing) is None:
        return found
    near = window(asked, of.time, of.tense)
    at = near.end if near.end <= asked.now - SHORT else asked.now
    holds = asked.world.relation("waiting-for", of.thing, of.to, at)
    moving = known(asked.world.measure("speed", of.thing, at))
    if holds is None and not moving:
        return found
    return Finding(bool(holds), (*moving, *found.facts[:1]), found.gap if holds is None else None)


def _each(asked: Asked, thing: Thing, at: float) -> tuple[Thing, ...]:
    return somebodies(asked, thing, at) or (thing,)
