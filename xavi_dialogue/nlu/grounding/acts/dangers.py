"""Dangers: from whom, where it is asked whether we were in danger, or safe."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import HowMuch, Why
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    Ago,
    Described,
    Ego,
    Event,
    Is,
    Not,
    Passenger,
    Pronoun,
    Relative,
    Thing,
    Unknown,
    Unsaid,
    Vehicle,
    WholeRide,
)
from xavi_dialogue.nlu.grounding.completion.discussion import events
from xavi_dialogue.nlu.grounding.context import Grounder, Mode
from xavi_dialogue.nlu.grounding.salience import FRESH, vehicles_of

STATES: Final = frozenset(("dangerous", "safe"))
COMFORT: Final = frozenset(("comfortable", "uncomfortable"))
PERILS: Final = STATES | {"close"}
RIDES: Final = ("ride", "trip", "journey", "drive")
SPOKEN: Final = 0.85  # salience from which a vehicle is the one that the turn before was about
LATELY: Final = 8.0  # [s] since that turn
NEAR: Final = 12.0  # [m] up to which it may have been a danger
_VAGUE: Final = ("it", "that", "this")


def threatened(spoken: Is, g: Grounder) -> Is:
    """Put in from whom: of the clause that says when, of the same breath, or spoken of just now.

    "Were we in danger when he came past?", "It shot across. Were we in danger just then?"
    """
    if isinstance(spoken.thing, Unknown) and spoken.thing.words in RIDES:
        whole = spoken.state in STATES | COMFORT
        return replace(spoken, thing=None, time=WholeRide()) if whole else spoken
    if spoken.state not in STATES | {"worth-it", "wrong"} or spoken.event is not None:
        return spoken
    option = g.context.discourse.option
    if option is not None and spoken.tense == "present" and _is_vague(spoken.thing):
        g.notes.leaned = True
        state = "dangerous" if spoken.state == "wrong" else spoken.state
        return replace(spoken, state=state, thing=None, event=option)
    if spoken.state not in STATES:
        return spoken
    if spoken.thing == Described(definite=False):
        return replace(spoken, thing=None)  # "was anything dangerous?"
    if not _of_us(spoken):
        return spoken
    match spoken.time:
        case Relative(relation="during", anchor=Event(actor=Described() | Pronoun() as whom)):
            return replace(spoken, thing=whom)
        case Unsaid() | Ago(seconds=None) | WholeRide() if spoken.tense == "past":
            known = spoken_of(g)
            return spoken if known is None else replace(spoken, thing=known)
    return spoken


def mode_of(event: Event, spoken: Is) -> Mode:
    """Tell what is taken for granted of an event in a state: what we may do now is made up."""
    if event.tense == "past":
        return "presupposed"
    weighed = spoken.state in STATES and event.actor == Ego() and event.tense == "present"
    return "supposed" if weighed else "asked"


def _is_vague(thing: Thing | None) -> bool:
    """Tell whether it is said of nothing, or of what was spoken of."""
    return thing is None or (isinstance(thing, Pronoun) and thing.form in _VAGUE)


def _of_us(spoken: Is) -> bool:
    """Tell whether it is said of us, or of nothing but what happened then."""
    if isinstance(spoken.thing, Pronoun):
        return _is_vague(spoken.thing) and isinstance(spoken.time, Relative | WholeRide)
    return isinstance(spoken.thing, Ego | Passenger)


def spoken_of(g: Grounder) -> Vehicle | None:
    """Find the vehicle of the same breath, or that of the turn before which came near us."""
    context = g.context
    found = vehicles_of(context.discourse.mentions)
    if not found:
        return None
    vehicle, salience = found[0]
    if salience >= FRESH:
        return Vehicle(vehicle)
    recent = _is_recent(g)
    look = context.look(vehicle, context.now)
    near = look is not None and look.distance <= NEAR
    return Vehicle(vehicle) if recent and near and salience >= SPOKEN * 0.6 else None


def fresh_event(g: Grounder) -> Event | None:
    """Give the event that the turn before was about; None where that is too long ago for "that"."""
    discourse = g.context.discourse
    if isinstance(discourse.question, HowMuch) and first(discourse.question, Event) is None:
        return None  # it was about a figure: "how close did we get? - was that dangerous?"
    return next(events(discourse, real=True), None) if _is_recent(g) else None


def _is_recent(g: Grounder) -> bool:
    asked = g.context.discourse.asked_at
    return asked is not None and g.context.now - asked <= LATELY


def is_of_undone(spoken: Is, g: Grounder) -> bool:
    """Tell whether it is said of now after what we do not do: "why don't we stop? Is it safe?"."""
    question = g.context.discourse.question
    undone = isinstance(question, Why) and isinstance(question.of, Not)
    return undone and spoken.state in STATES and spoken.tense == "present"
