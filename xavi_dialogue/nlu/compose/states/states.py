"""States: clauses with "be" and no other verb."""

from dataclasses import replace
from typing import Any, cast

from xavi_dialogue.domain.terms import (
    Ago,
    Back,
    Caused,
    Compares,
    Described,
    Destination,
    Ego,
    Event,
    Everyone,
    Exists,
    Feature,
    Happens,
    Has,
    Is,
    Lane,
    Measured,
    Nobody,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Quantity,
    Related,
    Road,
    That,
    Thing,
    Together,
    Unsaid,
    Vehicle,
    Wanted,
    WholeRide,
)
from xavi_dialogue.nlu.compose.clauses.adoption import compared_times, with_fields
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.followers import relation_of
from xavi_dialogue.nlu.compose.clauses.risks import moving_in
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Sem, as_lane, as_thing, between, is_thing
from xavi_dialogue.nlu.compose.clauses.times import PAST
from xavi_dialogue.nlu.compose.clauses.tree import words_of
from xavi_dialogue.nlu.compose.states.existence import existing, from_whom
from xavi_dialogue.nlu.compose.states.pacing import pace_said
from xavi_dialogue.nlu.compose.states.placing import LOOSE, in_lane, placed
from xavi_dialogue.nlu.compose.states.positions import stuck_at
from xavi_dialogue.nlu.compose.states.predicates import UNITS, lights, nominal, tense_of
from xavi_dialogue.nlu.compose.states.rooms import roomy
from xavi_dialogue.nlu.compose.verbs.events import when
from xavi_dialogue.nlu.compose.verbs.trends import nearness

_NEGATED = {"illegal": "allowed", "unnecessary": "necessary", "impossible": "possible",
            "occupied": "free", "unsure": "sure", "absent": "present", "early": "late",
            "on-route": "astray"}  # fmt: skip
STATES = frozenset(
    ("safe", "dangerous", "comfortable", "uncomfortable", "allowed", "necessary", "possible",
     "free", "visible", "hidden", "stationary", "moving", "fast", "slow", "close", "far", "sure",
     "over", "late", "wrong", "right", "present", "lost", "astray", "stuck", "at-fault", "dirty",
     "big", "normal", "worth-it", "better", "faulty", "awake", "autonomous", "busy")
)  # fmt: skip
_COMPARED: dict[str, tuple[str, str]] = {
    "fast": ("speed", "more"), "slow": ("speed", "less"), "close": ("distance", "less"),
    "far": ("distance", "more"), "big": ("size", "more"), "small": ("size", "less"),
    "high": ("value", "more"), "low": ("value", "less"), "long": ("duration", "more"),
    "soon": ("arrival-time", "less"), "late": ("arrival-time", "more"),
    "safe": ("value", "more"), "better": ("value", "more"), "likely": ("probability", "more"),
}  # fmt: skip
_TURNS = frozenset({"turn", "exit-left", "exit-right"})
#: What is said of a deed by how it was done.
_MANNERS: dict[str, Any] = {"hard": "hard", "sudden": "suddenly"}
EARLIER = 5.0  # [s] that "before" is ago
BESIDE = 0.5  # cost of a pronoun beside an adjective: "that van is it broken" is a question
FOR_WHOM = 0.7  # cost of "for the bus" in "that is, for the bus, the lorry"
RUN_ON = 1.5  # cost of "did" and "was" in one clause
_SIDES = frozenset({"ahead", "behind", "left", "right", "beside"})
_PLACED = frozenset({"bearing-ahead", "bearing-behind", "bearing-left", "bearing-right"})
_APART = frozenset({"with", "to", "into", "from", "of"})  # what stands before whom we are near
Found = tuple[Proposition, float]


def _said_before(clause: Clause) -> Back | None:
    """Read "earlier" beside whom a vehicle is said to be as a time, no comparison."""
    named = clause.objects and isinstance(as_thing(clause.objects[0][0]), Described | Vehicle)
    soon = [key for key, _ in clause.comparisons] == ["soon"]
    return Back("earlier") if soon and named and clause.than is None else None


