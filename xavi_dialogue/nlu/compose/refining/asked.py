"""Asked for: questions with a question word, by all that their clauses say.

"What was the fastest car so far?" is of the whole ride, "what would be quicker?" of the options.
"""

from typing import Any, Final, cast

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Doing,
    HowLong,
    HowMany,
    HowMuch,
    Identify,
    Listing,
    Question,
    When,
    Which,
)
from xavi_dialogue.domain.terms import (
    Back,
    Compares,
    Described,
    Ego,
    Event,
    Everyone,
    Feature,
    Happens,
    Is,
    Junction,
    Lane,
    Measured,
    Next,
    Not,
    Pronoun,
    Record,
    Related,
    Relative,
    Road,
    Wanted,
    WholeRide,
)
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Measure
from xavi_dialogue.nlu.compose.refining.distances import distance_asked
from xavi_dialogue.nlu.compose.refining.setting_off import Propose, set_off_late
from xavi_dialogue.nlu.compose.refining.sounds import sound_asked
from xavi_dialogue.nlu.compose.refining.turns import turns_asked
from xavi_dialogue.nlu.compose.wh_questions.wh import Wh

WHEN_WE_GO: Final = When(Happens(Event("go", Ego(), tense="future", modal="can")))
_UNREAL: Final = ("would", "could", "might")
_UNTIL: Final = ("before", "until")


def refined(wh: Wh, clause: Clause, question: Question, propose: Propose) -> Question:
    """Return what a question asks for by the slots of its clause."""
    found = (
        _superlative(wh, clause, question) or _sought(question) or _counted(wh, clause, question)
    )
    found = found or turns_asked(clause, question) or _unreal(wh, clause, question)
    found = (
        found
        or sound_asked(clause, question)
        or _of_lights(clause, question)
        or _waited_for(clause, question)
    )
    found = found or set_off_late(clause, question, propose) or _used(clause, question)
    return distance_asked(clause, found or question)


def _superlative(wh: Wh, clause: Clause, question: Question) -> Question | None:
    """Read "what was the fastest car we have seen?" as of all, and not of those in view."""
    match question:
        case Identify(
            Described(
                kind=kind,
                extreme="fastest" | "slowest" as pace,
                bearing=None,
                among=None,
                such=None | Related("can-see", Ego(), Wanted()) as seen,
            )
        ):
            past = clause.tense != "present" and wh.words[-1:] not in (("one",), ("ones",))
            before = seen is not None and seen.tense != "present"
            if not (past or before or clause.time == WholeRide() or "ever" in clause.focus):
                return None
            which: Any = "highest" if pace == "fastest" else "lowest"
            of = Measured("speed", Everyone(kind), time=WholeRide(), tense="past")
            return HowMuch(of, which)
    return None


def sought(act: Act) -> Act:
    """Read what a question of few words asks for as the list or the deed that it is."""
    found = _sought(act.question) if isinstance(act, Ask) else None
    return act if found is None else Ask(found)


def _sought(question: Question) -> Question | None:
    """Read what is asked for as the list or the deed that it is."""
    match question:
        case HowMuch(Measured("turn", time=Back("after"))):
            return Doing(Ego(), Next(), "future")  # "after this, which direction?"
        case Which(Road() | Junction() | Lane(), Not(Related("can-see", Ego(), Wanted()))):
            return Listing("hidden")  # "which part of the road can't you see?"
        case Which(such=Related("on", Wanted(), Record())):
            return Listing("vehicles")  # "what's on your screen?"
        case Which(Described(kind=kind) as one, Compares(Measured("delay", Wanted())) as such) if (
            one == Described(kind)
        ):
            return Which(Wanted(kind), such)  # "which road user limits our speed?"
    return None


def _unreal(wh: Wh, clause: Clause, question: Question) -> Question | None:
    """Read "what would have been quicker?" as asking for the options."""
    if wh.kind != "what" or clause.modal not in _UNREAL or clause.verb is not None:
        return None
    match question:
        case Which(Wanted(), Compares(Measured("speed" | "value", Wanted()), "more", None)):
            return Listing("options")
    return None


def _counted(wh: Wh, clause: Clause, question: Question) -> Question | None:
    """Read "how many are crossing?" as of those who cross, and not of crossings."""
    if question != HowMany(Junction()) or wh.kind != "grade" or clause.verb is not None:
        return None
    crossing = Event("cross", Wanted(), tense=cast(Any, clause.tense))
    return HowMany(Described(doing=crossing, plural=True, definite=False))


def _of_lights(clause: Clause, question: Question) -> Question | None:
    """Read what is asked of a signal, or of who is first in a queue."""
    match question:
        case Which(
            Feature(kind="light"),
            Happens(Event("give-way" | "keep-distance" | "do", who, Wanted(), tense=tense)),
        ):
            return HowMuch(Measured("indicator", who, tense=tense))  # "what signal is it giving?"
        case HowMuch(Measured("colour", Ego() | Pronoun("it")) as of) if (
            isinstance(clause.subject, Measure) and clause.subject.of.attribute == "indicator"
        ):
            return HowMuch(replace(of, thing=Feature("light")))  # "what colour was your signal?"
        case HowLong(Happens(Event("show", tense="present") as event)) if clause.has("do"):
            return HowLong(Happens(replace(event, tense="future")))  # "how long does it stay red?"
        case Which(thing, Is("first", Wanted() as who)):
            if any(_is_queue(c.sem) for c in clause.complements):
                return Which(thing, Related("on", who, Feature("queue")))
    return None


def _is_queue(sem: object) -> bool:
    return isinstance(sem, Feature) and sem.kind in ("queue", "line")


def _waited_for(clause: Clause, question: Question) -> Question | None:
    """Read "what has to happen before we can go?", "how long before we stand?" as when."""
    match question:
        case Doing(
            None, Relative("before", Event("go", Ego(), tense="present", modal="can")), tense
        ) if tense != "past":
            return WHEN_WE_GO
        case When(Is("allowed", event=Event("go", Ego()) as event)):
            return When(Happens(replace(event, modal="can")))  # "when do we get to go?"
        case HowLong(Event("stand" | "stop" as action, Ego(), tense="present")) if any(
            c.key in _UNTIL and c.sem == Ego() for c in clause.complements
        ):
            return When(Happens(Event(action, Ego(), tense="future")))
        case HowMuch(Measured("time-to-go", Ego())) if _is_halt(clause.subject):
            return When(Happens(replace(cast(Event, clause.subject), tense="future")))
    return None


def _is_halt(sem: object) -> bool:
    return isinstance(sem, Event) and sem.action in ("stand", "stop") and sem.actor == Ego()


def _used(clause: Clause, question: Question) -> Question | None:
    """Read "what deceleration did you use?" as how hard we braked."""
    if clause.verb is None or clause.verb.key != "use" or not isinstance(clause.gap, Measure):
        return None
    match question:
        case HowMuch(Measured("deceleration", Ego())):
            braked = Event("brake", Ego(), tense="past")
            return HowMuch(Measured("deceleration", Ego(), event=braked, tense="past"))
        case HowMuch(Measured(attribute, Ego(), time=Relative("during", Event("signal")))):
            return HowMuch(Measured(attribute, Ego(), tense=cast(Any, clause.tense)))
    return None
