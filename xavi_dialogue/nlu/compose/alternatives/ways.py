"""Ways: which way we go, or when, where "or" joins several of our courses."""

from msgspec import structs

from xavi_dialogue.domain.meaning import Question, When
from xavi_dialogue.domain.terms import (
    Both,
    Described,
    Ego,
    Exit,
    Happens,
    Pronoun,
    Proposition,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.nlu.compose.wh_questions.which import way_at

_WAYS = frozenset(
    {"exit-left", "exit-right", "exit-straight", "turn", "continue", "continue-next-exit",
     "leave", "enter", "u-turn", "head", "go", "pass"}
)  # fmt: skip
_OTHERS = (Described, Pronoun, Vehicle)


def way_asked(of: Proposition) -> Question | None:
    """Turn "do we turn left or go straight on" into the question which way we go."""
    if not isinstance(of, Both) or of.join != "or":
        return None
    found = [one.event for one in of.contents if isinstance(one, Happens)]
    if len(found) < len(of.contents) or not all(
        event.action in _WAYS
        and isinstance(event.actor, Ego)
        and event.modal is None
        and event.where is None
        and not isinstance(event.object, _OTHERS)
        for event in found
    ):
        return None
    if {event.action for event in found} == {"go"} and found[0].tense != "past":
        return When(
            Happens(structs.replace(found[0], time=Unsaid(), tense="future"))
        )  # "or later?"
    exits = any(isinstance(event.object, Exit) for event in found)
    time = next((e.time for e in found if not isinstance(e.time, Unsaid)), Unsaid())
    return way_at(Ego(), time, found[0].tense, "exit-number" if exits else "turn")