def state_of(clause: Clause) -> list[Found]:
    """Compose a clause without a verb; several readings at their costs."""
    bearing = clause.bearings[0][0] if clause.bearings else None
    said = clause.comparisons or clause.adjectives
    if said and isinstance(together := as_thing(clause.subject), Together):
        clause.subject = together  # "are the blue and the red one slower than us"
    if (earlier := _said_before(clause)) is not None:
        clause.comparisons, clause.time = [], earlier
    spoken = clause.subject
    judged = said or not {"close", "far"}.isdisjoint(clause.manner)
    where = next((c for c in clause.complements if c.key in _PLACED), None) if judged else None
    if where is not None and isinstance(spoken, Described) and as_thing(where.sem) == Ego():
        clause.complements.remove(where)  # "is the lorry behind us still standing"
        bearing = where.key.removeprefix("bearing-")
    if isinstance(spoken, Described) and spoken.bearing is None and judged and bearing in _SIDES:
        clause.subject = with_fields(spoken, bearing=bearing)  # "is that car behind as fast?"
    extra = ungoverned(clause) - 0.12
    if clause.has("do") and "be-past" in clause.aux:
        extra += RUN_ON  # "why did that car brake was it for us"
    return [(Not(p) if clause.negated else p, cost + extra) for p, cost in _found(clause)]


def ungoverned(clause: Clause) -> float:
    """Say what the clauses inside cost that a clause without a verb cannot govern."""
    prices = ((clause.question, 1.2), (clause.bare, 0.9), (clause.that, 0.5), (clause.gerund, 0.3))
    objects = 0.9 * max(0, len(clause.objects) - 1)
    loose = LOOSE * len(clause.particles)
    return sum(price for inner, price in prices if inner is not None) + objects + loose


def _found(clause: Clause) -> list[Found]:
    if clause.there:
        return _compared_there(clause, existing(clause))
    subject = clause.subject
    if clause.feelings and _feels(subject):
        who = as_thing(subject)
        return [(Is("upset", who, time=clause.time, tense=tense_of(clause)), -0.1)]
    for key, degree in clause.adjectives:
        if key == "wavering" and isinstance(subject, Ego | Pronoun):
            return [(Happens(Event("change-plan", time=clause.time, tense=tense_of(clause))), 0.0)]
        if key in _MANNERS and isinstance(subject, Event):
            hard = (*subject.manner, _MANNERS[key])
            deed = with_fields(subject, manner=hard, time=clause.time, tense=tense_of(clause))
            return [(Happens(deed), 0.0)]  # "was that braking hard?"
        if key == "raining" and isinstance(subject, Pronoun | Road | None):  # "is it icy?"
            return [(Has("weather", "bad", time=clause.time, tense=tense_of(clause)), 0.0)]
        if key == "over" and bearing_here(clause):
            who = as_thing(subject) or Ego()
            return [(Happens(Event("keep-lane", who, tense=tense_of(clause))), 0.0)]
        if key in _MANNERS and isinstance(subject, Pronoun):
            return [(_is(clause, "uncomfortable", degree == "too"), 0.0)]  # "that was sudden"
        if key in STATES or key in _NEGATED:
            beside = any(isinstance(sem, Pronoun) for sem, _ in clause.objects)
            cost = BESIDE * (beside + bool(clause.comparisons))  # "are you not moving faster?"
            return in_lane(clause, key) or [(_is(clause, key, degree == "too"), cost)]
    if clause.comparisons and (clause.comparisons[0][1] != "as" or clause.than is not None):
        compared = _compares(clause)
        if compared is not None:
            return [(compared, 0.0)]
    if "first" in clause.manner and is_thing(subject):
        return [(Is("first", as_thing(subject), time=clause.time, tense=tense_of(clause)), 0.0)]
    if any(words_of(c.node).startswith("close to") for c in clause.complements):
        return placed(clause)  # "that was a bit close to the van"
    for manner, state in (("fast", "fast"), ("slowly", "slow"), ("safely", "safe"),
                          ("gently", "comfortable"), ("hard", "uncomfortable"),
                          ("suddenly", "uncomfortable"), ("close", "close"), ("late", "late"),
                          ("early", "late"), ("far", "far")):  # fmt: skip
        hurried = manner == "suddenly" and isinstance(subject, Passenger | Ego)  # "in a hurry"
        timed = isinstance(subject, Event) and not clause.has("be")  # "why brake this early?"
        open_ = not (clause.objects or isinstance(subject, Measure) or hurried or timed)
        if manner in clause.manner and open_:
            return [(_is(clause, state, "too" in clause.focus), 0.05)]
    if isinstance(subject, Measure) and subject.of.attribute in ("brake-lights", "indicator"):
        return lights(clause, subject)
    if clause.objects:
        vague = isinstance(subject, Pronoun) and any(c.key == "for" for c in clause.complements)
        found = nominal(clause, clause.objects[0][0])
        vague = vague and not any(isinstance(getattr(of, "thing", 0), Feature) for of, _ in found)
        return [(of, cost + FOR_WHOM) for of, cost in found] if vague else found
    if is_thing(subject) and (said := pace_said(clause)) is not None:  # "we are down to 30"
        who = cast(Thing, as_thing(subject))
        return [(Compares(Measured("speed", who, time=clause.time, tense=tense_of(clause)),
                          "same", said), 0.0)]  # fmt: skip
    if clause.because is not None and isinstance(subject, Pronoun):
        cause = None if isinstance(clause.because, Clause) else as_thing(clause.because)
        return [(Caused(cause) if cause is not None else That(), 0.0)]
    return placed(clause)


