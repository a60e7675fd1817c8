"""Terms: actors, actions and tenses as the query fields spell them. One table each."""

from collections.abc import Iterator, Mapping
from typing import get_args

from xavi_dialogue.domain.terms import (
    Both,
    Described,
    Ego,
    Event,
    Everyone,
    Happens,
    Is,
    Lane,
    Nobody,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Tense,
    Thing,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import BEYOND, ActionName, Bearing
from xavi_dialogue.nlu.projection.fields import FieldAction, FieldActions, FieldTense

#: What each action is called in the fields; those that are missing have no name there.
ACTIONS: Mapping[ActionName, FieldAction] = {
    **{action: action for action in get_args(FieldAction)},
    "let-go": "give-way",
    "go": "continue",
    "move": "continue",
    "keep-lane": "continue",
    "wait": "stop",
    "stand": "stop",
    "brake": "stop",
    "swerve": "change-left",
    "merge": "change-left",
    "cut-in": "change-left",
    "pass": "overtake",
}
_SIDED: Mapping[ActionName, str] = {
    "turn": "exit",
    "go": "exit",
    "leave": "exit",
    "head": "exit",
    "change-lane": "change",
    "merge": "change",
    "swerve": "change",
    "move": "change",
    "cut-in": "change",
    "pull-out": "change",
}
#: What leads onto another lane or out by an exit, and the sides that these have.
_TAKING = frozenset(("leave", "turn", "enter", "head", "go", "move", "change-lane", "merge"))
_SIDES: Mapping[str, str] = {
    "left": "left", "leftmost": "left", "right": "right", "rightmost": "right",
}  # fmt: skip
_OPEN = frozenset(("turn", "change-lane", "merge", "swerve", "cut-in"))  # without a side: either
_BEARINGS: Mapping[Bearing, str] = {
    "ahead": "front",
    "ahead-left": "left",
    "ahead-right": "right",
    "behind": "behind",
    "behind-left": "left",
    "behind-right": "right",
    "left": "left",
    "right": "right",
    "beside": "left",
    "beside-left": "left",
    "beside-right": "right",
    "crossing-left": "left",
    "crossing-right": "right",
    "oncoming": "oncoming",
    "there": "that",
}
_PLAIN = frozenset(("vehicle", "car"))


def actor_of(thing: Thing | None) -> str:
    """Spell who acts."""
    match thing:
        case None | Ego() | Passenger():
            return "ego"
        case Vehicle(number=number):
            return "ego" if number == 0 else f"vehicle:{number}"
        case Vehicles() | Everyone():
            return "vehicle:both"
        case Wanted():
            return "vehicle:unknown"
        case Pronoun(form=form):
            return f"vehicle:{_pronoun(form)}"
        case Nobody(described=Described() as described) | (Described() as described):
            return f"vehicle:{_described(described)}"
    return "vehicle:unknown"


def actions_of(proposition: Proposition | None) -> FieldActions | None:
    """Spell the actions that a proposition holds to be done, in order."""
    if isinstance(proposition, Is) and proposition.state in ("stationary", "stuck"):
        return ("stop",)
    found = tuple(a for event in events_of(proposition) for a in _named(event))
    return found or None


def event_actions(event: Event | None) -> FieldActions | None:
    """Spell an event and what is done after it."""
    return actions_of(None if event is None else Happens(event))


def events_of(proposition: Proposition | None) -> Iterator[Event]:
    """Yield the events that a proposition holds to happen, and what is done after each."""
    match proposition:
        case Happens(event=event):
            at: Event | None = event
            while at is not None:
                yield at
                at = at.then
        case Not(content=content):
            yield from events_of(content)
        case Is(event=Event() as event):
            yield event
        case Both(contents=contents):
            for one in contents:
                if not isinstance(one, Not):
                    yield from events_of(one)


def denied_of(proposition: Proposition) -> FieldActions | None:
    """Spell what is denied beside something that is held: "gone on instead of stopping"."""
    if not isinstance(proposition, Both):
        return None
    denied = [one.content for one in proposition.contents if isinstance(one, Not)]
    return actions_of(denied[0]) if denied else None


def is_open(event: Event) -> bool:
    """Tell whether the side of a lane change or turn was left open."""
    return event.action in _OPEN and event.side is None


def is_beyond(event: Event) -> bool:
    """Tell whether it is nothing that the car can do."""
    return event.action in BEYOND and isinstance(event.actor, Ego)


def tense_of(event: Event) -> FieldTense:
    """Spell when an event is."""
    return "future" if event.modal == "will" else plain(event.tense)


def plain(tense: Tense) -> FieldTense:
    """Spell a tense."""
    return "past" if tense == "perfect" else tense


def _named(event: Event) -> tuple[FieldAction, ...]:
    taken = getattr(event.object, "side", None) or getattr(event.object, "which", "") or ""
    if event.action in _TAKING and taken in _SIDES:
        stem = "change" if isinstance(event.object, Lane) else "exit"
        return (f"{stem}-{_SIDES[taken]}",)  # type: ignore[return-value]
    if event.side == "straight" and event.action in ("turn", "go", "head", "leave", "move"):
        return ("exit-straight",)
    if event.side in ("left", "right") and event.action in _SIDED:
        kind = _SIDED[event.action]
        return (f"{kind}-{event.side}",)  # type: ignore[return-value]
    if is_open(event):
        return ("exit-left",) if event.action == "turn" else ("change-left",)
    name = ACTIONS.get(event.action)
    return () if name is None else (name,)


def _pronoun(form: str) -> str:
    return {"that": "that", "this": "that", "who": "unknown", "they": "both"}.get(form, "it")


def _described(described: Described) -> str:
    if described.bearing is not None and described.bearing in _BEARINGS:
        return _BEARINGS[described.bearing]
    if described.origin is not None and described.origin in _BEARINGS:
        return _BEARINGS[described.origin]
    if described.colour is not None:
        return described.colour
    if described.kind not in _PLAIN:
        return described.kind
    return "other" if described.other else "that" if described.definite else "unknown"
