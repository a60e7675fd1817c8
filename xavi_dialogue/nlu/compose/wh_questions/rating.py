"""Ratings: what our driving was like: "how would you rate your braking?", "was it a good turn?"."""

from typing import Any, Final, cast

from xavi_dialogue.domain.meaning import Act, Ask, HowDecide, HowMuch, Question, Social, Whether
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Happens,
    Is,
    Measured,
    Proposition,
    Time,
    Unsaid,
)
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.nominal import deed_of
from xavi_dialogue.nlu.compose.clauses.sem import Noun, Sem

_WHOLE: Final = ("move", "go")
_WELL: Final = frozenset(
    ("well", "nicely", "good", "nice", "decent", "smooth", "clean", "tidy", "neat")
)


def rated(clause: Clause, about: Sem | Special | None) -> Question | None:
    """Ask how comfortable a deed of ours was, or the ride as a whole."""
    sem: Sem | None = about.object if isinstance(about, Special) else about
    inner = about.content if isinstance(about, Special) else None
    deed = inner.event if isinstance(inner, Happens) else deed_of(sem)
    if isinstance(deed, Event):
        return _of_deed(deed, clause.time)
    if isinstance(sem, Ego) or (isinstance(sem, Noun) and sem.key == "ride"):
        return HowMuch(Measured("comfort", time=clause.time, tense=cast(Any, "past")))
    return None


def rating_of(acts: tuple[Act, ...], words: str) -> tuple[Act, ...] | None:
    """Read what asks for an opinion of our own driving: "did you brake well?"."""
    if len(acts) != 1:
        return None
    match acts[0]:
        case Social(kind="feelings", about=Happens(event=event) as about):
            found = _of_deed(event, about.event.time)
            return None if found is None else (Social("feelings"), Ask(found))
        case Ask(question=HowDecide(of=Is(state="comfortable" | "uncomfortable") as state)):
            return (Ask(Whether(state, degree=True)),)  # "how did you find that braking?"
        case Ask(question=Whether(that=that)) if not _WELL.isdisjoint(words.split()):
            deed = _deed_in(that)
            rating = None if deed is None else _of_deed(deed, deed.time)
            return None if rating is None else (Ask(rating),)
    return None


def _deed_in(that: Proposition) -> Event | None:
    """Find the deed that is said to have been a good one."""
    match that:
        case Happens(event=Event(tense="past", modal=None, manner=("safely",)) as event):
            return event
        case Is(state="right", tense="past", event=Event() as event):
            return event
        case Happens(event=Event(action="go", modal="should", manner=("first",))):
            return Event("turn")  # "was that a good turn?"
    return None


def _of_deed(deed: Event, time: Time) -> Question | None:
    if not isinstance(deed.actor, Ego):
        return None
    time = time if isinstance(deed.time, Unsaid) else deed.time
    if deed.action in _WHOLE:
        return HowMuch(Measured("comfort", time=time, tense="past"))
    if deed.action == "do":
        named = deed.object is not None
        that = Is("comfortable", deed.object, time=time, tense="past")
        return Whether(that, degree=True) if named else None
    about = Event(deed.action, time=deed.time)
    return Whether(Is("comfortable", event=about, time=time, tense="past"), degree=True)