def _compared_there(clause: Clause, found: list[Found]) -> list[Found]:
    """Add to whom there is how he compares: "is there anyone slower than us"."""
    if not clause.comparisons:
        return found
    such = _compares(replace(clause, subject=Wanted()))
    return [
        (with_fields(of, thing=with_fields(of.thing, such=such)), cost)
        if isinstance(of, Exists) and isinstance(of.thing, Described) and of.thing.such is None
        else (of, cost)
        for of, cost in found
    ]


def bearing_here(clause: Clause) -> bool:
    """Say whether it is said of where one is: "over here", "out there"."""
    return any(bearing in ("here", "there") for bearing, _ in clause.bearings)


def subject_event(clause: Clause) -> Event | None:
    """Find the event that is said to be so: the subject, or "to swerve"."""
    if isinstance(clause.subject, Event):
        return clause.subject
    return None


def _feels(sem: Sem | None) -> bool:
    """Say whether somebody else is meant who may feel something."""
    spoken = isinstance(sem, Pronoun) and sem.form in ("he", "she", "they", "who", "them-all")
    return spoken or isinstance(sem, Described | Vehicle | Nobody | Everyone | Wanted)


def _is(clause: Clause, key: str, too: bool) -> Proposition:
    state = _NEGATED.get(key, key)
    event = subject_event(clause)
    inner = clause.inner
    thing = as_thing(clause.subject) if event is None else None
    if state in ("free", "busy"):
        thing = thing or as_lane(clause.subject)
    if isinstance(clause.subject, Measure):
        thing = clause.subject.of.thing
        if state == "big" and clause.subject.of.attribute in ("gap", "distance"):
            return roomy(clause, clause.time)  # "was the gap big enough"
    spoken = isinstance(thing, Pronoun) and thing.form in ("that", "this", "it")
    if spoken and state == "free":
        thing = _free_place(clause) or thing
    if isinstance(thing, Pronoun) and (inner is not None or (spoken and state == "allowed")):
        thing = None
    bend = any(c.key == "for" and isinstance(c.sem, Feature) for c in clause.complements)
    if state in ("fast", "slow") and isinstance(thing, Pronoun) and bend:
        thing = Ego()  # "was it not too fast for this curve?"
    if state in ("close", "far") and isinstance(thing, Pronoun | Ego):
        thing = _near_what(clause, thing)
    if state in ("dangerous", "safe") and isinstance(thing, Ego | Passenger | Pronoun):
        thing = from_whom(clause) or thing
    if state in ("dangerous", "safe") and inner is None and event is None:
        inner = moving_in(clause, thing)  # "is it safe on the left?"
        thing = thing if inner is None else None
    bearing = next((c for c in clause.complements if c.key.startswith("bearing-")), None)
    beside = None if bearing is None else as_thing(bearing.sem)
    if state in ("close", "far") and thing == Ego() and isinstance(beside, Described | Vehicle):
        thing = beside  # "we are very close to that car"
    time, tense = when(clause, None), tense_of(clause)
    if "ever" in clause.focus and isinstance(time, Unsaid) and tense != "present":
        time = WholeRide()  # "was it ever close?"
    if state == "stuck" and (held := stuck_at(clause, thing)) is not None:
        return held
    found: Proposition = Is(cast(Any, state), thing, event or inner, too, time, tense)
    if bearing is not None and state in ("close", "stuck", "stationary"):
        to = as_thing(bearing.sem) or Ego()
        side = relation_of(bearing.key.removeprefix("bearing-"))
        if state == "stuck" and side == "behind" and thing is not None:
            return Happens(Event("follow", thing, to, time=clause.time, tense=tense_of(clause)))
        if state != "close":
            return Related(cast(Any, side), cast(Thing, thing), to, clause.time, tense_of(clause))
    return Not(found, lexical=True) if key in _NEGATED else found


