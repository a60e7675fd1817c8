"""Closeness of options: "was it a close decision", "how close were the two options"."""

from xavi_dialogue.domain.meaning import Compare, Listing
from xavi_dialogue.domain.terms import Ego, Event, Happens
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Group, Noun, Sem
from xavi_dialogue.nlu.compose.clauses.tree import words_of

_NEAR = frozenset({"close", "narrow", "tight", "near", "hard", "difficult", "tough"})


def is_choice(sem: Sem | None) -> bool:
    """Check whether a noun phrase is a decision of ours, or the options of one."""
    if isinstance(sem, Noun):
        called = sem.key == "prediction" and sem.word == "call"  # "how close was that call"
        return called or sem.key in ("option", "rival", "decision")
    return isinstance(sem, Event) and sem.action == "do" and isinstance(sem.actor, Ego)


def how_near(clause: Clause) -> Listing | Compare | None:
    """Ask which option came nearest to what was chosen, or how near the two named were."""
    return between_deeds(clause) or (rivals(clause) if is_choice(clause.subject) else None)


def between_deeds(clause: Clause) -> Compare | None:
    """Ask of two deeds how near they were: "was it close between stopping and going"."""
    for phrase in clause.complements:
        deeds = phrase.sem.members if isinstance(phrase.sem, Group) else ()
        if phrase.key == "between" and deeds and all(isinstance(one, Event) for one in deeds):
            return Compare(tuple(Happens(one) for one in deeds if isinstance(one, Event)), "margin")
    return None


def nearly_even(clause: Clause) -> Listing | Compare | None:
    """Ask the same where it is asked whether a decision was close; None: of something else."""
    if any(key == "close" for key, _ in clause.adjectives) or "close" in clause.manner:
        return how_near(clause)
    if clause.verb is not None or not clause.objects or not is_choice(clause.objects[0][0]):
        return None
    return rivals(clause) if _NEAR & {*words_of(clause.objects[0][1]).split()} else None


def rivals(clause: Clause) -> Listing:
    """Return the question for the next best options, supposed ones after "would"."""
    supposed = Event("do", modal="would") if clause.modal == "would" else None
    return Listing("rivals", time=clause.time, event=supposed)
