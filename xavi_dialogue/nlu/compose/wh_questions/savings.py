"""Savings: how much time an option would take or save: "how much later would that have been?"."""

from typing import Any, Final, cast

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import HowLong, HowMuch, Question, WhatIf, Which
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Exit,
    Happens,
    Lane,
    Measured,
    Passenger,
    Pronoun,
    Proposition,
    Related,
    Tense,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import ActionName, Attribute
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.nominal import event_in
from xavi_dialogue.nlu.compose.clauses.sem import as_thing
from xavi_dialogue.nlu.compose.clauses.tree import words_of

_IT: Final = (Pronoun("it"), Pronoun("that"), Pronoun("this"))
_VAGUE: Final = (None, Ego(), Passenger(), *_IT)
_UNREAL: Final = Event("do", modal="would")
UNREAL: Final = Measured("delay", event=_UNREAL)  # of the option spoken of
_TIME: Final = HowMuch(Measured("delay"))
_TURNS: Final[dict[str, ActionName]] = {
    "left": "exit-left", "right": "exit-right", "straight": "exit-straight"
}  # fmt: skip
_HALTS: Final = frozenset[ActionName](("wait", "stop", "stand", "brake", "slow-down", "follow"))
_SAVED: Final = frozenset[Attribute](("delay", "duration", "time-to-go", "speed"))
#: What leads on by another way: how long it would take is when we would be there.
_WAYS: Final = (*_TURNS.values(), "turn", "circle", "change-lane", "change-left", "change-right")


def of_option(question: Question, clause: Clause, deed: Proposition | None) -> Question:
    """Ask of the option that is named how much time it would take; else of the one spoken of.

    Args:
        question: as it was read.
        clause: its clause, which stands under no condition.
        deed: of "to overtake" in "how much would it save to overtake".
    """
    if (way := _way(question, clause)) is not None:
        return WhatIf(Happens(way), _TIME)
    if (means := _means(question, clause)) is not None:
        return WhatIf(Happens(means), _TIME)
    match question:
        case Which(such=Related("in-the-way-of" | "ahead-of" as how, Wanted() as who, Ego())) if (
            how == "in-the-way-of"
        ) + (clause.modal == "would") + _elsewhere(
            clause
        ) > 1:  # "who would be in our way?", "who is in our way there?"
            held = Event("block", who, Ego(), tense="present", modal="would")
            return replace(question, such=Happens(held))
        case HowMuch(
            of=Measured(attribute="delay" | "duration" | "speed" as attribute), extreme=None
        ):
            if clause.modal != "would":
                return question
        case _:
            return question
    subject = as_thing(clause.subject)
    named = clause.subject if isinstance(clause.subject, Event) else lane_taken(clause)
    if isinstance(subject, Exit):
        named = Event("leave", object=subject)
    named = named or first(deed, Event)
    if named is not None and isinstance(named.actor, Ego) and attribute != "duration":
        tense: Tense = "perfect" if clause.has("have") else "present"
        return WhatIf(Happens(replace(named, tense=tense, modal=None)), _TIME)
    if any(as_thing(phrase.sem) is not None for phrase in clause.complements):
        return question
    if subject not in (_IT if attribute != "delay" else _VAGUE):
        return question
    asked: Attribute = "duration" if attribute == "duration" else "delay"
    return HowMuch(replace(question.of, attribute=asked, to=None, event=_UNREAL))


def _means(question: Question, clause: Clause) -> Event | None:
    """Name what would save time: "how much sooner would we be there by passing it?"."""
    match question:
        case HowMuch(of=Measured(attribute=attribute, tense="present" | "future")) if (
            attribute in _SAVED and clause.tense not in ("past", "perfect")
        ):
            deeds = (event_in(phrase.sem) for phrase in clause.complements if phrase.key == "by")
            deed = next((one for one in deeds if one is not None), None)
            if deed is None or not isinstance(deed.actor, Ego):
                return None
            held = deed.action in _HALTS and clause.modal != "would"  # it is going on
            return None if held else replace(deed, tense="present", modal=None)
    return None


def _elsewhere(clause: Clause) -> bool:
    """Say whether it is said of there: "who is in our way there?"."""
    placed = [words_of(phrase.node).split() for phrase in clause.complements]
    return any(key == "there" for key, _ in clause.bearings) or ["there"] in [
        p[-1:] for p in placed
    ]


def _way(question: Question, clause: Clause) -> Event | None:
    """Name the way of "how long would it take to go straight", "how much longer to the left"."""
    match question:
        case HowLong(of=Event(action=action, actor=actor) as way) if (
            clause.modal == "would" and action in _WAYS and actor in (Ego(), *_IT)
        ):
            tense: Tense = "perfect" if clause.has("have") else "present"
            return replace(way, actor=Ego(), tense=tense, modal=None)
        case HowMuch(of=Measured(attribute="time-to-go")) if clause.verb is None:
            turn = next((_TURNS[key] for key, _ in clause.bearings if key in _TURNS), None)
            return None if turn is None else Event(turn, tense="present")
    return None


def lane_taken(clause: Clause) -> Event | None:
    """Read "would the other lane have been faster", "... quicker in the left lane"."""
    places = [as_thing(phrase.sem) for phrase in clause.complements if phrase.key in ("in", "on")]
    lane = next((t for t in (as_thing(clause.subject), *places) if isinstance(t, Lane)), None)
    if lane is None or lane.of is not None:
        return None
    if clause.verb is not None and not isinstance(as_thing(clause.subject), Lane):
        return None
    return change_to(lane, clause.tense)


def change_to(lane: Lane, tense: str) -> Event:
    """Return the change to a lane that is named."""
    side = {"left": "left", "right": "right", "leftmost": "left", "rightmost": "right"}
    action: Any = f"change-{side.get(lane.which, 'lane')}"
    return Event(action, tense=cast(Any, tense))