def _free_place(clause: Clause) -> Thing | None:
    """Tell what is free where "it is clear on the left", "is it clear ahead?" is said."""
    for bearing, _ in clause.bearings:
        if bearing in ("left", "right"):
            return Lane(cast(Any, bearing))
        if bearing == "ahead":
            return Road()
    return None


def _near_what(clause: Clause, thing: Thing) -> Thing:
    """Tell what "that was close with the car" and "is it still far" are said of."""
    for phrase in clause.complements:
        if phrase.key == "between" and (pair := between(phrase.sem)) is not None:
            return pair[0]  # "was it close between the two?"
        other = as_thing(phrase.sem)
        if phrase.key in _APART and isinstance(other, (Described, Vehicle)):
            return other
        if phrase.key == "into" and isinstance(other, (Described, Vehicle, Pronoun, Feature)):
            return other  # "is it far to the light?"
    return Destination() if clause.still and not clause.bearings else thing


def _compares(clause: Clause) -> Proposition | None:
    key, words = clause.comparisons[0]
    if words.startswith("no "):
        positive = _compares(replace(clause, comparisons=[(key, words.removeprefix("no "))]))
        return None if positive is None else Not(positive)
    sem = clause.subject
    if key in _COMPARED and isinstance(sem, Measure) and isinstance(clause.than, Quantity):
        of = cast(Measured, with_fields(sem.of, time=clause.time, tense=tense_of(clause)))
        return Compares(of, cast(Any, _COMPARED[key][1]), clause.than)  # "is the gap under 10 m"
    if key not in _COMPARED or not is_thing(clause.subject):
        return None
    attribute, direction = _COMPARED[key]
    if attribute == "value" and isinstance(clause.than, Quantity):
        attribute = UNITS.get(clause.than.unit, attribute)
    left = Measured(cast(Any, attribute), cast(Thing, clause.subject), time=clause.time,
                    tense=tense_of(clause))  # fmt: skip
    right: Any = None
    like = next((as_thing(c.sem) for c in clause.complements if c.key == "like"), None)
    if clause.than is None and like is not None:  # "he is faster like us"
        right = Measured(cast(Any, attribute), like, time=clause.time, tense=tense_of(clause))
    if clause.than is None and clause.time in PAST and attribute in ("speed", "distance"):
        opposite = {"more": "less", "less": "more"}.get(direction, direction)
        now = replace(clause, time=Unsaid(), than_time=Ago(EARLIER), aux=["be-present"])
        return compared_times(now, attribute, opposite, left.thing)  # "was it closer before?"
    if not isinstance(clause.than_time, Unsaid):
        return compared_times(clause, attribute, direction, left.thing)
    if isinstance(clause.than, Quantity):
        right = clause.than
        left = nearness(clause, left)
    elif clause.than is not None and not isinstance(clause.than, Clause):
        thing = as_thing(clause.than)
        if isinstance(clause.than, Measure):
            right = clause.than.of
        elif thing is not None:
            right = Measured(cast(Any, attribute), thing, time=clause.time, tense=tense_of(clause))
    if words == "as":
        direction = "same"
    if words.startswith(("less ", "worse")):
        direction = {"more": "less", "less": "more"}[direction]
    return Compares(left, cast(Any, direction), right)
